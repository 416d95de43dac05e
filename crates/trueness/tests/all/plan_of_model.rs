//! A plan of the tolerances of a CAD model, and the verdicts that it gives on parts with known errors.

use std::collections::BTreeMap;
use std::fmt::Write;
use trueness::files::MemorySources;
use trueness::geom::progress::Silent;
use trueness::task::Request;
use trueness::tasks::inspect::InspectRequest;
use trueness::tasks::plan_init::PlanInitRequest;

/// A plate of 60 × 40 × 10 with a bore of 12 at (20, 15).
const SIZE: [f64; 3] = [60.0, 40.0, 10.0];
const BORE: [f64; 2] = [20.0, 15.0];
const RADIUS: f64 = 6.0;

/// The text of a STEP file while it is written.
#[derive(Default)]
struct Text {
    entities: String,
    count: u64,
}

impl Text {
    fn add(&mut self, entity: String) -> u64 {
        self.count += 1;
        let _ = writeln!(self.entities, "#{}={entity};", self.count);
        self.count
    }

    fn triple(&mut self, keyword: &str, [x, y, z]: [f64; 3]) -> u64 {
        self.add(format!("{keyword}('',({x:?},{y:?},{z:?}))"))
    }

    fn axes(&mut self, origin: [f64; 3], z: [f64; 3], x: [f64; 3]) -> u64 {
        let origin = self.triple("CARTESIAN_POINT", origin);
        let [z, x] = [z, x].map(|d| self.triple("DIRECTION", d));
        self.add(format!("AXIS2_PLACEMENT_3D('',#{origin},#{z},#{x})"))
    }

    fn vertex(&mut self, place: [f64; 3]) -> u64 {
        let point = self.triple("CARTESIAN_POINT", place);
        self.add(format!("VERTEX_POINT('',#{point})"))
    }

    fn bound(&mut self, uses: &[(u64, bool)]) -> u64 {
        let same = |same: bool| if same { ".T." } else { ".F." };
        let uses: Vec<String> = uses
            .iter()
            .map(|(e, s)| format!("#{}", self.add(format!("ORIENTED_EDGE('',*,*,#{e},{})", same(*s)))))
            .collect();
        let ring = self.add(format!("EDGE_LOOP('',({}))", uses.join(",")));
        self.add(format!("FACE_BOUND('',#{ring},.T.)"))
    }

    fn face(&mut self, bounds: &[u64], surface: u64, same: bool) -> u64 {
        let bounds: Vec<String> = bounds.iter().map(|b| format!("#{b}")).collect();
        let sense = if same { ".T." } else { ".F." };
        self.add(format!("ADVANCED_FACE('',({}),#{surface},{sense})", bounds.join(",")))
    }
}

