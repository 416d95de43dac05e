//! The noise of a scan, found without a nominal: its standard deviation, how far neighbors share it, and how many points count as one.
//!
//! Scanners and the programs behind them write smoothed data. The errors of neighboring points are alike, so `n` points tell as
//! much as `n / τ` independent ones. Both are found together. Around places of the surface a polynomial is fitted to a patch of
//! neighbors. The products of its residuals are summed by the distance of the two points. A fit takes a part of the noise with
//! it, and of shared noise the greater part, so the sums are not the covariances. But their expectations are linear in the
//! covariances: `E[rᵀBr] = tr(P B P C)` with the projection `P` of the residuals. (The principle of MINQUE: C. R. Rao, Journal
//! of the American Statistical Association 67 (1972) 112–115.) The covariance that explains the sums best is found among those
//! of the form
//!
//! `C(d) = white [d = 0] + shared φ(d / reach)`, `φ(t) = (1 − t)⁴ (4 t + 1)`
//!
//! with Wendland's compact function `φ` (Advances in Computational Mathematics 4 (1995) 389–396), which is positive definite in
//! space. Some patches lie over edges, or over form that bends faster than a polynomial of degree four follows. They have
//! greater sums than the noise allows. The distribution of sums of squares of the noise found leaves them out.
//!
//! | file | what |
//! |---|---|
//! | `patch` | neighbors along a mesh, or in a cloud |
//! | `moments` | sums of products of a patch, and what they are expected to be |
//! | `covariance` | the covariance that explains the sums |
//! | `terms` | what is told, or why nothing |

mod covariance;
mod moments;
mod patch;
mod terms;
#[cfg(test)]
mod tests;

use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::scan::Scan;
use crate::space::Point;
use moments::Moments;
use patch::{Around, InCloud, OnMesh};
pub use terms::{NoNoise, Noise};

/// Most patches looked at: `progress` counts them.
pub const MAX_PATCHES: usize = 160;
/// Patches that hold a point, on average, where there are few.
const PATCHES_PER_POINT: usize = 2;
/// Points of a patch. The radius of the first size is eight spacings: noise that neighbors of three rings share reaches over
/// six. Smaller patches serve parts whose faces hold few of these, or where the large ones show form. They tell the noise, and
/// underestimate its reach.
const POINTS_PER_PATCH: [usize; 2] = [200, 80];
/// Unevenness up to which smaller patches tell noise: 1.1 on parts, 2.4 and more on free forms.
const MAX_SMALL_UNEVENNESS: f64 = 1.8;
/// Share of the distance between neighbors from which on noise may be form everywhere alike, such as narrow ribs.
const FORM_LIKE_NOISE_SHARE: f64 = 0.1;
/// Share of the noise of larger patches up to which that of smaller ones counts instead: noise is no less in smaller patches.
const MAX_NARROW_NOISE_SHARE: f64 = 0.7;
/// Least patches that tell the noise. The standard deviation of eight is known to a tenth, with shared noise to a fifth.
const MIN_PATCHES: usize = 8;

/// The noise of the `V` vertices of a mesh, millimeters. Neighbors are found through edges: weld first what is not welded. Vertices that no
/// facet uses are no neighbors of any.
///
/// On a mesh that is drawn, not measured, patches reach over edges. Then the result is how far the part departs from smooth
/// surfaces at the spacing of its vertices. Deterministic for any number of threads. Cost: a pass over the facets, and the
/// patches, whose number does not grow with the mesh. `progress` counts patches.
/// ```
/// use trueness_geom::{mesh::Mesh, noise, num::random::Random, progress::Silent};
/// // A plane of 61 × 61 vertices with independent noise, evenly within ±0.01 × √3.
/// let mut random = Random::new(1);
/// let place = |i: u32| [f64::from(i % 61), f64::from(i / 61), 0.01 * 12f64.sqrt() * (random.unit() - 0.5)];
/// let positions = (0..3721).map(place).collect();
/// let faces = (0..3600u32).flat_map(|k| {
///     let a = k / 60 * 61 + k % 60;
///     [[a, a + 1, a + 62], [a, a + 62, a + 61]]
/// });
/// let found = noise::mesh(&Mesh { positions, faces: faces.collect() }, 0, &Silent).unwrap();
/// assert!((found.deviation / 0.01 - 1.0).abs() < 0.05);
/// assert!(found.points_per_independent < 1.5);
/// ```
///
/// # Errors
/// [`NoNoise`]: too few vertices that hang together, a coordinate that is no number, a facet that names no vertex, cancelled.
pub fn mesh(mesh: &Mesh, seed: u64, progress: &dyn Progress) -> Result<Noise, NoNoise> {
    noise_of((&mesh.positions, Some(mesh)), None, seed, progress)
}

