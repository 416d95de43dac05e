//! Why there is no answer.

use crate::task::TaskError;
use trueness_files::{Holds, ReadError, WriteError};
use trueness_geom::align::AlignError;
use trueness_geom::check::CheckError;
use trueness_geom::closest::{MeshError, QueryError};
use trueness_geom::fit::FitError;
use trueness_geom::segment::SegmentError;
use trueness_geom::topology::TopologyError;
use trueness_section::SectionError;
use trueness_solid::repair::RepairError;
use trueness_surface::SurfaceError;
use trueness_surface::curvature::CurvatureError;

/// Why there is no answer: that of the task, with a sentence that says what is wrong and what to do.
///
/// ```
/// let error = trueness::read("no/such/file.stl").unwrap_err();
/// assert!(matches!(error, trueness::Error::Read(_)));
/// assert!(error.to_string().starts_with("no/such/file.stl: "), "{error}");
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file cannot be read; names file, place and remedy.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The file holds B-spline surfaces or curves, where something else is needed.
    #[error(
        "{path}: it holds B-spline surfaces or curves; trueness::files::open reads them, and trueness::tasks::compare measures against them"
    )]
    Splines {
        /// The file.
        path: String,
    },
    /// The file holds a CAD model, where a mesh or points are needed.
    #[error(
        "{path}: it holds a CAD model; Reference::read measures against its faces, trueness::tasks::check looks for its faults, \
         trueness::tasks::convert makes a mesh of it"
    )]
    Cad {
        /// The file.
        path: String,
    },
    /// Faces of a CAD model could not be read, and deviations from the others alone would mislead.
    #[error("{path}: {what}; trueness::tasks::compare measures against the others and says so")]
    Incomplete {
        /// The file.
        path: String,
        /// How many.
        what: String,
    },
    /// The faces of a CAD model cannot be made ready.
    #[error(transparent)]
    Model(#[from] TaskError),
    /// The file holds lines, arcs and curves of a drawing, where a mesh or points are needed.
    #[error("{path}: it holds a drawing; trueness::files::open reads it")]
    Drawing {
        /// The file.
        path: String,
    },
    /// The file holds points without facets, where a mesh is needed.
    #[error("{path}: it holds points without facets; this needs a mesh ({})", Holds::Mesh.formats())]
    NoFacets {
        /// The file.
        path: String,
    },
    /// A mesh cannot be searched.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The facets of a mesh cannot be connected.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// A point cannot be measured, or the work was stopped.
    #[error(transparent)]
    Query(#[from] QueryError),
    /// There is no pose.
    #[error(transparent)]
    Align(#[from] AlignError),
    /// A mesh cannot be checked.
    #[error(transparent)]
    Check(#[from] CheckError),
    /// A mesh cannot be mended.
    #[error(transparent)]
    Repair(#[from] RepairError),
    /// There is no element.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// Nothing can be looked for.
    #[error(transparent)]
    Segment(#[from] SegmentError),
    /// There is no contour.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// There is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// There are no curvatures.
    #[error(transparent)]
    Curvature(#[from] CurvatureError),
}
