//! The covariance of all lines and arcs of a contour, from their points and tangent joins.
//!
//! Each line or arc is known by the normal equations of its own points. A tangent join is a condition on the two beside
//! it, to first order linear, and is put in as such. The covariance becomes `C − C Aᵀ (A C Aᵀ)⁻¹ A C`, where
//! `C` is the one without it. Chains between corners are independent. The `Uncertainty` of a segment in the contour
//! also holds the rest that its fit takes into account. The covariance is scaled to agree with that.

use super::offer::Untidied;
use crate::model::result::{Continuity, Contour, Geometry, RowKind, Uncertainty};
use trueness_geom::num::cholesky::Cholesky;

/// Segments of a tangent chain whose covariance is still found.
const MAX_SEGMENTS_OF_CHAIN: usize = 200;
/// Share of the normal equations' scale that holds what the points alone do not hold: tangent joins must.
const HOLDING_WEIGHT: f64 = 1e-10;
/// A condition holds already where its variance is this share of that of its unknowns by themselves.
const HOLDS_ALREADY_VARIANCE: f64 = 1e-14;

/// A line, by a place of it and its angle, or a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// A line through the middle of its points.
    Line {
        /// That middle.
        place: [f64; 2],
        /// Angle with the first axis.
        angle: f64,
    },
    /// The circle of an arc.
    Arc {
        /// Its center.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
    },
}

impl Shape {
    fn unknowns(&self) -> usize {
        match self {
            Shape::Line { .. } => 2,
            Shape::Arc { .. } => 3,
        }
    }

    /// The same with one of its unknowns moved: of a line angle and place across, of a circle center and radius.
    fn moved(self, unknown: usize, by: f64) -> Shape {
        match self {
            Shape::Line { place, angle } if unknown == 0 => Shape::Line { place, angle: angle + by },
            Shape::Line { place, angle } => {
                let (sin, cos) = libm::sincos(angle);
                Shape::Line { place: [place[0] - by * sin, place[1] + by * cos], angle }
            }
            Shape::Arc { center, radius } if unknown == 2 => Shape::Arc { center, radius: radius + by },
            Shape::Arc { mut center, radius } => {
                center[unknown] += by;
                Shape::Arc { center, radius }
            }
        }
    }

    /// How the distance of a point grows with each unknown, but for the sign.
    fn slopes(&self, p: [f64; 2]) -> [f64; 3] {
        match self {
            Shape::Line { place, angle } => {
                let (sin, cos) = libm::sincos(*angle);
                [cos * (p[0] - place[0]) + sin * (p[1] - place[1]), 1.0, 0.0]
            }
            Shape::Arc { center, .. } => {
                let d = [p[0] - center[0], p[1] - center[1]];
                let far = libm::hypot(d[0], d[1]).max(f64::MIN_POSITIVE);
                [d[0] / far, d[1] / far, 1.0]
            }
        }
    }
}

/// The lines and arcs of a contour with their covariance.
#[derive(Debug)]
pub(super) struct Spread {
    /// The line or circle of each segment; none for splines, unreliable segments, and those without uncertainty.
    pub shapes: Vec<Option<Shape>>,
    /// Degrees of freedom of the noise.
    pub degrees: f64,
    /// The chain of each segment, and where its unknowns begin.
    places: Vec<(usize, usize)>,
    /// Covariance of the unknowns of each chain.
    chains: Vec<(usize, Vec<f64>)>,
    /// A length of the contour's size, for steps.
    size: f64,
}

impl Spread {
    pub fn new(contour: &Contour, row: &[[f64; 2]]) -> Result<Spread, Untidied> {
        if contour.row_kind == RowKind::Facets {
            return Err(Untidied::Exact);
        }
        let points = own_points(contour, row);
        let all: Vec<Option<Shape>> =
            (0..contour.segments.len()).map(|k| shape(contour, k, &points[k])).collect();
        let known = |k: usize| contour.segments[k].uncertainty.is_some() && !contour.unreliable.contains(&k);
        if !(0..all.len()).any(|k| known(k) && all[k].is_some()) {
            return Err(Untidied::Unknown);
        }
        let kept = points.iter().map(Vec::len).sum::<usize>() as f64;
        let mut spread = Spread {
            shapes: all.clone(),
            degrees: (kept - contour.unknowns).max(1.0),
            places: vec![(0, 0); all.len()],
            chains: vec![],
            size: contour.segments.iter().map(|s| s.length).sum::<f64>(),
        };
        for chain in chains(contour, &all) {
            if chain.len() > MAX_SEGMENTS_OF_CHAIN {
                return Err(Untidied::TooMany);
            }
            spread.add(contour, &chain, &points);
        }
        spread.agree_with_told(contour);
        for k in 0..all.len() {
            spread.shapes[k] = all[k].filter(|_| known(k));
        }
        Ok(spread)
    }

