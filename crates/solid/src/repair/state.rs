//! The state of a repair, as a value: a step makes the next one of it.
//!
//! To go back to an earlier state, or to go on from it under other options, it is cloned. The mesh and the facts known
//! about it are shared between clones until one of them changes.

use super::change::Change;
use super::pairs::Pairs;
use crate::arrange::ArrangeError;
use std::collections::BTreeSet;
use std::sync::Arc;
use trueness_geom::check::Known;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::Point;

/// Everything that steps change.
#[derive(Clone)]
pub(super) struct State {
    /// Copied only when it changes while another state still holds it.
    pub(super) mesh: Arc<Mesh>,
    pub changes: Vec<Change>,
    pub handover: Handover,
    /// Facts that follow from the mesh, once they were asked for.
    pub(super) known: Option<Arc<Known>>,
    /// Pairs of its facets that meet where they should not, as far as they are known.
    pub(super) pairs: Pairs,
}

/// Facts that a step hands to later ones, besides the mesh.
#[derive(Clone, Default)]
pub(super) struct Handover {
    /// Vertices at the rims of holes that a step has cut: those holes must be filled whatever their size.
    pub cut_rims: BTreeSet<u32>,
    /// Vertices that were separated from others on purpose and must not be joined again.
    pub kept_apart: BTreeSet<u32>,
    /// Holes that a step has cut have been widened.
    pub has_widened: bool,
    /// Area, mm², by which they may still be.
    pub widening_left: f64,
    /// Area, mm², of fins that are gone.
    pub fins_gone: f64,
    /// Nothing else has helped: crossing facets may be cut out.
    pub may_cut_out: bool,
    /// Why shells that meet were not united.
    pub not_united: Option<ArrangeError>,
    /// Corners of the facets that were removed so that the rest can be closed.
    pub lost: Vec<[Point; 3]>,
}

impl State {
    /// Nothing done to `mesh` yet.
    pub(super) fn of(mesh: Mesh) -> State {
        State {
            mesh: Arc::new(mesh),
            changes: vec![],
            handover: Handover::default(),
            known: None,
            pairs: Pairs::Unknown,
        }
    }

    /// The same mesh, nothing done to it yet. Known facts about it are kept.
    pub(super) fn untouched(&self) -> State {
        State { changes: vec![], handover: Handover::default(), ..self.clone() }
    }

    /// Whether anything has changed since that state.
    pub(super) fn is_beyond(&self, earlier: &State) -> bool {
        let is_same = Arc::ptr_eq(&self.mesh, &earlier.mesh) || self.mesh == earlier.mesh;
        self.changes.len() != earlier.changes.len() || !is_same
    }
}
