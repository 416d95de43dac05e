//! Faces without topology: trimmed surfaces (144), bounded surfaces (143), bounded planes (108) and surfaces with ends.

use super::super::record::Record;
use super::geometry::Geometry;
use super::surface::Patch;
use crate::formats::brep::span::MAX_GAP;
use crate::formats::brep::{Wrong, add_edge};
use trueness_cad::brep::{Bounds, Brep, EdgeUse, Loop, Vertex};
use trueness_cad::curve::Span;
use trueness_geom::space::{Aabb, minus, norm};

/// What of a surface a face is, and what was odd.
pub(super) struct Bounded {
    pub patch: Patch,
    pub bounds: Bounds,
    /// Which loop is around the others, where the file says so.
    pub outer: Option<usize>,
    /// Curves on the surface that the file wants to be taken in its parameters.
    pub in_parameters: Vec<u64>,
}

impl Geometry<'_> {
    /// The face of an entity; its border becomes part of `brep`.
    pub fn bounded(&self, record: &Record, brep: &mut Brep) -> Result<Bounded, Wrong> {
        match record.entity.kind {
            144 => self.trimmed(record, brep),
            143 => self.within_boundaries(record, brep),
            108 if record.entity.form < 0 => {
                Err(record.wrong("is a hole in a plane, which no surface names"))
            }
            108 if record.entity.form > 0 => {
                let patch = self.surface(record.entity.number, 0)?;
                let around = self.around(record, self.chain(record.pointer(4)?)?, brep)?;
                Ok(Bounded {
                    patch,
                    bounds: Bounds::Loops(vec![around]),
                    outer: Some(0),
                    in_parameters: vec![],
                })
            }
            _ => {
                let patch = self.surface(record.entity.number, 0)?;
                let bounds = Bounds::Rectangle(patch.sides);
                Ok(Bounded { patch, bounds, outer: None, in_parameters: vec![] })
            }
        }
    }

    /// A surface, whether its outer bound is a curve, the number of holes, the outer bound and the holes.
    fn trimmed(&self, record: &Record, brep: &mut Brep) -> Result<Bounded, Wrong> {
        let patch = self.surface(record.pointer(0)?, 0)?;
        let (has_outer, holes) = (record.integer(1)? != 0, record.count(2)?);
        self.budget.spend(1 + holes, record)?;
        let mut found =
            Bounded { patch, bounds: Bounds::Loops(vec![]), outer: Some(0), in_parameters: vec![] };
        let mut loops = vec![];
        let outer = if has_outer { record.optional(3)? } else { None };
        if outer.is_none() {
            if !found.patch.is_bounded() {
                return Err(record.wrong("has no outer bound, and its surface has no end"));
            }
            if holes == 0 {
                return Ok(Bounded { bounds: Bounds::Rectangle(found.patch.sides), outer: None, ..found });
            }
            let sides = self.sides(record, &found.patch)?;
            loops.push(self.around(record, sides, brep)?);
        }
        for number in outer.map(Ok).into_iter().chain((0..holes).map(|k| record.pointer(4 + k))) {
            let bound = self.file.record(number?)?;
            if bound.entity.kind != 142 {
                return Err(bound.wrong("is no curve on a surface"));
            }
            if bound.integer(4)? == 1 && bound.optional(3)?.is_some() {
                found.in_parameters.push(bound.entity.number);
            }
            let spans = self.bound(&bound, &found.patch)?;
            loops.push(self.around(&bound, spans, brep)?);
        }
        Ok(Bounded { bounds: Bounds::Loops(loops), ..found })
    }

    /// A curve on a surface (142): that in space, else that in the parameters.
    fn bound(&self, bound: &Record, patch: &Patch) -> Result<Vec<Span>, Wrong> {
        let in_parameters = bound.optional(2)?;
        match (bound.optional(3)?, in_parameters) {
            (Some(number), None) => self.chain(number),
            (None, Some(own)) => self.on_surface(own, patch),
            (Some(number), Some(own)) => {
                self.chain(number).or_else(|wrong| self.on_surface(own, patch).map_err(|_| wrong))
            }
            (None, None) => Err(bound.wrong("names neither a curve in space nor one in parameters")),
        }
    }

    /// Kind, surface, and the boundaries (141): each has curves in space, with their sense and those in parameters.
    fn within_boundaries(&self, record: &Record, brep: &mut Brep) -> Result<Bounded, Wrong> {
        let patch = self.surface(record.pointer(1)?, 0)?;
        let count = record.count(2)?;
        self.budget.spend(1 + count, record)?;
        let mut loops = vec![];
        for k in 0..count {
            let boundary = self.file.record(record.pointer(3 + k)?)?;
            if boundary.entity.kind != 141 {
                return Err(boundary.wrong("is no boundary"));
            }
            let (curves, mut at, mut spans) = (boundary.count(3)?, 4, vec![]);
            self.budget.spend(1 + curves, &boundary)?;
            for _ in 0..curves {
                let mut own = self.chain(boundary.pointer(at)?)?;
                if boundary.integer(at + 1)? == 2 {
                    own.reverse();
                    own.iter_mut().for_each(|span| span.range.reverse());
                }
                spans.append(&mut own);
                at += 3 + boundary.count(at + 2)?;
            }
            loops.push(self.around(&boundary, spans, brep)?);
        }
        match loops.is_empty() {
            true => Err(record.wrong("has no boundary")),
            false => Ok(Bounded { patch, bounds: Bounds::Loops(loops), outer: None, in_parameters: vec![] }),
        }
    }

    /// The four sides of a surface with ends, one after another.
    fn sides(&self, record: &Record, patch: &Patch) -> Result<Vec<Span>, Wrong> {
        let [[u0, u1], [v0, v1]] = patch.sides;
        let along = [(1, v0, [u0, u1]), (0, u1, [v0, v1]), (1, v1, [u1, u0]), (0, u0, [v1, v0])];
        let span = |(held, at, range)| Some(Span { curve: patch.surface.iso_curve(held, at)?, range });
        let spans: Option<Vec<Span>> = along.into_iter().map(span).collect();
        let mut spans = spans.ok_or_else(|| record.wrong("has holes and no outer bound, on an offset"))?;
        let size = |span: &Span| Aabb::of(&[0.0, 0.3, 0.7, 1.0].map(|s| span.derivatives(s)[0])).diagonal();
        spans.retain(|span| size(span) > self.tolerance);
        Ok(spans)
    }

    /// A loop of pieces, each an edge of its own. Pieces that are given backwards are turned.
    fn around(&self, record: &Record, mut spans: Vec<Span>, brep: &mut Brep) -> Result<Loop, Wrong> {
        self.budget.spend(spans.len(), record)?;
        follow(&mut spans, self.tolerance);
        let first = brep.vertices.len() as u32;
        let count = spans.len() as u32;
        let places: Vec<_> = spans.iter().map(|span| span.ends()[0]).collect();
        let gap = |k: usize| norm(minus(spans[k].ends()[1], places[(k + 1) % places.len()]));
        let widest = (0..spans.len()).map(gap).fold(0.0, f64::max);
        let size = Aabb::of(
            spans.iter().flat_map(|s| [0.0, 0.5].map(|t| s.derivatives(t)[0])).collect::<Vec<_>>().iter(),
        );
        if widest.is_nan() || widest > self.tolerance.max(MAX_GAP * size.diagonal()) {
            return Err(record.wrong(format!("is a boundary with a gap of {widest:.3e} mm")));
        }
        brep.vertices.extend(places.into_iter().map(|place| Vertex { place }));
        let mut uses = vec![];
        for (k, span) in (0..count).zip(spans) {
            let vertices = [first + k, first + (k + 1) % count];
            uses.push(EdgeUse {
                edge: add_edge(brep, span, vertices, record.entity.number),
                reversed: false,
            });
        }
        Ok(Loop::Edges(uses))
    }
}

/// Turns pieces so that each begins where the one before ends.
fn follow(spans: &mut [Span], tolerance: f64) {
    let apart = |a: [f64; 3], b: [f64; 3]| norm(minus(a, b));
    if let [first, second, ..] = spans {
        let ([a, b], [c, d]) = (first.ends(), second.ends());
        let (ahead, behind) = (apart(b, c).min(apart(b, d)), apart(a, c).min(apart(a, d)));
        if ahead > tolerance && behind < ahead {
            first.range.reverse();
        }
    }
    for k in 1..spans.len() {
        let end = spans[k - 1].ends()[1];
        let [from, to] = spans[k].ends();
        if apart(end, from) > tolerance && apart(end, to) < apart(end, from) {
            spans[k].range.reverse();
        }
    }
}
