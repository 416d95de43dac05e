//! Orders of triangles: along a curve through space, and so that few vertices are in use at a time.

use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::Aabb;

/// Triangles ordered in one go.
const TRIANGLES_PER_SORT: usize = 60_000;
/// Cells along each side of the curve.
const CURVE_CELLS: f32 = 65_536.0;

/// A Morton curve through a box.
pub struct Curve {
    scale: f32,
}

impl Curve {
    /// Over a box whose lower corner is the origin.
    pub fn over(bounds: &Aabb) -> Curve {
        let longest = if bounds.is_empty() { 0.0 } else { bounds.sides().into_iter().fold(0.0, f64::max) };
        // Twice the box, so that a shifted curve covers it, too.
        Curve { scale: if longest > 0.0 { 0.5 * CURVE_CELLS / longest as f32 } else { 0.0 } }
    }

    /// The triangles along the curve by their first corner's place; with another `shift` neighboring pieces meet elsewhere.
    pub fn sorted(&self, corners: &[u32], place: impl Fn(u32) -> [f32; 3] + Sync, shift: usize) -> Vec<u32> {
        let shift = shift as f32 * CURVE_CELLS * 0.117;
        let mut keys: Vec<(u64, u32)> = (0..corners.len() as u32 / 3)
            .into_par_iter()
            .map(|t| {
                let q = place(corners[3 * t as usize]);
                let cell = q.map(|x| (x * self.scale + shift).clamp(0.0, CURVE_CELLS - 1.0) as u16);
                (super::points::morton(&cell), t)
            })
            .collect();
        keys.par_sort_unstable();
        keys.par_iter().flat_map_iter(|(_, t)| (0..3).map(move |k| corners[3 * *t as usize + k])).collect()
    }
}

/// The triangles in an order that uses few vertices at a time, piece by piece as they come.
pub fn for_cache(corners: &[u32], progress: &dyn Progress) -> Result<Vec<u32>, Cancelled> {
    let pieces: Vec<Vec<u32>> = corners
        .par_chunks(3 * TRIANGLES_PER_SORT)
        .map(|piece| match progress.cancelled() {
            true => Err(Cancelled),
            false => Ok(piece_for_cache(piece)),
        })
        .collect::<Result<_, _>>()?;
    Ok(pieces.concat())
}

fn piece_for_cache(corners: &[u32]) -> Vec<u32> {
    let mut own = corners.to_vec();
    own.sort_unstable();
    own.dedup();
    let number = |v: &u32| own.binary_search(v).unwrap_or(0) as u32;
    let local: Vec<u32> = corners.iter().map(number).collect();
    meshopt::optimize_vertex_cache(&local, own.len()).into_iter().map(|v| own[v as usize]).collect()
}
