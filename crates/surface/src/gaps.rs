//! Gaps between points that lie in rows, which cross-validation of single points cannot see.
//!
//! A point of a scanner's row is told by its neighbors in the row, whatever the surface does between the rows. So where
//! rows lie far apart for the knots, blocks of the domain wider than a gap are left out. The residuals there of a
//! surface through the other points tell how little weight the thin-plate term may have.

use super::gram::{Binned, Sums};
use super::raster::distances;
use super::stencil::Stencil;
use trueness_geom::num::median::median;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::Point;
use trueness_geom::spline::surface::Patches;

/// Squares to a side of a knot cell at most.
const MAX_SQUARES_PER_CELL_SIDE: usize = 8;
/// Squares along a side of the domain at most.
const MAX_SQUARES_PER_SIDE: usize = 2048;
/// Gaps of this share of a knot cell and less leave no function free.
const WIDE_GAP_CELLS: f64 = 0.5;
/// In rows the square of a gap comes to so many areas of a point, and more. Scattered points have 3.5 and a grid 2.5.
const MIN_GAP_AREA_OF_ROWS: f64 = 5.0;
/// Side of a block, in gaps.
const BLOCK_SIDE_GAPS: f64 = 1.5;

/// Distance of the rows in knot cells, where the points lie in rows and these lie far apart.
///
/// Places between rows are a quarter of their distance from the next row in the median, and holes move it but little.
fn row_distance(data: &Binned) -> Option<f64> {
    let counts = [0, 1].map(|k| data.spans[k].count());
    let fine = (MAX_SQUARES_PER_SIDE / counts[0].max(counts[1])).clamp(1, MAX_SQUARES_PER_CELL_SIDE);
    let [rows, columns] = counts.map(|n| n * fine);
    let mut square = vec![f64::INFINITY; rows * columns];
    for (cell, from, to) in data.items() {
        let first = [cell as usize / counts[1], cell as usize % counts[1]].map(|k| k * fine);
        for local in &data.local[from as usize..to as usize] {
            let [i, j] =
                [0, 1].map(|k| first[k] + ((0.5 * (local[k] + 1.0) * fine as f64) as usize).min(fine - 1));
            square[i * columns + j] = 0.0;
        }
    }
    distances(&mut square, [rows, columns]);
    let median = median(&mut square).unwrap_or(0.0).sqrt() / fine as f64;
    let wide = 4.0 * median;
    let of_a_point = data.cells().0 as f64 / data.len() as f64;
    (wide > WIDE_GAP_CELLS && wide * wide > MIN_GAP_AREA_OF_ROWS * of_a_point).then_some(wide)
}

/// Blocks of the domain in the two colors of a chessboard.
struct Blocks {
    side: usize,
    cells: usize,
    columns: usize,
    /// Whether a block has points.
    filled: Vec<bool>,
}

impl Blocks {
    fn new(data: &Binned, gap: f64) -> Blocks {
        let side = ((BLOCK_SIDE_GAPS * gap).round() as usize).max(2);
        let [rows, columns] = [0, 1].map(|k| data.spans[k].count().div_ceil(side));
        let cells = data.spans[1].count();
        let mut own = Blocks { side, cells, columns, filled: vec![false; rows * columns] };
        for (cell, ..) in data.items() {
            let [i, j] = own.of(cell);
            own.filled[i * columns + j] = true;
        }
        own
    }

    fn of(&self, cell: u32) -> [usize; 2] {
        [cell as usize / self.cells / self.side, cell as usize % self.cells / self.side]
    }

    /// The color of a cell, and whether its block lies between others that have points. Beyond the outermost ones the
    /// surface is free to be anywhere.
    fn part(&self, cell: u32) -> (usize, bool) {
        let [i, j] = self.of(cell);
        let filled = |i: usize, j: usize| {
            j < self.columns && self.filled.get(i * self.columns + j).is_some_and(|f| *f)
        };
        let across = i > 0 && filled(i - 1, j) && filled(i + 1, j);
        let along = j > 0 && filled(i, j - 1) && filled(i, j + 1);
        ((i + j) % 2, across || along)
    }
}

