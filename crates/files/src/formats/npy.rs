//! NPY: an array of NumPy.
//!
//! Format: numpy/lib/format.py, versions 1 to 3. The header is a Python dictionary as text.

use super::strided::{Rows, StridedPoints, finite};
use crate::{
    Column, Columns,
    error::{Fault, Located, Result},
    feed::Feed,
    format::{Format, Head, Holds, Parsed, ReadOptions},
    number::count,
    scalar::{Order, Scalar},
    source::Source,
};
use rayon::prelude::*;
use trueness_geom::{cloud::PointStream, space::Point};

/// NumPy array.
pub(crate) const NPY: Format = Format {
    name: "npy",
    known_as: &["NPY"],
    extensions: &["npy"],
    written_as: &[],
    manual: include_str!("npy.md"),
    holds: &[Holds::Points],
    columns: true,
    sniff: |head: &Head| head.bytes.starts_with(NPY_MAGIC),
    read: Some(read),
    model: None,
    points: None,
    mesh: None,
};

const NPY_MAGIC: &[u8] = b"\x93NUMPY";
/// A header is read up to this length.
const MAX_NPY_HEADER_BYTES: usize = 1 << 16;

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let bytes = source.feed.ahead(MAX_NPY_HEADER_BYTES + 12)?;
    let (start, text) = header(bytes)?;
    let array = Array::parse(text)?;
    source.feed.step(start);
    let columns = array.columns(options.columns.as_ref())?;
    let size = array.scalar.size();
    let planar = columns.len() == 2;
    let points = if array.fortran {
        Parsed::points("npy", Columnwise::new(source.feed, array, columns, options.block)?)
    } else {
        let place = |i: usize| (columns[i] * size, array.scalar);
        let rows = Rows {
            order: array.order,
            stride: array.width * size,
            x: place(0),
            y: place(1),
            z: (!planar).then(|| place(2)),
            count: array.rows,
            what: ("point", "points"),
        };
        let points = StridedPoints::new(source.feed, rows, options.block)?;
        if let Some(left) = points.left_behind() {
            no_more(left, array.rows, start as u64 + array.rows * rows.stride as u64)?;
        }
        Parsed::points("npy", Rowwise(points))
    };
    Ok(Parsed { planar, ..points })
}

/// Where the data begin, and the text of the header.
fn header(bytes: &[u8]) -> Result<(usize, &str)> {
    let wrong = |what: &'static str| Fault::unexpected(what, &bytes[..bytes.len().min(16)]).at_byte(0);
    if !bytes.starts_with(NPY_MAGIC) {
        return Err(wrong("an array written by numpy.save"));
    }
    let (length, start) = match bytes {
        [_, _, _, _, _, _, 1, _, a, b, ..] => (usize::from(u16::from_le_bytes([*a, *b])), 10),
        [_, _, _, _, _, _, 2 | 3, _, a, b, c, d, ..] => (u32::from_le_bytes([*a, *b, *c, *d]) as usize, 12),
        _ => return Err(wrong("version 1, 2 or 3 of the format")),
    };
    let text = bytes.get(start..).and_then(|b| b.get(..length)).filter(|_| length <= MAX_NPY_HEADER_BYTES);
    let text = text.and_then(|t| std::str::from_utf8(t).ok());
    text.map(|t| (start + length, t)).ok_or_else(|| wrong("a header as long as it says"))
}

/// The content of the header.
struct Array {
    scalar: Scalar,
    order: Order,
    fortran: bool,
    rows: u64,
    width: usize,
}

/// An array with more columns holds no points.
const MAX_POINT_COLUMNS: u64 = 4096;

impl Array {
    fn parse(text: &str) -> Result<Array> {
        let wrong = || {
            Located::from(Fault::unexpected("descr, fortran_order and shape of the array", text.as_bytes()))
        };
        let value = |key: &str| {
            let at = text.find(&format!("'{key}'")).or_else(|| text.find(&format!("\"{key}\"")))?;
            let rest = text[at + key.len() + 2..].trim_start().strip_prefix(':')?;
            Some(rest.trim_start())
        };
        let descr = value("descr").ok_or_else(wrong)?;
        let (order, scalar) = dtype(descr)?;
        let fortran = match value("fortran_order") {
            Some(v) if v.starts_with("True") => true,
            Some(v) if v.starts_with("False") => false,
            _ => return Err(wrong()),
        };
        let shape = value("shape").and_then(|v| v.strip_prefix('(')?.split_once(')')).ok_or_else(wrong)?.0;
        let sides: Option<Vec<u64>> =
            shape.split(',').map(str::trim).filter(|w| !w.is_empty()).map(|w| count(w.as_bytes())).collect();
        match sides.ok_or_else(wrong)?[..] {
            [rows, width] if (2..=MAX_POINT_COLUMNS).contains(&width) => {
                Ok(Array { scalar, order, fortran, rows, width: width as usize })
            }
            _ => {
                let what = format!("an array of shape ({shape}) is not a list of points");
                Err(Fault::Unsupported { what, remedy: "save one of shape (n, 3)" }.into())
            }
        }
    }

