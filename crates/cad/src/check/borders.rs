//! How faces share edges.

use super::fault::{Fault, FaultKind, LENGTH_PARTS, length, middle, place_of_face, uses_of_face};
use crate::trim::{Piece, Straight, Trim};
use crate::trimmed::Trimmed;
use trueness_geom::space::{minus, norm};

/// Faces without a border, free edges, edges of several faces, faces that do not agree.
pub(super) fn faults(shape: &Trimmed) -> Vec<Fault> {
    let brep = &shape.brep;
    let mut all = vec![];
    let mut uses: Vec<(u32, u32, bool)> = vec![];
    for (face, trim) in (0u32..).zip(&shape.trims) {
        let own = uses_of_face(brep, face);
        let fault = |kind| {
            let edges = own.iter().map(|u| u.edge).collect();
            Fault { kind, faces: vec![face], edges, place: place_of_face(shape, face), size: 0.0 }
        };
        match trim {
            Err(_) => all.push(fault(FaultKind::RefusedFace)),
            Ok(trim) if trim.turned => all.push(fault(FaultKind::TurnedLoops)),
            Ok(trim) => all.extend(open_sides(face, trim)),
        }
        uses.extend(own.iter().map(|u| (u.edge, face, u.reversed)));
    }
    uses.sort_unstable();
    for same in uses.chunk_by(|a, b| a.0 == b.0) {
        let kind = match same {
            [_] => FaultKind::FreeEdge,
            [(_, _, first), (_, _, second)] if first == second => FaultKind::OppositeFaces,
            [_, _] => continue,
            _ => FaultKind::SharedEdge,
        };
        let edge = same[0].0;
        let mut faces: Vec<u32> = same.iter().map(|u| u.1).collect();
        faces.dedup();
        let size = length(brep, edge);
        all.push(Fault { kind, faces, edges: vec![edge], place: middle(shape, edge), size });
    }
    all
}

/// Where a face ends without an edge.
fn open_sides(face: u32, trim: &Trim) -> impl Iterator<Item = Fault> {
    let sides = trim.rings.iter().flat_map(|ring| &ring.pieces).filter_map(move |piece| {
        let Piece::Straight { ends: [a, b], kind: Straight::Side } = piece else { return None };
        let at = |i: usize| {
            let share = i as f64 / LENGTH_PARTS as f64;
            trim.chart.place([0, 1].map(|k| a[k] + share * (b[k] - a[k])))
        };
        let steps = (0..LENGTH_PARTS).map(|i| norm(minus(at(i + 1), at(i))));
        Some((at(LENGTH_PARTS / 2), steps.sum::<f64>()))
    });
    sides.map(move |(place, size)| Fault {
        kind: FaultKind::FreeEdge,
        faces: vec![face],
        edges: vec![],
        place,
        size,
    })
}
