//! Numerical tools: sums, random numbers, special functions.

pub mod random;
pub mod sum;
