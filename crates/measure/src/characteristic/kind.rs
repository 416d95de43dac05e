//! What a kind of characteristic is, and what a plan asks of one.
//!
//! A kind is asked about what the plan says, and what the plan says names the kind: both stand here.

use super::measured_feature::MeasuredFeature;
use super::value::{Missing, Value};
use crate::requirement::{Basic, Boundary, DatumSpec, Feature, Limits, Source, ZoneOffset};
use std::fmt::Debug;
use std::ops::Range;
use trueness_document::plan::{Class, MaterialWord, SizeWord, TextureWord};
use trueness_document::tolerance_class::Table;
use trueness_geom::fit::Method;
use trueness_geom::progress::Progress;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Vector;
use trueness_geom::zone::datum;

/// One kind of characteristic.
pub trait Characteristic: Sync + Debug {
    /// Its word in plans: `flatness`.
    fn word(&self) -> &'static str;
    /// Its sign on drawings, where it has one.
    fn symbol(&self) -> &'static str {
        ""
    }
    /// The standard and clause that define it.
    fn standard(&self) -> &'static str;
    /// The keys it takes beyond `id`, `kind`, `feature` and `uncertainty`.
    fn keys(&self) -> &'static [&'static str];
    /// The table of tolerance classes that its limits may be taken from.
    fn class_table(&self) -> Option<Table> {
        None
    }
    /// Whether its datums may have a material requirement.
    fn material_datums(&self) -> bool {
        false
    }
    /// How its limits are given.
    fn allowed(&self) -> Allowed {
        Allowed::Greatest
    }
    /// The unit of its values: `mm`, `deg` or `1`. Limits that are lengths are in the plan's unit.
    fn unit(&self, parameter: TextureWord) -> &'static str {
        let _ = parameter;
        "mm"
    }
    /// Whether its zone is a cylinder or a sphere (the sign ∅ on drawings); `planar`: the feature's points have two coordinates.
    fn diametral(&self, question: &Question, planar: bool) -> bool {
        let _ = (question, planar);
        false
    }
    /// The theoretically exact dimensions of the feature that is asked about, where a plan gives such by `basic`; the features are those of
    /// the model, and so are they then.
    ///
    /// # Errors
    /// Why there are none.
    fn exact(&self, model: &Measuring) -> Option<Result<Basic, Missing>> {
        let _ = model;
        None
    }
    /// Refuses what could not be evaluated whatever the measured data are.
    ///
    /// # Errors
    /// The key that is wrong, and why.
    fn check(&self, question: &Question) -> Result<(), Refusal>;
    /// The value.
    ///
    /// # Errors
    /// Why there is none.
    fn measure(&self, m: &Measuring) -> Result<Value, Missing>;
}

/// A characteristic that can be evaluated. Lengths in millimeters, angles in radians.
#[derive(Clone, Debug)]
pub struct Spec {
    /// Its name.
    pub id: String,
    /// Where the name stands.
    pub span: Range<usize>,
    /// What it is.
    pub kind: &'static dyn Characteristic,
    /// Numbers of the features: one, or two of a size.
    pub features: Vec<usize>,
    /// The datums, the first one first.
    pub datums: Vec<DatumSpec>,
    /// How datums are associated.
    pub datum_rule: datum::Rule,
    /// The datum system as given: frame from measured.
    pub frame: Option<Rigid>,
    /// Theoretically exact dimensions.
    pub basic: Basic,
    /// Where they stand in the plan; without, those of the model hold.
    pub basic_span: Option<Range<usize>>,
    /// Whether the zone is a cylinder or sphere, where the plan says so.
    pub diametral: Option<bool>,
    /// Where the zone of a profile lies.
    pub offset: ZoneOffset,
    /// Unit normal of the planes that the lines of a line profile lie in.
    pub intersection: Option<Vector>,
    /// How a form is evaluated.
    pub form: Method,
    /// Which size.
    pub size: Option<SizeWord>,
    /// What is allowed.
    pub limits: Limits,
    /// Where the tolerance or the nominal value stands in the plan.
    pub limits_span: Range<usize>,
    /// The tolerance class that it comes from.
    pub class: Option<String>,
    /// Where that stands in the plan.
    pub class_span: Range<usize>,
    /// Whether a run-out is read along the datum axis.
    pub axial: bool,
    /// Which parameter of a texture.
    pub parameter: TextureWord,
    /// Its material requirement.
    pub material: Option<MaterialWord>,
    /// The boundary that the requirement sets.
    pub boundary: Option<Boundary>,
    /// Expanded uncertainty of the value, as the plan gives it for this characteristic or for all.
    pub uncertainty: Option<f64>,
}

impl Spec {
    /// The unit of its value.
    pub fn unit(&self) -> &'static str {
        self.kind.unit(self.parameter)
    }

    /// Numbers of the features that the value depends on: its own, those of its datums, and those that they are derived from;
    /// ascending.
    pub fn numbers(&self, features: &[Feature]) -> Vec<usize> {
        let datums = self.datums.iter().flat_map(|d| &d.features);
        let mut all: Vec<usize> = self.features.iter().chain(datums).copied().collect();
        let mut next = 0;
        while let Some(n) = all.get(next).copied() {
            if let Source::Derived { of, .. } = &features[n].source {
                all.extend(of);
            }
            next += 1;
        }
        all.sort_unstable();
        all.dedup();
        all
    }
}

