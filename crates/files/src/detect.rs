//! Which format a file is of: content first, extension second.

use crate::{
    error::{Fault, Result},
    format::{Format, Head, Holds},
    formats::{FORMATS, table},
    lines::without_mark,
    source::{SNIFFED_BYTES, Source},
};
use std::path::Path;

/// The format of opened bytes.
pub(crate) fn format(source: &mut Source, path: &Path) -> Result<&'static Format> {
    let length = source.feed.left();
    let bytes = source.feed.ahead(SNIFFED_BYTES)?;
    let bytes = &bytes[..bytes.len().min(SNIFFED_BYTES)];
    let head = Head { bytes, length };
    if let Some(format) = FORMATS.iter().copied().find(|f| f.reads() && (f.sniff)(&head)) {
        return Ok(format);
    }
    if let Some(name) = foreign(bytes) {
        let what = format!("this is {name}, which is not read here");
        return Err(Fault::Foreign { what, remedy: format!("export it as {}", readable()) }.into());
    }
    if let Some((extension, name)) = foreign_extension(path) {
        let what = format!("the name ends in .{extension}: that is {name}, which is not read here");
        let remedy = format!("export it as {}; if it is one of these, name it by --format", readable());
        return Err(Fault::Foreign { what, remedy }.into());
    }
    if let Some(format) = by_extension(path).filter(|f| f.reads()) {
        return Ok(format);
    }
    if table::looks_like_rows(bytes) {
        return Ok(&table::TABLE);
    }
    let remedy = format!("give {}, or name the format by --format", readable());
    Err(Fault::Foreign { what: "this is of no known format".into(), remedy }.into())
}

/// All that is read of parts.
fn readable() -> String {
    let [mesh, points, model] = [Holds::Mesh, Holds::Points, Holds::Model].map(Holds::formats);
    format!("{mesh} (mesh), {points} (points) or {model} (CAD model)")
}

/// The format by a path's extension, that before `.gz` where there are two.
pub(crate) fn by_extension(path: &Path) -> Option<&'static Format> {
    Format::by_extension(extension(path)?)
}

/// The extension of a path, that before `.gz` where there are two.
fn extension(path: &Path) -> Option<&str> {
    let packed = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gz"));
    let inner = if packed { Path::new(path.file_stem()?) } else { path };
    inner.extension()?.to_str()
}

/// A well-known kind of file that is not read, by its ending. Some of them are text and would pass for a table.
fn foreign_extension(path: &Path) -> Option<(&'static str, &'static str)> {
    const FOREIGN_EXTENSIONS: &[(&str, &str)] = &[
        ("fls", "a FARO scan"),
        ("zfs", "a Zoller + Fröhlich scan"),
        ("3mf", "a 3MF model"),
        ("amf", "an AMF model"),
        ("glb", "a glTF model"),
        ("gltf", "a glTF model"),
        ("x3d", "an X3D model"),
        ("wrl", "a VRML model"),
        ("dae", "a COLLADA model"),
        ("fbx", "an FBX model"),
        ("3ds", "a 3D Studio model"),
        ("blend", "a Blender file"),
        ("vtk", "a VTK file"),
        ("vtu", "a VTK file"),
        ("jt", "a JT model"),
        ("sldprt", "a SolidWorks part"),
        ("sldasm", "a SolidWorks assembly"),
        ("catpart", "a CATIA part"),
        ("catproduct", "a CATIA assembly"),
        ("ipt", "an Inventor part"),
        ("x_t", "a Parasolid model"),
        ("x_b", "a Parasolid model"),
        ("sat", "an ACIS model"),
        ("sab", "an ACIS model"),
        ("3dm", "a Rhino model"),
        ("dwg", "an AutoCAD drawing"),
        ("f3d", "a Fusion model"),
        ("fcstd", "a FreeCAD document"),
        ("prt", "a CAD part"),
    ];
    let given = extension(path)?;
    FOREIGN_EXTENSIONS.iter().copied().find(|(e, _)| e.eq_ignore_ascii_case(given))
}

/// The kind of a document of XML or JSON that is not read, by a word in it.
fn foreign_document(bytes: &[u8]) -> Option<&'static str> {
    const FOREIGN_DOCUMENTS: &[(&[u8], &str)] = &[
        (b"<X3D", "an X3D model"),
        (b"<COLLADA", "a COLLADA model"),
        (b"<amf", "an AMF model"),
        (b"<VTKFile", "a VTK file"),
    ];
    let text = without_mark(bytes).trim_ascii_start();
    if text.starts_with(b"{") {
        let holds = |word: &[u8]| memchr::memmem::find(bytes, word).is_some();
        return (holds(b"\"asset\"") && holds(b"\"version\"")).then_some("a glTF model");
    }
    if !text.starts_with(b"<") {
        return None;
    }
    FOREIGN_DOCUMENTS
        .iter()
        .find(|(word, _)| memchr::memmem::find(bytes, word).is_some())
        .map(|(_, name)| *name)
}

/// A well-known kind of file that is not read, by its first bytes, so that the message can name it.
fn foreign(bytes: &[u8]) -> Option<&'static str> {
    const FOREIGN_MAGICS: &[(&[u8], &str)] = &[
        (b"PK\x03\x04", "a ZIP archive (3MF, a spreadsheet or another packed folder)"),
        (b"#VRML", "a VRML model"),
        (b"Kaydara FBX", "an FBX model"),
        (b"**ABCDEFGHIJKLMNOPQRSTUVWXYZ", "a Parasolid model"),
        (b"3D Geometry File Format", "a Rhino model"),
        (b"BLENDER", "a Blender file"),
        (b"\xd0\xcf\x11\xe0", "a document of a CAD or office program"),
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
    let magic = || FOREIGN_MAGICS.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, name)| *name);
    foreign_document(bytes).or_else(magic)
}
