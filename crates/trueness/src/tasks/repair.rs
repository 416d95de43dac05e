//! A mesh without its defects, and without a vertex moved.

use crate::read;
use crate::task::{
    Done, Output, Page, Reading, Request, RunFiles, STEPS, Scene, TaskError, Watch, not_negative,
    share_of_percent,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use trueness_document::Role;
use trueness_document::repair::{OutputRecord, RepairDocument};
use trueness_files::Sources;
use trueness_files::write::{MeshFile, Writable};
use trueness_geom::check::{self, CheckError};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_measure::repair::{Around, at_least, defects, document};
use trueness_report::views::repair::View;
use trueness_solid::repair::{self, Holes, Options, RepairError, Repaired, Step};

/// What a repair is asked.
///
/// ```
/// use trueness::task::{Outcome, Request};
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::repair::RepairRequest};
/// let folder = std::env::temp_dir().join(format!("trueness-repair-{}", std::process::id()));
/// std::fs::create_dir_all(&folder)?;
/// let request = RepairRequest {
///     mesh: "../../corpus/broken/hole_one_triangle.stl".into(),
///     out: Some(folder.join("sound.stl")),
///     ..RepairRequest::default()
/// };
/// let mut done = request.run(&FileSources, &Silent)?;
/// assert_eq!((done.outcome, done.document.facets.added), (Outcome::Conforming, 1));
/// done.commit()?;
/// assert!(folder.join("sound.stl").exists());
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RepairRequest {
    /// The mesh.
    pub mesh: PathBuf,
    /// How it is taken.
    #[serde(flatten)]
    pub reading: Reading,
    /// Where to write the mended mesh, mm; STL holds single precision only.
    pub out: Option<PathBuf>,
    /// Replace the mesh by the mended one, once that is written and read again.
    pub in_place: bool,
    /// Only these steps, in their own order; none: all. See [`STEPS`](trueness_solid::repair::STEPS).
    pub only: Vec<String>,
    /// All steps but these.
    pub skip: Vec<String>,
    /// Distance up to which two places may have been meant as one, mm; without it eight steps of single precision.
    pub gap: Option<f64>,
    /// Fill holes up to this share of the area of their shell, percent; of a shell with a larger one, up to 0.5 % only.
    pub holes: f64,
    /// Fill all holes, however large, even the rim of a sheet that is not flat; `holes` does not count then.
    pub all_holes: bool,
    /// Stitch edges up to this distance, mm; without it a ten-thousandth of the diagonal.
    pub stitch: Option<f64>,
    /// Remove shells with a smaller diagonal than this share of the whole, percent; without it none.
    pub remove_islands: Option<f64>,
    /// Share of the diagonal, and of the volume, by which the part may change, percent.
    pub max_change: f64,
    /// Changes to list in the document; all are counted.
    pub items: usize,
    /// Keep what a report draws.
    pub view: bool,
}

impl Default for RepairRequest {
    fn default() -> RepairRequest {
        RepairRequest {
            mesh: PathBuf::new(),
            reading: Reading::default(),
            out: None,
            in_place: false,
            only: vec![],
            skip: vec![],
            gap: None,
            holes: 25.0,
            all_holes: false,
            stitch: None,
            remove_islands: None,
            max_change: 0.01,
            items: 1000,
            view: false,
        }
    }
}

impl RepairRequest {
    /// Where the mended mesh goes.
    fn target(&self) -> &PathBuf {
        self.out.as_ref().unwrap_or(&self.mesh)
    }

    fn check(&self) -> Result<(), TaskError> {
        if self.out.is_none() && !self.in_place {
            return Err(TaskError::usage("the repaired mesh needs a file: give --out or --in-place"));
        }
        if !self.only.is_empty() && !self.skip.is_empty() {
            return Err(TaskError::usage("--only and --skip both choose steps; leave one of the two out"));
        }
        Ok(())
    }

    fn options(&self) -> Result<Options, TaskError> {
        let (only, skip) = (names("only", &self.only)?, names("skip", &self.skip)?);
        let wanted = |s: &&'static Step| (only.is_empty() || only.contains(s)) && !skip.contains(s);
        Ok(Options {
            steps: repair::STEPS.into_iter().filter(wanted).collect(),
            gap: self.gap.map(|x| not_negative("gap", x)).transpose()?,
            stitch: self.stitch.map(|x| not_negative("stitch", x)).transpose()?,
            islands: self.remove_islands.map(|x| share_of_percent("remove-islands", x)).transpose()?,
            single: self.target().extension().is_some_and(|e| e.eq_ignore_ascii_case("stl")),
            holes: match self.all_holes {
                true => Holes::All,
                false => Holes::UpTo(share_of_percent("holes", self.holes)?),
            },
        })
    }
}

