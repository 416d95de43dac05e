//! What is wrong with a boundary: borders, gaps, faces and edges of no size.

mod borders;
mod gaps;
mod sizes;
#[cfg(test)]
mod tests;

use crate::measure::Integrals;
use crate::trimmed::Trimmed;
use trueness_geom::space::{Point, times};

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

/// All faults, kind by kind. `within` is the uncertainty of the file, millimeters; `integrals` are those of the faces.
pub fn faults(shape: &Trimmed, integrals: &[Option<Integrals>], within: f64) -> Vec<Fault> {
    let mut all = borders::faults(shape);
    all.extend(gaps::faults(shape, within));
    all.extend(sizes::faults(shape, integrals, within));
    all.sort_by_key(|fault| fault.kind);
    all
}

/// The middle of an edge.
fn middle(shape: &Trimmed, edge: u32) -> Point {
    shape.brep.edges.get(edge as usize).map_or([0.0; 3], |e| e.span.derivatives(0.5)[0])
}

/// A place of a face: the middle of one of its edges, or amid its parameters.
fn place_of_face(shape: &Trimmed, face: u32) -> Point {
    match shape.trims.get(face as usize) {
        Some(Ok(trim)) if trim.edges.is_empty() => {
            trim.chart.place(trim.window.map(|[from, to]| 0.5 * (from + to)))
        }
        Some(Ok(trim)) => middle(shape, trim.edges[0]),
        _ => {
            let edges = borders::uses_of_face(&shape.brep, face);
            let sum = edges.iter().fold([0.0; 3], |sum, u| {
                let p = middle(shape, u.edge);
                [sum[0] + p[0], sum[1] + p[1], sum[2] + p[2]]
            });
            times(1.0 / edges.len().max(1) as f64, sum)
        }
    }
}