/// The plate, and the numbers of its faces by name.
fn plate() -> (Text, BTreeMap<&'static str, u64>) {
    let mut text = Text::default();
    let corner = |k: usize| std::array::from_fn(|axis| if k >> axis & 1 == 1 { SIZE[axis] } else { 0.0 });
    let vertices: Vec<u64> = (0..8).map(|k| text.vertex(corner(k))).collect();
    let mut edges: BTreeMap<[usize; 2], u64> = BTreeMap::new();
    let circles: Vec<u64> = [0.0, SIZE[2]]
        .map(|z| {
            let axes = text.axes([BORE[0], BORE[1], z], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
            let circle = text.add(format!("CIRCLE('',#{axes},{RADIUS:?})"));
            let start = text.vertex([BORE[0] + RADIUS, BORE[1], z]);
            text.add(format!("EDGE_CURVE('',#{start},#{start},#{circle},.T.)"))
        })
        .to_vec();
    let mut faces = BTreeMap::new();
    // Corners run counter-clockwise as seen from outside.
    let sides: [(&str, [usize; 4], [f64; 3]); 6] = [
        ("bottom", [0, 2, 3, 1], [0.0, 0.0, -1.0]),
        ("top", [4, 5, 7, 6], [0.0, 0.0, 1.0]),
        ("left", [0, 4, 6, 2], [-1.0, 0.0, 0.0]),
        ("right", [1, 3, 7, 5], [1.0, 0.0, 0.0]),
        ("front", [0, 1, 5, 4], [0.0, -1.0, 0.0]),
        ("back", [2, 6, 7, 3], [0.0, 1.0, 0.0]),
    ];
    for (name, corners, normal) in sides {
        let uses: Vec<(u64, bool)> = (0..4)
            .map(|k| {
                let [a, b] = [corners[k], corners[(k + 1) % 4]];
                let key = [a.min(b), a.max(b)];
                let edge = *edges.entry(key).or_insert_with(|| {
                    let [from, to] = key.map(corner);
                    let way: [f64; 3] = std::array::from_fn(|i| to[i] - from[i]);
                    let (point, direction) =
                        (text.triple("CARTESIAN_POINT", from), text.triple("DIRECTION", way));
                    let vector = text.add(format!("VECTOR('',#{direction},1.)"));
                    let line = text.add(format!("LINE('',#{point},#{vector})"));
                    text.add(format!(
                        "EDGE_CURVE('',#{},#{},#{line},.T.)",
                        vertices[key[0]], vertices[key[1]]
                    ))
                });
                (edge, a < b)
            })
            .collect();
        let mut bounds = vec![text.bound(&uses)];
        match name {
            "bottom" => bounds.push(text.bound(&[(circles[0], true)])),
            "top" => bounds.push(text.bound(&[(circles[1], false)])),
            _ => {}
        }
        let x = if normal[0] == 0.0 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let axes = text.axes(corner(corners[0]), normal, x);
        let plane = text.add(format!("PLANE('',#{axes})"));
        faces.insert(name, text.face(&bounds, plane, true));
    }
    let axes = text.axes([BORE[0], BORE[1], 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let cylinder = text.add(format!("CYLINDRICAL_SURFACE('',#{axes},{RADIUS:?})"));
    let bounds = [text.bound(&[(circles[0], false)]), text.bound(&[(circles[1], true)])];
    faces.insert("bore", text.face(&bounds, cylinder, false));
    (text, faces)
}

/// The plate with datums A (bottom), B (left), C (front) and six tolerances.
fn model() -> (String, BTreeMap<&'static str, u64>) {
    let (mut text, faces) = plate();
    let all: Vec<String> = faces.values().map(|n| format!("#{n}")).collect();
    let shell = text.add(format!("CLOSED_SHELL('',({}))", all.join(",")));
    let solid = text.add(format!("MANIFOLD_SOLID_BREP('plate',#{shell})"));
    let mm = text.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))".into());
    let radian = text.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))".into());
    let context = text.add(format!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#{mm},#{radian}))REPRESENTATION_CONTEXT('',''))"
    ));
    let product = text.add("PRODUCT('plate','plate','',())".into());
    let formation = text.add(format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"));
    let definition = text.add(format!("PRODUCT_DEFINITION('','',#{formation},$)"));
    let shape = text.add(format!("PRODUCT_DEFINITION_SHAPE('','',#{definition})"));
    let shown = text.add(format!("SHAPE_REPRESENTATION('',(#{solid}),#{context})"));
    text.add(format!("SHAPE_DEFINITION_REPRESENTATION(#{shape},#{shown})"));
    let mut aspects = BTreeMap::new();
    for (name, face) in &faces {
        let aspect = text.add(format!("SHAPE_ASPECT('{name}','',#{shape},.T.)"));
        text.add(format!("GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#{aspect},#{shown},#{face})"));
        aspects.insert(*name, aspect);
    }
    let mut compartments = vec![];
    for (letter, name) in [("A", "bottom"), ("B", "left"), ("C", "front")] {
        let feature = text.add(format!("DATUM_FEATURE('','',#{shape},.T.)"));
        text.add(format!("GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#{feature},#{shown},#{})", faces[name]));
        let datum = text.add(format!("DATUM('',$,#{shape},.F.,'{letter}')"));
        text.add(format!("SHAPE_ASPECT_RELATIONSHIP('','',#{feature},#{datum})"));
        compartments.push(text.add(format!("DATUM_REFERENCE_COMPARTMENT('',$,#{shape},.F.,#{datum},$)")));
    }
    let [a, b, c] = [compartments[0], compartments[1], compartments[2]];
    let system = text.add(format!("DATUM_SYSTEM('',$,#{shape},.F.,(#{a},#{b},#{c}))"));
    let first = text.add(format!("DATUM_SYSTEM('',$,#{shape},.F.,(#{a}))"));
    let length =
        |text: &mut Text, x: f64| text.add(format!("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({x:?}),#{mm})"));
    let width = length(&mut text, 0.05);
    text.add(format!("FLATNESS_TOLERANCE('flat','',#{width},#{})", aspects["top"]));
    let width = length(&mut text, 0.1);
    text.add(format!("PERPENDICULARITY_TOLERANCE('square','',#{width},#{},(#{first}))", aspects["left"]));
    text.add(format!(
        "(FLATNESS_TOLERANCE()GEOMETRIC_TOLERANCE('unit','',#{width},#{})GEOMETRIC_TOLERANCE_WITH_DEFINED_UNIT(#{width}))",
        aspects["top"]
    ));
    let width = length(&mut text, 0.2);
    let position = text.add(format!(
        "(GEOMETRIC_TOLERANCE('place','',#{width},#{})GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE((#{system}))POSITION_TOLERANCE())",
        aspects["bore"]
    ));
    let form = text.add("TOLERANCE_ZONE_FORM('cylindrical or circular')".into());
    text.add(format!("TOLERANCE_ZONE('',$,#{shape},.F.,(#{position}),#{form})"));
    text.add(format!("SURFACE_PROFILE_TOLERANCE('','',#{width},#{},(#{system}))", aspects["back"]));
    let [lower, upper] = [-0.1, 0.2].map(|x| length(&mut text, x));
    let size = text.add(format!("DIMENSIONAL_SIZE(#{},'diameter')", aspects["bore"]));
    let height = text.add(format!(
        "DIMENSIONAL_LOCATION('linear distance','',#{},#{})",
        aspects["bottom"], aspects["top"]
    ));
    for (dimension, nominal) in [(size, 2.0 * RADIUS), (height, SIZE[2])] {
        let range = text.add(format!("TOLERANCE_VALUE(#{lower},#{upper})"));
        text.add(format!("PLUS_MINUS_TOLERANCE(#{range},#{dimension})"));
        let value = text.add(format!(
            "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE({nominal:?}),#{mm})\
             REPRESENTATION_ITEM('nominal value'))"
        ));
        let shown = text.add(format!("SHAPE_DIMENSION_REPRESENTATION('',(#{value}),#{context})"));
        text.add(format!("DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#{dimension},#{shown})"));
    }
    let text = format!(
        "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF'));\nENDSEC;\nDATA;\n{}ENDSEC;\nEND-ISO-10303-21;\n",
        text.entities
    );
    (text, faces)
}

