//! Curvatures of meshes and clouds, place by place, from jets fitted to the neighborhood.
//!
//! F. Cazals, M. Pouget, Estimating differential quantities using polynomial fitting of osculating jets, Computer Aided
//! Geometric Design 22 (2005) 121–146. In a frame whose third axis is about the normal, the surface near a place is a
//! height `z(x, y)`. A polynomial of degree
//! `d` (a jet) is fitted to the neighbors by least squares. Its first and second derivatives give the normal and curvatures. Curvatures of a smooth surface come out to the order `d
//! − 1` in the size of the neighborhood. Three things differ from the paper. The frame is turned to the fitted normal
//! where that leans, and the standard uncertainty is reported. Places whose neighborhood is no surface on all sides
//! have no value but a reason.
//!
//! A curvature is positive where the surface bends towards its normal, as in [`trueness_geom::spline::surface::Bend`].
//! On a convex body with outward normals both principal curvatures are negative.
//!
//! | file | what |
//! |---|---|
//! | `terms` | what is asked, and why there may be no answer |
//! | `jet` | one neighborhood |
//! | `shared` | what noise that neighbors share does to it |
//! | `rings` | neighbors on a mesh, through edges |
//! | `near` | neighbors in a cloud, by distance |
//! | `sides` | normals of a cloud to one side |

mod jet;
mod near;
mod rings;
mod shared;
mod sides;
mod terms;
#[cfg(test)]
mod tests;

pub use jet::Jet;
pub use terms::{CurvatureError, DEGREES, MAX_NEIGHBORS, NoCurvature, Options, Reach, unknowns};

use jet::Fitter;
use terms::Terms;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::Point;

/// Places answered between two questions whether to go on.
const PLACES_PER_STOP_CHECK: usize = 64;
/// Pieces that the places are divided into, whatever the number of threads.
const MAX_RUNS: usize = 64;

/// Curvatures of all places, in their order.
#[derive(Clone, Debug)]
pub struct Curvatures {
    /// For each vertex or point its jet, or why there is none.
    pub places: Vec<Result<Jet, NoCurvature>>,
    /// Parts of a cloud that hang together, each with its normals to one side. A mesh has 0: its facets tell the side.
    pub parts: usize,
}

/// Curvatures at the `V` vertices of a mesh, millimeters.
///
/// Neighbors are found through edges, ring after ring, so that the other side of a thin wall is none. Vertices at one
/// place are two vertices: weld an unwelded mesh first. Normals are those of the facets. Rings do not grow through
/// vertices with more than 256 neighbors.
/// `progress` counts vertices. Deterministic for any number of threads; about 450 bytes a vertex with its facets. The time of a vertex is that of a least-squares fit, `2
/// m n²` products for `m` neighbors and `n` unknowns.
/// ```
/// use trueness_surface::curvature::{self, Options};
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
    let places = all(&terms, mesh.positions.len(), progress, || {
        let mut walk = rings.walk();
        let terms = &terms;
        move |fitter: &mut Fitter, v: u32| walk.jet(v, terms, fitter)
    })?;
    Ok(Curvatures { places, parts: 0 })
}

/// Curvatures at `N` points, millimeters, in their order.
///
/// The first frame of a place is the least-squares plane of its neighbors. A place is on a boundary where, along the
/// surface, no neighbor lies within an angle of 150 degrees. Normals are turned to one side from neighbor to neighbor,
/// the flattest way first (H. Hoppe et al., SIGGRAPH 1992). Then each part that hangs together looks outward, if it is
/// a body rather than a sheet. The mean of n · (p − c) tells that: in a closed body it is three times volume over area.
/// Other parts look to the side of their mean normal's largest coordinate. Equal points are one place: copies are no
/// neighbors, and have the same answer. As [`mesh()`] otherwise; about 600 bytes a point.
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
    let near = near::CloudNeighbors::new(points);
    let found = all(&terms, points.len(), progress, || {
        let (near, terms) = (&near, &terms);
        move |fitter: &mut Fitter, i: u32| near.jet(i, terms, fitter)
    })?;
    let (mut places, links): (Vec<_>, Vec<_>) = found.into_iter().unzip();
    let parts = sides::turn(points, &mut places, &links, progress)?;
    Ok(Curvatures { places, parts })
}

/// The answer of each place. `worker` makes the function that answers: it is called at most some dozens of times.
fn all<T: Send, W: FnMut(&mut Fitter, u32) -> T>(
    terms: &Terms,
    count: usize,
    progress: &dyn Progress,
    worker: impl Fn() -> W + Sync,
) -> Result<Vec<T>, Cancelled> {
    // Few workers, for each has room for a mark a place.
    let run = count.div_ceil(MAX_RUNS).max(4 * PLACES_PER_STOP_CHECK);
    let parts: Vec<Vec<T>> = (0..count.div_ceil(run))
        .into_par_iter()
        .map(|part| {
            let (mut fitter, mut answer) = (Fitter::new(terms.degree, terms.noise), worker());
            let (from, to) = (part * run, count.min((part + 1) * run));
            let mut answers = Vec::with_capacity(to - from);
            for first in (from..to).step_by(PLACES_PER_STOP_CHECK) {
                if progress.cancelled() {
                    break;
                }
                let last = to.min(first + PLACES_PER_STOP_CHECK);
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
