//! What is told of a fault, and where.

use crate::brep::{Bounds, Brep, EdgeUse, Loop};
use crate::trimmed::Trimmed;
use trueness_geom::space::{Point, norm, times};

/// Parts of an edge by which its length is integrated.
pub const LENGTH_PARTS: usize = 32;

/// A kind of fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// The border of a face encloses nothing, or contradicts itself.
    RefusedFace,
    /// An edge ends one face only.
    FreeEdge,
    /// More than two faces meet in an edge.
    SharedEdge,
    /// Two faces run along their common edge in the same direction: their normals do not agree.
    OppositeFaces,
    /// A solid encloses a volume below 0.
    InsideOutSolid,
    /// The loops of a face run so that it lies on their right.
    TurnedLoops,
    /// An edge is off the surface of its face.
    EdgeGap,
    /// An edge ends off its vertex.
    VertexGap,
    /// An edge is shorter than the uncertainty.
    TinyEdge,
    /// A face is narrower than the uncertainty.
    SliverFace,
}

/// A place where something is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// What.
    pub kind: FaultKind,
    /// The faces.
    pub faces: Vec<u32>,
    /// The edges.
    pub edges: Vec<u32>,
    /// A place to look at.
    pub place: Point,
    /// How large it is, in mm: the gap, the length of the edge, the width of the face; of a solid its volume in mm³.
    pub size: f64,
}

/// The middle of an edge.
pub fn middle(shape: &Trimmed, edge: u32) -> Point {
    shape.brep.edges.get(edge as usize).map_or([0.0; 3], |e| e.span.derivatives(0.5)[0])
}

/// A place of a face: the middle of one of its edges, or amid its parameters.
pub fn place_of_face(shape: &Trimmed, face: u32) -> Point {
    match shape.trims.get(face as usize) {
        Some(Ok(trim)) if trim.edges.is_empty() => {
            trim.chart.place(trim.window.map(|[from, to]| 0.5 * (from + to)))
        }
        Some(Ok(trim)) => middle(shape, trim.edges[0]),
        _ => {
            let edges = uses_of_face(&shape.brep, face);
            let sum = edges.iter().fold([0.0; 3], |sum, u| {
                let p = middle(shape, u.edge);
                [sum[0] + p[0], sum[1] + p[1], sum[2] + p[2]]
            });
            times(1.0 / edges.len().max(1) as f64, sum)
        }
    }
}

/// The edges of a face.
pub fn uses_of_face(brep: &Brep, face: u32) -> Vec<EdgeUse> {
    let Some(Bounds::Loops(loops)) = brep.faces.get(face as usize).map(|f| &f.bounds) else { return vec![] };
    let edges = loops.iter().filter_map(|l| if let Loop::Edges(uses) = l { Some(uses) } else { None });
    edges.flatten().copied().collect()
}

/// The length of an edge, by Simpson's rule.
pub fn length(brep: &Brep, edge: u32) -> f64 {
    let Some(edge) = brep.edges.get(edge as usize) else { return 0.0 };
    let rate = |i: usize| norm(edge.span.derivatives(i as f64 / (2 * LENGTH_PARTS) as f64)[1]);
    let weight = |i: usize| match i {
        0 => 1.0,
        i if i == 2 * LENGTH_PARTS => 1.0,
        i if i % 2 == 1 => 4.0,
        _ => 2.0,
    };
    (0..=2 * LENGTH_PARTS).map(|i| weight(i) * rate(i)).sum::<f64>() / (6 * LENGTH_PARTS) as f64
}
