//! The nominal on the sheets against its exact places; sheets that are turned; segments astray.

use super::nominal::DOT_BYTES;
use super::tests::{attributes, document, drawn, far, numbers, places, row};
use super::*;
use crate::subject::Subject;
use crate::{Language, flat};
use std::f64::consts::{FRAC_PI_2, TAU};
use trueness_document::section::{
    ContourRecord, FrameRecord, NominalRecord, NominalWarningKind, PlaneRecord, Positive,
};
use trueness_geom::progress::Silent;
use trueness_geom::spline::{basis::Knots, curve::Curve};
use trueness_measure::section::{Against, AgainstPlane};
use trueness_section::{Contour, Geometry, Options, Outline, Segment, contour, off_nominal};

/// A line, an arc of radius 8 and a curve, near to [`row`]; and a round hole that no point is near to.
fn outlines() -> Vec<Outline> {
    let line = Segment::straight([1000.0, -500.0], [1020.0, -500.0]);
    let arc = Segment::arc([1020.0, -492.0], 8.0, -FRAC_PI_2, FRAC_PI_2);
    let knots = Knots::new(3, vec![0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0]).unwrap();
    let control = [[1028.0, -492.0], [1028.0, -485.0], [1027.0, -480.0], [1015.0, -480.0], [1000.0, -480.0]];
    let curve = Curve::new(knots, control.to_vec()).unwrap();
    let length = curve.length(0.0, 1.0);
    let geometry = Geometry::Spline { curve, deviation: 0.0 };
    let spline = Segment { geometry, length, ..Segment::straight(control[0], control[4]) };
    let hole = Segment::arc([1010.0, -490.0], 2.0, 0.0, -TAU);
    vec![
        Outline { segments: vec![line, arc, spline], closed: false },
        Outline { segments: vec![hole], closed: true },
    ]
}

/// The document of points compared with these outlines.
fn compared(points: &[[f64; 2]], outlines: Vec<Outline>) -> SectionDocument {
    let found = off_nominal(points, &outlines, &Silent).unwrap();
    let own = contour(points, &Options::default(), &Silent).unwrap();
    let contours = vec![Against { points, found, far: 0, contour: &own }];
    let nominal = trueness_measure::section::nominal(
        "n.dxf",
        "drawing",
        vec![AgainstPlane { plane: None, outlines, contours }],
    );
    SectionDocument { nominal: Some(nominal), ..document(points) }
}

const ENGLISH: Style = Style { language: Language::En, decimal: None };

#[test]
fn the_nominal_is_drawn_where_it_is() {
    let points = row(0.01);
    let document = compared(&points, outlines());
    let page = drawn(&document, &flat(&points), 1 << 20);
    let paths = attributes(&page, "nominal", "d");
    let [open, hole] = paths[..] else { panic!("{paths:?}") };
    // The hole alone is closed and was not measured.
    assert!(!open.ends_with('Z') && hole.ends_with('Z'));
    assert_eq!(page.matches("class=\"nominal missed\"").count(), 1);
    let whole = outlines();
    let on = |p: [f64; 2], outline: usize| {
        let far = |s: &Segment| s.nearest(p).distance.abs();
        whole[outline].segments.iter().map(far).fold(f64::INFINITY, f64::min)
    };
    let bezier = |[a, b, c, d]: [[f64; 2]; 4], t: f64| {
        let s = 1.0 - t;
        [0, 1].map(|k| s * s * s * a[k] + 3.0 * s * s * t * b[k] + 3.0 * s * t * t * c[k] + t * t * t * d[k])
    };
    let of_open = places(&page, open);
    // A line, four parts of a quarter of a circle, two spans of the curve.
    assert_eq!(of_open.len(), 2 + 3 * 4 + 3 * 2);
    assert!(far(of_open[0], [1000.0, -500.0]) < 1e-5 && far(of_open[1], [1020.0, -500.0]) < 1e-5);
    for (control, outline) in [(&of_open[1..], 0), (&places(&page, hole.trim_end_matches('Z'))[..], 1)] {
        for piece in 0..(control.len() - 1) / 3 {
            let four = [0, 1, 2, 3].map(|k| control[3 * piece + k]);
            for t in [0.0, 0.2, 0.5, 0.9, 1.0] {
                assert!(on(bezier(four, t), outline) < 1e-5, "{outline} {piece} {t}");
            }
        }
    }
}

