//! Alignment by places that belong together: pairs of points, or rows. A row has a measured point, its nominal place and the
//! direction in which it is held, as in 3-2-1 and reference point systems.

use super::alignment::POOR_RESIDUAL_SHARE;
use super::icp::moved;
use super::system::{Constraint, Equation, SixBySix, Spectrum, System, eigen_six, slope};
use super::{AlignError, AlignWarning};
use crate::closest::check_points;
use crate::rigid::Rigid;
use crate::space::{Aabb, Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// One row of a reference point system: the measured point is to lie in the plane through `nominal` across `direction`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Measured, in its own frame, millimeters.
    pub measured: Point,
    /// Where it should be, in the frame of the reference.
    pub nominal: Point,
    /// The direction in which it is held, of any length, in the frame of the reference.
    pub direction: Vector,
    /// Its weight: greater than that of others means held better. All alike for 3-2-1.
    pub weight: f64,
}

/// An alignment by rows or pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct RowFit {
    /// Takes measured coordinates to those of the reference.
    pub reference_from_measured: Rigid,
    /// The distance left along the direction of each row, signed; for pairs the distance left.
    pub residuals: Vec<f64>,
    /// The change of the pose per millimeter of error in each row that is held along a direction. It is a rotation vector about
    /// `center` (radians per millimeter) and a translation; pairs have none.
    pub gains: Vec<[f64; 6]>,
    /// Center of those rotation vectors, in the frame of the reference.
    pub center: Point,
    /// Root of their weighted mean square.
    pub rms: f64,
    /// Steps taken.
    pub iterations: usize,
    /// Whether the steps settled.
    pub converged: bool,
    /// Warnings about the alignment.
    pub warnings: Vec<AlignWarning>,
}

impl RowFit {
    /// For each row, how far a millimeter of error in it moves the corner that it moves farthest, in millimeters. It is the
    /// column of the inverse of the equations (JCGM 102:2011, 6.2). From [`MIN_AMPLIFICATION`] on the places of the rows lie
    /// too near to a line, or to each other, for the part.
    pub fn amplifications(&self, corners: &[Point]) -> Vec<f64> {
        let of = |gain: &[f64; 6]| {
            let [a, b, c, x, y, z] = *gain;
            let moves = |p: &Point| norm(plus([x, y, z], cross([a, b, c], minus(*p, self.center))));
            corners.iter().map(moves).fold(0.0, f64::max)
        };
        self.gains.iter().map(of).collect()
    }
}

/// Millimeters that a corner moves per millimeter of error from which on a warning says so. A part ten times as long as its
/// places lie apart does not lie where the places say, for all practical purposes.
pub const MIN_AMPLIFICATION: f64 = 10.0;

/// The motion that brings `measured[i]` nearest to `reference[i]`, by the least weighted sum of squared distances.
///
/// Closed form by unit quaternions: Horn, Closed-form solution of absolute orientation using unit quaternions, J. Opt.
/// Soc. Am. A 4, 1987. A mirror image is never taken for a rotation. Without `weights` all count alike.
///
/// # Errors
/// [`AlignError::Uneven`], [`AlignError::TooFewPoints`] below three, [`AlignError::Collinear`], [`AlignError::BadWeight`], [`AlignError::NoWeight`],
/// [`AlignError::Point`] for a coordinate that is no number.
///
/// ```
/// use trueness_geom::{align::pairs, rigid::Rigid};
/// let measured = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 20.0, 0.0]];
/// let turn = Rigid::rotation_about([1.0, 1.0, 1.0], [2.0, 0.5, 0.0]);
/// let fit = pairs(&measured, &measured.map(|p| turn.point(p)), None)?;
/// assert!(fit.rms < 1e-14);
/// # Ok::<(), trueness_geom::align::AlignError>(())
/// ```
pub fn pairs(measured: &[Point], reference: &[Point], weights: Option<&[f64]>) -> Result<RowFit, AlignError> {
    let uneven = |what, found| Err(AlignError::Uneven { what, expected: measured.len(), found });
    if measured.len() != reference.len() {
        return uneven("points of the reference", reference.len());
    }
    if let Some(w) = weights
        && w.len() != measured.len()
    {
        return uneven("weights", w.len());
    }
    check_points(measured)?;
    check_points(reference)?;
    let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
    let total = checked_weights(measured.len(), &weight)?;
    let there = (0..measured.len()).filter(|&i| weight(i) > 0.0).count();
    if there < 3 {
        return Err(AlignError::TooFewPoints { needed: 3, found: there });
    }
    let fit = |measured: &[Point]| nearest(measured, reference, &weight, total);
    let Some((motion, residuals)) = fit(measured) else { return Err(AlignError::Collinear) };
    let left = |residuals: &[f64]| mean_square(residuals, &weight, total).sqrt();
    let rms = left(&residuals);
    let mut poor = poor([measured, reference], &residuals, &weight, rms);
    if let Some(AlignWarning::PoorRows { mirrored, .. }) = &mut poor {
        let image: Vec<Point> = measured.iter().map(|[x, y, z]| [-x, *y, *z]).collect();
        *mirrored = fit(&image).is_some_and(|(_, residuals)| left(&residuals) < MIRROR_RMS_RATIO * rms);
    }
    let warnings = poor.into_iter().collect();
    Ok(RowFit {
        reference_from_measured: motion,
        residuals,
        gains: vec![],
        center: [0.0; 3],
        rms,
        iterations: 1,
        converged: true,
        warnings,
    })
}

