//! Neighbors on a mesh: rings around a vertex, through edges.

use super::jet::{Fitter, Jet};
use super::terms::{NoCurvature, Taken, Terms};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::space::{Vector, cross, dot, minus, norm, plus, unit};
use crate::spatial::lists::lists;
use crate::topology::{Topology, TopologyError};

/// Rings do not grow through vertices with more neighbors: those around the middle of a disc of many facets would each take
/// in all others.
pub const HUB: usize = 256;

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
            let [a, b, c] = face.map(|v| mesh.positions[v as usize]);
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
        // What is said last is what counts.
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

    fn beside(&self, v: u32) -> &[u32] {
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
        let Rings { mesh, normals, barred, .. } = self.rings;
        match barred[v as usize] {
            Some(NoCurvature::Boundary) if terms.boundary => {}
            Some(reason) => return Err(reason),
            None => {}
        }
        let normal = normals[v as usize];
        if normal == [0.0; 3] {
            return Err(NoCurvature::Undetermined);
        }
        self.gather(v, terms);
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
            Taken::Count(count) => (count, f64::INFINITY),
            Taken::Radius(r) => (usize::MAX, r),
        };
        let mut ring = 0..1;
        while !ring.is_empty() && self.found.len() <= enough {
            let end = ring.end;
            for k in ring {
                let beside = rings.beside(self.found[k]);
                if k > 0 && beside.len() > HUB {
                    continue;
                }
                for &n in beside {
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
