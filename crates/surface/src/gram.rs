//! Normal equations, summed cell by cell.
//!
//! Within a knot cell all basis functions are polynomials of its two coordinates `s` and `t`. So a cell has moments
//! `Σ sⁱ tʲ`, `(2p + 1)(2q + 1)` of them, which give its part of the matrix. Its part of the right side follows from
//! `Σ sⁱ tʲ x`. These are fewer products a point than the `(p + 1)²(q + 1)²` of its basis functions. Points are sorted
//! by cell; sums run over blocks of fixed size, and blocks are added in their order.

use super::stencil::Stencil;
use trueness_geom::num::banded::dot;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::simd::widest::widest;
use trueness_geom::space::Point;
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::spans::Spans;
use trueness_geom::spline::surface::Patches;

/// Points that are summed in one go by a thread.
const POINTS_PER_ITEM: usize = 2048;
/// Points whose powers are at hand at a time.
const POINTS_PER_LANE: usize = 64;
/// Goes whose sums wait to be added up.
const ITEMS_WAITING: usize = 256;

/// Points sorted by knot cell.
pub(super) struct Binned {
    pub spans: [Spans; 2],
    /// Control points in both directions.
    pub counts: [usize; 2],
    /// Where each cell starts, and the end.
    starts: Vec<u32>,
    /// Numbers of the points.
    pub order: Vec<u32>,
    /// The place of each point in that order.
    pub rank: Vec<u32>,
    /// Coordinates in the cell, from −1 to 1.
    pub local: Vec<[f64; 2]>,
    /// The points less the center.
    pub points: Vec<Point>,
}

/// The sums of one run over all points.
pub(super) struct Sums {
    /// `Σ N r`.
    pub right: Vec<Point>,
    /// `Σ |r|²`.
    pub square: f64,
}

/// The place in a span with this coordinate from −1 to 1.
pub(super) fn within((low, high): (f64, f64), x: f64) -> f64 {
    (0.5 * (low * (1.0 - x) + high * (1.0 + x))).clamp(low, high)
}

impl Binned {
    pub(super) fn new(
        knots: &[Knots; 2],
        points: &[Point],
        parameters: &[[f64; 2]],
        center: Point,
    ) -> Binned {
        let spans = [Spans::new(&knots[0]), Spans::new(&knots[1])];
        let columns = spans[1].count();
        let cell = |p: &[f64; 2]| (spans[0].span_of(p[0]) * columns + spans[1].span_of(p[1])) as u32;
        let mut rank: Vec<u32> = parameters.par_iter().map(cell).collect();
        let mut starts = vec![0u32; spans[0].count() * columns + 1];
        rank.iter().for_each(|cell| starts[*cell as usize + 1] += 1);
        for k in 1..starts.len() {
            starts[k] += starts[k - 1];
        }
        let mut next = starts.clone();
        for at in &mut rank {
            let place = &mut next[*at as usize];
            *at = *place;
            *place += 1;
        }
        let count = points.len();
        let mut order = vec![0u32; count];
        let mut local = vec![[0.0; 2]; count];
        let mut sorted = vec![[0.0; 3]; count];
        // A thread has places side by side and looks for the points that belong there. Points of a cell are written one
        // after the other, so that the lines of memory being written are few.
        let part = count.div_ceil(rayon::current_num_threads()).max(1);
        let parts =
            order.par_chunks_mut(part).zip(local.par_chunks_mut(part)).zip(sorted.par_chunks_mut(part));
        parts.enumerate().for_each(|(n, ((order, local), sorted))| {
            let first = n * part;
            for (i, at) in rank.iter().enumerate() {
                let at = (*at as usize).wrapping_sub(first);
                if at < order.len() {
                    order[at] = i as u32;
                    local[at] = [0, 1].map(|k| spans[k].locate(parameters[i][k]).1);
                    sorted[at] = std::array::from_fn(|d| points[i][d] - center[d]);
                }
            }
        });
        let counts = [knots[0].count(), knots[1].count()];
        Binned { spans, counts, starts, order, rank, local, points: sorted }
    }

