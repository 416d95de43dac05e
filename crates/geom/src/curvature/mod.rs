//! Curvatures of meshes and clouds, place by place, from jets fitted to the neighbourhood.
//!
//! F. Cazals, M. Pouget, Estimating differential quantities using polynomial fitting of osculating jets, Computer Aided
//! Geometric Design 22 (2005) 121–146. In a frame whose third axis is about the normal, the surface near a place is a height
//! `z(x, y)`; a polynomial of degree `d` (a jet) is fitted to the neighbours by least squares, and its first and second
//! derivatives are normal and curvatures. Curvatures of a smooth surface come out to the order `d − 1` in the size of the
//! neighbourhood. What differs from the paper: the frame is turned to the fitted normal where that leans, the standard
//! uncertainty is told, and places where the neighbourhood is no surface on all sides have no value but a reason.
//!
//! A curvature is positive where the surface bends towards its normal, as in [`crate::spline::surface::Bend`]: on a convex body
//! with outward normals both principal curvatures are negative.
//!
//! | file | what |
//! |---|---|
//! | `jet` | one neighbourhood |
//! | `rings` | neighbours on a mesh, through edges |
//! | `near` | neighbours in a cloud, by distance |
//! | `sides` | normals of a cloud to one side |

mod jet;
mod near;
mod rings;
mod sides;
#[cfg(test)]
mod tests;

pub use jet::{Jet, unknowns};

use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress};
use crate::space::Point;
use crate::topology::TopologyError;
use crate::topology::weld::WeldError;
use jet::Fitter;
use rayon::prelude::*;

/// Degrees of the jets that can be fitted.
pub const DEGREES: std::ops::RangeInclusive<usize> = 2..=6;
/// Neighbours for each unknown, where their number is not given.
const PER_UNKNOWN: usize = 3;
/// Most neighbours that can be asked for.
pub const MOST_NEIGHBORS: usize = 10_000;
/// Places answered between two questions whether to go on.
const TASK: usize = 64;
/// Pieces that the places are divided into, whatever the number of threads.
const RUNS: usize = 64;

/// How curvatures are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Degree of the jets, from [`DEGREES`].
    pub degree: usize,
    /// What is taken into a neighbourhood.
    pub reach: Reach,
    /// Whether places on a boundary have values, from the one side that there is.
    pub boundary: bool,
}

impl Default for Options {
    fn default() -> Options {
        Options { degree: 3, reach: Reach::Auto, boundary: false }
    }
}

/// What is taken into a neighbourhood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// At least three neighbours for each unknown of the jet: 18 of degree 2, 30 of degree 3.
    Auto,
    /// At least so many neighbours: on a mesh whole rings of them, in a cloud the nearest ones.
    Count(usize),
    /// All neighbours within this distance, millimetres: curvature at a scale of one's own.
    Radius(f64),
}

