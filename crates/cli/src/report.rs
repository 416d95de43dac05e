//! The report that every command can write: its options, and the writing.

use crate::output::whole_file;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use trueness::task::{Done, ErrorKind, Watch};
use trueness_report::{Language, ReportOptions, Subject, Up};

/// A self-contained report.
#[derive(Args, Debug)]
#[command(next_help_heading = "Report")]
pub struct ReportArgs {
    /// Write a self-contained report with a 3D view
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Largest size of the report, MB
    #[arg(long, value_name = "MB", default_value = "10", value_parser = megabytes)]
    html_budget: f64,
    /// Language of the report: en, de, ru or zh
    #[arg(long, value_name = "LANG", default_value = "en", value_parser = language)]
    lang: Language,
    /// Decimal sign of the report: `.` or `,` [default: that of its language]
    #[arg(long, value_name = "SIGN", value_parser = decimal_sign)]
    decimal: Option<char>,
    /// Axis of the model that points up in the report
    #[arg(long, value_enum, default_value = "z")]
    up: UpArg,
    /// Title, for the head of the report
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    title: Option<String>,
    /// Part, for the head of the report
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    part: Option<String>,
    /// Serial number, for the head of the report
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    serial: Option<String>,
    /// Operator, for the head of the report
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    operator: Option<String>,
}

/// Which axis points up.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum UpArg {
    /// As in scanned figures.
    Y,
    /// As in technical drawings.
    Z,
}

impl From<UpArg> for Up {
    fn from(up: UpArg) -> Up {
        match up {
            UpArg::Y => Up::Y,
            UpArg::Z => Up::Z,
        }
    }
}

/// The page itself, with its script, takes most of the first two.
fn megabytes(text: &str) -> Result<f64, String> {
    let known = text.parse().ok().filter(|mb: &f64| mb.is_finite() && *mb >= 2.0);
    known.ok_or_else(|| "give a number of MB, 2 or more".into())
}

fn language(code: &str) -> Result<Language, String> {
    Language::from_code(code).ok_or_else(|| "the languages are en, de, ru and zh".into())
}

fn decimal_sign(sign: &str) -> Result<char, String> {
    match sign {
        "." => Ok('.'),
        "," => Ok(','),
        _ => Err("give `.` or `,`".into()),
    }
}

impl ReportArgs {
    /// The same for a report.
    fn options(&self) -> ReportOptions {
        ReportOptions {
            title: self.title.clone(),
            part: self.part.clone(),
            serial: self.serial.clone(),
            operator: self.operator.clone(),
            budget: (self.html_budget * 1e6) as usize,
            language: self.lang,
            decimal: self.decimal,
            up: self.up.into(),
        }
    }

    /// Writes the report of what a task answered, if one was asked for.
    pub fn write_done<D: Subject>(&self, done: &Done<D>, watch: &dyn Watch) -> anyhow::Result<()> {
        match &self.html {
            Some(path) => self.write_done_to(path, done, watch),
            None => Ok(()),
        }
    }

    /// Writes a report of what a task answered with these options to `path`.
    pub fn write_done_to<D: Subject>(
        &self,
        path: &Path,
        done: &Done<D>,
        watch: &dyn Watch,
    ) -> anyhow::Result<()> {
        let page = done.report(&self.options(), watch).map_err(|e| match e.kind() {
            ErrorKind::Cancelled => e,
            _ => e.context(format!("{}: cannot be made", path.display())),
        })?;
        Ok(whole_file(path, |file| file.write_all(&page))?)
    }
}