/// Whiskers run from the nominal through the points, as often as long as the page says; signs stand at the points farthest off.
#[test]
fn deviations_are_drawn_as_they_are() {
    let points: Vec<[f64; 2]> = row(0.01).into_iter().take(60).collect();
    let document =
        compared(&points, vec![Outline::polyline(&[[990.0, -500.005], [1030.0, -500.005]], false)]);
    let found = document.nominal.as_ref().unwrap();
    let page = drawn(&document, &flat(&points), 1 << 20);
    let times = page.split("class=\"off-legend\"").nth(1).unwrap().split("data-n=\"").nth(1).unwrap();
    let times: f64 = times.split('"').next().unwrap().parse().unwrap();
    let greatest = found.worst.iter().map(|w| w.deviation.abs()).fold(0.0, f64::max);
    let mut seen = 0;
    for (side, sign) in [("whisker plus", 1.0), ("whisker minus", -1.0)] {
        let known = points.iter().zip(&found.deviations[0]).zip(&found.nearest[0]);
        let mut own = known.filter(|((_, d), _)| d.is_some_and(|d| d * sign > 0.0));
        for ends in places(&page, attributes(&page, side, "d")[0]).chunks(2) {
            let ((p, deviation), near) = own.next().unwrap();
            assert!(far(ends[0], near.unwrap()) < 1e-4);
            assert!((far(ends[0], ends[1]) - times * deviation.unwrap().abs()).abs() < 1e-4);
            // Through the point.
            let [a, b] = [far(ends[0], *p), far(*p, ends[1])];
            assert!((a + b - far(ends[0], ends[1])).abs() < 1e-4);
            seen += 1;
        }
        assert!(own.next().is_none());
    }
    assert_eq!(seen, found.deviations[0].iter().flatten().filter(|d| **d != 0.0).count());
    // The longest is a tenth of the size of what was measured, or more than 0.4 of that: 1, 2, 5, 10 lie so far apart.
    let longest = times * greatest / far(points[0], points[59]);
    assert!(longest > 0.039 && longest < 0.101 && times >= 10.0, "{longest} {times}");
    let signs = attributes(&page, "worst ", "data-at");
    assert_eq!(signs.len(), 2);
    for (sign, worst) in signs.iter().zip(&found.worst) {
        assert!(far(places(&page, sign)[0], worst.point) < 1e-9);
    }
}

/// Rows of both tables lead to what is drawn: the points farthest off, and the outline that was not measured.
#[test]
fn tables_of_the_nominal_lead_to_the_drawing() {
    let points = row(0.01);
    let document = compared(&points, outlines());
    let found = document.nominal.as_ref().unwrap();
    assert!(found.outlines[1].covered == 0.0 && found.outlines[1].hole && found.outlines[1].points == 0);
    assert!((found.outlines[1].length - 2.0 * TAU).abs() < 1e-12);
    let [o, r] = [found.outlines[1].center, found.outlines[1].size];
    assert!(far(o, [1010.0, -490.0]) < 0.02 && far(r, [4.0; 2]) < 0.02, "{o:?} {r:?}");
    let (list, page) =
        (document.content(ENGLISH).unwrap().list.into_string(), drawn(&document, &flat(&points), 1 << 20));
    let picks = document.picks();
    let mut lead = vec![];
    for table in ["farthest", "outlines"] {
        let rows = list.split(&format!("<table class=\"pick {table}\"")).nth(1).unwrap();
        let rows = rows.split("</table>").next().unwrap().split("data-pick=\"").skip(1);
        lead.extend(rows.map(|row| row.split('"').next().unwrap().parse::<usize>().unwrap()));
    }
    let first = document.contours.iter().map(|c| c.segments.len() + c.joins.len()).sum::<usize>();
    // The open outline was measured up to where the row ends: it is in the list only if it lacks more than a fiftieth.
    let lacking = found.outlines.iter().filter(|o| o.lacks()).count();
    assert_eq!(lead, (first..first + 2 + lacking).collect::<Vec<_>>());
    assert_eq!(picks.len(), first + 2 + lacking);
    for n in &lead {
        assert_eq!(page.matches(&format!("data-mark=\"{n}\"")).count(), 1, "{n}");
    }
    assert_eq!(picks[first].position[..2], found.worst[0].point);
    assert!(list.contains("Not measured"));
}

