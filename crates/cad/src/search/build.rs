//! Takes a boundary apart for the search.

use super::cover::{self, cover_of_face, pieces_of_edge};
use super::face::Face as Searched;
use super::region::Region;
use super::side::Sides;
use super::tree::{Boxes, Item};
use crate::brep::{Bounds, Brep, Edge, Face, Loop};
use crate::curve::CurveFeet;
use crate::stop::go_on;
use crate::surface::SurfaceFeet;
use std::collections::BTreeMap;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Aabb, Point};

/// A boundary taken apart.
pub(super) struct Prepared<R> {
    pub(super) faces: Vec<Searched<R>>,
    pub(super) edges: Vec<Border>,
    pub(super) vertices: Vec<Point>,
    pub(super) targets: Vec<Target>,
    pub(super) boxes: Boxes,
    pub(super) sides: Sides,
    /// Distance within which a place of an edge is its end.
    pub(super) same: f64,
    /// Distance within which places are about as near.
    pub(super) touching: f64,
    /// The same for faces of two shells; 0 where there is only one.
    pub(super) rivals_within: f64,
}

/// An edge, or a side of a face that has none.
pub(super) struct Border {
    pub(super) feet: CurveFeet,
    pub(super) range: [f64; 2],
    /// Where it starts and ends.
    pub(super) vertices: Option<[u32; 2]>,
}

/// What a box of the tree is around.
#[derive(Clone, Copy, Debug)]
pub(super) enum Target {
    Unit { face: u32, unit: u32 },
    Edge(u32),
    Vertex(u32),
}

/// Share of the boundary's size within which a place of an edge is its end.
const END_OF_EDGE_SHARE: f64 = 1e-12;
/// Share within which parts touch: files have some ten digits.
const TOUCHING_SHELLS: f64 = 1e-9;
/// So many boxes in a row reach from one end of the boundary to the other.
const BOXES_OF_SIZE: f64 = 24.0;

/// Faces and their borders, before there are boxes around them.
struct Parts<R> {
    faces: Vec<Searched<R>>,
    edges: Vec<Border>,
    /// Whether a face with a region uses the edge.
    used: Vec<bool>,
    /// The edges around each face.
    around: Vec<Vec<usize>>,
    /// Vertices that are a loop of their own.
    corners: Vec<u32>,
    /// The face of each border beyond the edges.
    side_faces: Vec<u32>,
}

/// Takes apart the faces that have a region, and their borders.
pub(super) fn prepared<R: Region>(
    brep: &Brep,
    regions: Vec<Option<R>>,
    progress: &dyn Progress,
) -> Result<Prepared<R>, Cancelled> {
    let parts = Parts::new(brep, regions, progress)?;
    let vertices: Vec<Point> = brep.vertices.iter().map(|v| v.place).collect();
    let size = parts.extent().diagonal();
    let (targets, boxes) = parts.boxes(&vertices, size / BOXES_OF_SIZE, progress)?;
    let Parts { faces, edges, side_faces, .. } = parts;
    let sides = Sides::new(brep, &faces, side_faces, progress)?;
    let touching = TOUCHING_SHELLS * size;
    let has_rivals = faces.windows(2).any(|w| w[0].shell != w[1].shell);
    Ok(Prepared {
        faces,
        edges,
        vertices,
        targets,
        boxes: Boxes::new(boxes),
        sides,
        same: END_OF_EDGE_SHARE * size,
        touching,
        rivals_within: if has_rivals { touching } else { 0.0 },
    })
}

impl<R> Prepared<R> {
    /// A boundary without faces.
    pub(super) fn none() -> Prepared<R> {
        Prepared {
            faces: vec![],
            edges: vec![],
            vertices: vec![],
            targets: vec![],
            boxes: Boxes::new(vec![]),
            sides: Sides::default(),
            same: 0.0,
            touching: 0.0,
            rivals_within: 0.0,
        }
    }
}

impl<R: Region> Parts<R> {
    fn new(brep: &Brep, regions: Vec<Option<R>>, progress: &dyn Progress) -> Result<Parts<R>, Cancelled> {
        let border = |edge: &Edge| Border {
            feet: edge.span.feet(),
            range: edge.span.range,
            vertices: Some(edge.vertices),
        };
        let mut parts = Parts {
            faces: vec![],
            edges: brep.edges.iter().map(border).collect(),
            used: vec![false; brep.edges.len()],
            around: vec![],
            corners: vec![],
            side_faces: vec![],
        };
        let shells: BTreeMap<u32, u32> = (0u32..)
            .zip(&brep.shells)
            .flat_map(|(number, shell)| shell.faces.iter().map(move |face| (*face, number)))
            .collect();
        let mut regions = regions.into_iter();
        let feet = |face: &Face| go_on(progress).map(|()| SurfaceFeet::new(&face.surface));
        let all: Vec<SurfaceFeet> = brep.faces.par_iter().map(feet).collect::<Result<_, _>>()?;
        for ((number, face), feet) in (0u32..).zip(&brep.faces).zip(all) {
            let region = regions.next().flatten();
            let own = region.as_ref().map_or(vec![], |r| parts.borders(number, &face.bounds, &feet, r));
            parts.around.push(own);
            let shell = shells.get(&number).copied();
            parts.faces.push(Searched { feet, region, is_reversed: face.reversed, shell });
        }
        Ok(parts)
    }

