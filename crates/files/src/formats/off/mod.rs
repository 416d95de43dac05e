//! OFF: vertices and polygons as text, counted beforehand.

mod body;

use crate::{
    AtomicFile, SourceMesh, Warning, assemble,
    error::{Fault, Result, WriteFault},
    flow::Flow,
    format::{Format, Head, Holds, Parsed, ReadOptions, Weld, corners::corner_positions, loss::Loss},
    lines::{without_filling, without_mark},
    number::{count, push_number},
    source::{SNIFFED_BYTES, Source},
    unicode::no_zeros,
};
use body::Counts;
use std::io::Write;
use trueness_geom::mesh::Mesh;

/// Geomview OFF.
pub(crate) const OFF: Format = Format {
    name: "off",
    known_as: &["OFF"],
    extensions: &["off"],
    written_as: &["off"],
    manual: include_str!("off.md"),
    holds: &[Holds::Mesh, Holds::Points],
    columns: false,
    sniff: |head: &Head| {
        let text = without_mark(head.bytes).trim_ascii_start();
        keyword(text)
            .is_some_and(|(_, n)| text.get(n).is_none_or(|b| b.is_ascii_whitespace() || b.is_ascii_digit()))
    },
    read: Some(read),
    model: None,
    points: None,
    mesh: Some(write),
};

/// The word at the start of a header, and its length.
fn keyword(text: &[u8]) -> Option<(&[u8], usize)> {
    let at = memchr::memmem::find(&text[..text.len().min(8)], b"OFF")?;
    let prefix = &text[..at];
    prefix.iter().all(|b| matches!(b, b'S' | b'T' | b'C' | b'N' | b'4' | b'n')).then_some((prefix, at + 3))
}

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    no_zeros(without_filling(source.feed.ahead(SNIFFED_BYTES)?).0)?;
    // Zeros and blanks that fill the file up are no part of it.
    let text = without_filling(source.feed.all()?).0;
    no_zeros(text)?;
    let text = without_mark(text);
    let mut words = Flow::new(text, true);
    let counts = counts(&mut words).map_err(|fault| fault.at_line(words.line()))?;
    let (room, left) = (words.rest().len() as u64, words.line());
    // A vertex takes six bytes at least, a face four.
    if counts.vertices.saturating_mul(6).saturating_add(counts.faces.saturating_mul(4)) > room + 2 {
        let declared = counts.vertices.saturating_add(counts.faces);
        return Err(Fault::Short { what: "vertices and faces", declared, present: room / 4 }.at_line(left));
    }
    assemble::numbered("vertices", counts.vertices)?;
    let body::Body { positions, faces, rest, uneven } = body::read(text, words, &counts)?;
    let mut warnings = vec![];
    if rest > 0 {
        warnings.push(Warning::TrailingBytes { count: rest });
    }
    warnings.extend(uneven.map(|line| Warning::UnevenRow { line }));
    if faces.is_empty() {
        let mut parsed = Parsed::cloud("off", positions);
        parsed.warnings.extend(warnings);
        return Ok(parsed);
    }
    let mesh = faces.mesh(positions, options.weld != Weld::None, &mut warnings)?;
    Ok(Parsed::mesh("off", SourceMesh { mesh, ..SourceMesh::default() }, warnings))
}

/// The numbers of vertices and faces. The keyword may be left out, and the number of edges is passed over.
fn counts(words: &mut Flow) -> std::result::Result<Counts, Fault> {
    let expected = "the numbers of vertices, faces and edges";
    let ahead = words.clone();
    let first = words.next();
    let first = first
        .ok_or_else(|| Fault::unexpected("\"OFF\" and the numbers of vertices, faces and edges", b""))?;
    let mut widths = vec![3];
    match keyword(first) {
        Some((prefix, length)) => {
            let binary = words.clone().next().is_some_and(|w| w == b"BINARY");
            if binary || prefix.iter().any(|b| matches!(b, b'4' | b'n')) {
                let what = "OFF in binary or of other than three dimensions cannot be read".into();
                return Err(Fault::Unsupported { what, remedy: "export it as OFF in text" });
            }
            // A count may stand right behind the keyword.
            words.at -= first.len() - length;
            let normals = if prefix.contains(&b'N') { 3 } else { 0 };
            let texture = if prefix.contains(&b'S') { 2 } else { 0 };
            let colors: &[usize] = if prefix.contains(&b'C') { &[4, 3] } else { &[0] };
            widths = colors.iter().map(|c| 3 + normals + texture + c).collect();
        }
        None => *words = ahead,
    }
    let mut next = || {
        let word = words.next().unwrap_or_default();
        count(word).ok_or_else(|| Fault::unexpected(expected, word))
    };
    let (vertices, faces) = (next()?, next()?);
    // The edges are counted too, but not by all programs.
    let mut ahead = words.clone();
    let edges = ahead.next_on_line().is_some_and(|w| count(w).is_some());
    if edges {
        *words = ahead;
    }
    Ok(Counts { vertices, faces, edges, widths })
}

/// This many lines become text at a time.
const OFF_LINES_PER_WRITE: usize = 1 << 13;

fn write(file: &mut AtomicFile, mesh: &Mesh) -> std::result::Result<Loss, WriteFault> {
    writeln!(file, "OFF\n# millimetres\n{} {} 0", mesh.positions.len(), mesh.faces.len())?;
    let mut text = Vec::new();
    for positions in mesh.positions.chunks(OFF_LINES_PER_WRITE) {
        text.clear();
        for [x, y, z] in positions {
            for (x, after) in [(x, b' '), (y, b' '), (z, b'\n')] {
                push_number(&mut text, *x);
                text.push(after);
            }
        }
        file.write_all(&text)?;
    }
    for (i, faces) in mesh.faces.chunks(OFF_LINES_PER_WRITE).enumerate() {
        text.clear();
        for (j, face) in faces.iter().enumerate() {
            corner_positions(mesh, i * OFF_LINES_PER_WRITE + j, face)?;
            let [a, b, c] = face;
            writeln!(text, "3 {a} {b} {c}")?;
        }
        file.write_all(&text)?;
    }
    Ok(Loss::default())
}
