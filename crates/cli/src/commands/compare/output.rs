//! Where the answer of a comparison goes: document, points with deviations, report.

use crate::options::DocumentArgs;
use crate::options::ProgressStyle;
use crate::report::ReportArgs;
use anyhow::Context;
use clap::Args;
use std::path::{Path, PathBuf};
use trueness::task::RunFiles;
use trueness_document::compare::CompareDocument;
use trueness_document::scale::Scale;
use trueness_files::WriteError;
use trueness_files::write::{self, HeldPoints, Layout, PointsFile, Writable};
use trueness_geom::parallel::prelude::*;
use trueness_measure::compare::{self, Excluded};

/// Files that a comparison can write.
#[derive(Args, Debug)]
#[command(next_help_heading = "Output")]
pub struct OutputArgs {
    #[command(flatten)]
    pub document: DocumentArgs,
    /// Write x, y, z, deviation of every point
    #[arg(long, value_name = "FILE", help = out_help())]
    pub out: Option<PathBuf>,
    /// Color scale of the report (an object trueness/scale/1)
    #[arg(long, value_name = "FILE")]
    pub scale: Option<PathBuf>,
    #[command(flatten)]
    pub report: ReportArgs,
}

fn out_help() -> String {
    format!(
        "Write x, y, z, deviation of every point in input order ({}); with several references one file each: \
         name.1.csv, name.2.csv …",
        Writable::Points.shown()
    )
}

impl OutputArgs {
    /// All files that are written, beside those that are read.
    pub fn files(&self, inputs: RunFiles, references: usize) -> RunFiles {
        let points =
            self.out.iter().flat_map(|path| (0..references).map(move |i| numbered(path, i, references)));
        points
            .fold(inputs, |files, path| files.out(Some(&path), Writable::Points))
            .document(self.document.json.as_ref())
            .report(self.report.html.as_ref())
    }

    /// The color scale of `--scale`.
    pub fn read_scale(&self) -> anyhow::Result<Option<Scale>> {
        let Some(path) = &self.scale else { return Ok(None) };
        let shown = path.display();
        let text = std::fs::read_to_string(path).with_context(|| format!("{shown}: cannot be read"))?;
        let scale: Scale = serde_json::from_str(&text).with_context(|| {
            format!("{shown}: not a color scale (an object trueness/scale/1 as in a result's key `scale`)")
        })?;
        scale.check().with_context(|| format!("{shown}: not a usable color scale"))?;
        Ok(Some(scale))
    }

    /// The report in its file.
    pub fn write_html(
        &self,
        document: &CompareDocument,
        view: &trueness_report::views::compare::View,
        progress: ProgressStyle,
    ) -> anyhow::Result<()> {
        self.report.write(document, &view.objects(), &view.marks(document), progress)
    }
}

/// Name of the file for reference `i`: `path` itself, or `name.1.ext`, `name.2.ext` … for several.
fn numbered(path: &Path, i: usize, references: usize) -> PathBuf {
    match (references, path.extension()) {
        (1, _) | (_, None) => path.to_path_buf(),
        (_, Some(extension)) => {
            let mut ending = std::ffi::OsString::from(format!("{}.", i + 1));
            ending.push(extension);
            path.with_extension(ending)
        }
    }
}

/// The per-point files of `--out`: one a reference. Files that are looked at, PLY and VTP, are colored always, the others
/// where the scale is known beforehand.
pub struct PointFiles {
    files: Vec<PointFile>,
    /// Whether they say why a point does not count.
    reasons: bool,
}

enum PointFile {
    /// Written as the points come, colored if there is a scale.
    Now(PointsFile, Option<Scale>),
    /// Written when the scale is known.
    Later(HeldPoints),
}

impl PointFiles {
    /// Begins `path`, or `name.1.ext`, `name.2.ext` … for several references; `scale` if it is known beforehand.
    /// With `reasons` they say why a point does not count, and keep the deviations of outliers.
    pub fn create(
        path: &Path,
        references: usize,
        scale: Option<Scale>,
        reasons: bool,
    ) -> Result<PointFiles, WriteError> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        let looked_at = ["ply", "vtp"].iter().any(|e| extension.eq_ignore_ascii_case(e));
        let name = |i: usize| numbered(path, i, references);
        let file = |i: usize| match &scale {
            None if looked_at => HeldPoints::create(&name(i), reasons).map(PointFile::Later),
            scale => {
                let layout = Layout { deviation: true, reason: reasons, color: scale.is_some() };
                Ok(PointFile::Now(write::points(&name(i), layout)?, scale.clone()))
            }
        };
        Ok(PointFiles { files: (0..references).map(file).collect::<Result<_, _>>()?, reasons })
    }

    /// Adds a block to every file.
    pub fn write(&mut self, block: &compare::DeviationBlock) -> Result<(), WriteError> {
        let numbers = |values: &[f64]| -> Vec<f64> {
            values.par_iter().map(|&d| if d.is_finite() { d } else { f64::NAN }).collect()
        };
        let all = self.files.iter_mut().zip(block.deviations).zip(block.measured);
        for ((file, deviations), measured) in all {
            let deviation = numbers(measured);
            let number = |d: &f64| Excluded::of(*d).map_or(0, Excluded::number);
            let reason: Vec<u8> =
                if self.reasons { deviations.par_iter().map(number).collect() } else { vec![] };
            match file {
                PointFile::Now(file, scale) => {
                    let color = scale.as_ref().map_or(vec![], |scale| colors(scale, &numbers(deviations)));
                    file.write(&write::Block {
                        points: block.points,
                        deviation: &deviation,
                        reason: &reason,
                        color: &color,
                    })?;
                }
                PointFile::Later(file) => file.write(block.points, &deviation, &reason)?,
            }
        }
        Ok(())
    }

    /// Puts the files in their places, in the colors of `scale` if they have not got any yet.
    pub fn finish(self, scale: &Scale) -> Result<(), WriteError> {
        self.files.into_iter().try_for_each(|file| match file {
            PointFile::Now(file, _) => file.finish().map(drop),
            PointFile::Later(file) => file.finish(|deviation| colors(scale, deviation)).map(drop),
        })
    }
}

/// The color of each deviation; gray for none.
fn colors(scale: &Scale, deviation: &[f64]) -> Vec<[u8; 3]> {
    deviation.par_iter().map(|&d| scale.color(d)).collect()
}
