//! Loops over all threads of the current rayon pool.
//!
//! The names are those of rayon's parallel iterators, and each does what rayon's does; what is not here, rayon still has. The
//! difference is in the compiled code: rayon compiles its whole splitting anew for every loop, and that was three tenths of
//! this crate. Here a loop is a function of a range of indices, and one function that is compiled once hands the ranges to the
//! threads (`docs/decisions/0013-parallel-loops.md`).
//!
//! Items are taken in ascending ranges, 16 of them for each thread at most, so that a thread that is done takes another.
//! `collect` keeps the order. The first of several errors or matches, in the order of the items, is returned, on any number of
//! threads. `reduce`, `fold` and `sum` join neighbors in order, but the ends of the parts depend on the number of threads.
//! Their additions must not depend on that: whole numbers, boxes, maxima, not sums of floating-point numbers.
//!
//! ```
//! use trueness_geom::parallel::prelude::*;
//! let squares: Vec<u64> = (0..1000u64).into_par_iter().map(|i| i * i).collect();
//! assert_eq!(squares[999], 998_001);
//! assert_eq!(squares.par_iter().position_first(|s| *s > 50), Some(8));
//! ```

mod collect;
mod loops;
mod source;
mod split;
#[cfg(test)]
mod tests;

/// Loops out of slices, vectors and ranges.
pub mod prelude {
    pub use super::loops::{IntoParallel, Parallel};
}
pub use collect::FromParts;
pub use loops::{Folded, Loop, Scratched};
pub use source::Source;
