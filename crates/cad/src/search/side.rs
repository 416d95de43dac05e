//! On which side of a boundary a point is.
//!
//! Within a face its outward normal tells. On an edge or a corner it is the sum of the outward normals of all faces that meet there, each
//! weighted by the angle that the face takes there: as Bærentzen and Aanæs (Signed distance computation using the angle
//! weighted pseudonormal, IEEE Transactions on Visualization and Computer Graphics 11, 2005) prove for facets. Their proof looks at the
//! tangent planes alone, so it holds for bent faces as well, but where two of them touch: at the cutting edge of a lens the
//! normals cancel. There the face that bends most towards the point tells: it hides the other one.
//!
//! At the apex of a cone a face has no tangent plane: its normals around the apex are summed up.

use super::face::Face;
use super::nearest::{Candidate, On, Side};
use super::region::Region;
use crate::brep::{Bounds, Brep, Edge, EdgeUse, Loop};
use crate::stop::go_on;
use crate::surface::SurfaceFeet;
use std::f64::consts::{PI, TAU};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// What meets at edges and corners.
#[derive(Default)]
pub(super) struct Sides {
    edges: Vec<EdgeSides>,
    corners: Vec<Vec<Corner>>,
    /// The face of each side without an edge.
    side_faces: Vec<u32>,
    spans: Vec<Edge>,
}

#[derive(Default)]
struct EdgeSides {
    uses: Vec<Use>,
}

/// A face at an edge.
struct Use {
    face: u32,
    /// Whether its loop runs against the edge.
    reversed: bool,
    /// Parameters of the face along the edge, at equal steps; empty where they have a closed form.
    along: Vec<[f64; 2]>,
}

/// A face at a corner.
enum Corner {
    /// Between two edges of a loop.
    Between { face: u32, incoming: EdgeUse, outgoing: EdgeUse },
    /// All around it.
    Around(u32),
}

/// Steps at which parameters along an edge are kept.
const STEPS_ALONG: usize = 16;
/// Sine of the angle between two faces below which they touch: normals are known to about eight digits at an edge of a file.
const TOUCHING: f64 = 1e-6;
/// Cosine between a point's direction and the normal below which the side is not told.
const UNSURE: f64 = 1e-9;
/// Share of an edge at which its direction is taken where tangents coincide.
const CORNER_CHORD_SHARE: f64 = 1e-3;

impl Sides {
    pub(super) fn new<R: Region>(
        brep: &Brep,
        faces: &[Face<R>],
        side_faces: Vec<u32>,
        progress: &dyn Progress,
    ) -> Result<Sides, Cancelled> {
        let mut edges: Vec<EdgeSides> = brep.edges.iter().map(|_| EdgeSides::default()).collect();
        let mut corners: Vec<Vec<Corner>> = brep.vertices.iter().map(|_| vec![]).collect();
        for (number, (face, own)) in brep.faces.iter().zip(faces).enumerate() {
            let (Bounds::Loops(loops), Some(_)) = (&face.bounds, &own.region) else { continue };
            let number = number as u32;
            for l in loops {
                let uses = match l {
                    Loop::Vertex(vertex) => {
                        if let Some(corner) = corners.get_mut(*vertex as usize) {
                            corner.push(Corner::Around(number));
                        }
                        continue;
                    }
                    Loop::Edges(uses) => uses,
                };
                for (k, outgoing) in uses.iter().enumerate() {
                    go_on(progress)?;
                    let (Some(edge), Some(sides)) =
                        (brep.edges.get(outgoing.edge as usize), edges.get_mut(outgoing.edge as usize))
                    else {
                        continue;
                    };
                    let along = along(&own.feet, edge);
                    sides.uses.push(Use { face: number, reversed: outgoing.reversed, along });
                    let incoming = uses[(k + uses.len() - 1) % uses.len()];
                    let vertex = edge.vertices[usize::from(outgoing.reversed)];
                    if let Some(corner) = corners.get_mut(vertex as usize) {
                        corner.push(Corner::Between { face: number, incoming, outgoing: *outgoing });
                    }
                }
            }
        }
        Ok(Sides { edges, corners, side_faces, spans: brep.edges.clone() })
    }

