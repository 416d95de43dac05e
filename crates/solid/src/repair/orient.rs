//! Neighbors that face different ways.
//!
//! A sheet is a set of facets connected through edges of two facets. All facets of one are made to run the way round
//! that the larger part of its area runs already. A surface with one side only, such as Möbius's, keeps its seam.

use super::edges::{Edges, Side};
use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;
use trueness_geom::check::finding;

pub(super) const STEP: Step = Step {
    name: "orient",
    about: "Turns facets over until neighbors run the same way round; the smaller part of each sheet is turned.",
    removes: Removes::Nothing,
};

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    let known = work.known()?;
    if known.topology.inconsistent_edges.is_empty() {
        return Ok(());
    }
    let edges = Edges::of(work.mesh(), &known.topology);
    let facets = work.mesh().faces.len();
    let mut across: Vec<(u32, u32, bool)> = vec![];
    for edge in edges.iter() {
        if let [Side { facet: f, up: p, .. }, Side { facet: g, up: q, .. }] = *edge {
            across.extend([(f, g, p == q), (g, f, p == q)]);
        }
    }
    across.sort_unstable();
    let mut turned: Vec<Option<bool>> = vec![None; facets];
    let mut turns = vec![];
    for first in 0..facets as u32 {
        if turned[first as usize].is_none() {
            work.go_on()?;
            let sheet = flood(first, &across, &mut turned);
            turns.push(smaller(work, &sheet, &turned));
        }
    }
    for part in turns.into_iter().filter(|part| !part.is_empty()) {
        let area = part.iter().map(|&f| finding::area(work.corners(f))).sum();
        work.log(&STEP, "facets turned over", work.middle(part[0]), part.len(), area);
        work.turn(part);
    }
    Ok(())
}

/// The facets connected with `first`; for each, whether it must be turned to run as `first` does.
fn flood(first: u32, across: &[(u32, u32, bool)], turned: &mut [Option<bool>]) -> Vec<u32> {
    let mut sheet = vec![first];
    turned[first as usize] = Some(false);
    let mut next = 0;
    while let Some(&f) = sheet.get(next) {
        next += 1;
        let from = across.partition_point(|a| a.0 < f);
        for &(_, g, differ) in across[from..].iter().take_while(|a| a.0 == f) {
            if turned[g as usize].is_none() {
                turned[g as usize] = turned[f as usize].map(|t| t != differ);
                sheet.push(g);
            }
        }
    }
    sheet
}

/// The facets of the sheet that must be turned, or all others, whichever have less area.
fn smaller(work: &Work, sheet: &[u32], turned: &[Option<bool>]) -> Vec<u32> {
    let part = |which: bool| -> Vec<u32> {
        sheet.iter().copied().filter(|f| turned[*f as usize] == Some(which)).collect()
    };
    let (yes, no) = (part(true), part(false));
    let area = |part: &[u32]| part.iter().map(|&f| finding::area(work.corners(f))).sum::<f64>();
    if area(&yes) <= area(&no) { yes } else { no }
}
