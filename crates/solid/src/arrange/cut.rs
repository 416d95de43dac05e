//! The pieces of the facets of a cluster.

use super::cluster::{Cluster, Line, Segment};
use super::meetings::{Edge, edge};
use super::points::Points;
use super::triangulate::{self, Triangles, next, triangulate};
use std::cmp::Ordering;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::predicates::side_of_line;

/// A triangle of the arrangement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Piece {
    /// They run the same way round as those of `facet`.
    pub corners: [u32; 3],
    /// The lowest facet that it is part of.
    pub facet: u32,
    /// Facets that it is part of, less those that run the other way round.
    pub jump: i32,
}

/// Pieces of a cluster.
#[derive(Default)]
pub(super) struct Pieces {
    pub pieces: Vec<Piece>,
    /// Further facets of a piece, and whether they run the same way round.
    pub further: Vec<(usize, u32, bool)>,
}

/// The points of a cluster as its triangulation sees them.
struct Seen<'a> {
    points: &'a Points<'a>,
    axis: usize,
    numbers: &'a [u32],
    /// On which of the first 64 segments each point lies: those of one segment lie on a line.
    on: Vec<u64>,
}

impl triangulate::Plane for Seen<'_> {
    fn orient(&self, [a, b, c]: [u32; 3]) -> i32 {
        let [i, j, k] = [a, b, c].map(|p| p as usize);
        if self.on[i] & self.on[j] & self.on[k] != 0 {
            return 0;
        }
        self.points.orient(self.axis, [self.numbers[i], self.numbers[j], self.numbers[k]])
    }
    fn compare(&self, a: u32, b: u32) -> Ordering {
        let [a, b] = [a, b].map(|p| self.numbers[p as usize]);
        let along = |k: usize| self.points.compare(k % 3, a, b);
        along(self.axis + 1).then_with(|| along(self.axis + 2))
    }
    fn rough(&self, point: u32) -> [f64; 2] {
        let p = self.points.rough(self.numbers[point as usize]);
        [p[(self.axis + 1) % 3], p[(self.axis + 2) % 3]]
    }
}

/// Sorts points on a segment from its first end to its second.
pub(super) fn along(points: &Points, [a, b]: [u32; 2], on: &mut Vec<u32>) {
    let (from, to) = (points.rough(a), points.rough(b));
    let reach = |k: usize| (to[k] - from[k]).abs();
    let mut axes = [0, 1, 2];
    axes.sort_by(|i, j| reach(*j).total_cmp(&reach(*i)));
    let Some(k) = axes.into_iter().find(|&k| points.compare(k, a, b).is_ne()) else { return };
    let up = points.compare(k, a, b).is_lt();
    on.sort_unstable_by(|p, q| if up { points.compare(k, *p, *q) } else { points.compare(k, *q, *p) });
    on.dedup();
}

/// Cuts a cluster; `of_edge` gives the points on an edge in their order. `None` where the findings contradict
/// themselves.
pub(super) fn cut(
    mesh: &Mesh,
    points: &Points,
    cluster: &Cluster,
    of_edge: &dyn Fn(Edge) -> Vec<u32>,
) -> Option<Pieces> {
    let mut numbers = cluster.points.clone();
    let mut chains = vec![];
    for s in &cluster.segments {
        let mut chain = match s.line {
            Line::Edge(e) => of_edge(e),
            Line::Cut(_) => {
                let mut on = s.on.clone();
                along(points, s.ends, &mut on);
                on
            }
        };
        chain.insert(0, s.ends[0]);
        chain.push(s.ends[1]);
        numbers.extend(&chain);
        chains.push(chain);
    }
    numbers.sort_unstable();
    numbers.dedup();
    let local = |p: &u32| numbers.binary_search(p).map_or(0, |i| i as u32);
    let mut on = vec![0u64; numbers.len()];
    let mut edges = vec![];
    for (i, chain) in chains.iter_mut().enumerate() {
        chain.iter_mut().for_each(|p| *p = local(p));
        if i < 64 {
            chain.iter().for_each(|p| on[*p as usize] |= 1 << i);
        }
        edges.extend(chain.windows(2).map(|w| edge(w[0], w[1])));
    }
    edges.sort_unstable();
    edges.dedup();
    let seen = Seen { points, axis: cluster.axis, numbers: &numbers, on };
    let triangles = triangulate(numbers.len() as u32, &edges, &seen)?;
    let chain_of = |e: Edge| {
        // Edges come first, sorted.
        let before = |s: &Segment| matches!(s.line, Line::Edge(f) if f < e);
        let i = cluster.segments.partition_point(before);
        chains.get(i).filter(|_| cluster.segments[i].line == Line::Edge(e))
    };
    let mut pieces = Pieces::default();
    // For each triangle its piece.
    let mut piece_of = vec![usize::MAX; triangles.from.len() / 3];
    let mut first_turn = vec![];
    for &facet in &cluster.facets {
        let corners = mesh.faces[facet as usize];
        let [a, b, c] = corners.map(|v| &mesh.positions[v as usize]);
        let turn = side_of_line(cluster.axis, a, b, c);
        let inside = match cluster.facets.len() {
            1 => (0..triangles.from.len() as u32 / 3).collect(),
            _ => inside(&triangles, boundary(&triangles, corners, turn, &chain_of)?),
        };
        for t in inside {
            let piece = &mut piece_of[t as usize];
            if *piece == usize::MAX {
                *piece = pieces.pieces.len();
                let [a, b, c] = [0, 1, 2].map(|k| numbers[triangles.from[3 * t as usize + k] as usize]);
                let corners = if turn > 0 { [a, b, c] } else { [a, c, b] };
                pieces.pieces.push(Piece { corners, facet, jump: 1 });
                first_turn.push(turn);
            } else {
                let same = turn == first_turn[*piece];
                pieces.pieces[*piece].jump += if same { 1 } else { -1 };
                pieces.further.push((*piece, facet, same));
            }
        }
    }
    Some(pieces)
}

/// The half-edges along the boundary of a facet, the facet on their left.
fn boundary<'a>(
    triangles: &Triangles,
    [a, b, c]: [u32; 3],
    turn: i32,
    chain_of: &impl Fn(Edge) -> Option<&'a Vec<u32>>,
) -> Option<Vec<u32>> {
    let mut all = vec![];
    for (p, q) in [(a, b), (b, c), (c, a)] {
        let chain = chain_of(edge(p, q))?;
        // Chains run from the lower vertex to the higher one.
        let with = (p < q) == (turn > 0);
        for w in chain.windows(2) {
            all.push(if with { triangles.directed(w[0], w[1]) } else { triangles.directed(w[1], w[0]) }?);
        }
    }
    Some(all)
}

/// The triangles that are reached from these half-edges without crossing one of them.
fn inside(triangles: &Triangles, boundary: Vec<u32>) -> Vec<u32> {
    let mut barrier = vec![false; triangles.from.len()];
    boundary.iter().for_each(|e| barrier[*e as usize] = true);
    let mut reached = vec![false; triangles.from.len() / 3];
    let (mut stack, mut all) = (boundary.iter().map(|e| e / 3).collect::<Vec<u32>>(), vec![]);
    while let Some(t) = stack.pop() {
        if std::mem::replace(&mut reached[t as usize], true) {
            continue;
        }
        all.push(t);
        for e in [3 * t, next(3 * t), 3 * t + 2] {
            let twin = triangles.twin[e as usize];
            if !barrier[e as usize] && twin != u32::MAX {
                stack.push(twin / 3);
            }
        }
    }
    all.sort_unstable();
    all
}
