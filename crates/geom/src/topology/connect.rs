//! How the facets of a mesh hang together: edges, shells, and every place where they do not form a surface.
//!
//! No list of edges is made. Each vertex is examined on its own. Every facet at it has a next and a previous corner there; an
//! edge to vertex `w` means that `w` is among these. The vertex is in order if the next corners and the previous corners match
//! one to one and form a single ring. Comparisons of sixteen numbers at a time find that out. Every other vertex takes the
//! general way: its corners are sorted and counted. Each edge is counted at its lower end.
#![allow(unsafe_code, reason = "vector instructions that the processor is known to have")]

use super::EdgeAt;
use super::fans::{Fans, Spoke, TOPOLOGY_ITEMS_PER_TASK};
use super::same::{ROW_WIDTH, Row, Same};
use super::union::Sets;
use crate::mesh::Mesh;
use crate::num::predicates;
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::simd::Level;
use crate::simd::lanes::Plain;
#[cfg(target_arch = "x86_64")]
use crate::simd::lanes_x86::{A16, Z16};

/// Where a mesh is not a surface, in the order of the lower vertex of the edge, and the parts it falls into.
#[derive(Default)]
pub(super) struct Connection {
    pub edges: usize,
    pub boundary: Vec<EdgeAt>,
    pub non_manifold: Vec<EdgeAt>,
    pub inconsistent: Vec<EdgeAt>,
    pub non_manifold_vertices: Vec<u32>,
    pub duplicates: Vec<[u32; 2]>,
    /// Vertices with more than [`MIN_CROWDED_FACETS`] facets.
    pub hubs: Vec<u32>,
}

/// Facets at a vertex from which on it pays not to compare each with each.
pub(super) const MIN_CROWDED_FACETS: usize = 500;

/// An edge end at a vertex: the other end, whether the facet runs towards it, position among the spokes, third corner.
type End = (u32, bool, u32, u32);

/// The part of the work that one task does.
struct Part<'a> {
    mesh: &'a Mesh,
    shells: &'a Sets,
    spokes: Vec<Spoke>,
    found: Connection,
}

