//! Which of sixteen triangles cannot meet one: seen in single precision, from four planes.
//!
//! Of a triangle four planes are looked at: its own and the three that stand on its edges. A pair is settled when the
//! corners of the other triangle lie all beyond one of them, where corners shared with the first *and in that plane*
//! count as beyond: then the plane contains all that the two have in common, and that is a shared corner or edge. A
//! corner counts as beyond when the rounded distance says so by more than its error.
#![expect(clippy::needless_range_loop, reason = "lanes are indices into several arrays at once")]

use super::tree::{Boxes, Frame, Leaf};
use crate::closest::lanes::{Lanes, Plain};
#[cfg(target_arch = "x86_64")]
use crate::closest::lanes_x86::{A8, A16, Z16};
use crate::mesh::Mesh;
use crate::space::{Point, cross, dot, minus};
use crate::topology::same::{Same, W};

/// Triangles looked at together, half a leaf: of a whole one, seldom more than three overlap.
const HALF: usize = W / 2;

/// An instruction set the filter is written in.
pub(super) trait Wide: Lanes<W> {
    /// For half a leaf.
    type Half: Lanes<HALF> + Same<HALF>;
}
impl Wide for Plain<W> {
    type Half = Plain<HALF>;
}
#[cfg(target_arch = "x86_64")]
impl Wide for A16 {
    type Half = A8;
}
#[cfg(target_arch = "x86_64")]
impl Wide for Z16 {
    type Half = A8;
}

/// Distances are formed with less than ten roundings of 2^-24 of the sum of their terms; this allows sixteen.
const ROUNDING: f32 = 1.0 / (1 << 20) as f32;
/// Directions have components up to 1, and two places that are each off by the slack in three coordinates make a
/// distance: six of them, and two to spare.
const SLACKS: f32 = 8.0;

/// Directions (greatest component 1) of the plane and the three edge planes of each triangle of a leaf, and the place
/// of the second edge along its direction. Zero where the triangle is too thin to trust them.
pub(super) struct Planes {
    direction: [[[f32; W]; 3]; 4],
    offset: [f32; W],
}

/// The corners of the triangles of a leaf in the frame, in double precision: as exact as the mesh. Apart from [`planes`],
/// so that the arithmetic there can use vectors.
#[inline(always)]
fn places(mesh: &Mesh, frame: &Frame, leaf: &Leaf) -> [[[f64; W]; 3]; 3] {
    if frame.slack == 0.0 {
        return leaf.at.map(|corner| corner.map(|row| row.0.map(f64::from)));
    }
    let mut at = [[[0.0; W]; 3]; 3];
    for (corner, numbers) in at.iter_mut().zip(&leaf.corner) {
        for (i, number) in numbers.0.iter().enumerate() {
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
    const THIN: f64 = 1e-6;
    let mut out = Planes { direction: [[[0.0; W]; 3]; 4], offset: [0.0; W] };
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let size = |x: Point| larger(larger(x[0].abs(), x[1].abs()), x[2].abs());
    let at = places(mesh, frame, leaf);
    for i in 0..W {
        let [a, b, c] = [0, 1, 2].map(|j| [at[j][0][i], at[j][1][i], at[j][2][i]]);
        let e = [minus(b, a), minus(c, b), minus(a, c)];
        let n = cross(e[0], e[1]);
        let longest = larger(larger(size(e[0]), size(e[1])), size(e[2]));
        let trusted = size(n) > THIN * longest * longest;
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

/// Which of sixteen boxes overlap `b`.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
pub(super) unsafe fn overlap<L: Wide>(boxes: &Boxes, b: &[f32; 6]) -> u32 {
    let mut both = 0xffff;
    for k in 0..3 {
        // SAFETY: handed on.
        unsafe {
            both &= L::load(&boxes.0[k].0).le(L::splat(b[k + 3]));
            both &= L::splat(b[k]).le(L::load(&boxes.0[k + 3].0));
        }
    }
    both
}

/// Which triangles `among` those of leaf `q` may meet triangle `i` of leaf `l`; `reach` is the sum of the sides of a
/// box around all of them.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
pub(super) unsafe fn left_over<L: Wide>(
    (l, i, planes): (&Leaf, usize, &Planes),
    q: &Leaf,
    reach: f32,
    slack: f32,
    among: u32,
) -> u32 {
    let error = reach * ROUNDING + SLACKS * slack + f32::MIN_POSITIVE;
    let mut left = 0;
    for half in 0..2 {
        let among = among >> (half * HALF) & 0xff;
        if among != 0 {
            // SAFETY: handed on.
            left |=
                unsafe { left_of_half::<L::Half>((l, i, planes), q, half, error, among) } << (half * HALF);
        }
    }
    left
}

/// [`left_over`] for the first or second half of leaf `q`.
#[inline(always)]
unsafe fn left_of_half<L: Lanes<HALF> + Same<HALF>>(
    (l, i, planes): (&Leaf, usize, &Planes),
    q: &Leaf,
    half: usize,
    error: f32,
    among: u32,
) -> u32 {
    let id: [u32; 3] = std::array::from_fn(|j| l.corner[j].0[i]);
    let direction = |d: usize| std::array::from_fn::<f32, 3, _>(|k| planes.direction[d][k][i]);
    // SAFETY: handed on.
    unsafe {
        let (mut same, mut at) = ([[0; 3]; 3], [[L::splat(0.0); 3]; 3]);
        for k in 0..3 {
            for j in 0..3 {
                same[k][j] = L::same(&q.corner[k].0.as_chunks().0[half], id[j]);
                at[k][j] = L::load(&q.at[k][j].0.as_chunks().0[half]) - L::splat(l.at[0][j].0[i]);
            }
        }
        let (more, less) = (L::splat(error), L::splat(-error));
        let (mut above, mut below) = (u32::MAX, u32::MAX);
        let own = direction(0);
        for k in 0..3 {
            let (d, shared) = (along(own, &at[k]), same[k][0] | same[k][1] | same[k][2]);
            above &= more.le(d) | shared;
            below &= d.le(less) | shared;
        }
        let mut left = among & !(above | below);
        for e in 0..3 {
            let limit = if e == 1 { L::splat(planes.offset[i] + error) } else { more };
            let (mut beyond, d) = (u32::MAX, direction(e + 1));
            for k in 0..3 {
                beyond &= limit.le(along(d, &at[k])) | same[k][e] | same[k][(e + 1) % 3];
            }
            left &= !beyond;
        }
        left
    }
}

/// Points along a direction.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
unsafe fn along<L: Lanes<HALF>>(d: [f32; 3], at: &[L; 3]) -> L {
    // SAFETY: handed on.
    unsafe { at[2].mul_add(L::splat(d[2]), at[1].mul_add(L::splat(d[1]), at[0] * L::splat(d[0]))) }
}
