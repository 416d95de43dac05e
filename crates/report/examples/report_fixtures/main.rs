//! Writes the reports that the browser tests open: bodies whose deviations are known in closed form.
//!
//! ```text
//! cargo run --example report_fixtures -- FOLDER
//! ```

#![allow(
    clippy::disallowed_methods,
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a tool of the tests"
)]

mod answers;
mod clouds;
mod model;
mod numbers;
mod plan;
mod sections;
mod trends;

pub use answers::{
    check_document, check_page, curvature_page, defects, fit_page, lobed_cylinder, repair_page, surface_page,
    torus,
};
pub use clouds::page as cloud_page;
use numbers::{histogram, quantile, sorted, statistics};

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::path::Path;
use trueness_document::compare::Method;
use trueness_document::compare::*;
use trueness_document::scale::Scale;
use trueness_document::{InputRecord, Role, UNITS, VERSION, Verdict, Word};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Progress, Silent};
use trueness_geom::space::Point;
use trueness_report as report;
use trueness_report::{
    Geometry, NoValue, ReportError, ReportInput, ReportOptions, ReportSummary, ViewField, ViewObject,
    ViewRole,
};

fn main() {
    let folder = std::env::args().nth(1).expect("a folder to write to");
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder).unwrap();
    let tolerance = Some([-0.05, 0.05]);
    write(folder, "sphere", &sphere(200), tolerance, "sphere.stl", "nominal.stl");
    write(folder, "cube", &cube(), Some([-0.1, 0.1]), "cube.stl", "nominal.stl");
    write(folder, "free", &sphere(60), None, "sphere.stl", "nominal.stl");
    write(folder, "missing", &half_missing(), tolerance, "sphere.stl", "nominal.stl");
    let hostile = format!("<img src=x onerror=alert(1)>\u{202e}lts.{}</script>", "long".repeat(75));
    write(folder, "hostile", &sphere(40), tolerance, &hostile, "\u{2067}שלום\" onload=\"x.stl");
    write(folder, "cloud", &cloud(), Some([-0.1, 0.1]), "points.xyz", "nominal.stl");
    write(folder, "two", &two(), tolerance, "points.xyz", "fine.stl");
    write(folder, "box", &plain_box(), Some([-0.1, 0.1]), "box.stl", "nominal.stl");
    write(folder, "behind", &behind(), Some([-0.1, 0.1]), "part.stl", "nominal.stl");
    write(folder, "four", &four(), tolerance, "points.xyz", "fine.stl");
    answers::write_all(folder);
    clouds::write_all(folder);
    sections::write_all(folder);
    trends::write_all(folder);
    write(folder, "million", &sphere(1000), tolerance, "sphere.stl", "nominal.stl");
}

/// A body with one value a vertex for each reference.
pub struct Body {
    measured: Mesh,
    fields: Vec<Vec<f64>>,
    references: Vec<Mesh>,
    /// Whether the measured object is a cloud and the maps are on the references.
    cloud: bool,
    /// A measured place far off the part, the place nearest to it, and the deviation there.
    off: Option<(Point, Point, f64)>,
}

/// Radius 10, 2n² triangles; the deviation is 0.1·z/r.
pub fn sphere(n: u32) -> Body {
    let measured = uv_sphere(n);
    let values = measured.positions.iter().map(|p| 0.01 * p[2]).collect();
    Body { references: vec![measured.clone()], measured, fields: vec![values], cloud: false, off: None }
}

