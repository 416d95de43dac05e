//! Takes a boundary apart for the search.

use super::cover::{cover_of_face, pieces_of_edge};
use super::face::Face;
use super::region::Region;
use super::side::Sides;
use super::tree::Boxes;
use crate::brep::{Bounds, Brep, Loop};
use crate::curve::CurveFeet;
use crate::surface::SurfaceFeet;
use std::collections::BTreeMap;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point};

/// A boundary taken apart.
pub(super) struct Prepared<R> {
    pub(super) faces: Vec<Face<R>>,
    pub(super) edges: Vec<Border>,
    pub(super) vertices: Vec<Point>,
    pub(super) targets: Vec<Target>,
    pub(super) boxes: Boxes,
    pub(super) sides: Sides,
    /// Distance within which a place of an edge is its end.
    pub(super) same: f64,
    /// Distance within which faces of two shells are about as near.
    pub(super) touching: f64,
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
const SAME_PLACE: f64 = 1e-12;
/// Share within which parts touch: files have some ten digits.
const TOUCHING_SHELLS: f64 = 1e-9;
/// So many boxes in a row reach from one end of the boundary to the other.
const BOXES_OF_SIZE: f64 = 24.0;

/// Takes apart the faces that have a region, and their borders.
pub(super) fn prepared<R: Region>(brep: &Brep, regions: Vec<Option<R>>) -> Prepared<R> {
    let mut edges: Vec<Border> = brep
        .edges
        .iter()
        .map(|edge| {
            let (feet, range) = (edge.span.feet(), edge.span.range);
            Border { feet, range, vertices: Some(edge.vertices) }
        })
        .collect();
    let vertices: Vec<Point> = brep.vertices.iter().map(|v| v.place).collect();
    let (mut used, mut corners, mut side_faces) = (vec![false; edges.len()], vec![], vec![]);
    let shells: BTreeMap<u32, u32> = (0u32..)
        .zip(&brep.shells)
        .flat_map(|(number, shell)| shell.faces.iter().map(move |face| (*face, number)))
        .collect();
    let (mut faces, mut around) = (vec![], vec![]);
    let mut regions = regions.into_iter();
    for (number, face) in brep.faces.iter().enumerate() {
        let feet = SurfaceFeet::new(&face.surface);
        let region = regions.next().flatten();
        let mut own: Vec<usize> = vec![];
        match (&region, &face.bounds) {
            (None, _) => {}
            (Some(region), Bounds::Rectangle(_)) => {
                for side in sides(&feet, region) {
                    own.push(edges.len());
                    edges.push(side);
                    used.push(true);
                    side_faces.push(number as u32);
                }
            }
            (Some(_), Bounds::Loops(loops)) => {
                for l in loops {
                    match l {
                        Loop::Vertex(vertex) => corners.push(*vertex),
                        Loop::Edges(uses) => own.extend(uses.iter().map(|u| u.edge as usize)),
                    }
                }
                own.retain(|e| *e < brep.edges.len());
                own.iter().for_each(|e| used[*e] = true);
            }
        }
        around.push(own);
        let shell = shells.get(&(number as u32)).copied();
        faces.push(Face { feet, region, is_reversed: face.reversed, shell });
    }
    let extent = extent(&edges, &used, &faces);
    let step = extent.diagonal() / BOXES_OF_SIZE;
    let pieces: Vec<Vec<Aabb>> = edges.iter().map(|border| pieces_of_edge(&border.feet, step)).collect();
    let covers: Vec<Vec<(u32, Vec<Aabb>)>> = (0..faces.len())
        .into_par_iter()
        .map(|f| {
            let obstacles: Vec<Aabb> = around[f].iter().flat_map(|e| pieces[*e].iter().copied()).collect();
            cover_of_face(&faces[f], step, &obstacles)
        })
        .collect();
    let units = (0u32..).zip(&covers).flat_map(|(face, cover)| {
        cover.iter().map(move |(unit, own)| (Target::Unit { face, unit: *unit }, own.clone()))
    });
    let borders = (0..edges.len()).filter(|e| used[*e]);
    let borders = borders.map(|e| (Target::Edge(e as u32), pieces[e].clone()));
    let places = corners.iter().filter_map(|v| Some((*v, vertices.get(*v as usize)?)));
    let places = places.map(|(v, place)| (Target::Vertex(v), vec![Aabb::of(&[*place])]));
    let (mut boxes, mut targets) = (vec![], vec![]);
    for (target, own) in units.chain(borders).chain(places) {
        boxes.extend(own.into_iter().map(|bounds| (targets.len() as u32, bounds)));
        targets.push(target);
    }
    let sides = Sides::new(brep, &faces, side_faces);
    Prepared {
        faces,
        edges,
        vertices,
        targets,
        boxes: Boxes::new(boxes),
        sides,
        same: SAME_PLACE * extent.diagonal(),
        touching: TOUCHING_SHELLS * extent.diagonal(),
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

/// The box around all borders that are used, and places of all faces: a face without a border, as a sphere, reaches beyond all edges.
fn extent<R: Region>(edges: &[Border], used: &[bool], faces: &[Face<R>]) -> Aabb {
    let borders = edges.iter().zip(used).filter(|(_, used)| **used).map(|(border, _)| border.feet.bounds());
    let mut all = borders.fold(Aabb::EMPTY, |all, one| all.union(&one));
    for face in faces {
        if let Some(region) = &face.region {
            let window = region.window();
            let corners = [0.0, 0.25, 0.5, 0.75, 1.0]
                .map(|s| [0, 1].map(|k| window[k][0] + s * (window[k][1] - window[k][0])));
            all = all.union(&Aabb::of(&corners.map(|[u, v]| face.feet.surface().at(u, v))));
        }
    }
    all
}
