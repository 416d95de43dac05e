//! Poses about one that was found: a pose beside the right one fits all but a few points, and no small step leads from it.

use super::freedom::Freedom;
use super::icp::moved;
use super::system::{Spectrum, System};
use crate::rigid::Rigid;
use crate::space::times;

/// Poses to either side along each of the three motions that are held least.
const POSES_PER_SIDE: i32 = 5;
/// Shares of the spacing that these poses lie apart.
const POSE_STRIDE: f64 = 0.6;
/// Poses along a motion that the shape seems to leave free: points that were left out may hold it.
const POSES_PER_FREEDOM: usize = 144;

/// Poses about `pose`, at which `system` is that of the facets; `spacing` in millimeters.
pub(super) fn poses(system: &System, freedoms: &[Freedom], pose: &Rigid, spacing: f64) -> Vec<Rigid> {
    let weakest = Spectrum::of(system).vectors;
    let side = || -POSES_PER_SIDE..=POSES_PER_SIDE;
    let mut all = vec![];
    for (i, j) in side().flat_map(|i| side().map(move |j| (i, j))) {
        for k in side() {
            let ways = [i, j, k].map(|n| f64::from(n) * POSE_STRIDE * spacing);
            let step = std::array::from_fn(|d| (0..3).map(|w| ways[w] * weakest[w][d]).sum());
            all.push(moved(system, &step).after(pose));
        }
    }
    for freedom in freedoms {
        all.extend((1..POSES_PER_FREEDOM).map(|k| along(freedom, k, spacing).after(pose)));
    }
    all
}

/// Step `k` of [`POSES_PER_FREEDOM`]: all the way round, or as far to one side as to the other.
fn along(freedom: &Freedom, k: usize, spacing: f64) -> Rigid {
    match *freedom {
        Freedom::Turns { point, direction } => {
            let angle = std::f64::consts::TAU * k as f64 / POSES_PER_FREEDOM as f64;
            Rigid::rotation_about(point, times(angle, direction))
        }
        Freedom::Slides { direction } => {
            let way = POSE_STRIDE * spacing * (k as f64 - 0.5 * POSES_PER_FREEDOM as f64);
            Rigid::translation_by(times(way, direction))
        }
    }
}
