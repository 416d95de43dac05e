//! Cells of a row: where they begin and end, and what kind each is.

use crate::number::whole_number;

/// The separator of columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Separator {
    /// Any number of blanks and tabs. Every row has equally many cells: an empty one cannot be seen.
    Blanks,
    /// This byte once, blanks around it paid no heed to. Cells may be empty or quoted.
    Byte(u8),
}

impl Separator {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Separator::Blanks => "blanks",
            Separator::Byte(b';') => "semicolons",
            Separator::Byte(b'\t') => "tabs",
            Separator::Byte(_) => "commas",
        }
    }
    #[inline(always)]
    pub fn parts(self, byte: u8) -> bool {
        match self {
            Separator::Blanks => is_blank(byte),
            Separator::Byte(s) => byte == s,
        }
    }
}

#[inline(always)]
pub(super) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r')
}

/// The first place from `at` on that is no blank; a tab that separates is none.
#[inline(always)]
pub(super) fn skip_blanks(line: &[u8], mut at: usize, separator: Separator) -> usize {
    while let Some(&b) = line.get(at)
        && is_blank(b)
        && separator != Separator::Byte(b)
    {
        at += 1;
    }
    at
}

/// The end of a cell that begins at `at`. A quote at its start encloses separators; two of them within stand for one
/// (RFC 4180). `None` if it is not closed on this line.
pub(super) fn cell_end(line: &[u8], at: usize, separator: Separator) -> Option<usize> {
    let mut from = at;
    if line.get(at) == Some(&b'"') {
        loop {
            from += 2 + memchr::memchr(b'"', &line[from + 1..])?;
            if line.get(from) != Some(&b'"') {
                break;
            }
        }
    }
    let rest = &line[from..];
    Some(from + rest.iter().position(|b| separator.parts(*b)).unwrap_or(rest.len()))
}

/// The start of the cell after one that ends at `end`; `None` if it is the last. Blanks at the end of a line part nothing.
#[inline]
pub(super) fn next_cell(line: &[u8], end: usize, separator: Separator) -> Option<usize> {
    let next = skip_blanks(line, end, separator);
    match separator {
        Separator::Blanks => (next > end && next < line.len()).then_some(next),
        Separator::Byte(b) => (line.get(next) == Some(&b)).then(|| skip_blanks(line, next + 1, separator)),
    }
}

/// All cells of a line, their quotes and the blanks around them taken off. `None` if a quote is not closed.
pub(super) fn cells(line: &[u8], separator: Separator) -> Option<Vec<&[u8]>> {
    let mut cells = vec![];
    let mut at = skip_blanks(line, 0, separator);
    if separator == Separator::Blanks && at >= line.len() {
        return Some(cells);
    }
    loop {
        let end = cell_end(line, at, separator)?;
        cells.push(unquoted(&line[at..end]));
        match next_cell(line, end, separator) {
            Some(next) => at = next,
            None => return Some(cells),
        }
    }
}

/// How many cells there are, empty ones at the end not counted.
pub(super) fn filled(cells: &[&[u8]]) -> usize {
    cells.iter().rposition(|c| !c.is_empty()).map_or(0, |last| last + 1)
}

/// A cell without its quotes and the blanks around it.
pub(super) fn unquoted(cell: &[u8]) -> &[u8] {
    let cell = cell.trim_ascii();
    match cell {
        [b'"', inner @ .., b'"'] => inner.trim_ascii(),
        _ => cell,
    }
}

/// The number that a cell is.
pub(super) fn cell_number(cell: &[u8], point: u8) -> Option<f64> {
    // "1," is a number cut off, or followed by a comma that separates.
    let cut = point == b',' && cell.ends_with(b",");
    whole_number(cell, point).filter(|x| x.is_finite() && !cut)
}

/// The kind of content of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    Number,
    /// Nothing, or a mark that stands for no value.
    Missing,
    /// A name, a note, a date, a time.
    Word,
    /// Text that may have been meant as a number and is none, such as `1mm` or `1,234.5`.
    Unreadable,
}

/// Marks that stand for no value, lower case.
const MISSING_MARKS: [&str; 18] = [
    "-", "--", "\u{2212}", "\u{2013}", "\u{2014}", "?", "*", ".", "na", "n/a", "n.a.", "k.a.", "nan", "inf",
    "null", "none", "nil", "nv",
];

