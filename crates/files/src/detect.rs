//! Which format a file is of: content first, extension second.

use crate::{
    error::{Fault, Result},
    format::{Format, Head},
    formats::{FORMATS, table},
    source::{HEAD, Source},
};
use std::path::Path;

/// The format of opened bytes.
pub(crate) fn format(source: &mut Source, path: &Path) -> Result<&'static Format> {
    let length = source.feed.left();
    let bytes = source.feed.ahead(HEAD)?;
    let bytes = &bytes[..bytes.len().min(HEAD)];
    let head = Head { bytes, length };
    if let Some(format) = FORMATS.iter().copied().find(|f| f.reads() && (f.sniff)(&head)) {
        return Ok(format);
    }
    if let Some(name) = foreign(bytes) {
        return Err(Fault::Foreign(name).into());
    }
    if let Some(format) = by_extension(path).filter(|f| f.reads()) {
        return Ok(format);
    }
    if table::looks_like_rows(bytes) { Ok(&table::TABLE) } else { Err(Fault::Unknown.into()) }
}

/// The format by a path's extension, that before `.gz` where there are two.
pub(crate) fn by_extension(path: &Path) -> Option<&'static Format> {
    let packed = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gz"));
    let inner = if packed { Path::new(path.file_stem()?) } else { path };
    Format::by_extension(inner.extension()?.to_str()?)
}

/// Well-known kinds of files that are not read, by their first bytes, so that the message can name them.
fn foreign(bytes: &[u8]) -> Option<&'static str> {
    const KNOWN: &[(&[u8], &str)] = &[
        (b"PK\x03\x04", "a ZIP archive (3MF, a spreadsheet or another packed folder)"),
        (b"ASTM-E57", "an E57 point cloud"),
        (b"LASF", "a LAS or LAZ point cloud"),
        (b"# .PCD", "a PCD point cloud"),
        (b"VERSION .7", "a PCD point cloud"),
        (b"glTF", "a glTF model"),
        (b"# vtk", "a VTK file"),
        (b"<?xml", "an XML document"),
        (b"<VTKFile", "a VTK file"),
        (b"PAR1", "a Parquet table"),
        (b"%PDF", "a PDF document"),
        (b"\x89PNG", "a picture"),
        (b"\xff\xd8\xff", "a picture"),
        (b"\x7fELF", "a program"),
        (b"\x28\xb5\x2f\xfd", "a file packed by zstd"),
        (b"BZh", "a file packed by bzip2"),
        (b"\xfd7zXZ", "a file packed by xz"),
        (b"7z\xbc\xaf", "a 7-Zip archive"),
        (b"Rar!", "a RAR archive"),
        (b"version https://git-lfs", "a pointer to a file kept by Git LFS"),
        (b"\x89HDF", "an HDF5 file"),
        (b"<!DOCTYPE", "a web page"),
        (b"<html", "a web page"),
    ];
    KNOWN.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, name)| *name)
}
