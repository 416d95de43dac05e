//! Where a plane cuts edges.

use super::direction::dropped;
use super::ways::MeshEdge;
use crate::tessellate::Tessellation;
use crate::trimmed::Trimmed;
use trueness_geom::plane::Plane;
use trueness_geom::space::{Point, minus, plus, times};

/// Halvings of a part of an edge: the bits of a share.
const EDGE_HALVINGS: usize = 60;

/// The edges of facets, and what they draw.
pub struct Places<'a> {
    shape: &'a Trimmed,
    drawn: &'a Tessellation,
    plane: Plane,
    /// Parts of the part's edges by the edges of facets that draw them: the edge, and shares of the way along it at the lower vertex
    /// and the higher one.
    borders: Vec<(MeshEdge, (u32, [f64; 2]))>,
}

impl<'a> Places<'a> {
    pub fn new(shape: &'a Trimmed, drawn: &'a Tessellation, plane: Plane) -> Places<'a> {
        let mut borders = vec![];
        for (edge, line) in (0u32..).zip(&drawn.edges) {
            for (ends, shares) in line.vertices.windows(2).zip(line.shares.windows(2)) {
                let [a, b] = [ends[0], ends[1]];
                let shares = if a < b { [shares[0], shares[1]] } else { [shares[1], shares[0]] };
                borders.push(([a.min(b), a.max(b)], (edge, shares)));
            }
        }
        borders.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.0.cmp(&b.1.0)));
        Places { shape, drawn, plane, borders }
    }

    /// Where the plane cuts the edge of a facet.
    pub fn near(&self, edge: MeshEdge) -> Point {
        let [a, b] = edge.map(|v| self.drawn.mesh.positions[v as usize]);
        let [low, high] = [a, b].map(|p| self.plane.height(&p));
        let share = low / (low - high);
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
        dropped(&self.plane, plus(a, times(share, minus(b, a))))
    }

    /// Where it cuts the edge of the part that is drawn there; else the same.
    pub fn exact(&self, edge: MeshEdge) -> Point {
        let Ok(at) = self.borders.binary_search_by(|b| b.0.cmp(&edge)) else { return self.near(edge) };
        let (number, [mut low, mut high]) = self.borders[at].1;
        let span = &self.shape.brep.edges[number as usize].span;
        let place = |share: f64| span.derivatives(share)[0];
        let height = |share: f64| self.plane.height(&place(share));
        let [first, last] = [height(low), height(high)];
        if (first < 0.0) == (last < 0.0) {
            // A place on the plane counts as above.
            let end = if first.abs() <= last.abs() { low } else { high };
            return dropped(&self.plane, place(end));
        }
        for _ in 0..EDGE_HALVINGS {
            let middle = 0.5 * (low + high);
            if (height(middle) < 0.0) == (first < 0.0) { low = middle } else { high = middle }
        }
        dropped(&self.plane, place(0.5 * (low + high)))
    }
}
