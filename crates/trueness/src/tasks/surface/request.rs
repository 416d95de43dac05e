//! What is asked of a surface.

use crate::task::{PointReading, TaskError, Text, above_zero, choices};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::str::FromStr;
use trueness_surface::{BaseKind, Fairness};

choices! {
    /// What the parameters are taken from.
    pub enum Base {
        Plane = "plane": "The least-squares plane and the minimum bounding rectangle in it",
        Xy = "xy": "x and y themselves",
        Cylinder = "cylinder": "The least-squares cylinder",
        Sphere = "sphere": "The least-squares sphere",
        Mesh = "mesh": "The facets of the mesh, laid flat: for parts that fold over any plane",
    }
}

impl From<Base> for BaseKind {
    fn from(base: Base) -> BaseKind {
        match base {
            Base::Plane => BaseKind::Plane,
            Base::Xy => BaseKind::Xy,
            Base::Cylinder => BaseKind::Cylinder,
            Base::Sphere => BaseKind::Sphere,
            Base::Mesh => BaseKind::Mesh,
        }
    }
}

/// A whole number for each of `u` and `v`: `8x6`, or `8` for both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pair(pub [usize; 2]);

/// A text that is no pair of whole numbers.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{text:?} is no whole number; write 8x8")]
pub struct NoPair {
    text: String,
}

impl FromStr for Pair {
    type Err = NoPair;

    fn from_str(text: &str) -> Result<Pair, NoPair> {
        let number = |s: &str| s.parse::<usize>().map_err(|_| NoPair { text: s.into() });
        match text.split_once(['x', 'X', '×']) {
            Some((a, b)) => Ok(Pair([number(a)?, number(b)?])),
            None => number(text).map(|n| Pair([n, n])),
        }
    }
}

/// The weight of the thin-plate term: `auto`, or a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight(pub Fairness);

/// A text that is no weight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("it is auto, or a number from 0 upwards")]
pub struct NoWeight;

impl FromStr for Weight {
    type Err = NoWeight;

    fn from_str(text: &str) -> Result<Weight, NoWeight> {
        match (text, text.parse::<f64>()) {
            ("auto", _) => Ok(Weight(Fairness::Auto)),
            (_, Ok(w)) if w >= 0.0 && w.is_finite() => Ok(Weight(Fairness::Weight(w))),
            _ => Err(NoWeight),
        }
    }
}

/// Half the width of the gaps that do not count in an outline, mm; without it, as of `auto`, by the distance of neighbors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap(pub Option<f64>);

/// A text that is no width of a gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("it is auto, or a length above 0")]
pub struct NoGap;

impl FromStr for Gap {
    type Err = NoGap;

    fn from_str(text: &str) -> Result<Gap, NoGap> {
        match (text, text.parse::<f64>()) {
            ("auto", _) => Ok(Gap(None)),
            (_, Ok(reach)) if reach > 0.0 && reach.is_finite() => Ok(Gap(Some(reach))),
            _ => Err(NoGap),
        }
    }
}

/// Most corrections of the parameters.
pub const MAX_CORRECTIONS: u8 = 50;

/// What is asked of a surface.
///
/// ```
/// use trueness::task::{Outcome, Request};
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::surface::SurfaceRequest};
/// let request = SurfaceRequest {
///     points: "../../corpus/bunny/zipper_res4.ply".into(),
///     spans: Some("4x4".parse()?),
///     ..SurfaceRequest::default()
/// };
/// let done = request.run(&FileSources, &Silent)?;
/// assert_eq!(done.document.control_points.len(), 7);
/// // No plane is a base of a whole bunny.
/// assert_eq!(done.outcome, Outcome::NotConforming);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SurfaceRequest {
    /// The points, or a mesh, whose vertices are taken.
    pub points: PathBuf,
    /// Degrees along u and v, `3x3`; without it 3x3, or those that the knots tell.
    pub degree: Option<Text<Pair>>,
    /// Equal spans along u and v, `8x8`; without it 8x8; on a cylinder or sphere one for each 15°, where that is more.
    pub spans: Option<Text<Pair>>,
    /// Whole clamped knots: a JSON file `{"u": […], "v": […]}`.
    pub knots: Option<PathBuf>,
    /// Set knots until all points are within this distance, mm, or until noise is all that is left.
    pub tolerance: Option<f64>,
    /// What the parameters are taken from.
    pub base: Base,
    /// Weight of the thin-plate term, mm²: `auto`, or a number (0 for none); without it `auto`.
    pub fairness: Option<Text<Weight>>,
    /// Corrections of the parameters to the nearest places at most, 50 or fewer; with the base `xy` there are none.
    pub corrections: u8,
    /// Leave out points that contradict their neighbors; they are counted.
    pub robust: bool,
    /// Cut the surface along the outline of the points; gaps up to twice this length (mm) do not count; `auto`: three times the distance of
    /// neighbors.
    pub trim: Option<Text<Gap>>,
    /// How the points are taken.
    #[serde(flatten)]
    pub reading: PointReading,
    /// Where to write the surface as STEP (AP214).
    pub step: Option<PathBuf>,
    /// Where to write the surface as IGES (entity 128; with `trim` 144).
    pub iges: Option<PathBuf>,
    /// Where to write facets of the surface (.obj).
    pub obj: Option<PathBuf>,
    /// Distance that the facets keep from the surface, mm; without it a ten thousandth of its size.
    pub chord: Option<f64>,
    /// Keep what a report draws.
    pub view: bool,
}

