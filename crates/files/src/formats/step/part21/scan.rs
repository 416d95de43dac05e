//! One pass over the text.
//!
//! Every byte is looked at a bounded number of times: after a fault reading goes on at the next place that looks like the start of
//! an entity, and never goes back. A text in quotes that reaches such a start at the beginning of a line has lost its quote.

use super::file::{Broken, File, Place, RawRecord};
use super::lines::Lines;
use super::value::{Run, Value};
use crate::number::{count, integer, whole_number};
use std::collections::HashMap;
use trueness_geom::progress::{Cancelled, Progress};

/// Lists within lists at most.
const MAX_DEPTH: usize = 32;
/// Entities between two questions whether to go on.
const STEP: usize = 1 << 12;
/// The last line.
const END: &[u8] = b"END-ISO-10303-21";

/// Why an entity cannot be parsed.
type Reason = &'static str;

/// Finds and parses all entities of a text.
pub(in super::super) fn parse<'t>(text: &'t [u8], progress: &dyn Progress) -> Result<File<'t>, Cancelled> {
    let file = File {
        lines: Lines::new(text),
        values: vec![],
        records: vec![],
        places: vec![],
        keywords: vec![],
        broken: vec![],
        is_whole: false,
    };
    let mut scanner = Scanner {
        text,
        at: 0,
        file,
        keywords: HashMap::new(),
        pending: vec![],
        open: vec![],
        comments_end: text.len(),
    };
    let mut steps = 0usize;
    while scanner.statement() {
        steps += 1;
        if steps.is_multiple_of(STEP) && progress.cancelled() {
            return Err(Cancelled);
        }
    }
    Ok(scanner.file.sorted())
}

struct Scanner<'t> {
    text: &'t [u8],
    at: usize,
    file: File<'t>,
    keywords: HashMap<Vec<u8>, u32>,
    /// Values of the lists that are open.
    pending: Vec<Value<'t>>,
    /// Of each open list where its values begin, and whether a keyword stands before its bracket.
    open: Vec<(usize, bool)>,
    /// Behind this place no comment ends.
    comments_end: usize,
}

