//! Pairs as they are found: counted, the least of them kept, those of facets that are there several times multiplied.

use crate::topology::Topology;
use std::collections::BTreeMap;

/// Facets that are there more than once: only the first of them is searched, and its pairs stand for those of the others.
#[derive(Default)]
pub(super) struct Copies {
    /// For each first facet all of them, ascending.
    of: BTreeMap<u32, Vec<u32>>,
    /// Whether a facet has an earlier copy; empty where none has.
    later: Vec<bool>,
}

impl Copies {
    pub fn new(topology: &Topology) -> Copies {
        let mut copies = Copies::default();
        if topology.duplicate_facets.is_empty() {
            return copies;
        }
        copies.later = vec![false; topology.shell_of.len()];
        for &[first, again] in &topology.duplicate_facets {
            copies.later[again as usize] = true;
            copies.of.entry(first).or_insert_with(|| vec![first]).push(again);
        }
        copies.of.values_mut().for_each(|all| all.sort_unstable());
        copies
    }

    /// Whether an earlier facet stands for this one.
    pub fn later(&self, facet: u32) -> bool {
        self.later.get(facet as usize).copied().unwrap_or(false)
    }

    /// The flags of facets, where a facet that stands for others has theirs too.
    pub fn joined(&self, selected: &[bool]) -> Vec<bool> {
        let mut joined = selected.to_vec();
        for (first, all) in &self.of {
            joined[*first as usize] = all.iter().any(|f| selected[*f as usize]);
        }
        joined
    }

    /// All facets that this one stands for, ascending.
    fn all<'a>(&'a self, facet: &'a u32) -> &'a [u32] {
        self.of.get(facet).map_or(std::slice::from_ref(facet), |all| all)
    }
}

/// The pairs found that are of interest.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub copies: &'a Copies,
    /// Flags of the facets of which each pair has one; `None`: all.
    pub selected: Option<&'a [bool]>,
    /// So many of the least are listed.
    pub limit: usize,
}

/// Pairs found so far, of which the least are of interest.
pub(super) struct Pairs<'a> {
    pub wanted: Wanted<'a>,
    pub count: usize,
    /// The pairs of interest, and perhaps others that are not yet sorted out.
    pub first: Vec<[u32; 2]>,
}

impl<'a> Pairs<'a> {
    /// None yet.
    pub fn new(wanted: Wanted<'a>) -> Pairs<'a> {
        Pairs { wanted, count: 0, first: vec![] }
    }

    /// Takes in a pair, and those for which it stands.
    pub fn push(&mut self, a: u32, b: u32) {
        let Wanted { copies, selected, limit } = self.wanted;
        if copies.of.is_empty() {
            self.count += 1;
            self.first.push([a.min(b), a.max(b)]);
            return self.cut(limit);
        }
        let (a, b) = (copies.all(&a), copies.all(&b));
        let asked = |f: &u32| selected.is_none_or(|selected| selected[*f as usize]);
        let unasked = |all: &[u32]| all.iter().filter(|f| !asked(f)).count();
        self.count += a.len() * b.len() - unasked(a) * unasked(b);
        // By their lower facet, then by their higher one; no more than can be listed.
        let mut lower: Vec<(u32, &[u32])> =
            a.iter().map(|f| (*f, b)).chain(b.iter().map(|f| (*f, a))).collect();
        lower.sort_unstable_by_key(|l| l.0);
        let pairs = lower.into_iter().flat_map(|(x, others)| {
            let from = others.partition_point(|y| *y < x);
            others[from..].iter().map(move |y| [x, *y])
        });
        self.first.extend(pairs.filter(|[x, y]| asked(x) || asked(y)).take(limit));
        self.cut(limit);
    }

    /// Takes in what another part of the search gave.
    pub fn append(&mut self, part: Pairs) {
        self.count += part.count;
        self.first.extend(part.first);
        self.cut(self.wanted.limit);
    }

    /// Drops what is not of interest, once there are more than `slack` (and a few) beyond those asked for.
    pub fn cut(&mut self, slack: usize) {
        /// Pairs are never sorted out sooner: most meshes have few.
        const MIN_PAIRS_TO_CUT: usize = 1 << 10;
        let (spare, limit) = (if slack == 0 { 0 } else { MIN_PAIRS_TO_CUT }, self.wanted.limit);
        if self.first.len() > limit.saturating_add(slack).saturating_add(spare) {
            if limit > 0 {
                self.first.select_nth_unstable(limit - 1);
            }
            self.first.truncate(limit);
        }
    }
}
