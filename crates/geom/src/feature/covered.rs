//! How much of a nominal feature the points of a cloud cover.

use super::rules::Rules;
use super::{Nearness, Nominal};
use crate::rigid::Rigid;
use crate::space::{Aabb, Point, Vector, cross, least_axis, minus, norm, plus, times, unit};
use crate::spatial::neighbors::{Neighbor, PointTree};
use std::f64::consts::TAU;

/// Places that are asked. The share is known to about a hundredth.
const COVERAGE_PLACES: usize = 4096;
/// The neighbor whose distance tells how far points lie apart, of many points.
const SPACING_NEIGHBOR: usize = 12;
/// The same of few, which are probed one by one.
const NEIGHBOR_OF_FEW: usize = 2;
/// So many points for each neighbor.
const POINTS_PER_NEIGHBOR: usize = 20;
/// Sine of the angle to the direction of a row within which neighbors lie in the row. Rows of a scanner are farther apart than
/// points in a row: there the first neighbor beside the row tells.
const MAX_ROW_SINE: f64 = 0.3;
/// Neighbors among which that is looked for, at most.
const MAX_ROW_NEIGHBORS: usize = 384;
/// Points of a cloud that are asked how far they lie apart.
const MAX_ASKED_POINTS: usize = 2048;
/// Share of these points that lie no farther apart.
const COVERED_QUANTILE: f64 = 0.99;
/// Distance that a point may cover over that spacing: a wall is hit at a slant.
const SLANT_FACTOR: f64 = 2.0;
/// Share of the size of a feature up to which a distance is none.
const NO_SIZE_SHARE: f64 = 1e-6;
/// Steps of the sequence of places: powers of the root of x³ = x + 1, which leaves the least gaps in two dimensions. (M.
/// Roberts, The unreasonable effectiveness of quasirandom sequences, 2018.)
const PLACE_STEPS: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053_3];

/// Share of the area of a nominal feature, 0 to 1, that is near one of `points`, which were found for it. A place is near if it
/// is nearer to that point, seen along the surface, than the point's twelfth neighbor is and than `farthest`
/// ([`farthest_covered`]). With fewer than 240 points a nearer neighbor counts, the second at least; for points in rows it is
/// the first one outside the row. Points beyond its bounds cover none of it. Holes of the feature that its nominal form does
/// not have are not covered. `None` of an edge and of a nominal feature that makes no sense, 0 without points.
///
/// Cost: a search tree of the points, and some thousand nearest neighbors.
///
/// ```
/// use trueness_geom::feature::{Nominal, covered};
/// let boundary = vec![[0.0, 0.0, 0.0], [20.0, 0.0, 0.0], [20.0, 20.0, 0.0], [0.0, 20.0, 0.0]];
/// let floor = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary };
/// // The left half of it, in steps of 0.2.
/// let points: Vec<[f64; 3]> = (0..5000).map(|i| [0.2 * f64::from(i % 50), 0.2 * f64::from(i / 50), 0.01]).collect();
/// let share = covered(&floor, &points, f64::INFINITY).unwrap();
/// assert!((share - 0.5).abs() < 0.06, "{share}");
/// ```
pub fn covered(nominal: &Nominal, points: &[Point], farthest: f64) -> Option<f64> {
    let surface = nominal.surface()?;
    let foot = |p: &Point| surface.distance(*p).map(|(off, way)| minus(*p, times(off, way)));
    let inside = on_surface(nominal);
    let rules = Rules::new(nominal, &inside).ok()?;
    let feet: Vec<Point> = points.iter().filter_map(foot).filter(|p| rules.point(*p)).collect();
    let tree = PointTree::new(&feet);
    let places = spread(nominal, &rules)?;
    if feet.is_empty() {
        return Some(0.0);
    }
    let farthest = farthest * farthest;
    // Each point covers as far as its own neighbors are: somewhere they may lie a hundred times as dense.
    let covers = |n: u32| reach(&feet, &tree, n).min(farthest);
    let is_near = |p: &&Point| tree.nearest(p).is_some_and(|(square, n)| square <= covers(n));
    let near = places.iter().filter(is_near).count();
    Some(near as f64 / places.len() as f64)
}

