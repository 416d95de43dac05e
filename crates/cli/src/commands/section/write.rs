//! Drawings and tables of points of a section.

use clap::Args;
use std::path::PathBuf;
use trueness::tasks::section::SectionRequest;

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
    /// Write the points with their contour, segment, length along the contour and distance (.csv)
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl Drawings {
    /// The request with these.
    pub fn ask(&self, request: SectionRequest) -> SectionRequest {
        SectionRequest {
            dxf: self.dxf.clone(),
            svg: self.svg.clone(),
            step: self.step.clone(),
            iges: self.iges.clone(),
            out: self.out.clone(),
            ..request
        }
    }
}
