//! Control points from the normal equations, and the weight of the thin-plate term.

use super::energy::thin_plate;
use super::gaps::Folds;
use super::gram::{Binned, Sums};
use super::hold::{self, HoldGround, Penalty};
use super::stencil::{Order, Stencil};
use super::{Fairness, Options, Support, SurfaceError};
use trueness_geom::num::banded::{Banded, BandedError, Factor};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, minus};
use trueness_geom::spline::surface::Patches;

/// Control points of least squares.
pub(super) struct Solved {
    /// Less the center.
    pub points: Vec<Point>,
    pub fairness: f64,
    pub degrees_of_freedom: Option<f64>,
    pub support: Support,
    /// Stiffness of the plates that hold control points where points are few.
    pub stiffness: f64,
}

/// Least sum of the squares of a basis function over all points that holds a control point.
const MIN_SUPPORT: f64 = 1e-4;

/// Results of an earlier solution of much the same points.
#[derive(Clone, Copy)]
pub(super) struct EarlierSolution {
    pub fairness: f64,
    pub degrees_of_freedom: f64,
    /// Stiffness where points are few.
    pub stiffness: f64,
}

/// Times that the stiffness where points are few is found anew.
const SOFTENING_PASSES: usize = 2;

/// Solves for the control points.
pub(super) fn solve(
    data: &Binned,
    ground: &HoldGround,
    known: Option<EarlierSolution>,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Solved, SurfaceError> {
    let (normal, Sums { right, .. }) = data.equations(progress)?;
    let total = data.counts[0] * data.counts[1];
    let (cells, empty_cells) = data.cells();
    let unsupported = (0..total).filter(|k| normal.diagonal(*k) < MIN_SUPPORT).count();
    let support = Support { unsupported, control_points: total, empty_cells, cells };
    let energy = match options.fairness {
        Fairness::Weight(0.0) => Stencil::new([0, 0], [0, 0]),
        _ => thin_plate(&data.spans, data.counts),
    };
    // A weight that was given is the only one.
    let hold = match options.fairness {
        Fairness::Auto => Penalty::of(data, &normal, ground),
        Fairness::Weight(_) => None,
    };
    let stiffness = known.map_or(hold::MAX_PLATE_STIFFNESS, |k| k.stiffness);
    let mut system = System { data, normal, energy, hold, stiffness, right, support };
    let (fairness, degrees_of_freedom) = match (options.fairness, known) {
        (Fairness::Weight(w), _) => (w, None),
        (Fairness::Auto, Some(known)) => (known.fairness, Some(known.degrees_of_freedom)),
        (Fairness::Auto, None) => {
            let (w, dof) = system.automatic(progress)?;
            (w, Some(dof))
        }
    };
    let mut points = system.refined(&system.factor(fairness, progress)?, fairness, progress)?;
    for _ in 0..SOFTENING_PASSES {
        let Some(softer) = system.softer(&points, degrees_of_freedom, progress)? else { break };
        system.stiffness = softer;
        points = system.refined(&system.factor(fairness, progress)?, fairness, progress)?;
    }
    Ok(Solved { points, fairness, degrees_of_freedom, support, stiffness: system.stiffness })
}

/// Refuses a matrix larger than allowed.
pub(super) fn allowed(counts: [usize; 2], reach: [usize; 2], memory: usize) -> Result<(), SurfaceError> {
    match bytes(counts, reach) {
        Some(bytes) if bytes <= memory => Ok(()),
        bytes => Err(SurfaceError::TooLarge { counts, bytes, memory }),
    }
}

/// Memory that the matrix of so many control points takes; `None` where no number holds it.
fn bytes(counts: [usize; 2], reach: [usize; 2]) -> Option<usize> {
    // The product bounds every other one here.
    let total = counts[0].checked_mul(counts[1])?.checked_mul(reach[0].max(reach[1]) + 1)?;
    Banded::bytes(total / (reach[0].max(reach[1]) + 1), Order::new(counts).width(reach))
}

struct System<'a> {
    data: &'a Binned,
    normal: Stencil,
    energy: Stencil,
    hold: Option<Penalty>,
    /// Stiffness of the plates, as a share of the points' mean hold on a control point.
    stiffness: f64,
    right: Vec<Point>,
    support: Support,
}

