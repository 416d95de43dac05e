//! The course of a profile: the contour's own lines, arcs and curves, or a B-spline through the points.
//!
//! The B-spline has as many control points as the likelihood with Schwarz's penalty pays for. Edges of the trailing end
//! (corners, or the ends of an open row) are its ends. It is smooth: where a round edge runs into a side its curvature
//! cannot jump, and it swings beside. A contour that ends at the same edges, and costs less by the same measure, is
//! taken in its place.

use super::ends::{TrailingEdge, TurnedProfile};
use super::error::AirfoilError;
use crate::model::chain::SegmentKind;
use crate::model::flat::distance;
use crate::model::result::{Continuity, Contour};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::spline::curve::{self, Curve, Ends, Fitted};

/// Points as near to each other as this share of the spacing are one.
pub(super) const SAME_PLACE_SPACINGS: f64 = 1e-4;

/// Where there are more points the means of neighbors are taken.
const MAX_POINTS_OF_PROFILE: usize = 2000;
/// Places for each control point by which a curve's length is measured.
const PLACES_PER_CONTROL_POINT: usize = 8;
/// Control points to begin with, and the factor by which they grow.
const FIRST_POINTS_AND_GROWTH: (usize, f64) = (8, 1.3);
/// A curve longer than the way through the points by this factor runs wild between them.
const MAX_CURVE_LENGTH_RATIO: f64 = 1.03;
/// Tries without gain after which no more control points are tried.
const MAX_IDLE_TRIES: usize = 4;
/// About so many places of the course are tried for circles.
const COURSE_PLACES: usize = 2000;
/// Fewest such places of a segment.
const MIN_PLACES_PER_SEGMENT: usize = 24;
/// A corner of the contour is that of the trailing edge within so many distances between points.
const TRAILING_CORNER_SPACINGS: f64 = 3.0;

/// The course of a profile from its trailing edge around to it again.
pub(super) struct Profile {
    /// Places with the direction there; at a round trailing edge they go on beyond it at both ends.
    pub places: Vec<([f64; 2], [f64; 2])>,
    /// The place where a round trailing edge begins and ends.
    pub seam: Option<[f64; 2]>,
    /// Standard uncertainty of a place, across.
    pub uncertainty: f64,
    /// Standard deviation of the points about it.
    pub noise: f64,
    /// It is that of the contour.
    pub of_contour: bool,
}

impl Profile {
    /// The likelier course of a row, where the row ends for it, and another course where that is no lines and arcs.
    /// That is the other one, or the B-spline of every second point. `numbers` are those of the row's points among the
    /// contour's.
    pub fn new(
        row: &[[f64; 2]],
        numbers: &[usize],
        contour: &Contour,
        progress: &dyn Progress,
    ) -> Result<(TurnedProfile, Profile, Option<Profile>), AirfoilError> {
        let around = TurnedProfile::new(row, contour.closed)?;
        let smooth = SmoothCourse::new(&thinned(&around.row), progress);
        if let Err(AirfoilError::Cancelled(e)) = smooth {
            return Err(e.into());
        }
        let mut other = None;
        if !contour.segments.is_empty() && contour.unreliable.is_empty() {
            let count = smooth.as_ref().map_or(row.len(), |s| s.count) as f64;
            if let Some((cost, course)) = of_contour(&around, around.ends.map(|i| numbers[i]), contour, count)
            {
                if smooth.as_ref().map_or(true, |s| cost < s.cost) {
                    // A B-spline does not follow the scatter that a free curve of a contour follows, or does elsewhere.
                    let free = contour.segments.iter().any(|s| s.geometry.kind() == SegmentKind::Spline);
                    let smooth = smooth.ok().filter(|_| free).map(|s| s.course(&around));
                    return Ok((around, course, smooth));
                }
                other = Some(course);
            }
        }
        let smooth = smooth?;
        if other.is_none() {
            let last = around.row.len() - 1;
            let every = |(i, p): (usize, &[f64; 2])| (i % 2 == 0 || i == last).then_some(*p);
            let half: Vec<[f64; 2]> = thinned(&around.row).iter().enumerate().filter_map(every).collect();
            match SmoothCourse::new(&half, progress) {
                Err(AirfoilError::Cancelled(e)) => return Err(e.into()),
                half => other = half.ok().map(|half| half.course(&around)),
            }
        }
        let course = smooth.course(&around);
        Ok((around, course, other))
    }
}

