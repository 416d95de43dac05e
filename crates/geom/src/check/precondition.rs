//! The faults of a mesh that leave doubt in statistics of deviations from it, with their places.

use super::boundary::Boundary;
use super::kinds::*;
use super::overlap::shells_overlap;
use super::{DefectKind, Found, Inspected, Options, spacing};
use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress};
use crate::topology::{Properties, Soundness, Topology, TopologyError};
use std::sync::OnceLock;

/// The verdict on a mesh that is measured against, and what speaks against it.
#[derive(Clone, Debug, PartialEq)]
pub struct Precondition {
    /// The verdict.
    pub soundness: Soundness,
    /// Kinds that break the rule and have a finding, in the order of [`KINDS`]. None where the mesh is sound.
    pub findings: Vec<(&'static DefectKind, Found)>,
    /// The mesh is closed and consistently oriented, but its shells cross or touch, or one lies in another and looks the way
    /// that one does. The surface winds around some places more than once, or the wrong way.
    pub shells_overlap: bool,
}

/// The kinds that are looked for: they follow from how the facets hang together.
const KINDS_OF_RULE: [&DefectKind; 8] = [
    BOUNDARY_EDGES,
    HOLES,
    CRACKS,
    NON_MANIFOLD_EDGES,
    NON_MANIFOLD_VERTICES,
    DUPLICATE_FACETS,
    INCONSISTENT_ORIENTATION,
    INSIDE_OUT_SHELLS,
];

impl Precondition {
    /// The precondition of a welded mesh, listing at most `limit` findings of each kind.
    ///
    /// A sound mesh of one shell costs as much as [`Soundness::of`]. Findings are only looked for in meshes that are not sound.
    /// Overlapping shells are looked for where boxes of shells overlap, which takes a search for self-intersections.
    ///
    /// # Errors
    /// As [`Topology::watched`].
    pub fn of(mesh: &Mesh, limit: usize, progress: &dyn Progress) -> Result<Precondition, TopologyError> {
        let topology = Topology::watched(mesh, progress)?;
        let properties = Properties::of(mesh, &topology);
        let soundness = Soundness::from_parts(&topology, &properties);
        let inspected = Inspected {
            mesh,
            topology: &topology,
            properties: &properties,
            boundary: &Boundary::of(&topology),
            depths: &OnceLock::new(),
            stored_normals: None,
            crossings: None,
            options: &Options { limit, self_intersections: false, ..Options::default() },
            gap: 8.0 * spacing(&properties.bounds),
            progress,
        };
        let findings = if soundness.sound { vec![] } else { findings(&inspected) };
        let shells_overlap = soundness.oriented() && shells_overlap(&inspected)?;
        if progress.cancelled() {
            return Err(Cancelled.into());
        }
        Ok(Precondition { soundness, findings, shells_overlap })
    }
}

fn findings(inspected: &Inspected) -> Vec<(&'static DefectKind, Found)> {
    let of_rule = KINDS_OF_RULE.into_iter();
    let found = of_rule.filter_map(|kind| Some((kind, (kind.find)(inspected)?)));
    found.filter(|(_, found)| found.count > 0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;
    use crate::samples::block;

    #[test]
    fn a_sound_mesh_has_no_findings_and_a_broken_one_those_of_its_check() {
        let mut mesh = block(3, 3.0);
        assert!(
            Precondition::of(&mesh, 9, &Silent).is_ok_and(|p| p.soundness.sound && p.findings.is_empty())
        );
        mesh.faces.remove(4);
        mesh.faces.push(mesh.faces[20]);
        let p = Precondition::of(&mesh, 2, &Silent).unwrap();
        let counts: Vec<_> = p.findings.iter().map(|(k, f)| (k.name, f.count, f.items.len())).collect();
        let want = [
            ("boundary_edges", 3, 2),
            ("holes", 1, 1),
            ("non_manifold_edges", 3, 2),
            ("duplicate_facets", 1, 1),
        ];
        assert_eq!(counts, want);
        let whole = super::super::check(&mesh, None, &Options { limit: 2, ..Options::default() }, &Silent);
        let whole = whole.unwrap();
        assert!(p.findings.iter().all(|(kind, found)| whole.found(kind) == Some(found)));
        assert_eq!(p.soundness, whole.soundness);
    }
}
