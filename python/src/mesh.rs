//! A mesh that points are measured from.
#![expect(
    unsafe_code,
    reason = "NumPy looks at the memory of a mesh, which the mesh keeps alive and nobody changes"
)]

use crate::arrays::{self, Finite, Rows};
use crate::{errors, work};
use numpy::ndarray::ArrayView2;
use numpy::{Element, PyArray1, PyArray2};
use pyo3::prelude::*;
use std::sync::{Arc, Mutex};
use trueness::geom;
use trueness::geom::closest::{Query, QueryError, Tree};
use trueness::geom::deviation::sign_choice::SignRequest;
use trueness::geom::deviation::surface::{OnlyCancels, ReferenceSurface, SurfaceOptions};
use trueness::task::Choice;
use trueness::tasks::compare::Sign;
use work::Watcher;

/// Points that are answered at once: more need more memory and are no faster.
const BLOCK: usize = 1 << 20;
/// Surfaces of one mesh with different options that are kept.
const MAX_KEPT_SURFACES: usize = 4;

/// Vertices and faces, with what searches need of them once one was asked for.
#[pyclass(frozen, module = "trueness._trueness")]
pub struct Mesh {
    mesh: geom::mesh::Mesh,
    prepared: Mutex<Prepared>,
}

/// What is prepared at the first question, and kept.
#[derive(Default)]
struct Prepared {
    tree: Option<Tree>,
    surfaces: Vec<(SurfaceOptions, Arc<ReferenceSurface>)>,
}

impl Mesh {
    /// Of what was read.
    pub fn of(mesh: geom::mesh::Mesh) -> Mesh {
        Mesh { mesh, prepared: Mutex::default() }
    }

    /// The search tree.
    fn tree(&self, py: Python, progress: Option<&Py<PyAny>>) -> PyResult<Tree> {
        self.tree_of(py, &mut *work::lock(py, &self.prepared)?, progress)
    }

    fn tree_of(&self, py: Python, own: &mut Prepared, progress: Option<&Py<PyAny>>) -> PyResult<Tree> {
        if let Some(tree) = &own.tree {
            return Ok(tree.clone());
        }
        let built = work::run(py, progress, |watcher| {
            watcher.begin("building the tree", "steps", None);
            Tree::build_watched(&self.mesh, &OnlyCancels(watcher))
        })?;
        Ok(own.tree.insert(built.map_err(|e| errors::mesh(py, e))?).clone())
    }

    /// The surface with these options.
    fn surface(
        &self,
        py: Python,
        options: SurfaceOptions,
        progress: Option<&Py<PyAny>>,
    ) -> PyResult<Arc<ReferenceSurface>> {
        let query = Query { max_distance: options.max_distance, ..Query::default() };
        query.check().map_err(|e| errors::query(py, e, |i| i))?;
        let mut own = work::lock(py, &self.prepared)?;
        if let Some((_, surface)) = own.surfaces.iter().find(|(of, _)| *of == options) {
            return Ok(surface.clone());
        }
        let tree = self.tree_of(py, &mut own, progress)?;
        let made = work::run(py, progress, |watcher| {
            watcher.begin("preparing the reference", "steps", None);
            ReferenceSurface::new(&tree, &self.mesh, &options, &OnlyCancels(watcher))
        })?;
        let made = Arc::new(made.map_err(|e| errors::topology(py, e))?);
        own.surfaces.truncate(MAX_KEPT_SURFACES - 1);
        own.surfaces.insert(0, (options, made.clone()));
        Ok(made)
    }
}

/// Why points have no answer, with the row of the bad one.
struct BadPoint(QueryError, usize);

impl BadPoint {
    /// The failure of a block with its row among all points.
    fn of(error: QueryError, block: usize, finite: &Finite) -> BadPoint {
        let row = if let QueryError::BadPoint(i) = error { block * BLOCK + finite.row(i) } else { 0 };
        BadPoint(error, row)
    }

    fn raise(self, py: Python) -> PyErr {
        errors::query(py, self.0, |_| self.1)
    }
}

/// The deviations of points; NaN where a point is not finite.
fn measure(
    surface: &ReferenceSurface,
    points: &[geom::space::Point],
    watcher: &Watcher,
) -> Result<Vec<f64>, BadPoint> {
    watcher.begin("measuring", "points", Some(points.len() as u64));
    let mut all = Vec::with_capacity(points.len());
    for (block, part) in points.chunks(BLOCK).enumerate() {
        let finite = Finite::of(part);
        let values = surface.deviations(&finite.points, watcher);
        let values = values.map_err(|e| BadPoint::of(e, block, &finite))?;
        all.extend(finite.spread(values, f64::NAN, part.len()));
    }
    Ok(all)
}

/// How the sign is found, by its word.
pub fn sign(py: Python, word: &str) -> PyResult<SignRequest> {
    let known = || Sign::ALL.iter().map(|(_, word, _)| *word).collect::<Vec<_>>().join(", ");
    let sign = Sign::named(word)
        .ok_or_else(|| errors::usage(py, format!("sign: ‘{word}’ is none of {}", known())))?;
    Ok(sign.into())
}

/// Distances, places, facets and weights of the corners of the nearest places.
type Nearest<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray2<f64>>,
);

/// The same as columns.
#[derive(Default)]
struct Places {
    distances: Vec<f64>,
    points: Vec<[f64; 3]>,
    facets: Vec<i64>,
    weights: Vec<[f64; 3]>,
}

