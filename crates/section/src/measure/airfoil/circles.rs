//! Circles inscribed into a profile.

use super::super::nominal::inside;
use super::error::AirfoilError;
use super::profile::Profile;
use crate::model::crossings::crossing_chords;
use crate::model::flat::distance;
use trueness_geom::progress::{Cancelled, Progress};

/// Scatter makes loops at the trailing edge. A loop of a profile that crosses itself is wider by so many uncertainties of a place
/// in its mean width.
const MIN_LOOP_WIDTH_SIGMAS: f64 = 6.0;
/// Such a loop is also wider than this share of the chord.
const MIN_LOOP_WIDTH_OF_CHORD: f64 = 5e-4;
/// So many crossings are looked at.
const MAX_CROSSINGS_OF_PROFILE: usize = 1000;
/// Share of the camber line over which a thickness is taken for constant.
const FLAT_CAMBER_SHARE: f64 = 0.25;
/// Steps of a search that leaves two thirds each: to 1e-7 of the way.
const CIRCLE_SEARCH_STEPS: usize = 40;
/// Places of the camber line that are listed.
const LISTED_CAMBER_STEPS: usize = 50;

/// The curve as places, with the circles.
pub(super) struct InscribedCircles {
    /// Places, at a round trailing edge beyond it at both ends.
    places: Vec<[f64; 2]>,
    /// The place farthest from the middle of both ends.
    head: usize,
    /// Center and radius of circles that touch both sides, from the trailing to the leading edge.
    circles: Vec<([f64; 2], f64)>,
}

impl InscribedCircles {
    /// The circles of a course that goes on beyond its seam at both ends, if it has one.
    pub fn new(course: &Profile, progress: &dyn Progress) -> Result<InscribedCircles, AirfoilError> {
        let (all, seam) = (&course.places, course.seam);
        let places: Vec<[f64; 2]> = all.iter().map(|a| a.0).collect();
        let (quarter, last) = (places.len() / 4, places.len() - 1);
        let nearest = |seam: [f64; 2], among: std::ops::RangeInclusive<usize>| {
            let far = |i: &usize| distance(places[*i], seam);
            among.min_by(|a, b| far(a).total_cmp(&far(b)))
        };
        let once = seam.and_then(|s| Some((nearest(s, 0..=quarter)?, nearest(s, last - quarter..=last)?)));
        let (first, last) = once.unwrap_or((0, last));
        let tail = middle(places[first], places[last]);
        let far = |i: &usize| distance(places[*i], tail);
        let head = (first..=last).max_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(first);
        let own = &places[first..=last];
        if let Some(at) = crossing(own, MIN_LOOP_WIDTH_SIGMAS * course.uncertainty, progress)? {
            return Err(AirfoilError::Crosses { x: at[0], y: at[1] });
        }
        let inward = area(own).signum();
        let mut circles = vec![];
        for i in first + 1..head {
            if i % 64 == 0 && progress.cancelled() {
                return Err(Cancelled.into());
            }
            let normal = [-inward * all[i].1[1], inward * all[i].1[0]];
            if let Some((radius, j)) = touching(own, i - first, normal)
                && j + first > head
            {
                let p = places[i];
                let center = [p[0] + radius * normal[0], p[1] + radius * normal[1]];
                // Where the edges cross over, as at a bent trailing edge, a circle may lie outside.
                if inside(own, center) {
                    circles.push((center, radius));
                }
            }
        }
        if circles.len() < 3 {
            return Err(AirfoilError::Inside);
        }
        Ok(InscribedCircles { places, head, circles })
    }

    /// Leading and trailing edge: of a round trailing edge the ends of the longest chord.
    pub fn chord(&self, round: bool) -> ([f64; 2], [f64; 2]) {
        let n = self.places.len();
        let mut tail = middle(self.places[0], self.places[n - 1]);
        let mut head = self.farthest(tail, self.head);
        for _ in 0..if round { 20 } else { 0 } {
            let near = |i: &usize| distance(self.places[*i], head);
            // The row may begin a little off the edge, on either side.
            let most = (0..n).max_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or(0);
            tail = self.farthest(head, most);
            let most = (1..n - 1)
                .max_by(|a, b| distance(self.places[*a], tail).total_cmp(&distance(self.places[*b], tail)));
            head = self.farthest(tail, most.unwrap_or(self.head));
        }
        (head, tail)
    }

    /// The place near number `i` that is farthest from `from`: where the parabola through three distances is greatest.
    fn farthest(&self, from: [f64; 2], i: usize) -> [f64; 2] {
        if i == 0 || i + 1 >= self.places.len() {
            return self.places[i];
        }
        let values = [i - 1, i, i + 1].map(|k| distance(self.places[k], from));
        between(values, [i - 1, i, i + 1].map(|k| self.places[k]))
    }

    /// The greatest circle.
    pub fn greatest(&self) -> Option<([f64; 2], f64)> {
        let all = &self.circles;
        let i = (0..all.len()).max_by(|a, b| all[*a].1.total_cmp(&all[*b].1))?;
        if i == 0 || i + 1 == all.len() {
            return all.get(i).copied();
        }
        let three = [i - 1, i, i + 1].map(|k| all[k]);
        let values = three.map(|c| c.1);
        let [radius, _] = between(values, values.map(|r| [r, 0.0]));
        Some((between(values, three.map(|c| c.0)), radius))
    }

    /// Whether the greatest circle is the one of many of nearly its size. A quarter of the camber line or more has
    /// radii within `reach` of it.
    pub fn is_flat(&self, reach: f64) -> bool {
        let most = self.circles.iter().map(|c| c.1).fold(0.0, f64::max);
        let way = |w: &[([f64; 2], f64)]| distance(w[0].0, w[1].0);
        let near = |w: &&[([f64; 2], f64)]| w[0].1 > most - reach;
        let whole: f64 = self.circles.windows(2).map(way).sum();
        self.circles.windows(2).filter(near).map(way).sum::<f64>() > FLAT_CAMBER_SHARE * whole
    }