/// Control points up to which the degrees of freedom are counted one by one.
const MAX_POINTS_COUNTED_EXACTLY: usize = 300;
/// Random vectors that they are estimated by beyond, three at a time: each time is a pass over the points.
const RANDOM_PROBES: usize = 12;
/// Points to a control point from which on the first three do. The degrees of freedom are then known to about 3 %, and
/// are a small part of the number that they are subtracted from.
const MIN_DENSITY_FOR_FEW_PROBES: usize = 20;
/// How many times a degree of freedom counts: plain cross-validation takes noise for shape now and then.
const FREEDOM_WEIGHT: f64 = 1.4;

/// Exponent of the greatest weight that is tried.
const MAX_WEIGHT_EXPONENT: i32 = 4;
/// Times its least that the sum of squares at blocks left out may be.
const MAX_SQUARES_RATIO: f64 = 2.0;

impl System<'_> {
    /// The weight of the plates that hold control points where points are few.
    fn held_by(&self) -> f64 {
        self.stiffness * self.normal.trace() / self.energy.trace()
    }

    /// The stiffness that suits the residuals of these control points, where it is much less than the one there is.
    fn softer(
        &self,
        points: &[Point],
        degrees_of_freedom: Option<f64>,
        progress: &dyn Progress,
    ) -> Result<Option<f64>, SurfaceError> {
        let (Some(used), Some(_)) = (degrees_of_freedom, &self.hold) else { return Ok(None) };
        let free = (self.data.len() as f64 - used).max(1.0);
        let variance = self.left_by(points, progress)?.square / free;
        let softer = hold::stiffness(self.data, &self.normal, variance);
        Ok(Some(softer).filter(|s| *s < 0.5 * self.stiffness))
    }

    fn factor(&self, weight: f64, progress: &dyn Progress) -> Result<Factor, SurfaceError> {
        self.factor_of(&self.normal, weight, progress)
    }

    /// The factor with another matrix of the points.
    fn factor_of(
        &self,
        normal: &Stencil,
        weight: f64,
        progress: &dyn Progress,
    ) -> Result<Factor, SurfaceError> {
        let mut terms = vec![(weight, &self.energy)];
        terms.extend(self.hold.iter().map(|hold| (self.held_by(), &hold.stencil)));
        normal.with(&terms).factor(progress).map_err(|e| match e {
            BandedError::Cancelled(e) => e.into(),
            BandedError::NotDefinite { .. } => SurfaceError::Undetermined {
                total: self.support.control_points,
                points: self.data.len(),
                unsupported: self.support.unsupported,
            },
        })
    }

    /// The solution for a right side over the net.
    fn solved<const D: usize>(&self, factor: &Factor, right: &[[f64; D]]) -> Vec<[f64; D]> {
        let order = Order::new(self.data.counts);
        let mut own = vec![[0.0; D]; right.len()];
        right.iter().enumerate().for_each(|(k, r)| own[order.of(k)] = *r);
        factor.solve(&mut own);
        (0..right.len()).map(|k| own[order.of(k)]).collect()
    }

    /// The control points, corrected by their residuals until that changes nothing. The equations square the condition
    /// of the problem, and the corrections take most of it back. (Björck, Stability analysis of the method of
    /// semi-normal equations for linear least squares problems, Linear Algebra and its Applications 88/89, 1987).
    fn refined(
        &self,
        factor: &Factor,
        weight: f64,
        progress: &dyn Progress,
    ) -> Result<Vec<Point>, SurfaceError> {
        let mut right = self.right.clone();
        self.pull(&mut right, &vec![[0.0; 3]; self.right.len()], weight);
        let mut points = self.solved(factor, &right);
        let mut before = f64::INFINITY;
        for _ in 0..8 {
            let mut gradient = self.left_by(&points, progress)?.right;
            self.pull(&mut gradient, &points, weight);
            let step = self.solved(factor, &gradient);
            let size = largest(&step) / largest(&points).max(f64::MIN_POSITIVE);
            if size.is_nan() || size >= before {
                break;
            }
            points.iter_mut().zip(&step).for_each(|(p, s)| (0..3).for_each(|d| p[d] += s[d]));
            // A correction of this size has one of its square after it.
            if size < 1e-9 {
                break;
            }
            before = size;
        }
        Ok(points)
    }

    /// The sums of the residuals of the surface of these control points.
    fn left_by(&self, points: &[Point], progress: &dyn Progress) -> Result<Sums, SurfaceError> {
        let patches = Patches::of(self.data.spans.clone(), points, self.data.counts[1]);
        Ok(self.data.left_by(&patches, progress)?)
    }

    /// Adds the pull of the other terms at these control points: `− weight · E p`, and `H (t − p)` where points are
    /// few.
    fn pull(&self, to: &mut [Point], points: &[Point], weight: f64) {
        let mut add = |weight: f64, pull: Vec<Point>| {
            to.iter_mut().zip(pull).for_each(|(to, pull)| (0..3).for_each(|d| to[d] += weight * pull[d]));
        };
        if weight > 0.0 {
            add(-weight, self.energy.times(points));
        }
        if let Some(hold) = &self.hold {
            let off: Vec<Point> = hold.target.iter().zip(points).map(|(t, p)| minus(*t, *p)).collect();
            add(self.held_by(), hold.stencil.times(&off));
        }
    }

    /// The weight of least cross-validation, and the degrees of freedom with it.
    ///
    /// Weights are tried in steps of ten, then finer about the best. Sums of squares are those of one first surface
    /// plus the change by the weight, so that points without noise lose no digits.
    fn automatic(&self, progress: &dyn Progress) -> Result<(f64, f64), SurfaceError> {
        let unit = self.normal.trace() / self.energy.trace();
        let mut start = -10;
        let factor = loop {
            match self.factor(unit * power(f64::from(start)), progress) {
                Err(SurfaceError::Undetermined { .. }) if start < -4 => start += 1,
                other => break other?,
            }
        };
        let first = unit * power(f64::from(start));
        let base = self.refined(&factor, first, progress)?;
        let Sums { right: gradient, square } = self.left_by(&base, progress)?;
        let mut start_from = gradient.clone();
        self.pull(&mut start_from, &base, 0.0);
        let bent = self.energy.times(&base);
        let (size, count) = (self.data.square(), self.data.len() as f64);
        let probes = self.probes(progress)?;
        let score = |weight: f64| -> Result<(f64, f64), SurfaceError> {
            let factor = self.factor(weight, progress)?;
            let right: Vec<Point> = start_from
                .iter()
                .zip(&bent)
                .map(|(g, e)| std::array::from_fn(|d| g[d] - weight * e[d]))
                .collect();
            let change = self.solved(&factor, &right);
            let moved = self.normal.times(&change);
            let product = |a: &[Point], b: &[Point]| {
                a.iter().zip(b).map(|(a, b)| (0..3).map(|d| a[d] * b[d]).sum::<f64>()).sum::<f64>()
            };
            let left = square - 2.0 * product(&change, &gradient) + product(&change, &moved);
            // Rounding of the points themselves.
            let left = left.max(size * f64::EPSILON * f64::EPSILON);
            let dof = self.degrees_of_freedom(&factor, &probes);
            let free = count - FREEDOM_WEIGHT * dof;
            Ok((if free > 0.0 { left / (free * free) } else { f64::INFINITY }, dof))
        };
        let from = self.trusted(&base, &bent, (unit, start), progress)?;
        let mut best = (f64::INFINITY, f64::from(MAX_WEIGHT_EXPONENT), 0.0);
        let try_at = |exponent: f64, best: &mut (f64, f64, f64)| -> Result<(), SurfaceError> {
            let (value, dof) = score(unit * power(exponent))?;
            if value < best.0 {
                *best = (value, exponent, dof);
            }
            Ok(())
        };
        for k in start..=MAX_WEIGHT_EXPONENT {
            if f64::from(k) >= from {
                try_at(f64::from(k), &mut best)?;
            }
        }
        if best.0.is_infinite() {
            // No weight leaves freedom enough: the stiffest one.
            let stiffest = unit * power(f64::from(MAX_WEIGHT_EXPONENT));
            return Ok((stiffest, score(stiffest)?.1));
        }
        for step in [0.5, 0.25] {
            let middle = best.1;
            for side in [-step, step] {
                if middle + side >= from {
                    try_at(middle + side, &mut best)?;
                }
            }
        }
        Ok((unit * power(best.1), best.2))
    }

    /// The least exponent of the weight with which the surface can be relied upon between rows of points. From it on,
    /// the residual where blocks are left out is no more than twice the least of all weights.
    fn trusted(
        &self,
        base: &[Point],
        bent: &[Point],
        (unit, start): (f64, i32),
        progress: &dyn Progress,
    ) -> Result<f64, SurfaceError> {
        let surface = Patches::of(self.data.spans.clone(), base, self.data.counts[1]);
        let Some(folds) = Folds::of(self.data, &surface, progress)? else { return Ok(f64::from(start)) };
        let mut pulled = vec![[0.0; 3]; base.len()];
        self.pull(&mut pulled, base, 0.0);
        let off = |exponent: f64| -> Result<f64, SurfaceError> {
            let weight = unit * power(exponent);
            let mut sum = 0.0;
            for fold in [0, 1] {
                let (normal, gradient) = folds.kept(fold);
                let right: Vec<Point> = (0..base.len())
                    .map(|k| std::array::from_fn(|d| gradient[k][d] + pulled[k][d] - weight * bent[k][d]))
                    .collect();
                match self.factor_of(normal, weight, progress) {
                    Ok(factor) => sum += folds.left(fold, &self.solved(&factor, &right)),
                    Err(SurfaceError::Undetermined { .. }) => return Ok(f64::INFINITY),
                    Err(e) => return Err(e),
                }
            }
            Ok(sum)
        };
        let exponents: Vec<f64> = (start..=MAX_WEIGHT_EXPONENT).map(f64::from).collect();
        let off = exponents.iter().map(|e| off(*e)).collect::<Result<Vec<f64>, SurfaceError>>()?;
        let mut at = (0..off.len()).min_by(|a, b| off[*a].total_cmp(&off[*b])).unwrap_or(0);
        let most = MAX_SQUARES_RATIO * off[at];
        while at > 0 && off[at - 1] <= most {
            at -= 1;
        }
        Ok(exponents[at])
    }

    /// The probes of the trace: unit vectors of all control points, or the sums of random signs of the points.
    fn probes(&self, progress: &dyn Progress) -> Result<Vec<Vec<Point>>, SurfaceError> {
        let total = self.right.len();
        if total <= MAX_POINTS_COUNTED_EXACTLY {
            let unit = |first: usize| {
                (0..total).map(|k| std::array::from_fn(|d| f64::from(k == first + d))).collect()
            };
            return Ok((0..total).step_by(3).map(unit).collect());
        }
        let signs = |probe: usize| {
            self.data.sums_with(progress, move |i| {
                let bits = Random::stream(probe as u64, u64::from(i)).next_u64();
                std::array::from_fn(|d| if bits >> (20 * d + 3) & 1 == 0 { 1.0 } else { -1.0 })
            })
        };
        let times = if self.data.len() < MIN_DENSITY_FOR_FEW_PROBES * total { RANDOM_PROBES / 3 } else { 1 };
        (0..times).map(|time| Ok(signs(time)?)).collect()
    }

    /// The trace of the matrix from points to fitted points. Beyond [`MAX_POINTS_COUNTED_EXACTLY`] control points it is
    /// the mean over random signs. (Girard, A fast Monte-Carlo cross-validation procedure for large least squares
    /// problems with noisy data, Numerische Mathematik 56, 1989).
    fn degrees_of_freedom(&self, factor: &Factor, probes: &[Vec<Point>]) -> f64 {
        let exact = self.right.len() <= MAX_POINTS_COUNTED_EXACTLY;
        let mut sum = 0.0;
        for (n, probe) in probes.iter().enumerate() {
            let answer = self.solved(factor, probe);
            if exact {
                let applied = self.normal.times(&answer);
                sum += (0..3).filter_map(|d| applied.get(3 * n + d).map(|row| row[d])).sum::<f64>();
            } else {
                let products =
                    probe.iter().zip(&answer).map(|(a, b)| (0..3).map(|d| a[d] * b[d]).sum::<f64>());
                sum += products.sum::<f64>() / (3 * probes.len()) as f64;
            }
        }
        sum
    }
}

fn power(exponent: f64) -> f64 {
    libm::pow(10.0, exponent)
}

fn largest(points: &[Point]) -> f64 {
    points.iter().flatten().fold(0.0, |m, x| m.max(x.abs()))
}
