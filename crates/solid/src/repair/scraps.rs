//! Open sheets that lie about beside a closed shell.

use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;
use trueness_geom::deviation::sign_choice::MIN_SHEET_OPENNESS;
use trueness_geom::space::{Vector, cross, minus, norm, plus};
use trueness_geom::topology::Topology;

pub(super) const STEP: Step = Step {
    name: "scraps",
    about: "Removes open sheets that enclose nothing and have less than a tenth of the area of the largest closed shell.",
    removes: Removes::Sheets,
};

/// Share of the area of the largest closed shell up to which a sheet is a scrap.
const MAX_SCRAP_SHARE: f64 = 0.1;

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    let known = work.known()?;
    let (topology, areas) = (&known.topology, &known.properties.shell_areas);
    let open = open_shells(topology);
    let closed = areas.iter().zip(&open).filter(|(_, open)| !**open).map(|(a, _)| *a);
    let limit = MAX_SCRAP_SHARE * closed.fold(0.0, f64::max);
    if !(0..topology.shells).any(|s| open[s] && areas[s] < limit) {
        return Ok(());
    }
    let sheet = sheets(work)?;
    let mut shells = vec![vec![]; topology.shells];
    for (f, &s) in (0..).zip(&topology.shell_of) {
        if s != u32::MAX && sheet[s as usize] && areas[s as usize] < limit {
            shells[s as usize].push(f);
        }
    }
    let mut removed = vec![];
    for (s, facets) in shells.into_iter().enumerate().filter(|(_, shell)| !shell.is_empty()) {
        work.log(&STEP, "loose sheet removed", work.middle(facets[0]), facets.len(), areas[s]);
        removed.extend(facets);
    }
    if !removed.is_empty() {
        work.lose(&removed);
    }
    Ok(())
}

/// Which shells have a rim.
fn open_shells(topology: &Topology) -> Vec<bool> {
    let mut open = vec![false; topology.shells];
    for e in &topology.boundary_edges {
        open[topology.shell_of[e.facet as usize] as usize] = true;
    }
    open
}

/// Which shells are open sheets that enclose nothing.
pub(super) fn sheets(work: &mut Work) -> Result<Vec<bool>, RepairError> {
    let known = work.known()?;
    let (topology, areas) = (&known.topology, &known.properties.shell_areas);
    let open = open_shells(topology);
    let mut vector: Vec<Vector> = vec![[0.0; 3]; topology.shells];
    for (f, &s) in (0..).zip(&topology.shell_of) {
        if s != u32::MAX && open[s as usize] {
            let [a, b, c] = work.corners(f);
            let of = &mut vector[s as usize];
            *of = plus(*of, cross(minus(b, a), minus(c, a)));
        }
    }
    Ok((0..topology.shells)
        .map(|s| open[s] && 0.5 * norm(vector[s]) > MIN_SHEET_OPENNESS * areas[s])
        .collect())
}
