//! The vertices and faces behind the counts.
//!
//! The format is free: any blanks may part numbers. Only the colors of a face end with its line, and programs put
//! further numbers behind a vertex that the keyword does not announce. So there are two readings. By lines, each row is
//! a line, and further numbers on it are passed over. By words, a vertex has as many numbers as the keyword says, wherever
//! the lines end. The right reading uses the file up to its last word and passes over equally many numbers in all rows.
//! Where neither does, lines that give all rows are taken, and a warning names the first uneven one.

use crate::{
    assemble::Faces,
    error::{Fault, Located, Result},
    flow::Flow,
    number::{count, whole_number},
};
use trueness_geom::space::Point;

/// Vertices and faces, and how many bytes of further content follow.
pub(super) struct Body {
    pub positions: Vec<Point>,
    pub faces: Faces,
    pub rest: u64,
    /// The first line on which more or fewer numbers were passed over than on others.
    pub uneven: Option<u64>,
}

/// The counts of the header.
pub(super) struct Counts {
    /// Vertices.
    pub vertices: u64,
    /// Faces.
    pub faces: u64,
    /// Whether the number of edges stands on the same line.
    pub edges: bool,
    /// How many numbers a vertex may have, the likeliest first.
    pub widths: Vec<usize>,
}

/// Reads the text behind the counts, which `words` has passed.
pub(super) fn read(text: &[u8], words: Flow, counts: &Counts) -> Result<Body> {
    let mut by_lines = Reading::new(text, words.clone(), Rows::Lines);
    let lines = by_lines.run(counts);
    if lines.is_ok() && by_lines.uneven.is_none() && by_lines.at_end() {
        return Ok(by_lines.body());
    }
    // Where lines mean nothing, the number of edges may stand on a later one than the other counts.
    let mut ahead = words.clone();
    let edges = !counts.edges && ahead.next().and_then(count).is_some();
    let words = if edges { ahead } else { words };
    let mut nearest = None;
    for width in counts.widths.iter().copied() {
        for rows in [Rows::Words { width, colors: false }, Rows::Words { width, colors: true }] {
            let mut by_words = Reading::new(text, words.clone(), rows);
            match by_words.run(counts) {
                Ok(()) if by_words.uneven.is_none() && by_words.at_end() => return Ok(by_words.body()),
                Ok(()) => {}
                Err(fault) => nearest = nearest.or(Some(fault)),
            }
        }
    }
    match (lines, nearest) {
        (Ok(()), _) => Ok(by_lines.body()),
        // Where the first rows are no lines, the reading by words names the right place.
        (Err(_), Some(fault)) if by_lines.uneven.is_some() || by_lines.positions.len() < 2 => Err(fault),
        (Err(fault), _) => Err(fault),
    }
}

/// How rows are told from each other.
#[derive(Clone, Copy, PartialEq)]
enum Rows {
    /// By line ends.
    Lines,
    /// By the number of their words; behind the corners of a face its colors may follow up to the end of the line.
    Words { width: usize, colors: bool },
}

/// A reading under way.
struct Reading<'a> {
    text: &'a [u8],
    words: Flow<'a>,
    rows: Rows,
    positions: Vec<Point>,
    faces: Faces,
    /// How many numbers were passed over behind each vertex and each face, as long as they are equally many.
    extra: [Option<usize>; 2],
    /// The first line where they are not.
    uneven: Option<u64>,
}

