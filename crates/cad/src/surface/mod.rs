//! Surfaces of faces: places and derivatives by `u` and `v`, as ISO 10303-42 states them.
//!
//! | kind | place at `u`, `v`, in its frame |
//! |---|---|
//! | plane | `(u, v, 0)` |
//! | cylinder | `(r·cos u, r·sin u, v)` |
//! | cone | `((r + v·tan α)·cos u, (r + v·tan α)·sin u, v)` |
//! | sphere | `r·(cos v·cos u, cos v·sin u, sin v)` |
//! | torus | `((R + r·cos v)·cos u, (R + r·cos v)·sin u, r·sin v)` |
//! | spline | by its knots |
//! | extrusion | `curve(u) + v·direction` |
//! | revolution | `curve(v)`, turned by `u` about the axis |
//! | offset | that of another surface, moved along its normal `∂u × ∂v` |
//!
//! The normal of a surface is `∂u × ∂v`; that of a face may be the opposite.

mod bends;
mod convex;
mod evaluate;
mod extent;
mod feet;
mod foot;
mod kinds;
mod net;
mod parameters;
mod patch;
mod placed;
mod profile;
mod seams;
mod spline;
#[cfg(test)]
mod tests;

pub(crate) use bends::{Bends, Seconds, Slopes};
pub use feet::SurfaceFeet;
pub use foot::Foot;
pub use kinds::{Surface, SurfaceKind};
pub(crate) use patch::Patch;
pub use seams::Pole;
pub use trueness_geom::spline::surface::Jet;
