//! Models of a surface for CAD programs and viewers.

use crate::exit::{Usage, not_negative};
use crate::output::whole_file;
use anyhow::bail;
use clap::Args;
use std::path::PathBuf;
use trueness::task::RunFiles;
use trueness_files::cad::{self, Bound, SplineSurface, TrimmedFace};
use trueness_geom::progress::Progress;
use trueness_geom::space::{Aabb, Point};
use trueness_geom::spline::surface::Surface;
use trueness_surface::{Outline, OutlineRegion, trimmed};

/// Facets that are written at most.
const MOST_FACETS: usize = 20_000_000;

/// Files that a surface can be written to.
#[derive(Args, Debug)]
#[command(next_help_heading = "Output")]
pub struct Models {
    /// Write the surface as STEP (AP214)
    #[arg(long, value_name = "FILE")]
    step: Option<PathBuf>,
    /// Write the surface as IGES (entity 128; with --trim 144)
    #[arg(long, value_name = "FILE")]
    iges: Option<PathBuf>,
    /// Write facets of the surface (.obj)
    #[arg(long, value_name = "FILE")]
    obj: Option<PathBuf>,
    /// Distance that the facets keep from the surface, mm [default: a ten thousandth of its size]
    #[arg(long, value_name = "MM", requires = "obj")]
    chord: Option<f64>,
}

impl Models {
    /// With these files.
    pub fn files(&self, files: RunFiles) -> RunFiles {
        files
            .ending("--step", self.step.as_ref(), &["stp", "step"])
            .ending("--iges", self.iges.as_ref(), &["igs", "iges"])
            .ending("--obj", self.obj.as_ref(), &["obj"])
    }

    /// Refuses a distance that is none.
    pub fn check_chord(&self) -> Result<(), Usage> {
        match self.chord {
            Some(chord) if not_negative("chord", chord)? == 0.0 => {
                Err(Usage("--chord 0: give a length above 0".into()))
            }
            _ => Ok(()),
        }
    }

    /// Writes what was asked for.
    pub fn write(
        &self,
        surface: &Surface<Point>,
        outline: Option<&Outline>,
        progress: &dyn Progress,
    ) -> anyhow::Result<()> {
        let [u, v] = surface.knots();
        let faces: Vec<TrimmedFace> =
            outline.iter().flat_map(|o| &o.regions).map(|region| face(surface, region)).collect();
        let model = SplineSurface {
            degree: [u.degree(), v.degree()],
            knots: [u.values(), v.values()],
            points: surface.points(),
            faces: &faces,
        };
        if let Some(path) = &self.step {
            whole_file(path, |file| cad::step(file, &model))?;
        }
        if let Some(path) = &self.iges {
            whole_file(path, |file| cad::iges(file, &model))?;
        }
        if let Some(path) = &self.obj {
            let size = Aabb::of(surface.points()).diagonal();
            let chord = self.chord.unwrap_or(1e-4 * size).max(f64::MIN_POSITIVE);
            let mesh = match outline {
                Some(outline) => trimmed(surface, outline, chord, MOST_FACETS, progress)?,
                None => surface.tessellate(chord, MOST_FACETS, progress)?.map(|facets| facets.mesh),
            };
            let Some(mesh) = mesh else {
                bail!(
                    "{}: facets within {chord} mm would be more than {MOST_FACETS}; give a greater --chord",
                    path.display()
                );
            };
            trueness_files::write::mesh(path, &mesh)?;
        }
        Ok(())
    }
}

/// A region of the parameters as a face.
fn face(surface: &Surface<Point>, region: &OutlineRegion) -> TrimmedFace {
    let bound = |corners: &Vec<[f64; 2]>| {
        let next = corners.iter().cycle().skip(1);
        let sides = corners.iter().zip(next).map(|(a, b)| surface.over_line(*a, *b)).collect();
        Bound { corners: corners.clone(), sides }
    };
    TrimmedFace { outer: bound(&region.outer), holes: region.holes.iter().map(bound).collect() }
}
