//! Neighbors on a mesh: rings around a vertex, through edges.

use super::jet::{Fitter, Jet};
use super::terms::{NoCurvature, ResolvedReach, Terms};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Vector, cross, dot, minus, norm, plus, unit};
use trueness_geom::spatial::lists::lists;
use trueness_geom::topology::{Topology, TopologyError};

/// Rings do not grow through vertices with more neighbors: those around the middle of a disc of many facets would each take in all
/// others.
pub const MAX_RING_NEIGHBORS: usize = 256;

/// Rings around a vertex are a neighborhood if no vertex left out is nearer than this share of the farthest one in
/// them. In a net of like cells the share is 0.6. Rings of long facets reach far one way and hardly the other.
const MIN_ROUND_RATIO: f64 = 1.0 / 3.0;
/// Condition up to which the nearest vertices determine a jet in all directions: three rows of them do not, five do.
const MAX_EVEN_CONDITION: f64 = 300.0;
/// Times the neighbors asked for that are taken for it at most.
const MAX_NEIGHBOR_GROWTH: usize = 12;

/// A mesh as vertices that know their neighbors.
pub(super) struct Rings<'a> {
    mesh: &'a Mesh,
    first: Vec<u32>,
    others: Vec<u32>,
    /// Unit normal by the area of the facets around; zero where there is none.
    normals: Vec<Vector>,
    /// Why a vertex has no curvature, as far as it can be told without looking around.
    barred: Vec<Option<NoCurvature>>,
}

impl Rings<'_> {
    pub(super) fn new<'a>(mesh: &'a Mesh, progress: &dyn Progress) -> Result<Rings<'a>, TopologyError> {
        let topology = Topology::watched(mesh, progress)?;
        let count = mesh.positions.len();
        let mut out = vec![false; mesh.faces.len()];
        for &f in topology.repeated_vertex.iter().chain(&topology.not_finite) {
            out[f as usize] = true;
        }
        let counting = || mesh.faces.iter().zip(&out).filter(|(_, out)| !**out).map(|(f, _)| f);
        let mut normals = vec![[0.0; 3]; count];
        for face in counting() {
            let [a, b, c] = mesh.places(face);
            let area = cross(minus(b, a), minus(c, a));
            face.iter().for_each(|v| normals[*v as usize] = plus(normals[*v as usize], area));
        }
        let of_length_1 = |n: &mut Vector| *n = unit(*n).map_or([0.0; 3], |(n, _)| n);
        normals.par_chunks_mut(1 << 12).for_each(|part| part.iter_mut().for_each(of_length_1));
        let pairs: Vec<[u32; 2]> = (mesh.faces.par_iter().zip(&out))
            .filter(|(_, out)| !**out)
            .flat_map_iter(|(f, _)| [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]].map(|e| e.map(|k| f[k])))
            .collect();
        let (first, others) = lists(count, pairs);
        let mut barred = vec![None; count];
        // The last statement counts.
        for edge in &topology.boundary_edges {
            edge.vertices.iter().for_each(|v| barred[*v as usize] = Some(NoCurvature::Boundary));
        }
        let edges = topology.non_manifold_edges.iter().chain(&topology.inconsistent_edges);
        for v in edges.flat_map(|e| e.vertices).chain(topology.non_manifold_vertices.iter().copied()) {
            barred[v as usize] = Some(NoCurvature::NotASurface);
        }
        for (v, place) in mesh.positions.iter().enumerate() {
            if first[v] == first[v + 1] {
                barred[v] = Some(NoCurvature::Unused);
            }
            if place.iter().any(|x| !x.is_finite()) {
                barred[v] = Some(NoCurvature::NotFinite);
            }
        }
        Ok(Rings { mesh, first, others, normals, barred })
    }

    /// Something that goes around vertices, one after the other.
    pub(super) fn walk(&self) -> Walk<'_> {
        Walk { rings: self, seen: vec![0; self.normals.len()], round: 0, found: vec![] }
    }

    fn neighbors_of(&self, v: u32) -> &[u32] {
        &self.others[self.first[v as usize] as usize..self.first[v as usize + 1] as usize]
    }
}

/// Goes around vertices.
pub(super) struct Walk<'a> {
    rings: &'a Rings<'a>,
    /// The round in which a vertex was last met.
    seen: Vec<u32>,
    round: u32,
    /// The vertex itself, then its neighbors, ring after ring.
    found: Vec<u32>,
}

