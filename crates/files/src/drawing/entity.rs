//! What drawings are made of.

use trueness_geom::section::PlaneFrame;
use trueness_geom::spline::rational::Rational;

/// An entity of a drawing. Lengths in millimeters, angles in radians.
#[derive(Clone, Debug, PartialEq)]
pub enum Entity {
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
    /// A B-spline with clamped knots.
    Spline {
        /// Its degree.
        degree: usize,
        /// Its knots.
        knots: Vec<f64>,
        /// Its control points.
        points: Vec<[f64; 2]>,
    },
}

/// An entity as a drawing was read. Lengths in millimeters, angles in radians.
#[derive(Clone, Debug, PartialEq)]
pub enum Drawn {
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
    /// A B-spline, polynomial (all weights are the same) or rational, in the plane z = 0.
    Spline(Rational<3>),
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
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut add = |p: [f64; 2]| {
            (0..2).for_each(|k| (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k])));
        };
        for entity in &self.entities {
            match &entity.drawn {
                Drawn::Line { start, end } => [*start, *end].into_iter().for_each(&mut add),
                Drawn::Arc { center, radius, .. } => {
                    [-radius, *radius].into_iter().for_each(|r| add(center.map(|x| x + r)));
                }
                Drawn::Spline(curve) => {
                    let places = curve.masses().points().iter().filter_map(|m| m.place());
                    places.for_each(|p| add([p[0], p[1]]));
                }
            }
        }
        if low[0] <= high[0] { libm::hypot(high[0] - low[0], high[1] - low[1]) } else { 0.0 }
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
    let mut range: Option<[[f64; 2]; 2]> = None;
    let mut add = |p: [f64; 2]| {
        let [low, high] = range.get_or_insert([p, p]);
        for k in 0..2 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    };
    for entity in layers.iter().flat_map(|l| &l.entities) {
        match entity {
            Entity::Line { start, end } => [*start, *end].into_iter().for_each(&mut add),
            Entity::Arc { center, radius, .. } => {
                [-radius, *radius].into_iter().for_each(|r| add([center[0] + r, center[1] + r]));
            }
            Entity::Spline { points, .. } => points.iter().copied().for_each(&mut add),
        }
    }
    range
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
        let spline = Entity::Spline { degree: 2, knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], points };
        [Entity::Line { start, end }, round(-1.0), round(std::f64::consts::TAU), spline]
    }
}
