//! A mesh laid into the plane: two parameters for each vertex.
//!
//! First it is laid within a circle, where no facet can turn over
//! (`mean_value`). From there it is relaxed with a free rim until lengths are kept as far as they can be (`relax`).
//! Surfaces that can be unrolled are unrolled. Where the rim crosses itself then, as that of a spiral may, the mesh is
//! left within the circle.

mod disc;
mod mean_value;
mod relax;
#[cfg(test)]
mod tests;
mod triangle;

use super::SurfaceError;
use super::crossing::cross;
use disc::Disc;
use triangle::Triangle;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::predicates::side_of_line;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;

/// A mesh in the plane.
#[derive(Clone, Debug)]
pub(super) struct Flat {
    /// The place of each vertex, millimeters.
    pub places: Vec<[f64; 2]>,
    /// Factors by which lengths of facets grew: 1 % of the area has less, 1 % more.
    pub stretch: [f64; 2],
    /// Share of the vertices at facets that are turned over.
    pub folded_share: f64,
    /// Whether the rim lies on a circle.
    pub round: bool,
}

/// Share of the area that may be stretched by less, and by more, than is told.
const MAX_UNTOLD_AREA_SHARE: f64 = 0.01;

/// Lays a mesh into the plane.
///
/// Cost: some dozens of rounds over the facets; memory about 1 kB a vertex.
pub(super) fn flatten(mesh: &Mesh, progress: &dyn Progress) -> Result<Flat, SurfaceError> {
    let disc = Disc::of(mesh, progress)?;
    let triangles: Vec<Triangle> =
        disc.faces.par_iter().map(|face| Triangle::of(mesh.places(face))).collect();
    let area = triangles.iter().map(|t| 0.5 * t.doubled_area()).sum();
    let circle = mean_value::within_circle(&mesh.positions, &disc, area, progress)?;
    let mut places = circle.clone();
    let mut folded_share = turned_over(&disc, &places);
    let mut round = true;
    if folded_share == 0.0 {
        relax::relax(&disc, &triangles, &mut places, progress)?;
        folded_share = turned_over(&disc, &places);
        round = folded_share > 0.0 || cross(&disc.rims, &places);
        if round {
            (places, folded_share) = (circle, 0.0);
        }
    }
    let stretch = stretch(&disc, &triangles, &places);
    Ok(Flat { places, stretch, folded_share, round })
}

/// Share of the vertices at facets that do not run against the clock.
fn turned_over(disc: &Disc, places: &[[f64; 2]]) -> f64 {
    let mut at = vec![false; places.len()];
    for face in &disc.faces {
        let [a, b, c] = face.map(|v| [places[v as usize][0], places[v as usize][1], 0.0]);
        if side_of_line(2, &a, &b, &c) <= 0 {
            face.iter().for_each(|v| at[*v as usize] = true);
        }
    }
    at.iter().filter(|at| **at).count() as f64 / at.len() as f64
}

/// The factors by which lengths grew, less the least and the greatest ones.
fn stretch(disc: &Disc, triangles: &[Triangle], places: &[[f64; 2]]) -> [f64; 2] {
    let found: Vec<([f64; 2], f64)> = disc
        .faces
        .iter()
        .zip(triangles)
        .map(|(face, t)| (t.stretch(face.map(|v| places[v as usize])), t.doubled_area()))
        .collect();
    let area: f64 = found.iter().map(|f| f.1).sum();
    let after = |mut all: Vec<(f64, f64)>| {
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut passed = 0.0;
        let end = all.iter().find(|(_, own)| {
            passed += own;
            passed > MAX_UNTOLD_AREA_SHARE * area
        });
        end.map_or(0.0, |(value, _)| *value)
    };
    let least = after(found.iter().map(|(s, own)| (s[0], *own)).collect());
    [least, -after(found.iter().map(|(s, own)| (-s[1], *own)).collect())]
}
