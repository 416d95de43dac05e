//! The exact distance of points from a trimmed boundary.
//!
//! | task | where |
//! |---|---|
//! | prepare a boundary | [`Search::new`], [`Search::watched`] |
//! | nearest place of one point, of many | [`Search::nearest`], [`Search::map`] |
//! | what is asked of a trimmed face | [`Region`] |
//! | inside or outside | `side` |
//!
//! The nearest place of a face lies within it, where the distance from its surface has a minimum, or on its border. So there is a
//! finite list of candidates: all such minima of all surfaces that lie within their faces, the nearest place of each edge, and corners. Planes,
//! quadrics and tori have closed forms, swept surfaces those of their curves, and splines are searched piece by piece beyond doubt
//! ([`crate::surface::SurfaceFeet`]). A tree of boxes around parts of faces and edges leaves out what cannot be nearer than the best
//! candidate so far. A box may be too large, never too small: the answer does not hang on it. The twin in the tests tries all.
//!
//! Ties go to the lowest face, then to the lowest edge, then to the lowest corner. Where faces of two shells are about as near, as
//! where parts of an assembly touch, the point is inside if it is inside of one of them.

mod build;
mod cover;
mod face;
mod nearest;
mod region;
mod side;
#[cfg(test)]
mod tests;
mod tree;

pub use nearest::{Nearest, On, Side};
pub use region::Region;

use crate::brep::Brep;
use crate::curve;
use crate::surface::Foot;
use build::{Border, Prepared, Target, prepared};
use face::Face;
use nearest::{Best, Candidate};
use trueness_geom::closest::{QueryError, check_points};
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress, Silent};
use trueness_geom::space::{Point, Vector, minus, norm, plus, times};

/// A boundary, ready to be asked for nearest places.
pub struct Search<R>(Prepared<R>);

/// What a thread keeps from point to point.
struct Scratch {
    /// The last point at which each target was looked at.
    seen: Vec<u32>,
    point: u32,
    stack: Vec<(f64, u32)>,
}

/// Share of the distance within which a place is taken to ask for the side.
const SIDE_STEP_SHARE: f64 = 0.9;
/// Such steps at most: each leaves a tenth of the way along an edge.
const STEPS_BESIDE: usize = 12;
/// Points answered between two questions whether to go on.
const CHUNK: usize = 256;

impl<R: Region> Search<R> {
    /// Prepares a boundary; `regions` are those of its faces, in their order. Faces without one, and what only they use, are passed over.
    pub fn new(brep: &Brep, regions: Vec<Option<R>>) -> Search<R> {
        // Who is silent never stops.
        Search::watched(brep, regions, &Silent).unwrap_or_else(|Cancelled| Search(Prepared::none()))
    }