impl<'t> Scanner<'t> {
    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn rest(&self) -> &'t [u8] {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// The bytes from here that are of a kind.
    fn take(&mut self, of: impl Fn(u8) -> bool) -> &'t [u8] {
        let rest = self.rest();
        let length = rest.iter().position(|b| !of(*b)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// Passes over white space, comments and marks of printing.
    fn skip(&mut self) {
        loop {
            self.take(|b| b.is_ascii_whitespace());
            let rest = self.rest();
            if rest.starts_with(b"/*") && self.at < self.comments_end {
                match memchr::memmem::find(&rest[2..], b"*/") {
                    Some(n) => self.at += n + 4,
                    None => self.comments_end = self.at,
                }
            } else if rest.starts_with(b"\\N\\") || rest.starts_with(b"\\F\\") {
                self.at += 3;
            } else {
                return;
            }
        }
    }

    /// Reads the next statement; false at the end.
    fn statement(&mut self) -> bool {
        self.skip();
        match self.peek() {
            None => return false,
            Some(b'#') => self.entity(),
            Some(_) if self.rest().get(..END.len()).is_some_and(|w| w.eq_ignore_ascii_case(END)) => {
                self.file.is_whole = true;
                return false;
            }
            Some(_) => self.other(),
        }
        true
    }

    /// Passes over a statement that is no entity: those of the header, marks of sections.
    fn other(&mut self) {
        let from = self.at;
        while let Some(byte) = self.peek() {
            match byte {
                b';' => {
                    self.at += 1;
                    return;
                }
                b'\'' => {
                    // Without its end it reaches to the next entity, or there is no other text.
                    if self.quoted().is_err() {
                        self.at += usize::from(self.peek() == Some(b'\''));
                        return;
                    }
                }
                b'#' if self.at > from && starts_entity(self.rest()) => return,
                b'/' => {
                    self.skip();
                    self.at += usize::from(self.peek() == Some(b'/'));
                }
                _ => self.at += 1,
            }
        }
    }

    fn entity(&mut self) {
        let from = self.at;
        let marks = [self.file.values.len(), self.file.records.len()];
        self.at += 1;
        let number = count(self.take(|b| b.is_ascii_digit()));
        match (self.records(), number) {
            (Ok(()), Some(number)) if number < u64::MAX => {
                let count = (self.file.records.len() - marks[1]) as u32;
                let records = Run { from: marks[1] as u32, count };
                self.file.places.push(Place { number, at: from, records });
            }
            (read, _) => {
                let reason = read.err().unwrap_or("has a number beyond 64 bits");
                let keyword = self.file.records.get(marks[1]).map(|r| r.keyword);
                let number = number.unwrap_or(u64::MAX);
                self.file.broken.push(Broken { number, at: from, keyword, reason });
                self.file.values.truncate(marks[0]);
                self.file.records.truncate(marks[1]);
                self.pending.clear();
                self.open.clear();
                if read.is_err() {
                    self.recover();
                }
            }
        }
    }

    /// What stands behind the number of an entity.
    fn records(&mut self) -> Result<(), Reason> {
        self.skip();
        self.expect(b'=', "has no = behind its number")?;
        self.skip();
        if self.peek() == Some(b'(') {
            self.at += 1;
            self.skip();
            while self.peek() != Some(b')') {
                self.record()?;
                self.skip();
            }
            self.at += 1;
        } else {
            self.record()?;
        }
        self.skip();
        self.expect(b';', "does not end with a semicolon")
    }

    fn expect(&mut self, byte: u8, otherwise: Reason) -> Result<(), Reason> {
        match self.peek() {
            Some(found) if found == byte => {
                self.at += 1;
                Ok(())
            }
            Some(_) => Err(otherwise),
            None => Err("is cut short by the end of the file"),
        }
    }

    fn record(&mut self) -> Result<(), Reason> {
        let word = self.take(is_keyword);
        if word.is_empty() {
            return Err("has no keyword, or what is not read stands in its place");
        }
        let keyword = self.keyword(word);
        let index = self.file.records.len();
        // Known to those that tell of a broken entity.
        self.file.records.push(RawRecord { keyword, values: Run::default() });
        self.skip();
        if self.peek() != Some(b'(') {
            return Err("has no parameters in brackets");
        }
        let values = self.list()?;
        self.file.records[index].values = values;
        u32::try_from(self.file.records.len()).map(drop).map_err(|_| "is beyond what can be numbered")
    }

    fn keyword(&mut self, word: &[u8]) -> u32 {
        let upper = word.to_ascii_uppercase();
        if let Some(known) = self.keywords.get(&upper) {
            return *known;
        }
        let index = self.file.keywords.len() as u32;
        self.file.keywords.push(String::from_utf8_lossy(&upper).into_owned());
        self.keywords.insert(upper, index);
        index
    }

    /// The values between the bracket here and the one that closes it.
    fn list(&mut self) -> Result<Run, Reason> {
        self.begin_list(false)?;
        loop {
            self.skip();
            let opened = match self.peek() {
                Some(b')')
                    if self.pending.len() == self.open.last().map_or(0, |o| o.0 + usize::from(o.1)) =>
                {
                    false
                }
                Some(b'(') => {
                    self.begin_list(false)?;
                    true
                }
                Some(b) if is_keyword(b) && !b.is_ascii_digit() => {
                    let word = self.take(is_keyword);
                    self.skip();
                    if self.peek() != Some(b'(') {
                        return Err("has a word without brackets as a parameter");
                    }
                    self.begin_list(true)?;
                    self.pending.push(Value::Word(word));
                    true
                }
                _ => {
                    let value = self.value()?;
                    self.pending.push(value);
                    false
                }
            };
            if !opened && let Some(all) = self.end_lists()? {
                return Ok(all);
            }
        }
    }

    fn begin_list(&mut self, typed: bool) -> Result<(), Reason> {
        if self.open.len() >= MAX_DEPTH {
            return Err("has lists within lists beyond what is read");
        }
        self.at += 1;
        self.open.push((self.pending.len(), typed));
        Ok(())
    }

    /// After a value: the comma before the next one, or the ends of lists; the values of the outermost at its end.
    fn end_lists(&mut self) -> Result<Option<Run>, Reason> {
        loop {
            self.skip();
            match self.peek() {
                Some(b',') => {
                    self.at += 1;
                    return Ok(None);
                }
                Some(b')') => self.at += 1,
                Some(_) => return Err("has neither comma nor closing bracket behind a parameter"),
                None => return Err("is cut short by the end of the file"),
            }
            let Some((start, typed)) = self.open.pop() else { return Err("has a bracket too many") };
            let from = self.file.values.len();
            self.file.values.extend(self.pending.drain(start..));
            let sizes = (u32::try_from(from), u32::try_from(self.file.values.len() - from));
            let (Ok(from), Ok(count)) = sizes else { return Err("is beyond what can be numbered") };
            let run = Run { from, count };
            if self.open.is_empty() {
                return Ok(Some(run));
            }
            self.pending.push(if typed { Value::Typed(run) } else { Value::List(run) });
        }
    }

    /// A value that is no list.
    fn value(&mut self) -> Result<Value<'t>, Reason> {
        match self.peek() {
            Some(b'$' | b'*') => {
                self.at += 1;
                Ok(Value::Nothing)
            }
            Some(b'#') => {
                self.at += 1;
                match self.take(|b| b.is_ascii_digit()) {
                    [] => Err("has a # without a number"),
                    digits => Ok(Value::Reference(count(digits).unwrap_or(u64::MAX))),
                }
            }
            Some(b'\'') => self.quoted().map(Value::Text),
            Some(b'.') if !self.text.get(self.at + 1).is_some_and(u8::is_ascii_digit) => {
                self.at += 1;
                let word = self.take(|b| b.is_ascii_alphanumeric() || b == b'_');
                self.expect(b'.', "has a word that does not end with a point")?;
                Ok(Value::Word(word))
            }
            Some(b'"') => {
                self.at += 1;
                self.take(|b| b.is_ascii_hexdigit());
                self.expect(b'"', "has binary data that do not end with a quote")?;
                Ok(Value::Nothing)
            }
            Some(_) => self.number(),
            None => Err("is cut short by the end of the file"),
        }
    }

