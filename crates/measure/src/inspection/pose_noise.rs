//! How the noise of what was measured moves the pose of its alignment, and with it what is given in the frame of the reference.
//!
//! A best fit answers to the noise of every point: to that of the points of the features in the very numbers that move these, as both are
//! of one scan; to that of all others by its covariance, from which numbers are drawn. An alignment by datums is done anew. A pose that
//! the plan gives, by itself or by pairs and reference points, has no noise: the plan says none of it.

use super::align::{Found, by_datums};
use super::data::Data;
use super::noise_field::{Field, Source, parts};
use super::stop::{NominalFault, Stop};
use super::{Alignment, MeasuredFeature};
use crate::plan::{Align, Noise, Plan};
use std::collections::{BTreeMap, HashSet};
use trueness_geom::align::{BestFit, Measured, Response, Target, response};
use trueness_geom::closest::Tree;
use trueness_geom::progress::Progress;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::{Point, Vector, dot, plus, times};

type Six = [f64; 6];

/// How the noise moves the pose.
pub(super) enum PoseNoise {
    /// Not at all, or it is not known.
    None,
    /// As the datums move it.
    Datums,
    /// As a best fit answers.
    Response(Box<Answer>),
}

/// The answer of a best fit to noise.
pub(super) struct Answer {
    center: Point,
    /// What the noise of the features is made of, and the answer to each.
    own: Vec<(Source, [Vector; 6])>,
    /// A root of the covariance of the answer to all other noise.
    rest: [Six; 6],
    sigma: f64,
}

impl PoseNoise {
    /// Of the alignment of `data`, which lie where it took them.
    pub fn new(
        plan: &Plan,
        noise: &Noise,
        (data, alignment): (&Data, &Alignment),
        features: &[MeasuredFeature],
        progress: &dyn Progress,
    ) -> Result<PoseNoise, Stop> {
        if matches!(plan.align, Align::Datum { .. }) {
            return Ok(PoseNoise::Datums);
        }
        let (Found::BestFit(fit), Some(measured), Some(reference)) =
            (&alignment.found, &data.measured, &data.reference)
        else {
            return Ok(PoseNoise::None);
        };
        let tree =
            Tree::build_watched(reference, progress).map_err(|e| Stop::Nominal(NominalFault::Search(e)))?;
        let options = BestFit { seed: data.seed, ..BestFit::default() };
        let found =
            response(&Measured::from(measured), &Target::new(reference, &tree), fit, &options, progress);
        let found = found.map_err(super::align::failed)?;
        let of_features = features.iter().flat_map(|f| &f.points);
        Ok(PoseNoise::Response(Box::new(Answer::new(&found, measured.points(), noise, of_features))))
    }

    /// The motion of the pose in a draw of the noise; `moved` are the features with their noise.
    pub fn motion(
        &self,
        plan: &Plan,
        field: Option<&Field>,
        moved: &[MeasuredFeature],
        progress: &dyn Progress,
    ) -> Result<Rigid, Stop> {
        match (self, &plan.align, field) {
            (PoseNoise::Datums, Align::Datum { datums, rule, span, .. }, _) => {
                by_datums(moved, datums, *rule, span, progress)
            }
            (PoseNoise::Response(answer), _, Some(field)) => Ok(answer.motion(field)),
            _ => Ok(Rigid::IDENTITY),
        }
    }
}

impl Answer {
    fn new<'a>(
        found: &Response,
        points: &[Point],
        noise: &Noise,
        of_features: impl Iterator<Item = &'a Point>,
    ) -> Answer {
        let sources = |p: &Point| {
            let (parts, count) = parts(p, noise);
            parts.into_iter().take(count)
        };
        let touched: HashSet<Source> = of_features.flat_map(|p| sources(p).map(|s| s.0)).collect();
        let mut own: BTreeMap<Source, [Vector; 6]> = BTreeMap::new();
        let mut others: BTreeMap<Source, [Vector; 6]> = BTreeMap::new();
        let mut covariance = [[0.0; 6]; 6];
        for (p, gain) in points.iter().zip(&found.gains) {
            for (source, weight) in sources(p) {
                let of = match (touched.contains(&source), noise.correlation > 0.0) {
                    (true, _) => &mut own,
                    (false, true) => &mut others,
                    // No other point has this noise.
                    (false, false) => {
                        add(&mut covariance, gain);
                        continue;
                    }
                };
                let sum = of.entry(source).or_insert([[0.0; 3]; 6]);
                for i in 0..6 {
                    sum[i] = plus(sum[i], times(weight, gain[i]));
                }
            }
        }
        others.values().for_each(|gain| add(&mut covariance, gain));
        Answer {
            center: found.center,
            own: own.into_iter().collect(),
            rest: root(covariance),
            sigma: noise.deviation,
        }
    }

    fn motion(&self, field: &Field) -> Rigid {
        let mut change = [0.0; 6];
        for (source, gain) in &self.own {
            let g = field.vector(*source);
            change = std::array::from_fn(|i| change[i] + dot(gain[i], g));
        }
        // No place and no corner of a cell has this number.
        let [a, b] = [0, 1].map(|k| field.vector([1 << 63, k, 0]));
        let g = [a[0], a[1], a[2], b[0], b[1], b[2]];
        let rest = |i: usize| (0..6).map(|k| self.rest[i][k] * g[k]).sum::<f64>();
        Response::motion(self.center, std::array::from_fn(|i| self.sigma * (change[i] + rest(i))))
    }
}

