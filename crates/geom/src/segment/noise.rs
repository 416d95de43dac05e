//! How noisy is it? Residuals of small patches about the best simple surface through each.

use super::estimate::{KINDS, estimate};
use super::flood::{Marks, patch};
use super::pieces::PieceGraph;
use super::probe::Probe;
use crate::fit::improved;
use crate::num::random::Random;
use crate::parallel::prelude::*;
use crate::shape::{Kind, Shape};
use crate::space::{Point, single_step};

/// Patches looked at.
const NOISE_PATCHES: u64 = 400;
/// Pieces of a patch. Noise that hangs together over a distance shows in large patches only; but those may lie on no
/// simple surface at all.
const PIECES_PER_NOISE_PATCH: [usize; 2] = [24, 96];
/// How much more noise large patches may show than small ones, and still be believed.
const MAX_BELIEVED_RATIO: f64 = 3.0;
/// Noise of a drawn surface that may be the digits of its file, in steps of single precision.
const MAX_DIGIT_STEPS: f64 = 32.0;
/// The standard deviation over the lower quartile of those found in patches, for normal noise.
const SIGMA_OVER_QUARTILE: f64 = 1.15;

/// The noise that one piece tells by itself, and how well.
#[derive(Clone, Copy, Debug)]
pub(super) struct Noise {
    /// Standard deviation of the measured points across the surface, millimeters.
    pub distance: f64,
    /// Typical angle between the normal of a piece and that of the surface, radians.
    pub angle: f64,
}

/// The noise of a surface with at least one piece. `pick` draws a piece from a random number generator.
pub(super) fn noise(
    surface: &PieceGraph,
    crease: f64,
    seed: u64,
    pick: impl Fn(&mut Random) -> u32 + Sync,
) -> Noise {
    let [small, large] = PIECES_PER_NOISE_PATCH.map(|size| of_patches(surface, size, crease, seed, &pick));
    if surface.is_drawn && small.distance > MAX_DIGIT_STEPS * single_step(surface.points) {
        // Facets are as long as faces: patches went beyond them.
        return Noise { distance: 0.0, ..small };
    }
    let believed = large.distance <= MAX_BELIEVED_RATIO * small.distance;
    Noise { distance: if believed { large.distance.max(small.distance) } else { small.distance }, ..small }
}

/// The noise that patches of one size tell.
fn of_patches(
    surface: &PieceGraph,
    size: usize,
    crease: f64,
    seed: u64,
    pick: &(impl Fn(&mut Random) -> u32 + Sync),
) -> Noise {
    let found: Vec<Option<(f64, f64)>> = (0..NOISE_PATCHES)
        .into_par_iter()
        .map_init(
            || Marks::new(surface),
            |marks, k| {
                let piece = pick(&mut Random::stream(seed, k));
                best(surface, &patch(surface, piece, size, crease, marks, |_| true))
            },
        )
        .collect();
    let mut found: Vec<(f64, f64)> = found.into_iter().flatten().collect();
    // The median of the clean half: a quarter of all.
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.truncate(found.len().div_ceil(2));
    let distance = found.get(found.len() / 2).map_or(0.0, |f| f.0);
    found.sort_by(|a, b| a.1.total_cmp(&b.1));
    let angle = found.get(found.len() / 2).map_or(0.0, |f| f.1);
    Noise { distance: SIGMA_OVER_QUARTILE * distance, angle }
}

/// Root mean square distance of the points from the best simple surface through the patch, with the unknowns taken into
/// account. Also the median angle of the pieces to it.
fn best(surface: &PieceGraph, pieces: &[u32]) -> Option<(f64, f64)> {
    let points = surface.sampled_places(pieces, usize::MAX);
    let oriented: Vec<_> =
        pieces.iter().map(|&p| (surface.places[p as usize], surface.normals[p as usize])).collect();
    let fits = KINDS.into_iter().filter_map(|kind| {
        let left = points.len().checked_sub(kind.unknowns()).filter(|&left| left > 0)?;
        if kind != Kind::Plane && left < kind.unknowns() {
            return None;
        }
        let (shape, rms) = improved(&points, &estimate(kind, &oriented)?)?;
        Some((shape, rms * (points.len() as f64 / left as f64).sqrt()))
    });
    let (shape, rms) = fits.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((rms, middle_angle(&shape, &oriented)))
}

fn middle_angle(shape: &Shape, oriented: &[(Point, [f64; 3])]) -> f64 {
    let element = Probe::new(shape);
    let mut angles: Vec<f64> =
        oriented.iter().map(|&(p, n)| libm::acos(element.cosine(p, n).min(1.0))).collect();
    angles.sort_by(f64::total_cmp);
    angles.get(angles.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::super::{facets, seeds::Seeds, tests::parts::bored};
    use super::*;

    /// The clean part tells, even if it is the smaller one.
    #[test]
    fn the_noise_is_that_of_the_cleaner_part() {
        let fine = bored(128).noisy(0.01, 1);
        let rough = bored(128).noisy(0.1, 2);
        let mut mesh = fine.mesh;
        for (p, q) in mesh.positions.iter_mut().zip(&rough.mesh.positions).filter(|(p, _)| p[0] > -4.0) {
            *p = *q;
        }
        let surface = facets::surface(&mesh);
        let seeds = Seeds::new(&surface, |_| true);
        let found = noise(&surface, 32f64.to_radians().cos(), 0, |random| seeds.draw(random));
        assert!((0.006..0.016).contains(&found.distance), "{found:?}");
    }
}
