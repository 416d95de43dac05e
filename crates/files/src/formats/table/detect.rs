//! How a table is written, found out from its first lines: the rules stand at the head of the module.
//!
//! Every way of writing is tried on the first lines. One that reads every row goes before one that does not, three
//! coordinates before two, the earlier in the list before the later. Where none reads every row, the one that reads
//! the most is taken, and the reader then refuses the first row that it cannot read.

use super::{
    cell::{Separator, run_together},
    choose::{self, Chosen},
    header::{Header, UnitWord, unit_of},
    line::is_blank_line,
    row::{Layout, Row},
    tried::Tried,
};
use crate::{
    Columns, Unit, Warning,
    content::{ColumnTaken, TableReading},
    error::{Fault, Located, Result},
    lines::{Lines, line_end},
    source::SNIFFED_BYTES,
};

/// The facts that the first lines tell.
pub(super) struct Found {
    pub layout: Layout,
    pub variant: &'static str,
    /// Bytes and lines before the first row.
    pub skip: usize,
    pub lines: u64,
    /// Number of points as announced.
    pub declared: Option<u64>,
    /// Bytes of a row, about.
    pub width: usize,
    pub reading: TableReading,
    /// The unit of x, y, z in the header.
    pub unit: Option<Unit>,
    pub warnings: Vec<Warning>,
}

/// At most this many lines decide how a table is written.
const MAX_SAMPLE_LINES: usize = 400;

/// The ways of writing: separator and decimal point.
const DIALECTS: [(Separator, u8); 7] = [
    (Separator::Byte(b';'), b'.'),
    (Separator::Byte(b';'), b','),
    (Separator::Byte(b'\t'), b'.'),
    (Separator::Byte(b'\t'), b','),
    (Separator::Byte(b','), b'.'),
    (Separator::Blanks, b'.'),
    (Separator::Blanks, b','),
];

/// Whether the first lines are rows of numbers, with faults or without.
pub(super) fn plausible(head: &[u8]) -> bool {
    let lines = sample(head);
    DIALECTS.iter().filter_map(|d| Tried::new(*d, &lines)).any(|t| 2 * t.numeric > t.rows.len())
}

/// Looks at the first lines of a file. `unit_asked`: the user says the unit, so that it need not be understood.
pub(super) fn detect(head: &[u8], columns: Option<&Columns>, unit_asked: bool) -> Result<Found> {
    let lines = sample(head);
    let end = line_end(head);
    let mut candidates: Vec<Candidate> = vec![];
    let tabs = Tried::new((Separator::Byte(b'\t'), b'.'), &lines).is_some_and(|t| t.clearly_parted());
    for dialect in DIALECTS.iter().filter(|d| d.0 != Separator::Blanks || !tabs) {
        let Some(tried) = Tried::new(*dialect, &lines) else { continue };
        let chosen = choose::columns(&tried, columns);
        candidates.push(Candidate::of(tried, chosen, end));
    }
    match best(candidates) {
        Some(Candidate { tried, chosen, .. }) => found(head, &lines, &tried, chosen?, unit_asked),
        None => Err(no_rows(&lines)),
    }
}

/// A way of writing and what it reads.
struct Candidate<'a> {
    tried: Tried<'a>,
    chosen: std::result::Result<Chosen, Located>,
    rank: Rank,
    /// Lines that it reads as rows, or would, if it were clear which columns are meant.
    good: Vec<usize>,
}

/// The best way. It must not skip more rows of another way, before its first row, than it reads itself. Else a line behind a
/// table that is written otherwise would be read alone.
fn best(mut candidates: Vec<Candidate>) -> Option<Candidate> {
    let mut best = 0;
    for i in 1..candidates.len() {
        if candidates[i].rank > candidates[best].rank {
            best = i;
        }
    }
    let chosen = candidates.get(best)?;
    let skipped = |w: &Candidate| w.good.iter().filter(|line| **line < chosen.tried.start).count();
    let mut larger = (chosen.good.len(), best);
    for (i, candidate) in candidates.iter().enumerate().filter(|_| chosen.chosen.is_ok()) {
        if skipped(candidate) > larger.0 {
            larger = (skipped(candidate), i);
        }
    }
    Some(candidates.swap_remove(larger.1))
}

