//! Where the search starts: noise, and lines and arcs through parts of a row.

use crate::model::chain::SegmentKind;
use trueness_geom::num::median::median;

/// Half the number of points of a local fit of the noise.
const HALF_WINDOW: usize = 4;

/// Standard deviation of the noise across the row, and the step at which its points are followed. The step is the least
/// power of 2 at which neighbors are four times as far apart as they scatter.
///
/// From local cubics through nine points each, by their median, so that corners and outliers do not count. At greater
/// steps most of them may hold a corner. The least noise counts of all steps at which neighbors are as far apart as
/// they scatter. 0 for rows of fewer than nine points.
pub(crate) fn noise(points: &[[f64; 2]], closed: bool) -> (f64, usize) {
    let (mut step, mut least) = (1, f64::INFINITY);
    loop {
        let thinned: Vec<[f64; 2]> = points.iter().step_by(step).copied().collect();
        let found = noise_of(&thinned, closed);
        let far = |w: &[[f64; 2]]| libm::hypot(w[1][0] - w[0][0], w[1][1] - w[0][1]);
        let mut steps: Vec<f64> = thinned.windows(2).map(far).collect();
        let apart = median(&mut steps).unwrap_or(0.0);
        let found = found.min(least);
        if 4.0 * found <= apart || thinned.len() < 60 {
            return (found, step);
        }
        // Noise makes neighbors farther apart than they are; ends of a local fit far less.
        let mut chords: Vec<f64> =
            thinned.windows(2 * HALF_WINDOW + 1).map(|w| far(&[w[0], w[2 * HALF_WINDOW]])).collect();
        if found <= median(&mut chords).unwrap_or(0.0) / (2 * HALF_WINDOW) as f64 {
            least = found;
        }
        step *= 2;
    }
}

/// The same of a row whose points follow each other.
fn noise_of(points: &[[f64; 2]], closed: bool) -> f64 {
    off_polynomials::<4>(points, closed)
}

/// The same from polynomials of the fifth degree: of a curve without noise far less than from cubics.
pub(crate) fn noise_beyond_form(points: &[[f64; 2]], closed: bool) -> f64 {
    off_polynomials::<6>(points, closed)
}

/// Standard deviation of points about local polynomials of so many coefficients, by the median.
fn off_polynomials<const COEFFICIENTS: usize>(points: &[[f64; 2]], closed: bool) -> f64 {
    let n = points.len();
    let width = 2 * HALF_WINDOW + 1;
    if n < width + usize::from(closed) {
        return 0.0;
    }
    let starts = if closed { n } else { n - width + 1 };
    let window = |i: usize| std::array::from_fn(|k| points[(i + k) % n]);
    let mut all: Vec<f64> = (0..starts).filter_map(|i| mean_square_off::<COEFFICIENTS>(&window(i))).collect();
    let Some(median) = median(&mut all) else { return 0.0 };
    // Median of a chi-squared variable of so many degrees over their number: Wilson and Hilferty.
    let share: f64 = 1.0 - 2.0 / (9 * (width - COEFFICIENTS)) as f64;
    (median / (share * share * share)).sqrt()
}

