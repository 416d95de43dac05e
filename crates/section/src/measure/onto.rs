//! The best fit of a section onto the section of its nominal, in their plane.
//!
//! Least squares of the distances to the nearest place, by Gauss and Newton. The outline is taken for its tangent at
//! each foot, or for the corner where a foot is one. The feet are found anew after each step. (Chen and Medioni, Object
//! modelling by registration of multiple range images, 1992). A step that does not bring the points nearer is halved.
//! It begins with weights that fall with the distance (Huber), so that points without a counterpart hardly lead it. It
//! ends with all that count at full weight. Motions that the outlines do not hold are named and not guessed: as a
//! circle turns, and a line slides along itself.

mod freedom;
mod motion;
mod place;
#[cfg(test)]
mod tests;

use super::nominal::{Outline, off_nominal};
pub use freedom::{Free, Freedom};
pub use motion::PlaneMotion;
use place::{Places, Row};
use trueness_geom::num::cholesky::Cholesky;
use trueness_geom::num::median::median;
use trueness_geom::progress::{Cancelled, Progress};

/// A best fit.
#[derive(Clone, Debug, PartialEq)]
pub struct OntoNominal {
    /// The motion from the section as it lies onto the nominal.
    pub motion: PlaneMotion,
    /// Standard uncertainty of its shift, coordinate by coordinate; 0 where that was held.
    pub shift_uncertainty: [f64; 2],
    /// Standard uncertainty of its turn, radians; 0 where that was held.
    pub turn_uncertainty: f64,
    /// Root mean square distance before, of the points that count in the end.
    pub rms_before: f64,
    /// Root mean square distance in the end.
    pub rms: f64,
    /// So many successive points tell as much as one that scatters alone.
    pub correlated: f64,
    /// Points that count.
    pub used: usize,
    /// Points without a counterpart: beyond an end of the nominal, or farther than was said.
    pub left_out: usize,
    /// Steps taken.
    pub iterations: usize,
    /// Whether the last step was far smaller than the uncertainty.
    pub converged: bool,
}

/// Why there is no best fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OntoNominalError {
    /// There is nothing to fit onto.
    #[error("the nominal has no outline in this plane; give the plane of one, or leave --fit out")]
    NoOutline,
    /// Too few points count.
    #[error(
        "{found} points have a counterpart on the nominal, a fit of {unknowns} unknowns needs more than that; bring both together with trueness align, or widen --max-distance"
    )]
    TooFewPoints {
        /// Points that count.
        found: usize,
        /// Number of unknowns.
        unknowns: usize,
    },
    /// The outlines hold the section only in part.
    #[error("the nominal does not hold the section: {free}; {remedy}")]
    Undetermined {
        /// The motion that leaves all distances as they are.
        free: Free,
        /// The request that can be made instead.
        remedy: String,
    },
    /// Stopped through the progress argument.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Steps of either stage.
const MAX_STEPS_PER_STAGE: usize = 60;
/// A step so small against the uncertainty changes nothing.
const SETTLED_STEP_SIGMAS: f64 = 1e-3;
/// A step of this share of the size is rounding.
const ROUNDING_STEP_SHARE: f64 = 1e-13;
/// Residuals from which on a point counts less, in standard deviations (P. J. Huber 1964: 95 % as efficient as the mean).
const HUBER_SIGMAS: f64 = 1.345;
/// Median magnitude of a normal variable over its standard deviation.
const MEDIAN_SIGMAS: f64 = 0.674_489_75;
/// A turn is cut to this, radians: a tangent tells nothing of places farther round.
const MAX_STEP_TURN: f64 = 0.2;

