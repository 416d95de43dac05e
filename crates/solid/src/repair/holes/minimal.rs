//! The triangulation of a ring that has the least area, or bends least.
//!
//! All ways to cut the ring are weighed by dynamic programming: the part behind a chord is best filled by itself. That
//! takes the cube of the number of vertices; longer rings first lose ears, the shortest chord first, until few enough
//! are left.

use super::patch::Patch;
use super::ring::Ring;
use super::site::Site;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use trueness_geom::num::predicates;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, normal, plus, unit};

/// Vertices of a ring up to which all ways are weighed: 200,000 triangles.
const MAX_VERTICES_WEIGHED: usize = 100;

/// The quantity to minimize.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Aim {
    /// The area.
    Area,
    /// The largest angle between neighbors, then the area.
    Bend,
}

/// Cost of a triangulation.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cost {
    bend: f64,
    area: f64,
}

impl Cost {
    const ZERO: Cost = Cost { bend: 0.0, area: 0.0 };
    const IMPOSSIBLE: Cost = Cost { bend: f64::INFINITY, area: f64::INFINITY };

    fn plus(self, other: Cost) -> Cost {
        Cost { bend: self.bend.max(other.bend), area: self.area + other.area }
    }
    fn less(self, other: Cost) -> bool {
        self.bend.total_cmp(&other.bend).then(self.area.total_cmp(&other.area)) == Ordering::Less
    }
}

/// A patch without new vertices; `None` where every one would repeat an edge of the mesh or have a facet without area.
pub(super) fn patch(site: &Site, ring: &Ring, aim: Aim) -> Option<Patch> {
    let mut facets = vec![];
    let (rest, outside) = ears(site, ring, &mut facets)?;
    Table::new(site, rest, outside, aim).fill(&mut facets)?;
    Some(Patch { places: vec![], facets })
}

struct Table<'a> {
    site: &'a Site<'a, 'a>,
    aim: Aim,
    ring: Vec<u32>,
    at: Vec<Point>,
    /// Unit normal of the facet beyond the edge from vertex `i` to the next.
    outside: Vec<Vector>,
    /// For each `i < j` at `i * n + j` the cost of the part between, and the vertex between that gives it.
    best: Vec<(Cost, u32)>,
}