/// Points of one color: their equations, for the residuals of a surface.
struct Color {
    /// The normal equations of all of them.
    normal: Stencil,
    gradient: Vec<Point>,
    /// The equations and sums of those between others.
    inner: (Stencil, Sums),
}

/// Points whose blocks are left out by turns.
pub(super) struct Folds {
    colors: [Color; 2],
}

impl Folds {
    /// The folds for the residuals of `surface` (of points less the center). `None` where these do not lie in rows far
    /// apart, or have no blocks between others.
    pub(super) fn of(
        data: &Binned,
        surface: &Patches,
        progress: &dyn Progress,
    ) -> Result<Option<Folds>, Cancelled> {
        let Some(gap) = row_distance(data) else { return Ok(None) };
        let blocks = Blocks::new(data, gap);
        let color = |color: usize| -> Result<Color, Cancelled> {
            let of =
                |between: bool| data.part(surface, |cell| blocks.part(cell) == (color, between), progress);
            let (mut normal, Sums { right: mut gradient, .. }) = of(false)?;
            let inner = of(true)?;
            normal.add(&inner.0);
            gradient.iter_mut().zip(&inner.1.right).for_each(|(a, b)| (0..3).for_each(|d| a[d] += b[d]));
            Ok(Color { normal, gradient, inner })
        };
        let colors = [color(0)?, color(1)?];
        let both = colors.iter().all(|c| c.inner.0.trace() > 0.0);
        Ok(both.then_some(Folds { colors }))
    }

    /// The equations of the points that are not left out: matrix and right side.
    pub(super) fn kept(&self, fold: usize) -> (&Stencil, &[Point]) {
        let color = &self.colors[1 - fold];
        (&color.normal, &color.gradient)
    }

