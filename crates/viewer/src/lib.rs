//! The report page and 3D viewer.