/// The kind of a cell, quotes and blanks around it taken off.
pub(super) fn class(cell: &[u8], point: u8) -> Class {
    if cell_number(cell, point).is_some() {
        return Class::Number;
    }
    let text = String::from_utf8_lossy(cell).to_lowercase();
    let bare = text.trim_start_matches(['+', '-']);
    if cell.is_empty() || cell.starts_with(b"#") || MISSING_MARKS.iter().any(|m| *m == text || *m == bare) {
        return Class::Missing;
    }
    let letter = text.chars().next().is_some_and(char::is_alphabetic);
    let digit = cell.iter().any(u8::is_ascii_digit);
    if letter || !digit || is_date(cell) { Class::Word } else { Class::Unreadable }
}

/// `2026-11-22`, `22/11/2026`, `12:30:15.2`, and a date with a time.
fn is_date(cell: &[u8]) -> bool {
    let plain =
        |b: &u8| b.is_ascii_digit() || matches!(b, b'-' | b'/' | b':' | b'.' | b' ' | b'T' | b'Z' | b'+');
    let count = |c: u8| cell.iter().filter(|b| **b == c).count();
    let starts = cell.first().is_some_and(u8::is_ascii_digit);
    starts && cell.iter().all(plain) && (count(b':') > 0 || count(b'-') == 2 || count(b'/') == 2)
}

/// Ctrl-Z, which ends texts of DOS.
pub(super) const END_MARK: u8 = 0x1a;

/// Words that end a text, lower case and letters alone.
const END_WORDS: [&str; 12] = [
    "end",
    "eof",
    "endoffile",
    "endofdata",
    "enddata",
    "endpoints",
    "ende",
    "dateiende",
    "fin",
    "fine",
    "\u{43a}\u{43e}\u{43d}\u{435}\u{446}",
    "\u{7ed3}\u{675f}",
];

/// Whether a line says nothing but that the text ends.
pub(super) fn is_end(line: &[u8]) -> bool {
    let text = String::from_utf8_lossy(line).to_lowercase();
    if text.chars().any(char::is_numeric) {
        return false;
    }
    let bare: String = text.chars().filter(|c| c.is_alphabetic()).collect();
    END_WORDS.contains(&bare.as_str()) || bare.is_empty() && line.contains(&END_MARK)
}

/// Blanks that are no ASCII: they stand within numbers with thousands separators as well as between numbers.
const WIDE_BLANKS: [char; 4] = ['\u{a0}', '\u{2007}', '\u{2009}', '\u{202f}'];

