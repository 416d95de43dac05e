//! Deviations of scattered points as a map on the reference: each place shows the worst point near it.
//!
//! The reference may have facets far larger than the points are apart. For drawing, its facets are cut into pieces ([`bisection`]) about
//! as large as the points lie densely. While the points pass by, each piece keeps the worst of those whose nearest place lies in it. In
//! the end ([`surface`]) pieces are put together until they match the points' spacing ([`crate::spacing`]).
//!
//! Of a measured mesh with large facets places [`between`] its vertices count in it, too.
//!
//! Beside it, where asked for, stand mean deviations at [`places`] that are the same for every part.

mod between;
mod bisection;
mod creases;
mod facet;
mod fill;
mod places;
mod point_map;
mod surface;

pub use between::Between;
pub use places::PlaceMeans;
pub use point_map::{Flagged, Foot, PointMap};
pub use surface::MapSurface;

#[cfg(test)]
mod tests;
