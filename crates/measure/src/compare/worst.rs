//! The worst places, far from one another, out of any number of points in one pass.
//!
//! The surroundings of the reference are cut into cells; each cell keeps its highest and its lowest deviation. What is asked for in the
//! end is picked from these. So a single bad region does not fill the list, however many points it has.

use trueness_document::tolerance::badness;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point, minus, norm};

/// Cells along each side.
const CELLS_PER_SIDE: usize = 32;
/// Points that one task sorts into cells of its own.
const POINTS_PER_TASK: usize = 1 << 18;
/// Picked places are at least this share of the reference's diagonal apart.
const MIN_DISTANCE_DIAGONAL_SHARE: f64 = 0.05;

/// A measured point with its deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPoint {
    /// Number of the point, from 0 in file order.
    pub index: u64,
    /// The point, millimeters.
    pub point: Point,
    /// Its deviation, millimeters.
    pub deviation: f64,
    /// How bad it is: the size of the deviation, or how far it is beyond the tolerance of its region.
    pub badness: f64,
    /// Number of its region, counted from 1; 0 for none.
    pub region: u16,
}

/// Highest and lowest deviation of each cell around a reference.
pub struct WorstPlaces {
    origin: Point,
    per_cell: Point,
    diagonal: f64,
    cells: Vec<Option<WorstPoint>>,
}

impl WorstPlaces {
    /// For a reference of these bounds. Points outside count for the nearest cell at the rim.
    pub fn new(bounds: &Aabb) -> WorstPlaces {
        let sides = bounds.sides();
        let per_cell = sides.map(|s| if s > 0.0 { CELLS_PER_SIDE as f64 / s } else { 0.0 });
        WorstPlaces { origin: bounds.min, per_cell, diagonal: bounds.diagonal(), cells: Self::empty() }
    }

    fn empty() -> Vec<Option<WorstPoint>> {
        vec![None; 2 * CELLS_PER_SIDE * CELLS_PER_SIDE * CELLS_PER_SIDE]
    }

    /// Takes a block of points whose first has number `start`. A deviation that is none, NaN or infinite, is passed over.
    /// `judged(i)` is how bad point `i` of the block is, and its region.
    pub fn add(
        &mut self,
        start: u64,
        points: &[Point],
        deviations: &[f64],
        judged: impl Fn(usize) -> (f64, u16) + Sync,
    ) {
        let sort = |n: usize, (points, deviations): (&[Point], &[f64])| {
            let mut cells = Self::empty();
            for (i, (point, &deviation)) in points.iter().zip(deviations).enumerate() {
                if !deviation.is_finite() {
                    continue;
                }
                let at = n * POINTS_PER_TASK + i;
                let (badness, region) = judged(at);
                let place =
                    WorstPoint { index: start + at as u64, point: *point, deviation, badness, region };
                if deviation > 0.0 {
                    keep(&mut cells[2 * self.cell(point)], place);
                } else if deviation < 0.0 {
                    keep(&mut cells[2 * self.cell(point) + 1], place);
                }
            }
            cells
        };
        let parts =
            points.par_chunks(POINTS_PER_TASK).zip(deviations.par_chunks(POINTS_PER_TASK)).enumerate();
        let found: Vec<_> = parts.map(|(n, part)| sort(n, part)).collect();
        for place in found {
            for (mine, other) in self.cells.iter_mut().zip(place) {
                if let Some(p) = other {
                    keep(mine, p);
                }
            }
        }
    }

    fn cell(&self, p: &Point) -> usize {
        let at = |k: usize| (((p[k] - self.origin[k]) * self.per_cell[k]) as usize).min(CELLS_PER_SIDE - 1);
        (at(0) * CELLS_PER_SIDE + at(1)) * CELLS_PER_SIDE + at(2)
    }

    /// The `n` highest and the `n` lowest places that are not near one another, worst first.
    pub fn pick(&self, n: usize) -> [Vec<WorstPoint>; 2] {
        [0, 1].map(|side| {
            let mut all: Vec<WorstPoint> =
                self.cells.iter().skip(side).step_by(2).flatten().copied().collect();
            all.sort_by(|a, b| b.badness.total_cmp(&a.badness).then(a.index.cmp(&b.index)));
            let mut picked: Vec<WorstPoint> = vec![];
            for p in all {
                let apart = picked
                    .iter()
                    .all(|q| norm(minus(p.point, q.point)) >= MIN_DISTANCE_DIAGONAL_SHARE * self.diagonal);
                if picked.len() < n && apart {
                    picked.push(p);
                }
            }
            picked
        })
    }
}

