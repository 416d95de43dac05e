//! The inner loops in single precision: points against triangle frames, and blocks against boxes.
//!
//! SAFETY, here and for every function: the caller promises that the processor has the instructions of `V`.
#![expect(unsafe_code, reason = "loads of vector types need their instructions")]

use crate::closest::layout::{AB_LENGTH, AC_FIELD, BC_FIELD, CORNER_A, FRAME_AXES, Leaf, Node};
use crate::simd::lanes::Lanes;

/// Squared distance from `(x, y, z)`, given in triangle frames, to the triangles with sides `base`, `ac`, `bc`
/// (direction x, direction y, length).
///
/// For each side: `t` runs along it, `s` is the signed distance from its line, positive outside; the distance to the side
/// is `s² + (t - clamp t)²`. Inside all three lines only `z` counts. "Inside" is strict, so that a triangle without area,
/// whose three lines coincide, has no inside.
#[inline(always)]
pub unsafe fn frame_distance2<V: Lanes<N>, const N: usize>(
    [x, y, z]: [V; 3],
    base: V,
    ac: [V; 3],
    bc: [V; 3],
) -> V {
    let zero = unsafe { V::splat(0.0) };
    let e1 = x - x.max(zero).min(base);
    let d1 = e1.mul_add(e1, y * y);
    let t2 = x.mul_add(ac[0], y * ac[1]);
    let s2 = x.neg_mul_add(ac[1], y * ac[0]);
    let e2 = t2 - t2.max(zero).min(ac[2]);
    let d2 = e2.mul_add(e2, s2 * s2);
    let xb = x - base;
    let t3 = xb.mul_add(bc[0], y * bc[1]);
    let s3 = y.neg_mul_add(bc[0], xb * bc[1]);
    let e3 = t3 - t3.max(zero).min(bc[2]);
    let d3 = e3.mul_add(e3, s3 * s3);
    let outside = (zero - y).max(s2).max(s3);
    z.mul_add(z, d1.min(d2).min(d3).zero_where_negative(outside))
}

/// Field `i` of a leaf's eight triangles.
#[inline(always)]
unsafe fn field<V: Lanes<8>>(leaf: &Leaf, i: usize) -> V {
    unsafe { V::load(&leaf.field[i]) }
}

/// Each coordinate of `q` in a vector of its own.
///
/// A function, not `map` with a closure: closures over vector types are not reliably inlined into `#[target_feature]`
/// functions.
#[inline(always)]
pub unsafe fn splat<V: Lanes<8>>(q: [f32; 3]) -> [V; 3] {
    unsafe { [V::splat(q[0]), V::splat(q[1]), V::splat(q[2])] }
}

/// `q`, relative to the leaf's origin, in the frames of the leaf's eight triangles.
#[inline(always)]
pub unsafe fn into_frames<V: Lanes<8>>(leaf: &Leaf, q: [f32; 3]) -> [V; 3] {
    unsafe {
        let q = splat::<V>(q);
        let mut r = q;
        for (axis, r) in r.iter_mut().enumerate() {
            let a = FRAME_AXES + 3 * axis;
            let p = q[0].mul_add(field(leaf, a), q[1] * field(leaf, a + 1));
            *r = q[2].mul_add(field(leaf, a + 2), p - field(leaf, CORNER_A + axis));
        }
        r
    }
}

/// Squared distances from a point in frame coordinates `c` to the leaf's eight triangles.
#[inline(always)]
pub unsafe fn leaf_distance2<V: Lanes<8>>(leaf: &Leaf, c: [V; 3]) -> V {
    unsafe {
        let ac = [field(leaf, AC_FIELD), field(leaf, AC_FIELD + 1), field(leaf, AC_FIELD + 2)];
        let bc = [field(leaf, BC_FIELD), field(leaf, BC_FIELD + 1), field(leaf, BC_FIELD + 2)];
        frame_distance2(c, field(leaf, AB_LENGTH), ac, bc)
    }
}

/// Field `i` of the leaf's triangle `lane`, sixteen times.
#[inline(always)]
unsafe fn spread<V: Lanes<16>>(leaf: &Leaf, lane: usize, i: usize) -> V {
    unsafe { V::splat(leaf.field[i][lane & 7]) }
}

