//! Least squares of orthogonal distances: Levenberg–Marquardt on streamed normal equations.
//!
//! D. W. Marquardt, "An algorithm for least-squares estimation of nonlinear parameters", J. SIAM 11 (1963). Ours differs in
//! four points.
//! 1. The unknowns are small motions about the present element, so the frame is renewed in every step.
//! 2. Damping starts at zero, as the starts are good.
//! 3. Near the optimum the sum of squares falls by less than its own rounding and no longer tells whether a step was good. The
//!    gradient still has digits there, so such steps are taken without asking the sum.
//! 4. While steps are short, and shrink as they do with the right normal matrix, that matrix is kept and only the gradient
//!    is summed.
//!
//! **When it stops.** There is one rule ([`Step::is_last`]). The search ends with the step after which the way left cannot be
//! told apart from rounding. All lengths are root mean square changes of the distances, in the unit frame.

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
    /// The sums of the last pass: before the very last step, which changes nothing that shows. The normal matrix may be of one
    /// or two passes before, as long as the steps since were short ([`MAX_STEP_KEEPING_MATRIX`]).
    pub sums: Sums<P>,
    pub steps: usize,
    pub converged: bool,
}

/// Relative fall of the sum of squares that can still be told from its rounding: five digits are left to that.
const MIN_VISIBLE_FALL: f64 = 1e-11;
/// Steps below this length can be rounding alone. Distances are rounded by 1e-16, and unknowns that the points hardly determine
/// magnify that, here by a million at most.
const MAX_ROUNDING_STEP: f64 = 1e-10;
/// Share of the root mean square distance by which a step may change a distance unseen.
const UNSEEN_CHANGE_SHARE: f64 = 1e-3;
/// Steps up to this length are taken to leave the normal matrix as it is.
const MAX_STEP_KEEPING_MATRIX: f64 = 1e-5;
/// … if the step is at most this share of the one before: then the matrix has three digits and more, enough for steps and
/// uncertainties. If more remains, it is summed anew.
const MAX_SHRINKING_KEEPING_MATRIX: f64 = 1e-3;
/// Share of the predicted fall of the sum of squares that a step must bring to be taken.
const MIN_ACCEPTED_GAIN: f64 = 1e-4;
/// Damping above which the matrix has no inverse at any damping: the points leave some unknown without influence.
const MAX_DAMPING: f64 = 1e12;
/// Damping below which none is used, and the first damping used once it is needed.
const DAMPING_BOUNDS: (f64, f64) = (1e-7, 1e-3);

/// The facts known of a step before it is tried.
struct Step {
    length: f64,
    /// Whether no distance can change by more. Where they hardly determine an unknown, a step without length may lead far off.
    straight: bool,
    /// Length of the step taken before; infinite for the first.
    last_length: f64,
    /// The sum of squares would fall by less than its own rounding; and it is not damped, so that it leads to the optimum.
    invisible: bool,
}

impl Step {
    /// Whether nothing is left to go after this step that can be told apart from rounding.
    ///
    /// The way left is at most about the length of the step itself. Where undamped steps shrink steadily, as they do near the
    /// optimum, it is the length of the next one. That is this length times the quotient of the last two. That is compared with
    /// `enough`. And where steps in the reach of rounding no longer become shorter by half, they are rounding themselves.
    fn is_last(&self, enough: f64) -> bool {
        let &Step { length, straight, last_length, invisible } = self;
        let shrinking = if invisible && last_length < 1.0 { (length / last_length).min(1.0) } else { 1.0 };
        let is_rounding = invisible && length < MAX_ROUNDING_STEP && length > 0.5 * last_length;
        straight && length * shrinking <= enough || is_rounding
    }

    /// Whether the normal matrix is good enough for the next step too.
    fn keeps_matrix(&self) -> bool {
        self.length <= MAX_STEP_KEEPING_MATRIX
            && self.length <= MAX_SHRINKING_KEEPING_MATRIX * self.last_length
    }
}

/// The local minimum reached from `start`; `None` if `start` has no finite sum of squares or the points leave
/// some unknown without any influence.
pub(super) fn minimize<const P: usize, F: Family<P>, W: Weighing>(
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
            if damping > MAX_DAMPING {
                return None;
            }
            damping = more(damping);
            continue;
        };
        let fall = now.sums.fall(&step);
        // That of a point on the axis of a cone changes as the axis moves, whatever its slope.
        let most = step.iter().map(|x| x * x).sum::<f64>().sqrt();
        let rms = (now.sums.square / now.sums.weight).sqrt();
        let straight = most <= effort.enough.max(MAX_ROUNDING_STEP).max(UNSEEN_CHANGE_SHARE * rms);
        let invisible = damping == 0.0 && straight && fall <= MIN_VISIBLE_FALL * now.sums.square;
        let this = Step { length: now.sums.length(&step), straight, last_length, invisible };
        if this.is_last(effort.enough) {
            now.element = element;
            now.converged = true;
            break;
        }
        let next = if this.keeps_matrix() {
            sums_near::<P, F, W>(&element, sample, weigh, &now.sums)
        } else {
            sums::<P, F, W>(&element, sample, weigh)
        };
        // Rounding makes an inverse of a matrix without one, and steps that lead up.
        let gain = if fall > 0.0 { (now.sums.square - next.square) / fall } else { f64::NEG_INFINITY };
        if invisible || gain > MIN_ACCEPTED_GAIN {
            now.element = element;
            now.sums = next;
            last_length = this.length;
            damping = if gain > 0.75 || invisible {
                less(damping)
            } else if gain < 0.25 {
                more(damping)
            } else {
                damping
            };
        } else if this.length < effort.enough.max(MAX_ROUNDING_STEP) {
            // Not even a step that short is taken: the element is as good as can be.
            now.converged = true;
            break;
        } else {
            damping = more(damping);
        }
    }
    now.sums.square.is_finite().then_some(now)
}

fn more(damping: f64) -> f64 {
    (damping * 8.0).max(DAMPING_BOUNDS.1)
}
fn less(damping: f64) -> f64 {
    let less = damping / 8.0;
    if less < DAMPING_BOUNDS.0 { 0.0 } else { less }
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
        let best = minimize::<5, Cylinder, _>(&element, &sample, &Alike, FULL).unwrap().element;
        for off in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            let start = best.moved(&Cylinder::LOCAL, &[off, -off, off, off, off]).unwrap();
            let found = minimize::<5, Cylinder, _>(&start, &sample, &Alike, FULL).unwrap();
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
