//! The usual characteristics of features.

use super::text::{number_text, quoted};
use std::fmt::Write;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::dot;

/// Tolerances of a proposal: to be replaced by those of the drawing.
const PROPOSED_TOLERANCE: &str = "0.1";
/// Cosine above which directions count as parallel as drawn, and sine below which as perpendicular.
const DRAWN_PARALLEL_COSINE: f64 = 0.999;

/// The usual characteristics of each feature: form, size, attitude to the feature "A", a plane.
pub(super) fn usual(features: &[(String, Shape)]) -> String {
    let mut out = String::new();
    let mut number = 0;
    let mut add = |lines: String| {
        number += 1;
        let _ = write!(out, "\n[[characteristic]]\nid = \"{number}\"\n{lines}\n");
    };
    let datum = features.iter().find(|(id, _)| id == "A").and_then(|(_, shape)| shape.direction());
    for (id, shape) in features {
        let id_text = quoted(id);
        let form = [(Kind::Plane, "flatness"), (Kind::Cylinder, "cylindricity")];
        let form = form.into_iter().find(|(kind, _)| *kind == shape.kind());
        if let Some((_, form)) = form {
            add(format!("kind = \"{form}\"\nfeature = {id_text}\ntolerance = {PROPOSED_TOLERANCE}"));
        }
        if let Shape::Cylinder { radius, .. } | Shape::Sphere { radius, .. } = shape {
            let nominal = number_text(2.0 * radius);
            add(format!(
                "kind = \"size\"\nsize = \"GG\"\nfeature = {id_text}\nnominal = {nominal}\nupper = {PROPOSED_TOLERANCE}\nlower = -{PROPOSED_TOLERANCE}"
            ));
        }
        let (Some(own), Some(datum), true) = (shape.direction(), datum, id != "A") else { continue };
        // Planes stand to each other as their normals do, an axis to a plane the other way round.
        let is_plane = matches!(shape, Shape::Plane { .. });
        let along = dot(own, datum).abs();
        let kind = match (along >= DRAWN_PARALLEL_COSINE, along <= 1.0 - DRAWN_PARALLEL_COSINE) {
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
        add(format!(
            "kind = \"{kind}\"\nfeature = {id_text}\ndatums = [\"A\"]\ntolerance = {PROPOSED_TOLERANCE}"
        ));
    }
    out
}