    fn number(&mut self) -> Result<Value<'t>, Reason> {
        let word = self.take(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'e' | b'E'));
        let value = integer(word).map(Value::Integer).or_else(|| whole_number(word, b'.').map(Value::Real));
        value.ok_or("has a parameter that is no value")
    }

    /// The text in quotes that begins here.
    fn quoted(&mut self) -> Result<&'t [u8], Reason> {
        let from = self.at + 1;
        let mut at = from;
        loop {
            let Some(n) = memchr::memchr2(b'\'', b'\n', self.text.get(at..).unwrap_or_default()) else {
                // No other text begins behind here: going back is done once.
                return Err("has a text without a quote at its end");
            };
            at += n + 1;
            let rest = &self.text[at..];
            match (self.text[at - 1], rest.first()) {
                (b'\'', Some(b'\'')) => at += 1,
                (b'\'', _) => {
                    self.at = at;
                    return Ok(&self.text[from..at - 1]);
                }
                _ if starts_entity(rest) => {
                    self.at = at;
                    return Err("has a text without a quote at its end");
                }
                _ => {}
            }
        }
    }

    /// Goes to the next place that looks like the start of an entity, behind a statement or at the start of a line.
    fn recover(&mut self) {
        while let Some(n) = memchr::memchr(b'#', self.rest()) {
            self.at += n;
            let blank = |b: &&u8| b.is_ascii_whitespace();
            let mut back = self.text[..self.at].iter().rev().take_while(blank);
            let new_line = back.any(|b| *b == b'\n');
            let before = self.text[..self.at].iter().rev().find(|b| !blank(b));
            if (new_line || matches!(before, Some(b';' | b'/' | b')'))) && starts_entity(self.rest()) {
                return;
            }
            self.at += 1;
        }
        let end = memchr::memmem::find(self.rest(), END);
        self.at = end.map_or(self.text.len(), |n| self.at + n);
    }
}

/// Whether a text begins with the number of an entity and an equals sign.
fn starts_entity(text: &[u8]) -> bool {
    let Some(rest) = text.strip_prefix(b"#") else { return false };
    let digits = rest.iter().take_while(|b| b.is_ascii_digit()).count();
    digits > 0 && rest[digits..].iter().find(|b| !b.is_ascii_whitespace()) == Some(&b'=')
}

fn is_keyword(b: u8) -> bool {
    b.is_ascii_alphanumeric() || matches!(b, b'_' | b'!')
}
