//! Faces of a CAD model as a reference: features by face, exact distances, alignments that end on them.

use std::collections::BTreeMap;
use std::fmt::Write;
use trueness::document::Verdict;
use trueness::document::inspect::InspectDocument;
use trueness::files::MemorySources;
use trueness::geom::progress::Silent;
use trueness::task::{Request, TaskError};
use trueness::tasks::align::AlignRequest;
use trueness::tasks::compare::CompareRequest;
use trueness::tasks::inspect::InspectRequest;

type Point = [f64; 3];

/// A file under the way, entity by entity.
struct Step {
    text: String,
    next: u64,
    vertices: Vec<(Point, u64)>,
    edges: BTreeMap<[u64; 3], u64>,
    faces: Vec<u64>,
}

impl Step {
    fn new() -> Step {
        Step { text: String::new(), next: 100, vertices: vec![], edges: BTreeMap::new(), faces: vec![] }
    }

    fn add(&mut self, entity: &str) -> u64 {
        self.next += 1;
        writeln!(self.text, "#{}={entity};", self.next).unwrap();
        self.next
    }

    fn three(&mut self, keyword: &str, [x, y, z]: Point) -> u64 {
        self.add(&format!("{keyword}('',({x:?},{y:?},{z:?}))"))
    }

    fn placement(&mut self, at: Point, z: Point, x: Point) -> u64 {
        let (at, z, x) =
            (self.three("CARTESIAN_POINT", at), self.three("DIRECTION", z), self.three("DIRECTION", x));
        self.add(&format!("AXIS2_PLACEMENT_3D('',#{at},#{z},#{x})"))
    }

    fn vertex(&mut self, at: Point) -> u64 {
        if let Some(known) = self.vertices.iter().find(|v| v.0 == at) {
            return known.1;
        }
        let point = self.three("CARTESIAN_POINT", at);
        let vertex = self.add(&format!("VERTEX_POINT('',#{point})"));
        self.vertices.push((at, vertex));
        vertex
    }

    /// A use of a straight edge; each pair of vertices has one.
    fn line(&mut self, from: Point, to: Point) -> u64 {
        let (a, b) = (self.vertex(from), self.vertex(to));
        let (first, last, forth) = if a < b { (from, to, true) } else { (to, from, false) };
        let key = [a.min(b), a.max(b), 0];
        let edge = match self.edges.get(&key) {
            Some(edge) => *edge,
            None => {
                let way: Point = std::array::from_fn(|k| last[k] - first[k]);
                let (point, way) = (self.three("CARTESIAN_POINT", first), self.three("DIRECTION", way));
                let vector = self.add(&format!("VECTOR('',#{way},1.)"));
                let line = self.add(&format!("LINE('',#{point},#{vector})"));
                let edge = self.add(&format!("EDGE_CURVE('',#{},#{},#{line},.T.)", key[0], key[1]));
                self.edges.insert(key, edge);
                edge
            }
        };
        self.oriented(edge, forth)
    }