impl Places {
    fn of(count: usize) -> Places {
        let nowhere = [f64::NAN; 3];
        Places {
            distances: vec![f64::NAN; count],
            points: vec![nowhere; count],
            facets: vec![-1; count],
            weights: vec![nowhere; count],
        }
    }

    /// Looks all points up.
    fn find(
        tree: &Tree,
        points: &[geom::space::Point],
        max_distance: f64,
        watcher: &Watcher,
    ) -> Result<Places, BadPoint> {
        let query = Query { max_distance, ..Query::default() };
        watcher.begin("measuring", "points", Some(points.len() as u64));
        let mut all = Places::of(points.len());
        for (block, part) in points.chunks(BLOCK).enumerate() {
            let finite = Finite::of(part);
            let own = &finite.points;
            let found =
                tree.map_closest(own, &query, watcher, |i, hit| hit.map(|hit| tree.place(&own[i], &hit)));
            for (i, place) in found.map_err(|e| BadPoint::of(e, block, &finite))?.into_iter().enumerate() {
                let Some(place) = place else { continue };
                let row = block * BLOCK + finite.row(i);
                all.distances[row] = place.distance;
                all.points[row] = place.point;
                all.facets[row] = place.face.into();
                all.weights[row] = place.barycentric;
            }
        }
        Ok(all)
    }
}

#[pymethods]
impl Mesh {
    #[new]
    fn new(vertices: &Bound<PyAny>, faces: &Bound<PyAny>) -> PyResult<Mesh> {
        let py = vertices.py();
        let positions = arrays::points("vertices", vertices)?.slice().to_vec();
        let given = Rows::<i64>::read("faces", faces, "iu")?;
        let vertex = |row: usize, v: i64| {
            let known = usize::try_from(v).ok().filter(|v| *v < positions.len());
            known.and_then(|v| u32::try_from(v).ok()).ok_or_else(|| {
                let count = positions.len();
                errors::usage(
                    py,
                    format!("faces, row {row}: it names vertex {v}, but there are {count} vertices"),
                )
            })
        };
        let corners = |(row, face): (usize, &[i64; 3])| {
            Ok([vertex(row, face[0])?, vertex(row, face[1])?, vertex(row, face[2])?])
        };
        let faces = given.slice().iter().enumerate().map(corners).collect::<PyResult<_>>()?;
        Ok(Mesh::of(geom::mesh::Mesh { positions, faces }))
    }

    /// The vertices: a view that cannot be written to.
    #[getter]
    fn vertices<'py>(slf: &Bound<'py, Mesh>) -> PyResult<Bound<'py, PyAny>> {
        view(slf, slf.get().mesh.positions.as_flattened())
    }

    /// The faces: a view that cannot be written to.
    #[getter]
    fn faces<'py>(slf: &Bound<'py, Mesh>) -> PyResult<Bound<'py, PyAny>> {
        view(slf, slf.get().mesh.faces.as_flattened())
    }

    /// The nearest places.
    fn closest<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
        max_distance: f64,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Nearest<'py>> {
        let given = arrays::points("points", points)?;
        let points = given.slice();
        let tree = self.tree(py, progress.as_ref())?;
        let found =
            work::run(py, progress.as_ref(), |watcher| Places::find(&tree, points, max_distance, watcher))?;
        let Places { distances, points, facets, weights } = found.map_err(|e| e.raise(py))?;
        let column = arrays::column(py, distances);
        Ok((column, arrays::rows(py, points)?, arrays::column(py, facets), arrays::rows(py, weights)?))
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
        let given = arrays::points("points", points)?;
        let points = given.slice();
        let options = SurfaceOptions { sign: self::sign(py, sign)?, max_distance, skip_boundary };
        let surface = self.surface(py, options, progress.as_ref())?;
        let found = work::run(py, progress.as_ref(), |watcher| measure(&surface, points, watcher))?;
        Ok(arrays::column(py, found.map_err(|e| e.raise(py))?))
    }

    /// The method by which the sign is found, and why it is that one.
    fn sign(&self, py: Python, sign: &str) -> PyResult<(&'static str, String)> {
        let options = SurfaceOptions { sign: self::sign(py, sign)?, ..SurfaceOptions::default() };
        let surface = self.surface(py, options, None)?;
        Ok((surface.sign().method.name(), surface.sign().to_string()))
    }

    /// Whether it is closed, consistently oriented, and sound.
    fn soundness(&self, py: Python) -> PyResult<(bool, bool, bool)> {
        let surface = self.surface(py, SurfaceOptions::default(), None)?;
        let found = surface.soundness();
        Ok((found.closed, found.consistently_oriented, found.sound))
    }
}

/// The memory of a mesh as an array of three columns that keeps the mesh alive.
fn view<'py, T: Element>(owner: &Bound<'py, Mesh>, values: &[T]) -> PyResult<Bound<'py, PyAny>> {
    let shape = (values.len() / 3, 3);
    let values =
        ArrayView2::from_shape(shape, values).map_err(|e| errors::internal(owner.py(), e.to_string()))?;
    // SAFETY: the values belong to `owner`, which is frozen: they neither move nor change while it lives, and the array holds it. Nobody can
    // write to them, as the array is made read-only before it is given away.
    let array = unsafe { PyArray2::borrow_from_array(&values, owner.clone().into_any()) };
    array.call_method1("setflags", (false,))?;
    Ok(array.into_any())
}
