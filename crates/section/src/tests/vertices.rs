//! Rows of the ends of lines and the vertices of arcs: outlines of random parts, exact to the digits of a file.

use super::*;
use std::f64::consts::{PI, TAU};

/// A corner of an outline, and the radius it is rounded by; 0: it is sharp. Or an arc over the way to the next corner.
#[derive(Clone, Copy)]
struct Corner {
    at: [f64; 2],
    radius: f64,
    /// Sweep of the way to the next corner, positive to the left; 0 of a line.
    sweep: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Made {
    pub what: &'static str,
    /// Ends and radius (0 of a line) of each segment.
    truth: Vec<([f64; 2], [f64; 2], f64)>,
    pub points: Vec<[f64; 2]>,
    closed: bool,
    step: f64,
}

fn unit(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let d = far(a, b);
    [(b[0] - a[0]) / d, (b[1] - a[1]) / d]
}

/// `count` points of an arc, without the first.
fn arc(from: [f64; 2], to: [f64; 2], sweep: f64, count: usize) -> (Vec<[f64; 2]>, f64) {
    let chord = far(from, to);
    let radius = 0.5 * chord / libm::sin(0.5 * sweep.abs());
    let u = unit(from, to);
    let up = 0.5 * chord / libm::tan(0.5 * sweep);
    let center = [0.5 * (from[0] + to[0]) - up * u[1], 0.5 * (from[1] + to[1]) + up * u[0]];
    let start = libm::atan2(from[1] - center[1], from[0] - center[0]);
    let place = |i: usize| {
        let (s, c) = libm::sincos(start + sweep * i as f64 / (count - 1) as f64);
        [center[0] + radius * c, center[1] + radius * s]
    };
    ((1..count).map(place).collect(), radius)
}

/// The outline of corners; `counts` tells how many points an arc of this sweep has, and whether it is tangent at both ends.
fn outline(corners: &[Corner], mut counts: impl FnMut(f64, bool) -> usize) -> Made {
    let n = corners.len();
    let mut made = Made { what: "", truth: vec![], points: vec![], closed: true, step: 0.0 };
    let cut = |k: usize| {
        let (a, b, c) = (corners[(k + n - 1) % n].at, corners[k].at, corners[(k + 1) % n].at);
        let (u, v) = (unit(a, b), unit(b, c));
        let turn = libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
        let t = corners[k].radius * libm::tan(0.5 * turn.abs());
        (turn, [0, 1].map(|i| b[i] - t * u[i]), [0, 1].map(|i| b[i] + t * v[i]))
    };
    let mut add = |from: [f64; 2], to: [f64; 2], sweep: f64, tangent: bool| {
        if far(from, to) < 1e-9 {
            return;
        }
        if made.points.is_empty() {
            made.points.push(from);
        }
        let mut radius = 0.0;
        if sweep == 0.0 {
            made.points.push(to);
        } else {
            let (points, r) = arc(from, to, sweep, counts(sweep, tangent));
            (radius, _) = (r, made.points.extend(points));
        }
        made.truth.push((from, to, radius));
    };
    for k in 0..n {
        let (turn, from, to) = cut(k);
        if corners[k].radius > 0.0 {
            add(from, to, turn, true);
        }
        let (_, next, _) = cut((k + 1) % n);
        add(to, next, corners[k].sweep, corners[k].sweep.abs() == PI);
    }
    made.points.pop();
    made
}

fn sharp(at: [f64; 2]) -> Corner {
    Corner { at, radius: 0.0, sweep: 0.0 }
}

/// Random outlines. At least four wide chords tell an arc that is not tangent at both ends from sides of a polygon.
pub(super) fn made(random: &mut Random) -> Made {
    let mut between = |a: f64, b: f64| a + (b - a) * random.unit();
    let (w, h) = (between(12.0, 60.0), between(8.0, 30.0));
    let even = between(0.0, 1.0) < 0.5;
    let (fixed, picks) =
        (between(3.0, 20.99) as usize, (0..40).map(|_| between(3.0, 20.99) as usize).collect::<Vec<_>>());
    let mut next = 0;
    let counts = move |sweep: f64, tangent: bool| {
        next += 1;
        let picked = if even { fixed } else { picks[next % 40] };
        let wide = (sweep.abs() / (0.5 * PI) - 1e-9).ceil() as usize + 1;
        picked.max(wide).max(if tangent { 3 } else { 5 })
    };
    let rectangle = [[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]];
    let (what, corners): (_, Vec<Corner>) = match between(0.0, 8.0) as usize {
        0 => {
            let r = between(0.05, 0.45) * w.min(h);
            ("rounded rectangle", rectangle.map(|at| Corner { radius: r, ..sharp(at) }).to_vec())
        }
        1 => {
            let radii = [0; 4].map(|_| between(0.05, 0.45) * w.min(h));
            let corner = |k: usize| Corner { radius: radii[k], ..sharp(rectangle[k]) };
            ("four radii", (0..4).map(corner).collect())
        }
        2 => {
            let round = |at| Corner { sweep: PI, ..sharp(at) };
            ("obround", vec![sharp([0.0, 0.0]), round([w, 0.0]), sharp([w, h]), round([0.0, h])])
        }
        3 => {
            let sweep = between(1.2, 4.8);
            ("segment of a disc", vec![Corner { sweep, ..sharp([0.0, -h]) }, sharp([0.0, h])])
        }
        4 => {
            // A curved slot: two arcs about one center, and half circles tangent to them.
            let (r, half, sweep) = (between(10.0, 30.0), between(1.0, 4.0), between(0.7, 2.8));
            let at = |r: f64, a: f64| [r * libm::cos(a), r * libm::sin(a)];
            let (o, i) = (r + half, r - half);
            let c = |at, sweep| Corner { at, radius: 0.0, sweep };
            (
                "curved slot",
                vec![c(at(o, 0.0), sweep), c(at(o, sweep), PI), c(at(i, sweep), -sweep), c(at(i, 0.0), PI)],
            )
        }
        5 => {
            // A bracket; some corners are rounded, one of them inward.
            let (x, y) = (between(0.3, 0.7) * w, between(0.3, 0.7) * h);
            let all = [[0.0, 0.0], [w, 0.0], [w, y], [x, y], [x, h], [0.0, h]];
            let most = 0.4 * x.min(y).min(w - x).min(h - y);
            let radii = [0; 6].map(|_| if between(0.0, 1.0) < 0.6 { between(0.2, 1.0) * most } else { 0.0 });
            let radii = if radii.iter().all(|r| *r == 0.0) { [most; 6] } else { radii };
            ("bracket", (0..6).map(|k| Corner { radius: radii[k], ..sharp(all[k]) }).collect())
        }
        6 => {
            // A plate with a round notch or bump in one side.
            let (a, r) = (between(0.3, 0.6) * w, between(0.1, 0.3) * w.min(h));
            let sweep = between(1.0, PI) * if between(0.0, 1.0) < 0.7 { -1.0 } else { 1.0 };
            let notch = [Corner { sweep, ..sharp([a - r, 0.0]) }, sharp([a + r, 0.0])];
            (
                "notch",
                notch
                    .into_iter()
                    .chain(rectangle[1..].iter().map(|at| sharp(*at)))
                    .chain([sharp([0.0, 0.0])])
                    .collect(),
            )
        }
        _ => {
            // Two arcs that meet in corners: a lens, or a crescent with cusps.
            let (a, b) = (between(1.0, 2.9), between(0.6, 2.6));
            let b = if between(0.0, 1.0) < 0.5 { b } else { -0.6 * a.min(b) };
            (
                "two arcs",
                vec![Corner { sweep: a, ..sharp([0.0, -h]) }, Corner { sweep: b, ..sharp([0.0, h]) }],
            )
        }
    };
    as_a_file(Made { what, ..outline(&corners, counts) }, random)
}

/// The same as a file may hold it: in decimals, from any start, either way round, perhaps open.
fn as_a_file(made: Made, random: &mut Random) -> Made {
    let mut between = |a: f64, b: f64| a + (b - a) * random.unit();
    let step = 10.0_f64.powi(-(between(3.0, 6.99) as i32));
    let turn = if between(0.0, 1.0) < 0.5 { 0.0 } else { between(0.0, 6.0) };
    let (reversed, open) = (between(0.0, 1.0) < 0.5, between(0.0, 1.0) < 0.25);
    finished(made, turn, reversed, open, between(0.0, 1.0), step)
}

/// Turned, rounded, started elsewhere, run the other way round, or without its last segment.
fn finished(made: Made, turn: f64, reversed: bool, open: bool, start: f64, step: f64) -> Made {
    let (s, c) = libm::sincos(turn);
    let place = |p: [f64; 2]| {
        [12.3 + c * p[0] - s * p[1], s * p[0] + c * p[1] - 4.5].map(|x| {
            let decimals = (1.0 / step).round();
            (x * decimals).round() / decimals
        })
    };
    let mut points: Vec<[f64; 2]> = made.points.iter().map(|p| place(*p)).collect();
    let mut truth: Vec<_> = made.truth.iter().map(|(a, b, r)| (place(*a), place(*b), *r)).collect();
    if open && truth.len() > 2 {
        let (from, ..) = truth.pop().unwrap();
        let last = points.iter().position(|p| *p == from).unwrap();
        points.truncate(last + 1);
    } else {
        let by = (start * points.len() as f64) as usize;
        points.rotate_left(by);
    }
    if reversed {
        points.reverse();
        truth = truth.into_iter().rev().map(|(a, b, r)| (b, a, r)).collect();
    }
    Made { truth, points, step, closed: !(open && made.truth.len() > 2), ..made }
}

/// Whether a contour is the truth: kinds, ends and radii, as well as digits tell them.
fn right(made: &Made, contour: &Contour) -> bool {
    let n = made.truth.len();
    let near = |a: [f64; 2], b: [f64; 2]| far(a, b) <= 4.0 * made.step;
    let same = |s: &Segment, t: &([f64; 2], [f64; 2], f64)| {
        near(s.start, t.0)
            && near(s.end, t.1)
            && match s.geometry {
                Geometry::Arc { radius, sweep, .. } => {
                    let sagitta = radius * (1.0 - libm::cos(0.5 * sweep.abs().min(PI)));
                    t.2 > 0.0 && (radius - t.2).abs() <= t.2 * (4.0 * made.step / sagitta + 1e-9)
                }
                Geometry::Line => t.2 == 0.0,
                Geometry::Spline { .. } => false,
            }
    };
    contour.closed == made.closed
        && contour.segments.len() == n
        && (0..n).any(|k| (0..n).all(|i| same(&contour.segments[i], &made.truth[(i + k) % n])))
}

/// How many of random outlines are right, told as doubtful, and wrong without a word.
fn rates(count: usize, seed: u64, mut each: impl FnMut(&Made, &Contour)) -> [usize; 3] {
    let random = &mut Random::new(seed);
    let mut rates = [0; 3];
    for _ in 0..count {
        let made = made(random);
        let options = Options { closed: Some(made.closed), ..Options::default() };
        let Ok(contour) = contour(&made.points, &options, &Silent) else {
            rates[1] += 1;
            continue;
        };
        let kind = if right(&made, &contour) {
            0
        } else if !contour.unreliable.is_empty() {
            1
        } else {
            2
        };
        rates[kind] += 1;
        if kind > 0 {
            each(&made, &contour);
        }
    }
    rates
}

#[test]
fn outlines_by_vertices_are_right() {
    let count = 60;
    let mut all = std::collections::BTreeMap::<&str, usize>::new();
    let found = rates(count, 1, |made, contour| {
        *all.entry(made.what).or_default() += 1;
        let (n, step) = (made.points.len(), made.step);
        let truth: Vec<_> = made.truth.iter().map(|t| (far(t.0, t.1), t.2)).collect();
        let found_segments: Vec<_> =
            contour.segments.iter().map(|s| (s.geometry.kind(), s.length, s.count)).collect();
        println!(
            "{} {n} {step} unreliable {:?}: {truth:?}\n  {found_segments:?}",
            made.what, contour.unreliable
        );
    });
    println!("{found:?} {all:?}");
    assert_eq!(found[2], 0);
    assert!(20 * found[0] >= 19 * count);
}

/// Circles by even, uneven or too few points, polygons that scatter and symmetric curves are no outlines of lines and arcs.
#[test]
fn other_rows_are_no_outlines() {
    let random = &mut Random::new(3);
    for k in 0..600 {
        let mut between = |a: f64, b: f64| a + (b - a) * random.unit();
        let (n, r, first) = (between(5.0, 60.99) as usize, between(5.0, 40.0), between(0.0, TAU));
        let (step, missing) = (between(0.1, 0.9), between(0.0, n as f64) as usize);
        let at = |a: f64| [r * libm::cos(a + first), r * libm::sin(a + first)];
        let even = |i: usize| at(TAU * i as f64 / n as f64);
        let points: Vec<[f64; 2]> = match k % 6 {
            0 => (0..n).map(even).collect(),
            1 => (0..n).map(|i| at(TAU * (i as f64 + between(0.0, 0.3)) / n as f64)).collect(),
            2 => (0..).map(|i| step * f64::from(i)).take_while(|a| *a < TAU - 1e-3).map(at).collect(),
            3 => (0..n).filter(|i| *i != missing).map(even).collect(),
            4 => {
                let sides = 4 + n % 6;
                let round = (0..sides).map(|i| at(TAU * i as f64 / sides as f64));
                round.map(|p| p.map(|x| x + 0.003 * normal(random))).collect()
            }
            _ => (0..n)
                .map(|i| libm::sincos(TAU * i as f64 / n as f64))
                .map(|(s, c)| [r * c, 0.5 * r * s])
                .collect(),
        };
        let decimals = [1e3, 1e4, 1e6][k / 6 % 3];
        let points: Vec<[f64; 2]> =
            points.iter().map(|p| p.map(|x| (x * decimals).round() / decimals)).collect();
        let found = crate::row::vertices::vertices(&points, &points, true, false);
        assert!(found.is_none(), "{k} {n}: {:?}", found.map(|v| v.items));
    }
}
