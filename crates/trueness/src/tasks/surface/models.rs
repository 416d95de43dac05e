//! Models of a surface for CAD programs and viewers.

use super::request::SurfaceRequest;
use crate::task::{Output, TaskError};
use trueness_files::cad::{self, Bound, SplineSurface, TrimmedFace};
use trueness_files::write::MeshFile;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Aabb, Point};
use trueness_geom::spline::surface::Surface;
use trueness_surface::{Outline, OutlineRegion, trimmed};

/// Facets that are written at most.
const MAX_WRITTEN_FACETS: usize = 20_000_000;

/// Writes the models that were asked for.
pub fn write(
    request: &SurfaceRequest,
    surface: &Surface<Point>,
    outline: Option<&Outline>,
    progress: &dyn Progress,
) -> Result<Vec<Output>, TaskError> {
    let [u, v] = surface.knots();
    let faces: Vec<TrimmedFace> =
        outline.iter().flat_map(|o| &o.regions).map(|region| face(surface, region)).collect();
    let model = SplineSurface {
        degree: [u.degree(), v.degree()],
        knots: [u.values(), v.values()],
        points: surface.points(),
        faces: &faces,
    };
    let mut all = vec![];
    if let Some(path) = &request.step {
        all.push(Output::written(path, |file| cad::step(file, &model))?);
    }
    if let Some(path) = &request.iges {
        all.push(Output::written(path, |file| cad::iges(file, &model))?);
    }
    if let Some(path) = &request.obj {
        let size = Aabb::of(surface.points()).diagonal();
        let chord = request.chord.unwrap_or(1e-4 * size).max(f64::MIN_POSITIVE);
        let mesh = match outline {
            Some(outline) => trimmed(surface, outline, chord, MAX_WRITTEN_FACETS, progress)?,
            None => surface.tessellate(chord, MAX_WRITTEN_FACETS, progress)?.map(|facets| facets.mesh),
        };
        let mesh = mesh.ok_or_else(|| {
            TaskError::unanswerable(format!(
                "{}: facets within {chord} mm would be more than {MAX_WRITTEN_FACETS}; give a greater --chord",
                path.display()
            ))
        })?;
        let file = MeshFile::write(path, &mesh)?;
        all.push(Output::later(move || file.finish()));
    }
    Ok(all)
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