/// Mean square of the residuals of a polynomial through nine points, across the line through the first and last.
fn mean_square_off<const COEFFICIENTS: usize>(points: &[[f64; 2]; 2 * HALF_WINDOW + 1]) -> Option<f64> {
    let (first, last, middle) = (points[0], points[2 * HALF_WINDOW], points[HALF_WINDOW]);
    let (dx, dy) = (last[0] - first[0], last[1] - first[1]);
    let length = libm::hypot(dx, dy);
    if length == 0.0 || !length.is_finite() {
        return None;
    }
    let (c, s) = (dx / length, dy / length);
    let mut columns = [[0.0; 2 * HALF_WINDOW + 1]; COEFFICIENTS];
    let mut rest = [0.0; 2 * HALF_WINDOW + 1];
    for (i, p) in points.iter().enumerate() {
        let (x, y) = (p[0] - middle[0], p[1] - middle[1]);
        let t = 2.0 * (c * x + s * y) / length;
        columns[0][i] = 1.0;
        (1..COEFFICIENTS).for_each(|k| columns[k][i] = columns[k - 1][i] * t);
        rest[i] = c * y - s * x;
    }
    // Gram and Schmidt.
    for k in 0..COEFFICIENTS {
        for j in 0..k {
            let dot: f64 = (0..rest.len()).map(|i| columns[k][i] * columns[j][i]).sum();
            (0..rest.len()).for_each(|i| columns[k][i] -= dot * columns[j][i]);
        }
        let norm = columns[k].iter().map(|x| x * x).sum::<f64>().sqrt();
        if norm < 1e-9 {
            return None;
        }
        columns[k].iter_mut().for_each(|x| *x /= norm);
        let dot: f64 = (0..rest.len()).map(|i| columns[k][i] * rest[i]).sum();
        (0..rest.len()).for_each(|i| rest[i] -= dot * columns[k][i]);
    }
    Some(rest.iter().map(|r| r * r).sum::<f64>() / (rest.len() - COEFFICIENTS) as f64)
}

/// Part of a row that one line or arc fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part {
    pub kind: SegmentKind,
    /// First point, and the one after the last.
    pub from: usize,
    pub to: usize,
    /// Curvature of the arc, left turns positive.
    pub curvature: f64,
    /// Direction of the line or of the arc's middle.
    pub along: [f64; 2],
    /// Middle of its points.
    pub center: [f64; 2],
}

impl Part {
    /// Direction of the line or arc at a point.
    pub fn heading(&self, at: [f64; 2]) -> [f64; 2] {
        if self.kind == SegmentKind::Line {
            return self.along;
        }
        let radius = 1.0 / self.curvature;
        let center = [self.center[0] - radius * self.along[1], self.center[1] + radius * self.along[0]];
        let out = [at[0] - center[0], at[1] - center[1]];
        let length = libm::hypot(out[0], out[1]).max(f64::MIN_POSITIVE) * self.curvature.signum();
        [-out[1] / length, out[0] / length]
    }
}

/// Sums over the points before each, from the middle of the row, and the sum of the weights. They are x, y, xx, xy, yy,
/// z, xz, yz, zz with z = xx + yy. Each with its rounding loss: a short part of a long row is a small difference of
/// large sums.
pub(crate) struct Sums {
    before: Vec<[[f64; 2]; 10]>,
    middle: [f64; 2],
}

/// Adds to a sum in two parts: the rounded one, and the rounding loss (Knuth).
fn add(sum: &mut [f64; 2], term: f64) {
    let next = sum[0] + term;
    let part = next - sum[0];
    sum[1] += (sum[0] - (next - part)) + (term - part);
    sum[0] = next;
}

impl Sums {
    pub fn new(points: &[[f64; 2]], weights: &[f64]) -> Sums {
        Sums::within(points, weights, &vec![0.0; points.len()])
    }

    /// Sums of points that lie within arcs by this power each, as those of chords do.
    pub fn within(points: &[[f64; 2]], weights: &[f64], powers: &[f64]) -> Sums {
        let n = points.len() as f64;
        let middle = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
        let mut before = Vec::with_capacity(points.len() + 1);
        let mut sum = [[0.0; 2]; 10];
        before.push(sum);
        for ((p, w), power) in points.iter().zip(weights).zip(powers) {
            let (x, y) = (p[0] - middle[0], p[1] - middle[1]);
            let z = x * x + y * y + power;
            let terms = [x, y, x * x, x * y, y * y, z, x * z, y * z, z * z, 1.0];
            (0..10).for_each(|k| add(&mut sum[k], w * terms[k]));
            before.push(sum);
        }
        Sums { before, middle }
    }

    /// The sums over a part.
    fn between(&self, from: usize, to: usize) -> [f64; 10] {
        let (a, b) = (&self.before[from], &self.before[to]);
        std::array::from_fn(|k| (b[k][0] - a[k][0]) + (b[k][1] - a[k][1]))
    }

