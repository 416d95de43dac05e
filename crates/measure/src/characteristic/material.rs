//! The material requirements of ISO 2692:2021, by the surface: what the standard defines.
//!
//! A requirement sets a virtual condition: a perfect cylinder in the exact attitude (of a position also at the exact place), which the
//! surface must not pass. Its diameter is the maximum (least) material size and the tolerance. The tolerance is added where the surface
//! must lie within it (shaft by maximum, bore by least material), else taken off.
//!
//! The related size is the diameter of the smallest cylinder in that attitude and place around the surface (the largest within it). It is
//! the best over all motions that the datums leave free. The mating size is that of the cylinder that may lie anywhere (GN around, GX
//! within). Told are
//!
//! - as value, their difference: twice the offset of the axis, where the form is perfect;
//! - as greatest allowed value, the tolerance and what the mating size leaves of the maximum (least) material size: the bonus.
//!
//! The value keeps the limit exactly when the surface keeps the virtual condition. What some programs evaluate instead, the
//! axis of the mating cylinder against the tolerance and the bonus, differs where the form is not perfect.
//!
//! The straightness of an axis has no place and no attitude to keep: its virtual condition is that of the mating size alone. The value is
//! the difference of the mating size and the least-squares one (GG): for a bent cylinder of perfect sections the diameter of the zone of
//! its axis. The bonus is what the least-squares size leaves of the maximum (least) material size.
//!
//! A datum with a requirement is no longer the axis of its feature. The part may shift and lean as far as the datum's surface keeps its
//! own virtual condition. The value is the least over all these motions.

use super::kind::Measuring;
use super::located::{frame, system};
use super::measured_feature::MeasuredFeature;
use super::reason::{Impossible, NotMeasured};
use super::value::{Missing, Value};
use crate::requirement::Boundary;
use trueness_geom::fit::Method;
use trueness_geom::rigid::Rigid;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::{Point, Vector, dot, minus, norm, times};
use trueness_geom::zone::datum::Freedom;
use trueness_geom::zone::motion::{Placed, Search, placed};

/// Halvings of the search with a shifting datum: the answer's bounds then differ by nothing that shows.
const HALVINGS: usize = 48;
/// Millimeters by which rounding alone may put the datum's surface beyond its boundary.
const BOUNDARY_ROUNDING: f64 = 1e-9;

/// A straight line in the frame's coordinates.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    pub point: Point,
    /// Unit vector.
    pub direction: Vector,
}

impl Axis {
    /// Distance of a place from it, and the unit vector away from it.
    fn radial(&self, p: Point) -> (f64, Vector) {
        let q = minus(p, self.point);
        let out = minus(q, times(dot(q, self.direction), self.direction));
        let r = norm(out);
        (r, if r > 0.0 { times(1.0 / r, out) } else { [0.0; 3] })
    }
}

/// The surface of a cylinder that must not pass its boundary.
struct Surface<'a> {
    points: &'a [Point],
    /// Of each point the direction away from the feature's own axis, in the frame's coordinates.
    outward: Vec<Vector>,
    boundary: Boundary,
}

impl<'a> Surface<'a> {
    /// Of a feature whose points `start` takes to the frame's coordinates. The search may turn the part by little from there.
    fn new(
        feature: &'a MeasuredFeature,
        boundary: Boundary,
        start: &Rigid,
        m: &Measuring,
    ) -> Result<Surface<'a>, Missing> {
        let shape = feature.refitted(Kind::Cylinder, Method::Gaussian, m.progress)?.shape;
        let (Some(point), Some(direction)) = (shape.foot(), shape.direction()) else {
            return Err(NotMeasured::NoAxis.into());
        };
        let own = Axis { point, direction };
        let points = feature.own_points()?;
        let outward = points.iter().map(|p| start.vector(own.radial(*p).1)).collect();
        Ok(Surface { points, outward, boundary })
    }

    /// How far its point `i`, which came to lie at `p`, is beyond the boundary about `axis`, and the gradient.
    ///
    /// A boundary within the surface has all points on their own side of its axis. Beside a bore an empty cylinder may be as
    /// large as one likes: a point on the other side of the axis is beyond it by as much as it lies there.
    fn beyond(&self, i: usize, p: Point, axis: &Axis) -> (f64, Vector) {
        let (r, away) = axis.radial(p);
        let limit = 0.5 * self.boundary.size;
        if self.boundary.around {
            return (r - limit, away);
        }
        let own = self.outward[i];
        let side = r * dot(away, own);
        if side > 0.0 {
            return (limit - r, times(-1.0, away));
        }
        (limit - side, minus(times(dot(own, axis.direction), axis.direction), own))
    }
}

