//! Columns of numbers by the Arrow C data interface, in PyCapsules: what Arrow, pandas, Polars and DuckDB take without a copy.
#![expect(
    unsafe_code,
    reason = "the interface is structures of C, which those who take them release by pointers to functions"
)]

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use std::ffi::{CStr, CString, c_char, c_void};
use std::ptr::{null, null_mut};

/// A structure of the interface: what releases it is null once it has been moved elsewhere.
trait Structure: Sized {
    fn children(&mut self) -> &mut [*mut Self];
    fn release(&mut self) -> &mut Option<unsafe extern "C" fn(*mut Self)>;
    /// Takes what only this structure owns.
    ///
    /// # Safety
    /// Once, for a structure made here.
    unsafe fn free(&mut self);
}

#[repr(C)]
struct Schema {
    format: *const c_char,
    name: *const c_char,
    metadata: *const c_char,
    flags: i64,
    count: i64,
    children: *mut *mut Schema,
    dictionary: *mut Schema,
    release: Option<unsafe extern "C" fn(*mut Schema)>,
    private: *mut c_void,
}

#[repr(C)]
struct Array {
    length: i64,
    nulls: i64,
    offset: i64,
    buffer_count: i64,
    count: i64,
    buffers: *mut *const c_void,
    children: *mut *mut Array,
    dictionary: *mut Array,
    release: Option<unsafe extern "C" fn(*mut Array)>,
    private: *mut c_void,
}

/// What a schema owns.
struct SchemaOwner {
    _name: CString,
    children: Vec<*mut Schema>,
}

/// What an array owns: the NumPy array whose memory it shows.
struct ArrayOwner {
    _values: Option<Py<PyArray1<f64>>>,
    buffers: Vec<*const c_void>,
    children: Vec<*mut Array>,
}

// SAFETY: the pointers lead to memory that the structure owns, or that the NumPy array it holds owns.
unsafe impl Send for Schema {}
// SAFETY: as above.
unsafe impl Send for Array {}

/// Releases a structure, its children first.
///
/// # Safety
/// `this` is a structure made here that has not been released.
unsafe extern "C" fn release<T: Structure>(this: *mut T) {
    // SAFETY: the caller's promise.
    let this = unsafe { &mut *this };
    for child in this.children() {
        // SAFETY: children are boxes made here; one that has been moved away has no release, and its box is empty.
        let mut child = unsafe { Box::from_raw(*child) };
        if let Some(release) = *child.release() {
            // SAFETY: it has not been released, as it still says how.
            unsafe { release(&raw mut *child) }
        }
    }
    // SAFETY: once: the release is taken away.
    unsafe { this.free() }
    *this.release() = None;
}

impl Structure for Schema {
    fn children(&mut self) -> &mut [*mut Schema] {
        // SAFETY: the owner is the box made with this structure.
        unsafe { &mut (*self.private.cast::<SchemaOwner>()).children }
    }
    fn release(&mut self) -> &mut Option<unsafe extern "C" fn(*mut Schema)> {
        &mut self.release
    }
    unsafe fn free(&mut self) {
        // SAFETY: the caller's promise.
        drop(unsafe { Box::from_raw(self.private.cast::<SchemaOwner>()) });
    }
}

impl Structure for Array {
    fn children(&mut self) -> &mut [*mut Array] {
        // SAFETY: the owner is the box made with this structure.
        unsafe { &mut (*self.private.cast::<ArrayOwner>()).children }
    }
    fn release(&mut self) -> &mut Option<unsafe extern "C" fn(*mut Array)> {
        &mut self.release
    }
    unsafe fn free(&mut self) {
        // SAFETY: the caller's promise.
        drop(unsafe { Box::from_raw(self.private.cast::<ArrayOwner>()) });
    }
}

impl Drop for Schema {
    fn drop(&mut self) {
        if let Some(release) = self.release {
            // SAFETY: it has not been released, as it still says how.
            unsafe { release(self) }
        }
    }
}

impl Drop for Array {
    fn drop(&mut self) {
        if let Some(release) = self.release {
            // SAFETY: it has not been released, as it still says how.
            unsafe { release(self) }
        }
    }
}

impl Schema {
    fn new(format: &'static CStr, name: CString, children: Vec<Schema>) -> Schema {
        let children = children.into_iter().map(|child| Box::into_raw(Box::new(child))).collect();
        let mut owner = Box::new(SchemaOwner { _name: name, children });
        Schema {
            format: format.as_ptr(),
            name: owner._name.as_ptr(),
            metadata: null(),
            flags: 0,
            count: owner.children.len() as i64,
            children: owner.children.as_mut_ptr(),
            dictionary: null_mut(),
            release: Some(release::<Schema>),
            private: Box::into_raw(owner).cast(),
        }
    }
}

impl Array {
    fn new(length: usize, values: Option<(Py<PyArray1<f64>>, *const c_void)>, children: Vec<Array>) -> Array {
        let children = children.into_iter().map(|child| Box::into_raw(Box::new(child))).collect();
        // The first buffer would say which values are missing.
        let buffers = [null()].into_iter().chain(values.as_ref().map(|(_, data)| *data)).collect();
        let mut owner = Box::new(ArrayOwner { _values: values.map(|(array, _)| array), buffers, children });
        Array {
            length: length as i64,
            nulls: 0,
            offset: 0,
            buffer_count: owner.buffers.len() as i64,
            count: owner.children.len() as i64,
            buffers: owner.buffers.as_mut_ptr(),
            children: owner.children.as_mut_ptr(),
            dictionary: null_mut(),
            release: Some(release::<Array>),
            private: Box::into_raw(owner).cast(),
        }
    }
}

/// A table of these columns of equal length: its schema and its values.
#[pyfunction]
pub fn arrow<'py>(
    py: Python<'py>,
    names: Vec<String>,
    columns: Vec<PyReadonlyArray1<'py, f64>>,
) -> PyResult<(Bound<'py, PyCapsule>, Bound<'py, PyCapsule>)> {
    let (mut schemas, mut arrays, mut length) = (vec![], vec![], 0);
    for (name, column) in names.into_iter().zip(&columns) {
        let values = column.as_slice()?;
        length = values.len();
        schemas.push(Schema::new(c"g", CString::new(name)?, vec![]));
        let held: Py<PyArray1<f64>> = (**column).clone().unbind();
        arrays.push(Array::new(length, Some((held, values.as_ptr().cast())), vec![]));
    }
    let schema = Schema::new(c"+s", CString::default(), schemas);
    let array = Array::new(length, None, arrays);
    Ok((
        PyCapsule::new_with_value(py, schema, c"arrow_schema")?,
        PyCapsule::new_with_value(py, array, c"arrow_array")?,
    ))
}