impl Default for SurfaceRequest {
    fn default() -> SurfaceRequest {
        SurfaceRequest {
            points: PathBuf::new(),
            degree: None,
            spans: None,
            knots: None,
            tolerance: None,
            base: Base::Plane,
            fairness: None,
            corrections: 5,
            robust: false,
            trim: None,
            reading: PointReading::default(),
            step: None,
            iges: None,
            obj: None,
            chord: None,
            view: false,
        }
    }
}

impl SurfaceRequest {
    /// Refuses values that cannot be meant, or do not go together.
    pub(super) fn check(&self) -> Result<(), TaskError> {
        self.chord.map(|chord| above_zero("chord", chord)).transpose()?;
        if self.chord.is_some() && self.obj.is_none() {
            return Err(TaskError::usage("--chord is for the facets of --obj; give one"));
        }
        let layouts = [
            ("--spans", self.spans.is_some()),
            ("--knots", self.knots.is_some()),
            ("--tolerance", self.tolerance.is_some()),
        ];
        let given: Vec<&str> =
            layouts.into_iter().filter(|(_, given)| *given).map(|(name, _)| name).collect();
        if given.len() > 1 {
            let given = given.join(" and ");
            return Err(TaskError::usage(format!("{given} each say where knots are; give one of them")));
        }
        if self.corrections > MAX_CORRECTIONS {
            let asked = self.corrections;
            return Err(TaskError::usage(format!(
                "--corrections {asked}: give a number from 0 to {MAX_CORRECTIONS}"
            )));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::Choice;

    #[test]
    fn texts_mean_what_they_say() {
        assert_eq!(("12x8".parse(), "4".parse()), (Ok(Pair([12, 8])), Ok(Pair([4, 4]))));
        assert_eq!("auto".parse(), Ok(Weight(Fairness::Auto)));
        assert_eq!("0".parse(), Ok(Weight(Fairness::Weight(0.0))));
        assert_eq!(("auto".parse(), "2.5".parse()), (Ok(Gap(None)), Ok(Gap(Some(2.5)))));
        for text in ["", "8y8", "8x", "-1", "1.5x2"] {
            assert!(text.parse::<Pair>().is_err(), "{text}");
        }
        for text in ["-1", "nan", "inf", "Auto"] {
            assert!(text.parse::<Weight>().is_err() && text.parse::<Gap>().is_err(), "{text}");
        }
        assert!("0".parse::<Gap>().is_err());
    }

    #[test]
    fn bases_are_called_alike() {
        for (base, word, _) in Base::ALL {
            assert_eq!(BaseKind::from(*base).name(), *word);
        }
        assert_eq!(Base::ALL.len(), BaseKind::ALL.len());
    }

    /// What the parser of a command line refuses is refused without it, too.
    #[test]
    fn what_does_not_go_together_is_refused() {
        let refused = |request: SurfaceRequest| request.check().unwrap_err().to_string();
        let default = SurfaceRequest::default;
        let two = SurfaceRequest { tolerance: Some(0.1), spans: "8".parse().ok(), ..default() };
        assert!(refused(two).starts_with("--spans and --tolerance"));
        assert!(refused(SurfaceRequest { chord: Some(0.1), ..default() }).contains("--obj"));
        let obj = Some(PathBuf::from("a.obj"));
        assert!(refused(SurfaceRequest { chord: Some(0.0), obj, ..default() }).contains("above 0"));
        assert!(refused(SurfaceRequest { chord: Some(-1.0), ..default() }).contains("--chord -1"));
        assert!(refused(SurfaceRequest { corrections: 51, ..default() }).contains("to 50"));
        assert!(default().check().is_ok());
    }
}
