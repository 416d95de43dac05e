//! Where edges are off the surfaces of their faces and off their vertices.

use super::fault::{Fault, FaultKind};
use crate::trim::Piece;
use crate::trimmed::Trimmed;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Point, minus, norm};

/// Gaps beyond the uncertainty: of each edge on each of its faces the widest, and of each end.
pub(super) fn faults(shape: &Trimmed, within: f64) -> Vec<Fault> {
    let faces: Vec<Vec<Fault>> =
        (0..shape.trims.len() as u32).into_par_iter().map(|face| edge_gaps(shape, face, within)).collect();
    let mut all: Vec<Fault> = faces.into_iter().flatten().collect();
    for (number, edge) in (0u32..).zip(&shape.brep.edges) {
        for (end, vertex) in edge.span.ends().into_iter().zip(edge.vertices) {
            let Some(vertex) = shape.brep.vertices.get(vertex as usize) else { continue };
            let size = norm(minus(end, vertex.place));
            if size > within {
                let kind = FaultKind::VertexGap;
                all.push(Fault { kind, faces: vec![], edges: vec![number], place: vertex.place, size });
            }
        }
    }
    all
}

fn edge_gaps(shape: &Trimmed, face: u32, within: f64) -> Vec<Fault> {
    let Some(Ok(trim)) = shape.trims.get(face as usize) else { return vec![] };
    let mut worst: Vec<(u32, f64, Point)> = vec![];
    for piece in trim.rings.iter().flat_map(|ring| &ring.pieces) {
        let Piece::Edge(strand) = piece else { continue };
        for sample in &strand.samples {
            let place = trim.spans[strand.slot].derivatives(sample.share)[0];
            worst.push((strand.edge, norm(minus(place, trim.chart.place(sample.at))), place));
        }
    }
    worst.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
    worst.dedup_by_key(|w| w.0);
    let fault = |(edge, size, place)| Fault {
        kind: FaultKind::EdgeGap,
        faces: vec![face],
        edges: vec![edge],
        place,
        size,
    };
    worst.into_iter().filter(|w| w.1 > within).map(fault).collect()
}
