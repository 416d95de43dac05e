//! The report of an inspection: a block whose faces are off by known amounts.

use trueness_document::inspect::{CharacteristicRecord, InspectDocument, PlanRecord, ZoneForm};
use trueness_document::{Role, Verdict, Word};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Silent;
use trueness_geom::scan::Scan;
use trueness_measure::inspection::{self, Data};
use trueness_measure::plan::Plan;
use trueness_report::views::inspect::View;
use trueness_report::{ReportInput, ReportOptions};

const PLAN: &str = r#"
schema = "trueness/plan/1"
title = "Block"
measured = "scan.stl"
reference = "nominal.stl"
[deviation]
tolerance = [-0.05, 0.05]
[[feature]]
id = "A"
shape = "plane"
nominal = { point = [0, 0, 0], normal = [0, 0, -1], boundary = [[0, 0, 0], [40, 0, 0], [40, 25, 0], [0, 25, 0]] }
extract = { distance = 0.5 }
[[feature]]
id = "top"
shape = "plane"
nominal = { point = [0, 0, 10], normal = [0, 0, 1], boundary = [[0, 0, 10], [40, 0, 10], [40, 25, 10], [0, 25, 10]] }
extract = { distance = 0.5 }
[[feature]]
id = "front"
shape = "plane"
nominal = { point = [0, 0, 0], normal = [0, -1, 0], boundary = [[0, 0, 0], [40, 0, 0], [40, 0, 10], [0, 0, 10]] }
extract = { distance = 0.5 }
[[characteristic]]
id = "1"
kind = "flatness"
feature = "top"
tolerance = 0.05
[[characteristic]]
id = "2"
kind = "distance"
feature = "top"
datums = ["A"]
nominal = 10
upper = 0.05
lower = -0.05
[[characteristic]]
id = "3"
kind = "perpendicularity"
feature = "front"
datums = ["A"]
tolerance = 0.05
"#;

/// Sides of 40, 25 and 10 mm from the origin, cut into squares; its top is raised, its faces share no vertices.
fn block(raised: f64) -> Mesh {
    const STEPS: [u32; 3] = [16, 10, 4];
    let size = [40.0, 25.0, 10.0];
    let mut mesh = Mesh::default();
    for (axis, top) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let first = mesh.positions.len() as u32;
        for (i, j) in (0..=STEPS[u]).flat_map(|i| (0..=STEPS[v]).map(move |j| (i, j))) {
            let mut p = [0.0; 3];
            p[axis] = if top { size[axis] } else { 0.0 };
            p[u] = size[u] * f64::from(i) / f64::from(STEPS[u]);
            p[v] = size[v] * f64::from(j) / f64::from(STEPS[v]);
            if (axis, top) == (2, true) {
                p[2] += raised;
            }
            mesh.positions.push(p);
        }
        let at = |i: u32, j: u32| first + i * (STEPS[v] + 1) + j;
        for (i, j) in (0..STEPS[u]).flat_map(|i| (0..STEPS[v]).map(move |j| (i, j))) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let quads = [[a, b, c], [a, c, d]];
            mesh.faces.extend(quads.map(|[a, b, c]| if top { [a, b, c] } else { [a, c, b] }));
        }
    }
    mesh
}

/// What of the results is written otherwise than it was found.
#[derive(Clone, Copy, PartialEq)]
pub enum Written {
    /// Nothing.
    AsFound,
    /// The perpendicularity has material requirements and a bonus of 0.02 mm.
    Material,
    /// More kinds, with all that may stand in a row: uncertainties, degrees, letters, three datums, no value.
    Kinds,
}

/// Rows with all that may stand in one.
fn kinds(document: &mut InspectDocument) {
    let all = &mut document.characteristics;
    let [flatness, distance, attitude] = [0, 1, 2].map(|n| all[n].clone());
    all[0] = CharacteristicRecord {
        value: None,
        uncertainty: Some(0.002),
        reason: Some("too few points".into()),
        verdict: Verdict::NotMeasured,
        ..flatness.clone()
    };
    all[2] = CharacteristicRecord {
        uncertainty: Some(0.002),
        datums: ["A", "top", "front"].map(String::from).to_vec(),
        verdict: Verdict::Undecided,
        ..attitude
    };
    all.push(CharacteristicRecord {
        id: "4".into(),
        kind: "angle".into(),
        unit: "deg".into(),
        nominal: Some(90.0),
        lower: Some(89.5),
        upper: 90.5,
        value: Some(89.75),
        uncertainty: Some(0.125),
        verdict: Verdict::Pass,
        ..distance.clone()
    });
    all.push(CharacteristicRecord {
        id: "5".into(),
        kind: "size".into(),
        modifiers: vec!["GX".into()],
        datums: vec![],
        ..distance
    });
    all.push(CharacteristicRecord {
        id: "6".into(),
        kind: "texture".into(),
        symbol: String::new(),
        zone: Word(ZoneForm::Value),
        modifiers: vec!["Sq".into()],
        ..flatness
    });
}

/// Its top 0.08 mm too high: flat, but too far from the bottom, and out of the tolerance of the deviations.
pub fn page(written: Written, options: &ReportOptions) -> Vec<u8> {
    let plan = Plan::parse(PLAN).unwrap();
    let (scan, nominal) = (block(0.08), block(0.0));
    let files = [(Role::Measured, "scan.stl", &scan), (Role::Reference, "nominal.stl", &nominal)];
    let inputs = files.map(|(role, path, mesh)| super::answers::file(role, path, mesh)).to_vec();
    let data =
        Data { measured: Some(scan.into()), reference: Some(nominal), shown: 100_000, ..Data::default() };
    let found = inspection::run(&plan, data, &Silent).unwrap();
    let record = PlanRecord { path: "block.toml".into(), sha256: None };
    let mut document = inspection::document(&plan, record, &found, inputs);
    if written == Written::Kinds {
        kinds(&mut document);
    }
    if written == Written::Material {
        let c = document.characteristics.last_mut().unwrap();
        (c.zone, c.upper) = (Word(ZoneForm::Diameter), 0.07);
        (c.modifiers, c.datums) = (vec!["Ⓜ".into()], vec!["A(L)".into()]);
    }
    let deviations = found.deviations.as_ref().unwrap();
    let references = deviations.references("nominal.stl");
    let map = trueness_report::views::compare::View::new(
        "scan.stl",
        found.measured.as_ref().and_then(Scan::mesh),
        &references,
        &deviations.found,
    );
    let view = View::new(&document, &found, Some(&map));
    let (objects, marks) = (view.objects(), &view.marks[..]);
    super::bytes(&ReportInput { result: &document, objects: &objects, marks, options })
}
