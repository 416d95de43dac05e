//! What is drawn against the exact values of the document.

use super::pieces::kind;
use super::*;
use crate::{Language, flat};
use trueness_document::section::{FrameRecord, GeometryRecord};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;
use trueness_measure::section::Section;
use trueness_section::{Options, contour};

/// Far from the origin: a line, an arc of radius 8, a line, a corner, a free curve.
pub(super) fn row(noise: f64) -> Vec<[f64; 2]> {
    let mut random = Random::new(7);
    let mut normal = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
    let line = (0..60).map(|i| [f64::from(i) / 3.0, 0.0]);
    let arc = (0..38).map(|i| f64::from(i) / 24.0).map(|a| [20.0 + 8.0 * a.sin(), 8.0 - 8.0 * a.cos()]);
    let up = (0..40).map(|i| [28.0, 8.0 + f64::from(i) * 0.3]);
    let free = (0..120)
        .map(|i| f64::from(i) * 0.25)
        .map(|x| [28.0 - x, 20.0 + 1.5 * (0.4 * x).sin() + 0.01 * x * x]);
    let all = line.chain(arc).chain(up).chain(free);
    all.map(|[x, y]| [1000.0 + x + noise * normal(), y - 500.0 + noise * normal()]).collect()
}

pub(super) fn document(points: &[[f64; 2]]) -> SectionDocument {
    let options = Options::default();
    let found = contour(points, &options, &Silent).unwrap();
    let frame = FrameRecord { origin: [0.0; 3], x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0], flatness: 0.0 };
    let section = Section {
        frame,
        plane: None,
        area: Err("none"),
        loose: 0,
        gap: None,
        thickness: None,
        fills_area: false,
        bent: vec![],
        contours: vec![found],
    };
    trueness_measure::section::document(&[section], vec![], &options)
}

pub(super) fn drawn(document: &SectionDocument, places: &[Point], room: usize) -> String {
    let style = Style { language: Language::En, decimal: None };
    document.draw(style, &[ViewObject::measured(places)], Up::Z, room).into_string()
}

/// The values of an attribute of all elements of a class.
pub(super) fn attributes<'a>(page: &'a str, class: &str, name: &str) -> Vec<&'a str> {
    let found = page.split('<').filter(|e| e.contains(&format!("class=\"{class}")));
    found.map(|e| e.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap()).collect()
}

/// The numbers of a path or an attribute.
pub(super) fn numbers(text: &str) -> Vec<f64> {
    let parts = text.split(|c: char| c.is_ascii_alphabetic() && c != 'e' || c.is_whitespace());
    parts.filter(|p| !p.is_empty()).map(|p| p.parse().unwrap()).collect()
}

/// The places of a drawing as those of the section.
pub(super) fn places(page: &str, path: &str) -> Vec<[f64; 2]> {
    let origin = numbers(attributes(page, "plan", "data-origin")[0]);
    numbers(path).chunks(2).map(|p| [origin[0] + p[0], origin[1] - p[1]]).collect()
}

pub(super) fn far(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

#[test]
fn segments_are_drawn_where_they_are() {
    let document = document(&row(0.01));
    let page = drawn(&document, &[], 0);
    let segments = &document.contours[0].segments;
    let paths = attributes(&page, "segment", "d");
    assert_eq!(paths.len(), segments.len());
    let kinds: Vec<&str> = segments.iter().map(kind).collect();
    assert_eq!(kinds[..3], ["line", "arc", "line"]);
    assert!(kinds.contains(&"spline"), "{kinds:?}");
    for (segment, path) in segments.iter().zip(&paths) {
        assert!(page.contains(&format!("class=\"segment k-{}\"", kind(segment))));
        let control = places(&page, path);
        let bezier = |piece: usize, t: f64| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| control[3 * piece + k]);
            let s = 1.0 - t;
            [0, 1].map(|k| {
                s * s * s * a[k] + 3.0 * s * s * t * b[k] + 3.0 * s * t * t * c[k] + t * t * t * d[k]
            })
        };
        let ends = match segment.geometry {
            GeometryRecord::Arc { center, radius, start_angle, sweep } => {
                let at = |a: f64| [center[0] + radius * a.cos(), center[1] + radius * a.sin()];
                [at(start_angle), at(start_angle + sweep)]
            }
            _ => [segment.start, segment.end],
        };
        assert!(far(control[0], ends[0]) < 1e-9 && far(control[control.len() - 1], ends[1]) < 1e-9);
        match &segment.geometry {
            GeometryRecord::Line { .. } => assert_eq!(control.len(), 2),
            GeometryRecord::Arc { center, radius, .. } => {
                for piece in 0..(control.len() - 1) / 3 {
                    for t in [0.0, 0.1, 0.3, 0.5, 0.8, 1.0] {
                        let off = far(bezier(piece, t), *center) - radius;
                        assert!(off.abs() < 1e-7 * radius + 1e-10, "{off}");
                    }
                }
            }
            GeometryRecord::Spline { knots, control_points, .. } => {
                use trueness_geom::spline::{basis::Knots, curve::Curve};
                let curve =
                    Curve::new(Knots::new(3, knots.clone()).unwrap(), control_points.clone()).unwrap();
                let distinct = curve.knots().distinct();
                assert_eq!(control.len(), 3 * (distinct.len() - 1) + 1);
                for (piece, w) in distinct.windows(2).enumerate() {
                    for t in [0.0, 0.25, 0.7, 1.0] {
                        assert!(far(bezier(piece, t), curve.at(w[0] + t * (w[1] - w[0]))) < 1e-9);
                    }
                }
            }
        }
    }
}

