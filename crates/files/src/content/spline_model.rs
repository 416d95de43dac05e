//! Surfaces and curves as a CAD file holds them.

use trueness_cad::brep::{Bounds, Brep, Face, Loop};
use trueness_cad::frame::Placement;
use trueness_cad::model::Model;
use trueness_cad::surface::Surface;
use trueness_geom::space::Aabb;
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::rational::Rational;
use trueness_geom::spline::surface::Nurbs;

/// The B-spline surfaces and curves of a file, in its order.
#[derive(Clone, Debug, Default)]
pub struct SplineModel {
    /// The surfaces, each with the normal of its face outward.
    pub surfaces: Vec<Nurbs>,
    /// The curves in space; those that bound faces may be among them.
    pub curves: Vec<Rational<3>>,
}

/// A vertex lies at a corner of a surface within this share of the surface's size.
const CORNER_SHARE: f64 = 1e-5;

impl SplineModel {
    /// The surfaces of a model whose faces are all whole B-spline surfaces, and that stand where the file has them.
    pub(crate) fn of(model: &Model) -> Option<SplineModel> {
        let stands = model.instances.iter().all(|i| i.placement == Placement::IDENTITY);
        if !stands || !model.is_complete() {
            return None;
        }
        let mut surfaces = vec![];
        for instance in &model.instances {
            let brep = &model.parts.get(instance.part as usize)?.brep;
            for face in &brep.faces {
                let Surface::Spline(surface) = &face.surface else { return None };
                if !is_whole(brep, face, surface) {
                    return None;
                }
                surfaces.push(if face.reversed { surface.flipped() } else { (**surface).clone() });
            }
        }
        (!surfaces.is_empty()).then_some(SplineModel { surfaces, curves: vec![] })
    }
}

/// Whether a face is all of its surface: it has at most one loop, whose vertices are corners of the surface.
fn is_whole(brep: &Brep, face: &Face, surface: &Nurbs) -> bool {
    let edges = match &face.bounds {
        Bounds::Loops(loops) => match &loops[..] {
            [] => return true,
            [Loop::Edges(edges)] => edges,
            _ => return false,
        },
        Bounds::Rectangle(_) => return false,
    };
    let points: Vec<_> = surface.control_points().into_iter().map(|p| p.0).collect();
    let [(u, u_end), (v, v_end)] = surface.knots().each_ref().map(Knots::domain);
    let corners = [(u, v), (u, v_end), (u_end, v), (u_end, v_end)].map(|(u, v)| surface.at(u, v));
    let reach = CORNER_SHARE * Aabb::of(&points).diagonal();
    let at_corner = |vertex: u32| {
        let Some(vertex) = brep.vertices.get(vertex as usize) else { return false };
        let near = |c: &[f64; 3]| (0..3).all(|k| (c[k] - vertex.place[k]).abs() <= reach);
        corners.iter().flatten().any(near)
    };
    let mut vertices = edges.iter().filter_map(|e| brep.edges.get(e.edge as usize)).flat_map(|e| e.vertices);
    vertices.all(at_corner)
}
