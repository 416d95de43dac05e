//! Entities and layers of drawings.

use std::f64::consts::{FRAC_PI_2, TAU};
use trueness_geom::plane::PlaneFrame;
use trueness_geom::spline::rational::Rational;

/// An entity of a drawing. Lengths in millimeters, angles in radians. Splines are written as [`Clamped`] and read as [`Drawn`].
#[derive(Clone, Debug, PartialEq)]
pub enum Entity<S = Clamped> {
    /// A straight line.
    Line {
        /// Where it starts.
        start: [f64; 2],
        /// Where it ends.
        end: [f64; 2],
    },
    /// Part of a circle; a whole one where the sweep is a whole turn.
    Arc {
        /// Center of the circle.
        center: [f64; 2],
        /// Its radius.
        radius: f64,
        /// Angle of the start, seen from the center.
        start: f64,
        /// Angle run through, positive counter-clockwise.
        sweep: f64,
    },
    /// A B-spline.
    Spline(S),
}

/// A B-spline with clamped knots.
#[derive(Clone, Debug, PartialEq)]
pub struct Clamped {
    /// Its degree.
    pub degree: usize,
    /// Its knots.
    pub knots: Vec<f64>,
    /// Its control points.
    pub points: Vec<[f64; 2]>,
}

/// An entity as a drawing was read: its splines are polynomial (all weights are the same) or rational, in the plane z = 0.
pub type Drawn = Entity<Rational<3>>;

impl<S> Entity<S> {
    /// Its ends, with those places of an arc that lie farthest along the axes, or the control points of its spline.
    fn reach(&self, control: impl FnOnce(&S) -> Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        match self {
            Entity::Line { start, end } => vec![*start, *end],
            Entity::Arc { center, radius, start, sweep } => {
                let unit = reach_of_arc(*start, *sweep).into_iter();
                unit.map(|u| [0, 1].map(|k| center[k] + radius * u[k])).collect()
            }
            Entity::Spline(spline) => control(spline),
        }
    }
}

/// Ends of an arc of the unit circle, and the places on it where the circle crosses the axes.
fn reach_of_arc(start: f64, sweep: f64) -> Vec<[f64; 2]> {
    let end = start + sweep.clamp(-TAU, TAU);
    let on_circle = |angle: f64| [libm::cos(angle), libm::sin(angle)];
    let (low, high) = (start.min(end), start.max(end));
    let first = (low / FRAC_PI_2).ceil();
    let quarters = (0..=4).map(|k| first + f64::from(k)).filter(|q| q * FRAC_PI_2 <= high);
    let crossing = |q: f64| match q.rem_euclid(4.0) as u8 {
        0 => [1.0, 0.0],
        1 => [0.0, 1.0],
        2 => [-1.0, 0.0],
        _ => [0.0, -1.0],
    };
    [start, end].map(on_circle).into_iter().chain(quarters.map(crossing)).collect()
}

/// Diagonal of the box around places; 0 for no place.
fn diagonal(places: impl IntoIterator<Item = [f64; 2]>) -> f64 {
    let [low, high] = box_of(places).unwrap_or_default();
    libm::hypot(high[0] - low[0], high[1] - low[1])
}

/// The box around places; `None` for no place.
fn box_of(places: impl IntoIterator<Item = [f64; 2]>) -> Option<[[f64; 2]; 2]> {
    places.into_iter().map(|p| [p, p]).reduce(|[low, high], [p, _]| {
        [std::array::from_fn(|k| low[k].min(p[k])), std::array::from_fn(|k| high[k].max(p[k]))]
    })
}

/// An entity with the layer that it is on.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnEntity {
    /// Name of the layer.
    pub layer: String,
    /// Its course.
    pub drawn: Drawn,
}

/// The entities read from a drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The entities in the order of the file; those of zero length are left out.
    pub entities: Vec<DrawnEntity>,
}

impl Drawn {
    /// Places that the box around it must hold, with the control points of a spline.
    fn corners(&self) -> Vec<[f64; 2]> {
        self.reach(|curve| {
            let places = curve.masses().points().iter().filter_map(|m| m.place());
            places.map(|p| [p[0], p[1]]).collect()
        })
    }

    /// Diagonal of the box around it; for a spline, around its control points.
    pub fn size(&self) -> f64 {
        diagonal(self.corners())
    }
}

impl Drawing {
    /// Diagonal of the box around all lines, arcs and control points; 0 for an empty drawing.
    pub fn size(&self) -> f64 {
        diagonal(self.entities.iter().flat_map(|e| e.drawn.corners()))
    }
}

/// The entities of one layer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    /// Its name: letters, digits, `-` and `_`.
    pub name: String,
    /// Where its plane lies in space; drawings in the plane leave it out.
    pub frame: PlaneFrame,
    /// Its entities.
    pub entities: Vec<Entity>,
}

/// Box around all lines, arcs and control points; `None` for no entity.
pub(crate) fn bounds(layers: &[Layer]) -> Option<[[f64; 2]; 2]> {
    box_of(layers.iter().flat_map(|l| &l.entities).flat_map(|e| e.reach(|spline| spline.points.clone())))
}

/// Whether an arc is a whole circle.
pub(crate) fn whole(sweep: f64) -> bool {
    sweep.abs() >= std::f64::consts::TAU * (1.0 - 1e-12)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Boxes of arcs of all beginnings and sweeps are those of places close to each other along them.
    #[test]
    fn the_box_of_an_arc_is_that_of_its_places() {
        for (n, k) in (-9..=9).flat_map(|n| (-20..=20).map(move |k| (n, k))) {
            let (start, sweep) = (0.7 * f64::from(n), 0.31 * f64::from(k));
            let at = |t: f64| start + t * sweep.clamp(-TAU, TAU);
            let places = (0..=4000).map(|i| at(f64::from(i) / 4000.0));
            let dense = box_of(places.map(|a| [3.0 + 5.0 * libm::cos(a), 5.0 * libm::sin(a)])).unwrap();
            let arc: Entity = Entity::Arc { center: [3.0, 0.0], radius: 5.0, start, sweep };
            let found = box_of(arc.reach(|_| vec![])).unwrap();
            for (f, d) in found.iter().flatten().zip(dense.iter().flatten()) {
                assert!((f - d).abs() < 1e-5, "{start} {sweep}: {found:?} {dense:?}");
            }
        }
        let circle: Entity = Entity::Arc { center: [3.0, 0.0], radius: 5.0, start: 0.4, sweep: TAU };
        assert_eq!(box_of(circle.reach(|_| vec![])), Some([[-2.0, -5.0], [8.0, 5.0]]));
    }

    /// A line between two places, an arc, a circle and a spline.
    pub(crate) fn one_of_each(start: [f64; 2], end: [f64; 2]) -> [Entity; 4] {
        let round = |sweep| Entity::Arc { center: [1.0, 2.0], radius: 5.0, start: 0.5, sweep };
        let points = vec![[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]];
        let spline = Entity::Spline(Clamped { degree: 2, knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], points });
        [Entity::Line { start, end }, round(-1.0), round(std::f64::consts::TAU), spline]
    }
}
