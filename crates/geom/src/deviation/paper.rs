//! The deviation of a point as the paper on verifying triangulated models words it, for those who must reproduce it.
//!
//! Dobroskok, Garashchenko, Latysh, Verification of triangulation models after optical digitising, 2012 (equations in
//! brackets). A window about the point is half as wide as a 300th of length, width and height of the model together (2). It
//! grows until it holds ten facets or all (1). A point on a vertex deviates by nothing (3). Otherwise the nearest vertex in the
//! window (4) is found, and the least distance to the facets around it (18). That is the distance to the plane (7, 8–10) where
//! six angles say that the foot is inside (5), else to the edges (11–17).
//!
//! The misprints of (9), (14) and (15) are mended. Where the paper leaves a choice open, equal positions are one vertex. A
//! facet is in the window when one of its vertices is. The window is a closed cube and doubles. The first of equally near
//! vertices in the file counts. A right angle passes (5), decided by l² + l² − l² ≥ 0. A facet without area has only edges.
//!
//! **This is not the distance to the surface.** (5) tests three slabs, not the triangle. Points outside an acute triangle pass
//! it and get the (too small) distance to the plane. And the nearest facet need not touch the nearest vertex, which gives too
//! large values. On scans a third of the values are wrong. See [`Differences`].
//!
//! The values have no sign, as in the paper. A sign may be taken from the exact method for the same point. The side of the
//! facet that gave the value is not reliable where that value is wrong.

mod differences;
mod facet;
#[cfg(test)]
mod tests;

pub use differences::Differences;
pub use facet::Value;

use crate::closest::{MeshError, QueryError, check_mesh, check_points};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::{Aabb, Point};
use crate::spatial::neighbors::PointTree;
use crate::topology::weld;

/// Least facets that the window must hold (1).
const MIN_WINDOW_FACETS: usize = 10;
/// Length + width + height over the window's first half-size (2).
const WINDOW_DIVISOR: f64 = 300.0;
/// Points that one thread takes at a time.
const PAPER_POINTS_PER_TASK: usize = 1024;

