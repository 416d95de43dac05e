//! B-spline surfaces and curves of a STEP file, of whatever application protocol.

use super::text::{Instances, Record, Value};
use crate::content::spline_model::SplineModel;
use crate::error::{Fault, Result};
use crate::format::{Parsed, ReadOptions};
use crate::formats::spline::{Raw, curve, surface};
use crate::source::{SNIFFED_BYTES, Source};
use crate::unicode::no_zeros;
use crate::{Unit, Warning};
use std::collections::{BTreeMap, BTreeSet};

/// Reads a file.
pub(super) fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    no_zeros(source.feed.ahead(SNIFFED_BYTES)?)?;
    let text = source.feed.all()?;
    no_zeros(text)?;
    let file = Instances::of(text)?;
    placed(&file)?;
    let said = unit(&file)?;
    let unit = options.unit_of(said);
    let mut points = Points { file: &file, unit, known: BTreeMap::new() };
    let mut model = SplineModel::default();
    let faces = faces(&file)?;
    let mut warnings = vec![];
    let used: BTreeMap<u64, bool> = faces.iter().map(|f| (f.surface, f.same)).collect();
    let (mut read, mut trimmed) = (BTreeSet::new(), 0);
    for number in file.numbers() {
        if !file.mentions(number, b"SURFACE") && !file.mentions(number, b"CURVE") {
            continue;
        }
        let records = file.records(number)?;
        if let Some(raw) = points.raw(number, &records, 2)? {
            // A surface that no face names may be the basis of an offset surface.
            if !faces.is_empty() && !used.contains_key(&number) {
                continue;
            }
            let found = surface(raw).map_err(|f| file.fault(number, f))?;
            let flip = used.get(&number).is_some_and(|same| !same);
            model.surfaces.push(if flip { found.flipped() } else { found });
            read.insert(number);
        } else if let Some(raw) = points.raw(number, &records, 1)? {
            // Curves in the parameters of a surface have two coordinates, and are not read.
            if !raw.points.is_empty() {
                model.curves.push(curve(raw).map_err(|f| file.fault(number, f))?);
            }
        }
    }
    for face in faces.iter().filter(|f| read.contains(&f.surface)) {
        trimmed += u64::from(points.trimmed(face)?);
    }
    let left_out = faces.iter().filter(|f| !read.contains(&f.surface)).count() as u64;
    if trimmed > 0 {
        warnings.push(Warning::Trimmed { count: trimmed });
    }
    if left_out > 0 {
        warnings.push(Warning::FacesLeftOut { count: left_out, of: faces.len() as u64 });
    }
    Ok(Parsed::splines("step", model, said, warnings))
}

/// Refuses a file that places its parts, because its surfaces would be taken where they do not lie.
fn placed(file: &Instances) -> Result<()> {
    for number in file.numbers() {
        for keyword in
            [&b"MAPPED_ITEM"[..], b"ITEM_DEFINED_TRANSFORMATION", b"CARTESIAN_TRANSFORMATION_OPERATOR"]
        {
            if file.mentions(number, keyword) {
                let what = "the file is an assembly that moves its parts, which is not read".into();
                let remedy = "export the part alone";
                return Err(file.fault(number, Fault::Unsupported { what, remedy }));
            }
        }
    }
    Ok(())
}

/// The unit of lengths, where the file says one.
fn unit(file: &Instances) -> Result<Option<Unit>> {
    let mut found: Option<Unit> = None;
    for number in file.numbers().filter(|n| file.mentions(*n, b"GLOBAL_UNIT_ASSIGNED_CONTEXT")) {
        for (name, parameters) in file.records(number)? {
            let [Value::List(units)] = &parameters[..] else { continue };
            if name != b"GLOBAL_UNIT_ASSIGNED_CONTEXT" {
                continue;
            }
            for own in units {
                let Value::Instance(own) = own else { continue };
                let Some(unit) = length(file, *own)? else { continue };
                if found.is_some_and(|other| other != unit) {
                    let what = "the file has lengths in more than one unit".into();
                    let remedy = "export it in one unit";
                    return Err(file.fault(*own, Fault::Unclear { what, remedy }));
                }
                found = Some(unit);
            }
        }
    }
    Ok(found)
}