#[test]
fn joins_intervals_and_points_are_drawn_where_they_are() {
    let points = row(0.01);
    let document = document(&points);
    let page = drawn(&document, &flat(&points), 1 << 20);
    let joins = &document.contours[0].joins;
    let (signs, bars) = (attributes(&page, "join g", "data-at"), attributes(&page, "interval\" d", "d"));
    assert_eq!((signs.len(), bars.len()), (joins.len(), joins.len()));
    for (n, join) in joins.iter().enumerate() {
        assert!(far(places(&page, signs[n])[0], join.point) < 1e-9);
        let bar = places(&page, bars[n]);
        assert!((0..2).all(|k| far(bar[k], join.interval[k]) < 1e-9));
    }
    let dots = attributes(&page, "dots\"", "d");
    let [plan, course @ ..] = &dots[..] else { panic!() };
    let seen: Vec<f64> = plan
        .split(['M', 'h', ' '])
        .filter(|t| !t.is_empty() && *t != "0")
        .map(|t| t.parse().unwrap())
        .collect();
    let origin = numbers(attributes(&page, "plan", "data-origin")[0]);
    assert_eq!(seen.len(), 2 * points.len());
    for (dot, p) in seen.chunks(2).zip(&points) {
        assert!(far([origin[0] + dot[0], origin[1] - dot[1]], *p) < 1e-5, "{dot:?} {p:?}");
    }
    assert!(course.is_empty(), "residuals have classes of their kinds");
}

/// Every residual stands at its length and distance, in the color of its segment.
#[test]
fn residuals_stand_beside_the_length() {
    let document = document(&row(0.01));
    let page = drawn(&document, &[], 0);
    let contour = &document.contours[0];
    let svg = page.split("preserveAspectRatio").nth(1).unwrap();
    let [length, range] = ["data-length=\"", "data-range=\""]
        .map(|a| svg.split(a).nth(1).unwrap().split('"').next().unwrap().parse::<f64>().unwrap());
    assert_eq!(length, contour.length);
    let mut seen = 0;
    for name in ["line", "arc", "spline"] {
        let Some(path) = svg.split(&format!("class=\"dots k-{name}\" d=\"M")).nth(1) else { continue };
        let dots: Vec<[f64; 2]> = path
            .split("\"/>")
            .next()
            .unwrap()
            .split('M')
            .map(|dot| {
                let xy: Vec<f64> =
                    dot.trim_end_matches("h0").split(' ').map(|x| x.parse().unwrap()).collect();
                [xy[0] / course::COURSE_WIDTH * length, -xy[1] / course::COURSE_HALF_HEIGHT * range]
            })
            .collect();
        let own: Vec<usize> = (0..contour.residuals.len())
            .filter(|i| kind(&contour.segments[contour.labels[*i] as usize]) == name)
            .filter(|i| !contour.outliers.contains(&(*i as u64)))
            .collect();
        assert_eq!(dots.len(), own.len(), "{name}");
        for (dot, i) in dots.iter().zip(own) {
            let station = contour.stations[i].clamp(0.0, length);
            assert!((dot[0] - station).abs() < 1e-3 && (dot[1] - contour.residuals[i]).abs() < 1e-5 * range);
            seen += 1;
        }
    }
    assert_eq!(seen + contour.outliers.len(), contour.residuals.len());
}

/// A tooth is as long as the curvature is great, on the outside; a line has none.
#[test]
fn the_comb_is_the_curvature() {
    let document = document(&row(0.0));
    let contour = &document.contours[0];
    for segment in &contour.segments {
        let teeth = path::teeth(segment, 0.5);
        if let GeometryRecord::Arc { center, radius, .. } = segment.geometry {
            assert!(teeth.len() as f64 > segment.length / 0.5);
            for t in &teeth {
                assert!(
                    (t.curvature.abs() - 1.0 / radius).abs() < 1e-12
                        && (far(t.at, center) - radius).abs() < 1e-9
                );
                // The left is inside where it turns left.
                let inward = [0, 1].map(|k| t.at[k] + t.curvature.signum() * t.normal[k]);
                assert!(far(inward, center) < radius);
            }
        }
        assert_eq!(teeth.is_empty(), matches!(segment.geometry, GeometryRecord::Line { .. }));
        if let GeometryRecord::Spline { .. } = segment.geometry {
            let [first, last] = [teeth[0], teeth[teeth.len() - 1]];
            assert!(
                (first.curvature - segment.curvature[0]).abs() < 0.02,
                "{first:?} {:?}",
                segment.curvature
            );
            assert!((last.curvature - segment.curvature[1]).abs() < 0.02, "{last:?} {:?}", segment.curvature);
        }
    }
}

/// Points beyond what the budget holds are left out evenly, and the page says how many are there.
#[test]
fn few_bytes_hold_few_points() {
    let points = row(0.01);
    let (document, places) = (document(&points), flat(&points));
    for room in [0, 30, 1000, 3000, 1 << 20] {
        let (shown, all) = Drawn::shown(&document, &[ViewObject::measured(&places)], Up::Z, room);
        let page = drawn(&document, &places, room);
        let dots = attributes(&page, "dots\"", "d").first().map_or(0, |d| d.matches('M').count());
        assert_eq!((dots, all), (shown, points.len()), "{room}");
        assert!(shown * nominal::DOT_BYTES <= room);
    }
}
