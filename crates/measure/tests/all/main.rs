//! Characteristics, plans and inspections, seen from outside. One program of all tests links once.
#![allow(
    clippy::disallowed_methods,
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test may stop"
)]

mod characteristics;
mod common;
mod intervals;
mod material;
mod plan_faults;
mod plan_readings;
mod profile;
mod uncertainty;
