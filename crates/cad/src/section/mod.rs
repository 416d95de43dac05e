//! Where a plane cuts faces: lines and circles where these are exact, else cubics within a tolerance.
//!
//! The facets that draw the faces say which faces a section passes, in which order (`ways`); its places are then those of the edges and
//! surfaces themselves. So outlines of closed shells close, and what is nearer to the plane than facets are to the faces may be missed.
//!
//! | face | section |
//! |---|---|
//! | plane | line |
//! | cylinder, extrusion along the plane; cone through its apex | lines |
//! | sphere; cylinder, cone, torus, turned curve across their axis; torus along its axis | circle |
//! | all others | curve |

mod course;
mod direction;
mod kind;
mod place;
#[cfg(test)]
mod tests;
mod ways;

use crate::curve::{Curve, Span};
use crate::frame::Frame;
use crate::tessellate::Tessellation;
use crate::trim::Trim;
use crate::trimmed::Trimmed;
use course::Course;
use kind::Kind;
use place::Places;
use std::f64::consts::{PI, TAU};
use trueness_geom::plane::Plane;
use trueness_geom::space::{Point, cross, dot, minus, norm, unit};
use ways::{Run, ways};

/// The section of a plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Outlines, each with the material on its left as seen against the normal.
    pub outlines: Vec<Outline>,
    /// Faces that lie in the plane. The section is then that just below it.
    pub in_plane: Vec<u32>,
}

/// Pieces, each begins where the one before ends, up to the gaps between edges and faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// In their order.
    pub pieces: Vec<Piece>,
    /// Whether the last leads to the first.
    pub closed: bool,
}

/// A part of an outline in one face.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The face.
    pub face: u32,
    /// A line, a circle or a cubic spline.
    pub span: Span,
}

/// Faces and edges nearer to the plane than this share of the part lie in it: files have some ten digits.
const IN_PLANE_SHARE: f64 = 1e-9;
/// How far a cubic may lie from the section, as a share of the part.
pub const CURVE_SHARE: f64 = 1e-8;

/// The section of a plane with the faces of a boundary. `drawn` are their facets, which look out of the material.
pub fn section(shape: &Trimmed, drawn: &Tessellation, plane: &Plane) -> Section {
    let Some((normal, length)) = unit(plane.normal) else { return Section::default() };
    let plane = Plane { normal, offset: plane.offset / length };
    let size = drawn.mesh.bounds().diagonal();
    let tolerance = IN_PLANE_SHARE * size;
    // Places on the plane count as above, as if it were a little lower.
    let above: Vec<bool> = drawn.mesh.positions.iter().map(|p| plane.height(p) >= -tolerance).collect();
    let places = Places::new(shape, drawn, plane);
    let cutter = Cutter { shape, plane, places, tolerance, within: CURVE_SHARE * size };
    let outline = |(runs, closed): (Vec<Run>, bool)| Outline {
        pieces: runs.iter().flat_map(|run| cutter.pieces(run)).collect(),
        closed,
    };
    let outlines = ways(&drawn.mesh, &drawn.faces, &above).into_iter().map(outline);
    Section {
        outlines: outlines.filter(|o| !o.pieces.is_empty()).collect(),
        in_plane: in_plane(drawn, &plane, tolerance),
    }
}

/// Faces of which all vertices lie in the plane.
fn in_plane(drawn: &Tessellation, plane: &Plane, tolerance: f64) -> Vec<u32> {
    let mut off: Vec<u32> = vec![];
    let mut all: Vec<u32> = vec![];
    for (facet, face) in drawn.mesh.faces.iter().zip(&drawn.faces) {
        all.push(*face);
        if facet.iter().any(|v| plane.height(&drawn.mesh.positions[*v as usize]).abs() > tolerance) {
            off.push(*face);
        }
    }
    off.dedup();
    all.dedup();
    all.retain(|face| off.binary_search(face).is_err());
    all
}

/// What pieces are made with.
struct Cutter<'a> {
    shape: &'a Trimmed,
    plane: Plane,
    places: Places<'a>,
    tolerance: f64,
    within: f64,
}

impl Cutter<'_> {
    /// The pieces of a run: several lines where it passes the apex of a cone, else one.
    fn pieces(&self, run: &Run) -> Vec<Piece> {
        let Some(Ok(trim)) = self.shape.trims.get(run.face as usize) else { return vec![] };
        let mut places: Vec<Point> = run.edges.iter().map(|edge| self.places.near(*edge)).collect();
        if run.closed {
            places.extend(places.first().copied());
        } else if let [first, .., last] = &run.edges[..] {
            let end = places.len() - 1;
            (places[0], places[end]) = (self.places.exact(*first), self.places.exact(*last));
        }
        let spans = match Kind::of(trim, &self.plane, &places, self.tolerance) {
            Kind::Line(corner) => self.lines(&places, corner),
            Kind::Circle(center, radius) => {
                self.arc(&places, run.closed, center, radius).into_iter().collect()
            }
            Kind::Curve => self.curve(trim, &places).into_iter().collect(),
        };
        spans.into_iter().map(|span| Piece { face: run.face, span }).collect()
    }

    /// Straight from the first place to the last, or to a corner and on, if that is not on the way.
    fn lines(&self, places: &[Point], corner: Option<Point>) -> Vec<Span> {
        let [first, .., last] = places else { return vec![] };
        let is_beside = |c: &Point| {
            let [way, off] = [minus(*last, *first), minus(*c, *first)];
            norm(cross(way, off)) > self.tolerance * norm(way) || dot(way, off) < 0.0
        };
        let is_on_run = |c: &Point| places.iter().any(|p| norm(minus(*p, *c)) <= self.tolerance);
        let ends = match corner.filter(is_on_run).filter(is_beside) {
            Some(corner) => vec![[*first, corner], [corner, *last]],
            None => vec![[*first, *last]],
        };
        ends.into_iter()
            .filter(|[a, b]| norm(minus(*b, *a)) > self.tolerance)
            .map(|[a, b]| line(a, b))
            .collect()
    }

    /// The part of a circle that the places run along.
    fn arc(&self, places: &[Point], closed: bool, center: Point, radius: f64) -> Option<Span> {
        let frame = Frame::new(center, self.plane.normal, None)?;
        let angle = |p: &Point| {
            let [x, y, _] = frame.local(*p);
            libm::atan2(y, x)
        };
        let turn = |from: f64, to: f64| {
            let by = to - from;
            by - TAU * (by / TAU).round()
        };
        let angles: Vec<f64> = places.iter().map(angle).collect();
        let sweep: f64 = angles.windows(2).map(|w| turn(w[0], w[1])).sum();
        let sweep = match closed {
            true => TAU.copysign(sweep),
            false => sweep,
        };
        let start = *angles.first()?;
        let is_long = radius * sweep.abs() > self.tolerance && sweep.abs() < TAU + PI;
        is_long.then_some(Span { curve: Curve::Circle { frame, radius }, range: [start, start + sweep] })
    }

    fn curve(&self, trim: &Trim, places: &[Point]) -> Option<Span> {
        Course { trim, plane: &self.plane, within: self.within, same: self.tolerance }.span(places)
    }
}

fn line(from: Point, to: Point) -> Span {
    Span { curve: Curve::Line { origin: from, direction: minus(to, from) }, range: [0.0, 1.0] }
}
