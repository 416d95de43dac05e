//! PLY: tables of any properties, in text or in bytes of either order.

mod faces;
mod flow;
mod header;
mod loose;
mod text;
mod write;

use super::{
    strided::{Rows, StridedPoints},
    table::{Layout, Limit, Separator, TextPoints},
};
use crate::{
    SourceMesh, Warning,
    assemble::{self, Faces},
    error::{Fault, Located, Result},
    feed::Feed,
    format::{Format, Head, Holds, Parsed, ReadOptions, Weld},
    lines::{count_lines, without_filling, without_mark},
    scalar::{Order, Scalar},
    source::Source,
};
use faces::Stretch;
use flow::FlowPoints;
use header::{Element, Encoding, Header, PropertyType};
use loose::LoosePoints;
use trueness_geom::{cloud::PointStream, space::Point};

/// PLY, ASCII and binary.
pub(crate) const PLY: Format = Format {
    name: "ply",
    known_as: &["PLY"],
    extensions: &["ply"],
    written_as: &["ply"],
    manual: include_str!("ply.md"),
    holds: &[Holds::Mesh, Holds::Points],
    columns: false,
    sniff: |head: &Head| header::is_magic(without_mark(head.bytes)),
    read: Some(read),
    model: None,
    points: Some(write::begin),
    mesh: Some(write::mesh),
};

/// A header is read up to this length.
const MAX_PLY_HEADER_BYTES: usize = 1 << 20;

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let marked = source.feed.ahead(MAX_PLY_HEADER_BYTES)?;
    let mark = marked.len() - without_mark(marked).len();
    source.feed.step(mark);
    let bytes = source.feed.ahead(MAX_PLY_HEADER_BYTES)?;
    if !bytes.get(..3).is_some_and(|word| word.eq_ignore_ascii_case(b"ply")) {
        return Err(Fault::unexpected("\"ply\"", &bytes[..bytes.len().min(16)]).at_line(1));
    }
    let header = header::parse(&bytes[..bytes.len().min(MAX_PLY_HEADER_BYTES)])?;
    source.feed.step(header.length);
    let variant = match header.encoding {
        Encoding::Ascii => "ply-ascii",
        Encoding::Binary(Order::Little) => "ply-binary-le",
        Encoding::Binary(Order::Big) => "ply-binary-be",
    };
    let (before, vertex, after) = split(&header)?;
    let mut lines = header.lines;
    let skipped = BeforeVertices {
        at: header.length as u64,
        lines,
        bytes: skip(&mut source.feed, &header, before, &mut lines)?,
    };
    let count = vertex.count;
    let mut points = Points::new(source.feed, &header, vertex, lines, options)?;
    let mut warnings: Vec<Warning> = header.unknown.clone().into_iter().collect();
    if !has_faces(before) && !has_faces(after) {
        warnings.extend((count == 0).then_some(Warning::Nothing));
        let whole = after.iter().all(|e| e.count == 0);
        return Ok(match points {
            points if whole => {
                Parsed { warnings, ..Parsed::points(variant, VerticesToEnd { points, count }) }
            }
            points => Parsed { warnings, ..Parsed::points(variant, points) },
        });
    }
    assemble::numbered("vertices", count)?;
    let positions = points.drain()?;
    let (mut feed, lines) = points.into_rest();
    let at = feed.position();
    let mut faces = Faces::default();
    let encoding = header.encoding;
    if has_faces(before) {
        let stretch = Stretch { bytes: &skipped.bytes, at: skipped.at, lines: skipped.lines };
        faces::read(stretch, encoding, before, false, &positions, &mut faces)?;
    }
    let stretch = Stretch { bytes: in_encoding(feed.all()?, encoding), at, lines };
    let rest = faces::read(stretch, encoding, after, true, &positions, &mut faces)?;
    if !rest.trim_ascii().is_empty() {
        warnings.push(Warning::TrailingBytes { count: rest.len() as u64 });
    }
    let mesh = faces.mesh(positions, options.weld != Weld::None, &mut warnings)?;
    Ok(Parsed::mesh(variant, SourceMesh { mesh, unread: unread(&header), ..SourceMesh::default() }, warnings))
}

