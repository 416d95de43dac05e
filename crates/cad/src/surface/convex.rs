//! Where the distance from a piece of a surface has one minimum at most.
//!
//! Half the squared distance from `p` has the second derivatives `X_i·X_j + (X − p)·X_ij`. Over a rectangle of parameters on which they
//! are positive definite it is convex: a descent finds its only minimum. With bounds of the derivatives over the piece that is so
//! for all points within a distance of it: those of a scan near to its part, above all.

use super::bends::{Bends, Seconds, Slopes};
use trueness_geom::space::Vector;

/// Bounds of the derivatives of a piece.
#[derive(Clone, Debug)]
pub(super) struct Convexity {
    /// `X_u·X_u` and `X_v·X_v` at least.
    squares: [f64; 2],
    /// `|X_u·X_v|` at most.
    product: f64,
    seconds: Seconds,
}

impl Convexity {
    /// Of a part with these extents; first derivatives in its middle.
    pub(super) fn new(bends: &Bends, middle: [Vector; 2], sides: [f64; 2]) -> Convexity {
        let seconds = bends.greatest();
        let slopes = Slopes::new(middle, seconds, sides.map(|s| 0.5 * s));
        Convexity { squares: slopes.least().map(|s| s * s), product: slopes.product(), seconds }
    }

    /// Whether the squared distance is convex over all of the piece, for a point nowhere farther from it than that.
    pub(super) fn holds(&self, distance: f64) -> bool {
        let [uu, uv, vv] = self.seconds;
        let [a, c] = [self.squares[0] - distance * uu, self.squares[1] - distance * vv];
        let b = self.product + distance * uv;
        a > 0.0 && c > 0.0 && a * c > b * b
    }
}