/// The motion, within `freedom`, that brings the points of `rows` nearest to the outlines. Points that are farther than `reach` in the
/// end do not count. A turn alone is one about the origin; else the center is the middle of the points that count.
///
/// Uncertainties are those of the scatter of the points about the nominal after the fit. The scatter is taken as
/// correlated along each row as it is found to be. Cost: up to 120 times that of [`off_nominal`].
///
/// # Errors
/// [`OntoNominalError`]: no outline, too few points, motions that the outlines do not hold, cancelled.
///
/// ```
/// use trueness_section::{onto_nominal, Freedom, Outline};
/// let ell = Outline::polyline(&[[0.0, 0.0], [40.0, 0.0], [40.0, 20.0]], false);
/// let points: Vec<[f64; 2]> = (1..60).map(|i| f64::from(i)).map(|s| if s < 40.0 { [s, 0.3] } else { [40.1, s - 39.7] }).collect();
/// let found = onto_nominal(&[&points], &[ell], Freedom::SHIFT, f64::INFINITY, &trueness_geom::progress::Silent).unwrap();
/// assert!((found.motion.shift[0] + 0.1).abs() < 0.01 && (found.motion.shift[1] + 0.3).abs() < 0.01);
/// ```
pub fn onto_nominal(
    rows: &[&[[f64; 2]]],
    outlines: &[Outline],
    freedom: Freedom,
    reach: f64,
    progress: &dyn Progress,
) -> Result<OntoNominal, OntoNominalError> {
    if outlines.iter().all(|o| o.segments.is_empty()) {
        return Err(OntoNominalError::NoOutline);
    }
    let mut search = Search {
        rows: rows.iter().map(|r| r.to_vec()).collect(),
        outlines,
        freedom,
        progress,
        motion: PlaneMotion::about(if freedom == Freedom::TURN { [0.0; 2] } else { middle(rows) }),
    };
    let first = search.places()?;
    let mut iterations = search.settle(&huber)?.0;
    let within = |places: &Places| places.distances().map(|d| f64::from(d.abs() <= reach)).collect();
    let (steps, converged) = search.settle(&within)?;
    iterations += steps;
    let places = search.places()?;
    let weights: Vec<f64> = within(&places);
    let used = weights.iter().filter(|w| **w > 0.0).count();
    let normal = search.normal(&places, &weights)?;
    let distances: Vec<f64> = places.distances().collect();
    let correlated = places.rows.iter().map(|row| row.correlated(reach)).fold(1.0, f64::max);
    let degrees = (used as f64 / correlated - freedom.unknowns() as f64).max(1.0);
    let square: f64 = distances.iter().zip(&weights).map(|(d, w)| w * d * d).sum();
    let [x, y, turn] = normal.uncertainties(square / degrees);
    let before = first.rms_of(&places, reach);
    Ok(OntoNominal {
        motion: search.motion,
        shift_uncertainty: [x, y],
        turn_uncertainty: turn,
        rms_before: before,
        rms: (square / used.max(1) as f64).sqrt(),
        correlated,
        used,
        left_out: rows.iter().map(|r| r.len()).sum::<usize>() - used,
        iterations,
        converged,
    })
}

fn middle(rows: &[&[[f64; 2]]]) -> [f64; 2] {
    let finite = || rows.iter().flat_map(|r| r.iter()).filter(|p| p.iter().all(|x| x.is_finite()));
    let count = finite().count().max(1) as f64;
    [0, 1].map(|k| finite().map(|p| p[k]).sum::<f64>() / count)
}

/// Weights by which far points lead the fit no more than near ones.
fn huber(places: &Places) -> Vec<f64> {
    let mut sizes: Vec<f64> = places.distances().map(f64::abs).collect();
    let Some(middle) = median(&mut sizes) else { return vec![] };
    let scale = middle / MEDIAN_SIGMAS;
    let limit = HUBER_SIGMAS * scale;
    places.distances().map(|d| if d.abs() <= limit { 1.0 } else { limit / d.abs() }).collect()
}

struct Search<'a> {
    rows: Vec<Vec<[f64; 2]>>,
    outlines: &'a [Outline],
    freedom: Freedom,
    progress: &'a dyn Progress,
    motion: PlaneMotion,
}

/// Normal equations of a step, in the unknowns that are free: shifts, and the turn times a length.
struct Normal {
    freedom: Freedom,
    factor: Cholesky,
    right: Vec<f64>,
    /// The length that makes a turn a shift.
    arm: f64,
    /// Mean square distance, for the uncertainty of the step.
    square: f64,
    count: f64,
}

impl Normal {
    fn step(&self) -> [f64; 3] {
        let mut x = self.right.clone();
        self.factor.solve(&mut x);
        self.spread(&x)
    }

    /// Values of the free unknowns, as two shifts and a turn.
    fn spread(&self, x: &[f64]) -> [f64; 3] {
        let mut all = [0.0; 3];
        for (i, k) in self.freedom.axes().enumerate() {
            all[k] = if k == 2 { x[i] / self.arm } else { x[i] };
        }
        all
    }

