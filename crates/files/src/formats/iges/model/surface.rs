//! Surfaces of a file.

use super::super::record::Record;
use super::geometry::{Geometry, numbers};
use super::{powers, ruled};
use crate::formats::brep::MAX_BASES;
use crate::formats::brep::Wrong;
use crate::formats::spline::{Raw, surface as spline_surface};
use std::f64::consts::{PI, TAU};
use trueness_cad::curve::{Curve, Span};
use trueness_cad::frame::{Frame, Placement};
use trueness_cad::surface::Surface;
use trueness_geom::space::{Point, Vector, dot, minus, norm, times, unit};
use trueness_geom::spline::rational::Rational;
use trueness_geom::spline::value::Mass;

/// A surface as the file has it.
pub(super) struct Patch {
    pub surface: Surface,
    /// Whether the normal that the file gives it is opposite to `∂u × ∂v`.
    pub is_flipped: bool,
    /// First and last `u` and `v`; infinite where it has no end.
    pub sides: [[f64; 2]; 2],
    /// How the parameters of the file become `u` and `v`; `None` where the file gives them another meaning.
    pub parameters: Option<Parameters>,
}

/// How parameters of the file become those of a surface.
#[derive(Clone, Copy)]
pub(super) struct Parameters {
    /// The first of the file is `v`.
    pub is_swapped: bool,
    /// What the first of the file is multiplied with, and what is added then.
    pub first: [f64; 2],
}

const SAME_PARAMETERS: Option<Parameters> = Some(Parameters { is_swapped: false, first: [1.0, 0.0] });
/// Radians by which a whole turn may miss one: programs write six digits.
const WHOLE_TURN: f64 = 2e-5;

/// Kinds of surfaces that are read.
pub(super) const SURFACE_KINDS: [u64; 12] = [108, 114, 118, 120, 122, 128, 140, 190, 192, 194, 196, 198];

