//! Which of eight triangles cannot meet one: seen in single precision, from four planes.
//!
//! Four planes of a triangle are looked at: its own and the three that stand on its edges. A pair is settled when the corners
//! of the other triangle lie all beyond one of them. Corners shared with the first *and in that plane* count as beyond. Then
//! the plane contains all that the two have in common, a shared corner or edge. A corner counts as beyond when the rounded
//! distance says so by more than its error.
#![expect(clippy::needless_range_loop, reason = "lanes are indices into several arrays at once")]

use super::masks::Masks;
use super::tree::{Boxes, Frame, Leaf, TREE_WIDTH};
use crate::mesh::Mesh;
use crate::num::rounding::SINGLE_DISTANCE_ROUNDING;
use crate::space::{Point, cross, dot, minus};

/// Directions have components up to 1. Two places that are each off by the slack in three coordinates make a distance: six
/// slacks, and two to spare.
const SLACKS_PER_DISTANCE: f32 = 8.0;

/// Directions (greatest component 1) of the plane and the three edge planes of each triangle of a leaf. The place of the second
/// edge along its direction stands with them. Zero where the triangle is too thin to trust them.
pub(super) struct Planes {
    direction: [[[f32; TREE_WIDTH]; 3]; 4],
    offset: [f32; TREE_WIDTH],
}

/// The corners of the triangles of a leaf in the frame, in double precision. Apart from [`planes`],
/// so that the arithmetic there can use vectors.
#[inline(always)]
fn places(mesh: &Mesh, frame: &Frame, leaf: &Leaf) -> [[[f64; TREE_WIDTH]; 3]; 3] {
    if frame.slack == 0.0 {
        return leaf.at.map(|corner| corner.map(|row| row.map(f64::from)));
    }
    let mut at = [[[0.0; TREE_WIDTH]; 3]; 3];
    for (corner, numbers) in at.iter_mut().zip(&leaf.corner) {
        for (i, number) in numbers.iter().enumerate() {
            let place = mesh.positions.get(*number as usize).map_or([0.0; 3], |p| frame.place(p));
            for (row, x) in corner.iter_mut().zip(place) {
                row[i] = x;
            }
        }
    }
    at
}

/// The planes of the triangles of a leaf.
#[inline(always)]
pub(super) fn planes(mesh: &Mesh, frame: &Frame, leaf: &Leaf) -> Planes {
    /// Height over length below which the direction of a triangle is not trusted.
    const MIN_TRUSTED_SLENDERNESS: f64 = 1e-6;
    /// Height in the frame below which the direction is not trusted where places are rounded. Each place is off by up to 2^-54,
    /// and the direction then by less than 2^-25.
    const MIN_TRUSTED_HEIGHT: f64 = 1.0 / (1 << 26) as f64;
    let tiny = if frame.slack == 0.0 { 0.0 } else { MIN_TRUSTED_HEIGHT };
    let mut out = Planes { direction: [[[0.0; TREE_WIDTH]; 3]; 4], offset: [0.0; TREE_WIDTH] };
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let size = |x: Point| larger(larger(x[0].abs(), x[1].abs()), x[2].abs());
    let at = places(mesh, frame, leaf);
    for i in 0..TREE_WIDTH {
        let [a, b, c] = [0, 1, 2].map(|j| [at[j][0][i], at[j][1][i], at[j][2][i]]);
        let e = [minus(b, a), minus(c, b), minus(a, c)];
        let n = cross(e[0], e[1]);
        let longest = larger(larger(size(e[0]), size(e[1])), size(e[2]));
        let trusted = size(n) > larger(MIN_TRUSTED_SLENDERNESS * longest, tiny) * longest;
        let mut put = |j: usize, d: Point| {
            let f = if trusted { 1.0 / size(d) } else { 0.0 };
            for (k, x) in d.into_iter().enumerate() {
                out.direction[j][k][i] = (x * f) as f32;
            }
            d.map(|x| x * f)
        };
        put(0, n);
        put(1, cross(e[0], n));
        let m = put(2, cross(e[1], n));
        put(3, cross(e[2], n));
        out.offset[i] = dot(m, e[0]) as f32;
    }
    out
}

/// Which of the boxes overlap `b`.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
pub(super) unsafe fn overlap<L: Masks>(boxes: &Boxes, b: &[f32; 6]) -> u32 {
    // SAFETY: handed on.
    unsafe {
        let x = both::<L>(boxes, b, 0);
        let y = both::<L>(boxes, b, 1);
        let z = both::<L>(boxes, b, 2);
        L::bits(L::both(L::both(x, y), z))
    }
}

/// Which of the boxes overlap `b` along axis `k`.
#[inline(always)]
unsafe fn both<L: Masks>(boxes: &Boxes, b: &[f32; 6], k: usize) -> L::Mask {
    // SAFETY: handed on.
    unsafe {
        let below = L::load(&boxes.0[k]).at_most(L::splat(b[k + 3]));
        L::both(below, L::splat(b[k]).at_most(L::load(&boxes.0[k + 3])))
    }
}

/// The triangles `among` those of leaf `q` that may meet triangle `i` of leaf `l`. `reach` is the sum of the sides of a box
/// around all of them.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
pub(super) unsafe fn unseparated<L: Masks>(
    (l, i, planes): (&Leaf, usize, &Planes),
    q: &Leaf,
    reach: f32,
    slack: f32,
    among: u32,
) -> u32 {
    let error = reach * SINGLE_DISTANCE_ROUNDING + SLACKS_PER_DISTANCE * slack + f32::MIN_POSITIVE;
    // SAFETY: handed on. (No closures: they would not be compiled for the instructions of `L`.)
    unsafe {
        let (more, less) = (L::splat(error), L::splat(-error));
        let mut same = [[more.at_most(less); 3]; 3];
        let mut at = [[more; 3]; 3];
        for k in 0..3 {
            for j in 0..3 {
                same[k][j] = L::equal(&q.corner[k], l.corner[j][i]);
                at[k][j] = L::load(&q.at[k][j]) - L::splat(l.at[0][j][i]);
            }
        }
        let (mut above, mut below) = (less.at_most(more), less.at_most(more));
        for k in 0..3 {
            let shared = L::either(L::either(same[k][0], same[k][1]), same[k][2]);
            let d = along::<L>(&planes.direction[0], i, &at[k]);
            above = L::both(above, L::either(more.at_most(d), shared));
            below = L::both(below, L::either(d.at_most(less), shared));
        }
        let mut settled = L::either(above, below);
        for e in 0..3 {
            let limit = if e == 1 { L::splat(planes.offset[i] + error) } else { more };
            let mut beyond = less.at_most(more);
            for k in 0..3 {
                let d = along::<L>(&planes.direction[e + 1], i, &at[k]);
                let shared = L::either(same[k][e], same[k][(e + 1) % 3]);
                beyond = L::both(beyond, L::either(limit.at_most(d), shared));
            }
            settled = L::either(settled, beyond);
        }
        among & !L::bits(settled)
    }
}

/// Points along direction `i`.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
unsafe fn along<L: Masks>(d: &[[f32; TREE_WIDTH]; 3], i: usize, at: &[L; 3]) -> L {
    // SAFETY: handed on.
    unsafe { at[2].mul_add(L::splat(d[2][i]), at[1].mul_add(L::splat(d[1][i]), at[0] * L::splat(d[0][i]))) }
}
