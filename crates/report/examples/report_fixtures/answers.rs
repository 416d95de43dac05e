//! Reports of the other documents: a mesh with planted defects, an element through points with a known form.

use super::plan::Written;
use super::{uv_sphere, written};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;
use trueness_document::check::CheckDocument;
use trueness_document::fit::FitDocument;
use trueness_document::repair::OutputRecord;
use trueness_document::segment::{PieceKind, SegmentDocument};
use trueness_document::{InputRecord, Role};
use trueness_geom::check::check;
use trueness_geom::fit::{self, Method};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Silent;
use trueness_geom::scan::Scan;
use trueness_geom::segment;
use trueness_geom::shape::Kind;
use trueness_geom::space::Point;
use trueness_measure::repair::Around;
use trueness_report::{ReportInput, ReportOptions};
use trueness_solid::repair;
use trueness_surface as surface;
use trueness_surface::curvature;

/// All of them, into `folder`.
pub fn write_all(folder: &Path) {
    let options = ReportOptions { serial: Some("4711".into()), ..ReportOptions::default() };
    for (name, mesh) in [
        ("defects", defects()),
        ("sound", uv_sphere(30)),
        ("torn", torn()),
        ("block", super::clouds::cube(20.0)),
        ("pushed", pushed()),
        ("pleats", pleats()),
    ] {
        written(folder, name, check_page(&mesh, &options));
    }
    written(folder, "model", super::model::page(&options));
    written(folder, "mended", repair_page(&defects(), &options));
    for (name, method) in [("fit", Method::Gaussian), ("zone", Method::MinimumZone)] {
        written(folder, name, fit_page(&lobed_cylinder(), method, &options).0);
    }
    // Fewer points than there are steps of the distribution.
    let few: Vec<Point> = lobed_cylinder().into_iter().step_by(49).take(100).collect();
    written(folder, "few_fit", fit_page(&few, Method::Gaussian, &options).0);
    written(folder, "elements", segment_page(&peg(), &options).0);
    for (name, rows) in
        [("plan", Written::AsFound), ("plan_material", Written::Material), ("plan_kinds", Written::Kinds)]
    {
        written(folder, name, super::plan::page(rows, &options));
    }
    written(folder, "curvature", curvature_page(&torus(), &options));
    let points = Mesh { faces: vec![], ..torus() };
    written(folder, "curvature_cloud", curvature_page(&points, &options));
    written(folder, "surface", surface_page(&options));
    // Half of it: it has a boundary.
    let mut half = torus();
    let places = half.positions.clone();
    half.faces.retain(|f| f.iter().all(|v| places[*v as usize][1] < 0.01));
    written(folder, "curvature_half", curvature_page(&half, &options));
}

/// A sphere of radius 10 with a hole in front, a doubled facet, a fin, and a crumb that floats before it.
pub fn defects() -> Mesh {
    let mut mesh = uv_sphere(30);
    let middle = |mesh: &Mesh, f: &[u32; 3]| -> Point {
        std::array::from_fn(|k| f.iter().map(|v| mesh.positions[*v as usize][k]).sum::<f64>() / 3.0)
    };
    let front: Vec<bool> =
        mesh.faces.iter().map(|f| middle(&mesh, f)).map(|p| p[1] < -9.5 && p[2] > 0.5).collect();
    let mut keep = front.iter();
    mesh.faces.retain(|_| !keep.next().unwrap());
    mesh.faces.push(mesh.faces[200]);
    let [a, b, _] = mesh.faces[600];
    let tip = mesh.positions.len() as u32;
    mesh.positions.push(mesh.positions[a as usize].map(|x| 1.2 * x));
    mesh.faces.push([a, b, tip]);
    let first = mesh.positions.len() as u32;
    let corners = [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]];
    mesh.positions.extend(corners.map(|[x, y, z]| [x - 6.0, y - 13.0, z - 6.0]));
    mesh.faces.extend([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]].map(|f: [u32; 3]| f.map(|v| first + v)));
    mesh
}

/// A sphere with small holes all over, and one large one where the usual view does not look: at the back, below.
fn torn() -> Mesh {
    let mut mesh = uv_sphere(40);
    let mut n = 0;
    let places = mesh.positions.clone();
    mesh.faces.retain(|f| {
        n += 1;
        let [x, y, z] = places[f[0] as usize];
        n % 29 != 0 && y - x - z <= 16.0
    });
    mesh
}

/// A cube of 20 mm whose top is drawn down to a tip below its bottom: that they cross is seen from below.
fn pushed() -> Mesh {
    let mut mesh = super::clouds::cube(20.0);
    let tip = mesh.positions.len() as u32;
    mesh.positions.push([10.0, 10.0, -4.0]);
    // The top's two facets.
    mesh.faces.drain(2..4);
    mesh.faces.extend([[4, 5, tip], [5, 7, tip], [7, 6, tip], [6, 4, tip]]);
    mesh
}

