//! A surface as polynomials, one patch for each pair of spans: many places of it are evaluated so.

use super::super::spans::Spans;
use super::super::value::Value;
use super::{Bend, Surface};
use crate::space::{Point, Vector};

/// The polynomials of a surface.
///
/// Memory: 24 bytes times `(p + 1)(q + 1)` for each pair of spans. Evaluation needs no memory and no search for the functions;
/// it agrees with [`Surface::at`] but for rounding.
/// ```
/// use trueness_geom::spline::{basis::Knots, surface::{Patches, Surface}};
/// let knots = || Knots::uniform(3, 2, 0.0, 1.0);
/// let points = (0..25).map(|k| [f64::from(k / 5), f64::from(k % 5), f64::from(k * k % 7)]).collect();
/// let surface = Surface::new([knots(), knots()], points).unwrap();
/// let (a, b) = (surface.at(0.3, 0.7), Patches::new(&surface).at(0.3, 0.7));
/// assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-14));
/// ```
///
/// With `D` of 4 they are those of mass points: three coordinates times the mass, and the mass.
#[derive(Clone, Debug)]
pub struct Patches<const D: usize = 3> {
    pub(super) spans: [Spans; 2],
    /// `(p + 1)(q + 1)` numbers of `D` for each patch, patches row after row: powers of `v` within powers of `u`.
    coefficients: Vec<[f64; D]>,
}

/// A place of a surface with its derivatives by `u` and `v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// The place.
    pub place: Point,
    /// By `u` and by `v`.
    pub first: [Vector; 2],
    /// By `uu`, `uv` and `vv`.
    pub second: [Vector; 3],
}

impl Patches {
    /// The polynomials of `surface`.
    pub fn new(surface: &Surface<Point>) -> Patches {
        Patches::of(
            [Spans::new(&surface.knots()[0]), Spans::new(&surface.knots()[1])],
            surface.points(),
            surface.counts()[1],
        )
    }

    /// The place at `u`, `v`; outside of the domain that of the nearest place of it.
    pub fn at(&self, u: f64, v: f64) -> Point {
        let ((i, s), (j, t)) = (self.spans[0].locate(u), self.spans[1].locate(v));
        self.value(i * self.spans[1].count() + j, s, t)
    }

    /// Place and derivatives at `u`, `v`.
    pub fn jet(&self, u: f64, v: f64) -> Jet {
        let [place, su, sv, suu, suv, svv] = self.six(self.spans[0].locate(u), self.spans[1].locate(v));
        Jet { place, first: [su, sv], second: [suu, suv, svv] }
    }

    /// Normal and curvatures at `u`, `v`; `None` where the derivatives span no plane.
    pub fn bend(&self, u: f64, v: f64) -> Option<Bend> {
        let jet = self.jet(u, v);
        Bend::new(jet.first, jet.second)
    }
}

impl<const D: usize> Patches<D> {
    /// The patches of control points over spans, `n` to a row.
    pub fn of(spans: [Spans; 2], points: &[[f64; D]], n: usize) -> Patches<D> {
        let [p, q] = [spans[0].degree() + 1, spans[1].degree() + 1];
        let mut coefficients = Vec::with_capacity(spans[0].count() * spans[1].count() * p * q);
        let mut rows = vec![[0.0; D]; p * q];
        for i in 0..spans[0].count() {
            let a = spans[0].polynomials(i);
            for j in 0..spans[1].count() {
                let b = spans[1].polynomials(j);
                let corner = spans[0].first(i) * n + spans[1].first(j);
                for r in 0..p {
                    let own = &points[corner + r * n..][..q];
                    for l in 0..q {
                        rows[r * q + l] =
                            own.iter().enumerate().fold([0.0; D], |sum, (c, x)| sum.plus(b[c * q + l], *x));
                    }
                }
                for k in 0..p {
                    for l in 0..q {
                        let sum = (0..p).fold([0.0; D], |sum, r| sum.plus(a[r * p + k], rows[r * q + l]));
                        coefficients.push(sum);
                    }
                }
            }
        }
        Patches { spans, coefficients }
    }