/// What the points of the toleranced feature must keep.
enum Asked<'a> {
    /// The surface must not pass a cylinder.
    Surface(Surface<'a>),
    /// The axis lies within a cylinder.
    Ends(Vec<Point>),
}

impl Asked<'_> {
    fn points(&self) -> &[Point] {
        match self {
            Asked::Surface(surface) => surface.points,
            Asked::Ends(points) => points,
        }
    }

    fn distance(&self, axis: &Axis, i: usize, p: Point) -> (f64, Vector) {
        match self {
            Asked::Surface(surface) => surface.beyond(i, p, axis),
            Asked::Ends(_) => axis.radial(p),
        }
    }
}

/// The value of a cylinder whose axis belongs at `axis` of the frame `start`, with the requirement of its tolerance.
pub(super) fn oriented(m: &Measuring, start: Rigid, free: Freedom, axis: Axis) -> Result<Value, Missing> {
    let Some(boundary) = m.spec.boundary else {
        return Err(Impossible::NoMaterial.into());
    };
    let asked = Asked::Surface(Surface::new(m.feature(), boundary, &start, m)?);
    let distance = |i: usize, p: Point| Some(asked.distance(&axis, i, p));
    let search = Search { start, free, middle: 0.0, floating: false, outer: true };
    let found = placed(asked.points(), &distance, &search, m.progress)?;
    result_at(m, &asked, &found)
}

/// The value of an axis that belongs at `place` across z of the datum system, where it or its last datum has a requirement.
pub(super) fn located(m: &Measuring, place: [f64; 2]) -> Result<Value, Missing> {
    let axis = Axis { point: [place[0], place[1], 0.0], direction: [0.0, 0.0, 1.0] };
    let (start, free) = frame(m)?;
    // What takes the axis along itself, or about itself, tells nothing.
    let telling = |mut free: Freedom| {
        free.shift[2] = false;
        free.turn[2] &= place != [0.0; 2];
        free
    };
    // The surface is sought from where its own axis is nearest to the place.
    let nearest = |_: usize, p: Point| Some(axis.radial(p));
    let search = Search { start, free: telling(free), middle: 0.0, floating: false, outer: false };
    let start = placed(&m.feature().zoned()?, &nearest, &search, m.progress)?.motion;
    let Some(datum) = m.spec.datums.last().and_then(|d| d.boundary) else {
        return oriented(m, start, telling(free), axis);
    };
    let asked = match m.spec.boundary {
        Some(boundary) => Asked::Surface(Surface::new(m.feature(), boundary, &start, m)?),
        None => Asked::Ends(m.feature().zoned()?),
    };
    let Some(feature) = m.datums.last().and_then(|d| d.first()) else {
        return Err(Impossible::NoDatum.into());
    };
    let shift = Shift { asked: &asked, axis, datum: Surface::new(feature, datum, &start, m)?, m };
    let free = match m.datums.len() {
        1 => Freedom::ALL,
        // After a plane: what that leaves free.
        _ => {
            let mut freed = system(m)?.free;
            (freed.shift[0], freed.shift[1], freed.turn[2]) = (true, true, true);
            freed
        }
    };
    let found = shift.best(start, telling(free), feature)?;
    let mut value = result_at(m, &asked, &found)?;
    value.parts.push(("datum_virtual_size", datum.size));
    Ok(value)
}

/// The straightness of a cylinder's axis with the requirement of its tolerance.
pub(super) fn straight(m: &Measuring) -> Result<Value, Missing> {
    let Some(boundary) = m.spec.boundary else {
        return Err(Impossible::NoMaterial.into());
    };
    let mating = mating(m.feature(), boundary.around, m)?;
    let global = diameter(m.feature(), Method::Gaussian, m)?;
    // The bonus goes by the size that the value goes by: the limit is kept exactly when the virtual condition is.
    let (global, spare) = match boundary.around {
        true => (global.min(mating), boundary.size - global.min(mating)),
        false => (global.max(mating), global.max(mating) - boundary.size),
    };
    let parts = vec![("global_size", global), ("mating_size", mating)];
    let value = Value { value: (mating - global).abs(), parts, ..Value::default() };
    Ok(with_bonus(value, spare, boundary, m))
}

