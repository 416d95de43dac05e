//! Instances of entities, and what every file says of its product.

use std::fmt::Write as _;
use std::io::{self, Write};

/// Instances that are written one after the other and known by their numbers.
#[derive(Default)]
pub(super) struct Instances {
    text: String,
    count: usize,
}

impl Instances {
    pub(super) fn add(&mut self, body: &str) -> String {
        self.count += 1;
        let _ = writeln!(self.text, "#{}={body};", self.count);
        format!("#{}", self.count)
    }
    pub(super) fn point(&mut self, p: [f64; 3]) -> String {
        let list = list(p.iter().map(|x| real(*x)));
        self.add(&format!("CARTESIAN_POINT('',{list})"))
    }
    pub(super) fn direction(&mut self, [x, y, z]: [f64; 3]) -> String {
        self.add(&format!("DIRECTION('',({},{},{}))", real(x), real(y), real(z)))
    }
    /// A place with the directions of its third and first axis.
    pub(super) fn placement(&mut self, at: [f64; 3], z: [f64; 3], x: [f64; 3]) -> String {
        let (at, z, x) = (self.point(at), self.direction(z), self.direction(x));
        self.add(&format!("AXIS2_PLACEMENT_3D('',{at},{z},{x})"))
    }
    pub(super) fn curve(&mut self, degree: usize, knots: &[f64], points: &[String]) -> String {
        let (values, times) = grouped(knots);
        self.add(&format!(
            "B_SPLINE_CURVE_WITH_KNOTS('',{degree},{},.UNSPECIFIED.,.F.,.F.,{times},{values},.UNSPECIFIED.)",
            list(points.iter().cloned())
        ))
    }
}

pub(super) fn list(items: impl Iterator<Item = String>) -> String {
    format!("({})", items.collect::<Vec<_>>().join(","))
}

/// Shortest digits that read back as the same number; STEP wants a point in every real.
pub(in super::super) fn real(x: f64) -> String {
    let text = format!("{x:?}");
    match text.split_once('e') {
        Some((digits, exponent)) if digits.contains('.') => format!("{digits}E{exponent}"),
        Some((digits, exponent)) => format!("{digits}.E{exponent}"),
        None => text,
    }
}

/// Distinct knots and how often each stands.
pub(super) fn grouped(knots: &[f64]) -> (String, String) {
    let groups: Vec<&[f64]> = knots.chunk_by(|a, b| a == b).collect();
    (list(groups.iter().map(|g| real(g[0]))), list(groups.iter().map(|g| g.len().to_string())))
}

/// Writes the file of a model that is described by a line and known by a name.
pub(super) fn file(out: &mut dyn Write, description: &str, name: &str, model: &Instances) -> io::Result<()> {
    writeln!(out, "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('{description}'),'2;1');")?;
    writeln!(out, "FILE_NAME('{name}','1970-01-01T00:00:00',(''),(''),'trueness','trueness','');")?;
    writeln!(out, "FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\nENDSEC;\nDATA;")?;
    out.write_all(model.text.as_bytes())?;
    writeln!(out, "ENDSEC;\nEND-ISO-10303-21;")
}

/// The instances about a product and its units that every file needs. Gives the context of the shape, and the product's shape.
pub(super) fn product(file: &mut Instances, name: &str) -> (String, String) {
    let application = file.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
    file.add(&format!(
        "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{application})"
    ));
    let of_product = file.add(&format!("PRODUCT_CONTEXT('',{application},'mechanical')"));
    let product = file.add(&format!("PRODUCT('{name}','{name}','',({of_product}))"));
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