    /// First and last parameter of both directions.
    pub fn domain(&self) -> [(f64, f64); 2] {
        self.spans.each_ref().map(|s| (s.limits(0).0, s.limits(s.count() - 1).1))
    }

    /// The coefficients of patch number `cell`.
    pub fn patch(&self, cell: usize) -> (&[[f64; D]], usize) {
        let [p, q] = [self.spans[0].degree() + 1, self.spans[1].degree() + 1];
        (&self.coefficients[cell * p * q..(cell + 1) * p * q], q)
    }

    /// The value at the coordinates `s`, `t` of a patch.
    #[inline]
    pub fn value(&self, cell: usize, s: f64, t: f64) -> [f64; D] {
        let (own, q) = self.patch(cell);
        // The degrees in use have loops of known length.
        match q {
            3 => horner(own.as_chunks::<3>().0.iter(), s, t),
            4 => horner(own.as_chunks::<4>().0.iter(), s, t),
            5 => horner(own.as_chunks::<5>().0.iter(), s, t),
            _ => horner(own.chunks_exact(q), s, t),
        }
    }

    /// Value and derivatives at the coordinates `s`, `t` of patch `i`, `j`: itself, by `u`, by `v`, by `uu`, `uv` and `vv`.
    #[inline(always)]
    pub(super) fn six(&self, (i, s): (usize, f64), (j, t): (usize, f64)) -> [[f64; D]; 6] {
        let (own, q) = self.patch(i * self.spans[1].count() + j);
        let sum = match q {
            4 => horner_six(own.as_chunks::<4>().0.iter(), s, t),
            _ => horner_six(own.chunks_exact(q), s, t),
        };
        let (a, b) = (1.0 / self.spans[0].half(i), 1.0 / self.spans[1].half(j));
        let [value, u, v, uu, uv, vv] = sum;
        [
            value,
            u.map(|x| x * a),
            v.map(|x| x * b),
            uu.map(|x| 2.0 * x * a * a),
            uv.map(|x| x * a * b),
            vv.map(|x| 2.0 * x * b * b),
        ]
    }
}

/// Value, derivatives and halves of the second derivatives by `s` and by `t`, in the order of [`Patches::six`].
#[inline(always)]
fn horner_six<'a, R, const D: usize>(
    rows: impl DoubleEndedIterator<Item = &'a R>,
    s: f64,
    t: f64,
) -> [[f64; D]; 6]
where
    R: AsRef<[[f64; D]]> + ?Sized + 'a,
{
    let mut sum = [[0.0f64; D]; 6];
    for row in rows.rev() {
        let mut inner = [[0.0f64; D]; 3];
        for c in row.as_ref().iter().rev() {
            for d in 0..D {
                inner[2][d] = inner[2][d] * t + inner[1][d];
                inner[1][d] = inner[1][d] * t + inner[0][d];
                inner[0][d] = inner[0][d] * t + c[d];
            }
        }
        for d in 0..D {
            sum[3][d] = sum[3][d] * s + sum[1][d];
            sum[1][d] = sum[1][d] * s + sum[0][d];
            sum[4][d] = sum[4][d] * s + sum[2][d];
            sum[0][d] = sum[0][d] * s + inner[0][d];
            sum[2][d] = sum[2][d] * s + inner[1][d];
            sum[5][d] = sum[5][d] * s + inner[2][d];
        }
    }
    sum
}

/// The value of a polynomial whose rows are polynomials of `t`, for powers of `s`.
#[inline(always)]
fn horner<'a, R, const D: usize>(rows: impl DoubleEndedIterator<Item = &'a R>, s: f64, t: f64) -> [f64; D]
where
    R: AsRef<[[f64; D]]> + ?Sized + 'a,
{
    let mut sum = [0.0f64; D];
    for row in rows.rev() {
        let mut inner = [0.0f64; D];
        for c in row.as_ref().iter().rev() {
            (0..D).for_each(|d| inner[d] = inner[d] * t + c[d]);
        }
        (0..D).for_each(|d| sum[d] = sum[d] * s + inner[d]);
    }
    sum
}