/// The steps of these names.
fn names(option: &str, given: &[String]) -> Result<Vec<&'static Step>, TaskError> {
    let find = |name: &String| {
        repair::step(&name.replace('-', "_")).ok_or_else(|| {
            let known: Vec<&str> = repair::STEPS.iter().map(|s| s.name).collect();
            let known = known.join(", ");
            TaskError::usage(format!("--{option} {name}: there is no such step; there are {known}"))
        })
    };
    given.iter().map(find).collect()
}

impl Request for RepairRequest {
    type Document = RepairDocument;
    const COMMAND: &'static str = "repair";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        self.check()?;
        Ok(RunFiles::of([&self.mesh]).in_place(self.in_place).out(Some(self.target()), Writable::Mesh))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<RepairDocument>, TaskError> {
        self.check()?;
        let options = self.options()?;
        let max_change = not_negative("max-change", self.max_change)? / 100.0;
        let reading = self.reading.options();
        let (source, mut record) = read::mesh(sources, &self.mesh, Role::Mesh, &reading)?;
        if !source.unread.is_empty() {
            record.warnings.push(lost(&source.unread));
        }
        let stage = watch.stage("repairing", STEPS, None);
        let repaired = repair::repair(&source.mesh, &options, &*stage).map_err(|e| match e {
            RepairError::Cancelled(e) => e.into(),
            e => TaskError::unanswerable(format!("{}: {e}", self.mesh.display())),
        })?;
        drop(stage);
        let stage = watch.stage("measuring", STEPS, None);
        // One after the other the bytes of a file leave all threads but one idle.
        let write = || -> Result<MeshFile, TaskError> {
            read::hash(sources, &mut record, &self.mesh)?;
            Ok(MeshFile::write(self.target(), &repaired.mesh)?)
        };
        let (deviation, file) = rayon::join(|| repaired.deviation(&source.mesh, &*stage), write);
        let mut file = file?;
        drop(stage);
        let stage = watch.stage("checking the file", STEPS, None);
        let output = again(self.target(), self.gap, &mut file, &repaired, &*stage)?;
        drop(stage);
        let left_out = source.nonfinite_facets.len() as u64;
        let around = Around { file: record, left_out, output, deviation, limit: self.items, max_change };
        let document = document(&repaired, &options, around);
        let mended = Mended { before: source.mesh, after: repaired.mesh };
        let scene = self.view.then(|| Box::new(mended) as Box<dyn Scene<RepairDocument>>);
        Ok(Done { scene, outputs: vec![Output::later(move || file.finish())], ..Done::new(document) })
    }
}

/// What the file read tells of its vertices and facets and the file written will not.
fn lost(names: &[String]) -> String {
    /// A header may name thousands.
    const MAX_NAMED_DATA: usize = 12;
    let named = names.iter().take(MAX_NAMED_DATA).map(String::as_str).collect::<Vec<_>>().join(", ");
    let more = if names.len() > MAX_NAMED_DATA { ", …" } else { "" };
    format!("the mended mesh has places and facets only; the file's other data are not in it: {named}{more}")
}

/// Reads the file written and checks it.
fn again(
    target: &Path,
    gap: Option<f64>,
    file: &mut MeshFile,
    repaired: &Repaired,
    progress: &dyn Progress,
) -> Result<OutputRecord, TaskError> {
    let back: Option<Mesh> = file.read_back()?;
    let options = check::Options { gap, ..check::Options::default() };
    let report = match &back {
        // The same mesh has the same report.
        Some(mesh) if *mesh == repaired.mesh => Some(repaired.after.clone()),
        Some(mesh) => Some(check::check(mesh, None, &options, progress).map_err(|e| match e {
            CheckError::Cancelled(e) => e.into(),
            e => TaskError::because(e),
        })?),
        None => None,
    };
    Ok(OutputRecord {
        path: target.display().to_string(),
        rounded_vertices: file.loss.moved + repaired.rounded.vertices,
        rounding: file.loss.farthest.max(repaired.rounded.farthest),
        sound: report.as_ref().map(|r| r.sound),
        sound_reason: report.is_none().then(|| "it cannot be read again".into()),
        defects: report.as_ref().map(defects).unwrap_or_default(),
        at_least: report.as_ref().map(at_least).unwrap_or_default(),
    })
}

/// The mesh before and after.
struct Mended {
    before: Mesh,
    after: Mesh,
}

impl Scene<RepairDocument> for Mended {
    fn draw<'a>(&self, document: &RepairDocument, page: &'a mut Page<'a>) -> Result<(), TaskError> {
        let view = View::new(document, &document.inputs[0].path, &self.before, &self.after);
        page(&view.objects(), &view.marks)
    }
}
