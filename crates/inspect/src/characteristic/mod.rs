//! The characteristics that an inspection evaluates: one file each, one line in [`ALL`].
//!
//! Each evaluates its value as its standard defines it and says where the value is reached; what is allowed and what
//! follows from it is not its business.

mod angle;
mod angularity;
mod circular_runout;
mod coaxiality;
mod cylindricity;
mod distance;
mod flatness;
mod located;
mod material;
mod orientation;
mod parallelism;
mod perpendicularity;
mod position;
mod roundness;
mod size;
mod straightness;
mod surface_profile;
mod symmetry;
mod texture;
mod total_runout;

pub(crate) use located::datum_source;

use crate::inspection::Taken;
use crate::plan::text::TextureWord;
use crate::plan::{Class, Feature, Spec};
use crate::tolerance_class::Table;
use std::fmt::Debug;
use trueness_geom::fit::FitError;
use trueness_geom::progress::Progress;
use trueness_geom::space::Point;
use trueness_geom::zone::ZoneError;
use trueness_geom::zone::datum::DatumError;

/// All of them, in the order of ISO 1101, then dimensions, then texture.
pub static ALL: [&dyn Characteristic; 17] = [
    &straightness::Straightness,
    &flatness::Flatness,
    &roundness::Roundness,
    &cylindricity::Cylindricity,
    &surface_profile::SurfaceProfile,
    &parallelism::Parallelism,
    &perpendicularity::Perpendicularity,
    &angularity::Angularity,
    &position::Position,
    &coaxiality::Coaxiality,
    &symmetry::Symmetry,
    &circular_runout::CircularRunout,
    &total_runout::TotalRunout,
    &size::Size,
    &distance::Distance,
    &angle::Angle,
    &texture::Texture,
];

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

fn refuse<T>(key: &'static str, what: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal { key, what: what.into() })
}

impl<'a> Question<'a> {
    /// The toleranced feature; several features are refused.
    fn feature(&self) -> Result<&'a Feature, Refusal> {
        match self.spec.features.as_slice() {
            [one] => Ok(&self.features[*one]),
            _ => refuse("feature", "it is of one feature"),
        }
    }

    /// Class of the toleranced feature, one of these.
    fn class(&self, known: &[Class]) -> Result<Class, Refusal> {
        let class = self.feature()?.class;
        if known.contains(&class) {
            return Ok(class);
        }
        let words: Vec<&str> = known.iter().map(|c| c.word()).collect();
        let (id, is) = (&self.feature()?.id, class.word());
        refuse("feature", format!("feature \"{id}\" is a {is}; it is defined for: {}", words.join(", ")))
    }

    /// Classes of the datums; of a common datum, that of its features.
    fn datums(&self) -> Vec<Class> {
        self.spec.datums.iter().filter_map(|d| Some(self.features[*d.features.first()?].class)).collect()
    }

    /// The class of the first of one or several datums, which are all of these.
    fn system(&self, known: &[Class]) -> Result<Class, Refusal> {
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

    /// The only datum, one of these.
    fn datum(&self, known: &[Class]) -> Result<Class, Refusal> {
        if self.spec.datums.len() > 1 {
            return refuse("datums", "it is evaluated for a single datum only");
        }
        self.system(known)
    }
}

/// Shapes that have an axis.
const AXES: [Class; 3] = [Class::Line, Class::Cylinder, Class::Cone];

fn is_axis(class: Class) -> bool {
    AXES.contains(&class)
}

/// A characteristic with the features that it needs, taken from the measured data.
pub struct Measuring<'a> {
    /// The characteristic.
    pub spec: &'a Spec,
    /// The toleranced features.
    pub features: &'a [&'a Taken],
    /// The features of each datum, in their order.
    pub datums: &'a [Vec<&'a Taken>],
    /// Hears nothing of progress, but asked whether to stop.
    pub progress: &'a dyn Progress,
}

impl Measuring<'_> {
    fn feature(&self) -> &Taken {
        self.features[0]
    }
}

/// What was measured. Lengths in millimetres, angles in degrees.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Value {
    /// The value.
    pub value: f64,
    /// What a material requirement adds to the greatest allowed value; below 0 where the size is beyond its limit.
    pub bonus: f64,
    /// Whether the zone is a cylinder or sphere.
    pub diametral: bool,
    /// Places where the value is reached.
    pub witness: Vec<Point>,
    /// Further numbers, by name.
    pub parts: Vec<(&'static str, f64)>,
    /// What the reader should know.
    pub notes: Vec<String>,
}

/// Why there is no value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Missing {
    /// The result is no longer wanted.
    Cancelled,
    /// The data do not allow it.
    NotMeasured(String),
    /// The plan asks for what cannot be, as the data show.
    Impossible(String),
}

impl From<FitError> for Missing {
    fn from(e: FitError) -> Missing {
        match e {
            FitError::Cancelled => Missing::Cancelled,
            e => Missing::NotMeasured(e.to_string()),
        }
    }
}

impl From<ZoneError> for Missing {
    fn from(e: ZoneError) -> Missing {
        match e {
            ZoneError::Cancelled => Missing::Cancelled,
            e => Missing::NotMeasured(e.to_string()),
        }
    }
}

impl From<DatumError> for Missing {
    fn from(e: DatumError) -> Missing {
        match e {
            DatumError::Fit { error: FitError::Cancelled, .. } => Missing::Cancelled,
            DatumError::Zone { error: ZoneError::Cancelled, .. } => Missing::Cancelled,
            DatumError::Fit { .. } | DatumError::Zone { .. } => Missing::NotMeasured(e.to_string()),
            e => Missing::Impossible(e.to_string()),
        }
    }
}

/// The greatest of some numbers and the first place that has it.
fn greatest(numbers: impl Iterator<Item = f64>) -> Result<(usize, f64), Missing> {
    let found = numbers.enumerate().fold(None, |most: Option<(usize, f64)>, (i, x)| match most {
        Some((_, y)) if x <= y => most,
        _ => Some((i, x)),
    });
    let found = found.filter(|(_, x)| x.is_finite());
    found.ok_or_else(|| Missing::NotMeasured("it has no points with finite coordinates".into()))
}
