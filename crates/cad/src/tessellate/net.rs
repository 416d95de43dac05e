//! Bounds of second derivatives of splines, span by span, from control points of the derivatives.
//!
//! A rational spline is `X = A / w` with splines `A` and `w`. Taken from a place amid the control points of a span, all `X` of the span lie
//! within the greatest distance `r` of these (weights are above 0). Then `w X_u = A_u − w_u X` and `w X_uu = A_uu − 2 w_u X_u − w_uu X` bound
//! the derivatives, and so for `uv`. Where all weights are 1 that is the bound of the control points of the second derivative itself.

use crate::curve::Curve;
use trueness_geom::space::{minus, norm, plus, times};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::surface::Nurbs;

/// Bounds of `|X_uu|`, `|X_uv|`, `|X_vv|`.
pub type Seconds = [f64; 3];

/// Bounds for each cell between knots.
#[derive(Clone, Debug)]
pub struct Net {
    /// Ends of the cells along both parameters.
    pub knots: [Vec<f64>; 2],
    /// Row after row: cells of the first span of `u` come first.
    cells: Vec<Seconds>,
    /// Values of both parameters at which the surface may have a crease.
    pub creases: [Vec<f64>; 2],
}

/// Control points of a derivative: three coordinates times their weight, and the weight.
#[derive(Clone)]
struct Grid {
    counts: [usize; 2],
    values: Vec<[f64; 4]>,
}

/// One direction of a spline; a curve has a second one of degree 0.
#[derive(Clone, Copy)]
struct Direction<'a> {
    degree: usize,
    knots: &'a [f64],
}

impl Net {
    /// Of a surface.
    pub fn of_surface(nurbs: &Nurbs) -> Net {
        let values = nurbs.control_points().iter().map(|(p, w)| weighted(*p, *w)).collect();
        let knots = nurbs.knots();
        Net::new(Grid { counts: nurbs.counts(), values }, [Some(&knots[0]), Some(&knots[1])])
    }

    /// Of a curve, along `u`; `None` where it is no spline.
    pub fn of_curve(curve: &Curve) -> Option<Net> {
        let (knots, values): (&Knots, Vec<[f64; 4]>) = match curve {
            Curve::Spline(s) => (s.knots(), s.points().iter().map(|p| weighted(*p, 1.0)).collect()),
            Curve::Rational(r) => {
                let masses = r.masses();
                let own = masses.points().iter().map(|m| [m.moment[0], m.moment[1], m.moment[2], m.mass]);
                (masses.knots(), own.collect())
            }
            _ => return None,
        };
        Some(Net::new(Grid { counts: [values.len(), 1], values }, [Some(knots), None]))
    }

    fn new(grid: Grid, knots: [Option<&Knots>; 2]) -> Net {
        let directions = knots.map(|k| match k {
            Some(k) => Direction { degree: k.degree(), knots: k.values() },
            None => Direction { degree: 0, knots: &[0.0, 1.0] },
        });
        let distinct = knots.map(|k| k.map_or(vec![0.0, 1.0], Knots::distinct));
        let creases = [0, 1].map(|k| match knots[k] {
            Some(own) => {
                let inner = distinct[k].get(1..distinct[k].len() - 1).unwrap_or_default();
                inner.iter().copied().filter(|t| own.multiplicity(*t) >= own.degree()).collect()
            }
            None => vec![],
        });
        let of = |orders: [usize; 2]| derived(&grid, &directions, orders);
        let all = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]].map(|orders| (orders, of(orders)));
        let mut cells = vec![];
        for u in distinct[0].windows(2) {
            for v in distinct[1].windows(2) {
                cells.push(bound(&all, &directions, [0.5 * (u[0] + u[1]), 0.5 * (v[0] + v[1])]));
            }
        }
        Net { knots: distinct, cells, creases }
    }

    /// The greatest bounds over a box of parameters.
    pub fn over(&self, sides: [[f64; 2]; 2]) -> Seconds {
        let range = |k: usize| {
            let knots = &self.knots[k];
            let last = knots.len() - 2;
            let from = knots.partition_point(|t| *t <= sides[k][0]).saturating_sub(1).min(last);
            let to = knots.partition_point(|t| *t < sides[k][1]).saturating_sub(1).min(last);
            from..=to.max(from)
        };
        let width = self.knots[1].len() - 1;
        let mut most = [0.0f64; 3];
        for i in range(0) {
            for j in range(1) {
                (0..3).for_each(|n| most[n] = most[n].max(self.cells[i * width + j][n]));
            }
        }
        most
    }
}

