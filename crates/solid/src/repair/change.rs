//! A record of something that a step changed.

use super::step::Step;
use trueness_geom::space::Point;

/// Something that was changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The step that did it.
    pub step: &'static Step,
    /// Name of the change.
    pub what: &'static str,
    /// Where.
    pub position: Point,
    /// Facets concerned.
    pub facets: usize,
    /// How big: mm for vertices and edges, mm² for facets, mm³ for shells.
    pub size: f64,
}
