//! A CAD model as pictures show it: facets by their faces, and lines along its edges.

use crate::cad::word;
use trueness_cad::brep::{Brep, Color, Edge, Loop};
use trueness_cad::{brep::Bounds, curve::Span};
use trueness_document::info::CadSurface;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::Point;

/// What is drawn of the faces beside facets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawnFaces {
    /// The faces, in the order of the boundary.
    pub faces: Vec<DrawnFace>,
    /// The face of each facet.
    pub of_facet: Vec<u32>,
    /// Places along each edge between faces, or at the border of one.
    pub edges: Vec<Vec<Point>>,
}

/// What a reader is told of a face.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnFace {
    /// The number of its entity in the file.
    pub number: u64,
    /// The name that the file gives it; may be empty.
    pub name: String,
    /// The surface that it is a part of.
    pub kind: CadSurface,
    /// The color that the file gives it.
    pub color: Option<Color>,
}

/// How far a line may lie from its edge, as a share of the part's diagonal: less than a pixel of a picture.
const LINE_SHARE: f64 = 5e-4;
/// Greatest angle between neighboring parts of a line, radians: a circle has 24 or more.
const LINE_ANGLE: f64 = std::f64::consts::PI / 12.0;

impl DrawnFaces {
    /// Of a boundary and the facets that draw it, with the face of each.
    pub fn new(brep: &Brep, mesh: &Mesh, of_facet: Vec<u32>) -> DrawnFaces {
        let within = LINE_SHARE * mesh.bounds().diagonal();
        let faces = brep.faces.iter().map(|face| DrawnFace {
            number: face.entity,
            name: face.name.trim().to_string(),
            kind: word(face.surface.kind()),
            color: face.color,
        });
        let line = |(edge, _): (&Edge, _)| line(&edge.span, within);
        // Without a facet nothing says how fine a line must be.
        let borders = if mesh.faces.is_empty() { vec![] } else { borders(brep) };
        let edges = brep.edges.iter().zip(borders).filter(|(_, is_border)| *is_border).map(line);
        DrawnFaces { faces: faces.collect(), of_facet, edges: edges.collect() }
    }
}

/// Whether each edge ends a face. An edge that only one face uses, on both of its sides, is where its surface closes.
fn borders(brep: &Brep) -> Vec<bool> {
    let mut ends = vec![false; brep.edges.len()];
    for face in &brep.faces {
        let Bounds::Loops(loops) = &face.bounds else { continue };
        let mut own: Vec<u32> = vec![];
        for l in loops {
            if let Loop::Edges(uses) = l {
                own.extend(uses.iter().map(|u| u.edge));
            }
        }
        own.sort_unstable();
        for uses in own.chunk_by(|a, b| a == b) {
            if let (1, Some(end)) = (uses.len(), ends.get_mut(uses[0] as usize)) {
                *end = true;
            }
        }
    }
    ends
}

/// Places along an edge, without those that have no finite coordinates.
fn line(span: &Span, within: f64) -> Vec<Point> {
    let places = span.sample(within, LINE_ANGLE).into_iter().map(|t| span.curve.at(t));
    places.filter(|p| p.iter().all(|x| x.is_finite())).collect()
}
