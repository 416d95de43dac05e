//! The header of a PCD file: a line for each fact, the last of which says how the data are stored.

use crate::{
    error::{Fault, Result, quoted},
    lines::{Lines, line_end, words},
    number::{count, whole_number},
    scalar::Scalar,
};

/// How the points are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Storage {
    /// A line of words for each.
    Ascii,
    /// A row of bytes for each.
    Binary,
    /// Field after field, compressed by LZF.
    Packed,
}

/// A field of every point: one number, or several.
#[derive(Debug)]
struct Field {
    name: String,
    /// The letter of its type: `F`, `I` or `U`.
    kind: u8,
    /// Bytes of one number.
    size: usize,
    /// Numbers of a point.
    count: usize,
}

/// Where a coordinate is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub scalar: Scalar,
    /// The first byte in a row.
    pub byte: usize,
    /// The word in a line.
    pub word: usize,
}

/// The facts of a header.
#[derive(Debug)]
pub(super) struct Header {
    fields: Vec<Field>,
    pub storage: Storage,
    pub points: u64,
    /// Bytes of a point.
    pub stride: usize,
    /// Words of a point.
    pub words: usize,
    /// Where the scanner stood, unless it is the origin with the axes of the points.
    pub viewpoint: Option<String>,
    /// Bytes of the header.
    pub length: usize,
    /// Lines of the header.
    pub lines: u64,
    /// The byte that ends its lines.
    pub end: u8,
}

/// A point has no more bytes than this: clouds with histograms have some thousands.
const MAX_POINT_BYTES: usize = 1 << 20;

/// The lines of a header by their first word.
#[derive(Default)]
struct Facts<'a> {
    fields: Vec<&'a [u8]>,
    sizes: Vec<&'a [u8]>,
    kinds: Vec<&'a [u8]>,
    counts: Vec<&'a [u8]>,
    width: Option<u64>,
    height: Option<u64>,
    points: Option<u64>,
    viewpoint: Option<String>,
}

impl Header {
    pub fn parse(bytes: &[u8]) -> Result<Header> {
        let mut lines = Lines::new(bytes);
        let mut facts = Facts::default();
        loop {
            let Some(line) = lines.next() else {
                let what = "a line DATA ascii, DATA binary or DATA binary_compressed that ends the header";
                return Err(Fault::unexpected(what, &bytes[..bytes.len().min(64)]).into());
            };
            let number = lines.number;
            let mut rest = words(line);
            let Some(key) = rest.next().filter(|key| !key.starts_with(b"#")) else { continue };
            let values: Vec<&[u8]> = rest.collect();
            if key == b"DATA" {
                let storage = storage(&values).map_err(|fault| fault.at_line(number))?;
                let length = bytes.len() - lines.rest().len();
                let end = line_end(&bytes[..length]);
                return facts.header(storage, (length, number, end));
            }
            facts.take(key, values, line).map_err(|fault| fault.at_line(number))?;
        }
    }

    /// Where x, y and z are.
    pub fn coordinates(&self) -> Result<[Place; 3]> {
        let mut places = [None; 3];
        let (mut byte, mut word) = (0, 0);
        for field in &self.fields {
            if let Some(axis) = field.axis() {
                places[axis] = Some(Place { scalar: field.scalar()?, byte, word });
            }
            byte += field.size * field.count;
            word += field.count;
        }
        let [Some(x), Some(y), Some(z)] = places else {
            let there: Vec<&str> = self.fields.iter().map(|f| f.name.as_str()).collect();
            let what = format!("FIELDS has no x, y and z, but {}", quoted(there.join(" ").as_bytes()));
            return Err(
                Fault::Unsupported { what, remedy: "export the points with their coordinates" }.into()
            );
        };
        Ok([x, y, z])
    }

    /// The names of the fields beside x, y and z.
    pub fn other_fields(&self) -> impl Iterator<Item = &str> {
        self.fields.iter().filter(|f| f.axis().is_none()).map(|f| f.name.as_str())
    }
}

impl Field {
    /// 0, 1, 2 for x, y, z.
    fn axis(&self) -> Option<usize> {
        ["x", "y", "z"]
            .iter()
            .position(|axis| self.name.eq_ignore_ascii_case(axis))
            .filter(|_| self.count == 1)
    }

    fn scalar(&self) -> Result<Scalar> {
        Ok(match (self.kind, self.size) {
            (b'F', 4) => Scalar::F32,
            (b'F', 8) => Scalar::F64,
            (b'I', 1) => Scalar::I8,
            (b'I', 2) => Scalar::I16,
            (b'I', 4) => Scalar::I32,
            (b'I', 8) => Scalar::I64,
            (b'U', 1) => Scalar::U8,
            (b'U', 2) => Scalar::U16,
            (b'U', 4) => Scalar::U32,
            (b'U', 8) => Scalar::U64,
            (kind, size) => {
                let what =
                    format!("field {} has numbers of TYPE {} and SIZE {size}", self.name, kind as char);
                return Err(Fault::Unsupported { what, remedy: "save x, y and z as TYPE F, SIZE 8" }.into());
            }
        })
    }
}

