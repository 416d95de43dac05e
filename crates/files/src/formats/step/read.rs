//! B-spline surfaces and curves of a STEP file without faces, of whatever application protocol.

use super::part21::{Entity, File, Value, Wrong, parse};
use super::spline::{SplineRecord, spline};
use crate::Unit;
use crate::content::spline_model::SplineModel;
use crate::error::{Fault, Located, Result};
use crate::format::{Parsed, ReadOptions};
use crate::formats::spline::{curve, surface};
use crate::source::{SNIFFED_BYTES, Source};
use crate::unicode::no_zeros;
use std::collections::BTreeMap;
use trueness_geom::progress::Silent;

/// Reads a file.
pub(super) fn read(source: &mut Source, options: &ReadOptions) -> Result<Parsed> {
    no_zeros(source.feed.ahead(SNIFFED_BYTES)?)?;
    let text = source.feed.all()?;
    no_zeros(text)?;
    let file = parse(text, &Silent).map_err(|_| Fault::unexpected("a file", b""))?;
    undamaged(&file)?;
    placed(&file)?;
    let said = unit(&file)?;
    let unit = options.unit_of(said);
    let mut points = Points { file: &file, unit, known: BTreeMap::new() };
    let mut model = SplineModel::default();
    for entity in file.entities() {
        if let Some(record) = spline(&entity, 2)? {
            let Some(places) = points.places(&record)? else { continue };
            model.surfaces.push(surface(record.with(places)?).map_err(|f| fault(&entity, f))?);
        } else if let Some(record) = spline(&entity, 1)? {
            // Curves in the parameters of a surface have two coordinates, and are not read.
            if let Some(places) = points.places(&record)? {
                model.curves.push(curve(record.with(places)?).map_err(|f| fault(&entity, f))?);
            }
        }
    }
    Ok(Parsed::splines("step", model, said, vec![]))
}

impl From<Wrong> for Located {
    fn from(wrong: Wrong) -> Located {
        let what = format!("#{} {}", wrong.entity, wrong.reason);
        let fault = Fault::Unsupported { what, remedy: "mend this place or export the file again" };
        if wrong.line == 0 { fault.into() } else { fault.at_line(wrong.line) }
    }
}

/// A fault of an entity.
fn fault(entity: &Entity, fault: Fault) -> Located {
    fault.at_line(entity.wrong("").line)
}

/// Files with damaged geometry are refused, and those that are cut short.
fn undamaged(file: &File) -> Result<()> {
    for broken in file.broken() {
        let keyword = file.keyword_of(broken);
        if keyword.is_empty()
            || ["SURFACE", "CURVE", "FACE", "POINT", "UNIT"].iter().any(|w| keyword.contains(w))
        {
            file.entity(broken.number)?;
        }
    }
    match file.is_whole() {
        true => Ok(()),
        false => {
            Err(Fault::unexpected("the line END-ISO-10303-21 at the end", b"").at_line(file.last_line()))
        }
    }
}

/// Files that place their parts are refused: surfaces would be taken where they do not lie.
fn placed(file: &File) -> Result<()> {
    let keywords = ["MAPPED_ITEM", "ITEM_DEFINED_TRANSFORMATION", "CARTESIAN_TRANSFORMATION_OPERATOR"];
    for entity in file.entities() {
        if entity.records().any(|r| keywords.iter().any(|k| r.keyword.starts_with(k))) {
            let what = "the file is an assembly that moves its parts, which is not read".into();
            return Err(fault(&entity, Fault::Unsupported { what, remedy: "export the part alone" }));
        }
    }
    Ok(())
}

