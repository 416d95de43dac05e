//! Which of two elements explains a region better.
//!
//! An element with more unknowns fits the same points at least as well and mostly reaches farther. A cylinder nearly contains
//! planes, a torus nearly spheres and cylinders. So out of two regions around the same seed the one with more unknowns must
//! earn them, by one of three kinds of evidence. It covers clearly more surface ([`MIN_COVER_GAIN`],
//! [`COVER_GAIN_PER_UNKNOWN`]). Or it covers the same and fits clearly better where the simpler one fits worse than the noise
//! allows ([`GrownRegion::is_doubtful`], [`CLEARLY_BETTER_RMS`]). Or it covers the same and is the one that the facets follow
//! (`goes_along`). Before all that, an element may have corners of facets on it and not the facets. It gives way to one that a
//! large part of them follows (`is_of_corners`), whatever each covers. Whatever is not clear stays the simpler element. The
//! larger of two with equally many unknowns is kept.
//!
//! Gains are quotients of weights (area, or number of points), fits are compared by root mean square distances.

use super::pieces::PieceGraph;
use super::region::GrownRegion;
use crate::shape::{Kind, Shape};
use crate::space::{dot, minus, single_step};

/// Quotient of the distances below which another kind fits clearly better. Where the simpler element is just doubtful, this is
/// a root mean square of 0.94: the residual of the noise alone.
pub(super) const CLEARLY_BETTER_RMS: f64 = 0.75;
/// Quotient of the distances below which another kind fits better at all. From twenty points, the smallest patch, the root
/// mean square of the same noise is known to 16 %.
pub(super) const BETTER_RMS: f64 = 0.85;
/// Gain in cover that an element with more unknowns must have. The border of a region is uncertain by a ring of pieces, 10 to
/// 20 % of a region of some hundreds.
const MIN_COVER_GAIN: f64 = 1.15;
/// Gain that each further unknown adds: each lets the border bend a little farther.
const COVER_GAIN_PER_UNKNOWN: f64 = 0.1;
/// Gain that counts as "covers the same" where the fit decides against the simpler element. Below it the better fit may come
/// only from leaving out what fits badly.
const MIN_SAME_COVER: f64 = 0.95;
/// The same where the simpler element comes second. It may give up this much for fewer unknowns, if it fits better or covers
/// more as below.
const MIN_SIMPLER_COVER: f64 = 0.98;
/// Gain in cover from which on the simpler element replaces the other without a better fit.
const MIN_SIMPLER_GAIN: f64 = 1.05;
/// Quotient of the distances of the middles of facets below which one of two elements is clearly the one that the facets
/// follow. As far as the sag of the chords goes, an edge along a straight line of the element halves it.
const ALONG_FACETS_RATIO: f64 = 0.5;
/// Least share that an element must cover of the other's cover to be the one that the facets follow. One ring of facets of a
/// torus, out of three at least, follows a cone.
const MIN_ALONG_COVER: f64 = 0.4;
/// Corners of three chords.
const CHORD_POINTS: usize = 8;
/// The apex of a fan and six corners.
const FAN_POINTS: usize = 7;
/// Circles about the axis that show a torus.
const MIN_TORUS_CIRCLES: usize = 4;
/// Steps of single precision within which corners lie on one circle.
const CIRCLE_ROUNDING_STEPS: f64 = 16.0;
/// Least quotient of the areas of chords that are equally wide.
const MIN_EQUAL_LIKENESS: f64 = 0.999;

/// The one of two regions that explains more; `noise` is the standard deviation of the points.
pub(super) fn better(held: Option<GrownRegion>, other: GrownRegion, noise: f64) -> GrownRegion {
    match held {
        Some(held) if !replaces(&held, &other, noise) => held,
        _ => other,
    }
}

/// Whether `other` explains more than `held`.
fn replaces(held: &GrownRegion, other: &GrownRegion, noise: f64) -> bool {
    let [own, others] = [held, other].map(|region| region.shape.kind().unknowns());
    let gain = other.weight / held.weight;
    if is_of_corners(held, other, noise) {
        return true;
    }
    if is_of_corners(other, held, noise) {
        return false;
    }
    if own == others {
        return gain > 1.0;
    }
    if others > own {
        let asked = MIN_COVER_GAIN + COVER_GAIN_PER_UNKNOWN * (others - own) as f64;
        // A plane that is bowed within the tolerance is still a plane.
        let is_wrong = || {
            let fits_better = held.is_doubtful(noise) && other.rms < CLEARLY_BETTER_RMS * held.rms;
            held.shape.kind() != Kind::Plane && (fits_better || goes_along(other, held, noise))
        };
        return gain > asked || (gain > MIN_SAME_COVER && is_wrong());
    }
    let is_better = || other.rms < BETTER_RMS * held.rms && !goes_along(held, other, noise);
    gain > MIN_SIMPLER_COVER && (gain > MIN_SIMPLER_GAIN || is_better())
}

/// Whether the facets go along `one` where those of `other` only have their corners on theirs. Two circles of corners lie on a
/// cylinder and on a sphere; the facets between them are of the cylinder.
fn goes_along(one: &GrownRegion, other: &GrownRegion, noise: f64) -> bool {
    one.middles.max(noise) < ALONG_FACETS_RATIO * other.middles
}

