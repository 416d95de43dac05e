//! Vector instructions: what the processor has, and vectors of numbers for it.
//!
//! Every kernel is written once for any vector type and compiled for each [`Level`]. All levels give the same bits.

pub(crate) mod lanes;
#[cfg(target_arch = "x86_64")]
pub(crate) mod lanes_x86;
mod level;
pub mod widest;

pub use level::Level;