/// Squared distances from sixteen points to triangle `lane` of a leaf. `d` holds the points relative to a block
/// center, `c` that center in the triangle's frame.
#[inline(always)]
pub unsafe fn triangle_distance2<V: Lanes<16>>(leaf: &Leaf, lane: usize, c: [f32; 3], d: [V; 3]) -> V {
    unsafe {
        let mut r = d;
        for axis in 0..3 {
            let a = FRAME_AXES + 3 * axis;
            let p = d[2].mul_add(spread(leaf, lane, a + 2), V::splat(c[axis]));
            r[axis] = d[0].mul_add(spread(leaf, lane, a), d[1].mul_add(spread(leaf, lane, a + 1), p));
        }
        let ac = [
            spread(leaf, lane, AC_FIELD),
            spread(leaf, lane, AC_FIELD + 1),
            spread(leaf, lane, AC_FIELD + 2),
        ];
        let bc = [
            spread(leaf, lane, BC_FIELD),
            spread(leaf, lane, BC_FIELD + 1),
            spread(leaf, lane, BC_FIELD + 2),
        ];
        frame_distance2(r, spread(leaf, lane, AB_LENGTH), ac, bc)
    }
}

/// Squared distances from a point to the boxes of a node's children.
#[inline(always)]
pub unsafe fn box_distance2<V: Lanes<8>>(node: &Node, q: [V; 3]) -> V {
    unsafe {
        let zero = V::splat(0.0);
        let mut d = zero;
        for (k, q) in q.into_iter().enumerate() {
            let (lo, hi) = (V::load(&node.bounds[k]), V::load(&node.bounds[k + 3]));
            let e = (lo - q).max(q - hi).max(zero);
            d = e.mul_add(e, d);
        }
        d
    }
}

/// A block of points (as a box) and a point `x` of the surface, prepared for [`domination_margin`].
#[derive(Clone, Copy)]
pub struct Domination<V> {
    /// Low and high side of the block.
    side: [[V; 3]; 2],
    /// Squared distance from that side to `x`, along the axis.
    to_x: [[V; 3]; 2],
}

impl<V: Lanes<8>> Domination<V> {
    /// The block is the box `center ± half`.
    #[inline(always)]
    pub unsafe fn new(center: [f32; 3], half: [f32; 3], x: [f32; 3]) -> Self {
        unsafe {
            let zero = V::splat(0.0);
            let mut r = Domination { side: [[zero; 3]; 2], to_x: [[zero; 3]; 2] };
            for k in 0..3 {
                for (s, p) in [center[k] - half[k], center[k] + half[k]].into_iter().enumerate() {
                    r.side[s][k] = V::splat(p);
                    r.to_x[s][k] = V::splat((p - x[k]) * (p - x[k]));
                }
            }
            r
        }
    }
}

/// The least of `dist²(p, box) - |p - x|²` over all points `p` of the block, for the boxes of a node's children. Where it is
/// positive, nothing in the box can be closer than `x` to any point of the block.
///
/// Along one axis the difference is a concave function of `p`, so its least value is at one of the two sides of the block. Two
/// box distances an axis give the exact answer. This is the optimal decision criterion of Emrich, Kriegel, Kröger, Renz &
/// Züfle, "Boosting spatial pruning: on optimal pruning of MBRs" (SIGMOD 2010).
#[inline(always)]
pub unsafe fn domination_margin<V: Lanes<8>>(node: &Node, r: &Domination<V>) -> V {
    unsafe {
        let zero = V::splat(0.0);
        let mut g = zero;
        for k in 0..3 {
            let (lo, hi) = (V::load(&node.bounds[k]), V::load(&node.bounds[k + 3]));
            let e = (lo - r.side[0][k]).max(r.side[0][k] - hi).max(zero);
            let f = (lo - r.side[1][k]).max(r.side[1][k] - hi).max(zero);
            g = g + (e * e - r.to_x[0][k]).min(f * f - r.to_x[1][k]);
        }
        g
    }
}
