//! Curves of a file.

use super::super::part21::{Entity, File, Record, Value, Wrong};
use super::super::spline::{CURVES, spline};
use super::placement::{Units, direction, frame, operator, point, vector};
use crate::formats::brep::{Budget, MAX_BASES, span};
use crate::formats::spline::cad_curve;
use trueness_cad::curve::{Curve, Span};
use trueness_geom::space::{Point, cross, dot, minus, norm, plus, times, unit};

/// What geometry is read with.
#[derive(Clone, Copy)]
pub(super) struct Geometry<'f> {
    pub file: &'f File<'f>,
    pub units: Units,
    /// Within which two places are one, millimeters.
    pub tolerance: f64,
    pub budget: &'f Budget,
}

/// Entities that carry a curve in space beside others.
const CARRIERS: [&str; 4] = ["SURFACE_CURVE", "SEAM_CURVE", "INTERSECTION_CURVE", "BOUNDED_SURFACE_CURVE"];
/// Chains of curves.
const CHAINS: [&str; 4] =
    ["COMPOSITE_CURVE", "COMPOSITE_CURVE_ON_SURFACE", "BOUNDARY_CURVE", "OUTER_BOUNDARY_CURVE"];

impl<'f> Geometry<'f> {
    pub fn point(&self, number: u64) -> Result<Point, Wrong> {
        point(self.file, self.units, number)
    }

    /// A length that must be above 0, millimeters.
    pub fn length(&self, record: &Record, index: usize) -> Result<f64, Wrong> {
        let length = record.real(index)? * self.units.length;
        match length > 0.0 && length.is_finite() {
            true => Ok(length),
            false => {
                Err(record.wrong(format!("has a length that is not above 0 as parameter {}", index + 1)))
            }
        }
    }

    /// The curve of an edge, without the ends that a trimmed curve has, and whether it has that curve's sense.
    pub fn edge_curve(&self, number: u64) -> Result<(Curve, bool), Wrong> {
        let (mut number, mut same) = (number, true);
        for _ in 0..MAX_BASES {
            let entity = self.file.entity(number)?;
            if let Some(trimmed) = entity.record("TRIMMED_CURVE") {
                same ^= !trimmed.truth(4)?;
                number = trimmed.entity(1)?;
            } else if let Some(carried) = carried(&entity) {
                number = carried?;
            } else {
                return Ok((self.curve(number, 0)?, same));
            }
        }
        Err(self.file.entity(number)?.wrong("rests on itself"))
    }

    /// A curve.
    pub fn curve(&self, number: u64, depth: usize) -> Result<Curve, Wrong> {
        let entity = self.file.entity(number)?;
        if depth > MAX_BASES {
            return Err(entity.wrong("rests on itself"));
        }
        if let Some(curve) = self.spline(&entity)? {
            return Ok(curve);
        }
        if let Some(carried) = carried(&entity) {
            return self.curve(carried?, depth + 1);
        }
        let record = entity.main(&[]);
        let frame = || frame(self.file, self.units, record.entity(1)?);
        match record.keyword {
            "LINE" => Ok(Curve::Line {
                origin: self.point(record.entity(1)?)?,
                direction: vector(self.file, self.units, record.entity(2)?)?,
            }),
            "CIRCLE" => Ok(Curve::Circle { frame: frame()?, radius: self.length(&record, 2)? }),
            "ELLIPSE" => Ok(Curve::Ellipse { frame: frame()?, radii: self.radii(&record)? }),
            "HYPERBOLA" => Ok(Curve::Hyperbola { frame: frame()?, radii: self.radii(&record)? }),
            "PARABOLA" => Ok(Curve::Parabola { frame: frame()?, focal: self.length(&record, 2)? }),
            "POLYLINE" => self.polyline(&entity, &record),
            "TRIMMED_CURVE" if record.truth(4)? => self.curve(record.entity(1)?, depth + 1),
            "TRIMMED_CURVE" => Ok(Curve::Joined(vec![self.bounded(number, depth + 1)?])),
            "CURVE_REPLICA" => {
                let at = operator(self.file, self.units, record.entity(2)?)?;
                Ok(self.curve(record.entity(1)?, depth + 1)?.placed(&at))
            }
            "OFFSET_CURVE_3D" => self.offset(&record, depth),
            "PCURVE" => Err(record.wrong("is given in the parameters of a surface alone")),
            keyword if CHAINS.contains(&keyword) => self.chain(&entity, &record, depth),
            keyword => Err(record.wrong(format!("is no curve that is read but {keyword}"))),
        }
    }