impl Walk<'_> {
    /// The jet at a vertex.
    pub(super) fn jet(&mut self, v: u32, terms: &Terms, fitter: &mut Fitter) -> Result<Jet, NoCurvature> {
        let Rings { normals, barred, .. } = self.rings;
        match barred[v as usize] {
            Some(NoCurvature::Boundary) if terms.boundary => {}
            Some(reason) => return Err(reason),
            None => {}
        }
        if normals[v as usize] == [0.0; 3] {
            return Err(NoCurvature::Undetermined);
        }
        self.gather(v, terms);
        match terms.reach {
            ResolvedReach::Count(count) if !self.is_round() => {
                let (of_rings, even) = (self.fit(v, fitter), self.even_jet(v, count, fitter));
                match (of_rings, even) {
                    // Along a straight line rings may reach far.
                    (Ok(a), Ok(b)) if a.uncertainty <= b.uncertainty => of_rings,
                    (Ok(_), Err(_)) => of_rings,
                    _ => even,
                }
            }
            _ => self.fit(v, fitter),
        }
    }

    /// Whether no vertex beside those found is much nearer than the farthest of them.
    fn is_round(&self) -> bool {
        let rings = self.rings;
        let place = |n: &u32| rings.mesh.positions[*n as usize];
        let middle = place(&self.found[0]);
        let square = |n: &u32| {
            let d = minus(place(n), middle);
            dot(d, d)
        };
        let farthest = self.found.iter().map(square).fold(0.0, f64::max);
        let left_out = |n: &&u32| self.seen[**n as usize] != self.round;
        let around = self
            .found
            .iter()
            .map(|n| rings.neighbors_of(*n))
            .filter(|adjacent| adjacent.len() <= MAX_RING_NEIGHBORS);
        let adjacent = around.flatten().filter(left_out);
        adjacent.map(square).fold(f64::INFINITY, f64::min) >= MIN_ROUND_RATIO * MIN_ROUND_RATIO * farthest
    }

    /// The jet of the nearest vertices, more and more of them, until it is determined in all directions.
    fn even_jet(&mut self, v: u32, count: usize, fitter: &mut Fitter) -> Result<Jet, NoCurvature> {
        let mut wanted = count;
        loop {
            self.gather_nearest(v, wanted);
            let jet = self.fit(v, fitter);
            let is_all = self.found.len() <= wanted;
            if is_all
                || wanted >= MAX_NEIGHBOR_GROWTH * count
                || jet.is_ok_and(|jet| jet.condition <= MAX_EVEN_CONDITION)
            {
                return jet;
            }
            wanted += wanted / 2;
        }
    }

    /// Finds so many nearest vertices of those that hang together through nearer ones.
    fn gather_nearest(&mut self, v: u32, wanted: usize) {
        let rings = self.rings;
        self.round += 1;
        self.found.clear();
        self.seen[v as usize] = self.round;
        let middle = rings.mesh.positions[v as usize];
        // The bits of numbers that are not negative rise as the numbers do.
        let mut open = BinaryHeap::from([Reverse((0u64, v))]);
        while let Some(Reverse((_, n))) = open.pop() {
            self.found.push(n);
            if self.found.len() > wanted {
                break;
            }
            let adjacent = rings.neighbors_of(n);
            if n != v && adjacent.len() > MAX_RING_NEIGHBORS {
                continue;
            }
            for &other in adjacent {
                if self.seen[other as usize] != self.round {
                    self.seen[other as usize] = self.round;
                    open.push(Reverse((
                        norm(minus(rings.mesh.positions[other as usize], middle)).to_bits(),
                        other,
                    )));
                }
            }
        }
    }

    /// The jet of the vertices found.
    fn fit(&self, v: u32, fitter: &mut Fitter) -> Result<Jet, NoCurvature> {
        let Rings { mesh, normals, .. } = self.rings;
        let normal = normals[v as usize];
        let neighbors = &self.found[1..];
        fitter.take(mesh.positions[v as usize], neighbors.iter().map(|n| mesh.positions[*n as usize]));
        let jet = fitter.jet(normal)?;
        let folds = |n: &u32| dot(normals[*n as usize], jet.bend.normal) < 0.0;
        if dot(normal, jet.bend.normal) <= 0.0 || neighbors.iter().any(folds) {
            return Err(NoCurvature::Folded);
        }
        Ok(jet)
    }

    /// Finds the neighbors: ring by ring until there are enough, or those within the radius that hang together within it.
    fn gather(&mut self, v: u32, terms: &Terms) {
        let rings = self.rings;
        self.round += 1;
        self.found.clear();
        self.found.push(v);
        self.seen[v as usize] = self.round;
        let middle = rings.mesh.positions[v as usize];
        let (enough, radius) = match terms.reach {
            ResolvedReach::Count(count) => (count, f64::INFINITY),
            ResolvedReach::Radius(r) => (usize::MAX, r),
        };
        let mut ring = 0..1;
        while !ring.is_empty() && self.found.len() <= enough {
            let end = ring.end;
            for k in ring {
                let adjacent = rings.neighbors_of(self.found[k]);
                if k > 0 && adjacent.len() > MAX_RING_NEIGHBORS {
                    continue;
                }
                for &n in adjacent {
                    let new = self.seen[n as usize] != self.round;
                    if new && norm(minus(rings.mesh.positions[n as usize], middle)) <= radius {
                        self.seen[n as usize] = self.round;
                        self.found.push(n);
                    }
                }
            }
            ring = end..self.found.len();
        }
    }
}
