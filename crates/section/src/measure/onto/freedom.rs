//! The motions that are free, and those that the outlines hold.

use super::place::Place;
use std::fmt;

/// The motions that are free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Freedom {
    /// Along the first axis, along the second, and turning.
    pub axes: [bool; 3],
}

impl Freedom {
    /// All.
    pub const FREE: Freedom = Freedom { axes: [true; 3] };
    /// Along both axes.
    pub const SHIFT: Freedom = Freedom { axes: [true, true, false] };
    /// Along the first axis.
    pub const X: Freedom = Freedom { axes: [true, false, false] };
    /// Along the second axis.
    pub const Y: Freedom = Freedom { axes: [false, true, false] };
    /// About the origin.
    pub const TURN: Freedom = Freedom { axes: [false, false, true] };

    /// How many unknowns there are.
    pub fn unknowns(&self) -> usize {
        self.axes().count()
    }

    /// The unknowns: 0 and 1 shifts, 2 the turn.
    pub(super) fn axes(&self) -> impl Iterator<Item = usize> + use<> {
        let axes = self.axes;
        (0..3).filter(move |k| axes[*k])
    }

    /// The request that can be made instead where this is free.
    pub(super) fn remedy(&self, free: &Free) -> String {
        match free {
            Free::Turns { .. } if self.axes[0] && self.axes[1] => "ask for --fit xy".into(),
            Free::Slides { direction: [x, _] }
                if self.axes[0] && self.axes[1] && x.abs() > ALONG_AXIS_COSINE =>
            {
                "ask for --fit y".into()
            }
            Free::Slides { direction: [_, y] }
                if self.axes[0] && self.axes[1] && y.abs() > ALONG_AXIS_COSINE =>
            {
                "ask for --fit x".into()
            }
            _ => "leave --fit out, or give a nominal that holds it".into(),
        }
    }
}

/// A direction is along an axis if its component is greater than this.
const ALONG_AXIS_COSINE: f64 = 0.999;

/// A motion that leaves all distances as they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Free {
    /// It slides along this unit direction.
    Slides {
        /// Where to.
        direction: [f64; 2],
    },
    /// It turns about a place.
    Turns {
        /// About which.
        center: [f64; 2],
    },
}

impl Free {
    /// Where the equations have no solution at all.
    pub(super) fn nothing_holds() -> Free {
        Free::Slides { direction: [1.0, 0.0] }
    }
}

impl fmt::Display for Free {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Free::Slides { direction: [x, y] } => {
                write!(f, "a shift along ({:.4}, {:.4}) is free", x + 0.0, y + 0.0)
            }
            Free::Turns { center: [x, y] } => write!(f, "a turn about ({x:.4}, {y:.4}) is free"),
        }
    }
}

/// Mean square displacement along the outline's normals per mean square displacement, above which a motion is held. A turned
/// ellipse whose axes differ by 3 % has about that.
const MIN_HELD_SHARE: f64 = 1e-4;
/// Share of the turn, counted as displacement, in a motion that counts as a slide.
const MAX_TURN_SHARE_OF_SLIDE: f64 = 0.01;

/// How the distance of a point grows with two shifts, and with a turn times an arm.
pub(super) fn slopes(point: [f64; 2], normal: [f64; 2], pivot: [f64; 2], arm: f64) -> [f64; 3] {
    let d = [point[0] - pivot[0], point[1] - pivot[1]];
    [normal[0], normal[1], (d[0] * normal[1] - d[1] * normal[0]) / arm]
}

/// Whether the outlines hold all that may move, chords that follow a curve taken for that. Else the motion that they do
/// not hold.
pub(super) fn held<'a>(
    places: impl Iterator<Item = (&'a Place, f64)>,
    pivot: [f64; 2],
    arm: f64,
    freedom: Freedom,
) -> Result<(), Free> {
    let (mut matrix, mut total) = ([[0.0; 3]; 3], 0.0);
    for (p, weight) in places {
        total += weight;
        let corner = p.is_corner.then(|| p.across());
        for direction in std::iter::once(p.smooth).chain(corner) {
            let s = slopes(p.place, direction, pivot, arm);
            for i in freedom.axes() {
                for j in freedom.axes() {
                    matrix[i][j] += weight * s[i] * s[j];
                }
            }
        }
    }
    // A motion that the question holds is held well.
    for k in (0..3).filter(|k| !freedom.axes[*k]) {
        matrix[k][k] = 2.0 * total;
    }
    let (value, [x, y, turn]) = least(matrix);
    if value > MIN_HELD_SHARE * total {
        return Ok(());
    }
    let turn = turn / arm;
    Err(if (turn * arm).powi(2) <= MAX_TURN_SHARE_OF_SLIDE {
        let size = libm::hypot(x, y).max(f64::MIN_POSITIVE);
        let sign = if x + y < 0.0 { -1.0 } else { 1.0 };
        Free::Slides { direction: [sign * x / size, sign * y / size] }
    } else {
        Free::Turns { center: [pivot[0] - y / turn, pivot[1] + x / turn] }
    })
}

/// Least eigenvalue of a symmetric matrix and its unit vector, by Jacobi's rotations.
fn least(mut a: [[f64; 3]; 3]) -> (f64, [f64; 3]) {
    let mut v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..JACOBI_SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let (sin, cos) = libm::sincos(0.5 * libm::atan2(2.0 * a[p][q], a[p][p] - a[q][q]));
            for k in 0..3 {
                (a[k][p], a[k][q]) = (cos * a[k][p] + sin * a[k][q], cos * a[k][q] - sin * a[k][p]);
                (v[k][p], v[k][q]) = (cos * v[k][p] + sin * v[k][q], cos * v[k][q] - sin * v[k][p]);
            }
            for k in 0..3 {
                (a[p][k], a[q][k]) = (cos * a[p][k] + sin * a[q][k], cos * a[q][k] - sin * a[p][k]);
            }
        }
    }
    let k = if a[0][0] <= a[1][1] && a[0][0] <= a[2][2] {
        0
    } else if a[1][1] <= a[2][2] {
        1
    } else {
        2
    };
    (a[k][k], [v[0][k], v[1][k], v[2][k]])
}

/// Sweeps of rotations; each squares the entries off the diagonal.
const JACOBI_SWEEPS: usize = 12;
