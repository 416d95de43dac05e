//! How a table is written, found out from its first lines.
//!
//! Every way of writing that is in use is tried on the first lines; the one that finds numbers in the most lines is
//! taken, and among equals the earlier in the list.

use super::{
    header,
    row::{Layout, Separator, is_comment},
};
use crate::{
    Column, Columns, Warning,
    error::{Fault, Result},
    lines::{Lines, line_end},
    number::{count, whole_number},
    source::HEAD,
};

/// What the first lines say.
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
    pub warnings: Vec<Warning>,
}

/// Lines looked at.
const SAMPLE: usize = 400;
/// Columns that can be told apart.
const COLUMNS: usize = 64;

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

/// Looks at the first lines of a file.
pub(super) fn detect(head: &[u8], columns: Option<&Columns>) -> Result<Found> {
    let lines = sample(head);
    let tried = DIALECTS.iter().map(|d| Tried::new(*d, &lines));
    // The later of equals would win: so from the end.
    let best = tried.rev().max_by_key(|t| t.rank());
    match best {
        Some(best) if !best.rows.is_empty() => best.found(head, &lines, columns),
        _ => Err(first_line_fault(&lines)),
    }
}

/// The first lines, without one that the end of the sample cuts.
fn sample(head: &[u8]) -> Vec<&[u8]> {
    let mut lines: Vec<&[u8]> = Lines::new(head).take(SAMPLE).collect();
    let cut = head.len() >= HEAD && lines.len() < SAMPLE;
    if cut && lines.len() > 1 {
        lines.pop();
    }
    lines
}

fn first_line_fault(lines: &[&[u8]]) -> crate::error::Located {
    let said = lines
        .iter()
        .position(|l| !l.trim_ascii().is_empty() && !is_comment(l.trim_ascii(), Separator::Blanks));
    match said {
        Some(i) => Fault::unexpected("rows of two or three numbers", lines[i]).at_line(i as u64 + 1),
        None => {
            Fault::Unexpected { expected: "rows of two or three numbers".into(), found: "no rows".into() }
                .into()
        }
    }
}

/// One way of writing, tried on the sample.
struct Tried {
    dialect: (Separator, u8),
    /// Lines that are rows, and for each of them the set of columns that are numbers, and how many columns it has.
    rows: Vec<(usize, u64, usize)>,
    /// Two or three.
    least: u32,
}

impl Tried {
    fn new(dialect: (Separator, u8), lines: &[&[u8]]) -> Tried {
        let numeric = |line: &&[u8]| {
            let words = Layout::words(dialect.0, line);
            let set =
                words.iter().take(COLUMNS).enumerate().filter(|(_, w)| whole_number(w, dialect.1).is_some());
            (set.fold(0u64, |m, (i, _)| m | 1 << i), words.len())
        };
        let all: Vec<(usize, u64, usize)> = lines
            .iter()
            .enumerate()
            .filter(|(_, l)| !is_comment(l.trim_ascii(), dialect.0))
            .map(|(i, l)| {
                let (set, n) = numeric(l);
                (i, set, n)
            })
            .collect();
        let rows = |least: u32| all.iter().copied().filter(|r| r.1.count_ones() >= least).collect::<Vec<_>>();
        let (three, two) = (rows(3), rows(2));
        // A few rows of three among many of two are not what the table is about.
        if 2 * three.len() > two.len() {
            Tried { dialect, rows: three, least: 3 }
        } else {
            Tried { dialect, rows: two, least: 2 }
        }
    }

    /// More rows are better; then three columns of numbers; then numbers only.
    fn rank(&self) -> (usize, u32, bool) {
        let pure = self.rows.iter().all(|(_, set, n)| set.count_ones() as usize == *n);
        (self.rows.len() * (self.least as usize - 1), self.least, pure && self.least == 2)
    }