/// Points of the plate: its bore is displaced along x and larger in radius, its top is higher.
fn scan(shift: f64, larger: f64, higher: f64) -> String {
    let mut out = String::new();
    let mut put = |p: [f64; 3]| {
        let _ = writeln!(out, "{:.9} {:.9} {:.9}", p[0], p[1], p[2]);
    };
    let [x, y, z] = [SIZE[0], SIZE[1], SIZE[2] + higher];
    let steps = |length: f64| (0..=length as usize).map(move |k| k as f64 * length / length.trunc());
    for u in steps(SIZE[0]) {
        for v in steps(SIZE[1]) {
            if distance(u - BORE[0] - shift, v - BORE[1]) > RADIUS + larger {
                put([u, v, 0.0]);
                put([u, v, z]);
            }
        }
        for w in steps(SIZE[2]) {
            put([u, 0.0, w * z / SIZE[2]]);
            put([u, y, w * z / SIZE[2]]);
        }
    }
    for v in steps(SIZE[1]) {
        for w in steps(SIZE[2]) {
            put([0.0, v, w * z / SIZE[2]]);
            put([x, v, w * z / SIZE[2]]);
        }
    }
    for k in 0..72 {
        let (sin, cos) = libm::sincos(k as f64 * std::f64::consts::PI / 36.0);
        for w in steps(SIZE[2]) {
            let r = RADIUS + larger;
            put([BORE[0] + shift + r * cos, BORE[1] + r * sin, w * z / SIZE[2]]);
        }
    }
    out
}

