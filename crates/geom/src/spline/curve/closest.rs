//! The place of a curve nearest to a point.

use super::super::value::Value;
use super::b_spline::Curve;

/// The place of a curve nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot<const D: usize> {
    /// Its parameter.
    pub parameter: f64,
    /// The place.
    pub place: [f64; D],
    /// Its distance from the point.
    pub distance: f64,
}

fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a.iter().zip(&b).map(|(x, y)| x * y).sum()
}

impl<const D: usize> Curve<[f64; D]> {
    /// The place nearest to `point`: each span is looked at in a few places, the best are refined by Newton's method.
    ///
    /// Two places nearer to each other than a part of a span, and equally far from the point, may be taken for one another. The
    /// distance is then that of one of them. Cost: a few evaluations per span.
    pub fn closest(&self, point: [f64; D]) -> Foot<D> {
        let distinct = self.knots.distinct();
        let steps = 2 * self.knots.degree() + 2;
        let mut places: Vec<(f64, f64)> = vec![];
        for span in distinct.windows(2) {
            for i in 0..steps {
                let t = span[0] + (span[1] - span[0]) * i as f64 / steps as f64;
                places.push((t, self.distance_at(t, point)));
            }
        }
        let end = self.domain().1;
        places.push((end, self.distance_at(end, point)));
        let last = places.len() - 1;
        let mut best = Foot { parameter: end, place: self.at(end), distance: f64::INFINITY };
        let mut minima: Vec<usize> = (0..=last)
            .filter(|&i| {
                (i == 0 || places[i].1 <= places[i - 1].1) && (i == last || places[i].1 <= places[i + 1].1)
            })
            .collect();
        minima.sort_by(|a, b| places[*a].1.total_cmp(&places[*b].1));
        for i in minima.into_iter().take(4) {
            let range = (places[i.saturating_sub(1)].0, places[(i + 1).min(last)].0);
            let foot = self.closest_from(point, places[i].0, range);
            if foot.distance < best.distance {
                best = foot;
            }
        }
        best
    }

    fn distance_at(&self, t: f64, point: [f64; D]) -> f64 {
        let difference = self.at(t).minus(point);
        dot(difference, difference)
    }

    /// Newton's method on the condition that the difference is at right angles to the curve, kept within a range.
    pub fn closest_from(&self, point: [f64; D], start: f64, range: (f64, f64)) -> Foot<D> {
        let (mut t, mut low, mut high) = (start, range.0, range.1);
        for _ in 0..40 {
            let mut d = [[0.0; D]; 3];
            self.derivatives_into(t, &mut d);
            let difference = d[0].minus(point);
            let slope = dot(difference, d[1]);
            if slope > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let bend = dot(d[1], d[1]) + dot(difference, d[2]);
            let newton = t - slope / bend;
            // Where the distance is not convex, or the step leaves the range, the range is halved.
            let next =
                if bend > 0.0 && newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            let done = (next - t).abs() <= 4.0 * f64::EPSILON * (1.0 + t.abs());
            t = next;
            if done {
                break;
            }
        }
        let place = self.at(t);
        let difference = place.minus(point);
        Foot { parameter: t, place, distance: dot(difference, difference).sqrt() }
    }
}
