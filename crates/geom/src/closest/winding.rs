//! Inside or outside a mesh with holes, by the generalised winding number.
//!
//! The winding number of a point is the sum of the signed solid angles of all triangles over 4π: 1 inside and 0 outside
//! a closed mesh, and a smooth blend near the holes of an open one (Jacobson, Kavan & Sorkine-Hornung 2013). Far from
//! a group of triangles the sum is nearly that of one dipole at their centre, so it is gathered along the search tree
//! and a group is opened only when the point is within [`OPENING`] times its radius (Barill, Dickson, Schmidt, Levin &
//! Jacobson, "Fast winding numbers for soups and clouds", 2018; here with the first-order term only, and a wider opening
//! to make up for it). Eight groups or triangles are judged at once.
#![expect(unsafe_code, reason = "choosing the instruction set at run time; loads of vector types")]

use crate::closest::kernel::into_frames;
use crate::closest::lanes::{Lanes, Plain};
use crate::closest::limits::{QueryError, check_points};
use crate::closest::query::Level;
use crate::closest::tree::{AC, BASE, Tree};
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, cross, minus, norm, plus, times};
use rayon::prelude::*;

/// A group is taken as a dipole from this many radii on. At 3 the error stayed below 0.05 in the tests.
pub const OPENING: f64 = 3.0;

/// The dipole of a group of triangles.
#[derive(Clone, Copy, Default)]
struct Dipole {
    /// Area vector: sum of normals times areas.
    vector: [f64; 3],
    centre: [f64; 3],
    area: f64,
    /// Of a sphere about the centre that holds the triangles.
    radius: f64,
}

/// The dipoles of a node's children, structure of arrays, single precision relative to the tree's centre.
#[derive(Clone, Copy, Default)]
#[repr(align(32))]
struct Group {
    centre: [[f32; 8]; 3],
    vector: [[f32; 8]; 3],
    /// Square of the distance from which on the dipole serves.
    open: [f32; 8],
}

/// The tree's dipoles. Borrow the tree they belong to.
pub struct Winding<'a> {
    tree: &'a Tree,
    groups: Vec<Group>,
}

impl<'a> Winding<'a> {
    /// One pass over the triangles and nodes.
    pub fn new(tree: &'a Tree) -> Self {
        let of_leaf: Vec<Dipole> =
            (0..tree.leaves.len()).into_par_iter().map(|l| leaf_dipole(tree, l)).collect();
        let mut of_node = vec![Dipole::default(); tree.nodes.len()];
        // Unused children: a dipole of no strength, never opened.
        let empty = Group { centre: [[1e9; 8]; 3], open: [0.0; 8], vector: [[0.0; 8]; 3] };
        let mut groups = vec![empty; tree.nodes.len()];
        // A child's index is above its parent's.
        for n in (0..tree.nodes.len()).rev() {
            let children: Vec<Dipole> = used(tree, n)
                .map(|(_, c)| if c < 0 { of_leaf[!c as usize] } else { of_node[c as usize] })
                .collect();
            for (j, d) in children.iter().enumerate() {
                for k in 0..3 {
                    groups[n].centre[k][j] = ((d.centre[k] - tree.centre[k]) * tree.scale) as f32;
                    groups[n].vector[k][j] = (d.vector[k] * tree.scale * tree.scale) as f32;
                }
                groups[n].open[j] = (OPENING * d.radius * tree.scale).powi(2) as f32;
            }
            let area = children.iter().map(|d| d.area).sum::<f64>();
            let weight = |d: &Dipole| if area > 0.0 { d.area / area } else { 1.0 / children.len() as f64 };
            let centre = children.iter().fold([0.0; 3], |c, d| plus(c, times(weight(d), d.centre)));
            let vector = children.iter().fold([0.0; 3], |v, d| plus(v, d.vector));
            let radius =
                children.iter().map(|d| norm(minus(d.centre, centre)) + d.radius).fold(0.0, f64::max);
            of_node[n] = Dipole { vector, centre, area, radius };
        }
        Winding { tree, groups }
    }

    /// Winding number of each point.
    pub fn numbers(&self, points: &[Point], progress: &dyn Progress) -> Result<Vec<f64>, QueryError> {
        check_points(points)?;
        let level = Level::detect();
        let mut out = vec![0.0; points.len()];
        out.par_chunks_mut(256).zip(points.par_chunks(256)).try_for_each(|(o, p)| {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            self.chunk(level, p, o);
            progress.advance(p.len() as u64);
            Ok(())
        })?;
        Ok(out)
    }

    fn chunk(&self, level: Level, points: &[[f64; 3]], out: &mut [f64]) {
        #[cfg(target_arch = "x86_64")]
        {
            #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
            unsafe fn avx2(w: &Winding, p: &[[f64; 3]], o: &mut [f64]) {
                let mut stack = vec![];
                for (p, o) in p.iter().zip(o) {
                    *o = unsafe { w.number::<crate::closest::lanes_x86::A8>(p, &mut stack) };
                }
            }
            if level != Level::Plain {
                // SAFETY: `Level::detect` found AVX2.
                return unsafe { avx2(self, points, out) };
            }
        }
        let (mut stack, _) = (vec![], level);
        for (p, o) in points.iter().zip(out) {
            // SAFETY: plain Rust needs no special instructions.
            *o = unsafe { self.number::<Plain<8>>(p, &mut stack) };
        }
    }

