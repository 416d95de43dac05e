//! Surfaces through points, seen from outside. One program of all tests links once.
#![allow(clippy::unwrap_used, reason = "a test may stop")]

mod fit;
mod uneven_meshes;
