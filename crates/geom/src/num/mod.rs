//! Numerical tools: sums, random numbers, special functions.

pub mod banded;
pub mod big;
pub mod cholesky;
pub mod dense;
pub(crate) mod double;
pub mod exact;
pub mod golden;
pub mod interval;
pub mod median;
pub mod multigrid;
pub mod predicates;
pub mod random;
pub(crate) mod rounding;
pub mod sparse;
pub mod special;
pub mod sum;