impl Geometry<'_> {
    /// A surface.
    pub fn surface(&self, number: u64, depth: usize) -> Result<Patch, Wrong> {
        let record = self.file.record(number)?;
        if depth > MAX_BASES {
            return Err(record.wrong("rests on itself"));
        }
        self.budget.spend(1, &record)?;
        let patch = match record.entity.kind {
            108 => self.plane(&record)?,
            114 => Patch::spline(Surface::Spline(Box::new(powers::surface(self, &record)?))),
            118 => Patch::spline(Surface::Spline(Box::new(ruled::surface(self, &record)?))),
            120 => self.revolution(&record)?,
            122 => self.tabulated(&record)?,
            128 => self.spline_surface(&record)?,
            140 => self.offset_surface(&record, depth)?,
            190 | 192 | 194 | 196 | 198 => Patch::whole(self.elementary(&record)?),
            kind => return Err(record.wrong(format!("is no surface that is read but of the kind {kind}"))),
        };
        let at = self.placed(&record)?;
        if at == Placement::IDENTITY {
            return Ok(patch);
        }
        let scales = patch.surface.parameter_scales(at.scale);
        let sides = [0, 1].map(|k| patch.sides[k].map(|x| x * scales[k]));
        let is_flipped = patch.is_flipped != at.is_mirrored();
        Ok(Patch { surface: patch.surface.placed(&at), is_flipped, sides, ..patch })
    }

    /// All places with `A x + B y + C z = D`.
    fn plane(&self, record: &Record) -> Result<Patch, Wrong> {
        let wrong = || record.wrong("is a plane without a normal");
        let (normal, length) = unit(record.triple(0)?).ok_or_else(wrong)?;
        let foot = times(record.real(3)? / length * self.unit, normal);
        let frame = Frame::new(self.finite(record, foot)?, normal, None).ok_or_else(wrong)?;
        Ok(Patch { parameters: None, ..Patch::whole(Surface::Plane(frame)) })
    }

    fn elementary(&self, record: &Record) -> Result<Surface, Wrong> {
        let above_0 = |k: usize| {
            let length = record.real(k)? * self.unit;
            match length > 0.0 && length.is_finite() {
                true => Ok(length),
                false => {
                    Err(record.wrong(format!("has a length that is not above 0 as parameter {}", k + 1)))
                }
            }
        };
        Ok(match record.entity.kind {
            190 => Surface::Plane(self.axes(record, 0, 1, 2)?),
            192 => Surface::Cylinder { frame: self.axes(record, 0, 1, 3)?, radius: above_0(2)? },
            194 => {
                let (radius, half_angle) = (record.real(2)? * self.unit, record.real(3)? * PI / 180.0);
                if !(radius >= 0.0 && half_angle > 0.0 && half_angle < PI / 2.0) {
                    return Err(record.wrong("has a radius below 0 or an angle that no cone has"));
                }
                Surface::Cone { frame: self.axes(record, 0, 1, 4)?, radius, half_angle }
            }
            196 => Surface::Sphere { frame: self.axes(record, 0, 2, 3)?, radius: above_0(1)? },
            _ => {
                Surface::Torus { frame: self.axes(record, 0, 1, 4)?, major: above_0(2)?, minor: above_0(3)? }
            }
        })
    }

    /// A curve that turns about a line, from one angle to another. The file has the parameter of the curve first.
    fn revolution(&self, record: &Record) -> Result<Patch, Wrong> {
        let axis = self.curve(record.pointer(0)?)?;
        let [from, to] = axis.ends();
        let Some((axis, _)) = unit(minus(to, from)) else {
            return Err(record.wrong("turns about a line without a direction"));
        };
        let (Span { curve, range }, first) = profile(self.curve(record.pointer(1)?)?, from, axis);
        let [start, mut end] = [record.real(2)?, record.real(3)?];
        if (end - start - TAU).abs() <= WHOLE_TURN {
            end = start + TAU;
        }
        if !(end > start && end - start <= TAU + WHOLE_TURN) {
            return Err(record.wrong("turns from an angle to one that does not lie within a turn behind it"));
        }
        let surface = Surface::Revolution { curve: Box::new(curve), origin: from, axis };
        let parameters = Some(Parameters { is_swapped: true, first });
        Ok(Patch { surface, is_flipped: true, sides: [[start, end], ordered(range)], parameters })
    }

    /// A curve that moves along the line from its start to a place.
    fn tabulated(&self, record: &Record) -> Result<Patch, Wrong> {
        let Span { curve, range } = self.curve(record.pointer(0)?)?;
        let direction = minus(self.place(record, 1)?, curve.at(range[0]));
        if norm(direction) == 0.0 {
            return Err(record.wrong("moves its curve nowhere"));
        }
        let surface = Surface::Extrusion { curve: Box::new(curve), direction };
        let [low, high] = ordered(range);
        let parameters = Some(Parameters { is_swapped: false, first: [high - low, low] });
        Ok(Patch { surface, is_flipped: false, sides: [[low, high], [0.0, 1.0]], parameters })
    }

    fn spline_surface(&self, record: &Record) -> Result<Patch, Wrong> {
        let [(m, p), (n, q)] = [numbers(record, 0, 2)?, numbers(record, 1, 3)?];
        let net = m.saturating_mul(n);
        if net > record.len() {
            return Err(record.wrong(format!(
                "is cut short: {net} control points declared, {} present",
                record.len() / 4
            )));
        }
        self.budget.spend(net, record)?;
        let (a, b) = (m + p + 1, n + q + 1);
        let knots = record.reals(9, a + b)?;
        let weights = record.reals(9 + a + b, net)?;
        let points = record.reals(9 + a + b + net, 3 * net)?;
        // In the file points run along u first.
        let turn = |k: usize| (k % n) * m + k / n;
        let point = |k: usize| [0, 1, 2].map(|i| points[3 * turn(k) + i] * self.unit);
        let raw = Raw {
            degree: vec![p, q],
            knots: vec![knots[..a].to_vec(), knots[a..].to_vec()],
            counts: vec![m, n],
            points: (0..net).map(point).collect(),
            weights: (0..net).map(|k| weights[turn(k)]).collect(),
        };
        let nurbs = spline_surface(raw).map_err(|fault| record.wrong(fault.to_string()))?;
        let mut patch = Patch::spline(Surface::Spline(Box::new(nurbs)));
        let ends = 9 + a + b + 4 * net;
        if record.len() > ends + 3 {
            for k in 0..2 {
                let [low, high] = patch.sides[k];
                let own =
                    [record.real(ends + 2 * k)?, record.real(ends + 2 * k + 1)?].map(|t| t.clamp(low, high));
                if own[0] >= own[1] {
                    return Err(record.wrong("has sides that end before they begin"));
                }
                patch.sides[k] = own;
            }
        }
        Ok(patch)
    }

    /// A surface moved along its normal, to the side of a given direction in the middle of its parameters.
    fn offset_surface(&self, record: &Record, depth: usize) -> Result<Patch, Wrong> {
        let basis = self.surface(record.pointer(4)?, depth + 1)?;
        let finite = |[low, high]: [f64; 2]| {
            if low.is_finite() && high.is_finite() { 0.5 * (low + high) } else { 0.0 }
        };
        let [u, v] = basis.sides.map(finite);
        let toward: Vector = record.triple(0)?;
        let side = basis.surface.normal(u, v).map_or(0.0, |normal| dot(normal, toward));
        if side == 0.0 {
            return Err(record.wrong("is an offset to neither side: its direction lies within the surface"));
        }
        let distance = record.real(3)? * self.unit * side.signum();
        let surface = Surface::Offset { basis: Box::new(basis.surface), distance };
        Ok(Patch { surface, ..basis })
    }
}