impl SmoothCourse {
    fn course(&self, around: &TurnedProfile) -> Profile {
        let seam = (around.trailing == TrailingEdge::Round).then(|| around.row[around.over]);
        let (places, uncertainty, noise) = (along(&self.curve), self.uncertainty, self.noise);
        Profile { places, seam, uncertainty, noise, of_contour: false }
    }
}

/// Twice the negative logarithm of the likelihood of points with this sum of squared distances, and the penalty for the unknowns.
fn cost(sum: f64, unknowns: f64, penalty: f64, count: f64, spacing: f64) -> f64 {
    let floor = (SAME_PLACE_SPACINGS * spacing).powi(2);
    count * libm::log(sum / (count - unknowns).max(1.0) + floor) + penalty * libm::log(count)
}

fn unit(v: [f64; 2]) -> [f64; 2] {
    let size = libm::hypot(v[0], v[1]).max(f64::MIN_POSITIVE);
    [v[0] / size, v[1] / size]
}

/// Places of a curve, more where its knots are.
fn along(curve: &Curve<[f64; 2]>) -> Vec<([f64; 2], [f64; 2])> {
    let distinct = curve.knots().distinct();
    let each = COURSE_PLACES.div_ceil(distinct.len().max(2) - 1).max(4);
    let mut parameters: Vec<f64> = vec![];
    for w in distinct.windows(2) {
        parameters.extend((0..each).map(|k| w[0] + (w[1] - w[0]) * k as f64 / each as f64));
    }
    parameters.extend(distinct.last());
    let place = |t: &f64| {
        let d = curve.derivatives(*t, 1);
        (d[0], unit(d[1]))
    };
    parameters.iter().map(place).collect()
}

/// The contour's own course with its cost for as many points; `None` where it does not end where the profile does.
fn of_contour(
    around: &TurnedProfile,
    ends: [usize; 2],
    contour: &Contour,
    as_many: f64,
) -> Option<(f64, Profile)> {
    let whole: f64 = contour.segments.iter().map(|s| s.length).sum();
    if whole <= 0.0 {
        return None;
    }
    let kept =
        |i: &usize| contour.outliers.binary_search(i).is_err() && contour.repeated.binary_search(i).is_err();
    let own: Vec<usize> = (0..contour.residuals.len()).filter(kept).collect();
    let sum: f64 = own.iter().map(|i| contour.residuals[*i].powi(2)).sum();
    let (count, unknowns) = (own.len() as f64, contour.unknowns);
    let share = as_many / count.max(1.0);
    let penalty = unknowns + contour.joins.len() as f64;
    let cost = cost(share * sum, share * unknowns, penalty, as_many, contour.spacing);
    let stations = ends.map(|i| contour.stations[i]);
    let corners = corners(contour);
    // The way on from a station to the corner nearest to it, below 0 the way back.
    let to_corner = |station: f64| {
        let way = |c: &f64| (c - station + 0.5 * whole).rem_euclid(whole) - 0.5 * whole;
        let near = corners.iter().map(way).min_by(|a, b| a.abs().total_cmp(&b.abs()));
        near.filter(|way| way.abs() < TRAILING_CORNER_SPACINGS * contour.spacing)
    };
    let over = whole / 16.0;
    let (from, to) = match around.trailing {
        TrailingEdge::Open(_) => (0.0, whole),
        TrailingEdge::Round => (stations[0] - over, stations[0] + whole + over),
        TrailingEdge::Sharp => {
            to_corner(stations[0]).map(|way| (stations[0] + way, stations[0] + way + whole))?
        }
        // Where no point lies on the face the contour leads the sides on to one corner: they end with their points.
        TrailingEdge::Blunt(_) => {
            // A corner farther within a side is none of its end.
            let inside = |way: f64| (way <= contour.spacing).then_some(way.max(0.0));
            let from = stations[0] + inside(to_corner(stations[0])?)?;
            let to = stations[1] - inside(-to_corner(stations[1])?)?;
            (from, if to <= from { to + whole } else { to })
        }
    };
    let places = between(contour, from, to, whole);
    let at = between(contour, stations[0], stations[0], whole).first()?.0;
    let seam = (around.trailing == TrailingEdge::Round).then_some(at);
    let uncertainty = contour.noise * (unknowns / count.max(1.0)).sqrt();
    Some((cost, Profile { places, seam, uncertainty, noise: contour.noise, of_contour: true }))
}

/// Lengths along a contour to its corners.
fn corners(contour: &Contour) -> Vec<f64> {
    let mut station = 0.0;
    let mut all = vec![];
    for (segment, join) in contour.segments.iter().zip(&contour.joins) {
        station += segment.length;
        if join.continuity == Continuity::G0 {
            all.push(station);
        }
    }
    all
}

