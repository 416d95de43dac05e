//! What minima the distance from a piece of a surface has, by bounds of its derivatives.
//!
//! Half the squared distance from `p` has the derivatives `(X − p)·X_i` and the second ones `X_i·X_j + (X − p)·X_ij`. Over a rectangle of
//! parameters each lies between two numbers: `X − p` in the box around the piece, `X_ij` in a box around its coefficients. Where a second
//! derivative is below 0 there is no minimum. Where a first one in the middle is greater than what the second ones can change, the
//! distance stands still nowhere. Where the second ones are positive definite the distance is convex: a descent finds its only minimum,
//! and the derivatives in the middle say how near that can be at most.

use super::bends::{Bends, Seconds, Slopes};
use trueness_geom::space::{Aabb, Point, Vector, dot, minus, norm, times};
use trueness_geom::spline::surface::Jet;

/// Bounds of the derivatives of a piece, by shares of the way along it.
#[derive(Clone, Debug)]
pub(super) struct Convexity {
    /// Its middle.
    place: Point,
    /// First derivatives there.
    first: [Vector; 2],
    /// `X_u·X_u` and `X_v·X_v`, at least and at most.
    squares: [[f64; 2]; 2],
    /// `X_u·X_v`, at least and at most.
    product: [f64; 2],
    /// Around the second derivatives by `uu`, `uv` and `vv`.
    seconds: [Aabb; 3],
    /// Their lengths at most.
    lengths: Seconds,
    /// The greatest coordinate of the piece, which rounding goes by.
    scale: f64,
}

/// What minima of less than a limit there are within.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Minima {
    None,
    /// One at most: a descent from the middle comes to it, or to an end of the piece.
    One,
    Unknown,
}

/// Roundings of a scalar product, or of a coefficient, as a share of what is multiplied: it is the sum of some dozens of products.
pub const PRODUCT_ROUNDING: f64 = 256.0 * f64::EPSILON;

impl Convexity {
    /// Of a part within a box, with these extents as shares of the piece that `bends` are of; its derivatives in its middle by its own shares.
    pub(super) fn new(bends: &Bends, sides: [f64; 2], middle: &Jet, bounds: &Aabb) -> Convexity {
        let [s, t] = sides;
        let factors = [s * s, s * t, t * t];
        let lengths = bends.greatest();
        let lengths = [0, 1, 2].map(|n| factors[n] * lengths[n]);
        let seconds = bends.boxes();
        let scaled = |n: usize| Aabb {
            min: seconds[n].min.map(|x| factors[n] * x),
            max: seconds[n].max.map(|x| factors[n] * x),
        };
        let scale = bounds.min.iter().chain(&bounds.max).fold(0.0, |m: f64, x| m.max(x.abs()));
        Convexity::of(middle.place, middle.first, [0, 1, 2].map(scaled), lengths, scale)
    }

    /// Of the part over a rectangle of shares, with its derivatives in its middle by the shares of the whole; and a box around it.
    pub(super) fn part(
        &self,
        [[a, b], [c, d]]: [[f64; 2]; 2],
        middle: &Jet,
        whole: &Aabb,
    ) -> (Convexity, Aabb) {
        let [s, t] = [b - a, d - c];
        let factors = [s * s, s * t, t * t];
        let scaled = |n: usize| Aabb {
            min: self.seconds[n].min.map(|x| factors[n] * x),
            max: self.seconds[n].max.map(|x| factors[n] * x),
        };
        let seconds = [0, 1, 2].map(scaled);
        let lengths = [0, 1, 2].map(|n| factors[n] * self.lengths[n]);
        let first = [times(s, middle.first[0]), times(t, middle.first[1])];
        let bulge = 0.125 * (lengths[0] + 2.0 * lengths[1] + lengths[2]) + PRODUCT_ROUNDING * self.scale;
        let half = [0, 1, 2].map(|k| 0.5 * (first[0][k].abs() + first[1][k].abs()) + bulge);
        let bounds = Aabb {
            min: [0, 1, 2].map(|k| (middle.place[k] - half[k]).max(whole.min[k])),
            max: [0, 1, 2].map(|k| (middle.place[k] + half[k]).min(whole.max[k])),
        };
        (Convexity::of(middle.place, first, seconds, lengths, self.scale), bounds)
    }