impl Patch {
    /// A surface without ends but those of its kind.
    fn whole(surface: Surface) -> Patch {
        let sides = surface.domain();
        Patch { surface, is_flipped: false, sides, parameters: None }
    }

    fn spline(surface: Surface) -> Patch {
        Patch { parameters: SAME_PARAMETERS, ..Patch::whole(surface) }
    }

    /// Whether it has an end on all sides.
    pub fn is_bounded(&self) -> bool {
        self.sides.as_flattened().iter().all(|x| x.is_finite())
    }
}

fn ordered([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

/// Share of its size within which a curve that comes near the axis ends on it: rounding of the digits of a file.
const ON_AXIS: f64 = 1e-6;

/// A curve that is turned about an axis, and how the file's parameter becomes its own. A circle or an ellipse that would cross the axis keeps its ends.
fn profile(span: Span, origin: Point, axis: Vector) -> (Span, [f64; 2]) {
    let Span { curve, range } = span;
    let off = |p: Point| {
        let arm = minus(p, origin);
        minus(arm, times(dot(arm, axis), axis))
    };
    if curve.period().is_some() {
        let arms = [0.0, 0.25, 0.5, 0.75].map(|share| off(curve.at(TAU * share)));
        if arms.iter().any(|arm| dot(*arm, off(curve.at(0.5 * (range[0] + range[1])))) < 0.0) {
            let width = range[1] - range[0];
            let first = [1.0 / width, -range[0] / width];
            return (Span { curve: Curve::Joined(vec![Span { curve, range }]), range: [0.0, 1.0] }, first);
        }
        return (Span { curve, range }, [1.0, 0.0]);
    }
    let size = norm(minus(curve.at(range[0]), curve.at(range[1])));
    let onto = |p: Point| {
        let arm = off(p);
        if norm(arm) <= ON_AXIS * size { minus(p, arm) } else { p }
    };
    let curve = match curve {
        Curve::Spline(spline) => {
            let mut points = spline.points().to_vec();
            if let [first, .., last] = &mut points[..] {
                (*first, *last) = (onto(*first), onto(*last));
            }
            trueness_geom::spline::curve::Curve::new(spline.knots().clone(), points)
                .map_or(Curve::Spline(spline), Curve::Spline)
        }
        Curve::Rational(rational) => {
            let mut masses = rational.masses().points().to_vec();
            let moved = |m: &Mass<3>| m.place().map_or(*m, |p| Mass::new(onto(p), m.mass));
            if let [first, .., last] = &mut masses[..] {
                (*first, *last) = (moved(first), moved(last));
            }
            Rational::of_masses(rational.masses().knots().clone(), masses)
                .map_or(Curve::Rational(rational), Curve::Rational)
        }
        other => other,
    };
    (Span { curve, range }, [1.0, 0.0])
}
