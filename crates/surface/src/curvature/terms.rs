//! Options, and reasons why there may be no answer.

use trueness_geom::noise::Noise;
use trueness_geom::progress::Cancelled;
use trueness_geom::topology::TopologyError;
use trueness_geom::topology::weld::WeldError;

/// Degrees of the jets that can be fitted.
pub const DEGREES: std::ops::RangeInclusive<usize> = 2..=6;
/// Neighbors for each unknown, where their number is not given.
const NEIGHBORS_PER_UNKNOWN: usize = 3;
/// Most neighbors that can be asked for.
pub const MAX_NEIGHBORS: usize = 10_000;

/// How curvatures are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Degree of the jets, from [`DEGREES`].
    pub degree: usize,
    /// The points that are taken into a neighborhood.
    pub reach: Reach,
    /// Whether places on a boundary have values, from the one side that there is.
    pub boundary: bool,
    /// How far neighbors share noise, for uncertainties; without it all errors are independent.
    pub noise: Option<Noise>,
}

impl Default for Options {
    fn default() -> Options {
        Options { degree: 3, reach: Reach::Auto, boundary: false, noise: None }
    }
}

/// The points that are taken into a neighborhood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// At least three neighbors for each unknown of the jet: 18 of degree 2, 30 of degree 3.
    Auto,
    /// At least so many neighbors: on a mesh whole rings of them, in a cloud the nearest ones.
    Count(usize),
    /// All neighbors within this distance, millimeters: curvature at a scale of one's own.
    Radius(f64),
}

impl Reach {
    /// Fewest neighbors that are looked for with jets of this degree; `None` where a radius tells.
    pub fn neighbors(self, degree: usize) -> Option<usize> {
        match self {
            Reach::Auto => Some(NEIGHBORS_PER_UNKNOWN * unknowns(degree)),
            Reach::Count(count) => Some(count),
            Reach::Radius(_) => None,
        }
    }
}

/// Why a place has no curvature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NoCurvature {
    /// A coordinate is infinite or not a number.
    NotFinite,
    /// No facet uses the vertex.
    Unused,
    /// Facets meet there, or around it, in a way that is no surface. More than two meet at an edge, fans touch, or the
    /// orientations of facets disagree.
    NotASurface,
    /// The surface ends there: it has neighbors on one side only.
    Boundary,
    /// There are fewer neighbors than unknowns.
    FewNeighbors,
    /// The neighbors do not determine the jet: they lie on one line or curve, or at one place.
    Undetermined,
    /// The neighborhood folds over: it is no height over any plane.
    Folded,
}

impl NoCurvature {
    /// All of them.
    pub const ALL: [NoCurvature; 7] = [
        NoCurvature::NotFinite,
        NoCurvature::Unused,
        NoCurvature::NotASurface,
        NoCurvature::Boundary,
        NoCurvature::FewNeighbors,
        NoCurvature::Undetermined,
        NoCurvature::Folded,
    ];

    /// Its name: `not_finite`, `unused`, …
    pub fn name(self) -> &'static str {
        match self {
            NoCurvature::NotFinite => "not_finite",
            NoCurvature::Unused => "unused",
            NoCurvature::NotASurface => "not_a_surface",
            NoCurvature::Boundary => "boundary",
            NoCurvature::FewNeighbors => "few_neighbors",
            NoCurvature::Undetermined => "undetermined",
            NoCurvature::Folded => "folded",
        }
    }
}

/// Why there are no curvatures.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CurvatureError {
    /// The degree is not offered.
    #[error("degree {0}: it must be from {first} to {last}", first = DEGREES.start(), last = DEGREES.end())]
    Degree(usize),
    /// Too few neighbors for the degree, or too many.
    #[error("neighbors {asked}: a jet of degree {degree} needs from {needed} to {MAX_NEIGHBORS}")]
    Neighbors {
        /// Asked for.
        asked: usize,
        /// The degree.
        degree: usize,
        /// Unknowns of the jet.
        needed: usize,
    },
    /// The radius is no length.
    #[error("radius {0}: it must be a length above 0")]
    Radius(f64),
    /// More points than can be numbered.
    #[error("{0} points are more than can be numbered with 32 bits")]
    TooMany(usize),
    /// A facet names a vertex that does not exist, or there are too many.
    #[error(transparent)]
    Mesh(#[from] WeldError),
    /// Stopped through the progress argument.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<TopologyError> for CurvatureError {
    fn from(e: TopologyError) -> CurvatureError {
        match e {
            TopologyError::Weld(e) => e.into(),
            TopologyError::Cancelled(e) => e.into(),
        }
    }
}

/// Coefficients of a jet of this degree.
pub fn unknowns(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

/// Options with the numbers that follow from them.
pub(super) struct Terms {
    pub degree: usize,
    pub unknowns: usize,
    pub reach: ResolvedReach,
    pub boundary: bool,
    pub noise: Option<Noise>,
}

/// [`Reach`] worked out.
#[derive(Clone, Copy)]
pub(super) enum ResolvedReach {
    Count(usize),
    Radius(f64),
}

impl Terms {
    pub(super) fn of(options: &Options) -> Result<Terms, CurvatureError> {
        let degree = options.degree;
        if !DEGREES.contains(&degree) {
            return Err(CurvatureError::Degree(degree));
        }
        let unknowns = unknowns(degree);
        let reach = match (options.reach, options.reach.neighbors(degree)) {
            (_, Some(count)) if (unknowns..=MAX_NEIGHBORS).contains(&count) => ResolvedReach::Count(count),
            (_, Some(asked)) => return Err(CurvatureError::Neighbors { asked, degree, needed: unknowns }),
            (Reach::Radius(r), _) if r > 0.0 && r.is_finite() => ResolvedReach::Radius(r),
            (Reach::Radius(r), _) => return Err(CurvatureError::Radius(r)),
            (Reach::Auto | Reach::Count(_), None) => return Err(CurvatureError::Degree(degree)),
        };
        Ok(Terms { degree, unknowns, reach, boundary: options.boundary, noise: options.noise })
    }
}
