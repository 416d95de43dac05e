//! Inside or outside a mesh with holes, by the generalized winding number.
//!
//! The winding number of a point is the sum of the signed solid angles of all triangles over 4π. It is 1 inside and 0 outside a
//! closed mesh, and blends smoothly near the holes of an open one (Jacobson, Kavan & Sorkine-Hornung 2013). Far from a group of
//! triangles the sum is nearly that of one dipole at their center. So it is gathered along the search tree, and a group is
//! opened only for points within some times its radius. (Barill, Dickson, Schmidt, Levin & Jacobson, "Fast winding numbers for
//! soups and clouds", 2018.) Here the dipole has the first-order term only, and a wider opening makes up for it. Who only asks
//! for the side is answered from few groups where that is clear. Sixteen neighboring points walk together (module
//! `solid_angle`), each with its own decisions.
#![expect(
    unsafe_code,
    reason = "choosing the instruction set at run time; answers written to places of their own"
)]

use crate::closest::block::POINTS_PER_BLOCK;
use crate::closest::limits::QueryError;
use crate::closest::order;
use crate::closest::solid_angle::{self, Group, Stack};
use crate::closest::tree::Tree;
use crate::memory::{Shared, large_pages};
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::simd::Level;
use crate::simd::lanes::Plain;
use crate::space::{Point, Vector, cross, minus, norm, plus, times};

/// Where the number is wanted, a group is taken as a dipole from so many radii on.
const NUMBER_DIPOLE_RADII: f32 = 3.0;
/// Where the side is wanted, first from so many radii on: that costs a third.
const ROUGH_DIPOLE_RADII: f32 = 1.5;
/// Where the rough number is not [`MIN_CLEAR_SIDE`] from the limit, from so many.
const FINE_DIPOLE_RADII: f32 = 6.0;
/// A rough number tells the side if it is this far from the limit: twice the greatest error found.
const MIN_CLEAR_SIDE: f64 = 0.3;

/// The dipole of a group of triangles.
#[derive(Clone, Copy, Default)]
struct Dipole {
    /// Area vector: sum of normals times areas.
    vector: Vector,
    center: Point,
    area: f64,
    /// Radius of a sphere about the center that holds the triangles.
    radius: f64,
}

/// A tree with the dipoles of its groups: ready for winding numbers. 11 bytes a face.
pub struct Winding {
    pub(super) tree: Tree,
    pub(super) groups: Vec<Group>,
}

impl Winding {
    /// One pass over the triangles and nodes.
    pub fn new(tree: &Tree) -> Self {
        let leaves = tree.leaves.len();
        let of_leaf: Vec<Dipole> = (0..leaves).into_par_iter().map(|l| leaf_dipole(tree, l)).collect();
        let mut of_node = vec![Dipole::default(); tree.nodes.len()];
        let mut groups = vec![Group::EMPTY; tree.nodes.len()];
        // A child's index is above its parent's.
        for n in (0..tree.nodes.len()).rev() {
            let node = &tree.nodes[n];
            let mut children = [Dipole::default(); 8];
            let mut count = 0;
            for (&c, _) in node.child.iter().zip(&node.bounds[0]).filter(|(_, low)| **low < f32::INFINITY) {
                children[count] = if c < 0 { of_leaf[!c as usize] } else { of_node[c as usize] };
                count += 1;
            }
            for (j, d) in children[..count].iter().enumerate() {
                let center = times(tree.scale, minus(d.center, tree.center));
                let vector = times(tree.scale * tree.scale, d.vector);
                groups[n].set(j, center, vector, d.radius * tree.scale);
            }
            of_node[n] = join(&children[..count]);
        }
        Winding { tree: tree.clone(), groups }
    }

    /// Winding number of each point, in the order of `points`. It depends on nothing but mesh and point; the last digits
    /// also on the instructions that the processor has.
    ///
    /// Where the mesh covers itself once, it differs from the exact sum by at most 0.05, and by less than 0.004 in the mean.
    /// Each further layer adds as much (found by test, not proved). A point nearer to the surface than a millionth of the size
    /// of the faces there may be taken to the other side. A point on it has some finite number. Runs on the current rayon pool
    /// and tells `progress` of points answered. Cost: 0.3 to 1.5 µs a point and core.
    ///
    /// # Errors
    /// [`QueryError::BadPoint`], [`QueryError::Cancelled`].
    pub fn numbers(&self, points: &[Point], progress: &dyn Progress) -> Result<Vec<f64>, QueryError> {
        self.map(points, progress, |block, who, stack| {
            self.block(Level::detect(), block, who, NUMBER_DIPOLE_RADII, stack)
        })
    }

