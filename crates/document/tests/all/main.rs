//! Documents and tolerance classes, seen from outside. One program of all tests links once.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, reason = "a test may stop")]

mod schema;
mod tolerance_class;