/// A sphere of radius 10, twice `n` squared triangles.
pub fn uv_sphere(n: u32) -> Mesh {
    let (rings, around) = (n, n);
    let mut mesh = Mesh::default();
    for i in 0..=rings {
        let theta = PI * f64::from(i) / f64::from(rings);
        let count = if i == 0 || i == rings { 1 } else { around };
        for j in 0..count {
            let phi = 2.0 * PI * f64::from(j) / f64::from(around);
            mesh.positions.push([
                10.0 * theta.sin() * phi.cos(),
                10.0 * theta.sin() * phi.sin(),
                10.0 * theta.cos(),
            ]);
        }
    }
    let at = |i: u32, j: u32| match i {
        0 => 0,
        i if i == rings => 1 + (rings - 1) * around,
        i => 1 + (i - 1) * around + j % around,
    };
    for i in 0..rings {
        for j in 0..around {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.faces
                .extend([[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
        }
    }
    mesh
}

/// 20 mm; +x face +0.2, −y face −0.15, +z face the tolerance's 0.1, −z face two storing steps more, the others 0.
/// Faces share no vertex, so each has its one value.
fn cube() -> Body {
    let mut measured = Mesh::default();
    let mut values = vec![];
    for (axis, side) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
        let value =
            [[0.2, 0.0], [0.0, -0.15], [0.1, 0.1 + 2.0 * 0.2 / 32_760.0]][axis][usize::from(side < 0.0)];
        // The hair's breadth keeps equal places of neighboring faces apart.
        let half = 10.0 - 1e-9;
        let first = measured.positions.len() as u32;
        for (u, v) in [(-half, -half), (half, -half), (half, half), (-half, half)] {
            let mut p = [0.0; 3];
            p[axis] = 10.0 * side;
            p[(axis + 1) % 3] = u;
            p[(axis + 2) % 3] = v;
            measured.positions.push(p);
            values.push(value);
        }
        let quad = if side > 0.0 { [[0, 1, 2], [0, 2, 3]] } else { [[0, 2, 1], [0, 3, 2]] };
        measured.faces.extend(quad.map(|t| t.map(|k| first + k)));
    }
    Body { references: vec![measured.clone()], measured, fields: vec![values], cloud: false, off: None }
}

/// The sphere without values where y is above 0.
fn half_missing() -> Body {
    let mut body = sphere(100);
    for (value, p) in body.fields[0].iter_mut().zip(&body.measured.positions) {
        if p[1] > 0.0 {
            *value = f64::NAN;
        }
    }
    body
}

/// Points on the sphere, measured against it; the map is on the reference.
fn cloud() -> Body {
    let body = sphere(150);
    Body { references: vec![body.measured.clone()], cloud: true, ..body }
}

/// The same points against a fine and a coarse sphere.
fn two() -> Body {
    let points = uv_sphere(150);
    let fields = vec![
        points.positions.iter().map(|p| 0.01 * p[2]).collect(),
        points.positions.iter().map(|p| 0.02 * p[0] + 0.02).collect(),
    ];
    Body {
        fields,
        references: vec![uv_sphere(150), uv_sphere(150)],
        measured: points,
        cloud: true,
        off: None,
    }
}

/// A cube of 20 mm and 12 facets, whose corners coincide, against the same of 5 × 5 squares a face. Nothing deviates.
fn plain_box() -> Body {
    let [measured, reference] = [1, 5].map(|n| {
        let mut mesh = Mesh::default();
        for (axis, side) in (0..3).flat_map(|axis| [(axis, 10.0), (axis, -10.0)]) {
            let first = mesh.positions.len() as u32;
            for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
                let mut p = [side; 3];
                p[(axis + 1) % 3] = 20.0 * f64::from(i) / f64::from(n) - 10.0;
                p[(axis + 2) % 3] = 20.0 * f64::from(j) / f64::from(n) - 10.0;
                mesh.positions.push(p);
            }
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let a = first + i * (n + 1) + j;
                let [b, c, d] = [a + n + 1, a + n + 2, a + 1];
                let quad = if side > 0.0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
                mesh.faces.extend(quad);
            }
        }
        mesh
    });
    let values = vec![0.0; measured.positions.len()];
    Body { fields: vec![values], references: vec![reference], measured, cloud: false, off: None }
}

/// A sphere whose worst place looks to the back, the left and the foot, another one to the other side; and a measured place
/// 30 mm above it, where the reference has no surface.
fn behind() -> Body {
    let measured = uv_sphere(120);
    let bumps = [([-0.5, 0.6, -0.62], 0.4), ([0.5, -0.6, 0.62], -0.3)];
    let bump = |p: &Point| {
        let at = |(n, height): &([f64; 3], f64)| {
            let cosine = (0..3).map(|k| n[k] * p[k]).sum::<f64>() / 10.0;
            height * (-((1.0 - cosine) / 0.02)).exp()
        };
        bumps.iter().map(at).sum()
    };
    let values = measured.positions.iter().map(bump).collect();
    let off = Some(([0.0, 0.0, 40.0], [0.0, 0.0, 10.0], 30.0));
    Body { fields: vec![values], references: vec![measured.clone()], measured, cloud: false, off }
}