    /// The center at which a distance is greatest in magnitude.
    pub fn extreme(&self, off: &dyn Fn([f64; 2]) -> f64) -> Option<[f64; 2]> {
        let all = &self.circles;
        let size = |i: &usize| off(all[*i].0).abs();
        let i = (0..all.len()).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        if i == 0 || i + 1 == all.len() {
            return all.get(i).map(|c| c.0);
        }
        let three = [i - 1, i, i + 1].map(|k| all[k].0);
        Some(between(three.map(|p| off(p).abs()), three))
    }

    /// Some of the circles, from the leading to the trailing edge, evenly.
    pub fn line(&self) -> Vec<([f64; 2], f64)> {
        let all = &self.circles;
        let mut ways = vec![0.0];
        for w in all.windows(2).rev() {
            ways.push(ways[ways.len() - 1] + distance(w[0].0, w[1].0));
        }
        let (last, whole) = (all.len() - 1, ways[all.len() - 1]);
        let at = |k: usize| {
            let way = whole * k as f64 / LISTED_CAMBER_STEPS as f64;
            let i = ways.partition_point(|w| *w < way).clamp(1, last);
            let share =
                ((way - ways[i - 1]) / (ways[i] - ways[i - 1]).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            let (a, b) = (all[last - (i - 1)], all[last - i]);
            let mix = |x: f64, y: f64| x + share * (y - x);
            ([mix(a.0[0], b.0[0]), mix(a.0[1], b.0[1])], mix(a.1, b.1))
        };
        (0..=LISTED_CAMBER_STEPS).map(at).collect()
    }
}

fn middle(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}

/// Where a profile crosses itself such that both loops are wider than `least`, and than bends at the trailing edge
/// make.
fn crossing(places: &[[f64; 2]], least: f64, progress: &dyn Progress) -> Result<Option<[f64; 2]>, Cancelled> {
    let chords: Vec<[[f64; 2]; 2]> = places.windows(2).map(|w| [w[0], w[1]]).collect();
    let chord = places.iter().map(|p| distance(*p, places[0])).fold(0.0, f64::max);
    let way = |p: &[[f64; 2]]| p.windows(2).map(|w| distance(w[0], w[1])).sum::<f64>();
    let width = |p: &[[f64; 2]]| 2.0 * area(p).abs() / way(p).max(f64::MIN_POSITIVE);
    let wide = |(i, j): &(usize, usize)| {
        let rest: Vec<[f64; 2]> = places[..=*i].iter().chain(&places[j + 1..]).copied().collect();
        width(&places[i + 1..=*j]).min(width(&rest)) > least.max(MIN_LOOP_WIDTH_OF_CHORD * chord)
    };
    let all = crossing_chords(&chords, true, MAX_CROSSINGS_OF_PROFILE, progress)?;
    Ok(all.into_iter().find(wide).map(|(i, _)| places[i]))
}

fn area(polygon: &[[f64; 2]]) -> f64 {
    let o = polygon[0];
    let cross = |w: &[[f64; 2]]| (w[0][0] - o[0]) * (w[1][1] - o[1]) - (w[0][1] - o[1]) * (w[1][0] - o[0]);
    0.5 * polygon.windows(2).map(cross).sum::<f64>()
}

/// The radius of the greatest circle that touches place `i` from the side of `normal` and holds no other place. Also
/// the place that it touches, too. Between places the least radius is that of a parabola.
fn touching(places: &[[f64; 2]], i: usize, normal: [f64; 2]) -> Option<(f64, usize)> {
    let p = places[i];
    let radius = |q: [f64; 2]| {
        let d = [q[0] - p[0], q[1] - p[1]];
        let ahead = d[0] * normal[0] + d[1] * normal[1];
        let square = d[0] * d[0] + d[1] * d[1];
        // A place that lies on the tangent, as near as can be told.
        if ahead <= 1e-9 * square.sqrt() { f64::INFINITY } else { 0.5 * square / ahead }
    };
    let all = (0..places.len()).filter(|j| *j != i).map(|j| (radius(places[j]), j));
    let (least, j) = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
    if !least.is_finite() {
        return None;
    }
    if j == 0 || j + 1 == places.len() || j.abs_diff(i) < 2 {
        return Some((least, j));
    }
    // Between the places beside the curve is a parabola, nearly.
    let three = [j - 1, j, j + 1].map(|k| places[k]);
    let at = |t: f64| radius(on_parabola(three, t));
    let (mut low, mut high) = (-1.0, 1.0);
    for _ in 0..CIRCLE_SEARCH_STEPS {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(a) < at(b) { high = b } else { low = a }
    }
    Some((least.min(at(0.5 * (low + high))), j))
}

/// The place at `t` between -1 and 1 on the parabola through three places.
fn on_parabola([x, y, z]: [[f64; 2]; 3], t: f64) -> [f64; 2] {
    [0, 1].map(|k| y[k] + 0.5 * t * (z[k] - x[k]) + 0.5 * t * t * (x[k] - 2.0 * y[k] + z[k]))
}

/// The value at the top of the parabola through three values, of a place that changes with them quadratically.
fn between([a, b, c]: [f64; 3], what: [[f64; 2]; 3]) -> [f64; 2] {
    let bend = a - 2.0 * b + c;
    let t = if bend < 0.0 { (0.5 * (a - c) / bend).clamp(-1.0, 1.0) } else { 0.0 };
    on_parabola(what, t)
}
