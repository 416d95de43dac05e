//! Lines, arcs, circles and B-splines of a drawing as curves in space: a geometric curve set for each layer.
//!
//! An arc is a circle whose first axis points to the start of the arc. The arc runs counter-clockwise about the third axis.
//! So every arc is trimmed from 0 to the angle run through, whatever its sense.

use super::instances::{Instances, file, list, product, real};
use crate::content::drawing::{Clamped, Entity, Layer, whole};
use std::io::{self, Write};
use trueness_geom::plane::PlaneFrame;

/// Writes a drawing.
pub fn write(out: &mut dyn Write, layers: &[Layer]) -> io::Result<()> {
    let mut model = Instances::default();
    let (context, shape_of_product) = product(&mut model, "section");
    let mut items = vec![model.placement([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])];
    for layer in layers.iter().filter(|l| !l.entities.is_empty()) {
        let curves: Vec<String> = layer.entities.iter().map(|e| curve(&mut model, &layer.frame, e)).collect();
        let set = model.add(&format!("GEOMETRIC_CURVE_SET('{}',{})", layer.name, list(curves.into_iter())));
        items.push(set);
    }
    let shape = model.add(&format!(
        "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',{},{context})",
        list(items.into_iter())
    ));
    model.add(&format!("SHAPE_DEFINITION_REPRESENTATION({shape_of_product},{shape})"));
    file(out, "curves of sections", "section", &model)
}

fn curve(model: &mut Instances, frame: &PlaneFrame, entity: &Entity) -> String {
    match entity {
        Entity::Line { start, end } => {
            let (from, to) = (frame.place(*start), frame.place(*end));
            let along: [f64; 3] = std::array::from_fn(|k| to[k] - from[k]);
            let length = along.iter().map(|x| x * x).sum::<f64>().sqrt();
            // A line of no length has a direction all the same.
            let unit = if length > 0.0 { along.map(|x| x / length) } else { frame.x };
            let (direction, from) = (model.direction(unit), model.point(from));
            let vector = model.add(&format!("VECTOR('',{direction},1.0)"));
            let line = model.add(&format!("LINE('',{from},{vector})"));
            let to = model.point(to);
            trimmed(model, &line, [&from, &to], length)
        }
        Entity::Arc { center, radius, start, sweep } => {
            let at = |angle: f64| {
                let (sin, cos) = libm::sincos(angle);
                [cos, sin]
            };
            let [cos, sin] = at(*start);
            let to_start = std::array::from_fn(|k| cos * frame.x[k] + sin * frame.y[k]);
            // 0 and no minus 0.
            let normal = frame.normal().map(|x| if *sweep < 0.0 { 0.0 - x } else { x });
            let placement = model.placement(frame.place(*center), normal, to_start);
            let circle = model.add(&format!("CIRCLE('',{placement},{})", real(*radius)));
            if whole(*sweep) {
                return circle;
            }
            let ends = [*start, start + sweep].map(|angle| {
                let [cos, sin] = at(angle);
                model.point(frame.place([center[0] + radius * cos, center[1] + radius * sin]))
            });
            trimmed(model, &circle, [&ends[0], &ends[1]], sweep.abs())
        }
        Entity::Spline(Clamped { degree, knots, points }) => {
            let points: Vec<String> = points.iter().map(|p| model.point(frame.place(*p))).collect();
            model.curve(*degree, knots, &points)
        }
    }
}

/// The part of a curve from its parameter 0 to `end`, between two points.
fn trimmed(model: &mut Instances, basis: &str, [from, to]: [&str; 2], end: f64) -> String {
    model.add(&format!(
        "TRIMMED_CURVE('',{basis},({from},PARAMETER_VALUE(0.0)),({to},PARAMETER_VALUE({})),.T.,.PARAMETER.)",
        real(end)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::content::drawing::tests::one_of_each;

    /// Every instance that is named is there, before it is used; each kind of entity is written once.
    #[test]
    fn instances_are_named_before_they_are_used() {
        let [line, arc, circle, spline] = one_of_each([0.0, 0.0], [3.0, 4.0]);
        let entities = vec![line, arc, circle, spline];
        let frame = PlaneFrame { origin: [0.0, 0.0, 7.0], x: [0.0, 1.0, 0.0], y: [-1.0, 0.0, 0.0] };
        let mut bytes = vec![];
        let layers = [Layer { name: "section-1".into(), frame, entities }, Layer::default()];
        write(&mut bytes, &layers).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        for (n, line) in text.lines().filter(|l| l.starts_with('#')).enumerate() {
            let (name, body) = line.split_once('=').unwrap();
            assert_eq!(name, format!("#{}", n + 1));
            for used in body.split('#').skip(1) {
                let digits: String = used.chars().take_while(char::is_ascii_digit).collect();
                assert!(digits.parse::<usize>().unwrap() <= n, "{line}");
            }
        }
        let count = |word: &str| text.matches(&format!("={word}(")).count();
        assert_eq!(["LINE", "CIRCLE", "TRIMMED_CURVE", "B_SPLINE_CURVE_WITH_KNOTS"].map(count), [1, 2, 2, 1]);
        assert_eq!(count("GEOMETRIC_CURVE_SET"), 1);
        // The end of the line, in space: the first axis is the second of the coordinates.
        assert!(text.contains("CARTESIAN_POINT('',(-4.0,3.0,7.0))") && text.contains("PARAMETER_VALUE(5.0)"));
        // The arc runs clockwise: about the third axis turned over.
        assert!(text.contains("DIRECTION('',(0.0,0.0,-1.0))"));
    }
}
