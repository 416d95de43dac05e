//! Faces of solids as rational splines of the same shape.

use super::super::Region;
use super::solids::{Part, Solid};
use crate::brep::Brep;
use crate::frame::Frame;
use crate::surface::Surface;
use std::f64::consts::{FRAC_PI_2, TAU};
use trueness_geom::space::{Point, plus};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::surface::Nurbs;

/// Control points of an arc of radius 1: direction and weight; one more unit of the parameter for each quarter.
fn arc([from, to]: [f64; 2]) -> (Knots, Vec<([f64; 2], f64)>) {
    let n = ((to - from) / FRAC_PI_2 - 1e-9).ceil().max(1.0);
    let step = (to - from) / n;
    let half = (0.5 * step).cos();
    let mut points = vec![];
    let mut inner = vec![];
    for i in 0..n as usize {
        let t = from + step * i as f64;
        points.push(([t.cos(), t.sin()], 1.0));
        let middle = t + 0.5 * step;
        points.push(([middle.cos() / half, middle.sin() / half], half));
        if i > 0 {
            inner.extend([i as f64; 2]);
        }
    }
    points.push(([to.cos(), to.sin()], 1.0));
    (Knots::clamped(2, 0.0, &inner, n).unwrap(), points)
}

/// The part of a turned surface: `profile` are control points of radius and height.
fn turned(frame: &Frame, turn: [f64; 2], (knots, profile): (Knots, Vec<([f64; 2], f64)>)) -> Nurbs {
    let (around, circle) = arc(turn);
    let mut points: Vec<(Point, f64)> = vec![];
    for ([x, y], w) in &circle {
        for ([rho, z], v) in &profile {
            points.push((plus(frame.origin, frame.vector([rho * x, rho * y, *z])), w * v));
        }
    }
    Nurbs::weighted([around, knots], &points).unwrap()
}

/// The solid with all faces but plane ones cut by profiles as splines.
pub fn rewritten(solid: &Solid) -> (Brep, Vec<Option<Part>>) {
    let (mut brep, mut parts) = (solid.brep.clone(), solid.parts.clone());
    for (face, part) in brep.faces.iter_mut().zip(&mut parts) {
        let Some(Part::Rectangle { sides: [turn, along], .. }) = part.clone() else { continue };
        let line =
            |from: [f64; 2], to: [f64; 2]| (Knots::uniform(1, 1, 0.0, 1.0), vec![(from, 1.0), (to, 1.0)]);
        let round = |major: f64, minor: f64| {
            let (knots, points) = arc(along);
            (knots, points.into_iter().map(|([x, y], w)| ([major + minor * x, minor * y], w)).collect())
        };
        let nurbs = match &face.surface {
            Surface::Plane(frame) => {
                let corners =
                    [[turn[0], along[0]], [turn[0], along[1]], [turn[1], along[0]], [turn[1], along[1]]];
                let points = corners.map(|[u, v]| (frame.place([u, v, 0.0]), 1.0));
                let knots = || Knots::uniform(1, 1, 0.0, 1.0);
                Nurbs::weighted([knots(), knots()], &points).unwrap()
            }
            Surface::Cylinder { frame, radius } => {
                turned(frame, turn, line([*radius, along[0]], [*radius, along[1]]))
            }
            Surface::Cone { frame, radius, half_angle } => {
                let at = |v: f64| [radius + v * half_angle.tan(), v];
                turned(frame, turn, line(at(along[0]), at(along[1])))
            }
            Surface::Sphere { frame, radius } => turned(frame, turn, round(0.0, *radius)),
            Surface::Torus { frame, major, minor } => turned(frame, turn, round(*major, *minor)),
            _ => continue,
        };
        let sides: [[f64; 2]; 2] = nurbs.knots().each_ref().map(|k| k.domain().into());
        let is_whole = |[a, b]: [f64; 2]| b - a > TAU - 1e-9;
        let period = |k: usize, side: [f64; 2]| is_whole(side).then_some(sides[k][1] - sides[k][0]);
        let is_plane = matches!(face.surface, Surface::Plane(_));
        let periods = if is_plane { [None; 2] } else { [period(0, turn), period(1, along)] };
        face.surface = Surface::Spline(Box::new(nurbs));
        if let crate::brep::Bounds::Rectangle(_) = face.bounds {
            face.bounds = crate::brep::Bounds::Rectangle(sides);
        }
        let own = Part::Rectangle { sides, periods };
        assert_eq!(own.window(), sides);
        *part = Some(own);
    }
    (brep, parts)
}
