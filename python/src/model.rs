//! A CAD model that points are measured from.

use crate::arrays::{self, Finite};
use crate::mesh::{Mesh, sign};
use crate::{errors, work};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use std::path::PathBuf;
use trueness::SurfaceOptions;
use trueness::files::MemorySources;
use trueness::geom::closest::QueryError;

/// Exact faces, and the mesh that draws them.
#[pyclass(frozen, module = "trueness._trueness")]
pub struct Model {
    model: trueness::Model,
    mesh: Py<Mesh>,
}

/// Distances, places and numbers of the faces of the nearest places.
type Nearest<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<i64>>);

#[pymethods]
impl Model {
    /// Of the bytes of a file of this name.
    #[new]
    fn new(py: Python, name: PathBuf, bytes: PyBackedBytes, progress: Option<Py<PyAny>>) -> PyResult<Model> {
        let mut sources = MemorySources::new();
        sources.insert(name.clone(), bytes);
        let model = work::run(py, progress.as_ref(), |watcher| {
            watcher.begin("preparing the faces", "steps", None);
            trueness::Model::read(&sources, &name, watcher)
        })?;
        let model = model.map_err(|e| errors::task(py, &e))?;
        let mesh = Py::new(py, Mesh::of(model.mesh().clone()))?;
        Ok(Model { model, mesh })
    }

    /// The mesh that draws the faces.
    #[getter]
    fn mesh(&self, py: Python) -> Py<Mesh> {
        self.mesh.clone_ref(py)
    }

    /// How far that mesh is from the faces at most, mm.
    #[getter]
    fn drawn_within(&self) -> f64 {
        self.model.faces().drawn_within
    }

    /// For each face the number of its entity in the file, and its name.
    #[getter]
    fn faces(&self) -> Vec<(u64, String)> {
        self.model.faces().faces.iter().map(|face| (face.entity, face.name.clone())).collect()
    }

    /// What was odd about the file.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.model.record().warnings.clone()
    }

    /// The nearest places.
    fn closest<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Nearest<'py>> {
        let given = arrays::points("points", points)?;
        let finite = Finite::of(given.slice());
        let found = work::run(py, progress.as_ref(), |watcher| {
            watcher.begin("measuring", "points", Some(finite.points.len() as u64));
            let search = &self.model.faces().search;
            search.map(&finite.points, watcher, |_, near| (near.distance, near.place, i64::from(near.face)))
        })?;
        let found = found.map_err(|e| errors::query(py, e, |i| finite.row(i)))?;
        let nowhere = (f64::NAN, [f64::NAN; 3], -1);
        let found = finite.spread(found, nowhere, given.slice().len());
        let distances = arrays::column(py, found.iter().map(|f| f.0).collect());
        let places = arrays::rows(py, found.iter().map(|f| f.1).collect())?;
        Ok((distances, places, arrays::column(py, found.iter().map(|f| f.2).collect())))
    }

    /// Deviations: positive outside; NaN where a point is not finite or is excluded, infinite beyond the greatest distance.
    fn deviations<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        sign: &str,
        max_distance: f64,
        skip_boundary: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        if max_distance.is_nan() || max_distance < 0.0 {
            return Err(errors::query(py, QueryError::BadMaxDistance(max_distance), |i| i));
        }
        if !["auto", "none"].contains(&sign) {
            let text = format!(
                "sign: ‘{sign}’ is for meshes; take auto, for the side of the faces' normal, or none"
            );
            return Err(errors::usage(py, text));
        }
        let given = arrays::points("points", points)?;
        let finite = Finite::of(given.slice());
        let options = SurfaceOptions { sign: self::sign(py, sign)?, max_distance, skip_boundary };
        let found = work::run(py, progress.as_ref(), |watcher| {
            watcher.begin("measuring", "points", Some(finite.points.len() as u64));
            self.model.faces().deviations(&finite.points, &options, watcher)
        })?;
        let found = found.map_err(|e| errors::query(py, e, |i| finite.row(i)))?;
        Ok(arrays::column(py, finite.spread(found, f64::NAN, given.slice().len())))
    }
}