    fn found(&self, head: &[u8], lines: &[&[u8]], columns: Option<&Columns>) -> Result<Found> {
        let (separator, point) = self.dialect;
        let (start, first_set, width) = self.rows[0];
        let common = self.rows.iter().fold(u64::MAX, |m, r| m & r.1);
        // Where rows disagree, the first decides, and the others will be refused with their lines.
        let set = if common.count_ones() >= self.least { common } else { first_set };
        let numeric: Vec<usize> = (0..COLUMNS).filter(|i| set >> i & 1 == 1).collect();
        let declared = self.announced(lines, start);
        let names = self.names(lines, start, width);
        let mut warnings = vec![];
        let wanted = match columns {
            Some(columns) => chosen(columns, &names, width)?,
            None => self.guess(lines, &numeric, &names, &mut warnings),
        };
        let mut layout = Layout::of(separator, point, line_end(head), &wanted);
        layout.announced = declared.is_some();
        let skip = if start == 0 { offset(head, lines[0]) } else { offset(head, lines[start]) };
        let csv = matches!(separator, Separator::Byte(_));
        let rows: usize = lines[start..].iter().map(|l| l.len() + 1).sum();
        Ok(Found {
            layout,
            variant: if declared.is_some() {
                "pts"
            } else if csv {
                "csv"
            } else {
                "xyz"
            },
            skip,
            lines: start as u64,
            declared,
            width: rows.div_ceil(lines.len() - start).max(4),
            warnings,
        })
    }

    /// The number that stands alone on the line before the rows.
    fn announced(&self, lines: &[&[u8]], start: usize) -> Option<u64> {
        let said = |l: &&&[u8]| !l.trim_ascii().is_empty() && !is_comment(l.trim_ascii(), self.dialect.0);
        let mut before = lines[..start].iter().filter(said);
        let only = before.next()?;
        if before.next().is_some() { None } else { count(only.trim_ascii()) }
    }

    /// Names of the columns from the last line before the rows, if it has as many words as they.
    fn names(&self, lines: &[&[u8]], start: usize, width: usize) -> Vec<String> {
        let last = lines[..start].iter().rev().find(|l| !l.trim_ascii().is_empty());
        let names = last.map(|l| header::names(l, self.dialect.0)).unwrap_or_default();
        if names.len() >= width.min(2) && names.iter().all(|n| n.parse::<f64>().is_err()) {
            names
        } else {
            vec![]
        }
    }

    /// The columns of the coordinates, when nobody names them.
    fn guess(
        &self,
        lines: &[&[u8]],
        numeric: &[usize],
        names: &[String],
        warnings: &mut Vec<Warning>,
    ) -> Vec<usize> {
        let named = header::coordinates(names).filter(|c| c.iter().all(|i| numeric.contains(i)));
        if let Some(named) = named.filter(|c| c.len() == 3 || numeric.len() == 2) {
            return named;
        }
        let mut free = numeric;
        if free.len() > 3 && self.counts_rows(lines) {
            warnings.push(Warning::RunningNumber);
            free = &free[1..];
        } else if free.len() > 3 && !names.is_empty() {
            warnings.push(Warning::ColumnsGuessed {
                taken: [free[0] + 1, free[1] + 1, free[2] + 1],
                of: free.len(),
            });
        }
        let no_point = || self.rows.iter().all(|(i, ..)| memchr::memchr(b'.', lines[*i]).is_none());
        if self.dialect.0 == Separator::Byte(b',')
            && free.len() > 3
            && free.len().is_multiple_of(2)
            && no_point()
        {
            warnings.push(Warning::PerhapsDecimalCommas);
        }
        free[..free.len().min(self.least as usize)].to_vec()
    }

    /// Whether the first column goes up by one from row to row.
    fn counts_rows(&self, lines: &[&[u8]]) -> bool {
        let first = |i: usize| count(Layout::words(self.dialect.0, lines[i]).first()?);
        let mut pairs = self.rows.windows(2).map(|w| (first(w[0].0), first(w[1].0)));
        self.rows.len() > 2
            && pairs.all(|(a, b)| matches!((a, b), (Some(a), Some(b)) if a.checked_add(1) == Some(b)))
    }
}

/// The columns the user asks for, counted from 0.
fn chosen(columns: &Columns, names: &[String], width: usize) -> Result<Vec<usize>> {
    let find = |c: &Column| match c {
        Column::Number(n) if *n <= width => Ok(n - 1),
        Column::Number(n) => Err((n.to_string(), format!("{width} columns"))),
        Column::Name(name) => {
            let at = names.iter().position(|n| *n == name.to_lowercase());
            let there = if names.is_empty() { "no names".into() } else { names.join(", ") };
            at.ok_or((format!("\"{name}\""), there))
        }
    };
    let found: std::result::Result<Vec<usize>, (String, String)> = columns.0.iter().map(find).collect();
    found.map_err(|(wanted, there)| Fault::NoColumn { wanted, there }.at_line(1))
}

/// Where in `head` a line cut from it begins.
fn offset(head: &[u8], line: &[u8]) -> usize {
    (line.as_ptr() as usize).saturating_sub(head.as_ptr() as usize)
}
