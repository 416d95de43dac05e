//! Faces whose file gives them no topology.

use trueness_cad::brep::{Bounds, Face, Loop};

/// A face without topology: its loops have no sense yet.
pub(super) struct Loose {
    pub face: u32,
    /// Which loop is around the others, where the file says so.
    pub outer: Option<usize>,
}

/// The edges of a face.
pub(super) fn edges_of(face: &Face) -> Vec<u32> {
    let Bounds::Loops(loops) = &face.bounds else { return vec![] };
    let uses = loops.iter().filter_map(|l| if let Loop::Edges(uses) = l { Some(uses) } else { None });
    uses.flatten().map(|u| u.edge).collect()
}
