//! The ground that regions are grown on: pieces of surface with a normal, and which of them are neighbors.
//!
//! The pieces are the facets of a mesh or the points of a cloud; everything after this file treats both alike.

use super::probe::Probe;
use crate::space::{Aabb, Point, Vector, dot, minus, norm, times};

/// No region, no piece.
pub(super) const NO_PIECE: u32 = u32::MAX;

/// The measured places of a piece.
#[derive(Debug)]
pub(super) enum Pieces<'a> {
    /// Facets: the corners of each.
    Facets(&'a [[u32; 3]]),
    /// Points: the piece is the point.
    Points,
}

/// Pieces of surface and their neighbors.
#[derive(Debug)]
pub(super) struct PieceGraph<'a> {
    /// The measured points, millimeters.
    pub points: &'a [Point],
    pub pieces: Pieces<'a>,
    /// Middle of each piece.
    pub places: Vec<Point>,
    /// Unit normal of each piece; zero where it has none.
    pub normals: Vec<Vector>,
    /// Area of each piece, mm²; of a point, 1.
    pub weights: Vec<f64>,
    /// The neighbors of piece `i` are `others[first[i]..first[i + 1]]`.
    pub first: Vec<u32>,
    pub others: Vec<u32>,
    /// Whether the facets are those of a program that draws parts: exact, and no smaller than the shape asks for. False of points.
    pub is_drawn: bool,
}

/// How far a piece may be from an element that it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Band {
    /// Distance, millimeters.
    pub distance: f64,
    /// Cosine of the angle between the normals.
    pub cosine: f64,
}