fn distance(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

fn proposed(sources: &MemorySources) -> String {
    let request = PlanInitRequest { nominal: "plate.stp".into(), ..PlanInitRequest::default() };
    request.run(sources, &Silent).unwrap().document.text
}

#[test]
fn tolerances_of_the_model_stand_in_the_plan() {
    let (text, faces) = model();
    let sources: MemorySources = [("plate.stp", text)].into_iter().collect();
    let plan = proposed(&sources);
    let has = |lines: &str| assert!(plan.contains(lines), "{lines}\n\n{plan}");
    has(&format!("id = \"A\"\nshape = \"plane\"\nface = {}\n", faces["bottom"]));
    has(&format!("shape = \"cylinder\"\nface = {}\ninternal = true\n", faces["bore"]));
    has("method = \"datum\"\ndatums = [\"A\", \"B\", \"C\"]\n");
    has(&format!("kind = \"flatness\"\nfeature = \"plane {}\"\ntolerance = 0.05\n", faces["top"]));
    has("kind = \"perpendicularity\"\nfeature = \"B\"\ntolerance = 0.1\ndatums = [\"A\"]\n");
    has(&format!(
        "kind = \"position\"\nfeature = \"cylinder {}\"\ntolerance = 0.2\ndatums = [\"A\", \"B\", \"C\"]\n",
        faces["bore"]
    ));
    has(&format!("feature = \"cylinder {}\"\nnominal = 12.0\nupper = 0.2\nlower = -0.1\n", faces["bore"]));
    has(&format!(
        "kind = \"distance\"\nfeature = \"plane {}\"\ndatums = [\"A\"]\nnominal = 10.0\n",
        faces["top"]
    ));
    has("flatness 0.1, of face");
    has("plans have no \"per unit of 0.1 mm\"");
    has("# datums of the model: 3 in the plan, 0 as comments\n");
    has("# dimensions of the model: 2 in the plan, 0 as comments\n");
    has("# geometric tolerances of the model: 4 in the plan, 1 as comments\n");
}

#[test]
fn known_errors_give_the_verdicts_that_they_demand() {
    let (text, _) = model();
    // Bore displaced, radius larger, top higher; and what fails: position (twice the shift), size, distance.
    for (shift, larger, higher, failed) in [
        (0.0, 0.0, 0.0, &[][..]),
        (0.08, 0.05, 0.1, &[]),
        (0.12, 0.0, 0.0, &["position"]),
        (0.0, 0.12, 0.0, &["size"]),
        (0.0, 0.0, 0.25, &["distance"]),
    ] {
        let mut sources: MemorySources = [("plate.stp", text.clone())].into_iter().collect();
        let plan = proposed(&sources);
        sources.insert("scan.xyz", scan(shift, larger, higher).into_bytes());
        sources.insert("plan.toml", plan.clone().into_bytes());
        let asked = serde_json::json!({"plan": "plan.toml", "measured": ["scan.xyz"]});
        let request: InspectRequest = serde_json::from_value(asked).unwrap();
        let done = request.run(&sources, &Silent).unwrap_or_else(|e| panic!("{e}\n{plan}"));
        let document: serde_json::Value = serde_json::from_str(&done.json().unwrap()).unwrap();
        let characteristics = document["characteristics"].as_array().unwrap();
        assert_eq!(characteristics.len(), 6, "{document}");
        for one in characteristics {
            let kind = one["kind"].as_str().unwrap();
            let expected = if failed.contains(&kind) { "fail" } else { "pass" };
            assert_eq!(one["verdict"], expected, "{one}");
            let value = one["value"].as_f64().unwrap();
            let exact = match kind {
                "position" => 2.0 * shift,
                "size" => 2.0 * (RADIUS + larger),
                "distance" => SIZE[2] + higher,
                _ => 0.0,
            };
            assert!((value - exact).abs() < 1e-6, "{kind} {value} {exact}");
        }
    }
}