    /// Adds the covariance of a chain.
    fn add(&mut self, contour: &Contour, chain: &[usize], points: &[Vec<[f64; 2]>]) {
        let mut n = 0;
        for k in chain {
            self.places[*k] = (self.chains.len(), n);
            n += self.shapes[*k].map_or(0, |s| s.unknowns());
        }
        let mut covariance = vec![0.0; n * n];
        for k in chain {
            let Some(shape) = self.shapes[*k] else { continue };
            let at = self.places[*k].1;
            let own = alone(&shape, &points[*k], self.size);
            let m = shape.unknowns();
            for i in 0..m {
                for j in 0..m {
                    covariance[(at + i) * n + at + j] = own[i][j];
                }
            }
        }
        self.chains.push((n, covariance));
        for k in chain {
            let next = (k + 1) % contour.segments.len();
            let tangent = contour.joins.get(*k).is_some_and(|j| j.continuity != Continuity::G0);
            if tangent && next != *k && chain.contains(&next) {
                let same = turns_alike(contour, *k, next);
                self.hold(&[*k, next], &|s| off_tangent([s[0], s[1]], same));
            }
        }
        let variance = contour.noise * contour.noise;
        if let Some((_, covariance)) = self.chains.last_mut() {
            covariance.iter_mut().for_each(|x| *x *= variance);
        }
    }

    /// Puts a condition on segments of the last chain into its covariance.
    fn hold(&mut self, of: &[usize], condition: &dyn Fn(&[Shape]) -> f64) {
        let Some(slopes) = self.slopes(of, condition) else { return };
        let Some((n, covariance)) = self.chains.last_mut() else { return };
        let n = *n;
        let mut along = vec![0.0; n];
        for (_, i, slope) in &slopes {
            for r in 0..n {
                along[r] += covariance[r * n + i] * slope;
            }
        }
        let variance: f64 = slopes.iter().map(|(_, i, slope)| slope * along[*i]).sum();
        // A condition that holds already, as around a closed chain, is rounding.
        let apart: f64 = slopes.iter().map(|(_, i, slope)| slope * slope * covariance[i * n + i]).sum();
        if variance.is_nan() || variance <= HOLDS_ALREADY_VARIANCE * apart {
            return;
        }
        for r in 0..n {
            for c in 0..n {
                covariance[r * n + c] -= along[r] * along[c] / variance;
            }
        }
    }

    /// How a value of segments grows with each of their unknowns: chain, number in it, slope.
    fn slopes(&self, of: &[usize], value: &dyn Fn(&[Shape]) -> f64) -> Option<Vec<(usize, usize, f64)>> {
        let shapes: Vec<Shape> = of.iter().map(|k| self.shapes[*k]).collect::<Option<_>>()?;
        let mut all = vec![];
        for (i, k) in of.iter().enumerate() {
            for unknown in 0..shapes[i].unknowns() {
                let angle = matches!(shapes[i], Shape::Line { .. }) && unknown == 0;
                let step = SLOPE_STEP * if angle { 1.0 } else { self.size };
                let at = |by: f64| {
                    let mut moved = shapes.clone();
                    moved[i] = moved[i].moved(unknown, by);
                    value(&moved)
                };
                let (chain, first) = self.places[*k];
                all.push((chain, first + unknown, (at(step) - at(-step)) / (2.0 * step)));
            }
        }
        Some(all)
    }

    /// Covariance of two values of segments of this contour; `None` where one of them has no uncertainty.
    pub fn covariance(
        &self,
        of: &[usize],
        a: &dyn Fn(&[Shape]) -> f64,
        b: &dyn Fn(&[Shape]) -> f64,
    ) -> Option<f64> {
        let (x, y) = (self.slopes(of, a)?, self.slopes(of, b)?);
        let mut sum = 0.0;
        for (chain, i, s) in &x {
            for (other, j, t) in y.iter().filter(|(other, ..)| other == chain) {
                let (n, covariance) = self.chains.get(*other)?;
                sum += s * t * covariance[i * n + j];
            }
        }
        Some(sum)
    }

    /// Scales the unknowns of each segment so that its uncertainty is the one told.
    fn agree_with_told(&mut self, contour: &Contour) {
        for (k, segment) in contour.segments.iter().enumerate() {
            let (Some(shape), Some(stated)) = (self.shapes[k], segment.uncertainty) else { continue };
            let (chain, first) = self.places[k];
            let Some((n, covariance)) = self.chains.get_mut(chain) else { continue };
            let (own, stated) = match stated {
                Uncertainty::Line { angle } => (first, angle),
                Uncertainty::Arc { radius, .. } => (first + 2, radius),
            };
            let variance = covariance[own * *n + own];
            if variance <= 0.0 || stated <= 0.0 {
                continue;
            }
            let scale = stated / variance.sqrt();
            for i in first..first + shape.unknowns() {
                for r in 0..*n {
                    covariance[i * *n + r] *= scale;
                    covariance[r * *n + i] *= scale;
                }
            }
        }
    }
}