impl PieceGraph<'_> {
    /// Number of pieces.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }
    /// The neighbors of a piece.
    pub(super) fn neighbors(&self, piece: u32) -> &[u32] {
        let i = piece as usize;
        &self.others[self.first[i] as usize..self.first[i + 1] as usize]
    }
    /// Whether a piece can belong to anything.
    pub(super) fn counts(&self, piece: u32) -> bool {
        self.normals[piece as usize] != [0.0; 3]
    }
    /// Sum of the weights.
    pub(super) fn weight(&self, pieces: &[u32]) -> f64 {
        pieces.iter().map(|&p| self.weights[p as usize]).sum()
    }
    /// The numbers of the measured points of a piece.
    #[inline]
    pub(super) fn corners(&self, piece: u32) -> ([u32; 3], usize) {
        match self.pieces {
            Pieces::Facets(faces) => (faces[piece as usize], 3),
            Pieces::Points => ([piece; 3], 1),
        }
    }
    /// The numbers of the measured points of all `pieces`, ascending, each once.
    pub(super) fn points_of(&self, pieces: impl IntoIterator<Item = u32>) -> Vec<u32> {
        let mut all: Vec<u32> = Vec::new();
        for piece in pieces {
            let (corners, count) = self.corners(piece);
            all.extend(&corners[..count]);
        }
        all.sort_unstable();
        all.dedup();
        all
    }
    /// Whether the pieces are facets.
    pub(super) fn is_mesh(&self) -> bool {
        matches!(self.pieces, Pieces::Facets(_))
    }
    /// Length of the edge that two facets share.
    pub(super) fn edge(&self, one: u32, other: u32) -> Option<f64> {
        let [(a, count), (b, _)] = [one, other].map(|p| self.corners(p));
        let mut shared = a[..count].iter().filter(|c| b.contains(c)).map(|c| self.points[*c as usize]);
        Some(norm(minus(shared.next()?, shared.next()?)))
    }
    /// Cosine of the angle by which the surface turns from one piece to a neighbor. Their normals may point to either side;
    /// whether it goes on or folds back tells the edge of two facets.
    pub(super) fn turn(&self, one: u32, other: u32) -> f64 {
        let cosine = dot(self.normals[one as usize], self.normals[other as usize]).abs();
        if self.folds_back(one, other) { -cosine } else { cosine }
    }
    /// Whether two facets lie on the same side of the edge that they share, as those of a rim sharper than a right angle.
    pub(super) fn folds_back(&self, one: u32, other: u32) -> bool {
        // A flood begins with a piece reached from itself.
        if one == other || !self.is_mesh() {
            return false;
        }
        let [a, b] = [one, other].map(|piece| self.corners(piece).0);
        let place = |corner: u32| self.points[corner as usize];
        let mut shared = a.iter().filter(|c| b.contains(c)).map(|c| place(*c));
        let (Some(from), Some(to)) = (shared.next(), shared.next()) else { return false };
        let own = |corners: [u32; 3], others: [u32; 3]| corners.into_iter().find(|c| !others.contains(c));
        let (Some(c), Some(d)) = (own(a, b), own(b, a)) else { return true };
        let edge = minus(to, from);
        let [c, d] = [c, d].map(|corner| minus(place(corner), from));
        // Across the edge, times the square of its length: no division by that of an edge without any.
        let square = dot(edge, edge);
        let across = |q: Vector| minus(times(square, q), times(dot(q, edge), edge));
        dot(across(c), across(d)) > 0.0
    }
    /// Quotient of the weights of two pieces, of the lesser by the greater, to a thousandth.
    pub(super) fn likeness(&self, one: u32, other: u32) -> f64 {
        let [a, b] = [one, other].map(|p| self.weights[p as usize]);
        (1e3 * a.min(b) / a.max(b)).round() / 1e3
    }
    /// At most about `most` places of the measured points of `pieces`, taken evenly over the list.
    pub(super) fn sampled_places(&self, pieces: &[u32], most: usize) -> Vec<Point> {
        let stride = pieces.len().div_ceil(most).max(1);
        let sampled = self.points_of(pieces.iter().copied().step_by(stride));
        sampled.into_iter().map(|i| self.points[i as usize]).collect()
    }
    /// Whether a piece lies within `band` of the element. Two corners of a facet must. The third, which may belong to a
    /// neighboring face that is shared at an edge, may be four times as far.
    #[inline]
    pub(super) fn belongs(&self, piece: u32, element: &Probe, band: &Band) -> bool {
        let i = piece as usize;
        let turned = element.cosine(self.places[i], self.normals[i]);
        // The normal of a piece without area is zero.
        if turned.is_nan() || turned < band.cosine.max(f64::MIN_POSITIVE) {
            return false;
        }
        let (corners, count) = self.corners(piece);
        let mut outside = 0;
        for &c in &corners[..count] {
            let d = element.distance(self.points[c as usize]).abs();
            outside += usize::from(d.is_nan() || d > band.distance);
            if d > 4.0 * band.distance || 3 * outside > count {
                return false;
            }
        }
        true
    }
    /// How badly a piece fits: 1 at the edge of the band in distance or in angle.
    pub(super) fn misfit(&self, piece: u32, element: &Probe, band: &Band) -> f64 {
        let i = piece as usize;
        let (corners, count) = self.corners(piece);
        let square: f64 =
            corners[..count].iter().map(|&c| element.distance(self.points[c as usize]).powi(2)).sum();
        let turned = 1.0 - element.cosine(self.places[i], self.normals[i]);
        square / (count as f64 * band.distance * band.distance) + turned / (1.0 - band.cosine)
    }
    /// The box of the measured points of `pieces`.
    pub(super) fn bounds(&self, pieces: &[u32]) -> Aabb {
        pieces.iter().fold(Aabb::EMPTY, |b, &p| {
            let (corners, count) = self.corners(p);
            b.union(&Aabb::of(corners[..count].iter().map(|&c| &self.points[c as usize])))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::facets;
    use super::*;
    use crate::mesh::Mesh;
    use crate::shape::Shape;

    #[test]
    fn one_corner_may_lie_off_and_no_facet_be_turned() {
        let band = Band { distance: 0.1, cosine: 0.9 };
        let plane = Probe::new(&Shape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
        let belongs = |heights: [f64; 3]| {
            let corners = [[0.0, 0.0, heights[0]], [9.0, 0.0, heights[1]], [0.0, 9.0, heights[2]]];
            let mesh = Mesh { positions: corners.to_vec(), faces: vec![[0, 1, 2]] };
            facets::surface(&mesh).belongs(0, &plane, &band)
        };
        assert!(belongs([0.0; 3]) && belongs([0.09, -0.09, 0.09]) && belongs([0.0, 0.39, 0.05]));
        assert!(!belongs([0.0, 0.41, 0.05]) && !belongs([0.11, 0.12, 0.0]));
        // All corners are near, but it leans by more than 26 degrees.
        let mesh =
            Mesh { positions: vec![[0.0; 3], [0.1, 0.0, 0.09], [0.0, 9.0, 0.0]], faces: vec![[0, 1, 2]] };
        assert!(!facets::surface(&mesh).belongs(0, &plane, &band));
        // Without area it belongs to nothing.
        let mesh = Mesh { positions: vec![[0.0; 3], [1.0, 0.0, 0.0]], faces: vec![[0, 1, 1]] };
        assert!(!facets::surface(&mesh).belongs(0, &plane, &band));
    }
}
