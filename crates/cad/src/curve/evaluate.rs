//! Places and derivatives of curves.

use super::kinds::{Curve, Span};
use crate::frame::Frame;
use std::f64::consts::TAU;
use trueness_geom::space::{Point, Vector, minus, plus, times};

impl Curve {
    /// The place at `t`; outside of its domain that of its nearest end.
    pub fn at(&self, t: f64) -> Point {
        self.derivatives(t)[0]
    }

    /// Place, first and second derivative at `t`; at a corner those of the piece that begins there.
    pub fn derivatives(&self, t: f64) -> [Vector; 3] {
        match self {
            Curve::Line { origin, direction } => {
                [std::array::from_fn(|k| origin[k] + t * direction[k]), *direction, [0.0; 3]]
            }
            Curve::Circle { frame, radius } => {
                let [c, s] = [radius * libm::cos(t), radius * libm::sin(t)];
                in_frame(frame, [c, s], [-s, c], [-c, -s])
            }
            Curve::Ellipse { frame, radii: [a, b] } => {
                let (c, s) = (libm::cos(t), libm::sin(t));
                in_frame(frame, [a * c, b * s], [-a * s, b * c], [-a * c, -b * s])
            }
            Curve::Hyperbola { frame, radii: [a, b] } => {
                let (c, s) = (libm::cosh(t), libm::sinh(t));
                in_frame(frame, [a * c, b * s], [a * s, b * c], [a * c, b * s])
            }
            Curve::Parabola { frame, focal: f } => {
                in_frame(frame, [f * t * t, 2.0 * f * t], [2.0 * f * t, 2.0 * f], [2.0 * f, 0.0])
            }
            Curve::Spline(spline) => {
                let mut out = [[0.0; 3]; 3];
                spline.derivatives_into(t, &mut out);
                out
            }
            Curve::Rational(rational) => match rational.derivatives(t, 2).as_deref() {
                Some(&[place, first, second]) => [place, first, second],
                _ => [[f64::NAN; 3]; 3],
            },
            Curve::Polyline(points) => {
                let (k, share) = piece(t, points.len().saturating_sub(1));
                let [Some(a), Some(b)] = [points.get(k), points.get(k + 1)] else {
                    return [[f64::NAN; 3]; 3];
                };
                let side = minus(*b, *a);
                [std::array::from_fn(|i| a[i] + share * side[i]), side, [0.0; 3]]
            }
            Curve::Joined(spans) => {
                let (k, share) = piece(t, spans.len());
                spans.get(k).map_or([[f64::NAN; 3]; 3], |span| span.derivatives(share))
            }
        }
    }

    /// First and last parameter; infinite for lines, hyperbolas and parabolas, one turn for circles and ellipses.
    pub fn domain(&self) -> [f64; 2] {
        match self {
            Curve::Line { .. } | Curve::Hyperbola { .. } | Curve::Parabola { .. } => {
                [f64::NEG_INFINITY, f64::INFINITY]
            }
            Curve::Circle { .. } | Curve::Ellipse { .. } => [0.0, TAU],
            Curve::Spline(spline) => spline.domain().into(),
            Curve::Rational(rational) => rational.masses().domain().into(),
            Curve::Polyline(points) => [0.0, points.len().saturating_sub(1) as f64],
            Curve::Joined(spans) => [0.0, spans.len() as f64],
        }
    }

    /// The turn after which a circle or an ellipse repeats. Other curves that close have two ends at one place; an edge that
    /// goes over these is [`Curve::Joined`].
    pub fn period(&self) -> Option<f64> {
        matches!(self, Curve::Circle { .. } | Curve::Ellipse { .. }).then_some(TAU)
    }
}

impl Span {
    /// Place and derivatives at a share of the way from its start, 0 to 1.
    pub fn derivatives(&self, share: f64) -> [Vector; 3] {
        let [from, to] = self.range;
        let rate = to - from;
        let [place, first, second] = self.curve.derivatives(from + share * rate);
        [place, times(rate, first), times(rate * rate, second)]
    }

    /// Start and end.
    pub fn ends(&self) -> [Point; 2] {
        self.range.map(|t| self.curve.at(t))
    }
}

/// The vectors of a plane curve in the plane of a frame.
fn in_frame(frame: &Frame, place: [f64; 2], first: [f64; 2], second: [f64; 2]) -> [Vector; 3] {
    let flat = |[a, b]: [f64; 2]| frame.vector([a, b, 0.0]);
    [plus(frame.origin, flat(place)), flat(first), flat(second)]
}

/// The piece that a parameter of a chain of pieces falls on, and its share of the way along it.
fn piece(t: f64, pieces: usize) -> (usize, f64) {
    let index = (t.max(0.0) as usize).min(pieces.saturating_sub(1));
    (index, (t - index as f64).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::space::norm;
    use trueness_geom::spline::{basis::Knots, curve::Curve as Spline, rational::Rational};

    /// One of each kind, with a range to try it in.
    fn curves() -> Vec<Span> {
        let frame = Frame::new([1.0, -2.0, 0.5], [0.3, 0.4, 1.0], Some([1.0, 0.2, 0.0])).unwrap();
        let points = [[0.0, 0.0, 0.0], [1.0, 2.0, 0.0], [3.0, 1.0, 1.0], [4.0, 0.0, 2.0]];
        let knots = Knots::uniform(3, 1, 0.0, 2.0);
        let weighted: Vec<_> = points.iter().zip([1.0, 0.5, 2.0, 1.0]).map(|(p, w)| (*p, w)).collect();
        let circle = Curve::Circle { frame, radius: 2.0 };
        let mut all = vec![
            (Curve::Line { origin: [1.0, 2.0, 3.0], direction: [0.5, 0.0, -2.0] }, [-1.0, 3.0]),
            (circle.clone(), [5.0, -1.0]),
            (Curve::Ellipse { frame, radii: [3.0, 1.0] }, [0.0, 7.0]),
            (Curve::Hyperbola { frame, radii: [2.0, 1.5] }, [-1.0, 1.0]),
            (Curve::Parabola { frame, focal: 0.7 }, [-2.0, 1.0]),
            (Curve::Spline(Spline::new(knots.clone(), points.to_vec()).unwrap()), [0.2, 1.9]),
            (Curve::Rational(Rational::new(knots, &weighted).unwrap()), [1.9, 0.2]),
            (Curve::Polyline(points.to_vec()), [0.1, 0.9]),
        ];
        let turn = |range| Span { curve: circle.clone(), range };
        all.push((Curve::Joined(vec![turn([1.0, 2.0]), turn([2.0, 5.0])]), [1.1, 1.9]));
        all.into_iter().map(|(curve, range)| Span { curve, range }).collect()
    }

    #[test]
    fn derivatives_are_those_of_the_places() {
        let step = 1e-5;
        for span in curves() {
            for share in [0.1, 0.45, 0.8] {
                let at = |s: f64| span.derivatives(share + s);
                let [_, first, second] = at(0.0);
                for k in 0..3 {
                    let slope = (at(step)[0][k] - at(-step)[0][k]) / (2.0 * step);
                    let bend = (at(step)[1][k] - at(-step)[1][k]) / (2.0 * step);
                    assert!((slope - first[k]).abs() < 1e-7 * (1.0 + norm(second)), "{span:?}");
                    assert!((bend - second[k]).abs() < 1e-6 * (1.0 + norm(second)), "{span:?}");
                }
            }
        }
    }
}
