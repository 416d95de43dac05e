//! The covariance of the noise that explains the sums of the patches best.

use super::moments::{COVARIANCE_BINS, LAG_COUNT, Moments, middle};
use super::terms::{Noise, shared};
use crate::num::special::chi_square_quantile;

/// First reach that is tried, in spacings: within a smaller one no neighbors share anything.
const FIRST_REACH_SPACINGS: f64 = 1.5;
/// Quotient of a reach and the one before it.
const REACH_QUOTIENT: f64 = 1.15;
/// Reaches that are tried.
const REACHES_TRIED: usize = 14;
/// Share of the patches that must be clean: their quantile is compared with that of the noise.
const CLEAN_PATCH_SHARE: f64 = 0.25;
/// Share of patches of nothing but noise that are kept.
const KEPT_PATCH_SHARE: f64 = 0.995;
/// Rounds in which patches are chosen and the covariance is found anew. Most searches end after three.
const MAX_PATCH_ROUNDS: usize = 12;

/// Sum of squares, in standard deviations, by which shared noise must explain the sums better than independent noise does. Its
/// share and reach are two unknowns more. Chance makes as much of these once in a thousand times, as patches lie over each
/// other.
const SHARED_NOISE_GAIN: f64 = 13.8;

/// A covariance: variances, mm², and the reach in spacings.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Model {
    white: f64,
    shared: f64,
    reach: f64,
}

impl Model {
    fn variance(&self) -> f64 {
        self.white + self.shared
    }
    /// The sum of what each bin adds, by its covariance.
    fn sum(&self, bins: &[f64; COVARIANCE_BINS]) -> f64 {
        let of_bin = |(bin, x): (usize, &f64)| x * shared(middle(bin) / self.reach);
        self.white * bins[0] + self.shared * bins.iter().enumerate().map(of_bin).sum::<f64>()
    }
    /// The free points of a patch that tell of its variance as if they were independent.
    fn degrees(&self, patch: &Moments) -> f64 {
        let square = |(bin, pairs): (usize, &f64)| {
            let white = if bin == 0 { self.white } else { 0.0 };
            pairs * (white + self.shared * shared(middle(bin) / self.reach)).powi(2)
        };
        let squares: f64 = patch.pairs.iter().enumerate().map(square).sum();
        // No more than all of them, also where the squares of variances are too small for numbers.
        (patch.free * patch.points * self.variance().powi(2) / squares).min(patch.free)
    }
}

/// The noise of patches, of which there is one at least.
pub(super) fn found(patches: &[Moments]) -> Noise {
    let mut kept = cleaner_half(patches);
    let mut model = explained(patches, &kept);
    for _ in 0..MAX_PATCH_ROUNDS {
        // Data without noise, or with that of rounding alone, leave nothing to choose patches by.
        if model.variance() < f64::MIN_POSITIVE.sqrt() {
            break;
        }
        let next = clean(patches, &model);
        if next == kept || !next.contains(&true) {
            break;
        }
        kept = next;
        model = explained(patches, &kept);
    }
    let of_kept = || patches.iter().zip(&kept).filter(|(_, k)| **k).map(|(p, _)| p);
    let count = of_kept().count();
    let variance = model.variance();
    let sums = of_kept().map(|p| model.sum(&p.about_center)).sum::<f64>() / count as f64;
    let mut spacings: Vec<f64> = of_kept().map(|p| p.spacing).collect();
    spacings.sort_by(f64::total_cmp);
    let spacing = spacings[count / 2];
    let is_shared = model.shared > 0.0;
    Noise {
        deviation: variance.sqrt(),
        white: if is_shared { model.white / variance } else { 1.0 },
        reach: if is_shared { model.reach * spacing } else { 0.0 },
        points_per_independent: if is_shared { (sums / variance).max(1.0) } else { 1.0 },
        spacing,
        patches: count,
        excluded_patches: patches.len() - count,
        unevenness: unevenness(&of_kept().collect::<Vec<_>>(), &model),
    }
}

/// How much the variances of patches differ, in what chance makes: from their first decile to their median, which patches over form do not
/// reach.
fn unevenness(patches: &[&Moments], model: &Model) -> f64 {
    let of_patch = |p: &&Moments| (p.products[0] / model.sum(&p.expected[0]), model.degrees(p));
    let mut all: Vec<(f64, f64)> = patches.iter().map(of_patch).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at = |share: f64| {
        let (ratio, degrees) = all[(share * all.len() as f64) as usize];
        (ratio, chi_square_quantile(share, degrees) / degrees)
    };
    let (low, middle) = (at(0.1), at(0.5));
    let found = libm::log(middle.0 / low.0) / libm::log(middle.1 / low.1);
    if found.is_finite() { found.max(0.0) } else { 0.0 }
}

