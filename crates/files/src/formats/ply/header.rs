//! The header of a PLY file: its elements, their properties, and how these are written.

use crate::{
    Warning,
    error::{Fault, Located, Result, quoted},
    lines::words,
    number::count,
    scalar::{Order, Scalar},
};

/// How the elements are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Binary(Order),
}

/// The type of a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PropertyType {
    One(Scalar),
    /// A count and so many numbers.
    List {
        count: Scalar,
        item: Scalar,
    },
}

/// A column of an element.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub name: String,
    pub kind: PropertyType,
}

/// A table of the file.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

impl Element {
    /// Number of rows to read. Rows without properties hold nothing, however many are declared.
    pub fn rows(&self) -> u64 {
        if self.properties.is_empty() { 0 } else { self.count }
    }
    /// Bytes of a row, if all rows have the same.
    pub fn stride(&self) -> Option<usize> {
        let size = |p: &Property| match p.kind {
            PropertyType::One(s) => Some(s.size()),
            PropertyType::List { .. } => None,
        };
        self.properties.iter().map(size).sum()
    }
    /// Least number of bytes of a row.
    pub fn least_stride(&self) -> usize {
        let size = |p: &Property| match p.kind {
            PropertyType::One(s) => s.size(),
            PropertyType::List { count, .. } => count.size(),
        };
        self.properties.iter().map(size).sum()
    }
    /// The property of this name and its position.
    pub fn property(&self, name: &str) -> Option<(usize, &Property)> {
        self.properties.iter().enumerate().find(|(_, p)| p.name == name)
    }
}

/// A header.
#[derive(Clone, Debug)]
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Bytes and lines it takes.
    pub length: usize,
    pub lines: u64,
    /// The byte that ends lines.
    pub end: u8,
    /// The warning about lines before the first element that begin with no known word. Old exporters sign there without `comment`.
    pub unknown: Option<Warning>,
}

impl Header {
    fn passed_over(&mut self, line: &[u8]) {
        match &mut self.unknown {
            Some(Warning::HeaderLines { count, .. }) => *count += 1,
            _ => self.unknown = Some(Warning::HeaderLines { count: 1, line: self.lines, text: quoted(line) }),
        }
    }
}

/// A file has this many elements, and each of them this many properties, at most. More are an attack.
const MAX_ELEMENTS_OR_PROPERTIES: usize = 4096;

/// Whether a file begins with the word `ply` on a line of its own, in small letters or capitals.
pub(super) fn is_magic(bytes: &[u8]) -> bool {
    let Some((word, rest)) = bytes.split_first_chunk::<3>() else { return false };
    let next = rest.iter().find(|b| !matches!(b, b' ' | b'\t'));
    word.eq_ignore_ascii_case(b"ply") && matches!(next, Some(b'\n' | b'\r'))
}

/// Reads the header at the start of `bytes`.
pub(super) fn parse(bytes: &[u8]) -> Result<Header> {
    let break_at = bytes.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(0);
    let old = bytes.get(break_at) == Some(&b'\r') && bytes.get(break_at + 1) != Some(&b'\n');
    let end = if old { b'\r' } else { b'\n' };
    let mut header =
        Header { encoding: Encoding::Ascii, elements: vec![], length: 0, lines: 0, end, unknown: None };
    let mut encoding = None;
    loop {
        header.lines += 1;
        let number = header.lines;
        let rest = bytes.get(header.length..).unwrap_or_default();
        let wrong = |expected: &'static str, line: &[u8]| Fault::unexpected(expected, line).at_line(number);
        let Some(length) = memchr::memchr(end, rest) else {
            // Without a line end nothing can follow: as good as the end, if it says so.
            if rest.trim_ascii().eq_ignore_ascii_case(b"end_header") {
                header.length = bytes.len();
                break;
            }
            return Err(wrong("\"end_header\" at the end of the header", b"the end of the file"));
        };
        let line = rest[..length].trim_ascii();
        header.length += length + 1;
        let mut words = words(line);
        match words.next().map(<[u8]>::to_ascii_lowercase).as_deref() {
            Some(b"end_header") => break,
            Some(b"ply") if header.lines == 1 => {}
            Some(b"format") => encoding = Some(format(line, header.lines)?),
            Some(b"element") => header.elements.push(element(line, header.lines)?),
            Some(b"property") => {
                let property = property(line, header.lines)?;
                match header.elements.last_mut() {
                    Some(e) if e.properties.len() < MAX_ELEMENTS_OR_PROPERTIES => e.properties.push(property),
                    _ => return Err(wrong("an element before its properties", line)),
                }
            }
            Some(b"comment" | b"obj_info") | None => {}
            Some(_) if header.elements.is_empty() && header.lines > 1 => header.passed_over(line),
            _ => return Err(wrong("\"element\", \"property\", \"comment\" or \"end_header\"", line)),
        }
        if header.elements.len() > MAX_ELEMENTS_OR_PROPERTIES {
            return Err(wrong("a reasonable number of elements", line));
        }
    }
    header.encoding = encoding.ok_or_else(|| {
        let found = Fault::Unexpected { expected: "a line \"format …\"".into(), found: "none".into() };
        found.at_line(2)
    })?;
    Ok(header)
}

/// The type of this name.
fn scalar(name: &[u8]) -> Option<Scalar> {
    Some(match &name.to_ascii_lowercase()[..] {
        b"char" | b"int8" => Scalar::I8,
        b"uchar" | b"uint8" => Scalar::U8,
        b"short" | b"int16" => Scalar::I16,
        b"ushort" | b"uint16" => Scalar::U16,
        b"int" | b"int32" => Scalar::I32,
        b"uint" | b"uint32" => Scalar::U32,
        b"float" | b"float32" => Scalar::F32,
        b"double" | b"float64" => Scalar::F64,
        _ => return None,
    })
}

fn format(line: &[u8], number: u64) -> Result<Encoding> {
    match words(line).nth(1).map(<[u8]>::to_ascii_lowercase).as_deref() {
        Some(b"ascii") => Ok(Encoding::Ascii),
        Some(b"binary_little_endian") => Ok(Encoding::Binary(Order::Little)),
        Some(b"binary_big_endian") => Ok(Encoding::Binary(Order::Big)),
        _ => Err(Fault::unexpected("ascii, binary_little_endian or binary_big_endian", line).at_line(number)),
    }
}

fn element(line: &[u8], number: u64) -> Result<Element> {
    let mut words = words(line).skip(1);
    match (words.next(), words.next().and_then(count)) {
        (Some(name), Some(count)) => Ok(Element { name: text(name), count, properties: vec![] }),
        _ => Err(Fault::unexpected("\"element\", a name and a number", line).at_line(number)),
    }
}

fn property(line: &[u8], number: u64) -> Result<Property> {
    let wrong = || -> Located {
        Fault::unexpected("\"property\", a type (char … double, or list of two types) and a name", line)
            .at_line(number)
    };
    let mut words = words(line).skip(1);
    let first = words.next().ok_or_else(wrong)?;
    let kind = if first.eq_ignore_ascii_case(b"list") {
        let count = words.next().and_then(scalar).ok_or_else(wrong)?;
        let item = words.next().and_then(scalar).ok_or_else(wrong)?;
        if matches!(count, Scalar::F32 | Scalar::F64) {
            return Err(wrong());
        }
        PropertyType::List { count, item }
    } else {
        PropertyType::One(scalar(first).ok_or_else(wrong)?)
    };
    let name = words.next().ok_or_else(wrong)?;
    Ok(Property { name: text(name), kind })
}

fn text(word: &[u8]) -> String {
    String::from_utf8_lossy(word).into_owned()
}
