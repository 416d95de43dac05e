//! The motions that datums hold and those they leave free.

use super::source::Datum;
use crate::rigid::Rigid;
use crate::space::{Vector, cross, dot, times};
use std::f64::consts::FRAC_PI_2;

/// Motions that a datum system leaves free, along and about the axes of its frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Freedom {
    /// Shifts along x, y, z.
    pub shift: [bool; 3],
    /// Turns about x, y, z.
    pub turn: [bool; 3],
}

impl Freedom {
    /// Everything is held.
    pub const NONE: Freedom = Freedom { shift: [false; 3], turn: [false; 3] };
    /// Nothing is held.
    pub const ALL: Freedom = Freedom { shift: [true; 3], turn: [true; 3] };
    /// Whether everything is held.
    pub fn is_none(&self) -> bool {
        *self == Freedom::NONE
    }
}

/// The frame of up to three datums.
///
/// A first plane gives z, into the material, and the origin's height; a first axis gives z and the origin's place across it. A
/// second plane gives x, into the material. A second axis gives the origin's place, and a third axis or center the direction of
/// x, towards it. y makes the frame right-handed.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// Takes measured coordinates to those of the frame.
    pub frame: Rigid,
    /// The motions that the datums leave free.
    pub free: Freedom,
    /// The datums.
    pub datums: Vec<Datum>,
}

impl System {
    /// The attitude that the datums hold.
    pub(super) fn held(&self) -> Held {
        let [x, _, z] = self.frame.rotation();
        if self.free.turn[2] { Held::Along(z) } else { Held::All([x, cross(z, x), z]) }
    }
}

/// Angle in radians within which datums count as parallel or perpendicular as drawn. A measured part is off by its own
/// deviations, which are far smaller, and a drawing's other angles are far larger.
pub const AS_DRAWN: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// The attitude that earlier datums hold.
#[derive(Clone, Copy)]
pub(super) enum Held {
    Nothing,
    Along(Vector),
    All([Vector; 3]),
}

/// The direction nearest to `direction` among those held, or the angle to the one that it is least parallel or perpendicular to.
pub(super) fn nearest(held: &[Vector], direction: Vector) -> Result<Vector, f64> {
    let angle = |v: &Vector| libm::acos(dot(*v, direction).abs().min(1.0));
    match held.iter().find(|v| angle(v) <= AS_DRAWN) {
        Some(v) => Ok(times(dot(*v, direction).signum(), *v)),
        None => {
            let oblique = |a: &f64| a.min(FRAC_PI_2 - a);
            let worst = held.iter().map(angle).max_by(|a, b| oblique(a).total_cmp(&oblique(b)));
            Err(worst.unwrap_or(0.0))
        }
    }
}