    fn uncertainties(&self, variance: f64) -> [f64; 3] {
        let n = self.freedom.unknowns();
        let x: Vec<f64> = (0..n).map(|i| (variance * self.factor.inverse_diagonal(i)).sqrt()).collect();
        self.spread(&x)
    }
}

impl Search<'_> {
    fn places(&self) -> Result<Places, Cancelled> {
        let mut rows = vec![];
        for row in &self.rows {
            let points: Vec<[f64; 2]> = row.iter().map(|p| self.motion.apply(*p)).collect();
            let found = off_nominal(&points, self.outlines, self.progress)?;
            rows.push(Row::new(&points, &found, self.outlines));
        }
        Ok(Places { rows })
    }

    fn normal(&self, places: &Places, weights: &[f64]) -> Result<Normal, OntoNominalError> {
        let pivot = self.motion.moved_center();
        let kept = || places.all().zip(weights).filter(|(_, w)| **w > 0.0);
        let count = kept().count();
        let n = self.freedom.unknowns();
        if count <= n {
            return Err(OntoNominalError::TooFewPoints { found: count, unknowns: n });
        }
        let square = |p: &[f64; 2]| (p[0] - pivot[0]).powi(2) + (p[1] - pivot[1]).powi(2);
        let arm = (kept().map(|(p, _)| square(&p.point)).sum::<f64>() / count as f64).sqrt();
        let arm = arm.max(f64::MIN_POSITIVE);
        let held = freedom::held(kept().map(|(p, w)| (p, *w)), pivot, arm, self.freedom);
        if let Err(free) = held {
            return Err(OntoNominalError::Undetermined { remedy: self.freedom.remedy(&free), free });
        }
        let (mut matrix, mut right, mut sum) = (vec![0.0; n * n], vec![0.0; n], 0.0);
        for (p, w) in kept() {
            let corner = p.is_corner.then(|| (p.across(), 0.0));
            for (direction, distance) in std::iter::once((p.normal, p.distance)).chain(corner) {
                let slopes = freedom::slopes(p.point, direction, pivot, arm);
                for (i, a) in self.freedom.axes().enumerate() {
                    right[i] -= w * slopes[a] * distance;
                    for (j, b) in self.freedom.axes().enumerate().take(i + 1) {
                        matrix[i * n + j] += w * slopes[a] * slopes[b];
                    }
                }
            }
            sum += w * p.distance * p.distance;
        }
        let factor = Cholesky::new(matrix, n).ok_or_else(|| {
            let free = Free::nothing_holds();
            OntoNominalError::Undetermined { remedy: self.freedom.remedy(&free), free }
        })?;
        Ok(Normal { freedom: self.freedom, factor, right, arm, square: sum, count: count as f64 })
    }

    /// Steps until they are small against the uncertainty, or until none brings the points nearer.
    fn settle(&mut self, weigh: &dyn Fn(&Places) -> Vec<f64>) -> Result<(usize, bool), OntoNominalError> {
        let mut places = self.places()?;
        for step in 0..MAX_STEPS_PER_STAGE {
            let weights = weigh(&places);
            let normal = self.normal(&places, &weights)?;
            let mut by = normal.step();
            let turn = by[2].abs();
            if turn > MAX_STEP_TURN {
                by = by.map(|x| x * MAX_STEP_TURN / turn);
            }
            let size = |by: [f64; 3]| libm::hypot(libm::hypot(by[0], by[1]), by[2] * normal.arm);
            let uncertain = (normal.square / normal.count).sqrt() / normal.count.sqrt();
            let least =
                (SETTLED_STEP_SIGMAS * uncertain).max(ROUNDING_STEP_SHARE * (normal.arm + self.motion.far()));
            let before = self.motion;
            loop {
                self.motion = before.then(by);
                let tried = self.places()?;
                if places.come_nearer(&tried, &weights) {
                    places = tried;
                    break;
                }
                // Nor is there an end to halving a value that is no number.
                if !size(by).is_finite() || least.is_nan() || size(by) <= least {
                    self.motion = before;
                    break;
                }
                by = by.map(|x| 0.5 * x);
            }
            if size(by) <= least {
                return Ok((step + 1, true));
            }
        }
        Ok((MAX_STEPS_PER_STAGE, false))
    }
}
