//! Instances of a STEP file (ISO 10303-21) as they stand in its text, and the parameters within them.

use crate::error::{Fault, Result};
use crate::lines::line_of;
use crate::number::{integer, whole_number};
use std::collections::BTreeMap;

/// A parameter of an entity.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    /// `#12`
    Instance(u64),
    Integer(i64),
    Real(f64),
    /// `.T.`, without the points.
    Word(Vec<u8>),
    /// Text, with its quotes taken off; doubled quotes and codes are left as they are.
    Text(Vec<u8>),
    List(Vec<Value>),
    /// `LENGTH_MEASURE(25.4)`
    Typed(Vec<Value>),
    /// `$` or `*`
    Nothing,
}

/// An entity: its keyword and parameters. A complex instance has several.
pub(super) type Record = (Vec<u8>, Vec<Value>);

/// The data sections of a file.
pub(super) struct Instances<'a> {
    text: &'a [u8],
    /// For each number, where the text behind its `=` begins and ends.
    places: BTreeMap<u64, (usize, usize)>,
}

/// Lists may lie within lists to this depth.
const MAX_LIST_DEPTH: usize = 32;

impl<'a> Instances<'a> {
    /// Finds all instances of `text`.
    pub(super) fn of(text: &'a [u8]) -> Result<Instances<'a>> {
        let mut found = Instances { text, places: BTreeMap::new() };
        let (mut at, mut data) = (0, false);
        loop {
            at = skip(text, at);
            if at >= text.len() {
                let what = "the line END-ISO-10303-21 at the end";
                return Err(found.wrong(text.len(), what, b""));
            }
            let end = found.statement(at)?;
            let statement = text[at..end].trim_ascii_end();
            match statement {
                b"DATA" => data = true,
                b"ENDSEC" => data = false,
                b"END-ISO-10303-21" => return Ok(found),
                _ if statement.starts_with(b"DATA") && !data => data = true,
                _ if data => found.instance(at, end)?,
                _ => {}
            }
            at = end + 1;
        }
    }

    /// The end of the statement that begins at `from`: its semicolon.
    fn statement(&self, from: usize) -> Result<usize> {
        let mut at = from;
        while at < self.text.len() {
            match self.text[at] {
                b';' => return Ok(at),
                b'\'' => at = self.behind_text(at)?,
                b'/' if self.text[at..].starts_with(b"/*") => at = skip(self.text, at),
                _ => at += 1,
            }
        }
        Err(self.wrong(from, "a statement that ends with a semicolon", &self.text[from..]))
    }

    /// The place behind the text in quotes that begins here.
    fn behind_text(&self, from: usize) -> Result<usize> {
        memchr::memchr(b'\'', &self.text[from + 1..])
            .map(|n| from + n + 2)
            .ok_or_else(|| self.wrong(from, "text that ends with a quote", &self.text[from..]))
    }

    fn instance(&mut self, from: usize, end: usize) -> Result<()> {
        let statement = &self.text[from..end];
        let behind = statement.strip_prefix(b"#").unwrap_or_default();
        let digits = behind.iter().take_while(|b| b.is_ascii_digit()).count();
        let number = crate::number::count(&behind[..digits]);
        let equals = skip(self.text, from + 1 + digits);
        let (Some(number), Some(b'=')) = (number, self.text.get(equals).filter(|_| equals < end)) else {
            return Err(self.wrong(from, "an instance such as #12=POINT(…);", statement));
        };
        if self.places.insert(number, (equals + 1, end)).is_some() {
            return Err(self.wrong(from, "each instance once", format!("#{number} again").as_bytes()));
        }
        Ok(())
    }

    /// The line of an instance, for messages.
    pub(super) fn line(&self, number: u64) -> u64 {
        line_of(self.text, self.places.get(&number).map_or(0, |p| p.0))
    }
    /// A fault of an instance.
    pub(super) fn fault(&self, number: u64, fault: Fault) -> crate::error::Located {
        fault.at_line(self.line(number))
    }
    fn wrong(&self, at: usize, expected: &'static str, found: &[u8]) -> crate::error::Located {
        Fault::unexpected(expected, found).at_line(line_of(self.text, at))
    }

    /// Whether there is an instance of this number.
    pub(super) fn has(&self, number: u64) -> bool {
        self.places.contains_key(&number)
    }
    /// Numbers of all instances.
    pub(super) fn numbers(&self) -> impl Iterator<Item = u64> + '_ {
        self.places.keys().copied()
    }

    /// Whether the text of an instance has this keyword in it, not reading further.
    pub(super) fn mentions(&self, number: u64, keyword: &[u8]) -> bool {
        self.places
            .get(&number)
            .is_some_and(|(from, end)| memchr::memmem::find(&self.text[*from..*end], keyword).is_some())
    }

    /// The entities of an instance: one, or those of a complex one.
    pub(super) fn records(&self, number: u64) -> Result<Vec<Record>> {
        let Some((from, end)) = self.places.get(&number).copied() else {
            return Err(
                Fault::unexpected("an instance that is there", format!("#{number}").as_bytes()).into()
            );
        };
        let mut reader = Reader { of: self, at: skip(self.text, from), end };
        if reader.peek() != Some(b'(') {
            return Ok(vec![reader.record()?]);
        }
        reader.at += 1;
        let mut all = vec![];
        loop {
            reader.blank();
            if reader.peek() == Some(b')') {
                return Ok(all);
            }
            all.push(reader.record()?);
        }
    }

