//! The loss in writing a format.

use trueness_geom::parallel::prelude::*;
use trueness_geom::space::Point;

/// The loss in writing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loss {
    /// Positions that changed.
    pub moved: u64,
    /// The greatest change of a coordinate, millimeters.
    pub farthest: f64,
}

impl Loss {
    /// The loss by rounding to single precision.
    pub(crate) fn of_single_precision(positions: &[Point]) -> Loss {
        let change = |p: &Point| p.iter().map(|x| (x - f64::from(*x as f32)).abs()).fold(0.0, f64::max);
        let add = |a: Loss, b: Loss| Loss { moved: a.moved + b.moved, farthest: a.farthest.max(b.farthest) };
        let one = |p: &Point| {
            let farthest = change(p);
            Loss { moved: u64::from(farthest > 0.0), farthest }
        };
        positions.par_iter().map(one).reduce(Loss::default, add)
    }
}
