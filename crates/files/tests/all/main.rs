//! Readers and writers, seen from outside. One program of all tests links once.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used, reason = "a test may stop")]

mod check;
mod common;
mod corpus;
mod endings;
mod exactness;
mod format_lists;
mod free_form;
mod hostile;
mod large;
mod sources;
mod tables;
