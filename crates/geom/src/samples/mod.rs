//! Meshes for tests and examples: simple bodies, and bodies with defects whose number is known.

#![allow(clippy::unwrap_used, clippy::panic, clippy::disallowed_methods, reason = "they are for tests alone")]

mod bodies;
mod planted;

pub use bodies::{add, block, cube, inverted, on_threads, sphere};
pub use planted::{counts, planted, sound};
