//! Why a file was not read: place, what was expected, remedy.

use std::{borrow::Cow, fmt, io};

/// A file that could not be read.
#[derive(Debug, thiserror::Error)]
#[error("{file}{place}: {fault}; {}", fault.remedy())]
pub struct ReadError {
    /// The file's name as it was given, or `standard input`.
    pub file: String,
    /// Where in the file.
    pub place: Place,
    /// The fault.
    #[source]
    pub fault: Fault,
}

/// Where in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Nowhere in particular.
    File,
    /// A line of a text file, counted from 1.
    Line(u64),
    /// A byte of a binary file, counted from 0 (of the unpacked bytes, where the file is packed).
    Byte(u64),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::File => Ok(()),
            Place::Line(n) => write!(f, ", line {n}"),
            Place::Byte(n) => write!(f, ", byte {n}"),
        }
    }
}

/// A fault of a file.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// The system refused.
    #[error("{0}")]
    Io(io::Error),
    /// A file of zero bytes.
    #[error("the file is empty")]
    Empty,
    /// It is of no format that is read, or of none that holds what is needed.
    #[error("{what}")]
    Foreign {
        /// What is known of it.
        what: String,
        /// The remedy: the formats that are.
        remedy: String,
    },
    /// The format named is only written.
    #[error("files of the format {0} are written, but not read")]
    NotRead(&'static str),
    /// Something else stands where the format demands something.
    #[error("expected {expected}, found {found}")]
    Unexpected {
        /// The content that the format demands.
        expected: Cow<'static, str>,
        /// The content that is there, shortened.
        found: String,
    },
    /// The file ends early.
    #[error("cut short: {declared} {what} declared, {present} present")]
    Short {
        /// Name of the things counted.
        what: &'static str,
        /// As many as the header says.
        declared: u64,
        /// As many as there are whole.
        present: u64,
    },
    /// A face names a vertex that is not there.
    #[error("face names vertex {index}, but there are {count} vertices")]
    NoSuchVertex {
        /// The number as written in the file.
        index: i64,
        /// How many vertices there are.
        count: u64,
    },
    /// NaN or infinity.
    #[error("{what} {number} has a coordinate that is not a finite number")]
    NotFinite {
        /// `point` or `vertex`.
        what: &'static str,
        /// Its number, counted from 1.
        number: u64,
    },
    /// More than can be numbered.
    #[error("{count} {what} are more than the {limit} that can be numbered")]
    TooMany {
        /// Name of the things counted.
        what: &'static str,
        /// How many there are.
        count: u64,
        /// How many there may be.
        limit: u64,
    },
    /// The packed file grows beyond all measure when unpacked.
    #[error("unpacks to more than {ratio} times its size")]
    Bomb {
        /// The greatest ratio allowed.
        ratio: u64,
    },
    /// The packed bytes are damaged.
    #[error("the gzip data are damaged: {0}")]
    Gzip(io::Error),
    /// A feature of the format that is not read.
    #[error("{what}")]
    Unsupported {
        /// The feature.
        what: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// Columns were asked for in a file that has none.
    #[error("columns were named, but the format is {0}, which is no table")]
    NoTable(&'static str),
    /// Normals were asked for in a file of a kind that has none, or whose normals are not read.
    #[error("no normals are read from files of the format {0}")]
    NoNormals(&'static str),
    /// Vertices are to be joined over a distance that no two of them exceed.
    #[error("all its vertices lie within {distance} mm of one another: it is only {size} mm long")]
    WeldTooFar {
        /// The distance asked for, millimeters.
        distance: f64,
        /// Diagonal of the box of the vertices, millimeters.
        size: f64,
    },
    /// A cell of a table is not what the table needs there.
    #[error("column {column}{}: expected {expected}, found {found}", named(.name))]
    Cell {
        /// Number of the column, counted from 1.
        column: usize,
        /// Its name in the header, else the coordinate; empty where neither is known.
        name: String,
        /// The content that the table needs.
        expected: Cow<'static, str>,
        /// The content that is there, shortened.
        found: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// The file can be taken in more than one way, and nothing says which is meant.
    #[error("{what}")]
    Unclear {
        /// The unclear point.
        what: String,
        /// How to say it.
        remedy: &'static str,
    },
    /// More content than announced.
    #[error("{declared} {what} announced, {present} present")]
    Surplus {
        /// Name of the things counted.
        what: &'static str,
        /// As many as the file says.
        declared: u64,
        /// As many as there are.
        present: u64,
    },
    /// Bytes behind all that the header declares.
    #[error("{count} bytes follow the {declared} {what} that the header declares")]
    Trailing {
        /// How many.
        count: u64,
        /// Name of the things counted.
        what: &'static str,
        /// As many as the header says.
        declared: u64,
    },
    /// Zero bytes in a text.
    #[error("zero bytes within text: the file was not written to its end, or it is no text")]
    Zeros,
    /// The file became shorter while it was read.
    #[error("the file became shorter while it was read: {length} bytes at first, then {now}")]
    Shrunk {
        /// Its length when it was opened.
        length: u64,
        /// Its length now.
        now: u64,
    },
    /// Nothing goes by the name.
    #[error("nothing goes by this name{}", nearest_name(.nearest))]
    Unnamed {
        /// The name that is nearest to it, where there are any.
        nearest: Option<String>,
    },
    /// A text is longer than it may be.
    #[error("it is longer than {longest} bytes")]
    TooLong {
        /// Bytes that it may have.
        longest: u64,
    },
    /// Reading was stopped on demand.
    #[error("reading was stopped")]
    Cancelled,
    /// The file is needed as a whole, and there is no memory for that.
    #[error("{} MB of memory are needed to read it", bytes.div_ceil(1_000_000))]
    Memory {
        /// Bytes asked for.
        bytes: u64,
    },
    /// The columns asked for are not in the file.
    #[error("no column {wanted}; there are {there}")]
    NoColumn {
        /// As asked for.
        wanted: String,
        /// The columns of the file.
        there: String,
    },
}

impl Fault {
    /// Whether the question was wrong, not the file: an option does not fit it.
    pub fn is_wrong_usage(&self) -> bool {
        matches!(self, Fault::NoTable(_) | Fault::WeldTooFar { .. } | Fault::NotRead(_))
    }
    /// The remedy.
    pub fn remedy(&self) -> &str {
        match self {
            Fault::Io(e) if e.kind() == io::ErrorKind::NotFound => "check the spelling of the path",
            Fault::Io(e) if e.kind() == io::ErrorKind::PermissionDenied => "get the permission to read it",
            Fault::Io(_) => "check that the file can be read",
            Fault::Unnamed { .. } => "check the spelling of the name",
            Fault::TooLong { .. } => "check that it is the right file",
            Fault::Empty => "export it again",
            Fault::Foreign { remedy, .. } => remedy,
            Fault::NotRead(_) => "name another format",
            Fault::Unexpected { .. } => "correct this place or export the file again",
            Fault::Short { .. } => "copy or export the file again",
            Fault::NoSuchVertex { .. } => {
                "export the file again: its faces and vertices do not belong together"
            }
            Fault::NotFinite { .. } => "remove it, or export without invalid points",
            Fault::TooMany { .. } => "divide the file into parts",
            Fault::Bomb { .. } => "if it is trustworthy, unpack it first",
            Fault::Gzip(_) => "copy the file again or unpack it first",
            Fault::NoTable(_) => "leave --columns out",
            Fault::NoNormals(_) => {
                "give the points as PLY with nx, ny, nz or as a table with such columns, or a mesh"
            }
            Fault::WeldTooFar { .. } => "give --weld a smaller distance, or the right unit to --units",
            Fault::Cancelled => "read it again",
            Fault::NoColumn { .. } => "name three of these, by name or by number from 1",
            Fault::Unsupported { remedy, .. }
            | Fault::Cell { remedy, .. }
            | Fault::Unclear { remedy, .. } => remedy,
            Fault::Surplus { .. } => "correct the number or export the file again",
            Fault::Trailing { .. } => "save the data again, one array or model in a file",
            Fault::Zeros => "export or copy the file again",
            Fault::Shrunk { .. } => "wait until the other program has written it, and try again",
            Fault::Memory { .. } => "divide the file into parts, or use a machine with more memory",
        }
    }
    /// Fewer things than declared.
    pub(crate) fn short(what: &'static str, declared: u64, present: u64) -> Fault {
        Fault::Short { what, declared, present }
    }
    /// Two statements of a file do not agree.
    pub(crate) fn contradiction(what: impl Into<String>) -> Fault {
        Fault::Unclear { what: what.into(), remedy: "copy or export the file again" }
    }
    pub(crate) fn at(self, place: Place) -> Located {
        Located { place, fault: self }
    }
    pub(crate) fn at_byte(self, byte: u64) -> Located {
        self.at(Place::Byte(byte))
    }
    pub(crate) fn at_line(self, line: u64) -> Located {
        self.at(Place::Line(line))
    }
    /// `found` may be any bytes; they are shortened and made printable.
    pub(crate) fn unexpected(expected: impl Into<Cow<'static, str>>, found: &[u8]) -> Fault {
        Fault::Unexpected { expected: expected.into(), found: quoted(found) }
    }
}

/// A name in brackets, unless it is empty.
fn named(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!(" ({name})") }
}

/// The hint at the nearest name.
fn nearest_name(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |nearest| format!(", the nearest is {nearest}"))
}

/// The beginning of some bytes, made printable for a message.
pub(crate) fn quoted(found: &[u8]) -> String {
    const MAX_QUOTED_CHARS: usize = 40;
    let found = found.trim_ascii();
    if found.is_empty() {
        return "nothing".into();
    }
    let text = String::from_utf8_lossy(&found[..found.len().min(4 * MAX_QUOTED_CHARS)]);
    let mut shown: String =
        text.chars().take(MAX_QUOTED_CHARS).map(|c| if c.is_control() { '·' } else { c }).collect();
    if text.chars().count() > MAX_QUOTED_CHARS {
        shown.push('…');
    }
    format!("\"{shown}\"")
}

/// A fault and its place, before it is known in which file.
#[derive(Debug)]
pub(crate) struct Located {
    pub place: Place,
    pub fault: Fault,
}

impl Located {
    pub fn in_file(self, file: &str) -> ReadError {
        ReadError { file: file.into(), place: self.place, fault: self.fault }
    }
}

impl From<Fault> for Located {
    fn from(fault: Fault) -> Located {
        fault.at(Place::File)
    }
}

impl From<io::Error> for Located {
    fn from(e: io::Error) -> Located {
        Fault::Io(e).into()
    }
}

pub(crate) type Result<T> = std::result::Result<T, Located>;
