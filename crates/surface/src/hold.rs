//! Plates that hold the control points where points are few.
//!
//! The weight of the thin plate is that which suits all points. A few points at the rim of a basis function would be
//! all that a control point beyond their outline follows. Their noise is then enlarged as often as the function is
//! small: the surface leaves the part. So functions that meet few points get a plate of their own, as stiff as the
//! noise asks for. A plate goes on for ever with the slope at its edge, so a second term lets it lie down along the
//! base.

use super::BaseKind;
use super::base::Base;
use super::energy::{over_span, squares};
use super::gram::Binned;
use super::stencil::Stencil;
use trueness_geom::num::cholesky::Cholesky;
use trueness_geom::space::{Point, minus};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::spans::Spans;

/// Points as dense as elsewhere, all over a basis function, would be a certain number. It is held where it meets fewer
/// than this share of that. The noise of its control point is then twice that of others; without bound, as the share
/// goes to none.
const SPARSE_SHARE: f64 = 0.3;
/// Most that a plate holds, as a share of the mean hold of the points on a control point.
pub(super) const MAX_PLATE_STIFFNESS: f64 = 1e-2;
/// A bend of this slope from one cell to the next counts as much as one standard deviation of a point. Points without
/// noise are held by next to nothing.
const PLATE_SLOPE: f64 = 0.1;
/// Length, as a share of the shorter side, over which the surface lies down along the base.
const LEVELLING_REACH: f64 = 0.1;

/// The base and the points by which the control points are held.
pub(super) struct HoldGround<'a> {
    pub knots: &'a [Knots; 2],
    pub base: &'a Base,
    pub points: &'a [Point],
    pub parameters: &'a [[f64; 2]],
    /// The place that is subtracted from all places.
    pub center: Point,
}

/// The term `(p − t)ᵀ H (p − t)` for control points `p`.
pub(super) struct Penalty {
    /// `H`, of unit stiffness.
    pub stencil: Stencil,
    /// `t`, less the center: only its slopes count.
    pub target: Vec<Point>,
}

impl Penalty {
    /// The penalty for the control points that the matrix of the points leaves loose; `None` where there are none.
    pub(super) fn of(data: &Binned, normal: &Stencil, ground: &HoldGround) -> Option<Penalty> {
        let needs = needs(data, normal);
        if needs.iter().all(|n| *n == 0.0) {
            return None;
        }
        let sides = ground.knots.each_ref().map(|k| k.domain().1 - k.domain().0);
        // Over a mesh laid flat there is no base in space to lie down along: the plate alone holds.
        let reach = match ground.base.kind {
            BaseKind::Mesh => f64::INFINITY,
            _ => LEVELLING_REACH * sides[0].min(sides[1]),
        };
        let integrals = data.spans.each_ref().map(Integrals::new);
        let mut stencil = Stencil::new(data.counts, data.spans.each_ref().map(Spans::degree));
        for cell in 0..data.spans[0].count() * data.spans[1].count() {
            for quarter in 0..4 {
                let need = need_at(data, &needs, cell, quarter);
                if need > 0.0 {
                    add(&mut stencil, data, &integrals, (cell, quarter), need, reach);
                }
            }
        }
        let target = target(ground).into_iter().map(|t| minus(t, ground.center)).collect();
        Some(Penalty { stencil, target })
    }
}

/// The stiffness for points of this variance, as a share of the points' mean hold on a control point.
pub(super) fn stiffness(data: &Binned, normal: &Stencil, variance: f64) -> f64 {
    let sides = data.spans.each_ref().map(|s| s.limits(s.count() - 1).1 - s.limits(0).0);
    let cell = sides[0] * sides[1] / data.cells().0 as f64;
    let mean = normal.trace() / (data.counts[0] * data.counts[1]) as f64;
    (variance / (PLATE_SLOPE * PLATE_SLOPE * cell * mean)).min(MAX_PLATE_STIFFNESS)
}

/// Adds the terms of one quarter of a cell.
fn add(
    stencil: &mut Stencil,
    data: &Binned,
    integrals: &[Integrals; 2],
    (cell, quarter): (usize, usize),
    need: f64,
    reach: f64,
) {
    let [p, q] = data.spans.each_ref().map(Spans::degree);
    let columns = data.spans[1].count();
    let [i, j] = [cell / columns, cell % columns];
    let corner = data.spans[0].first(i) * data.counts[1] + data.spans[1].first(j);
    for a in 0..=p {
        for b in a..=p {
            let u = |order| integrals[0].of(2 * i + quarter / 2, order, a, b);
            for c in 0..=q {
                for d in 0..=q {
                    let v = |order| integrals[1].of(2 * j + quarter % 2, order, c, d);
                    let plate = u(2) * v(0) + 2.0 * u(1) * v(1) + u(0) * v(2);
                    let slope = u(1) * v(0) + u(0) * v(1);
                    let row = stencil.row(corner + a * data.counts[1] + c, b - a);
                    row[d + q - c] += need * (plate + slope / (reach * reach));
                }
            }
        }
    }
}

