//! A block of neighboring points, and the error bounds of the search in single precision.

use crate::closest::tree::Tree;
use crate::closest::triangle;
use crate::num::rounding::SINGLE_DISTANCE_ROUNDING;
use crate::space::Point;

/// Points in a block: the width of an AVX-512 register.
pub const POINTS_PER_BLOCK: usize = 16;
/// Factor that makes a length in single precision an upper bound. Making it from exact numbers takes at most eight roundings
/// of 2^-24, this one included: 4.8e-7.
pub const LENGTH_UP: f32 = 1.000_001;
/// The same for a square of lengths, of which each has eight: at most twenty roundings, 1.2e-6. The rest is to spare; a bound that
/// is too wide only looks at a triangle more.
pub const SQUARE_UP: f32 = 1.000_01;

/// A block of up to sixteen points.
pub struct PointBlock {
    pub points: [Point; POINTS_PER_BLOCK],
    pub len: usize,
    /// Center of the points' box.
    pub center: Point,
    /// Scaled: points relative to `center` (unused ones repeat the last), largest such length, half the box.
    pub offset: [[f32; POINTS_PER_BLOCK]; 3],
    pub reach: f32,
    pub half: [f32; 3],
    /// Scaled center relative to the tree's.
    pub at: [f32; 3],
}

impl PointBlock {
    /// The block of one to sixteen points.
    #[inline(always)]
    pub fn new(tree: &Tree, points: &[Point]) -> PointBlock {
        let len = points.len();
        let (mut lo, mut hi) = (points[0], points[0]);
        let mut b = PointBlock {
            points: [points[len - 1]; POINTS_PER_BLOCK],
            len,
            center: [0.0; 3],
            offset: [[0.0; POINTS_PER_BLOCK]; 3],
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
            b.center[k] = 0.5 * (lo[k] + hi[k]);
            b.half[k] = ((hi[k] - b.center[k]).max(b.center[k] - lo[k]) * tree.scale) as f32 * LENGTH_UP;
            b.at[k] = ((b.center[k] - tree.center[k]) * tree.scale) as f32;
            for i in 0..POINTS_PER_BLOCK {
                b.offset[k][i] = ((b.points[i][k] - b.center[k]) * tree.scale) as f32;
            }
        }
        let mut r = 0.0;
        for i in 0..POINTS_PER_BLOCK {
            let [x, y, z] = [b.offset[0][i], b.offset[1][i], b.offset[2][i]];
            let d = x * x + y * y + z * z;
            r = if d > r { d } else { r };
        }
        b.reach = r.sqrt() * LENGTH_UP;
        b
    }

    /// False if squares of the lengths involved would come near the end of the single-precision range.
    #[inline(always)]
    pub fn in_range(&self) -> bool {
        self.at.iter().chain(&self.half).all(|x| x.abs() < 1e15)
    }

    /// Point `i` relative to the tree's center, scaled.
    #[inline(always)]
    pub fn place(&self, i: usize) -> [f32; 3] {
        std::array::from_fn(|k| self.at[k] + self.offset[k][i])
    }

    /// Squared box distance up to which a box can hold a triangle nearer to point `i` than `best`, the least distance found.
    /// `error` is the bound of its error. The point's place and the boxes are rounded too, at the scale of the whole mesh.
    #[inline(always)]
    pub fn bound(&self, i: usize, best: f32, error: f32) -> f32 {
        let size = self.place(i).iter().fold(1.0, |m, x| if x.abs() > m { x.abs() } else { m });
        let d = best + 2.0 * error + SINGLE_DISTANCE_ROUNDING * (size + best);
        d * d * SQUARE_UP
    }

    /// The block's center relative to `origin`, scaled.
    #[inline(always)]
    pub fn relative(&self, tree: &Tree, origin: Point) -> [f32; 3] {
        std::array::from_fn(|k| ((self.center[k] - origin[k]) * tree.scale) as f32)
    }
}

/// A point of the surface near the block, and how far rounding may have put it off the surface. Neighboring values of a
/// coordinate can lie farther apart than the points do, where a mesh is small for its distance from the origin.
pub struct SurfacePoint {
    pub point: Point,
    /// Greatest distance from the surface, scaled.
    pub off: f32,
}

impl SurfacePoint {
    /// The place closest to the block's center on the triangle in this slot.
    #[inline(always)]
    pub fn new(tree: &Tree, b: &PointBlock, slot: u32) -> SurfacePoint {
        /// Greatest bound kept: its square is in the range of single precision.
        const MAX_KEPT_BOUND: f64 = 1e15;
        let t = tree.triangle(slot);
        let point = triangle::closest_point(&b.center, &t).point;
        // The rounding of lengths up to the size of the mesh, which is about 1.
        let rounding = 16.0 * f64::EPSILON;
        let off = triangle::squared_distance(&point, &t).0.sqrt() * tree.scale + rounding;
        // A NaN is not below either.
        SurfacePoint {
            point,
            off: if off < MAX_KEPT_BOUND { off as f32 * LENGTH_UP } else { MAX_KEPT_BOUND as f32 },
        }
    }
}

/// Length of a vector.
#[inline(always)]
pub fn norm(a: [f32; 3]) -> f32 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}