/// The same points against four spheres.
fn four() -> Body {
    let points = uv_sphere(40);
    let field = |n: u32| points.positions.iter().map(|p| 0.01 * f64::from(n) * p[2]).collect();
    Body {
        fields: (1..=4).map(field).collect(),
        references: vec![uv_sphere(40); 4],
        measured: points,
        cloud: true,
        off: None,
    }
}

fn write(
    folder: &Path,
    name: &str,
    body: &Body,
    tolerance: Option<[f64; 2]>,
    measured: &str,
    reference: &str,
) {
    let options = ReportOptions {
        title: Some(format!("Inspection of {measured}")).filter(|_| name == "behind"),
        serial: Some(format!("{name} 4711")),
        ..ReportOptions::default()
    };
    written(folder, name, page(body, tolerance, [measured, reference], &options).0);
}

fn written(folder: &Path, name: &str, page: Vec<u8>) {
    let path = folder.join(format!("{name}.html"));
    println!("{}: {} bytes", path.display(), page.len());
    std::fs::write(&path, page).unwrap();
}

fn bytes(input: &ReportInput) -> Vec<u8> {
    let mut page = vec![];
    report::write(input, &Silent, &mut page).unwrap();
    page
}

/// The report of a body, with names of the measured and the reference file.
pub fn page(
    body: &Body,
    tolerance: Option<[f64; 2]>,
    names: [&str; 2],
    options: &ReportOptions,
) -> (Vec<u8>, ReportSummary) {
    heard(body, tolerance, names, options, &Silent).unwrap()
}

/// The same, with somebody who hears how far it is and may stop it.
pub fn heard(
    body: &Body,
    tolerance: Option<[f64; 2]>,
    [measured, reference]: [&str; 2],
    options: &ReportOptions,
    progress: &dyn Progress,
) -> Result<(Vec<u8>, ReportSummary), ReportError> {
    let result = document(body, tolerance, measured, reference);
    let reasons = vec![NoValue::MaxDistance; body.measured.positions.len()];
    let view =
        |comparison: usize| ViewField { comparison, values: &body.fields[comparison], reasons: &reasons };
    let geometry =
        if body.cloud { Geometry::Points(&body.measured.positions) } else { Geometry::Mesh(&body.measured) };
    let mut objects = vec![ViewObject {
        name: measured,
        geometry,
        fields: (0..body.fields.len()).map(view).collect(),
        ..ViewObject::measured(&[])
    }];
    for (n, mesh) in body.references.iter().enumerate() {
        objects.push(ViewObject {
            role: ViewRole::Reference,
            name: reference,
            color: None,
            comparison: Some(n),
            geometry: Geometry::Mesh(mesh),
            fields: if body.cloud { vec![view(n)] } else { vec![] },
            keep: &[],
            gathered: None,
            faces: None,
        });
    }
    let mut page = vec![];
    let result = &result;
    let input = ReportInput { result, objects: &objects, marks: &[], options };
    let summary = report::write(&input, progress, &mut page)?;
    Ok((page, summary))
}

fn document(body: &Body, tolerance: Option<[f64; 2]>, measured: &str, reference: &str) -> CompareDocument {
    let comparisons: Vec<Comparison> =
        body.fields.iter().enumerate().map(|(n, f)| comparison(body, n, f, tolerance, reference)).collect();
    let sizes: Vec<f64> = sorted(body.fields[0].iter().map(|v| v.abs()).filter(|v| v.is_finite()));
    let points = body.measured.positions.len();
    let mut inputs = vec![record(Role::Measured, measured, points, None)];
    inputs.extend(
        body.references
            .iter()
            .map(|r| record(Role::Reference, reference, points, Some(r.faces.len() as u64))),
    );
    CompareDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs,
        measured: Measured {
            kind: Word(MeasuredKind::Vertices),
            count: body.measured.positions.len() as u64,
            bounds: None,
        },
        alignment: None,
        method: Word(Method::Exact),
        sign: sign(),
        max_distance: None,
        skip_boundary: false,
        facing: None,
        verdict: comparisons[0].verdict,
        verdict_reasons: comparisons[0].verdict_reasons.clone(),
        comparisons,
        paired: vec![],
        scale: Scale::for_deviations(quantile(&sizes, 0.95), tolerance),
        sampling: None,
        seed: 1,
    }
}