    /// A use of the arc that goes around +z from one vertex to another.
    fn arc(&mut self, center: Point, [from, to]: [Point; 2], forth: bool) -> u64 {
        let key = [self.vertex(from), self.vertex(to), 1];
        let edge = match self.edges.get(&key) {
            Some(edge) => *edge,
            None => {
                let place = self.placement(center, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
                let circle = self.add(&format!("CIRCLE('',#{place},{RADIUS:?})"));
                let edge = self.add(&format!("EDGE_CURVE('',#{},#{},#{circle},.T.)", key[0], key[1]));
                self.edges.insert(key, edge);
                edge
            }
        };
        self.oriented(edge, forth)
    }

    fn oriented(&mut self, edge: u64, forth: bool) -> u64 {
        self.add(&format!("ORIENTED_EDGE('',*,*,#{edge},{})", if forth { ".T." } else { ".F." }))
    }

    fn face(&mut self, name: &str, loops: &[Vec<u64>], surface: u64, same_sense: bool) {
        let mut bounds = vec![];
        for uses in loops {
            let uses: Vec<String> = uses.iter().map(|u| format!("#{u}")).collect();
            let edge_loop = self.add(&format!("EDGE_LOOP('',({}))", uses.join(",")));
            bounds.push(format!("#{}", self.add(&format!("FACE_BOUND('',#{edge_loop},.T.)"))));
        }
        let sense = if same_sense { ".T." } else { ".F." };
        let face = self.add(&format!("ADVANCED_FACE('{name}',({}),#{surface},{sense})", bounds.join(",")));
        self.faces.push(face);
    }

    fn polygon(&mut self, corners: [Point; 4]) -> Vec<u64> {
        (0..4).map(|k| self.line(corners[k], corners[(k + 1) % 4])).collect()
    }

    fn plane(&mut self, name: &str, corners: [Point; 4], normal: Point, holes: Vec<Vec<u64>>) {
        let least = if normal[0] == 0.0 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let place = self.placement(corners[0], normal, least);
        let surface = self.add(&format!("PLANE('',#{place})"));
        let outer = self.polygon(corners);
        self.face(name, &[vec![outer], holes].concat(), surface, true);
    }

    /// The file of one solid of all faces.
    fn file(mut self) -> (String, Vec<u64>) {
        let faces: Vec<String> = self.faces.iter().map(|f| format!("#{f}")).collect();
        let shell = self.add(&format!("CLOSED_SHELL('',({}))", faces.join(",")));
        let solid = self.add(&format!("MANIFOLD_SOLID_BREP('plate',#{shell})"));
        let text = format!(
            "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n\
             #1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n#2=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n\
             #3=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-4),#1,'','');\n\
             #4=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#3))\
             GLOBAL_UNIT_ASSIGNED_CONTEXT((#1,#2))REPRESENTATION_CONTEXT('',''));\n\
             #5=CARTESIAN_POINT('',(0.,0.,0.));\n#6=DIRECTION('',(1.,0.,0.));\n#8=DIRECTION('',(0.,0.,1.));\n\
             #9=AXIS2_PLACEMENT_3D('',#5,#8,#6);\n#10=PRODUCT('id','a part','',());\n#11=PRODUCT_DEFINITION_FORMATION('','',#10);\n\
             #12=PRODUCT_DEFINITION('','',#11,$);\n#13=PRODUCT_DEFINITION_SHAPE('','',#12);\n\
             #14=SHAPE_DEFINITION_REPRESENTATION(#13,#15);\n#15=SHAPE_REPRESENTATION('',(#9,#{solid}),#4);\n{}ENDSEC;\n\
             END-ISO-10303-21;\n",
            self.text
        );
        (text, self.faces)
    }
}

const LENGTH: f64 = 40.0;
const WIDTH: f64 = 30.0;
const HEIGHT: f64 = 10.0;
const RADIUS: f64 = 5.0;
const CENTER: [f64; 2] = [20.0, 15.0];

/// A plate with a bore of two half cylinders, of which the second is off by so much; numbers of its faces: bottom, top, front, back, left, right,
/// both halves.
fn plate(off: f64) -> (String, Vec<u64>) {
    let mut s = Step::new();
    let [l, w, h] = [LENGTH, WIDTH, HEIGHT];
    let center = |z: f64| [CENTER[0], CENTER[1], z];
    let a = |z: f64| [CENTER[0] + RADIUS, CENTER[1], z];
    let b = |z: f64| [CENTER[0] - RADIUS, CENTER[1], z];
    let below = vec![s.arc(center(0.0), [a(0.0), b(0.0)], true), s.arc(center(0.0), [b(0.0), a(0.0)], true)];
    s.plane("", [[0.0, 0.0, 0.0], [0.0, w, 0.0], [l, w, 0.0], [l, 0.0, 0.0]], [0.0, 0.0, -1.0], vec![below]);
    let above = vec![s.arc(center(h), [b(h), a(h)], false), s.arc(center(h), [a(h), b(h)], false)];
    s.plane("TOP", [[0.0, 0.0, h], [l, 0.0, h], [l, w, h], [0.0, w, h]], [0.0, 0.0, 1.0], vec![above]);
    s.plane("", [[0.0, 0.0, 0.0], [l, 0.0, 0.0], [l, 0.0, h], [0.0, 0.0, h]], [0.0, -1.0, 0.0], vec![]);
    s.plane("", [[0.0, w, 0.0], [0.0, w, h], [l, w, h], [l, w, 0.0]], [0.0, 1.0, 0.0], vec![]);
    s.plane("", [[0.0, 0.0, 0.0], [0.0, 0.0, h], [0.0, w, h], [0.0, w, 0.0]], [-1.0, 0.0, 0.0], vec![]);
    s.plane("", [[l, 0.0, 0.0], [l, w, 0.0], [l, w, h], [l, 0.0, h]], [1.0, 0.0, 0.0], vec![]);
    for (off, [from, to]) in [(0.0, [a(0.0), b(0.0)]), (off, [b(0.0), a(0.0)])] {
        let up = |p: Point| [p[0], p[1], h];
        let place = s.placement([CENTER[0] + off, CENTER[1], 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let surface = s.add(&format!("CYLINDRICAL_SURFACE('',#{place},{RADIUS:?})"));
        let around = vec![
            s.arc(center(0.0), [from, to], false),
            s.line(from, up(from)),
            s.arc(center(h), [up(from), up(to)], true),
            s.line(up(to), to),
        ];
        s.face("BORE", &[around], surface, false);
    }
    s.file()
}

/// Points of a plate whose bore is larger by `grown`, clear of its edges.
fn scan(grown: f64) -> Vec<Point> {
    let mut all = vec![];
    for (i, j) in (1..40).flat_map(|i| (1..30).map(move |j| (i, j))) {
        let [x, y] = [f64::from(i), f64::from(j)];
        if (x - CENTER[0]).hypot(y - CENTER[1]) > RADIUS + 0.9 {
            all.extend([[x, y, 0.0], [x, y, HEIGHT]]);
        }
    }
    for (i, k) in (1..40).flat_map(|i| (1..10).map(move |k| (i, k))) {
        let [x, z] = [f64::from(i), f64::from(k)];
        all.extend([[x, 0.0, z], [x, WIDTH, z]]);
        if x < WIDTH {
            all.extend([[0.0, x, z], [LENGTH, x, z]]);
        }
    }
    for (n, k) in (0..64).flat_map(|n| (1..10).map(move |k| (n, k))) {
        let turn = std::f64::consts::TAU * (f64::from(n) + 0.5) / 64.0;
        let r = RADIUS + grown;
        all.push([CENTER[0] + r * turn.cos(), CENTER[1] + r * turn.sin(), f64::from(k)]);
    }
    all
}

fn xyz(points: &[Point]) -> String {
    points.iter().map(|[x, y, z]| format!("{x:?} {y:?} {z:?}\n")).collect()
}

/// Points moved away by a turn about each axis and a shift.
fn moved(points: &[Point]) -> Vec<Point> {
    let ([s, c], [t, d]) = ([0.3f64.sin(), 0.3f64.cos()], [0.2f64.sin(), 0.2f64.cos()]);
    let turn = |[x, y, z]: Point| {
        let [x, y] = [c * x - s * y, s * x + c * y];
        [d * x - t * z + 7.0, y - 3.0, t * x + d * z + 11.0]
    };
    points.iter().map(|p| turn(*p)).collect()
}

/// The document of a plan with these features, each judged by its form, and what else it has.
fn inspected(step: &str, points: &[Point], rest: &str) -> Result<InspectDocument, TaskError> {
    let plan =
        format!("schema = \"trueness/plan/1\"\nmeasured = \"scan.xyz\"\nreference = \"plate.step\"\n{rest}");
    let sources: MemorySources =
        [("plan.toml", plan), ("plate.step", step.to_string()), ("scan.xyz", xyz(points))]
            .into_iter()
            .collect();
    let request = InspectRequest { plan: "plan.toml".into(), ..InspectRequest::default() };
    Ok(request.run(&sources, &Silent)?.document)
}

/// A plan with a bore and a plane by these keys.
fn bore_and_plane(bore: &str, plane: &str) -> String {
    format!(
        "[[feature]]\nid = \"B\"\nshape = \"cylinder\"\nextract = {{ distance = 0.5 }}\n{bore}\n\
         [[feature]]\nid = \"A\"\nshape = \"plane\"\nextract = {{ distance = 0.5 }}\n{plane}\n\
         [[characteristic]]\nid = \"1\"\nkind = \"size\"\nsize = \"GG\"\nfeature = \"B\"\nnominal = 10\nupper = 0.1\nlower = -0.1\n\
         [[characteristic]]\nid = \"2\"\nkind = \"perpendicularity\"\nfeature = \"B\"\ndatums = [\"A\"]\ntolerance = 0.05\n\
         [[characteristic]]\nid = \"3\"\nkind = \"flatness\"\nfeature = \"A\"\ntolerance = 0.05\n"
    )
}

/// Faces by number, by name and by a seed, and the nominal written out, are one feature with the same values.
#[test]
fn features_by_face_have_the_values_of_their_nominals() {
    let (step, faces) = plate(0.0);
    let points = scan(0.02);
    let [top, first, second] = [faces[1], faces[6], faces[7]];
    let written = (
        "nominal = { point = [20, 15, 0], direction = [0, 0, 1], radius = 5, length = 10 }".to_string(),
        "nominal = { point = [0, 0, 10], normal = [0, 0, 1], boundary = [[0, 0, 10], [40, 0, 10], [40, 30, 10], [0, 30, 10]] }"
            .to_string(),
    );
    let ways = [
        written,
        (format!("face = [{first}, {second}]"), format!("face = {top}")),
        ("name = \"BORE\"".into(), "name = \"TOP\"".into()),
        ("seed = [20, 20, 5]".into(), "seed = [3, 3, 10]".into()),
    ];
    let found: Vec<InspectDocument> =
        ways.iter().map(|(b, a)| inspected(&step, &points, &bore_and_plane(b, a)).unwrap()).collect();
    for document in &found {
        let said: Vec<u64> = document.features[0].faces.iter().map(|f| f.face).collect();
        assert_eq!(said, [first, second]);
        assert_eq!(document.features[0].faces[0].name.as_deref(), Some("BORE"));
        assert_eq!(document.features[1].faces[0].face, top);
        assert_eq!(document.features[0].points, 576, "all of the bore");
        assert_eq!(document.features[1].points, found[0].features[1].points);
        let coverage = document.features[0].coverage.unwrap();
        assert!(coverage > 0.8, "{coverage}");
        for (n, c) in document.characteristics.iter().enumerate() {
            let (own, written) = (c.value.unwrap(), found[0].characteristics[n].value.unwrap());
            assert!((own - written).abs() < 1e-9, "{}: {own} {written}", c.id);
        }
        assert!((document.characteristics[0].value.unwrap() - 10.04).abs() < 1e-6);
    }
    assert_eq!(found[1].features[0].source.to_string(), "faces");
}

/// One half of a bore has its own points alone.
#[test]
fn a_face_is_not_its_whole_surface() {
    let (step, faces) = plate(0.0);
    let found =
        inspected(&step, &scan(0.02), &bore_and_plane(&format!("face = {}", faces[6]), "name = \"TOP\""));
    let document = found.unwrap();
    assert_eq!(document.features[0].points, 288);
    assert_eq!(document.features[0].faces.iter().map(|f| f.face).collect::<Vec<_>>(), [faces[6]]);
    assert!(document.features[0].coverage.unwrap() > 0.8);
    assert!((document.characteristics[0].value.unwrap() - 10.04).abs() < 1e-6);
}

/// Of a model of which a face was not read no part passes; a feature that is that face says why there is none.
#[test]
fn an_incomplete_model_passes_no_part() {
    let (step, faces) = plate(0.0);
    let plan = bore_and_plane("name = \"BORE\"", "name = \"TOP\"");
    let whole = inspected(&step, &scan(0.02), &plan).unwrap();
    assert_eq!(whole.verdict, Verdict::Pass);
    // The front is a plane of the third face.
    let front = format!("#{}=ADVANCED_FACE", faces[2]);
    let line = step.lines().find(|line| line.starts_with(&front)).unwrap();
    let surface = line.rsplit(",#").next().unwrap().split(',').next().unwrap();
    let broken = step.replace(&format!("#{surface}=PLANE("), &format!("#{surface}=FLOATING_CARPET("));
    let document = inspected(&broken, &scan(0.02), &plan).unwrap();
    assert_eq!(document.verdict, Verdict::Undecided);
    let reasons: Vec<String> = document.verdict_reasons.iter().map(|r| r.text.clone()).collect();
    assert!(reasons.iter().any(|r| r.contains("7 of 8 faces of the reference were read")), "{reasons:?}");
    assert!(document.characteristics.iter().all(|c| c.value.is_some()));
    let asked = bore_and_plane("name = \"BORE\"", &format!("face = {}", faces[2]));
    let refused = inspected(&broken, &scan(0.02), &asked).unwrap_err().to_string();
    assert!(refused.contains(&format!("face {} of the reference could not be read", faces[2])), "{refused}");
}

#[test]
fn faces_that_cannot_be_the_feature_are_refused_with_the_reason() {
    let (step, faces) = plate(0.0);
    let [top, first, second] = [faces[1], faces[6], faces[7]];
    let refused = |step: &str, bore: &str| {
        let plan = bore_and_plane(bore, "name = \"TOP\"");
        inspected(step, &scan(0.0), &plan).unwrap_err().to_string()
    };
    let number = refused(&step, "face = 3");
    assert!(
        number.contains("line 8, column 8: feature \"B\": the reference has no face 3; it has 8 faces"),
        "{number}"
    );
    let kind = refused(&step, &format!("face = {top}"));
    assert!(
        kind.contains(&format!("face {top} \"TOP\" of the reference is a plane, not a cylinder")),
        "{kind}"
    );
    let name = refused(&step, "name = \"BOR\"");
    assert!(name.contains("there is no face \"BOR\"; did you mean \"BORE\"?"), "{name}");
    let instance = refused(&step, "name = \"BORE\"\ninstance = \"left\"");
    assert!(instance.contains("there is no instance \"left\""), "{instance}");
    let shaft = refused(&step, &format!("face = {first}\ninternal = false"));
    assert!(
        shaft.contains("`internal` is false, but the material of the reference is around the face"),
        "{shaft}"
    );
    let both = refused(&step, &format!("face = {first}\nseed = [1, 2, 3]"));
    assert!(both.contains("give one of `face`, `name`, `seed`, `nominal` and `points`"), "{both}");
    let (apart, _) = plate(0.01);
    let apart = refused(&apart, &format!("face = [{first}, {second}]"));
    assert!(
        apart.contains("are not one surface: they are 0.01") && apart.contains("0.000100 mm for the same"),
        "{apart}"
    );
    let mesh = "OFF\n3 1 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n";
    let sources: MemorySources = [
        (
            "plan.toml",
            format!(
                "schema = \"trueness/plan/1\"\nmeasured = \"scan.xyz\"\nreference = \"m.off\"\n{}",
                bore_and_plane("face = 3", "nominal = { point = [0, 0, 0], normal = [0, 0, 1], boundary = [[0, 0, 0], [9, 0, 0], [0, 9, 0]] }")
            ),
        ),
        ("m.off", mesh.to_string()),
        ("scan.xyz", xyz(&scan(0.0))),
    ]
    .into_iter()
    .collect();
    let request = InspectRequest { plan: "plan.toml".into(), ..InspectRequest::default() };
    let mesh = request.run(&sources, &Silent).map(|_| ()).unwrap_err().to_string();
    assert!(mesh.contains("the reference is a mesh"), "{mesh}");
}

/// All but the points of the bore lie on the plate; those are 0.02 in the material.
#[test]
fn deviations_of_a_plan_are_those_from_the_faces() {
    let (step, faces) = plate(0.0);
    let document = inspected(&step, &scan(0.02), "[deviation]\ntolerance = 0.01\n").unwrap();
    let deviation = document.deviation.unwrap();
    assert_eq!(deviation.surfaces.unwrap().count, 8);
    let all = &deviation.deviation.all;
    assert!((all.min.unwrap() + 0.02).abs() < 1e-13 && all.max.unwrap().abs() < 1e-13, "{all:?}");
    let of = |face: u64| deviation.faces.iter().find(|f| f.face.face == face).unwrap();
    let half = of(faces[6]);
    assert_eq!((half.count, half.inside), (288, Some(0.0)));
    assert!((half.mean + 0.02).abs() < 1e-13 && (half.rms - 0.02).abs() < 1e-13);
    assert_eq!((of(faces[1]).inside, of(faces[1]).face.name.as_deref()), (Some(1.0), Some("TOP")));
    assert_eq!(deviation.faces.iter().map(|f| f.count).sum::<u64>(), all.count);
}

fn compared(points: &[Point], along: &str) -> Vec<f64> {
    let sources: MemorySources =
        [("plate.step", plate(0.0).0), ("scan.xyz", xyz(points))].into_iter().collect();
    let asked = serde_json::json!({"measured": "scan.xyz", "references": ["plate.step"], "along": along});
    let request: CompareRequest = serde_json::from_value(asked).unwrap();
    let done = request.run(&sources, &Silent).unwrap();
    let own = &done.document.comparisons[0];
    assert_eq!(own.excluded.values().sum::<u64>(), 0, "{:?}", own.excluded);
    vec![own.deviation.all.min.unwrap(), own.deviation.all.max.unwrap()]
}

/// The table of points names the face of each.
#[test]
fn a_table_names_the_face_of_each_point() {
    let (step, faces) = plate(0.0);
    let path = std::env::temp_dir().join(format!("trueness-cad-faces-{}.csv", std::process::id()));
    let points = [[3.0, 4.0, 10.5], [20.0, 19.0, 5.0], [20.0, 15.0, 500.0]];
    let sources: MemorySources = [("plate.step", step), ("scan.xyz", xyz(&points))].into_iter().collect();
    let asked = serde_json::json!({"measured": "scan.xyz", "references": ["plate.step"], "out": path, "max_distance": 9});
    let request: CompareRequest = serde_json::from_value(asked).unwrap();
    request.run(&sources, &Silent).unwrap().commit().unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let wanted =
        format!("x,y,z,deviation,face\n3,4,10.5,0.5,{}\n20,19,5,1,{}\n20,15,500,,\n", faces[1], faces[6]);
    assert_eq!(text, wanted);
}

/// A line 3 off the axis of a bore of radius 5 meets it 4 from the middle.
#[test]
fn lines_meet_the_faces_themselves() {
    let [low, high] = compared(&[[21.0, 18.0, 5.0], [21.5, 18.0, 5.0]], "1,0,0")[..] else { unreachable!() };
    assert!((low - 2.5).abs() < 1e-12 && (high - 3.0).abs() < 1e-12, "{low} {high}");
    let angle = 0.123f64;
    let at = |r: f64| [20.0 + r * angle.cos(), 15.0 + r * angle.sin(), 5.0];
    let [low, high] = compared(&[at(4.25), at(5.5)], "reference")[..] else { unreachable!() };
    assert!((low + 0.5).abs() < 1e-12 && (high - 0.75).abs() < 1e-12, "{low} {high}");
}

/// Points of the plate itself come to lie on its faces; facets are some micrometers off a bore.
#[test]
fn a_best_fit_ends_on_the_faces() {
    let sources: MemorySources =
        [("plate.step", plate(0.0).0), ("scan.xyz", xyz(&moved(&scan(0.0))))].into_iter().collect();
    let request = AlignRequest {
        measured: "scan.xyz".into(),
        reference: "plate.step".into(),
        ..AlignRequest::default()
    };
    let found = request.run(&sources, &Silent).unwrap().document;
    assert!(found.rms.is_finite() && found.rms < 1e-9, "{}", found.rms);
}

/// The front door opens a model as a task does: exact faces, no facets of them.
#[test]
fn a_reference_is_a_model_with_exact_faces() {
    let folder = std::env::temp_dir().join(format!("trueness-cad-reference-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("plate.stp");
    let (text, _) = plate(0.0);
    std::fs::write(&file, &text).unwrap();
    let reference = trueness::Reference::read(&file).unwrap();
    assert_eq!(reference.faces().unwrap().faces.len(), 8);
    let scan = scan(0.125);
    let found = reference.deviations(&scan).unwrap();
    for (p, d) in scan.iter().zip(found.iter()) {
        let from_axis = (p[0] - CENTER[0]).hypot(p[1] - CENTER[1]);
        let expected = if from_axis < RADIUS + 0.5 { -0.125 } else { 0.0 };
        assert!((d.unwrap() - expected).abs() < 1e-12, "{p:?}: {d:?}");
    }
    let nearest = reference.nearest(&[CENTER[0] + 3.0, CENTER[1], 5.0]).unwrap();
    assert!((nearest.distance - (RADIUS - 3.0)).abs() < 1e-12);
    assert!((nearest.point[0] - CENTER[0] - RADIUS).abs() < 1e-12);
    // A face of a surface that is not known: nothing is measured as if it were not there.
    let holed = text.replacen("CYLINDRICAL_SURFACE", "OFFSET_UNKNOWN_SURFACE", 1);
    std::fs::write(&file, holed).unwrap();
    let said = trueness::Reference::read(&file).unwrap_err();
    assert!(matches!(said, trueness::Error::Incomplete { .. }), "{said}");
    assert!(said.to_string().contains("7 of 8 faces"), "{said}");
    let said = trueness::read(&file).unwrap_err().to_string();
    assert!(said.contains("Reference::read"), "{said}");
    std::fs::remove_dir_all(&folder).unwrap();
}