/// The unit of lengths, where the file says one.
fn unit(file: &File) -> Result<Option<Unit>> {
    let mut found: Option<Unit> = None;
    for record in file.entities().filter_map(|e| e.record("GLOBAL_UNIT_ASSIGNED_CONTEXT")) {
        let [Value::List(_)] = record.values else { continue };
        for own in record.list(0)? {
            let Value::Reference(own) = own else { continue };
            let own = file.entity(*own)?;
            let Some(unit) = length(&own)? else { continue };
            if found.is_some_and(|other| other != unit) {
                let what = "the file has lengths in more than one unit".into();
                return Err(fault(&own, Fault::Unclear { what, remedy: "export it in one unit" }));
            }
            found = Some(unit);
        }
    }
    Ok(found)
}

/// The unit that an entity stands for, if it is one of lengths.
fn length(entity: &Entity) -> Result<Option<Unit>> {
    if entity.record("LENGTH_UNIT").is_none() {
        return Ok(None);
    }
    let unit = match (entity.record("SI_UNIT"), entity.record("CONVERSION_BASED_UNIT")) {
        (Some(si), _) => match (si.word(0).as_deref(), si.word(1).as_deref()) {
            (Some("MILLI"), Some("METRE")) => Some(Unit::Millimeter),
            (Some("CENTI"), Some("METRE")) => Some(Unit::Centimeter),
            (Some("MICRO"), Some("METRE")) => Some(Unit::Micrometer),
            (None, Some("METRE")) => Some(Unit::Meter),
            _ => None,
        },
        (_, Some(conversion)) => match &conversion.text(0).to_ascii_uppercase()[..] {
            inch if inch.starts_with("INCH") => Some(Unit::Inch),
            "MILLIMETRE" | "MILLIMETER" | "MM" => Some(Unit::Millimeter),
            "CENTIMETRE" | "CENTIMETER" | "CM" => Some(Unit::Centimeter),
            "METRE" | "METER" | "M" => Some(Unit::Meter),
            _ => None,
        },
        _ => None,
    };
    let what = || "the unit of lengths is none of um, mm, cm, m and inch".to_string();
    let remedy = "export it in millimeters";
    unit.map(Some).ok_or_else(|| fault(entity, Fault::Unsupported { what: what(), remedy }))
}

/// Points in millimeters, each read once.
struct Points<'f> {
    file: &'f File<'f>,
    unit: Unit,
    known: BTreeMap<u64, Option<[f64; 3]>>,
}

impl Points<'_> {
    /// The place of a `CARTESIAN_POINT`; `None` if it has two coordinates.
    fn point(&mut self, number: u64) -> Result<Option<[f64; 3]>> {
        if let Some(known) = self.known.get(&number) {
            return Ok(*known);
        }
        let entity = self.file.entity(number)?;
        let record = entity.main(&[]);
        if record.keyword != "CARTESIAN_POINT" || !entity.is_simple() {
            let what = format!("is no CARTESIAN_POINT but {}", record.keyword);
            return Err(record.wrong(what).into());
        }
        let numbers: Option<Vec<f64>> = record.list(1)?.iter().map(|v| record.number(*v)).collect();
        let wrong = || record.wrong("is no point of two or three numbers");
        let place = match &numbers.ok_or_else(wrong)?[..] {
            [x, y, z] => Some([*x, *y, *z]),
            [_] | [_, _] => None,
            _ => return Err(wrong().into()),
        };
        if place.is_some_and(|p| p.iter().any(|x| !x.is_finite())) {
            return Err(fault(&entity, Fault::NotFinite { what: "point", number }));
        }
        let place = place.map(|p| p.map(|x| self.unit.to_millimeters(x)));
        self.known.insert(number, place);
        Ok(place)
    }

    /// The control points of a spline; `None` where it lies in the parameters of a surface.
    fn places(&mut self, spline: &SplineRecord) -> Result<Option<Vec<[f64; 3]>>> {
        let known = |n: &u64| self.file.entity(*n).is_ok();
        if let Some(missing) = spline.points().iter().find(|n| !known(n)) {
            return Err(spline
                .wrong(format!("has control point #{missing}, which is not among those that are there"))
                .into());
        }
        spline.points().iter().map(|n| self.point(*n)).collect()
    }
}
