//! The direction in which a surface bends most: knot lines across it need to be close, those along it need not.

use super::SurfaceFit;
use std::f64::consts::FRAC_PI_2;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::dot;
use trueness_geom::spline::surface::Patches;

/// Directions no farther than this from the main one, in radians, count as it.
const NEAR_MAIN_ANGLE: f64 = 0.12;
/// A surface has a grain where they have this share of all bending: by chance it is `2 NEAR_MAIN_ANGLE / (π / 2)`, 0.15.
const MIN_GRAIN_SHARE: f64 = 0.3;
/// Directions that are tried as the main one.
const DIRECTIONS_TRIED: usize = 180;
/// Times that the main one is moved to the mean of those near it.
const MEAN_DIRECTION_STEPS: usize = 20;

/// The direction of the parameters in which most of the surface bends, if that is much of it.
///
/// Each point counts as much as the surface there bends more along one direction than across it. A place that bends
/// alike both ways does not count. Directions at right angles are one, as they take the same knot lines. The main one
/// is where they lie closest, so that others do not draw it aside, as they would a mean of all.
pub(super) fn grain(found: &SurfaceFit) -> Option<[f64; 2]> {
    let patches = Patches::new(&found.surface);
    let seen: Vec<(f64, f64)> = found.feet.par_iter().map(|f| bent(&patches, *f)).collect();
    let sum_of = |f: &dyn Fn(f64) -> f64| seen.iter().map(|(angle, by)| by * f(*angle)).sum::<f64>();
    let total = sum_of(&|_| 1.0);
    if !(total > 0.0 && total.is_finite()) {
        return None;
    }
    let mut bins = vec![0.0; DIRECTIONS_TRIED];
    for (angle, by) in &seen {
        bins[((angle / FRAC_PI_2 * DIRECTIONS_TRIED as f64) as usize).min(DIRECTIONS_TRIED - 1)] += by;
    }
    let wide = (NEAR_MAIN_ANGLE / FRAC_PI_2 * DIRECTIONS_TRIED as f64) as usize;
    let around = |k: usize| {
        (0..=2 * wide).map(|n| bins[(k + DIRECTIONS_TRIED + n - wide) % DIRECTIONS_TRIED]).sum::<f64>()
    };
    let first = (0..DIRECTIONS_TRIED).max_by(|a, b| around(*a).total_cmp(&around(*b)).then(b.cmp(a)))?;
    let mut main = (first as f64 + 0.5) * FRAC_PI_2 / DIRECTIONS_TRIED as f64;
    for _ in 0..MEAN_DIRECTION_STEPS {
        let near =
            |angle: f64| 1.0 - (off(angle, main) / NEAR_MAIN_ANGLE) * (off(angle, main) / NEAR_MAIN_ANGLE);
        let count = sum_of(&|angle| near(angle).max(0.0));
        let step = sum_of(&|angle| near(angle).max(0.0) * off(angle, main)) / count;
        if !step.is_finite() {
            return None;
        }
        main += step;
        if step.abs() < 1e-5 {
            break;
        }
    }
    let share = sum_of(&|angle| f64::from(off(angle, main).abs() <= NEAR_MAIN_ANGLE)) / total;
    (share > MIN_GRAIN_SHARE).then(|| [libm::cos(main), libm::sin(main)])
}

/// The difference of two directions of a net, from −π/4 to π/4.
fn off(a: f64, b: f64) -> f64 {
    let turns = (a - b) / FRAC_PI_2;
    (turns - turns.round()) * FRAC_PI_2
}

/// The direction from 0 to π/2 along or across which the surface bends most, and by how much more than across it.
fn bent(patches: &Patches, [u, v]: [f64; 2]) -> (f64, f64) {
    let Some(bend) = patches.bend(u, v) else { return (0.0, 0.0) };
    let [a, b, c] = patches.jet(u, v).second.map(|d| dot(d, bend.normal));
    // Eigenvalues of [[a, b], [b, c]]: middle ± radius.
    let (middle, half) = (0.5 * (a + c), 0.5 * (a - c));
    let radius = libm::hypot(half, b);
    let more = (middle + radius).abs() - (middle - radius).abs();
    let angle = 0.5 * libm::atan2(b, half);
    (angle.rem_euclid(FRAC_PI_2), more.abs())
}
