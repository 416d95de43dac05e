//! Files of any format.

use crate::mesh::Mesh;
use crate::{arrays, errors, work};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use trueness::files::{Body, FileSources, Place, ReadError, ReadOptions, Sources, Warning, open_from};
use trueness::geom;
use trueness::task::{Reading, TaskError};

/// What a file holds.
enum Read {
    Mesh(geom::mesh::Mesh),
    Points(Vec<geom::space::Point>),
    /// The bytes of a CAD file.
    Cad(Vec<u8>),
}

/// Reads a mesh, points, or the bytes of a CAD model; with what was odd about the file. `reading` says how it is taken.
#[pyfunction]
pub fn read<'py>(
    py: Python<'py>,
    path: PathBuf,
    reading: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, Vec<String>)> {
    let reading: Reading = serde_json::from_str(reading).map_err(|e| errors::usage(py, e.to_string()))?;
    let found = work::run(py, progress.as_ref(), |watcher| {
        watcher.begin("reading", "bytes", None);
        content(&path, &reading.options())
    })?;
    let (read, warnings) = found.map_err(|e| errors::task(py, &e))?;
    let made = match read {
        Read::Mesh(mesh) => Bound::new(py, Mesh::of(mesh))?.into_any(),
        Read::Points(points) => arrays::rows(py, points)?.into_any(),
        Read::Cad(bytes) => PyBytes::new(py, &bytes).into_any(),
    };
    Ok((made, warnings))
}

fn content(path: &std::path::Path, options: &ReadOptions) -> Result<(Read, Vec<String>), TaskError> {
    let input = open_from(&FileSources, path, options)?;
    let mut warnings: Vec<String> = input.warnings.iter().map(ToString::to_string).collect();
    let refused = |e: trueness::Error| Err(TaskError::because(e));
    let shown = || input.provenance.path.clone();
    let read = match input.body {
        Body::Mesh(source) => Read::Mesh(source.mesh),
        Body::Points(mut stream) => {
            let (mut all, mut block) = (vec![], vec![]);
            loop {
                stream.next_block(&mut block)?;
                if block.is_empty() {
                    break;
                }
                all.append(&mut block);
            }
            warnings.extend(stream.remarks().into_iter().map(|text| Warning::Remark(text).to_string()));
            Read::Points(all)
        }
        Body::Cad(_) => {
            let bytes = FileSources.bytes(path).and_then(|bytes| bytes.head(usize::MAX));
            Read::Cad(bytes.map_err(|fault| ReadError { file: shown(), place: Place::File, fault })?)
        }
        Body::Splines(_) => return refused(trueness::Error::Splines { path: shown() }),
        Body::Drawing(_) => return refused(trueness::Error::Drawing { path: shown() }),
    };
    Ok((read, warnings))
}
