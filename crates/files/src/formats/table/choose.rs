//! Which columns are x, y, z: those asked for, those that the header names, or the first that hold numbers.

use super::{
    cell::{Class, Separator},
    header::{Axes, Header},
    tried::Tried,
};
use crate::{
    Column, Columns, Warning,
    error::{Fault, Located, Result},
    number::count,
};

/// Columns of x, y and perhaps z, counted from 0.
pub(super) struct Chosen {
    pub columns: Vec<usize>,
    /// The header's names are those of the columns; else it is prose.
    pub named: bool,
    pub warnings: Vec<Warning>,
}

impl Chosen {
    fn named(columns: Vec<usize>) -> Chosen {
        Chosen { columns, named: true, warnings: vec![] }
    }
}

/// The columns to take, or why that is not clear.
pub(super) fn columns(tried: &Tried, asked: Option<&Columns>) -> Result<Chosen> {
    if let Some(asked) = asked {
        return self::asked(asked, tried).map(Chosen::named);
    }
    let guessed = guessed(tried);
    let Some(header) = &tried.header else { return unnamed(tried, guessed) };
    match header.axes() {
        Axes::Named(named) => self::named(tried, header, named, guessed),
        Axes::Unnamed if guessed.len() < 2 => unnamed(tried, guessed),
        Axes::Unnamed if guessed.len() > 3 => {
            Err(unclear(tried, header, "name more than three columns of numbers, and none of them x"))
        }
        Axes::Unnamed => {
            let names = |i: &usize| header.names.get(*i).map(|n| n.text.clone()).unwrap_or_default();
            let warnings = vec![Warning::NamesUnknown { names: guessed.iter().map(names).collect() }];
            Ok(Chosen { columns: guessed, named: true, warnings })
        }
        // A profile of x and z has two coordinates in their order.
        Axes::Partly(found) => {
            let mut named = found.iter().flatten().copied();
            let rising = named.clone().is_sorted() && named.all(|i| guessed.contains(&i));
            if guessed.len() == 2 && found.iter().flatten().count() == 2 && rising {
                return Ok(Chosen::named(guessed));
            }
            Err(unclear(tried, header, "name some of x, y, z, but not x and y"))
        }
        Axes::Twice(axis) => Err(unclear(tried, header, &format!("name {axis} more than once"))),
    }
}

/// All columns but those that hold a word, or a mark for a missing one, in every row.
fn guessed(tried: &Tried) -> Vec<usize> {
    let words = |i: &usize| {
        tried.column(*i).all(|c| matches!(c, Class::Word | Class::Missing))
            && tried.column(*i).any(|c| c == Class::Word)
    };
    (0..tried.width).filter(|i| !words(i)).collect()
}

/// Columns that a header names are binding.
fn named(tried: &Tried, header: &Header, named: Vec<usize>, guessed: Vec<usize>) -> Result<Chosen> {
    let (names, cells) = (header.names.len(), tried.width);
    let longest = tried.rows.iter().map(|l| l.cells.len()).max().unwrap_or(cells);
    let even = names == cells || names <= longest && names >= tried.least_names();
    if !even {
        // A comment may be prose: "# the points x y z" over three columns, or "# x y z of the housing". It counts where
        // it may be names, and must not contradict the rows.
        let prose = header.comment && tried.dialect.0 == Separator::Blanks;
        if prose && named.iter().any(|i| *i >= cells) {
            return unnamed(tried, guessed);
        }
        let agrees = prose && named[..] == guessed[..named.len().min(guessed.len())];
        if !agrees || named.len() < guessed.len().min(3) {
            let what = format!("are {names}, but the rows have {cells} cells");
            return Err(unclear(tried, header, &what));
        }
    }
    if let [x, y] = named[..]
        && guessed.iter().any(|i| ![x, y].contains(i))
    {
        return Err(unclear(tried, header, "name x and y, and of further columns of numbers none z"));
    }
    Ok(Chosen::named(named))
}

/// The first columns of numbers where nobody names them.
fn unnamed(tried: &Tried, mut guessed: Vec<usize>) -> Result<Chosen> {
    let at = tried.rows.first().map_or(0, |l| l.index as u64 + 1);
    let fail = |what: &str, remedy: &'static str| -> Located {
        Fault::Unclear { what: what.into(), remedy }.at_line(at)
    };
    let by_number = "name the columns of x, y, z by --columns, for instance 1,2,3 or 2,3,4";
    if guessed.len() < 2 {
        return Err(fail(
            "rows of two or three numbers are expected, but there is one column of them",
            by_number,
        ));
    }
    if tried.dialect.0 == Separator::Byte(b',') && guessed.len() != 3 && all_plain(tried, &guessed) {
        let what = "its commas may separate columns or be decimal signs: no number has a decimal point";
        return Err(fail(what, by_number));
    }
    if tried.dialect.0 == Separator::Byte(b',') && guessed.windows(2).any(|w| grouped(tried, w[0], w[1])) {
        let what =
            "its commas may separate columns or thousands: three digits stand behind some in every row";
        return Err(fail(what, by_number));
    }
    if numbered_columns(tried, &guessed) {
        let what = "the first row counts the columns: it may be a header or a point";
        return Err(fail(what, "delete that row, or write its numbers with decimals as the others are"));
    }
    let mut warnings = vec![];
    if guessed.len() > 2 && counts_rows(tried, guessed[0]) {
        let others = all_plain(tried, &guessed[1..guessed.len().min(4)]);
        if others && guessed.len() > 3 || !others && guessed.len() == 3 {
            return Err(fail("the first column counts the rows: it may be x or a running number", by_number));
        }
        if guessed.len() > 3 {
            warnings.push(Warning::RunningNumber);
            guessed.remove(0);
        }
    }
    guessed.truncate(3);
    Ok(Chosen { columns: guessed, named: false, warnings })
}

