//! The entities of a DXF file.

use super::entities::{Said, Vertex, arc, ellipse, line, polyline, spline, vertex, vertices};
use super::groups::{BINARY, Group, Groups};
use crate::drawing::{Drawing, DrawnEntity};
use crate::error::{Fault, Result};
use crate::format::{Parsed, ReadOptions};
use crate::source::{HEAD, Source};
use crate::unicode::no_zeros;
use crate::{Unit, Warning};
use std::collections::BTreeMap;

/// Reads a file.
pub(super) fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    if source.feed.ahead(HEAD)?.starts_with(BINARY) {
        let what = "this drawing is binary DXF, which is not read".into();
        return Err(Fault::Unsupported { what, remedy: "save it as ASCII DXF" }.into());
    }
    no_zeros(source.feed.ahead(HEAD)?)?;
    let text = source.feed.all()?;
    no_zeros(text)?;
    let said = unit(&mut Groups::new(text))?;
    let mut reader = Reader { unit: options.unit_of(said), ..Reader::default() };
    let mut groups = Groups::new(text);
    while let Some(name) = section(&mut groups)? {
        match name.value {
            b"ENTITIES" => reader.entities(&mut groups)?,
            _ => while !groups.next()?.is(0, b"ENDSEC") {},
        }
    }
    let mut warnings = vec![];
    if !reader.passed_over.is_empty() {
        let kinds = reader.passed_over.iter().map(|(name, count)| format!("{count} {name}"));
        warnings.push(Warning::PassedOver { what: kinds.collect::<Vec<_>>().join(", ") });
    }
    if reader.drawing.entities.is_empty() {
        warnings.push(Warning::NothingDrawn);
    }
    Ok(Parsed::drawing("dxf", reader.drawing, said, warnings))
}

/// The name of the next section; `None` at the end of the file.
fn section<'a>(groups: &mut Groups<'a>) -> Result<Option<Group<'a>>> {
    let group = groups.next()?;
    if group.is(0, b"EOF") {
        return Ok(None);
    }
    let name = if group.is(0, b"SECTION") { groups.next()? } else { group };
    match name.code {
        2 => Ok(Some(name)),
        _ => Err(name.wrong("a section and its name, or `EOF`")),
    }
}

/// The unit that the header says.
fn unit(groups: &mut Groups) -> Result<Option<Unit>> {
    let mut found = None;
    while let Some(name) = section(groups)? {
        let mut insunits = false;
        loop {
            let group = groups.next()?;
            if group.is(0, b"ENDSEC") {
                break;
            }
            if name.value == b"HEADER" && insunits && group.code == 70 {
                found = Some(group);
            }
            insunits = group.is(9, b"$INSUNITS");
        }
    }
    let Some(group) = found else { return Ok(None) };
    Ok(Some(match group.integer()? {
        0 => return Ok(None),
        1 => Unit::Inch,
        4 => Unit::Millimeter,
        5 => Unit::Centimeter,
        6 => Unit::Meter,
        13 => Unit::Micrometer,
        _ => {
            let what = "the unit of the drawing ($INSUNITS) is none of um, mm, cm, m and inch".into();
            return Err(Fault::Unsupported { what, remedy: "save it in millimeters" }.at_line(group.line));
        }
    }))
}

#[derive(Default)]
struct Reader {
    unit: Unit,
    drawing: Drawing,
    passed_over: BTreeMap<String, u64>,
}

impl Reader {
    /// The entities up to the end of their section.
    fn entities<'a>(&mut self, groups: &mut Groups<'a>) -> Result<()> {
        let mut own: Vec<Group<'a>> = vec![];
        let mut name = groups.next()?;
        // Vertices of the polyline that is being read, and what it says itself.
        let mut open: Option<(Vec<Group<'a>>, u64, Vec<Vertex>)> = None;
        loop {
            if name.code != 0 {
                return Err(name.wrong("an entity, or `ENDSEC`"));
            }
            if name.value == b"ENDSEC" {
                return match open {
                    Some(_) => Err(name.wrong("`SEQEND` after the vertices of a polyline")),
                    None => Ok(()),
                };
            }
            own.clear();
            let next = loop {
                let group = groups.next()?;
                if group.code == 0 {
                    break group;
                }
                own.push(group);
            };
            let said = Said { groups: &own, line: name.line, unit: self.unit };
            match (name.value, &mut open) {
                (b"POLYLINE", _) => open = Some((own.clone(), name.line, vec![])),
                (b"VERTEX", Some((_, _, vertices))) => vertices.push(vertex(&said)?),
                (b"SEQEND", Some((own, line, vertices))) => {
                    let said = Said { groups: own, line: *line, unit: self.unit };
                    self.polyline(&said, vertices)?;
                    open = None;
                }
                _ => self.entity(name.value, &said)?,
            }
            name = next;
        }
    }

    /// A `POLYLINE` with its vertices: one in the plane, neither a mesh nor the control points of a curve.
    fn polyline(&mut self, said: &Said, vertices: &[Vertex]) -> Result<()> {
        let flags = said.integer(70)?;
        // 8: in space, 16, 64: meshes; 2, 4: the vertices of a curve fitted to them stand among its control points.
        if flags & (2 | 4 | 8 | 16 | 64) != 0 {
            *self.passed_over.entry("POLYLINE".into()).or_default() += 1;
            return Ok(());
        }
        self.add(said, |out| polyline(said, vertices, flags & 1 != 0, out))
    }

    fn entity(&mut self, name: &[u8], said: &Said) -> Result<()> {
        match name {
            // What stands on paper is none of the part.
            _ if said.integer(67)? == 1 => Ok(()),
            b"LINE" => self.add(said, |out| line(said, out)),
            b"ARC" => self.add(said, |out| arc(said, false, out)),
            b"CIRCLE" => self.add(said, |out| arc(said, true, out)),
            b"SPLINE" => self.add(said, |out| spline(said, out)),
            b"ELLIPSE" => self.add(said, |out| ellipse(said, out)),
            b"LWPOLYLINE" => {
                let closed = said.integer(70)? & 1 != 0;
                self.add(said, |out| polyline(said, &vertices(said)?, closed, out))
            }
            _ => {
                *self.passed_over.entry(String::from_utf8_lossy(name).into_owned()).or_default() += 1;
                Ok(())
            }
        }
    }

    fn add(
        &mut self,
        said: &Said,
        make: impl FnOnce(&mut Vec<crate::drawing::Drawn>) -> Result<()>,
    ) -> Result<()> {
        let mut found = vec![];
        make(&mut found)?;
        let layer = said.groups.iter().find(|g| g.code == 8).map(|g| String::from_utf8_lossy(g.value));
        let layer = layer.unwrap_or_default().into_owned();
        self.drawing
            .entities
            .extend(found.into_iter().map(|drawn| DrawnEntity { layer: layer.clone(), drawn }));
        Ok(())
    }
}
