//! Which facets a plane cuts, one after another.

use trueness_geom::mesh::Mesh;

/// An edge of the mesh by its vertices, the lower first.
pub type MeshEdge = [u32; 2];

/// A stretch of a section within one face.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The face.
    pub face: u32,
    /// The edges of facets that it passes; a closed one passes the first again.
    pub edges: Vec<MeshEdge>,
    /// Whether it never leaves the face.
    pub closed: bool,
}

/// The way through a facet.
struct Step {
    face: u32,
    from: MeshEdge,
    to: MeshEdge,
}

/// The runs of each outline, and whether it closes. `above` tells of each vertex on which side of the plane it is; so a facet is cut in
/// two edges or none. The material is on the left, as seen against the normal, where facets run counter-clockwise outside.
pub fn ways(mesh: &Mesh, faces: &[u32], above: &[bool]) -> Vec<(Vec<Run>, bool)> {
    let mut steps: Vec<Step> = vec![];
    for (facet, face) in mesh.faces.iter().zip(faces) {
        let (mut from, mut to) = (None, None);
        for k in 0..3 {
            let [a, b] = [facet[k], facet[(k + 1) % 3]];
            let edge = [a.min(b), a.max(b)];
            match (above[a as usize], above[b as usize]) {
                (true, false) => from = Some(edge),
                (false, true) => to = Some(edge),
                _ => {}
            }
        }
        steps.extend(from.zip(to).map(|(from, to)| Step { face: *face, from, to }));
    }
    let within = |s: &Step| [(s.face, s.from), (s.face, s.to)];
    let runs: Vec<Run> = chains(&steps, within)
        .into_iter()
        .map(|(chain, closed)| {
            let first = steps[chain[0]].from;
            let passed = chain.iter().map(|s| steps[*s].to);
            let edges = std::iter::once(first).chain(passed).take(chain.len() + usize::from(!closed));
            Run { face: steps[chain[0]].face, edges: edges.collect(), closed }
        })
        .collect();
    let (whole, parts): (Vec<Run>, Vec<Run>) = runs.into_iter().partition(|run| run.closed);
    let ends = |run: &Run| [run.edges[0], run.edges[run.edges.len() - 1]];
    let joined = chains(&parts, ends).into_iter();
    let joined = joined.map(|(chain, closed)| (chain.iter().map(|r| parts[*r].clone()).collect(), closed));
    joined.chain(whole.into_iter().map(|run| (vec![run], true))).collect()
}

/// Items one after another, each begins where the one before ends, and whether the last leads to the first. Of several that begin at one
/// place the first is taken.
fn chains<T, K: Ord + Copy>(items: &[T], ends: impl Fn(&T) -> [K; 2]) -> Vec<(Vec<usize>, bool)> {
    let mut starts: Vec<(K, usize)> = items.iter().zip(0..).map(|(item, i)| (ends(item)[0], i)).collect();
    starts.sort_unstable();
    let mut reached: Vec<K> = items.iter().map(|item| ends(item)[1]).collect();
    reached.sort_unstable();
    let mut used = vec![false; items.len()];
    let mut all = vec![];
    for is_closed in [false, true] {
        for first in 0..items.len() {
            let [start, _] = ends(&items[first]);
            if used[first] || !is_closed && reached.binary_search(&start).is_ok() {
                continue;
            }
            let mut chain = vec![];
            let mut next = Some(first);
            while let Some(item) = next {
                used[item] = true;
                chain.push(item);
                let [_, end] = ends(&items[item]);
                let from = starts.partition_point(|s| s.0 < end);
                next = starts[from..].iter().take_while(|s| s.0 == end).map(|s| s.1).find(|i| !used[*i]);
            }
            let closed = chain.last().is_some_and(|last| ends(&items[*last])[1] == start);
            all.push((chain, closed));
        }
    }
    all
}
