//! Fits against answers of others, closed forms and their own laws.

mod certificate;
mod cones;
mod dual;
mod laws;
mod program;
mod recovery;
mod references;
mod robust;
mod slopes;
mod spread;

use super::{Fit, FitError, Method, Options, fit};
use crate::frame::Pose;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::shape::{Kind, Parameter, Shape};
use crate::space::{Point, Vector, plus, times};

/// Points on an element of the kind, with noise across it.
struct Made {
    kind: Kind,
    count: usize,
    /// Share of the full turn about the axis (and of the tube's turn, of the sphere's polar angle) that is seen.
    share: f64,
    noise: f64,
    seed: u64,
}

/// Where and how [`Made`] elements lie.
fn placement(kind: Kind) -> Pose {
    if kind.is_flat() {
        Pose::flat([31.0, -17.0, 0.0], [0.8, 0.6, 0.0])
    } else {
        Pose::along([31.0, -17.0, 55.0], [0.3, -0.5, 0.8])
    }
}

impl Made {
    /// The element without noise.
    fn shape(&self) -> Shape {
        let Pose { origin, axes: [u, _, w] } = placement(self.kind);
        match self.kind {
            Kind::Line2 => Shape::Line2 { point: origin, direction: u },
            Kind::Line => Shape::Line { point: origin, direction: w },
            Kind::Plane => Shape::Plane { point: origin, normal: w },
            Kind::Circle2 => Shape::Circle2 { center: origin, radius: 20.0 },
            Kind::Circle => Shape::Circle { center: origin, normal: w, radius: 20.0 },
            Kind::Ellipse2 => {
                Shape::Ellipse2 { center: origin, direction: u, major_radius: 30.0, minor_radius: 20.0 }
            }
            Kind::Sphere => Shape::Sphere { center: origin, radius: 20.0 },
            Kind::Cylinder => Shape::Cylinder { point: origin, direction: w, radius: 20.0 },
            Kind::Cone => {
                let half_angle = 0.3f64;
                let apex = plus(origin, times(-20.0 / half_angle.tan(), w));
                Shape::Cone { apex, direction: w, half_angle, point: origin, radius: 20.0 }
            }
            Kind::Torus => {
                Shape::Torus { center: origin, direction: w, major_radius: 20.0, minor_radius: 6.0 }
            }
        }
    }
    fn points(&self) -> Vec<Point> {
        let pose = placement(self.kind);
        let mut random = Random::new(self.seed);
        let mut next = move || random.unit();
        (0..self.count)
            .map(|_| {
                let turn = self.share * std::f64::consts::TAU * next();
                let (height, noise) =
                    (40.0 * (next() - 0.5), self.noise * (next() + next() + next() - 1.5) * 2.0);
                let local = self.local(turn, height, noise, &mut next);
                (0..3).fold(pose.origin, |p, k| plus(p, times(local[k], pose.axes[k])))
            })
            .collect()
    }
    fn local(&self, turn: f64, height: f64, noise: f64, next: &mut impl FnMut() -> f64) -> Vector {
        let (sin, cos) = turn.sin_cos();
        let radius = 20.0 + noise;
        match self.kind {
            Kind::Line2 => [height, noise, 0.0],
            Kind::Line => [noise, self.noise * (next() - 0.5), height],
            Kind::Plane => [height, 25.0 * (next() - 0.5), noise],
            Kind::Circle2 => [radius * cos, radius * sin, 0.0],
            Kind::Circle => [radius * cos, radius * sin, self.noise * (next() - 0.5)],
            Kind::Ellipse2 => {
                let (nx, ny) = (20.0 * cos, 30.0 * sin);
                let n = noise / nx.hypot(ny);
                [30.0 * cos + n * nx, 20.0 * sin + n * ny, 0.0]
            }
            Kind::Sphere => {
                let z = 1.0 - 2.0 * self.share * next();
                let across = (1.0 - z * z).sqrt() * radius;
                let turn = std::f64::consts::TAU * next();
                [across * turn.cos(), across * turn.sin(), z * radius]
            }
            Kind::Cylinder => [radius * cos, radius * sin, height],
            Kind::Cone => {
                let r = 20.0 + height * 0.3f64.tan() + noise * 0.3f64.cos();
                [r * cos, r * sin, height - noise * 0.3f64.sin()]
            }
            Kind::Torus => {
                let tube = std::f64::consts::TAU * next();
                let r = 20.0 + (6.0 + noise) * tube.cos();
                [r * cos, r * sin, (6.0 + noise) * tube.sin()]
            }
        }
    }
}

fn fitted(points: &[Point], kind: Kind, method: Method) -> Result<Fit, FitError> {
    fit(points, kind, &Options { method, ..Options::default() }, &Silent)
}

/// The methods that mean something for a kind.
fn methods(kind: Kind) -> impl Iterator<Item = Method> {
    let round = matches!(kind, Kind::Circle2 | Kind::Sphere | Kind::Cylinder);
    let zones = kind != Kind::Ellipse2;
    Method::ALL.into_iter().filter(move |m| match m {
        Method::Gaussian | Method::Robust => true,
        Method::MinimumZone => zones,
        Method::MinimumCircumscribed | Method::MaximumInscribed => round,
    })
}
