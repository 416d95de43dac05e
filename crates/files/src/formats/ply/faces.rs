//! Faces and triangle strips, in text or in bytes.

use super::{
    header::{Element, Encoding, PropertyType},
    text,
};
use crate::{
    assemble::Faces,
    error::{Fault, Result},
    feed::Feed,
    scalar::{Order, Scalar},
};
use rayon::prelude::*;
use trueness_geom::space::Point;

/// Names of the property that lists the vertices of a face.
pub(super) const INDEX_LIST_NAMES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Whether an element connects vertices.
pub(super) fn is_faces(element: &Element) -> bool {
    matches!(element.name.as_str(), "face" | "tristrips") && indices(element).is_some()
}

/// Which property is the list of vertices.
fn indices(element: &Element) -> Option<usize> {
    INDEX_LIST_NAMES.iter().find_map(|name| {
        let (i, property) = element.property(name)?;
        matches!(property.kind, PropertyType::List { .. }).then_some(i)
    })
}

/// Length of the row ahead; `None` if the file ends within it. Where `starts` has a place for each property, it receives
/// the offsets of the properties in the row.
pub(super) fn row_length(
    feed: &mut Feed,
    element: &Element,
    order: Order,
    starts: &mut [usize],
) -> Result<Option<usize>> {
    let mut length = 0usize;
    for (i, property) in element.properties.iter().enumerate() {
        if let Some(start) = starts.get_mut(i) {
            *start = length;
        }
        let (count, size) = match property.kind {
            PropertyType::One(s) => (1, s.size()),
            PropertyType::List { count, item } => {
                let bytes = feed.ahead(length + count.size())?;
                let Some(bytes) = bytes.get(length..).filter(|b| b.len() >= count.size()) else {
                    return Ok(None);
                };
                let n = count.get(bytes, order);
                if n < 0.0 {
                    return Err(Fault::unexpected("the length of a list", n.to_string().as_bytes())
                        .at_byte(feed.position()));
                }
                length += count.size();
                (n as usize, item.size())
            }
        };
        length = length.saturating_add(count.saturating_mul(size));
    }
    Ok((feed.ahead(length)?.len() >= length).then_some(length))
}

/// A stretch of a file: its bytes, the first of them, and how many lines come before.
pub(super) struct Stretch<'a> {
    pub bytes: &'a [u8],
    pub at: u64,
    pub lines: u64,
}

/// Reads the rows of `elements`. Gives what follows them, which should be nothing if `to_end`.
pub(super) fn read<'a>(
    stretch: Stretch<'a>,
    encoding: Encoding,
    elements: &[Element],
    to_end: bool,
    positions: &[Point],
    faces: &mut Faces,
) -> Result<&'a [u8]> {
    let Encoding::Binary(order) = encoding else {
        return in_text(stretch.bytes, stretch.lines, elements, to_end, positions, faces);
    };
    let mut bytes = Bytes { rest: stretch.bytes, at: stretch.at, order };
    for element in elements {
        if plain(&mut bytes, element, positions, faces) {
            continue;
        }
        let list = indices(element).filter(|_| is_faces(element));
        let mut corners = vec![];
        for row in 0..element.rows() {
            let at = bytes.at;
            if !bytes.row(element, list, &mut corners)? {
                return Err(Fault::Short { what: "faces", declared: element.count, present: row }.at_byte(at));
            }
            if list.is_some() {
                add_faces(element, &corners, positions, faces).map_err(|f| f.at_byte(at))?;
            }
        }
    }
    Ok(bytes.rest)
}

/// Takes the corners of a face, or those of many strips.
fn add_faces(
    element: &Element,
    corners: &[f64],
    positions: &[Point],
    faces: &mut Faces,
) -> std::result::Result<(), Fault> {
    let count = positions.len() as u64;
    let vertex = |v: &f64| {
        let inside = *v >= 0.0 && *v < count as f64 && v.fract() == 0.0;
        if inside { Ok(*v as u32) } else { Err(Fault::NoSuchVertex { index: *v as i64, count }) }
    };
    if element.name == "face" {
        let corners: Vec<u32> = corners.iter().map(vertex).collect::<std::result::Result<_, _>>()?;
        faces.push(positions, &corners);
        return Ok(());
    }
    // A strip turns with each triangle and ends at a negative number.
    for strip in corners.split(|v| *v < 0.0) {
        let strip: Vec<u32> = strip.iter().map(vertex).collect::<std::result::Result<_, _>>()?;
        for (i, w) in strip.windows(3).enumerate() {
            let [a, b, c] = if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] };
            if a != b && b != c && c != a {
                faces.push(positions, &[a, b, c]);
            }
        }
    }
    Ok(())
}