/// Whether all cells of these columns are numbers of digits alone.
fn all_plain(tried: &Tried, columns: &[usize]) -> bool {
    let digits = |cell: &[u8]| {
        let cell = cell.strip_prefix(b"-").or_else(|| cell.strip_prefix(b"+")).unwrap_or(cell);
        cell.iter().all(u8::is_ascii_digit)
    };
    columns.iter().all(|&i| tried.texts(i).all(digits))
}

/// Whether the cells of two adjacent columns could be the halves of numbers with thousands separators. Then every row has up to
/// three digits, then three digits and perhaps decimals.
fn grouped(tried: &Tried, first: usize, second: usize) -> bool {
    let digits = |cell: &[u8]| cell.iter().take_while(|b| b.is_ascii_digit()).count();
    let high = |cell: &[u8]| {
        let cell = cell.strip_prefix(b"-").or_else(|| cell.strip_prefix(b"+")).unwrap_or(cell);
        digits(cell) == cell.len() && (1..=3).contains(&cell.len())
    };
    let low = |cell: &[u8]| digits(cell) == 3;
    second == first + 1 && tried.texts(first).all(high) && tried.texts(second).all(low)
}

/// Whether a column goes up by one from row to row, in digits alone.
fn counts_rows(tried: &Tried, column: usize) -> bool {
    let numbers: Option<Vec<u64>> = tried.texts(column).map(count).collect();
    let by_one = |n: Vec<u64>| n.len() > 2 && n.windows(2).all(|w| w[0].checked_add(1) == Some(w[1]));
    numbers.is_some_and(by_one)
}

/// Whether the first row is 0, 1, 2 … or 1, 2, 3 …, and all others have decimals: libraries write such headers.
fn numbered_columns(tried: &Tried, columns: &[usize]) -> bool {
    let first: Option<Vec<u64>> = columns.iter().map(|&i| count(tried.texts(i).next()?)).collect();
    let counts = first.is_some_and(|n| n[0] <= 1 && n.windows(2).all(|w| w[0] + 1 == w[1]));
    let decimal = |cell: &[u8]| cell.iter().any(|b| matches!(b, b'.' | b',' | b'e' | b'E'));
    counts && tried.texts(0).count() > 1 && columns.iter().all(|&i| tried.texts(i).skip(1).all(decimal))
}

fn unclear(tried: &Tried, header: &Header, what: &str) -> Located {
    const MAX_NAMES_SHOWN: usize = 12;
    let names: Vec<&str> = header.names.iter().map(|n| n.text.as_str()).take(MAX_NAMES_SHOWN).collect();
    let more = if header.names.len() > MAX_NAMES_SHOWN { ", …" } else { "" };
    let what = format!("the names of the columns ({}{more}) {what}", names.join(", "));
    let remedy = match tried.dialect.0 {
        Separator::Blanks => "name the columns of x, y, z by --columns, by number from 1",
        Separator::Byte(_) => "name the columns of x, y, z by --columns, by name or by number from 1",
    };
    Fault::Unclear { what, remedy }.at_line(header.line as u64 + 1)
}

/// The columns the user asks for.
fn asked(columns: &Columns, tried: &Tried) -> Result<Vec<usize>> {
    let names = tried.header.as_ref().map(|h| &h.names[..]).unwrap_or_default();
    let one = |is: &dyn Fn(&super::header::Name) -> bool| {
        let mut all = names.iter().enumerate().filter(|(_, n)| is(n));
        all.next().filter(|_| all.next().is_none()).map(|(i, _)| i)
    };
    let find = |c: &Column| match c {
        Column::Number(n) if *n <= tried.width => Ok(n - 1),
        Column::Number(n) => Err((n.to_string(), format!("{} columns", tried.width))),
        Column::Name(name) => {
            let name = name.to_lowercase();
            // By the name as it stands, else without its unit.
            let at = one(&|n| n.text.to_lowercase() == name).or_else(|| one(&|n| n.base == name));
            let there: Vec<&str> = names.iter().map(|n| n.text.as_str()).collect();
            let there = if there.is_empty() { "only columns without names".into() } else { there.join(", ") };
            at.ok_or((format!("\"{name}\""), there))
        }
    };
    let found: std::result::Result<Vec<usize>, (String, String)> = columns.0.iter().map(find).collect();
    let line = tried.header.as_ref().map_or(tried.start, |h| h.line) as u64 + 1;
    found.map_err(|(wanted, there)| Fault::NoColumn { wanted, there }.at_line(line))
}
