//! Statistics of deviations.

use crate::errors;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use trueness::Summary;

/// The statistics of deviations as a document has them, as JSON. Values that are not finite do not count.
#[pyfunction]
pub fn statistics(py: Python, values: PyReadonlyArray1<f64>) -> PyResult<String> {
    let values = values.as_slice()?;
    let found = py.detach(|| trueness::measure::by_side(&Summary::of(values)));
    serde_json::to_string(&found).map_err(|e| errors::internal(py, e.to_string()))
}
