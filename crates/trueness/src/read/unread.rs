//! What of a file is not read: one place for what documents, verdicts and refusals say of it.

use crate::task::TaskError;
use std::path::Path;
use trueness_document::{IncompleteRecord, InputRecord, Role};
use trueness_files::cad::SplineModel;
use trueness_files::{Unread, Warning};

/// What of a file was not read, of which `facets` facets were; `None` where all of it was.
pub fn incomplete(role: Role, warnings: &[Warning], facets: Option<u64>) -> Option<IncompleteRecord> {
    let what = match role {
        Role::Reference => "the reference",
        Role::Measured | Role::Mesh => "the file",
    };
    let unread = warnings.iter().filter_map(|w| Some((w, w.unread()?)));
    // What can be counted says most.
    let (warning, unread) = unread.max_by_key(|(_, unread)| matches!(unread, Unread::Faces { .. }))?;
    let Unread::Faces { count, of } = unread else {
        return Some(IncompleteRecord { read: None, of: None, text: format!("{what}: {warning}") });
    };
    let of = of.or(facets.map(|read| read + count))?;
    let read = of.saturating_sub(count);
    let were = if read == 1 { "was" } else { "were" };
    Some(IncompleteRecord {
        read: Some(read),
        of: Some(of),
        text: format!("{read} of {of} faces of {what} {were} read"),
    })
}

/// Faces that are less than their surface.
pub fn trimmed(warnings: &[Warning]) -> Option<u64> {
    warnings.iter().find_map(|w| match w {
        Warning::Trimmed { count } => Some(*count),
        _ => None,
    })
}

/// Why a CAD file is refused where `need` is what it lacks.
pub fn refusal(path: &Path, model: &SplineModel, record: &InputRecord, need: &str) -> TaskError {
    let faces = record.incomplete.as_ref().and_then(|i| i.read.zip(i.of));
    let holds = match (faces, model.surfaces.len(), model.curves.len()) {
        (Some((0, of)), ..) => {
            format!("none of its {of} faces lies on a B-spline surface, and others are not read")
        }
        (Some((1, of)), ..) => {
            format!("1 of its {of} faces lies on a B-spline surface, and others are not read")
        }
        (Some((read, of)), ..) => {
            format!("{read} of its {of} faces lie on B-spline surfaces, and others are not read")
        }
        (None, 0, curves) => format!("it holds no B-spline surface ({curves} curves)"),
        (None, surfaces, _) => format!("it holds B-spline surfaces ({surfaces})"),
    };
    TaskError::unanswerable(format!("{}: {holds}; {need}: export the part as STL", path.display()))
}