    fn radii(&self, record: &Record) -> Result<[f64; 2], Wrong> {
        Ok([self.length(record, 2)?, self.length(record, 3)?])
    }

    /// A curve with ends, from its start to its end.
    pub fn bounded(&self, number: u64, depth: usize) -> Result<Span, Wrong> {
        let entity = self.file.entity(number)?;
        if depth > MAX_BASES {
            return Err(entity.wrong("rests on itself"));
        }
        if let Some(carried) = carried(&entity) {
            return self.bounded(carried?, depth + 1);
        }
        if let Some(record) = entity.record("TRIMMED_CURVE") {
            return self.trimmed(&record, depth);
        }
        let curve = self.curve(number, depth + 1)?;
        let range = curve.domain();
        match range.iter().all(|t| t.is_finite()) {
            true => Ok(Span { curve, range }),
            false => Err(entity.wrong("has no ends")),
        }
    }

    fn trimmed(&self, record: &Record, depth: usize) -> Result<Span, Wrong> {
        let curve = self.curve(record.entity(1)?, depth + 1)?;
        let same = record.truth(4)?;
        let by_parameter = record.word(5).as_deref() == Some("PARAMETER");
        let mut ends = [0.0; 2];
        for (end, index) in ends.iter_mut().zip([2, 3]) {
            *end = self.trim(record, index, &curve, by_parameter)?;
        }
        span::from_parameters(curve, ends, same).map_err(|reason| record.wrong(reason))
    }

    /// The parameter of one end of a trimmed curve: by its number or by its place, whichever the file prefers.
    fn trim(&self, record: &Record, index: usize, curve: &Curve, by_parameter: bool) -> Result<f64, Wrong> {
        let trims = record.list(index)?;
        let parameter = trims.iter().find_map(|v| record.number(*v)).filter(|t| t.is_finite());
        let place = trims.iter().find_map(|v| match v {
            Value::Reference(n) => Some(*n),
            _ => None,
        });
        let scale = match curve {
            Curve::Circle { .. } | Curve::Ellipse { .. } => self.units.angle,
            _ => 1.0,
        };
        match (parameter, place) {
            (Some(t), None) => Ok(t * scale),
            (Some(t), Some(_)) if by_parameter => Ok(t * scale),
            (_, Some(place)) => Ok(span::foot(curve, self.point(place)?).parameter),
            (None, None) => Err(record.wrong("has an end that is neither a parameter nor a point")),
        }
    }

    fn spline(&self, entity: &Entity<'f>) -> Result<Option<Curve>, Wrong> {
        let Some(record) = spline(entity, 1)? else { return Ok(None) };
        self.budget.spend(record.points().len(), entity)?;
        let points = record.points().iter().map(|n| self.point(*n)).collect::<Result<Vec<_>, _>>()?;
        let raw = record.with(points)?;
        cad_curve(raw).map(Some).map_err(|fault| entity.wrong(fault.to_string()))
    }

    fn polyline(&self, entity: &Entity, record: &Record) -> Result<Curve, Wrong> {
        let points = record.entities(1)?;
        self.budget.spend(points.len(), entity)?;
        let points = points.map(|n| self.point(n)).collect::<Result<Vec<_>, _>>()?;
        match points.len() {
            0 | 1 => Err(record.wrong("has fewer than two points")),
            _ => Ok(Curve::Polyline(points)),
        }
    }

