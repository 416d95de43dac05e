//! Curves of a file. All of them have ends.

use super::super::record::Record;
use super::conic;
use super::geometry::{Geometry, numbers, upright};
use super::powers;
use crate::formats::brep::span::{self, MAX_GAP};
use crate::formats::brep::{MAX_BASES, Wrong};
use crate::formats::spline::{Raw, cad_curve};
use std::f64::consts::TAU;
use trueness_cad::curve::{Curve, Span};
use trueness_cad::frame::Placement;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// Sine of an angle within which two unit vectors are along each other: rounding of the digits of a file.
const IN_PLANE: f64 = 1e-6;

/// Kinds of curves that are read.
pub(super) const CURVE_KINDS: [u64; 9] = [100, 102, 104, 106, 110, 112, 116, 126, 130];

impl Geometry<'_> {
    /// The pieces of a curve, one after another; those of a composite curve (102) are its members'. Pieces without extent are left out.
    pub fn chain(&self, number: u64) -> Result<Vec<Span>, Wrong> {
        let mut spans = vec![];
        self.add_pieces(number, Placement::IDENTITY, 0, &mut spans)?;
        match spans.is_empty() {
            true => Err(self.file.record(number)?.wrong("is a curve without extent")),
            false => Ok(spans),
        }
    }

    fn add_pieces(
        &self,
        number: u64,
        at: Placement,
        depth: usize,
        spans: &mut Vec<Span>,
    ) -> Result<(), Wrong> {
        let record = self.file.record(number)?;
        if depth > MAX_BASES {
            return Err(record.wrong("rests on itself"));
        }
        if record.entity.kind != 102 {
            let span = self.piece(&record, depth)?;
            let span = if at == Placement::IDENTITY { span } else { span.placed(&at) };
            let places = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| span.derivatives(share)[0]);
            if !places.as_flattened().iter().all(|x| x.is_finite()) {
                return Err(record.wrong("has no place on its curve"));
            }
            if places[1..].iter().any(|p| *p != places[0]) {
                spans.push(span);
            }
            return Ok(());
        }
        let count = record.count(0)?;
        self.budget.spend(1 + count, &record)?;
        let at = at.after(&self.placed(&record)?);
        for k in 1..=count {
            self.add_pieces(record.pointer(k)?, at, depth + 1, spans)?;
        }
        Ok(())
    }

    /// A curve as one, from its start to its end.
    pub fn curve(&self, number: u64) -> Result<Span, Wrong> {
        let mut spans = self.chain(number)?;
        if spans.len() > 1 {
            let record = self.file.record(number)?;
            for pair in spans.windows(2) {
                let gap = norm(minus(pair[1].ends()[0], pair[0].ends()[1]));
                let reach = norm(minus(pair[1].ends()[1], pair[1].ends()[0]));
                if gap > self.tolerance.max(MAX_GAP * reach) {
                    return Err(record.wrong(format!("has members with a gap of {gap:.3e} mm between them")));
                }
            }
            let range = [0.0, spans.len() as f64];
            return Ok(Span { curve: Curve::Joined(spans), range });
        }
        spans.pop().ok_or_else(|| Wrong {
            entity: number,
            line: 0,
            reason: "is a curve without extent".into(),
        })
    }

    fn piece(&self, record: &Record, depth: usize) -> Result<Span, Wrong> {
        self.budget.spend(1, record)?;
        let span = match record.entity.kind {
            100 => self.arc(record)?,
            104 => conic::conic(self, record)?,
            106 => self.points(record)?,
            110 => self.line(record)?,
            112 => powers::curve(self, record)?,
            116 => {
                let p = self.place(record, 0)?;
                Span { curve: Curve::Polyline(vec![p, p]), range: [0.0, 1.0] }
            }
            126 => self.spline(record)?,
            130 => self.offset(record, depth)?,
            kind => return Err(record.wrong(format!("is no curve that is read but of the kind {kind}"))),
        };
        let at = self.placed(record)?;
        Ok(if at == Placement::IDENTITY { span } else { span.placed(&at) })
    }

    fn line(&self, record: &Record) -> Result<Span, Wrong> {
        let [from, to] = [self.place(record, 0)?, self.place(record, 3)?];
        let direction = minus(to, from);
        let curve = match norm(direction) > 0.0 {
            true => Curve::Line { origin: from, direction },
            false => Curve::Polyline(vec![from, to]),
        };
        Ok(Span { curve, range: [0.0, 1.0] })
    }

    /// A circle from one place to another against the clock, in the plane of its z. Its parameter is the angle from x, as in the file.
    fn arc(&self, record: &Record) -> Result<Span, Wrong> {
        let n = record.reals(0, 7)?;
        let [start, end] = [[n[3] - n[1], n[4] - n[2]], [n[5] - n[1], n[6] - n[2]]];
        let radius = libm::hypot(start[0], start[1]) * self.unit;
        let center = self.finite(record, [n[1], n[2], n[0]].map(|x| x * self.unit))?;
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(record.wrong("is an arc without a radius"));
        }
        let angle = |[x, y]: [f64; 2]| libm::atan2(y, x);
        let from = angle(start).rem_euclid(TAU);
        let curve = Curve::Circle { frame: upright(center), radius };
        span::from_parameters(curve, [from, angle(end)], true).map_err(|reason| record.wrong(reason))
    }

    /// Points, straight from one to the next.
    fn points(&self, record: &Record) -> Result<Span, Wrong> {
        if !matches!(record.entity.form, 1..=3 | 11..=13 | 63) {
            return Err(record.wrong(format!("is of the form {}, which is no curve", record.entity.form)));
        }
        let (width, first) = match record.integer(0)? {
            1 => (2, 3),
            2 => (3, 2),
            3 => (6, 2),
            kind => return Err(record.wrong(format!("has tuples of the kind {kind}, which there is not"))),
        };
        let count = record.count(1)?;
        self.budget.spend(count, record)?;
        let height = if width == 2 { record.real(2)? } else { 0.0 };
        let numbers = record.reals(first, width * count)?;
        let place = |t: &[f64]| [t[0], t[1], if width == 2 { height } else { t[2] }].map(|x| x * self.unit);
        let points: Vec<Point> = numbers.chunks(width).map(place).collect();
        if points.len() < 2 {
            return Err(record.wrong("has fewer than two points"));
        }
        for p in &points {
            self.finite(record, *p)?;
        }
        let range = [0.0, points.len() as f64 - 1.0];
        Ok(Span { curve: Curve::Polyline(points), range })
    }

    fn spline(&self, record: &Record) -> Result<Span, Wrong> {
        let (count, degree) = numbers(record, 0, 1)?;
        let knots = record.reals(6, count + degree + 1)?;
        let first = 6 + knots.len();
        let weights = record.reals(first, count)?;
        let points = record.reals(first + count, 3 * count)?;
        self.budget.spend(count, record)?;
        let ends = first + 4 * count;
        let raw = Raw {
            degree: vec![degree],
            knots: vec![knots],
            counts: vec![count],
            points: points.as_chunks::<3>().0.iter().map(|p| p.map(|x| x * self.unit)).collect(),
            weights,
        };
        let curve = cad_curve(raw).map_err(|fault| record.wrong(fault.to_string()))?;
        let [low, high] = curve.domain();
        // Some programs leave the ends out, or write 0 for both.
        let ends = match record.len() > ends + 1 {
            true => [record.real(ends)?, record.real(ends + 1)?],
            false => [0.0; 2],
        };
        let range = if ends[0] == ends[1] { [low, high] } else { ends.map(|t| t.clamp(low, high)) };
        match range[0] < range[1] {
            true => Ok(Span { curve, range }),
            false => Err(record.wrong("ends before it begins")),
        }
    }

    /// The offset by one distance of a line, or of a circle in its plane.
    fn offset(&self, record: &Record, depth: usize) -> Result<Span, Wrong> {
        let basis = self.file.record(record.pointer(0)?)?;
        if depth > MAX_BASES || basis.entity.kind == 130 {
            return Err(record.wrong("rests on itself"));
        }
        let Span { curve, range } = self.piece(&basis, depth + 1)?;
        let distance = record.real(5)? * self.unit;
        let side = unit(record.triple(9)?).map(|(v, _)| v);
        let moved = side
            .filter(|_| matches!(record.integer(1), Ok(1)))
            .and_then(|side| moved(&curve, side, distance));
        let curve = moved.ok_or_else(|| {
            record.wrong("is an offset of a curve that is neither a line nor a circle in its plane, or by a distance that changes")
        })?;
        let ends = [record.real(12)?, record.real(13)?];
        let own = range[0] <= ends[0] && ends[0] < ends[1] && ends[1] <= range[1];
        Ok(Span { curve, range: if own { ends } else { range } })
    }
}

/// A line, or a circle in its plane, moved to the side that is at right angles to its tangent and to `normal`.
fn moved(curve: &Curve, normal: Vector, distance: f64) -> Option<Curve> {
    match curve {
        Curve::Line { origin, direction } => {
            let (across, _) = unit(cross(normal, *direction))?;
            Some(Curve::Line { origin: plus(*origin, times(distance, across)), direction: *direction })
        }
        Curve::Circle { frame, radius } if norm(cross(normal, frame.axes[2])) < IN_PLANE => {
            let radius = radius - distance * dot(normal, frame.axes[2]).signum();
            (radius > 0.0).then_some(Curve::Circle { frame: *frame, radius })
        }
        _ => None,
    }
}