/// The half of the patches with the lesser variances.
fn cleaner_half(patches: &[Moments]) -> Vec<bool> {
    let variances: Vec<f64> = patches.iter().map(|p| p.products[0] / p.free).collect();
    let mut sorted = variances.clone();
    sorted.sort_by(f64::total_cmp);
    variances.iter().map(|v| *v <= sorted[sorted.len() / 2]).collect()
}

/// The patches whose sums of squares the noise allows. Its size is taken from their lower quartile: the patches over edges and form lie above.
fn clean(patches: &[Moments], model: &Model) -> Vec<bool> {
    let of_patch = |p: &Moments| (p.products[0] / model.sum(&p.expected[0]), model.degrees(p));
    let all: Vec<(f64, f64)> = patches.iter().map(of_patch).collect();
    let mut sorted = all.clone();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (low, degrees) = sorted[(CLEAN_PATCH_SHARE * sorted.len() as f64) as usize];
    let quantile = |share: f64, degrees: f64| chi_square_quantile(share, degrees) / degrees;
    let size = low / quantile(CLEAN_PATCH_SHARE, degrees);
    all.iter().map(|(ratio, degrees)| *ratio <= size * quantile(KEPT_PATCH_SHARE, *degrees)).collect()
}

/// The covariance whose expected sums are nearest to those of the patches kept, each weighed by its scatter from patch to patch.
fn explained(patches: &[Moments], kept: &[bool]) -> Model {
    let kept: Vec<&Moments> = patches.iter().zip(kept).filter(|(_, k)| **k).map(|(p, _)| p).collect();
    let count = kept.len() as f64;
    let mut products = [0.0; LAG_COUNT];
    let mut squares = [0.0; LAG_COUNT];
    let mut expected = [[0.0; COVARIANCE_BINS]; LAG_COUNT];
    for patch in &kept {
        for lag in 0..LAG_COUNT {
            products[lag] += patch.products[lag] / count;
            squares[lag] += patch.products[lag].powi(2) / count;
            let bins = expected[lag].iter_mut().zip(&patch.expected[lag]);
            bins.for_each(|(sum, x)| *sum += x / count);
        }
    }
    let weight = |lag: usize| {
        let scatter = (squares[lag] - products[lag].powi(2)).max(0.0).sqrt();
        if scatter > 0.0 { 1.0 / scatter } else { 0.0 }
    };
    let weights: [f64; LAG_COUNT] = std::array::from_fn(weight);
    let wanted: [f64; LAG_COUNT] = std::array::from_fn(|lag| weights[lag] * products[lag]);
    let of_model = |model: Model| -> [f64; LAG_COUNT] {
        std::array::from_fn(|lag| weights[lag] * model.sum(&expected[lag]))
    };
    let white = of_model(Model { white: 1.0, shared: 0.0, reach: FIRST_REACH_SPACINGS });
    let mut reach = FIRST_REACH_SPACINGS;
    let error = |w: f64, s: f64, together: &[f64; LAG_COUNT]| -> f64 {
        (0..LAG_COUNT).map(|lag| (w * white[lag] + s * together[lag] - wanted[lag]).powi(2)).sum()
    };
    let alone = inner(&white, &wanted) / inner(&white, &white);
    if !(alone.is_finite() && alone > 0.0) {
        // No patch scatters, or all by the same: there is nothing to tell reaches by.
        return Model { white: products[0] / expected[0][0], shared: 0.0, reach };
    }
    // A sum over patches scatters by the root of their number less than that of one.
    let clearly = SHARED_NOISE_GAIN / count;
    let mut best = (error(alone, 0.0, &white) - clearly, Model { white: alone, shared: 0.0, reach });
    for _ in 0..REACHES_TRIED {
        let together = of_model(Model { white: 0.0, shared: 1.0, reach });
        for [w, s] in shares(&white, &together, &wanted) {
            let error = error(w, s, &together);
            if error < best.0 {
                best = (error, Model { white: w, shared: s, reach });
            }
        }
        reach *= REACH_QUOTIENT;
    }
    best.1
}

/// The shares of two lists that make a third one best, none below 0: both, or one alone.
fn shares(one: &[f64; LAG_COUNT], other: &[f64; LAG_COUNT], wanted: &[f64; LAG_COUNT]) -> Vec<[f64; 2]> {
    let [aa, ab, bb] = [inner(one, one), inner(one, other), inner(other, other)];
    let [aw, bw] = [inner(one, wanted), inner(other, wanted)];
    let determinant = aa * bb - ab * ab;
    let both = [(aw * bb - bw * ab) / determinant, (bw * aa - aw * ab) / determinant];
    let all = [both, [aw / aa, 0.0], [0.0, bw / bb]];
    all.into_iter().filter(|pair| pair.iter().all(|x| x.is_finite() && *x >= 0.0)).collect()
}

fn inner(a: &[f64; LAG_COUNT], b: &[f64; LAG_COUNT]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