/// Whether `region` is only one of corners, of one face or several, and a large part of its facets goes along `other`.
pub(super) fn is_of_corners(region: &GrownRegion, other: &GrownRegion, noise: f64) -> bool {
    let of_corners = region.rms.max(noise) < ALONG_FACETS_RATIO * region.middles;
    of_corners && goes_along(other, region, noise) && other.weight > MIN_ALONG_COVER * region.weight
}

/// Whether the facets of `region` might go along another element.
pub(super) fn may_give_way(region: &GrownRegion, noise: f64) -> bool {
    noise < ALONG_FACETS_RATIO * region.middles
}

/// So many points that an element of the kind is more than a coincidence: twice its unknowns and two more. Any three points have
/// a plane, and a fourth on it is hardly chance.
pub(super) fn fewest_points(kind: Kind) -> usize {
    if kind == Kind::Plane { 4 } else { 2 * kind.unknowns() + 2 }
}

/// Whether so many points of the pieces show an element of the kind: [`fewest_points`]. Fewer do on a drawn surface where the
/// facets are chords of equal width. A cylinder needs the corners of three, as a chamfer and the adjacent planes have a
/// cylinder of their corners too. That is eight points for five unknowns. A fan of a cone leaves as much over with six corners
/// about its apex, where all facets meet. Each has the right distance from the apex's axis, and the apex takes three unknowns.
pub(super) fn is_shown(surface: &PieceGraph, kind: Kind, pieces: &[u32], points: usize) -> bool {
    let fewest = match kind {
        Kind::Cylinder => CHORD_POINTS,
        Kind::Cone if meet(surface, pieces) => FAN_POINTS,
        _ => usize::MAX,
    };
    let chords = || {
        let like = |p: &u32| surface.likeness(*p, pieces[0]) >= MIN_EQUAL_LIKENESS;
        surface.is_drawn && points >= fewest && pieces.iter().all(like)
    };
    points >= fewest_points(kind) || chords()
}

/// Whether the corners of a drawn surface show a torus. Any three circles about one axis lie on one, as those of a chamfer and
/// its adjacent face. So the corners lie on four at least. Other elements, and measured surfaces, have nothing to ask.
pub(super) fn has_circles(surface: &PieceGraph, shape: &Shape, pieces: &[u32]) -> bool {
    let Shape::Torus { minor_radius, .. } = *shape else { return true };
    if !surface.is_drawn {
        return true;
    }
    let (origin, axes) = shape.frame();
    let tube = |p: u32| {
        let q = minus(surface.points[p as usize], origin);
        shape.coordinates(axes.map(|a| dot(a, q)))[1]
    };
    let points = surface.points_of(pieces.iter().copied());
    let mut around: Vec<f64> = points.into_iter().map(tube).collect();
    around.sort_by(f64::total_cmp);
    let same = CIRCLE_ROUNDING_STEPS * single_step(surface.points) / minor_radius;
    let parted = around.windows(2).filter(|w| w[1] - w[0] > same).count();
    parted + 1 >= MIN_TORUS_CIRCLES
}

/// Whether all facets share a corner.
fn meet(surface: &PieceGraph, pieces: &[u32]) -> bool {
    let Some(&first) = pieces.first().filter(|_| surface.is_mesh()) else { return false };
    let all = |corner: &u32| pieces.iter().all(|p| surface.corners(*p).0.contains(corner));
    surface.corners(first).0.iter().any(all)
}

#[cfg(test)]
mod tests {
    use super::super::tests::one_of_each;
    use super::*;

    /// Which of two tells more, by what they cover and how well they fit; noise is 0.01.
    #[test]
    fn the_simpler_element_is_preferred_unless_it_covers_less_or_fits_worse() {
        let [plane, sphere, cylinder, _, torus] = one_of_each([0.0; 3], [0.0, 0.0, 1.0], 0.3);
        let region = |shape, weight, rms| GrownRegion { shape, pieces: vec![], weight, rms, middles: rms };
        let second = |one: (Shape, f64, f64), other: (Shape, f64, f64)| {
            replaces(&region(one.0, one.1, one.2), &region(other.0, other.1, other.2), 0.01)
        };
        // Two more unknowns: 35 % more.
        assert!(!second((plane, 1.0, 0.01), (cylinder, 1.3, 0.01)));
        assert!(second((plane, 1.0, 0.01), (cylinder, 1.4, 0.01)));
        // A bowed plane stays one, a ball that fits worse than noise does not.
        assert!(!second((plane, 1.0, 0.03), (cylinder, 1.0, 0.01)));
        assert!(second((sphere, 1.0, 0.03), (torus, 1.0, 0.01)));
        assert!(
            !second((sphere, 1.0, 0.012), (torus, 1.0, 0.01))
                && !second((sphere, 1.0, 0.03), (torus, 0.9, 0.01))
        );
        // The other way round.
        assert!(
            second((cylinder, 1.0, 0.01), (plane, 1.06, 0.01))
                && second((torus, 1.0, 0.01), (sphere, 1.0, 0.008))
        );
        assert!(
            !second((cylinder, 1.0, 0.01), (plane, 1.0, 0.01))
                && !second((cylinder, 1.0, 0.01), (plane, 0.9, 0.001))
        );
        // The larger one of one kind.
        let leaning = Shape::Plane { point: [0.0; 3], normal: [0.0, 0.6, 0.8] };
        assert!(second((plane, 1.0, 0.01), (leaning, 1.01, 0.02)));
        assert!(!second((plane, 1.0, 0.01), (leaning, 0.99, 0.0)));
    }
}