/// How far at most one point of a cloud covers a surface, mm: twice as far as nearly all of them do. A handful of points of a scan
/// that has thousands elsewhere covers nothing. Infinite for fewer than two points.
///
/// Cost: some thousand nearest neighbors.
///
/// ```
/// use trueness_geom::{feature::farthest_covered, spatial::neighbors::PointTree};
/// let points: Vec<[f64; 3]> = (0..10_000).map(|i| [0.2 * f64::from(i % 100), 0.2 * f64::from(i / 100), 0.0]).collect();
/// let farthest = farthest_covered(&points, &PointTree::new(&points));
/// assert!(farthest > 2.0 * 0.4 && farthest < 2.0 * 1.0, "{farthest}");
/// ```
pub fn farthest_covered(points: &[Point], tree: &PointTree) -> f64 {
    if points.len() < 2 {
        return f64::INFINITY;
    }
    let asked = (0..points.len() as u32).step_by(points.len().div_ceil(MAX_ASKED_POINTS));
    let mut all: Vec<f64> = asked.map(|n| reach(points, tree, n)).collect();
    all.sort_unstable_by(f64::total_cmp);
    SLANT_FACTOR * all[(COVERED_QUANTILE * (all.len() - 1) as f64) as usize].sqrt()
}

/// Square of how far one of some points covers: its twelfth neighbor or, of points in rows, the first one beside the row.
fn reach(points: &[Point], tree: &PointTree, n: u32) -> f64 {
    let neighbor =
        (points.len() / POINTS_PER_NEIGHBOR).clamp(NEIGHBOR_OF_FEW, SPACING_NEIGHBOR).min(points.len() - 1);
    let around = tree.k_nearest(&points[n as usize], neighbor, Some(n));
    let last = around.last().copied().unwrap_or((0.0, n));
    if neighbor < SPACING_NEIGHBOR {
        return last.0;
    }
    let from = |q: u32| minus(points[q as usize], points[n as usize]);
    let Some((row, _)) = unit(from(last.1)) else { return last.0 };
    let is_beside = |(_, q): &Neighbor| norm(cross(from(*q), row)) > MAX_ROW_SINE * norm(from(*q));
    if around.iter().any(is_beside) {
        return last.0;
    }
    let more = tree.k_nearest(&points[n as usize], MAX_ROW_NEIGHBORS, Some(n));
    more.into_iter().find(is_beside).map_or(last.0, |beside| beside.0)
}

/// Places on a nominal feature and within its bounds.
fn on_surface(nominal: &Nominal) -> Nearness {
    let rounding = NO_SIZE_SHARE * nominal.area().unwrap_or(0.0).sqrt();
    Nearness { distance: rounding, angle: 1.0, margin: -rounding, rim: true, inward: None }
}

