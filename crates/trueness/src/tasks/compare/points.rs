//! Files of points with their deviations, one a reference.

use crate::task::Output;
use std::path::{Path, PathBuf};
use trueness_document::scale::Scale;
use trueness_files::WriteError;
use trueness_files::write::{self, HeldPoints, Layout, PointsFile};
use trueness_geom::parallel::prelude::*;
use trueness_measure::compare::{DeviationBlock, Excluded};

/// Name of the file for reference `i`: `path` itself, or `name.1.ext`, `name.2.ext` … for several.
pub fn numbered(path: &Path, i: usize, references: usize) -> PathBuf {
    match (references, path.extension()) {
        (1, _) | (_, None) => path.to_path_buf(),
        (_, Some(extension)) => {
            let mut ending = std::ffi::OsString::from(format!("{}.", i + 1));
            ending.push(extension);
            path.with_extension(ending)
        }
    }
}

/// The files of a comparison: one a reference. Files that are looked at are colored always, the others
/// where the scale is known beforehand.
pub struct PointFiles {
    files: Vec<PointFile>,
    /// Whether they say why a point does not count.
    reasons: bool,
    /// Of each reference the numbers of its faces in its file; none of other references than CAD models.
    faces: Vec<Vec<u64>>,
}

enum PointFile {
    /// Written as the points come, colored if there is a scale.
    Now(PointsFile, Option<Scale>),
    /// Written when the scale is known.
    Later(HeldPoints),
}

impl PointFiles {
    /// Begins `path`, or `name.1.ext`, `name.2.ext` … for several references; `scale` if it is known beforehand.
    /// With `reasons` they say why a point does not count, and keep the deviations of outliers. `faces` has the numbers of the faces of each
    /// reference, which tables name beside the points.
    pub fn create(
        path: &Path,
        faces: Vec<Vec<u64>>,
        scale: Option<Scale>,
        reasons: bool,
    ) -> Result<PointFiles, WriteError> {
        let references = faces.len();
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        let looked_at = ["ply", "vtp"].iter().any(|e| extension.eq_ignore_ascii_case(e));
        let name = |i: usize| numbered(path, i, references);
        let file = |i: usize| match &scale {
            None if looked_at => HeldPoints::create(&name(i), reasons).map(PointFile::Later),
            scale => {
                let (color, face) = (scale.is_some(), !faces[i].is_empty());
                let layout = Layout { deviation: true, reason: reasons, face, color };
                Ok(PointFile::Now(write::points(&name(i), layout)?, scale.clone()))
            }
        };
        let files = (0..references).map(file).collect::<Result<_, _>>()?;
        Ok(PointFiles { files, reasons, faces })
    }

    /// Adds a block to every file.
    pub fn write(&mut self, block: &DeviationBlock) -> Result<(), WriteError> {
        let numbers = |values: &[f64]| -> Vec<f64> {
            values.par_iter().map(|&d| if d.is_finite() { d } else { f64::NAN }).collect()
        };
        let all = self.files.iter_mut().zip(block.deviations).zip(block.measured);
        for (((file, deviations), measured), (own, entities)) in all.zip(block.faces.iter().zip(&self.faces))
        {
            let entity =
                |(face, d): (&u32, &f64)| entities.get(*face as usize).copied().filter(|_| d.is_finite());
            let face: Vec<Option<u64>> = match entities.is_empty() {
                true => vec![],
                false => own.iter().zip(measured).map(entity).collect(),
            };
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
                        face: &face,
                        color: &color,
                    })?;
                }
                PointFile::Later(file) => file.write(block.points, &deviation, &reason)?,
            }
        }
        Ok(())
    }

    /// The files, which get the colors of `scale` if they have not got any yet.
    pub fn outputs(self, scale: &Scale) -> Vec<Output> {
        let output = |file| match file {
            PointFile::Now(file, _) => Output::later(move || file.finish().map(drop)),
            PointFile::Later(file) => {
                let scale = scale.clone();
                Output::later(move || file.finish(|deviation| colors(&scale, deviation)).map(drop))
            }
        };
        self.files.into_iter().map(output).collect()
    }
}

/// The color of each deviation; gray for none.
fn colors(scale: &Scale, deviation: &[f64]) -> Vec<[u8; 3]> {
    deviation.par_iter().map(|&d| scale.color(d)).collect()
}
