//! The freedom that the shape leaves: a plane slides, a cylinder spins, a sphere turns every way.

use super::AlignError;
use super::icp::{Match, Problem, moved};
use super::system::{Six, SixBySix, Spectrum, System, eigen_six, slope};
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, cross, dot, minus, plus, times, unit};
use std::collections::BTreeMap;

/// A motion that changes nothing in how the measured fits the reference; in the frame of the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Freedom {
    /// It slides along this unit direction.
    Slides {
        /// Where to.
        direction: Vector,
    },
    /// It turns about an axis.
    Turns {
        /// A place on the axis, millimeters.
        point: Point,
        /// Unit direction of the axis.
        direction: Vector,
    },
}

/// Mean square displacement along the facets' normals per unit of mean square displacement, above which a motion is held.
const HELD: f64 = 0.02;
/// Share of the radius by which the others are tried, and the distance per way up to which they are free: a cylinder of
/// facets holds its rotation by its edges, but only until the next facet.
const TRIED: f64 = 0.05;
const BARELY: f64 = 0.02;

/// Number of directions of the spectrum, from the least, that are free at `pose`.
pub(super) fn count(
    problem: &Problem,
    system: &System,
    spectrum: &Spectrum,
    pose: &Rigid,
    progress: &dyn Progress,
) -> Result<usize, AlignError> {
    let step = TRIED * system.radius;
    let mut here = None;
    for k in 0..6 {
        let share = spectrum.values[k] / system.weight;
        if share >= HELD {
            return Ok(k);
        }
        let at_pose = match here {
            Some(x) => x,
            None => *here.insert(mean_square(problem, pose, step, progress)?),
        };
        for sign in [-1.0, 1.0] {
            let motion = moved(system, &spectrum.vectors[k].map(|x| sign * step * x));
            let there = mean_square(problem, &motion.after(pose), step, progress)?;
            if (there - at_pose).max(0.0).sqrt() > BARELY * step {
                return Ok(k);
            }
        }
    }
    Ok(6)
}

/// Distances from which on none counts for more where it is asked how far a pose may move, in standard deviations.
const CAP: f64 = 6.0;
/// How often the interval in which a motion begins to cost is halved.
const HALVINGS: usize = 8;

/// The motions that facets hardly hold though they are not free, unit directions of the spectrum, each with how far the pose may move along
/// it, to the side where it may move farther, until the likelihood falls by the factor of one standard deviation. Points of a single face
/// are held by its rim: those that lie beyond it, and only once they do. The equations at the pose know of the few that do there, or of none.
pub(super) fn barely_held(
    problem: &Problem,
    system: &System,
    (facets, spectrum): (&System, &Spectrum),
    free: usize,
    pose: &Rigid,
    progress: &dyn Progress,
) -> Result<Vec<(Six, f64)>, AlignError> {
    let hardly = |k: &usize| spectrum.values[*k] / facets.weight < HELD;
    let directions: Vec<usize> = (free..6).take_while(hardly).collect();
    let (sigma, count) = (system.rms(), system.count());
    if directions.is_empty() || sigma <= problem.rounding {
        return Ok(vec![]);
    }
    let cap = CAP * sigma;
    let least = problem.cost(pose, cap, progress)?;
    let most = TRIED * facets.radius;
    let mut all = vec![];
    for k in directions {
        let mut widest = 0.0_f64;
        for sign in [-1.0, 1.0] {
            let costs = |way: f64| -> Result<bool, AlignError> {
                let motion = moved(facets, &spectrum.vectors[k].map(|x| sign * way * x));
                Ok(count * (problem.cost(&motion.after(pose), cap, progress)? - least) > sigma * sigma)
            };
            let (mut low, mut high) = (0.0, (sigma / count.sqrt()).max(problem.rounding));
            while high < most && !costs(high)? {
                (low, high) = (high, 2.0 * high);
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if costs(middle)? { high = middle } else { low = middle }
            }
            widest = widest.max(high);
        }
        all.push((spectrum.vectors[k], widest));
    }
    Ok(all)
}

/// Mean square distance of the samples that have a place within `reach`.
fn mean_square(
    problem: &Problem,
    pose: &Rigid,
    reach: f64,
    progress: &dyn Progress,
) -> Result<f64, AlignError> {
    let matches = problem.matches(pose, reach, progress)?;
    let there = matches.iter().filter(|m| m.distance.is_finite());
    let (sum, weight) = there.fold((0.0, 0.0), |(s, w), m| {
        (s + m.equation.weight * m.distance * m.distance, w + m.equation.weight)
    });
    Ok(if weight > 0.0 { sum / weight } else { reach * reach })
}