/// A nominal of very many chords keeps within the bytes that there are, and within what the page says of the true one.
#[test]
fn the_nominal_takes_no_more_bytes_than_there_are() {
    let points = row(0.01);
    let chord = |i: i32| f64::from(i) * 1e-3;
    let wave: Vec<[f64; 2]> =
        (0..20_000).map(|i| [1000.0 + chord(i), -500.0 + 0.5 * (2.0 * chord(i)).sin()]).collect();
    let document = compared(&points, vec![Outline::polyline(&wave, false)]);
    let bare = drawn(&document, &flat(&points), 0);
    assert!(attributes(&bare, "nominal", "d").is_empty() && !bare.contains("whisker"));
    let mut before = 0;
    for room in [2_000, 8_000, 30_000, 200_000, 2_000_000] {
        let page = drawn(&document, &flat(&points), room);
        assert!(page.len() <= bare.len() + room, "{room}: {} {}", page.len(), bare.len());
        let paths = attributes(&page, "nominal", "d");
        let Some(path) = paths.first() else { continue };
        let kept = places(&page, path);
        assert!(kept.len() >= before);
        before = kept.len();
        let within = page.split("Reference</span> ≤").nth(1).map_or(1e-6, |text| {
            text.split("data-n=\"").nth(1).unwrap().split('"').next().unwrap().parse::<f64>().unwrap()
        });
        let outline = Outline::polyline(&kept, false);
        let found = off_nominal(&wave[1..wave.len() - 1], &[outline], &Silent).unwrap();
        let worst = found.iter().flatten().map(|o| o.deviation.abs()).fold(0.0, f64::max);
        assert!(worst <= within + 1e-5, "{room}: {worst} {within}");
    }
    assert_eq!(before, wave.len());
    let (shown, all) = Drawn::shown(&document, &[ViewObject::measured(&flat(&points))], Up::Z, 30_000);
    assert!(shown <= all && shown * DOT_BYTES < 30_000 && shown > 0);
}

