//! Reading STEP files: own ones, those of other programs, broken ones.

use super::surface;
use crate::cad::{SplineModel, SplineSurface};
use crate::format::{Content, Parsed};
use crate::source::Source;
use crate::write::scratch::Folder;
use crate::{Body, Input, MemorySources, ReadError, ReadOptions, Sources, Unit, UnitFrom, Warning, open};
use std::path::Path;
use trueness_geom::num::random::Random;
use trueness_geom::spline::surface::Nurbs;

/// Opens text as a file without an ending that tells.
fn opened(text: &[u8], units: Option<Unit>) -> Result<Input, ReadError> {
    let folder = Folder::new();
    let path = folder.path().join("model");
    std::fs::write(&path, text).unwrap();
    open(&path, &ReadOptions { units, ..ReadOptions::default() })
}

/// The surfaces and curves of a text, whole.
fn read(text: &[u8], units: Option<Unit>) -> Result<Parsed, ReadError> {
    let sources: MemorySources = [("model", text.to_vec())].into_iter().collect();
    let bytes = sources.bytes(Path::new("model")).unwrap();
    let parsed = Source::of(bytes).and_then(|mut source| {
        super::read::read(&mut source, &ReadOptions { units, ..ReadOptions::default() })
    });
    parsed.map_err(|e| e.in_file("model"))
}

fn model(parsed: Parsed) -> (SplineModel, Vec<Warning>) {
    match parsed.content {
        Content::Splines(model) => (model, parsed.warnings),
        _ => panic!("no splines"),
    }
}

/// Numbers of every size, with all their digits.
fn points(count: usize) -> Vec<[f64; 3]> {
    let mut random = Random::stream(3, 0);
    (0..count).map(|_| std::array::from_fn(|k| (random.unit() - 0.5) * [1e-7, 3.0, 1e9][k])).collect()
}

fn written(knots: [&[f64]; 2], degree: [usize; 2], points: &[[f64; 3]]) -> Vec<u8> {
    let mut bytes = vec![];
    surface(&mut bytes, &SplineSurface { degree, knots, points, faces: &[] }).unwrap();
    bytes
}

const U: [f64; 9] = [-1.0, -1.0, -1.0, -1.0, 1.0 / 3.0, 7.5, 7.5, 7.5, 7.5];
const V: [f64; 7] = [0.0, 0.0, 0.0, 1e-3, 2.0, 2.0, 2.0];

#[test]
fn what_was_written_reads_back_bit_for_bit() {
    let points = points(20);
    let input = opened(&written([&U, &V], [3, 2], &points), Some(Unit::Inch)).unwrap();
    assert_eq!(
        (input.provenance.unit_assumed, input.provenance.unit_from),
        (Unit::Millimeter, UnitFrom::Header)
    );
    assert_eq!(input.warnings, [Warning::UnitKept { said: Unit::Millimeter, asked: Unit::Inch }]);
    let Body::Cad(file) = input.body else { panic!("no model") };
    let model = file.splines.unwrap();
    let [Nurbs::Plain(found)] = &model.surfaces[..] else { panic!("{}", model.surfaces.len()) };
    assert_eq!((found.knots()[0].values(), found.knots()[1].values()), (&U[..], &V[..]));
    assert_eq!(found.points(), points);
}

/// A file of these instances, in meters.
fn file(instances: &str) -> Vec<u8> {
    format!(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('it''s; a /* test'),'2;1');\nENDSEC;\nDATA;\n\
         #1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n\
         #2=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#1))REPRESENTATION_CONTEXT('',''));\n\
         #3=CARTESIAN_POINT('',(1.,0.,0.));\n#4=CARTESIAN_POINT('',(1.,0.,2.));\n\
         #5=CARTESIAN_POINT('',(1.,1.,0.));\n#6=CARTESIAN_POINT('',(1.,1.,2.));\n\
         #7=CARTESIAN_POINT('',(0.,1.,0.));\n#8=CARTESIAN_POINT ( 'a;b', (0.,1.E0,2) ) ;\n{instances}\nENDSEC;\nEND-ISO-10303-21;\n"
    )
    .into_bytes()
}

