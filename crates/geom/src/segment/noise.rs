//! How noisy is it? Residuals of small patches about the best simple surface through each.

use super::estimate::estimate;
use super::flood::{Marks, patch};
use super::grow::refined;
use super::surface::{NONE, Surface, normal};
use crate::fit::{Kind, Shape};
use crate::num::random::Random;
use crate::space::{Point, dot};
use rayon::prelude::*;

/// Patches looked at.
const PATCHES: u64 = 400;
/// Pieces of a patch.
const SIZE: usize = 24;
/// The share of patches taken for clean: the others may lie on edges or on what is no simple surface.
const CLEAN: f64 = 0.25;
/// The standard deviation over that quantile, for normal noise in patches of this size.
const QUANTILE: f64 = 1.15;

/// What one piece tells by itself, and how well.
#[derive(Clone, Copy, Debug)]
pub(super) struct Noise {
    /// Standard deviation of the measured points across the surface, millimetres.
    pub distance: f64,
    /// Typical angle between the normal of a piece and that of the surface, radians.
    pub angle: f64,
}

/// The noise of a surface with at least one piece. `pick` draws a piece from a random number generator.
pub(super) fn noise(
    surface: &Surface,
    crease: f64,
    seed: u64,
    pick: impl Fn(&mut Random) -> u32 + Sync,
) -> Noise {
    let mut found: Vec<(f64, f64)> = (0..PATCHES)
        .into_par_iter()
        .map_init(
            || Marks::new(surface),
            |marks, k| {
                let piece = pick(&mut Random::stream(seed, k));
                (piece != NONE).then(|| {
                    let pieces = patch(surface, piece, SIZE, crease, marks, |_| true);
                    best(surface, &pieces)
                })?
            },
        )
        .flatten()
        .collect();
    let quantile = |all: &mut [f64]| {
        all.sort_by(f64::total_cmp);
        all.get((CLEAN * all.len() as f64) as usize).copied().unwrap_or(0.0)
    };
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.truncate(found.len().div_ceil(2));
    let distance = {
        // A quarter of all is half of the better half.
        let index = found.len() / 2;
        found.get(index).map_or(0.0, |f| f.0)
    };
    let angle = quantile(&mut found.iter().map(|f| f.1).collect::<Vec<f64>>());
    Noise { distance: QUANTILE * distance, angle }
}

/// Root mean square distance of the points from the best simple surface through the patch, with the unknowns taken
/// into account, and the median angle of the pieces to it.
fn best(surface: &Surface, pieces: &[u32]) -> Option<(f64, f64)> {
    let points = surface.some_places(pieces, usize::MAX);
    let oriented: Vec<_> =
        pieces.iter().map(|&p| (surface.places[p as usize], surface.normals[p as usize])).collect();
    let kinds = [Kind::Plane, Kind::Cylinder, Kind::Sphere, Kind::Cone, Kind::Torus];
    let fits = kinds.into_iter().filter_map(|kind| {
        let left = points.len().checked_sub(kind.unknowns()).filter(|&left| left > 0)?;
        if kind != Kind::Plane && left < kind.unknowns() {
            return None;
        }
        let (shape, rms) = refined(kind, &estimate(kind, &oriented)?, &points)?;
        Some((shape, rms * (points.len() as f64 / left as f64).sqrt()))
    });
    let (shape, rms) = fits.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((rms, middle_angle(&shape, &oriented)))
}

fn middle_angle(shape: &Shape, oriented: &[(Point, [f64; 3])]) -> f64 {
    let mut angles: Vec<f64> =
        oriented.iter().map(|&(p, n)| dot(n, normal(shape, p)).abs().min(1.0).acos()).collect();
    angles.sort_by(f64::total_cmp);
    angles.get(angles.len() / 2).copied().unwrap_or(0.0)
}
