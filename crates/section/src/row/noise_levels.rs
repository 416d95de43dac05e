//! The partition that the search begins with, at the level of noise that local fits tell. Rows of few points to a
//! segment have it at finer levels too.
//!
//! Where most local fits hold a corner or a small arc, they take it for noise. The partition at that level is one
//! smooth curve over all corners. Fits of three to five points show whether there may be a finer noise. Then partitions
//! at finer levels are tried, each is searched as a whole, and the cheapest is chosen. The cost is twice the negative
//! logarithm of the likelihood plus a penalty. The penalty grows without bound as the unknowns become as many as the
//! points. (Hurvich and Tsai, Regression and time series model selection in small samples, Biometrika 76, 1989). Where
//! even the cheapest scatters far more than the short fits, it hides form, and is named so.

use super::clean::{Clean, size};
use super::exact::{quantized, rounded};
use super::polygon::polygon;
use crate::model::chain::SegmentKind;
use crate::model::prior::{KnownNoise, NEGLIGIBLE_OFFSET_SPACINGS, Prior};
use crate::model::result::{Continuity, Contour, Options};
use crate::search::partition::{MAX_PART_STARTS, Penalty, partition};
use crate::search::parts::{Part, noise, scatter};
use crate::search::span::Found;
use std::collections::VecDeque;

/// Fewest points of a part.
const MIN_POINTS_PER_PART: usize = 4;
/// Fewest points of a part at finer levels.
const MIN_POINTS_PER_PART_FINER: usize = 3;
/// The partition and the noise that it shows follow each other so many times.
const PARTITION_PASSES: usize = 6;
/// Noise of a first partition below this share of that of local fits: these are not fits of noise.
const MIN_LOCAL_NOISE_SHARE: f64 = 0.3;
/// In rows of fewer points local fits take form for noise.
pub(super) const MAX_POINTS_WITH_FORM_IN_NOISE: usize = 24;
/// Noise of such a row is no more than this share of the distance between points.
const MAX_NOISE_OF_SHORT_ROW_SPACINGS: f64 = 0.05;

/// Longer rows have enough points to a segment for most of their local fits to lie within one.
const MAX_POINTS_OF_SHORT_FITS: usize = 400;
/// In rows of up to so many points finer levels are tried where short fits tell less noise than there is about the chains found.
const SPARSE_ROW_POINTS: usize = 100;
/// In longer rows of `n` points finer levels are tried where short fits tell less than e^(−this / √n) of that noise.
/// Chance hardly makes them do so.
const FINER_LEVEL_CHANCE: f64 = 6.0;
/// In rows of up to so many points parts may have so few that tangent joins look like corners.
const MAX_POINTS_WITH_FALSE_CORNERS: usize = 3000;
/// So many partitions at finer levels are searched.
const MAX_FINER_PARTITIONS: usize = 4;
/// Each finer level is this share of the one before.
const LEVEL_RATIO: f64 = 0.45;
/// The finest level is this share of the noise of short fits. The lower quartile of few fits may lie above the noise as
/// well as below.
const MIN_LEVEL_SHARE: f64 = 0.4;
/// Chains of a finer level are taken where they are cheaper by this: their likelihood is e^4 times as high, beyond the penalty.
pub(super) const FINER_LEVEL_COST_MARGIN: f64 = 8.0;
/// Chains whose costs differ by less are the same.
pub(super) const EQUAL_COST: f64 = 1e-3;

/// The partition that a search begins with.
#[derive(Clone, Debug)]
pub(super) struct Partition {
    /// The row, turned so that it begins where a part does, by so many points.
    pub clean: Clean,
    pub turned: usize,
    pub weights: Vec<f64>,
    pub known_noise: Option<KnownNoise>,
    pub parts: Vec<Part>,
    pub outliers: Vec<usize>,
    /// The parts are exact lines and arcs.
    pub exact: bool,
    /// Arcs are tangent to the lines beside them.
    pub known: bool,
    pub step: usize,
    /// They are taken to be: corners are between lines alone.
    pub tangent: bool,
    /// The continuity that all joins have, where it is not left to the data.
    pub forced: Option<Continuity>,
    /// Standard deviation of the noise that the partition was made with, and of local fits.
    pub sigma: f64,
    pub own: f64,
    /// Noise below this is rounding.
    least: f64,
}

fn penalty(count: f64, noise: f64, fewest: usize) -> Penalty {
    let log = libm::log(count.max(2.0));
    Penalty { line: 3.0 * log, arc: 4.0 * log, noise, fewest, places: MAX_PART_STARTS }
}

