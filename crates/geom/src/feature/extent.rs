//! How far a nominal feature goes.

use super::rules::Rules;
use super::{FeatureError, Nearness, Nominal};
use crate::space::{Aabb, Point};

/// Nothing is sought, only how far a nominal goes is asked.
const NOTHING_SOUGHT: Nearness = Nearness { distance: 0.0, angle: 0.0, margin: 0.0, rim: true, inward: None };

/// How far a nominal feature goes.
pub(crate) struct Extent(Rules<'static>);

impl Extent {
    /// # Errors
    /// [`FeatureError`]: a nominal feature that makes no sense.
    pub(crate) fn new(nominal: &Nominal) -> Result<Extent, FeatureError> {
        Ok(Extent(Rules::new(nominal, &NOTHING_SOUGHT)?))
    }

    /// How far a place lies within its bounds, along it; below zero beyond them, infinite where it has none.
    pub(crate) fn within(&self, p: Point) -> f64 {
        self.0.within(p)
    }

    /// Places all over it.
    pub(super) fn places(&self) -> Vec<Point> {
        self.0.starts()
    }

    /// A box around it.
    pub(crate) fn bounds(&self) -> Aabb {
        self.0.bounds()
    }
}
