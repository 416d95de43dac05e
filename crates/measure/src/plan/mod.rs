//! The inspection plan that can be evaluated: features, characteristics, decision.
//!
//! [`Plan::parse`] refuses whatever could not be evaluated, with line, column and the nearest known word, before any file
//! is read.

mod align;
mod checker;
mod datum;
mod decision;
mod deviation;
mod feature;
mod limits_read;
mod material;
pub mod region;
mod spec;
mod tolerance_region;

pub use align::Align;
pub use decision::{Decision, Noise, NoiseSource, Rule};
pub use deviation::Deviation;
pub(crate) use feature::DEFAULT_MIN_COVERAGE;
pub use tolerance_region::{ToleranceRegion, regions_of_file};

use crate::characteristic::Spec;
use crate::requirement::Feature;
use checker::Checker;
use trueness_document::plan::{At, PlanError, PlanText, UnitWord};

/// A plan that can be evaluated. Lengths in millimeters, angles in radians.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Heading.
    pub title: Option<String>,
    /// Unit of files that do not say their own.
    pub units: Option<UnitWord>,
    /// File of the measured mesh or cloud, as written.
    pub measured: Option<At<String>>,
    /// File of the nominal mesh, as written.
    pub reference: Option<At<String>>,
    /// How the measured data come to lie on the reference.
    pub align: Align,
    /// What is asked of the deviations from the reference; nothing where absent.
    pub deviation: Option<Deviation>,
    /// The features, in the plan's order.
    pub features: Vec<Feature>,
    /// The characteristics, in the plan's order.
    pub specs: Vec<Spec>,
    /// How verdicts are reached.
    pub decision: Decision,
}

impl Plan {
    /// Reads a plan.
    ///
    /// # Errors The first fault, with line and column. It is no TOML, has an unknown key or word (with the nearest known one), or names a
    /// feature that does not exist. A kind does not fit its feature; a datum, tolerance or key is missing.
    ///
    /// ```
    /// use trueness_measure::plan::Plan;
    /// let text = r#"
    /// schema = "trueness/plan/1"
    /// [[feature]]
    /// id = "A"
    /// shape = "plane"
    /// points = "a.xyz"
    /// [[characteristic]]
    /// id = "1"
    /// kind = "flatness"
    /// feature = "A"
    /// tolerance = 0.05
    /// "#;
    /// assert_eq!(Plan::parse(text)?.specs[0].kind.word(), "flatness");
    /// let error = Plan::parse(&text.replace("flatness", "flatnes")).unwrap_err();
    /// assert!(error.to_string().starts_with("line 9, column 8: there is no kind \"flatnes\"; did you mean \"flatness\"?"));
    /// # Ok::<(), trueness_document::plan::PlanError>(())
    /// ```
    pub fn parse(text: &str) -> Result<Plan, PlanError> {
        let written = PlanText::read(text)?;
        let unit = written.units.as_ref().map_or(1.0, |u| u.value.millimeters());
        let checker = Checker { text, unit };
        let points = written.feature.iter().filter_map(|f| f.value.points.as_ref());
        for path in written.measured.iter().chain(&written.reference).chain(points) {
            checker.path(path)?;
        }
        let features = feature::features(&checker, &written)?;
        let decision = decision::decision(&checker, &written)?;
        let specs = spec::specs(&checker, &written, &features, &decision)?;
        let deviation = deviation::deviation(&checker, &written, &features)?;
        if specs.is_empty()
            && deviation.as_ref().is_none_or(|d| d.tolerance.is_none() && d.regions.is_empty())
        {
            let what =
                "nothing in the plan can be judged; add a [[characteristic]] or a tolerance in [deviation]";
            return checker.wrong(&(0..0), what);
        }
        Ok(Plan {
            align: align::align(&checker, &written, &features)?,
            title: written.title,
            units: written.units.map(|u| u.value),
            measured: written.measured,
            reference: written.reference,
            deviation,
            features,
            specs,
            decision,
        })
    }

    /// Number of the feature with this id.
    pub fn feature(&self, id: &str) -> Option<usize> {
        self.features.iter().position(|f| f.id == id)
    }
}