    /// Segments one after another.
    fn chain(&self, entity: &Entity, record: &Record, depth: usize) -> Result<Curve, Wrong> {
        let mut spans: Vec<Span> = vec![];
        for number in record.entities(1)? {
            let segment = self.file.entity(number)?;
            let segment = segment.main(&["COMPOSITE_CURVE_SEGMENT"]);
            if !segment.keyword.ends_with("COMPOSITE_CURVE_SEGMENT") {
                return Err(segment.wrong("is no COMPOSITE_CURVE_SEGMENT"));
            }
            let mut span = self.bounded(segment.entity(2)?, depth + 1)?;
            self.budget.spend(size(&span.curve), entity)?;
            if !segment.truth(1)? {
                span.range.reverse();
            }
            if let Some(before) = spans.last() {
                let gap = norm(minus(span.ends()[0], before.ends()[1]));
                let reach = norm(minus(span.ends()[1], span.ends()[0]));
                if gap > self.tolerance.max(span::MAX_GAP * reach) {
                    return Err(
                        segment.wrong(format!("begins {gap:.3e} mm from where the segment before it ends"))
                    );
                }
            }
            spans.push(span);
        }
        match spans.is_empty() {
            true => Err(record.wrong("has no segments")),
            false => Ok(Curve::Joined(spans)),
        }
    }

    /// The offset of a line, or of a circle in its plane.
    fn offset(&self, record: &Record, depth: usize) -> Result<Curve, Wrong> {
        let basis = self.curve(record.entity(1)?, depth + 1)?;
        let distance = record.real(2)? * self.units.length;
        let side = direction(self.file, record.entity(4)?)?;
        let moved = match &basis {
            Curve::Line { origin, direction } => unit(cross(side, *direction)).map(|(across, _)| {
                Curve::Line { origin: plus(*origin, times(distance, across)), direction: *direction }
            }),
            Curve::Circle { frame, radius } if norm(cross(side, frame.axes[2])) < ALONG => {
                let radius = radius - distance * dot(side, frame.axes[2]).signum();
                (radius > 0.0).then_some(Curve::Circle { frame: *frame, radius })
            }
            _ => None,
        };
        moved.ok_or_else(|| {
            record.wrong("is an offset of a curve that is neither a line nor a circle in its plane")
        })
    }
}

/// Sine of an angle within which two unit vectors are along each other: rounding of a few steps.
const ALONG: f64 = 1e-12;

/// The curve in space that an entity carries beside others, if it is such an entity.
fn carried(entity: &Entity) -> Option<Result<u64, Wrong>> {
    let carrier = entity.records().find(|r| CARRIERS.contains(&r.keyword) && !r.values.is_empty());
    carrier.map(|c| c.entity(usize::from(entity.is_simple())))
}

/// Whether a keyword is one of curves.
pub(super) fn is_curve(keyword: &str) -> bool {
    CURVES.contains(&keyword)
        || CARRIERS.contains(&keyword)
        || CHAINS.contains(&keyword)
        || matches!(
            keyword,
            "LINE"
                | "CIRCLE"
                | "ELLIPSE"
                | "HYPERBOLA"
                | "PARABOLA"
                | "POLYLINE"
                | "TRIMMED_CURVE"
                | "CURVE_REPLICA"
        )
        || matches!(keyword, "OFFSET_CURVE_3D" | "PCURVE" | "BOUNDED_CURVE" | "CURVE")
}

/// How many places a curve is made of.
pub(super) fn size(curve: &Curve) -> usize {
    match curve {
        Curve::Spline(spline) => spline.points().len(),
        Curve::Rational(rational) => rational.masses().points().len(),
        Curve::Polyline(points) => points.len(),
        Curve::Joined(spans) => spans.iter().map(|s| size(&s.curve)).sum(),
        _ => 1,
    }
}