fn storage(values: &[&[u8]]) -> std::result::Result<Storage, Fault> {
    match values {
        [b"ascii"] => Ok(Storage::Ascii),
        [b"binary"] => Ok(Storage::Binary),
        [b"binary_compressed"] => Ok(Storage::Packed),
        _ => Err(Fault::unexpected("DATA ascii, binary or binary_compressed", &values.join(&b' '))),
    }
}

impl<'a> Facts<'a> {
    fn take(&mut self, key: &[u8], values: Vec<&'a [u8]>, line: &[u8]) -> std::result::Result<(), Fault> {
        let number = || match values[..] {
            [word] => count(word).ok_or_else(|| Fault::unexpected("a whole number", line)),
            _ => Err(Fault::unexpected("one whole number", line)),
        };
        match key {
            b"FIELDS" | b"COLUMNS" => self.fields = values,
            b"SIZE" => self.sizes = values,
            b"TYPE" => self.kinds = values,
            b"COUNT" => self.counts = values,
            b"WIDTH" => self.width = Some(number()?),
            b"HEIGHT" => self.height = Some(number()?),
            b"POINTS" => self.points = Some(number()?),
            b"VIEWPOINT" => self.viewpoint = viewpoint(&values)?,
            b"VERSION" => {}
            _ => return Err(Fault::unexpected("a line of the header of PCD", line)),
        }
        Ok(())
    }

    fn header(self, storage: Storage, (length, lines, end): (usize, u64, u8)) -> Result<Header> {
        let points = self.number_of_points()?;
        let fields = self.fields()?;
        let all = |of: fn(&Field) -> usize| fields.iter().map(of).try_fold(0usize, usize::checked_add);
        let (stride, words) = (all(|f| f.size.saturating_mul(f.count)), all(|f| f.count));
        let (Some(stride @ 1..=MAX_POINT_BYTES), Some(words)) = (stride, words) else {
            let fault = Fault::unexpected("SIZE and COUNT of a point of 1 to 1048576 bytes", b"others");
            return Err(fault.into());
        };
        Ok(Header { fields, storage, points, stride, words, viewpoint: self.viewpoint, length, lines, end })
    }

    fn number_of_points(&self) -> Result<u64> {
        let (width, height) = match (self.width, self.height, self.points) {
            (None, None, Some(points)) => (points, 1),
            (Some(width), height, _) => (width, height.unwrap_or(1)),
            _ => {
                return Err(Fault::unexpected("lines WIDTH and HEIGHT, or POINTS, in the header", b"").into());
            }
        };
        let places = width.checked_mul(height);
        match (places, self.points) {
            (Some(places), Some(points)) if places == points => Ok(places),
            (Some(places), None) => Ok(places),
            (_, points) => {
                let points = points.map_or_else(String::new, |n| format!(", and POINTS {n}"));
                let what = format!("WIDTH {width} times HEIGHT {height} is not the number of points{points}");
                Err(Fault::Unclear { what, remedy: "correct the header or export the file again" }.into())
            }
        }
    }

    fn fields(&self) -> Result<Vec<Field>> {
        let n = self.fields.len();
        let counts = if self.counts.is_empty() { vec![&b"1"[..]; n] } else { self.counts.clone() };
        if self.sizes.len() != n || self.kinds.len() != n || counts.len() != n {
            let what = format!(
                "FIELDS names {n}, SIZE {}, TYPE {}, COUNT {} fields",
                self.sizes.len(),
                self.kinds.len(),
                counts.len()
            );
            return Err(Fault::Unclear { what, remedy: "correct the header or export the file again" }.into());
        }
        let small = |word: &[u8]| count(word).and_then(|n| usize::try_from(n).ok());
        let fields = (0..n).map(|i| {
            Some(Field {
                name: String::from_utf8_lossy(self.fields[i]).into_owned(),
                kind: *self.kinds[i].first()?,
                size: small(self.sizes[i]).filter(|size| *size > 0)?,
                count: small(counts[i])?,
            })
        });
        let fields: Option<Vec<Field>> = fields.collect();
        fields.ok_or_else(|| {
            Fault::unexpected("whole numbers behind SIZE, none of them 0, and COUNT", &self.sizes.join(&b' '))
                .into()
        })
    }
}

/// The place of the scanner as it stands there; `None` where it is the origin of the points, without a rotation.
fn viewpoint(values: &[&[u8]]) -> std::result::Result<Option<String>, Fault> {
    let numbers: Option<Vec<f64>> = values.iter().map(|word| whole_number(word, b'.')).collect();
    match numbers.as_deref() {
        Some([x, y, z, w, i, j, k]) => {
            let moved = [x, y, z, i, j, k].iter().any(|n| **n != 0.0) || w.abs() != 1.0;
            Ok(moved.then(|| String::from_utf8_lossy(&values.join(&b' ')).into_owned()))
        }
        _ => Err(Fault::unexpected("seven numbers behind VIEWPOINT", &values.join(&b' '))),
    }
}
