//! The list of formats: a format is one file or folder here and one line in [`FORMATS`]. Its manual is its page in the
//! handbook.

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

use crate::format::Format;

/// All formats. Those that show themselves plainly come first.
pub static FORMATS: &[&Format] = &[
    &ply::PLY,
    &npy::NPY,
    &off::OFF,
    &stl::STL,
    &obj::OBJ,
    &table::TABLE,
    &npz::NPZ,
    &vtp::VTP,
    #[cfg(feature = "parquet")]
    &parquet::PARQUET,
];

impl Format {
    /// The format of this name or extension (upper or lower case).
    pub fn named(name: &str) -> Option<&'static Format> {
        let is = |s: &&str| s.eq_ignore_ascii_case(name);
        let by_name = FORMATS.iter().copied().find(|f| is(&f.name));
        by_name.or_else(|| Format::by_extension(name))
    }
    /// The format whose files end in `extension`, given without dot, upper or lower case.
    pub fn by_extension(extension: &str) -> Option<&'static Format> {
        FORMATS.iter().copied().find(|f| f.extensions.iter().any(|e| e.eq_ignore_ascii_case(extension)))
    }
}
