//! Facets that hang on a surface without being part of it.
//!
//! The edges where more than two facets meet cut the mesh into sheets. A sheet is superfluous under three conditions.
//! The others do without it (two more facets at each of those edges). It encloses nothing. It is small, or hangs on all
//! sides (a wall inside). A sheet with a boundary edge is superfluous only where nothing else of its shell has one but
//! at holes. So parts of an open surface stay. Where a shell has as many facets one way as the other at every edge,
//! each sheet bounds material: bodies that touch in edges.

use super::edges::Edges;
use super::error::RepairError;
use super::holes;
use super::step::{Removes, Step};
use super::union::solid_shells;
use super::work::Work;
use std::collections::BTreeMap;
use trueness_geom::deviation::sign_choice::MIN_SHEET_OPENNESS;
use trueness_geom::space::{Vector, cross, minus, norm, plus};

pub(super) const STEP: Step = Step {
    name: "fins",
    about: "Removes sheets that hang on edges where two other facets meet: fins, and walls inside.",
    removes: Removes::Fins,
};

/// Sheets with boundary edges are fins as long as all of them together have at most this share of the area of their
/// shell. All fins of all rounds have at most this share of all area.
const MAX_FIN_SHARE: f64 = 0.1;

#[derive(Clone, Debug, Default)]
struct Sheet {
    facets: Vec<u32>,
    /// Twice the vector area, twice the area.
    vector: Vector,
    area: f64,
    has_rim: bool,
    /// Its edges with more than two facets, by index, and how many of them are its own.
    edges: BTreeMap<usize, usize>,
    /// It has boundary edges that are not of a hole to be filled.
    has_border: bool,
}

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    let known = work.known()?;
    if known.topology.non_manifold_edges.is_empty() {
        return Ok(());
    }
    let edges = Edges::of(work.mesh(), &known.topology);
    let of = edges.sheets(work.mesh().faces.len());
    let mut sheets = vec![Sheet::default(); of.len()];
    for (f, &s) in (0..).zip(&of).filter(|(f, _)| known.topology.shell_of[*f as usize] != u32::MAX) {
        let [a, b, c] = work.corners(f);
        let normal = cross(minus(b, a), minus(c, a));
        let sheet = &mut sheets[s as usize];
        sheet.facets.push(f);
        sheet.vector = plus(sheet.vector, normal);
        sheet.area += norm(normal);
    }
    let fillable = holes::fillable(work, &known);
    // How many facets there are at each edge of more than two.
    let mut meetings: Vec<usize> = vec![];
    for edge in edges.iter() {
        let of_edge: Vec<u32> = edge.iter().map(|s| of[s.facet as usize]).collect();
        match of_edge.len() {
            1 => {
                let sheet = &mut sheets[of_edge[0] as usize];
                sheet.has_rim = true;
                sheet.has_border |= !fillable.contains(&edge[0].ends);
            }
            2 => {}
            _ => {
                let edge = meetings.len();
                of_edge.iter().for_each(|s| *sheets[*s as usize].edges.entry(edge).or_default() += 1);
                meetings.push(of_edge.len());
            }
        }
    }
    let shell = |s: &Sheet| known.topology.shell_of[s.facets[0] as usize] as usize;
    let mut open = vec![false; known.topology.shells];
    let mut may_go: Vec<f64> = known.properties.shell_areas.iter().map(|area| MAX_FIN_SHARE * area).collect();
    // In all rounds together, as a share of the area at first.
    let mut removed_area = work.state.handover.fins_gone;
    let most = MAX_FIN_SHARE * (known.properties.area + removed_area);
    let encloses_nothing = |s: &Sheet| norm(s.vector) > 2.0 * MIN_SHEET_OPENNESS * s.area;
    let small = |s: &Sheet, may_go: &[f64]| !s.has_rim || 0.5 * s.area <= may_go[shell(s)];
    let is_fin = |s: &Sheet| !s.edges.is_empty() && encloses_nothing(s) && 0.5 * s.area <= may_go[shell(s)];
    for sheet in sheets.iter().filter(|s| !s.facets.is_empty() && s.has_border && !is_fin(s)) {
        open[shell(sheet)] = true;
    }
    let solid = solid_shells(work.mesh(), &known.topology);
    let mut candidates: Vec<u32> = (0..sheets.len() as u32)
        .filter(|s| !sheets[*s as usize].edges.is_empty() && !solid[shell(&sheets[*s as usize])])
        .filter(|s| encloses_nothing(&sheets[*s as usize]) && small(&sheets[*s as usize], &may_go))
        .filter(|s| !sheets[*s as usize].has_rim || !open[shell(&sheets[*s as usize])])
        .collect();
    candidates.sort_by(|a, b| sheets[*a as usize].area.total_cmp(&sheets[*b as usize].area));
    let mut removed = vec![];
    for s in candidates {
        let sheet = &sheets[s as usize];
        let not_needed = |(edge, own): (&usize, &usize)| meetings[*edge] >= own + 2;
        let fin = if sheet.has_rim { 0.5 * sheet.area } else { 0.0 };
        if small(sheet, &may_go) && removed_area + fin <= most && sheet.edges.iter().all(not_needed) {
            may_go[shell(sheet)] -= fin;
            removed_area += fin;
            sheet.edges.iter().for_each(|(edge, own)| meetings[*edge] -= own);
            let place = work.middle(sheet.facets[0]);
            work.log(&STEP, "superfluous sheet removed", place, sheet.facets.len(), 0.5 * sheet.area);
            removed.extend(&sheet.facets);
        }
    }
    work.state.handover.fins_gone = removed_area;
    if !removed.is_empty() {
        work.replace(&removed, &[]);
    }
    Ok(())
}
