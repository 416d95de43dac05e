//! PTX: scans of Leica Cyclone, as text.
//!
//! A scan is a head of ten lines and a line for each of its columns times rows directions. The matrix of the head takes places, as
//! rows, to common axes: `p' = p · M`.

#[cfg(test)]
mod tests;

use crate::{
    ScanWarning, Unit,
    error::{Fault, Located, Result},
    format::{Format, Head, Holds, Parsed, ReadOptions},
    formats::strided::is_finite,
    lines::{Lines, line_end, words},
    number::{count, whole_number},
    records::TextRecords,
    scan_warning::remark,
    source::Source,
};
use trueness_geom::{cloud::PointStream, space::Point};

/// Scans of Leica Cyclone.
pub(crate) const PTX: Format = Format {
    name: "ptx",
    known_as: &["PTX"],
    extensions: &["ptx"],
    written_as: &[],
    manual: include_str!("ptx.md"),
    holds: &[Holds::Points],
    columns: false,
    sniff: |head: &Head| is_ptx(head.bytes),
    read: Some(read),
    model: None,
    points: None,
    mesh: None,
};

/// Numbers in the lines of a head: columns, rows, the place of the scanner, its axes, the matrix.
const NUMBERS_PER_LINE: [usize; 10] = [1, 1, 3, 3, 3, 3, 4, 4, 4, 4];
/// A record has at least three words, with a blank or line end behind each.
const MIN_RECORD_BYTES: u64 = 6;

/// Whether text begins with the head of a scan.
fn is_ptx(bytes: &[u8]) -> bool {
    let mut lines = Lines::new(bytes);
    NUMBERS_PER_LINE.iter().enumerate().all(|(i, width)| {
        let Some(line) = lines.next() else { return false };
        let fits =
            |word: &[u8]| if i < 2 { count(word).is_some() } else { whole_number(word, b'.').is_some() };
        words(line).count() == *width && words(line).all(fits)
    })
}

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let end = line_end(source.feed.ahead(1 << 16)?);
    let mut scans = Scans {
        records: TextRecords::new(source.feed, end, 0, options.block),
        scan: Scan::default(),
        scans: 0,
        empty: 0,
        no_return: 0,
    };
    if !scans.begin()? {
        return Err(Fault::unexpected("the head of a scan", b"").at_line(1));
    }
    Ok(Parsed { unit: Some(Unit::Meter), ..Parsed::points("ptx", scans) })
}

/// A scan of which not all records have been read.
#[derive(Default)]
struct Scan {
    /// As many as its head declares.
    declared: u64,
    /// Those read.
    read: u64,
    /// Points among them.
    points: u64,
    /// The first three numbers of the rows of its matrix.
    matrix: [Point; 4],
}

/// The points of all scans.
struct Scans {
    records: TextRecords,
    scan: Scan,
    /// Scans begun.
    scans: u64,
    /// Those that ended without a point.
    empty: u64,
    no_return: u64,
}

impl Scans {
    /// Reads the head of the next scan; false at the end of the file.
    fn begin(&mut self) -> Result<bool> {
        let mut head = [[0.0; 4]; 10];
        for (i, width) in NUMBERS_PER_LINE.into_iter().enumerate() {
            let line = match self.records.line()? {
                Some(line) => line,
                None if i == 0 && self.scans > 0 => return Ok(false),
                None => vec![],
            };
            let numbers: Option<Vec<f64>> = words(&line).map(|word| whole_number(word, b'.')).collect();
            match numbers {
                Some(numbers) if numbers.len() == width && numbers.iter().all(|x| x.is_finite()) => {
                    head[i][..width].copy_from_slice(&numbers);
                }
                _ => {
                    let expected = format!("line {} of the head of a scan with {width} number(s)", i + 1);
                    return Err(Fault::unexpected(expected, &line).at_line(self.records.lines));
                }
            }
        }
        let [columns, rows, .., a, b, c, d] = head;
        if [a[3], b[3], c[3], d[3]] != [0.0, 0.0, 0.0, 1.0] {
            let found = format!("{} {} {} {}", a[3], b[3], c[3], d[3]);
            let fault = Fault::unexpected("0 0 0 1 in the last column of the matrix", found.as_bytes());
            return Err(fault.at_line(self.records.lines));
        }
        let declared = columns[0] * rows[0];
        if declared.fract() != 0.0 || !(0.0..1e18).contains(&declared) {
            let fault =
                Fault::unexpected("numbers of columns and rows", format!("{declared} points").as_bytes());
            return Err(fault.at_line(self.records.lines - 9));
        }
        let declared = declared as u64;
        if let Some(left) = self.records.left()
            && declared > left / MIN_RECORD_BYTES + 1
        {
            let short = Fault::Short { what: "points", declared, present: left / MIN_RECORD_BYTES };
            return Err(short.at_line(self.records.lines - 9));
        }
        self.scans += 1;
        self.scan = Scan { declared, read: 0, points: 0, matrix: [a, b, c, d].map(|[x, y, z, _]| [x, y, z]) };
        Ok(true)
    }
}

impl PointStream for Scans {
    type Error = Located;
    fn expected(&self) -> Option<u64> {
        Some(self.scan.declared)
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<()> {
        block.clear();
        while block.is_empty() {
            let Scan { declared, read, points, matrix } = self.scan;
            if read == declared {
                self.empty += u64::from(points == 0);
                self.scan.points = 1;
                if !self.begin()? {
                    return Ok(());
                }
                continue;
            }
            let records = self.records.points(declared - read, |line| place(line, &matrix), block)?;
            if records == 0 {
                let short = Fault::Short { what: "points of a scan", declared, present: read };
                return Err(short.at_line(self.records.lines + 1));
            }
            self.scan.read += records;
            self.scan.points += block.len() as u64;
            self.no_return += records - block.len() as u64;
        }
        Ok(())
    }
    fn remarks(&self) -> Vec<String> {
        let mut remarks = vec![];
        if self.scans > 1 {
            remarks.push(ScanWarning::Scans { count: self.scans, empty: self.empty }.to_string());
        }
        remarks.extend(remark(self.no_return, |count| ScanWarning::NoReturn { count }));
        remarks
    }
}

/// The place of a record in common axes, if there was a return.
fn place(line: &[u8], matrix: &[Point; 4]) -> std::result::Result<Option<Point>, Fault> {
    let mut own = [0.0; 3];
    let mut words = words(line);
    for x in &mut own {
        let word = words.next().unwrap_or_default();
        *x = whole_number(word, b'.').ok_or_else(|| Fault::unexpected("three or more numbers", line))?;
    }
    if own == [0.0; 3] {
        return Ok(None);
    }
    let [a, b, c, d] = matrix;
    let placed: Point = std::array::from_fn(|i| own[0] * a[i] + own[1] * b[i] + own[2] * c[i] + d[i]);
    if is_finite(&placed) { Ok(Some(placed)) } else { Err(Fault::unexpected("finite numbers", line)) }
}
