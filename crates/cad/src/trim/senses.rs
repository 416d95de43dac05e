//! Loops some of which run the wrong way.
//!
//! Programs write holes that run along with the loop around them, and bands around a surface that closes whose two loops run the same
//! way. Where turning some of the loops, and no other choice of as few of them, bounds an area, that is meant.

use crate::brep::{EdgeUse, Loop};

/// Loops of a face whose senses are tried.
const MAX_LOOPS_TURNED: usize = 6;

/// The loops with some of them turned: all choices of one loop, then of two, and so on, but not of all. None of more loops than are tried.
pub(super) fn choices(loops: &[Loop]) -> impl Iterator<Item = Vec<Vec<Loop>>> {
    let count = if loops.len() > MAX_LOOPS_TURNED { 0 } else { loops.len() as u32 };
    (1..count).map(move |turned| {
        let chosen = (1..1u32 << count).filter(|choice| choice.count_ones() == turned);
        chosen.map(|choice| with_turned(loops, choice)).collect()
    })
}

fn with_turned(loops: &[Loop], choice: u32) -> Vec<Loop> {
    let turn = |(k, own): (usize, &Loop)| match own {
        Loop::Edges(uses) if choice >> k & 1 == 1 => {
            let turned = |u: &EdgeUse| EdgeUse { edge: u.edge, reversed: !u.reversed };
            Loop::Edges(uses.iter().rev().map(turned).collect())
        }
        own => own.clone(),
    };
    loops.iter().enumerate().map(turn).collect()
}
