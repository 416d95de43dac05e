//! How a best fit answers to small shifts of what was measured: the derivative of the pose.
//!
//! The least sum of weighted squares of `e + J x` lies at `x = -(Jᵀ W J)⁺ Jᵀ W e`, which is linear in the distances `e`. A
//! shift of a vertex changes the distances of its facets along their normals. (JCGM 102:2011, 6.2: the propagation of
//! covariances through a least-squares estimate.) Weights and facets met are those of the pose.

use super::freedom::twists;
use super::sample::{Measured, Samples};
use super::system::{Six, Spectrum, slope};
use super::twist::directions;
use super::work::Work;
use super::{AlignError, AlignWarning, Alignment, BestFit, Freedom, Target};
use crate::closest::BoundaryEdges;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, dot, plus, times};

/// How a best fit answers to small shifts of what was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// One response for each vertex of the mesh, or point of the cloud. The products of its six vectors with a shift of it,
    /// millimeters in the frame of the reference, are the change of the pose. That change is a rotation vector about `center`,
    /// radians, and a translation, millimeters. Zero for what has no weight.
    pub gains: Vec<[Vector; 6]>,
    /// Place that the rotations are about.
    pub center: Point,
}

impl Response {
    /// The motion that `change` of the pose is.
    pub fn motion(center: Point, change: [f64; 6]) -> Rigid {
        let [a, b, c, x, y, z] = change;
        Rigid::translation_by([x, y, z]).after(&Rigid::rotation_about(center, [a, b, c]))
    }
}

/// How the best fit `fit` answers to small shifts of its vertices or points. `measured` lies where it took them, and `options` are its own.
///
/// This holds to first order: for shifts that are small compared with the facets, and places that stay on their facet of the
/// reference. Points on edges do not stay. Motions that the shape leaves free do not move. Cost: one closest-point search of
/// the surface, and 144 bytes a vertex.
///
/// # Errors
/// [`AlignError`]: a reference that cannot be searched, cancelled.
///
/// ```
/// use trueness_geom::align::{BestFit, Measured, Response, Target, best_fit, response};
/// use trueness_geom::{closest::Tree, mesh::Mesh, progress::Silent};
/// let reference = Mesh {
///     positions: vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 11.0]],
///     faces: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
/// };
/// let tree = Tree::build(&reference)?;
/// let (target, options) = (Target::new(&reference, &tree), BestFit::default());
/// let fit = best_fit(&Measured::Mesh(&reference), &target, &options, &Silent)?;
/// let found = response(&Measured::Mesh(&reference), &target, &fit, &options, &Silent)?;
/// // When all of it shifts by 1 along z, the pose goes back by 1.
/// let back: f64 = found.gains.iter().map(|g| g[5][2]).sum();
/// assert!((back + 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn response(
    measured: &Measured,
    reference: &Target,
    fit: &Alignment,
    options: &BestFit,
    progress: &dyn Progress,
) -> Result<Response, AlignError> {
    let mut surface = Samples::of_surface(measured);
    if fit.warnings.contains(&AlignWarning::NormalsTurned) {
        surface = surface.turned();
    }
    let boundary_edges = BoundaryEdges::watched(reference.tree, progress)?;
    let work = Work::new(reference, &boundary_edges, options, &surface);
    let problem = work.problem(&surface);
    let mut matches = problem.matches(&Rigid::IDENTITY, f64::INFINITY, progress)?;
    let sigma = problem.deviation(&matches);
    problem.weigh(&mut matches, sigma);
    let system = problem.system_of_facets(&matches, &Rigid::IDENTITY);
    let slack: Vec<Freedom> = fit.slack.iter().map(|s| s.0).collect();
    let still = problem.lock.map(|lock| lock.twists(&Rigid::IDENTITY)).unwrap_or_default();
    let untold = [still, twists(&fit.freedoms), twists(&slack)].concat();
    let spectrum = Spectrum::without(&system, &directions(&untold, system.center, system.radius));
    let mut gains = vec![[[0.0; 3]; 6]; measured.points().len()];
    let facets = match measured {
        Measured::Mesh(mesh) => Samples::facets(mesh),
        Measured::Points { .. } => vec![],
    };
    for (k, m) in matches.iter().enumerate().filter(|(_, m)| m.equation.weight > 0.0) {
        let row = slope(m.equation.point, m.facet, system.center, system.radius);
        let mut add = |at: usize, share: f64| {
            for i in 0..6 {
                gains[at][i] = plus(gains[at][i], times(share * m.equation.weight * row[i], m.facet));
            }
        };
        match (measured, facets.get(k)) {
            (Measured::Mesh(mesh), Some(face)) => {
                mesh.faces[*face as usize].iter().for_each(|&v| add(v as usize, 1.0 / 3.0));
            }
            _ => add(k, 1.0),
        }
    }
    let unit = |i: usize| if i < 3 { 1.0 / system.radius } else { 1.0 };
    for gain in gains.iter_mut().filter(|g| g.iter().any(|row| dot(*row, *row) > 0.0)) {
        for axis in 0..3 {
            let right: Six = std::array::from_fn(|i| -gain[i][axis]);
            let solved = spectrum.solve(&right, 0);
            for i in 0..6 {
                gain[i][axis] = unit(i) * solved[i];
            }
        }
    }
    Ok(Response { gains, center: system.center })
}