/// A box of 200 mm, and above it a tube of a thousand narrow folds.
fn pleats() -> Mesh {
    const FOLDS: u32 = 2000;
    let mut mesh = super::clouds::cube(200.0);
    let first = mesh.positions.len() as u32;
    for i in 0..FOLDS {
        let (s, c) = (f64::from(i) * std::f64::consts::TAU / f64::from(FOLDS)).sin_cos();
        let r = if i % 2 == 0 { 25.0 } else { 24.8 };
        mesh.positions.extend([[100.0 + r * c, 100.0 + r * s, 210.0], [100.0 + r * c, 100.0 + r * s, 280.0]]);
        let [a, b] = [first + 2 * i, first + 2 * ((i + 1) % FOLDS)];
        mesh.faces.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
    }
    mesh
}

/// The report of a check.
pub fn check_page(mesh: &Mesh, options: &ReportOptions) -> Vec<u8> {
    let document = check_document(mesh);
    let view = trueness_report::views::check::View::new(&document, "part.stl", mesh, Default::default());
    let (objects, marks) = (view.objects(), &view.marks[..]);
    super::bytes(&ReportInput { result: &document, objects: &objects, marks, options })
}

/// What the check says.
pub fn check_document(mesh: &Mesh) -> CheckDocument {
    let options = Default::default();
    let report = check(mesh, None, &options, &Silent).unwrap();
    trueness_measure::check::document(
        &report,
        file(Role::Reference, "part.stl", mesh),
        mesh.faces.len() as u64,
        Default::default(),
        &options,
    )
}

/// The report of a repair with all steps.
pub fn repair_page(mesh: &Mesh, options: &ReportOptions) -> Vec<u8> {
    let wish = repair::Options { islands: Some(0.01), ..repair::Options::default() };
    let repaired = repair::repair(mesh, &wish, &Silent).unwrap();
    let around = Around {
        file: file(Role::Reference, "part.stl", mesh),
        left_out: 0,
        output: OutputRecord {
            path: "mended.ply".into(),
            rounded_vertices: 0,
            rounding: 0.0,
            sound: Some(true),
            sound_reason: None,
            defects: BTreeMap::new(),
            at_least: vec![],
        },
        deviation: repaired.deviation(mesh, &Silent),
        limit: 1000,
        max_change: 1e-4,
    };
    let document = trueness_measure::repair::document(&repaired, &wish, around);
    let view = trueness_report::views::repair::View::new(&document, "part.stl", mesh, &repaired.mesh);
    let (objects, marks) = (view.objects(), &view.marks[..]);
    super::bytes(&ReportInput { result: &document, objects: &objects, marks, options })
}

/// Radius 10, axis z, 30 long, three lobes of ±0.1: the highest at the front.
pub fn lobed_cylinder() -> Vec<Point> {
    let at = |i: u32, z: f64| {
        let angle = TAU * f64::from(i) / 120.0;
        let r = 10.0 + 0.1 * (3.0 * (angle + TAU / 4.0)).cos();
        [r * angle.cos(), r * angle.sin(), z]
    };
    (0..=40).flat_map(|j| (0..120).map(move |i| at(i, 0.75 * f64::from(j) - 15.0))).collect()
}

/// The report of a cylinder through points, and its document.
pub fn fit_page(points: &[Point], method: Method, options: &ReportOptions) -> (Vec<u8>, FitDocument) {
    let wish = fit::Options { method, ..fit::Options::default() };
    let fit = fit::fit(points, Kind::Cylinder, &wish, &Silent).unwrap();
    let cloud = Mesh { positions: points.to_vec(), faces: vec![] };
    let files = vec![file(Role::Measured, "bore.xyz", &cloud)];
    let noise = trueness_measure::fit::noise(&fit, &cloud.into(), 1, &Silent).unwrap();
    let document = trueness_measure::fit::document(&fit, &noise, points, files, 1);
    let view = trueness_report::views::fit::View::new(&document, "bore.xyz", &fit.shape, points);
    let (objects, marks) = (view.objects(), &view.marks[..]);
    let page = super::bytes(&ReportInput { result: &document, objects: &objects, marks, options });
    (page, document)
}

