//! OBJ: vertices and polygons as text.
//!
//! Parts of the text are read at the same time. Each gives its vertices and the places of its faces. The corners are
//! looked up when all vertices are there.

mod continued;

use crate::{
    AtomicFile, SourceMesh,
    assemble::{self, Faces},
    error::{Fault, Result, WriteFault},
    format::{Format, Head, Holds, Parsed, ReadOptions, Weld, corners::corner_positions, loss::Loss},
    lines::{count_lines, is_text, line_end, parts, without_end_mark, without_mark},
    number::{integer, number, push_number},
    source::{SNIFFED_BYTES, Source},
    unicode::no_zeros,
};
use std::io::Write;
use trueness_geom::parallel::prelude::*;
use trueness_geom::{mesh::Mesh, space::Point};

/// Wavefront OBJ.
pub(crate) const OBJ: Format = Format {
    name: "obj",
    known_as: &["OBJ"],
    extensions: &["obj"],
    written_as: &["obj"],
    manual: include_str!("obj.md"),
    holds: &[Holds::Mesh, Holds::Points],
    columns: false,
    sniff,
    read: Some(read),
    model: None,
    points: None,
    mesh: Some(write),
};

/// One task reads about this many bytes.
const OBJ_BYTES_PER_TASK: usize = 1 << 20;

fn sniff(head: &Head) -> bool {
    let bytes = without_end_mark(head.bytes);
    if !is_text(bytes) {
        return false;
    }
    let word = |l: &[u8]| -> Vec<u8> {
        let ends = |b: &u8| b.is_ascii_whitespace() || *b == b'\\';
        l.split(ends).next().unwrap_or_default().to_vec()
    };
    let known = |l: &[u8]| {
        matches!(
            &word(l)[..],
            b"v" | b"vn" | b"vt" | b"f" | b"o" | b"g" | b"s" | b"mtllib" | b"usemtl" | b"l" | b"p" | b"vp"
        )
    };
    let lines = without_mark(bytes).split(|b| matches!(b, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    let mut said = lines.filter(|l| !l.is_empty() && !l.starts_with(b"#")).take(1000).peekable();
    said.peek().is_some_and(|l| known(l)) && said.any(|l| word(l) == b"v")
}

/// The text after `v` in a line that gives a vertex.
fn vertex(line: &[u8]) -> Option<&[u8]> {
    line.strip_prefix(b"v").filter(|l| l.first().is_some_and(u8::is_ascii_whitespace))
}

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    no_zeros(source.feed.ahead(SNIFFED_BYTES)?)?;
    let text = without_mark(source.feed.all()?);
    no_zeros(text)?;
    let end = line_end(text);
    let text = continued::joined(without_end_mark(text), end);
    let parts = parts(&text, OBJ_BYTES_PER_TASK, end);
    let read: Vec<_> = parts.par_iter().map(|p| TextPart::read(p, end)).collect();
    let starts = lines_before(&parts, end);
    let mut positions = Vec::new();
    let mut lists = Vec::new();
    for (part, start) in read.into_iter().zip(&starts) {
        let part = part.map_err(|(line, fault)| fault.at_line(start + line))?;
        lists.push((positions.len(), part.faces));
        if positions.is_empty() { positions = part.positions } else { positions.extend(part.positions) }
    }
    assemble::numbered("vertices", positions.len() as u64)?;
    let mut faces = Faces::default();
    let mut corners = vec![];
    for ((before, list), start) in lists.into_iter().zip(starts) {
        for face in list {
            corners.clear();
            face.corners(before, positions.len(), &mut corners).map_err(|f| f.at_line(start + face.line))?;
            faces.push(&positions, &corners);
        }
    }
    if faces.is_empty() {
        return Ok(Parsed::cloud("obj", positions));
    }
    let mut warnings = vec![];
    let mesh = faces.mesh(positions, options.weld != Weld::None, &mut warnings)?;
    Ok(Parsed::mesh("obj", SourceMesh { mesh, ..SourceMesh::default() }, warnings))
}

fn lines_before(parts: &[&[u8]], end: u8) -> Vec<u64> {
    let mut lines = 0;
    let mut before = |p: &&[u8]| {
        let this = lines;
        lines += count_lines(p, end);
        this
    };
    parts.iter().map(&mut before).collect()
}

/// The content of a part of the text.
#[derive(Default)]
struct TextPart<'a> {
    positions: Vec<Point>,
    faces: Vec<Face<'a>>,
}

