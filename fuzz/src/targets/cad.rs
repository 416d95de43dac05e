//! The readers of CAD models. Of all that is read indices must name what is there, and numbers must be finite.

use super::Target;
use crate::mutate::mutated;
use std::path::Path;
use trueness_cad::brep::{Bounds, Brep, Loop};
use trueness_files::{ReadOptions, cad};
use trueness_geom::progress::Silent;

/// STEP.
pub const STEP: Target = Target {
    name: "step",
    extension: "step",
    seeds: |_| SEEDS.iter().map(|entities| whole(entities)).collect(),
    mutate: |random, case, other| mutated(random, case, other, WORDS),
    run: |_, path| read(path),
    size: <[u8]>::len,
};

/// IGES.
pub const IGES: Target = Target {
    name: "iges",
    extension: "igs",
    seeds: |_| IGES_SEEDS.iter().map(|entities| iges(entities)).collect(),
    mutate: |random, case, other| mutated(random, case, other, IGES_WORDS),
    run: |_, path| read(path),
    size: <[u8]>::len,
};

/// Entities of IGES, one a line: the matrix that places it, its kind and its parameters.
const IGES_SEEDS: [&str; 2] = [
    "0 108,0.,0.,1.,0.,0,0.,0.,0.,0.\n0 110,0.,0.,0.,4.,0.,0.\n0 110,4.,0.,0.,0.,3.,0.\n0 110,0.,3.,0.,0.,0.,0.\n0 102,3,3,5,7\n\
     0 142,0,1,0,9,2\n0 144,1,1,0,11\n0 124,0.,-1.,0.,1.,1.,0.,0.,2.,0.,0.,1.,3.\n15 100,0.,0.,0.,2.,0.,0.,2.\n0 120,5,17,0.,3.\n\
     0 110,0.1,0.5,0.,0.4,0.9,0.\n0 110,0.4,0.9,0.,0.1,2.,0.\n0 110,0.1,2.,0.,0.1,0.5,0.\n0 102,3,21,23,25\n0 142,0,19,27,0,1\n\
     0 144,19,1,0,29\n0 308,0,1HA,2,13,31\n15 408,33,1.,2.,3.,2.\n0 104,1.,0.,1.,0.,0.,-1.,0.,1.,0.,1.,0.\n0 122,37,1.,0.,5.\n\
     0 118,3,5,0,0\n0 140,0.,0.,1.,0.5,39\n0 106,1,3,0.,0.,0.,1.,0.,1.,1.\n0 143,0,1,1,49\n0 141,0,1,1,2,3,1,0,5,2,0\n",
    "0 502,2,2.,0.,0.,2.,0.,5.\n0 100,0.,0.,0.,2.,0.,2.,0.\n0 100,5.,0.,0.,2.,0.,2.,0.\n0 110,2.,0.,0.,2.,0.,5.\n\
     0 504,3,3,1,1,1,1,5,1,2,1,2,7,1,1,1,2\n0 508,4,0,9,1,1,0,0,9,3,1,0,0,9,2,0,0,0,9,3,0,0\n0 508,1,0,9,1,0,0\n0 508,1,0,9,2,1,0\n\
     0 116,0.,0.,0.\n0 116,0.,0.,5.\n0 123,0.,0.,1.\n0 123,0.,0.,-1.\n0 192,17,21,2.\n0 190,17,23\n0 190,19,21\n0 510,25,1,1,11\n\
     0 510,27,1,1,13\n0 510,29,1,1,15\n0 514,3,31,1,33,1,35,1\n0 186,37,1,0\n0 196,17,3.,0,0\n0 198,17,21,3.,1.\n0 194,17,21,1.,30.\n\
     0 126,2,2,1,0,0,0,0.,0.,0.,1.,1.,1.,1.,0.5,1.,0.,0.,0.,1.,1.,0.,2.,0.,0.,0.,1.\n0 120,7,47,0.,1.\n\
     0 128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,1.,0.,1.,0.,1.\n",
];

const IGES_WORDS: &[&[u8]] = &[
    b"1",
    b"7",
    b"144",
    b"124",
    b"99999999",
    b"-1",
    b"0.",
    b"1.E308",
    b"1H",
    b"9999H",
    b",",
    b";",
    b"D      3",
    b"P      2",
    b"T      1",
];

