//! Vertices, edges, loops, faces and shells of solids (502, 504, 508, 510, 514).

use super::super::record::Record;
use super::geometry::Geometry;
use super::surface::Patch;
use crate::formats::brep::span::{MAX_GAP, between};
use crate::formats::brep::{Wrong, add_edge, reversed};
use std::collections::HashMap;
use trueness_cad::brep::{Bounds, Brep, EdgeUse, Loop, Vertex};
use trueness_cad::curve::Span;
use trueness_geom::space::{Point, minus, norm};

/// Which member of which list became which vertex and edge.
pub(super) struct Topology<'f> {
    pub geometry: Geometry<'f>,
    vertices: HashMap<(u64, usize), u32>,
    edges: HashMap<(u64, usize), Result<u32, Wrong>>,
}

/// A member of a list: the list and the number of the member, from 1.
fn member(record: &Record, k: usize) -> Result<(u64, usize), Wrong> {
    let index = record.integer(k + 1)?;
    match usize::try_from(index) {
        Ok(index) if index > 0 => Ok((record.pointer(k)?, index)),
        _ => Err(record.wrong(format!("names member {index} of a list, whose first is 1"))),
    }
}

impl<'f> Topology<'f> {
    pub fn new(geometry: Geometry<'f>) -> Topology<'f> {
        Topology { geometry, vertices: HashMap::new(), edges: HashMap::new() }
    }

    /// The list of this kind, if it has so many members of `width` parameters behind their number.
    fn list(
        &self,
        (list, index): (u64, usize),
        kind: u64,
        width: usize,
    ) -> Result<(Record<'f>, usize), Wrong> {
        let record = self.geometry.file.record(list)?;
        if record.entity.kind != kind {
            return Err(record.wrong(format!("is no list of the kind {kind} but of {}", record.entity.kind)));
        }
        match index <= record.count(0)? {
            true => Ok((record, 1 + width * (index - 1))),
            false => Err(record.wrong(format!("has no member {index}"))),
        }
    }

    fn vertex(&mut self, member: (u64, usize), brep: &mut Brep) -> Result<u32, Wrong> {
        if let Some(known) = self.vertices.get(&member) {
            return Ok(*known);
        }
        let (record, at) = self.list(member, 502, 3)?;
        let place = self.geometry.place(&record, at)?;
        self.geometry.budget.spend(1, &record)?;
        let index = brep.vertices.len() as u32;
        brep.vertices.push(Vertex { place });
        self.vertices.insert(member, index);
        Ok(index)
    }

    fn edge(&mut self, member: (u64, usize), brep: &mut Brep) -> Result<u32, Wrong> {
        if let Some(known) = self.edges.get(&member) {
            return known.clone();
        }
        let made = self.make_edge(member, brep);
        self.edges.insert(member, made.clone());
        made
    }

    fn make_edge(&mut self, own: (u64, usize), brep: &mut Brep) -> Result<u32, Wrong> {
        let (record, at) = self.list(own, 504, 5)?;
        let vertices =
            [self.vertex(member(&record, at + 1)?, brep)?, self.vertex(member(&record, at + 3)?, brep)?];
        let ends = vertices.map(|v| brep.vertices.get(v as usize).map_or([f64::NAN; 3], |v| v.place));
        let number = record.pointer(at)?;
        let span = self.geometry.curve(number)?;
        let span =
            self.on_curve(&self.geometry.file.record(number)?, span, ends, vertices[0] == vertices[1])?;
        Ok(add_edge(brep, span, vertices, number))
    }

    /// The part of a curve between two vertices: all of it where its ends are there.
    fn on_curve(&self, record: &Record, span: Span, ends: [Point; 2], closed: bool) -> Result<Span, Wrong> {
        let tolerance = self.geometry.tolerance;
        let [from, to] = span.ends();
        let off = |a: Point, b: Point| norm(minus(a, ends[0])).max(norm(minus(b, ends[1])));
        if off(from, to) <= tolerance {
            return Ok(span);
        }
        if off(to, from) <= tolerance {
            return Ok(Span { range: [span.range[1], span.range[0]], ..span });
        }
        let (span, off) = between(span.curve, ends, true, closed, tolerance);
        let places = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| span.derivatives(share)[0]);
        let length: f64 = places.windows(2).map(|w| norm(minus(w[0], w[1]))).sum();
        match off <= tolerance.max(MAX_GAP * length) {
            true => Ok(span),
            false => {
                Err(record.wrong(format!("is an edge with a vertex that lies {off:.3e} mm off its curve")))
            }
        }
    }

    /// A loop (508): for each edge its list, its number there, whether it runs along, and its curves in parameters.
    fn ring(&mut self, number: u64, brep: &mut Brep) -> Result<Loop, Wrong> {
        let record = self.geometry.file.record(number)?;
        if record.entity.kind != 508 {
            return Err(record.wrong(format!("is no loop but of the kind {}", record.entity.kind)));
        }
        let count = record.count(0)?;
        self.geometry.budget.spend(count, &record)?;
        let (mut uses, mut poles, mut at) = (vec![], vec![], 1);
        for _ in 0..count {
            let own = member(&record, at + 1)?;
            match record.integer(at)? {
                1 => poles.push(self.vertex(own, brep)?),
                _ => {
                    uses.push(EdgeUse { edge: self.edge(own, brep)?, reversed: record.integer(at + 3)? == 0 })
                }
            }
            at += 5 + 2 * record.count(at + 4)?;
        }
        match (uses.is_empty(), poles.first()) {
            (false, _) => Ok(Loop::Edges(uses)),
            (true, Some(pole)) => Ok(Loop::Vertex(*pole)),
            (true, None) => Err(record.wrong("has no edges")),
        }
    }

    /// The surface and the loops of a face (510); `turned` where it is to look against the normal of its surface.
    pub fn face(&mut self, record: &Record, turned: bool, brep: &mut Brep) -> Result<(Patch, Bounds), Wrong> {
        let count = record.count(1)?;
        self.geometry.budget.spend(1 + count, record)?;
        let mut loops = vec![];
        for k in 0..count {
            let around = self.ring(record.pointer(3 + k)?, brep)?;
            loops.push(if turned { reversed(around) } else { around });
        }
        let patch = self.geometry.surface(record.pointer(0)?, 0)?;
        match (loops.is_empty(), patch.is_bounded()) {
            (false, _) => Ok((patch, Bounds::Loops(loops))),
            (true, true) => {
                let sides = patch.sides;
                Ok((patch, Bounds::Rectangle(sides)))
            }
            (true, false) => Err(record.wrong("has no loops, and its surface has no end")),
        }
    }
}