fn add(covariance: &mut [Six; 6], gain: &[Vector; 6]) {
    for (row, a) in covariance.iter_mut().zip(gain) {
        for (entry, b) in row.iter_mut().zip(gain) {
            *entry += dot(*a, *b);
        }
    }
}

/// The lower triangular root of a symmetric positive semidefinite matrix (Cholesky); zero where it is singular.
fn root(a: [Six; 6]) -> [Six; 6] {
    let mut l = [[0.0; 6]; 6];
    for j in 0..6 {
        let left = a[j][j] - (0..j).map(|k| l[j][k] * l[j][k]).sum::<f64>();
        if left <= 1e-14 * a[j][j] {
            continue;
        }
        l[j][j] = left.sqrt();
        for i in j + 1..6 {
            l[i][j] = (a[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>()) / l[j][j];
        }
    }
    l
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some places with gains of a fit.
    fn fitted() -> (Vec<Point>, Response) {
        let mut random = trueness_geom::num::random::Random::new(3);
        let mut three = |size: f64| -> Vector { std::array::from_fn(|_| size * (random.unit() - 0.5)) };
        let points: Vec<Point> = (0..40).map(|_| three(9.0)).collect();
        let gains = points.iter().map(|_| std::array::from_fn(|_| three(0.1))).collect();
        (points, Response { gains, center: [1.0, 2.0, 3.0] })
    }

    /// The change of the pose by the noise of every point, summed up one by one.
    fn direct(points: &[Point], found: &Response, field: &mut Field) -> Six {
        let mut change = [0.0; 6];
        for (p, gain) in points.iter().zip(&found.gains) {
            let moved = field.at(p);
            change = std::array::from_fn(|i| change[i] + dot(gain[i], moved));
        }
        change
    }

    /// Where all points are of features, the pose moves by the noise of these very points: draw by draw, to rounding.
    #[test]
    fn the_pose_moves_with_the_noise_of_the_points() {
        let (points, found) = fitted();
        for correlation in [0.0, 2.5] {
            let noise = Noise { deviation: 0.01, correlation, white: 0.0, draws: 1 };
            let answer = Answer::new(&found, &points, &noise, points.iter());
            for draw in 0..20 {
                let estimated = answer.motion(&Field::new(&noise, draw));
                let wanted = direct(&points, &found, &mut Field::new(&noise, draw));
                let wanted = Response::motion(found.center, wanted);
                for p in &points {
                    let off = plus(estimated.point(*p), times(-1.0, wanted.point(*p)));
                    assert!(dot(off, off).sqrt() < 1e-12, "{correlation}: {off:?}");
                }
            }
        }
    }

    /// Noise of points that are of no feature, or of half of them: the spread of the pose is that of the sums, within what 4,000 draws tell.
    #[test]
    fn what_is_of_no_feature_moves_the_pose_as_far() {
        let (points, found) = fitted();
        for (correlation, touched) in [(0.0, 0), (0.0, 20), (2.5, 0), (2.5, 20)] {
            let noise = Noise { deviation: 0.01, correlation, white: 0.0, draws: 1 };
            let answer = Answer::new(&found, &points, &noise, points[..touched].iter());
            let (mut estimated, mut wanted) = ([0.0; 3], [0.0; 3]);
            for draw in 0..4000 {
                let moved = answer.motion(&Field::new(&noise, draw)).point(found.center);
                let sums = direct(&points, &found, &mut Field::new(&noise, 10_000 + draw));
                for k in 0..3 {
                    estimated[k] += (moved[k] - found.center[k]).powi(2);
                    wanted[k] += sums[3 + k].powi(2);
                }
            }
            for k in 0..3 {
                let ratio = (estimated[k] / wanted[k]).sqrt();
                assert!((ratio - 1.0).abs() < 0.06, "{correlation} {touched}: {ratio}");
            }
        }
    }

    #[test]
    fn the_root_makes_the_matrix() {
        let b: [Six; 6] =
            std::array::from_fn(|i| std::array::from_fn(|j| ((7 * i + 3 * j * j + 1) % 11) as f64 - 4.0));
        // The last direction is a sum of two others: the matrix is singular.
        let b: [Six; 6] = std::array::from_fn(|i| match i {
            5 => std::array::from_fn(|j| b[0][j] + b[3][j]),
            _ => b[i],
        });
        let product = |a: &[Six; 6], i: usize, j: usize| (0..6).map(|k| a[i][k] * a[j][k]).sum::<f64>();
        let a: [Six; 6] = std::array::from_fn(|i| std::array::from_fn(|j| product(&b, i, j)));
        let l = root(a);
        for (i, row) in a.iter().enumerate() {
            for (j, wanted) in row.iter().enumerate() {
                assert!((product(&l, i, j) - wanted).abs() < 1e-9, "{i} {j}");
            }
        }
    }
}
