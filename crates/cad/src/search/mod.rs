//! The exact distance of points from a trimmed boundary.
//!
//! | task | where |
//! |---|---|
//! | prepare a boundary | [`Search::new`] |
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
//! Ties go to the lowest face, then to the lowest edge, then to the lowest corner.

mod build;
mod cover;
mod side;
#[cfg(test)]
mod tests;
mod tree;

use crate::brep::Brep;
use crate::curve::CurveFeet;
use crate::surface::SurfaceFeet;
use crate::trim::Trim;
use side::Sides;
use tree::Boxes;
use trueness_geom::closest::{QueryError, check_points};
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, Vector, minus, norm, plus, times};

pub use side::Side;

/// What of its surface a face is, as the search asks it.
pub trait Region: Sync + Send {
    /// Whether the face has the place with these parameters, whatever number of periods they are away. Its border belongs to it.
    fn contains(&self, at: [f64; 2]) -> bool;
    /// First and last `u`, first and last `v` of the face, on one sheet where parameters repeat.
    fn window(&self) -> [[f64; 2]; 2];
}

impl Region for Trim {
    fn contains(&self, at: [f64; 2]) -> bool {
        Trim::contains(self, at)
    }
    fn window(&self) -> [[f64; 2]; 2] {
        self.window
    }
}

/// What the nearest place lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum On {
    /// Within a face.
    Face(u32),
    /// On an edge, or on a side of a face that has none.
    Edge(u32),
    /// On a corner.
    Vertex(u32),
}

/// The place of a boundary nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its distance; NaN for a boundary without faces.
    pub distance: f64,
    /// The place.
    pub place: Point,
    /// What it lies on. Edges beyond those of the boundary are sides of faces without edges.
    pub on: On,
    /// The face, of several that meet there the lowest.
    pub face: u32,
    /// Parameters within a face; on an edge its own parameter, twice; on a corner NaN.
    pub parameters: [f64; 2],
    /// On which side the point is.
    pub side: Side,
    /// The unit outward normal: of the face, or of all faces that meet there, weighted by their angles. `None` where they have none together.
    pub normal: Option<Vector>,
}

impl Nearest {
    /// The distance, below 0 inside; `None` where the side is not known.
    pub fn signed(&self) -> Option<f64> {
        match self.side {
            Side::Outside => Some(self.distance),
            Side::Inside => Some(-self.distance),
            Side::Open | Side::Unsure => None,
        }
    }
}

/// A boundary, ready to be asked for nearest places.
pub struct Search<R> {
    faces: Vec<Face<R>>,
    edges: Vec<Border>,
    vertices: Vec<Point>,
    targets: Vec<Target>,
    boxes: Boxes,
    sides: Sides,
    /// Distance within which a place of an edge is its end.
    same: f64,
}

/// A face.
struct Face<R> {
    feet: SurfaceFeet,
    /// `None` where nothing is known of it.
    region: Option<R>,
    is_reversed: bool,
}

/// An edge, or a side of a face that has none.
struct Border {
    feet: CurveFeet,
    range: [f64; 2],
    vertices: Option<[u32; 2]>,
}

/// What a box of the tree is around.
#[derive(Clone, Copy, Debug)]
enum Target {
    Unit { face: u32, unit: u32 },
    Edge(u32),
    Vertex(u32),
}

/// The best candidate so far.
#[derive(Clone, Copy)]
struct Best {
    distance: f64,
    place: Point,
    on: On,
    parameters: [f64; 2],
}

/// What a thread keeps from point to point.
struct Scratch {
    /// The last point at which each target was looked at.
    seen: Vec<u32>,
    point: u32,
    stack: Vec<(f64, u32)>,
}

/// Share of the distance within which a place is taken to ask for the side.
const WITHIN: f64 = 0.9;
/// Such steps at most: each leaves a tenth of the way along an edge.
const STEPS_BESIDE: usize = 12;
/// Points answered between two questions whether to go on.
const CHUNK: usize = 256;

impl<R: Region> Search<R> {
    /// Prepares a boundary; `regions` are those of its faces, in their order. Faces without one, and what only they use, are passed over.
    pub fn new(brep: &Brep, regions: Vec<Option<R>>) -> Search<R> {
        build::search(brep, regions)
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
        Scratch { seen: vec![0; self.targets.len()], point: 0, stack: vec![] }
    }