/// The noise of `N` points, millimeters. Neighbors are the nearest ones. As [`mesh()`] otherwise.
///
/// # Errors
/// As [`mesh()`].
pub fn cloud(points: &[Point], seed: u64, progress: &dyn Progress) -> Result<Noise, NoNoise> {
    noise_of((points, None), None, seed, progress)
}

/// The noise of a mesh or a cloud. As [`mesh()`] otherwise.
///
/// # Errors
/// As [`mesh()`].
pub fn scan(scan: &Scan, seed: u64, progress: &dyn Progress) -> Result<Noise, NoNoise> {
    noise_of((scan.points(), scan.mesh()), None, seed, progress)
}

/// The noise of the `V` vertices of a mesh or points of a cloud, whose distances from surfaces fitted to them are known. Form is told
/// from noise with less doubt, and also where the surface bends much from one point to the next. Points without a distance that is a
/// number do not count. As [`mesh()`] otherwise.
///
/// # Errors
/// As [`mesh()`].
pub fn about(scan: &Scan, distances: &[f64], seed: u64, progress: &dyn Progress) -> Result<Noise, NoNoise> {
    noise_of((scan.points(), scan.mesh()), Some(distances), seed, progress)
}

fn noise_of(
    (points, mesh): (&[Point], Option<&Mesh>),
    distances: Option<&[f64]>,
    seed: u64,
    progress: &dyn Progress,
) -> Result<Noise, NoNoise> {
    if let Some(index) = points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        return Err(NoNoise::NotFinite { index });
    }
    let counts = |i: u32| distances.is_none_or(|all| all.get(i as usize).is_some_and(|d| d.is_finite()));
    let counted: Vec<u32> = (0..points.len() as u32).filter(|i| counts(*i)).collect();
    let around: Box<dyn Around> = match mesh {
        None => Box::new(InCloud { points, counted: &counted }),
        Some(mesh) => Box::new(OnMesh::new(mesh, counts)?),
    };
    let all = Places { points, counted: &counted, around: &*around, distances };
    let wide = all.noise_of_patches(POINTS_PER_PATCH[0], seed, progress);
    let looks_like_noise = |n: &Noise| n.even().is_ok() && n.deviation <= FORM_LIKE_NOISE_SHARE * n.spacing;
    if matches!(wide, Err(NoNoise::Cancelled(_))) || wide.as_ref().is_ok_and(looks_like_noise) {
        return wide;
    }
    let great = wide.as_ref().map_or(f64::INFINITY, |n| n.deviation);
    match all.noise_of_patches(POINTS_PER_PATCH[1], seed, progress) {
        Err(NoNoise::Cancelled(e)) => Err(e.into()),
        Ok(narrow)
            if narrow.unevenness <= MAX_SMALL_UNEVENNESS
                && narrow.deviation <= MAX_NARROW_NOISE_SHARE * great =>
        {
            Ok(narrow)
        }
        _ => wide,
    }
}

/// Points whose noise is looked for: all, the numbers of those that count, their neighbors and distances.
struct Places<'a> {
    points: &'a [Point],
    counted: &'a [u32],
    around: &'a dyn Around,
    distances: Option<&'a [f64]>,
}

impl Places<'_> {
    /// The noise that patches of so many points tell.
    fn noise_of_patches(&self, size: usize, seed: u64, progress: &dyn Progress) -> Result<Noise, NoNoise> {
        let Places { points, counted, around, distances } = self;
        let count = MAX_PATCHES.min(PATCHES_PER_POINT * counted.len() / size);
        let centers = Random::new(seed).choose(count, counted.len());
        let patches: Vec<Option<Moments>> = (centers.par_iter())
            .map(|&center| {
                if progress.cancelled() {
                    return None;
                }
                let patch = around.patch(counted[center], size);
                let places: Vec<Point> = patch.iter().map(|i| points[*i as usize]).collect();
                let heights =
                    distances.map(|all| patch.iter().map(|i| all[*i as usize]).collect::<Vec<f64>>());
                // The smaller patches of those that are looked at again are no more of what is to be done.
                if size == POINTS_PER_PATCH[0] {
                    progress.advance(1);
                }
                Moments::of(&places, heights.as_deref(), size)
            })
            .collect();
        if progress.cancelled() {
            return Err(Cancelled.into());
        }
        let patches: Vec<Moments> = patches.into_iter().flatten().collect();
        if patches.len() < MIN_PATCHES {
            return Err(NoNoise::FewPatches { found: patches.len(), needed: size, least: MIN_PATCHES });
        }
        Ok(covariance::found(&patches))
    }
}
