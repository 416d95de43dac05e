//! Features, zones and statistics, seen from outside. One program of all tests links once.
#![allow(
    clippy::disallowed_methods,
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test may stop"
)]

mod common_datum;
mod degenerate_surfaces;
mod feature;
mod oracles;
mod process;
mod properties;
mod zone;
