//! Least squares of orthogonal distances: Levenberg–Marquardt on streamed normal equations.
//!
//! D. W. Marquardt, "An algorithm for least-squares estimation of nonlinear parameters", J. SIAM 11 (1963).
//! Ours differs in four points. The unknowns are small motions about the present element, so the frame is
//! renewed in every step. Damping starts at zero, as the starts are good. And once the linear model says that
//! the sum of squares cannot fall by more than its own rounding, steps are taken unseen until they stop
//! shrinking: the gradient still has digits where the sum has none left. While steps are short, and shrink as they do with
//! the right normal matrix, that matrix is kept and only the gradient is summed.

use super::family::{Element, Family};
use super::normal::{Sums, Weighing, sums, sums_near};
use super::sample::Sample;

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// Most steps.
    pub steps: usize,
    /// Root mean square change of the distances, in the unit frame, below which a step ends the search.
    pub enough: f64,
}

/// To the last digits: half of what a distance of 1 is rounded by.
pub(super) const FULL: Effort = Effort { steps: 300, enough: 5e-17 };
/// Good enough to choose between starts or to start on more points.
pub(super) const ROUGH: Effort = Effort { steps: 40, enough: 1e-7 };

/// As good as few points can tell: the last step leaves about the square of this.
pub(super) const NEAR: Effort = Effort { steps: 40, enough: 1e-3 };

/// Where the search ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct Optimum<const P: usize> {
    pub element: Element,
    /// Of the last pass: before the very last step, which changes nothing that shows. The normal matrix may be of one or
    /// two passes before, as long as the steps since were short ([`ALIKE`]).
    pub sums: Sums<P>,
    pub steps: usize,
    pub converged: bool,
}

/// Relative fall of the sum of squares that its rounding still shows.
const VISIBLE_FALL: f64 = 1e-11;
/// Steps below this, root mean square in the unit frame, are in the reach of rounding.
const ROUNDING_REACH: f64 = 1e-10;
/// Steps below this, root mean square in the unit frame, are thought to leave the normal matrix as it is.
const ALIKE: f64 = 1e-5;
/// What remains of a step in the next, at most, where they did: the matrix then has three digits and more, enough for steps
/// and uncertainties. If more remains, it is renewed.
const SWIFT: f64 = 1e-3;
/// Damping below which none is used, and the first damping used once it is needed.
const DAMPING: (f64, f64) = (1e-7, 1e-3);

/// The local minimum reached from `start`; `None` if `start` has no finite sum of squares or the points leave
/// some unknown without any influence.
pub(super) fn minimise<const P: usize, F: Family<P>, W: Weighing>(
    start: &Element,
    sample: &Sample,
    weigh: &W,
    effort: Effort,
) -> Option<Optimum<P>> {
    let mut now =
        Optimum { element: *start, sums: sums::<P, F, W>(start, sample, weigh), steps: 0, converged: false };
    let mut damping = 0.0;
    let mut last_length = f64::INFINITY;
    while now.steps < effort.steps && now.sums.square.is_finite() {
        now.steps += 1;
        let proposal = now.sums.step(damping).and_then(|step| {
            let element = now.element.moved(&F::LOCAL, &step)?;
            F::sound(element.size).then_some((step, element))
        });
        let Some((step, element)) = proposal else {
            if damping > 1e12 {
                return None;
            }
            damping = harder(damping);
            continue;
        };
        let length = now.sums.length(&step);
        let fall = now.sums.fall(&step);
        let unseen = damping == 0.0 && fall <= VISIBLE_FALL * now.sums.square;
        if length <= effort.enough
            || (unseen && last_length < 1.0 && length * (length / last_length) <= effort.enough)
            || (unseen && length < ROUNDING_REACH && length > 0.5 * last_length)
        {
            now.element = element;
            now.converged = true;
            break;
        }
        let next = if length <= ALIKE && length <= SWIFT * last_length {
            sums_near::<P, F, W>(&element, sample, weigh, &now.sums)
        } else {
            sums::<P, F, W>(&element, sample, weigh)
        };
        let gain = (now.sums.square - next.square) / fall;
        if unseen || gain > 1e-4 {
            now.element = element;
            now.sums = next;
            last_length = length;
            damping = if gain > 0.75 || unseen {
                easier(damping)
            } else if gain < 0.25 {
                harder(damping)
            } else {
                damping
            };
        } else if length < ROUNDING_REACH {
            now.converged = true;
            break;
        } else {
            damping = harder(damping);
        }
    }
    now.sums.square.is_finite().then_some(now)
}

fn harder(damping: f64) -> f64 {
    (damping * 8.0).max(DAMPING.1)
}
fn easier(damping: f64) -> f64 {
    let less = damping / 8.0;
    if less < DAMPING.0 { 0.0 } else { less }
}

#[cfg(test)]
mod tests {
    use super::super::cylinder::Cylinder;
    use super::super::normal::Alike;
    use super::*;
    use crate::frame::Pose;
    use crate::num::random::Random;
    use crate::space::Point;

    /// A cylinder of radius 0.05, so that small motions change the slopes much, seen over a third of its turn.
    #[test]
    fn the_normal_matrix_kept_is_that_of_the_element_found() {
        let mut random = Random::new(9);
        let mut point = |_| -> Point {
            let (angle, rho) = (2.0 * random.unit(), 0.05 + 1e-3 * (random.unit() - 0.5));
            [rho * angle.cos(), rho * angle.sin(), 2.0 * random.unit() - 1.0]
        };
        let points: Vec<Point> = (0..500).map(&mut point).collect();
        let sample = Sample::new(&points).unwrap();
        let element = Element {
            pose: Pose::along(sample.unit([0.0; 3]), [0.0, 0.0, 1.0]),
            size: [0.05 * sample.scale, 0.0],
        };
        let best = minimise::<5, Cylinder, _>(&element, &sample, &Alike, FULL).unwrap().element;
        for off in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            let start = best.moved(&Cylinder::LOCAL, &[off, -off, off, off, off]).unwrap();
            let found = minimise::<5, Cylinder, _>(&start, &sample, &Alike, FULL).unwrap();
            assert!(found.converged);
            let there = sums::<5, Cylinder, _>(&found.element, &sample, &Alike).symmetric();
            let kept = found.sums.symmetric();
            for i in 0..5 {
                for j in 0..5 {
                    let scale = (there[i][i] * there[j][j]).sqrt();
                    let error = (kept[i][j] - there[i][j]).abs() / scale;
                    assert!(error < 1e-3, "{off} {i} {j}: {error}");
                }
            }
        }
    }
}