/// Names of the properties of vertices and faces beside places and corners, each once.
fn unread(header: &Header) -> Vec<String> {
    let mut names: Vec<String> = vec![];
    for element in header.elements.iter().filter(|e| e.count > 0) {
        let known: &[&str] = match element.name.as_str() {
            "vertex" => &["x", "y", "z"],
            _ if faces::is_faces(element) => &faces::INDEX_LIST_NAMES,
            _ => continue,
        };
        for property in &element.properties {
            if !known.contains(&property.name.as_str()) && !names.contains(&property.name) {
                names.push(property.name.clone());
            }
        }
    }
    names
}

/// The content before the vertices: its bytes, and where they begin.
struct BeforeVertices {
    at: u64,
    lines: u64,
    bytes: Vec<u8>,
}

/// Whether there are faces in these elements.
fn has_faces(elements: &[Element]) -> bool {
    elements.iter().any(|e| e.count > 0 && faces::is_faces(e))
}

/// Text without the zeros and blanks that fill the file up; bytes as they are.
fn in_encoding(rest: &[u8], encoding: Encoding) -> &[u8] {
    match encoding {
        Encoding::Ascii => without_filling(rest).0,
        Encoding::Binary(_) => rest,
    }
}

/// The elements before the vertices, the vertices, and those after.
fn split(header: &Header) -> Result<(&[Element], &Element, &[Element])> {
    let elements = &header.elements;
    let at = elements.iter().position(|e| e.name == "vertex").ok_or_else(|| {
        Fault::Unexpected { expected: "an element \"vertex\" in the header".into(), found: "none".into() }
            .at_line(header.lines)
    })?;
    Ok((&elements[..at], &elements[at], &elements[at + 1..]))
}

/// Steps over the rows of elements before the vertices, and gives their bytes if there are faces among them.
fn skip(feed: &mut Feed, header: &Header, elements: &[Element], lines: &mut u64) -> Result<Vec<u8>> {
    let keeps = has_faces(elements);
    let mut kept = vec![];
    if elements.iter().all(|e| e.rows() == 0) {
        return Ok(kept);
    }
    let Encoding::Binary(order) = header.encoding else {
        let all = feed.all()?;
        let length = all.len() - text::skip_elements(all, *lines, elements)?.len();
        if keeps {
            kept.extend_from_slice(&all[..length]);
        }
        *lines += count_lines(&all[..length], header.end);
        feed.step(length);
        return Ok(kept);
    };
    for element in elements {
        for row in 0..element.rows() {
            let at = feed.position();
            let Some(length) = faces::row_length(feed, element, order, &mut [])? else {
                return Err(Fault::Short { what: "rows", declared: element.count, present: row }.at_byte(at));
            };
            if keeps {
                kept.extend_from_slice(&feed.ahead(length)?[..length]);
            }
            feed.step(length);
        }
    }
    Ok(kept)
}

/// Where x, y and z, under any of their names, stand among the properties of the vertices.
fn coordinates(vertex: &Element, header: &Header, names: [&str; 3]) -> Result<[usize; 3]> {
    let mut found = [0; 3];
    for (name, found) in names.into_iter().zip(&mut found) {
        match vertex.property(name) {
            Some((i, p)) if matches!(p.kind, PropertyType::One(_)) => *found = i,
            _ => {
                let names: Vec<&str> = vertex.properties.iter().map(|p| p.name.as_str()).collect();
                let found = if names.is_empty() { "no properties".into() } else { names.join(", ") };
                let expected = format!("a property \"{name}\" of the vertices").into();
                return Err(Fault::Unexpected { expected, found }.at_line(header.lines));
            }
        }
    }
    Ok(found)
}

/// The vertices as a stream. Only blanks may follow it: rows beyond the declared ones would be lost.
struct VerticesToEnd {
    points: Points,
    count: u64,
}

impl PointStream for VerticesToEnd {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        self.points.expected()
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        self.points.next_block(block)?;
        if block.is_empty() {
            let text = matches!(self.points, Points::Text(_) | Points::Flow(_));
            let feed = self.points.feed();
            let at = feed.position();
            let rest = feed.all()?;
            let filling = text && without_filling(rest).0.is_empty();
            if !filling && !rest.trim_ascii().is_empty() {
                return Err(beyond(rest, text, self.count).at_byte(at));
            }
        }
        Ok(())
    }
}

