//! Tables of text (RFC 4180).

use std::borrow::Cow;
use std::fmt::Display;
use std::io::Write;

/// The end of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineEnd {
    /// A line feed.
    Lf,
    /// Carriage return and line feed, as RFC 4180 has it.
    CrLf,
}

/// Rows of cells, one cell after the other, at the end of a text.
///
/// Text stands in quotes where it holds a separator. Text that a spreadsheet would run as a formula, and is no number, begins with an
/// apostrophe. Names come from plans and files of others.
pub struct Csv<'a> {
    out: &'a mut Vec<u8>,
    line_end: LineEnd,
    row_begun: bool,
}

impl<'a> Csv<'a> {
    /// A table, or rows of one, at the end of `out`.
    pub fn at_end_of(out: &'a mut Vec<u8>, line_end: LineEnd) -> Csv<'a> {
        Csv { out, line_end, row_begun: false }
    }

    /// A cell of text.
    pub fn text(&mut self, text: &str) -> &mut Self {
        let text = guarded(text);
        let cell = self.cell();
        match text.contains([',', '"', '\r', '\n']) {
            true => cell.extend(format!("\"{}\"", text.replace('"', "\"\"")).as_bytes()),
            false => cell.extend(text.as_bytes()),
        }
        self
    }

    /// A cell of a number, as it displays itself.
    pub fn number(&mut self, number: impl Display) -> &mut Self {
        // Writing to memory cannot fail.
        let _ = write!(self.cell(), "{number}");
        self
    }

    /// A cell of a number, empty where there is none.
    pub fn optional(&mut self, number: Option<impl Display>) -> &mut Self {
        match number {
            Some(number) => self.number(number),
            None => self.text(""),
        }
    }

    /// Ends the row.
    pub fn end_row(&mut self) {
        self.out.extend(match self.line_end {
            LineEnd::Lf => &b"\n"[..],
            LineEnd::CrLf => b"\r\n",
        });
        self.row_begun = false;
    }

    /// A whole row of texts.
    pub fn row(&mut self, texts: impl IntoIterator<Item = impl AsRef<str>>) {
        for text in texts {
            self.text(text.as_ref());
        }
        self.end_row();
    }

    /// Where the next cell is written.
    pub(crate) fn cell(&mut self) -> &mut Vec<u8> {
        if self.row_begun {
            self.out.push(b',');
        }
        self.row_begun = true;
        self.out
    }
}

/// The text, with an apostrophe before a formula.
fn guarded(text: &str) -> Cow<'_, str> {
    let runs = text.starts_with(['=', '+', '-', '@']) && text.parse::<f64>().is_err();
    if runs { format!("'{text}").into() } else { text.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(text: &str) -> String {
        let mut out = vec![];
        Csv::at_end_of(&mut out, LineEnd::Lf).text(text);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn no_text_breaks_out_of_its_cell_or_runs() {
        assert_eq!(cell("a,\"b\"\n"), "\"a,\"\"b\"\"\n\"");
        for (text, written) in [
            ("=A1", "'=A1"),
            ("-x", "'-x"),
            ("-1.5e-7", "-1.5e-7"),
            ("=A,1", "\"'=A,1\""),
            ("A-B", "A-B"),
            ("", ""),
        ] {
            assert_eq!(cell(text), written);
        }
    }

    #[test]
    fn cells_and_rows() {
        let mut out = b"# head\n".to_vec();
        let mut csv = Csv::at_end_of(&mut out, LineEnd::CrLf);
        csv.row(["", "b", "c"]);
        csv.number(-1.5).optional(None::<f64>).optional(Some(1e-7)).end_row();
        csv.end_row();
        assert_eq!(String::from_utf8(out).unwrap(), "# head\n,b,c\r\n-1.5,,0.0000001\r\n\r\n");
    }
}
