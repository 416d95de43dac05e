//! The entities of a DXF file.

use super::blocks::{Block, Insert, Item, Placed, block_name, is_layer_0};
use super::entities::{EntityGroups, Vertex, arc, ellipse, line, polyline, spline, vertex, vertices};
use super::groups::{BINARY_MARK, Group, Groups};
use super::hidden::{Hidden, Unseen, several};
use crate::content::drawing::DrawnEntity;
use crate::error::{Fault, Result};
use crate::format::{Parsed, ReadOptions};
use crate::source::{SNIFFED_BYTES, Source};
use crate::unicode::no_zeros;
use crate::{Unit, Warning};
use std::collections::BTreeMap;

/// Reads a file.
pub(super) fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    if source.feed.ahead(SNIFFED_BYTES)?.starts_with(BINARY_MARK) {
        let what = "this drawing is binary DXF, which is not read".into();
        return Err(Fault::Unsupported { what, remedy: "save it as ASCII DXF" }.into());
    }
    no_zeros(source.feed.ahead(SNIFFED_BYTES)?)?;
    let text = source.feed.all()?;
    no_zeros(text)?;
    let (entity, hidden) = settings(&mut Groups::new(text))?;
    let unit = options.unit_of(entity);
    let (mut own, mut blocks) = (Reader::new(unit, &hidden), BTreeMap::new());
    let mut groups = Groups::new(text);
    while let Some(name) = section(&mut groups)? {
        match name.value {
            b"ENTITIES" => own.entities(&records(&mut groups, b"ENDSEC")?)?,
            b"BLOCKS" => own.through += read_blocks(&mut groups, unit, &hidden, &mut blocks)?,
            _ => while !groups.next()?.is(0, b"ENDSEC") {},
        }
    }
    let mut placed = Placed::new(blocks, own.passed_over, own.unseen, &hidden);
    placed.place(own.items)?;
    let mut warnings = vec![];
    if !placed.passed_over.is_empty() {
        let kinds = placed.passed_over.iter().map(|(name, count)| format!("{count} {name}"));
        warnings.push(Warning::PassedOver { what: kinds.collect::<Vec<_>>().join(", ") });
    }
    warnings.extend(placed.unseen.warning());
    warnings.extend(several(placed.drawing.entities.iter().map(|e| e.layer.as_str())));
    if own.through > 0 {
        warnings.push(Warning::ThroughPoints { count: own.through });
    }
    if placed.drawing.entities.is_empty() {
        warnings.push(Warning::NothingDrawn);
    }
    Ok(Parsed::drawing("dxf", placed.drawing, entity, warnings))
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

/// The unit that the header says, and which layers are hidden.
fn settings(groups: &mut Groups) -> Result<(Option<Unit>, Hidden)> {
    let (mut found, mut hidden) = (None, Hidden::default());
    while let Some(name) = section(groups)? {
        if name.value == b"TABLES" {
            hidden = layers(groups)?;
            continue;
        }
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
    Ok((found.map(unit).transpose()?.flatten(), hidden))
}

/// The hidden layers of the tables up to the end of their section.
fn layers(groups: &mut Groups) -> Result<Hidden> {
    let (mut hidden, mut layer) = (Hidden::default(), None::<Vec<Group>>);
    loop {
        let group = groups.next()?;
        if group.code != 0 {
            layer.iter_mut().for_each(|record| record.push(group));
            continue;
        }
        if let Some(record) = layer.take() {
            hidden.add(&record)?;
        }
        match group.value {
            b"ENDSEC" => return Ok(hidden),
            b"LAYER" => layer = Some(vec![]),
            _ => {}
        }
    }
}

/// The unit of a number of the header; `None` where it says none.
fn unit(group: Group) -> Result<Option<Unit>> {
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

/// An entity as the file holds it: its name, and its groups up to the next one.
struct Record<'a> {
    name: Group<'a>,
    groups: Vec<Group<'a>>,
}

/// The entities up to the name that ends them.
fn records<'a>(groups: &mut Groups<'a>, end: &[u8]) -> Result<Vec<Record<'a>>> {
    let mut all: Vec<Record> = vec![];
    loop {
        let group = groups.next()?;
        match (group.code, all.last_mut()) {
            (0, _) if group.value == end => return Ok(all),
            (0, _) => all.push(Record { name: group, groups: vec![] }),
            (_, Some(last)) => last.groups.push(group),
            (_, None) => return Err(group.wrong("an entity, or the end of its section")),
        }
    }
}

/// The blocks of their section, by name. Gives how many of their splines are drawn through points.
fn read_blocks<'a>(
    groups: &mut Groups<'a>,
    unit: Unit,
    hidden: &Hidden,
    blocks: &mut BTreeMap<String, Result<Block>>,
) -> Result<u64> {
    let mut through = 0;
    let all = records(groups, b"ENDSEC")?;
    for own in all.split(|r| r.name.value == b"ENDBLK") {
        let Some(first) = own.iter().position(|r| r.name.value == b"BLOCK") else { continue };
        let mut own_through = 0;
        let mut read = || {
            let entity = EntityGroups { groups: &own[first].groups, line: own[first].name.line, unit };
            let base = [entity.length_or_0(10)?, entity.length_or_0(20)?];
            let mut reader = Reader::new(unit, hidden);
            reader.entities(&own[first + 1..])?;
            own_through += reader.through;
            Ok(Block { base, items: reader.items, passed_over: reader.passed_over, unseen: reader.unseen })
        };
        blocks.insert(block_name(&own[first].groups), read());
        through += own_through;
    }
    Ok(through)
}

