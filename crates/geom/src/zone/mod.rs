//! Tolerance zones: the smallest zone of a given form and attitude that holds all points.
//!
//! A zone of form alone is a fit ([`crate::fit`] by minimum zone). Datums hold the zones here. Their direction is given, or
//! stands at a given angle to a given direction and is free to turn about it. Or a frame leaves some motions free.
//!
//! | zone | where |
//! |---|---|
//! | between two parallel planes | [`slab`], [`slab_at_angle`] |
//! | within a cylinder | [`tube`], [`tube_at_angle`] |
//! | about a true geometry, with motions left free | [`motion`] |
//! | frames that datums make | [`datum`] |
//! | parameters of areal texture | [`texture`] |
//! | global sizes of two opposite planes | [`opposite_planes`] |
//! | the centers of a cylinder's sections | [`median_line`] |
//! | points by sections across a direction | [`sections`] |
//! | the form below noise | [`smooth`] |
//! | two-point sizes | [`two_point_diameters`], [`two_point_distances`] |

mod azimuth;
mod circle;
pub mod datum;
mod error;
mod local_size;
mod mean;
mod median_line;
pub mod motion;
mod opposite;
mod planes;
mod sections;
mod smooth;
pub mod texture;
mod tubes;

pub use error::ZoneError;
pub use local_size::{TwoPoint, two_point_diameters, two_point_distances};
pub use mean::mean;
pub use median_line::{MedianLine, median_line};
pub use opposite::{Opposite, opposite_planes};
pub use planes::{Slab, parallel_planes, slab, slab_at_angle};
pub use sections::sections;
pub use smooth::{Smooth, smooth};
pub use tubes::{Tube, tube, tube_at_angle};
