//! Bounds of the derivatives of a polynomial or rational piece of a surface, by coefficients in Bernstein form.
//!
//! With `X = A / w` and `P = A_u w − A w_u`, which is `w² X_u`, the mixed derivative is `X_uv = (P_v w − 2 P w_v) / w³`, and so are the
//! others. The numerators are polynomials, and lie within the hull of their coefficients. Where terms cancel, as on the straight lines of a
//! cylinder, they cancel there too.

use super::net::Net;
use trueness_geom::space::{Aabb, Vector, cross, dot, minus, norm, plus, times};
use trueness_geom::spline::value::Mass;

/// Bounds of the second derivatives by `uu`, `uv` and `vv`.
pub(crate) type Seconds = [f64; 3];

/// Both parameters of each second derivative.
const PAIRS: [[usize; 2]; 3] = [[0, 0], [0, 1], [1, 1]];

/// The second derivatives of a piece, by shares of the way along it. Halves keep the shares of the whole.
#[derive(Clone, Debug)]
pub(crate) struct Bends {
    numerators: [Net<Vector>; 3],
    weights: Net<f64>,
}

impl Bends {
    pub(crate) fn new(piece: &Net<Mass<3>>) -> Bends {
        // About a place of the piece: what is left has no rounding of far coordinates.
        let center = piece.values.first().map_or([0.0; 3], |m| times(1.0 / m.mass, m.moment));
        let moments = piece.map(|m| minus(m.moment, times(m.mass, center)));
        let masses = piece.map(|m| m.mass);
        let first = masses.values.first().copied().unwrap_or(1.0);
        if masses.values.iter().all(|w| *w == first) {
            let of = |[j, k]: [usize; 2]| moments.derivative(j).derivative(k).map(|v| times(1.0 / first, *v));
            return Bends { numerators: PAIRS.map(of), weights: Net { counts: [1, 1], values: vec![1.0] } };
        }
        let by = |a: &Net<Vector>, b: &Net<f64>| a.product(b, |v, w| times(w, v));
        let of = |[j, k]: [usize; 2]| {
            let top =
                difference(&by(&moments.derivative(j), &masses), &by(&moments, &masses.derivative(j)), 1.0);
            difference(&by(&top.derivative(k), &masses), &by(&top, &masses.derivative(k)), 2.0)
        };
        Bends { numerators: PAIRS.map(of), weights: masses }
    }

    /// Both halves along a direction.
    pub(crate) fn halves(&self, k: usize) -> [Bends; 2] {
        let [[a, d], [b, e], [c, f]] = self.numerators.each_ref().map(|n| n.halves(k));
        let [v, w] = self.weights.halves(k);
        [Bends { numerators: [a, b, c], weights: v }, Bends { numerators: [d, e, f], weights: w }]
    }

    /// Their lengths at most.
    pub(crate) fn greatest(&self) -> Seconds {
        self.most(norm)
    }

    /// Their extents along a unit vector at most.
    pub(crate) fn along(&self, way: Vector) -> Seconds {
        self.most(|v| dot(v, way).abs())
    }

    /// Boxes around them.
    pub(crate) fn boxes(&self) -> [Aabb; 3] {
        let cube = |w: f64| w * w * w;
        let most = self.weights.values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (least, most) = (cube(self.weights.least()), cube(most));
        self.numerators.each_ref().map(|n| {
            let own = Aabb::of(&n.values);
            Aabb {
                min: own.min.map(|x| x / if x < 0.0 { least } else { most }),
                max: own.max.map(|x| x / if x > 0.0 { least } else { most }),
            }
        })
    }

    fn most(&self, size: impl Fn(Vector) -> f64) -> Seconds {
        let least = self.weights.least();
        let of = |n: &Net<Vector>| {
            n.values.iter().fold(0.0, |m: f64, v| m.max(size(*v))) / (least * least * least)
        };
        self.numerators.each_ref().map(of)
    }
}

/// `a − factor·b`. A direction in which one of them has degree 0 says nothing.
fn difference(a: &Net<Vector>, b: &Net<Vector>, factor: f64) -> Net<Vector> {
    let values = a.values.iter().zip(&b.values).map(|(a, b)| plus(*a, times(-factor, *b))).collect();
    Net { counts: a.counts, values }
}

/// What the first derivatives of a piece are at least and at most, from those in its middle and from bounds of the second ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slopes {
    /// `X_u` and `X_v` in the middle.
    pub(crate) middle: [Vector; 2],
    /// By how much they differ from that at most.
    pub(crate) off: [f64; 2],
}

impl Slopes {
    /// `reach` is half of the extent of the piece along each parameter.
    pub(crate) fn new(middle: [Vector; 2], [uu, uv, vv]: Seconds, [h, k]: [f64; 2]) -> Slopes {
        Slopes { middle, off: [h * uu + k * uv, h * uv + k * vv] }
    }