/// Root mean square residual of a mirror image over that of pairs or a best fit, below which they look mirrored.
pub(super) const MIRROR_RMS_RATIO: f64 = 0.5;

/// The motion of the least weighted sum of squares and the distances that it leaves; `None` where another does as well.
fn nearest(
    measured: &[Point],
    reference: &[Point],
    weight: &impl Fn(usize) -> f64,
    total: f64,
) -> Option<(Rigid, Vec<f64>)> {
    let mean = |p: &[Point]| (0..p.len()).fold([0.0; 3], |s, i| plus(s, times(weight(i) / total, p[i])));
    let (from, to) = (mean(measured), mean(reference));
    // Correlation of the centered points: s[a][b] = Σ w p_a q_b.
    let mut s = [[0.0; 3]; 3];
    for i in 0..measured.len() {
        let (p, q) = (minus(measured[i], from), minus(reference[i], to));
        for a in 0..3 {
            for b in 0..3 {
                s[a][b] += weight(i) / total * p[a] * q[b];
            }
        }
    }
    let (rows, certain) = quaternion_rotation(&s);
    if !certain {
        return None;
    }
    let motion = Rigid::of_rotation(rows, from, to);
    let distances = measured.iter().zip(reference).map(|(p, q)| norm(minus(motion.point(*p), *q)));
    Some((motion, distances.collect()))
}

/// Told of rows of which much is left for the size of their places, the measured and those of the reference.
fn poor(
    places: [&[Point]; 2],
    residuals: &[f64],
    weight: &impl Fn(usize) -> f64,
    rms: f64,
) -> Option<AlignWarning> {
    let counts: Vec<usize> = (0..residuals.len()).filter(|&i| weight(i) > 0.0).collect();
    let [a, b] = places.map(|p| Aabb::of(counts.iter().map(|&i| &p[i])).diagonal());
    let share = rms / a.min(b);
    let row = counts.into_iter().max_by(|&i, &j| residuals[i].abs().total_cmp(&residuals[j].abs()))?;
    let residual = residuals[row].abs();
    (share > POOR_RESIDUAL_SHARE).then_some(AlignWarning::PoorRows { share, row, residual, mirrored: false })
}

/// The rotation of greatest `Σ s_ab R_ba`, and whether no other does as well.
fn quaternion_rotation(s: &[[f64; 3]; 3]) -> ([Vector; 3], bool) {
    let trace = s[0][0] + s[1][1] + s[2][2];
    let skew = [s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]];
    let size = s.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    let mut n: SixBySix = [[0.0; 6]; 6];
    n[0][0] = trace;
    for a in 0..3 {
        (n[0][a + 1], n[a + 1][0]) = (skew[a], skew[a]);
        for b in 0..3 {
            n[a + 1][b + 1] = s[a][b] + s[b][a] - if a == b { trace } else { 0.0 };
        }
    }
    // The two rows that Horn's matrix does not have stand below all its eigenvalues.
    (n[4][4], n[5][5]) = (-16.0 * size, -16.0 * size);
    let (values, vectors) = eigen_six(&n);
    let [w, x, y, z, ..] = vectors[5];
    let rows = [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ];
    (rows, size > 0.0 && values[5] - values[4] > 1e-12 * size)
}

/// Steps after which rows count as not settling.
const MAX_ROW_STEPS: usize = 100;

