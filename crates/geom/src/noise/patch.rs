//! Patches: the points around a point.

use super::terms::NoNoise;
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::space::{Point, dot, minus};
use crate::spatial::lists::lists;
use std::collections::BTreeSet;

/// A source of the neighbors of points.
pub(super) trait Around: Sync {
    /// At most `size` points around `center`, which comes first.
    fn patch(&self, center: u32, size: usize) -> Vec<u32>;
}

/// Vertices of a mesh, neighbors through edges.
pub(super) struct OnMesh {
    first: Vec<u32>,
    all_neighbors: Vec<u32>,
}

impl OnMesh {
    /// The neighbors of the vertices that count.
    pub(super) fn new(mesh: &Mesh, counts: impl Fn(u32) -> bool + Sync) -> Result<OnMesh, NoNoise> {
        let vertices = mesh.positions.len();
        if let Some(facet) = mesh.faces.iter().position(|f| f.iter().any(|v| *v as usize >= vertices)) {
            return Err(NoNoise::NoSuchVertex { facet });
        }
        let sides = |f: &[u32; 3]| [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]].map(|e| e.map(|k| f[k]));
        let sides = mesh.faces.par_iter().flat_map_iter(sides);
        let counted = sides.filter(|[a, b]| a != b && counts(*a) && counts(*b));
        let (first, all_neighbors) = lists(vertices, counted.collect());
        Ok(OnMesh { first, all_neighbors })
    }
    fn neighbors(&self, v: u32) -> &[u32] {
        &self.all_neighbors[self.first[v as usize] as usize..self.first[v as usize + 1] as usize]
    }
}

impl Around for OnMesh {
    /// Ring by ring.
    fn patch(&self, center: u32, size: usize) -> Vec<u32> {
        let (mut found, mut seen) = (vec![center], BTreeSet::from([center]));
        let mut next = 0;
        while next < found.len() && found.len() < size {
            for &v in self.neighbors(found[next]) {
                if found.len() < size && seen.insert(v) {
                    found.push(v);
                }
            }
            next += 1;
        }
        found
    }
}

/// Points of a cloud, neighbors by nearness. A pass over all for each patch costs less than a tree, for so few patches.
pub(super) struct InCloud<'a> {
    /// All points, and the numbers of those that count.
    pub points: &'a [Point],
    pub counted: &'a [u32],
}

impl Around for InCloud<'_> {
    fn patch(&self, center: u32, size: usize) -> Vec<u32> {
        let middle = self.points[center as usize];
        let mut near: Vec<(f64, u32)> = Vec::with_capacity(size + 1);
        let mut farthest = f64::INFINITY;
        for &i in self.counted {
            let away = minus(self.points[i as usize], middle);
            let square = dot(away, away);
            if square < farthest {
                near.insert(near.partition_point(|n| n.0 <= square), (square, i));
                near.truncate(size);
                farthest = near.get(size - 1).map_or(f64::INFINITY, |n| n.0);
            }
        }
        near.into_iter().map(|n| n.1).collect()
    }
}
