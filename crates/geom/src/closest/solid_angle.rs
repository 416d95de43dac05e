//! Solid angles of the tree's groups and triangles, seen from sixteen points at once.
//!
//! Each point decides for itself which groups it opens. The walk carries the set of points that still need a group opened;
//! values computed for the others count nothing. So a point's number does not depend on its neighbors.
//!
//! SAFETY, here and for every function: the caller promises that the processor has the instructions of `V`.
#![expect(unsafe_code, reason = "loads of vector types need their instructions")]

use crate::closest::block::POINTS_PER_BLOCK;
use crate::closest::layout::{AB_LENGTH, AC_FIELD, CORNER_A, FRAME_AXES, Leaf};
use crate::closest::tree::Tree;
use crate::simd::lanes::Lanes;
use crate::space::{Point, Vector};

/// Nodes and leaves still to be looked at, and for which points.
pub type Stack = Vec<(i32, u32)>;

/// The dipoles of a node's children, scaled, relative to the tree's center.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub struct Group {
    /// Coordinates of the center, area vector, and the square of the radius.
    child: [[f32; 8]; 8],
}

impl Group {
    /// Unused children: dipoles of no strength, never opened, as no point is taken to be so far away ([`MAX_SCALED_COORDINATE`]).
    pub const EMPTY: Group = Group { child: [[1e9, 1e9, 1e9, 0.0, 0.0, 0.0, 0.0, 0.0]; 8] };

    /// Fills in child `j`. All scaled.
    pub fn set(&mut self, j: usize, center: Point, vector: Vector, radius: f64) {
        let [c, v] = [center, vector].map(|a| a.map(|x| x as f32));
        self.child[j] = [c[0], c[1], c[2], v[0], v[1], v[2], (radius * radius) as f32, 0.0];
    }
}

/// Half of a solid angle for each point, and the full turns that its phase has lost. It is kept as a complex number of that
/// phase, so that angles add by multiplication and one arc tangent serves all.
struct Angle<V> {
    re: V,
    im: V,
    turns: V,
}

impl<V: Lanes<16>> Angle<V> {
    /// Adds the phase, between -π and π, of `re + i im`.
    ///
    /// A sum leaves that range only if both parts lie on one side of the real axis and the product on the other.
    #[inline(always)]
    fn add(&mut self, re: V, im: V, one: V) {
        let next_re = im.neg_fused(self.im, self.re * re);
        let next_im = self.re.fused(im, self.im * re);
        let [before, with, after] =
            [one.zero_where_negative(self.im), one.zero_where_negative(im), one.zero_where_negative(next_im)];
        let differ = before - with;
        self.turns = self.turns + (before - after) * differ.neg_fused(differ, one);
        (self.re, self.im) = (next_re, next_im);
    }

    /// Brings the number back to about unit size, which leaves the phase; does nothing the second time.
    #[inline(always)]
    fn rescale(&mut self, zero: V, tiny: V) {
        let size = self.re.max(zero - self.re).max(self.im.max(zero - self.im)).max(tiny);
        (self.re, self.im) = (self.re / size, self.im / size);
    }

    /// The phases, turns included.
    #[inline(always)]
    fn phases(&self) -> [f64; POINTS_PER_BLOCK] {
        let (re, im, turns) = (self.re.array(), self.im.array(), self.turns.array());
        std::array::from_fn(|i| {
            // Adding zero makes a negative zero positive, as the counting of turns takes it.
            let phase = libm::atan2(im[i] as f64 + 0.0, re[i] as f64);
            phase + 2.0 * std::f64::consts::PI * turns[i] as f64
        })
    }
}

/// Winding numbers of those of `points` whose bits are set in `who`; the others mean nothing. A group is a dipole from
/// `opening` radii on.
#[inline(always)]
pub unsafe fn numbers<V: Lanes<16>>(
    tree: &Tree,
    groups: &[Group],
    points: &[Point; POINTS_PER_BLOCK],
    who: u32,
    opening: f32,
    stack: &mut Stack,
) -> [f64; POINTS_PER_BLOCK] {
    unsafe {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let q = from::<V>(tree, points, tree.center);
        let open2 = opening * opening;
        let mut far = zero;
        let mut near = Angle { re: one, im: zero, turns: zero };
        stack.clear();
        stack.push((tree.root, who));
        while let Some((n, who)) = stack.pop() {
            if n < 0 {
                leaf_angle(tree, !n as usize, points, who, &mut near);
                continue;
            }
            let (group, node) = (&groups[n as usize], &tree.nodes[n as usize]);
            for (d, &child) in group.child.iter().zip(&node.child) {
                let e = [V::splat(d[0]) - q[0], V::splat(d[1]) - q[1], V::splat(d[2]) - q[2]];
                let d2 = e[0].fused(e[0], e[1].fused(e[1], e[2] * e[2]));
                let opened = d2.le(V::splat(open2 * d[6])) & who;
                if opened != 0 {
                    stack.push((child, opened));
                }
                if opened != who {
                    let v = e[1].fused(V::splat(d[4]), e[2] * V::splat(d[5]));
                    let v = e[0].fused(V::splat(d[3]), v);
                    far = far + (v / (d2 * d2.sqrt())).keep(who & !opened);
                }
            }
        }
        let (far, near) = (far.array(), near.phases());
        std::array::from_fn(|i| (far[i] as f64 + 2.0 * near[i]) / (4.0 * std::f64::consts::PI))
    }
}