const QUARTER: &str = "/* a quarter of a cylinder; */ #10=(\n BOUNDED_SURFACE ( ) B_SPLINE_SURFACE(2,1,((#3,#4),(#5,#6),\n(#7,#8)),\
    .CYLINDRICAL_SURF.,.F.,.F.,.U.)B_SPLINE_SURFACE_WITH_KNOTS((3,3),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)\
    GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE(((1.,1.),(0.70710678118654757,0.70710678118654757),(1.,1.)))\
    REPRESENTATION_ITEM('')SURFACE());";

#[test]
fn rational_surfaces_of_complex_instances_in_meters() {
    let (found, warnings) = model(read(&file(QUARTER), None).unwrap());
    assert!(warnings.is_empty() && matches!(found.surfaces[..], [Nurbs::Rational(_)]));
    for (u, v) in [(0.0, 0.0), (0.3, 0.2), (0.9, 1.0)] {
        let [x, y, z] = found.surfaces[0].at(u, v).unwrap();
        assert!((x * x + y * y - 1e6).abs() < 1e-9 && (z - 2000.0 * v).abs() < 1e-9);
    }
}

#[test]
fn kinds_without_knots_have_those_of_their_kind() {
    let net = "((#3,#4),(#5,#6),(#7,#8)),.UNSPECIFIED.,.F.,.F.,.F.";
    let knots = |keyword: &str, degrees: &str| {
        let (found, _) = model(read(&file(&format!("#10={keyword}('',{degrees},{net});")), None).unwrap());
        found.surfaces[0].knots().clone().map(|k| k.values().to_vec())
    };
    let straight = vec![0.0, 0.0, 1.0, 1.0];
    assert_eq!(knots("BEZIER_SURFACE", "2,1"), [vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], straight.clone()]);
    assert_eq!(knots("BEZIER_SURFACE", "1,1"), [vec![0.0, 0.0, 1.0, 2.0, 2.0], straight.clone()]);
    assert_eq!(knots("QUASI_UNIFORM_SURFACE", "1,1"), [vec![0.0, 0.0, 1.0, 2.0, 2.0], straight]);
    let uniform = [vec![-1.0, 0.0, 1.0, 2.0, 3.0], vec![-1.0, 0.0, 1.0, 2.0]];
    assert_eq!(knots("UNIFORM_SURFACE", "1,1"), uniform);
}

/// A face that is a whole surface is one, and its sense turns the normal. One with a hole or a vertex within its surface, one on a plane, and
/// one that a part in an assembly moves are none.
#[test]
fn whole_faces_turn_and_others_are_none() {
    let edge = |number: u32, [a, b]: [&str; 2], along: &str| {
        let [line, vector, direction] = [1, 2, 3].map(|k| number + k);
        format!(
            "#{number}=EDGE_CURVE('',{a},{b},#{line},.T.);\n#{line}=LINE('',#3,#{vector});\n#{vector}=VECTOR('',#{direction},1.);\n\
             #{direction}=DIRECTION('',({along}));\n#{}=ORIENTED_EDGE('',*,*,#{number},.T.);\n",
            number + 4
        )
    };
    let splines = |vertex: &str, bounds: &str, surface: &str, sense: &str| {
        let vertices = format!("#20=VERTEX_POINT('',#3);\n#21=VERTEX_POINT('',#{vertex});\n");
        let along = if vertex == "4" { "0.,0.,1." } else { "0.,1.,0." };
        let edges = edge(40, ["#20", "#21"], along) + &edge(50, ["#21", "#20"], along);
        let text = format!(
            "{QUARTER}\n{vertices}{edges}#24=EDGE_LOOP('',(#44,#54));\n#25=FACE_BOUND('',#24,.T.);\n#26=FACE_BOUND('',#24,.T.);\n\
             #31=PLANE('',#32);\n#32=AXIS2_PLACEMENT_3D('',#3,$,$);\n#30=ADVANCED_FACE('',({bounds}),{surface},{sense});"
        );
        let Body::Cad(file) = opened(&file(&text), None).unwrap().body else { panic!("no model") };
        file.splines
    };
    let normal = |model: &SplineModel| model.surfaces[0].bend(0.5, 0.5).unwrap().normal;
    assert!(normal(&splines("4", "#25", "#10", ".T.").unwrap())[0] > 0.7);
    assert!(normal(&splines("4", "#25", "#10", ".F.").unwrap())[0] < -0.7);
    assert!(splines("5", "#25", "#10", ".T.").is_none());
    assert!(splines("4", "#25,#26", "#10", ".T.").is_none());
    assert!(splines("4", "#25", "#31", ".T.").is_none());
}

