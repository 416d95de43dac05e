//! What a request means for the comparison: its values checked, its small files read.

use super::request::{CompareRequest, Method};
use crate::read;
use crate::task::{Meaning, REPORT_POINTS, TaskError};
use std::path::Path;
use trueness_document::of_percent;
use trueness_document::scale::Scale;
use trueness_document::tolerance::cannot_fail;
use trueness_files::{Fault, Sources};
use trueness_geom::deviation::surface::SurfaceOptions;
use trueness_measure::compare::{AlongRule, Lines, Options};

/// Worst places that can be asked for.
const MAX_WORST: u16 = 1000;
/// Longest color scale, bytes.
const LONGEST_SCALE: usize = 16 << 20;

impl CompareRequest {
    /// What is asked of the comparison; normals and places between vertices come later.
    pub(super) fn options(&self, sources: &dyn Sources) -> Result<Options, TaskError> {
        self.check_numbers()?;
        let share = |name: &str, written: f64| {
            of_percent(written).map_err(|what| TaskError::usage(format!("{name} {written}: {what}")))
        };
        let required_share = share("--inside", self.inside)?;
        let min_coverage = share("--min-coverage", self.min_coverage)?;
        let max_distance = self.max_distance.unwrap_or(f64::INFINITY);
        if self.max_distance.is_some_and(|d| !(0.0..f64::INFINITY).contains(&d)) {
            return Err(TaskError::usage(format!(
                "--max-distance {max_distance}: a distance is a finite number of mm, 0 or more; without the option there is no limit"
            )));
        }
        self.check_along()?;
        let regions = self.regions.as_deref().map(|path| read::regions(sources, path));
        let regions = regions.transpose()?.unwrap_or_default();
        let tolerance = self.tolerance.as_ref().map(|t| t.value.0);
        let zones = tolerance.into_iter().chain(regions.iter().map(|r| r.tolerance));
        if let Some(why) = cannot_fail(max_distance, zones) {
            return Err(TaskError::usage(format!("--max-distance {max_distance}: {why}")));
        }
        Ok(Options {
            method: self.method.into(),
            surface: SurfaceOptions {
                sign: self.sign.into(),
                max_distance,
                skip_boundary: self.skip_boundary,
            },
            along: self.along().map(|rule| Lines::new(rule, vec![])),
            outliers: self.outliers.as_ref().map(|rule| rule.value),
            coverage: self.coverage.as_ref().map(|reach| reach.value),
            min_coverage,
            regions,
            tolerance,
            worst: self.worst.map_or(Options::default().worst, usize::from),
            required_share,
            shown: if self.view { REPORT_POINTS } else { 0 },
            independent: self.independent,
            research: self.research,
            seed: self.seed,
            ..Options::default()
        })
    }

    /// Along what lines deviations are measured.
    pub(super) fn along(&self) -> Option<AlongRule> {
        self.along.as_ref().map(|rule| rule.value)
    }

    /// Refuses numbers that mean nothing.
    fn check_numbers(&self) -> Result<(), TaskError> {
        let wrong = |what: String| Err(TaskError::usage(what));
        if self.references.is_empty() {
            return wrong("there is no reference; give at least one".into());
        }
        if let Some(n) = self.worst.filter(|n| !(1..=MAX_WORST).contains(n)) {
            return wrong(format!("--worst {n}: give a number from 1 to {MAX_WORST}"));
        }
        if self.sample == Some(0) {
            return wrong("--sample 0: give a number from 1 upwards".into());
        }
        if self.tolerance.is_none() && self.inside != CompareRequest::default().inside {
            return wrong(format!(
                "--inside {} is a share within a tolerance; give --tolerance",
                self.inside
            ));
        }
        Ok(())
    }

    /// Refuses what lines do not go with.
    fn check_along(&self) -> Result<(), TaskError> {
        let along = self.along();
        if self.normals.is_some() && self.facing.is_none() && along != Some(AlongRule::Measured) {
            return Err(TaskError::usage("--normals is for --facing and --along measured; give one of them"));
        }
        match (along, self.method) {
            (Some(_), Method::Paper) => {
                Err(TaskError::usage("--along measures along lines, --method paper to vertices; choose one"))
            }
            (Some(_), _) if self.both => Err(TaskError::usage(
                "--both measures to the nearest place in both directions; leave --along out",
            )),
            _ => Ok(()),
        }
    }
}

/// The color scale of a file.
pub fn read_scale(sources: &dyn Sources, path: &Path) -> Result<Scale, TaskError> {
    let shown = path.display();
    let text = sources.text(path, LONGEST_SCALE).map_err(|e| match e.fault {
        Fault::Io(e) => TaskError::because(e),
        _ => e.into(),
    });
    let text = text.meaning(|| format!("{shown}: the color scale cannot be read; check the path"))?;
    let scale: Scale = serde_json::from_str(&text).meaning(|| {
        format!("{shown}: it holds no color scale; give a JSON object trueness/scale/1, as under the key `scale` of a result")
    })?;
    scale.check().meaning(|| format!("{shown}: the color scale cannot be used; correct it"))?;
    Ok(scale)
}
