//! One B-spline surface as a face within its four edges, or as faces within others.
//!
//! The four edges are the rows and columns of control points at the border, which are the boundary curves of a clamped surface.

use super::instances::{Instances, file, grouped, list, product};
use crate::content::spline_surface::{Bound, SplineSurface, TrimmedFace};
use std::io::{self, Write};

/// Writes the surface.
pub fn write(out: &mut dyn Write, surface: &SplineSurface) -> io::Result<()> {
    let mut model = Instances::default();
    let (context, shape_of_product) = product(&mut model, "surface");
    let faces = faces(&mut model, surface);
    let shell = model.add(&format!("OPEN_SHELL('',{})", list(faces.into_iter())));
    let shells = model.add(&format!("SHELL_BASED_SURFACE_MODEL('',({shell}))"));
    let frame = model.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let shape = model.add(&format!("MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',({frame},{shells}),{context})"));
    model.add(&format!("SHAPE_DEFINITION_REPRESENTATION({shape_of_product},{shape})"));
    file(out, "B-spline surface", "surface", &model)
}

/// The surface within its edges, or its parts within theirs.
fn faces(file: &mut Instances, surface: &SplineSurface) -> Vec<String> {
    let [m, n] = surface.counts();
    let points: Vec<Vec<String>> =
        (0..m).map(|i| (0..n).map(|j| file.point(surface.point(i, j))).collect()).collect();
    let ([p, q], [u, v]) = (surface.degree, surface.knots);
    let ((of_u, times_u), (of_v, times_v)) = (grouped(u), grouped(v));
    let rows = list(points.iter().map(|row| list(row.iter().cloned())));
    let whole = file.add(&format!(
        "B_SPLINE_SURFACE_WITH_KNOTS('',{p},{q},{rows},.UNSPECIFIED.,.F.,.F.,.F.,{times_u},{times_v},{of_u},{of_v},.UNSPECIFIED.)"
    ));
    if !surface.faces.is_empty() {
        let mut part = |face: &TrimmedFace| {
            let outer = bound(file, "FACE_OUTER_BOUND", &face.outer);
            let holes = face.holes.iter().map(|hole| bound(file, "FACE_BOUND", hole));
            let bounds = list(std::iter::once(outer).chain(holes.collect::<Vec<_>>()));
            file.add(&format!("ADVANCED_FACE('',{bounds},{whole},.T.)"))
        };
        return surface.faces.iter().map(&mut part).collect();
    }
    let corner = |i: usize, j: usize| points[i][j].clone();
    let corners = [corner(0, 0), corner(m - 1, 0), corner(m - 1, n - 1), corner(0, n - 1)];
    let vertices = corners.map(|c| file.add(&format!("VERTEX_POINT('',{c})")));
    let along_u = |j: usize| -> Vec<String> { (0..m).map(|i| corner(i, j)).collect() };
    let along_v = |i: usize| points[i].clone();
    let curves = [
        file.curve(p, u, &along_u(0)),
        file.curve(q, v, &along_v(m - 1)),
        file.curve(p, u, &along_u(n - 1)),
        file.curve(q, v, &along_v(0)),
    ];
    // Around the border against the clock as the normal looks; the last two curves run the other way.
    let ends = [(0, 1, ".T."), (1, 2, ".T."), (3, 2, ".F."), (0, 3, ".F.")];
    let edges: Vec<String> = curves
        .iter()
        .zip(ends)
        .map(|(curve, (a, b, sense))| {
            let edge = file.add(&format!("EDGE_CURVE('',{},{},{curve},.T.)", vertices[a], vertices[b]));
            file.add(&format!("ORIENTED_EDGE('',*,*,{edge},{sense})"))
        })
        .collect();
    let around = file.add(&format!("EDGE_LOOP('',{})", list(edges.into_iter())));
    let bound = file.add(&format!("FACE_OUTER_BOUND('',{around},.T.)"));
    vec![file.add(&format!("ADVANCED_FACE('',({bound}),{whole},.T.)"))]
}

/// A closed line on the surface.
fn bound(file: &mut Instances, kind: &str, bound: &Bound) -> String {
    let starts: Vec<String> = bound.sides.iter().map(|side| file.point(side.points()[0])).collect();
    let vertices: Vec<String> = starts.iter().map(|p| file.add(&format!("VERTEX_POINT('',{p})"))).collect();
    let n = vertices.len();
    let edges: Vec<String> = bound
        .sides
        .iter()
        .enumerate()
        .map(|(k, side)| {
            let inner = &side.points()[1..side.points().len() - 1];
            // Each side ends where the next one starts, to the last bit.
            let mut points = vec![starts[k].clone()];
            points.extend(inner.iter().map(|p| file.point(*p)));
            points.push(starts[(k + 1) % n].clone());
            let curve = file.curve(side.knots().degree(), side.knots().values(), &points);
            let edge =
                file.add(&format!("EDGE_CURVE('',{},{},{curve},.T.)", vertices[k], vertices[(k + 1) % n]));
            file.add(&format!("ORIENTED_EDGE('',*,*,{edge},.T.)"))
        })
        .collect();
    let around = file.add(&format!("EDGE_LOOP('',{})", list(edges.into_iter())));
    file.add(&format!("{kind}('',{around},.T.)"))
}
