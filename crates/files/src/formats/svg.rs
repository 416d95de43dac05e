//! SVG drawings, 1 to 1: a unit of the drawing is a millimeter, y runs upwards as in the data.
//!
//! Arcs are arcs. Cubic splines are Bézier curves, exactly: their knots are inserted until each span stands alone. A spline
//! of another degree is drawn as a polyline of 64 steps to a span.

use crate::content::drawing::{Clamped, Entity, Layer, bounds, whole};
use crate::xml::Xml;
use std::io::{self, Write};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::Curve;

/// Writes a drawing; lines are a five hundredth of its size wide.
pub fn write(out: &mut dyn Write, layers: &[Layer]) -> io::Result<()> {
    let [low, high] = bounds(layers).unwrap_or_default();
    let size = [high[0] - low[0], high[1] - low[1]];
    let margin = 0.02 * size[0].max(size[1]).max(1e-3);
    let [w, h] = size.map(|s| s + 2.0 * margin);
    let (x, y) = (low[0] - margin, -high[1] - margin);
    let mut xml = Xml::new(0);
    xml.declaration(&[("encoding", "UTF-8".into())]);
    let page = [
        ("xmlns", "http://www.w3.org/2000/svg".into()),
        ("width", format!("{w}mm")),
        ("height", format!("{h}mm")),
        ("viewBox", format!("{x} {y} {w} {h}")),
    ];
    xml.start("svg", &page);
    let width = w.max(h) / 500.0;
    for layer in layers {
        let style = [
            ("id", layer.name.clone()),
            ("transform", "scale(1,-1)".into()),
            ("fill", "none".into()),
            ("stroke", "black".into()),
            ("stroke-width", width.to_string()),
        ];
        xml.element("g", &style, |xml| layer.entities.iter().for_each(|e| entity(xml, e)));
        out.write_all(xml.take().as_bytes())?;
    }
    xml.end();
    out.write_all(xml.take().as_bytes())
}

fn entity(xml: &mut Xml, entity: &Entity) {
    let mut path = |d: String| xml.empty("path", &[("d", d)]);
    match entity {
        Entity::Line { start: [x, y], end: [u, v] } => path(format!("M {x} {y} L {u} {v}")),
        Entity::Arc { center: [x, y], radius, sweep, .. } if whole(*sweep) => {
            let circle = [("cx", x.to_string()), ("cy", y.to_string()), ("r", radius.to_string())];
            xml.empty("circle", &circle);
        }
        Entity::Arc { center, radius, start, sweep } => {
            let at = |a: f64| [center[0] + radius * libm::cos(a), center[1] + radius * libm::sin(a)];
            let ([x, y], [u, v]) = (at(*start), at(start + sweep));
            let large = u8::from(sweep.abs() > std::f64::consts::PI);
            let turn = u8::from(*sweep > 0.0);
            path(format!("M {x} {y} A {radius} {radius} 0 {large} {turn} {u} {v}"));
        }
        Entity::Spline(spline) => {
            if let Some(d) = course(spline) {
                path(d);
            }
        }
    }
}

/// The path of a spline; `None` where it is none.
fn course(Clamped { degree, knots, points }: &Clamped) -> Option<String> {
    let knots = Knots::new(*degree, knots.clone()).ok()?;
    let curve = Curve::new(knots, points.clone()).ok()?;
    let [x, y] = curve.at(curve.domain().0);
    let mut d = format!("M {x} {y}");
    if *degree == 3 {
        for b in curve.bezier()[1..].chunks(3) {
            let [p, q, r] = [0, 1, 2].map(|k| b.get(k).copied().unwrap_or_default());
            d += &format!(" C {} {} {} {} {} {}", p[0], p[1], q[0], q[1], r[0], r[1]);
        }
    } else {
        for [x, y] in &curve.sample(64 * curve.knots().distinct().len())[1..] {
            d += &format!(" L {x} {y}");
        }
    }
    Some(d)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page of a flat arc is as large as the arc, not as its circle: 20 wide, and 50 − √(50² − 10²) high.
    #[test]
    fn a_page_is_as_large_as_what_is_drawn() {
        let half = libm::asin(0.2);
        let start = std::f64::consts::FRAC_PI_2 + half;
        let arc = Entity::Arc { center: [7.0, -3.0], radius: 50.0, start, sweep: -2.0 * half };
        let mut out = vec![];
        write(&mut out, &[Layer { name: "a".into(), entities: vec![arc], ..Layer::default() }]).unwrap();
        let text = String::from_utf8(out).unwrap();
        let seen = text.split("viewBox=\"").nth(1).unwrap().split('"').next().unwrap();
        let seen: Vec<f64> = seen.split(' ').map(|x| x.parse().unwrap()).collect();
        let height = 50.0 - (50.0_f64 * 50.0 - 100.0).sqrt();
        // A fiftieth of the width on all sides; y points down.
        for (x, wanted) in seen.iter().zip([-3.4, -47.4, 20.8, height + 0.8]) {
            assert!((x - wanted).abs() < 1e-9, "{seen:?}");
        }
    }

    #[test]
    fn a_cubic_is_the_bezier_curves_it_consists_of() {
        let knots = vec![0.0, 0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0, 1.0];
        let points = vec![[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [3.0, 1.0], [4.0, 0.0]];
        let arc = Entity::Arc { center: [0.0, 0.0], radius: 1.0, start: 0.0, sweep: -4.0 };
        let layer = Layer {
            name: "a".into(),
            entities: vec![Entity::Spline(Clamped { degree: 3, knots, points }), arc],
            ..Layer::default()
        };
        let mut out = vec![];
        write(&mut out, &[layer]).unwrap();
        let text = String::from_utf8(out).unwrap();
        assert_eq!((text.matches(" C ").count(), text.matches(" A 1 1 0 1 0 ").count()), (2, 1), "{text}");
    }
}
