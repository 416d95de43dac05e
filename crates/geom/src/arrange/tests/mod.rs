//! Tests.
mod unions;