struct Reader<'h> {
    unit: Unit,
    hidden: &'h Hidden,
    items: Vec<Item>,
    passed_over: BTreeMap<String, u64>,
    unseen: Unseen,
    /// How many splines are given only by the points on them.
    through: u64,
}

impl<'h> Reader<'h> {
    fn new(unit: Unit, hidden: &'h Hidden) -> Reader<'h> {
        let (items, passed_over) = (vec![], BTreeMap::new());
        Reader { unit, hidden, items, passed_over, unseen: Unseen::default(), through: 0 }
    }

    /// Whether an entity is not seen; if so, counts it. Layer 0 of a block is decided where the block is inserted.
    fn is_unseen(&mut self, entity: &EntityGroups) -> Result<bool> {
        if entity.integer(60)? == 1 {
            self.unseen.count_marked();
            return Ok(true);
        }
        let layer = layer(entity);
        let hidden = !is_layer_0(&layer) && self.hidden.state(&layer).is_some();
        if hidden {
            self.unseen.count_on_layer(&layer);
        }
        Ok(hidden)
    }

    fn entities(&mut self, records: &[Record]) -> Result<()> {
        // The polyline whose vertices are being read.
        let mut open: Option<(&Record, Vec<Vertex>)> = None;
        let mut last = 0;
        for record in records {
            let entity = EntityGroups { groups: &record.groups, line: record.name.line, unit: self.unit };
            last = record.groups.last().map_or(record.name.line, |g| g.line);
            match (record.name.value, &mut open) {
                (b"POLYLINE", _) => open = Some((record, vec![])),
                (b"VERTEX", Some((_, vertices))) => vertices.push(vertex(&entity)?),
                (b"SEQEND", Some((own, vertices))) => {
                    let entity = EntityGroups { groups: &own.groups, line: own.name.line, unit: self.unit };
                    self.polyline(&entity, vertices)?;
                    open = None;
                }
                // It ends the attributes of a block, too.
                (b"SEQEND", None) => {}
                _ => self.entity(record.name.value, &entity)?,
            }
        }
        match open {
            Some(_) => Err(Fault::unexpected("`SEQEND` after the vertices of a polyline", b"").at_line(last)),
            None => Ok(()),
        }
    }

    /// A `POLYLINE` with its vertices: one in the plane, neither a mesh nor the control points of a curve.
    fn polyline(&mut self, entity: &EntityGroups, vertices: &[Vertex]) -> Result<()> {
        if entity.integer(67)? == 1 || self.is_unseen(entity)? {
            return Ok(());
        }
        let flags = entity.integer(70)?;
        // 8: in space, 16, 64: meshes; 2, 4: the vertices of a curve fitted to them stand among its control points.
        if flags & (2 | 4 | 8 | 16 | 64) != 0 {
            *self.passed_over.entry("POLYLINE".into()).or_default() += 1;
            return Ok(());
        }
        self.add(entity, |out| polyline(entity, vertices, flags & 1 != 0, out))
    }

    fn entity(&mut self, name: &[u8], entity: &EntityGroups) -> Result<()> {
        match name {
            // Entities in paper space are no part of the model.
            _ if entity.integer(67)? == 1 => Ok(()),
            // Whether a block is seen depends on the layers of its entities as well.
            _ if (name != b"INSERT" || entity.integer(60)? == 1) && self.is_unseen(entity)? => Ok(()),
            b"LINE" => self.add(entity, |out| line(entity, out)),
            b"ARC" => self.add(entity, |out| arc(entity, false, out)),
            b"CIRCLE" => self.add(entity, |out| arc(entity, true, out)),
            b"SPLINE" => {
                self.through += u64::from(!entity.has(10));
                self.add(entity, |out| spline(entity, out))
            }
            b"INSERT" => {
                self.items.push(Item::Insert(Insert::of(entity, layer(entity))?));
                Ok(())
            }
            b"ELLIPSE" => self.add(entity, |out| ellipse(entity, out)),
            b"LWPOLYLINE" => {
                let closed = entity.integer(70)? & 1 != 0;
                self.add(entity, |out| polyline(entity, &vertices(entity)?, closed, out))
            }
            _ => {
                *self.passed_over.entry(String::from_utf8_lossy(name).into_owned()).or_default() += 1;
                Ok(())
            }
        }
    }

    fn add(
        &mut self,
        entity: &EntityGroups,
        make: impl FnOnce(&mut Vec<crate::content::drawing::Drawn>) -> Result<()>,
    ) -> Result<()> {
        let mut found = vec![];
        make(&mut found)?;
        let layer = layer(entity);
        let item = |drawn| Item::Drawn(DrawnEntity { layer: layer.clone(), drawn });
        self.items.extend(found.into_iter().map(item));
        Ok(())
    }
}

/// The layer that an entity is on.
fn layer(entity: &EntityGroups) -> String {
    let layer = entity.groups.iter().find(|g| g.code == 8).map(|g| String::from_utf8_lossy(g.value));
    layer.unwrap_or_default().into_owned()
}
