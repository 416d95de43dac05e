//! A plan proposed from the elements of a nominal mesh: every element a feature, with the usual characteristics.

use std::fmt::Write;
use trueness_geom::mesh::Mesh;
use trueness_geom::rigid::Rigid;
use trueness_geom::segment::{Region, Segmentation};
use trueness_geom::shape::Shape;
use trueness_geom::space::{Point, Vector, cross, dot, least_axis, minus, plus, times};
use trueness_geom::zone::datum::direction;

/// Tolerances of a proposal: to be replaced by those of the drawing.
const TOLERANCE: &str = "0.1";
/// Cosine above which directions count as parallel as drawn, and sine below which as perpendicular.
const PARALLEL: f64 = 0.999;

/// The text of a plan for the elements `found` in the nominal `mesh`, whose file is called `reference`. It parses; its
/// tolerances are placeholders. Elements without a nominal form in plans (tori) are left out, as a comment says.
pub fn proposal(mesh: &Mesh, found: &Segmentation, reference: &str) -> String {
    let mut out = format!(
        "# Proposed from {0}. Tolerances are placeholders: put in those of the drawing, take out what is not toleranced.\n\
         schema = \"trueness/plan/1\"\nunits = \"mm\"\nmeasured = \"scan.stl\"\nreference = {0}\n",
        quoted(reference)
    );
    let mut features: Vec<(String, &Region)> = Vec::new();
    let mut numbers = [0usize; 4];
    for (label, region) in found.regions.iter().enumerate() {
        let corners = corners(mesh, found, label as u32);
        let (kind, class) = match region.fit.shape {
            Shape::Plane { .. } => (0, "plane"),
            Shape::Cylinder { .. } => (1, "cylinder"),
            Shape::Cone { .. } => (2, "cone"),
            Shape::Sphere { .. } => (3, "sphere"),
            _ => {
                let kind = region.fit.shape.kind().name();
                let _ = writeln!(
                    out,
                    "\n# A {kind} was found too; a plan cannot seek it by its nominal form yet."
                );
                continue;
            }
        };
        numbers[kind] += 1;
        let first_plane = kind == 0 && numbers[0] == 1;
        let id = if first_plane { "A".to_string() } else { format!("{class} {}", numbers[kind]) };
        let Some(nominal) = nominal(&region.fit.shape, &corners) else { continue };
        let _ = write!(
            out,
            "\n[[feature]]\nid = {}\nshape = \"{class}\"\nnominal = {{ {nominal} }}\n",
            quoted(&id)
        );
        features.push((id, region));
    }
    characteristics(&mut out, &features);
    out
}

/// The usual characteristics of each feature: form, size, attitude to the largest plane.
fn characteristics(out: &mut String, features: &[(String, &Region)]) {
    let mut number = 0;
    let mut add = |lines: String| {
        number += 1;
        let _ = write!(out, "\n[[characteristic]]\nid = \"{number}\"\n{lines}\n");
    };
    let datum = features.iter().find(|(id, _)| id == "A").and_then(|(_, r)| direction(&r.fit.shape));
    for (id, region) in features {
        let id_text = quoted(id);
        let shape = &region.fit.shape;
        let form = match shape {
            Shape::Plane { .. } => Some("flatness"),
            Shape::Cylinder { .. } => Some("cylindricity"),
            _ => None,
        };
        if let Some(form) = form {
            add(format!("kind = \"{form}\"\nfeature = {id_text}\ntolerance = {TOLERANCE}"));
        }
        if let Shape::Cylinder { radius, .. } | Shape::Sphere { radius, .. } = shape {
            let nominal = number_text(2.0 * radius);
            add(format!(
                "kind = \"size\"\nsize = \"GG\"\nfeature = {id_text}\nnominal = {nominal}\nupper = {TOLERANCE}\nlower = -{TOLERANCE}"
            ));
        }
        let (Some(own), Some(datum), true) = (direction(shape), datum, id != "A") else { continue };
        // Planes stand to each other as their normals do, an axis to a plane the other way round.
        let is_plane = matches!(shape, Shape::Plane { .. });
        let along = dot(own, datum).abs();
        let kind = match (along >= PARALLEL, along <= 1.0 - PARALLEL) {
            (true, _) => {
                if is_plane {
                    "parallelism"
                } else {
                    "perpendicularity"
                }
            }
            (_, true) => {
                if is_plane {
                    "perpendicularity"
                } else {
                    "parallelism"
                }
            }
            _ => continue,
        };
        add(format!("kind = \"{kind}\"\nfeature = {id_text}\ndatums = [\"A\"]\ntolerance = {TOLERANCE}"));
    }
}

/// The corners of the facets of a region.
fn corners(mesh: &Mesh, found: &Segmentation, label: u32) -> Vec<[Point; 3]> {
    let own = mesh.faces.iter().zip(&found.labels).filter(|(_, l)| **l == label);
    let corner = |v: u32| mesh.positions.get(v as usize).copied();
    own.filter_map(|(f, _)| Some([corner(f[0])?, corner(f[1])?, corner(f[2])?])).collect()
}

/// The keys of a nominal feature: the element, within the bounds of its facets.
fn nominal(shape: &Shape, facets: &[[Point; 3]]) -> Option<String> {
    let points = || facets.iter().flatten();
    let range = |origin: Point, way: Vector| {
        let along = points().map(|p| dot(minus(*p, origin), way));
        let low = along.clone().fold(f64::INFINITY, f64::min);
        (low, along.fold(f64::NEG_INFINITY, f64::max))
    };
    let at = |origin: Point, way: Vector, t: f64| plus(origin, times(t, way));
    match *shape {
        Shape::Plane { point, normal } => {
            let facing =
                facets.iter().fold([0.0; 3], |s, [a, b, c]| plus(s, cross(minus(*b, *a), minus(*c, *a))));
            let normal = if dot(facing, normal) < 0.0 { times(-1.0, normal) } else { normal };
            let [u, v, _] = Rigid::into_frame(point, normal, least_axis(normal))?.rotation();
            let ((a, b), (c, d)) = (range(point, u), range(point, v));
            let corner = |s: f64, t: f64| vector(at(at(point, u, s), v, t));
            Some(format!(
                "point = {}, normal = {}, boundary = [{}, {}, {}, {}]",
                vector(point),
                vector(normal),
                corner(a, c),
                corner(b, c),
                corner(b, d),
                corner(a, d)
            ))
        }
        Shape::Cylinder { point, direction, radius } => {
            let (from, to) = range(point, direction);
            Some(format!(
                "point = {}, direction = {}, radius = {}, length = {}",
                vector(at(point, direction, from)),
                vector(direction),
                number_text(radius),
                number_text(to - from)
            ))
        }
        Shape::Cone { apex, direction, half_angle, .. } => {
            let (from, to) = range(apex, direction);
            Some(format!(
                "apex = {}, direction = {}, half_angle = {}, between = [{}, {}]",
                vector(apex),
                vector(direction),
                number_text(half_angle.to_degrees()),
                number_text(from.max(0.0)),
                number_text(to)
            ))
        }
        Shape::Sphere { center, radius } => {
            Some(format!("center = {}, radius = {}", vector(center), number_text(radius)))
        }
        _ => None,
    }
}

/// A number without the rounding of single precision that meshes come with: to six digits after the point.
fn number_text(x: f64) -> String {
    let rounded = (x * 1e6).round() / 1e6;
    // TOML has floats with a point; minus zero is zero.
    format!("{:?}", rounded + 0.0)
}

fn vector(v: [f64; 3]) -> String {
    format!("[{}]", v.map(number_text).join(", "))
}

/// A string of TOML.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
