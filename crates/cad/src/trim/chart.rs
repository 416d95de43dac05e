//! A surface as its parameters are used by one face: which side repeats, which side is a single place.

use super::stand_in;
use crate::surface::{Jet, Surface};
use std::f64::consts::TAU;
use trueness_geom::space::{Point, minus, norm};

/// A side of the domain: the parameter that is constant there, and whether it is the last value.
pub type Side = (usize, usize);

/// A surface with its periods and poles. Parameters may lie any number of periods away from the domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// The surface.
    pub surface: Surface,
    /// After how much a parameter repeats.
    pub periods: [Option<f64>; 2],
    /// First and last `u`, first and last `v`; of a cone those of one nappe, of a torus that meets itself those of one part.
    pub domain: [[f64; 2]; 2],
    /// The place that a side is, where it is one: `poles[k][0]` at the first value of parameter `k`.
    pub poles: [[Option<Point>; 2]; 2],
}

impl Chart {
    /// The chart for a face that passes through these places; they decide between the nappes of a cone and the like.
    pub fn new(surface: &Surface, places: &[Point]) -> Chart {
        let mut chart = Chart {
            surface: surface.clone(),
            periods: stand_in::periods(surface),
            domain: surface.domain(),
            poles: [[None; 2]; 2],
        };
        match surface {
            Surface::Cone { frame, radius, half_angle } => {
                let apex = -radius / libm::tan(*half_angle);
                let above: f64 = places.iter().map(|p| frame.local(*p)[2] - apex).sum();
                let is_above = if places.is_empty() { *half_angle > 0.0 } else { above > 0.0 };
                chart.cut(1, if is_above { [apex, f64::INFINITY] } else { [f64::NEG_INFINITY, apex] });
            }
            Surface::Torus { frame, major, minor } if minor >= major => {
                let turn = libm::acos(-major / minor);
                let off = |sign: f64| {
                    let to_tube = |p: &Point| {
                        let [x, y, z] = frame.local(*p);
                        (libm::hypot(libm::hypot(x, y) - sign * major, z) - minor).abs()
                    };
                    places.iter().map(to_tube).sum::<f64>()
                };
                let is_outer = places.is_empty() || off(1.0) <= off(-1.0);
                chart.cut(1, if is_outer { [-turn, turn] } else { [turn, TAU - turn] });
            }
            _ => chart.find_poles(),
        }
        chart
    }

    /// Keeps a part of a parameter's range; its ends are poles where they are finite.
    fn cut(&mut self, k: usize, range: [f64; 2]) {
        self.periods[k] = None;
        self.domain[k] = range;
        self.find_poles();
    }

    fn find_poles(&mut self) {
        let open = |x: [f64; 2]| [if x[0].is_finite() { x[0] } else { 0.0 }, if x[1].is_finite() { x[1] } else { 1.0 }];
        for k in 0..2 {
            if self.periods[k].is_some() {
                continue;
            }
            let [first, last] = open(self.domain[1 - k]);
            for end in 0..2 {
                let fixed = self.domain[k][end];
                if !fixed.is_finite() {
                    continue;
                }
                let place = |share: f64| {
                    let mut at = [fixed; 2];
                    at[1 - k] = first + share * (last - first);
                    self.surface.at(at[0], at[1])
                };
                let places: Vec<Point> = (0..=SAMPLES_OF_SIDE).map(|i| place(i as f64 / SAMPLES_OF_SIDE as f64)).collect();
                let extent = places.iter().map(|p| norm(minus(*p, places[0]))).fold(0.0, f64::max);
                if extent <= POLE_SHARE * self.size_hint() {
                    self.poles[k][end] = Some(places[0]);
                }
            }
        }
    }

    /// A length of the size of the surface where it has one: poles are told from short sides by it.
    fn size_hint(&self) -> f64 {
        let of = |x: [f64; 2]| match (x[0].is_finite(), x[1].is_finite()) {
            (true, true) => x,
            (true, false) => [x[0], x[0] + 1.0],
            (false, true) => [x[1] - 1.0, x[1]],
            (false, false) => [0.0, 1.0],
        };
        let [us, vs] = self.domain.map(of);
        let middle = [0.5 * (us[0] + us[1]), 0.5 * (vs[0] + vs[1])];
        let center = self.surface.at(middle[0], middle[1]);
        let corners = [[us[0], vs[0]], [us[1], vs[0]], [us[0], vs[1]], [us[1], vs[1]], [us[0], middle[1]], [middle[0], vs[0]]];
        corners.iter().map(|[u, v]| norm(minus(self.surface.at(*u, *v), center))).fold(0.0, f64::max)
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
        let [u, v] = self.wrapped(at);
        self.surface.jet(u, v)
    }

    /// The place.
    pub fn place(&self, at: [f64; 2]) -> Point {
        let [u, v] = self.wrapped(at);
        self.surface.at(u, v)
    }

    /// The same place with its parameters as near to others as periods allow.
    pub fn beside(&self, at: [f64; 2], near: [f64; 2]) -> [f64; 2] {
        std::array::from_fn(|k| match self.periods[k] {
            Some(period) => at[k] + period * ((near[k] - at[k]) / period).round(),
            None => at[k],
        })
    }

    /// Parameters of the place on the surface next to a point; beside `near` where that is given.
    pub fn parameters(&self, point: Point, near: Option<[f64; 2]>) -> [f64; 2] {
        let start = near.map(|n| self.wrapped(n));
        let found = stand_in::parameters(self, point, start);
        near.map_or(found, |n| self.beside(found, n))
    }

    /// The pole within `reach` of a point.
    pub fn pole(&self, point: Point, reach: f64) -> Option<Side> {
        let sides = [(0, 0), (0, 1), (1, 0), (1, 1)];
        sides.into_iter().find(|(k, end)| self.poles[*k][*end].is_some_and(|p| norm(minus(p, point)) <= reach))
    }

    /// Whether any side is a pole.
    pub fn has_poles(&self) -> bool {
        self.poles.iter().flatten().any(Option::is_some)
    }
}

/// Places of a side that are compared.
const SAMPLES_OF_SIDE: usize = 8;
/// A side shorter than this share of the surface is a single place: files have twelve digits, rounded a few times.
const POLE_SHARE: f64 = 1e-9;
