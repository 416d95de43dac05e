//! The plan's file, and the files that it names.

use super::part::Fault;
use crate::read::{self, Opened};
use crate::task::{Meaning, TaskError};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use trueness_document::inspect::PlanRecord;
use trueness_document::plan::{At, PlanError};
use trueness_document::{InputRecord, Role};
use trueness_files::{ReadOptions, Sources};
use trueness_geom::progress::Silent;
use trueness_geom::scan::Scan;
use trueness_geom::space::Point;
use trueness_measure::inspection::{Data, OwnPoints};
use trueness_measure::plan::Plan;
use trueness_measure::requirement::{Feature, Source};

/// Longest plan that is read, bytes.
const LONGEST_PLAN: usize = 16 << 20;

/// A plan with its text.
pub struct PlanFile {
    pub path: PathBuf,
    pub text: String,
    pub plan: Plan,
    sha256: Option<String>,
}

impl PlanFile {
    pub fn read(sources: &dyn Sources, path: &Path) -> Result<PlanFile, TaskError> {
        let shown = path.display();
        let wrong = |what: String| TaskError::unanswerable(format!("{shown}: {what}"));
        if sources.is_stream(path) {
            return Err(wrong(
                "a plan must be a file, as its paths are relative to its folder; save it and name that"
                    .into(),
            ));
        }
        let bytes = read::bytes(sources, path, "plan", LONGEST_PLAN)?
            .ok_or_else(|| wrong("it is longer than 16 MB; a plan is a short text".into()))?;
        let text = String::from_utf8(bytes).map_err(|e| {
            let valid = String::from_utf8_lossy(&e.as_bytes()[..e.utf8_error().valid_up_to()]).into_owned();
            let end = valid.len();
            let what = "the text is not UTF-8; save the plan as UTF-8";
            wrong(PlanError::at(&valid, &(end..end), what).to_string())
        })?;
        let plan = Plan::parse(&text).map_err(|e| wrong(e.to_string()))?;
        Ok(PlanFile { path: path.to_owned(), text, plan, sha256: read::digest(sources, path) })
    }

    pub fn record(&self) -> PlanRecord {
        PlanRecord { path: self.path.display().to_string(), sha256: self.sha256.clone() }
    }

    /// A path of the plan, from where the program runs.
    fn path_of(&self, written: &At<String>) -> PathBuf {
        let folder = self.path.parent().filter(|p| !p.as_os_str().is_empty());
        folder.map_or_else(|| PathBuf::from(&written.value), |f| f.join(&written.value))
    }

    /// The files that it reads; with `own`, its own measured data among them.
    pub fn inputs(&self, own: bool) -> Vec<PathBuf> {
        let points = self.plan.features.iter().filter_map(|f| match &f.source {
            Source::Points(path) => Some(path),
            _ => None,
        });
        let measured = self.plan.measured.iter().filter(|_| own);
        points.chain(measured).chain(&self.plan.reference).map(|p| self.path_of(p)).collect()
    }

    /// The place of something in the plan, and what it is, for errors.
    fn at(&self, written: &At<String>, what: &str) -> String {
        format!("{}: {}", self.path.display(), PlanError::at(&self.text, &written.span, what))
    }

    /// What a part is called: its file, that of the plan's measured data, or the plan.
    pub fn name_of(&self, part: Option<&Path>) -> String {
        let own = || self.plan.measured.as_ref().map_or_else(|| self.path.clone(), |own| self.path_of(own));
        part.map_or_else(own, Path::to_owned).display().to_string()
    }

    /// Reads the measured data at `path`.
    fn measured(
        &self,
        sources: &dyn Sources,
        path: &Path,
        options: &ReadOptions,
        data: &mut Data,
    ) -> Result<InputRecord, TaskError> {
        let (scan, record, _) = read_scan(sources, path, options)?;
        if let Some(what) = self.plan.deviation.as_ref().and_then(|d| d.needs_normals())
            && matches!(scan, Scan::Cloud(_))
        {
            let what = format!("{what} of [deviation]");
            data.normals = read::all_normals(sources, path, None, options, &what, "")?;
        }
        data.measured = Some(scan);
        Ok(record)
    }

    /// Everything measured, with `part` in place of the plan's own measured data.
    /// `shown` points are kept for a report.
    pub fn data(
        &self,
        sources: &dyn Sources,
        part: Option<&Path>,
        seed: u64,
        shown: usize,
    ) -> Result<(Data, Vec<InputRecord>), Fault> {
        // A file that says its unit knows better than the plan.
        let unit_else = self.plan.units.and_then(|u| u.name().parse().ok());
        let options = ReadOptions { unit_else, ..ReadOptions::default() };
        let (mut data, mut inputs) = (Data { seed, shown, ..Data::default() }, Vec::new());
        if let Some(own) = &self.plan.measured {
            let path = part.map_or_else(|| self.path_of(own), Path::to_owned);
            let measured = self.measured(sources, &path, &options, &mut data);
            let measured = match part {
                Some(_) => measured,
                None => measured
                    .meaning(|| self.at(own, "the measured data (--measured FILE names another file)")),
            };
            inputs.push(measured.map_err(Fault::Part)?);
        }
        // A feature that is sought by its nominal is told what it leaves out.
        let sought = self.plan.features.iter().any(Feature::is_sought);
        let wanted = sought || self.plan.align.uses_reference() || self.plan.deviation.is_some();
        if let Some(written) = self.plan.reference.as_ref().filter(|_| wanted) {
            let path = self.path_of(written);
            let read = read::mesh_or_faces(sources, &path, &options, &Silent);
            let (source, faces, mut record) = read.meaning(|| self.at(written, "the reference"))?;
            read::hash(sources, &mut record, &path)?;
            (data.reference, data.reference_left_out) = (Some(source.mesh), source.nonfinite_facets);
            data.faces = faces.map(Arc::new);
            inputs.push(record);
        }
        let mut seen: BTreeMap<PathBuf, (Vec<Point>, bool)> = BTreeMap::new();
        for (number, feature) in self.plan.features.iter().enumerate() {
            let Source::Points(written) = &feature.source else { continue };
            let path = self.path_of(written);
            if !seen.contains_key(&path) {
                let what = format!("the points of feature \"{}\"", feature.id);
                let (scan, record, planar) =
                    read_scan(sources, &path, &options).meaning(|| self.at(written, &what))?;
                inputs.push(record);
                seen.insert(path.clone(), (scan.into_points(), planar));
            }
            if let Some((points, planar)) = seen.get(&path) {
                data.points.insert(number, OwnPoints { points: points.clone(), planar: *planar });
            }
        }
        Ok((data, inputs))
    }
}

/// Reads a mesh or points, and whether these have two coordinates only.
fn read_scan(
    sources: &dyn Sources,
    path: &Path,
    options: &ReadOptions,
) -> Result<(Scan, InputRecord, bool), TaskError> {
    let Opened { mut record, body, planar, .. } = read::open(sources, path, Role::Measured, options)?;
    let scan = read::scan(path, body, &mut record)?;
    read::describe(&mut record, scan.points());
    read::hash(sources, &mut record, path)?;
    Ok((scan, record, planar))
}