impl<'a> Reading<'a> {
    fn new(text: &'a [u8], words: Flow<'a>, rows: Rows) -> Reading<'a> {
        let (positions, faces) = (vec![], Faces::default());
        Reading { text, words, rows, positions, faces, extra: [None; 2], uneven: None }
    }

    fn body(self) -> Body {
        let rest = if self.at_end() { 0 } else { self.words.rest().len() as u64 };
        Body { positions: self.positions, faces: self.faces, rest, uneven: self.uneven }
    }

    fn at_end(&self) -> bool {
        self.words.clone().next().is_none()
    }

    fn run(&mut self, counts: &Counts) -> Result<()> {
        self.positions.reserve(counts.vertices as usize);
        for row in 0..counts.vertices {
            let short = Fault::Short { what: "vertices", declared: counts.vertices, present: row };
            let point = self.vertex(row, short).map_err(|f| self.here(f))?;
            self.positions.push(point);
        }
        let mut corners = vec![];
        for row in 0..counts.faces {
            let short = Fault::Short { what: "faces", declared: counts.faces, present: row };
            self.face(counts.vertices, short, &mut corners).map_err(|f| self.here(f))?;
            self.faces.push(&self.positions, &corners);
        }
        Ok(())
    }

    fn here(&self, fault: Fault) -> Located {
        fault.at_line(self.words.line())
    }

    /// The next word of a row that has begun.
    fn word(&mut self) -> Option<&'a [u8]> {
        if self.rows == Rows::Lines { self.words.next_on_line() } else { self.words.next() }
    }

    /// The line of the last word, for messages.
    fn shown(&self) -> &'a [u8] {
        let is_end = |b: &u8| matches!(b, b'\n' | b'\r');
        let at = self.words.at;
        let from = self.text[..at].iter().rposition(is_end).map_or(0, |i| i + 1);
        let to = self.text[at..].iter().position(is_end).map_or(self.text.len(), |i| at + i);
        &self.text[from..to]
    }

    fn vertex(&mut self, row: u64, short: Fault) -> std::result::Result<Point, Fault> {
        let first = self.words.next().ok_or(short)?;
        let mut point = [0.0; 3];
        for (axis, x) in point.iter_mut().enumerate() {
            let word = if axis == 0 { Some(first) } else { self.word() };
            let number = word.and_then(|w| whole_number(w, b'.'));
            *x =
                number.ok_or_else(|| Fault::unexpected("three numbers with decimal points", self.shown()))?;
            if !x.is_finite() {
                return Err(Fault::NotFinite { what: "vertex", number: row + 1 });
            }
        }
        match self.rows {
            Rows::Lines => self.pass_over(0)?,
            Rows::Words { width, .. } => {
                for _ in 3..width {
                    let number = self.words.next().and_then(|w| whole_number(w, b'.'));
                    number.ok_or_else(|| {
                        Fault::unexpected("as many numbers of a vertex as the keyword says", self.shown())
                    })?;
                }
            }
        }
        Ok(point)
    }

    fn face(
        &mut self,
        vertices: u64,
        short: Fault,
        corners: &mut Vec<u32>,
    ) -> std::result::Result<(), Fault> {
        corners.clear();
        let first = self.words.next().ok_or(short)?;
        let expected = "the number of corners and as many numbers of vertices";
        let wrong = |reading: &Self| Fault::unexpected(expected, reading.shown());
        let size = count(first).ok_or_else(|| wrong(self))?;
        for _ in 0..size {
            let v = self.word().and_then(count).ok_or_else(|| wrong(self))?;
            if v >= vertices {
                return Err(Fault::NoSuchVertex {
                    index: i64::try_from(v).unwrap_or(i64::MAX),
                    count: vertices,
                });
            }
            corners.push(v as u32);
        }
        if !matches!(self.rows, Rows::Words { colors: false, .. }) {
            self.pass_over(1)?;
        }
        Ok(())
    }

    /// Passes over the numbers on the rest of the line behind a vertex (0) or a face (1). Behind a face there may be a color
    /// of one, three or four.
    fn pass_over(&mut self, kind: usize) -> std::result::Result<(), Fault> {
        let mut extra = 0;
        while let Some(word) = self.words.next_on_line() {
            if whole_number(word, b'.').is_none() {
                return Err(Fault::unexpected("numbers alone behind a vertex or face", self.shown()));
            }
            extra += 1;
        }
        let fits = kind == 0 || matches!(extra, 0 | 1 | 3 | 4);
        let alike = *self.extra[kind].get_or_insert(extra) == extra;
        if self.uneven.is_none() && !(fits && alike) {
            self.uneven = Some(self.words.line());
        }
        Ok(())
    }
}
