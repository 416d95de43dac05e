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
    // Its four edges.
    assert_eq!(model.curves.len(), 4);
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

/// The sense of a face turns the normal; faces on planes, holes and vertices within are told.
#[test]
fn faces_turn_trim_and_leave_out() {
    let bound = "#20=VERTEX_POINT('',#3);\n#21=VERTEX_POINT('',#P);\n#22=EDGE_CURVE('',#20,#21,#99,.T.);\n\
        #23=ORIENTED_EDGE('',*,*,#22,.T.);\n#24=EDGE_LOOP('',(#23));\n#25=FACE_OUTER_BOUND('',#24,.T.);\n";
    let face = |vertex: &str, bounds: &str, sense: &str| {
        let bound = bound.replace("#P", vertex);
        let text = format!("{QUARTER}\n{bound}#30=ADVANCED_FACE('',({bounds}),#10,{sense});");
        model(read(&file(&text), None).unwrap())
    };
    let normal = |m: &SplineModel| m.surfaces[0].bend(0.5, 0.5).unwrap().normal;
    let (same, warnings) = face("#8", "#25", ".T.");
    assert!(warnings.is_empty() && normal(&same)[0] > 0.7);
    assert!(normal(&face("#8", "#25", ".F.").0)[0] < -0.7);
    assert_eq!(face("#5", "#25", ".T.").1, [Warning::Trimmed { count: 1 }]);
    assert_eq!(face("#8", "#25,#25", ".T.").1, [Warning::Trimmed { count: 1 }]);
    let plane = format!(
        "{QUARTER}\n#31=PLANE('',#3);\n#32=ADVANCED_FACE('',(),#31,.T.);\n#33=ADVANCED_FACE('',(),#10,.T.);"
    );
    let (found, warnings) = model(read(&file(&plane), None).unwrap());
    assert_eq!((found.surfaces.len(), warnings), (1, vec![Warning::FacesLeftOut { count: 1, of: 2 }]));
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
