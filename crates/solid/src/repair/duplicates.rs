//! Facets that are there more than once.
//!
//! One of the facets with the same three vertices stays, or none: the one that its neighbors need. At each of its three
//! edges the other facets are counted by direction; where they lack one, they vote for it.

use super::edges::Edges;
use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;
use std::collections::BTreeMap;
use trueness_geom::check::finding;

pub(super) const STEP: Step = Step {
    name: "duplicates",
    about: "Keeps one of several facets with the same three vertices, where the neighbors need one; else removes all.",
    removes: Removes::Nothing,
};

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    let known = work.known()?;
    if known.topology.duplicate_facets.is_empty() {
        return Ok(());
    }
    let edges = Edges::of(work.mesh(), &known.topology);
    let (mut removed, mut directions) = (vec![], Directions::default());
    let mut pairs = known.topology.duplicate_facets.clone();
    pairs.sort_unstable();
    for group in pairs.chunk_by(|a, b| a[0] == b[0]) {
        work.go_on()?;
        let facets: Vec<u32> = [group[0][0]].into_iter().chain(group.iter().map(|d| d[1])).collect();
        let kept = wanted(work, &edges, &mut directions, &facets);
        let others = facets.iter().copied().filter(|f| Some(*f) != kept);
        let before = removed.len();
        removed.extend(others);
        let (place, area) = (work.middle(facets[0]), finding::area(work.corners(facets[0])));
        work.log(&STEP, "facets at the same place removed", place, removed.len() - before, area);
    }
    work.replace(&removed, &[]);
    Ok(())
}

/// For edges asked about, how many facets run up them and how many down: at one edge there may be very many groups.
#[derive(Default)]
struct Directions(BTreeMap<[u32; 2], [isize; 2]>);

impl Directions {
    /// Facets that run from `from` to `to`, and those that run the other way.
    fn at(&mut self, edges: &Edges, from: u32, to: u32) -> [isize; 2] {
        let count = || {
            let up = edges.at(from, to).iter().filter(|s| s.up).count();
            [up as isize, (edges.at(from, to).len() - up) as isize]
        };
        let [up, down] = *self.0.entry([from.min(to), from.max(to)]).or_insert_with(count);
        if from < to { [up, down] } else { [down, up] }
    }
}

/// Which of the facets stays.
fn wanted(work: &Work, edges: &Edges, directions: &mut Directions, facets: &[u32]) -> Option<u32> {
    let [a, b, c] = work.mesh().faces[facets[0] as usize];
    let turned_as_first = |f: u32| {
        let face = work.mesh().faces[f as usize];
        (0..3).any(|k| face[k] == a && face[(k + 1) % 3] == b)
    };
    let own = facets.iter().filter(|f| turned_as_first(**f)).count() as isize;
    let (mut votes, mut neighbors) = (0, 0);
    for (from, to) in [(a, b), (b, c), (c, a)] {
        let [along, against] = directions.at(edges, from, to);
        let others = [along - own, against - (facets.len() as isize - own)];
        neighbors += others[0] + others[1];
        votes += others[1] - others[0];
    }
    match votes {
        // The rest needs none of them, or does not know.
        0 if neighbors > 0 && neighbors % 2 == 0 => None,
        0.. => facets.iter().copied().find(|&f| turned_as_first(f)),
        // One that looks the wrong way is turned later.
        _ => facets.iter().copied().find(|&f| !turned_as_first(f)).or(Some(facets[0])),
    }
}