    /// The face, the side and the normal at the best place.
    pub(super) fn of<R: Region>(
        &self,
        faces: &[Face<R>],
        p: &Point,
        best: &Candidate,
    ) -> (u32, Side, Option<Vector>) {
        let away = minus(*p, best.place);
        match best.on {
            On::Face(number) => {
                let face = &faces[number as usize];
                let normal = face.outward(best.parameters).or_else(|| {
                    let pole = face.pole_at(&best.place)?;
                    unit(face.around(&pole).0).map(|(n, _)| n)
                });
                (number, side(normal, away), normal)
            }
            On::Edge(edge) => match self.edges.get(edge as usize) {
                Some(own) => self.at_edge(faces, edge, own, best, away),
                None => {
                    let face = self.side_faces.get(edge as usize - self.edges.len()).copied().unwrap_or(0);
                    (face, Side::Open, None)
                }
            },
            On::Vertex(vertex) => self.at_corner(faces, vertex, best, away),
        }
    }

    fn at_edge<R: Region>(
        &self,
        faces: &[Face<R>],
        edge: u32,
        own: &EdgeSides,
        best: &Candidate,
        away: Vector,
    ) -> (u32, Side, Option<Vector>) {
        let first = own.uses.iter().map(|u| u.face).min().unwrap_or(0);
        let span = &self.spans[edge as usize].span;
        let share = span.share(best.parameters[0]);
        let at: Vec<(&Use, [f64; 2], Vector)> = own
            .uses
            .iter()
            .filter_map(|u| {
                let face = &faces[u.face as usize];
                let at = u.parameters(&face.feet, best.place, share);
                face.outward(at).map(|n| (u, at, n))
            })
            .collect();
        let sum = at.iter().fold([0.0; 3], |sum, (_, _, n)| plus(sum, *n));
        let normal = unit(sum).map(|(n, _)| n);
        if own.uses.len() < 2 {
            return (first, Side::Open, normal);
        }
        if norm(sum) < TOUCHING
            && let Some((own, _, up)) = at.first()
        {
            let tangent = span.derivatives(share)[1];
            let inward =
                |u: &Use, n: Vector| cross(n, if u.reversed { times(-1.0, tangent) } else { tangent });
            let up = if dot(*up, away) < 0.0 { times(-1.0, *up) } else { *up };
            let height = |(u, at, n): &(&Use, [f64; 2], Vector)| {
                let (way, _) = unit(inward(u, *n))?;
                Some((faces[u.face as usize].bend(*at, way, up)?, dot(*n, up)))
            };
            let heights: Vec<(f64, f64)> = at.iter().filter_map(height).collect();
            let tip = unit(inward(own, at[0].2)).map(|(b, _)| b);
            return (first, visible_side(&heights), tip.map(|b| times(-1.0, b)));
        }
        (first, side(normal, away), normal)
    }

    fn at_corner<R: Region>(
        &self,
        faces: &[Face<R>],
        vertex: u32,
        best: &Candidate,
        away: Vector,
    ) -> (u32, Side, Option<Vector>) {
        let Some(corners) = self.corners.get(vertex as usize) else { return (0, Side::Unsure, None) };
        let mut sum = [0.0; 3];
        let mut first = u32::MAX;
        let mut is_open = false;
        for corner in corners {
            match corner {
                Corner::Around(face) => {
                    first = first.min(*face);
                    let own = &faces[*face as usize];
                    let part = own.pole_at(&best.place).map_or([0.0; 3], |pole| own.around(&pole).0);
                    sum = plus(sum, part);
                }
                Corner::Between { face, incoming, outgoing } => {
                    first = first.min(*face);
                    is_open |= [incoming, outgoing]
                        .iter()
                        .any(|u| self.edges.get(u.edge as usize).is_none_or(|e| e.uses.len() < 2));
                    sum = plus(sum, self.sector(&faces[*face as usize], *incoming, *outgoing, best.place));
                }
            }
        }
        // What is left of normals that cancel is rounding.
        let normal = unit(sum).filter(|(_, length)| *length > TOUCHING).map(|(n, _)| n);
        let first = if first == u32::MAX { 0 } else { first };
        if is_open { (first, Side::Open, normal) } else { (first, side(normal, away), normal) }
    }

