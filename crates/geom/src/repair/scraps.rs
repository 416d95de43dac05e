//! Open sheets that lie about beside a closed shell.

use super::work::Work;
use super::{RepairError, SHEET, Step};
use crate::space::{Vector, cross, minus, norm, plus};

pub(super) const STEP: Step = Step {
    name: "scraps",
    about: "Removes open sheets that enclose nothing and have less than a tenth of the area of the largest closed shell.",
    run,
};

/// Share of the area of the largest closed shell up to which a sheet is a scrap.
const SCRAP: f64 = 0.1;

fn run(work: &mut Work) -> Result<(), RepairError> {
    let known = work.known()?;
    let (topology, areas) = (&known.topology, &known.properties.shell_areas);
    let mut open = vec![false; topology.shells];
    for e in &topology.boundary_edges {
        open[topology.shell_of[e.facet as usize] as usize] = true;
    }
    let closed = areas.iter().zip(&open).filter(|(_, open)| !**open).map(|(a, _)| *a);
    let limit = SCRAP * closed.fold(0.0, f64::max);
    let small = |s: usize| open[s] && areas[s] < limit;
    if !(0..topology.shells).any(small) {
        return Ok(());
    }
    let mut shells = vec![([0.0; 3] as Vector, vec![]); topology.shells];
    for (f, &s) in (0..).zip(&topology.shell_of) {
        if s != u32::MAX && small(s as usize) {
            let [a, b, c] = work.corners(f);
            let shell = &mut shells[s as usize];
            shell.0 = plus(shell.0, cross(minus(b, a), minus(c, a)));
            shell.1.push(f);
        }
    }
    let mut removed = vec![];
    for (s, (vector, facets)) in shells.into_iter().enumerate().filter(|(_, shell)| !shell.1.is_empty()) {
        if 0.5 * norm(vector) > SHEET * areas[s] {
            work.log(STEP.name, "loose sheet removed", work.middle(facets[0]), facets.len(), areas[s]);
            removed.extend(facets);
        }
    }
    if !removed.is_empty() {
        work.replace(&removed, &[]);
    }
    Ok(())
}