/// Looks at all vertices; facets connected through an edge become one set of `shells`.
pub(super) fn connect(
    mesh: &Mesh,
    fans: &Fans,
    shells: &Sets,
    level: Level,
    progress: &dyn Progress,
) -> Connection {
    let vertices = fans.len();
    let parts: Vec<Connection> = (0..vertices.div_ceil(TOPOLOGY_ITEMS_PER_TASK))
        .into_par_iter()
        .filter(|_| !progress.cancelled())
        .map(|i| {
            let range =
                (i * TOPOLOGY_ITEMS_PER_TASK) as u32..vertices.min((i + 1) * TOPOLOGY_ITEMS_PER_TASK) as u32;
            let mut part = Part { mesh, shells, spokes: vec![], found: Connection::default() };
            match level {
                // SAFETY: nobody asks for a level that the processor does not have.
                #[cfg(target_arch = "x86_64")]
                Level::Avx512 => unsafe { avx512(&mut part, fans, range) },
                #[cfg(target_arch = "x86_64")]
                Level::Avx2 => unsafe { avx2(&mut part, fans, range) },
                _ => part.vertices::<Plain<ROW_WIDTH>>(fans, range),
            }
            part.found
        })
        .collect();
    let mut all = Connection::default();
    for part in parts {
        all.edges += part.edges;
        all.boundary.extend(part.boundary);
        all.non_manifold.extend(part.non_manifold);
        all.inconsistent.extend(part.inconsistent);
        all.non_manifold_vertices.extend(part.non_manifold_vertices);
        all.duplicates.extend(part.duplicates);
        all.hubs.extend(part.hubs);
    }
    all.duplicates.sort_unstable_by_key(|d| d[1]);
    all
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,popcnt")]
fn avx2(part: &mut Part, fans: &Fans, vertices: std::ops::Range<u32>) {
    part.vertices::<A16>(fans, vertices);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,bmi1,popcnt")]
fn avx512(part: &mut Part, fans: &Fans, vertices: std::ops::Range<u32>) {
    part.vertices::<Z16>(fans, vertices);
}

impl Part<'_> {
    #[inline(always)]
    fn vertices<S: Same<ROW_WIDTH>>(&mut self, fans: &Fans, vertices: std::ops::Range<u32>) {
        let mut spokes = std::mem::take(&mut self.spokes);
        for v in vertices {
            fans.spokes(&self.mesh.faces, v, &mut spokes);
            let ring = (3..=ROW_WIDTH).contains(&spokes.len()) && self.ring::<S>(v, &spokes);
            if !ring && !spokes.is_empty() {
                self.count(v, &mut spokes);
            }
        }
        self.spokes = spokes;
    }

    /// True, and counted, if the facets form one ring around `v`, all running the same way.
    #[inline(always)]
    fn ring<S: Same<ROW_WIDTH>>(&mut self, v: u32, spokes: &[Spoke]) -> bool {
        let mut before = Row([u32::MAX; ROW_WIDTH]);
        for (b, s) in before.0.iter_mut().zip(spokes) {
            *b = s[1];
        }
        let (mut met, mut follower) = (0, [0u8; ROW_WIDTH]);
        for (f, s) in follower.iter_mut().zip(spokes) {
            // SAFETY: `connect` chose `S` among what the processor has.
            let m = unsafe { S::same(&before.0, s[0]) };
            if m.count_ones() != 1 || met & m != 0 {
                return false;
            }
            met |= m;
            *f = m.trailing_zeros() as u8;
        }
        let (mut at, mut steps) = (0, 0);
        loop {
            (at, steps) = (follower[at] as usize, steps + 1);
            if at == 0 || steps > ROW_WIDTH {
                break;
            }
        }
        if steps != spokes.len() {
            return false;
        }
        for (i, s) in spokes.iter().enumerate().filter(|(_, s)| s[0] > v) {
            self.found.edges += 1;
            self.shells.join(s[2], spokes[follower[i] as usize][2]);
        }
        true
    }

    /// The general case: any number of facets in any arrangement around `v`.
    fn count(&mut self, v: u32, spokes: &mut [Spoke]) {
        if spokes.len() > MIN_CROWDED_FACETS {
            self.found.hubs.push(v);
        }
        spokes.sort_unstable_by_key(|s| s[2]);
        let of_spoke = |(i, s): (u32, &Spoke)| [(s[0], true, i, s[1]), (s[1], false, i, s[0])];
        let mut ends: Vec<End> = (0..).zip(spokes.iter()).flat_map(of_spoke).collect();
        ends.sort_unstable();
        let local = Sets::new(spokes.len());
        let mut doubled = false;
        for group in ends.chunk_by(|a, b| a.0 == b.0) {
            group.iter().for_each(|e| local.join(group[0].2, e.2));
            if group[0].0 > v {
                self.edge(v, group, spokes);
                let mut third: Vec<u32> = group.iter().map(|e| e.3).collect();
                third.sort_unstable();
                doubled |= third.windows(2).any(|p| p[0] == p[1]);
            }
        }
        if (0..spokes.len() as u32).any(|i| local.root(i) != 0) {
            self.found.non_manifold_vertices.push(v);
        }
        if doubled {
            self.duplicates(v, spokes);
        }
    }

    /// Counts the edge from `v` to the common other end of `group`.
    fn edge(&mut self, v: u32, group: &[End], spokes: &[Spoke]) {
        self.found.edges += 1;
        let facet = |e: &End| spokes[e.2 as usize][2];
        let Some(lowest) = group.iter().min_by_key(|e| e.2) else { return };
        let vertices = if lowest.1 { [v, lowest.0] } else { [lowest.0, v] };
        let at = EdgeAt { vertices, facet: facet(lowest) };
        match group {
            [_] => self.found.boundary.push(at),
            [a, b] if a.1 == b.1 => self.found.inconsistent.push(at),
            [_, _] => {}
            _ => self.found.non_manifold.push(at),
        }
        group.iter().for_each(|e| self.shells.join(at.facet, facet(e)));
    }

    /// Facets at `v` that have the same three corners, of which `v` is the lowest. Facets without area are another defect.
    fn duplicates(&mut self, v: u32, spokes: &[Spoke]) {
        let others = |s: &Spoke| (s[0].min(s[1]), s[0].max(s[1]), s[2]);
        let mut here: Vec<_> = spokes.iter().map(others).filter(|o| o.0 > v).collect();
        here.sort_unstable();
        for same in here.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter(|same| same.len() > 1) {
            let corners = self.mesh.faces[same[0].2 as usize].map(|v| self.mesh.positions[v as usize]);
            if predicates::axis(&corners).is_some() {
                self.found.duplicates.extend(same[1..].iter().map(|again| [same[0].2, again.2]));
            }
        }
    }
}