    /// Sum of the squares that are left of those points left out that lie between others, where the control points change by
    /// so much.
    pub(super) fn left(&self, fold: usize, change: &[Point]) -> f64 {
        let (normal, Sums { right, square, .. }) = &self.colors[fold].inner;
        let moved = normal.times(change);
        let product = |a: &[Point], b: &[Point]| {
            a.iter().zip(b).map(|(a, b)| (0..3).map(|d| a[d] * b[d]).sum::<f64>()).sum::<f64>()
        };
        (square - 2.0 * product(change, right) + product(change, &moved)).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use trueness_geom::num::random::Random;
    use trueness_geom::progress::Silent;
    use trueness_geom::space::{dot, minus};
    use trueness_geom::spline::basis::Knots;

    const SPANS: [usize; 2] = [20, 16];

    fn binned(places: &[[f64; 2]]) -> Binned {
        let knots = [Knots::uniform(3, SPANS[0], 0.0, 100.0), Knots::uniform(2, SPANS[1], 0.0, 80.0)];
        let points: Vec<Point> = places.iter().map(|[x, y]| [*x, *y, libm::sin(x / 9.0) + y / 7.0]).collect();
        Binned::new(&knots, &points, places, [50.0, 40.0, 0.0])
    }

    /// Rows `apart` millimeters from each other at this angle, points on them 0.4 mm apart; without a disk of this radius.
    fn rows(apart: f64, degrees: f64, hole: f64) -> Vec<[f64; 2]> {
        let (s, c) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
        let at = |row: i32, n: i32| {
            let (across, along) =
                (apart * (f64::from(row) + 0.3), 0.4 * f64::from(n) + 0.05 * f64::from(row % 7));
            [c * along - s * across, s * along + c * across]
        };
        let all = (-90..90).flat_map(|row| (-375..375).map(move |n| at(row, n)));
        let inside = |p: &[f64; 2]| (0.0..=100.0).contains(&p[0]) && (0.0..=80.0).contains(&p[1]);
        all.filter(|p| inside(p) && libm::hypot(p[0] - 40.0, p[1] - 40.0) >= hole).collect()
    }

    /// The distance of rows is found at any angle, and beside holes; cells are 5 mm wide. Points that do not lie in
    /// rows have no such distance.
    #[test]
    fn rows_are_told_by_their_distance() {
        for degrees in [0.0, 17.0, 45.0, 90.0] {
            for apart in [4.0, 7.0, 10.0, 16.0] {
                for hole in [0.0, 20.0] {
                    let found = row_distance(&binned(&rows(apart, degrees, hole))).unwrap() * 5.0;
                    assert!(found > 0.75 * apart && found < 1.6 * apart, "{degrees} {apart} {hole}: {found}");
                }
            }
            assert_eq!(row_distance(&binned(&rows(1.5, degrees, 20.0))), None);
        }
        let random = &mut Random::new(3);
        let mut scattered = |count: usize| -> Vec<[f64; 2]> {
            (0..count).map(|_| [100.0 * random.unit(), 80.0 * random.unit()]).collect()
        };
        for count in [60, 300, 3000, 30_000] {
            assert_eq!(row_distance(&binned(&scattered(count))), None, "{count}");
        }
        for step in [1, 5, 10] {
            let grid: Vec<[f64; 2]> = (0..=100 / step)
                .flat_map(|i| (0..=80 / step).map(move |j| [f64::from(i * step), f64::from(j * step)]))
                .collect();
            assert_eq!(row_distance(&binned(&grid)), None, "{step}");
        }
    }

    /// The residual squares of the points left out are those of a sum over them. The points kept in both folds are all
    /// there are.
    #[test]
    fn folds_are_sums_over_their_points() {
        let places = rows(9.0, 17.0, 15.0);
        let data = binned(&places);
        let random = &mut Random::new(5);
        let mut net = || -> Vec<Point> {
            let size = data.counts[0] * data.counts[1];
            (0..size).map(|_| [random.unit(), random.unit(), random.unit()]).collect()
        };
        let (first, change) = (net(), net());
        let surface = |p: &[Point]| Patches::of(data.spans.clone(), p, data.counts[1]);
        let folds = Folds::of(&data, &surface(&first), &Silent).unwrap().unwrap();
        let both: Vec<Point> =
            first.iter().zip(&change).map(|(a, b)| std::array::from_fn(|d| a[d] + b[d])).collect();
        let both = surface(&both);
        let blocks = Blocks::new(&data, row_distance(&data).unwrap());
        for fold in [0, 1] {
            let (mut sum, mut count) = (0.0, 0);
            for (cell, from, to) in data.items() {
                for k in from as usize..to as usize {
                    let [s, t] = data.local[k];
                    let left = minus(data.points[k], both.value(cell as usize, s, t));
                    if blocks.part(cell) == (fold, true) {
                        sum += dot(left, left);
                        count += 1;
                    }
                }
            }
            assert!(
                count > data.len() / 6 && count < 6 * data.len() / 10,
                "{fold}: {count} of {}",
                data.len()
            );
            let own = folds.left(fold, &change);
            assert!((own - sum).abs() < 1e-9 * sum, "{fold}: {own} {sum}");
        }
        let all = data.part(&surface(&first), |_| true, &Silent).unwrap();
        let mut kept = folds.kept(0).0.clone();
        kept.add(folds.kept(1).0);
        for (a, b) in kept.times(&change).iter().zip(all.0.times(&change)) {
            assert!((0..3).all(|d| (a[d] - b[d]).abs() < 1e-9 * (1.0 + b[d].abs())));
        }
        for (k, b) in all.1.right.iter().enumerate() {
            let [p, q] = [0, 1].map(|fold| folds.kept(fold).1[k]);
            assert!((0..3).all(|d| (p[d] + q[d] - b[d]).abs() < 1e-9 * (1.0 + b[d].abs())));
        }
    }
}
