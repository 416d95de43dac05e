//! Areas, volumes, first moments and bounds of faces, from exact surfaces within exact edges.
//!
//! By Green's theorem an integral over a face is one along its rings ([`crate::trim`]), of an integral across. The inner one is by a rule of
//! Gauss: exact for planes, cylinders, cones and extrusions, which are polynomials across, and up to rounding for spheres, tori and
//! revolutions, which are harmonics of low order; splines are taken from knot to knot, in so many steps that halving them changes nothing. The
//! outer one halves its steps until the error is what is asked for.

mod bounds;
mod integrand;
mod rule;
#[cfg(test)]
mod tests;

pub use bounds::bounds;

use crate::trim::{Piece, Trim};
use integrand::{Inner, TERMS};
use trueness_geom::space::{Point, Vector, minus, norm, plus, times};

/// Integrals over faces. Moments and volume are about [`Integrals::origin`]; a sum over a closed shell does not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integrals {
    /// The place that positions are taken from.
    pub origin: Point,
    /// Square millimeters.
    pub area: f64,
    /// `∫ x dA`: the center of the area, times the area.
    pub area_moment: Vector,
    /// `∫ x·n dA / 3` with the outward normal: over a closed shell the volume within.
    pub volume: f64,
    /// `∫ x² n dA / 2` along each axis: over a closed shell the center of the volume, times the volume.
    pub volume_moment: Vector,
    /// By how much area and volume may be off: what a weaker rule differs by.
    pub errors: [f64; 2],
}

/// The error that is asked for, as a share of the area, and of the area times the extent. What is measured is by how much a weaker rule
/// differs: the error itself is far less.
const ASKED: f64 = 1e-10;
/// Steps along the border of a face at most.
const MAX_STEPS: usize = 4000;

impl Integrals {
    /// Of one face.
    ///
    /// Cost: some thousand places of the surface, for splines some hundred thousand.
    ///
    /// ```
    /// use trueness_cad::{brep::{Bounds, Brep, Face}, frame::Frame, measure::Integrals, surface::Surface, trim::Trim};
    /// let frame = Frame::new([1.0, 2.0, 3.0], [0.0, 0.0, 1.0], None).unwrap();
    /// let face = Face {
    ///     surface: Surface::Sphere { frame, radius: 2.0 },
    ///     reversed: false,
    ///     bounds: Bounds::Loops(vec![]),
    ///     entity: 1,
    ///     name: String::new(),
    ///     color: None,
    ///     instance: 0,
    /// };
    /// let trim = Trim::new(&Brep::default(), &face, 0.0).unwrap();
    /// let whole = Integrals::of(&trim, [0.0; 3]);
    /// assert!((whole.area / (16.0 * std::f64::consts::PI) - 1.0).abs() < 1e-12);
    /// assert!((whole.volume / (32.0 / 3.0 * std::f64::consts::PI) - 1.0).abs() < 1e-12);
    /// ```
    pub fn of(trim: &Trim, origin: Point) -> Integrals {
        // Close to the face less is lost to rounding; moved to the origin afterward.
        let (center, size) = middle(trim);
        let inner = Inner::new(trim, center);
        let value = |piece: usize, t: f64| {
            let (ring, number) = inner.pieces[piece];
            inner.along(&trim.rings[ring].pieces[number], t)
        };
        let (mut parts, mut owner) = (vec![], vec![]);
        for piece in 0..inner.pieces.len() {
            let (ring, number) = inner.pieces[piece];
            for w in inner.breaks(&trim.rings[ring].pieces[number]).windows(2) {
                parts.push(rule::kronrod([w[0], w[1]], &|t| value(piece, t)));
                owner.push(piece);
            }
        }
        let area: f64 = parts.iter().map(|p| p.sum[0]).sum::<f64>().abs().max(f64::MIN_POSITIVE);
        let asked: [f64; TERMS] = std::array::from_fn(|n| ASKED * area * libm::pow(size, DEGREES[n]));
        let most = parts.len() + MAX_STEPS;
        let (sum, error) = rule::adaptive(parts, asked, most, &value, owner);
        let sense = if trim.reversed { -1.0 } else { 1.0 };
        Integrals {
            origin: center,
            area: sum[0],
            area_moment: [sum[1], sum[2], sum[3]],
            volume: sense * sum[4..7].iter().sum::<f64>() / 3.0,
            volume_moment: [sum[7], sum[8], sum[9]].map(|m| sense * m),
            errors: [error[0], error[4..7].iter().sum::<f64>() / 3.0],
        }
        .about(origin, [4, 5, 6].map(|n| sense * sum[n]), [10, 11, 12].map(|n| sense * sum[n]))
    }

    /// The same about another origin, with `∫ x n dA` along each axis and `∫ n dA`.
    fn about(self, origin: Point, flux: Vector, normals: Vector) -> Integrals {
        let by = minus(self.origin, origin);
        let through = trueness_geom::space::dot(by, normals);
        Integrals {
            origin,
            area_moment: plus(self.area_moment, times(self.area, by)),
            volume: self.volume + through / 3.0,
            volume_moment: std::array::from_fn(|k| {
                self.volume_moment[k] + by[k] * flux[k] + 0.5 * by[k] * by[k] * normals[k]
            }),
            ..self
        }
    }

    /// Both together; about the origin of the first.
    pub fn plus(&self, other: &Integrals) -> Integrals {
        Integrals {
            origin: self.origin,
            area: self.area + other.area,
            area_moment: plus(self.area_moment, other.area_moment),
            volume: self.volume + other.volume,
            volume_moment: plus(self.volume_moment, other.volume_moment),
            errors: [0, 1].map(|k| self.errors[k] + other.errors[k]),
        }
    }

    /// The center of the area.
    pub fn center_of_area(&self) -> Point {
        plus(self.origin, times(1.0 / self.area, self.area_moment))
    }

    /// The center of the volume within a closed shell.
    pub fn center_of_volume(&self) -> Point {
        plus(self.origin, times(1.0 / self.volume, self.volume_moment))
    }
}

/// The power of a length in each term beyond an area.
const DEGREES: [f64; TERMS] = [0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 0.0, 0.0, 0.0];

/// A place amid a face, and how far it reaches from there.
fn middle(trim: &Trim) -> (Point, f64) {
    let places: Vec<Point> = trim
        .rings
        .iter()
        .flat_map(|r| &r.pieces)
        .flat_map(Piece::places)
        .map(|(at, _)| trim.chart.place(at))
        .collect();
    let center = times(1.0 / places.len() as f64, places.iter().fold([0.0; 3], |s, p| plus(s, *p)));
    (center, places.iter().map(|p| norm(minus(*p, center))).fold(0.0, f64::max))
}
