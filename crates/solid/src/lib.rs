//! Meshes as boundaries of solids: findings of [`check`](trueness_geom::check) are mended, and crossing shells become
//! one.
//!
//! | task | where |
//! |---|---|
//! | defects mended without moving a vertex | [`repair`] |
//! | meshes cut where facets meet, unions of shells | [`arrange`] |
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test does not hang on the last digit"))]

pub mod arrange;
mod neighborhood;
pub mod repair;