/// The unit that an instance stands for, if it is one of lengths.
fn length(file: &Instances, number: u64) -> Result<Option<Unit>> {
    let records = file.records(number)?;
    let has = |keyword: &[u8]| records.iter().find(|r| r.0 == keyword).map(|r| &r.1[..]);
    if has(b"LENGTH_UNIT").is_none() {
        return Ok(None);
    }
    let unit = match (has(b"SI_UNIT"), has(b"CONVERSION_BASED_UNIT")) {
        (Some([Value::Word(prefix), Value::Word(meter)]), _) if meter == b"METRE" => match &prefix[..] {
            b"MILLI" => Some(Unit::Millimeter),
            b"CENTI" => Some(Unit::Centimeter),
            b"MICRO" => Some(Unit::Micrometer),
            _ => None,
        },
        (Some([Value::Nothing, Value::Word(meter)]), _) if meter == b"METRE" => Some(Unit::Meter),
        (_, Some([Value::Text(name), _])) if name.to_ascii_uppercase().starts_with(b"INCH") => {
            Some(Unit::Inch)
        }
        (_, Some([Value::Text(name), _])) => match &name.to_ascii_uppercase()[..] {
            b"MILLIMETRE" | b"MILLIMETER" | b"MM" => Some(Unit::Millimeter),
            b"CENTIMETRE" | b"CENTIMETER" | b"CM" => Some(Unit::Centimeter),
            b"METRE" | b"METER" | b"M" => Some(Unit::Meter),
            _ => None,
        },
        _ => None,
    };
    let what = || "the unit of lengths is none of um, mm, cm, m and inch".to_string();
    let remedy = "export it in millimeters";
    unit.map(Some).ok_or_else(|| file.fault(number, Fault::Unsupported { what: what(), remedy }))
}

/// A face: its surface, whether it looks the way of the surface's normal, and its bounds.
struct Face {
    surface: u64,
    same: bool,
    bounds: Vec<u64>,
}

fn faces(file: &Instances) -> Result<Vec<Face>> {
    let mut all = vec![];
    for number in file.numbers().filter(|n| file.mentions(*n, b"FACE")) {
        for (name, p) in file.records(number)? {
            if !matches!(&name[..], b"ADVANCED_FACE" | b"FACE_SURFACE") {
                continue;
            }
            let [_, Value::List(bounds), Value::Instance(surface), Value::Word(same)] = &p[..] else {
                let fault = Fault::unexpected("a face with bounds, a surface and its sense", &name);
                return Err(file.fault(number, fault));
            };
            let bounds = bounds.iter().filter_map(reference).collect();
            all.push(Face { surface: *surface, same: same == b"T", bounds });
        }
    }
    Ok(all)
}

fn reference(value: &Value) -> Option<u64> {
    match value {
        Value::Instance(n) => Some(*n),
        _ => None,
    }
}

fn whole(value: &Value) -> Option<usize> {
    match value {
        Value::Integer(n) => usize::try_from(*n).ok(),
        _ => None,
    }
}

fn real(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(n) => Some(*n as f64),
        Value::Real(x) => Some(*x),
        Value::Typed(inner) => inner.first().and_then(real),
        _ => None,
    }
}

fn list(value: Option<&Value>) -> Option<&[Value]> {
    match value {
        Some(Value::List(all)) => Some(all),
        _ => None,
    }
}

/// Points in millimeters, each read once.
struct Points<'a> {
    file: &'a Instances<'a>,
    unit: Unit,
    known: BTreeMap<u64, Option<[f64; 3]>>,
}

