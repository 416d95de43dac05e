//! What drawings are made of.

use trueness_geom::section::PlaneFrame;
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
    /// Its ends, two corners of the box around its circle, or the control points of its spline.
    fn reach(&self, control: impl FnOnce(&S) -> Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        match self {
            Entity::Line { start, end } => vec![*start, *end],
            Entity::Arc { center, radius, .. } => [-radius, *radius].map(|r| center.map(|x| x + r)).to_vec(),
            Entity::Spline(spline) => control(spline),
        }
    }
}

/// The box around places; `None` of none.
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

/// What was read of a drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The entities in the order of the file; those of zero length are left out.
    pub entities: Vec<DrawnEntity>,
}

impl Drawing {
    /// Diagonal of the box around all ends, circles and control points; 0 of nothing.
    pub fn size(&self) -> f64 {
        let control = |curve: &Rational<3>| {
            let places = curve.masses().points().iter().filter_map(|m| m.place());
            places.map(|p| [p[0], p[1]]).collect()
        };
        let [low, high] =
            box_of(self.entities.iter().flat_map(|e| e.drawn.reach(control))).unwrap_or_default();
        libm::hypot(high[0] - low[0], high[1] - low[1])
    }
}

/// The entities of one layer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    /// Its name: letters, digits, `-` and `_`.
    pub name: String,
    /// Where its plane lies in space; drawings in the plane leave it out.
    pub frame: PlaneFrame,
    /// What is on it.
    pub entities: Vec<Entity>,
}

/// Box around all ends, centers with their radii, and control points; `None` of nothing.
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

    /// A line between two places, an arc, a circle and a spline.
    pub(crate) fn one_of_each(start: [f64; 2], end: [f64; 2]) -> [Entity; 4] {
        let round = |sweep| Entity::Arc { center: [1.0, 2.0], radius: 5.0, start: 0.5, sweep };
        let points = vec![[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]];
        let spline = Entity::Spline(Clamped { degree: 2, knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], points });
        [Entity::Line { start, end }, round(-1.0), round(std::f64::consts::TAU), spline]
    }
}
