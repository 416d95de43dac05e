//! A curve taken apart into pieces that are asked for their nearest places.

use super::kinds::{Curve, Span};
use super::part::{Foot, Part, Shape, View, add};
use trueness_geom::space::{Aabb, Point, Vector, plus};
use trueness_geom::spline::value::Mass;

/// A range of a curve, ready to be asked for its nearest places: splines are cut at their knots, chains at their joints.
#[derive(Clone, Debug)]
pub struct CurveFeet {
    /// In the order of parameters.
    pub(super) parts: Vec<Part>,
    /// Whether the range runs backwards.
    pub(super) is_reversed: bool,
}

impl CurveFeet {
    /// Of the curve from one parameter to another; both may be infinite where its domain is.
    pub fn new(curve: &Curve, range: [f64; 2]) -> CurveFeet {
        CurveFeet::seen(curve, range, View::Space)
    }

    /// Of the shadow of the curve on the plane through the origin at right angles to a unit vector.
    pub fn along(curve: &Curve, range: [f64; 2], direction: Vector) -> CurveFeet {
        CurveFeet::seen(curve, range, View::Along(direction))
    }

    fn seen(curve: &Curve, [from, to]: [f64; 2], view: View) -> CurveFeet {
        let mut parts = vec![];
        add(curve, [from.min(to), from.max(to)], view, &mut parts);
        CurveFeet { parts, is_reversed: from > to }
    }

    /// The place nearest to a point within the range. Of several that are equally near one is taken, the same each time; on the axis of a
    /// circle that is its start.
    pub fn nearest(&self, p: Point) -> Foot {
        self.nearer(p, f64::INFINITY).unwrap_or(Foot {
            parameter: f64::NAN,
            place: [f64::NAN; 3],
            distance: f64::NAN,
        })
    }

    /// The nearest place, if it is nearer than `limit`.
    pub fn nearer(&self, p: Point, limit: f64) -> Option<Foot> {
        let mut best: Option<Foot> = None;
        let mut reach = limit;
        let mut look = |part: &Part| {
            if part.bounds.distance(&p) >= reach {
                return;
            }
            part.candidates(p, reach, self.is_reversed, &mut |foot: Foot| {
                if foot.distance < reach {
                    reach = foot.distance;
                    best = Some(foot);
                }
                reach
            });
        };
        if self.is_reversed {
            self.parts.iter().rev().for_each(&mut look)
        } else {
            self.parts.iter().for_each(look)
        }
        best
    }

    /// Hands over all places where the distance from a point has a minimum that is below `limit`, which the callback says anew, and
    /// some more, ends and corners among them.
    pub fn candidates(&self, p: Point, mut limit: f64, mut visit: impl FnMut(Foot) -> f64) {
        for part in &self.parts {
            if part.bounds.distance(&p) < limit {
                limit = part.candidates(p, limit, false, &mut visit);
            }
        }
    }

    /// A box around the range, for splines that of their control points. The smallest one is [`CurveFeet::exact_bounds`].
    pub fn bounds(&self) -> Aabb {
        self.parts.iter().fold(Aabb::EMPTY, |b, part| b.union(&part.bounds))
    }

    /// Boxes around the pieces with their first and last parameters.
    pub fn pieces(&self) -> impl Iterator<Item = (Aabb, [f64; 2])> + '_ {
        self.parts.iter().map(|part| (part.bounds, part.range))
    }

    /// Control points of the pieces of a spline, with their first and last parameters.
    pub(crate) fn beziers(&self) -> impl Iterator<Item = (&[Mass<3>], [f64; 2])> {
        self.parts.iter().filter_map(|part| match &part.shape {
            Shape::Bezier(bezier) => Some((bezier.points.as_slice(), part.range)),
            _ => None,
        })
    }

    /// A box around the part between two parameters of one piece.
    pub(crate) fn bounds_within(&self, range: [f64; 2]) -> Aabb {
        let is_around = |part: &&Part| part.range[0] <= range[0] && part.range[1] >= range[1];
        self.parts.iter().find(is_around).map_or(self.bounds(), |part| part.within(range).bounds)
    }

    /// Places whose hull of all lines, planes or spaces through them holds the range.
    pub(crate) fn support(&self) -> Vec<Point> {
        let of = |part: &Part| match &part.shape {
            Shape::Line { origin, direction } => vec![*origin, plus(*origin, *direction)],
            Shape::Conic(conic) => conic.support().to_vec(),
            Shape::Bezier(bezier) => bezier.places().collect(),
        };
        self.parts.iter().flat_map(of).collect()
    }
}

impl Span {
    /// The span, ready to be asked for its nearest places many times.
    pub fn feet(&self) -> CurveFeet {
        CurveFeet::new(&self.curve, self.range)
    }

    /// The place nearest to a point; see [`CurveFeet::nearest`]. Who asks often keeps [`Span::feet`].
    pub fn nearest(&self, p: Point) -> Foot {
        self.feet().nearest(p)
    }

    /// The share of the way from start to end of a parameter, 0 to 1.
    pub fn share(&self, parameter: f64) -> f64 {
        let [from, to] = self.range;
        ((parameter - from) / (to - from)).clamp(0.0, 1.0)
    }
}
