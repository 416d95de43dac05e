//! What regions are grown on: pieces of surface with a normal, and which of them are neighbours.
//!
//! The pieces are the facets of a mesh or the points of a cloud; everything after this file treats both alike.

use crate::fit::Shape;
use crate::space::{Aabb, Point, Vector, dot};

/// No region, no piece.
pub(super) const NONE: u32 = u32::MAX;

/// The measured places of a piece.
#[derive(Debug)]
pub(super) enum Pieces<'a> {
    /// Facets: the corners of each.
    Facets(&'a [[u32; 3]]),
    /// Points: the piece is the point.
    Points,
}

/// Pieces of surface and their neighbours.
#[derive(Debug)]
pub(super) struct Surface<'a> {
    /// The measured points, millimetres.
    pub points: &'a [Point],
    pub pieces: Pieces<'a>,
    /// Middle of each piece.
    pub places: Vec<Point>,
    /// Unit normal of each piece; zero where it has none.
    pub normals: Vec<Vector>,
    /// Area of each piece, mm²; of a point, 1.
    pub weights: Vec<f64>,
    /// The neighbours of piece `i` are `others[first[i]..first[i + 1]]`.
    pub first: Vec<u32>,
    pub others: Vec<u32>,
}

/// How far a piece may be from an element that it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Band {
    /// Distance, millimetres.
    pub distance: f64,
    /// Cosine of the angle between the normals.
    pub cosine: f64,
}

impl Surface<'_> {
    /// Number of pieces.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }
    /// The neighbours of a piece.
    pub(super) fn neighbours(&self, piece: u32) -> &[u32] {
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
    /// At most about `most` places of the measured points of `pieces`, taken evenly over the list.
    pub(super) fn some_places(&self, pieces: &[u32], most: usize) -> Vec<Point> {
        let stride = pieces.len().div_ceil(most).max(1);
        let some = self.points_of(pieces.iter().copied().step_by(stride));
        some.into_iter().map(|i| self.points[i as usize]).collect()
    }
    /// Whether a piece lies within `band` of the element. Of a facet two corners must; the third, which may be one of
    /// a neighbouring face that is shared at an edge, may be four times as far.
    pub(super) fn belongs(&self, piece: u32, shape: &Shape, band: &Band) -> bool {
        let i = piece as usize;
        let turned = dot(self.normals[i], normal(shape, self.places[i])).abs();
        // The normal of a piece without area is zero.
        if turned.is_nan() || turned < band.cosine.max(f64::MIN_POSITIVE) {
            return false;
        }
        let (corners, count) = self.corners(piece);
        let mut outside = 0;
        for &c in &corners[..count] {
            let d = shape.distance(self.points[c as usize]).abs();
            outside += usize::from(d.is_nan() || d > band.distance);
            if d > 4.0 * band.distance || 3 * outside > count {
                return false;
            }
        }
        true
    }
    /// How badly a piece fits: 1 at the edge of the band in distance or in angle.
    pub(super) fn misfit(&self, piece: u32, shape: &Shape, band: &Band) -> f64 {
        let i = piece as usize;
        let (corners, count) = self.corners(piece);
        let square: f64 =
            corners[..count].iter().map(|&c| shape.distance(self.points[c as usize]).powi(2)).sum();
        let turned = 1.0 - dot(self.normals[i], normal(shape, self.places[i])).abs();
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

/// Unit normal of the element at the place of it nearest to `p`; zero where there are many.
pub(super) fn normal(shape: &Shape, p: Point) -> Vector {
    use crate::space::{minus, plus, times, unit};
    let direct = |v: Vector| unit(v).map_or([0.0; 3], |(v, _)| v);
    let across = |point: Point, axis: Vector| {
        let q = minus(p, point);
        direct(minus(q, times(dot(q, axis), axis)))
    };
    match *shape {
        Shape::Plane { normal, .. } => normal,
        Shape::Sphere { center, .. } => direct(minus(p, center)),
        Shape::Cylinder { point, direction, .. } => across(point, direction),
        Shape::Cone { point, direction, half_angle, .. } => {
            minus(times(half_angle.cos(), across(point, direction)), times(half_angle.sin(), direction))
        }
        Shape::Torus { center, direction, major_radius, .. } => {
            let ring = plus(center, times(major_radius, across(center, direction)));
            direct(minus(p, ring))
        }
        _ => [0.0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{plus, times};

    /// The normal is the gradient of the distance.
    #[test]
    fn normals_are_gradients_of_the_distance() {
        let direction = [0.6, 0.0, 0.8];
        let (center, half_angle) = ([1.0, 2.0, 3.0], 0.4f64);
        let apex = plus(center, times(-5.0 / half_angle.tan(), direction));
        let shapes = [
            Shape::Plane { point: center, normal: direction },
            Shape::Sphere { center, radius: 5.0 },
            Shape::Cylinder { point: center, direction, radius: 5.0 },
            Shape::Cone { apex, direction, half_angle, point: center, radius: 5.0 },
            Shape::Torus { center, direction, major_radius: 5.0, minor_radius: 2.0 },
        ];
        for shape in shapes {
            for p in [[4.0, -2.0, 1.0], [-3.0, 7.0, 5.0], [1.5, 8.0, 2.0]] {
                let gradient: Vector = std::array::from_fn(|k| {
                    let at = |h: f64| {
                        let mut q = p;
                        q[k] += h;
                        shape.distance(q)
                    };
                    (at(1e-5) - at(-1e-5)) / 2e-5
                });
                let found = normal(&shape, p);
                for k in 0..3 {
                    assert!((found[k] - gradient[k]).abs() < 1e-8, "{shape:?} {found:?} {gradient:?}");
                }
            }
        }
    }
}
