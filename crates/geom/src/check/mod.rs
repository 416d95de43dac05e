//! Everything that is wrong with a mesh, found exactly and with its place.

pub mod intersect;
