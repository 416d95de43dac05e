//! What a section is asked.

use crate::task::{Independence, PointReading, ReferenceReading, TaskError, Text, ToleranceText, choices};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use trueness_measure::compare::MIN_COVERAGE;
use trueness_section as section;
use trueness_section::{Freedom, Options};

choices! {
    /// Continuity of all joins.
    pub enum Continuity {
        G0 = "g0": "Corners everywhere",
        G1 = "g1": "Common tangents everywhere",
        G2 = "g2": "Common tangents, and common curvatures at the ends of splines",
    }
}

choices! {
    /// What of a section may move for the best fit.
    pub enum Fit {
        Free = "free": "Shifts along both axes and a turn",
        Xy = "xy": "Shifts along both axes",
        X = "x": "A shift along the first axis",
        Y = "y": "A shift along the second axis",
        Turn = "turn": "A turn about the origin of the plane's axes",
        None = "none": "Nothing",
    }
}

choices! {
    /// How the join of one line and one curve is found.
    pub enum Search {
        Golden = "golden": "",
        Stepwise = "stepwise": "",
        Improved = "improved": "",
    }
}

choices! {
    /// Interval of a golden-section search.
    pub enum Interval {
        Profile = "profile": "",
        Paper = "paper": "",
    }
}

/// What a section is asked.
///
/// ```
/// use trueness::task::Request;
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::section::SectionRequest};
/// let request = SectionRequest {
///     input: "../../corpus/sections/rounded_rectangle.stl".into(),
///     plane: vec![[0.07229382650079952, -0.8569996931911372, 0.5102206664965356, 110.26353072993271]],
///     ..SectionRequest::default()
/// };
/// let done = request.run(&FileSources, &Silent)?;
/// assert!(done.document.contours.iter().any(|contour| contour.segments.len() == 8));
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SectionRequest {
    /// Points in order, of two or three columns, or with planes a mesh or a cloud.
    pub input: PathBuf,
    /// How they are taken.
    #[serde(flatten)]
    pub reading: PointReading,
    /// Planes that cut a mesh or cloud: each at right angles to nx, ny, nz, at the distance d from the origin.
    pub plane: Vec<[f64; 4]>,
    /// Stacks of parallel planes: normal, first and last distance from the origin, step.
    pub stack: Vec<[f64; 6]>,
    /// Thickness of the slab of a cloud whose points count as on the plane, mm.
    pub thickness: Option<f64>,
    /// Contours of a cloud go on over gaps up to this, mm; without it told from how uneven the points lie.
    pub gap: Option<f64>,
    /// Standard deviation of the points across the contour, mm; without it found from the data.
    pub noise: Option<f64>,
    /// Continuity of all joins; without it told from the data.
    pub continuity: Option<Continuity>,
    /// The contour is closed; if it is not said to be open either, the gap between its ends tells.
    pub closed: bool,
    /// The contour is open.
    pub open: bool,
    /// Confidence of the intervals, percent.
    pub level: f64,
    /// Measure each contour as an airfoil or blade: chords, camber line, greatest thickness, radii of its edges; with a nominal also twist
    /// and offset.
    pub airfoil: bool,
    /// Stacking point of the airfoils in the nominal's coordinates of the plane, mm; without it the centroid of the nominal's profile.
    pub stacking: Option<[f64; 2]>,
    /// Offer what a drawing would have, where the points allow it; the contour stays as it is found.
    pub tidy: bool,
    /// How far neighbors share errors.
    #[serde(flatten)]
    pub independence: Independence,
    /// Find one join, that of a line at an end of the row and one curve, by this method; all stand in the document.
    pub search: Option<Search>,
    /// Interval of the golden-section search: from the likelihood, or from the paper's 3 σ and correlation.
    pub interval: Interval,
    /// Compare the points with the section of this nominal: a mesh, a DXF drawing in the plane's coordinates, or points in order.
    pub nominal: Option<PathBuf>,
    /// How the nominal is taken.
    #[serde(flatten)]
    pub reference_reading: ReferenceReading,
    /// Bring the section nearest to the nominal first, within its plane, by least squares; without it it stays where it is.
    pub fit: Option<Fit>,
    /// Allowed deviation of the profile: ±T or -L,+U in mm.
    pub tolerance: Option<Text<ToleranceText>>,
    /// Share of the points that must lie within the tolerance, percent.
    pub inside: f64,
    /// Share of the nominal's length that must be measured for a pass, and of the points that must have a counterpart on it, percent.
    pub min_coverage: f64,
    /// Exclude (and count) points farther from the nominal than this, mm; the best fit does not look at them either.
    pub max_distance: Option<f64>,
    /// Where to write a DXF drawing, a layer for each plane.
    pub dxf: Option<PathBuf>,
    /// Where to write an SVG drawing, 1 to 1.
    pub svg: Option<PathBuf>,
    /// Where to write the curves in space as STEP (AP214).
    pub step: Option<PathBuf>,
    /// Where to write the curves in space as IGES (entities 100, 110, 126).
    pub iges: Option<PathBuf>,
    /// Where to write the points with contour, segment, length along the contour and distance, CSV.
    pub out: Option<PathBuf>,
    /// Seed of everything random.
    pub seed: u64,
    /// Keep what a report draws.
    pub view: bool,
}

