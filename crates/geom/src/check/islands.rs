//! Shells so small that they are likely dust.

use super::{DefectKind, Inspected, Measure, Severity, Shows};
use crate::parallel::prelude::*;
use crate::space::Aabb;

pub(super) const KIND: DefectKind = DefectKind {
    name: "islands",
    severity: Severity::Warning,
    about: "Shells that are small beside the whole: dust of a scan, or crumbs of a conversion. \
            Facets: the first of the shell.",
    size: "diagonal, mm",
    measure: Measure::Diagonal,
    shows: Shows::Shell,
    follows: false,
    missing: None,
    find: |m| {
        let bounds = shell_bounds(m);
        let limit = m.options.island_share * m.properties.bounds.diagonal();
        let small: Vec<usize> = (0..bounds.len()).filter(|&s| bounds[s].1.diagonal() < limit).collect();
        // A mesh that is all dust has no islands.
        let small = if small.len() == bounds.len() { vec![] } else { small };
        m.each(&small, |&s| {
            let (first, bounds) = bounds[s];
            let mut finding = m.finding(vec![first], vec![], bounds.diagonal());
            finding.position = std::array::from_fn(|k| bounds.min[k] / 2.0 + bounds.max[k] / 2.0);
            finding.bounds = bounds;
            finding.measures = vec![("shell", s as f64), ("area", m.properties.shell_areas[s])];
            finding
        })
    },
};

/// The lowest facet and the box of each shell.
pub(super) fn shell_bounds(m: &Inspected) -> Vec<(u32, Aabb)> {
    let mut bounds = vec![(u32::MAX, Aabb::EMPTY); m.topology.shells];
    if let [(first, only)] = &mut bounds[..] {
        // Nearly every mesh; its facets need not be looked at one by one.
        *first = m.topology.shell_of.iter().position(|&s| s == 0).unwrap_or(0) as u32;
        *only = m.properties.bounds;
        return bounds;
    }
    let parts: Vec<Vec<Run>> = m
        .topology
        .shell_of
        .par_chunks(ISLAND_FACETS_PER_TASK)
        .enumerate()
        .map(|(i, part)| runs(m, i * ISLAND_FACETS_PER_TASK, part))
        .collect();
    for (shell, facet, run) in parts.into_iter().flatten() {
        let (first, all) = &mut bounds[shell as usize];
        *first = (*first).min(facet);
        *all = all.union(&run);
    }
    bounds
}

/// Facets of one task.
const ISLAND_FACETS_PER_TASK: usize = 1 << 13;

/// Consecutive facets of one shell: its number, the first of them, their box.
type Run = (u32, u32, Aabb);

/// The runs among the facets from `first` on, which have these shells.
fn runs(m: &Inspected, first: usize, shells: &[u32]) -> Vec<Run> {
    let mut runs: Vec<Run> = vec![];
    for (f, &shell) in (first as u32..).zip(shells).filter(|(_, shell)| **shell != u32::MAX) {
        let own = Aabb::of(&m.corners(f));
        match runs.last_mut() {
            Some((of, _, bounds)) if *of == shell => *bounds = bounds.union(&own),
            _ => runs.push((shell, f, own)),
        }
    }
    runs
}
