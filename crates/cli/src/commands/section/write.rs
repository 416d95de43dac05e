//! Drawings and tables of points of a section.

use crate::output::whole_file;
use crate::run_files::RunFiles;
use clap::Args;
use std::path::PathBuf;
use trueness_document::section::{FrameRecord, NominalRecord};
use trueness_files::drawing::{self, Clamped, Entity, Layer};
use trueness_geom::section::{Geometry, PlaneFrame, Segment};
use trueness_measure::section::Section;

/// Files that a section can write.
#[derive(Args, Debug)]
#[command(next_help_heading = "Output")]
pub struct Drawings {
    /// Write a DXF drawing, a layer for each plane
    #[arg(long, value_name = "FILE")]
    dxf: Option<PathBuf>,
    /// Write an SVG drawing, 1 to 1
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Write the curves in space as STEP (AP214)
    #[arg(long, value_name = "FILE")]
    step: Option<PathBuf>,
    /// Write the curves in space as IGES (entities 100, 110, 126)
    #[arg(long, value_name = "FILE")]
    iges: Option<PathBuf>,
    /// Write the points with contour, segment, length along the contour and distance (.csv)
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl Drawings {
    /// With these files.
    pub fn files(&self, files: RunFiles) -> RunFiles {
        files
            .ending("--dxf", self.dxf.as_ref(), &["dxf"])
            .ending("--svg", self.svg.as_ref(), &["svg"])
            .ending("--step", self.step.as_ref(), &["stp", "step"])
            .ending("--iges", self.iges.as_ref(), &["igs", "iges"])
            .ending("--out", self.out.as_ref(), &["csv"])
    }

    /// Writes what was asked for: of each section its contours, `rows`, the points of each contour, and their deviations from the
    /// nominal, where there is one.
    pub fn write(
        &self,
        sections: &[Section],
        rows: &[Vec<[f64; 2]>],
        nominal: Option<&NominalRecord>,
    ) -> anyhow::Result<()> {
        let layers: Vec<Layer> = sections.iter().enumerate().map(|(n, s)| layer(n, s)).collect();
        if let Some(path) = &self.dxf {
            whole_file(path, |file| drawing::dxf(file, &layers))?;
        }
        if let Some(path) = &self.svg {
            whole_file(path, |file| drawing::svg(file, &layers))?;
        }
        if let Some(path) = &self.step {
            whole_file(path, |file| drawing::step(file, &layers))?;
        }
        if let Some(path) = &self.iges {
            whole_file(path, |file| drawing::iges(file, &layers))?;
        }
        if let Some(path) = &self.out {
            whole_file(path, |file| {
                let deviation = if nominal.is_some() { ",deviation" } else { "" };
                writeln!(file, "x,y,contour,segment,length,distance{deviation}")?;
                let contours = sections.iter().flat_map(|s| &s.contours);
                for (n, (contour, row)) in contours.zip(rows).enumerate() {
                    for (i, [x, y]) in row.iter().enumerate() {
                        let (segment, length) = (contour.labels[i] + 1, contour.stations[i]);
                        let distance = contour.residuals[i];
                        write!(file, "{x},{y},{},{segment},{length},{distance}", n + 1)?;
                        match nominal.map(|nominal| nominal.deviations[n][i]) {
                            None => writeln!(file)?,
                            Some(off) => {
                                writeln!(file, ",{}", off.map_or(String::new(), |off| off.to_string()))?
                            }
                        }
                    }
                }
                Ok(())
            })?;
        }
        Ok(())
    }
}

fn layer(number: usize, section: &Section) -> Layer {
    let entity = |segment: &Segment| match &segment.geometry {
        Geometry::Line => Entity::Line { start: segment.start, end: segment.end },
        Geometry::Arc { center, radius, start, sweep } => {
            Entity::Arc { center: *center, radius: *radius, start: *start, sweep: *sweep }
        }
        Geometry::Spline { curve, .. } => Entity::Spline(Clamped {
            degree: curve.knots().degree(),
            knots: curve.knots().values().to_vec(),
            points: curve.points().to_vec(),
        }),
    };
    let entities = section.contours.iter().flat_map(|c| &c.segments).map(entity).collect();
    let FrameRecord { origin, x, y, .. } = section.frame;
    Layer { name: format!("section-{}", number + 1), frame: PlaneFrame { origin, x, y }, entities }
}
