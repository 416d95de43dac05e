//! Loops over all threads of the current rayon pool.
//!
//! The names are those of rayon's parallel iterators, and each does what rayon's does; what is not here, rayon still has.
//! The difference is what the compiler makes of them: rayon compiles its whole splitting anew for every loop, and that was
//! three tenths of this crate. Here a loop is a function of a range of indices, and one function that is compiled once
//! hands the ranges to the threads ([decision 0013](https://github.com/trueness/trueness/blob/main/docs/decisions/0013-parallel-loops.md)).
//!
//! Items are taken in ascending ranges, [`PARTS`] of them for each thread at most, so that a thread that is done takes
//! another. `collect` keeps the order. Of several errors or matches the first in the order of the items is returned, on any
//! number of threads. `reduce`, `fold` and `sum` join neighbours in order, but where the parts end depends on the number of
//! threads: what they add must not depend on that (whole numbers, boxes, maxima; not sums of floating-point numbers).
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
#[cfg(test)]
mod tests;

use std::ops::Range;

/// What makes loops of slices, vectors and ranges.
pub mod prelude {
    pub use super::loops::{IntoParallel, Parallel};
}
pub use collect::FromParts;
pub use loops::{Folded, Loop, Scratched};
pub use source::Source;

/// Parts of a loop for each thread. More of them even out items of unequal cost; each costs a fraction of a microsecond.
const PARTS: usize = 16;

/// The parts that `len` items are done in, each of `least` or more of them.
fn count_parts(len: usize, least: usize) -> usize {
    let threads = rayon::current_num_threads();
    let most = if threads == 1 { 1 } else { PARTS * threads };
    (len / least.max(1)).max(1).min(most).min(len)
}

/// Part `part` of `parts` of `len` items. All are equally long to one item.
fn range(part: usize, parts: usize, len: usize) -> Range<usize> {
    let at = |part: usize| (part as u128 * len as u128 / parts as u128) as usize;
    at(part)..at(part + 1)
}

/// Does `work` on every part, on all threads of the current pool. The one place where rayon is asked.
fn each_part(parts: usize, work: &(dyn Fn(usize) + Sync)) {
    use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
    match parts {
        0 => {}
        1 => work(0),
        _ => (0..parts).into_par_iter().with_max_len(1).for_each(work),
    }
}
