//! Parametric splines (112, 114): polynomials by their powers in each segment, which are cubic B-splines exactly.

use super::super::record::Record;
use super::geometry::Geometry;
use crate::formats::brep::Wrong;
use crate::formats::spline::{Raw, cad_curve, surface as spline_surface};
use trueness_cad::curve::Span;
use trueness_geom::space::Point;
use trueness_geom::spline::surface::Nurbs;

/// The degree of each segment.
const CUBIC: usize = 3;

/// A curve (112): kind, continuity, dimensions, segments, breaks, then powers of x, y and z in each segment.
pub(super) fn curve(geometry: &Geometry, record: &Record) -> Result<Span, Wrong> {
    let segments = record.count(3)?;
    let breaks = record.reals(4, segments + 1)?;
    let first = 5 + segments;
    geometry.budget.spend(CUBIC * segments, record)?;
    let mut points = vec![];
    for segment in 0..segments {
        let powers = record.reals(first + 12 * segment, 12)?;
        let width = breaks[segment + 1] - breaks[segment];
        let coordinate =
            |k: usize| bernstein(std::array::from_fn(|i| powers[4 * k + i] * geometry.unit), width);
        let [x, y, z] = [0, 1, 2].map(coordinate);
        points.extend((usize::from(segment > 0)..=CUBIC).map(|i| [x[i], y[i], z[i]]));
    }
    let raw = Raw {
        degree: vec![CUBIC],
        knots: vec![knots(&breaks)],
        counts: vec![points.len()],
        weights: vec![1.0; points.len()],
        points,
    };
    let curve = cad_curve(raw).map_err(|fault| record.wrong(fault.to_string()))?;
    let range = curve.domain();
    Ok(Span { curve, range })
}

/// A surface (114): kind, patches, segments along u and v, breaks, then powers of x, y and z in each patch. Behind the patches of a row along v
/// stands one that has no meaning; some programs leave it out.
pub(super) fn surface(geometry: &Geometry, record: &Record) -> Result<Nurbs, Wrong> {
    let [m, n] = [record.count(2)?, record.count(3)?];
    let breaks = [record.reals(4, m + 1)?, record.reals(5 + m, n + 1)?];
    let first = 6 + m + n;
    let all = m.saturating_mul(n);
    let has_filling =
        record.len() >= first.saturating_add(48usize.saturating_mul(all.saturating_add(m.saturating_sub(1))));
    if all == 0 || record.len() < first.saturating_add(48usize.saturating_mul(all)) {
        return Err(record.wrong(format!("has not the numbers of its {m} × {n} patches")));
    }
    geometry.budget.spend(CUBIC * CUBIC * all, record)?;
    let counts = [CUBIC * m + 1, CUBIC * n + 1];
    let mut points: Vec<Point> = vec![[0.0; 3]; counts[0] * counts[1]];
    for patch in 0..all {
        let (i, j) = (patch / n, patch % n);
        let row = if has_filling { n + 1 } else { n };
        let powers = record.reals(first + 48 * (i * row + j), 48)?;
        let widths = [breaks[0][i + 1] - breaks[0][i], breaks[1][j + 1] - breaks[1][j]];
        for k in 0..3 {
            // Powers of u run first. Each line of them becomes one of Bernstein's, along u and then along v.
            let along_u: [[f64; 4]; 4] = std::array::from_fn(|b| {
                bernstein(std::array::from_fn(|a| powers[16 * k + 4 * b + a] * geometry.unit), widths[0])
            });
            for a in 0..=CUBIC {
                let line = bernstein(std::array::from_fn(|b| along_u[b][a]), widths[1]);
                for (b, value) in line.into_iter().enumerate() {
                    points[(CUBIC * i + a) * counts[1] + CUBIC * j + b][k] = value;
                }
            }
        }
    }
    let raw = Raw {
        degree: vec![CUBIC; 2],
        knots: breaks.iter().map(|b| knots(b)).collect(),
        counts: counts.to_vec(),
        weights: vec![1.0; points.len()],
        points,
    };
    spline_surface(raw).map_err(|fault| record.wrong(fault.to_string()))
}

/// Clamped knots, three times each between.
fn knots(breaks: &[f64]) -> Vec<f64> {
    let last = breaks.len().saturating_sub(1);
    let times = |k: usize| if k == 0 || k == last { CUBIC + 1 } else { CUBIC };
    breaks.iter().enumerate().flat_map(|(k, t)| std::iter::repeat_n(*t, times(k))).collect()
}

/// Bernstein's coefficients of `a + b s + c s² + d s³` over `s` from 0 to `width`.
fn bernstein([a, b, c, d]: [f64; 4], width: f64) -> [f64; 4] {
    let (b, c, d) = (b * width, c * width * width, d * width * width * width);
    [a, a + b / 3.0, a + (2.0 * b + c) / 3.0, a + b + c + d]
}
