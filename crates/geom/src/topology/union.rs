//! Disjoint sets that several threads join at once.

use crate::memory::atomics;
use crate::parallel::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Members set up, or numbered, by one task.
const MEMBERS_PER_TASK: usize = 1 << 16;

/// Sets of the numbers `0..n`. A parent never has a larger number than its child. So the least member of a set ends up as its
/// root whatever the threads do.
pub struct Sets(Vec<AtomicU32>);

impl Sets {
    /// `n` sets of one.
    pub fn new(n: usize) -> Sets {
        let sets = Sets(atomics(n));
        let fill = |(i, part): (usize, &[AtomicU32])| {
            for (j, parent) in part.iter().enumerate() {
                parent.store((i * MEMBERS_PER_TASK + j) as u32, Relaxed);
            }
        };
        if n <= MEMBERS_PER_TASK {
            fill((0, &sets.0));
        } else {
            sets.0.par_chunks(MEMBERS_PER_TASK).enumerate().for_each(fill);
        }
        sets
    }

    /// The least member of the set of `a`, once all joins are done. Halves the path on the way.
    #[inline(always)]
    pub fn root(&self, mut a: u32) -> u32 {
        loop {
            let parent = self.0[a as usize].load(Relaxed);
            if parent == a {
                return a;
            }
            let grandparent = self.0[parent as usize].load(Relaxed);
            if grandparent != parent {
                // Another thread may have been faster; then its shortcut is as good.
                let _ = self.0[a as usize].compare_exchange(parent, grandparent, Relaxed, Relaxed);
            }
            a = grandparent;
        }
    }

    /// Makes one set of those of `a` and `b`.
    #[inline(always)]
    pub fn join(&self, a: u32, b: u32) {
        let (mut a, mut b) = (self.root(a), self.root(b));
        while a != b {
            if a < b {
                (a, b) = (b, a);
            }
            if self.0[a as usize].compare_exchange(a, b, Relaxed, Relaxed).is_ok() {
                return;
            }
            (a, b) = (self.root(a), self.root(b));
        }
    }

    /// Number of sets that hold a member for which `counts` says yes, and for each member the number of its set. That is
    /// [`u32::MAX`] where `counts` says no. Sets are numbered by their least member. Members of one set must agree about
    /// `counts`.
    pub fn numbered(&self, counts: impl Fn(u32) -> bool + Sync) -> (usize, Vec<u32>) {
        let is_first = |i: &u32| self.0[*i as usize].load(Relaxed) == *i && counts(*i);
        let n = self.0.len();
        let firsts: Vec<Vec<u32>> = (0..n.div_ceil(MEMBERS_PER_TASK))
            .into_par_iter()
            .map(|part| {
                (part * MEMBERS_PER_TASK..n.min((part + 1) * MEMBERS_PER_TASK))
                    .map(|i| i as u32)
                    .filter(is_first)
                    .collect()
            })
            .collect();
        let firsts = firsts.concat();
        let number_of = |i: u32| firsts.partition_point(|&f| f < self.root(i)) as u32;
        let one = firsts.len() == 1;
        let numbers = (0..n as u32)
            .into_par_iter()
            .map(|i| {
                if !counts(i) {
                    u32::MAX
                } else if one {
                    0
                } else {
                    number_of(i)
                }
            })
            .collect();
        (firsts.len(), numbers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_numbered_by_their_least_member() {
        let sets = Sets::new(7);
        for (a, b) in [(5, 1), (6, 5), (3, 2)] {
            sets.join(a, b);
        }
        assert_eq!(sets.numbered(|i| i != 4), (3, vec![0, 1, 2, 2, u32::MAX, 1, 1]));
        assert_eq!(Sets::new(0).numbered(|_| true), (0, vec![]));
    }

    #[test]
    fn threads_join_a_ring_into_one() {
        let n = 100_000u32;
        let sets = Sets::new(n as usize);
        (0..n).into_par_iter().for_each(|i| sets.join(i, (i + 7) % n));
        let (count, numbers) = sets.numbered(|_| true);
        assert_eq!((count, numbers.iter().max()), (1, Some(&0)));
    }
}
