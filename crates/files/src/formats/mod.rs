//! One file or folder per format; the list of them is in `format.rs`.

pub(crate) mod obj;
pub(crate) mod off;
pub(crate) mod ply;
pub(crate) mod stl;
pub(crate) mod table;
