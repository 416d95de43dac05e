//! Two-point sizes (ISO 17450-3:2016, ISO 14405-1:2016, 3.6): the distance of two opposite places of a feature of size.
//!
//! Each measured point is one end. The other lies where the line through it, across the axis or along the common normal, meets
//! the other side. That side is interpolated among the points nearest to there by a plane of least squares through their
//! heights, never beyond the heights themselves. Where they lie in a row it is the line between its two neighbors. A point
//! whose other end is not between points has no size.

use crate::frame::Pose;
use crate::num::dense::eigen;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, Vector, dot, minus, plus, times, unit};
use crate::spatial::neighbors::PointTree;

/// Points that the other end is interpolated among.
const INTERPOLATION_POINTS: usize = 8;
/// Part of a turn, radians, beyond which neighbors tell nothing of a place on a cylinder.
const MAX_NEIGHBOR_TURN: f64 = std::f64::consts::FRAC_PI_4;
/// Moment across a row over that along it below which neighbors lie in a row: then they tell no slope across.
const MAX_ROW_MOMENT_SHARE: f64 = 0.03;
/// Angle by which rounding may bend a row that a place is the middle of.
const MAX_ROW_BEND: f64 = 1e-9;
/// Distance from a row that a place may have, as a share of the row's root mean square length.
const MAX_ROW_DISTANCE: f64 = 0.3;

/// A two-point size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoPoint {
    /// Millimeters.
    pub size: f64,
    /// The measured point, and the place opposite.
    pub ends: [Point; 2],
}

/// The two-point diameters of a cylinder or circle about the axis through `point` along `direction` (of length 1). There is one
/// for each of `points` whose opposite place is between others, in their order. Millimeters. Points on the axis and those that
/// are not finite have none. Cost: `n log n`.
///
/// # Errors
/// [`Cancelled`].
///
/// ```
/// use trueness_geom::{progress::Silent, zone::two_point_diameters};
/// let at = |k: u32| (std::f64::consts::TAU * f64::from(k) / 36.0).sin_cos();
/// // An oval of 10 and 10.2 mm.
/// let oval: Vec<[f64; 3]> = (0..36).map(|k| [5.0 * at(k).1, 5.1 * at(k).0, 0.0]).collect();
/// let found = two_point_diameters(&oval, [0.0; 3], [0.0, 0.0, 1.0], &Silent)?;
/// let sizes: Vec<f64> = found.iter().map(|d| d.size).collect();
/// let (least, greatest) = sizes.iter().fold((f64::MAX, 0.0f64), |(l, g), s| (l.min(*s), g.max(*s)));
/// assert!(sizes.len() == 36 && (least - 10.0).abs() < 0.01 && (greatest - 10.2).abs() < 0.01);
/// # Ok::<(), trueness_geom::progress::Cancelled>(())
/// ```
pub fn two_point_diameters(
    points: &[Point],
    point: Point,
    direction: Vector,
    progress: &dyn Progress,
) -> Result<Vec<TwoPoint>, Cancelled> {
    let Some((direction, _)) = unit(direction) else { return Ok(vec![]) };
    let frame = Pose::along(point, direction);
    let [x, y, _] = frame.axes;
    // Turn, station and radius of each point.
    let polar = |[a, b, along]: [f64; 3]| [libm::atan2(b, a), along, libm::hypot(a, b)];
    let places: Vec<[f64; 3]> = points.iter().map(|p| polar(frame.local(*p))).collect();
    let (sum, count) = (places.iter().filter(|p| finite(p)))
        .fold((0.0, 0u64), |(sum, count), [.., radius]| (sum + radius, count + 1));
    let mean = sum / count.max(1) as f64;
    if mean <= 0.0 {
        return Ok(vec![]);
    }
    // The surface unrolled, a quarter turn beyond each end.
    let unrolled = |[turn, along, radius]: &[f64; 3]| {
        let near = |turn: f64| [mean * turn, *along, *radius];
        let beyond = turn - std::f64::consts::TAU.copysign(*turn);
        [Some(near(*turn)), (turn.abs() > std::f64::consts::FRAC_PI_2).then(|| near(beyond))]
    };
    let outside = places.iter().filter(|p| finite(p) && p[2] > 0.0);
    let sheet = Sheet::of(outside.flat_map(unrolled).flatten().collect(), MAX_NEIGHBOR_TURN * mean);
    let ends = |(p, [turn, along, radius]): (&Point, &[f64; 3])| {
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let there = turn - std::f64::consts::PI.copysign(*turn);
        let opposite = sheet.height(mean * there, *along).filter(|_| *radius > 0.0);
        Ok(opposite.map(|opposite| {
            let (sine, cosine) = (libm::sin(there), libm::cos(there));
            let out = plus(times(opposite * cosine, x), times(opposite * sine, y));
            let end = plus(plus(point, times(*along, direction)), out);
            TwoPoint { size: radius + opposite, ends: [*p, end] }
        }))
    };
    let all: Vec<Option<TwoPoint>> = points.par_iter().zip(&places).map(ends).collect::<Result<_, _>>()?;
    Ok(all.into_iter().flatten().collect())
}

