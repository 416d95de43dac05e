//! A place of a surface, as searches answer it.

use trueness_geom::space::Point;

/// A place of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Its parameters.
    pub parameters: [f64; 2],
    /// The place.
    pub place: Point,
    /// Its distance from the point that was asked for.
    pub distance: f64,
}
