//! How nodes and leaves lie in memory; see the module `tree` for what they hold.

use crate::space::Point;

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
pub const FIELDS_PER_TRIANGLE: usize = 19;

/// Frame axes: `x` in fields 0..3, `y` in 3..6, `z` in 6..9.
pub const FRAME_AXES: usize = 0;

/// Corner `A` in the frame's directions: 9..12. Subtracted after the rotation.
pub const CORNER_A: usize = 9;

/// Length of `AB`.
pub const AB_LENGTH: usize = 12;

/// Direction (x, y) and length of `AC_FIELD`.
pub const AC_FIELD: usize = 13;

/// Direction (x, y) and length of `BC_FIELD`.
pub const BC_FIELD: usize = 16;

/// Up to eight triangles, structure of arrays: `field[f][j]` is field `f` of triangle `j`.
#[repr(C, align(64))]
#[derive(Clone, Copy)]
pub struct Leaf {
    /// See [`FIELDS_PER_TRIANGLE`].
    pub field: [[f32; 8]; FIELDS_PER_TRIANGLE],
    /// Point (unscaled, double precision) that the leaf's numbers are relative to.
    pub origin: Point,
    /// Slot of the first triangle; triangle `j` has slot `first + j`.
    pub first: u32,
    /// Scaled distance from `origin` to the farthest corner: with the query's distance, it bounds the rounding error.
    pub radius: f32,
}

/// An unused lane stands this far away (scaled) along its normal: never a candidate, and its square is finite.
pub const UNUSED_LANE_HEIGHT: f32 = 1e18;