impl Partition {
    /// At the level that local fits tell, or that is given; of rows that are lines and arcs exactly, these.
    pub fn new(clean: Clean, prior: &Prior, options: &Options) -> Partition {
        let n = clean.points.len();
        let (mut own, step) = noise(&clean.points, clean.closed);
        if n < MAX_POINTS_WITH_FORM_IN_NOISE {
            own = own.min(MAX_NOISE_OF_SHORT_ROW_SPACINGS * clean.spacing);
        }
        let least = (1e-6 * size(&clean.points)).max(options.resolution.unwrap_or(0.0));
        let rounding = clean.rounding;
        own = own.max(rounding);
        let sigma = prior.noise.map_or(own, |n| n.deviation).max(least);
        let free = prior.noise.is_none() && options.continuity.is_none();
        let exact = if free { rounded(&clean, least) } else { None };
        let known = exact.is_some();
        let none = || polygon(&clean, &penalty(n as f64, least, MIN_POINTS_PER_PART * step));
        let exact = if prior.noise.is_none() { exact.or_else(none) } else { None };
        let mut partition = Partition {
            weights: clean.numbers.iter().map(|i| prior.weight(*i)).collect(),
            clean,
            turned: 0,
            known_noise: prior.noise,
            parts: vec![],
            outliers: vec![],
            exact: exact.is_some(),
            known,
            step,
            tangent: false,
            forced: options.continuity,
            sigma,
            own,
            least: least.max(rounding),
        };
        // Nothing more is to be known of a polygon.
        if let Some((by, parts)) = exact {
            partition.turn(by);
            partition.sigma = scatter(&partition.clean.points, &partition.weights, &parts).max(least);
            (partition.own, partition.parts) = (partition.sigma, parts);
            return partition;
        }
        partition.outliers = partition.clean.outliers(sigma, step);
        for i in &partition.outliers {
            partition.weights[*i] = 0.0;
        }
        partition.clean.bring_in(&partition.outliers);
        for _ in 0..PARTITION_PASSES {
            partition.divide(MIN_POINTS_PER_PART);
            // Where corners lie so near to each other that each local fit holds one, the partition knows the noise better.
            let found =
                scatter(&partition.clean.points, &partition.weights, &partition.parts).max(partition.least);
            if prior.noise.is_some() || found > MIN_LOCAL_NOISE_SHARE * partition.sigma {
                break;
            }
            (partition.own, partition.sigma) = (partition.own.min(found), found);
        }
        partition
    }

    /// The noise that short fits tell, where it is asked for.
    pub fn fine(&self) -> Option<f64> {
        if self.exact || self.known_noise.is_some() { None } else { fine_noise(&self.clean, self.step) }
    }

    fn turn(&mut self, by: usize) {
        self.turned = (self.turned + by) % self.clean.points.len();
        self.clean.points.rotate_left(by);
        self.weights.rotate_left(by);
    }

    /// The partition at the level `sigma`; a closed row is turned so that it begins where a part does.
    fn divide(&mut self, fewest: usize) {
        let penalty = penalty(self.weights.iter().sum(), self.sigma, fewest * self.step);
        self.parts = partition(&self.clean.points, &self.weights, &penalty);
        if self.clean.closed && self.parts.len() > 1 {
            self.turn(self.parts[self.parts.len() / 2].from);
            self.parts = partition(&self.clean.points, &self.weights, &penalty);
        }
    }

