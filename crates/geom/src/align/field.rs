//! A grid about the reference that tells at once how far a place is from it, about: for trying very many poses.

use super::sample::agree;
use crate::closest::{Query, QueryError, Tree};
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::space::{Aabb, Point, Vector, cross, dot, minus, times, unit};

/// Cells along the diagonal of the reference's box.
const ALONG: f64 = 72.0;

/// What a cell knows of the surface near its middle.
#[derive(Clone, Copy)]
struct Cell {
    /// Distance of its middle along the normal; infinite where the surface is beyond reach.
    height: f32,
    /// Normal of the nearest facet.
    normal: [f32; 3],
}

/// Distances near a mesh.
pub(super) struct Field {
    low: Point,
    /// Cells a millimeter.
    scale: f64,
    counts: [usize; 3],
    cells: Vec<Cell>,
    /// Distance beyond which a place does not count.
    pub reach: f64,
}

impl Field {
    /// Of `mesh` with search tree `tree`, as far as `reach`. Cost: some hundred thousand closest points.
    pub fn new(
        mesh: &Mesh,
        tree: &Tree,
        bounds: &Aabb,
        reach: f64,
        progress: &dyn Progress,
    ) -> Result<Field, QueryError> {
        let cell = bounds.diagonal() / ALONG;
        let low = bounds.min.map(|x| x - reach - cell);
        let counts = bounds.sides().map(|s| ((s + 2.0 * reach) / cell) as usize + 3);
        let middle = |i: usize| {
            let (x, rest) = (i % counts[0], i / counts[0]);
            let at = [x, rest % counts[1], rest / counts[1]];
            std::array::from_fn(|k| low[k] + (at[k] as f64 + 0.5) * cell)
        };
        let middles: Vec<Point> = (0..counts.iter().product()).map(middle).collect();
        let far = Cell { height: f32::INFINITY, normal: [0.0; 3] };
        let query = Query { max_distance: reach + cell, ..Query::default() };
        let cells = tree.map_closest(&middles, &query, progress, |i, hit| {
            let Some(hit) = hit else { return far };
            let Some(normal) = facet_normal(mesh, hit.face) else { return far };
            let away = minus(middles[i], tree.place(&middles[i], &hit).point);
            // Beside a rim the distance is longer than its share along the normal.
            let height = hit.distance().copysign(dot(away, normal));
            Cell { height: height as f32, normal: normal.map(|x| x as f32) }
        })?;
        Ok(Field { low, scale: 1.0 / cell, counts, cells, reach })
    }

    /// How well a place with this normal (or none) fits the surface: 1 on it, 0 beyond `reach` of it or turned away.
    #[inline(always)]
    pub fn worth(&self, p: Point, normal: Vector, oriented: bool, reach: f64) -> f64 {
        let at: [f64; 3] = std::array::from_fn(|k| (p[k] - self.low[k]) * self.scale);
        if !(0..3).all(|k| at[k] >= 0.0 && at[k] < self.counts[k] as f64) {
            return 0.0;
        }
        let [x, y, z] = at.map(|x| x as usize);
        let cell = &self.cells[(z * self.counts[1] + y) * self.counts[0] + x];
        if !cell.height.is_finite() {
            return 0.0;
        }
        let n = cell.normal.map(f64::from);
        if !agree(normal, n, oriented, TURNED) {
            return 0.0;
        }
        let from_middle: Vector = std::array::from_fn(|k| (at[k] - at[k].floor() - 0.5) / self.scale);
        let share = (f64::from(cell.height) + dot(from_middle, n)) / reach;
        (1.0 - share * share).max(0.0)
    }
}

/// Cosine of the angle up to which normals are taken for those of the same place.
pub(super) const TURNED: f64 = 0.35;

/// Unit normal of a face; `None` where it has no area.
pub(super) fn facet_normal(mesh: &Mesh, face: u32) -> Option<Vector> {
    let [a, b, c] = mesh.faces[face as usize].map(|v| mesh.positions[v as usize]);
    let (u, v) = (minus(b, a), minus(c, a));
    // Edges near unit length, so that tiny facets do not underflow.
    let size = u.iter().chain(&v).fold(0.0f64, |m, x| m.max(x.abs()));
    unit(cross(times(1.0 / size, u), times(1.0 / size, v))).map(|n| n.0)
}
