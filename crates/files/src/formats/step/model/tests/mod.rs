//! Small files of each kind of entity, and what they are in closed form.

mod assembly;
mod geometry;
mod hostile;
mod links;
mod topology;

use crate::cad::{CadFile, read_from};
use crate::{MemorySources, ReadError, ReadOptions};
use std::path::Path;
use trueness_cad::brep::Face;
use trueness_cad::model::Model;
use trueness_geom::progress::Silent;
use trueness_geom::space::{Point, minus, norm};

/// Reads text.
fn read(text: &str) -> Result<CadFile, ReadError> {
    let mut sources = MemorySources::new();
    sources.insert("model.step", text.as_bytes().to_vec());
    read_from(&sources, Path::new("model.step"), &ReadOptions::default(), &Silent)
}

/// A file of these entities.
fn whole(entities: &str) -> String {
    format!(
        "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n{entities}\nENDSEC;\nEND-ISO-10303-21;\n"
    )
}

/// Units (millimeters, radians), axes along those of space, and the product of one representation with these items.
fn part(items: &str, entities: &str) -> String {
    whole(&format!(
        "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n#2=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n\
         #3=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-4),#1,'','');\n\
         #4=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#3))\
         GLOBAL_UNIT_ASSIGNED_CONTEXT((#1,#2))REPRESENTATION_CONTEXT('',''));\n\
         #5=CARTESIAN_POINT('',(0.,0.,0.));\n#6=DIRECTION('',(1.,0.,0.));\n#7=DIRECTION('',(0.,1.,0.));\n#8=DIRECTION('',(0.,0.,1.));\n\
         #9=AXIS2_PLACEMENT_3D('',#5,#8,#6);\n#10=PRODUCT('id','a part','',());\n#11=PRODUCT_DEFINITION_FORMATION('','',#10);\n\
         #12=PRODUCT_DEFINITION('','',#11,$);\n#13=PRODUCT_DEFINITION_SHAPE('','',#12);\n\
         #14=SHAPE_DEFINITION_REPRESENTATION(#13,#15);\n#15=SHAPE_REPRESENTATION('',(#9,{items}),#4);\n{entities}"
    ))
}

/// The model of a file that must be read whole.
fn model(text: &str) -> Model {
    let file = read(text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert!(file.model.unread.is_empty(), "{:?}\n{text}", file.model.unread);
    file.model
}

/// The faces of the only part.
fn faces(text: &str) -> Vec<Face> {
    let mut model = model(text);
    assert_eq!((model.parts.len(), model.instances.len()), (1, 1), "{text}");
    model.parts.remove(0).brep.faces
}

fn near(a: Point, b: Point) -> bool {
    norm(minus(a, b)) < 1e-12
}