/// Bytes not yet read, and where they begin in the file.
struct Bytes<'a> {
    rest: &'a [u8],
    at: u64,
    order: Order,
}

impl<'a> Bytes<'a> {
    fn take_bytes(&mut self, length: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(length)?;
        self.rest = rest;
        self.at += length as u64;
        Some(taken)
    }

    /// Reads a row, its list `wanted` into `out`. False if the bytes end before.
    fn row(&mut self, element: &Element, wanted: Option<usize>, out: &mut Vec<f64>) -> Result<bool> {
        for (i, property) in element.properties.iter().enumerate() {
            let (count, item) = match property.kind {
                PropertyType::One(scalar) => (1.0, scalar),
                PropertyType::List { count, item } => {
                    let at = self.at;
                    let Some(bytes) = self.take_bytes(count.size()) else { return Ok(false) };
                    let n = count.get(bytes, self.order);
                    if n < 0.0 {
                        return Err(
                            Fault::unexpected("the length of a list", n.to_string().as_bytes()).at_byte(at)
                        );
                    }
                    (n, item)
                }
            };
            let Some(bytes) = self.take_bytes((count as usize).saturating_mul(item.size())) else {
                return Ok(false);
            };
            if wanted == Some(i) {
                out.clear();
                out.extend(bytes.chunks_exact(item.size()).map(|b| item.get(b, self.order)));
            }
        }
        Ok(true)
    }
}

/// Reads the common case: nothing but triangles of 32-bit numbers. False, with nothing read, in any other case.
fn plain(bytes: &mut Bytes, element: &Element, positions: &[Point], faces: &mut Faces) -> bool {
    const TRIANGLE_ROW_BYTES: usize = 13;
    let list = |k: &PropertyType| matches!(k, PropertyType::List { count: c, item: Scalar::I32 | Scalar::U32 } if c.size() == 1);
    let one = element.name == "face"
        && matches!(&element.properties[..], [p] if list(&p.kind) && is_faces(element));
    let Some(length) = usize::try_from(element.count).ok().and_then(|n| n.checked_mul(TRIANGLE_ROW_BYTES))
    else {
        return false;
    };
    let Some((rows, rest)) = bytes.rest.split_at_checked(length).filter(|_| one) else { return false };
    let rows = rows.as_chunks::<TRIANGLE_ROW_BYTES>().0;
    let big = bytes.order == Order::Big;
    let corner = |r: &[u8; TRIANGLE_ROW_BYTES], k: usize| {
        let b = [r[4 * k + 1], r[4 * k + 2], r[4 * k + 3], r[4 * k + 4]];
        if big { u32::from_be_bytes(b) } else { u32::from_le_bytes(b) }
    };
    let count = positions.len();
    let good = |r: &[u8; TRIANGLE_ROW_BYTES]| r[0] == 3 && (0..3).all(|k| (corner(r, k) as usize) < count);
    if !rows.par_iter().with_min_len(1 << 13).all(good) {
        return false;
    }
    let triangle = |r: &[u8; TRIANGLE_ROW_BYTES]| [corner(r, 0), corner(r, 1), corner(r, 2)];
    faces.triangles.par_extend(rows.par_iter().with_min_len(1 << 13).map(triangle));
    bytes.rest = rest;
    bytes.at += length as u64;
    true
}

/// Rows of text, behind which nothing should follow if `to_end`.
fn in_text<'a>(
    rest: &'a [u8],
    before: u64,
    elements: &[Element],
    to_end: bool,
    positions: &[Point],
    faces: &mut Faces,
) -> Result<&'a [u8]> {
    let wanted: text::WantedList = |element| indices(element).filter(|_| is_faces(element));
    let (mut of_lines, mut of_words) = (Faces::default(), Faces::default());
    let mut to_lines = |e: &Element, list: &[f64]| add_faces(e, list, positions, &mut of_lines);
    let lines = text::by_lines(rest, before, elements, wanted, &mut to_lines);
    if !lines.as_ref().is_ok_and(|passed| passed.is_exact(to_end)) {
        let mut to_words = |e: &Element, list: &[f64]| add_faces(e, list, positions, &mut of_words);
        match text::by_words(rest, before, elements, wanted, &mut to_words) {
            Ok(passed) if passed.is_exact(to_end) => {
                faces.append(of_words);
                return Ok(passed.rest);
            }
            // Where the first rows are no lines, the reading by words names the right place.
            Err(fault) if lines.is_err() && of_lines.triangles.len() < 2 => return Err(fault),
            _ => {}
        }
    }
    let rest = lines?.rest;
    faces.append(of_lines);
    Ok(rest)
}