/// The value and its bonus where the points came to lie.
fn result_at(m: &Measuring, asked: &Asked, found: &Placed) -> Result<Value, Missing> {
    let far = asked.points().get(found.max.1).copied();
    let mut value = Value { witness: far.into_iter().collect(), ..Value::default() };
    let Asked::Surface(Surface { boundary, .. }) = asked else {
        value.value = 2.0 * found.half;
        return Ok(value);
    };
    let related = match boundary.around {
        true => boundary.size + 2.0 * found.half,
        false => boundary.size - 2.0 * found.half,
    };
    let mating = mating(m.feature(), boundary.around, m)?;
    // The related cylinder is one of those that may lie anywhere: none of these is worse.
    let (mating, spare) = match boundary.around {
        true => (mating.min(related), boundary.size - mating.min(related)),
        false => (mating.max(related), mating.max(related) - boundary.size),
    };
    value.value = (mating - related).abs();
    value.parts = vec![("mating_size", mating), ("related_size", related)];
    Ok(with_bonus(value, spare, *boundary, m))
}

/// A value with its bonus, and the sizes that it comes from.
fn with_bonus(mut value: Value, spare: f64, boundary: Boundary, m: &Measuring) -> Value {
    value.bonus = spare;
    value.parts.insert(0, ("bonus", spare));
    value.parts.push(("material_size", boundary.size));
    if let crate::requirement::Limits::Greatest(t) = m.spec.limits {
        value.parts.push(("virtual_size", boundary.virtual_size(t)));
    }
    value
}

/// Diameter of the smallest cylinder around a feature, or of the largest within it.
fn mating(feature: &MeasuredFeature, around: bool, m: &Measuring) -> Result<f64, Missing> {
    diameter(feature, if around { Method::MinimumCircumscribed } else { Method::MaximumInscribed }, m)
}

/// Diameter of the cylinder associated with a feature.
fn diameter(feature: &MeasuredFeature, method: Method, m: &Measuring) -> Result<f64, Missing> {
    match feature.refitted(Kind::Cylinder, method, m.progress)?.shape {
        Shape::Cylinder { radius, .. } => Ok(2.0 * radius),
        _ => Err(NotMeasured::NoDiameter.into()),
    }
}

/// A toleranced feature and a datum that shifts within its boundary about z.
struct Shift<'a> {
    asked: &'a Asked<'a>,
    axis: Axis,
    datum: Surface<'a>,
    m: &'a Measuring<'a>,
}

impl Shift<'_> {
    /// The motion, with the datum's surface within its boundary, that brings the toleranced feature nearest to its place.
    ///
    /// With the greatest distance `w` allowed, the excess of a motion is the greater of two: the feature's beyond `w`, and the datum's
    /// beyond its boundary. The least over all motions falls as `w` grows; where it comes to 0 is the answer.
    fn best(&self, start: Rigid, free: Freedom, feature: &MeasuredFeature) -> Result<Placed, Missing> {
        let own = self.asked.points();
        let (none, z) = ([0.0; 3], [0.0, 0.0, 1.0]);
        let about = Axis { point: none, direction: z };
        let datum = |i: usize, p: Point| self.datum.beyond(i, p, &about);
        let search = |start| Search { start, free, middle: 0.0, floating: false, outer: true };
        // Where the datum has the most room.
        let alone = |i: usize, p: Point| Some(datum(i, p));
        let gauged = placed(self.datum.points, &alone, &search(start), self.m.progress)?;
        if gauged.half > BOUNDARY_ROUNDING {
            let (id, by) = (feature.id.clone(), 2.0 * gauged.half);
            return Err(NotMeasured::BeyondVirtualCondition { id, by }.into());
        }
        let all: Vec<Point> = own.iter().chain(self.datum.points).copied().collect();
        let within = |w: f64, from: Rigid| {
            let both = |i: usize, p: Point| {
                Some(match i < own.len() {
                    true => {
                        let (d, away) = self.asked.distance(&self.axis, i, p);
                        (d - w, away)
                    }
                    false => datum(i - own.len(), p),
                })
            };
            placed(&all, &both, &search(from), self.m.progress)
        };
        let at = |motion: Rigid| {
            let held = Search { start: motion, free: Freedom::NONE, ..search(motion) };
            let distance = |i: usize, p: Point| Some(self.asked.distance(&self.axis, i, p));
            placed(own, &distance, &held, self.m.progress)
        };
        let mut best = at(gauged.motion)?;
        let distance = |i: usize, p: Point| Some(self.asked.distance(&self.axis, i, p));
        let (mut low, mut high) =
            (placed(own, &distance, &search(gauged.motion), self.m.progress)?.half, best.half);
        for _ in 0..HALVINGS {
            let w = 0.5 * (low + high);
            if w <= low || w >= high {
                break;
            }
            let found = within(w, best.motion)?;
            if found.half <= BOUNDARY_ROUNDING * 1e-3 {
                let there = at(found.motion)?;
                high = w.min(there.half);
                best = if there.half < best.half { there } else { best };
            } else {
                low = w;
            }
        }
        Ok(best)
    }
}