    fn answer(&self, p: &Point, scratch: &mut Scratch) -> Nearest {
        let mut own = self.describe(p, self.best(p, scratch));
        if let (On::Vertex(vertex), Side::Unsure) = (own.on, own.side) {
            let ways = self.sides.edges_at(vertex);
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
            at = plus(at, times(WITHIN * distance, way));
            let other = self.describe(&at, self.best(&at, scratch));
            if matches!(other.side, Side::Outside | Side::Inside) {
                return Some(other.side);
            }
            distance = other.distance;
        }
        None
    }

    fn best(&self, p: &Point, scratch: &mut Scratch) -> Best {
        scratch.point += 1;
        let mut best = Best::NONE;
        if p.iter().all(|x| x.is_finite()) {
            let Scratch { seen, point, stack } = scratch;
            self.boxes.visit(p, stack, |target| {
                let own = &mut seen[target as usize];
                if *own != *point {
                    *own = *point;
                    self.look(self.targets[target as usize], p, &mut best);
                }
                best.distance
            });
        }
        best
    }

    /// Takes the places of a target that are better than the best one.
    fn look(&self, target: Target, p: &Point, best: &mut Best) {
        match target {
            Target::Unit { face, unit } => {
                let Face { feet, region: Some(region), .. } = &self.faces[face as usize] else { return };
                // What is as near counts as well: the lower face is taken.
                feet.visit_unit(unit as usize, *p, best.distance.next_up(), &mut |foot| {
                    let own = Best {
                        distance: foot.distance,
                        place: foot.place,
                        on: On::Face(face),
                        parameters: foot.parameters,
                    };
                    if own.is_before(best) && region.contains(foot.parameters) {
                        *best = own;
                    }
                    best.distance.next_up()
                });
            }
            Target::Edge(edge) => {
                let border = &self.edges[edge as usize];
                if let Some(foot) = border.feet.nearer(*p, best.distance.next_up()) {
                    let Border { range: [from, to], vertices, .. } = border;
                    let on = match vertices {
                        Some([first, _]) if self.is_at(*first, &foot.place) => On::Vertex(*first),
                        Some([_, last]) if self.is_at(*last, &foot.place) => On::Vertex(*last),
                        Some([first, _]) if foot.parameter == *from => On::Vertex(*first),
                        Some([_, last]) if foot.parameter == *to => On::Vertex(*last),
                        _ => On::Edge(edge),
                    };
                    let parameters =
                        if matches!(on, On::Edge(_)) { [foot.parameter; 2] } else { [f64::NAN; 2] };
                    best.take(Best { distance: foot.distance, place: foot.place, on, parameters });
                }
            }
            Target::Vertex(vertex) => {
                let place = self.vertices[vertex as usize];
                let (on, parameters) = (On::Vertex(vertex), [f64::NAN; 2]);
                best.take(Best { distance: norm(minus(place, *p)), place, on, parameters });
            }
        }
    }

    fn is_at(&self, vertex: u32, place: &Point) -> bool {
        self.vertices.get(vertex as usize).is_some_and(|v| norm(minus(*v, *place)) <= self.same)
    }

    fn describe(&self, p: &Point, best: Best) -> Nearest {
        let Best { distance, place, on, parameters } = best;
        if !distance.is_finite() {
            let distance = f64::NAN;
            return Nearest { distance, place, on, face: 0, parameters, side: Side::Unsure, normal: None };
        }
        let (face, side, normal) = self.sides.of(&self.faces, p, &best);
        Nearest { distance, place, on, face, parameters, side, normal }
    }
}

impl Best {
    const NONE: Best = Best {
        distance: f64::INFINITY,
        place: [f64::NAN; 3],
        on: On::Vertex(u32::MAX),
        parameters: [f64::NAN; 2],
    };

    fn is_before(&self, other: &Best) -> bool {
        self.distance < other.distance || self.distance == other.distance && self.on < other.on
    }

    fn take(&mut self, other: Best) {
        if other.is_before(self) {
            *self = other;
        }
    }
}
