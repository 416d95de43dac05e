//! Readers and writers of meshes and point clouds: bytes to data and back, millimeters throughout.
//!
//! | task | where |
//! |---|---|
//! | read a file of any kind | [`open`], with [`ReadOptions`] |
//! | read the normals of its points | [`open_normals`] |
//! | read files, memory or uploads by one function | [`open_from`], [`open_normals_from`] of [`Sources`] |
//! | read a small text | [`Sources::text`] |
//! | the content of a file | [`Input`], [`Body`], [`SourceMesh`], [`Provenance`], [`TableReading`], [`Warning`] |
//! | which formats there are, and their manual pages | [`FORMATS`], [`Format`] |
//! | write points, with or without deviations | [`write::points`] |
//! | write a mesh | [`write::mesh`] |
//! | write a table of text, an XML document | [`write::Csv`], [`write::Xml`] |
//! | models of CAD files | [`cad::read`] |
//! | B-spline surfaces and curves for CAD programs, and from them | [`cad`] |
//! | a file that appears whole or not at all | [`AtomicFile`] |
//! | unfinished files when the program ends early | [`remove_unfinished`], [`remove_leftovers`] |
//! | the hash of a file | [`sha256`], [`Sources::sha256`] |
//!
//! Readers take their input for hostile. A count in a header is compared with the bytes that are there before
//! memory is asked for. No input makes readers panic.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test does not hang on the last digit"))]

mod assemble;
mod atomic_file;
pub mod cad;
mod columns;
mod content;
mod csv;
mod detect;
pub mod drawing;
mod error;
mod feed;
mod flow;
mod format;
mod formats;
mod gzip;
mod lines;
mod number;
mod open;
mod polygon;
mod records;
mod scalar;
mod scan_warning;
mod source;
mod temporary;
mod unicode;
mod unit;
mod warning;
pub mod write;
mod xml;

pub use atomic_file::AtomicFile;
pub use columns::{Column, Columns, ColumnsError};
pub use content::{
    Body, ColumnTaken, FacetRegions, Input, PointSource, Provenance, SourceMesh, TableReading, UnitFrom,
};
pub use error::{Fault, Place, ReadError, WriteError, WriteFault};
pub use format::{Format, Holds, ReadOptions, Weld};
pub use formats::FORMATS;
pub use open::{open, open_from, open_normals, open_normals_from};
pub use scan_warning::ScanWarning;
pub use source::{FileSources, MemorySources, SourceBytes, Sources, sha256};
pub use temporary::{Leftovers, remove_leftovers, remove_unfinished};
pub use unit::{Unit, UnitError};
pub use warning::{Unread, Warning};