/// A file as a document names it.
fn record(role: Role, path: &str, points: usize, facets: Option<u64>) -> InputRecord {
    InputRecord {
        role,
        path: path.into(),
        format: "STL, binary".into(),
        bytes: 84,
        sha256: Some("3f".repeat(32)),
        sha256_reason: None,
        unit_assumed: "mm".into(),
        unit_from: "assumed".into(),
        table: None,
        points: points as u64,
        facets,
        incomplete: None,
        cad: None,
        trimmed_faces: None,
        bounds: None,
        warnings: vec![],
    }
}

fn sign() -> SignRecord {
    SignRecord {
        requested: "auto".into(),
        method: Word(SignBy::Pseudonormal),
        reason: "the reference is closed and consistently oriented".into(),
        disagreement: Some(0.0),
        disagreement_reason: None,
        sample: 1000,
    }
}

fn comparison(
    body: &Body,
    n: usize,
    field: &[f64],
    tolerance: Option<[f64; 2]>,
    reference: &str,
) -> Comparison {
    let values = sorted(field.iter().copied().filter(|v| v.is_finite()));
    let shares = tolerance.map(|[lower, upper]| {
        let share = |keep: &dyn Fn(f64) -> bool| {
            values.iter().filter(|v| keep(**v)).count() as f64 / values.len() as f64
        };
        ToleranceShares {
            lower,
            upper,
            inside: Some(share(&|v| lower <= v && v <= upper)),
            inside_reason: None,
            above: Some(share(&|v| v > upper)),
            above_reason: None,
            below: Some(share(&|v| v < lower)),
            below_reason: None,
            required: 1.0,
        }
    });
    let missing = (field.len() - values.len()) as u64;
    let side = |keep: &dyn Fn(f64) -> bool| statistics(&sorted(values.iter().copied().filter(|v| keep(*v))));
    Comparison {
        surfaces: None,
        faces: vec![],
        reference: reference.into(),
        rank: n as u32 + 1,
        warnings: vec![],
        sign: sign(),
        soundness: soundness(),
        deviation: BySide {
            all: side(&|_| true),
            positive: side(&|v| v > 0.0),
            negative: side(&|v| v < 0.0),
        },
        excluded: if missing > 0 {
            BTreeMap::from([("max_distance".into(), missing)])
        } else {
            BTreeMap::new()
        },
        along: None,
        regions: vec![],
        outliers: None,
        between_vertices: None,
        coverage: None,
        verdict: shares.as_ref().map(|s| match s.inside {
            Some(inside) if inside >= s.required => Verdict::Pass,
            _ => Verdict::Fail,
        }),
        verdict_reasons: vec![],
        others_verdict: None,
        tolerance: shares,
        histogram: Some(histogram(&values)),
        lowest: None,
        highest: None,
        worst: worst(body, field),
        reverse: None,
        paper_vs_exact: None,
        research: None,
    }
}

fn soundness() -> Soundness {
    Soundness {
        sound: true,
        closed: true,
        consistently_oriented: true,
        outward: true,
        not_finite_facets: 0,
        shells: 1,
        boundary_edges: 0,
        non_manifold_edges: 0,
        non_manifold_vertices: 0,
        duplicate_facets: 0,
        degenerate_facets: 0,
        inconsistent_edges: 0,
        findings: Default::default(),
    }
}

/// The three highest and three lowest vertices, at least 1 mm apart.
fn worst(body: &Body, field: &[f64]) -> Vec<Worst> {
    let off = |(point, nearest, deviation)| Worst {
        sign: 1,
        index: 0,
        point,
        nearest,
        normal: None,
        deviation,
        region: None,
    };
    let mut all: Vec<Worst> = body.off.map(off).into_iter().collect();
    for sign in [1i8, -1] {
        let mut order: Vec<usize> = (0..field.len()).filter(|i| field[*i] * f64::from(sign) > 0.0).collect();
        order.sort_by(|a, b| field[*b].abs().total_cmp(&field[*a].abs()));
        let mut picked: Vec<Point> = vec![];
        for index in order {
            let p = body.measured.positions[index];
            let apart = |q: &Point| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>() > 4.0;
            if picked.len() < 3 && picked.iter().all(apart) {
                picked.push(p);
                let worst = Worst {
                    sign,
                    index: index as u64,
                    point: p,
                    nearest: p,
                    normal: None,
                    deviation: field[index],
                    region: None,
                };
                all.push(worst);
            }
        }
    }
    all
}