/// Places spread evenly over a nominal feature; `None` of an edge and of what makes no sense.
fn spread(nominal: &Nominal, rules: &Rules) -> Option<Vec<Point>> {
    let fractions = (1..=COVERAGE_PLACES).map(|n| PLACE_STEPS.map(|step| (step * n as f64).fract()));
    let about =
        |axis: Vector| Rigid::into_frame([0.0; 3], axis, least_axis(axis)).map(|frame| frame.inverse());
    let polar =
        |turn: f64, radius: f64, z: f64| [radius * libm::cos(TAU * turn), radius * libm::sin(TAU * turn), z];
    let places: Vec<Point> = match nominal {
        Nominal::Plane { point, normal, boundary } => {
            let frame = about(unit(*normal)?.0)?;
            let seen: Vec<Point> =
                boundary.iter().map(|p| frame.inverse().vector(minus(*p, *point))).collect();
            let bounds = Aabb::of(&seen);
            let within = |k: usize, t: f64| bounds.min[k] + t * (bounds.max[k] - bounds.min[k]);
            fractions
                .map(|[s, t]| plus(*point, frame.vector([within(0, s), within(1, t), 0.0])))
                .filter(|p| rules.point(*p))
                .collect()
        }
        Nominal::Cylinder { point, direction, radius, length } => {
            let frame = about(unit(*direction)?.0)?;
            fractions.map(|[s, t]| plus(*point, frame.vector(polar(s, *radius, t * length)))).collect()
        }
        Nominal::Cone { apex, direction, half_angle, between: [from, to] } => {
            let frame = about(unit(*direction)?.0)?;
            // As much area as the radius grows.
            let along = |t: f64| (from * from + t * (to * to - from * from)).sqrt();
            fractions
                .map(|[s, t]| {
                    plus(*apex, frame.vector(polar(s, along(t) * libm::tan(*half_angle), along(t))))
                })
                .collect()
        }
        Nominal::Sphere { center, radius } => fractions
            .map(|[s, t]| {
                let z = 2.0 * t - 1.0;
                plus(*center, times(*radius, polar(s, (1.0 - z * z).max(0.0).sqrt(), z)))
            })
            .collect(),
        Nominal::Edge { .. } => return None,
    };
    (!places.is_empty()).then_some(places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::dot;

    /// Places are on the feature and as many in each tenth of its area.
    #[test]
    fn places_are_spread_evenly() {
        let direction = [0.48, -0.6, 0.64];
        let cone = Nominal::Cone { apex: [1.0, 2.0, 3.0], direction, half_angle: 0.4, between: [2.0, 5.0] };
        let surface = cone.surface().unwrap();
        let spread =
            |nominal: &Nominal| spread(nominal, &Rules::new(nominal, &on_surface(nominal)).unwrap()).unwrap();
        let places = spread(&cone);
        assert_eq!(places.len(), COVERAGE_PLACES);
        let mut tenths = [0usize; 10];
        for p in places {
            assert!(surface.distance(p).unwrap().0.abs() < 1e-12);
            let along = dot(minus(p, [1.0, 2.0, 3.0]), direction);
            tenths[(10.0 * (along * along - 4.0) / 21.0) as usize] += 1;
        }
        assert!(tenths.iter().all(|n| n.abs_diff(COVERAGE_PLACES / 10) < 12), "{tenths:?}");
        let sphere = Nominal::Sphere { center: [0.0; 3], radius: 2.0 };
        let heights = |from: f64| spread(&sphere).iter().filter(|p| p[2] > from).count();
        assert!(
            heights(0.0).abs_diff(COVERAGE_PLACES / 2) < 12
                && heights(1.0).abs_diff(COVERAGE_PLACES / 4) < 12
        );
        assert!(spread(&sphere).iter().all(|p| (norm(*p) - 2.0).abs() < 1e-12));
    }

    /// A share of a cylinder, sparse and dense, on its place and beside it; a few points in a corner.
    #[test]
    fn the_share_is_that_of_the_area_near_points() {
        let bore =
            Nominal::Cylinder { point: [0.0; 3], direction: [0.0, 0.0, 2.0], radius: 5.0, length: 20.0 };
        for (count, off) in [(40, 0.0), (200, 0.0), (200, 0.05)] {
            for share in [0.1, 0.5, 0.9] {
                let at = |i: usize, j: usize| {
                    let turn = TAU * share * i as f64 / count as f64;
                    [5.0 * libm::cos(turn) + off, 5.0 * libm::sin(turn), 20.0 * j as f64 / count as f64]
                };
                let points: Vec<Point> = (0..count * count).map(|n| at(n % count, n / count)).collect();
                let found = covered(&bore, &points, f64::INFINITY).unwrap();
                // Both ends are widened by the reach, some steps.
                let wider = 2.0 * 3.0 / count as f64;
                assert!(found >= share - 0.01 && found <= share + wider, "{count} {off} {share}: {found}");
            }
        }
        let few: Vec<Point> = (0..5).map(|k| [5.0, 0.1 * f64::from(k), 0.1 * f64::from(k * k % 3)]).collect();
        assert!(covered(&bore, &few, f64::INFINITY).unwrap() < 0.03);
        // Rows forty times as far apart as their points, over all of it and over a fifth.
        for share in [0.2, 1.0] {
            let at = |i: usize, j: usize| {
                let turn = TAU * (i as f64 / 800.0);
                [5.0 * libm::cos(turn), 5.0 * libm::sin(turn), 20.0 * share * j as f64 / 12.0]
            };
            let points: Vec<Point> = (0..800 * 13).map(|n| at(n % 800, n / 800)).collect();
            let found = covered(&bore, &points, f64::INFINITY).unwrap();
            assert!(found >= share - 0.01 && found <= share + 0.1, "{share}: {found}");
        }
        // Twelve places around it, in three rings, are all of it; in a sixth of the turn they are no fourth.
        let probed = |share: f64| -> Vec<Point> {
            let at = |k: i32| {
                let turn = TAU * share * f64::from(k % 4) / 4.0;
                [5.0 * libm::cos(turn), 5.0 * libm::sin(turn), 3.0 + 7.0 * f64::from(k / 4)]
            };
            (0..12).map(at).collect()
        };
        let [all, part] = [1.0, 0.1].map(|share| covered(&bore, &probed(share), f64::INFINITY).unwrap());
        assert!(all > 0.9 && part < 0.2, "{all} {part}");
        // A ring of a table around a floor covers nothing of it, and the points of a sphere are on it.
        let boundary = vec![[0.0, 0.0, 0.0], [20.0, 0.0, 0.0], [20.0, 20.0, 0.0], [0.0, 20.0, 0.0]];
        let floor = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary };
        let table = (0..44 * 44).map(|n| [f64::from(n % 44) - 12.0, f64::from(n / 44) - 12.0, 0.0]);
        let ring: Vec<Point> = table.filter(|p| [0, 1].iter().any(|k| p[*k] < 0.0 || p[*k] > 20.0)).collect();
        assert_eq!(covered(&floor, &ring, f64::INFINITY), Some(0.0));
        let ball = Nominal::Sphere { center: [1e3, 2e3, 3e3], radius: 2.0 };
        let around: Vec<Point> =
            (0..2000).map(|n| plus([1e3, 2e3, 3e3], times(2.001, on_ball(f64::from(n) / 2000.0)))).collect();
        assert!(covered(&ball, &around, f64::INFINITY).unwrap() > 0.95);
        // Not where the scan has a hundred times as many elsewhere.
        let floor = (0..10_000).map(|n| [50.0 + 0.3 * f64::from(n % 100), 0.3 * f64::from(n / 100), 0.0]);
        let scan: Vec<Point> = probed(1.0).into_iter().chain(floor).collect();
        let farthest = farthest_covered(&scan, &PointTree::new(&scan));
        assert!(covered(&bore, &probed(1.0), farthest).unwrap() < 0.2);
        assert!(
            covered(&bore, &probed(1.0), farthest_covered(&probed(1.0), &PointTree::new(&probed(1.0))))
                .unwrap()
                > 0.9
        );
        assert_eq!(covered(&bore, &few[..1], f64::INFINITY), Some(0.0));
        assert_eq!(covered(&bore, &[], f64::INFINITY), Some(0.0));
    }

    /// Places in a spiral over a ball of radius 1.
    fn on_ball(t: f64) -> Point {
        let z = 2.0 * t - 1.0;
        let (turn, radius) = (TAU * 1000.0 * t * 0.618, (1.0 - z * z).sqrt());
        [radius * libm::cos(turn), radius * libm::sin(turn), z]
    }
}
