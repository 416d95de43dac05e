//! Curves given in the parameters of a surface alone, in space.
//!
//! On a line of equal parameters they are that line of the surface. Others become cubics whose ends and tangents are right, halved until they are near
//! enough in the middle.

use super::geometry::Geometry;
use super::surface::Patch;
use crate::formats::brep::Wrong;
use crate::formats::spline::{Raw, cad_curve};
use trueness_cad::curve::{Curve, Span};
use trueness_geom::space::{Point, Vector, minus, norm, plus, times};

/// The share of the file's resolution that a cubic may be off.
const OFF_SHARE: f64 = 0.1;
/// Cubics that one curve is cut into at first.
const PIECES: usize = 4;
/// Halvings at most.
const MAX_CUBIC_HALVINGS: usize = 12;
/// Share of the extent of a line within which its places have equal parameters: rounding of the digits of a file.
const LEVEL: f64 = 1e-9;

impl Geometry<'_> {
    /// The pieces of a curve (`number`) in the parameters of a surface, in space.
    pub fn on_surface(&self, number: u64, patch: &Patch) -> Result<Vec<Span>, Wrong> {
        let record = self.file.record(number)?;
        let Some(how) = patch.parameters else {
            return Err(record.wrong("is given in the parameters of a surface that has none of its own"));
        };
        // Parameters are no lengths.
        let plain = Geometry { unit: 1.0, ..*self };
        let [scale, shift] = how.first;
        let place = |[a, b, _]: [f64; 3]| {
            let a = shift + scale * a;
            if how.is_swapped { [b, a] } else { [a, b] }
        };
        let vector = |[a, b, _]: [f64; 3]| if how.is_swapped { [b, scale * a] } else { [scale * a, b] };
        let mut all = vec![];
        for span in plain.chain(number)? {
            let at = |share: f64| {
                let [p, d, _] = span.derivatives(share);
                (place(p), vector(d))
            };
            let found = match level(patch, &span, &at) {
                Some(found) => found,
                None => self.cubics(patch, &at).ok_or_else(|| {
                    record.wrong(
                        "runs where its surface has no tangents, or turns too often to be drawn in space",
                    )
                })?,
            };
            all.push(found);
        }
        all.retain(|span| (0..5).any(|k| span.derivatives(f64::from(k) / 4.0)[0] != span.ends()[0]));
        Ok(all)
    }

    fn cubics(&self, patch: &Patch, at: &impl Fn(f64) -> ([f64; 2], [f64; 2])) -> Option<Span> {
        let jet = |share: f64| -> (Point, Vector) {
            let ([u, v], [du, dv]) = at(share);
            let jet = patch.surface.jet(u, v);
            (jet.place, plus(times(du, jet.first[0]), times(dv, jet.first[1])))
        };
        let mut points = vec![jet(0.0).0];
        let mut ends = vec![0.0];
        // The next piece first.
        let first = |k: usize| [k as f64 / PIECES as f64, (k as f64 + 1.0) / PIECES as f64];
        let mut pending: Vec<([f64; 2], usize)> = (0..PIECES).rev().map(|k| (first(k), 0)).collect();
        while let Some(([from, to], depth)) = pending.pop() {
            let (width, middle) = ((to - from) / 3.0, 0.5 * (from + to));
            let ([a, da], [b, db]) = (<[Vector; 2]>::from(jet(from)), <[Vector; 2]>::from(jet(to)));
            let inner = [plus(a, times(width, da)), minus(b, times(width, db))];
            let drawn: Point =
                std::array::from_fn(|k| 0.125 * (a[k] + b[k]) + 0.375 * (inner[0][k] + inner[1][k]));
            let off = norm(minus(drawn, jet(middle).0));
            if !off.is_finite() {
                return None;
            }
            if off <= OFF_SHARE * self.tolerance {
                points.extend([inner[0], inner[1], b]);
                ends.push(to);
            } else if depth < MAX_CUBIC_HALVINGS {
                pending.extend([([middle, to], depth + 1), ([from, middle], depth + 1)]);
            } else {
                return None;
            }
        }
        let last = ends.len() - 1;
        let times_of = |k: usize| if k == 0 || k == last { 4 } else { 3 };
        let knots = ends.iter().enumerate().flat_map(|(k, t)| std::iter::repeat_n(*t, times_of(k))).collect();
        let weights = vec![1.0; points.len()];
        let raw = Raw { degree: vec![3], knots: vec![knots], counts: vec![points.len()], points, weights };
        Some(Span { curve: cad_curve(raw).ok()?, range: [0.0, 1.0] })
    }
}

/// A straight line along which one parameter stays the same.
fn level(patch: &Patch, span: &Span, at: &impl Fn(f64) -> ([f64; 2], [f64; 2])) -> Option<Span> {
    if !matches!(span.curve, Curve::Line { .. }) {
        return None;
    }
    let [from, to] = [at(0.0).0, at(1.0).0];
    let moved = [0, 1].map(|k| (to[k] - from[k]).abs());
    let held = usize::from(moved[1] < moved[0]);
    let other = 1 - held;
    if moved[held] > LEVEL * moved[other] {
        return None;
    }
    let curve = patch.surface.iso_curve(held, from[held])?;
    let [low, high] = curve.domain();
    let range = match curve.period() {
        Some(_) => [from[other], to[other]],
        None => [from[other].clamp(low, high), to[other].clamp(low, high)],
    };
    (range[0] != range[1]).then_some(Span { curve, range })
}
