//! Patches: the points around a point.

use super::moments::POINTS;
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::space::Point;
use crate::spatial::lists::lists;
use crate::spatial::neighbors::PointTree;
use std::collections::BTreeSet;

/// What knows the neighbors of points.
pub(super) trait Around: Sync {
    /// At most [`POINTS`] points around `center`, which comes first.
    fn patch(&self, center: u32) -> Vec<u32>;
}

/// Vertices of a mesh, neighbors through edges.
pub(super) struct OnMesh {
    first: Vec<u32>,
    others: Vec<u32>,
}

impl OnMesh {
    pub(super) fn new(mesh: &Mesh) -> OnMesh {
        let sides = |f: &[u32; 3]| [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]].map(|e| e.map(|k| f[k]));
        let sides = mesh.faces.par_iter().flat_map_iter(sides).filter(|e| e[0] != e[1]);
        let (first, others) = lists(mesh.positions.len(), sides.collect());
        OnMesh { first, others }
    }
    fn beside(&self, v: u32) -> &[u32] {
        &self.others[self.first[v as usize] as usize..self.first[v as usize + 1] as usize]
    }
}

impl Around for OnMesh {
    /// Ring by ring.
    fn patch(&self, center: u32) -> Vec<u32> {
        let (mut found, mut seen) = (vec![center], BTreeSet::from([center]));
        let mut next = 0;
        while next < found.len() && found.len() < POINTS {
            for &v in self.beside(found[next]) {
                if found.len() < POINTS && seen.insert(v) {
                    found.push(v);
                }
            }
            next += 1;
        }
        found
    }
}

/// Points of a cloud, neighbors by nearness.
pub(super) struct InCloud<'a> {
    points: &'a [Point],
    tree: PointTree,
}

impl InCloud<'_> {
    pub(super) fn new(points: &[Point]) -> InCloud<'_> {
        InCloud { points, tree: PointTree::new(points) }
    }
}

impl Around for InCloud<'_> {
    fn patch(&self, center: u32) -> Vec<u32> {
        let near = self.tree.k_nearest(&self.points[center as usize], POINTS - 1, Some(center));
        std::iter::once(center).chain(near.into_iter().map(|n| n.1)).collect()
    }
}
