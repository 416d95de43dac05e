//! A tensor product: evaluation, derivatives, knots, degrees, parts.

use super::super::basis::{KnotError, Knots};
use super::super::curve::Curve;
use super::super::value::Value;

/// One of the two parameters of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The first.
    U,
    /// The second.
    V,
}

/// A B-spline surface of points, of vectors, or of mass points.
///
/// The control points lie row after row: those of the first knot of `u` come first, ordered by `v`.
/// ```
/// use trueness_geom::spline::{basis::Knots, surface::Surface};
/// let knots = || Knots::uniform(2, 1, 0.0, 2.0);
/// let mut points: Vec<[f64; 3]> = (0..9).map(|k| [f64::from(k / 3), f64::from(k % 3), 0.0]).collect();
/// points[4][2] = 1.2;
/// let surface = Surface::new([knots(), knots()], points).unwrap();
/// assert_eq!(surface.at(1.0, 1.0), [1.0, 1.0, 0.3]);
/// // At the top both principal curvatures are 0.6; the normal points away from their centers.
/// let bend = surface.bend(1.0, 1.0).unwrap();
/// assert!((bend.mean + 0.6).abs() < 1e-15 && (bend.gaussian - 0.36).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Surface<V> {
    knots: [Knots; 2],
    points: Vec<V>,
}

impl<V: Value> Surface<V> {
    /// The surface of these control points.
    ///
    /// # Errors
    /// [`KnotError::Points`] where their number does not fit the knots.
    pub fn new(knots: [Knots; 2], points: Vec<V>) -> Result<Surface<V>, KnotError> {
        let needed = knots[0].count() * knots[1].count();
        match points.len() == needed {
            true => Ok(Surface { knots, points }),
            false => Err(KnotError::Points { found: points.len(), needed }),
        }
    }
    /// Knots and degrees in both directions.
    pub fn knots(&self) -> &[Knots; 2] {
        &self.knots
    }
    /// The control points, row after row.
    pub fn points(&self) -> &[V] {
        &self.points
    }
    /// Number of control points along `u` and along `v`.
    pub fn counts(&self) -> [usize; 2] {
        [self.knots[0].count(), self.knots[1].count()]
    }
    /// First and last parameter of both directions.
    pub fn domain(&self) -> [(f64, f64); 2] {
        [self.knots[0].domain(), self.knots[1].domain()]
    }

    /// The surface at `u`, `v`; outside of its domain that of the nearest place of it.
    pub fn at(&self, u: f64, v: f64) -> V {
        let (i, a) = self.knots[0].basis(u);
        let (j, b) = self.knots[1].basis(v);
        self.sum(i, &a, j, &b)
    }

    /// All partial derivatives up to the order given: entry `[i][j]` is the `i`-th by `u` and `j`-th by `v`, for
    /// `i + j ≤ order`. At a knot from the right, at the last one from the left.
    pub fn derivatives(&self, u: f64, v: f64, order: usize) -> Vec<Vec<V>> {
        let (i, a) = self.knots[0].derivatives(u, order);
        let (j, b) = self.knots[1].derivatives(v, order);
        let row = |k: usize| (0..=order - k).map(|l| self.sum(i, &a[k], j, &b[l])).collect();
        (0..=order).map(row).collect()
    }

    fn sum(&self, i: usize, a: &[f64], j: usize, b: &[f64]) -> V {
        let n = self.knots[1].count();
        a.iter().enumerate().fold(V::ZERO, |sum, (r, x)| {
            let row = &self.points[(i + r) * n + j..];
            let inner = b.iter().zip(row).fold(V::ZERO, |sum, (y, p)| sum.plus(*y, *p));
            sum.plus(*x, inner)
        })
    }

    /// The curve on the surface along which the parameter of `held` is `t`.
    pub fn iso_curve(&self, held: Direction, t: f64) -> Curve<V> {
        let [m, n] = self.counts();
        let (knots, count) = match held {
            Direction::U => (&self.knots[1], n),
            Direction::V => (&self.knots[0], m),
        };
        let (first, weights) = self.knots[held as usize].basis(t);
        let point = |k: usize| {
            weights.iter().enumerate().fold(V::ZERO, |sum, (i, w)| {
                let at = match held {
                    Direction::U => (first + i) * n + k,
                    Direction::V => k * n + first + i,
                };
                sum.plus(*w, self.points[at])
            })
        };
        Curve::over_knots(knots.clone(), (0..count).map(point).collect())
    }