#[test]
fn broken_files_are_refused_with_their_line() {
    let net = "((#3,#4),(#5,#6)),.UNSPECIFIED.,.F.,.F.,.F.";
    let cases = [
        (format!("#10=B_SPLINE_SURFACE_WITH_KNOTS('',1,1,{net},(2,2),(2,3),(0.,1.),(0.,1.),.U.);"), "knots"),
        (format!("#10=B_SPLINE_SURFACE_WITH_KNOTS('',1,1,{net},(2,2),(2,2),(1.,0.),(0.,1.),.U.);"), "must not fall"),
        (format!("#10=B_SPLINE_SURFACE_WITH_KNOTS('',1,9999999999,{net},(2,2),(2,2),(0.,1.),(0.,1.),.U.);"), "knots"),
        ("#10=BEZIER_SURFACE('',1,1,((#3,#4),(#5)),.U.,.F.,.F.,.F.);".into(), "equally many"),
        ("#10=BEZIER_SURFACE('',1,1,((#3,#4),(#5,#77)),.U.,.F.,.F.,.F.);".into(), "that are there"),
        ("#10=BEZIER_SURFACE('',1,1,((#3,#4),(#5,#1)),.U.,.F.,.F.,.F.);".into(), "CARTESIAN_POINT"),
        ("#10=CURVE('never ends);".into(), "quote"),
        ("#10=CURVE((1,2);".into(), "closing bracket"),
        ("#3=CURVE();".into(), "once"),
        (QUARTER.replace("(0.70710678118654757,0.70710678118654757)", "(0.,-1.)"), "must be above 0"),
        (QUARTER.replace("(0.70710678118654757,0.70710678118654757),", ""), "weight"),
        ("#10=MAPPED_ITEM('',#1,#2);".into(), "assembly"),
        ("#9=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n#10=GLOBAL_UNIT_ASSIGNED_CONTEXT((#9));".into(), "more than one unit"),
        ("#9=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.KILO.,.METRE.));\n#10=GLOBAL_UNIT_ASSIGNED_CONTEXT((#9));".into(), "inch"),
        (format!("#10=CURVE({}1{});", "(".repeat(100), ")".repeat(100)), "lists within lists"),
    ];
    for (text, wanted) in cases {
        let said = match read(&file(&text), None) {
            Err(e) => e.to_string(),
            Ok(_) => panic!("{text} was read"),
        };
        assert!(said.contains(wanted) && said.contains("line "), "{text}\n{said}");
    }
}

#[test]
fn cut_short_or_changed_anywhere_it_does_no_harm() {
    let whole = file(QUARTER);
    for end in 0..whole.len() {
        let cut = read(&whole[..end], None);
        assert!(cut.is_err() || end + 2 >= whole.len(), "{end}");
    }
    let mut random = Random::stream(11, 0);
    for _ in 0..3000 {
        let mut bytes = whole.clone();
        for _ in 0..1 + random.below(4) {
            let at = random.below(bytes.len() as u64) as usize;
            bytes[at] = b"0123456789#(),;'.$*-E/ABS\n"[random.below(26) as usize];
        }
        let _ = read(&bytes, None);
    }
}
