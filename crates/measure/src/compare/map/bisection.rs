//! Facets cut in halves until no edge is longer than asked for.
//!
//! Always the longest edge is cut, in its middle (M.-C. Rivara, "Algorithms for refining triangular grids suitable for adaptive and
//! multigrid techniques", 1984). Every edge longer than the limit is cut in the end, from both of its sides and at the same places. So
//! the pieces fit together without gaps, whatever shape the facets have. Stopping at a greater limit gives pieces that those of the
//! smaller limit divide.

use trueness_geom::mesh::Mesh;
use trueness_geom::space::{Point, dot, minus};

/// Area of a piece over the square of its longest edge, as halving leaves it.
pub const PIECE_AREA_RATIO: f64 = 0.18;

/// Halvings of one facet, at most, one after another.
const MAX_HALVINGS: usize = 60;

/// The pieces as a tree: nodes `0..F` are the facets themselves, the others follow in pairs.
pub struct Bisection {
    /// 0 for a piece that is not cut, else `first half << 2 | number of the edge`.
    nodes: Vec<u32>,
    /// Longest edge of a piece, millimeters; the facets' own where they are shorter.
    pub edge: f64,
}

/// Squared lengths of the edges from corner 0 to 1, 1 to 2, 2 to 0.
pub type Edges = [f64; 3];

impl Bisection {
    /// Cuts every edge longer than `edge`, or than a greater limit if there were more than `most` cuts.
    pub fn of(mesh: &Mesh, edge: f64, most: usize) -> Bisection {
        let mut edge = edge;
        loop {
            if let Some(nodes) = cut_all(mesh, edge, most) {
                return Bisection { nodes, edge };
            }
            edge *= 1.25;
        }
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The two halves of a piece and the edge that is cut; `None` if it is not.
    pub fn halves(&self, node: u32) -> Option<([u32; 2], usize)> {
        let n = self.nodes.get(node as usize).copied().filter(|n| *n != 0)?;
        Some(([n >> 2, (n >> 2) + 1], n as usize & 3))
    }

    /// The smallest piece of facet `face` that holds the place with these weights of its corners.
    pub fn piece(&self, face: u32, mut weights: [f64; 3]) -> u32 {
        let mut node = face;
        while let Some((halves, edge)) = self.halves(node) {
            let second = in_second(edge, &weights);
            weights = half_weights(edge, second, weights);
            node = halves[usize::from(second)];
        }
        node
    }
}

/// Squared lengths of the edges of a triangle.
pub fn edges([a, b, c]: [Point; 3]) -> Edges {
    [[a, b], [b, c], [c, a]].map(|[p, q]| dot(minus(p, q), minus(p, q)))
}

/// The longest of three edges; of equal ones the first.
pub fn longest(edges: &Edges) -> usize {
    (1..3).fold(0, |best, k| if edges[k] > edges[best] { k } else { best })
}

/// Edges of a half. The median's length follows from those of the sides (Apollonius).
pub fn half_edges(cut: usize, second: bool, edges: Edges) -> Edges {
    let [c, next, last] = [cut, (cut + 1) % 3, (cut + 2) % 3].map(|k| edges[k]);
    let median = (0.25 * (2.0 * next + 2.0 * last - c)).max(0.0);
    if second { [0.25 * c, next, median] } else { [0.25 * c, median, last] }
}

/// Corners of a half, given the middle of the edge that is cut. The first half has the edge's start, the second its end.
pub fn half_corners<T: Copy>(cut: usize, second: bool, corners: [T; 3], middle: T) -> [T; 3] {
    let [a, b, c] = [cut, (cut + 1) % 3, (cut + 2) % 3].map(|k| corners[k]);
    if second { [middle, b, c] } else { [a, middle, c] }
}

/// Whether a place lies in the second half; on the border it lies in the first.
pub fn in_second(cut: usize, weights: &[f64; 3]) -> bool {
    weights[(cut + 1) % 3] > weights[cut]
}

/// The weights of a place for the corners of its half.
pub fn half_weights(cut: usize, second: bool, weights: [f64; 3]) -> [f64; 3] {
    let [a, b, c] = [cut, (cut + 1) % 3, (cut + 2) % 3].map(|k| weights[k]);
    if second { [2.0 * a, b - a, c] } else { [a - b, 2.0 * b, c] }
}

fn cut_all(mesh: &Mesh, edge: f64, most: usize) -> Option<Vec<u32>> {
    let limit = edge * edge;
    let mut nodes = vec![0; mesh.faces.len()];
    let mut open = vec![];
    for (face, corners) in (0u32..).zip(&mesh.faces) {
        open.push((face, edges(corners.map(|v| mesh.positions[v as usize])), 0));
        while let Some((node, lengths, depth)) = open.pop() {
            let cut = longest(&lengths);
            // Also false for what is not finite.
            if !(lengths[cut] > limit && lengths[cut] < f64::INFINITY) || depth >= MAX_HALVINGS {
                continue;
            }
            let first = nodes.len() as u32;
            if nodes.len() + 2 > mesh.faces.len() + 2 * most || first >= 1 << 30 {
                return None;
            }
            nodes[node as usize] = first << 2 | cut as u32;
            nodes.extend([0, 0]);
            open.push((first, half_edges(cut, false, lengths), depth + 1));
            open.push((first + 1, half_edges(cut, true, lengths), depth + 1));
        }
    }
    Some(nodes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_short_and_hold_their_places() {
        // A needle beside a plump facet.
        let positions = vec![[0.0; 3], [40.0, 0.0, 0.0], [20.0, 17.0, 5.0], [0.3, -0.4, 0.0]];
        let mesh = Mesh { positions, faces: vec![[0, 1, 2], [1, 0, 3]] };
        let tree = Bisection::of(&mesh, 1.0, 100_000);
        assert_eq!(tree.edge, 1.0);
        for face in 0..2u32 {
            let corners = mesh.faces[face as usize].map(|v| mesh.positions[v as usize]);
            for i in 0..500 {
                let (u, v) = (f64::from(i) * 0.618_034 % 1.0, f64::from(i) / 500.0);
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                let mut weights = [1.0 - u - v, u, v];
                let leaf = tree.piece(face, weights);
                let at = |c: [Point; 3], w: [f64; 3]| [0, 1, 2].map(|k| (0..3).map(|j| w[j] * c[j][k]).sum());
                let place: Point = at(corners, weights);
                let (mut node, mut piece, mut lengths) = (face, corners, edges(corners));
                while let Some((halves, cut)) = tree.halves(node) {
                    let second = in_second(cut, &weights);
                    let [a, b] = [piece[cut], piece[(cut + 1) % 3]];
                    let middle = [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]));
                    lengths = half_edges(cut, second, lengths);
                    weights = half_weights(cut, second, weights);
                    piece = half_corners(cut, second, piece, middle);
                    node = halves[usize::from(second)];
                    let exact = edges(piece);
                    assert!((0..3).all(|k| (exact[k] - lengths[k]).abs() < 1e-9));
                }
                assert_eq!(node, leaf);
                assert!(weights.iter().all(|w| *w >= -1e-12) && edges(piece).iter().all(|l| *l <= 1.0));
                let again: Point = at(piece, weights);
                assert!(minus(again, place).iter().all(|d: &f64| d.abs() < 1e-9));
            }
        }
        assert!(Bisection::of(&mesh, 0.01, 1000).edge > 0.01);
        assert_eq!(Bisection::of(&mesh, 100.0, 1000).len(), 2);
    }
}
