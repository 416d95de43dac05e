//! `trueness formats`: what can be read and written, and the manual page of each format.

use crate::command::Run;
use crate::console::document;
use crate::exit::Usage;
use crate::options::Common;
use clap::Args;
use trueness::task::Outcome;
use trueness::task::RunFiles;
use trueness_files::write::Writable;
use trueness_files::{FORMATS, Format, Holds};

/// List the file formats that are read and written, or print the manual page of one
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness formats
  trueness formats stl")]
pub struct FormatsArgs {
    /// Name or ending of a format: its manual page is printed, as Markdown
    format: Option<String>,
}

impl Run for FormatsArgs {
    fn files(&self, _: &Common) -> anyhow::Result<RunFiles> {
        Ok(RunFiles::of([]))
    }
    fn run(&self, _: &Common) -> anyhow::Result<Outcome> {
        match &self.format {
            None => document(&list())?,
            Some(name) => {
                let format = Format::named(name.trim_start_matches('.')).ok_or_else(|| {
                    let known: Vec<&str> = FORMATS.iter().map(|f| f.name).collect();
                    Usage(format!("{name}: there is no such format; there are {}", known.join(", ")))
                })?;
                document(format.manual)?;
            }
        }
        Ok(Outcome::Conforming)
    }
}

/// All formats, with what is read and written of each.
fn list() -> String {
    const READ: [(Holds, &str); 4] = [
        (Holds::Mesh, "meshes"),
        (Holds::Points, "points"),
        (Holds::Model, "CAD models"),
        (Holds::Drawing, "drawings"),
    ];
    const WRITTEN: [(Writable, &str); 4] = [
        (Writable::Points, "points"),
        (Writable::Mesh, "meshes"),
        (Writable::Regions, "regions"),
        (Writable::Values, "values"),
    ];
    let mut out = String::new();
    let mut row = |cells: [&str; 4]| {
        let line = format!("{:<9}{:<16}{:<35}{}", cells[0], cells[1], cells[2], cells[3]);
        out.push_str(line.trim_end());
        out.push('\n');
    };
    row(["format", "read", "written", "endings"]);
    for format in FORMATS {
        let only_written = format.written_as.iter().filter(|e| !format.extensions.contains(e));
        let endings: Vec<&str> = format.extensions.iter().chain(only_written).copied().collect();
        let holds = |kind: &Writable| kind.endings().iter().any(|e| endings.contains(e));
        let written: Vec<&str> =
            WRITTEN.iter().filter(|(kind, _)| holds(kind)).map(|(_, name)| *name).collect();
        let read: Vec<&str> =
            READ.iter().filter(|(kind, _)| format.holds().contains(kind)).map(|(_, name)| *name).collect();
        let shown: Vec<String> = endings.iter().map(|e| format!(".{e}")).collect();
        row([format.name, &read.join(", "), &written.join(", "), &shown.join(" ")]);
    }
    out.push_str(
        "\nA file is recognized by its content, not by its ending. Each may be packed with gzip (.gz).\n\
         Curves and surfaces for CAD programs are written by options of `section` and `surface`.\n\
         `trueness formats NAME` prints the page of a format.\n",
    );
    out
}
