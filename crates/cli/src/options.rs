//! Options that several commands share, each written once.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trueness::task::{Choice, FormatName, PointReading, Reading, ReferenceReading, Text};
use trueness_files::{Columns, Unit};

/// Options that every command takes.
#[derive(Args, Debug)]
#[command(next_help_heading = "Common options")]
pub struct Common {
    /// Number of threads; results do not depend on it [default: all]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..), allow_negative_numbers = true)]
    pub threads: Option<u16>,
    /// Seed of all random numbers
    #[arg(long, global = true, value_name = "N", default_value_t = 0, value_parser = seed, allow_negative_numbers = true)]
    pub seed: u64,
    /// Print no table; the result is in the exit status and in the written files
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// Print the whole content of the result document in the table
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
    /// The same as JSON objects, one on each line.
    Json,
    /// Nothing.
    None,
}

/// One of the words of a choice, with what they mean in the help.
pub fn choice<T: Choice>() -> impl TypedValueParser<Value = T> {
    let words = T::ALL.iter().map(|(_, word, about)| match *about {
        "" => PossibleValue::new(*word),
        about => PossibleValue::new(*word).help(about),
    });
    PossibleValuesParser::new(words)
        .try_map(|word| T::named(&word.to_lowercase()).ok_or("there is no such word"))
}

/// A number of an option. The task decides which numbers it allows.
pub fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| match text.contains(',') {
        true => "write it with a decimal point, like 0.05".into(),
        false => "give a number, like 0.05".into(),
    })
}

/// A seed of random numbers.
fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("give a whole number from 0 to {}", u64::MAX))
}

/// A count of an option that is not nothing.
pub fn count_above_zero(text: &str) -> Result<u64, String> {
    text.parse().ok().filter(|n| *n > 0).ok_or_else(|| "give a whole number, 1 or more".into())
}

/// A count of an option.
pub fn count(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| "give a whole number, 0 or more".into())
}

/// How a file is taken that does not say all of itself.
#[derive(Args, Debug)]
pub struct InputArgs {
    /// Unit of a file that does not state its own: mm, cm, m, in, um [default: mm]
    #[arg(long, value_name = "UNIT")]
    units: Option<Text<Unit>>,
    /// Format of the file, see `trueness formats` [default: recognized by its content, then by its ending]
    #[arg(long, value_name = "NAME")]
    format: Option<Text<FormatName>>,
}

impl InputArgs {
    /// The same for a request.
    pub fn reading(&self) -> Reading {
        Reading { units: self.units.clone(), format: self.format.clone() }
    }
}

/// The same where the file may be a table.
#[derive(Args, Debug)]
pub struct PointInputArgs {
    #[command(flatten)]
    file: InputArgs,
    /// Columns of a table: the numbers or names of those of x, y, z (2,3,4 or X,Y,Z), or the kind of each (-,x,y,z)
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    columns: Option<Text<Columns>>,
}

impl PointInputArgs {
    /// The same for a request.
    pub fn reading(&self) -> PointReading {
        let Reading { units, format } = self.file.reading();
        PointReading { units, format, columns: self.columns.clone() }
    }
}

/// How the reference is read.
#[derive(Args, Debug)]
pub struct ReferenceArgs {
    /// Unit of a reference that does not state its own [default: the unit of --units]
    #[arg(long, value_name = "UNIT")]
    reference_units: Option<Text<Unit>>,
    /// Format of the reference; --format is the one of the measured file [default: recognized by its content]
    #[arg(long, value_name = "NAME")]
    reference_format: Option<Text<FormatName>>,
}

impl ReferenceArgs {
    /// The same for a request.
    pub fn reading(&self) -> ReferenceReading {
        ReferenceReading {
            reference_units: self.reference_units.clone(),
            reference_format: self.reference_format.clone(),
        }
    }
}

/// Where the result document goes.
#[derive(Args, Debug)]
pub struct DocumentArgs {
    /// Write the result document; `-` writes it to stdout instead of the table
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}