    /// The parameters of an instance that is this simple entity.
    pub(super) fn simple(&self, number: u64, keyword: &'static str) -> Result<Vec<Value>> {
        let mut records = self.records(number)?;
        match records.pop() {
            Some((name, parameters)) if records.is_empty() && name == keyword.as_bytes() => Ok(parameters),
            other => {
                let name = other.map_or(vec![], |o| o.0);
                Err(self.fault(number, Fault::unexpected(keyword, &name)))
            }
        }
    }
}

/// Passes over white space and comments.
fn skip(text: &[u8], mut at: usize) -> usize {
    loop {
        while text.get(at).is_some_and(u8::is_ascii_whitespace) {
            at += 1;
        }
        if !text[at.min(text.len())..].starts_with(b"/*") {
            return at;
        }
        at = memchr::memmem::find(&text[at + 2..], b"*/").map_or(text.len(), |n| at + n + 4);
    }
}

/// A place within an instance.
struct Reader<'a> {
    of: &'a Instances<'a>,
    at: usize,
    end: usize,
}

impl Reader<'_> {
    fn peek(&self) -> Option<u8> {
        self.of.text.get(self.at).copied().filter(|_| self.at < self.end)
    }
    fn blank(&mut self) {
        self.at = skip(self.of.text, self.at).min(self.end);
    }
    fn wrong(&self, expected: &'static str) -> crate::error::Located {
        self.of.wrong(self.at, expected, &self.of.text[self.at.min(self.end)..self.end])
    }
    /// The bytes from here that are of a kind.
    fn take_while(&mut self, of: impl Fn(u8) -> bool) -> &[u8] {
        let from = self.at;
        while self.peek().is_some_and(&of) {
            self.at += 1;
        }
        &self.of.text[from..self.at]
    }

    fn record(&mut self) -> Result<Record> {
        let name =
            self.take_while(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'!')).to_ascii_uppercase();
        self.blank();
        if name.is_empty() || self.peek() != Some(b'(') {
            return Err(self.wrong("an entity with its parameters in brackets"));
        }
        Ok((name, self.list(0)?))
    }

    /// The values between the bracket here and the one that closes it.
    fn list(&mut self, depth: usize) -> Result<Vec<Value>> {
        if depth > MAX_LIST_DEPTH {
            return Err(self.wrong("fewer lists within lists"));
        }
        self.at += 1;
        let mut all = vec![];
        self.blank();
        if self.peek() == Some(b')') {
            self.at += 1;
            return Ok(all);
        }
        loop {
            self.blank();
            all.push(self.value(depth)?);
            self.blank();
            let next = self.peek();
            self.at += 1;
            match next {
                Some(b',') => {}
                Some(b')') => return Ok(all),
                _ => {
                    self.at -= 1;
                    return Err(self.wrong("a comma or a closing bracket"));
                }
            }
        }
    }

    fn value(&mut self, depth: usize) -> Result<Value> {
        match self.peek() {
            Some(b'(') => Ok(Value::List(self.list(depth + 1)?)),
            Some(b'$' | b'*') => {
                self.at += 1;
                Ok(Value::Nothing)
            }
            Some(b'#') => {
                self.at += 1;
                let number = crate::number::count(self.take_while(|b| b.is_ascii_digit()));
                number.map(Value::Instance).ok_or_else(|| self.wrong("the number of an instance"))
            }
            Some(b'\'') => {
                let from = self.at + 1;
                // Doubled quotes within end one text and begin another.
                while self.peek() == Some(b'\'') {
                    self.at = self.of.behind_text(self.at)?;
                }
                Ok(Value::Text(self.of.text[from.min(self.at - 1)..self.at - 1].to_vec()))
            }
            Some(b'.') => {
                self.at += 1;
                let word = self.take_while(|b| b.is_ascii_alphanumeric() || b == b'_').to_ascii_uppercase();
                if self.peek() != Some(b'.') {
                    return Err(self.wrong("a word between points, as .T."));
                }
                self.at += 1;
                Ok(Value::Word(word))
            }
            Some(b'"') => {
                self.at += 1;
                self.take_while(|b| b != b'"');
                self.at += 1;
                Ok(Value::Nothing)
            }
            Some(b) if b.is_ascii_alphabetic() || b == b'!' => Ok(Value::Typed(self.record_at(depth)?)),
            _ => self.number(),
        }
    }

    fn record_at(&mut self, depth: usize) -> Result<Vec<Value>> {
        self.take_while(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'!'));
        self.blank();
        match self.peek() {
            Some(b'(') => self.list(depth + 1),
            _ => Err(self.wrong("a value in brackets")),
        }
    }

    fn number(&mut self) -> Result<Value> {
        let from = self.at;
        let word = self.take_while(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'e' | b'E'));
        let value = match integer(word) {
            Some(n) => Some(Value::Integer(n)),
            None => whole_number(word, b'.').map(Value::Real),
        };
        value.ok_or_else(|| {
            self.at = from;
            self.wrong("a value")
        })
    }
}
