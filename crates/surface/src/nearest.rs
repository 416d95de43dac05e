//! The nearest places of points on the surface found, beyond doubt.
//!
//! The descents of parameter correction stop at any place where the distance stands still. For most points the surface's reach
//! says that there is no nearer one ([`Patches::reach`](trueness_geom::spline::surface::Patches::reach)); for the others all of it is searched.

use super::{SurfaceError, SurfaceFit, border};
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::Point;
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::surface::{FootSearch, Nurbs, Surface};

/// Points between two questions whether to stop.
const POINTS_PER_SEARCH: usize = 256;

/// The fit with true distances of the points that are `beyond`, and the numbers of the points beyond the border. The
/// known distance is an upper bound of the true one.
///
/// Cost: some microseconds for each of them whose foot is in doubt.
pub(super) fn with_true_distances(
    points: &[Point],
    mut fit: SurfaceFit,
    beyond: f64,
    progress: &dyn Progress,
) -> Result<SurfaceFit, SurfaceError> {
    let is_beyond = |i: &u32| fit.deviations[*i as usize].abs() > beyond;
    let (ask, keep): (Vec<u32>, Vec<u32>) = fit.doubtful.iter().copied().partition(is_beyond);
    if ask.is_empty() {
        fit.beyond_border = border::beyond(points, &fit);
        return Ok(fit);
    }
    let search = FootSearch::new(&untorn(&fit.surface), progress)?;
    let chunk = |part: &[u32]| {
        if progress.cancelled() {
            return Err(Cancelled);
        }
        Ok(part.iter().map(|i| search.nearest(&points[*i as usize])).collect::<Vec<_>>())
    };
    let found: Result<Vec<_>, Cancelled> = ask.par_chunks(POINTS_PER_SEARCH).map(chunk).collect();
    let asked_from = keep.len();
    fit.doubtful = keep;
    for (index, found) in ask.into_iter().zip(found?.concat()) {
        let i = index as usize;
        // A search that was given up may know a farther place than the descent does.
        if found.certain || found.foot.distance < fit.deviations[i].abs() {
            fit.deviations[i] = found.foot.signed(points[i]);
            fit.feet[i] = found.foot.parameters;
        }
        if !(found.certain && found.foot.settled) {
            fit.doubtful.push(index);
        }
    }
    fit.unsettled = fit.doubtful.len() - asked_from;
    fit.beyond_border = border::beyond(points, &fit);
    Ok(fit)
}

/// The surface, cut where a knot stands more often than the degree: it is torn there. Parameters stay the same.
fn untorn(surface: &Surface<Point>) -> Vec<Nurbs> {
    let whole = Nurbs::from(surface.clone());
    let parts = surface.knots().each_ref().map(limits);
    let over = |u: &[f64]| {
        let u = (u[0], u[1]);
        parts[1].windows(2).map(move |v| [u, (v[0], v[1])]).collect::<Vec<_>>()
    };
    match parts.iter().map(Vec::len).max() {
        Some(2) => vec![whole],
        _ => parts[0].windows(2).flat_map(over).map(|domain| whole.within(domain)).collect(),
    }
}

/// Ends of the parts that hang together.
fn limits(knots: &Knots) -> Vec<f64> {
    let all = knots.distinct();
    let last = all.len() - 1;
    let torn = |k: usize| k == 0 || k == last || knots.multiplicity(all[k]) > knots.degree();
    (0..=last).filter(|k| torn(*k)).map(|k| all[k]).collect()
}
