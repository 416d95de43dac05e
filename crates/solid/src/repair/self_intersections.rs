//! Facets that still cross when nothing else is left to do: the last resort.
//!
//! The facets of all crossing pairs are cut out. If that cuts a shell into several pieces, those that are small beside its
//! largest piece are removed too. The step that fills holes then fills the holes, whatever their size; where no patch fits,
//! it widens them.

use super::error::RepairError;
use super::scraps::sheets;
use super::step::{Removes, Step};
use super::work::Work;
use trueness_geom::check::finding::area;

pub(super) const STEP: Step = Step {
    name: "self_intersections",
    about: "Tears out facets that still cross others when nothing else helps, and what they cut off; the holes are \
            filled afterwards. Sheets keep their crossings.",
    removes: Removes::Crossings,
};

/// No more than this share of the area is cut out: the rest beyond that would be another model.
const MAX_CUT_OUT_SHARE: f64 = 0.75;
/// A piece cut off is removed if it has at most this share of the area of the largest piece of its shell.
const MAX_SMALL_PIECE_SHARE: f64 = 0.25;

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    if !work.state.handover.may_cut_out {
        return Ok(());
    }
    // Nothing would be left of a tangle.
    let Some(mut crossings) = work.crossings(|_, _| true)? else { return Ok(()) };
    let known = work.known()?;
    // A sheet is no body: where it crosses something, nothing is wrong with its surface.
    let sheet = sheets(work)?;
    let in_sheet = |f: &u32| sheet[known.topology.shell_of[*f as usize] as usize];
    crossings.retain(|pair| !pair.iter().any(in_sheet));
    if crossings.is_empty() {
        return Ok(());
    }
    let shell_of = known.topology.shell_of.clone();
    let mut is_removed = vec![false; work.mesh().faces.len()];
    crossings.iter().flatten().for_each(|f| is_removed[*f as usize] = true);
    let area_of = |wanted: bool| -> f64 {
        let facets = (0..).zip(&is_removed).filter(|(_, t)| **t || !wanted);
        facets.map(|(f, _)| area(work.corners(f))).sum()
    };
    if area_of(true) > MAX_CUT_OUT_SHARE * area_of(false) {
        return Ok(());
    }
    let removed: Vec<u32> = (0..).zip(&is_removed).filter(|(_, t)| **t).map(|(f, _)| f).collect();
    let place = work.middle(crossings[0][0]);
    work.log(&STEP, "crossing facets torn out", place, removed.len(), 0.0);
    work.cut_out(&removed);
    let left = shell_of.into_iter().zip(is_removed).filter(|(_, removed)| !removed).map(|(shell, _)| shell);
    remove_small_pieces(work, &left.collect::<Vec<u32>>())
}

/// Removes the small pieces that were cut off; `shell_of` is the shell of each facet before the cut.
fn remove_small_pieces(work: &mut Work, shell_of: &[u32]) -> Result<(), RepairError> {
    let known = work.known()?;
    let areas = &known.properties.shell_areas;
    let pieces = (0..).zip(&known.topology.shell_of).filter(|(_, s)| **s != u32::MAX);
    let mut of_piece = vec![(u32::MAX, vec![]); known.topology.shells];
    for (f, &piece) in pieces {
        let entry: &mut (u32, Vec<u32>) = &mut of_piece[piece as usize];
        entry.0 = shell_of[f as usize];
        entry.1.push(f);
    }
    let mut largest = std::collections::BTreeMap::<u32, f64>::new();
    for (piece, (shell, _)) in of_piece.iter().enumerate() {
        let area = largest.entry(*shell).or_default();
        *area = area.max(areas[piece]);
    }
    let mut removed = vec![];
    for (piece, (shell, facets)) in of_piece.into_iter().enumerate() {
        if areas[piece] <= MAX_SMALL_PIECE_SHARE * largest.get(&shell).copied().unwrap_or(0.0) {
            work.log(&STEP, "piece cut off removed", work.middle(facets[0]), facets.len(), areas[piece]);
            removed.extend(facets);
        }
    }
    if !removed.is_empty() {
        work.cut_out(&removed);
    }
    Ok(())
}
