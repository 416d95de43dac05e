//! The parameters of places on or near a surface.

use super::feet::SurfaceFeet;
use super::foot::Foot;
use super::kinds::Surface;
use super::seams::ROUNDED_PLACE_SHARE;
use trueness_geom::space::{Point, minus, norm};

impl SurfaceFeet {
    /// The parameters of the nearest place to a point on or near the surface.
    ///
    /// With `near` they are those of all that name this place that are nearest to `near`: continued over a seam they go on beyond the
    /// domain, and of several places that are equally near, the one around `near` is taken. Without `near` they lie within the domain.
    ///
    /// At a pole, at an apex or on an axis, where one parameter is any number, it is that of `near`, or 0.
    pub fn parameters(&self, p: Point, near: Option<[f64; 2]>) -> [f64; 2] {
        let surface = self.surface();
        let periods = self.periods();
        let lift = |foot: &Foot| {
            let lifted = lifted(foot.parameters, near, periods, surface.domain());
            let free = self.free(foot, p);
            [0, 1].map(|k| if free[k] { near.map_or(0.0, |n| n[k]) } else { lifted[k] })
        };
        let mut best: Option<(Foot, [f64; 2], f64)> = None;
        let off =
            |own: [f64; 2]| near.map_or(0.0, |n| (0..2).map(|k| (own[k] - n[k]).abs()).fold(0.0, f64::max));
        let mut offer = |foot: Foot| {
            let own = lift(&foot);
            let away = off(own);
            let is_better = best.as_ref().is_none_or(|(b, _, least)| {
                let same = ROUNDED_PLACE_SHARE * (norm(foot.place) + foot.distance);
                let difference = foot.distance - b.distance;
                if difference.abs() <= same { near.is_some() && away < *least } else { difference < 0.0 }
            });
            if is_better {
                best = Some((foot, own, away));
            }
        };
        if let Some(foot) = near.and_then(|near| self.continued(p, near)) {
            return lift(&foot);
        }
        let mut reach = f64::INFINITY;
        self.visit(p, reach, &mut |foot| {
            reach = reach.min(foot.distance + 2.0 * ROUNDED_PLACE_SHARE * (norm(foot.place) + foot.distance));
            offer(foot);
            reach
        });
        best.map_or([f64::NAN; 2], |(_, own, _)| own)
    }

    /// The same parameters within the domain.
    pub fn home(&self, at: [f64; 2]) -> [f64; 2] {
        lifted(at, None, self.periods(), self.surface().domain())
    }

    /// Which parameters may be any number.
    fn free(&self, foot: &Foot, p: Point) -> [bool; 2] {
        let surface = self.surface();
        let same = ROUNDED_PLACE_SHARE * (norm(foot.place) + foot.distance);
        let mut free = [false; 2];
        for pole in self.poles() {
            let is_there = norm(minus(foot.place, pole.place)) <= same;
            free[1 - pole.held] |= is_there;
        }
        let frame = match surface {
            Surface::Cylinder { frame, .. }
            | Surface::Cone { frame, .. }
            | Surface::Sphere { frame, .. }
            | Surface::Torus { frame, .. } => frame,
            _ => return free,
        };
        let [x, y, _] = frame.local(p);
        free[0] |= libm::hypot(x, y) == 0.0;
        free
    }
}

impl Surface {
    /// See [`SurfaceFeet::parameters`]. Who asks often, of a spline above all, keeps a [`SurfaceFeet`].
    pub fn parameters(&self, p: Point, near: Option<[f64; 2]>) -> [f64; 2] {
        SurfaceFeet::new(self).parameters(p, near)
    }
}

/// The name of parameters that lies nearest to `near`, or within the domain.
fn lifted(
    own: [f64; 2],
    near: Option<[f64; 2]>,
    periods: [Option<f64>; 2],
    domain: [[f64; 2]; 2],
) -> [f64; 2] {
    [0, 1].map(|k| match (periods[k], near) {
        (None, _) => own[k],
        (Some(period), Some(near)) => own[k] + period * ((near[k] - own[k]) / period).round(),
        (Some(period), None) => {
            let turns = ((own[k] - domain[k][0]) / period).floor();
            let within = own[k] - period * turns;
            if within >= domain[k][1] { domain[k][0] } else { within }
        }
    })
}
