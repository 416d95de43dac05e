//! CAD models as nominals of sections, and their own check.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, status, stderr, stdout, trueness};
use std::fmt::Write;

/// A rod of radius 2 from z = 0 to 3: a band between two circles, an end below and one above.
const ROD: &str = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n\
#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n\
#2=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#3))GLOBAL_UNIT_ASSIGNED_CONTEXT((#1))REPRESENTATION_CONTEXT('',''));\n\
#3=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-5),#1,'','');\n\
#4=DIRECTION('',(0.,0.,1.));\n#5=DIRECTION('',(1.,0.,0.));\n\
#6=CARTESIAN_POINT('',(0.,0.,0.));\n#7=CARTESIAN_POINT('',(0.,0.,3.));\n\
#8=AXIS2_PLACEMENT_3D('',#6,#4,#5);\n#9=AXIS2_PLACEMENT_3D('',#7,#4,#5);\n\
#10=CARTESIAN_POINT('',(2.,0.,0.));\n#11=CARTESIAN_POINT('',(2.,0.,3.));\n\
#12=VERTEX_POINT('',#10);\n#13=VERTEX_POINT('',#11);\n\
#14=CIRCLE('',#8,2.);\n#15=CIRCLE('',#9,2.);\n\
#16=EDGE_CURVE('',#12,#12,#14,.T.);\n#17=EDGE_CURVE('',#13,#13,#15,.T.);\n\
#18=ORIENTED_EDGE('',*,*,#16,.T.);\n#19=ORIENTED_EDGE('',*,*,#17,.F.);\n\
#20=ORIENTED_EDGE('',*,*,#16,.F.);\n#21=ORIENTED_EDGE('',*,*,#17,.T.);\n\
#22=EDGE_LOOP('',(#18));\n#23=EDGE_LOOP('',(#19));\n#24=EDGE_LOOP('',(#20));\n#25=EDGE_LOOP('',(#21));\n\
#26=FACE_BOUND('',#22,.T.);\n#27=FACE_BOUND('',#23,.T.);\n#28=FACE_BOUND('',#24,.T.);\n#29=FACE_BOUND('',#25,.T.);\n\
#30=CYLINDRICAL_SURFACE('',#8,2.);\n#31=PLANE('',#8);\n#32=PLANE('',#9);\n\
#33=ADVANCED_FACE('AROUND',(#26,#27),#30,.T.);\n#34=ADVANCED_FACE('BELOW',(#28),#31,.F.);\n#35=ADVANCED_FACE('ABOVE',(#29),#32,.T.);\n\
#36=CLOSED_SHELL('',(#33,#34,#35));\n#37=MANIFOLD_SOLID_BREP('ROD',#36);\n\
#38=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#37),#2);\nENDSEC;\nEND-ISO-10303-21;\n";

/// Points around a circle of a radius, at a height.
fn ring(radius: f64, z: f64) -> String {
    let mut text = String::new();
    for i in 0..360 {
        let (s, c) = f64::from(i).to_radians().sin_cos();
        writeln!(text, "{:?} {:?} {z:?}", radius * c, radius * s).unwrap();
    }
    text
}

fn count(d: &serde_json::Value, kind: &str) -> u64 {
    d["defects"][kind]["count"].as_u64().unwrap()
}

#[test]
fn a_section_is_measured_to_the_circle_of_a_cylinder() {
    let folder = Folder::new();
    let part = folder.write("rod.stp", ROD);
    let points = folder.write("ring.xyz", ring(2.01, 1.25));
    let words = ["section", points.to_str().unwrap(), "--closed", "--nominal", part.to_str().unwrap()];
    let o = trueness(words);
    assert_eq!(status(&o), 0, "{}{}", stdout(&o), stderr(&o));
    let nominal = &document(words)["nominal"];
    assert_eq!(nominal["outline"], "faces");
    let all = &nominal["deviation"]["all"];
    for key in ["min", "max"] {
        assert!((all[key].as_f64().unwrap() - 0.01).abs() < 1e-9, "{key}: {}", all[key]);
    }
    let outline = &nominal["outlines"][0];
    assert_eq!(outline["closed"], true);
    assert!((outline["length"].as_f64().unwrap() - 4.0 * std::f64::consts::PI).abs() < 1e-9);
    // A plane in the upper end is told.
    let points = folder.write("top.xyz", ring(2.0, 3.0));
    let words = ["section", points.to_str().unwrap(), "--closed", "--nominal", part.to_str().unwrap()];
    let o = trueness(words);
    assert!(stdout(&o).contains("face 35 of the nominal lies in the plane at 3.0000 mm"), "{}", stdout(&o));
}

#[test]
fn a_sound_model_is_sound_and_its_faults_are_found() {
    let folder = Folder::new();
    let check = |name: &str, text: &str| {
        let part = folder.write(name, text);
        let words = ["check", part.to_str().unwrap()];
        let o = trueness(words);
        (status(&o), document(words), stdout(&o))
    };
    let (said, d, table) = check("rod.stp", ROD);
    assert_eq!(said, 0, "{table}");
    assert!(d["defects"].as_object().unwrap().values().all(|k| k["count"] == 0), "{table}");
    let volume = 12.0 * std::f64::consts::PI;
    assert!((d["volume"].as_f64().unwrap() / volume - 1.0).abs() < 1e-9);
    assert_eq!(d["tolerances"], serde_json::json!({ "gap": 1e-5 }));
    // What is not exact says so.
    let of_drawing = d["of_drawing"].as_array().unwrap();
    assert!(of_drawing.iter().all(|key| d[key.as_str().unwrap()].is_number()), "{of_drawing:?}");
    assert!(table.contains("(of the mesh that draws it)"), "{table}");
    // Without its lower end the circle there is free.
    let (said, d, table) = check("open.stp", &ROD.replace("(#33,#34,#35)", "(#33,#35)"));
    assert_eq!((said, count(&d, "free_edges")), (1, 1), "{table}");
    let edge = &d["defects"]["free_edges"]["items"][0];
    assert_eq!((edge["edge"].as_f64(), edge["face"].as_f64()), (Some(16.0), Some(33.0)));
    assert!((edge["size"].as_f64().unwrap() - 4.0 * std::f64::consts::PI).abs() < 1e-9);
    // An end 20 µm too high is off its edge by that; a warning alone.
    let (said, d, table) = check(
        "gap.stp",
        &ROD.replace(
            "#32=PLANE('',#9)",
            "#40=CARTESIAN_POINT('',(0.,0.,3.02));\n#41=AXIS2_PLACEMENT_3D('',#40,#4,#5);\n#32=PLANE('',#41)",
        ),
    );
    assert_eq!((said, count(&d, "edge_gaps")), (0, 1), "{table}");
    assert!((d["defects"]["edge_gaps"]["items"][0]["size"].as_f64().unwrap() - 0.02).abs() < 1e-9);
    // A face that nobody can read.
    let (said, d, table) = check("unread.stp", &ROD.replace("PLANE('',#9)", "FLOATING_CARPET('',#9)"));
    assert_eq!((said, count(&d, "unread_faces"), count(&d, "free_edges")), (1, 1, 1), "{table}");
}

#[test]
fn what_is_about_facets_is_refused_for_a_model() {
    let folder = Folder::new();
    let part = folder.write("rod.stp", ROD);
    for option in ["--gap", "--weld", "--sliver-angle", "--island"] {
        let o = trueness(["check", part.to_str().unwrap(), option, "0.5"]);
        assert_eq!(status(&o), 2, "{}", stderr(&o));
        assert!(stderr(&o).contains(&format!("{option}: it is about facets")), "{}", stderr(&o));
    }
}