/// The motions that the first `free` directions of the spectrum span: slides first, then turns.
pub(super) fn named(system: &System, spectrum: &Spectrum, free: usize) -> Vec<Freedom> {
    // Combinations without rotation: the null space of the Gram matrix of the rotations.
    let turn = |k: usize| -> Vector { std::array::from_fn(|i| spectrum.vectors[k][i]) };
    let shift = |k: usize| -> Vector { std::array::from_fn(|i| spectrum.vectors[k][i + 3]) };
    let mut gram: SixBySix = [[0.0; 6]; 6];
    for i in 0..6 {
        for j in 0..6 {
            gram[i][j] = match i < free && j < free {
                true => dot(turn(i), turn(j)),
                // The others stand last.
                false => f64::from(u8::from(i == j)) * 4.0,
            };
        }
    }
    let (values, rows) = eigen_six(&gram);
    let combined = |row: &Six, of: &dyn Fn(usize) -> Vector| {
        (0..free).fold([0.0; 3], |s, k| plus(s, times(row[k], of(k))))
    };
    let slides: Vec<Vector> = (0..free)
        .filter(|&k| values[k] < 0.01)
        .filter_map(|k| unit(combined(&rows[k], &shift)).map(|u| u.0))
        .collect();
    let mut found: Vec<Freedom> =
        slides.iter().map(|&direction| Freedom::Slides { direction: forward(direction) }).collect();
    for row in (0..free).filter(|&k| values[k] >= 0.01).map(|k| &rows[k]) {
        let omega = times(1.0 / system.radius, combined(row, &turn));
        let t = slides.iter().fold(combined(row, &shift), |t, s| minus(t, times(dot(t, *s), *s)));
        let Some((direction, size)) = unit(omega) else { continue };
        let point = plus(system.center, times(1.0 / (size * size), cross(omega, t)));
        found.push(Freedom::Turns { point, direction: forward(direction) });
    }
    found
}

/// The direction whose component of largest magnitude is positive.
fn forward(d: Vector) -> Vector {
    let largest = (0..3).max_by(|&i, &j| d[i].abs().total_cmp(&d[j].abs())).unwrap_or(0);
    times(1f64.copysign(d[largest]), d)
}

/// Cells along the radius within which residuals may go together.
const CELLS: f64 = 4.0;
/// Matches added in one go: sums do not depend on the number of threads.
const CHUNK: usize = 1 << 16;

/// Covariance of the six unknowns (rotation vector about the center of the system, radians; translation, mm), none along
/// the first `free` directions; along those that are `barely` held at least as uncertain as how far they may move.
///
/// Residuals of a part go together over some distance: form deviations and a scanner's errors are waves. Samples of one
/// cell of space are therefore taken for one observation (cluster-robust covariance: Liang, Zeger, Longitudinal data
/// analysis using generalized linear models, Biometrika 73, 1986): right for independent residuals as well as for
/// correlated ones, as long as their range is below the cells' size, a quarter of the points' radius.
pub(super) fn covariance(
    system: &System,
    spectrum: &Spectrum,
    matches: &[Match],
    free: usize,
    barely: &[(Six, f64)],
) -> SixBySix {
    let part = |matches: &[Match]| {
        let mut cells: BTreeMap<[i64; 3], Six> = BTreeMap::new();
        for m in matches.iter().filter(|m| m.equation.weight > 0.0) {
            let e = &m.equation;
            let key = minus(e.point, system.center).map(|x| (x * CELLS / system.radius).floor() as i64);
            let row = slope(e.point, e.away, system.center, system.radius);
            let sum = cells.entry(key).or_insert([0.0; 6]);
            for i in 0..6 {
                sum[i] += e.weight * row[i];
            }
        }
        cells
    };
    let parts: Vec<BTreeMap<[i64; 3], Six>> = matches.par_chunks(CHUNK).map(part).collect();
    let mut cells: BTreeMap<[i64; 3], Six> = BTreeMap::new();
    for (key, row) in parts.into_iter().flatten() {
        let sum = cells.entry(key).or_insert([0.0; 6]);
        for i in 0..6 {
            sum[i] += row[i];
        }
    }
    let mut middle = [[0.0; 6]; 6];
    for g in cells.values() {
        for i in 0..6 {
            for j in 0..6 {
                middle[i][j] += g[i] * g[j];
            }
        }
    }
    let count = cells.len() as f64;
    let few = count / (count - 6.0).max(1.0);
    let mut out = spectrum.sandwich(&middle, free);
    let along = |m: &SixBySix, v: &Six| -> f64 {
        (0..6).flat_map(|i| (0..6).map(move |j| (i, j))).map(|(i, j)| v[i] * m[i][j] * v[j]).sum()
    };
    if !barely.is_empty() {
        // How many times the variance is that of independent residuals, along what is held well.
        let alone =
            |k: usize| system.rms() * system.rms() / system.count() * system.weight / spectrum.values[k];
        let held = (free..6).filter(|&k| spectrum.values[k] >= HELD * system.weight);
        let ratios: Vec<f64> = held.map(|k| along(&out, &spectrum.vectors[k]) / alone(k)).collect();
        let together = (ratios.iter().sum::<f64>() / ratios.len().max(1) as f64).max(1.0);
        for (v, way) in barely {
            let more = (together * way * way - along(&out, v)).max(0.0);
            for i in 0..6 {
                for j in 0..6 {
                    out[i][j] += more * v[i] * v[j];
                }
            }
        }
    }
    let unit = |k: usize| if k < 3 { 1.0 / system.radius } else { 1.0 };
    for i in 0..6 {
        for j in 0..6 {
            out[i][j] *= few * unit(i) * unit(j);
        }
    }
    out
}