/// Points farther away, scaled, are moved to it in each coordinate. The solid angle of the mesh from there is too small for
/// numbers.
const MAX_SCALED_COORDINATE: f64 = 1e8;

/// The points relative to `origin`, scaled.
#[inline(always)]
unsafe fn from<V: Lanes<16>>(tree: &Tree, points: &[Point; POINTS_PER_BLOCK], origin: Point) -> [V; 3] {
    let mut out = [[0f32; POINTS_PER_BLOCK]; 3];
    for (i, p) in points.iter().enumerate() {
        for k in 0..3 {
            out[k][i] =
                ((p[k] - origin[k]) * tree.scale).clamp(-MAX_SCALED_COORDINATE, MAX_SCALED_COORDINATE) as f32;
        }
    }
    unsafe { [V::load(&out[0]), V::load(&out[1]), V::load(&out[2])] }
}

/// Adds the triangles of leaf `l` for the points in `who`.
#[inline(always)]
unsafe fn leaf_angle<V: Lanes<16>>(
    tree: &Tree,
    l: usize,
    points: &[Point; POINTS_PER_BLOCK],
    who: u32,
    sum: &mut Angle<V>,
) {
    unsafe {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let leaf = &tree.leaves[l];
        let q = from::<V>(tree, points, leaf.origin);
        for lane in 0..tree.slots_of(l).len() {
            let (re, im) = triangle_angle(leaf, lane, q);
            // A point that does not need this leaf is given the number 1.
            sum.add((re - one).keep(who) + one, im.keep(who), one);
        }
        sum.rescale(zero, V::splat(f32::MIN_POSITIVE));
    }
}

/// A complex number whose phase is half the solid angle of triangle `lane` (van Oosterom & Strackee 1983), for points
/// relative to the leaf's origin. In the triangle's own frame the triple product is just base x height x -z.
#[inline(always)]
unsafe fn triangle_angle<V: Lanes<16>>(leaf: &Leaf, lane: usize, q: [V; 3]) -> (V, V) {
    unsafe {
        let lane = lane & 7;
        let f = |i: usize| leaf.field[i][lane];
        let mut r = q;
        for (axis, r) in r.iter_mut().enumerate() {
            let a = FRAME_AXES + 3 * axis;
            let p = q[2].fused(V::splat(f(a + 2)), V::splat(-f(CORNER_A + axis)));
            *r = q[0].fused(V::splat(f(a)), q[1].fused(V::splat(f(a + 1)), p));
        }
        let [x, y, z] = r;
        let (base, cx, cy) = (f(AB_LENGTH), f(AC_FIELD) * f(AC_FIELD + 2), f(AC_FIELD + 1) * f(AC_FIELD + 2));
        let (bx, cx, y_c) = (V::splat(base) - x, V::splat(cx) - x, V::splat(cy) - y);
        let zz = z * z;
        let yz = y.fused(y, zz);
        let la = x.fused(x, yz).sqrt();
        let lb = bx.fused(bx, yz).sqrt();
        let lc = cx.fused(cx, y_c.fused(y_c, zz)).sqrt();
        // Scalar products of the vectors to the corners.
        let ab = x.neg_fused(bx, yz);
        let c_low = y.neg_fused(y_c, zz);
        let bc = bx.fused(cx, c_low);
        let ca = x.neg_fused(cx, c_low);
        let lalb = la * lb;
        let re = lc.fused(lalb + ab, bc.fused(la, ca * lb));
        let im = z * V::splat(-base * cy);
        let size = (lalb * lc).max(V::splat(f32::MIN_POSITIVE));
        (re / size, im / size)
    }
}