/// The axis asked for points upward on the sheet of a plane that it lies in; what is drawn tells the plane's coordinates all the same.
#[test]
fn sheets_are_turned_so_that_the_axis_points_upward() {
    let points = row(0.0);
    let lies = |x, y| FrameRecord { origin: [0.0; 3], x, y, flatness: 0.0 };
    let of = |frame: FrameRecord, up: Up| {
        let document = SectionDocument { frame, ..document(&points) };
        (document.draw(ENGLISH, &[], up, 0).into_string(), document)
    };
    let (e, z) = (|k: usize| std::array::from_fn(|i| f64::from(u8::from(i == k))), [0.0, 0.0, -1.0]);
    let cases = [
        // Cut at right angles to y, with z downward in it; at right angles to x; to z.
        (lies(e(0), z), Up::Z, [0.0, -1.0]),
        (lies(e(1), e(2)), Up::Y, [1.0, 0.0]),
        (lies(e(1), e(2)), Up::Z, [0.0, 1.0]),
        (lies(e(0), e(1)), Up::Z, [0.0, 1.0]),
        (lies(e(0), e(1)), Up::Y, [0.0, 1.0]),
        (lies([0.6, 0.0, 0.8], e(1)), Up::Z, [1.0, 0.0]),
        (
            lies([0.6, 0.8, 0.0], [0.48, -0.36, 0.8]),
            Up::Y,
            [0.8 / libm::hypot(0.8, 0.36), -0.36 / libm::hypot(0.8, 0.36)],
        ),
    ];
    for (frame, up, [a, b]) in cases {
        let (page, document) = of(frame, up);
        let told = page.split("data-up=\"").nth(1).map(|t| numbers(t.split('"').next().unwrap()));
        let told = told.unwrap_or(vec![0.0, 1.0]);
        assert!(far([told[0], told[1]], [a, b]) < 1e-12, "{told:?} {a} {b}");
        for (at, join) in attributes(&page, "join g", "data-at").iter().zip(&document.contours[0].joins) {
            let [u, v] = places(&page, at)[0];
            assert!((v - (a * join.point[0] + b * join.point[1])).abs() < 1e-9);
            // As the script reads coordinates.
            assert!(far([b * u + a * v, b * v - a * u], join.point) < 1e-9);
        }
        // Of two places of the plane, the one farther along the axis stands higher.
        let axis = if up == Up::Y { 1 } else { 2 };
        let [along, across] = [[a, b], [b, -a]].map(|p| frame.place(p)[axis]);
        assert!(along > 0.0 || frame.x[axis] == 0.0 && frame.y[axis] == 0.0, "{along}");
        assert!(across.abs() < 1e-12, "{across}");
    }
}

