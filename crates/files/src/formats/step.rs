//! STEP files (ISO 10303-21) of application protocol 214: one B-spline surface as a face within its four edges, millimetres.
//!
//! The edges are the rows and columns of control points at the border, which are the boundary curves of a clamped surface. The
//! header's time stamp is fixed, so that the same surface gives the same bytes.

use crate::cad::SplineSurface;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Instances that are written one after the other and known by their numbers.
#[derive(Default)]
struct Instances {
    text: String,
    count: usize,
}

impl Instances {
    fn add(&mut self, body: &str) -> String {
        self.count += 1;
        let _ = writeln!(self.text, "#{}={body};", self.count);
        format!("#{}", self.count)
    }
    fn point(&mut self, p: [f64; 3]) -> String {
        let list = list(p.iter().map(|x| real(*x)));
        self.add(&format!("CARTESIAN_POINT('',{list})"))
    }
    fn curve(&mut self, degree: usize, knots: &[f64], points: &[String]) -> String {
        let (values, times) = grouped(knots);
        self.add(&format!(
            "B_SPLINE_CURVE_WITH_KNOTS('',{degree},{},.UNSPECIFIED.,.F.,.F.,{times},{values},.UNSPECIFIED.)",
            list(points.iter().cloned())
        ))
    }
}

fn list(items: impl Iterator<Item = String>) -> String {
    format!("({})", items.collect::<Vec<_>>().join(","))
}

/// Shortest digits that read back as the same number; STEP wants a point in every real.
pub(super) fn real(x: f64) -> String {
    let text = format!("{x:?}");
    match text.split_once('e') {
        Some((digits, exponent)) if digits.contains('.') => format!("{digits}E{exponent}"),
        Some((digits, exponent)) => format!("{digits}.E{exponent}"),
        None => text,
    }
}

/// Distinct knots and how often each stands.
fn grouped(knots: &[f64]) -> (String, String) {
    let groups: Vec<&[f64]> = knots.chunk_by(|a, b| a == b).collect();
    (list(groups.iter().map(|g| real(g[0]))), list(groups.iter().map(|g| g.len().to_string())))
}

/// Writes the surface.
pub fn write(out: &mut dyn Write, surface: &SplineSurface) -> io::Result<()> {
    let mut file = Instances::default();
    let (context, shape_of_product) = product(&mut file);
    let face = face(&mut file, surface);
    let shell = file.add(&format!("OPEN_SHELL('',({face}))"));
    let model = file.add(&format!("SHELL_BASED_SURFACE_MODEL('',({shell}))"));
    let origin = file.point([0.0; 3]);
    let z = file.add("DIRECTION('',(0.0,0.0,1.0))");
    let x = file.add("DIRECTION('',(1.0,0.0,0.0))");
    let frame = file.add(&format!("AXIS2_PLACEMENT_3D('',{origin},{z},{x})"));
    let shape = file.add(&format!("MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',({frame},{model}),{context})"));
    file.add(&format!("SHAPE_DEFINITION_REPRESENTATION({shape_of_product},{shape})"));
    writeln!(out, "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('B-spline surface'),'2;1');")?;
    writeln!(out, "FILE_NAME('surface','1970-01-01T00:00:00',(''),(''),'trueness','trueness','');")?;
    writeln!(out, "FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\nENDSEC;\nDATA;")?;
    out.write_all(file.text.as_bytes())?;
    writeln!(out, "ENDSEC;\nEND-ISO-10303-21;")
}

/// What every file needs to say about a product and its units. Gives the context of the shape, and the product's shape.
fn product(file: &mut Instances) -> (String, String) {
    let application = file.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
    file.add(&format!(
        "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{application})"
    ));
    let of_product = file.add(&format!("PRODUCT_CONTEXT('',{application},'mechanical')"));
    let product = file.add(&format!("PRODUCT('surface','surface','',({of_product}))"));
    file.add(&format!("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))"));
    let formation = file.add(&format!("PRODUCT_DEFINITION_FORMATION('','',{product})"));
    let of_design =
        file.add(&format!("PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')"));
    let definition = file.add(&format!("PRODUCT_DEFINITION('design','',{formation},{of_design})"));
    let shape = file.add(&format!("PRODUCT_DEFINITION_SHAPE('','',{definition})"));
    let length = file.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
    let angle = file.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    let solid = file.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    let accuracy = file.add(&format!(
        "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),{length},'distance_accuracy_value','')"
    ));
    let context = file.add(&format!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({accuracy}))\
         GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid}))REPRESENTATION_CONTEXT('',''))"
    ));
    (context, shape)
}

/// The surface within its edges.
fn face(file: &mut Instances, surface: &SplineSurface) -> String {
    let [m, n] = surface.counts();
    let points: Vec<Vec<String>> =
        (0..m).map(|i| (0..n).map(|j| file.point(surface.point(i, j))).collect()).collect();
    let ([p, q], [u, v]) = (surface.degree, surface.knots);
    let ((of_u, times_u), (of_v, times_v)) = (grouped(u), grouped(v));
    let rows = list(points.iter().map(|row| list(row.iter().cloned())));
    let whole = file.add(&format!(
        "B_SPLINE_SURFACE_WITH_KNOTS('',{p},{q},{rows},.UNSPECIFIED.,.F.,.F.,.F.,{times_u},{times_v},{of_u},{of_v},.UNSPECIFIED.)"
    ));
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
    file.add(&format!("ADVANCED_FACE('',({bound}),{whole},.T.)"))
}