    /// Number of points.
    pub(super) fn len(&self) -> usize {
        self.order.len()
    }
    /// The parameters of the point at this place of the order, in this cell: those given, to rounding.
    pub(super) fn parameters(&self, cell: usize, at: usize) -> [f64; 2] {
        let columns = self.spans[1].count();
        let cell = [cell / columns, cell % columns];
        [0, 1].map(|k| within(self.spans[k].limits(cell[k]), self.local[at][k]))
    }
    /// Cells, and how many of them hold no point.
    pub(super) fn cells(&self) -> (usize, usize) {
        (self.starts.len() - 1, self.starts.windows(2).filter(|w| w[0] == w[1]).count())
    }
    /// Points for a unit of area, over the cells that have any.
    pub(super) fn density(&self) -> f64 {
        let area = |cell: usize| {
            let at = [cell / self.spans[1].count(), cell % self.spans[1].count()];
            4.0 * self.spans[0].half(at[0]) * self.spans[1].half(at[1])
        };
        let filled = self.starts.windows(2).enumerate().filter(|(_, w)| w[0] < w[1]);
        self.len() as f64 / filled.map(|(cell, _)| area(cell)).sum::<f64>()
    }
    /// `Σ |x|²` over the points less the center.
    pub(super) fn square(&self) -> f64 {
        self.points.iter().map(|p| p.iter().map(|x| x * x).sum::<f64>()).sum()
    }

    /// The pieces of work: cell, first point, end.
    pub(super) fn items(&self) -> Vec<(u32, u32, u32)> {
        let mut items = vec![];
        for (cell, w) in self.starts.windows(2).enumerate() {
            for from in (w[0]..w[1]).step_by(POINTS_PER_ITEM) {
                items.push((cell as u32, from, w[1].min(from + POINTS_PER_ITEM as u32)));
            }
        }
        items
    }

    /// The normal equations: `Σ w N Nᵀ`, and the sums of the points less the center.
    pub(super) fn equations(&self, progress: &dyn Progress) -> Result<(Stencil, Sums), Cancelled> {
        let mut normal = Stencil::new(self.counts, [self.spans[0].degree(), self.spans[1].degree()]);
        let sums = self.sums_of(Some(&mut normal), progress, |k, _, _| self.points[k])?;
        Ok((normal, sums))
    }

    /// The sums of the residuals of the `surface` (of points less the center).
    pub(super) fn left_by(&self, surface: &Patches, progress: &dyn Progress) -> Result<Sums, Cancelled> {
        self.sums_of(None, progress, |k, cell, [s, t]| {
            let place = surface.value(cell, s, t);
            std::array::from_fn(|d| self.points[k][d] - place[d])
        })
    }

    /// The sums with other values in place of the points: `value` has the number of a point.
    pub(super) fn sums_with(
        &self,
        progress: &dyn Progress,
        value: impl Fn(u32) -> Point + Sync,
    ) -> Result<Vec<Point>, Cancelled> {
        Ok(self.sums_of(None, progress, |k, _, _| value(self.order[k]))?.right)
    }

    /// The equations of the points in some of the cells, for the residuals of the `surface` (of points less the
    /// center).
    pub(super) fn part(
        &self,
        surface: &Patches,
        cells: impl Fn(u32) -> bool,
        progress: &dyn Progress,
    ) -> Result<(Stencil, Sums), Cancelled> {
        let mut normal = Stencil::new(self.counts, [self.spans[0].degree(), self.spans[1].degree()]);
        let mut items = self.items();
        items.retain(|item| cells(item.0));
        let left = |k: usize, cell: usize, [s, t]: [f64; 2]| {
            let place = surface.value(cell, s, t);
            std::array::from_fn(|d| self.points[k][d] - place[d])
        };
        let sums = self.sums_over(&items, Some(&mut normal), progress, left)?;
        Ok((normal, sums))
    }

