//! Faces of a CAD model as a target: facets find the candidates, and all numbers come from the faces themselves.

use super::along::{AlongRule, Lines};
use super::excluded::Excluded;
use super::kept::{Asked, Kept, Measures, Nearest, none};
use super::worst::WorstPoint;
use crate::cad_faces::{CadFaces, deviation};
use std::sync::Arc;
use trueness_cad::search::{Nearest as CadNearest, Side};
use trueness_cad::surface::SurfaceFeet;
use trueness_geom::closest::{Closest, Crossing, QueryError, Tree};
use trueness_geom::deviation::sign_choice::SignChoice;
use trueness_geom::deviation::surface::{OnlyCancels, SurfaceOptions};
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Progress, Silent};
use trueness_geom::space::{Point, Vector, dot, minus, norm, plus, times, unit};

/// Faces of a CAD model with what is asked of them; `tree` finds the facet that draws a place.
pub struct CadTarget<'a> {
    pub faces: &'a CadFaces,
    pub tree: &'a Tree,
    pub options: SurfaceOptions,
    pub choice: SignChoice,
    along: Option<Along>,
}

/// Lines that are measured along, and the surfaces that they meet.
struct Along {
    rule: AlongRule,
    normals: Arc<[Vector]>,
    surfaces: Vec<SurfaceFeet>,
}

/// What is kept of a point, and its face.
struct OnFace {
    kept: Kept,
    /// Whether its side and its place are beyond doubt.
    is_certain: bool,
    face: u32,
}

/// Where a line meets a face.
#[derive(Clone, Copy)]
struct Met {
    /// How far from the point, mm.
    distance: f64,
    place: Point,
    normal: Option<Vector>,
    /// Of the facet that was met on the way.
    facet: u32,
    weights: [f64; 3],
    /// Whether the place is that of the face and not of the facet.
    is_exact: bool,
}

/// Steps from a facet to its surface: each doubles the digits.
const MAX_CROSSING_STEPS: usize = 24;
/// Share of the coordinates within which a place of a line lies on a surface: some hundred roundings.
const MAX_LIFT_SHARE: f64 = 1e-13;
/// So many times as far along its line as the facet is off its face, a crossing may lie from that of the facet.
const MAX_STEP_RATIO: f64 = 4.0;