    fn of(place: Point, first: [Vector; 2], seconds: [Aabb; 3], lengths: Seconds, scale: f64) -> Convexity {
        let slopes = Slopes::new(first, lengths, [0.5; 2]);
        let (least, most) = (slopes.least(), slopes.greatest());
        let squares = [0, 1].map(|k| [least[k] * least[k], most[k] * most[k]]);
        Convexity { place, first, squares, product: slopes.product(), seconds, lengths, scale }
    }

    /// Whether the squared distance is convex over all of the piece, for any point nowhere farther from it than that.
    pub(super) fn holds(&self, distance: f64) -> bool {
        let [uu, uv, vv] = self.lengths;
        let [a, c] = [self.squares[0][0] - distance * uu, self.squares[1][0] - distance * vv];
        let b = greatest(self.product) + distance * uv;
        a > 0.0 && c > 0.0 && a * c > b * b
    }

    /// The minima of less than `limit` for a point; `bounds` are around the piece.
    pub(super) fn minima(&self, p: &Point, bounds: &Aabb, limit: f64) -> Minima {
        let around = Aabb { min: minus(bounds.min, *p), max: minus(bounds.max, *p) };
        let [uu, uv, vv] = self.seconds.each_ref().map(|s| product(&around, s));
        let sum = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
        let [uu, uv, vv] = [sum(self.squares[0], uu), sum(self.product, uv), sum(self.squares[1], vv)];
        if uu[1] < 0.0 || vv[1] < 0.0 {
            return Minima::None;
        }
        let away = minus(self.place, *p);
        let reach = norm(away);
        let slopes = self.first.map(|d| dot(away, d));
        let across = greatest(uv);
        for (k, own) in [uu, vv].into_iter().enumerate() {
            let rounding = PRODUCT_ROUNDING * (reach + self.scale) * self.squares[k][1].sqrt();
            if slopes[k].abs() > 0.5 * (greatest(own) + across) + rounding {
                return Minima::None;
            }
        }
        let (a, c) = (uu[0], vv[0]);
        if !(a > 0.0 && c > 0.0 && a * c > across * across) {
            return Minima::Unknown;
        }
        // `a x² − 2 b |x y| + c y²` is no less than the sum of these squares.
        let ratio = (a / c).sqrt();
        let square = reach * reach;
        let fall = fall(slopes[0], a - across * ratio) + fall(slopes[1], c - across / ratio);
        let rounding = PRODUCT_ROUNDING * (square + self.scale * reach);
        if square - 2.0 * fall > limit * limit + rounding { Minima::None } else { Minima::One }
    }
}

/// How far `slope·x + bend·x²/2` falls within half a unit around 0 at most.
fn fall(slope: f64, bend: f64) -> f64 {
    let slope = slope.abs();
    if slope < 0.5 * bend { 0.5 * slope * slope / bend } else { 0.5 * slope - 0.125 * bend.max(0.0) }
}

/// The greater magnitude of two.
fn greatest([a, b]: [f64; 2]) -> f64 {
    a.abs().max(b.abs())
}

/// Least and greatest scalar product of vectors within two boxes.
fn product(a: &Aabb, b: &Aabb) -> [f64; 2] {
    let mut range = [0.0; 2];
    for k in 0..3 {
        let ends = [a.min[k] * b.min[k], a.min[k] * b.max[k], a.max[k] * b.min[k], a.max[k] * b.max[k]];
        range[0] += ends[0].min(ends[1]).min(ends[2].min(ends[3]));
        range[1] += ends[0].max(ends[1]).max(ends[2].max(ends[3]));
    }
    range
}