impl<'a> Table<'a> {
    fn new(site: &'a Site<'a, 'a>, ring: Vec<u32>, outside: Vec<Vector>, aim: Aim) -> Table<'a> {
        let at = ring.iter().map(|v| site.work.at(*v)).collect();
        let n = ring.len();
        Table { site, aim, ring, at, outside, best: vec![(Cost::ZERO, u32::MAX); n * n] }
    }

    fn fill(mut self, facets: &mut Vec<[u32; 3]>) -> Option<()> {
        let n = self.ring.len();
        for span in 2..n {
            for i in 0..n - span {
                self.best[i * n + i + span] = self.between(i, i + span);
            }
        }
        let mut stack = vec![(0, n - 1)];
        while let Some((i, j)) = stack.pop() {
            let (_, m) = self.best[i * n + j];
            if j - i < 2 {
                continue;
            }
            let m = m as usize;
            if m >= n {
                return None;
            }
            facets.push([self.ring[i], self.ring[m], self.ring[j]]);
            stack.extend([(i, m), (m, j)]);
        }
        Some(())
    }

    /// The best triangle on the chord from `i` to `j`.
    fn between(&self, i: usize, j: usize) -> (Cost, u32) {
        let n = self.ring.len();
        let mut best = (Cost::IMPOSSIBLE, u32::MAX);
        let whole = i == 0 && j == n - 1;
        if !whole && self.site.has_edge(self.ring[i], self.ring[j]) {
            return best;
        }
        for m in i + 1..j {
            let parts = self.best[i * n + m].0.plus(self.best[m * n + j].0);
            let cost = parts.plus(self.triangle(i, m, j, whole));
            if cost.less(best.0) {
                best = (cost, m as u32);
            }
        }
        best
    }

    fn triangle(&self, i: usize, m: usize, j: usize, whole: bool) -> Cost {
        let corners = [self.at[i], self.at[m], self.at[j]];
        if self.ring[i] == self.ring[j] || predicates::is_flat(corners.each_ref()) {
            return Cost::IMPOSSIBLE;
        }
        let normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        let mut bend = 0.0f64;
        if self.aim == Aim::Bend {
            let own = unit(normal).map_or([0.0; 3], |(n, _)| n);
            let mut meet = |other: Vector| bend = bend.max(1.0 - dot(own, other));
            meet(self.beyond(i, m));
            meet(self.beyond(m, j));
            if whole {
                meet(self.outside[j]);
            }
        }
        // Equal areas are common (flat holes); a small weight on the length of the chord then prefers compact triangles.
        /// Equal areas are common (flat holes); a small weight on the length of the chord then prefers compact triangles.
        const CHORD_WEIGHT: f64 = 0.01;
        let chord = minus(corners[2], corners[0]);
        Cost { bend, area: 0.5 * norm(normal) + CHORD_WEIGHT * dot(chord, chord) }
    }

    /// Unit normal of the facet beyond the chord from `i` to `j`, as chosen before.
    fn beyond(&self, i: usize, j: usize) -> Vector {
        if j == i + 1 {
            return self.outside[i];
        }
        let m = self.best[i * self.ring.len() + j].1 as usize;
        let Some(middle) = self.at.get(m) else { return [0.0; 3] };
        unit(cross(minus(*middle, self.at[i]), minus(self.at[j], self.at[i]))).map_or([0.0; 3], |(n, _)| n)
    }
}

/// Cuts ears off a ring that is too long, adding their facets. Returns the rest with the normals beyond its edges.
fn ears(site: &Site, ring: &Ring, facets: &mut Vec<[u32; 3]>) -> Option<(Vec<u32>, Vec<Vector>)> {
    let (work, n) = (site.work, ring.vertices.len());
    let normal = |f: &u32| normal(work.corners(*f)).unwrap_or([0.0; 3]);
    let mut outside: Vec<Vector> = ring.facets.iter().map(normal).collect();
    if n <= MAX_VERTICES_WEIGHED {
        return Some((ring.vertices.clone(), outside));
    }
    let at = |i: usize| work.at(ring.vertices[i]);
    let up = (1..n - 1).fold([0.0; 3], |s, i| plus(s, cross(minus(at(i), at(0)), minus(at(i + 1), at(0)))));
    let mut next: Vec<usize> = (0..n).map(|i| (i + 1) % n).collect();
    let mut before: Vec<usize> = (0..n).map(|i| (i + n - 1) % n).collect();
    let mut version = vec![0u32; n];
    let ear = |before: &[usize], next: &[usize], i: usize| -> Option<Ear> {
        let (a, b, c) = (at(before[i]), at(i), at(next[i]));
        let (p, q) = (ring.vertices[before[i]], ring.vertices[next[i]]);
        let usable = p != q && !site.has_edge(p, q) && !predicates::is_flat([&a, &b, &c]);
        // An ear that points inwards comes last.
        let inwards = dot(cross(minus(b, a), minus(c, a)), up) <= 0.0;
        usable.then(|| Ear { inwards, chord: dot(minus(c, a), minus(c, a)), vertex: i, version: 0 })
    };
    let mut heap: BinaryHeap<Ear> = (0..n).filter_map(|i| ear(&before, &next, i)).collect();
    let mut left = n;
    while left > MAX_VERTICES_WEIGHED {
        let Ear { vertex: i, version: v, .. } = heap.pop()?;
        if version[i] != v {
            continue;
        }
        let (p, q) = (before[i], next[i]);
        facets.push([ring.vertices[p], ring.vertices[i], ring.vertices[q]]);
        outside[p] = unit(cross(minus(at(i), at(p)), minus(at(q), at(p)))).map_or([0.0; 3], |(n, _)| n);
        (next[p], before[q]) = (q, p);
        version[i] = u32::MAX;
        left -= 1;
        for k in [p, q] {
            version[k] += 1;
            heap.extend(ear(&before, &next, k).map(|e| Ear { version: version[k], ..e }));
        }
    }
    let start = (0..n).find(|&i| version[i] != u32::MAX)?;
    let (mut rest, mut normals, mut i) = (vec![], vec![], start);
    loop {
        rest.push(ring.vertices[i]);
        normals.push(outside[i]);
        i = next[i];
        if i == start {
            return Some((rest, normals));
        }
    }
}

/// A corner of the ring that may be cut off.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ear {
    inwards: bool,
    chord: f64,
    vertex: usize,
    version: u32,
}

impl Eq for Ear {}

impl PartialOrd for Ear {
    fn partial_cmp(&self, other: &Ear) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Ear {
    /// The greatest is the one to be cut first: outward, with the shortest chord, lowest.
    fn cmp(&self, other: &Ear) -> Ordering {
        let key = |e: &Ear| (e.inwards, e.vertex, e.version);
        (other.inwards.cmp(&self.inwards))
            .then(other.chord.total_cmp(&self.chord))
            .then_with(|| key(other).cmp(&key(self)))
    }
}
