//! Loops some of which run the wrong way.
//!
//! Programs write holes that run along with the loop around them, and bands around a surface that closes whose two loops run the same
//! way. Where turning some of the loops, and no other choice of as few of them, bounds an area, that is meant.

use super::error::TrimError;
use super::{Border, Trim, chain};
use crate::brep::{EdgeUse, Loop};

/// Loops of a face whose senses are tried.
const MAX_TRIED: usize = 6;

/// The only trim with as few turned loops as can be.
///
/// # Errors
/// [`TrimError::Contradiction`]: no choice of loops bounds an area, or several do.
pub(super) fn only(border: &Border, loops: &[Loop]) -> Result<Trim, TrimError> {
    let count = loops.len();
    if !(2..=MAX_TRIED).contains(&count) {
        return Err(TrimError::Contradiction);
    }
    for turned in 1..count as u32 {
        let choices = (1..1u32 << count).filter(|choice| choice.count_ones() == turned);
        let mut found = choices.filter_map(|choice| {
            let uses = chain::bounding_uses(&with_turned(loops, choice), border.face.reversed).ok()?;
            border.trim(&uses, true).ok()
        });
        match (found.next(), found.next()) {
            (Some(only), None) => return Ok(only),
            (Some(_), Some(_)) => return Err(TrimError::Contradiction),
            (None, _) => {}
        }
    }
    Err(TrimError::Contradiction)
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
