//! Options that several commands share, each written once.

use crate::exit::{Usage, not_negative};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trueness_files::{Columns, FORMATS, Format, ReadOptions, Unit, Weld};

/// Options that every command takes.
#[derive(Args, Debug)]
#[command(next_help_heading = "Common options")]
pub struct Common {
    /// Threads to use [default: all]; results do not depend on it
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Seed of everything random
    #[arg(long, global = true, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Print no table; the exit status and the files written tell the result
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// Print all that the document tells, in the table too
    #[arg(long, short, global = true, conflicts_with = "quiet")]
    pub verbose: bool,
    /// Progress on stderr: a bar on a terminal, plain lines, JSON lines, or nothing
    #[arg(long, global = true, value_enum, default_value = "auto")]
    pub progress: ProgressStyle,
}

/// How progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ProgressStyle {
    /// A bar on a terminal, nothing elsewhere.
    Auto,
    /// A line every two seconds.
    Plain,
    /// The same as JSON objects, one a line.
    Json,
    /// Nothing.
    None,
}

/// How a file is taken that does not say all of itself.
#[derive(Args, Debug)]
pub struct InputArgs {
    /// Unit of a file that does not say its own: mm cm m in um [default: mm]
    #[arg(long, value_name = "UNIT")]
    pub units: Option<Unit>,
    /// Format of the file [default: told by its content, then by its ending]
    #[arg(long, value_name = "NAME", value_parser = format_named)]
    pub format: Option<&'static Format>,
}

impl InputArgs {
    /// The same for the readers.
    pub fn reading(&self) -> ReadOptions {
        ReadOptions { units: self.units, format: self.format, ..ReadOptions::default() }
    }
}

/// The same where the file may be a table.
#[derive(Args, Debug)]
pub struct PointInputArgs {
    #[command(flatten)]
    pub file: InputArgs,
    /// Columns of a table: where x, y, z are (2,3,4 or X,Y,Z), or what each column is (-,x,y,z)
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pub columns: Option<Columns>,
}

impl PointInputArgs {
    /// The same for the readers.
    pub fn reading(&self) -> ReadOptions {
        ReadOptions { columns: self.columns.clone(), ..self.file.reading() }
    }
}

/// How the reference is read.
#[derive(Args, Debug)]
pub struct ReferenceArgs {
    /// Unit of the reference [default: that of the measured file, --units]
    #[arg(long, value_name = "UNIT")]
    reference_units: Option<Unit>,
    /// Format of the reference [default: told by its content; --format is that of the measured file]
    #[arg(long, value_name = "NAME", value_parser = format_named)]
    reference_format: Option<&'static Format>,
}

impl ReferenceArgs {
    /// Refuses what is said of a reference where there is none; `option` is what names one.
    pub fn without_reference(&self, option: &str) -> Result<(), Usage> {
        let given = [("units", self.reference_units.is_some()), ("format", self.reference_format.is_some())];
        match given.iter().find(|(_, given)| *given) {
            Some((what, _)) => {
                Err(Usage(format!("--reference-{what} is for the file of {option}; give one")))
            }
            None => Ok(()),
        }
    }

    /// The same for the readers, beside what was said of the measured file.
    pub fn reading(&self, measured: &PointInputArgs) -> ReadOptions {
        ReadOptions {
            units: self.reference_units.or(measured.file.units),
            format: self.reference_format,
            ..ReadOptions::default()
        }
    }
}

/// Where the result document goes.
#[derive(Args, Debug)]
pub struct DocumentArgs {
    /// Write the result document; `-` for stdout, then without a table
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}

/// What `--weld` asks for.
pub fn weld(distance: Option<f64>) -> Result<Weld, Usage> {
    distance.map_or(Ok(Weld::Same), |d| Ok(Weld::Within(not_negative("weld", d)?)))
}

/// A format of this name that is read.
pub fn format_named(name: &str) -> Result<&'static Format, String> {
    Format::named(name).filter(|f| f.reads()).ok_or_else(|| {
        let known: Vec<&str> = FORMATS.iter().filter(|f| f.reads()).map(|f| f.name).collect();
        format!("there is no such format to read; there are {}", known.join(", "))
    })
}
