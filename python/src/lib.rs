//! The extension module of the Python package `trueness`: arrays and requests in, arrays and documents out. What users see of it is
//! written in Python, in `trueness/`.

mod answer;
mod arrays;
mod arrow;
mod errors;
mod mesh;
mod model;
mod read;
mod statistics;
mod work;

use pyo3::prelude::*;
use std::ffi::OsString;

/// The program with these words: its exit status.
#[pyfunction]
fn main(py: Python, words: Vec<OsString>) -> u8 {
    py.detach(|| trueness_cli::main_from(words))
}

#[pymodule]
fn _trueness(module: &Bound<PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<mesh::Mesh>()?;
    module.add_class::<model::Model>()?;
    module.add_class::<answer::Answer>()?;
    module.add_function(wrap_pyfunction!(answer::run, module)?)?;
    module.add_function(wrap_pyfunction!(arrays::address, module)?)?;
    module.add_function(wrap_pyfunction!(arrow::arrow, module)?)?;
    module.add_function(wrap_pyfunction!(main, module)?)?;
    module.add_function(wrap_pyfunction!(read::read, module)?)?;
    module.add_function(wrap_pyfunction!(statistics::statistics, module)?)
}
