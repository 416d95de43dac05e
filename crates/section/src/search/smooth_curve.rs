//! A smooth curve along the points of a row. Models are built on it where lines and arcs of a first partition do not
//! follow the points.

use super::model_edits::PlacedModel;
use super::rounds::Search;
use crate::model::chain::{Chain, Piece};
use crate::model::criterion::{Model, PieceSpec};
use crate::model::flat::{angle, distance};
use crate::model::least::State;
use trueness_geom::spline::curve::{self, Curve, Ends, chord_parameters, spread_knots};

/// Control points at first; they double up to one for so many points.
const FIRST_CONTROL_POINTS: usize = 8;
/// Points to a control point, at least.
const POINTS_PER_CONTROL_POINT: usize = 4;
/// The curve follows the points where they scatter about it by no more than so many times their noise.
const MAX_RMS_SIGMAS: f64 = 1.15;
/// Noise of more than this share of the distance between points makes chords longer than the ways between the points.
const MAX_NOISE_FOR_CHORDS_SPACINGS: f64 = 0.2;
/// Arcs to a span of the curve.
const ARCS_PER_SPAN: usize = 4;

impl Search<'_> {
    /// Arcs along the curve of fewest control points that the points scatter about by no more than their noise. The `specs` are scaled onto it. `None` where no curve does.
    pub fn arcs_along_smooth_curve(&self, first: &State, specs: &[PieceSpec]) -> Option<PlacedModel> {
        let (n, from) = (self.row.points.len(), first.breaks[0]);
        let closed = first.chain.closed;
        let numbers: Vec<usize> = (from..from + n + usize::from(closed)).map(|i| i % n).collect();
        let kept: Vec<usize> = (0..numbers.len()).filter(|k| self.row.weights[numbers[*k]] > 0.0).collect();
        let points: Vec<[f64; 2]> = kept.iter().map(|k| self.row.points[numbers[*k]]).collect();
        let (curve, parameters) = self.smoothed(&points)?;
        let spans = curve.knots().distinct();
        let steps = spans
            .windows(2)
            .flat_map(|w| (0..ARCS_PER_SPAN).map(|k| w[0] + (w[1] - w[0]) * k as f64 / ARCS_PER_SPAN as f64));
        let places: Vec<f64> = steps.chain(spans.last().copied()).collect();
        let at: Vec<[[f64; 2]; 2]> = places.iter().map(|t| [curve.at(*t), curve.derivative(*t, 1)]).collect();
        let arc = |w: &[[[f64; 2]; 2]]| {
            let turn = angle(w[0][1], w[1][1]);
            let half = 0.5 * turn;
            let longer = if half.abs() > 1e-6 { half / libm::sin(half) } else { 1.0 };
            let way = distance(w[0][0], w[1][0]) * longer;
            Piece::arc(way, turn / way)
        };
        let pieces: Vec<Piece> = at.windows(2).map(arc).collect();
        if pieces.iter().any(|p| !(p.length > 0.0 && p.coefficients[0].is_finite())) {
            return None;
        }
        let [start, along] = at[0];
        let chain = Chain { start, heading: libm::atan2(along[1], along[0]), pieces, ..first.chain.clone() };
        let stations = chain.stations();
        let station = |t: f64| {
            let k = places.partition_point(|x| *x <= t).clamp(1, places.len() - 1);
            let share = (t - places[k - 1]) / (places[k] - places[k - 1]);
            stations[k - 1] + share * (stations[k] - stations[k - 1])
        };
        // A point left out is where the next one is.
        let mut order = vec![0.0; n];
        let mut next = 0;
        for (k, place) in order.iter_mut().enumerate() {
            next += usize::from(kept.get(next).is_some_and(|i| *i < k));
            *place = station(parameters[next.min(parameters.len() - 1)]);
        }
        let (whole, old) = (stations[stations.len() - 1], [specs.first()?.from, specs.last()?.to]);
        let scaled = |s: f64| (s - old[0]) / (old[1] - old[0]) * whole;
        let specs =
            specs.iter().map(|p| PieceSpec { from: scaled(p.from), to: scaled(p.to), ..*p }).collect();
        let state = State { chain, breaks: first.breaks.clone(), feet: vec![0.5; n], sum: 0.0 };
        Some(PlacedModel::of_arcs(Model { state, cost: f64::INFINITY }, stations, order, specs))
    }

    /// The curve along points, and their parameters.
    fn smoothed(&self, points: &[[f64; 2]]) -> Option<(Curve<[f64; 2]>, Vec<f64>)> {
        let n = points.len();
        let parameters = match self.criterion.noise > MAX_NOISE_FOR_CHORDS_SPACINGS * self.spacing {
            true => (0..n).map(|i| i as f64 / (n - 1) as f64).collect(),
            false => chord_parameters(points)?,
        };
        let most = (MAX_RMS_SIGMAS * self.criterion.noise).max(self.criterion.resolution);
        let mut count = FIRST_CONTROL_POINTS;
        while POINTS_PER_CONTROL_POINT * count <= n {
            let (fitted, sum) = self.off_curve(points, &parameters, count)?;
            if sum <= most * most * (n - count) as f64 {
                return Some((fitted, parameters));
            }
            count *= 2;
        }
        None
    }

    /// The curve of so many control points along points, and the sum of squares that they lie off it.
    pub fn off_curve(
        &self,
        points: &[[f64; 2]],
        parameters: &[f64],
        count: usize,
    ) -> Option<(Curve<[f64; 2]>, f64)> {
        if count > points.len() {
            return None;
        }
        let knots = spread_knots(3, count, parameters);
        let fitted = curve::fit(points, parameters, &knots, Ends::FREE, 0.0).ok()?.curve;
        let square = |(p, t): (&[f64; 2], &f64)| {
            let (at, along) = (fitted.at(*t), fitted.derivative(*t, 1));
            let across = along[0] * (p[1] - at[1]) - along[1] * (p[0] - at[0]);
            across * across / (along[0] * along[0] + along[1] * along[1])
        };
        let sum: f64 = points.iter().zip(parameters).map(square).sum();
        Some((fitted, sum))
    }
}
