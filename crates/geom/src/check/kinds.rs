//! The list of what is looked for: a kind of defect is one file and one line here.

use super::finding::DefectKind;
use super::{
    boundary_edges, cracks, dangling_facets, degenerate_facets, duplicate_facets, holes,
    inconsistent_orientation, inside_out_shells, islands, non_manifold_edges, non_manifold_vertices,
    not_finite_facets, reversed_normals, self_intersections, sliver_facets, t_junctions, unshared_vertices,
};

/// Names each kind, and lists all of them.
macro_rules! kinds {
    ($($name:ident: $file:ident,)*) => {
        $(
            #[doc = concat!("The kind `", stringify!($file), "`.")]
            pub const $name: &DefectKind = &$file::KIND;
        )*

        /// All kinds of defect, in the order in which they are told.
        pub const KINDS: [&DefectKind; [$($name.name),*].len()] = [$($name),*];
    };
}

kinds! {
    BOUNDARY_EDGES: boundary_edges,
    HOLES: holes,
    CRACKS: cracks,
    DANGLING_FACETS: dangling_facets,
    NON_MANIFOLD_EDGES: non_manifold_edges,
    NON_MANIFOLD_VERTICES: non_manifold_vertices,
    DUPLICATE_FACETS: duplicate_facets,
    DEGENERATE_FACETS: degenerate_facets,
    SLIVER_FACETS: sliver_facets,
    REVERSED_NORMALS: reversed_normals,
    INCONSISTENT_ORIENTATION: inconsistent_orientation,
    INSIDE_OUT_SHELLS: inside_out_shells,
    SELF_INTERSECTIONS: self_intersections,
    T_JUNCTIONS: t_junctions,
    UNSHARED_VERTICES: unshared_vertices,
    ISLANDS: islands,
    NOT_FINITE_FACETS: not_finite_facets,
}
