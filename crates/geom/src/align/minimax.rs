//! The best fit by the least greatest distance (Chebyshev), from a pose that is near.
//!
//! Least squares share the deviations out. Here the worst place alone decides, so that a part is as far within a zone about its
//! reference as it can be. A sequence of linear programs in small motions (`zone::motion`), over those points that stick out
//! most.

use super::counting::{Counting, NotCounted, weighted_mean};
use super::perturbed::Searched;
use super::sample::Measured;
use super::{AlignError, Alignment, BestFit, Start, Target};
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, minus, norm, times};

/// The pose with the least greatest distance.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimax {
    /// Takes measured coordinates to those of the reference.
    pub reference_from_measured: Rigid,
    /// The greatest distance of a point that counts from the surface, millimeters.
    pub greatest: f64,
    /// Where that point lies on the reference's side, millimeters.
    pub at: Point,
    /// Root of their weighted mean square distance.
    pub rms: f64,
    /// Their weighted mean distance.
    pub mean_abs: f64,
    /// Points that count.
    pub used: u64,
    /// Points that do not.
    pub not_counted: NotCounted,
}

/// The motion after which the greatest distance of a point from the surface is least. It lies near `from`, a best fit of the
/// same `measured` to the same `reference`. The vertices of a mesh count. Points beyond ten standard deviations of the best fit
/// and a hundredth of the diagonal of the reference do not, unless `options` say so. `not_counted` reports them, with those
/// that have no place on the reference.
///
/// A local search, begun again beside where it ends, and at a given start that is better: the best fit decides near which pose.
/// Cost: three to ten closest-point searches of all points, one by one. Each time that the search goes on from a pose nearby
/// costs as many, and some thousand of single points.
///
/// # Errors
/// [`AlignError::Free`] where the best fit left a motion free, [`AlignError::NotSettled`], [`AlignError::Cancelled`], and those of
/// [`best_fit`](super::best_fit).
///
/// ```
/// use trueness_geom::align::{BestFit, Measured, Start, Target, best_fit, minimax};
/// use trueness_geom::{closest::Tree, mesh::Mesh, progress::Silent, rigid::Rigid};
/// let reference = Mesh {
///     positions: vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 11.0]],
///     faces: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
/// };
/// let mut points = vec![];
/// for face in &reference.faces {
///     let [a, b, c] = reference.places(face);
///     for (i, j) in (1..12).flat_map(|i| (1..12 - i).map(move |j| (f64::from(i) / 12.0, f64::from(j) / 12.0))) {
///         points.push(std::array::from_fn(|k| a[k] + i * (b[k] - a[k]) + j * (c[k] - a[k])));
///     }
/// }
/// let tree = Tree::build(&reference)?;
/// let target = Target::new(&reference, &tree);
/// let measured = Measured::Points { points: &points, normals: None };
/// let options = BestFit { start: Start::From(Rigid::IDENTITY), ..BestFit::default() };
/// let fit = best_fit(&measured, &target, &options, &Silent)?;
/// assert!(minimax(&measured, &target, &fit, &options, &Silent)?.greatest < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn minimax(
    measured: &Measured,
    reference: &Target,
    from: &Alignment,
    options: &BestFit,
    progress: &dyn Progress,
) -> Result<Minimax, AlignError> {
    let start = from.reference_from_measured;
    let counting = Counting::of(measured, reference, from, options, 0.0, progress)?;
    let Counting { points, weights, .. } = &counting;
    let distance = |_: usize, p: Point| -> Option<(f64, Vector)> {
        let place = reference.tree.closest(&p, f64::INFINITY).ok().flatten()?;
        let away = minus(p, place.point);
        match norm(away) {
            // On the surface it goes up along the normal whichever way.
            0.0 => Some((0.0, super::field::facet_normal(reference.mesh, place.face)?)),
            size => Some((size, times(1.0 / size, away))),
        }
    };
    let searched = Searched { points, distance: &distance, room: &[], seed: options.seed };
    let mut found = searched.lowest(start, progress)?;
    if let Start::From(pose) = options.start
        && points.iter().all(|p| distance(0, pose.point(*p)).is_some_and(|d| d.0 < found.half))
    {
        found = searched.lowest(pose, progress)?;
    }
    let motion = found.motion;
    let ends: Vec<f64> = points.iter().map(|p| distance(0, motion.point(*p)).map_or(0.0, |d| d.0)).collect();
    let sum = |f: &dyn Fn(f64) -> f64| weighted_mean(weights, &ends, f);
    Ok(Minimax {
        reference_from_measured: motion,
        greatest: found.half,
        at: motion.point(points[found.max.1]),
        rms: sum(&|d| d * d).sqrt(),
        mean_abs: sum(&|d| d),
        used: points.len() as u64,
        not_counted: counting.not_counted(&motion, reference, progress)?,
    })
}