fn weighted(p: [f64; 3], w: f64) -> [f64; 4] {
    [w * p[0], w * p[1], w * p[2], w]
}

/// Control points of a derivative; `None` where it is 0 everywhere.
fn derived(grid: &Grid, directions: &[Direction; 2], orders: [usize; 2]) -> Option<Grid> {
    let mut grid = grid.clone();
    for k in 0..2 {
        for order in 0..orders[k] {
            let p = directions[k].degree.checked_sub(order).filter(|p| *p > 0)?;
            let u = directions[k].knots;
            let mut counts = grid.counts;
            counts[k] -= 1;
            let step = if k == 0 { grid.counts[1] } else { 1 };
            let value = |n: usize| {
                let (i, j) = (n / counts[1], n % counts[1]);
                let at = i * grid.counts[1] + j;
                let knot = [i, j][k] + order;
                let width = u[knot + p + 1] - u[knot + 1];
                let factor = if width > 0.0 { p as f64 / width } else { 0.0 };
                std::array::from_fn(|d| factor * (grid.values[at + step][d] - grid.values[at][d]))
            };
            grid = Grid { counts, values: (0..counts[0] * counts[1]).map(value).collect() };
        }
    }
    Some(grid)
}

/// The control points that act at a place of the parameters.
fn acting(grid: &Grid, directions: &[Direction; 2], orders: [usize; 2], at: [f64; 2]) -> Vec<[f64; 4]> {
    let range = [0, 1].map(|k| {
        let d = directions[k];
        let span = d.knots.partition_point(|t| *t <= at[k]).saturating_sub(1);
        let last = span.saturating_sub(orders[k]).min(grid.counts[k] - 1);
        last.saturating_sub(d.degree - orders[k])..=last
    });
    let [us, vs] = range;
    us.flat_map(|i| vs.clone().map(move |j| (i, j)))
        .map(|(i, j)| grid.values[i * grid.counts[1] + j])
        .collect()
}

fn bound(all: &[([usize; 2], Option<Grid>); 6], directions: &[Direction; 2], at: [f64; 2]) -> Seconds {
    let points = |n: usize| {
        let (orders, grid) = &all[n];
        grid.as_ref().map_or(vec![], |g| acting(g, directions, *orders, at))
    };
    let own = points(0);
    let place = |m: &[f64; 4]| times(1.0 / m[3], [m[0], m[1], m[2]]);
    let center = times(1.0 / own.len() as f64, own.iter().fold([0.0; 3], |s, m| plus(s, place(m))));
    let reach = own.iter().map(|m| norm(minus(place(m), center))).fold(0.0, f64::max);
    let least = own.iter().map(|m| m[3]).fold(f64::INFINITY, f64::min);
    // Greatest derivative of the moments about the center, and of the weight.
    let sizes = |n: usize| {
        points(n).iter().fold([0.0f64; 2], |[a, w], m| {
            let about = minus([m[0], m[1], m[2]], times(m[3], center));
            [a.max(norm(about)), w.max(m[3].abs())]
        })
    };
    let [u, v, uu, uv, vv] = [1, 2, 3, 4, 5].map(sizes);
    let first = |[a, w]: [f64; 2]| (a + w * reach) / least;
    let [du, dv] = [first(u), first(v)];
    [
        (uu[0] + 2.0 * u[1] * du + uu[1] * reach) / least,
        (uv[0] + u[1] * dv + v[1] * du + uv[1] * reach) / least,
        (vv[0] + 2.0 * v[1] * dv + vv[1] * reach) / least,
    ]
}