/// How far each basis function is from being held by its points: 0 of enough, 1 of none.
fn needs(data: &Binned, normal: &Stencil) -> Vec<f64> {
    let squares = data.spans.each_ref().map(squares);
    let density = data.density();
    let need = |k: usize| {
        let [i, j] = [k / data.counts[1], k % data.counts[1]];
        let full = density * squares[0][i] * squares[1][j];
        (1.0 - normal.diagonal(k) / (SPARSE_SHARE * full)).max(0.0)
    };
    (0..data.counts[0] * data.counts[1]).map(need).collect()
}

/// The need in the middle of a quarter of a cell: that of the functions there, as the surface is made of their control points.
fn need_at(data: &Binned, needs: &[f64], cell: usize, quarter: usize) -> f64 {
    let at = [cell / data.spans[1].count(), cell % data.spans[1].count()];
    let half = [quarter / 2, quarter % 2];
    let values = [0, 1].map(|k| {
        let (p, t) = (data.spans[k].degree(), half[k] as f64 - 0.5);
        let horner = |c: &[f64]| c.iter().rev().fold(0.0, |sum, c| sum * t + c);
        data.spans[k].polynomials(at[k]).chunks_exact(p + 1).map(horner).collect::<Vec<f64>>()
    });
    let first = [0, 1].map(|k| data.spans[k].first(at[k]));
    let row = |a: usize| {
        let own = &needs[(first[0] + a) * data.counts[1] + first[1]..];
        values[1].iter().zip(own).map(|(v, n)| v * n).sum::<f64>()
    };
    values[0].iter().enumerate().map(|(a, u)| u * row(a)).sum::<f64>().max(0.0)
}

/// Control points of the base, tilted as the points over it are.
fn target(HoldGround { knots, base, points, parameters, center }: &HoldGround) -> Vec<Point> {
    if base.kind == BaseKind::Mesh {
        return vec![*center; knots[0].count() * knots[1].count()];
    }
    let slopes = slopes(base, points, parameters);
    let [us, vs] = knots.each_ref().map(Knots::greville);
    let at = |u: f64, v: f64| {
        let place = base.at([u, v]);
        std::array::from_fn(|d| place[d] + slopes[0][d] * u + slopes[1][d] * v)
    };
    us.iter().flat_map(|u| vs.iter().map(|v| at(*u, *v))).collect()
}

/// Growth of the points' distances from the base along `u` and `v`, by least squares.
fn slopes(base: &Base, points: &[Point], parameters: &[[f64; 2]]) -> [Point; 2] {
    let count = points.len() as f64;
    let mean = [0, 1].map(|k| parameters.iter().map(|p| p[k]).sum::<f64>() / count);
    let (mut square, mut product) = ([0.0; 4], [[0.0; 3]; 2]);
    for (point, parameters) in points.iter().zip(parameters) {
        let off = minus(*point, base.at(*parameters));
        let own = [0, 1].map(|k| parameters[k] - mean[k]);
        for a in 0..2 {
            (0..2).for_each(|b| square[2 * a + b] += own[a] * own[b]);
            (0..3).for_each(|d| product[a][d] += own[a] * off[d]);
        }
    }
    let Some(factor) = Cholesky::new(square.to_vec(), 2) else { return [[0.0; 3]; 2] };
    let mut slopes = [[0.0; 3]; 2];
    for d in 0..3 {
        let mut own = [product[0][d], product[1][d]];
        factor.solve(&mut own);
        (0..2).for_each(|k| slopes[k][d] = own[k]);
    }
    slopes
}

/// Integrals over both halves of each span of the products of two derivatives of orders 0 to 2.
struct Integrals {
    functions: usize,
    values: Vec<f64>,
}

impl Integrals {
    fn new(spans: &Spans) -> Integrals {
        let functions = spans.degree() + 1;
        let mut values = vec![];
        for span in 0..spans.count() {
            for half in [(-1.0, 0.0), (0.0, 1.0)] {
                (0..3).for_each(|order| values.extend(over_span(spans, span, order, half)));
            }
        }
        Integrals { functions, values }
    }
    fn of(&self, half: usize, order: usize, a: usize, b: usize) -> f64 {
        let n = self.functions;
        self.values[((half * 3 + order) * n + a) * n + b]
    }
}
