//! Edges and faces of no size, and solids inside out.

use super::fault::{Fault, FaultKind, length, middle, place_of_face, uses_of_face};
use crate::measure::Integrals;
use crate::trimmed::Trimmed;

/// Edges shorter and faces narrower than the uncertainty, and solids with a volume below 0.
pub(super) fn faults(shape: &Trimmed, integrals: &[Option<Integrals>], within: f64) -> Vec<Fault> {
    let brep = &shape.brep;
    let mut all = vec![];
    let lengths: Vec<f64> = (0..brep.edges.len() as u32).map(|edge| length(brep, edge)).collect();
    for (edge, size) in (0u32..).zip(&lengths).filter(|(_, length)| **length <= within) {
        let kind = FaultKind::TinyEdge;
        all.push(Fault { kind, faces: vec![], edges: vec![edge], place: middle(shape, edge), size: *size });
    }
    for (face, own) in (0u32..).zip(integrals) {
        let Some(own) = own else { continue };
        let edges: Vec<u32> = uses_of_face(brep, face).iter().map(|u| u.edge).collect();
        let around: f64 = edges.iter().filter_map(|e| lengths.get(*e as usize)).sum();
        // A strip is as wide as its area over half of the way around it.
        let size = 2.0 * own.area / around;
        // A sphere has no border.
        if around > 0.0 && size <= within {
            let kind = FaultKind::SliverFace;
            all.push(Fault { kind, faces: vec![face], edges, place: place_of_face(shape, face), size });
        }
    }
    for solid in &brep.solids {
        let volume = shape.volume(solid, integrals).unwrap_or(0.0);
        let faces = brep.shells.get(solid.outer as usize).map_or(vec![], |shell| shell.faces.clone());
        if volume < 0.0
            && let Some(first) = faces.first()
        {
            let place = place_of_face(shape, *first);
            let kind = FaultKind::InsideOutSolid;
            all.push(Fault { kind, faces, edges: vec![], place, size: -volume });
        }
    }
    all
}