impl Points<'_> {
    /// The place of a `CARTESIAN_POINT`; `None` if it has two coordinates.
    fn point(&mut self, number: u64) -> Result<Option<[f64; 3]>> {
        if let Some(known) = self.known.get(&number) {
            return Ok(*known);
        }
        let parameters = self.file.simple(number, "CARTESIAN_POINT")?;
        let numbers: Option<Vec<f64>> =
            list(parameters.get(1)).and_then(|all| all.iter().map(real).collect());
        let wrong = || self.file.fault(number, Fault::unexpected("a point of two or three numbers", b""));
        let place = match &numbers.ok_or_else(wrong)?[..] {
            [x, y, z] => Some([*x, *y, *z]),
            [_] | [_, _] => None,
            _ => return Err(wrong()),
        };
        if place.is_some_and(|p| p.iter().any(|x| !x.is_finite())) {
            return Err(self.file.fault(number, Fault::NotFinite { what: "point", number }));
        }
        let place = place.map(|p| p.map(|x| self.unit.to_millimeters(x)));
        self.known.insert(number, place);
        Ok(place)
    }

    /// The numbers of a surface (`dimensions` is 2) or a curve (1) in these entities; `None` if they are none.
    fn raw(&mut self, number: u64, records: &[Record], dimensions: usize) -> Result<Option<Raw>> {
        let names = if dimensions == 2 { SURFACE_ENTITIES } else { CURVE_ENTITIES };
        let find = |name: &[u8]| records.iter().find(|r| r.0 == name).map(|r| &r.1[..]);
        let simple = records.len() == 1;
        let Some((kind, own)) = names[..4].iter().find_map(|n| Some((*n, find(n)?))) else { return Ok(None) };
        // A simple instance has its name first, then all parameters; of a complex one each entity has its own.
        let (base, rest) = match (simple, find(names[4])) {
            (true, _) => own
                .get(1..)
                .unwrap_or(&[])
                .split_at_checked(PARAMETERS_BEFORE_KNOTS[dimensions - 1])
                .unwrap_or((&[], &[])),
            (false, Some(base)) => (base, own),
            (false, None) => return Ok(None),
        };
        let wrong = |what: &'static str| self.file.fault(number, Fault::unexpected(what, b""));
        let degree: Option<Vec<usize>> = base.iter().take(dimensions).map(whole).collect();
        let degree = degree.filter(|d| d.len() == dimensions).ok_or_else(|| wrong("degrees"))?;
        let net = list(base.get(dimensions)).ok_or_else(|| wrong("a list of control points"))?;
        let rows: Vec<&[Value]> = match dimensions {
            2 => net.iter().map(|row| list(Some(row))).collect::<Option<_>>(),
            _ => Some(vec![net]),
        }
        .ok_or_else(|| wrong("control points in rows"))?;
        let counts = match dimensions {
            2 => vec![rows.len(), rows.first().map_or(0, |r| r.len())],
            _ => vec![net.len()],
        };
        if rows.iter().any(|r| r.len() != rows[0].len()) {
            return Err(wrong("rows of equally many control points"));
        }
        let mut points = vec![];
        for value in rows.iter().flat_map(|r| r.iter()) {
            let known = reference(value).filter(|at| self.file.has(*at));
            let at = known.ok_or_else(|| {
                self.file.fault(
                    number,
                    Fault::unexpected("control points that are there", format!("{value:?}").as_bytes()),
                )
            })?;
            match self.point(at)? {
                Some(p) => points.push(p),
                // In the parameters of a surface.
                None => return Ok(Some(Raw::default())),
            }
        }
        let wrong = |what: &'static str| self.file.fault(number, Fault::unexpected(what, b""));
        let knots = if kind == names[0] {
            let lists = |from: usize, k: usize| list(rest.get(from + k));
            (0..dimensions)
                .map(|k| repeated(lists(0, k)?, lists(dimensions, k)?, counts[k] + degree[k] + 1))
                .collect::<Option<_>>()
                .ok_or_else(|| {
                    wrong("knots, each as often as its multiplicity, that fit the control points")
                })?
        } else {
            (0..dimensions)
                .map(|k| implied(kind, degree[k], counts[k]))
                .collect::<Option<_>>()
                .ok_or_else(|| wrong("as many control points as the kind of the spline needs"))?
        };
        let weights = match find(names[5]) {
            None => vec![1.0; points.len()],
            Some(own) => weights(own, dimensions).ok_or_else(|| wrong("weights that are numbers"))?,
        };
        Ok(Some(Raw { degree, knots, counts, points, weights }))
    }

    /// Whether a face is less than its surface: it has more than one bound, or a vertex of it is no corner.
    fn trimmed(&mut self, face: &Face) -> Result<bool> {
        if face.bounds.len() != 1 {
            return Ok(face.bounds.len() > 1);
        }
        let records = self.file.records(face.surface)?;
        let Some(raw) = self.raw(face.surface, &records, 2)? else { return Ok(false) };
        let [m, n] = [raw.counts[0], raw.counts[1]];
        let corners = [0, n - 1, (m - 1) * n, m * n - 1].map(|k| raw.points[k]);
        let size = trueness_geom::space::Aabb::of(&raw.points).diagonal();
        for vertex in self.vertices(face.bounds[0])? {
            let Some(p) = vertex else { continue };
            let near = |c: &[f64; 3]| (0..3).all(|k| (c[k] - p[k]).abs() <= 1e-5 * size);
            if !corners.iter().any(near) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The vertices of a bound's loop.
    fn vertices(&mut self, bound: u64) -> Result<Vec<Option<[f64; 3]>>> {
        let follow = |file: &Instances, number: u64, at: usize| -> Result<Vec<u64>> {
            let records = file.records(number)?;
            let value = records.first().and_then(|r| r.1.get(at));
            Ok(match value {
                Some(Value::List(all)) => all.iter().filter_map(reference).collect(),
                Some(Value::Instance(n)) => vec![*n],
                _ => vec![],
            })
        };
        let mut all = vec![];
        for path in follow(self.file, bound, 1)? {
            for oriented in follow(self.file, path, 1)? {
                for edge in follow(self.file, oriented, 3)? {
                    for vertex in [follow(self.file, edge, 1)?, follow(self.file, edge, 2)?].concat() {
                        for point in follow(self.file, vertex, 1)? {
                            all.push(self.point(point)?);
                        }
                    }
                }
            }
        }
        Ok(all)
    }
}

/// Number of parameters of a B-spline before its knots, its name not counted: for a curve, for a surface.
const PARAMETERS_BEFORE_KNOTS: [usize; 2] = [5, 7];
/// Entities of a B-spline: with knots, Bézier, quasi-uniform, uniform; then those of a complex instance that hold its control points and its
/// weights.
const SURFACE_ENTITIES: [&[u8]; 6] = [
    b"B_SPLINE_SURFACE_WITH_KNOTS",
    b"BEZIER_SURFACE",
    b"QUASI_UNIFORM_SURFACE",
    b"UNIFORM_SURFACE",
    b"B_SPLINE_SURFACE",
    b"RATIONAL_B_SPLINE_SURFACE",
];
const CURVE_ENTITIES: [&[u8]; 6] = [
    b"B_SPLINE_CURVE_WITH_KNOTS",
    b"BEZIER_CURVE",
    b"QUASI_UNIFORM_CURVE",
    b"UNIFORM_CURVE",
    b"B_SPLINE_CURVE",
    b"RATIONAL_B_SPLINE_CURVE",
];

/// Knots by their multiplicities; `None` unless there are `needed`.
fn repeated(times: &[Value], knots: &[Value], needed: usize) -> Option<Vec<f64>> {
    let times: Vec<usize> = times.iter().map(whole).collect::<Option<_>>()?;
    let sum = times.iter().try_fold(0usize, |sum, n| sum.checked_add(*n))?;
    if times.len() != knots.len() || sum != needed {
        return None;
    }
    let knots: Vec<f64> = knots.iter().map(real).collect::<Option<_>>()?;
    Some(knots.iter().zip(times).flat_map(|(t, n)| std::iter::repeat_n(*t, n)).collect())
}

/// The knots that a kind of splines has without saying so.
fn implied(kind: &[u8], degree: usize, count: usize) -> Option<Vec<f64>> {
    let needed = count.checked_add(degree)?.checked_add(1)?;
    let spans = count.checked_sub(degree).filter(|_| degree > 0)?;
    let at = |i: usize| match kind {
        k if k.starts_with(b"UNIFORM") => i as f64 - degree as f64,
        k if k.starts_with(b"BEZIER") => (i.saturating_sub(1) / degree).min((count - 1) / degree) as f64,
        _ => i.saturating_sub(degree).min(spans) as f64,
    };
    let whole = !kind.starts_with(b"BEZIER") || (count - 1).is_multiple_of(degree);
    (whole && spans > 0).then(|| (0..needed).map(at).collect())
}

/// Weights in rows, or in one list.
fn weights(own: &[Value], dimensions: usize) -> Option<Vec<f64>> {
    let all = list(own.last())?;
    match dimensions {
        2 => {
            let rows: Option<Vec<Vec<f64>>> =
                all.iter().map(|row| list(Some(row))?.iter().map(real).collect()).collect();
            rows.map(|r| r.concat())
        }
        _ => all.iter().map(real).collect(),
    }
}
