//! All that a comparison takes, read and ready, and the comparing.

use super::measured::Measured;
use super::options::read_scale;
use super::points::PointFiles;
use super::references::{self, Opened};
use super::request::CompareRequest;
use crate::read;
use crate::task::{STEPS, TaskError, Watch, ended, welding};
use std::path::Path;
use trueness_document::InputRecord;
use trueness_document::align::AlignedTo;
use trueness_document::compare::{MeasuredKind, Reverse};
use trueness_document::scale::Scale;
use trueness_files::{ReadError, ReadOptions, Sources, WriteError};
use trueness_geom::closest::QueryError;
use trueness_measure::compare::{
    self, AlongRule, Between, Comparisons, Facing, Lines, Options, ReverseError,
};

/// What is compared with what, and how.
pub struct Prepared {
    pub measured: Measured,
    pub opened: Vec<Opened>,
    /// The measured file, then those of the references.
    pub files: Vec<InputRecord>,
    pub options: Options,
    /// How the measured was brought to the first reference.
    pub alignment: Option<AlignedTo>,
    /// The color scale that was given.
    pub scale: Option<Scale>,
}

impl Prepared {
    /// Reads all files, and aligns if that is asked for.
    pub fn new(
        request: &CompareRequest,
        sources: &dyn Sources,
        watch: &dyn Watch,
    ) -> Result<Prepared, TaskError> {
        let options = request.options(sources)?;
        let tolerance = options.tolerance.map(|t| [t.lower, t.upper]);
        let scale = request.scale.as_deref().map(|path| read_scale(sources, path)).transpose()?;
        let scale = scale.map(|scale| scale.for_tolerance(tolerance));
        let reading = request.reading.options();
        let (sample, seed) = (request.sample, request.seed);
        let measured = Measured::open(&request.measured, &reading, sample, seed, (sources, watch))?;
        if request.both && measured.mesh.is_none() {
            let text = "--both needs a measured mesh: points have no facets to measure back to";
            return Err(TaskError::usage(text));
        }
        let of_references = request.reference_reading.options(&request.reading);
        let reading = ReadOptions { weld: welding(request.weld)?, ..of_references };
        let (opened, records) = references::open(&request.references, &reading, &options, (sources, watch))?;
        let mut files = vec![measured.record.clone()];
        files.extend(records);
        let mut ready = Prepared { measured, opened, files, options, alignment: None, scale };
        if request.align {
            ready.align(request, watch)?;
        }
        ready.ask_beside_points(request, sources)?;
        Ok(ready)
    }

    /// Brings the measured to the first reference.
    fn align(&mut self, request: &CompareRequest, watch: &dyn Watch) -> Result<(), TaskError> {
        let stage = watch.stage("aligning", STEPS, None);
        let reference = (self.opened[0].mesh(), self.opened[0].faces());
        let found = self.measured.align(&request.measured, reference, request.seed, &*stage)?;
        // Aligning reads the points.
        self.files[0].warnings.clone_from(&self.measured.record.warnings);
        self.alignment = Some(trueness_measure::align::aligned_to(&found, self.files[1].path.clone()));
        Ok(())
    }

    /// What is asked of the measured beside its points: places on large facets for maps, normals where a rule needs them.
    fn ask_beside_points(
        &mut self,
        request: &CompareRequest,
        sources: &dyn Sources,
    ) -> Result<(), TaskError> {
        let (measured, options) = (&self.measured, &mut self.options);
        let mapped = options.tells_coverage();
        let vertices = measured.mesh.as_ref().filter(|_| mapped && measured.kind == MeasuredKind::Vertices);
        options.between = vertices.map(Between::of).unwrap_or_default();
        let between = options.between.normals.clone();
        let columns = request.normals.as_ref().map(|columns| &columns.value);
        let normals = |what: &str| {
            let file = (sources, request.measured.as_path());
            let own = measured.normals(file, columns, &request.reading.options(), what);
            own.map(|own| [own, between.clone()].concat())
        };
        if request.along() == Some(AlongRule::Measured) {
            options.along = Some(Lines::new(AlongRule::Measured, normals("--along measured")?));
        }
        if let Some(angle) = request.facing {
            options.facing = Some(Facing::new(angle.radians(), normals("--facing")?));
        }
        Ok(())
    }

    /// Compares all points, which go to the files of points block by block, and meanwhile takes the hashes of what was read.
    pub fn compare(
        &mut self,
        request: &CompareRequest,
        mut points: Option<&mut PointFiles>,
        (sources, watch): (&dyn Sources, &dyn Watch),
    ) -> Result<Comparisons, TaskError> {
        let Prepared { measured, opened, files, options, .. } = self;
        let references = references::named(opened, &files[1..]);
        let between = options.between.points.len() as u64;
        let total = measured.points.expected().map(|n| (n + between) * references.len() as u64);
        let stage = watch.stage("comparing", "points", total);
        let (hashes, found) =
            rayon::join(
                || {
                    let paths = [&request.measured].into_iter().chain(&request.references);
                    files.iter_mut().zip(paths).try_for_each(|(file, path)| read::hash(sources, file, path))
                },
                || {
                    compare::run(&mut *measured.points, &references, options, &*stage, |block| {
                        match &mut points {
                            Some(files) => files.write(block),
                            None => Ok(()),
                        }
                    })
                },
            );
        let found = ended(stage, found).map_err(|e| in_file(e, &request.measured))?;
        hashes?;
        files[0].warnings.extend(measured.points.remarks());
        Ok(found)
    }

    /// Both directions together; nothing where the measured is no mesh.
    pub fn reverse(&self, found: &Comparisons, watch: &dyn Watch) -> Result<Vec<Option<Reverse>>, TaskError> {
        let Some(mesh) = &self.measured.mesh else { return Ok(vec![]) };
        let stage = watch.stage("measuring back", "points", None);
        let all = self.opened.iter().zip(&found.references);
        let back = all.map(|(r, forth)| compare::reverse(mesh, r.mesh(), forth, &*stage).map(Some));
        back.collect::<Result<_, _>>().map_err(|e| match e {
            ReverseError::Query(QueryError::Cancelled(e)) => e.into(),
            e => TaskError::because(e),
        })
    }
}

/// A comparison that failed, with the file that it failed on.
fn in_file(error: compare::CompareError<ReadError, WriteError>, measured: &Path) -> TaskError {
    use compare::CompareError::{NoPoints, Normals, Query, Reference, Sink, Stream};
    match error {
        Stream(e) => e.into(),
        Sink(e) => e.into(),
        Query(QueryError::Cancelled(e)) => e.into(),
        e @ (Query(_) | NoPoints | Normals { .. }) => {
            TaskError::unanswerable(format!("{}: {e}", measured.display()))
        }
        e @ Reference { .. } => TaskError::because(e),
    }
}
