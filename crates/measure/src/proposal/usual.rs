//! The usual characteristics of features.

use super::draft::Refused;
use super::text::{comment, number_text, quoted};
use std::fmt::Write;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::{cross, dot, norm};

/// Tolerances of a proposal: to be replaced by those of the drawing.
const PROPOSED_TOLERANCE: f64 = 0.1;
/// Cosine above which directions count as parallel as drawn, and sine below which as perpendicular.
const DRAWN_PARALLEL_COSINE: f64 = 0.999;

/// How a feature stands to the datum.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Stands {
    Along,
    Across,
    Inclined,
}

/// By directions that were found in facets.
pub(super) fn as_found(own: [f64; 3], datum: [f64; 3]) -> Stands {
    let along = dot(own, datum).abs();
    match (along >= DRAWN_PARALLEL_COSINE, along <= 1.0 - DRAWN_PARALLEL_COSINE) {
        (true, _) => Stands::Along,
        (_, true) => Stands::Across,
        _ => Stands::Inclined,
    }
}

/// By directions that are exact but for the digits of a file.
pub(super) fn as_drawn(own: [f64; 3], datum: [f64; 3]) -> Stands {
    match (norm(cross(own, datum)), dot(own, datum).abs()) {
        (sine, _) if sine < super::faces::MAX_SINE_OF_AXES => Stands::Along,
        (_, cosine) if cosine < super::faces::MAX_SINE_OF_AXES => Stands::Across,
        _ => Stands::Inclined,
    }
}

/// The usual characteristics of each feature: form, size, attitude to the feature "A", a plane. Those that are refused are comments.
pub(super) fn usual(
    features: &[(String, Shape)],
    stands: fn([f64; 3], [f64; 3]) -> Stands,
    refused: &Refused,
) -> String {
    let mut out = String::new();
    let mut number = 0;
    let mut add = |kind: &str, id: &str, lines: Result<(&str, &str), &str>| {
        number += 1;
        let id = quoted(id);
        let refused = refused.get(&number.to_string());
        let _ = match refused.map_or(lines, |why| Err(why)) {
            Ok((before, after)) => write!(
                out,
                "\n[[characteristic]]\nid = \"{number}\"\nkind = \"{kind}\"\n{before}feature = {id}\n{after}\n"
            ),
            Err(why) => {
                write!(out, "\n{}", comment(&format!("Not in the plan: {kind} of {id}: {why}")))
            }
        };
    };
    let datum = features.iter().find(|(id, _)| id == "A").and_then(|(_, shape)| shape.direction());
    for (id, shape) in features {
        let form = [(Kind::Plane, "flatness"), (Kind::Cylinder, "cylindricity")];
        let form = form.into_iter().find(|(kind, _)| *kind == shape.kind());
        if let Some((_, form)) = form {
            add(form, id, Ok(("", &format!("tolerance = {PROPOSED_TOLERANCE}"))));
        }
        if let Shape::Cylinder { radius, .. } | Shape::Sphere { radius, .. } = shape {
            let nominal = number_text(2.0 * radius);
            let limits =
                format!("nominal = {nominal}\nupper = {PROPOSED_TOLERANCE}\nlower = -{PROPOSED_TOLERANCE}");
            let lines = match 2.0 * radius > PROPOSED_TOLERANCE {
                true => Ok(("size = \"GG\"\n", limits.as_str())),
                false => Err("it is no larger than the placeholder"),
            };
            add("size", id, lines);
        }
        let (Some(own), Some(datum), true) = (shape.direction(), datum, id != "A") else { continue };
        // Planes stand to each other as their normals do, an axis to a plane the other way round.
        let is_plane = matches!(shape, Shape::Plane { .. });
        let kind = match stands(own, datum) {
            Stands::Inclined => continue,
            found if (found == Stands::Along) == is_plane => "parallelism",
            _ => "perpendicularity",
        };
        add(kind, id, Ok(("", &format!("datums = [\"A\"]\ntolerance = {PROPOSED_TOLERANCE}"))));
    }
    out
}
