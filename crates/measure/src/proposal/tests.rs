//! Plans of small models, each held against the model itself.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may stop")]

use super::{General, Proposal, of_model};
use crate::cad_faces::CadFaces;
use crate::inspection::{Data, on_model};
use crate::plan::Plan;
use std::sync::Arc;
use trueness_cad::brep::{Bounds, Brep, Face};
use trueness_cad::frame::{Frame, Placement};
use trueness_cad::model::{Instance, Model, Part};
use trueness_cad::surface::Surface;
use trueness_cad::tessellate::Fineness;
use trueness_cad::tolerances::{
    Datum, DatumPart, DatumReference, Dimension, GeometricTolerance, Target, Tolerances,
};
use trueness_cad::trimmed::Trimmed;
use trueness_geom::progress::Silent;

const FINENESS: Fineness = Fineness { distance: 0.01, angle: 0.2 };
/// A whole turn, and half of one.
const TURN: [f64; 2] = [0.0, std::f64::consts::TAU];
const HALF_TURN: [f64; 2] = [0.0, std::f64::consts::PI];

fn frame(origin: [f64; 3], z: [f64; 3]) -> Frame {
    Frame::new(origin, z, None).unwrap()
}

fn face(entity: u64, surface: Surface, sides: [[f64; 2]; 2], reversed: bool) -> Face {
    Face {
        surface,
        reversed,
        bounds: Bounds::Rectangle(sides),
        entity,
        name: String::new(),
        color: None,
        instance: 0,
    }
}

fn plane(entity: u64, origin: [f64; 3], z: [f64; 3]) -> Face {
    face(entity, Surface::Plane(frame(origin, z)), [[-20.0, 20.0], [-10.0, 10.0]], false)
}

fn bore(entity: u64, [x, y]: [f64; 2], radius: f64, turn: [f64; 2]) -> Face {
    let frame = frame([x, y, 0.0], [0.0, 0.0, 1.0]);
    face(entity, Surface::Cylinder { frame, radius }, [turn, [0.0, 8.0]], true)
}

fn part(faces: Vec<Face>) -> Part {
    Part { brep: Brep { faces, ..Brep::default() }, ..Part::default() }
}

fn alone(faces: Vec<Face>, tolerances: Tolerances) -> Model {
    Model {
        parts: vec![part(faces)],
        instances: vec![Instance::of(0, Placement::IDENTITY)],
        tolerances,
        ..Model::default()
    }
}

fn reference(model: &Model) -> Data {
    let shape = Trimmed::of(model, &Silent).unwrap();
    let drawn = shape.tessellate(FINENESS, 1 << 20, &Silent).unwrap();
    let faces = CadFaces::new(model, shape, (&drawn.mesh, drawn.faces), FINENESS.distance, &Silent).unwrap();
    Data { reference: Some(drawn.mesh), faces: Some(Arc::new(faces)), ..Data::default() }
}