/// Places of a contour from one length along it to another; of a closed one also before its start and beyond its end.
fn between(contour: &Contour, from: f64, to: f64, whole: f64) -> Vec<([f64; 2], [f64; 2])> {
    let rounds = if contour.closed { -1..=2 } else { 0..=0 };
    let mut all: Vec<([f64; 2], [f64; 2])> = vec![];
    for round in rounds {
        let mut start = f64::from(round) * whole;
        for segment in &contour.segments {
            let end = start + segment.length;
            let (low, high) = (from.max(start), to.min(end));
            let (own, length) = (start, segment.length.max(f64::MIN_POSITIVE));
            start = end;
            if low > high {
                continue;
            }
            let count =
                ((COURSE_PLACES as f64 * (high - low) / whole).ceil() as usize).max(MIN_PLACES_PER_SEGMENT);
            let steps = if high > low { count } else { 0 };
            let place = |i: usize| {
                let share = (low - own + (high - low) * i as f64 / count as f64) / length;
                (segment.place(share), unit(segment.direction(share)))
            };
            let next: Vec<_> = (0..=steps).map(place).collect();
            // A tangent join is one place.
            let same = |a: &([f64; 2], [f64; 2])| distance(a.0, next[0].0) <= 1e-9 * length && all.len() > 1;
            let skip = usize::from(all.last().is_some_and(same));
            all.extend(next.into_iter().skip(skip));
        }
    }
    all
}

/// The means of so many neighbors that few enough points are left; the ends stay.
fn thinned(row: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let by = row.len().div_ceil(MAX_POINTS_OF_PROFILE);
    if by < 2 {
        return row.to_vec();
    }
    let mean =
        |group: &[[f64; 2]]| [0, 1].map(|k| group.iter().map(|p| p[k]).sum::<f64>() / group.len() as f64);
    let last = row.len() - 1;
    let inner = row[1..last].chunks(by).map(mean);
    std::iter::once(row[0]).chain(inner).chain(std::iter::once(row[last])).collect()
}

/// The curve through the points.
struct SmoothCourse {
    curve: Curve<[f64; 2]>,
    /// Standard uncertainty of a place of it, across.
    uncertainty: f64,
    noise: f64,
    cost: f64,
    /// Number of points.
    count: usize,
}

impl SmoothCourse {
    /// The curve with the number of control points that costs least: a chi-squared part and Schwarz's penalty, two for
    /// each. No more than three for four points: with more, hardly any point would tell that the curve is wrong.
    fn new(row: &[[f64; 2]], progress: &dyn Progress) -> Result<SmoothCourse, AirfoilError> {
        let n = row.len();
        let chords = curve::chord_parameters(row).ok_or(AirfoilError::Inside)?;
        let length: f64 = row.windows(2).map(|w| distance(w[0], w[1])).sum();
        let mut best: Option<SmoothCourse> = None;
        let most = (3 * n / 4).max(FIRST_POINTS_AND_GROWTH.0).min(n);
        let (mut count, mut idle) = (FIRST_POINTS_AND_GROWTH.0.min(most), 0);
        loop {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            let mut parameters = chords.clone();
            let knots = curve::spread_knots(3, count, &parameters);
            let fitted = curve::corrected(row, &mut parameters, &knots, Ends::FREE).ok();
            let held = |f: &Fitted<2>| {
                let places = f.curve.sample(PLACES_PER_CONTROL_POINT * knots.count());
                places.windows(2).map(|w| distance(w[0], w[1])).sum::<f64>() < MAX_CURVE_LENGTH_RATIO * length
            };
            if let Some(fitted) = fitted.filter(held) {
                let p = knots.count() as f64;
                let cost = cost(fitted.sum_of_squares, p, 2.0 * p, n as f64, length / n as f64);
                if best.as_ref().is_none_or(|b| cost < b.cost) {
                    idle = 0;
                    let variance = fitted.sum_of_squares / (n as f64 - p).max(1.0);
                    let uncertainty = (variance * p / n as f64).sqrt();
                    best = Some(SmoothCourse {
                        curve: fitted.curve,
                        uncertainty,
                        noise: variance.sqrt(),
                        cost,
                        count: n,
                    });
                } else {
                    idle += 1;
                }
            }
            if count >= most || idle >= MAX_IDLE_TRIES {
                return best.ok_or(AirfoilError::Inside);
            }
            count = ((count as f64 * FIRST_POINTS_AND_GROWTH.1) as usize).min(most);
        }
    }
}
