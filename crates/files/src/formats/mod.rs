//! One file or folder per format; the list of them is in `format.rs`.

pub(crate) mod dxf;
pub(crate) mod iges;
pub(crate) mod npy;
pub(crate) mod npz;
pub(crate) mod obj;
pub(crate) mod off;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;
pub(crate) mod ply;
pub(crate) mod step;
pub(crate) mod stl;
pub(crate) mod strided;
pub(crate) mod svg;
pub(crate) mod table;
pub(crate) mod vtp;