/// Whether every row was read, how many were, how many coordinates they have, and how many cells are numbers.
type Rank = (bool, usize, usize, usize);

impl<'a> Candidate<'a> {
    fn of(tried: Tried<'a>, chosen: std::result::Result<Chosen, Located>, end: u8) -> Candidate<'a> {
        let numbers = tried.numbers();
        let Ok(known) = &chosen else {
            let good = tried.rows_of_numbers().collect();
            return Candidate { tried, chosen, rank: (false, 0, 0, numbers), good };
        };
        let layout = tried.layout(end, &known.columns);
        let (mut good, mut bad) = (vec![], 0);
        for line in &tried.rows {
            match layout.row(line.text) {
                Ok(Row::Point(_)) => good.push(line.index),
                Ok(_) => {}
                Err(_) => bad += 1,
            }
        }
        let all = bad == 0 && !good.is_empty();
        // Rows read in part say little about the number of coordinates.
        let (some, coordinates) = if all { (0, known.columns.len()) } else { (good.len(), 0) };
        Candidate { tried, chosen, rank: (all, some, coordinates, numbers), good }
    }
}

/// The first lines, without one that the end of the sample cuts.
fn sample(head: &[u8]) -> Vec<&[u8]> {
    let mut lines: Vec<&[u8]> = Lines::new(head).take(MAX_SAMPLE_LINES).collect();
    let cut = head.len() >= SNIFFED_BYTES && lines.len() < MAX_SAMPLE_LINES;
    if cut && lines.len() > 1 {
        lines.pop();
    }
    lines
}

fn no_rows(lines: &[&[u8]]) -> Located {
    let together = |(i, line): (usize, &&[u8])| Some((i, run_together(line.trim_ascii())?));
    if let Some((i, (what, remedy))) = lines.iter().enumerate().find_map(together) {
        return Fault::Unclear { what: what.into(), remedy }.at_line(i as u64 + 1);
    }
    let expected = "rows of two or three numbers";
    match lines.iter().position(|l| !is_blank_line(l)) {
        Some(i) => Fault::unexpected(expected, lines[i]).at_line(i as u64 + 1),
        None => Fault::Unexpected { expected: expected.into(), found: "no rows".into() }.into(),
    }
}

fn found(head: &[u8], lines: &[&[u8]], tried: &Tried, chosen: Chosen, unit_asked: bool) -> Result<Found> {
    let Chosen { columns, named, mut warnings } = chosen;
    let header = tried.header.as_ref().filter(|_| named);
    let start = tried.start;
    let mut layout = tried.layout(line_end(head), &columns);
    layout.announced = tried.announced.is_some();
    let unit = match unit(header, &columns, unit_asked, &mut warnings)? {
        None => stated(&lines[..start], unit_asked)?,
        unit => unit,
    };
    let csv = matches!(tried.dialect.0, Separator::Byte(_));
    let bytes: usize = lines[start..].iter().map(|l| l.len() + 1).sum();
    let name = |i: usize| header.and_then(|h| Some(h.names.get(i)?.text.clone()));
    let taken = columns.iter().zip(['x', 'y', 'z']).map(|(&column, axis)| ColumnTaken {
        axis,
        number: column + 1,
        name: name(column),
    });
    Ok(Found {
        layout,
        variant: match (tried.announced, csv) {
            (Some(_), _) => "pts",
            (None, true) => "csv",
            (None, false) => "xyz",
        },
        skip: offset(head, lines[start]),
        lines: start as u64,
        declared: tried.announced,
        width: bytes.div_ceil(lines.len() - start).max(4),
        reading: TableReading {
            separator: tried.dialect.0.name(),
            decimal_sign: char::from(tried.dialect.1),
            columns: taken.collect(),
            of: tried.width,
            header_line: header.map(|h| h.line as u64 + 1),
            lines_skipped: start as u64,
        },
        unit,
        warnings,
    })
}

/// The unit that the names of x, y, z give.
fn unit(
    header: Option<&Header>,
    columns: &[usize],
    asked: bool,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Unit>> {
    let Some(header) = header else { return Ok(None) };
    let names: Vec<_> = columns.iter().filter_map(|&i| header.names.get(i)).collect();
    let remarks = names.iter().filter(|n| matches!(n.unit, UnitWord::Remark(_)));
    warnings.extend(remarks.map(|n| Warning::NoUnit { name: n.text.clone() }));
    let unclear = |what: String| {
        let remedy = "say the unit of x, y, z by --units um, mm, cm, m or in";
        Fault::Unclear { what, remedy }.at_line(header.line as u64 + 1)
    };
    if let Some((name, unit)) = names.iter().find_map(|n| match &n.unit {
        UnitWord::Foreign(unit) => Some((&n.text, unit)),
        _ => None,
    }) && !asked
    {
        return Err(unclear(format!("the name \"{name}\" gives the unit {unit}, which is not understood")));
    }
    let units: Vec<Option<Unit>> =
        names.iter().map(|n| if let UnitWord::Unit(u) = n.unit { Some(u) } else { None }).collect();
    let first = units.first().copied().flatten();
    if units.iter().all(|u| *u == first) || asked {
        return Ok(first);
    }
    let all: Vec<&str> = names.iter().map(|n| n.text.as_str()).collect();
    Err(unclear(format!("the names {} give different units", all.join(", "))))
}

/// The unit that lines before the rows state for the whole file: `# Units: inch`, `Einheit = mm`, `% unit cm`.
fn stated(lines: &[&[u8]], asked: bool) -> Result<Option<Unit>> {
    let mut found: Option<Unit> = None;
    for (number, line) in lines.iter().enumerate() {
        let text = String::from_utf8_lossy(line).to_lowercase();
        let text = text.trim_start_matches(|c: char| !c.is_alphabetic());
        let Some(rest) = UNIT_WORDS.iter().find_map(|word| text.strip_prefix(word)) else { continue };
        let separated = rest.starts_with([':', '=', ',', ';', '\t', ' ', '(']);
        // The text in brackets names the quantity that has the unit.
        let rest = rest.trim_start();
        let rest = rest.strip_prefix('(').and_then(|r| r.split_once(')')).map_or(rest, |(_, rest)| rest);
        let marked = rest.trim_start().starts_with([':', '=']);
        let said = rest.trim_matches(|c: char| c.is_whitespace() || ":=,;.\"".contains(c));
        let unclear = |what: String| {
            let remedy = "say the unit of x, y, z by --units um, mm, cm, m or in";
            Err(Fault::Unclear { what, remedy }.at_line(number as u64 + 1))
        };
        match unit_of(said) {
            UnitWord::Unit(unit) if separated && found.is_none_or(|before| before == unit) => {
                found = Some(unit)
            }
            UnitWord::Unit(_) if separated && !asked => return unclear("two units are stated".into()),
            UnitWord::Foreign(word) if separated && !asked => {
                return unclear(format!("the unit {word} is not understood"));
            }
            // A factor before a unit, or a part of one.
            UnitWord::Remark(word) if marked && !asked && word.bytes().any(|b| b.is_ascii_digit()) => {
                return unclear(format!("the unit {word} is not understood"));
            }
            _ => {}
        }
    }
    Ok(found)
}

/// Words that state the unit of a whole file, the longer before those that they begin with.
const UNIT_WORDS: [&str; 8] =
    ["length units", "length unit", "units", "unit", "einheiten", "einheit", "unités", "единицы"];

/// Where in `head` a line cut from it begins.
fn offset(head: &[u8], line: &[u8]) -> usize {
    (line.as_ptr() as usize).saturating_sub(head.as_ptr() as usize)
}
