//! A surface as its parameters are used by one face: which of them repeats, which side is a single place.

use crate::surface::{Jet, Patch, Pole, Surface, SurfaceFeet};
use trueness_geom::space::{Point, minus, norm};

/// A side of the domain: the parameter that is constant there, and whether it is the last value (1) or the first (0).
pub type Side = (usize, usize);

/// A surface with its periods and poles. Parameters may lie any number of periods away from the domain.
#[derive(Clone, Debug)]
pub struct Chart {
    feet: SurfaceFeet,
    /// After how much a parameter repeats.
    pub periods: [Option<f64>; 2],
    /// First and last `u`, first and last `v`; between two poles, where there are any.
    pub domain: [[f64; 2]; 2],
    /// The place that a side is, where it is one: `poles[k][0]` at the first value of parameter `k`.
    pub poles: [[Option<Point>; 2]; 2],
}

/// Values of parameters that differ by less than this share are the same: twelve digits are written.
pub const SAME_PARAMETER: f64 = 1e-9;

impl Chart {
    /// The chart for a face that passes through these places: they decide between the parts that a pole leaves, as the nappes of a cone.
    pub fn new(surface: &Surface, places: &[Point]) -> Chart {
        let feet = SurfaceFeet::new(surface);
        let mut chart =
            Chart { periods: feet.periods(), domain: surface.domain(), poles: [[None; 2]; 2], feet };
        for k in 0..2 {
            let poles: Vec<Pole> = chart.feet.poles().iter().filter(|p| p.held == k).copied().collect();
            if !poles.is_empty() {
                chart.cut(k, &poles, places);
            }
        }
        chart
    }

    /// Keeps what lies between two poles.
    fn cut(&mut self, k: usize, poles: &[Pole], places: &[Point]) {
        let mut values: Vec<(f64, Option<Point>)> = poles.iter().map(|p| (p.at, Some(p.place))).collect();
        if let Some(period) = self.periods[k].take() {
            let again = |turns: f64| {
                values.iter().map(move |(at, place)| (at + turns * period, *place)).collect::<Vec<_>>()
            };
            values = [again(-1.0), again(0.0), again(1.0)].concat();
        } else {
            values.extend(self.domain[k].map(|at| (at, None)));
        }
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        // A pole at an end of the domain is that end.
        values.dedup_by(|b, a| {
            let is_same = (b.0 - a.0).abs() <= SAME_PARAMETER * (1.0 + a.0.abs().min(b.0.abs()));
            if is_same {
                a.1 = a.1.or(b.1);
            }
            is_same
        });
        let own = self.domain[k];
        let part = |x: f64| values.partition_point(|v| v.0 <= x).clamp(1, values.len() - 1);
        let mut votes = vec![0usize; values.len()];
        for place in places {
            votes[part(self.feet.parameters(*place, None)[k])] += 1;
        }
        let middle = match own.map(f64::is_finite) {
            [true, true] => 0.5 * (own[0] + own[1]),
            // Of a cone the nappe on which the radius is above 0.
            _ => 0.0,
        };
        votes[part(middle)] += usize::from(votes.iter().all(|v| *v == 0));
        let best = (1..votes.len()).max_by_key(|i| (votes[*i], values.len() - i)).unwrap_or(1);
        let ends = [values[best - 1], values[best]];
        self.domain[k] = ends.map(|e| e.0);
        self.poles[k] = ends.map(|e| e.1);
    }

    /// The surface.
    pub fn surface(&self) -> &Surface {
        self.feet.surface()
    }

    /// Of a spline its pieces between knots, row after row, and these.
    pub(crate) fn spans(&self) -> Option<(&[Patch], &[Vec<f64>; 2])> {
        self.feet.spans()
    }

    /// The same place within the domain.
    pub fn wrapped(&self, at: [f64; 2]) -> [f64; 2] {
        std::array::from_fn(|k| match self.periods[k] {
            Some(period) => at[k] - period * ((at[k] - self.domain[k][0]) / period).floor(),
            None => at[k],
        })
    }

    /// Place and derivatives.
    pub fn jet(&self, at: [f64; 2]) -> Jet {
        self.feet.jet(self.wrapped(at))
    }

    /// The place.
    pub fn place(&self, at: [f64; 2]) -> Point {
        self.jet(at).place
    }

    /// The same place with its parameters as near to others as periods allow.
    pub fn beside(&self, at: [f64; 2], near: [f64; 2]) -> [f64; 2] {
        std::array::from_fn(|k| match self.periods[k] {
            Some(period) => at[k] + period * ((near[k] - at[k]) / period).round(),
            None => at[k],
        })
    }

    /// Parameters of the place on the surface next to a point; of all that name it the ones next to `near`.
    pub fn parameters(&self, point: Point, near: Option<[f64; 2]>) -> [f64; 2] {
        self.between_poles(self.feet.parameters(point, near))
    }

    /// The same place with values between the poles, where these cut open a parameter that would repeat.
    pub fn between_poles(&self, at: [f64; 2]) -> [f64; 2] {
        std::array::from_fn(|k| match (self.feet.periods()[k], self.periods[k]) {
            (Some(period), None) => {
                let middle = 0.5 * (self.domain[k][0] + self.domain[k][1]);
                at[k] + period * ((middle - at[k]) / period).round()
            }
            _ => at[k],
        })
    }

    /// The pole within `reach` of a point; of several at one place that whose parameter is nearest to `near`.
    pub fn pole(&self, point: Point, reach: f64, near: Option<[f64; 2]>) -> Option<Side> {
        let sides = [(0, 0), (0, 1), (1, 0), (1, 1)];
        let is_there =
            |side: &Side| self.poles[side.0][side.1].is_some_and(|p| norm(minus(p, point)) <= reach);
        let away = |(k, end): &Side| {
            let [from, to] = self.domain[*k];
            near.map_or(0.0, |n| (n[*k] - self.domain[*k][*end]).abs() / (to - from))
        };
        sides.into_iter().filter(is_there).min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    /// Whether any side is a pole.
    pub fn has_poles(&self) -> bool {
        self.poles.iter().flatten().any(Option::is_some)
    }
}