/// A file of entities.
fn iges(entities: &str) -> Vec<u8> {
    let mut out = format!("{:<72}S{:>7}\n", "", 1);
    out += &format!("{:<72}G{:>7}\n", ",,1HA,1HA,1HA,1HA,32,38,6,308,15,1HA,1.,2,2HMM,1,.01,1HA,1.E-3;", 1);
    let (mut parameters, mut row) = (String::new(), 1);
    for (n, line) in entities.lines().enumerate() {
        let (matrix, own) = line.trim().split_once(' ').unwrap_or_default();
        let kind = own.split(',').next().unwrap_or_default();
        let text = format!("{own};");
        let lines: Vec<&[u8]> = text.as_bytes().chunks(64).collect();
        let number = 2 * n + 1;
        out += &format!("{kind:>8}{row:>8}{0:>8}{0:>8}{0:>8}{0:>8}{matrix:>8}{0:>8}{0:0>8}D{number:>7}\n", 0);
        out += &format!("{kind:>8}{0:>8}{0:>8}{1:>8}{0:>8}{0:>32}D{2:>7}\n", 0, lines.len(), number + 1);
        for line in lines {
            parameters += &format!("{:<64}{number:>8}P{row:>7}\n", String::from_utf8_lossy(line));
            row += 1;
        }
    }
    format!("{out}{parameters}{:<72}T{:>7}\n", "", 1).into_bytes()
}

/// Units, axes and a product, before the entities of each seed.
const BASE: &str = "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n#2=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n\
    #3=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-4),#1,'','');\n#4=(GEOMETRIC_REPRESENTATION_CONTEXT(3)\
    GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#3))GLOBAL_UNIT_ASSIGNED_CONTEXT((#1,#2))REPRESENTATION_CONTEXT('',''));\n\
    #5=CARTESIAN_POINT('',(0.,0.,0.));\n#6=DIRECTION('',(1.,0.,0.));\n#8=DIRECTION('',(0.,0.,1.));\n#9=AXIS2_PLACEMENT_3D('',#5,#8,#6);\n\
    #10=PRODUCT('id','\\X2\\03A6\\X0\\ it''s','',());\n#11=PRODUCT_DEFINITION_FORMATION('','',#10);\n#12=PRODUCT_DEFINITION('','',#11,$);\n\
    #13=PRODUCT_DEFINITION_SHAPE('','',#12);\n#14=SHAPE_DEFINITION_REPRESENTATION(#13,#15);\n#15=SHAPE_REPRESENTATION('',(#9,#20),#4);\n";

const SEEDS: [&str; 3] = [
    "#20=MANIFOLD_SOLID_BREP('',#21);\n#21=CLOSED_SHELL('',(#22,#23));\n#22=ADVANCED_FACE('',(#24,#25),#26,.T.);\n#23=ADVANCED_FACE('',(#27),#28,.F.);\n\
     #24=FACE_BOUND('',#29,.T.);\n#25=FACE_BOUND('',#30,.F.);\n#26=CYLINDRICAL_SURFACE('',#9,2.);\n#27=FACE_OUTER_BOUND('',#29,.F.);\n#28=PLANE('',#9);\n\
     #29=EDGE_LOOP('',(#31));\n#30=EDGE_LOOP('',(#32));\n#31=ORIENTED_EDGE('',*,*,#33,.T.);\n#32=ORIENTED_EDGE('',*,*,#34,.T.);\n\
     #33=EDGE_CURVE('',#35,#35,#36,.T.);\n#34=EDGE_CURVE('',#37,#37,#38,.T.);\n#35=VERTEX_POINT('',#39);\n#36=CIRCLE('',#9,2.);\n#37=VERTEX_POINT('',#40);\n\
     #38=CIRCLE('',#41,2.);\n#39=CARTESIAN_POINT('',(2.,0.,0.));\n#40=CARTESIAN_POINT('',(2.,0.,5.));\n#41=AXIS2_PLACEMENT_3D('',#42,#8,#6);\n\
     #42=CARTESIAN_POINT('',(0.,0.,5.));\n",
    "#20=GEOMETRIC_SET('',(#21,#22));\n#21=RECTANGULAR_TRIMMED_SURFACE('',#23,0.,1.,0.,1.,.T.,.T.);\n#22=CURVE_BOUNDED_SURFACE('',#24,(#25),.F.);\n\
     #23=B_SPLINE_SURFACE_WITH_KNOTS('',1,1,((#5,#26),(#27,#28)),.U.,.F.,.F.,.U.,(2,2),(2,2),(0.,1.),(0.,1.),.U.);\n#24=PLANE('',#9);\n\
     #25=BOUNDARY_CURVE('',(#29,#30),.F.);\n#26=CARTESIAN_POINT('',(0.,1.,0.));\n#27=CARTESIAN_POINT('',(1.,0.,0.));\n#28=CARTESIAN_POINT('',(1.,1.,1.));\n\
     #29=COMPOSITE_CURVE_SEGMENT(.C.,.T.,#31);\n#30=COMPOSITE_CURVE_SEGMENT(.C.,.F.,#32);\n#31=TRIMMED_CURVE('',#33,(#27),(#26),.T.,.CARTESIAN.);\n\
     #32=BEZIER_CURVE('',2,(#27,#5,#26),.U.,.F.,.U.);\n#33=CIRCLE('',#9,1.);\n",
    "#20=MAPPED_ITEM('',#21,#22);\n#21=REPRESENTATION_MAP(#9,#23);\n#22=CARTESIAN_TRANSFORMATION_OPERATOR_3D('',$,$,$,$,#24,2.,$);\n\
     #23=SHAPE_REPRESENTATION('',(#25),#4);\n#24=CARTESIAN_POINT('',(1.,2.,3.));\n#25=FACETED_BREP('',#26);\n#26=CLOSED_SHELL('',(#27,#28));\n\
     #27=FACE('',(#29));\n#28=FACE('',(#30));\n#29=FACE_BOUND('',#31,.T.);\n#30=FACE_BOUND('',#31,.F.);\n#31=POLY_LOOP('',(#5,#24,#32));\n\
     #32=CARTESIAN_POINT('',(1.,0.,0.));\n#33=NEXT_ASSEMBLY_USAGE_OCCURRENCE('','','',#12,#34,$);\n#34=PRODUCT_DEFINITION('','',#11,$);\n\
     #35=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#36,#37);\n#36=(REPRESENTATION_RELATIONSHIP('','',#23,#15)\
     REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#38)SHAPE_REPRESENTATION_RELATIONSHIP());\n#37=PRODUCT_DEFINITION_SHAPE('','',#33);\n\
     #38=ITEM_DEFINED_TRANSFORMATION('','',#9,#9);\n",
];

