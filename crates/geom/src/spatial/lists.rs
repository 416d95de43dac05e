//! Lists of neighbors, one behind the other in one array.

use crate::parallel::prelude::*;

/// For each of `count` numbers the place of its list's begin, and one more for the end; and the lists. A list holds the second
/// of each pair, listed by the first, ascending and once each.
pub fn lists(count: usize, mut pairs: Vec<[u32; 2]>) -> (Vec<u32>, Vec<u32>) {
    pairs.par_sort_unstable();
    pairs.dedup();
    let mut first = vec![0u32; count + 1];
    for pair in &pairs {
        first[pair[0] as usize + 1] += 1;
    }
    for i in 0..count {
        first[i + 1] += first[i];
    }
    (first, pairs.into_iter().map(|p| p[1]).collect())
}