/// The plan of a model, which parses and which the model keeps.
fn proposed(model: &Model, general: Option<&str>) -> String {
    let data = reference(model);
    let general = general.map(|text| text.parse::<General>().unwrap());
    let asked = Proposal { reference: "m.stp", general: general.as_ref() };
    let text = of_model(model, &data, &asked, &Silent).unwrap();
    let plan = Plan::parse(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let wrong = on_model(&plan, &data, &Silent).unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert!(wrong.iter().all(Option::is_none), "{wrong:?}\n{text}");
    text
}

fn has(text: &str, lines: &str) {
    assert!(text.contains(lines), "{lines}\n\n{text}");
}

/// A lid that is flush with the first of two plates of one name: features are of one instance each, and each is named so that there is one.
#[test]
fn features_of_an_assembly_are_of_one_instance() {
    let [up, down] = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let plate =
        part(vec![plane(10, [0.0; 3], up), plane(11, [0.0, 0.0, -5.0], down), bore(12, [0.0; 2], 3.0, TURN)]);
    let lid = part(vec![plane(20, [50.0, 0.0, 0.0], up), plane(21, [50.0, 0.0, -5.0], down)]);
    let at = |part: u32, name: &str, z: f64| Instance {
        path: vec!["asm".into(), name.into()],
        ..Instance::of(part, Placement { shift: [0.0, 0.0, z], ..Placement::IDENTITY })
    };
    let model = Model {
        parts: vec![plate, lid],
        instances: vec![at(1, "lid", 0.0), at(0, " ", 0.0), at(0, " ", 40.0)],
        ..Model::default()
    };
    assert_eq!(reference(&model).faces.unwrap().instances, ["asm/lid", "asm/", "asm/ (2)"]);
    let text = proposed(&model, None);
    has(&text, "id = \"A\"\nshape = \"plane\"\nface = 10\n# the first of 2 instances\ninstance = \"asm/\"\n");
    has(&text, "id = \"plane 20\"\nshape = \"plane\"\nface = 20\n\n");
    assert_eq!(text.matches("[[feature]]").count(), 5);
}

/// A plane that leans by a degree is neither parallel nor perpendicular, and one that leans by the digits of a file is.
#[test]
fn leaning_planes_have_no_attitude() {
    let lean = |degrees: f64| {
        let (s, c) = libm::sincos(f64::to_radians(degrees));
        [0.0, s, c]
    };
    let faces = vec![
        plane(1, [0.0; 3], [0.0, 0.0, -1.0]),
        plane(2, [0.0, 0.0, 9.0], lean(1.0)),
        plane(3, [0.0, 0.0, 19.0], lean(1e-5)),
        plane(4, [0.0, 30.0, 0.0], lean(89.0)),
    ];
    let text = proposed(&alone(faces, Tolerances::default()), None);
    let attitudes = |kind: &str| text.matches(&format!("kind = \"{kind}\"\n")).count();
    assert_eq!([attitudes("parallelism"), attitudes("perpendicularity")], [1, 0], "{text}");
    has(&text, "kind = \"parallelism\"\nfeature = \"plane 3\"\n");
}

/// General tolerances by the tables of ISO 2768 for sides, sizes and distances of the model.
#[test]
fn general_tolerances_go_by_the_sizes_of_the_model() {
    let faces = vec![
        plane(1, [0.0; 3], [0.0, 0.0, -1.0]),
        plane(2, [0.0, 0.0, 8.0], [0.0, 0.0, 1.0]),
        face(
            3,
            Surface::Plane(Frame::new([20.0, 0.0, 4.0], [1.0, 0.0, 0.0], Some([0.0, 1.0, 0.0])).unwrap()),
            [[-10.0, 10.0], [-4.0, 4.0]],
            false,
        ),
        bore(4, [0.0; 2], 3.5, TURN),
        bore(5, [10.0, 0.0], 2.0, HALF_TURN),
    ];
    let model = alone(faces, Tolerances::default());
    let text = proposed(&model, Some("ISO2768-mK"));
    // Sides of 40: 0.2; a bore of 7: 0.2 by class m; a rounding of 2: 0.2 of the radius; 8 between planes: 0.2.
    has(&text, "kind = \"flatness\"\nfeature = \"A\"\nclass = \"K\"\nlength = 40.0\n");
    has(&text, "kind = \"size\"\nfeature = \"cylinder 4\"\nsize = \"LP\"\nnominal = 7.0\nclass = \"m\"\n");
    has(&text, "feature = \"cylinder 5\"\nsize = \"GG\"\nnominal = 4.0\nupper = 0.4\nlower = -0.4\n");
    has(
        &text,
        "kind = \"distance\"\nfeature = \"plane 2\"\ndatums = [\"A\"]\nnominal = 8.0\nclass = \"m\"\n",
    );
    has(&text, "kind = \"parallelism\"\nfeature = \"plane 2\"\ndatums = [\"A\"]\ntolerance = 0.4\n");
    has(
        &text,
        "kind = \"perpendicularity\"\nfeature = \"plane 3\"\ndatums = [\"A\"]\nclass = \"K\"\nlength = 8.0\n",
    );
    let geometry = proposed(&model, Some("L"));
    assert!(!geometry.contains("kind = \"size\"") && geometry.contains("class = \"L\""), "{geometry}");
}

fn target(faces: &[u64]) -> Target {
    Target { faces: faces.to_vec(), ..Target::default() }
}

/// A slot's length from round end to round end is no distance of middles; a distance without limits takes the general ones.
#[test]
fn dimensions_that_the_model_has_otherwise_are_told() {
    let faces = vec![
        plane(1, [0.0; 3], [0.0, 0.0, -1.0]),
        bore(2, [-6.0, 0.0], 2.5, HALF_TURN),
        bore(3, [6.0, 0.0], 2.5, HALF_TURN),
    ];
    let dimension = |entity: u64, nominal: f64, deviations: Option<[f64; 2]>| Dimension {
        entity,
        name: "linear distance".into(),
        of: vec![target(&[2]), target(&[3])],
        nominal: Some(nominal),
        deviations,
        ..Dimension::default()
    };
    let some = Some([-0.1, 0.1]);
    let dimensions = vec![
        dimension(50, 12.0, some),
        dimension(51, 17.0, some),
        dimension(52, 7.0, some),
        dimension(53, 13.0, some),
        dimension(54, 12.0, None),
    ];
    let model = alone(faces, Tolerances { dimensions, ..Tolerances::default() });
    let text = proposed(&model, Some("m"));
    has(&text, "id = \"50\"\nkind = \"distance\"\n");
    has(&text, "nominal = 12.0\nclass = \"m\"\n");
    let told = |entity: u64, why: &str| {
        let line = text.lines().find(|l| l.starts_with(&format!("# Not in the plan: #{entity} ")));
        assert!(line.is_some_and(|l| l.contains(why)), "{entity} {why}\n{text}");
    };
    told(51, "far side to far side");
    told(52, "near side to near side");
    told(53, "the model itself has 12");
    has(&text, "# dimensions of the model: 2 in the plan, 3 as comments\n");
}

/// What the datums of the model cannot hold, or plans cannot measure there, is a comment, and the rest of the plan stands.
#[test]
fn requirements_that_are_not_measured_are_comments() {
    let faces = vec![
        plane(1, [0.0; 3], [0.0, 0.0, -1.0]),
        plane(2, [0.0, -10.0, 0.0], [0.0, -1.0, 0.0]),
        plane(3, [-20.0, 0.0, 0.0], [-1.0, 0.0, 0.0]),
        plane(6, [0.0, 0.0, 12.0], [0.0, 0.0, 1.0]),
        face(
            4,
            Surface::Cylinder { frame: frame([0.0, 3.0, 6.0], [1.0, 0.0, 0.0]), radius: 2.0 },
            [TURN, [0.0, 8.0]],
            true,
        ),
    ];
    let datum = |entity: u64, letter: &str, face: u64| Datum {
        entity,
        letter: letter.into(),
        features: vec![target(&[face])],
        targets: vec![],
    };
    let to = |letters: &[&str]| {
        let part = |letter: &&str| DatumPart { letter: (*letter).into(), modifiers: vec![] };
        letters.iter().map(|l| DatumReference { parts: vec![part(l)] }).collect::<Vec<_>>()
    };
    let size = Dimension {
        entity: 60,
        name: "diameter".into(),
        of: vec![target(&[4])],
        nominal: Some(4.0),
        deviations: Some([0.0, 0.1]),
        ..Dimension::default()
    };
    let position = |entity: u64, modifiers: &[&str], datums: &[&str]| GeometricTolerance {
        entity,
        kind: "position".into(),
        width: Some(0.2),
        of: target(&[4]),
        datums: to(datums),
        modifiers: modifiers.iter().map(|m| m.to_string()).collect(),
        zone: Some("cylindrical or circular".into()),
        ..GeometricTolerance::default()
    };
    let geometric = vec![
        position(70, &["maximum material requirement"], &["A", "B", "C"]),
        position(71, &[], &["A", "B", "C"]),
        position(72, &[], &["A", "D"]),
    ];
    let datums = vec![datum(80, "A", 1), datum(81, "B", 2), datum(82, "C", 3), datum(83, "D", 6)];
    let text = proposed(&alone(faces, Tolerances { datums, geometric, dimensions: vec![size] }), None);
    has(&text, "# Not in the plan: #70 position 0.2 (maximum material requirement) to A | B | C");
    has(&text, "evaluated for an axis along z, placed by x and y");
    has(&text, "id = \"71\"\nkind = \"position\"\n");
    has(&text, "# Not in the plan: #72 position 0.2 to A | D");
    has(&text, "# geometric tolerances of the model: 1 in the plan, 2 as comments\n");
}
