//! Facts that follow from the corners of a mesh: the check asks for them, and a repair again and again.

use super::boundary::Boundary;
use super::intersect::Crossings;
use super::{Inspected, Options};
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::topology::{Properties, Topology};
use std::sync::OnceLock;

/// Facts that follow from a mesh.
#[derive(Debug)]
pub struct Known {
    /// Edges, shells, and how facets hang together.
    pub topology: Topology,
    /// Counts, area, volume, genus.
    pub properties: Properties,
    /// The boundary edges as rings and chains.
    pub boundary: Boundary,
    /// As in [`Inspected`].
    pub depths: OnceLock<Vec<i32>>,
}

impl Known {
    /// The facts for `mesh`, which `topology` was made of.
    pub fn of(mesh: &Mesh, topology: Topology) -> Known {
        let properties = Properties::of(mesh, &topology);
        let boundary = Boundary::of(&topology);
        Known { topology, properties, boundary, depths: OnceLock::new() }
    }

    /// The facts for `mesh`, which has the same facets, without the vertices that no facet uses. `None` where facets do not
    /// count, which might use some.
    pub fn compacted(&self, mesh: &Mesh) -> Option<Known> {
        let known = Known::of(mesh, self.topology.compacted()?);
        Some(Known { depths: self.depths.clone(), ..known })
    }

    /// For the kinds of defect to look at; nothing is known of stored normals. `gap`, mm.
    pub fn inspected<'a>(
        &'a self,
        mesh: &'a Mesh,
        crossings: Option<&'a Crossings>,
        (options, gap): (&'a Options, f64),
        progress: &'a dyn Progress,
    ) -> Inspected<'a> {
        Inspected {
            mesh,
            topology: &self.topology,
            properties: &self.properties,
            boundary: &self.boundary,
            depths: &self.depths,
            stored_normals: None,
            crossings,
            options,
            gap,
            progress,
        }
    }
}