/// The two-point sizes of two opposite planes along their common `normal` (of length 1). There is one for each point of either
/// with a place opposite that is between points of the other. The sizes of the first come first, then those of the second.
/// Millimeters. Cost: `n log n`.
///
/// # Errors
/// [`Cancelled`].
pub fn two_point_distances(
    [first, second]: [&[Point]; 2],
    normal: Vector,
    progress: &dyn Progress,
) -> Result<Vec<TwoPoint>, Cancelled> {
    let Some((normal, _)) = unit(normal) else { return Ok(vec![]) };
    let frame = Pose::along([0.0; 3], normal);
    let flat = |p: &Point| frame.local(*p);
    let sheet = |points: &[Point]| Sheet::of(points.iter().map(flat).filter(finite).collect(), f64::INFINITY);
    let mut all = vec![];
    for (points, other) in [(first, sheet(second)), (second, sheet(first))] {
        let ends = |p: &Point| {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            let [u, v, height] = flat(p);
            let opposite = other.height(u, v).map(|there| there - height);
            Ok(opposite.map(|way| TwoPoint { size: way.abs(), ends: [*p, plus(*p, times(way, normal))] }))
        };
        let found: Vec<Option<TwoPoint>> = points.par_iter().map(ends).collect::<Result<_, _>>()?;
        all.extend(found.into_iter().flatten());
    }
    Ok(all)
}

fn finite(p: &[f64; 3]) -> bool {
    p.iter().all(|x| x.is_finite())
}

/// Heights over places of a plane.
struct Sheet {
    places: Vec<[f64; 3]>,
    tree: PointTree,
    /// How far along the first axis places may be from where they are asked for.
    reach: f64,
}

impl Sheet {
    fn of(places: Vec<[f64; 3]>, reach: f64) -> Sheet {
        let flat: Vec<Point> = places.iter().map(|[u, v, _]| [*u, *v, 0.0]).collect();
        Sheet { places, tree: PointTree::new(&flat), reach }
    }

    /// The height at a place; `None` where it is not surrounded by points, nor between points of a row.
    fn height(&self, u: f64, v: f64) -> Option<f64> {
        if !(u.is_finite() && v.is_finite()) {
            return None;
        }
        let near = self.tree.k_nearest(&[u, v, 0.0], INTERPOLATION_POINTS, None);
        let away = near.iter().map(|(_, n)| self.places[*n as usize]).map(|[a, b, h]| [a - u, b - v, h]);
        let near: Vec<[f64; 3]> = away.filter(|[a, ..]| a.abs() <= self.reach).collect();
        if let Some([.., height]) = near.iter().find(|[a, b, _]| *a == 0.0 && *b == 0.0) {
            return Some(*height);
        }
        between(&near)
    }
}

