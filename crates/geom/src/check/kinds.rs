//! The list of what is looked for: a kind of defect is one file and one line here.

use super::finding::DefectKind;
use super::{
    boundary_edges, cracks, dangling_facets, degenerate_facets, duplicate_facets, holes,
    inconsistent_orientation, inside_out_shells, islands, non_manifold_edges, non_manifold_vertices,
    not_finite_facets, reversed_normals, self_intersections, sliver_facets, t_junctions, unshared_vertices,
};

/// All kinds of defect, in the order in which they are told.
pub const KINDS: [&DefectKind; 17] = [
    &boundary_edges::KIND,
    &holes::KIND,
    &cracks::KIND,
    &dangling_facets::KIND,
    &non_manifold_edges::KIND,
    &non_manifold_vertices::KIND,
    &duplicate_facets::KIND,
    &degenerate_facets::KIND,
    &sliver_facets::KIND,
    &reversed_normals::KIND,
    &inconsistent_orientation::KIND,
    &inside_out_shells::KIND,
    &self_intersections::KIND,
    &t_junctions::KIND,
    &unshared_vertices::KIND,
    &islands::KIND,
    &not_finite_facets::KIND,
];
