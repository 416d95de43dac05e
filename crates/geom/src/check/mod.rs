//! Everything that is wrong with a mesh, found exactly and with its place.
//!
//! [`check`] looks for every kind of defect in [`KINDS`]: one file and one line each. A check never fails, it returns
//! [`Finding`]s: kind, place and size as data, not text. Questions of geometry (orientation, intersection, collinearity) are
//! decided exactly. Questions that only a tolerance can decide have one in [`Options`], with a default that follows from the
//! precision of the coordinates.

pub(crate) mod boundary;
mod boundary_edges;
mod cracks;
mod dangling_facets;
mod degenerate_facets;
mod duplicate_facets;
pub mod finding;
mod holes;
mod inconsistent_orientation;
mod inside_out_shells;
pub mod intersect;
mod islands;
mod kinds;
mod known;
pub mod near;
pub mod nesting;
mod non_manifold_edges;
mod non_manifold_vertices;
mod not_finite_facets;
mod options;
mod overlap;
mod precision;
mod precondition;
mod reversed_normals;
mod self_intersections;
mod sliver_facets;
mod t_junctions;
#[cfg(test)]
pub(crate) mod tests;
mod unshared_vertices;

pub use finding::{DefectKind, Finding, Found, Inspected, Measure, Severity, Shows};
pub use kinds::*;
pub use known::Known;
pub use options::Options;
pub use precision::spacing;
pub use precondition::Precondition;

use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress};
use crate::topology::weld::WeldError;
use crate::topology::{Properties, Soundness, Topology, TopologyError};

/// The result of [`check`].
#[derive(Clone, Debug)]
pub struct Report {
    /// No finding of a kind that is an [`Severity::Error`].
    pub sound: bool,
    /// The verdict that the signs of deviations hang on.
    pub soundness: Soundness,
    /// Size and place.
    pub properties: Properties,
    /// Vertices that a facet uses.
    pub vertices: usize,
    /// Edges.
    pub edges: usize,
    /// V − E + F.
    pub euler_characteristic: i64,
    /// Number of handles of all shells together; `None` unless the mesh is a closed surface, consistently oriented.
    pub genus: Option<i64>,
    /// The gap used, mm.
    pub gap: f64,
    /// Findings by kind, in the order of [`KINDS`]; `None` where a kind was not looked for.
    pub defects: Vec<(&'static DefectKind, Option<Found>)>,
}

impl Report {
    /// Findings of this kind; `None` where it was not looked for ([`DefectKind::missing`]).
    pub fn found(&self, kind: &DefectKind) -> Option<&Found> {
        self.defects.iter().find(|(of, _)| *of == kind).and_then(|(_, found)| found.as_ref())
    }

    /// How many findings of this kind there are; 0 where it was not looked for.
    pub fn count(&self, kind: &DefectKind) -> usize {
        self.found(kind).map_or(0, |found| found.count)
    }
}

/// Why there is no report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CheckError {
    /// The faces cannot be connected.
    #[error(transparent)]
    Weld(#[from] WeldError),
    /// The ends of boundary edges are numbered in 32 bits.
    #[error(
        "{edges} edges with one facet are more than the {MAX_BOUNDARY_EDGES} that can be walked: weld the mesh, or split the model"
    )]
    TooManyBoundaryEdges {
        /// Number of edges with one facet.
        edges: usize,
    },
    /// The check was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<TopologyError> for CheckError {
    fn from(e: TopologyError) -> CheckError {
        match e {
            TopologyError::Weld(e) => e.into(),
            TopologyError::Cancelled(e) => e.into(),
        }
    }
}

/// Most boundary edges whose ends can be numbered by a `u32`.
const MAX_BOUNDARY_EDGES: usize = u32::MAX as usize / 2;

/// Looks for every kind of defect.
///
/// `mesh` must be welded, as the readers of files and [`weld`](crate::topology::weld) leave it: vertices at the same place are
/// otherwise different vertices. `stored_normals` are those a file holds with its facets, in the order of the faces, of any
/// length; a zero or NaN one says nothing. Any mesh will do, however broken; what geometry decides is decided exactly where
/// coordinates are 0 or from 1e-50 to 1e45 mm. The report is the same for any number of threads. A scan of 1.6 million facets
/// takes about 0.4 s on two cores, half of it for self-intersections. `progress` hears of facets as they pass that search.
/// Closed shells within each other are compared two and two, which grows with the square of how deep they lie. 3,000 boxes,
/// each in the next, take 0.7 s; 10,000 take 8 s.
///
/// # Errors
/// [`CheckError`].
pub fn check(
    mesh: &Mesh,
    stored_normals: Option<&[[f32; 3]]>,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Report, CheckError> {
    let known = known(mesh, progress)?;
    let crossings = match options.self_intersections {
        true => Some(intersect::first_self_intersections(mesh, &known.topology, options.limit, progress)?),
        false => None,
    };
    let gap = options.gap.unwrap_or(8.0 * spacing(&known.properties.bounds));
    let inspected = known.inspected(mesh, crossings.as_ref(), (options, gap), progress);
    Ok(report(&Inspected { stored_normals, ..inspected })?)
}

/// The demands of [`check`] on a mesh before anything is looked for.
///
/// # Errors
/// [`CheckError`].
pub fn known(mesh: &Mesh, progress: &dyn Progress) -> Result<Known, CheckError> {
    let topology = Topology::watched(mesh, progress)?;
    let open = topology.boundary_edges.len();
    if open > MAX_BOUNDARY_EDGES {
        return Err(CheckError::TooManyBoundaryEdges { edges: open });
    }
    Ok(Known::of(mesh, topology))
}

/// As [`check`], where what the kinds look at is at hand.
///
/// # Errors
/// [`Cancelled`].
pub fn report(inspected: &Inspected) -> Result<Report, Cancelled> {
    let &Inspected { topology, properties, gap, progress, .. } = inspected;
    let mut defects = vec![];
    for kind in KINDS {
        defects.push((kind, (kind.find)(inspected)));
        if progress.cancelled() {
            return Err(Cancelled);
        }
    }
    let broken = |(kind, found): &(&DefectKind, Option<Found>)| {
        kind.severity == Severity::Error && found.as_ref().is_some_and(|f| f.count > 0)
    };
    let soundness = Soundness::from_parts(topology, properties);
    Ok(Report {
        sound: topology.counting_facets > 0 && !defects.iter().any(broken),
        genus: genus(topology, &soundness),
        soundness,
        vertices: topology.used_vertices(),
        edges: topology.edges,
        euler_characteristic: topology.euler_characteristic(),
        gap,
        properties: properties.clone(),
        defects,
    })
}

/// From V − E + F = 2 (shells − handles), which holds for closed oriented surfaces.
fn genus(topology: &Topology, soundness: &Soundness) -> Option<i64> {
    let surface = soundness.closed
        && soundness.consistently_oriented
        && soundness.non_manifold_edges == 0
        && soundness.non_manifold_vertices == 0;
    surface.then(|| topology.shells as i64 - topology.euler_characteristic() / 2)
}