    /// The same surface with the knot `t` once more in a direction.
    ///
    /// # Errors
    /// [`KnotError`] where `t` is outside of the domain or then stands too often.
    pub fn insert(&self, direction: Direction, t: f64) -> Result<Surface<V>, KnotError> {
        self.along(direction, |curve| curve.insert(t))
    }

    /// The same surface with the degree in a direction one higher.
    pub fn elevated(&self, direction: Direction) -> Surface<V> {
        self.along(direction, |curve| Ok(curve.elevated())).unwrap_or_else(|_| self.clone())
    }

    /// The two parts of the surface before and after `t` in a direction, which must lie inside of its domain.
    ///
    /// # Errors
    /// [`KnotError::Order`] where it does not.
    pub fn split(&self, direction: Direction, t: f64) -> Result<[Surface<V>; 2], KnotError> {
        let k = direction as usize;
        let (from, to) = self.domain()[k];
        if t.is_nan() || t <= from || t >= to {
            return Err(KnotError::Order { index: 0, value: t });
        }
        let mut whole = self.clone();
        let p = self.knots[k].degree();
        for _ in self.knots[k].multiplicity(t)..p + 1 {
            whole = whole.insert(direction, t)?;
        }
        let values = whole.knots[k].values();
        let cut = values.partition_point(|x| *x < t);
        let knots = [Knots::new(p, values[..cut + p + 1].to_vec())?, Knots::new(p, values[cut..].to_vec())?];
        let [m, n] = whole.counts();
        let part = |side: usize, own: &Knots| {
            let mut both = whole.knots.clone();
            both[k] = own.clone();
            let inside = |index: usize| (if k == 0 { index / n } else { index % n } < cut) == (side == 0);
            let points = (0..m * n).filter(|i| inside(*i)).map(|i| whole.points[i]).collect();
            Surface::new(both, points)
        };
        Ok([part(0, &knots[0])?, part(1, &knots[1])?])
    }

    /// The same surface over another domain of a direction, which starts before its second knot and ends after its last but
    /// one. Beyond its own ends it goes on as the polynomials there do.
    ///
    /// ```
    /// use trueness_geom::spline::{basis::Knots, surface::{Direction, Surface}};
    /// let knots = || Knots::uniform(2, 2, 0.0, 2.0);
    /// let points = (0..16).map(|k| [f64::from(k / 4), f64::from(k % 4), f64::from(k * k % 7)]).collect();
    /// let surface = Surface::new([knots(), knots()], points).unwrap();
    /// let longer = surface.going_on(Direction::V, (-0.5, 2.25)).unwrap();
    /// let back = longer.going_on(Direction::V, (0.0, 2.0)).unwrap();
    /// let off = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
    /// assert!(off(longer.at(0.7, 1.9), surface.at(0.7, 1.9)) < 1e-14);
    /// assert!(surface.points().iter().zip(back.points()).all(|(a, b)| off(*a, *b) < 1e-13));
    /// ```
    ///
    /// # Errors
    /// [`KnotError`] where the domain is another one.
    pub fn going_on(&self, direction: Direction, domain: (f64, f64)) -> Result<Surface<V>, KnotError> {
        self.along(direction, |curve| curve.going_on(domain))
    }

    /// Does the same to all rows of control points of a direction.
    fn along(
        &self,
        direction: Direction,
        change: impl Fn(&Curve<V>) -> Result<Curve<V>, KnotError>,
    ) -> Result<Surface<V>, KnotError> {
        let [m, n] = self.counts();
        let (step, others, stride, count) = match direction {
            Direction::U => (n, n, 1, m),
            Direction::V => (1, m, n, n),
        };
        let row = |k: usize| (0..count).map(|i| self.points[k * stride + i * step]).collect();
        let own = &self.knots[direction as usize];
        let changed: Result<Vec<Curve<V>>, KnotError> =
            (0..others).map(|k| change(&Curve::over_knots(own.clone(), row(k)))).collect();
        let changed = changed?;
        let Some(first) = changed.first() else { return Ok(self.clone()) };
        let mut knots = self.knots.clone();
        knots[direction as usize] = first.knots().clone();
        let count = first.points().len();
        let points = match direction {
            Direction::U => (0..count * n).map(|i| changed[i % n].points()[i / n]).collect(),
            Direction::V => changed.iter().flat_map(|c| c.points().iter().copied()).collect(),
        };
        Surface::new(knots, points)
    }
}
