//! Reports of sections whose lines and arcs are known in closed form.

use std::f64::consts::TAU;
use std::path::Path;
use trueness_document::Role;
use trueness_document::section::{FrameRecord, SectionDocument};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;
use trueness_measure::section::{Against, AgainstPlane, Section};
use trueness_report::{ReportInput, ReportOptions, ViewObject, flat};
use trueness_section::{Options, Outline, Segment, contour, off_nominal};

/// All of them, into `folder`.
pub fn write_all(folder: &Path) {
    super::written(folder, "against", against());
    super::written(folder, "section", page(&[vec![profile()]]));
    super::written(folder, "stack", page(&[vec![circle(20.0), circle(12.0)], vec![circle(16.0)]]));
}

/// From (1000, −500) a line of 20 along x, a quarter of a circle of radius 8 to the left, a line of 12, a corner to the
/// left, a line of 15; points every 0.3 with a noise of 0.01.
fn profile() -> Vec<[f64; 2]> {
    let quarter = 2.0 * TAU;
    let mut random = Random::new(3);
    let mut normal = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
    let at = |s: f64| match s {
        s if s < 20.0 => [s, 0.0],
        s if s < 20.0 + quarter => {
            let a = (s - 20.0) / 8.0;
            [20.0 + 8.0 * a.sin(), 8.0 - 8.0 * a.cos()]
        }
        s if s < 32.0 + quarter => [28.0, 8.0 + s - 20.0 - quarter],
        s => [28.0 - (s - 32.0 - quarter), 20.0],
    };
    let count = ((47.0 + quarter) / 0.3) as u32;
    (0..=count)
        .map(|i| at(0.3 * f64::from(i)))
        .map(|[x, y]| [1000.0 + x + 0.01 * normal(), y - 500.0 + 0.01 * normal()])
        .collect()
}

fn circle(radius: f64) -> Vec<[f64; 2]> {
    let at = |i: u32| TAU * f64::from(i) / 180.0;
    (0..180).map(|i| [radius * at(i).cos(), radius * at(i).sin()]).collect()
}

/// The report of the profile in a plane whose second axis points down, against what it was made of, 0.05 outside of that on the
/// first line, and a hole that was not measured.
fn against() -> Vec<u8> {
    let points: Vec<[f64; 2]> = profile();
    let (wish, options) = (Options::default(), ReportOptions::default());
    let lines = [
        [[1000.0, -499.95], [1020.0, -499.95]],
        [[1028.0, -492.0], [1028.0, -480.0]],
        [[1028.0, -480.0], [1013.0, -480.0]],
    ];
    let [first, up, back] = lines.map(|[a, b]| Segment::straight(a, b));
    let arc = Segment::arc([1020.0, -492.0], 8.0, -0.25 * TAU, 0.25 * TAU);
    let hole = Segment::arc([1010.0, -490.0], 2.0, 0.0, -TAU);
    let whole = Outline { segments: vec![first, arc, up, back], closed: false };
    let outlines = vec![whole, Outline { segments: vec![hole], closed: true }];
    let own = contour(&points, &wish, &Silent).unwrap();
    let found = off_nominal(&points, &outlines, &Silent).unwrap();
    let contours = vec![Against { points: &points, found, far: 0, contour: &own }];
    let nominal = trueness_measure::section::nominal(
        "nominal.dxf",
        "drawing",
        vec![AgainstPlane { plane: Some(0), outlines, contours }],
    );
    let frame = FrameRecord { origin: [0.0; 3], x: [1.0, 0.0, 0.0], y: [0.0, 0.0, -1.0], flatness: 0.0 };
    let section =
        Section::new(frame, Some(([0.0, 1.0, 0.0], 0.0)), Err("points have no facets"), vec![own.clone()]);
    let files = [(Role::Measured, "profile.txt"), (Role::Reference, "nominal.dxf")];
    let files = files.map(|(role, name)| super::record(role, name, points.len(), None)).to_vec();
    let document = SectionDocument {
        nominal: Some(nominal),
        ..trueness_measure::section::document(&[section], files, &wish)
    };
    let places = flat(&points);
    let objects = [ViewObject::measured(&places)];
    super::bytes(&ReportInput { result: &document, objects: &objects, marks: &[], options: &options })
}

/// The report of planes with contours of these points.
fn page(planes: &[Vec<Vec<[f64; 2]>>]) -> Vec<u8> {
    let (wish, options) = (Options::default(), ReportOptions::default());
    let one = planes.len() == 1;
    let sections: Vec<Section> = planes
        .iter()
        .enumerate()
        .map(|(n, rows)| {
            let frame = FrameRecord { origin: [0.0, 0.0, n as f64], ..FrameRecord::FLAT };
            let plane = (!one).then_some(([0.0, 0.0, 1.0], n as f64));
            let contours = rows.iter().map(|r| contour(r, &wish, &Silent).unwrap()).collect();
            Section::new(frame, plane, Err("points have no facets"), contours)
        })
        .collect();
    let places: Vec<Vec<Point>> = planes.iter().flatten().map(|r| flat(r)).collect();
    let count = places.iter().map(Vec::len).sum();
    let files = vec![super::record(Role::Measured, "profile.txt", count, None)];
    let document = trueness_measure::section::document(&sections, files, &wish);
    let objects: Vec<ViewObject> = places.iter().map(|p| ViewObject::measured(p)).collect();
    let result = &document;
    super::bytes(&ReportInput { result, objects: &objects, marks: &[], options: &options })
}