impl Reach {
    /// Fewest neighbours that are looked for with jets of this degree; `None` where a radius tells.
    pub fn neighbors(self, degree: usize) -> Option<usize> {
        match self {
            Reach::Auto => Some(PER_UNKNOWN * unknowns(degree)),
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
    /// Facets meet there, or around it, in a way that is no surface: more than two at an edge, fans that touch, or facets whose
    /// orientations disagree.
    NotASurface,
    /// The surface ends there: it has neighbours on one side only.
    Boundary,
    /// There are fewer neighbours than unknowns.
    FewNeighbors,
    /// The neighbours do not determine the jet: they lie on one line or curve, or at one place.
    Undetermined,
    /// The neighbourhood folds over: it is no height over any plane.
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
}

/// Curvatures of all places, in their order.
#[derive(Clone, Debug)]
pub struct Curvatures {
    /// For each vertex or point its jet, or why there is none.
    pub places: Vec<Result<Jet, NoCurvature>>,
    /// Of a cloud: parts that hang together, each with its normals to one side; 0 of a mesh, whose facets tell the side.
    pub parts: usize,
}

/// Why there are no curvatures.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CurvatureError {
    /// The degree is not offered.
    #[error("degree {0}: it must be from {first} to {last}", first = DEGREES.start(), last = DEGREES.end())]
    Degree(usize),
    /// Too few neighbours for the degree, or too many.
    #[error("{asked} neighbors: a jet of degree {degree} needs from {needed} to {MOST_NEIGHBORS}")]
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

/// Curvatures at the `V` vertices of a mesh, millimetres.
///
/// Neighbours are found through edges, ring after ring, so that the other side of a thin wall is none. Vertices at one place are
/// two vertices: weld first what is not welded. Normals are those of the facets. Rings do not grow through vertices with more than
/// 256 neighbours. `progress` counts vertices. Deterministic for any number of threads; about 450 bytes a vertex
/// with its facets; the time of a vertex is that of a least-squares fit, `2 m n²` products for `m` neighbours and `n` unknowns.
/// ```
/// use trueness_geom::curvature::{self, Options};
/// use trueness_geom::{mesh::Mesh, progress::Silent};
/// // The saddle z = x y / 10.
/// let place = |i: u32| {
///     let (x, y) = (f64::from(i % 21) - 10.0, f64::from(i / 21) - 10.0);
///     [x, y, 0.1 * x * y]
/// };
/// let faces = (0..400u32).flat_map(|k| {
///     let a = k / 20 * 21 + k % 20;
///     [[a, a + 1, a + 22], [a, a + 22, a + 21]]
/// });
/// let mesh = Mesh { positions: (0..441).map(place).collect(), faces: faces.collect() };
/// let found = curvature::mesh(&mesh, &Options::default(), &Silent).unwrap();
/// let middle = found.places[220].unwrap();
/// assert!((middle.bend.principal[0].curvature - 0.1).abs() < 1e-12);
/// assert!((middle.bend.gaussian + 0.01).abs() < 1e-12);
/// ```
///
/// # Errors
/// [`CurvatureError`]: options out of range, a facet that names no vertex, cancelled. Single vertices have their own reasons.
pub fn mesh(mesh: &Mesh, options: &Options, progress: &dyn Progress) -> Result<Curvatures, CurvatureError> {
    let terms = Terms::of(options)?;
    let rings = rings::Rings::new(mesh, progress)?;
    let places = terms.all(mesh.positions.len(), progress, || {
        let mut walk = rings.walk();
        let terms = &terms;
        move |fitter: &mut Fitter, v: u32| walk.jet(v, terms, fitter)
    })?;
    Ok(Curvatures { places, parts: 0 })
}

/// Curvatures at `N` points, millimetres, in their order.
///
/// The first frame of a place is the least-squares plane of its neighbours. A place is on a boundary where, along the surface, no
/// neighbour lies within an angle of 150 degrees. Normals are turned to one side from neighbour to neighbour, the flattest way
/// first (H. Hoppe et al., SIGGRAPH 1992); then each part that hangs together looks outward, if it is a body rather than a sheet
/// (the mean of n · (p − c) tells, which is three times volume over area of a closed one), else to the side of its mean normal's
/// largest coordinate. Equal points are points of their own. As [`mesh()`] otherwise;
/// about 600 bytes a point.
///
/// # Errors
/// As [`mesh()`].
pub fn cloud(
    points: &[Point],
    options: &Options,
    progress: &dyn Progress,
) -> Result<Curvatures, CurvatureError> {
    let terms = Terms::of(options)?;
    if points.len() >= u32::MAX as usize {
        return Err(CurvatureError::TooMany(points.len()));
    }
    let near = near::Near::new(points);
    let found = terms.all(points.len(), progress, || {
        let (near, terms) = (&near, &terms);
        move |fitter: &mut Fitter, i: u32| near.jet(i, terms, fitter)
    })?;
    let (mut places, links): (Vec<_>, Vec<_>) = found.into_iter().unzip();
    let parts = sides::turn(points, &mut places, &links, progress)?;
    Ok(Curvatures { places, parts })
}

/// Options with what follows from them.
struct Terms {
    degree: usize,
    unknowns: usize,
    reach: Taken,
    boundary: bool,
}

/// [`Reach`] without what must be worked out.
#[derive(Clone, Copy)]
enum Taken {
    Count(usize),
    Radius(f64),
}

impl Terms {
    fn of(options: &Options) -> Result<Terms, CurvatureError> {
        let degree = options.degree;
        if !DEGREES.contains(&degree) {
            return Err(CurvatureError::Degree(degree));
        }
        let unknowns = unknowns(degree);
        let reach = match (options.reach, options.reach.neighbors(degree)) {
            (_, Some(count)) if (unknowns..=MOST_NEIGHBORS).contains(&count) => Taken::Count(count),
            (_, Some(asked)) => return Err(CurvatureError::Neighbors { asked, degree, needed: unknowns }),
            (Reach::Radius(r), _) if r > 0.0 && r.is_finite() => Taken::Radius(r),
            (Reach::Radius(r), _) => return Err(CurvatureError::Radius(r)),
            (Reach::Auto | Reach::Count(_), None) => return Err(CurvatureError::Degree(degree)),
        };
        Ok(Terms { degree, unknowns, reach, boundary: options.boundary })
    }

    /// The answer of each place. `worker` makes what answers: it is called at most some dozens of times.
    fn all<T: Send, W: FnMut(&mut Fitter, u32) -> T>(
        &self,
        count: usize,
        progress: &dyn Progress,
        worker: impl Fn() -> W + Sync,
    ) -> Result<Vec<T>, Cancelled> {
        // Few workers, for each has room for a mark a place.
        let run = count.div_ceil(RUNS).max(4 * TASK);
        let parts: Vec<Vec<T>> = (0..count.div_ceil(run))
            .into_par_iter()
            .map(|part| {
                let (mut fitter, mut answer) = (Fitter::new(self.degree), worker());
                let (from, to) = (part * run, count.min((part + 1) * run));
                let mut answers = Vec::with_capacity(to - from);
                for first in (from..to).step_by(TASK) {
                    if progress.cancelled() {
                        break;
                    }
                    let last = to.min(first + TASK);
                    answers.extend((first..last).map(|i| answer(&mut fitter, i as u32)));
                    progress.advance((last - first) as u64);
                }
                answers
            })
            .collect();
        if progress.cancelled() {
            return Err(Cancelled);
        }
        Ok(parts.into_iter().flatten().collect())
    }
}