    /// Line and arc through a part: their sums of squares, the arc's `None` where there is none.
    pub fn fit(&self, from: usize, to: usize) -> (f64, Option<(f64, [f64; 2], f64)>) {
        let d = self.between(from, to);
        let n = d[9].max(f64::MIN_POSITIVE);
        let (mx, my, mz) = (d[0] / n, d[1] / n, d[5] / n);
        let (xx, xy, yy) = (d[2] - n * mx * mx, d[3] - n * mx * my, d[4] - n * my * my);
        let half = 0.5 * (xx - yy);
        let line = (0.5 * (xx + yy) - (half * half + xy * xy).sqrt()).max(0.0);
        // About the part's own middle: z' = z − 2 m·p + |m|².
        let mm = mx * mx + my * my;
        let (xz0, yz0) = (d[6] - mx * d[5], d[7] - my * d[5]);
        let (xz, yz) = (xz0 - 2.0 * (mx * xx + my * xy), yz0 - 2.0 * (mx * xy + my * yy));
        let z = mz - mm;
        let zz0 = d[8] - n * mz * mz;
        let cross = mx * xz0 + my * yz0;
        let square = mx * mx * xx + 2.0 * mx * my * xy + my * my * yy;
        let zz = zz0 - 4.0 * cross + 4.0 * square;
        (
            line,
            circle(n, [xx, xy, yy, xz, yz, zz, z]).map(|(eta, [p, q], radius)| {
                (n * eta, [p + mx + self.middle[0], q + my + self.middle[1]], radius)
            }),
        )
    }

    pub fn part(&self, points: &[[f64; 2]], kind: SegmentKind, from: usize, to: usize) -> Part {
        let d = self.between(from, to);
        let n = d[9].max(f64::MIN_POSITIVE);
        let (mx, my) = (d[0] / n, d[1] / n);
        let (xx, xy, yy) = (d[2] - n * mx * mx, d[3] - n * mx * my, d[4] - n * my * my);
        let angle = 0.5 * libm::atan2(2.0 * xy, xx - yy);
        let (sin, cos) = libm::sincos(angle);
        let (first, last) = (points[from], points[to - 1]);
        let chord = [last[0] - first[0], last[1] - first[1]];
        let turned = if chord[0] * cos + chord[1] * sin < 0.0 { -1.0 } else { 1.0 };
        let mut part = Part {
            kind,
            from,
            to,
            curvature: 0.0,
            along: [turned * cos, turned * sin],
            center: [mx + self.middle[0], my + self.middle[1]],
        };
        if let (SegmentKind::Arc, (_, Some((_, center, radius)))) = (kind, self.fit(from, to)) {
            // The sense of the turn by the area swept about the center.
            let area: f64 = points[from..to]
                .windows(2)
                .map(|w| {
                    (w[0][0] - center[0]) * (w[1][1] - center[1])
                        - (w[0][1] - center[1]) * (w[1][0] - center[0])
                })
                .sum();
            part.curvature = area.signum() / radius;
            let out = points[(from + to) / 2];
            let out = [out[0] - center[0], out[1] - center[1]];
            let length = libm::hypot(out[0], out[1]).max(f64::MIN_POSITIVE);
            let sense = area.signum();
            part.along = [-sense * out[1] / length, sense * out[0] / length];
            part.center = [center[0] + radius * out[0] / length, center[1] + radius * out[1] / length];
        }
        part
    }
}

