//! Drawings and tables of points of a section.

use crate::output::whole_file;
use crate::run_files::RunFiles;
use clap::Args;
use std::path::PathBuf;
use trueness_files::drawing::{self, Entity, Layer};
use trueness_geom::section::{Contour, Geometry, Segment};
use trueness_inspect::results::section::Section;

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
    /// Write the points with contour, segment, length along the contour and distance (.csv)
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl Drawings {
    /// With these files.
    pub fn files(&self, files: RunFiles) -> RunFiles {
        [("--dxf", &self.dxf), ("--svg", &self.svg), ("--out", &self.out)]
            .into_iter()
            .fold(files, |files, (option, path)| files.also(option, path.as_ref()))
    }

    /// Writes what was asked for: of each section its contours, and `rows`, the points of each contour.
    pub fn write(&self, sections: &[Section], rows: &[Vec<[f64; 2]>]) -> anyhow::Result<()> {
        let layers: Vec<Layer> = sections.iter().enumerate().map(|(n, s)| layer(n, &s.contours)).collect();
        if let Some(path) = &self.dxf {
            whole_file(path, |file| drawing::dxf(file, &layers))?;
        }
        if let Some(path) = &self.svg {
            whole_file(path, |file| drawing::svg(file, &layers))?;
        }
        if let Some(path) = &self.out {
            whole_file(path, |file| {
                writeln!(file, "x,y,contour,segment,length,distance")?;
                let contours = sections.iter().flat_map(|s| &s.contours);
                for (n, (contour, row)) in contours.zip(rows).enumerate() {
                    for (i, [x, y]) in row.iter().enumerate() {
                        let (segment, length) = (contour.labels[i] + 1, contour.stations[i]);
                        let distance = contour.residuals[i];
                        writeln!(file, "{x},{y},{},{segment},{length},{distance}", n + 1)?;
                    }
                }
                Ok(())
            })?;
        }
        Ok(())
    }
}

fn layer(number: usize, contours: &[Contour]) -> Layer {
    let entity = |segment: &Segment| match &segment.geometry {
        Geometry::Line => Entity::Line { start: segment.start, end: segment.end },
        Geometry::Arc { center, radius, start, sweep } => {
            Entity::Arc { center: *center, radius: *radius, start: *start, sweep: *sweep }
        }
        Geometry::Spline { curve, .. } => Entity::Spline {
            degree: curve.knots().degree(),
            knots: curve.knots().values().to_vec(),
            points: curve.points().to_vec(),
        },
    };
    let entities = contours.iter().flat_map(|c| &c.segments).map(entity).collect();
    Layer { name: format!("section-{}", number + 1), entities }
}