    /// Notes what is around a face.
    fn borders(&mut self, number: u32, bounds: &Bounds, feet: &SurfaceFeet, region: &R) -> Vec<usize> {
        let first = self.edges.len();
        let Bounds::Loops(loops) = bounds else {
            self.edges.extend(sides(feet, region));
            self.used.resize(self.edges.len(), true);
            self.side_faces.resize(self.side_faces.len() + self.edges.len() - first, number);
            return (first..self.edges.len()).collect();
        };
        let mut own = vec![];
        for l in loops {
            match l {
                Loop::Vertex(vertex) => self.corners.push(*vertex),
                Loop::Edges(uses) => own.extend(uses.iter().map(|u| u.edge as usize)),
            }
        }
        own.retain(|e| *e < first - self.side_faces.len());
        own.iter().for_each(|e| self.used[*e] = true);
        own
    }

    /// A box around about all.
    fn extent(&self) -> Aabb {
        let mut extent = Aabb::EMPTY;
        for (border, _) in self.edges.iter().zip(&self.used).filter(|(_, used)| **used) {
            extent = extent.union(&border.feet.bounds());
        }
        for face in &self.faces {
            // A face without a border, as a sphere, reaches beyond all edges.
            if let Some(region) = &face.region {
                let window = region.window();
                let at = |share: f64| window.map(|[from, to]| from + share * (to - from));
                let places = [0.0, 0.25, 0.5, 0.75, 1.0].map(at).map(|[u, v]| face.feet.surface().at(u, v));
                extent = extent.union(&Aabb::of(&places));
            }
        }
        extent
    }

    /// The targets, and boxes around them that are about as long as `step`.
    fn boxes(
        &self,
        vertices: &[Point],
        step: f64,
        progress: &dyn Progress,
    ) -> Result<(Vec<Target>, Vec<Item>), Cancelled> {
        let own = |border: &Border| go_on(progress).map(|()| pieces_of_edge(&border.feet, step));
        let pieces: Vec<Vec<Aabb>> = self.edges.iter().map(own).collect::<Result<_, _>>()?;
        let covers: Vec<Vec<(u32, Vec<cover::Cover>)>> = (0..self.faces.len())
            .into_par_iter()
            .map(|f| {
                go_on(progress)?;
                progress.advance(1);
                let borders: Vec<Aabb> =
                    self.around[f].iter().flat_map(|e| pieces[*e].iter().copied()).collect();
                Ok(cover_of_face(&self.faces[f], step, &borders))
            })
            .collect::<Result<_, Cancelled>>()?;
        let (mut boxes, mut targets) = (vec![], vec![]);
        let mut add = |target: Target, own: &[cover::Cover]| {
            let target_number = targets.len() as u32;
            let item = |(bounds, place): &cover::Cover| Item {
                target: target_number,
                bounds: *bounds,
                place: *place,
            };
            boxes.extend(own.iter().map(item));
            targets.push(target);
        };
        for (face, cover) in (0u32..).zip(&covers) {
            for (unit, own) in cover {
                add(Target::Unit { face, unit: *unit }, own);
            }
        }
        for (edge, own) in (0u32..).zip(&pieces).filter(|(edge, _)| self.used[*edge as usize]) {
            let unknown: Vec<cover::Cover> = own.iter().map(|bounds| (*bounds, [f64::NAN; 3])).collect();
            add(Target::Edge(edge), &unknown);
        }
        for vertex in &self.corners {
            if let Some(place) = vertices.get(*vertex as usize) {
                add(Target::Vertex(*vertex), &[(Aabb::of(&[*place]), *place)]);
            }
        }
        Ok((targets, boxes))
    }
}

/// The sides of a face without edges, but those where its surface closes.
fn sides<R: Region>(feet: &SurfaceFeet, region: &R) -> Vec<Border> {
    /// Share of a period within which a face goes all around.
    const WHOLE: f64 = 1e-9;
    let window = region.window();
    let mut sides = vec![];
    for held in 0..2 {
        let [from, to] = window[held];
        if feet.periods()[held].is_some_and(|p| (to - from - p).abs() <= WHOLE * p) {
            continue;
        }
        for at in [from, to].into_iter().filter(|t| t.is_finite()) {
            if let Some(curve) = feet.surface().iso_curve(held, at) {
                let range = window[1 - held];
                sides.push(Border { feet: CurveFeet::new(&curve, range), range, vertices: None });
            }
        }
    }
    sides
}
