//! The nominal that a section is compared with.

mod faces;
mod layers;
mod outlines;

use super::found::Found;
use super::planes::{self, Cut};
use super::request::SectionRequest;
use crate::task::{TaskError, ToleranceText};
use outlines::{Nominal, plane_of};
use trueness_document::compare::Warning;
use trueness_document::section::{NominalRecord, NominalWarning, ProfileRule};
use trueness_document::tolerance::cannot_fail;
use trueness_document::{InputRecord, of_percent};
use trueness_files::Sources;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::Aabb;
use trueness_measure::compare::plausibility;
use trueness_measure::section::{Against, AgainstPlane, Section};
use trueness_section::{self as section, Contour, OntoNominalError, Options, Outline};

/// What a section must be near to.
pub struct Rule {
    /// What the profile must keep, if anything.
    profile: Option<ProfileRule>,
    /// From what distance on points do not count.
    max_distance: f64,
}

impl SectionRequest {
    /// What the profile must keep.
    pub(super) fn rule(&self) -> Result<Rule, TaskError> {
        if self.nominal.is_none() {
            self.reference_reading.without_reference("--nominal")?;
        }
        let share = |name: &str, written: f64| {
            of_percent(written).map_err(|what| TaskError::usage(format!("{name} {written}: {what}")))
        };
        let max_distance = self.max_distance.unwrap_or(f64::INFINITY);
        if self.max_distance.is_some_and(|d| !(d > 0.0 && d.is_finite())) {
            return Err(TaskError::usage(format!(
                "--max-distance {max_distance}: a distance is a finite number of mm above 0; without the option there is no limit"
            )));
        }
        let Some(ToleranceText(tolerance)) = self.tolerance.as_ref().map(|t| t.value) else {
            return Ok(Rule { profile: None, max_distance });
        };
        if let Some(why) = cannot_fail(max_distance, std::iter::once(tolerance)) {
            return Err(TaskError::usage(format!("--max-distance {max_distance}: {why}")));
        }
        let profile = ProfileRule {
            tolerance,
            required_share: share("--inside", self.inside)?,
            min_coverage: share("--min-coverage", self.min_coverage)?,
        };
        Ok(Rule { profile: Some(profile), max_distance })
    }
}

/// How the points of the sections differ from the nominal, and what there is to say about its file; nothing where none was
/// given.
pub fn compare(
    request: &SectionRequest,
    sources: &dyn Sources,
    (found, planes): (&Found, &[Cut]),
    (rule, options): (&Rule, &Options),
    progress: &dyn Progress,
) -> Result<Option<(NominalRecord, InputRecord)>, TaskError> {
    let Some(path) = &request.nominal else { return Ok(None) };
    let sections = &found.sections;
    let reading = request.reference_reading.options(&request.reading);
    let nominal = Nominal::open(sources, path, &reading, sections.len(), progress)?;
    let freedom = request.freedom();
    let (mut all, mut fits, mut in_plane) = (vec![], vec![], vec![]);
    let mut rows = found.rows.iter();
    for (n, section) in sections.iter().enumerate() {
        let (mut outlines, doubt) =
            nominal.outlines((found, n), section, planes.get(n), options, progress)?;
        in_plane.extend(doubt);
        let own: Vec<&[[f64; 2]]> = rows.by_ref().take(section.contours.len()).map(|r| &r[..]).collect();
        let plane = section.plane.map(|_| n as u64);
        if let Some(freedom) = freedom.filter(|_| !outlines.is_empty() && !own.is_empty()) {
            let fit = section::onto_nominal(&own, &outlines, freedom.1, rule.max_distance, progress);
            let fit = fit.map_err(|e| with_place(e, &nominal, plane))?;
            // Coordinates stay those of the section.
            let back = fit.motion.inverse();
            outlines = outlines.iter().map(|o| o.moved(&back)).collect();
            fits.push(trueness_measure::section::fit_record(plane, freedom, &fit));
        }
        let contours = (own.into_iter().zip(&section.contours))
            .map(|(points, contour)| against(points, contour, &outlines, rule.max_distance, progress))
            .collect::<Result<_, _>>()?;
        all.push(AgainstPlane { plane, outlines, contours });
    }
    if all.iter().all(|plane| plane.outlines.is_empty()) {
        let first = sections.first().map(|section| plane_of(section, planes.first()));
        let reach = first.map_or(String::new(), |plane| planes::reach(&plane, &nominal.record));
        return Err(nominal.because(format!(
            "no plane of the section meets it{reach}; bring part and nominal together with trueness align, or say its unit \
             with --reference-units"
        )));
    }
    let unlikely = unlikely(sections, &all).into_iter().map(NominalWarning::from);
    let mut found = trueness_measure::section::nominal(&nominal.record.path, nominal.kind(), all);
    found.warnings.splice(0..0, unlikely.chain(nominal.passed_over()).chain(in_plane));
    found.fits = fits;
    if let Some(profile) = &rule.profile {
        found.judge(profile, &nominal.record);
    }
    Ok(Some((found, nominal.record)))
}

/// The points of a contour against outlines; those farther than `max_distance` are left out.
fn against<'a>(
    points: &'a [[f64; 2]],
    contour: &'a Contour,
    outlines: &[Outline],
    max_distance: f64,
    progress: &dyn Progress,
) -> Result<Against<'a>, Cancelled> {
    let mut found = section::off_nominal(points, outlines, progress)?;
    let mut far = 0;
    for off in &mut found {
        if off.is_some_and(|o| o.deviation.abs() > max_distance) {
            (*off, far) = (None, far + 1);
        }
    }
    Ok(Against { points, found, far, contour })
}

/// Why there is no best fit, with the file and the plane.
fn with_place(e: OntoNominalError, nominal: &Nominal, plane: Option<u64>) -> TaskError {
    match e {
        OntoNominalError::Cancelled(e) => e.into(),
        e => nominal.because(format!(
            "--fit{}: {e}",
            plane.map_or(String::new(), |n| format!(" in plane {}", n + 1))
        )),
    }
}

/// What makes it unlikely that part and nominal belong together: sizes as of another unit, boxes that lie apart.
fn unlikely(sections: &[Section], all: &[AgainstPlane]) -> Vec<Warning> {
    let (mut measured, mut nominal) = (vec![], vec![]);
    // What one of them alone has in a plane tells nothing.
    let both = |(_, p): &(&Section, &AgainstPlane)| !p.outlines.is_empty() && !p.contours.is_empty();
    for (section, plane) in sections.iter().zip(all).filter(both) {
        measured.extend(plane.contours.iter().flat_map(|c| c.points).map(|p| section.frame.place(*p)));
        for corners in plane.outlines.iter().filter_map(Outline::bounds) {
            let corner = |[i, j]: [usize; 2]| section.frame.place([corners[i][0], corners[j][1]]);
            nominal.extend([[0, 0], [0, 1], [1, 0], [1, 1]].map(corner));
        }
    }
    let [measured, nominal] = [measured, nominal].map(|places| trueness_measure::bounds(&Aabb::of(&places)));
    match (measured, nominal) {
        (Some(m), Some(n)) => plausibility::warnings(&m, &n, "--units, --reference-units"),
        _ => vec![],
    }
}