/// Puts places into the order in which people look at them: the farthest beyond the tolerance first, without one the
/// greatest deviation; of equally bad ones, the first in the file.
pub fn sort(places: &mut [WorstPoint], zone: Option<[f64; 2]>) {
    let bad = |p: &WorstPoint| badness(p.deviation, zone);
    places.sort_by(|a, b| bad(b).total_cmp(&bad(a)).then(a.index.cmp(&b.index)));
}

/// The worse one stays; of equal ones, the first in the file.
fn keep(cell: &mut Option<WorstPoint>, p: WorstPoint) {
    let better = cell.is_none_or(|c| p.badness > c.badness || (p.badness == c.badness && p.index < c.index));
    if better {
        *cell = Some(p);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_regions_and_not_neighbors() {
        let bounds = Aabb { min: [0.0; 3], max: [100.0, 100.0, 0.0] };
        let mut w = WorstPlaces::new(&bounds);
        // A plate with two dents and one bump, 10,000 points a block, in two blocks.
        let height = |x: f64, y: f64| {
            let hill = |cx: f64, cy: f64, h: f64| h * (-((x - cx).powi(2) + (y - cy).powi(2)) / 8.0).exp();
            hill(20.0, 20.0, 0.5) - hill(70.0, 30.0, 0.4) - hill(80.0, 90.0, 0.6)
        };
        let points: Vec<Point> =
            (0..20_000).map(|i| [(i % 200) as f64 * 0.5, (i / 200) as f64, 0.0]).collect();
        let deviations: Vec<f64> = points.iter().map(|p| height(p[0], p[1])).collect();
        // Two that have none.
        let mut deviations = deviations;
        (deviations[5], deviations[700]) = (f64::NAN, f64::INFINITY);
        let (first, rest) = deviations.split_at(9_000);
        w.add(0, &points[..9_000], first, |i| (first[i].abs(), 0));
        w.add(9_000, &points[9_000..], rest, |i| (rest[i].abs(), 0));
        let [high, low] = w.pick(2);
        assert_eq!(high[0].point, [20.0, 20.0, 0.0]);
        assert_eq!(high[0].index, 20 * 200 + 40);
        assert_eq!((low[0].point, low[1].point), ([80.0, 90.0, 0.0], [70.0, 30.0, 0.0]));
    }

    #[test]
    fn what_fails_comes_before_what_does_not() {
        let order = |zone| {
            let of = |(index, deviation): (u64, f64)| WorstPoint {
                index,
                point: [0.0; 3],
                deviation,
                badness: deviation.abs(),
                region: 0,
            };
            let mut places: Vec<WorstPoint> =
                (0..).zip([0.039, 0.02, 0.01, -0.495, -0.07, 0.07]).map(of).collect();
            sort(&mut places, zone);
            places.iter().map(|p| p.index).collect::<Vec<_>>()
        };
        assert_eq!(order(Some([-0.05, 0.05])), [3, 4, 5, 0, 1, 2]);
        assert_eq!(order(None), [3, 4, 5, 0, 1, 2]);
        // Below −0.06 is out, up to 0.1 is in: what is smaller may be worse.
        assert_eq!(order(Some([-0.06, 0.1])), [3, 4, 5, 0, 2, 1]);
        assert_eq!(order(Some([-0.5, 0.03])), [5, 0, 3, 1, 2, 4]);
    }

    #[test]
    fn first_in_the_file_wins_a_tie() {
        let mut w = WorstPlaces::new(&Aabb { min: [0.0; 3], max: [1.0; 3] });
        w.add(0, &[[0.5; 3], [0.5001; 3], [f64::MAX; 3]], &[1.0, 1.0, f64::NAN], |_| (1.0, 0));
        let [high, low] = w.pick(3);
        assert_eq!((high.len(), high[0].index, low.len()), (1, 0, 0));
    }
}
