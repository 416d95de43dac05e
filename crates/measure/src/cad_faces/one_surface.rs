//! Which faces are parts of one surface.

use super::faces::CadFaces;
use trueness_geom::shape::Shape;
use trueness_geom::space::{Aabb, dot};

/// Share of its size within which surfaces are one whatever the file says: files have about ten digits.
const ROUNDED_SIZE_SHARE: f64 = 1e-7;

/// How two faces are to each other.
pub(super) enum Apart {
    /// Of one kind and sense, so far off each other at most, mm.
    By(f64),
    /// They look opposite ways.
    Turned,
    /// One is no element, or they are of two kinds.
    Kinds,
}

impl CadFaces {
    /// How far the surface of the second face is from that of the first.
    pub(super) fn apart(&self, first: u32, second: u32) -> Apart {
        let [a, b] = [first, second].map(|face| &self.faces[face as usize]);
        let (Some(one), Some(other)) = (a.shape, b.shape) else { return Apart::Kinds };
        if one.kind() != other.kind() {
            return Apart::Kinds;
        }
        if a.inward != b.inward || is_turned(&one, &other) {
            return Apart::Turned;
        }
        Apart::By(b.places.iter().map(|p| one.distance(*p).abs()).fold(0.0, f64::max))
    }

    /// How far surfaces may be apart that the file takes for one, mm.
    pub(super) fn same_within(&self, face: u32) -> f64 {
        let size = Aabb::of(&self.faces[face as usize].places).diagonal();
        self.uncertainty.max(ROUNDED_SIZE_SHARE * size)
    }

    /// Whether two faces are parts of one surface.
    pub(crate) fn is_one(&self, first: u32, second: u32) -> bool {
        matches!(self.apart(first, second), Apart::By(off) if off <= self.same_within(first))
    }

    /// The faces in groups that share edges and are one surface, as two halves of a bore are. Each group is ascending; groups are in the order of
    /// their first faces.
    pub fn surfaces(&self) -> Vec<Vec<u32>> {
        let mut group: Vec<Option<usize>> = vec![None; self.faces.len()];
        let mut all: Vec<Vec<u32>> = vec![];
        for start in 0..self.faces.len() as u32 {
            if group[start as usize].is_some() {
                continue;
            }
            let (number, mut own, mut next) = (all.len(), vec![start], 0);
            group[start as usize] = Some(number);
            while let Some(face) = own.get(next).copied() {
                next += 1;
                for other in &self.neighbors[face as usize] {
                    // All are held against the first, so that no chain of small steps leads away.
                    if group[*other as usize].is_none() && self.is_one(start, *other) {
                        group[*other as usize] = Some(number);
                        own.push(*other);
                    }
                }
            }
            own.sort_unstable();
            all.push(own);
        }
        all
    }
}

/// Whether two planes look opposite ways.
fn is_turned(one: &Shape, other: &Shape) -> bool {
    matches!((one, other), (Shape::Plane { normal: a, .. }, Shape::Plane { normal: b, .. }) if dot(*a, *b) < 0.0)
}