    /// As [`Search::new`], asking `progress` whether to go on; it hears of faces.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn watched(
        brep: &Brep,
        regions: Vec<Option<R>>,
        progress: &dyn Progress,
    ) -> Result<Search<R>, Cancelled> {
        Ok(Search(prepared(brep, regions, progress)?))
    }

    /// The nearest place of a point. A point that is not finite has a distance that is not.
    pub fn nearest(&self, p: &Point) -> Nearest {
        self.answer(p, &mut self.scratch())
    }

    /// `f(index, nearest)` of every point, in their order; the same on any number of threads.
    ///
    /// # Errors
    /// [`QueryError::BadPoint`] for a point that is not finite, [`QueryError::Cancelled`]. `progress` hears of points.
    pub fn map<T: Send>(
        &self,
        points: &[Point],
        progress: &dyn Progress,
        f: impl Fn(usize, Nearest) -> T + Sync,
    ) -> Result<Vec<T>, QueryError> {
        check_points(points)?;
        let chunk = |(n, part): (usize, &[Point])| -> Result<Vec<T>, QueryError> {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            let mut scratch = self.scratch();
            let found = part
                .iter()
                .enumerate()
                .map(|(i, p)| f(n * CHUNK + i, self.answer(p, &mut scratch)))
                .collect();
            progress.advance(part.len() as u64);
            Ok(found)
        };
        let parts: Result<Vec<Vec<T>>, QueryError> =
            points.par_chunks(CHUNK).enumerate().map(chunk).collect();
        Ok(parts?.into_iter().flatten().collect())
    }

    fn scratch(&self) -> Scratch {
        Scratch { seen: vec![0; self.0.targets.len()], point: 0, stack: vec![] }
    }

    fn answer(&self, p: &Point, scratch: &mut Scratch) -> Nearest {
        let mut own = self.describe(p, &self.best(p, scratch));
        if let (On::Vertex(vertex), Side::Unsure) = (own.on, own.side) {
            let ways = self.0.sides.edges_at(vertex);
            let side = ways.iter().find_map(|way| self.side_beside(p, own.distance, *way, scratch));
            own.side = side.unwrap_or(Side::Unsure);
        }
        own
    }

    /// The side at a corner by that beside it: no boundary is nearer than the distance, so all within has the same side. Along an edge
    /// other places become the nearest ones.
    fn side_beside(&self, p: &Point, distance: f64, way: Vector, scratch: &mut Scratch) -> Option<Side> {
        let (mut at, mut distance) = (*p, distance);
        for _ in 0..STEPS_BESIDE {
            at = plus(at, times(SIDE_STEP_SHARE * distance, way));
            let other = self.describe(&at, &self.best(&at, scratch));
            if matches!(other.side, Side::Outside | Side::Inside) {
                return Some(other.side);
            }
            distance = other.distance;
        }
        None
    }

    fn best(&self, p: &Point, scratch: &mut Scratch) -> Best {
        if !p.iter().all(|x| x.is_finite()) {
            return Best::none(self.0.rivals_within);
        }
        let (best, reach) = self.best_within(p, Some(self.0.touching), scratch);
        if best.own.distance <= reach { best } else { self.best_within(p, None, scratch).0 }
    }

    /// The best place, looked for with the help of known places or without, and how far it was looked for in the end.
    fn best_within(&self, p: &Point, slack: Option<f64>, scratch: &mut Scratch) -> (Best, f64) {
        scratch.point += 1;
        let mut best = Best::none(self.0.rivals_within);
        let Scratch { seen, point, stack } = scratch;
        let reach = self.0.boxes.visit(p, slack, stack, |target, reach| {
            let own = &mut seen[target as usize];
            if *own != *point {
                *own = *point;
                self.look(self.0.targets[target as usize], p, reach, &mut best);
            }
            best.reach()
        });
        (best, reach)
    }

    /// Takes the places of a target that are within a reach and better than the best one.
    fn look(&self, target: Target, p: &Point, reach: f64, best: &mut Best) {
        match target {
            Target::Unit { face, unit } => {
                let own = &self.0.faces[face as usize];
                let Face { feet, region: Some(region), shell, .. } = own else { return };
                let within = |best: &Best| best.reach_for(*shell).min(reach);
                feet.visit_unit(unit as usize, *p, within(best), &mut |foot| {
                    let Foot { parameters, place, distance } = foot;
                    if distance < within(best) && region.contains(parameters) {
                        let on = On::Face(face);
                        best.take(Candidate { distance, place, on, parameters, shell: *shell });
                    }
                    within(best)
                });
            }
            Target::Edge(edge) => {
                let border = &self.0.edges[edge as usize];
                if let Some(foot) = border.feet.nearer(*p, reach) {
                    let on = self.on_edge(edge, border, &foot);
                    let parameters =
                        if matches!(on, On::Edge(_)) { [foot.parameter; 2] } else { [f64::NAN; 2] };
                    let curve::Foot { distance, place, .. } = foot;
                    best.take(Candidate { distance, place, on, parameters, shell: None });
                }
            }
            Target::Vertex(vertex) => {
                let place = self.0.vertices[vertex as usize];
                let (on, parameters) = (On::Vertex(vertex), [f64::NAN; 2]);
                let distance = norm(minus(place, *p));
                best.take(Candidate { distance, place, on, parameters, shell: None });
            }
        }
    }

    /// The edge, or the corner at its end.
    fn on_edge(&self, edge: u32, border: &Border, foot: &curve::Foot) -> On {
        let Border { range: [from, to], vertices, .. } = border;
        match vertices {
            Some([first, _]) if self.is_at(*first, &foot.place) => On::Vertex(*first),
            Some([_, last]) if self.is_at(*last, &foot.place) => On::Vertex(*last),
            Some([first, _]) if foot.parameter == *from => On::Vertex(*first),
            Some([_, last]) if foot.parameter == *to => On::Vertex(*last),
            _ => On::Edge(edge),
        }
    }

    fn is_at(&self, vertex: u32, place: &Point) -> bool {
        self.0.vertices.get(vertex as usize).is_some_and(|v| norm(minus(*v, *place)) <= self.0.same)
    }

    fn describe(&self, p: &Point, best: &Best) -> Nearest {
        let Candidate { distance, place, on, parameters, .. } = best.own;
        if !distance.is_finite() {
            let distance = f64::NAN;
            return Nearest { distance, place, on, face: 0, parameters, side: Side::Unsure, normal: None };
        }
        let sides = |c: &Candidate| self.0.sides.of(&self.0.faces, p, c);
        let (face, mut side, normal) = sides(&best.own);
        if side == Side::Outside && best.rival.is_some_and(|rival| sides(&rival).1 == Side::Inside) {
            side = Side::Inside;
        }
        Nearest { distance, place, on, face, parameters, side, normal }
    }
}