    fn sums_of(
        &self,
        normal: Option<&mut Stencil>,
        progress: &dyn Progress,
        value: impl Fn(usize, usize, [f64; 2]) -> Point + Sync,
    ) -> Result<Sums, Cancelled> {
        self.sums_over(&self.items(), normal, progress, value)
    }

    /// The sums over these pieces of work.
    fn sums_over(
        &self,
        items: &[(u32, u32, u32)],
        mut normal: Option<&mut Stencil>,
        progress: &dyn Progress,
        value: impl Fn(usize, usize, [f64; 2]) -> Point + Sync,
    ) -> Result<Sums, Cancelled> {
        let [p, q] = [self.spans[0].degree(), self.spans[1].degree()];
        let mut sums = Sums { right: vec![[0.0; 3]; self.counts[0] * self.counts[1]], square: 0.0 };
        let products = [Products::new(&self.spans[0]), Products::new(&self.spans[1])];
        let moments = if normal.is_some() { (2 * p + 1) * (2 * q + 1) } else { 0 };
        let size = moments + 3 * (p + 1) * (q + 1) + 1;
        let mut cell = vec![0.0; size];
        let mut current = items.first().map_or(0, |i| i.0);
        for batch in items.chunks(ITEMS_WAITING) {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            let found: Vec<Vec<f64>> =
                batch.par_iter().map(|item| self.item(*item, size, moments > 0, &value)).collect();
            for (item, own) in batch.iter().zip(found) {
                if item.0 != current {
                    self.flush(current as usize, &mut cell, &products, normal.as_deref_mut(), &mut sums);
                    current = item.0;
                }
                cell.iter_mut().zip(own).for_each(|(a, b)| *a += b);
            }
        }
        self.flush(current as usize, &mut cell, &products, normal, &mut sums);
        Ok(sums)
    }

    /// The moments of one piece of work: those of the matrix, those of the values, the square.
    fn item(
        &self,
        (cell, from, to): (u32, u32, u32),
        size: usize,
        normal: bool,
        value: &(impl Fn(usize, usize, [f64; 2]) -> Point + Sync),
    ) -> Vec<f64> {
        let [p, q] = [self.spans[0].degree(), self.spans[1].degree()];
        let mut out = vec![0.0; size];
        let mut powers =
            [vec![[0.0f64; POINTS_PER_LANE]; 2 * p + 1], vec![[0.0f64; POINTS_PER_LANE]; 2 * q + 1]];
        let mut values = [[0.0f64; POINTS_PER_LANE]; 3];
        for start in (from as usize..to as usize).step_by(POINTS_PER_LANE) {
            let count = POINTS_PER_LANE.min(to as usize - start);
            // Lanes beyond the last point have no weight.
            let padded = count.next_multiple_of(8);
            let (mut s, mut t) = ([0.0; POINTS_PER_LANE], [0.0; POINTS_PER_LANE]);
            for n in 0..count {
                let k = start + n;
                [s[n], t[n]] = self.local[k];
                let r = value(k, cell as usize, self.local[k]);
                (0..3).for_each(|d| values[d][n] = r[d]);
            }
            powers[0][0][..count].fill(1.0);
            powers[0][0][count..padded].fill(0.0);
            values.iter_mut().for_each(|v| v[count..padded].fill(0.0));
            powers[1][0][..padded].fill(1.0);
            let [a, b] = &mut powers;
            add_moments([(a, &s), (b, &t)], &values, padded, normal, &mut out);
        }
        out
    }