    /// The columns of x, y and, unless the points lie in the plane, z; counted from 0.
    fn columns(&self, wanted: Option<&Columns>) -> Result<Vec<usize>> {
        let Some(Columns(wanted)) = wanted else {
            if matches!(self.rows, 2 | 3) && self.width > 3 {
                let what =
                    format!("an array of shape ({}, {}) seems to lie on its side", self.rows, self.width);
                return Err(
                    Fault::Unsupported { what, remedy: "save its transpose, or name the columns" }.into()
                );
            }
            return Ok((0..self.width.min(3)).collect());
        };
        let find = |c: &Column| match c {
            Column::Number(n) if *n <= self.width => Ok(n - 1),
            Column::Number(n) => Err(n.to_string()),
            Column::Name(name) => Err(format!("\"{name}\"")),
        };
        let found: std::result::Result<Vec<usize>, String> = wanted.iter().map(find).collect();
        let there = format!("{} columns without names", self.width);
        found.map_err(|wanted| Fault::NoColumn { wanted, there }.into())
    }
}

/// Byte order and type of the numbers, as in `'<f8'`.
fn dtype(descr: &str) -> Result<(Order, Scalar)> {
    let name = descr.strip_prefix(['\'', '"']).and_then(|d| d.split(['\'', '"']).next());
    let unsupported = || -> Located {
        let what = format!("an array of type {} cannot be read", name.unwrap_or("record"));
        Fault::Unsupported { what, remedy: "save it as float64, with array.astype(\"f8\")" }.into()
    };
    let (order, kind) = name.and_then(|n| n.split_at_checked(1)).ok_or_else(unsupported)?;
    let scalar = match kind {
        "f4" => Scalar::F32,
        "f8" => Scalar::F64,
        "i1" => Scalar::I8,
        "i2" => Scalar::I16,
        "i4" => Scalar::I32,
        "u1" => Scalar::U8,
        "u2" => Scalar::U16,
        "u4" => Scalar::U32,
        _ => return Err(unsupported()),
    };
    match order {
        "<" | "|" => Ok((Order::Little, scalar)),
        ">" => Ok((Order::Big, scalar)),
        _ => Err(unsupported()),
    }
}

/// Points whose coordinates lie column after column, as Fortran has them. From a file, only the part of each column is
/// read that a block needs. A stream stays in memory as a whole.
struct Columnwise {
    feed: Feed,
    array: Array,
    columns: Vec<usize>,
    found: usize,
    rows: usize,
    block: usize,
    /// Bytes of a column's part.
    column_part: Vec<u8>,
}

impl Columnwise {
    fn new(mut feed: Feed, array: Array, columns: Vec<usize>, block: usize) -> Result<Columnwise> {
        let size = array.scalar.size();
        let at = feed.position();
        let there = match feed.left() {
            Some(left) => left,
            None => feed.all()?.len() as u64,
        };
        let row = (array.width * size) as u64;
        let need = array.rows.checked_mul(row).filter(|need| *need <= there);
        let (Some(need), Ok(rows)) = (need, usize::try_from(array.rows)) else {
            let short = Fault::Short { what: "points", declared: array.rows, present: there / row };
            return Err(short.at_byte(at + there));
        };
        no_more(there - need, array.rows, at + need)?;
        Ok(Columnwise { feed, array, columns, found: 0, rows, block: block.max(1), column_part: vec![] })
    }
}

impl PointStream for Columnwise {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.rows as u64)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        let size = self.array.scalar.size();
        let (start, rows) = (self.found, self.rows);
        let end = rows.min(start.saturating_add(self.block));
        let at = self.feed.position();
        block.clear();
        block.resize(end - start, [0.0; 3]);
        self.column_part.resize((end - start) * size, 0);
        let array = &self.array;
        for (axis, column) in self.columns.iter().enumerate() {
            self.feed.copy(((column * rows + start) * size) as u64, &mut self.column_part)?;
            let cells = self.column_part.par_chunks_exact(size).with_min_len(1 << 12);
            block.par_iter_mut().with_min_len(1 << 12).zip(cells).for_each(|(point, bytes)| {
                point[axis] = array.scalar.get(bytes, array.order);
            });
        }
        finite(block, "point", start as u64)
            .map_err(|(i, fault)| fault.at_byte(at + ((start + i) * size) as u64))?;
        self.found = end;
        Ok(())
    }
}

/// Points whose rows must end with the file. Further bytes are another array, or the header is wrong.
struct Rowwise(StridedPoints);

impl PointStream for Rowwise {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        self.0.expected()
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        self.0.next_block(block)?;
        if block.is_empty() {
            let declared = self.0.expected().unwrap_or_default();
            let feed = self.0.feed();
            let (at, rest) = (feed.position(), feed.all()?.len() as u64);
            no_more(rest, declared, at)?;
        }
        Ok(())
    }
}

/// Refuses bytes behind the array.
fn no_more(count: u64, declared: u64, at: u64) -> Result<()> {
    if count > 0 { Err(Fault::Trailing { count, what: "points", declared }.at_byte(at)) } else { Ok(()) }
}
