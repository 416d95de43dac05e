//! A face, and what it is like at a place: its outward normal, how it bends, and its normals around a pole.

use super::region::Region;
use crate::surface::{Pole, SurfaceFeet};
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// A face.
pub(super) struct Face<R> {
    /// Its surface.
    pub(super) feet: SurfaceFeet,
    /// `None` where nothing is known of it.
    pub(super) region: Option<R>,
    /// Whether its outward normal is opposite to that of the surface.
    pub(super) is_reversed: bool,
    /// Its shell.
    pub(super) shell: Option<u32>,
}

/// Share of a domain by which a place lies beside a pole.
const BESIDE_POLE: f64 = 1e-7;
/// Directions around a pole.
const AROUND_POLE: usize = 96;
/// Halvings of the angle between two of them to find where the face begins.
const POLE_HALVINGS: usize = 30;

impl<R: Region> Face<R> {
    /// The outward unit normal; `None` at a pole.
    pub(super) fn outward(&self, at: [f64; 2]) -> Option<Vector> {
        let jet = self.feet.jet(at);
        let (normal, _) = unit(cross(jet.first[0], jet.first[1]))?;
        // At a pole what is left of a derivative is rounding.
        if self.pole_at(&jet.place).is_some() {
            return None;
        }
        Some(if self.is_reversed { times(-1.0, normal) } else { normal })
    }

    /// The pole at a place.
    pub(super) fn pole_at(&self, place: &Point) -> Option<Pole> {
        /// Share of the coordinates within which a place is a pole.
        const AT_POLE: f64 = 1e-9;
        let near =
            |pole: &&Pole| norm(minus(pole.place, *place)) <= AT_POLE * (norm(pole.place) + norm(*place));
        self.feet.poles().iter().find(near).copied()
    }

    /// How much the surface bends towards `up` along the tangent `way`.
    pub(super) fn bend(&self, at: [f64; 2], way: Vector, up: Vector) -> Option<f64> {
        let jet = self.feet.jet(at);
        let [du, dv] = jet.first;
        let [a, b, c] = [dot(du, du), dot(du, dv), dot(dv, dv)];
        let [x, y] = [dot(du, way), dot(dv, way)];
        let determinant = a * c - b * b;
        let [s, t] = [(c * x - b * y) / determinant, (a * y - b * x) / determinant];
        let [uu, uv, vv] = jet.second.map(|w| dot(w, up));
        let bend = s * s * uu + 2.0 * s * t * uv + t * t * vv;
        bend.is_finite().then_some(bend)
    }

    /// The sum of the outward normals around a pole by the angles that they take there, and the sum of these: of the directions in which the
    /// face leaves it.
    pub(super) fn around(&self, pole: &Pole) -> (Vector, f64) {
        let Some(region) = &self.region else { return ([0.0; 3], 0.0) };
        let surface = self.feet.surface();
        let domain = surface.domain();
        let width = |k: usize| {
            let [from, to] = domain[k];
            if from.is_finite() && to.is_finite() { to - from } else { 1.0 }
        };
        let [turn_from, turn_to] = domain[1 - pole.held];
        let mut total = ([0.0; 3], 0.0);
        for sense in [-1.0, 1.0] {
            let beside = pole.at + sense * BESIDE_POLE * width(pole.held);
            let [from, to] = domain[pole.held];
            if beside < from || beside > to {
                continue;
            }
            let at = |t: f64| if pole.held == 0 { [beside, t] } else { [t, beside] };
            let has = |t: f64| region.contains(at(t));
            let t = |i: usize| turn_from + (turn_to - turn_from) * i as f64 / AROUND_POLE as f64;
            let mut before = has(t(0));
            for i in 0..AROUND_POLE {
                let (mut low, mut high) = (t(i), t(i + 1));
                let after = has(high);
                if before != after {
                    let mut limits = [low, high];
                    for _ in 0..POLE_HALVINGS {
                        let middle = 0.5 * (limits[0] + limits[1]);
                        limits[usize::from(has(middle) != before)] = middle;
                    }
                    if before { high = limits[0] } else { low = limits[1] }
                }
                if before || after {
                    self.add_sector(pole, [at(low), at(high)], &mut total);
                }
                before = after;
            }
        }
        total
    }

    /// Adds what lies between two places beside a pole.
    fn add_sector(&self, pole: &Pole, ends: [[f64; 2]; 2], total: &mut (Vector, f64)) {
        let surface = self.feet.surface();
        let ways = ends.map(|[u, v]| unit(minus(surface.at(u, v), pole.place)).map_or([0.0; 3], |(w, _)| w));
        let angle = libm::atan2(norm(cross(ways[0], ways[1])), dot(ways[0], ways[1]));
        let middle = [0, 1].map(|k| 0.5 * (ends[0][k] + ends[1][k]));
        if let Some(normal) = surface.normal(middle[0], middle[1]) {
            let outward = if self.is_reversed { -angle } else { angle };
            total.0 = plus(total.0, times(outward, normal));
            total.1 += angle;
        }
    }
}
