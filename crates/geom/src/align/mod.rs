//! Alignment: the rigid motion that brings what was measured onto its reference.
//!
//! | task | where |
//! |---|---|
//! | best fit of a scan from any pose | [`best_fit`] |
//! | the same of a part that may be larger or smaller as a whole | [`best_fit_scaled`] |
//! | the pose with the least greatest distance | [`minimax`] |
//! | the pose with the least greatest excess over tolerances | [`into_zones`] |
//! | how a best fit answers to small shifts of what was measured | [`response`] |
//! | pairs of places that belong together | [`pairs`] |
//! | 3-2-1 and reference point systems (RPS) | [`constrained`] |
//!
//! [`best_fit`] goes three steps:
//! 1. *Start* (`features`, `field`, `start`): poses from principal axes and from pairs of points with normals. Each is tried on
//!    a grid of distances about the reference. The best are refined on a few hundred samples.
//! 2. *Iteration* (`icp`, `system`): closest points and small motions over the whole surface, weighted by area. Normals must be
//!    compatible, and outliers have no weight. It ends when a step is less than a thousandth of its own uncertainty.
//! 3. *What the result is worth* (`loose`, `rims`, `freedom`, `covariance`, `wall`): covariance, motions that are not held, other poses that fit as
//!    well (`look`, `mirror`).
//!
//! Where a mesh only draws exact surfaces ([`ExactSurface`]), the iteration ends on these, and the figures are those of distances from them.
//!
//! [`minimax`] and [`into_zones`] begin there and search on by linear programs (`counting`, `perturbed`).
//!
//! All answers are the same for any number of threads; random choices depend on the seed alone.

#![allow(clippy::needless_range_loop, reason = "matrices are read by row and column")]

mod alignment;
mod alternatives;
mod best_fit;
mod counting;
mod covariance;
mod error;
mod features;
mod field;
mod freedom;
mod icp;
mod look;
mod loose;
mod minimax;
mod mirror;
mod near;
mod perturbed;
mod response;
mod revolved;
mod rims;
mod rows;
mod sample;
mod scaled;
mod settle;
mod start;
mod system;
mod target;
#[cfg(test)]
mod tests;
mod twist;
mod wall;
mod work;
mod zones;

pub use alignment::{AlignWarning, Alignment, Alternative, BestFit, Start};
pub use best_fit::best_fit;
pub use counting::NotCounted;
pub use error::AlignError;
pub use freedom::Freedom;
pub use minimax::{Minimax, minimax};
pub use response::{Response, response};
pub use rows::{MIN_AMPLIFICATION, Row, RowFit, constrained, pairs};
pub use sample::Measured;
pub use scaled::{Scale, best_fit_scaled};
pub use target::{ExactFoot, ExactSurface, Target};
pub use twist::Lock;
pub use zones::{InZones, ZoneAt, into_zones};
