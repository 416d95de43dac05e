//! The inspection plan: features, characteristics, decision, from a text that people write.
//!
//! [`Plan::parse`] refuses whatever could not be evaluated, with line, column and the nearest known word, before any file
//! is read.

mod align;
mod at;
mod boundary;
mod checker;
mod datum;
mod decision;
mod deviation;
mod error;
mod feature;
mod limits;
mod limits_read;
mod material;
mod numbers;
mod proposal;
pub mod region;
mod spec;
mod synonyms;
pub mod text;
mod tolerance_region;

pub use crate::characteristic::kind::Spec;
pub use align::Align;
pub use at::At;
pub use boundary::Boundary;
pub use datum::DatumSpec;
pub use decision::{Decision, Noise, NoiseSource, Rule};
pub use deviation::Deviation;
pub use error::{PlanError, unknown};
pub use feature::{Class, Extract, Feature, Source};
pub use limits::{Basic, Limits, ZoneOffset};
pub use proposal::proposal;
pub use tolerance_region::{ToleranceRegion, regions_of_file};

use crate::characteristic;
use checker::Checker;
use text::{PlanText, UnitWord};

/// Name of the plan's schema.
pub const SCHEMA: &str = "trueness/plan/1";

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
    /// # Errors
    /// The first fault, with line and column: no TOML, an unknown key or word (with the nearest known one), a feature that
    /// does not exist, a kind that does not fit its feature, a missing datum, tolerance or key.
    ///
    /// ```
    /// use trueness_inspect::plan::Plan;
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
    /// # Ok::<(), trueness_inspect::plan::PlanError>(())
    /// ```
    pub fn parse(text: &str) -> Result<Plan, PlanError> {
        let written: PlanText = toml::from_str(text).map_err(|e| PlanError::of_reader(text, &e))?;
        let unit = written.units.as_ref().map_or(1.0, |u| u.value.millimeters());
        let checker = Checker { text, unit };
        if written.schema.value != SCHEMA {
            let what = format!("the schema is \"{}\"; this program reads \"{SCHEMA}\"", written.schema.value);
            return checker.wrong(&written.schema.span, what);
        }
        numbers::checked(&checker)?;
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

/// The JSON schema of plans: that of the text, with the words of all characteristics.
pub fn schema() -> schemars::Schema {
    let mut schema = schemars::schema_for!(PlanText);
    let words: Vec<&str> = characteristic::ALL.iter().map(|c| c.word()).collect();
    if let Some(kind) = schema.pointer_mut("/$defs/Kind").and_then(|kind| kind.as_object_mut()) {
        kind.insert("enum".into(), words.into());
    }
    schema
}