/// Steps by which slopes are found, as a share of the size.
const SLOPE_STEP: f64 = 1e-6;

/// Points of each segment that its fit has used.
fn own_points(contour: &Contour, row: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let mut all = vec![vec![]; contour.segments.len()];
    for (i, (label, p)) in contour.labels.iter().zip(row).enumerate() {
        let used = contour.outliers.binary_search(&i).is_err() && contour.repeated.binary_search(&i).is_err();
        if let Some(own) = all.get_mut(*label as usize).filter(|_| used) {
            own.push(*p);
        }
    }
    all
}

fn shape(contour: &Contour, k: usize, points: &[[f64; 2]]) -> Option<Shape> {
    let segment = &contour.segments[k];
    match &segment.geometry {
        _ if points.is_empty() || segment.length <= 0.0 => None,
        Geometry::Line => {
            let along = [0, 1].map(|i| (segment.end[i] - segment.start[i]) / segment.length);
            let far = |p: &[f64; 2]| (0..2).map(|i| along[i] * (p[i] - segment.start[i])).sum::<f64>();
            let middle = points.iter().map(far).sum::<f64>() / points.len() as f64;
            let place = [0, 1].map(|i| segment.start[i] + middle * along[i]);
            Some(Shape::Line { place, angle: segment.angle() })
        }
        Geometry::Arc { center, radius, .. } => Some(Shape::Arc { center: *center, radius: *radius }),
        Geometry::Spline { .. } => None,
    }
}

/// Segments with shapes that are joined by tangents.
fn chains(contour: &Contour, shapes: &[Option<Shape>]) -> Vec<Vec<usize>> {
    let n = shapes.len();
    let linked = |k: usize| {
        let next = (k + 1) % n;
        contour.joins.get(k).is_some_and(|j| j.continuity != Continuity::G0)
            && shapes[k].is_some()
            && shapes[next].is_some()
            && (k + 1 < n || contour.closed)
    };
    let first = (0..n).find(|k| !linked((k + n - 1) % n)).unwrap_or(0);
    let mut all: Vec<Vec<usize>> = vec![];
    for k in (0..n).map(|i| (first + i) % n) {
        match all.last_mut().filter(|_| k != first && linked((k + n - 1) % n)) {
            Some(chain) => chain.push(k),
            None => all.push(vec![k]),
        }
    }
    all.retain(|chain| shapes[chain[0]].is_some());
    all
}

/// Covariance of the unknowns of a shape by its points alone, of points of variance 1.
fn alone(shape: &Shape, points: &[[f64; 2]], size: f64) -> [[f64; 3]; 3] {
    let m = shape.unknowns();
    let mut normal = vec![0.0; m * m];
    for p in points {
        let s = shape.slopes(*p);
        for i in 0..m {
            for j in 0..=i {
                normal[i * m + j] += s[i] * s[j];
            }
        }
    }
    let weight = HOLDING_WEIGHT * points.len().max(1) as f64;
    for i in 0..m {
        let angle = matches!(shape, Shape::Line { .. }) && i == 0;
        normal[i * m + i] += weight * if angle { size * size } else { 1.0 };
    }
    let mut all = [[0.0; 3]; 3];
    // The matrix of a held shape is positive definite.
    if let Some(factor) = Cholesky::new(normal, m) {
        for i in 0..m {
            let mut b = vec![0.0; m];
            b[i] = 1.0;
            factor.solve(&mut b);
            for j in 0..m {
                all[j][i] = b[j];
            }
        }
    }
    all
}

/// Whether two segments turn to the same side.
pub(super) fn turns_alike(contour: &Contour, a: usize, b: usize) -> bool {
    contour.segments[a].curvature[1] * contour.segments[b].curvature[0] > 0.0
}

/// How far two shapes are from being tangent: 0 where they touch. Circles that turn alike touch from within.
pub(super) fn off_tangent(of: [Shape; 2], alike: bool) -> f64 {
    match of {
        [Shape::Line { place, angle }, Shape::Arc { center, radius }]
        | [Shape::Arc { center, radius }, Shape::Line { place, angle }] => {
            let (sin, cos) = libm::sincos(angle);
            (cos * (center[1] - place[1]) - sin * (center[0] - place[0])).abs() - radius
        }
        [Shape::Arc { center: a, radius: r }, Shape::Arc { center: b, radius: s }] => {
            let apart = libm::hypot(b[0] - a[0], b[1] - a[1]);
            apart - if alike { (r - s).abs() } else { r + s }
        }
        [Shape::Line { angle: a, .. }, Shape::Line { angle: b, .. }] => turned(b - a, std::f64::consts::TAU),
    }
}

/// An angle to within half a period of 0.
pub(super) fn turned(angle: f64, period: f64) -> f64 {
    angle - period * (angle / period).round()
}
