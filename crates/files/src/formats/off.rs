//! OFF: vertices and polygons as text, counted beforehand.

use crate::{
    AtomicFile, SourceMesh, Warning,
    assemble::{self, Faces},
    error::{Fault, Result, WriteFault},
    format::{Format, Head, Parsed, ReadOptions, Weld},
    lines::{Lines, without_mark, words},
    number::{count, push_number, whole_number},
    source::{HEAD, Source},
    unicode::no_zeros,
    write::{Loss, corners::corner_positions},
};
use std::io::Write;
use trueness_geom::{mesh::Mesh, space::Point};

/// Geomview OFF.
pub(crate) const OFF: Format = Format {
    name: "off",
    extensions: &["off"],
    written_as: &["off"],
    manual: include_str!("off.md"),
    columns: false,
    sniff: |head: &Head| {
        let text = without_mark(head.bytes).trim_ascii_start();
        keyword(text)
            .is_some_and(|(_, n)| text.get(n).is_none_or(|b| b.is_ascii_whitespace() || b.is_ascii_digit()))
    },
    read: Some(read),
    points: None,
    mesh: Some(write),
};

/// The word at the start of a header, and its length.
fn keyword(text: &[u8]) -> Option<(&[u8], usize)> {
    let at = memchr::memmem::find(&text[..text.len().min(8)], b"OFF")?;
    let prefix = &text[..at];
    prefix.iter().all(|b| matches!(b, b'S' | b'T' | b'C' | b'N' | b'4' | b'n')).then_some((prefix, at + 3))
}

/// Lines that say something, without comments.
struct Said<'a>(Lines<'a>);

impl<'a> Iterator for Said<'a> {
    type Item = &'a [u8];
    fn next(&mut self) -> Option<&'a [u8]> {
        self.0
            .by_ref()
            .map(|l| l[..memchr::memchr(b'#', l).unwrap_or(l.len())].trim_ascii())
            .find(|l| !l.is_empty())
    }
}

impl Said<'_> {
    fn line(&self) -> u64 {
        self.0.number
    }
}

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    no_zeros(source.feed.ahead(HEAD)?)?;
    let text = source.feed.all()?;
    no_zeros(text)?;
    let mut lines = Said(Lines::new(text));
    let (vertices, count) = counts(&mut lines)?;
    // A vertex takes six bytes at least, a face four.
    let (room, left) = (lines.0.rest().len() as u64, lines.line());
    if vertices.saturating_mul(6).saturating_add(count.saturating_mul(4)) > room + 2 {
        let declared = vertices.saturating_add(count);
        return Err(Fault::Short { what: "vertices and faces", declared, present: room / 4 }.at_line(left));
    }
    assemble::numbered("vertices", vertices)?;
    let positions = positions(&mut lines, vertices)?;
    let mut faces = Faces::default();
    let mut corners = vec![];
    for row in 0..count {
        let short = Fault::Short { what: "faces", declared: count, present: row };
        let Some(line) = lines.next() else { return Err(short.at_line(lines.line())) };
        face(line, vertices, &mut corners).map_err(|f| f.at_line(lines.line()))?;
        faces.push(&positions, &corners);
    }
    let mut warnings = vec![];
    let rest = lines.0.rest().len() as u64;
    if lines.next().is_some() {
        warnings.push(Warning::TrailingBytes { count: rest });
    }
    if faces.is_empty() {
        let mut parsed = Parsed::cloud("off", positions);
        parsed.warnings.extend(warnings);
        return Ok(parsed);
    }
    let mesh = faces.mesh(positions, options.weld != Weld::None, &mut warnings)?;
    Ok(Parsed::mesh("off", SourceMesh { mesh, ..SourceMesh::default() }, warnings))
}

/// The numbers of vertices and faces, from the line of the keyword or the next. The keyword may be left out.
fn counts(lines: &mut Said) -> Result<(u64, u64)> {
    let nothing = || Fault::unexpected("\"OFF\" and the numbers of vertices, faces and edges", b"");
    let first = lines.next().ok_or_else(nothing)?;
    let mut line = first;
    if let Some((prefix, length)) = keyword(first) {
        line = first[length..].trim_ascii();
        if line.starts_with(b"BINARY") || prefix.iter().any(|b| matches!(b, b'4' | b'n')) {
            let what = "OFF in binary or of other than three dimensions cannot be read".into();
            return Err(Fault::Unsupported { what, remedy: "export it as OFF in text" }.at_line(lines.line()));
        }
        if line.is_empty() {
            line = lines.next().ok_or_else(nothing)?;
        }
    }
    let mut numbers = words(line).map(count);
    match (numbers.next(), numbers.next()) {
        (Some(Some(vertices)), Some(Some(faces))) => Ok((vertices, faces)),
        _ => Err(Fault::unexpected("the numbers of vertices, faces and edges", line).at_line(lines.line())),
    }
}

fn positions(lines: &mut Said, count: u64) -> Result<Vec<Point>> {
    let mut positions = Vec::with_capacity(count as usize);
    for row in 0..count {
        let short = Fault::Short { what: "vertices", declared: count, present: row };
        let Some(line) = lines.next() else { return Err(short.at_line(lines.line())) };
        let mut numbers = words(line).map(|w| whole_number(w, b'.'));
        let mut next = || numbers.next().flatten();
        let (Some(x), Some(y), Some(z)) = (next(), next(), next()) else {
            return Err(Fault::unexpected("three numbers with decimal points", line).at_line(lines.line()));
        };
        if !(x.is_finite() && y.is_finite() && z.is_finite()) {
            return Err(Fault::NotFinite { what: "vertex", number: row + 1 }.at_line(lines.line()));
        }
        positions.push([x, y, z]);
    }
    Ok(positions)
}

fn face(line: &[u8], vertices: u64, corners: &mut Vec<u32>) -> std::result::Result<(), Fault> {
    corners.clear();
    let expected = "the number of corners and as many numbers of vertices";
    let mut words = words(line);
    let size = words.next().and_then(count).ok_or_else(|| Fault::unexpected(expected, line))?;
    for _ in 0..size {
        let v = words.next().and_then(count).ok_or_else(|| Fault::unexpected(expected, line))?;
        if v >= vertices {
            return Err(Fault::NoSuchVertex { index: i64::try_from(v).unwrap_or(i64::MAX), count: vertices });
        }
        corners.push(v as u32);
    }
    Ok(())
}

/// Lines made into text at a time.
const CHUNK: usize = 1 << 13;

fn write(file: &mut AtomicFile, mesh: &Mesh) -> std::result::Result<Loss, WriteFault> {
    writeln!(file, "OFF\n# millimetres\n{} {} 0", mesh.positions.len(), mesh.faces.len())?;
    let mut text = Vec::new();
    for positions in mesh.positions.chunks(CHUNK) {
        text.clear();
        for [x, y, z] in positions {
            for (x, after) in [(x, b' '), (y, b' '), (z, b'\n')] {
                push_number(&mut text, *x);
                text.push(after);
            }
        }
        file.write_all(&text)?;
    }
    for (i, faces) in mesh.faces.chunks(CHUNK).enumerate() {
        text.clear();
        for (j, face) in faces.iter().enumerate() {
            corner_positions(mesh, i * CHUNK + j, face)?;
            let [a, b, c] = face;
            writeln!(text, "3 {a} {b} {c}")?;
        }
        file.write_all(&text)?;
    }
    Ok(Loss::default())
}