/// Share of the points that must lie within the tolerance where nothing is said, percent.
const DEFAULT_INSIDE_PERCENT: f64 = 100.0;

impl Default for SectionRequest {
    fn default() -> SectionRequest {
        SectionRequest {
            input: PathBuf::new(),
            reading: PointReading::default(),
            plane: vec![],
            stack: vec![],
            thickness: None,
            gap: None,
            noise: None,
            continuity: None,
            closed: false,
            open: false,
            level: 95.0,
            airfoil: false,
            stacking: None,
            tidy: false,
            independence: Independence::default(),
            search: None,
            interval: Interval::Profile,
            nominal: None,
            reference_reading: ReferenceReading::default(),
            fit: None,
            tolerance: None,
            inside: DEFAULT_INSIDE_PERCENT,
            min_coverage: 100.0 * MIN_COVERAGE,
            max_distance: None,
            dxf: None,
            svg: None,
            step: None,
            iges: None,
            out: None,
            seed: 0,
            view: false,
        }
    }
}

/// Why a number is no level of confidence.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NoLevel {
    /// It is a share of 1.
    #[error("it is in percent: write {} for a share of {share}", 100.0 * .share)]
    ShareOfOne {
        /// As written.
        share: f64,
    },
    /// It is no percentage between 1 and 100.
    #[error("give a number of percent between 1 and 100, such as 95")]
    OutOfRange,
}

/// A level of confidence as it is written: a share of 1 written by mistake is refused, since it would make all intervals tiny.
///
/// # Errors
/// [`NoLevel`]: a share of 1, or nothing between 1 and 100.
pub fn level(percent: f64) -> Result<f64, NoLevel> {
    if percent > 1.0 && percent < 100.0 {
        return Ok(percent);
    }
    Err(match percent > 0.0 && percent <= 1.0 {
        true => NoLevel::ShareOfOne { share: percent },
        false => NoLevel::OutOfRange,
    })
}

impl SectionRequest {
    /// Refuses values that do not go together.
    pub(super) fn check(&self) -> Result<(), TaskError> {
        level(self.level).map_err(|what| TaskError::usage(format!("--level {}: {what}", self.level)))?;
        if self.closed && self.open {
            return Err(TaskError::usage("--closed and --open exclude each other; leave one of them out"));
        }
        let (nominal, tolerance) = (self.nominal.is_some(), self.tolerance.is_some());
        let of = SectionRequest::default();
        for (option, given, of, there) in [
            ("stacking", self.stacking.is_some(), "airfoil", self.airfoil),
            ("fit", self.fit.is_some(), "nominal", nominal),
            ("tolerance", tolerance, "nominal", nominal),
            ("inside", self.inside != of.inside, "tolerance", tolerance),
            ("min-coverage", self.min_coverage != of.min_coverage, "tolerance", tolerance),
            ("max-distance", self.max_distance.is_some(), "nominal", nominal),
        ] {
            if given && !there {
                return Err(TaskError::usage(format!("--{option} needs --{of}; give both or none")));
            }
        }
        match self.stacking {
            Some([x, y]) if !x.is_finite() || !y.is_finite() => {
                Err(TaskError::usage(format!("--stacking {x},{y}: give two finite numbers of mm")))
            }
            _ => Ok(()),
        }
    }

    /// How contours are found.
    pub(super) fn options(&self) -> Options {
        Options {
            noise: self.noise,
            continuity: self.continuity.map(|c| match c {
                Continuity::G0 => section::Continuity::G0,
                Continuity::G1 => section::Continuity::G1,
                Continuity::G2 => section::Continuity::G2,
            }),
            closed: (self.closed || self.open).then_some(self.closed),
            level: self.level / 100.0,
            ..Options::default()
        }
    }

    /// The paper's method that was asked for, if any.
    pub(super) fn method(&self) -> Option<section::Search> {
        match (self.search, self.interval) {
            (None, Interval::Profile) => None,
            (None, Interval::Paper) | (Some(Search::Golden), _) => Some(section::Search::Golden),
            (Some(Search::Stepwise), _) => Some(section::Search::Stepwise),
            (Some(Search::Improved), _) => Some(section::Search::Improved),
        }
    }

    /// What may move for the best fit, if anything, with its name.
    pub(super) fn freedom(&self) -> Option<(&'static str, Freedom)> {
        match self.fit? {
            Fit::Free => Some(("free", Freedom::FREE)),
            Fit::Xy => Some(("xy", Freedom::SHIFT)),
            Fit::X => Some(("x", Freedom::X)),
            Fit::Y => Some(("y", Freedom::Y)),
            Fit::Turn => Some(("turn", Freedom::TURN)),
            Fit::None => None,
        }
    }
}