    /// The winding number of `p`.
    #[inline(always)]
    unsafe fn number<V: Lanes<8>>(&self, p: &[f64; 3], stack: &mut Vec<i32>) -> f64 {
        unsafe {
            let q: [V; 3] =
                std::array::from_fn(|k| V::splat(((p[k] - self.tree.centre[k]) * self.tree.scale) as f32));
            let (mut far, mut near) = (V::splat(0.0), 0.0);
            stack.clear();
            stack.push(self.tree.root);
            while let Some(n) = stack.pop() {
                if n < 0 {
                    near += self.leaf_angle::<V>(!n as usize, p);
                    continue;
                }
                let g = self.groups.get_unchecked(n as usize);
                let e: [V; 3] = std::array::from_fn(|k| V::load(&g.centre[k]).sub(q[k]));
                let d2 = e[0].mul_add(e[0], e[1].mul_add(e[1], e[2].mul(e[2])));
                let v: [V; 3] = std::array::from_fn(|k| V::load(&g.vector[k]));
                let v = e[0].mul_add(v[0], e[1].mul_add(v[1], e[2].mul(v[2])));
                let inside = V::load(&g.open);
                far = far.add(v.div(d2.mul(d2.sqrt())).zero_where_negative(d2.sub(inside)));
                let mut mask = d2.le(inside);
                let node = self.tree.nodes.get_unchecked(n as usize);
                while mask != 0 {
                    stack.push(*node.child.get_unchecked(mask.trailing_zeros() as usize & 7));
                    mask &= mask - 1;
                }
            }
            let mut sums = [0f32; 8];
            far.store(&mut sums);
            let far: f64 = sums.iter().map(|&x| x as f64).sum();
            (far + near) / (4.0 * std::f64::consts::PI)
        }
    }

    /// Signed solid angle of a leaf's triangles: 2 atan2(y, x) each (van Oosterom & Strackee 1983). In a triangle's own
    /// frame the triple product y is just base x height x -z.
    #[inline(always)]
    unsafe fn leaf_angle<V: Lanes<8>>(&self, l: usize, p: &[f64; 3]) -> f64 {
        unsafe {
            let leaf = self.tree.leaves.get_unchecked(l);
            let [x, y, z] = into_frames::<V>(
                leaf,
                std::array::from_fn(|k| ((p[k] - leaf.origin[k]) * self.tree.scale) as f32),
            );
            let f = |i: usize| V::load(&leaf.field[i]);
            let (base, length) = (f(BASE), f(AC + 2));
            let (cx, cy) = (f(AC).mul(length), f(AC + 1).mul(length));
            let zero = V::splat(0.0);
            let corner = [[zero.sub(x), zero.sub(y)], [base.sub(x), zero.sub(y)], [cx.sub(x), cy.sub(y)]];
            let zz = z.mul(z);
            let inner = |i: usize, j: usize| {
                corner[i][0].mul_add(corner[j][0], corner[i][1].mul_add(corner[j][1], zz))
            };
            let [la, lb, lc] = [inner(0, 0).sqrt(), inner(1, 1).sqrt(), inner(2, 2).sqrt()];
            let re =
                la.mul(lb).mul_add(lc, inner(0, 1).mul_add(lc, inner(1, 2).mul_add(la, inner(2, 0).mul(lb))));
            let im = zero.sub(z).mul(base.mul(cy));
            let (mut xs, mut ys) = ([0f32; 8], [0f32; 8]);
            re.store(&mut xs);
            im.store(&mut ys);
            // An unused lane has y = 0, x > 0 up to rounding: no angle.
            let small =
                im.sub(re.mul(V::splat(0.3))).max(zero.sub(im).sub(re.mul(V::splat(0.3)))).le(zero) == 0xFF;
            if small && re.le(zero) == 0 {
                // Eight angles under 0.3 each: multiply the complex numbers and take one angle. Ratios, to keep their size.
                let (mut c, mut s) = (1.0f64, 0.0f64);
                for j in 0..8 {
                    let t = ys[j] as f64 / xs[j] as f64;
                    (c, s) = (c - s * t, s + c * t);
                }
                2.0 * s.atan2(c)
            } else {
                (0..8).map(|j| 2.0 * (ys[j] as f64).atan2(xs[j] as f64)).sum()
            }
        }
    }
}

/// The used children of node `n`, with their lanes.
fn used(tree: &Tree, n: usize) -> impl Iterator<Item = (usize, i32)> {
    let node = &tree.nodes[n];
    (0..8).filter(|&j| node.bounds[0][j] < f32::INFINITY).map(|j| (j, node.child[j]))
}

fn leaf_dipole(tree: &Tree, l: usize) -> Dipole {
    let mut d = Dipole::default();
    for s in tree.slots_of(l) {
        let [a, b, c] = tree.triangle(s);
        let n = times(0.5, cross(minus(b, a), minus(c, a)));
        let area = norm(n);
        d.vector = plus(d.vector, n);
        d.area += area;
        d.centre = plus(d.centre, times(area / 3.0, plus(a, plus(b, c))));
    }
    d.centre =
        if d.area > 0.0 { times(1.0 / d.area, d.centre) } else { tree.triangle(tree.leaves[l].first)[0] };
    for v in tree.slots_of(l).flat_map(|s| tree.triangle(s)) {
        d.radius = d.radius.max(norm(minus(v, d.centre)));
    }
    d
}
