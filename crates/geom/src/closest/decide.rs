//! Last stage: the few triangles left of each point, in double precision.
#![expect(unsafe_code, reason = "loads of vector types need their instructions")]

use crate::closest::block::PointBlock;
use crate::closest::hit::Hit;
use crate::closest::thin;
use crate::closest::tree::Tree;
use crate::closest::triangle;
use crate::memory::prefetch;
use crate::simd::lanes::Real;

/// A triangle that single precision cannot exclude.
#[derive(Clone, Copy)]
pub struct Undecided {
    /// Number of the point in the block.
    pub point: u32,
    /// Slot of the triangle.
    pub slot: u32,
}

/// Computes the distances in double precision; the least wins, then the lowest face.
///
/// # Safety
/// The processor has the instructions of `D`.
#[inline(always)]
pub unsafe fn decide<D: Real>(tree: &Tree, b: &PointBlock, undecided: &[Undecided], hits: &mut [Hit]) {
    // The corners lie scattered in memory: ask for all of them before the first is needed.
    for &Undecided { slot, .. } in undecided {
        for v in tree.slots[slot as usize] {
            prefetch(&tree.corners[v as usize]);
        }
    }
    let mut soa = [[0f64; 8]; 12];
    for part in undecided.chunks(D::LANES) {
        for (j, &Undecided { point: i, slot }) in part.iter().enumerate() {
            let (p, t) = (b.points[i as usize], tree.triangle(slot));
            for k in 0..3 {
                soa[k][j & 7] = p[k];
                for v in 0..3 {
                    soa[3 + 3 * v + k][j & 7] = t[v][k];
                }
            }
        }
        // SAFETY: the caller's promise.
        let v = unsafe { load_all::<D>(&soa) };
        let corners = [[v[3], v[4], v[5]], [v[6], v[7], v[8]], [v[9], v[10], v[11]]];
        // SAFETY: the caller's promise.
        let (d, height, is_thin) = unsafe { triangle::squared([v[0], v[1], v[2]], corners) };
        let (mut distances, mut heights, mut slow) = ([0f64; 8], [0f64; 8], [0f64; 8]);
        d.store(&mut distances);
        height.store(&mut heights);
        is_thin.store(&mut slow);
        for (j, &Undecided { point: i, slot }) in part.iter().enumerate().filter(|(j, _)| slow[j & 7] != 0.0)
        {
            let (p, rim) = (&b.points[i as usize], distances[j & 7]);
            (distances[j & 7], heights[j & 7]) = thin::squared(p, &tree.triangle(slot), rim);
        }
        for ((&distance_squared, &height), &Undecided { point: i, slot }) in
            distances.iter().zip(&heights).zip(part)
        {
            let h = &mut hits[i as usize];
            if distance_squared <= h.distance_squared {
                let face = tree.face[slot as usize];
                if distance_squared < h.distance_squared || face < h.face {
                    *h = Hit { distance_squared, face, slot, height };
                }
            }
        }
    }
}

/// All rows as vectors.
#[inline(always)]
unsafe fn load_all<D: Real>(rows: &[[f64; 8]; 12]) -> [D; 12] {
    // SAFETY: the caller's promise.
    unsafe {
        let mut out = [D::load(&rows[0]); 12];
        for (v, row) in out.iter_mut().zip(rows) {
            *v = D::load(row);
        }
        out
    }
}
