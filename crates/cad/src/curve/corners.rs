//! Where a curve may bend suddenly.

use super::kinds::Curve;

impl Curve {
    /// Parameters within its domain at which a derivative may jump, ascending: knots, and ends of pieces.
    pub fn corners(&self) -> Vec<f64> {
        let inner = |all: Vec<f64>| all.get(1..all.len().max(2) - 1).unwrap_or_default().to_vec();
        match self {
            Curve::Spline(spline) => inner(spline.knots().distinct()),
            Curve::Rational(rational) => inner(rational.masses().knots().distinct()),
            Curve::Polyline(points) => (1..points.len().saturating_sub(1)).map(|k| k as f64).collect(),
            Curve::Joined(spans) => {
                let mut all = vec![];
                for (k, span) in spans.iter().enumerate() {
                    let [from, to] = span.range;
                    let share = |t: &f64| (t - from) / (to - from);
                    let mut own: Vec<f64> = span.curve.corners().iter().map(share).collect();
                    own.retain(|s| *s > 0.0 && *s < 1.0);
                    own.sort_by(f64::total_cmp);
                    all.extend(own.iter().map(|s| k as f64 + s));
                    all.extend((k + 1 < spans.len()).then_some((k + 1) as f64));
                }
                all
            }
            _ => vec![],
        }
    }
}
