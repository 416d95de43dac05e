//! A surface of points or of mass points, as files have them.

use super::{Bend, Direction, RationalSurface, Surface};
use crate::space::Point;
use crate::spline::basis::{KnotError, Knots};
use crate::spline::value::Value;

/// A B-spline surface, rational or not.
#[derive(Clone, Debug, PartialEq)]
pub enum Nurbs {
    /// All weights are equal.
    Plain(Surface<Point>),
    /// Control points have weights, all above 0.
    Rational(RationalSurface),
}

impl Nurbs {
    /// The surface of control points, row after row as in [`Surface`], with weights above 0; polynomial where all weights are
    /// equal.
    ///
    /// ```
    /// use trueness_geom::spline::{basis::Knots, surface::Nurbs};
    /// let knots = || Knots::uniform(1, 1, 0.0, 1.0);
    /// let corners = [[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0]];
    /// let plain = Nurbs::weighted([knots(), knots()], &corners.map(|p| (p, 2.0))).unwrap();
    /// assert!(matches!(plain, Nurbs::Plain(_)));
    /// let points = [(corners[0], 1.0), (corners[1], 1.0), (corners[2], 3.0), (corners[3], 3.0)];
    /// let rational = Nurbs::weighted([knots(), knots()], &points).unwrap();
    /// assert_eq!(rational.at(0.5, 0.5), Some([1.5, 1.0, 0.0]));
    /// ```
    ///
    /// # Errors
    /// [`KnotError::Points`] where their number does not fit the knots, [`KnotError::Weight`] for a weight that is not above 0.
    pub fn weighted(knots: [Knots; 2], points: &[(Point, f64)]) -> Result<Nurbs, KnotError> {
        let bad = |(_, w): &(Point, f64)| !(*w > 0.0 && w.is_finite());
        if let Some(index) = points.iter().position(bad) {
            return Err(KnotError::Weight { index, value: points[index].1 });
        }
        match points.windows(2).all(|p| p[0].1 == p[1].1) {
            true => Surface::new(knots, points.iter().map(|p| p.0).collect()).map(Nurbs::Plain),
            false => RationalSurface::new(knots, points).map(Nurbs::Rational),
        }
    }
    /// Knots and degrees in both directions.
    pub fn knots(&self) -> &[Knots; 2] {
        match self {
            Nurbs::Plain(s) => s.knots(),
            Nurbs::Rational(s) => s.masses().knots(),
        }
    }
    /// Number of control points along `u` and along `v`.
    pub fn counts(&self) -> [usize; 2] {
        self.knots().each_ref().map(Knots::count)
    }
    /// The control points, row after row, with their weights.
    pub fn control_points(&self) -> Vec<(Point, f64)> {
        match self {
            Nurbs::Plain(s) => s.points().iter().map(|p| (*p, 1.0)).collect(),
            Nurbs::Rational(s) => {
                s.masses().points().iter().map(|m| (m.moment.map(|x| x / m.mass), m.mass)).collect()
            }
        }
    }
    /// The surface at `u`, `v`; `None` where the mass is 0, which weights above 0 exclude.
    pub fn at(&self, u: f64, v: f64) -> Option<Point> {
        match self {
            Nurbs::Plain(s) => Some(s.at(u, v)),
            Nurbs::Rational(s) => s.at(u, v),
        }
    }
    /// The same surface with `u` for `v` and `v` for `u`: its normal looks the other way.
    pub fn flipped(&self) -> Nurbs {
        let [m, n] = self.counts();
        let [u, v] = self.knots().clone();
        let turn = |k: usize| (k % m) * n + k / m;
        let flipped = match self {
            Nurbs::Plain(s) => {
                Surface::new([v, u], (0..m * n).map(|k| s.points()[turn(k)]).collect()).map(Nurbs::Plain)
            }
            Nurbs::Rational(s) => {
                Surface::new([v, u], (0..m * n).map(|k| s.masses().points()[turn(k)]).collect())
                    .map(|masses| Nurbs::Rational(masses.into()))
            }
        };
        flipped.unwrap_or_else(|_| self.clone())
    }
    /// The part of the surface over these parameters; what lies outside of its domain is cut off.
    pub fn within(&self, [(u0, u1), (v0, v1)]: [(f64, f64); 2]) -> Nurbs {
        use Direction::{U, V};
        let cuts = [(U, u0, 1), (U, u1, 0), (V, v0, 1), (V, v1, 0)];
        match self {
            Nurbs::Plain(s) => Nurbs::Plain(cut(s.clone(), cuts)),
            Nurbs::Rational(s) => Nurbs::Rational(cut(s.masses().clone(), cuts).into()),
        }
    }
    /// Normal and curvatures at `u`, `v`; `None` where the derivatives span no plane.
    pub fn bend(&self, u: f64, v: f64) -> Option<Bend> {
        match self {
            Nurbs::Plain(s) => s.bend(u, v),
            Nurbs::Rational(s) => s.bend(u, v),
        }
    }
}

/// Cuts a surface at parameters and keeps one of the parts of each.
fn cut<V: Value>(whole: Surface<V>, cuts: [(Direction, f64, usize); 4]) -> Surface<V> {
    cuts.into_iter().fold(whole, |rest, (direction, t, keep)| match rest.split(direction, t) {
        Ok([first, second]) => [first, second].into_iter().nth(keep).unwrap_or(rest),
        Err(_) => rest,
    })
}

impl From<Surface<Point>> for Nurbs {
    fn from(surface: Surface<Point>) -> Nurbs {
        Nurbs::Plain(surface)
    }
}

impl From<RationalSurface> for Nurbs {
    fn from(surface: RationalSurface) -> Nurbs {
        Nurbs::Rational(surface)
    }
}