/// Segments astray are drawn apart, and their points do not squash those of the others.
#[test]
fn segments_astray_stand_apart() {
    let mut document = document(&row(0.01));
    let page = drawn(&document, &[], 0);
    assert!(
        !page.contains("astray") && !document.content(ENGLISH).unwrap().list.into_string().contains("astray")
    );
    let one = &mut document.contours[0];
    one.astray = vec![1];
    let greatest = |of: &ContourRecord, own: bool| {
        let all = of.residuals.iter().enumerate().filter(|(i, _)| (of.labels[*i] == 1) == own);
        all.filter(|(i, _)| !of.outliers.contains(&(*i as u64))).map(|(_, r)| r.abs()).fold(0.0, f64::max)
    };
    for i in 0..one.residuals.len() {
        one.residuals[i] *= if one.labels[i] == 1 { 1000.0 } else { 1.0 };
    }
    let others = greatest(one, false);
    assert!(greatest(one, true) > 100.0 * others);
    let page = drawn(&document, &[], 0);
    assert_eq!(page.matches("class=\"segment k-arc astray\"").count(), 1);
    assert_eq!(page.matches("class=\"segment").count(), document.contours[0].segments.len());
    assert!(page.contains("off the points"));
    let svg = page.split("preserveAspectRatio").nth(1).unwrap();
    let range: f64 = svg.split("data-range=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    assert!((range / others - 1.05).abs() < 1e-9, "{range} {others}");
    let dots = svg.split("class=\"dots k-astray\" d=\"").nth(1).unwrap().split('"').next().unwrap();
    let heights: Vec<f64> =
        dots.split('M').skip(1).map(|d| d.split([' ', 'h']).nth(1).unwrap().parse().unwrap()).collect();
    assert_eq!(heights.len(), document.contours[0].labels.iter().filter(|l| **l == 1).count());
    assert!(
        heights.iter().all(|y| y.abs() <= course::COURSE_HALF_HEIGHT)
            && heights.iter().any(|y| y.abs() == course::COURSE_HALF_HEIGHT)
    );
    // Where all are astray there is nothing else to see.
    let all = &mut document.contours[0];
    all.astray = (0..all.segments.len() as u64).collect();
    let most = greatest(all, true).max(greatest(all, false));
    let page = drawn(&document, &[], 0);
    let range = page.split("data-range=\"").nth(1).unwrap().split('"').next().unwrap();
    assert!(range.parse::<f64>().unwrap() >= most);
}

/// What of an outline was measured is drawn by itself, and the rest dashed.
#[test]
fn an_outline_is_dashed_where_it_was_not_measured() {
    // Along the line, from the sixth of its sixty points to the last.
    let points: Vec<[f64; 2]> = row(0.0).into_iter().take(60).skip(5).collect();
    let document = compared(&points, outlines());
    let page = drawn(&document, &flat(&points), 1 << 20);
    let [measured, missed, hole] = attributes(&page, "nominal", "d")[..] else { panic!("{page}") };
    assert_eq!(attributes(&page, "nominal missed", "d"), [missed, hole]);
    let ends = [points[0][0], points[54][0]];
    let line = places(&page, measured);
    assert!(line.len() == 2 && !measured.contains('C'), "{measured}");
    assert!((0..2).all(|k| far(line[k], [ends[k], -500.0]) < 1e-5), "{line:?}");
    let rest = places(&page, missed);
    assert_eq!(missed.matches('M').count(), 2);
    for (n, at) in
        [(0, [1000.0, -500.0]), (1, [ends[0], -500.0]), (2, [ends[1], -500.0]), (3, [1020.0, -500.0])]
    {
        assert!(far(rest[n], at) < 1e-5, "{rest:?}");
    }
    assert!(far(rest[rest.len() - 1], [1000.0, -480.0]) < 1e-5);
    let legend = page.split("sheet-legend").nth(1).unwrap();
    assert!(legend.contains("\"stroke nominal\"") && legend.contains("\"stroke nominal missed\""));
}

/// The record of rows in one plane that holds these outlines.
fn against(rows: &[Vec<[f64; 2]>], outlines: &[Outline]) -> NominalRecord {
    let bare = Contour::default();
    let of = |points: &'_ [[f64; 2]]| off_nominal(points, outlines, &Silent).unwrap();
    let contours =
        rows.iter().map(|points| Against { points, found: of(points), far: 0, contour: &bare }).collect();
    let plane = AgainstPlane { plane: None, outlines: outlines.to_vec(), contours };
    trueness_measure::section::nominal("n.dxf", "drawing", vec![plane])
}

fn circle([x, y]: [f64; 2], r: f64) -> Vec<[f64; 2]> {
    (0..60).map(|i| libm::sincos(TAU * f64::from(i) / 60.0)).map(|(s, c)| [x + r * c, y + r * s]).collect()
}

/// Head, table and legend tell the sign of what the points were measured against: of closed outlines, of open ones, or of both.
#[test]
fn the_sign_is_that_of_what_was_measured() {
    let around = Outline::polyline(&circle([0.0; 2], 20.0), true);
    let open = Outline::polyline(&[[100.0, 0.0], [140.0, 0.0]], false);
    let along: Vec<[f64; 2]> = (0..40).map(|i| [100.5 + f64::from(i), 0.1]).collect();
    let ring = vec![circle([0.0; 2], 20.1)];
    let both = [ring.clone(), vec![along.clone()]].concat();
    let outlines = [around, open];
    for (rows, positive, key) in [
        (ring, Positive::Outside, "nominal.outside"),
        (vec![along], Positive::Left, "nominal.left"),
        (both, Positive::Both, "nominal.outside_or_left"),
    ] {
        let found = against(&rows, &outlines);
        assert_eq!(*found.positive, positive);
        assert!(found.deviations.iter().flatten().flatten().all(|d| *d > 0.0));
        let document = SectionDocument { nominal: Some(found), ..document(&row(0.0)) };
        assert_eq!(document.content(ENGLISH).unwrap().convention, Some(key));
        // So do the heads of the columns.
        assert_eq!(
            document.content(ENGLISH).unwrap().list.into_string().contains("data-t=\"plus\""),
            positive == Positive::Outside
        );
    }
    assert_eq!(document(&row(0.0)).content(ENGLISH).unwrap().convention, Some("sign.section"));
}

/// A hole too many is named with its distance, of the size of the part or of its own; a hole of another size is not; nor are outlines that
/// close. One that nearly does is, with its gap.
#[test]
fn what_makes_deviations_doubtful_is_named() {
    let frame = [[0.0, 0.0], [100.0, 0.0], [100.0, 60.0], [0.0, 60.0]];
    let hole = Outline { segments: vec![Segment::arc([30.0, 30.0], 8.0, 0.0, -TAU)], closed: true };
    let outlines = [Outline::polyline(&frame, true), hole];
    let side: Vec<[f64; 2]> = (0..200).map(|i| [0.5 * f64::from(i), -0.01]).collect();
    let part = |holes: &[([f64; 2], f64)]| -> Vec<Vec<[f64; 2]>> {
        [side.clone()].into_iter().chain(holes.iter().map(|(center, r)| circle(*center, *r))).collect()
    };
    for (holes, least) in [
        (vec![([30.0, 30.0], 8.01)], None),
        (vec![([30.0, 30.0], 5.0)], None),
        (vec![([30.0, 30.0], 8.01), ([70.0, 30.0], 3.0)], Some((27.0, "contour 3 of the part lies"))),
        (vec![([70.0, 4.0], 0.5), ([30.0, 30.0], 8.01)], Some((3.5, "contour 2 of the part lies"))),
    ] {
        let found = against(&part(&holes), &outlines).warnings;
        let Some((least, text)) = least else {
            assert_eq!(found, []);
            continue;
        };
        assert!(found.len() == 1 && found[0].kind == NominalWarningKind::NowhereNear, "{found:?}");
        assert!((found[0].value - least).abs() < 1e-9 && found[0].text.contains(text), "{found:?}");
    }
    let gap = Outline::polyline(&[[0.001, 0.0], [100.0, 0.0], [100.0, 60.0], [0.0, 60.0], [0.0; 2]], false);
    let found = against(&part(&[]), &[gap]).warnings;
    assert!(found.len() == 1 && found[0].kind == NominalWarningKind::NearlyClosed, "{found:?}");
    assert!((found[0].value - 0.001).abs() < 1e-12);
    assert!(found[0].text.contains("contour 1 of the nominal is open by 0.0010 mm at (0.0010, 0.0000)"));
}

/// Of several planes the points farthest off name theirs; a drawing among the files has no points; all of a nominal that is larger by far can
/// be shown.
#[test]
fn planes_and_sizes_are_told() {
    let points = row(0.01);
    let mut document = compared(&points, outlines());
    let frame = FrameRecord::FLAT;
    let plane = PlaneRecord {
        normal: [0.0, 0.0, 1.0],
        offset: 0.0,
        frame,
        contours: 1,
        area: None,
        area_reason: None,
        loose: 0,
        gap: None,
        hint: None,
        fills_area: false,
    };
    let farthest = |document: &SectionDocument| {
        let list = document.content(ENGLISH).unwrap().list.into_string();
        let table = list.split("<table class=\"pick farthest\"").nth(1).unwrap();
        table.split("</table>").next().unwrap().to_string()
    };
    assert!(!farthest(&document).contains("Plane"));
    document.planes = vec![plane.clone(), plane];
    document.contours[0].plane = Some(1);
    assert!(farthest(&document).contains("Plane</span>\u{a0}2"), "{}", farthest(&document));
    let page = drawn(&document, &flat(&points), 1 << 20);
    assert!(!page.contains("data-all"));
    let large = [[900.0, -600.0], [1300.0, -600.0], [1300.0, -300.0], [900.0, -300.0]];
    let page = drawn(&compared(&points, vec![Outline::polyline(&large, true)]), &flat(&points), 1 << 20);
    let all = numbers(attributes(&page, "plan", "data-all")[0]);
    let origin = numbers(attributes(&page, "plan", "data-origin")[0]);
    let [low, high] = [[all[0], all[1] + all[3]], [all[0] + all[2], all[1]]];
    let place = |[x, y]: [f64; 2]| [origin[0] + x, origin[1] - y];
    // The middle and 1.12 times the size of the square.
    assert!(far(place(low), [876.0, -618.0]) < 1e-9 && far(place(high), [1324.0, -282.0]) < 1e-9, "{all:?}");
}