/// How limits are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Allowed {
    /// `tolerance`: the greatest value.
    Greatest,
    /// `nominal`, `upper`, `lower`.
    Between,
}

/// A characteristic of a plan under examination.
#[derive(Clone, Copy)]
pub struct Question<'a> {
    /// The characteristic.
    pub spec: &'a Spec,
    /// All features of the plan.
    pub features: &'a [Feature],
}

/// Why a plan cannot be evaluated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The key that is wrong; `kind` for a missing one.
    pub key: &'static str,
    /// Why.
    pub what: String,
}

pub(super) fn refuse<T>(key: &'static str, what: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal { key, what: what.into() })
}

/// What there is for a feature in place of a kind that is not defined for it.
fn instead(word: &str, class: Class) -> &'static str {
    match (word, class) {
        ("roundness" | "flatness" | "straightness", Class::Cylinder) => {
            "; of a cylinder there is cylindricity"
        }
        ("circular-runout", Class::Cylinder) => {
            "; of a cylinder there is total-runout; a circle is one section, by `points` of its own"
        }
        ("circular-runout", Class::Plane) => "; of a plane there is total-runout",
        ("cylindricity", Class::Circle) => "; of a circle there is roundness",
        ("cylindricity" | "roundness", Class::Plane) => "; of a plane there is flatness",
        ("total-runout", Class::Circle) => "; of a circle there is circular-runout",
        ("size", Class::Plane) => "; of planes it is the size of two: feature = [\"A\", \"B\"]",
        ("coaxiality", Class::Plane) => "; of a plane there is symmetry or position",
        ("symmetry", Class::Cone) => "; of a cone there is coaxiality",
        _ => "",
    }
}

impl<'a> Question<'a> {
    /// The toleranced feature; several features are refused.
    pub(super) fn feature(&self) -> Result<&'a Feature, Refusal> {
        match self.spec.features.as_slice() {
            [one] => Ok(&self.features[*one]),
            _ => refuse("feature", "it is of one feature"),
        }
    }

    /// Class of the toleranced feature, one of these.
    pub(super) fn class(&self, known: &[Class]) -> Result<Class, Refusal> {
        let class = self.feature()?.class;
        if known.contains(&class) {
            return Ok(class);
        }
        let words: Vec<&str> = known.iter().map(|c| c.word()).collect();
        let (id, is) = (&self.feature()?.id, class.word());
        let instead = instead(self.spec.kind.word(), class);
        refuse(
            "feature",
            format!("feature \"{id}\" is a {is}; it is defined for: {}{instead}", words.join(", ")),
        )
    }

    /// Classes of the datums; of a common datum, that of its features.
    pub(super) fn datums(&self) -> Vec<Class> {
        self.spec.datums.iter().filter_map(|d| Some(self.features[*d.features.first()?].class)).collect()
    }

    /// The class of the first of one or several datums, which are all of these.
    pub(super) fn system(&self, known: &[Class]) -> Result<Class, Refusal> {
        let datums = self.datums();
        let words = || known.iter().map(|c| c.word()).collect::<Vec<_>>().join(", ");
        if let Some(other) = datums.iter().find(|d| !known.contains(d)) {
            let what = format!("the datum is a {}; it must be one of: {}", other.word(), words());
            return refuse("datums", what);
        }
        match datums.first() {
            None => refuse("kind", "it needs a datum: give `datums`"),
            Some(first) => Ok(*first),
        }
    }

    /// Whether the model says where the toleranced feature and all datums are.
    pub(super) fn is_of_model(&self) -> bool {
        let written = |n: &usize| {
            matches!(self.features[*n].source, Source::Derived { .. }) || self.features[*n].has_nominal()
        };
        self.spec.numbers(self.features).iter().all(written)
    }

    /// The only datum, one of these.
    pub(super) fn datum(&self, known: &[Class]) -> Result<Class, Refusal> {
        if self.spec.datums.len() > 1 {
            return refuse("datums", "it is evaluated for a single datum only");
        }
        self.system(known)
    }
}

/// Shapes that have an axis.
pub(super) const WITH_AXIS: [Class; 3] = [Class::Line, Class::Cylinder, Class::Cone];
/// Shapes that have a direction.
pub(super) const WITH_DIRECTION: [Class; 4] = [Class::Plane, Class::Line, Class::Cylinder, Class::Cone];

pub(super) fn is_axis(class: Class) -> bool {
    WITH_AXIS.contains(&class)
}

/// A characteristic with the features that it needs, taken from the measured data.
pub struct Measuring<'a> {
    /// The characteristic.
    pub spec: &'a Spec,
    /// The toleranced features.
    pub features: &'a [&'a MeasuredFeature],
    /// The features of each datum, in their order.
    pub datums: &'a [Vec<&'a MeasuredFeature>],
    /// Hears nothing of progress, but asked whether to stop.
    pub progress: &'a dyn Progress,
}

impl Measuring<'_> {
    pub(super) fn feature(&self) -> &MeasuredFeature {
        self.features[0]
    }
}
