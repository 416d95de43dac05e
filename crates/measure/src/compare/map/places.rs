//! Mean deviations at places of the reference that are the same whatever was measured: what maps over many parts rest on.
//!
//! The facets are parted at creases and cut by the reference's own size alone ([`bisection`](super::bisection)). Each point counts at
//! the corner of its piece that is nearest to its place on the reference.

use super::bisection::{Bisection, PIECE_AREA_RATIO, half_corners, half_weights, in_second};
use super::creases;
use super::facet::{place, whole_area};
use super::fill::fill;
use std::collections::HashMap;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::sum::Sum;
use trueness_geom::space::{Point, minus, norm};

/// Cuts of the facets, at most: some 20,000 places on a reference of few facets.
const MAX_PLACE_CUTS: usize = 40_000;

/// Sums of deviations, place by place.
pub struct Places {
    mesh: Mesh,
    pieces: Bisection,
    /// Vertices of `mesh` at the corners of each piece; of pieces that are cut, of no use.
    corners: Vec<[u32; 3]>,
    sums: Vec<Sum>,
    counts: Vec<u64>,
}

/// Mean deviations at the places.
#[derive(Clone, Debug)]
pub struct PlaceMeans {
    /// The reference in pieces; its vertices are the places.
    pub mesh: Mesh,
    /// Mean deviation of the points nearest to each place; where there are none, of the nearest place along the surface that has some;
    /// NaN where that is farther than `reach`.
    pub means: Vec<f64>,
    /// Points in each mean; 0 where it is another place's.
    pub counts: Vec<u64>,
    /// How far a mean goes over to places without points, millimeters.
    pub reach: f64,
}

impl Places {
    /// Of a reference; nothing measured yet.
    pub fn new(reference: &Mesh) -> Places {
        let edge = (whole_area(reference) / (PIECE_AREA_RATIO * MAX_PLACE_CUTS as f64)).sqrt();
        let edge = if edge > 0.0 { edge } else { f64::INFINITY };
        let pieces = Bisection::of(reference, edge, MAX_PLACE_CUTS);
        let mut cut = Cutting { mesh: Mesh::default(), middles: HashMap::new() };
        let mut corners = vec![[0; 3]; pieces.len()];
        for (face, own) in cut.starts(reference).into_iter().enumerate() {
            let mut open = vec![(face as u32, own)];
            while let Some((node, own)) = open.pop() {
                corners[node as usize] = own;
                match pieces.halves(node) {
                    None => cut.mesh.faces.push(own),
                    Some(([first, second], edge)) => {
                        let middle = cut.middle(own[edge], own[(edge + 1) % 3]);
                        open.push((second, half_corners(edge, true, own, middle)));
                        open.push((first, half_corners(edge, false, own, middle)));
                    }
                }
            }
        }
        let count = cut.mesh.positions.len();
        Places { mesh: cut.mesh, pieces, corners, sums: vec![Sum::default(); count], counts: vec![0; count] }
    }

    /// The place at which a point counts whose place on the `reference` lies on `face`; of equally near ones the first corner.
    pub fn at(&self, reference: &Mesh, face: u32, weights: [f64; 3]) -> u32 {
        let (mut node, mut inside) = (face, weights);
        while let Some((halves, edge)) = self.pieces.halves(node) {
            let second = in_second(edge, &inside);
            inside = half_weights(edge, second, inside);
            node = halves[usize::from(second)];
        }
        let (foot, own) = (place(reference, face, weights), self.corners[node as usize]);
        let away = own.map(|v| norm(minus(foot, self.mesh.positions[v as usize])));
        own[(1..3).fold(0, |best, k| if away[k] < away[best] { k } else { best })]
    }

    /// Adds a deviation at a place.
    pub fn add(&mut self, place: u32, deviation: f64) {
        let n = place as usize;
        self.sums[n] = std::mem::take(&mut self.sums[n]).plus(deviation);
        self.counts[n] += 1;
    }

    /// The means; each goes over to places without points no farther than `reach` away along the surface.
    pub fn means(self, reach: f64) -> PlaceMeans {
        let mean =
            |(sum, count): (&Sum, &u64)| if *count > 0 { sum.value() / *count as f64 } else { f64::NAN };
        let mut means: Vec<f64> = self.sums.iter().zip(&self.counts).map(mean).collect();
        fill(&self.mesh, &mut means, reach);
        PlaceMeans { mesh: self.mesh, means, counts: self.counts, reach }
    }
}

/// The reference in pieces, under construction.
struct Cutting {
    mesh: Mesh,
    /// Middle of the edge between two vertices. Looked up only, never walked through.
    middles: HashMap<[u32; 2], u32>,
}

impl Cutting {
    /// The facets to begin with, parted at creases; vertices that none uses are left out.
    fn starts(&mut self, reference: &Mesh) -> Vec<[u32; 3]> {
        let numbers = creases::corners(reference);
        let mut vertices = HashMap::new();
        let mut vertex = |corner: usize| {
            *vertices.entry(numbers[corner]).or_insert_with(|| {
                let v = reference.faces[corner / 3][corner % 3];
                self.mesh.positions.push(reference.positions[v as usize]);
                self.mesh.positions.len() as u32 - 1
            })
        };
        (0..reference.faces.len()).map(|f| [0, 1, 2].map(|k| vertex(3 * f + k))).collect()
    }

    fn middle(&mut self, a: u32, b: u32) -> u32 {
        *self.middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            let (p, q): (Point, Point) = (self.mesh.positions[a as usize], self.mesh.positions[b as usize]);
            self.mesh.positions.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
            self.mesh.positions.len() as u32 - 1
        })
    }
}
