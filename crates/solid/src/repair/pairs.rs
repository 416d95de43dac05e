//! Known pairs of facets that meet where they should not, while facets come and go.
//!
//! Whether two facets meet follows from their corners alone. So where facets are removed and others added, the pairs of
//! those that stay are known, and only the added facets must be looked at.

use std::ops::Range;

/// Pairs of facets that meet where they should not.
#[derive(Clone, Debug, Default)]
pub(super) enum Pairs {
    /// Nothing is known.
    #[default]
    Unknown,
    /// There are too many among so many facets.
    Tangle(usize),
    /// All of the first so many facets, sorted.
    All(Vec<[u32; 2]>, usize),
}

impl Pairs {
    /// The facets, below `facets`, whose pairs are not known.
    pub fn new_facets(&self, facets: usize) -> Option<Range<usize>> {
        match self {
            Pairs::Unknown => Some(0..facets),
            Pairs::Tangle(searched) => (*searched != facets).then_some(0..facets),
            Pairs::All(_, searched) => (*searched < facets).then_some(*searched..facets),
        }
    }

    /// Takes in the pairs found of the new facets, which makes `facets` in all; `None`: too many.
    pub fn take_in(&mut self, found: Option<Vec<[u32; 2]>>, facets: usize) {
        let known = match std::mem::take(self) {
            Pairs::All(pairs, _) => pairs,
            _ => vec![],
        };
        *self = match found {
            None => Pairs::Tangle(facets),
            Some(mut found) => {
                found.extend(known);
                found.sort_unstable();
                Pairs::All(found, facets)
            }
        };
    }

    /// All of them, if they are known and not too many.
    pub fn all(&self) -> Option<&[[u32; 2]]> {
        match self {
            Pairs::All(pairs, _) => Some(pairs),
            _ => None,
        }
    }

    /// Facets are removed: those for which `keep` says no. The others keep their order.
    pub fn keep(&mut self, keep: &[bool]) {
        let Pairs::All(pairs, searched) = self else {
            *self = Pairs::Unknown;
            return;
        };
        let mut number = vec![u32::MAX; keep.len()];
        for (new, (old, _)) in (0..).zip(keep.iter().enumerate().filter(|(_, keep)| **keep)) {
            number[old] = new;
        }
        pairs.retain_mut(|pair| {
            *pair = pair.map(|f| number[f as usize]);
            !pair.contains(&u32::MAX)
        });
        *searched = keep[..*searched].iter().filter(|keep| **keep).count();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_of_facets_that_stay_are_kept() {
        let mut pairs = Pairs::Unknown;
        assert_eq!(pairs.new_facets(5), Some(0..5));
        pairs.take_in(Some(vec![[0, 3], [1, 2], [2, 4]]), 5);
        assert_eq!((pairs.new_facets(5), pairs.new_facets(7)), (None, Some(5..7)));
        pairs.keep(&[true, false, true, true, true, true, false]);
        assert_eq!((pairs.all(), pairs.new_facets(5)), (Some(&[[0, 2], [1, 3]][..]), Some(4..5)));
        pairs.take_in(Some(vec![[0, 4]]), 5);
        assert_eq!(pairs.all(), Some(&[[0, 2], [0, 4], [1, 3]][..]));
        pairs.take_in(None, 6);
        assert_eq!((pairs.all(), pairs.new_facets(6), pairs.new_facets(9)), (None, None, Some(0..9)));
        pairs.keep(&[true]);
        assert_eq!(pairs.new_facets(1), Some(0..1));
    }
}
