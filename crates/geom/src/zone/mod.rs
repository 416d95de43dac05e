//! Tolerance zones: the smallest zone of a given form and attitude that holds all points.
//!
//! A zone of form alone is a fit ([`crate::fit`] by minimum zone). The zones here are held by datums: their direction is
//! given, or stands at a given angle to a given direction and is free to turn about it, or a frame leaves some motions free.
//!
//! | zone | where |
//! |---|---|
//! | between two parallel planes | [`slab`], [`slab_at_angle`] |
//! | within a cylinder | [`tube`], [`tube_at_angle`] |
//! | about a true geometry, with motions left free | [`motion`] |
//! | frames that datums make | [`datum`] |
//! | parameters of areal texture | [`texture`] |
//! | two-point sizes | [`two_point_diameters`], [`two_point_distances`] |

mod azimuth;
mod circle;
pub mod datum;
mod error;
mod local_size;
pub mod motion;
mod planes;
pub mod texture;
mod tubes;

pub use error::ZoneError;
pub use local_size::{TwoPoint, two_point_diameters, two_point_distances};
pub use planes::{Slab, parallel_planes, slab, slab_at_angle};
pub use tubes::{Tube, tube, tube_at_angle};