    /// The same row at finer levels, where short fits tell a noise below that about the chains found. Only the few
    /// different partitions are returned that may be cheapest.
    pub fn finer(&self, options: &Options, fine: Option<f64>, founds: &[Found]) -> VecDeque<Partition> {
        let n = self.clean.points.len();
        let share =
            if n <= SPARSE_ROW_POINTS { 1.0 } else { libm::exp(-FINER_LEVEL_CHANCE / (n as f64).sqrt()) };
        // Few points to a segment look like corners where there are none.
        let own = if founds.len() > 1 && n <= MAX_POINTS_WITH_FALSE_CORNERS { self.tangent() } else { None };
        let free = |_: &f64| options.continuity.is_none();
        let Some(fine) = fine.filter(free) else { return own.into_iter().collect() };
        if fine >= share * self.noise(founds) {
            return own.into_iter().collect();
        }
        let (bar, mut seen, mut all) = (self.cost(founds), vec![self.breaks()], vec![]);
        for fewest in [MIN_POINTS_PER_PART, MIN_POINTS_PER_PART_FINER] {
            let mut level = self.sigma;
            while level > (MIN_LEVEL_SHARE * fine).max(self.least) {
                level *= LEVEL_RATIO;
                let mut other = Partition { sigma: level.max(self.least), ..self.clone() };
                other.divide(fewest);
                let found = scatter(&other.clean.points, &other.weights, &other.parts).max(self.least);
                (other.own, other.sigma) = (found.min(self.own), found.min(self.sigma));
                let (breaks, least) = (other.breaks(), other.least_cost(found));
                if !seen.contains(&breaks) && least + FINER_LEVEL_COST_MARGIN < bar {
                    all.push((least, other));
                }
                seen.push(breaks);
            }
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.truncate(MAX_FINER_PARTITIONS);
        own.into_iter().chain(all.into_iter().map(|(_, partition)| partition)).collect()
    }

    /// The same parts as chains with corners between lines alone, where there are arcs that may be tangent to their
    /// neighbors. A join that the partition put a few points off looks like a corner.
    pub fn tangent(&self) -> Option<Partition> {
        let arcs = self.parts.iter().filter(|p| p.kind == SegmentKind::Arc).count();
        (arcs > 0 && !self.tangent && self.forced.is_none())
            .then(|| Partition { tangent: true, ..self.clone() })
    }

    /// The least cost of chains of the parts. Each would follow the part before with a common tangent, and scatter no
    /// more than it does by itself.
    fn least_cost(&self, scatter: f64) -> f64 {
        let each = |p: &Part| if p.kind == SegmentKind::Line { 1.0 } else { 2.0 };
        let unknowns = 2.0 + self.parts.iter().map(each).sum::<f64>();
        let spare = self.weights.iter().sum::<f64>() - unknowns;
        self.cost_of(scatter * scatter * spare.max(0.0), unknowns)
    }

    /// Where parts begin in the row as it came, and their kinds.
    fn breaks(&self) -> Vec<(usize, SegmentKind)> {
        let n = self.clean.points.len();
        let mut all: Vec<_> = self.parts.iter().map(|p| ((p.from + self.turned) % n, p.kind)).collect();
        all.sort_unstable();
        all
    }

    /// Standard deviation of the points about chains.
    fn noise(&self, founds: &[Found]) -> f64 {
        let spare = self.weights.iter().sum::<f64>() - founds.iter().map(Found::unknowns).sum::<f64>();
        (founds.iter().map(|f| f.state.sum).sum::<f64>() / spare.max(1.0)).sqrt()
    }

    /// The cost of chains, to compare chains of the same row: infinite where they are as many unknowns as points.
    pub fn cost(&self, founds: &[Found]) -> f64 {
        if founds.iter().any(|f| f.unreliable) {
            return f64::INFINITY;
        }
        let unknowns = founds.iter().map(Found::unknowns).sum::<f64>() + founds.len() as f64;
        self.cost_of(founds.iter().map(|f| f.state.sum).sum(), unknowns)
    }

    fn cost_of(&self, sum: f64, unknowns: f64) -> f64 {
        let count = self.weights.iter().sum::<f64>();
        let spare = count - unknowns - 2.0;
        if spare <= 0.0 {
            return f64::INFINITY;
        }
        let mean = sum / count + self.least * self.least;
        // Schwarz's penalty, or the one of Hurvich and Tsai where the points are few for so many unknowns.
        let correction = 2.0 * count * (unknowns + 1.0) / spare;
        count * libm::log(mean) + correction.max(unknowns * libm::log(count))
    }
}

/// Points of the short fits, and the degree of their polynomials.
const SHORT_FITS: [(usize, usize); 4] = [(3, 1), (4, 1), (4, 2), (5, 2)];

/// The least noise that short fits of points
/// `step` apart tell, by the lower quartile of each. A quarter of them holds no corner where segments have four points. `None`
/// in long rows, and in rows of too few points to tell.
fn fine_noise(clean: &Clean, step: usize) -> Option<f64> {
    let n = clean.points.len();
    if !(8 * step..=MAX_POINTS_OF_SHORT_FITS).contains(&n) || quantized(&clean.points) {
        return None;
    }
    SHORT_FITS
        .iter()
        .filter_map(|(count, degree)| {
            let starts = if clean.closed { n } else { n - (count - 1) * step };
            let window = |i: usize| (0..*count).map(|k| clean.points[(i + k * step) % n]).collect::<Vec<_>>();
            let mut all: Vec<f64> = (0..starts).filter_map(|i| off_polynomial(&window(i), *degree)).collect();
            all.sort_by(f64::total_cmp);
            // Lower quartile of a chi-squared variable of one or two degrees of freedom.
            let quartile = if count - degree == 2 { 0.1015 } else { 0.5754 };
            all.get(all.len() / 4).map(|x| (x / quartile).sqrt())
        })
        .min_by(f64::total_cmp)
}

/// Sum of squares of points about a polynomial, across the line through the first and last of them.
fn off_polynomial(points: &[[f64; 2]], degree: usize) -> Option<f64> {
    let (first, last) = (points.first()?, points.last()?);
    let d = [last[0] - first[0], last[1] - first[1]];
    let length = libm::hypot(d[0], d[1]);
    if length == 0.0 {
        return None;
    }
    let local = |p: &[f64; 2]| {
        let q = [p[0] - first[0], p[1] - first[1]];
        ((d[0] * q[0] + d[1] * q[1]) / (length * length), (d[0] * q[1] - d[1] * q[0]) / length)
    };
    let all: Vec<(f64, f64)> = points.iter().map(local).collect();
    // Gram and Schmidt.
    let mut rest: Vec<f64> = all.iter().map(|p| p.1).collect();
    let mut columns: Vec<Vec<f64>> = vec![];
    for k in 0..=degree {
        let mut column: Vec<f64> = all.iter().map(|p| p.0.powi(k as i32)).collect();
        for before in &columns {
            remove(&mut column, before);
        }
        let norm = column.iter().map(|x| x * x).sum::<f64>().sqrt();
        if norm < 1e-9 {
            return None;
        }
        column.iter_mut().for_each(|x| *x /= norm);
        remove(&mut rest, &column);
        columns.push(column);
    }
    Some(rest.iter().map(|r| r * r).sum())
}

/// Takes from a vector its part along a unit vector.
fn remove(from: &mut [f64], unit: &[f64]) {
    let dot: f64 = from.iter().zip(unit).map(|(a, b)| a * b).sum();
    from.iter_mut().zip(unit).for_each(|(a, b)| *a -= dot * b);
}

/// Short fits of rows of `n` points scatter. One row without form in a thousand has a noise of more than e^(this / √n)
/// times that of the short fits. That was found by trial, for 14 to 400 points.
const HIDDEN_FORM_CHANCE: f64 = 8.0;
/// Beyond that, and so many times the noise of short fits, form is hidden.
const MIN_HIDDEN_FORM_RATIO: f64 = 2.5;
/// Distances are no noise of which so large a share of the squares is of one period.
const MIN_PERIODIC_SHARE: f64 = 0.6;
/// Chance makes such distances so no more often than this.
const MAX_PERIODIC_CHANCE: f64 = 1e-5;

/// Segments whose scatter is form that is too short for the points to tell: the contour's noise is none.
pub(super) fn hidden(contour: &Contour, fine: f64) -> Vec<usize> {
    let n = contour.labels.len();
    let nothing = NEGLIGIBLE_OFFSET_SPACINGS * contour.spacing;
    let limit =
        MIN_HIDDEN_FORM_RATIO.max(libm::exp(HIDDEN_FORM_CHANCE / (n as f64).sqrt())) * fine.max(nothing);
    if contour.noise <= nothing || contour.noise <= limit && !is_periodic(&contour.residuals) {
        return vec![];
    }
    (0..contour.segments.len()).filter(|k| contour.segments[*k].rms > 0.5 * contour.noise).collect()
}

/// Whether most of the values is of one period, as where sides of a polygon are taken for a circle. (Fisher, Tests of
/// significance in harmonic analysis, Proceedings of the Royal Society A 125, 1929).
fn is_periodic(values: &[f64]) -> bool {
    let n = values.len();
    let whole: f64 = values.iter().map(|v| v * v).sum();
    let waves = n / 2;
    let share = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        let (mut a, mut b) = (0.0, 0.0);
        for (i, v) in values.iter().enumerate() {
            let (sin, cos) = libm::sincos(angle * i as f64);
            (a, b) = (a + v * cos, b + v * sin);
        }
        // The shortest wave is a cosine alone.
        (a * a + b * b) * if 2 * k == n { 1.0 } else { 2.0 } / n as f64 / whole.max(f64::MIN_POSITIVE)
    };
    let most = (1..=waves).map(share).fold(0.0, f64::max);
    most > MIN_PERIODIC_SHARE
        && waves as f64 * (1.0 - most).max(0.0).powi(waves as i32 - 1) < MAX_PERIODIC_CHANCE
}