    /// Whether the winding number of each point is above `limit`, in the order of `points`: above one half is inside.
    ///
    /// Three times as fast as [`Winding::numbers`], and nearer the truth where it matters. A number that is not clearly above
    /// or below is found again with an error of at most 0.01. Each further layer adds as much (found by test, not proved).
    ///
    /// # Errors
    /// The errors of [`Winding::numbers`].
    pub fn above(
        &self,
        limit: f64,
        points: &[Point],
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, QueryError> {
        let level = Level::detect();
        self.map(points, progress, |block, who, stack| {
            let mut numbers = self.block(level, block, who, ROUGH_DIPOLE_RADII, stack);
            let unclear = (0..POINTS_PER_BLOCK)
                .filter(|&i| (numbers[i] - limit).abs() < MIN_CLEAR_SIDE)
                .fold(0, |u, i| u | 1 << i)
                & who;
            if unclear != 0 {
                let fine = self.block(level, block, unclear, FINE_DIPOLE_RADII, stack);
                (0..POINTS_PER_BLOCK).filter(|i| unclear >> i & 1 != 0).for_each(|i| numbers[i] = fine[i]);
            }
            numbers.map(|w| w > limit)
        })
    }

    /// The value of `f` for each point, in their order. It is given sixteen neighbors at a time, and which of them count.
    fn map<T: Send>(
        &self,
        points: &[Point],
        progress: &dyn Progress,
        f: impl Fn(&[Point; POINTS_PER_BLOCK], u32, &mut Stack) -> [T; POINTS_PER_BLOCK] + Sync,
    ) -> Result<Vec<T>, QueryError> {
        let mut out = large_pages(Vec::with_capacity(points.len()));
        let places = Shared::of(&mut out);
        order::for_each_bucket(points, progress, |stack, slice, base, items| {
            for part in items.chunks(POINTS_PER_BLOCK) {
                let mut block = [[0.0; 3]; POINTS_PER_BLOCK];
                for (p, &i) in block.iter_mut().zip(part) {
                    *p = slice[i as u32 as usize];
                }
                for (&i, x) in part.iter().zip(f(&block, (1 << part.len()) - 1, stack)) {
                    // SAFETY: there is room for all, and each index comes exactly once.
                    unsafe { *places.at(base + i as u32 as usize) = x }
                }
            }
        })?;
        // SAFETY: no error: every index has come.
        unsafe { out.set_len(points.len()) };
        Ok(out)
    }

    /// Winding numbers of those of `points` whose bits are set in `who`, a group being a dipole from `opening` radii on.
    pub(super) fn block(
        &self,
        level: Level,
        points: &[Point; POINTS_PER_BLOCK],
        who: u32,
        opening: f32,
        stack: &mut Stack,
    ) -> [f64; POINTS_PER_BLOCK] {
        #[cfg(target_arch = "x86_64")]
        {
            use crate::simd::lanes_x86::{A16, Z16};
            #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
            fn avx2(
                w: &Winding,
                p: &[Point; POINTS_PER_BLOCK],
                who: u32,
                opening: f32,
                s: &mut Stack,
            ) -> [f64; POINTS_PER_BLOCK] {
                // SAFETY: the features above are those of the type.
                unsafe { solid_angle::numbers::<A16>(&w.tree, &w.groups, p, who, opening, s) }
            }
            #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
            fn avx512(
                w: &Winding,
                p: &[Point; POINTS_PER_BLOCK],
                who: u32,
                opening: f32,
                s: &mut Stack,
            ) -> [f64; POINTS_PER_BLOCK] {
                // SAFETY: the features above are those of the type.
                unsafe { solid_angle::numbers::<Z16>(&w.tree, &w.groups, p, who, opening, s) }
            }
            // No more than there is, whatever is asked for.
            match level.min(Level::detect()) {
                // SAFETY: `Level::detect` found these features.
                Level::Avx512 => return unsafe { avx512(self, points, who, opening, stack) },
                // SAFETY: `Level::detect` found these features.
                Level::Avx2 => return unsafe { avx2(self, points, who, opening, stack) },
                Level::Plain => {}
            }
        }
        let _ = level; // other processors have one way only
        // SAFETY: plain Rust needs no special instructions.
        unsafe { solid_angle::numbers::<Plain<16>>(&self.tree, &self.groups, points, who, opening, stack) }
    }
}

/// The dipole of several together.
fn join(parts: &[Dipole]) -> Dipole {
    let area = parts.iter().map(|d| d.area).sum::<f64>();
    let weight = |d: &Dipole| if area > 0.0 { d.area / area } else { 1.0 / parts.len() as f64 };
    let center = parts.iter().fold([0.0; 3], |c, d| plus(c, times(weight(d), d.center)));
    let vector = parts.iter().fold([0.0; 3], |v, d| plus(v, d.vector));
    let radius = parts.iter().map(|d| norm(minus(d.center, center)) + d.radius).fold(0.0, f64::max);
    Dipole { vector, center, area, radius }
}

fn leaf_dipole(tree: &Tree, l: usize) -> Dipole {
    let triangle = |s: u32| {
        let [a, b, c] = tree.triangle(s);
        let vector = times(0.5, cross(minus(b, a), minus(c, a)));
        Dipole { vector, center: times(1.0 / 3.0, plus(a, plus(b, c))), area: norm(vector), radius: 0.0 }
    };
    let mut parts = [Dipole::default(); 8];
    let mut count = 0;
    for s in tree.slots_of(l) {
        parts[count] = triangle(s);
        count += 1;
    }
    let mut d = join(&parts[..count]);
    for v in tree.slots_of(l).flat_map(|s| tree.triangle(s)) {
        d.radius = d.radius.max(norm(minus(v, d.center)));
    }
    d
}
