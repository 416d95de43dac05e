//! A plan proposed from the elements of a nominal mesh: every element a feature, with the usual characteristics.

use super::draft::Refused;
use super::text::{number_text, quoted, vector};
use super::usual::{as_found, usual};
use crate::plan::DEFAULT_MIN_COVERAGE;
use crate::plan::region::{facets_of, nominal_of};
use std::collections::BTreeMap;
use std::fmt::Write;
use trueness_geom::feature::Nominal;
use trueness_geom::mesh::Mesh;
use trueness_geom::segment::Segmentation;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::{Point, cross, dot, minus, norm, plus, times};

/// A feature with less of the area of its nominal form is a part of it.
const WHOLE_AREA_SHARE: f64 = 0.9;

/// The text of a plan for the elements `found` in the nominal `mesh`, whose file is called `reference`. It parses; its
/// tolerances are placeholders. Elements without a nominal form in plans (tori) are left out, as a comment says.
pub fn of_mesh(mesh: &Mesh, found: &Segmentation, reference: &str) -> String {
    let mut out = format!(
        "# Proposed from {0}. Tolerances are placeholders: put in those of the drawing, take out what is not toleranced.\n\
         schema = \"trueness/plan/1\"\nunits = \"mm\"\nmeasured = \"scan.stl\"\nreference = {0}\n\n\
         # \"none\" where the scan lies in the coordinates of the model already.\n[align]\nmethod = \"best-fit\"\n\n\
         # Of each feature, rim = false leaves out vertices on edges, which scanners round. A coarse mesh whose vertices all lie\n\
         # on edges needs rim = true.\n",
        quoted(reference)
    );
    let mut features: Vec<(String, Shape)> = Vec::new();
    let mut numbers: BTreeMap<&str, usize> = BTreeMap::new();
    for (label, region) in found.regions.iter().enumerate() {
        let facets = facets_of(mesh, found, label as u32);
        let kind = region.fit.shape.kind();
        let class = kind.name();
        if !kind.has_nominal() {
            let _ =
                writeln!(out, "\n# A {class} was found too; a plan cannot seek it by its nominal form yet.");
            continue;
        }
        let number = numbers.entry(class).or_insert(0);
        *number += 1;
        let id =
            if kind == Kind::Plane && *number == 1 { "A".to_string() } else { format!("{class} {number}") };
        let Some(nominal) = nominal_of(&region.fit.shape, &facets) else { continue };
        let _ = write!(
            out,
            "\n[[feature]]\nid = {}\nshape = \"{class}\"\n{}nominal = {{ {} }}\nextract = {{ rim = false{} }}\n",
            quoted(&id),
            internal(&nominal, &facets),
            keys(&nominal),
            coverage(&nominal, &facets)
        );
        features.push((id, region.fit.shape));
    }
    if let Some(left) = without_region(mesh, found) {
        let _ = write!(out, "\n# {left}\n");
    }
    out.push_str(&usual(&features, as_found, &Refused::new()));
    out
}

/// Facets that belong to no element, and where the largest of them is: what they are is not in the plan.
fn without_region(mesh: &Mesh, found: &Segmentation) -> Option<String> {
    let corners = |f: usize| mesh.faces[f].map(|v| mesh.positions[v as usize]);
    let left = (0..mesh.faces.len()).filter(|f| found.labels.get(*f) == Some(&u32::MAX));
    let areas: Vec<(f64, usize)> =
        left.map(|f| (area(&corners(f)), f)).filter(|(area, _)| *area > 0.0).collect();
    let (_, largest) = areas.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let all: f64 = (0..mesh.faces.len()).map(|f| area(&corners(f))).sum();
    let [a, b, c] = corners(largest);
    let middle = times(1.0 / 3.0, plus(a, plus(b, c)));
    Some(format!(
        "{} facets, {:.1} % of the area, are of no element that was found: free forms and small faces. The largest is at {}.",
        areas.len(),
        100.0 * areas.iter().map(|a| a.0).sum::<f64>() / all,
        vector(middle.map(|x| (x * 1e3).round() / 1e3))
    ))
}

fn area([a, b, c]: &[Point; 3]) -> f64 {
    0.5 * norm(cross(minus(*b, *a), minus(*c, *a)))
}

/// The key `coverage` of a feature that is only a part of its nominal form, as a pocket is of a sphere: the usual share of
/// what there is. Empty where all of it is there.
fn coverage(nominal: &Nominal, facets: &[[Point; 3]]) -> String {
    let there: f64 = facets.iter().map(area).sum();
    match nominal.area().map(|area| there / area) {
        Some(share) if share < WHOLE_AREA_SHARE => {
            format!(", coverage = {:.3}", DEFAULT_MIN_COVERAGE * share)
        }
        _ => String::new(),
    }
}

/// The key `internal` of a cylinder, cone or sphere, as its facets tell which face out of the material. Empty of others.
fn internal(nominal: &Nominal, facets: &[[Point; 3]]) -> String {
    let Some(surface) = nominal.surface().filter(|_| !matches!(nominal, Nominal::Plane { .. })) else {
        return String::new();
    };
    let outward = |[a, b, c]: &[Point; 3]| {
        let middle = times(1.0 / 3.0, plus(*a, plus(*b, *c)));
        let double = cross(minus(*b, *a), minus(*c, *a));
        surface.distance(middle).map_or(0.0, |(_, way)| dot(double, way))
    };
    match facets.iter().map(outward).sum::<f64>() {
        0.0 => String::new(),
        sum => format!("internal = {}\n", sum < 0.0),
    }
}

/// The keys of a nominal feature.
fn keys(nominal: &Nominal) -> String {
    match nominal {
        Nominal::Plane { point, normal, boundary } => {
            let corners: Vec<String> = boundary.iter().map(|p| vector(*p)).collect();
            format!(
                "point = {}, normal = {}, boundary = [{}]",
                vector(*point),
                vector(*normal),
                corners.join(", ")
            )
        }
        Nominal::Cylinder { point, direction, radius, length } => format!(
            "point = {}, direction = {}, radius = {}, length = {}",
            vector(*point),
            vector(*direction),
            number_text(*radius),
            number_text(*length)
        ),
        Nominal::Cone { apex, direction, half_angle, between: [from, to] } => format!(
            "apex = {}, direction = {}, half_angle = {}, between = [{}, {}]",
            vector(*apex),
            vector(*direction),
            number_text(half_angle.to_degrees()),
            number_text(*from),
            number_text(*to)
        ),
        Nominal::Sphere { center, radius } => {
            format!("center = {}, radius = {}", vector(*center), number_text(*radius))
        }
        Nominal::Edge { point, direction, length, normals: [a, b] } => format!(
            "point = {}, direction = {}, length = {}, normals = [{}, {}]",
            vector(*point),
            vector(*direction),
            number_text(*length),
            vector(*a),
            vector(*b)
        ),
    }
}