    /// Directions in which edges leave a corner.
    pub(super) fn edges_at(&self, vertex: u32) -> Vec<Vector> {
        let Some(corners) = self.corners.get(vertex as usize) else { return vec![] };
        let between = |corner: &Corner| match corner {
            Corner::Between { outgoing, .. } => Some(self.direction(*outgoing, false, 0.0)),
            Corner::Around(_) => None,
        };
        corners.iter().filter_map(between).collect()
    }

    /// The outward normal of a face at a corner times the angle between its edges there.
    fn sector<R: Region>(
        &self,
        face: &Face<R>,
        incoming: EdgeUse,
        outgoing: EdgeUse,
        place: Point,
    ) -> Vector {
        if let Some(pole) = face.pole_at(&place) {
            return face.around(&pole).0;
        }
        let Some(normal) = face.outward(face.feet.parameters(place, None)) else { return [0.0; 3] };
        let angle = |share: f64| {
            let out = self.direction(outgoing, false, share);
            let back = self.direction(incoming, true, share);
            let angle = libm::atan2(dot(normal, cross(out, back)), dot(out, back));
            if angle < 0.0 { angle + TAU } else { angle }
        };
        let mut own = angle(0.0);
        // Of edges that leave along the same tangent the chords tell which one is on the left.
        if !(TOUCHING..=TAU - TOUCHING).contains(&own) {
            own = if angle(CORNER_CHORD_SHARE) < PI { 0.0 } else { TAU };
        }
        times(own, normal)
    }

    /// The direction of an edge away from its start, or from its end, as its loop uses it: the tangent, or the chord over a share.
    fn direction(&self, u: EdgeUse, at_end: bool, share: f64) -> Vector {
        let Some(edge) = self.spans.get(u.edge as usize) else { return [0.0; 3] };
        let is_last = at_end != u.reversed;
        let from = if is_last { 1.0 } else { 0.0 };
        let sense = if is_last { -1.0 } else { 1.0 };
        let [place, first, _] = edge.span.derivatives(from);
        let chord = |share: f64| minus(edge.span.derivatives(from + sense * share)[0], place);
        let way = if share > 0.0 || norm(first) == 0.0 {
            chord(share.max(CORNER_CHORD_SHARE))
        } else {
            times(sense, first)
        };
        unit(way).map_or([0.0; 3], |(d, _)| d)
    }
}

/// Parameters of a face along an edge; none where asking for them is cheap.
fn along(feet: &SurfaceFeet, edge: &Edge) -> Vec<[f64; 2]> {
    if feet.units() == 1 {
        return vec![];
    }
    let mut near = None;
    (0..=STEPS_ALONG)
        .map(|i| {
            let place = edge.span.derivatives(i as f64 / STEPS_ALONG as f64)[0];
            let at = feet.parameters(place, near);
            near = Some(at);
            at
        })
        .collect()
}

impl Use {
    fn parameters(&self, feet: &SurfaceFeet, place: Point, share: f64) -> [f64; 2] {
        let step = (share * STEPS_ALONG as f64).round() as usize;
        feet.home(feet.parameters(place, self.along.get(step).copied()))
    }
}

/// The side by the highest of faces that touch, of which the height and the sense of the normal are given.
fn visible_side(heights: &[(f64, f64)]) -> Side {
    let greatest = heights.iter().fold(0.0, |m: f64, h| m.max(h.0.abs()));
    let top = |sense: f64| {
        heights.iter().filter(|h| h.1 * sense > 0.0).map(|h| h.0).fold(f64::NEG_INFINITY, f64::max)
    };
    match top(1.0) - top(-1.0) {
        d if d > TOUCHING * greatest => Side::Outside,
        d if d < -TOUCHING * greatest => Side::Inside,
        _ => Side::Unsure,
    }
}

/// The side of a direction by a normal.
fn side(normal: Option<Vector>, away: Vector) -> Side {
    let Some(normal) = normal else { return Side::Unsure };
    let (height, reach) = (dot(normal, away), norm(away));
    match height {
        _ if reach == 0.0 => Side::Outside,
        h if h.abs() <= UNSURE * reach => Side::Unsure,
        h if h > 0.0 => Side::Outside,
        _ => Side::Inside,
    }
}