/// A face whose corners are still text.
struct Face<'a> {
    text: &'a [u8],
    /// Its line in the part, from 1.
    line: u64,
    /// Vertices of the part before it.
    vertices: usize,
}

impl<'a> TextPart<'a> {
    fn read(text: &'a [u8], end: u8) -> std::result::Result<TextPart<'a>, (u64, Fault)> {
        let mut part = TextPart::default();
        for (i, line) in text.split(|b| *b == end).enumerate() {
            let line = line.trim_ascii_start();
            let number = i as u64 + 1;
            if let Some(rest) = vertex(line) {
                part.positions.push(position(rest).map_err(|fault| (number, fault))?);
            } else if let Some(text) =
                line.strip_prefix(b"f").filter(|l| l.first().is_some_and(u8::is_ascii_whitespace))
            {
                part.faces.push(Face { text, line: number, vertices: part.positions.len() });
            }
        }
        Ok(part)
    }
}

/// The first three numbers of a line.
fn position(mut text: &[u8]) -> std::result::Result<Point, Fault> {
    let mut point = [0.0; 3];
    for x in &mut point {
        text = text.trim_ascii_start();
        match number(text, b'.') {
            Some((value, length)) if text.get(length).is_none_or(u8::is_ascii_whitespace) => {
                if !value.is_finite() {
                    return Err(Fault::unexpected("a finite number", &text[..length]));
                }
                *x = value;
                text = &text[length..];
            }
            _ => {
                let word = text.split(u8::is_ascii_whitespace).next().unwrap_or_default();
                return Err(Fault::unexpected("three numbers with decimal points", word));
            }
        }
    }
    Ok(point)
}

impl Face<'_> {
    /// Numbers of the corners, from 0; `before` vertices came before this part, and there are `count`.
    fn corners(&self, before: usize, count: usize, out: &mut Vec<u32>) -> std::result::Result<(), Fault> {
        for word in self.text.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty()) {
            if word.starts_with(b"#") {
                break;
            }
            let vertex = word.split(|b| *b == b'/').next().unwrap_or_default();
            let index = integer(vertex).ok_or_else(|| Fault::unexpected("the number of a vertex", word))?;
            let from = if index < 0 { (before + self.vertices) as i64 } else { -1 };
            match u32::try_from(index.saturating_add(from)) {
                Ok(v) if (v as usize) < count => out.push(v),
                _ => return Err(Fault::NoSuchVertex { index, count: count as u64 }),
            }
        }
        Ok(())
    }
}

/// This many lines become text at a time.
const OBJ_LINES_PER_WRITE: usize = 1 << 13;

fn write(file: &mut AtomicFile, mesh: &Mesh) -> std::result::Result<Loss, WriteFault> {
    file.write_all(b"# millimetres\n")?;
    let mut text = Vec::new();
    for positions in mesh.positions.chunks(OBJ_LINES_PER_WRITE) {
        text.clear();
        for p in positions {
            text.push(b'v');
            for x in p {
                text.push(b' ');
                push_number(&mut text, *x);
            }
            text.push(b'\n');
        }
        file.write_all(&text)?;
    }
    for (i, faces) in mesh.faces.chunks(OBJ_LINES_PER_WRITE).enumerate() {
        text.clear();
        for (j, face) in faces.iter().enumerate() {
            corner_positions(mesh, i * OBJ_LINES_PER_WRITE + j, face)?;
            let [a, b, c] = face.map(|v| u64::from(v) + 1);
            writeln!(text, "f {a} {b} {c}")?;
        }
        file.write_all(&text)?;
    }
    Ok(Loss::default())
}
