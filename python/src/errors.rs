//! Why there is no answer, as the exceptions of `trueness/_errors.py`, with the words of the program.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::error::Error;
use std::io;
use trueness::files::{Fault, ReadError};
use trueness::geom::closest::{MeshError, QueryError};
use trueness::geom::topology::TopologyError;
use trueness::task::{ErrorKind, TaskError, causes};

/// The exception of a class of `trueness._errors`.
fn exception(py: Python, class: &str, texts: Vec<String>, number: Option<i32>) -> PyErr {
    let made = || {
        let class = py.import("trueness._errors")?.getattr(class)?;
        let words = PyDict::new(py);
        words.set_item("causes", texts)?;
        words.set_item("errno", number)?;
        class.call_method("_made", (), Some(&words))
    };
    made().map_or_else(|e| e, PyErr::from_value)
}

/// A wrong argument.
pub fn usage(py: Python, text: String) -> PyErr {
    exception(py, "UsageError", vec![text], None)
}

/// A fault of the package itself.
pub fn internal(py: Python, text: String) -> PyErr {
    exception(py, "InternalError", vec![text], None)
}

/// A task that has no answer.
pub fn task(py: Python, error: &TaskError) -> PyErr {
    if let Some(of_system) = of_system(error) {
        return file(py, of_system, causes(error));
    }
    let class = match error.kind() {
        ErrorKind::Usage => "UsageError",
        ErrorKind::Unanswerable => "UnanswerableError",
        ErrorKind::Cancelled => "CancelledError",
    };
    exception(py, class, causes(error), None)
}

/// What the system says of a file.
fn file(py: Python, error: &io::Error, texts: Vec<String>) -> PyErr {
    let class = match error.kind() {
        io::ErrorKind::NotFound => "MissingFileError",
        _ => "FileError",
    };
    exception(py, class, texts, error.raw_os_error())
}

/// The error of the system that led to another one.
fn of_system<'a>(error: &'a (dyn Error + 'static)) -> Option<&'a io::Error> {
    let mut next = Some(error);
    while let Some(error) = next {
        let of_fault = |fault: &'a Fault| match fault {
            Fault::Io(e) => Some(e),
            _ => None,
        };
        let of_read = error.downcast_ref::<ReadError>().and_then(|e| of_fault(&e.fault));
        let found = error.downcast_ref().or(of_read).or(error.downcast_ref().and_then(of_fault));
        if found.is_some() {
            return found;
        }
        next = error.source();
    }
    None
}

/// A mesh that cannot be measured against.
pub fn mesh(py: Python, error: MeshError) -> PyErr {
    match error {
        MeshError::BadIndex { face, .. } => usage(py, format!("faces, row {face}: {error}")),
        MeshError::BadVertex(row) => usage(py, format!("vertices, row {row}: {error}")),
        error => task(py, &TaskError::because(error)),
    }
}

/// Facets that cannot be connected.
pub fn topology(py: Python, error: TopologyError) -> PyErr {
    task(py, &TaskError::because(error))
}

/// Points that cannot be measured; `row` is that of a point by its number.
pub fn query(py: Python, error: QueryError, row: impl Fn(usize) -> usize) -> PyErr {
    match error {
        QueryError::BadPoint(i) => {
            let error = QueryError::BadPoint(row(i));
            usage(py, format!("points, row {}: {error}", row(i)))
        }
        error @ QueryError::BadMaxDistance(_) => usage(py, format!("max_distance: {error}")),
        error => task(py, &TaskError::because(error)),
    }
}
