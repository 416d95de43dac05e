//! The search tree: nodes with eight children, leaves with eight triangles.
//!
//! **Scaled space.** Nodes and leaves live in single precision, in coordinates `(x - center) * scale`. The power of two `scale`
//! makes the mesh about one unit large. So a part of 10 µm and one of 10 km, at the origin or at 1e6, are searched with the
//! same relative precision. Nothing under- or overflows.
//!
//! **Leaf frames.** A leaf holds each triangle in the triangle's own right-handed orthonormal frame. The origin is a corner
//! `A`, `x` runs along the longest edge `AB`, `y` in the plane towards `C`, `z` along the normal. A query is moved into the
//! frame by nine multiply-adds. The remaining task is the distance in a plane to a triangle with one side on the x axis; see
//! `kernel`. A rotation is perfectly conditioned. So the error of the computed distance is a few roundings of the lengths
//! involved for *every* triangle, needles and points included. A Gram matrix (the usual barycentric way) loses digits with the
//! square of the aspect ratio and costs about 70 instead of 45 operations.
//!
//! **Slots.** Triangles are stored again in the order of the leaves ("slots"), as indices into vertices renumbered by first
//! use. So the double-precision finish reads memory that neighbors in space share.

use crate::closest::hit::Hit;
use crate::closest::layout::{Leaf, Node};
use crate::closest::triangle::{self, Feature};
use crate::space::{Point, minus, norm};
use std::ops::Deref;
use std::sync::Arc;

/// Share by which coordinates and lengths may be off in the coordinates of a tree. It is more than rounding to these, and a
/// division by a direction, take.
pub const TREE_ROUNDING: f64 = 1e-12;

/// A mesh prepared for closest-point queries: build once, ask often, from any number of threads.
///
/// Holds its own copy of the triangles, about 120 bytes a face; the mesh may be dropped. Clones share it.
#[derive(Clone)]
pub struct Tree(Arc<Arrays>);

impl Deref for Tree {
    type Target = Arrays;
    #[inline(always)]
    fn deref(&self) -> &Arrays {
        &self.0
    }
}

/// The arrays of a tree.
pub struct Arrays {
    pub(super) nodes: Vec<Node>,
    pub(super) leaves: Vec<Leaf>,
    /// Root: a node, or `!0` when all triangles fit one leaf.
    pub(super) root: i32,
    pub(super) center: Point,
    pub(super) scale: f64,
    /// Corners of each slot, indices into `corners`.
    pub(super) slots: Vec<[u32; 3]>,
    /// Vertices in order of first use by a slot.
    pub(super) corners: Vec<Point>,
    /// Face of each slot.
    pub(super) face: Vec<u32>,
}

/// The point of a mesh closest to a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// Distance to it, millimeters: correct to a few units in the last place.
    pub distance: f64,
    /// Where it is.
    pub point: Point,
    /// The face it lies on; where several faces are equally near, the lowest.
    pub face: u32,
    /// Weights of the face's corners: `point` is their weighted mean.
    pub barycentric: [f64; 3],
    /// The part of the face that it lies on.
    pub feature: Feature,
}

/// The point of a mesh closest to a given point, and the face there.
pub(crate) struct Foot {
    /// Where it is.
    pub point: Point,
    /// The part of the face that it lies on.
    pub feature: Feature,
    /// The corners of the face, in its order.
    pub corners: [Point; 3],
}

impl Tree {
    pub(super) fn new(arrays: Arrays) -> Tree {
        Tree(Arc::new(arrays))
    }

    /// Length of the longest edge of the face that was hit.
    pub(crate) fn longest_edge(&self, hit: &Hit) -> f64 {
        let [a, b, c] = self.triangle(hit.slot);
        [minus(b, a), minus(c, b), minus(a, c)].map(norm).into_iter().fold(0.0, f64::max)
    }

    /// Number of faces.
    pub fn faces(&self) -> usize {
        self.face.len()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..])
            + size_of_val(&self.leaves[..])
            + size_of_val(&self.slots[..])
            + size_of_val(&self.corners[..])
            + size_of_val(&self.face[..])
    }

    /// The place that `hit` found for `p`. Cost: one triangle.
    ///
    /// # Panics
    /// If `hit` comes from another tree with more faces.
    pub fn place(&self, p: &Point, hit: &Hit) -> Closest {
        let place = triangle::closest_point(p, &self.triangle(hit.slot));
        Closest {
            distance: hit.distance(),
            point: place.point,
            face: hit.face,
            barycentric: place.barycentric,
            feature: place.feature,
        }
    }

    /// As [`Tree::place`], without the weights of the corners: cheaper where the place lies inside the face, as most do.
    #[inline(always)]
    pub(crate) fn foot(&self, p: &Point, hit: &Hit) -> Foot {
        let corners = self.triangle(hit.slot);
        match triangle::foot(p, &corners, hit.height, hit.distance_squared) {
            Some(point) => Foot { point, feature: Feature::Face, corners },
            None => {
                let place = triangle::closest_point(p, &corners);
                Foot { point: place.point, feature: place.feature, corners }
            }
        }
    }

    /// The corners of the triangle in `slot`.
    #[inline(always)]
    pub(super) fn triangle(&self, slot: u32) -> [Point; 3] {
        let [a, b, c] = self.slots[slot as usize];
        [self.corners[a as usize], self.corners[b as usize], self.corners[c as usize]]
    }

    /// The slots of leaf `l`.
    pub(super) fn slots_of(&self, l: usize) -> std::ops::Range<u32> {
        let end = self.leaves.get(l + 1).map_or(self.face.len() as u32, |next| next.first);
        self.leaves[l].first..end
    }
}