const WORDS: &[&[u8]] = &[
    b"#5",
    b"#20",
    b"#22",
    b"#33",
    b"#99999999999999999999",
    b".T.",
    b".F.",
    b"$",
    b"*",
    b"''",
    b"'",
    b"(",
    b")",
    b"/*",
    b"*/",
    b"1.E308",
    b"0.",
    b"-1.",
    b"CARTESIAN_POINT",
    b"DEGENERATE_TOROIDAL_SURFACE",
    b"TOROIDAL_SURFACE",
    b"CONICAL_SURFACE",
    b"OFFSET_SURFACE",
    b"SURFACE_OF_REVOLUTION",
    b"ORIENTED_FACE",
    b"SOLID_REPLICA",
    b"SHELL_BASED_SURFACE_MODEL",
    b"ELLIPSE",
    b"COMPOSITE_CURVE",
    b"POLYLINE",
    b"END-ISO-10303-21;",
    b"\n#7=",
];

fn whole(entities: &str) -> Vec<u8> {
    format!("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n{BASE}{entities}ENDSEC;\nEND-ISO-10303-21;\n")
        .into_bytes()
}

fn read(path: &Path) {
    let file = match cad::read(path, &ReadOptions::default(), &Silent) {
        Ok(file) => file,
        Err(e) => return super::readers::refused(&e, path),
    };
    let parts = file.model.parts.len();
    assert!(parts > 0, "neither a part nor an error");
    assert!(file.model.instances.iter().all(|i| (i.part as usize) < parts), "an instance of no part");
    let numbers = file.model.instances.iter().flat_map(|i| i.placement.matrix()).flatten();
    assert!(numbers.into_iter().all(f64::is_finite), "a placement that is not finite");
    assert!(file.model.unread.iter().all(|u| !u.reason.is_empty()), "something is not read for no reason");
    file.model.parts.iter().for_each(|part| sound(&part.brep));
}

fn sound(brep: &Brep) {
    let names = |index: u32, count: usize| (index as usize) < count;
    let finite = |place: [f64; 3]| place.iter().all(|x| x.is_finite());
    assert!(brep.vertices.iter().all(|v| finite(v.place)), "a vertex that is not finite");
    for edge in &brep.edges {
        assert!(edge.vertices.iter().all(|v| names(*v, brep.vertices.len())), "an edge of no vertex");
        assert!(edge.span.ends().into_iter().all(finite), "an edge whose end is not finite");
    }
    for face in &brep.faces {
        let Bounds::Loops(loops) = &face.bounds else { continue };
        assert!(!loops.is_empty(), "a face without loops");
        for around in loops {
            assert!(
                match around {
                    Loop::Vertex(v) => names(*v, brep.vertices.len()),
                    Loop::Edges(uses) =>
                        !uses.is_empty() && uses.iter().all(|u| names(u.edge, brep.edges.len())),
                },
                "a loop of no edge"
            );
        }
    }
    for shell in &brep.shells {
        assert!(shell.faces.iter().all(|f| names(*f, brep.faces.len())), "a shell of no face");
    }
    for solid in &brep.solids {
        let shells = solid.voids.iter().chain([&solid.outer]);
        assert!(shells.into_iter().all(|s| names(*s, brep.shells.len())), "a solid of no shell");
    }
}
