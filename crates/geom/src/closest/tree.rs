//! The search tree: nodes with eight children, leaves with eight triangles.
//!
//! **Scaled space.** Nodes and leaves live in single precision, in coordinates `(x - centre) * scale`, where `scale` is a
//! power of two that makes the mesh about one unit large. So a part of 10 µm and one of 10 km, at the origin or at 1e6,
//! are searched with the same relative precision and nothing under- or overflows.
//!
//! **Leaf frames.** A leaf holds each triangle in the triangle's own right-handed orthonormal frame: origin at a corner
//! `A`, `x` along the longest edge `AB`, `y` in the plane towards `C`, `z` normal. A query is moved into the frame by nine
//! multiply-adds; what remains is the distance in a plane to a triangle with one side on the x axis (see `kernel`). A
//! rotation is perfectly conditioned, so the error of the computed distance is a few roundings of the lengths involved
//! for *every* triangle, needles and points included; a Gram matrix (the usual barycentric way) loses digits with the
//! square of the aspect ratio and costs about 70 instead of 45 operations.
//!
//! **Slots.** Triangles are stored again in the order of the leaves ("slots"), as indices into vertices renumbered by
//! first use, so that the double-precision finish reads memory that neighbours in space share.

use crate::closest::limits::{self, MeshError};
use crate::closest::triangle::{self, Feature};
use crate::closest::{Hit, build};
use crate::mesh::Mesh;
use crate::progress::{Progress, Silent};
use crate::space::{Point, minus, norm};

/// Inner node: boxes of up to eight children, structure of arrays.
#[repr(C, align(64))]
#[derive(Clone, Copy)]
pub struct Node {
    /// `bounds[axis]` the low and `bounds[axis + 3]` the high sides. An unused child is an empty box (+inf, -inf).
    pub bounds: [[f32; 8]; 6],
    /// Index of a node, or `!index` of a leaf.
    pub child: [i32; 8],
}

impl Node {
    /// No child.
    pub const EMPTY: Node = Node {
        bounds: [
            [f32::INFINITY; 8],
            [f32::INFINITY; 8],
            [f32::INFINITY; 8],
            [f32::NEG_INFINITY; 8],
            [f32::NEG_INFINITY; 8],
            [f32::NEG_INFINITY; 8],
        ],
        child: [0; 8],
    };
}

/// Numbers kept for each triangle of a leaf: see the constants.
pub const FIELDS: usize = 19;
/// Frame axes: `x` in fields 0..3, `y` in 3..6, `z` in 6..9.
pub const AXES: usize = 0;
/// Corner `A` in the frame's directions: 9..12. Subtracted after the rotation.
pub const ORIGIN: usize = 9;
/// Length of `AB`.
pub const BASE: usize = 12;
/// Direction (x, y) and length of `AC`.
pub const AC: usize = 13;
/// Direction (x, y) and length of `BC`.
pub const BC: usize = 16;

/// Up to eight triangles, structure of arrays: `field[f][j]` is field `f` of triangle `j`.
#[repr(C, align(64))]
#[derive(Clone, Copy)]
pub struct Leaf {
    /// See [`FIELDS`].
    pub field: [[f32; 8]; FIELDS],
    /// Point (unscaled, double precision) that the leaf's numbers are relative to.
    pub origin: Point,
    /// Slot of the first triangle; triangle `j` has slot `first + j`.
    pub first: u32,
    /// Scaled distance from `origin` to the farthest corner: with the query's distance, it bounds the rounding error.
    pub radius: f32,
}

/// An unused lane stands this far away (scaled) along its normal: never a candidate, and its square is finite.
pub const NOWHERE: f32 = 1e18;

/// A mesh prepared for closest-point queries: build once, ask often, from any number of threads.
///
/// Holds its own copy of the triangles, about 120 bytes a face; the mesh may be dropped.
pub struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) leaves: Vec<Leaf>,
    /// Root: a node, or `!0` when all triangles fit one leaf.
    pub(super) root: i32,
    pub(super) centre: Point,
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
    /// Distance to it, millimetres: correct to a few units in the last place.
    pub distance: f64,
    /// Where it is.
    pub point: Point,
    /// The face it lies on; where several faces are equally near, the lowest.
    pub face: u32,
    /// Weights of the face's corners: `point` is their weighted mean.
    pub barycentric: [f64; 3],
    /// What part of the face it lies on.
    pub feature: Feature,
}

impl Tree {
    /// Prepares `mesh`, whose faces may be degenerate, doubled or crossing; vertices that no face uses do not count.
    ///
    /// Runs on the current rayon pool; the tree does not depend on its size. Cost: `n log n`, about 0.3 s and 200 MB for
    /// a million faces on two cores.
    ///
    /// # Errors
    /// [`MeshError`], if there are no faces, too many, one naming a vertex that does not exist, or a vertex that is not
    /// finite or beyond [`MAX_VERTEX`](crate::closest::MAX_VERTEX); or faces that extend over less than
    /// [`MIN_EXTENT`](crate::closest::MIN_EXTENT), for which the powers in distances would lose their digits.
    pub fn build(mesh: &Mesh) -> Result<Tree, MeshError> {
        Tree::build_watched(mesh, &Silent)
    }

    /// As [`Tree::build`], asking `progress` whether to go on.
    ///
    /// # Errors
    /// Those of [`Tree::build`], and [`MeshError::Cancelled`].
    pub fn build_watched(mesh: &Mesh, progress: &dyn Progress) -> Result<Tree, MeshError> {
        limits::check_mesh(mesh)?;
        Ok(build::build(mesh, progress)?)
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

    /// The corners of the triangle in `slot`.
    #[inline(always)]
    pub(super) fn triangle(&self, slot: u32) -> [Point; 3] {
        self.slots[slot as usize].map(|v| self.corners[v as usize])
    }

    /// The slots of leaf `l`.
    pub(super) fn slots_of(&self, l: usize) -> std::ops::Range<u32> {
        let end = self.leaves.get(l + 1).map_or(self.face.len() as u32, |next| next.first);
        self.leaves[l].first..end
    }
}