/// The height at the origin of a plane through heights at places around it, or between its neighbors where they lie in a row.
/// `None` where the origin is not between them. No height is beyond the least and greatest of theirs.
fn between(places: &[[f64; 3]]) -> Option<f64> {
    let n = places.len() as f64;
    let mean = [0, 1, 2].map(|k| places.iter().map(|p| p[k]).sum::<f64>() / n);
    let mut scatter = [[0.0; 3]; 3];
    for p in places {
        let d = minus(*p, mean);
        (0..2).for_each(|i| (0..2).for_each(|j| scatter[i][j] += d[i] * d[j]));
    }
    let (moments, axes) = eigen(scatter);
    let along = |k: usize, p: &[f64; 3]| dot(axes[k], [p[0], p[1], 0.0]);
    let row = moments[1] < MAX_ROW_MOMENT_SHARE * moments[2];
    // The second axis is any one where all lie in a row exactly.
    let (middle, on) = (libm::hypot(mean[0], mean[1]), along(2, &mean));
    let off_row = (middle * middle - on * on).max(0.0).sqrt();
    if row {
        return (off_row <= MAX_ROW_DISTANCE * (moments[2] / n).sqrt())
            .then(|| in_row(places.iter().map(|p| [along(2, p), p[2]])))
            .flatten();
    }
    let height = plane(places);
    let (least, greatest) =
        places.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, g), p| (l.min(p[2]), g.max(p[2])));
    (surrounded(places) && height.is_finite()).then(|| height.clamp(least, greatest))
}

/// The height at the origin of the plane of least squares through heights at other places. Each has the inverse square of its
/// distance as its weight: far ones would take the crests off lobes of a few points.
fn plane(places: &[[f64; 3]]) -> f64 {
    let weigh = |p: &[f64; 3]| 1.0 / (p[0] * p[0] + p[1] * p[1]);
    let all: f64 = places.iter().map(weigh).sum();
    let mean = [0, 1, 2].map(|k| places.iter().map(|p| weigh(p) * p[k]).sum::<f64>() / all);
    let (mut xx, mut xy, mut yy, mut xz, mut yz) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for p in places {
        let ([x, y, z], w) = (minus(*p, mean), weigh(p));
        (xx, xy, yy) = (xx + w * x * x, xy + w * x * y, yy + w * y * y);
        (xz, yz) = (xz + w * x * z, yz + w * y * z);
    }
    let det = xx * yy - xy * xy;
    mean[2] - ((xz * yy - yz * xy) * mean[0] + (yz * xx - xz * xy) * mean[1]) / det
}

/// The height at zero between the nearest place of a row before it and that behind it; `None` where one is missing.
fn in_row(places: impl Iterator<Item = [f64; 2]> + Clone) -> Option<f64> {
    let [before, first] = places.clone().filter(|p| p[0] <= 0.0).max_by(|a, b| a[0].total_cmp(&b[0]))?;
    let [after, second] = places.filter(|p| p[0] >= 0.0).min_by(|a, b| a[0].total_cmp(&b[0]))?;
    let way = after - before;
    Some(if way > 0.0 { first - before / way * (second - first) } else { first })
}

