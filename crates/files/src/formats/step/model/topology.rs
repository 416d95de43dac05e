//! Vertices, edges and loops.

use super::super::part21::{Entity, Record, Wrong};
use super::curve::{Geometry, size};
use crate::formats::brep::span::{MAX_GAP, between};
use crate::formats::brep::{add_edge, straight};
use std::collections::HashMap;
use trueness_cad::brep::{Bounds, Brep, EdgeUse, Loop, Vertex};
use trueness_cad::curve::{Curve, Span};
use trueness_geom::space::{Aabb, Point, minus, norm};

/// Oriented edges, faces and shells that name another one of their kind at most.
pub(super) const MAX_ORIENTED: usize = 8;

/// The boundary that is made, and which entity became which vertex and edge.
pub(super) struct Topology<'f> {
    pub geometry: Geometry<'f>,
    pub brep: Brep,
    /// Of vertices, and of the points of polygons.
    vertices: HashMap<u64, u32>,
    edges: HashMap<u64, Result<u32, Wrong>>,
    /// Sides of polygons, by the lower and the higher number of their points.
    sides: HashMap<[u64; 2], u32>,
}

impl<'f> Topology<'f> {
    pub fn new(geometry: Geometry<'f>) -> Topology<'f> {
        Topology {
            geometry,
            brep: Brep::default(),
            vertices: HashMap::new(),
            edges: HashMap::new(),
            sides: HashMap::new(),
        }
    }

    /// Forgets which entity became what: another representation has other units.
    pub fn forget(&mut self) {
        self.vertices.clear();
        self.edges.clear();
        self.sides.clear();
    }

    fn add_vertex(&mut self, number: u64, place: Point) -> u32 {
        let index = self.brep.vertices.len() as u32;
        self.brep.vertices.push(Vertex { place });
        self.vertices.insert(number, index);
        index
    }

    fn place(&self, vertex: u32) -> Point {
        self.brep.vertices.get(vertex as usize).map_or([f64::NAN; 3], |v| v.place)
    }

    /// The vertex of an entity.
    pub fn vertex(&mut self, number: u64) -> Result<u32, Wrong> {
        if let Some(known) = self.vertices.get(&number) {
            return Ok(*known);
        }
        let entity = self.geometry.file.entity(number)?;
        let Some(record) = entity.record("VERTEX_POINT") else {
            return Err(entity.wrong("is no VERTEX_POINT"));
        };
        let index = usize::from(entity.is_simple());
        let place = self.geometry.point(record.entity(index)?)?;
        Ok(self.add_vertex(number, place))
    }

    /// The edge of an entity.
    fn edge(&mut self, number: u64) -> Result<u32, Wrong> {
        if let Some(known) = self.edges.get(&number) {
            return known.clone();
        }
        let made = self.make_edge(number);
        self.edges.insert(number, made.clone());
        made
    }

    fn make_edge(&mut self, number: u64) -> Result<u32, Wrong> {
        let entity = self.geometry.file.entity(number)?;
        let record = entity.main(&["EDGE_CURVE", "EDGE"]);
        if !matches!(record.keyword, "EDGE_CURVE" | "EDGE") {
            return Err(record.wrong(format!("is no EDGE_CURVE but {}", record.keyword)));
        }
        let vertices = [self.vertex(record.entity(1)?)?, self.vertex(record.entity(2)?)?];
        let ends = vertices.map(|v| self.place(v));
        let curve = match record.keyword {
            "EDGE_CURVE" if !record.is_absent(3) => {
                let (curve, same) = self.geometry.edge_curve(record.entity(3)?)?;
                Some((curve, same == record.truth(4)?))
            }
            _ => None,
        };
        let closed = vertices[0] == vertices[1];
        let span = match curve {
            Some((curve, same)) => self.on_curve(&record, curve, ends, same, closed)?,
            // An edge without a curve is straight.
            None => straight(ends).ok_or_else(|| record.wrong("has neither a curve nor two places"))?,
        };
        self.geometry.budget.spend(size(&span.curve), &entity)?;
        Ok(add_edge(&mut self.brep, span, vertices, number))
    }

    fn on_curve(
        &self,
        record: &Record,
        curve: Curve,
        ends: [Point; 2],
        same: bool,
        closed: bool,
    ) -> Result<Span, Wrong> {
        let tolerance = self.geometry.tolerance;
        let (span, off) = between(curve, ends, same, closed, tolerance);
        let places = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| span.derivatives(share)[0]);
        let length: f64 = places.windows(2).map(|w| norm(minus(w[0], w[1]))).sum();
        if !length.is_finite() || !off.is_finite() {
            return Err(record.wrong("has no place on its curve"));
        }
        if off > tolerance.max(MAX_GAP * length) {
            return Err(record.wrong(format!("has a vertex that lies {off:.3e} mm off its curve")));
        }
        Ok(span)
    }

