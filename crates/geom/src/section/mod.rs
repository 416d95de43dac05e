//! Sections: the lines, arcs and curves of a row of points, and the places where they join.
//!
//! | file | what |
//! |---|---|
//! | `row` | rows as they come: what is wrong with them |
//! | `start` | noise; independent lines and arcs by dynamic programming |
//! | `chain`, `free` | pieces that join with a common tangent, as curvature along the length |
//! | `least` | their least-squares fit |
//! | `search` | number and kinds of pieces |
//! | `profile` | intervals of the joins |
//! | `cut` | where a plane cuts a mesh |
//! | `span`, `contour`, `convert` | corners, chains between them, the contour as lines, arcs and B-splines |

#![allow(clippy::needless_range_loop, reason = "matrices are read by row and column")]

mod chain;
mod contour;
mod convert;
mod cut;
mod free;
mod least;
mod profile;
mod result;
mod row;
mod search;
mod span;
mod start;
#[cfg(test)]
mod tests;

pub use chain::Kind;
pub use contour::contour;
pub use cut::{Chain, Plane, PlaneFrame, area, cut};
pub use result::{Continuity, Contour, Geometry, Join, Options, SectionError, Segment};