    /// Their lengths at least.
    pub(crate) fn least(&self) -> [f64; 2] {
        [0, 1].map(|k| (norm(self.middle[k]) - self.off[k]).max(0.0))
    }

    /// Their lengths at most.
    pub(crate) fn greatest(&self) -> [f64; 2] {
        [0, 1].map(|k| norm(self.middle[k]) + self.off[k])
    }

    /// Their scalar product at least and at most.
    pub(crate) fn product(&self) -> [f64; 2] {
        let (own, off) = (dot(self.middle[0], self.middle[1]), self.off_product());
        [own - off, own + off]
    }

    /// Their vector product in the middle, and by how much it differs from that at most.
    pub(crate) fn normal(&self) -> (Vector, f64) {
        (cross(self.middle[0], self.middle[1]), self.off_product())
    }

    /// By how much a product of both differs from that in the middle at most.
    fn off_product(&self) -> f64 {
        let [a, b] = self.middle.map(norm);
        a * self.off[1] + b * self.off[0] + self.off[0] * self.off[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Surface;
    use trueness_geom::spline::basis::Knots;
    use trueness_geom::spline::surface::Nurbs;

    fn piece(points: &[([f64; 3], f64)], counts: [usize; 2]) -> (Net<Mass<3>>, Surface) {
        let values = points.iter().map(|(p, w)| Mass::new(*p, *w)).collect();
        let knots = counts.map(|n| Knots::uniform(n - 1, 1, 0.0, 1.0));
        (Net { counts, values }, Surface::Spline(Box::new(Nurbs::weighted(knots, points).unwrap())))
    }

    /// Some pieces with and without weights; one of a cylinder, which is straight along `u`.
    fn pieces() -> Vec<(Net<Mass<3>>, Surface)> {
        let some = |weighted: bool| -> Vec<([f64; 3], f64)> {
            (0..12u32)
                .map(|n| {
                    let [i, j] = [n / 4, n % 4].map(f64::from);
                    let w = if weighted { 1.0 + 0.5 * f64::from(n * n % 5) } else { 2.0 };
                    ([i + 100.0, j + 0.2 * i, 0.3 * f64::from(n * 7 % 5)], w)
                })
                .collect()
        };
        let w = f64::sqrt(0.5);
        let arc = |z: f64| [([2.0, 0.0, z], 1.0), ([2.0, 2.0, z], w), ([0.0, 2.0, z], 1.0)];
        vec![
            piece(&some(false), [3, 4]),
            piece(&some(true), [3, 4]),
            piece(&[arc(0.0), arc(200.0)].concat(), [2, 3]),
        ]
    }

    #[test]
    fn second_derivatives_keep_to_their_bounds() {
        for (net, surface) in pieces() {
            let whole = Bends::new(&net);
            let [left, right] = whole.halves(0);
            let way = [0.6, 0.0, 0.8];
            for i in 0..=10 {
                for j in 0..=10 {
                    let at = [i, j].map(|n| f64::from(n) / 10.0);
                    let jet = surface.jet(at[0], at[1]);
                    let mut parts = vec![&whole];
                    parts.extend((i <= 5).then_some(&left));
                    parts.extend((i >= 5).then_some(&right));
                    for part in parts {
                        let (most, along) = (part.greatest(), part.along(way));
                        for n in 0..3 {
                            assert!(norm(jet.second[n]) <= most[n] * (1.0 + 1e-12) + 1e-10, "{n} {at:?}");
                            assert!(dot(jet.second[n], way).abs() <= along[n] * (1.0 + 1e-12) + 1e-10);
                            let around = part.boxes()[n].widened(1e-9);
                            assert_eq!(around.distance(&jet.second[n]), 0.0, "{n} {at:?}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_cylinder_is_straight() {
        let (net, _) = &pieces()[2];
        let [uu, uv, vv] = Bends::new(net).greatest();
        assert!(uu < 1e-10 && uv < 1e-10 && vv > 2.0, "{uu} {uv} {vv}");
    }

    #[test]
    fn first_derivatives_keep_to_their_bounds() {
        for (net, surface) in pieces() {
            let slopes = Slopes::new(surface.jet(0.5, 0.5).first, Bends::new(&net).greatest(), [0.5; 2]);
            let (normal, off) = slopes.normal();
            for n in 0..=20 {
                let [u, v] = [n % 5, n / 5].map(|k| f64::from(k) / 4.0);
                let [du, dv] = surface.jet(u, v).first;
                assert!(norm(du) >= slopes.least()[0] - 1e-9 && norm(dv) >= slopes.least()[1] - 1e-9);
                assert!(norm(du) <= slopes.greatest()[0] + 1e-9 && norm(dv) <= slopes.greatest()[1] + 1e-9);
                let [least, most] = slopes.product();
                assert!((least - 1e-9..=most + 1e-9).contains(&dot(du, dv)));
                assert!(norm(minus(cross(du, dv), normal)) <= off + 1e-9);
            }
        }
    }
}