/// Why there are no values.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PaperError {
    /// The mesh cannot be measured against.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The mesh has too many facets to be numbered.
    #[error(transparent)]
    Weld(#[from] weld::WeldError),
    /// The points cannot be measured, or the computation was stopped.
    #[error(transparent)]
    Query(#[from] QueryError),
}

impl From<Cancelled> for PaperError {
    fn from(stopped: Cancelled) -> PaperError {
        PaperError::Query(stopped.into())
    }
}

/// Distances of `points` from `mesh` by the paper's method, in the order of the points, millimeters, unsigned.
///
/// # Errors
/// The errors of [`Paper::new`] and [`Paper::values`].
pub fn distances(mesh: &Mesh, points: &[Point], progress: &dyn Progress) -> Result<Vec<f64>, PaperError> {
    let values = Paper::new(mesh)?.values(points, progress)?;
    Ok(values.into_iter().map(|v| v.distance).collect())
}

/// A mesh, prepared.
#[derive(Clone, Debug)]
pub struct Paper {
    /// Every position once, in the order of the file.
    vertices: Vec<Point>,
    tree: PointTree,
    faces: Vec<[u32; 3]>,
    /// Facets around vertex `v`: `around[starts[v]..starts[v + 1]]`.
    starts: Vec<u32>,
    around: Vec<u32>,
    /// Half the side of the first window.
    half: f64,
}

impl Paper {
    /// Prepares a mesh. Cost: some 0.3 s for a million facets.
    ///
    /// # Errors
    /// No facets, a facet that names a vertex which is not there, a coordinate that is not finite.
    pub fn new(mesh: &Mesh) -> Result<Paper, PaperError> {
        check_mesh(mesh)?;
        let (vertices, faces) = distinct(mesh)?;
        let sides = Aabb::of(&vertices).sides();
        let mut starts = vec![0; vertices.len() + 1];
        faces.iter().flatten().for_each(|v| starts[*v as usize + 1] += 1);
        for v in 0..vertices.len() {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut around = vec![0; 3 * faces.len()];
        for (face, corner) in (0..).zip(&faces).flat_map(|(i, f)| f.iter().map(move |v| (i, *v as usize))) {
            around[next[corner] as usize] = face;
            next[corner] += 1;
        }
        let half = (sides[0] + sides[1] + sides[2]) / WINDOW_DIVISOR;
        Ok(Paper { tree: PointTree::new(&vertices), vertices, faces, starts, around, half })
    }

    /// Distance and rounding bound of each point, in order. Runs on the current rayon pool; cost: about 1 µs a point.
    ///
    /// # Errors
    /// A point that is not finite; a stop by `progress`, which is told of points done.
    pub fn values(&self, points: &[Point], progress: &dyn Progress) -> Result<Vec<Value>, PaperError> {
        check_points(points)?;
        let mut values = vec![Value { distance: 0.0, rounding: 0.0 }; points.len()];
        values
            .par_chunks_mut(PAPER_POINTS_PER_TASK)
            .zip(points.par_chunks(PAPER_POINTS_PER_TASK))
            .try_for_each(|(values, points)| {
                if progress.cancelled() {
                    return Err(Cancelled);
                }
                for (value, m) in values.iter_mut().zip(points) {
                    *value = self.value(m);
                }
                progress.advance(points.len() as u64);
                Ok(())
            })?;
        Ok(values)
    }

    fn value(&self, m: &Point) -> Value {
        let vertex = self.vertex_of(m) as usize;
        if self.vertices[vertex] == *m {
            return Value { distance: 0.0, rounding: 0.0 };
        }
        facet::least(
            m,
            self.facets(vertex).iter().map(|f| self.faces[*f as usize].map(|v| self.vertices[v as usize])),
        )
    }

    fn facets(&self, vertex: usize) -> &[u32] {
        &self.around[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }

    /// The vertex nearest to `m` among those in the window.
    ///
    /// The nearest of all is the answer as soon as a window holds it, for windows only grow. So facets are counted only where a
    /// smaller window may hold ten of them and not the nearest vertex.
    fn vertex_of(&self, m: &Point) -> u32 {
        let nearest = self.tree.nearest(m).map_or(0, |(_, v)| v);
        let place = self.vertices[nearest as usize];
        let mut half = self.half;
        loop {
            let window = Aabb { min: m.map(|x| x - half), max: m.map(|x| x + half) };
            let holds_nearest = (0..3).all(|k| window.min[k] <= place[k] && place[k] <= window.max[k]);
            // A model without extent has one vertex, which doubling a zero would never reach.
            if holds_nearest || half == 0.0 {
                return nearest;
            }
            if self.holds_enough(&window) {
                return self.nearest_inside(m, &window);
            }
            half *= 2.0;
        }
    }

    fn holds_enough(&self, window: &Aabb) -> bool {
        let enough = MIN_WINDOW_FACETS.min(self.faces.len());
        let mut facets: Vec<u32> = Vec::with_capacity(MIN_WINDOW_FACETS);
        self.tree.in_box(window, |_, v| {
            for f in self.facets(v as usize) {
                if facets.len() < enough && !facets.contains(f) {
                    facets.push(*f);
                }
            }
            facets.len() < enough
        });
        facets.len() == enough
    }

    fn nearest_inside(&self, m: &Point, window: &Aabb) -> u32 {
        let mut best = (f64::INFINITY, u32::MAX);
        self.tree.in_box(window, |q, v| {
            let [x, y, z] = [m[0] - q[0], m[1] - q[1], m[2] - q[2]];
            let d = x * x + y * y + z * z;
            if d < best.0 || (d == best.0 && v < best.1) {
                best = (d, v);
            }
            true
        });
        best.1
    }
}

/// The used positions, each once and in the order of the file, and the facets between them.
fn distinct(mesh: &Mesh) -> Result<(Vec<Point>, Vec<[u32; 3]>), PaperError> {
    let welded = weld::mesh(mesh)?;
    let mut rank = vec![u32::MAX; welded.mesh.positions.len()];
    let mut vertices = Vec::with_capacity(rank.len());
    for number in welded.vertex_of.iter().filter(|n| **n != u32::MAX) {
        let number = *number as usize;
        if rank[number] == u32::MAX {
            rank[number] = vertices.len() as u32;
            vertices.push(welded.mesh.positions[number]);
        }
    }
    let faces = welded.mesh.faces.iter().map(|f| f.map(|v| rank[v as usize])).collect();
    Ok((vertices, faces))
}