/// The fault of bytes after the vertices. In a text mostly the header counts too few vertices.
fn beyond(rest: &[u8], text: bool, declared: u64) -> Fault {
    let what = "vertices";
    let lines = text.then(|| std::str::from_utf8(rest).ok()).flatten().unwrap_or_default().lines();
    let rows: Vec<&str> = lines.filter(|line| !line.trim().is_empty()).collect();
    let number = |word: &str| word.parse::<f64>().is_ok();
    if !rows.is_empty() && rows.iter().all(|line| line.split_whitespace().all(number)) {
        return Fault::Surplus { what, declared, present: declared + rows.len() as u64 };
    }
    Fault::Trailing { count: rest.len() as u64, what, declared }
}

/// The vertices as a stream.
enum Points {
    Text(TextPoints),
    Flow(FlowPoints),
    Even(StridedPoints),
    Loose(LoosePoints),
}

impl Points {
    fn new(
        mut feed: Feed,
        header: &Header,
        vertex: &Element,
        lines: u64,
        options: &ReadOptions,
    ) -> Result<Points> {
        if vertex.count == 0 {
            let layout = Layout::of(Separator::Blanks, b'.', header.end, &[]);
            return Ok(Points::Text(TextPoints::new(feed, layout, lines, Limit::Exactly(0), 0)));
        }
        let names = if options.normals { ["nx", "ny", "nz"] } else { ["x", "y", "z"] };
        let xyz = coordinates(vertex, header, names)?;
        let Encoding::Binary(order) = header.encoding else {
            let head = feed.ahead(MAX_PLY_HEADER_BYTES)?;
            let whole = head.len() < MAX_PLY_HEADER_BYTES;
            if !flow::rows_are_lines(vertex, xyz, &head[..head.len().min(MAX_PLY_HEADER_BYTES)], whole) {
                let (vertex, block) = (vertex.clone(), options.block);
                return Ok(Points::Flow(FlowPoints::new(feed, vertex, xyz, header.end, lines, block)));
            }
            let layout = Layout::of(Separator::Blanks, b'.', header.end, &xyz);
            let window = options.block.saturating_mul(12 * vertex.properties.len());
            return Ok(Points::Text(TextPoints::new(
                feed,
                layout,
                lines,
                Limit::Exactly(vertex.count),
                window,
            )));
        };
        let size = |k: &PropertyType| if let PropertyType::One(s) = k { *s } else { Scalar::U8 };
        let place = |i: usize| {
            let before = vertex.properties[..i].iter().map(|p| size(&p.kind).size()).sum();
            (before, size(&vertex.properties[i].kind))
        };
        let [x, y, z] = xyz.map(place);
        let stride = vertex.least_stride();
        let rows =
            Rows { order, stride, x, y, z: Some(z), count: vertex.count, what: ("vertex", "vertices") };
        if vertex.stride().is_some() {
            return Ok(Points::Even(StridedPoints::new(feed, rows, options.block)?));
        }
        Ok(Points::Loose(LoosePoints::new(feed, vertex.clone(), rows, xyz, options.block)))
    }

    /// All points that are left. Memory grows with the bytes that are there, not with the declared count.
    fn drain(&mut self) -> Result<Vec<Point>> {
        let (mut all, mut block) = (vec![], vec![]);
        loop {
            self.next_block(&mut block)?;
            if block.is_empty() {
                return Ok(all);
            }
            if all.is_empty() { std::mem::swap(&mut all, &mut block) } else { all.append(&mut block) }
        }
    }

    fn feed(&mut self) -> &mut Feed {
        match self {
            Points::Text(p) => p.feed(),
            Points::Flow(p) => p.feed(),
            Points::Even(p) => p.feed(),
            Points::Loose(p) => p.feed(),
        }
    }

    fn into_rest(self) -> (Feed, u64) {
        match self {
            Points::Text(p) => p.into_rest(),
            Points::Flow(p) => p.into_rest(),
            Points::Even(p) => (p.into_rest(), 0),
            Points::Loose(p) => (p.into_rest(), 0),
        }
    }
}

impl PointStream for Points {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        match self {
            Points::Text(p) => p.expected(),
            Points::Flow(p) => p.expected(),
            Points::Even(p) => p.expected(),
            Points::Loose(p) => p.expected(),
        }
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        match self {
            Points::Text(p) => p.next_block(block),
            Points::Flow(p) => p.next_block(block),
            Points::Even(p) => p.next_block(block),
            Points::Loose(p) => p.next_block(block),
        }
    }
}
