//! Every answer of `corpus/reference_fits`.

use super::{Fit, Kind, Method, Parameter, Shape, fitted};
use crate::shape::Shape::{Cone, Cylinder, Line, Line2, Plane};
use crate::space::{Aabb, Point, cross, minus, norm};
use std::collections::BTreeMap;
use std::path::PathBuf;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../corpus/reference_fits")
}

struct Answer {
    set: String,
    kind: Kind,
    method: Method,
    /// The class determines the element badly.
    weak: bool,
    numbers: BTreeMap<String, Vec<f64>>,
}

fn kind(element: &str) -> Kind {
    match element {
        "line2d" => Kind::Line2,
        "line3d" => Kind::Line,
        "circle2d" => Kind::Circle2,
        "circle3d" => Kind::Circle,
        name => Kind::ALL.into_iter().find(|k| k.name() == name).unwrap(),
    }
}

fn answers() -> Vec<Answer> {
    let text = std::fs::read_to_string(folder().join("reference.txt")).unwrap();
    let lines = text.lines().filter(|l| !l.starts_with('#'));
    lines
        .map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            let mut numbers: BTreeMap<String, Vec<f64>> = BTreeMap::new();
            let mut name = "";
            for word in &words[4..] {
                match word.parse::<f64>() {
                    Ok(x) => numbers.get_mut(name).unwrap().push(x),
                    Err(_) => {
                        name = word;
                        numbers.insert(name.into(), Vec::new());
                    }
                }
            }
            Answer {
                set: words[0].into(),
                kind: kind(words[1]),
                weak: ["far", "arc8", "cap5"].contains(&words[2]),
                method: Method::ALL.into_iter().find(|m| m.name() == words[3]).unwrap(),
                numbers,
            }
        })
        .collect()
}

fn points(set: &str) -> Vec<Point> {
    let text = std::fs::read_to_string(folder().join(format!("{set}.xyz"))).unwrap();
    text.lines()
        .map(|line| {
            let x: Vec<f64> = line.split_whitespace().map(|w| w.parse().unwrap()).collect();
            [x[0], x[1], x.get(2).copied().unwrap_or(0.0)]
        })
        .collect()
}

fn three(x: &[f64]) -> Point {
    [x[0], x[1], x.get(2).copied().unwrap_or(0.0)]
}

/// The quantity of the fit that the reference names, as distance from the reference's.
fn error(name: &str, reference: &[f64], fit: &Fit) -> f64 {
    let found = |wanted: &str| fit.shape.parameters().into_iter().find(|p| p.0 == wanted).map(|p| p.1);
    match (name, &fit.shape) {
        ("rms", _) => (fit.residuals.rms - reference[0]).abs(),
        ("form", _) => (fit.residuals.form_error - reference[0]).abs(),
        ("diameter", _) => match found("radius") {
            Some(Parameter::Number(radius)) => (2.0 * radius - reference[0]).abs(),
            _ => f64::INFINITY,
        },
        ("direction" | "normal", _) => match found(name) {
            Some(Parameter::Vector(v)) => norm(cross(v, three(reference))) / norm(three(reference)),
            _ => f64::INFINITY,
        },
        // A point on an axis or plane may lie anywhere on it.
        ("point", Plane { .. } | Line2 { .. } | Line { .. }) => fit.shape.distance(three(reference)).abs(),
        ("point", Cylinder { point, direction, .. } | Cone { point, direction, .. }) => {
            norm(cross(minus(three(reference), *point), *direction))
        }
        // Both at the foot of the mean: how far it is from the surface.
        ("radius", Cone { half_angle, radius, .. }) => (radius - reference[0]).abs() * half_angle.cos(),
        _ => match found(name) {
            Some(Parameter::Number(x)) => (x - reference[0]).abs(),
            Some(Parameter::Vector(v)) => norm(minus(v, three(reference))),
            None => f64::INFINITY,
        },
    }
}

#[test]
fn every_reference_is_met_to_its_last_digits() {
    let answers = answers();
    assert_eq!(answers.len(), 183);
    for answer in &answers {
        let points = points(&answer.set);
        let fit = fitted(&points, answer.kind, answer.method).unwrap();
        assert!(fit.converged, "{}", answer.set);
        let sides = Aabb::of(&points).sides();
        let radius = fit.shape.parameters().into_iter().fold(0.0, |m: f64, p| match p {
            ("radius" | "major_radius", Parameter::Number(r)) => m.max(r),
            _ => m,
        });
        let size = sides.into_iter().fold(radius, f64::max).clamp(1.0, 1000.0);
        // A thousandth of what certified software is asked for; directions in radians.
        let limit = match (answer.method, answer.weak) {
            (Method::Gaussian, false) => 1e-12 * size,
            (Method::Gaussian, true) => 1e-9,
            (_, false) => 1e-12 * size,
            (_, true) => 1e-7,
        };
        for (name, reference) in &answer.numbers {
            let limit = match name.as_str() {
                "direction" | "normal" | "half_angle" if answer.weak => 1e-10,
                "direction" | "normal" | "half_angle" => 1e-12,
                "apex" => 10.0 * limit,
                _ => limit,
            };
            let error = error(name, reference, &fit);
            assert!(error <= limit, "{} {} {name}: {error:e} > {limit:e}", answer.set, answer.method.name());
        }
        if let (Some(radius), Cone { .. }) = (answer.numbers.get("radius"), &fit.shape) {
            let d = fit.shape.distance(three(&answer.numbers["point"]));
            let half_angle = answer.numbers["half_angle"][0];
            assert!((d + radius[0] * half_angle.cos()).abs() <= limit, "{}", answer.set);
        }
    }
}

/// The circle through six points of Gander, Golub and Strebel, Least-squares fitting of circles and ellipses,
/// BIT 34 (1994): center (4.7398, 2.9835), radius 4.7142.
#[test]
fn the_published_circle() {
    let points = [[1.0, 7.0], [2.0, 6.0], [5.0, 8.0], [7.0, 7.0], [9.0, 5.0], [3.0, 7.0]];
    let points: Vec<Point> = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let fit = fitted(&points, Kind::Circle2, Method::Gaussian).unwrap();
    let Shape::Circle2 { center, radius } = fit.shape else { panic!() };
    assert!((center[0] - 4.7398).abs() < 5e-5 && (center[1] - 2.9835).abs() < 5e-5);
    assert!((radius - 4.7142).abs() < 5e-5);
}

/// The ellipse of the same paper, example of section 6: half axes 6.5187 and 3.0319, center (2.6996, 3.8160).
#[test]
fn the_published_ellipse() {
    let points =
        [[1.0, 7.0], [2.0, 6.0], [5.0, 8.0], [7.0, 7.0], [9.0, 5.0], [3.0, 7.0], [6.0, 2.0], [8.0, 4.0]];
    let points: Vec<Point> = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let fit = fitted(&points, Kind::Ellipse2, Method::Gaussian).unwrap();
    let Shape::Ellipse2 { center, major_radius, minor_radius, .. } = fit.shape else { panic!() };
    assert!((center[0] - 2.6996).abs() < 5e-5 && (center[1] - 3.8160).abs() < 5e-5, "{fit:?}");
    assert!((major_radius - 6.5187).abs() < 5e-5 && (minor_radius - 3.0319).abs() < 5e-5);
}
