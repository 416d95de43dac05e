//! Facets of faces, within a distance of their surfaces.
//!
//! An edge is one polyline for all faces that it bounds, so facets meet vertex by vertex and a closed shell is watertight however coarse
//! it is. Within a face, facets are those of the constrained Delaunay triangulation in parameters that are scaled to the cells of
//! a grid: a cell is as large as the surface's bends allow. Facets that turn out too far from the surface are cut,
//! edges too, until all keep to the tolerance. Sides that are a single place have a single vertex.

mod bend;
mod edges;
mod face;
mod lines;
mod net;
mod polygon;
#[cfg(test)]
mod tests;

pub use bend::Bound;
pub use edges::Polyline;
pub use lines::Fineness;

use crate::brep::Brep;
use crate::trim::Trim;
use face::{FaceFacets, Outcome, facets};
use polygon::Source;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};

/// A part as facets.
#[derive(Clone, Debug, Default)]
pub struct Tessellation {
    /// Facets look out of the material. Vertices of edges come first.
    pub mesh: Mesh,
    /// The face of each facet.
    pub faces: Vec<u32>,
    /// Parameters of the corners of each facet, on the surface of its face; at a pole the one that may be any number lies between those of
    /// the other corners.
    pub parameters: Vec<[[f64; 2]; 3]>,
    /// For each face how far its facets are from it at most, and it from them, the gap of its edges included; `None` where it has none.
    pub bounds: Vec<Option<Bound>>,
    /// For each edge its places; empty for edges that bound no face.
    pub edges: Vec<Polyline>,
    /// Faces that could not be divided, and why.
    pub failed: Vec<(u32, String)>,
}

/// Why a part is not tessellated.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TessellateError {
    /// [`Cancelled`].
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// More facets than are allowed.
    #[error(
        "{facets} facets or more would be needed, {most} are allowed; with a tolerance of {tolerance} mm they are about that many"
    )]
    TooMany {
        /// About how many.
        facets: usize,
        /// How many are allowed.
        most: usize,
        /// The tolerance that would do, millimeters.
        tolerance: f64,
    },
}

/// Rounds in which edges are made finer where faces need it.
const MAX_ROUNDS: usize = 12;

impl Tessellation {
    /// Of a part, with the trims of its faces: `None` for a face that has no inside, which is then left out. At most `most` facets.
    ///
    /// A face that cannot be divided is told in [`Tessellation::failed`]; the others stand. Progress is told face by face. Cost: about
    /// 10 µs for each facet.
    ///
    /// # Errors
    /// [`TessellateError`].
    pub fn new(
        brep: &Brep,
        trims: &[Option<&Trim>],
        fineness: Fineness,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<Tessellation, TessellateError> {
        let required = edges::required(brep, trims);
        let shares: Vec<Vec<f64>> = (0..brep.edges.len())
            .into_par_iter()
            .map(|e| edges::shares(brep, e, &required[e], fineness))
            .collect();
        // Places that are added later have later numbers, so faces that do not see them stand.
        let (mut polylines, mut positions) = edges::numbered(brep, shares);
        let mut outcomes: Vec<Option<Outcome>> = trims.iter().map(|_| None).collect();
        let mut stale: Vec<usize> = (0..trims.len()).filter(|f| trims[*f].is_some()).collect();
        for round in 0..=MAX_ROUNDS {
            let made: Result<Vec<Outcome>, Cancelled> = stale
                .par_iter()
                .map(|f| {
                    if progress.cancelled() {
                        return Err(Cancelled);
                    }
                    let own = |t| facets(t, (&polylines, &positions), fineness, most, progress);
                    let outcome = trims[*f].map(own).transpose()?;
                    if round == 0 {
                        progress.advance(1);
                    }
                    Ok(outcome.unwrap_or(Outcome::Failed("it has no inside")))
                })
                .collect();
            for (f, outcome) in stale.iter().zip(made?) {
                outcomes[*f] = Some(outcome);
            }
            check_count(&outcomes, most, fineness)?;
            if round == MAX_ROUNDS {
                break;
            }
            let wanted = outcomes
                .iter()
                .flatten()
                .filter_map(|o| if let Outcome::Finer(w, _) = o { Some(w) } else { None });
            let touched = edges::insert(brep, wanted.flatten(), &mut polylines, &mut positions);
            if touched.is_empty() {
                break;
            }
            let is_touched = |t: &Trim| t.edges.iter().any(|e| touched.binary_search(e).is_ok());
            stale = (0..trims.len()).filter(|f| trims[*f].is_some_and(is_touched)).collect();
        }
        Ok(merged(outcomes, polylines, positions))
    }
}

/// Whether there are too many facets, and with which tolerance there were not.
fn check_count(outcomes: &[Option<Outcome>], most: usize, fineness: Fineness) -> Result<(), TessellateError> {
    let count = |outcome: &Outcome| match outcome {
        Outcome::Done(f) | Outcome::Finer(_, Some(f)) => f.facets.len(),
        Outcome::TooMany(n) => *n,
        Outcome::Finer(_, None) | Outcome::Failed(_) => 0,
    };
    let facets = outcomes.iter().flatten().map(count).fold(0, usize::saturating_add);
    if facets <= most {
        return Ok(());
    }
    // Facets are inverse to the tolerance where surfaces bend both ways, and fewer than that where they do not.
    let tolerance = fineness.distance * facets as f64 / most.max(1) as f64;
    Err(TessellateError::TooMany { facets, most, tolerance })
}

/// One mesh of the facets of all faces.
fn merged(
    outcomes: Vec<Option<Outcome>>,
    edges: Vec<Polyline>,
    positions: Vec<trueness_geom::space::Point>,
) -> Tessellation {
    let mut all = Tessellation { mesh: Mesh { positions, faces: vec![] }, edges, ..Tessellation::default() };
    for (number, outcome) in outcomes.into_iter().enumerate() {
        let number = number as u32;
        let own: Option<FaceFacets> = match outcome {
            None => None,
            Some(Outcome::Done(own) | Outcome::Finer(_, Some(own))) => Some(own),
            Some(Outcome::Failed(why)) => {
                all.failed.push((number, why.to_string()));
                None
            }
            Some(Outcome::Finer(_, None) | Outcome::TooMany(_)) => {
                all.failed
                    .push((number, "its edges touch or cross in the parameters of its surface".to_string()));
                None
            }
        };
        all.bounds.push(own.as_ref().map(|o| o.bound));
        let Some(own) = own else { continue };
        let mut numbers = vec![];
        for source in &own.vertices {
            numbers.push(match source {
                Source::Shared(v) => *v,
                Source::Own(place) => {
                    all.mesh.positions.push(*place);
                    (all.mesh.positions.len() - 1) as u32
                }
            });
        }
        all.faces.extend(own.facets.iter().map(|_| number));
        all.mesh.faces.extend(own.facets.iter().map(|f| f.map(|v| numbers[v])));
        all.parameters.extend(own.parameters);
    }
    all
}