/// A peg on the plane z = 0: a shaft of radius 10, a cone above it, a cap of radius 8 on that.
pub fn peg() -> Mesh {
    const AROUND: u32 = 72;
    let foot = (1..10).map(|k| [f64::from(k), 0.0]);
    let shaft = (0..16).map(|k| [10.0, f64::from(k)]);
    let cone = (0..8).map(|k| [10.0 - 0.5 * f64::from(k), 16.0 + f64::from(k)]);
    // The cap begins where the cone ends, at radius 6; its middle lies lower.
    let cap = (0..10).map(|k| {
        let angle = 0.75f64.acos() + 0.08 * f64::from(k);
        [8.0 * angle.cos(), 24.0 + 8.0 * (angle.sin() - 0.75f64.acos().sin())]
    });
    let section: Vec<[f64; 2]> = foot.chain(shaft).chain(cone).chain(cap).collect();
    let mut mesh = Mesh::default();
    for [rho, z] in &section {
        mesh.positions.extend((0..AROUND).map(|k| {
            let angle = TAU * f64::from(k) / f64::from(AROUND);
            [rho * angle.cos(), rho * angle.sin(), *z]
        }));
    }
    for row in 0..section.len() as u32 - 1 {
        for k in 0..AROUND {
            let next = (k + 1) % AROUND;
            let [a, b] = [row * AROUND + k, row * AROUND + next];
            let [c, d] = [b + AROUND, a + AROUND];
            mesh.faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// The report of the elements of a mesh, and its document.
pub fn segment_page(mesh: &Mesh, options: &ReportOptions) -> (Vec<u8>, SegmentDocument) {
    let wish = segment::Options::default();
    let found = segment::mesh(mesh, &wish, &Silent).unwrap();
    let files = vec![file(Role::Measured, "peg.stl", mesh)];
    let scan = Scan::Mesh(mesh.clone());
    let noise = trueness_measure::noise_or_reason(found.shared_noise(&scan, 0, &Silent)).unwrap();
    let document = trueness_measure::segment::document(&found, &noise, PieceKind::Facets, files, &wish, None);
    let view = trueness_report::views::segment::View::new(&document, &scan, &found.labels);
    let (objects, marks) = (view.objects(), &view.marks[..]);
    let result = &document;
    (super::bytes(&ReportInput { result, objects: &objects, marks, options }), document)
}

/// Radii 10 and 4, the axis is z; the curvatures differ all over.
pub fn torus() -> Mesh {
    let (n, m) = (180, 90);
    let mut mesh = Mesh::default();
    for (i, j) in (0..m).flat_map(|j| (0..n).map(move |i| (i, j))) {
        let (u, v) = (TAU * f64::from(i) / f64::from(n), TAU * f64::from(j) / f64::from(m));
        let rho = 10.0 + 4.0 * v.cos();
        mesh.positions.push([rho * u.cos(), rho * u.sin(), 4.0 * v.sin()]);
        let at = |i: u32, j: u32| (j % m) * n + i % n;
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        mesh.faces.extend([[a, b, c], [a, c, d]]);
    }
    mesh
}

/// The report of curvatures, of a mesh or, without facets, of a cloud.
pub fn curvature_page(mesh: &Mesh, options: &ReportOptions) -> Vec<u8> {
    let scan = Scan::from(mesh.clone());
    let noise = trueness_measure::curvature::noise(&scan, 1, &Silent).unwrap();
    let wish = curvature::Options {
        degree: 4,
        noise: noise.as_ref().ok().copied(),
        ..curvature::Options::default()
    };
    let (found, name) = match &scan {
        Scan::Mesh(mesh) => (curvature::mesh(mesh, &wish, &Silent), "torus.stl"),
        Scan::Cloud(points) => (curvature::cloud(points, &wish, &Silent), "torus.xyz"),
    };
    let found = found.unwrap();
    let inputs = vec![file(Role::Measured, name, mesh)];
    let document = trueness_measure::curvature::document(&found, &scan, &wish, &noise, inputs).unwrap();
    let view = trueness_report::views::curvature::View::new(&document, name, &scan, &found);
    let result = &document;
    super::bytes(&ReportInput { result, objects: &view.objects(), marks: &[], options })
}

/// z = x² / 80 − y² / 120 over 60 by 40 mm, each point 0.02 mm above or below it by turns.
pub fn surface_page(options: &ReportOptions) -> Vec<u8> {
    let place = |k: u32| -> Point {
        let (i, j) = (k % 121, k / 121);
        let (x, y) = (0.5 * f64::from(i) - 30.0, 0.5 * f64::from(j) - 20.0);
        [x, y, x * x / 80.0 - y * y / 120.0 + if (i + j) % 2 == 0 { 0.02 } else { -0.02 }]
    };
    let points: Vec<Point> = (0..121 * 81).map(place).collect();
    let wish = surface::Options {
        layout: surface::Layout::Spans([4, 3]),
        base: surface::BaseKind::Xy,
        fairness: surface::Fairness::Weight(0.0),
        ..surface::Options::default()
    };
    let found = surface::fit(&points, &wish, &Silent).unwrap();
    let inputs = vec![super::record(Role::Measured, "sheet.xyz", points.len(), None)];
    let document = trueness_measure::surface::document(&found, &points, &wish, None, inputs);
    let view = trueness_report::views::surface::View::new(&document, &found, None, "sheet.xyz", &points);
    let (objects, marks) = (view.objects(), &view.marks[..]);
    super::bytes(&ReportInput { result: &document, objects: &objects, marks, options })
}

/// A file of a mesh.
pub fn file(role: Role, path: &str, mesh: &Mesh) -> InputRecord {
    let facets = (!mesh.faces.is_empty()).then_some(mesh.faces.len() as u64);
    super::record(role, path, mesh.positions.len(), facets)
}
