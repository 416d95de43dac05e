//! How a loop is split into parts, and who does them.

use std::ops::Range;

/// Parts of a loop for each thread. More of them even out items of unequal cost; each costs a fraction of a microsecond.
const PARTS_PER_THREAD: usize = 16;

/// The parts that `len` items are done in, each of `least` or more of them.
pub(super) fn count_parts(len: usize, least: usize) -> usize {
    let threads = rayon::current_num_threads();
    let most = if threads == 1 { 1 } else { PARTS_PER_THREAD * threads };
    (len / least.max(1)).max(1).min(most).min(len)
}

/// Part `part` of `parts` of `len` items. All are equally long to one item.
pub(super) fn range(part: usize, parts: usize, len: usize) -> Range<usize> {
    let at = |part: usize| (part as u128 * len as u128 / parts as u128) as usize;
    at(part)..at(part + 1)
}

/// Does `work` on every part, on all threads of the current pool. The one place where rayon is asked.
pub(super) fn each_part(parts: usize, work: &(dyn Fn(usize) + Sync)) {
    use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
    match parts {
        0 => {}
        1 => work(0),
        _ => (0..parts).into_par_iter().with_max_len(1).for_each(work),
    }
}