/// Whether no half-plane is free of places, seen from the origin.
fn surrounded(places: &[[f64; 3]]) -> bool {
    let mut turns: Vec<f64> = places.iter().map(|[a, b, _]| libm::atan2(*b, *a)).collect();
    turns.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (turns.first(), turns.last()) else { return false };
    let around = first + std::f64::consts::TAU - last;
    turns.windows(2).map(|w| w[1] - w[0]).fold(around, f64::max) <= std::f64::consts::PI + MAX_ROW_BEND
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;
    use crate::progress::Silent;

    /// A cylinder about a slanted axis: 20 levels of 60 points, turned at random, whose radius is 8 + 0.1 cos(2 turn).
    fn oval(turns: std::ops::Range<f64>) -> (Vec<Point>, Point, Vector, impl Fn(f64) -> f64) {
        let direction = unit([0.3, -0.5, 1.0]).unwrap().0;
        let [x, y, _] = Pose::along([0.0; 3], direction).axes;
        let radius = |turn: f64| 8.0 + 0.1 * (2.0 * turn).cos();
        let middle = [7.0, 8.0, 9.0];
        let mut random = Random::new(3);
        let points = (0..1200).map(|k| {
            let turn = turns.start + (turns.end - turns.start) * random.unit();
            let out = plus(times(radius(turn) * turn.cos(), x), times(radius(turn) * turn.sin(), y));
            plus(plus(middle, times(f64::from(k / 60), direction)), out)
        });
        (points.collect(), middle, direction, radius)
    }

    #[test]
    fn diameters_of_an_oval_are_those_of_its_formula() {
        let (points, middle, direction, radius) = oval(0.0..std::f64::consts::TAU);
        let found = two_point_diameters(&points, middle, direction, &Silent).unwrap();
        // The ends of the cylinder have neighbors on one side only.
        assert!(found.len() > 1000, "{}", found.len());
        let [x, y, _] = Pose::along([0.0; 3], direction).axes;
        for d in &found {
            let [a, b] = d.ends.map(|p| minus(p, middle));
            assert!((dot(minus(b, a), direction)).abs() < 1e-9, "the ends lie at one station");
            let turn = dot(a, y).atan2(dot(a, x));
            // A chord of neighbors 0.8 mm apart is 0.003 mm within the oval at most.
            assert!((d.size - 2.0 * radius(turn)).abs() < 0.02, "{} {}", d.size, 2.0 * radius(turn));
            let away = minus(b, a);
            assert!((dot(away, away).sqrt() - d.size).abs() < 1e-9);
        }
    }

    /// Five lobes of 0.05 mm on a bore measured at 71 places of each level, farther apart along it than around. Opposite a
    /// crest lies a trough, and every size is twice the radius.
    #[test]
    fn lobes_are_not_smoothed_where_levels_are_far_apart() {
        for apart in [0.6, 0.9, 1.5, 4.0] {
            let at = |k: u32| std::f64::consts::TAU * (f64::from(k % 71) + 0.3 * f64::from(k / 71)) / 71.0;
            let radius = |turn: f64| 8.0 + 0.05 * (5.0 * turn).cos();
            let place = |k: u32| {
                let (turn, level) = (at(k), apart * f64::from(k / 71));
                [radius(turn) * turn.cos(), radius(turn) * turn.sin(), level]
            };
            let points: Vec<Point> = (0..71 * 9).map(place).collect();
            let found = two_point_diameters(&points, [0.0; 3], [0.0, 0.0, 1.0], &Silent).unwrap();
            assert!(found.len() >= 71 * 7, "{}", found.len());
            let worst = found.iter().fold(0.0f64, |m, d| m.max((d.size - 16.0).abs()));
            assert!(worst < 0.006, "{apart}: {worst}");
        }
    }

    #[test]
    fn half_a_bore_has_no_diameters() {
        let (points, middle, direction, _) = oval(0.0..0.8 * std::f64::consts::PI);
        assert_eq!(two_point_diameters(&points, middle, direction, &Silent).unwrap(), []);
        let broken = [[f64::NAN; 3], middle, [1.0, 2.0, 3.0]];
        assert_eq!(two_point_diameters(&broken, middle, direction, &Silent).unwrap(), []);
        assert_eq!(two_point_diameters(&[], middle, [0.0; 3], &Silent).unwrap(), []);
    }

    #[test]
    fn a_wedge_is_as_thick_as_it_is_there() {
        let mut random = Random::new(5);
        let mut side = |slope: f64, z: f64| -> Vec<Point> {
            let mut at = || 10.0 * random.unit();
            (0..400).map(|_| [at(), at()]).map(|[x, y]| [x, y, z + slope * x]).collect()
        };
        let (floor, roof) = (side(0.0, 0.0), side(0.01, 5.0));
        let found = two_point_distances([&floor, &roof], [0.0, 0.0, 1.0], &Silent).unwrap();
        assert!(found.len() > 600, "{}", found.len());
        for t in &found {
            assert!((t.size - (5.0 + 0.01 * t.ends[0][0])).abs() < 1e-12, "{t:?}");
            assert!((t.ends[1][0], t.ends[1][1]) == (t.ends[0][0], t.ends[0][1]));
        }
    }

    /// Sections of a coordinate measuring machine: places between points of one level alone.
    #[test]
    fn levels_far_apart_are_followed_each_on_its_own() {
        let ring = |z: f64, radius: f64| {
            (0..36).map(move |k| {
                let turn = std::f64::consts::TAU * f64::from(k) / 36.0;
                [radius * turn.cos(), radius * turn.sin(), z]
            })
        };
        let points: Vec<Point> = ring(0.0, 5.0).chain(ring(20.0, 5.2)).collect();
        let found = two_point_diameters(&points, [0.0; 3], [0.0, 0.0, 1.0], &Silent).unwrap();
        assert_eq!(found.len(), 72);
        for d in &found {
            let expected = if d.ends[0][2] > 10.0 { 10.4 } else { 10.0 };
            assert!((d.size - expected).abs() < 1e-9, "{} {expected}", d.size);
        }
    }

    /// Two rims of a bore, as a tessellated one has them. However little the points of a rim leave their row, the sizes change
    /// by no more than the points do.
    #[test]
    fn noise_changes_sizes_by_no_more_than_itself() {
        let mut random = Random::new(11);
        let rims: Vec<[f64; 3]> = (0..504)
            .map(|k| {
                let turn = std::f64::consts::TAU * (f64::from(k % 252) + 0.3 * random.unit()) / 252.0;
                [7.5 + 0.01 * (3.0 * turn).sin(), turn, 10.0 * f64::from(k / 252)]
            })
            .collect();
        let placed = |shift: &mut dyn FnMut() -> f64| -> Vec<Point> {
            rims.iter().map(|[r, t, z]| [r * t.cos() + shift(), r * t.sin() + shift(), z + shift()]).collect()
        };
        let axis = ([0.0; 3], [0.0, 0.0, 1.0]);
        let sizes = |points: &[Point]| two_point_diameters(points, axis.0, axis.1, &Silent).unwrap();
        for noise in [0.0, 1e-12, 1e-7, 1e-4, 5e-3] {
            let points = placed(&mut || noise * (random.unit() - 0.5));
            let found = sizes(&points);
            assert!(found.len() > 450, "{noise}: {}", found.len());
            for d in &found {
                // The lobes of the rims are opposite to valleys: the size is 15 all around.
                assert!((d.size - 15.0).abs() < 2.0 * noise + 1e-4, "{noise}: {}", d.size);
            }
        }
    }

    /// Places opposite each other but for rounding have the distance of the points themselves, however the axis lies.
    #[test]
    fn points_opposite_each_other_are_the_ends() {
        let turned = |t: f64| (0..36).map(move |k| std::f64::consts::TAU * f64::from(k) / 36.0 + t);
        for start in [0.0, 0.1, 1.0, 2.0] {
            let ring = turned(start).map(|t| [5.0 * t.cos(), 5.1 * t.sin(), 0.0]).collect::<Vec<Point>>();
            let found = two_point_diameters(&ring, [0.0; 3], [0.0, 0.0, -1.0], &Silent).unwrap();
            assert_eq!(found.len(), 36);
            for (k, d) in found.iter().enumerate() {
                let away = minus(ring[(k + 18) % 36], ring[k]);
                assert!((d.size - dot(away, away).sqrt()).abs() < 1e-9, "{start} {k}: {}", d.size);
            }
        }
    }
}
