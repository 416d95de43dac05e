//! The CAD model of an IGES file: exact faces, and where subfigures stand.
//!
//! Entities that nothing uses are its shapes: solids with their own topology, faces of trimmed and bounded surfaces, surfaces with ends.
//! Faces without topology have borders of their own: those that coincide within the resolution of the file are sewn (`sew`), and loops and
//! normals without a sense get one (`orient`, `sheets`). A damaged entity costs the faces that need it, which are told with entity, line and reason.

mod assembly;
mod boundary;
mod conic;
mod curve;
mod geometry;
mod kinds;
mod looks;
mod loose;
mod on_surface;
mod orient;
mod placement;
mod powers;
mod read;
mod ruled;
mod sew;
mod shape;
mod sheets;
mod surface;
#[cfg(test)]
mod tests;
mod topology;

pub(super) use read::read;
