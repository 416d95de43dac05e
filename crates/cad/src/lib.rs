//! CAD models: faces on exact surfaces, cut out by exact edges. Numbers in, numbers out: no files, no clock, no printing.
//!
//! | what | where |
//! |---|---|
//! | axes of curves and surfaces; where a part stands | [`frame`] |
//! | lines, conics, splines in space | [`curve`] |
//! | planes, quadrics, tori, splines, swept surfaces | [`surface`] |
//! | vertices, edges, faces, shells, solids | [`brep`] |
//! | what is wrong with a boundary | [`check`] |
//! | exact distances to trimmed faces | [`search`] |
//! | where planes cut faces | [`section`] |
//! | the part of a surface that a face is | [`trim`] |
//! | a boundary with the trims of all its faces | [`trimmed`] |
//! | areas, volumes, moments, bounds | [`measure`] |
//! | facets | [`tessellate`] |
//! | parts, their instances, what could not be read | [`model`] |
//! | datums, geometric tolerances, dimensions of a model | [`tolerances`] |
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test does not hang on the last digit"))]

mod agree;
pub mod brep;
pub mod check;
pub mod curve;
pub mod frame;
pub mod measure;
pub mod model;
pub mod search;
pub mod section;
mod stop;
pub mod surface;
pub mod tessellate;
pub mod tolerances;
pub mod trim;
pub mod trimmed;