    /// A loop of a face.
    pub fn read_loop(&mut self, number: u64) -> Result<Loop, Wrong> {
        let entity = self.geometry.file.entity(number)?;
        let record = entity.main(&["EDGE_LOOP", "POLY_LOOP", "VERTEX_LOOP"]);
        match record.keyword {
            "VERTEX_LOOP" => Ok(Loop::Vertex(self.vertex(record.entity(1)?)?)),
            "EDGE_LOOP" => self.edge_loop(&entity, &record),
            "POLY_LOOP" => self.polygon(&entity, &record),
            keyword => Err(record.wrong(format!("is no loop that is read but {keyword}"))),
        }
    }

    fn edge_loop(&mut self, entity: &Entity, record: &Record) -> Result<Loop, Wrong> {
        let edges = record.entities(1)?;
        self.geometry.budget.spend(edges.len(), entity)?;
        let mut uses = vec![];
        for number in edges {
            uses.push(self.edge_use(number)?);
        }
        if uses.is_empty() {
            return Err(record.wrong("has no edges"));
        }
        self.closes(record, &uses)?;
        Ok(Loop::Edges(uses))
    }

    /// An edge as a loop names it.
    fn edge_use(&mut self, number: u64) -> Result<EdgeUse, Wrong> {
        let (mut number, mut reversed) = (number, false);
        for _ in 0..MAX_ORIENTED {
            let entity = self.geometry.file.entity(number)?;
            let Some(oriented) = entity.record("ORIENTED_EDGE") else {
                return Ok(EdgeUse { edge: self.edge(number)?, reversed });
            };
            reversed ^= !oriented.truth(oriented.values.len().saturating_sub(1))?;
            number = oriented.entity(oriented.values.len().saturating_sub(2))?;
        }
        Err(self.geometry.file.entity(number)?.wrong("rests on itself"))
    }

    /// First and last vertex of an edge as a loop uses it.
    fn ends(&self, used: &EdgeUse) -> [u32; 2] {
        let [a, b] = self.brep.edges.get(used.edge as usize).map_or([0; 2], |e| e.vertices);
        if used.reversed { [b, a] } else { [a, b] }
    }

    /// Whether each edge begins where the one before it ends, but for gaps that are small against the loop.
    fn closes(&self, record: &Record, uses: &[EdgeUse]) -> Result<(), Wrong> {
        let mut widest = (0.0, 0);
        let mut length = 0.0;
        for (k, used) in uses.iter().enumerate() {
            let next = self.ends(&uses[(k + 1) % uses.len()])[0];
            let [from, to] = self.ends(used);
            length += norm(minus(self.place(from), self.place(to)));
            let gap = if to == next { 0.0 } else { norm(minus(self.place(to), self.place(next))) };
            if gap > widest.0 {
                widest = (gap, used.edge);
            }
        }
        if widest.0 > self.geometry.tolerance.max(MAX_GAP * length) {
            let edge = self.brep.edges.get(widest.1 as usize).map_or(0, |e| e.entity);
            return Err(record.wrong(format!("is open: {:.3e} mm behind edge #{edge}", widest.0)));
        }
        Ok(())
    }