/// The motion that brings the measured point of every row into the plane across its direction. Six rows that hold all six
/// freedoms are met exactly (3-2-1), more by the least weighted sum of squares (RPS). A point held in two or three directions
/// has as many rows.
///
/// It starts from `start`, or from the points taken as pairs; the planes are few, so a start far off may lead to another
/// solution. Steps of Gauss and Newton.
///
/// # Errors
/// [`AlignError::TooFewPoints`] below six rows; [`AlignError::Underdetermined`] names how many freedoms stay open;
/// [`AlignError::NoDirection`], [`AlignError::BadWeight`], [`AlignError::NoWeight`], [`AlignError::Point`]; those of [`pairs`] without a start.
///
/// ```
/// use trueness_geom::{align::{constrained, Row}, rigid::Rigid};
/// // Three points hold z, two hold y, one holds x.
/// let held = [
///     ([0.0, 0.0, 0.0], 2), ([80.0, 0.0, 0.0], 2), ([0.0, 50.0, 0.0], 2),
///     ([10.0, 0.0, 8.0], 1), ([70.0, 0.0, 8.0], 1), ([0.0, 25.0, 8.0], 0),
/// ];
/// let turn = Rigid::rotation_about([0.0; 3], [0.3, -0.2, 1.0]);
/// let rows = held.map(|(nominal, axis)| {
///     let mut direction = [0.0; 3];
///     direction[axis] = 1.0;
///     Row { measured: turn.point(nominal), nominal, direction, weight: 1.0 }
/// });
/// let fit = constrained(&rows, None)?;
/// assert!(fit.converged && fit.rms < 1e-13);
/// assert!(fit.reference_from_measured.after(&turn).angle() < 1e-14);
/// # Ok::<(), trueness_geom::align::AlignError>(())
/// ```
pub fn constrained(rows: &[Row], start: Option<Rigid>) -> Result<RowFit, AlignError> {
    let measured: Vec<Point> = rows.iter().map(|r| r.measured).collect();
    let nominal: Vec<Point> = rows.iter().map(|r| r.nominal).collect();
    check_points(&measured)?;
    check_points(&nominal)?;
    if rows.len() < 6 {
        return Err(AlignError::TooFewPoints { needed: 6, found: rows.len() });
    }
    let weight = |i: usize| rows[i].weight;
    let total = checked_weights(rows.len(), &weight)?;
    let held: Result<Vec<Vector>, AlignError> = rows
        .iter()
        .enumerate()
        .map(|(row, r)| unit(r.direction).map(|d| d.0).ok_or(AlignError::NoDirection { row }))
        .collect();
    let held = held?;
    let mut pose = match start {
        Some(pose) => pose,
        None => pairs(&measured, &nominal, None)?.reference_from_measured,
    };
    let middle = times(1.0 / rows.len() as f64, nominal.iter().fold([0.0; 3], |s, p| plus(s, *p)));
    let radius = nominal.iter().map(|p| norm(minus(*p, middle))).fold(0.0, f64::max);
    let residual = |pose: &Rigid, i: usize| dot(held[i], minus(pose.point(measured[i]), nominal[i]));
    let size = nominal.iter().flatten().fold(radius, |m, x| m.max(x.abs()));
    let (mut iterations, mut converged) = (0, false);
    while iterations < MAX_ROW_STEPS && !converged {
        let equation = |i: usize| Equation {
            point: pose.point(measured[i]),
            away: minus(pose.point(measured[i]), nominal[i]),
            hold: Constraint::Plane(held[i]),
            weight: weight(i),
        };
        let numbers: Vec<usize> = (0..rows.len()).collect();
        let system = System::new(&numbers, |i| equation(*i), middle, radius);
        let spectrum = Spectrum::of(&system);
        if spectrum.fixed > 0 {
            return Err(AlignError::Underdetermined { free: spectrum.fixed });
        }
        let step = spectrum.solve(&system.right, 0);
        pose = moved(&system, &step).after(&pose);
        iterations += 1;
        converged = step.iter().all(|x| x.abs() <= 8.0 * f64::EPSILON * size);
    }
    let residuals: Vec<f64> = (0..rows.len()).map(|i| residual(&pose, i)).collect();
    let gains = gains(rows, &held, &pose, middle, radius);
    let rms = mean_square(&residuals, &weight, total).sqrt();
    let settled = (!converged).then_some(AlignWarning::NotConverged);
    let warnings = poor([&measured, &nominal], &residuals, &weight, rms).into_iter().chain(settled).collect();
    Ok(RowFit {
        reference_from_measured: pose,
        residuals,
        gains,
        center: middle,
        rms,
        iterations,
        converged,
        warnings,
    })
}

/// The change of the pose per error of each row at `pose`.
fn gains(rows: &[Row], held: &[Vector], pose: &Rigid, center: Point, radius: f64) -> Vec<[f64; 6]> {
    let equation = |i: usize| Equation {
        point: pose.point(rows[i].measured),
        away: [0.0; 3],
        hold: Constraint::Plane(held[i]),
        weight: rows[i].weight,
    };
    let numbers: Vec<usize> = (0..rows.len()).collect();
    let spectrum = Spectrum::of(&System::new(&numbers, |i| equation(*i), center, radius));
    let gain = |i: usize| {
        let row = slope(equation(i).point, held[i], center, radius);
        let step = spectrum.solve(&row.map(|x| -rows[i].weight * x), 0);
        std::array::from_fn(|k| if k < 3 { step[k] / radius } else { step[k] })
    };
    numbers.into_iter().map(gain).collect()
}

/// The sum of the weights, each of which must be a number from 0 upwards, and not all of them 0.
fn checked_weights(count: usize, weight: &impl Fn(usize) -> f64) -> Result<f64, AlignError> {
    match (0..count).find(|&i| !(weight(i) >= 0.0 && weight(i).is_finite())) {
        Some(row) => Err(AlignError::BadWeight { row }),
        None => {
            let total: f64 = (0..count).map(weight).sum();
            if total > 0.0 { Ok(total) } else { Err(AlignError::NoWeight) }
        }
    }
}

fn mean_square(residuals: &[f64], weight: &impl Fn(usize) -> f64, total: f64) -> f64 {
    residuals.iter().enumerate().map(|(i, r)| weight(i) * r * r).sum::<f64>() / total
}
