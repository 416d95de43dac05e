//! Where the answer goes: document, points with deviations, report.

use crate::console;
use crate::exit::Usage;
use crate::report::ReportArgs;
use anyhow::Context;
use clap::Args;
use rayon::prelude::*;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use trueness_files::write::{self, HeldPoints, Layout, PointsFile};
use trueness_files::{AtomicFile, WriteError};
use trueness_inspect::compare;
use trueness_inspect::report::Answer;
use trueness_inspect::results::compare::CompareDocument;
use trueness_inspect::scale::Scale;

/// Files that a comparison can write.
#[derive(Args, Debug)]
#[command(next_help_heading = "Output")]
pub struct OutputArgs {
    /// Write the result document; `-` for stdout, then without a table
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Write x, y, z, deviation of every point in input order (.csv .ply .parquet .npz .vtp); with several
    /// references one file each: name.1.csv, name.2.csv …
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Colour scale of the report (an object trueness/scale/1)
    #[arg(long, value_name = "FILE")]
    pub scale: Option<PathBuf>,
    #[command(flatten)]
    pub report: ReportArgs,
}

impl OutputArgs {
    /// Refuses two outputs on the same stream or in the same file.
    pub fn check(&self) -> Result<(), Usage> {
        let files: Vec<&PathBuf> = [&self.json, &self.out, &self.report.html].into_iter().flatten().collect();
        for (i, a) in files.iter().enumerate() {
            if files[..i].contains(a) {
                return Err(Usage(format!(
                    "{}: two outputs go to the same file; give each its own",
                    a.display()
                )));
            }
        }
        Ok(())
    }

    /// The colour scale of `--scale`.
    pub fn read_scale(&self) -> anyhow::Result<Option<Scale>> {
        let Some(path) = &self.scale else { return Ok(None) };
        let shown = path.display();
        let text = std::fs::read_to_string(path).with_context(|| format!("{shown}: cannot be read"))?;
        let scale: Scale = serde_json::from_str(&text).with_context(|| {
            format!("{shown}: not a colour scale (an object trueness/scale/1 as in a result's key `scale`)")
        })?;
        scale.check().with_context(|| format!("{shown}: not a usable colour scale"))?;
        Ok(Some(scale))
    }

    /// The document on stdout or in its file.
    pub fn write_json(&self, document: &CompareDocument) -> anyhow::Result<()> {
        json_file(self.json.as_deref(), document).map(|_| ())
    }

    /// The report in its file.
    pub fn write_html(&self, document: &CompareDocument, view: &compare::View) -> anyhow::Result<()> {
        self.report.write(Answer::Compare(document), &view.objects(), &view.marks(document))
    }

    /// True if the table would mix with the document.
    pub fn json_on_stdout(&self) -> bool {
        self.json.as_deref() == Some(Path::new("-"))
    }
}

/// Writes a file that appears whole or not at all.
pub fn whole_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> anyhow::Result<()> {
    let make = || {
        let mut file = BufWriter::new(AtomicFile::create(path)?);
        write(&mut file)?;
        file.into_inner().map_err(|e| e.into_error())?.commit()
    };
    make().with_context(|| format!("{}: cannot be written; nothing of it was left behind", path.display()))
}

/// Writes the result document of `--json`, to stdout for `-`. True if it went there: no table then.
pub fn json_file(path: Option<&Path>, document: &impl serde::Serialize) -> anyhow::Result<bool> {
    let Some(path) = path else { return Ok(false) };
    let mut text = serde_json::to_string_pretty(document)?;
    text.push('\n');
    if path == Path::new("-") {
        console::document(&text)?;
        return Ok(true);
    }
    whole_file(path, |file| file.write_all(text.as_bytes()))?;
    Ok(false)
}

/// The per-point files of `--out`: one a reference. Files that are looked at, PLY and VTP, are coloured always, the others
/// where the scale is known beforehand.
pub struct PointFiles(Vec<PointFile>);

enum PointFile {
    /// Written as the points come, coloured if there is a scale.
    Now(PointsFile, Option<Scale>),
    /// Written when the scale is known.
    Later(HeldPoints),
}

impl PointFiles {
    /// Begins `path`, or `name.1.ext`, `name.2.ext` … for several references; `scale` if it is known beforehand.
    pub fn create(path: &Path, references: usize, scale: Option<Scale>) -> Result<PointFiles, WriteError> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        let looked_at = ["ply", "vtp"].iter().any(|e| extension.eq_ignore_ascii_case(e));
        let name = |i: usize| match references {
            1 => path.to_path_buf(),
            _ => path.with_extension(format!("{}.{extension}", i + 1)),
        };
        let file = |i: usize| match &scale {
            None if looked_at => HeldPoints::create(&name(i)).map(PointFile::Later),
            scale => {
                let layout = Layout { deviation: true, colour: scale.is_some() };
                Ok(PointFile::Now(write::points(&name(i), layout)?, scale.clone()))
            }
        };
        (0..references).map(file).collect::<Result<_, _>>().map(PointFiles)
    }

    /// Adds a block to every file.
    pub fn write(&mut self, block: &compare::Block) -> Result<(), WriteError> {
        for (file, deviations) in self.0.iter_mut().zip(block.deviations) {
            let deviation: Vec<f64> =
                deviations.par_iter().map(|&d| if d.is_finite() { d } else { f64::NAN }).collect();
            match file {
                PointFile::Now(file, scale) => {
                    let colour = scale.as_ref().map_or(vec![], |scale| colours(scale, &deviation));
                    file.write(&write::Block {
                        points: block.points,
                        deviation: &deviation,
                        colour: &colour,
                    })?;
                }
                PointFile::Later(file) => file.write(block.points, &deviation)?,
            }
        }
        Ok(())
    }

    /// Puts the files in their places, in the colours of `scale` if they have not got any yet.
    pub fn finish(self, scale: &Scale) -> Result<(), WriteError> {
        self.0.into_iter().try_for_each(|file| match file {
            PointFile::Now(file, _) => file.finish().map(drop),
            PointFile::Later(file) => file.finish(|deviation| colours(scale, deviation)).map(drop),
        })
    }
}

/// The colour of each deviation; grey for none.
fn colours(scale: &Scale, deviation: &[f64]) -> Vec<[u8; 3]> {
    deviation.par_iter().map(|&d| scale.color(d)).collect()
}