    /// A closed polygon: its sides are edges that polygons with the same points share.
    fn polygon(&mut self, entity: &Entity, record: &Record) -> Result<Loop, Wrong> {
        let points = record.entities(1)?;
        self.geometry.budget.spend(points.len(), entity)?;
        let mut corners: Vec<u64> = points.collect();
        corners.dedup();
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if corners.len() < 3 {
            return Err(record.wrong("has fewer than three corners"));
        }
        let mut uses = vec![];
        for (k, from) in corners.iter().copied().enumerate() {
            let to = corners[(k + 1) % corners.len()];
            uses.push(EdgeUse { edge: self.side(from.min(to), from.max(to))?, reversed: from > to });
        }
        Ok(Loop::Edges(uses))
    }

    fn side(&mut self, low: u64, high: u64) -> Result<u32, Wrong> {
        if let Some(known) = self.sides.get(&[low, high]) {
            return Ok(*known);
        }
        let mut vertices = [0; 2];
        for (vertex, number) in vertices.iter_mut().zip([low, high]) {
            *vertex = match self.vertices.get(&number) {
                Some(known) => *known,
                None => {
                    let place = self.geometry.point(number)?;
                    self.add_vertex(number, place)
                }
            };
        }
        let ends = vertices.map(|v| self.place(v));
        let Some(span) = straight(ends) else {
            return Err(self.geometry.file.entity(high)?.wrong("lies where the corner before it lies"));
        };
        let index = add_edge(&mut self.brep, span, vertices, low);
        self.sides.insert([low, high], index);
        Ok(index)
    }

    /// The bounds of a surface that curves bound: each piece of them is an edge of its own.
    pub fn boundaries(&mut self, record: &Record) -> Result<Bounds, Wrong> {
        let mut loops = vec![];
        for number in record.entities(2)? {
            let entity = self.geometry.file.entity(number)?;
            let spans = match self.geometry.curve(number, 0)? {
                Curve::Joined(spans) => spans,
                _ => vec![self.geometry.bounded(number, 0)?],
            };
            loops.push(self.boundary(&entity, spans)?);
        }
        match loops.is_empty() {
            true => Err(record.wrong("has no boundary")),
            false => Ok(Bounds::Loops(loops)),
        }
    }

    fn boundary(&mut self, entity: &Entity, spans: Vec<Span>) -> Result<Loop, Wrong> {
        self.geometry.budget.spend(spans.len(), entity)?;
        let first = self.brep.vertices.len() as u32;
        let count = spans.len() as u32;
        let mut uses = vec![];
        for (k, span) in (0..count).zip(spans) {
            self.brep.vertices.push(Vertex { place: span.ends()[0] });
            let vertices = [first + k, first + (k + 1) % count];
            let edge = add_edge(&mut self.brep, span, vertices, entity.number());
            uses.push(EdgeUse { edge, reversed: false });
        }
        let gap = |used: &EdgeUse| {
            let edge = &self.brep.edges[used.edge as usize];
            norm(minus(edge.span.ends()[1], self.place(edge.vertices[1])))
        };
        let widest = uses.iter().map(gap).fold(0.0, f64::max);
        let size = Aabb::of(&self.corners(&Loop::Edges(uses.clone()))).diagonal();
        match widest <= self.geometry.tolerance.max(MAX_GAP * size) {
            true => Ok(Loop::Edges(uses)),
            false => Err(entity.wrong(format!("is a boundary with a gap of {widest:.3e} mm"))),
        }
    }

    /// The corners of a loop, in its order.
    pub fn corners(&self, around: &Loop) -> Vec<Point> {
        match around {
            Loop::Vertex(v) => vec![self.place(*v)],
            Loop::Edges(uses) => uses.iter().map(|u| self.place(self.ends(u)[0])).collect(),
        }
    }
}