/// Fault and remedy of text that holds several numbers and nothing that parts them, or a number and blanks that are no
/// ASCII.
pub(super) fn run_together(text: &[u8]) -> Option<(&'static str, &'static str)> {
    let shown: String = match std::str::from_utf8(text) {
        Ok(text) => text.into(),
        // Latin-1.
        Err(_) => text.iter().map(|b| char::from(*b)).collect(),
    };
    let decimal = |part: &str| part.contains('.') && cell_number(part.as_bytes(), b'.').is_some();
    let parts: Vec<&str> = shown.split(WIDE_BLANKS).filter(|p| !p.trim().is_empty()).collect();
    if parts.len() > 1 && parts.iter().filter(|p| decimal(p.trim())).count() > 1 {
        return Some((
            "no-break spaces stand between the numbers",
            "replace them with blanks or export with semicolons",
        ));
    }
    let is_number = |part: &str| [b'.', b','].iter().any(|p| cell_number(part.as_bytes(), *p).is_some());
    if let [only] = parts[..]
        && shown.contains(WIDE_BLANKS)
        && is_number(only.trim())
    {
        return Some((
            "no-break spaces stand beside the number",
            "replace them with blanks or export with semicolons",
        ));
    }
    let number = shown.bytes().all(|b| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+'));
    // Between two points stand the decimals of one number and the next one's digits: more than the last one's decimals.
    let between: Vec<&str> = shown.split('.').skip(1).collect();
    let [inner @ .., last] = &between[..] else { return None };
    let longer = |part: &&str| part.len() > last.len() || part.contains(['-', '+']);
    let several = !inner.is_empty() && last.len() > 1 && inner.iter().all(longer);
    (number && several).then_some((
        "numbers of fixed width follow each other with nothing between",
        "export with blanks or semicolons between the columns",
    ))
}

/// Whether a line, blanks before it taken off, is a comment.
///
/// `#REF!,1,2` is none: it begins with a cell that a spreadsheet could not compute. Nor is `#ERR,1,2`: a word stands right
/// behind the mark, and all other cells hold numbers. Nor is `'1,5`: a spreadsheet's number kept as text.
pub(super) fn is_comment(line: &[u8], separator: Separator) -> bool {
    match line {
        [b'#', rest @ ..] => !is_error_cell(rest, separator),
        [b'\'', next, ..] => !matches!(next, b'0'..=b'9' | b'+' | b'-' | b'.' | b','),
        [b'%' | b'!' | b'\'', ..] | [b'/', b'/', ..] => true,
        [b';', ..] => separator != Separator::Byte(b';'),
        _ => false,
    }
}

/// Whether what stands behind `#` at the start of a line is the first cell of a row.
fn is_error_cell(rest: &[u8], separator: Separator) -> bool {
    let end = rest.iter().position(|b| is_blank(*b) || matches!(b, b';' | b',')).unwrap_or(rest.len());
    let (word, others) = rest.split_at(end);
    let upper =
        |b: &u8| b.is_ascii_uppercase() || b.is_ascii_digit() || matches!(b, b'/' | b'_') || !b.is_ascii();
    let known = matches!(word, b"N/A" | b"NV" | b"NA")
        || matches!(word, [name @ .., b'!' | b'?'] if !name.is_empty() && name.iter().all(upper));
    let Separator::Byte(_) = separator else { return known && !others.is_empty() };
    let numbers = || {
        let cells = cells(others, separator).unwrap_or_default();
        let number = |c: &&[u8]| cell_number(c, b'.').or(cell_number(c, b',')).is_some();
        cells.len() > 1 && cells.iter().skip(1).all(number)
    };
    known && !others.is_empty() || word.first().is_some_and(u8::is_ascii_alphabetic) && numbers()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_every_kind_of_line() {
        let semicolon = Separator::Byte(b';');
        let cases: [(&str, Separator, Option<&[&str]>); 10] = [
            ("1;2;3", semicolon, Some(&["1", "2", "3"])),
            (" 1 ; \" 2 \";;", semicolon, Some(&["1", "2", "", ""])),
            ("\"a;b\";\"say \"\"x\"\"\";3", semicolon, Some(&["a;b", "say \"\"x\"\"", "3"])),
            ("1;\"2;3", semicolon, None),
            ("", semicolon, Some(&[""])),
            ("\t2\t3", Separator::Byte(b'\t'), Some(&["", "2", "3"])),
            ("  1 \t 2  ", Separator::Blanks, Some(&["1", "2"])),
            (" \t ", Separator::Blanks, Some(&[])),
            ("\"a b\" 2", Separator::Blanks, Some(&["a b", "2"])),
            ("5\";6", semicolon, Some(&["5\"", "6"])),
        ];
        for (line, separator, want) in cases {
            let want: Option<Vec<&[u8]>> = want.map(|w| w.iter().map(|c| c.as_bytes()).collect());
            assert_eq!(cells(line.as_bytes(), separator), want, "{line}");
        }
    }

    #[test]
    fn kinds_of_cells() {
        let with = |class_wanted: Class, point: u8, all: &[&str]| {
            for cell in all {
                assert_eq!(class(cell.as_bytes(), point), class_wanted, "{cell}");
            }
        };
        with(Class::Number, b'.', &["1", "-1.5", "+.5", "1e-3", "2.5D+02", "\u{2212}3.5"]);
        with(Class::Number, b',', &["1", "-1,5", "+,5", "1,25E-3"]);
        with(
            Class::Missing,
            b'.',
            &["", "-", "NA", "n/a", "NaN", "-inf", "#REF!", "#DIV/0!", "\u{2212}", "null"],
        );
        with(
            Class::Word,
            b'.',
            &["P1", "point", "Höhe", "2026-11-22", "12:30:15", "FA(P1)=FEAT/POINT", "(a)"],
        );
        with(
            Class::Unreadable,
            b'.',
            &["1mm", "1,5", "1,234.5", "1 234", "1'234.5", "0x10", "1.2.3", "[1", "\u{2013}5"],
        );
        with(Class::Unreadable, b',', &["1.5", "1.234,5", "1,"]);
    }

    #[test]
    fn comments() {
        let comma = Separator::Byte(b',');
        for line in [
            "# 1,2,3",
            "#1,2,3",
            "#x,y,z",
            "#",
            "% 1 2 3",
            "! a",
            "// 1 2",
            "# offset,1,2",
            "' note",
            ";1,2,3",
        ] {
            assert!(is_comment(line.as_bytes(), comma), "{line}");
        }
        for line in
            ["#REF!,1,2", "#N/A,1,2", "#DIV/0!,1,2", "#BEZUG!,1,2", "#ERR,1,2", "'1,2,3", "'-1,2,3", "1,2,3"]
        {
            assert!(!is_comment(line.as_bytes(), comma), "{line}");
        }
        assert!(!is_comment(b";1,5;2,5", Separator::Byte(b';')));
        assert!(!is_comment(b"#REF! 1 2", Separator::Blanks) && is_comment(b"#scan 1 2", Separator::Blanks));
    }
}