    /// Adds the sums that the moments of a cell come to, and clears them.
    fn flush(
        &self,
        cell: usize,
        moments: &mut [f64],
        products: &[Products; 2],
        normal: Option<&mut Stencil>,
        sums: &mut Sums,
    ) {
        let [p, q] = [self.spans[0].degree(), self.spans[1].degree()];
        let (i, j) = (cell / self.spans[1].count(), cell % self.spans[1].count());
        let corner = self.spans[0].first(i) * self.counts[1] + self.spans[1].first(j);
        let mut at = 0;
        if let Some(normal) = normal {
            let wide = 2 * q + 1;
            at = (2 * p + 1) * wide;
            for a in 0..=p {
                for b in a..=p {
                    let own = products[0].of(i, a, b);
                    let mut row = vec![0.0; wide];
                    for (k, x) in own.iter().enumerate() {
                        row.iter_mut().zip(&moments[k * wide..]).for_each(|(r, m)| *r += x * m);
                    }
                    for c in 0..=q {
                        for d in 0..=q {
                            let sum = dot(products[1].of(j, c.min(d), c.max(d)), &row);
                            normal.row(corner + a * self.counts[1] + c, b - a)[d + q - c] += sum;
                        }
                    }
                }
            }
        }
        let (f, g) = (self.spans[0].polynomials(i), self.spans[1].polynomials(j));
        for d in 0..3 {
            for a in 0..=p {
                for c in 0..=q {
                    let row = |k: usize| dot(&g[c * (q + 1)..][..=q], &moments[at + k * (q + 1)..][..=q]);
                    let sum: f64 = (0..=p).map(|k| f[a * (p + 1) + k] * row(k)).sum();
                    sums.right[corner + a * self.counts[1] + c][d] += sum;
                }
            }
            at += (p + 1) * (q + 1);
        }
        sums.square += moments[at];
        moments.fill(0.0);
    }
}

widest! {
    /// Adds to `out` the moments of the first `count` lanes, if `normal` asks for them, those of the values, and their
    /// square. The lowest powers of both coordinates are given and the others filled in.
    fn add_moments [] [] (
        coordinates: [(&mut [[f64; POINTS_PER_LANE]], &[f64; POINTS_PER_LANE]); 2],
        values: &[[f64; POINTS_PER_LANE]; 3],
        count: usize,
        normal: bool,
        out: &mut [f64],
    ) = {
        let [(a, s), (b, t)] = coordinates;
        raise(a, s);
        raise(b, t);
        let mut at = 0;
        if normal {
            for a in a.iter() {
                for b in b.iter() {
                    out[at] += dot(&a[..count], &b[..count]);
                    at += 1;
                }
            }
        }
        let last = out.len() - 1;
        for v in values {
            let mut weighted = [0.0; POINTS_PER_LANE];
            for a in &a[..a.len().div_ceil(2)] {
                for n in 0..POINTS_PER_LANE {
                    weighted[n] = a[n] * v[n];
                }
                for b in &b[..b.len().div_ceil(2)] {
                    out[at] += dot(&weighted[..count], &b[..count]);
                    at += 1;
                }
            }
            for n in 0..POINTS_PER_LANE {
                weighted[n] = a[0][n] * v[n];
            }
            out[last] += dot(&weighted[..count], &v[..count]);
        }
    }
}

/// Fills in the powers above the lowest one.
#[inline(always)]
fn raise(powers: &mut [[f64; POINTS_PER_LANE]], x: &[f64; POINTS_PER_LANE]) {
    for k in 1..powers.len() {
        let (low, high) = powers.split_at_mut(k);
        for n in 0..POINTS_PER_LANE {
            high[0][n] = low[k - 1][n] * x[n];
        }
    }
}

/// Products of two basis functions on each span, as polynomials.
struct Products {
    degree: usize,
    coefficients: Vec<f64>,
}

impl Products {
    fn new(spans: &Spans) -> Products {
        let p = spans.degree();
        let mut coefficients = vec![];
        for span in 0..spans.count() {
            let own: Vec<&[f64]> = spans.polynomials(span).chunks_exact(p + 1).collect();
            for a in &own {
                for b in &own {
                    let start = coefficients.len();
                    coefficients.resize(start + 2 * p + 1, 0.0);
                    for (k, x) in a.iter().enumerate() {
                        b.iter().enumerate().for_each(|(l, y)| coefficients[start + k + l] += x * y);
                    }
                }
            }
        }
        Products { degree: p, coefficients }
    }
    fn of(&self, span: usize, a: usize, b: usize) -> &[f64] {
        let (n, wide) = (self.degree + 1, 2 * self.degree + 1);
        &self.coefficients[((span * n + a) * n + b) * wide..][..wide]
    }
}