/// Mean squared distance, center and radius of the circle by Taubin's method, from sums about the middle. These are xx,
/// xy, yy, xz, yz, zz (of deviations from the mean) and the mean of z. `None` where it is straight or has no area.
///
/// Chernov, Circular and Linear Regression, 2010, section 5.8: the least root of the characteristic polynomial by Newton's
/// method from 0. Unlike that of Kåsa, the circle of a short arc is not drawn in, and never fits worse than the line.
pub(crate) fn circle(n: f64, [xx, xy, yy, xz, yz, zz, z]: [f64; 7]) -> Option<(f64, [f64; 2], f64)> {
    let [xx, xy, yy, xz, yz, zz] = [xx, xy, yy, xz, yz, zz].map(|s| s / n);
    let cov = xx * yy - xy * xy;
    let (a3, a2) = (4.0 * z, -3.0 * z * z - (zz + z * z));
    let a1 = zz * z + 4.0 * cov * z - xz * xz - yz * yz;
    let a0 = xz * (xz * yy - yz * xy) + yz * (yz * xx - xz * xy) - zz * cov;
    let (mut x, mut y) = (0.0, a0);
    for _ in 0..20 {
        let slope = a1 + x * (2.0 * a2 + 3.0 * a3 * x);
        let next = x - y / slope;
        if next == x || !next.is_finite() {
            break;
        }
        let value = a0 + next * (a1 + next * (a2 + next * a3));
        if value.abs() >= y.abs() {
            break;
        }
        (x, y) = (next, value);
    }
    let det = x * x - x * z + cov;
    let center = [0.5 * (xz * (yy - x) - yz * xy) / det, 0.5 * (yz * (xx - x) - xz * xy) / det];
    let radius = (center[0] * center[0] + center[1] * center[1] + z).sqrt();
    (radius.is_finite() && cov > 1e-12 * z * z).then_some((x.max(0.0), center, radius))
}

/// Two lines or arcs with a corner between them, and their sum of squares.
pub(crate) struct Halves {
    pub parts: [Part; 2],
    pub sum: f64,
}

/// The lines or arcs of least squares for each two kinds, with `fewest` points on each at least, each fitted by itself.
/// Time grows with the number of points.
pub(crate) fn halves(points: &[[f64; 2]], weights: &[f64], fewest: usize) -> Vec<Halves> {
    use SegmentKind::{Arc, Line};
    let (sums, n) = (Sums::new(points, weights), points.len());
    // The best lines and arcs before and after.
    let mut best = [[(f64::INFINITY, 0); 2]; 2];
    for at in fewest..(n + 1).saturating_sub(fewest) {
        let [before, after] = [sums.fit(0, at), sums.fit(at, n)]
            .map(|(line, arc)| [line, arc.map_or(f64::INFINITY, |(arc, ..)| arc)]);
        for (best, before) in best.iter_mut().zip(before) {
            for (best, after) in best.iter_mut().zip(after) {
                if before + after < best.0 {
                    *best = (before + after, at);
                }
            }
        }
    }
    let kinds = [Line, Arc];
    let pairs = (0..2).flat_map(|i| (0..2).map(move |j| (i, j))).filter(|(i, j)| best[*i][*j].0.is_finite());
    let halves = |(i, j): (usize, usize)| {
        let (sum, at) = best[i][j];
        let parts = [sums.part(points, kinds[i], 0, at), sums.part(points, kinds[j], at, n)];
        Halves { parts, sum }
    };
    pairs.map(halves).collect()
}

/// So many parts of as many points each, as arcs.
pub(crate) fn shares(points: &[[f64; 2]], weights: &[f64], count: usize) -> Vec<Part> {
    let (sums, n) = (Sums::new(points, weights), points.len());
    (0..count).map(|k| sums.part(points, SegmentKind::Arc, k * n / count, (k + 1) * n / count)).collect()
}

/// Standard deviation of the points about the parts of a partition.
pub(crate) fn scatter(points: &[[f64; 2]], weights: &[f64], parts: &[Part]) -> f64 {
    let sums = Sums::new(points, weights);
    let mut all = (0.0, 0.0);
    for part in parts {
        let (line, arc) = sums.fit(part.from, part.to);
        let (sum, unknowns) = match (part.kind, arc) {
            (SegmentKind::Line, _) | (_, None) => (line, 3.0),
            (_, Some((arc, _, _))) => (arc, 4.0),
        };
        all = (all.0 + sum, all.1 + weights[part.from..part.to].iter().sum::<f64>() - unknowns);
    }
    (all.0.max(0.0) / all.1.max(1.0)).sqrt()
}
