//! A block of neighbouring points, the buffers of the thread that answers it, and the error bounds.

use crate::closest::layout::Node;
use crate::closest::tree::Tree;
use crate::closest::triangle;
use crate::space::Point;

/// Points in a block: the width of an AVX-512 register.
pub const BLOCK: usize = 16;
/// Up to this many leaves, a block is tested triangle by triangle; above, by a common walk. (8 and 12 are slower.)
pub const DENSE: usize = 10;
/// Leaves and nodes at most to begin the common walk with: children of two nodes. (24 are slower.)
pub const FRONT: usize = 16;
/// Unit of the error bounds: a distance computed from lengths up to `l` is right to `ROUNDING * l`. The kernels make
/// about ten roundings of 2^-24; this allows sixteen.
pub const ROUNDING: f32 = 1.0 / (1 << 20) as f32;

/// A triangle that may be the closest to some point of the block.
#[derive(Clone, Copy)]
pub struct Candidate {
    pub leaf: u32,
    pub lane: u32,
    /// The block's centre in the triangle's frame.
    pub centre: [f32; 3],
}

/// A child of a node: where it leads, and where its box stands.
#[derive(Clone, Copy)]
pub struct Seed {
    pub child: i32,
    pub parent: u32,
    pub lane: u32,
}

/// A leaf tested against one point by the wave.
#[derive(Clone, Copy)]
pub struct Row {
    pub distance2: [f32; 8],
    /// First slot of the leaf.
    pub first: u32,
    /// Number of the point in the block.
    pub point: u32,
}

/// Buffers of one thread, and what carries over from block to block.
#[derive(Default)]
pub struct Scratch {
    /// Winner of the block before: where to begin. (The answers do not depend on it.)
    pub warm: u32,
    /// Leaves that can hold the closest triangle of some point.
    pub leaves: Vec<Seed>,
    /// Nodes that can hold further ones; together at most [`FRONT`].
    pub open: Vec<Seed>,
    /// All of them, as children of nodes of their own: where the wave begins.
    pub front: Vec<Node>,
    /// (point, node) and (point, leaf) pairs of the wave.
    pub queue: Vec<[i32; 2]>,
    pub found: Vec<[i32; 2]>,
    pub candidates: Vec<Candidate>,
    /// Squared distances, candidates x points.
    pub table: Vec<[f32; BLOCK]>,
    pub rows: Vec<Row>,
    /// Triangles to settle: point of the block, slot.
    pub pairs: Vec<(u32, u32)>,
}

/// A block of up to sixteen points.
pub struct Block {
    pub points: [Point; BLOCK],
    pub len: usize,
    /// Centre of the points' box.
    pub centre: Point,
    /// Scaled: points relative to `centre` (unused ones repeat the last), largest such length, half the box.
    pub offset: [[f32; BLOCK]; 3],
    pub reach: f32,
    pub half: [f32; 3],
    /// Scaled centre relative to the tree's.
    pub at: [f32; 3],
}

impl Block {
    /// Of one to sixteen points.
    #[inline(always)]
    pub fn new(tree: &Tree, points: &[Point]) -> Block {
        let len = points.len();
        let (mut lo, mut hi) = (points[0], points[0]);
        let mut b = Block {
            points: [points[len - 1]; BLOCK],
            len,
            centre: [0.0; 3],
            offset: [[0.0; BLOCK]; 3],
            reach: 0.0,
            half: [0.0; 3],
            at: [0.0; 3],
        };
        for (i, p) in points.iter().enumerate() {
            b.points[i] = *p;
            for k in 0..3 {
                lo[k] = if p[k] < lo[k] { p[k] } else { lo[k] };
                hi[k] = if p[k] > hi[k] { p[k] } else { hi[k] };
            }
        }
        for k in 0..3 {
            b.centre[k] = 0.5 * (lo[k] + hi[k]);
            b.half[k] = ((hi[k] - b.centre[k]).max(b.centre[k] - lo[k]) * tree.scale) as f32 * 1.000001;
            b.at[k] = ((b.centre[k] - tree.centre[k]) * tree.scale) as f32;
            for i in 0..BLOCK {
                b.offset[k][i] = ((b.points[i][k] - b.centre[k]) * tree.scale) as f32;
            }
        }
        let mut r = 0.0;
        for i in 0..BLOCK {
            let [x, y, z] = [b.offset[0][i], b.offset[1][i], b.offset[2][i]];
            let d = x * x + y * y + z * z;
            r = if d > r { d } else { r };
        }
        b.reach = r.sqrt() * 1.000001;
        b
    }

    /// False if squares of the lengths involved would come near the end of the single-precision range.
    #[inline(always)]
    pub fn in_range(&self) -> bool {
        self.at.iter().chain(&self.half).all(|x| x.abs() < 1e15)
    }

    /// Point `i` relative to the tree's centre, scaled.
    #[inline(always)]
    pub fn place(&self, i: usize) -> [f32; 3] {
        std::array::from_fn(|k| self.at[k] + self.offset[k][i])
    }

    /// Squared box distance up to which a box can hold a rival of point `i`, whose least distance is `best` with error
    /// bound `error`. The point's place and the boxes are rounded too, at the scale of the whole mesh.
    #[inline(always)]
    pub fn bound(&self, i: usize, best: f32, error: f32) -> f32 {
        let size = self.place(i).iter().fold(1.0, |m, x| if x.abs() > m { x.abs() } else { m });
        let d = best + 2.0 * error + ROUNDING * (size + best);
        d * d * 1.00001
    }

    /// The block's centre relative to `origin`, scaled.
    #[inline(always)]
    pub fn relative(&self, tree: &Tree, origin: Point) -> [f32; 3] {
        std::array::from_fn(|k| ((self.centre[k] - origin[k]) * tree.scale) as f32)
    }
}

/// A place near the block, and how far off the surface it may be: the numbers of its coordinates are spaced, and where a mesh
/// is small, or long, for its distance from the origin, they are spaced wider than points are apart.
pub struct Near {
    pub point: Point,
    /// Scaled.
    pub off: f32,
}

impl Near {
    /// The place closest to the block's centre on the triangle in this slot.
    #[inline(always)]
    pub fn new(tree: &Tree, b: &Block, slot: u32) -> Near {
        /// Greatest that is worth telling: its square is in the range of single precision.
        const MOST: f64 = 1e15;
        let t = tree.triangle(slot);
        let point = triangle::closest_point(&b.centre, &t).point;
        // Of lengths up to the size of the mesh, which is about 1.
        let rounding = 16.0 * f64::EPSILON;
        let off = triangle::squared_distance(&point, &t).0.sqrt() * tree.scale + rounding;
        // A NaN is not below either.
        Near { point, off: if off < MOST { off as f32 * 1.000001 } else { MOST as f32 } }
    }
}

/// Length of a vector.
#[inline(always)]
pub fn norm(a: [f32; 3]) -> f32 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}
