//! NumPy arrays in and out.

use crate::errors;
use numpy::{Element, IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, dtype};
use pyo3::prelude::*;
use std::borrow::Cow;
use trueness::Point;

/// An array of shape (n, 3) that others own, in our memory order; the very array where it is in that order already.
pub struct Rows<'py, T: Element>(PyReadonlyArray2<'py, T>);

impl<'py, T: Element> Rows<'py, T> {
    /// The argument `name`; `kinds` are the letters of NumPy's kinds of numbers that it may have.
    ///
    /// # Errors
    /// Another shape or kind.
    pub fn read(name: &str, value: &Bound<'py, PyAny>, kinds: &str) -> PyResult<Rows<'py, T>> {
        let py = value.py();
        let numpy = py.import("numpy")?;
        let array = numpy.call_method1("asarray", (value,))?;
        let shape: Vec<usize> = array.getattr("shape")?.extract()?;
        let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
        let is_empty = shape.first() == Some(&0);
        if !(shape.len() == 2 && shape[1] == 3) && shape != [0] {
            let shown: Vec<String> = shape.iter().map(ToString::to_string).collect();
            let text = format!("{name}: its shape is ({}), give one of (n, 3)", shown.join(", "));
            return Err(errors::usage(py, text));
        }
        if !kinds.contains(&kind) && !is_empty {
            let wanted = if kinds.contains('f') { "real numbers" } else { "whole numbers" };
            let text = format!("{name}: it holds {}, give {wanted}", array.getattr("dtype")?);
            return Err(errors::usage(py, text));
        }
        let required = numpy.call_method1("require", (array, dtype::<T>(py), ("C", "A")))?;
        let rows = required.call_method1("reshape", (shape[0], 3))?;
        let array =
            rows.cast::<PyArray2<T>>().map_err(|_| errors::usage(py, format!("{name}: not an array")))?;
        Ok(Rows(array.try_readonly().map_err(|e| errors::usage(py, format!("{name}: {e}")))?))
    }

    /// The rows.
    pub fn slice(&self) -> &[[T; 3]] {
        self.0.as_slice().map_or(&[], |all| all.as_chunks().0)
    }
}

/// Points, which may be any real numbers.
pub fn points<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Rows<'py, f64>> {
    Rows::read(name, value, "fiu")
}

/// Where the points of an argument lie in memory as we read them.
#[pyfunction]
pub fn address(points: &Bound<PyAny>) -> PyResult<usize> {
    Ok(self::points("points", points)?.slice().as_ptr().addr())
}

/// Points without those that are not finite, and the rows of the rest where some were left out.
pub struct Finite<'a> {
    pub points: Cow<'a, [Point]>,
    rows: Option<Vec<usize>>,
}

impl<'a> Finite<'a> {
    /// Of these; they are copied only where one is not finite.
    pub fn of(points: &'a [Point]) -> Finite<'a> {
        let is_finite = |p: &Point| p.iter().all(|x| x.is_finite());
        if points.iter().all(is_finite) {
            return Finite { points: Cow::Borrowed(points), rows: None };
        }
        let rows: Vec<usize> = (0..points.len()).filter(|i| is_finite(&points[*i])).collect();
        Finite { points: rows.iter().map(|i| points[*i]).collect(), rows: Some(rows) }
    }

    /// The row of the point of this number.
    pub fn row(&self, number: usize) -> usize {
        self.rows.as_ref().and_then(|rows| rows.get(number)).copied().unwrap_or(number)
    }

    /// One value for each row, of one for each finite point; `fill` for the others.
    pub fn spread<T: Copy>(&self, values: Vec<T>, fill: T, count: usize) -> Vec<T> {
        let Some(rows) = &self.rows else { return values };
        let mut all = vec![fill; count];
        for (row, value) in rows.iter().zip(values) {
            all[*row] = value;
        }
        all
    }
}

/// A column of numbers, not copied.
pub fn column<T: Element>(py: Python, values: Vec<T>) -> Bound<PyArray1<T>> {
    values.into_pyarray(py)
}

/// Rows of three numbers, not copied.
pub fn rows<T: Element>(py: Python, values: Vec<[T; 3]>) -> PyResult<Bound<PyArray2<T>>> {
    let count = values.len();
    values.into_flattened().into_pyarray(py).reshape([count, 3])
}