impl<'a> CadTarget<'a> {
    pub fn new(
        faces: &'a CadFaces,
        tree: &'a Tree,
        options: SurfaceOptions,
        lines: Option<&Lines>,
    ) -> CadTarget<'a> {
        let along = lines.map(|lines| Along {
            rule: lines.rule(),
            normals: lines.normals(),
            surfaces: faces.faces.par_iter().map(|face| SurfaceFeet::new(&face.surface)).collect(),
        });
        CadTarget { faces, tree, options, choice: SignChoice::by_normal(options.sign), along }
    }

    /// Deviations of points, the first with number `asked.start`, and their places in a map.
    pub fn measure(
        &self,
        points: &[Point],
        asked: &Asked,
        progress: &dyn Progress,
    ) -> Result<Measures, QueryError> {
        let near = self
            .faces
            .search
            .map(points, progress, |i, near| (deviation(&points[i], &near, &self.options), near))?;
        let found: Vec<OnFace> = match &self.along {
            None => (0..points.len()).into_par_iter().map(|i| self.at_nearest(i, near[i], asked)).collect(),
            Some(along) => self.along_lines(along, points, &near, asked, &OnlyCancels(progress))?,
        };
        let uncertain = found.iter().filter(|f| !f.is_certain).count() as u64;
        let faces = found.iter().map(|f| f.face).collect();
        let kept = found.into_iter().map(|f| f.kept).collect();
        Ok(Measures { uncertain, faces, ..Measures::of(kept, asked) })
    }

    /// What is kept of a point at its nearest place, and whether its side is certain.
    fn at_nearest(&self, i: usize, (deviation, near): (f64, CadNearest), asked: &Asked) -> OnFace {
        let of = |kept| OnFace { kept, is_certain: near.side != Side::Unsure, face: near.face };
        if !deviation.is_finite() {
            return of(none(deviation));
        }
        if !asked.agrees(i, || near.normal) {
            return of(none(Excluded::Facing.value()));
        }
        let drawn = || self.tree.closest(&near.place, f64::INFINITY).ok().flatten();
        of(match asked.needs_place(i).then(drawn).flatten() {
            Some(at) => asked.kept(i, deviation, at.face, at.barycentric, &near.place),
            None => none(deviation),
        })
    }

    /// The same where lines meet the faces.
    fn along_lines(
        &self,
        along: &Along,
        points: &[Point],
        near: &[(f64, CadNearest)],
        asked: &Asked,
        progress: &dyn Progress,
    ) -> Result<Vec<OnFace>, QueryError> {
        let direction = |i: usize| along.direction(asked.start + i as u64, &near[i].1);
        let line = |i: usize| direction(i).filter(|_| near[i].0.is_finite());
        let crossings =
            self.tree.map_crossings(points, line, f64::INFINITY, progress, |_, crossing| crossing)?;
        let kept = |i: usize| {
            let (deviation, nearest) = near[i];
            let is_certain = nearest.side != Side::Unsure;
            let of = |kept, is_certain, face| OnFace { kept, is_certain, face };
            if !deviation.is_finite() {
                return of(none(deviation), is_certain, nearest.face);
            }
            let left_out = |why: Excluded| of(none(why.value()), true, nearest.face);
            let Some(way) = direction(i) else { return left_out(Excluded::NoDirection) };
            let met = crossings[i].map(|c| self.met(along, &points[i], way, &c));
            let Some(met) = met.filter(|met| met.distance <= self.options.max_distance) else {
                return left_out(Excluded::NoCrossing);
            };
            if !asked.agrees(i, || met.normal) {
                return left_out(Excluded::Facing);
            }
            let kept = asked.kept(i, met.distance.copysign(deviation), met.facet, met.weights, &met.place);
            of(kept, is_certain && met.is_exact, self.faces.drawn.of_facet[met.facet as usize])
        };
        Ok((0..points.len()).into_par_iter().map(kept).collect())
    }

    /// Where a line meets the surface of the face whose facet it meets: Newton's steps from there; where they lead away, as on a line
    /// that grazes the face, the place of the facet.
    fn met(&self, along: &Along, p: &Point, way: Vector, crossing: &Crossing) -> Met {
        let face = self.faces.drawn.of_facet[crossing.face as usize] as usize;
        let (way, _) = unit(way).unwrap_or((way, 1.0));
        let (surface, turned) = (&along.surfaces[face], self.faces.faces[face].is_reversed);
        let (mut t, mut reach, mut found) = (crossing.along, None, None);
        for _ in 0..MAX_CROSSING_STEPS {
            let at = plus(*p, times(t, way));
            let foot = surface.nearest(at);
            let [u, v] = foot.parameters;
            let Some(normal) = surface.surface().normal(u, v) else { break };
            let off = dot(normal, minus(at, foot.place));
            let step = off / dot(normal, way);
            // The first step is about as long as the facet is off its face.
            let rounding = MAX_LIFT_SHARE * (norm(*p) + norm(foot.place));
            let limit = *reach.get_or_insert(MAX_STEP_RATIO * step.abs() + rounding);
            if !step.is_finite() || (t - step - crossing.along).abs() > limit {
                break;
            }
            if off.abs() <= rounding {
                found = Some((foot.place, if turned { times(-1.0, normal) } else { normal }));
                break;
            }
            t -= step;
        }
        let is_exact = found.is_some();
        let (place, normal) = match found {
            Some((place, normal)) => (place, Some(normal)),
            None => (crossing.point, None),
        };
        let distance = if is_exact { t.abs() } else { crossing.along.abs() };
        Met { distance, place, normal, facet: crossing.face, weights: crossing.barycentric, is_exact }
    }

    /// Where a point is nearest, or where its line meets the faces; `None` for one that cannot be measured.
    pub fn nearest(&self, place: &WorstPoint) -> Result<Option<Nearest>, QueryError> {
        let near = self.faces.search.nearest(&place.point);
        if !near.distance.is_finite() {
            return Ok(None);
        }
        if let Some(along) = &self.along {
            let way = along.direction(place.index, &near);
            let points = [place.point];
            let crossing = self.tree.map_crossings(&points, |_| way, f64::INFINITY, &Silent, |_, c| c)?[0];
            let met = crossing.zip(way).map(|(c, way)| self.met(along, &place.point, way, &c));
            return Ok(met.map(|met| Nearest {
                place: met.place,
                normal: met.normal,
                face: met.facet,
                weights: met.weights,
            }));
        }
        let drawn = self.tree.closest(&near.place, f64::INFINITY)?;
        Ok(drawn.map(|Closest { face, barycentric: weights, .. }| Nearest {
            place: near.place,
            normal: near.normal,
            face,
            weights,
        }))
    }
}

impl Along {
    /// The direction of the line of a point by its number; `None` where it has none.
    fn direction(&self, index: u64, near: &CadNearest) -> Option<Vector> {
        let way = match self.rule {
            AlongRule::Direction(way) => Some(way),
            AlongRule::Reference => near.normal,
            AlongRule::Measured => usize::try_from(index).ok().and_then(|i| self.normals.get(i)).copied(),
        };
        way.filter(|d| d.iter().any(|x| *x != 0.0) && d.iter().all(|x| x.is_finite()))
    }
}
