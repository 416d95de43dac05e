//! A CAD model with a face that cannot be read: every document says so, and none that judges the model passes.

use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;
use trueness::document::ResultDocument;
use trueness::files::MemorySources;
use trueness::geom::progress::Silent;
use trueness::task::{Outcome, Request};
use trueness::tasks::align::AlignRequest;
use trueness::tasks::check::CheckRequest;
use trueness::tasks::compare::CompareRequest;
use trueness::tasks::convert::ConvertRequest;
use trueness::tasks::fit::FitRequest;
use trueness::tasks::info::InfoRequest;
use trueness::tasks::inspect::InspectRequest;
use trueness::tasks::repair::RepairRequest;
use trueness::tasks::section::SectionRequest;
use trueness::tasks::segment::SegmentRequest;

/// The corners of a block, and its sides.
const SIZES: [f64; 3] = [30.0, 20.0, 10.0];
const SIDES: [[u32; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

/// A block of flat faces. What of its last face is damaged: nothing, its border, or the sense of its border.
fn block(damage: &str) -> String {
    let mut text = String::from(
        "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n\
         #1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n#2=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n\
         #3=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#1,#2))REPRESENTATION_CONTEXT('',''));\n\
         #4=PRODUCT('id','block','',());\n#5=PRODUCT_DEFINITION_FORMATION('','',#4);\n#6=PRODUCT_DEFINITION('','',#5,$);\n\
         #7=PRODUCT_DEFINITION_SHAPE('','',#6);\n#8=SHAPE_DEFINITION_REPRESENTATION(#7,#9);\n\
         #9=FACETED_BREP_SHAPE_REPRESENTATION('',(#10),#3);\n#10=FACETED_BREP('',#11);\n",
    );
    for corner in 0..8u32 {
        let [x, y, z] = [0, 1, 2].map(|k| f64::from(corner >> k & 1) * SIZES[k]);
        writeln!(text, "#{}=CARTESIAN_POINT('',({x:?},{y:?},{z:?}));", 20 + corner).unwrap();
    }
    for (number, side) in SIDES.iter().enumerate() {
        let mut corners = side.map(|c| format!("#{}", 20 + c));
        match (number, damage) {
            (5, "missing") => corners[2] = "#999".into(),
            (5, "turned") => corners.reverse(),
            _ => {}
        }
        let n = 100 + 10 * number;
        writeln!(text, "#{n}=FACE('',(#{}));\n#{}=FACE_OUTER_BOUND('',#{},.T.);", n + 1, n + 1, n + 2)
            .unwrap();
        writeln!(text, "#{}=POLY_LOOP('',({}));", n + 2, corners.join(",")).unwrap();
    }
    text + "#11=CLOSED_SHELL('',(#100,#110,#120,#130,#140,#150));\nENDSEC;\nEND-ISO-10303-21;\n"
}

/// Points on the sides of the block.
fn scan() -> String {
    let point = |k: usize| {
        let (a, b) = ((k as f64 * 0.754_877_666).fract(), (k as f64 * 0.569_840_291).fract());
        let axis = k % 3;
        let mut p = [0.0; 3];
        p[axis] = if k % 6 < 3 { 0.0 } else { SIZES[axis] };
        p[(axis + 1) % 3] = a * SIZES[(axis + 1) % 3];
        p[(axis + 2) % 3] = b * SIZES[(axis + 2) % 3];
        format!("{} {} {}\n", p[0], p[1], p[2])
    };
    (1..3000).map(point).collect()
}

const PLAN: &str = "schema = \"trueness/plan/1\"\nmeasured = \"scan.xyz\"\nreference = \"block.step\"\n[align]\nmethod = \"none\"\n\
    [[feature]]\nid = \"A\"\nshape = \"plane\"\nface = 100\n[[characteristic]]\nid = \"1\"\nkind = \"flatness\"\nfeature = \"A\"\ntolerance = 0.5\n";

/// Runs a request: its command, its outcome, and the warnings of its inputs.
fn run<R: Request>(asked: Value, sources: &MemorySources) -> (&'static str, Outcome, String)
where
    R::Document: ResultDocument,
{
    let request: R = serde_json::from_value(asked).unwrap();
    let done = request.run(sources, &Silent).map_err(|e| format!("{}: {e}", R::COMMAND)).unwrap();
    let document: Value = serde_json::from_str(&done.json().unwrap()).unwrap();
    let warnings = document["inputs"].as_array().unwrap().iter().map(|i| i["warnings"].to_string());
    (R::COMMAND, done.outcome, warnings.collect())
}

fn all(sources: &MemorySources, folder: &Path) -> Vec<(&'static str, Outcome, String)> {
    let model = "block.step";
    let out = |name: &str| folder.join(name);
    vec![
        run::<InfoRequest>(json!({"file": model}), sources),
        run::<CheckRequest>(json!({"mesh": model}), sources),
        run::<CompareRequest>(
            json!({"measured": "scan.xyz", "references": [model], "tolerance": "1", "min_coverage": 0}),
            sources,
        ),
        run::<AlignRequest>(json!({"measured": "scan.xyz", "reference": model}), sources),
        run::<ConvertRequest>(json!({"input": model, "out": out("block.ply")}), sources),
        run::<RepairRequest>(
            json!({"mesh": model, "out": out("mended.ply"), "max_change": 100.0, "all_holes": true}),
            sources,
        ),
        run::<InspectRequest>(json!({"plan": "plan.toml"}), sources),
        run::<SectionRequest>(json!({"input": model, "plane": [[0.0, 0.0, 1.0, 5.0]]}), sources),
        run::<SegmentRequest>(json!({"input": model}), sources),
        run::<FitRequest>(json!({"points": model, "shape": "sphere"}), sources),
    ]
}

fn sources(damage: &str) -> MemorySources {
    [("block.step", block(damage)), ("scan.xyz", scan()), ("plan.toml", PLAN.into())].into_iter().collect()
}

/// What judges the model, or brings something to it.
const JUDGES: [&str; 6] = ["check", "compare", "align", "convert", "repair", "inspect"];

#[test]
fn nothing_passes_over_an_incomplete_model() {
    let folder = std::env::temp_dir().join(format!("trueness-incomplete-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    for (command, outcome, warnings) in all(&sources("missing"), &folder) {
        assert!(warnings.contains("5 of 6 faces"), "{command}: {warnings}");
        assert!(outcome == Outcome::NotConforming || !JUDGES.contains(&command), "{command}");
    }
    for (command, outcome, warnings) in all(&sources("nothing"), &folder) {
        // A block fits into itself in several poses.
        let passes = outcome == Outcome::Conforming || command == "align";
        assert!(!warnings.contains("faces") && passes, "{command}: {outcome:?} {warnings}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A face that looks inward is turned, which is told; the check finds it.
#[test]
fn a_face_that_looks_inward_is_turned() {
    let sources = sources("turned");
    let request: InfoRequest = serde_json::from_value(json!({"file": "block.step"})).unwrap();
    let found = request.run(&sources, &Silent).unwrap().document;
    assert!(found.inputs[0].warnings[0].starts_with("1 face(s) look the other way"));
    assert!((found.cad.unwrap().volume.unwrap() - 6000.0).abs() < 1e-9);
    let (_, outcome, _) = run::<CheckRequest>(json!({"mesh": "block.step"}), &sources);
    assert_eq!(outcome, Outcome::NotConforming);
}

/// A plane with an edge that is no part of it: nothing can be measured, which is told soon; the check says what is wrong.
#[test]
fn a_model_without_a_border_that_can_be_followed_is_refused() {
    let face = "#20=CARTESIAN_POINT('',(0.,0.,0.));\n#21=CARTESIAN_POINT('',(0.,0.,50.));\n#22=CARTESIAN_POINT('',(30.,0.,50.));\n\
        #23=CARTESIAN_POINT('',(30.,20.,50.));\n#24=AXIS2_PLACEMENT_3D('',#20,$,$);\n#25=PLANE('',#24);\n\
        #26=B_SPLINE_CURVE_WITH_KNOTS('',2,(#21,#22,#23,#21),.UNSPECIFIED.,.T.,.F.,(3,1,3),(0.,1.,2.),.UNSPECIFIED.);\n\
        #27=VERTEX_POINT('',#21);\n#28=EDGE_CURVE('',#27,#27,#26,.T.);\n#29=ORIENTED_EDGE('',*,*,#28,.T.);\n#30=EDGE_LOOP('',(#29));\n\
        #31=FACE_OUTER_BOUND('',#30,.T.);\n#32=ADVANCED_FACE('',(#31),#25,.T.);\n#11=OPEN_SHELL('',(#32));\nENDSEC;\nEND-ISO-10303-21;\n";
    let text = block("nothing");
    let head = &text[..text.find("#10=").unwrap()];
    let text = format!("{head}#10=SHELL_BASED_SURFACE_MODEL('',(#11));\n{face}");
    let sources: MemorySources = [("block.step", text), ("scan.xyz", scan())].into_iter().collect();
    let begun = std::time::Instant::now();
    let compare = json!({"measured": "scan.xyz", "references": ["block.step"]});
    let request: CompareRequest = serde_json::from_value(compare).unwrap();
    let told = request.run(&sources, &Silent).err().unwrap().to_string();
    assert!(told.contains("none of its 1 faces") && told.contains("#32"), "{told}");
    let (_, outcome, _) = run::<CheckRequest>(json!({"mesh": "block.step"}), &sources);
    assert_eq!(outcome, Outcome::NotConforming);
    assert!(begun.elapsed().as_secs() < 20);
}
