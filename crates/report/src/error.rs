//! Why there is no report.

use std::io;
use trueness_geom::progress::Cancelled;

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The output refused bytes.
    #[error("the report could not be written: {0}")]
    Write(#[from] io::Error),
    /// The result could not be made JSON.
    #[error("the result could not be put into the report: {0}")]
    Json(#[from] serde_json::Error),
    /// A field has another number of values than its object has places.
    #[error("object {object}: {values} deviations for {places} places")]
    FieldLength {
        /// Number of the object.
        object: usize,
        /// Deviations given.
        values: usize,
        /// Points or vertices.
        places: usize,
    },
    /// The report is no longer wanted.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The triangle code failed.
    #[error("the triangles could not be packed: {0}")]
    Encoding(String),
}
