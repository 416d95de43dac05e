//! Distance from a point to a segment, in double precision or in lanes of it.

use crate::simd::lanes::Real;

#[inline(always)]
pub(super) fn sub<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
#[inline(always)]
pub(super) fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Where between its ends the segment along `v` (squared length `vv`), seen from its tail, is nearest to the head of `w`.
#[inline(always)]
pub(super) fn along<T: Real>(w: [T; 3], v: [T; 3], vv: T, zero: T, one: T) -> T {
    let t = T::select(vv.above(zero), dot(w, v) / vv, zero);
    t.most(zero).least(one)
}

/// Squared distance from the head of `w` to the point at `t` of the segment along `v`.
#[inline(always)]
pub(super) fn aside<T: Real>(w: [T; 3], v: [T; 3], t: T) -> T {
    let e = sub(w, [t * v[0], t * v[1], t * v[2]]);
    dot(e, e)
}

/// Squared distance from the head of `w` to the segment along `v` (squared length `vv`) from its tail.
///
/// A function, not a closure: closures over vector types are not reliably inlined into `#[target_feature]` functions.
#[inline(always)]
pub(super) fn edge<T: Real>(w: [T; 3], v: [T; 3], vv: T, zero: T, one: T) -> T {
    aside(w, v, along(w, v, vv, zero, one))
}
