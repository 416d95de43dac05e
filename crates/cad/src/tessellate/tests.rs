//! Facets are closed, look outward, and keep to their bounds.

use super::*;
use crate::brep::Bounds;
use crate::curve::Span;
use crate::frame::Frame;
use crate::measure::Integrals;
use crate::surface::{Surface, SurfaceFeet};
use crate::trim::tests::{Made, circle, drum, frame, line};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use trueness_geom::progress::Silent;
use trueness_geom::space::{cross, dot, minus, norm, plus, times};
use trueness_geom::spline::{basis::Knots, surface::Nurbs};

fn tessellated(made: &Made, distance: f64) -> (Tessellation, Vec<Trim>) {
    let trims: Vec<Trim> = made.brep.faces.iter().map(|f| Trim::new(&made.brep, f, 0.0).unwrap()).collect();
    let all: Vec<Option<&Trim>> = trims.iter().map(Some).collect();
    let fineness = Fineness { distance, angle: 0.6 };
    let made = Tessellation::new(&made.brep, &all, fineness, 2_000_000, &Silent).unwrap();
    (made, trims)
}

/// Volume and area.
fn sizes(mesh: &Mesh) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for f in &mesh.faces {
        let [a, b, c] = f.map(|v| mesh.positions[v as usize]);
        let n = cross(minus(b, a), minus(c, a));
        sum[0] += dot(a, n) / 6.0;
        sum[1] += 0.5 * norm(n);
    }
    sum
}

fn assert_closed(mesh: &Mesh, what: &str) {
    let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    for f in &mesh.faces {
        for i in 0..3 {
            let [a, b] = [f[i], f[(i + 1) % 3]];
            assert_ne!(a, b, "{what}");
            *sides.entry([a, b]).or_default() += 1;
        }
    }
    for ([a, b], n) in &sides {
        assert_eq!(*n, 1, "{what}: {a} {b} {:?}", mesh.positions[*a as usize]);
        assert!(
            sides.contains_key(&[*b, *a]),
            "{what}: {a} {b} {:?} {:?}",
            mesh.positions[*a as usize],
            mesh.positions[*b as usize]
        );
    }
}

/// Facets keep to their bounds: places of them are no farther from the surface.
fn assert_within(made: &Tessellation, trims: &[Trim], distance: f64, what: &str) {
    assert!(made.failed.is_empty(), "{what} {:?}", made.failed);
    let feet: Vec<SurfaceFeet> = trims.iter().map(|t| SurfaceFeet::new(t.chart.surface())).collect();
    for (n, (f, face)) in made.mesh.faces.iter().zip(&made.faces).enumerate() {
        let trim = &trims[*face as usize];
        let bound = made.bounds[*face as usize].unwrap();
        assert!(
            bound.distance <= 1.01 * distance + 3.0 * trim.gap && bound.is_proven,
            "{what} {face} {bound:?}"
        );
        let corners = f.map(|v| made.mesh.positions[v as usize]);
        for (p, at) in corners.iter().zip(&made.parameters[n]) {
            let on = trim.chart.place(*at);
            assert!(norm(minus(on, *p)) <= 1e-9 + 2.0 * trim.gap, "{what} {face} {on:?} {p:?}");
        }
        if n % 7 == 0 {
            for weights in [[0.33, 0.33, 0.34], [0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]] {
                let p = (0..3).fold([0.0; 3], |s, i| plus(s, times(weights[i], corners[i])));
                let off = feet[*face as usize].nearest(p).distance;
                assert!(off <= bound.distance + 1e-12, "{what} {face} {off} {bound:?}");
            }
        }
    }
}

fn assert_solid(made: &Made, what: &str) {
    let exact = made
        .brep
        .faces
        .iter()
        .map(|f| Integrals::of(&Trim::new(&made.brep, f, 0.0).unwrap(), [0.0; 3]))
        .reduce(|a, b| a.plus(&b))
        .unwrap();
    let mut before = f64::INFINITY;
    for distance in [0.1, 0.01, 0.001] {
        let (facets, trims) = tessellated(made, distance);
        let what = format!("{what} {distance} {}", facets.mesh.faces.len());
        assert_within(&facets, &trims, distance, &what);
        assert_closed(&facets.mesh, &what);
        let [volume, area] = sizes(&facets.mesh);
        assert!(volume > 0.0, "{what}");
        assert!(
            (volume - exact.volume).abs() <= 1.05 * distance * exact.area,
            "{what} {volume} {}",
            exact.volume
        );
        // By the square of the size of facets, which is the distance.
        let off = (area - exact.area).abs();
        assert!(off < 0.5 * before || off < 1e-9 * exact.area, "{what} {off} {before}");
        before = off;
    }
}

#[test]
fn drums_are_closed_however_their_edges_start() {
    for (seed, height) in [(0, 3.0), (1, 0.01), (2, 200.0), (3, 1.0)] {
        assert_solid(&drum(&frame(seed), 2.0, height, 0.4 * seed as f64), &format!("drum {height}"));
    }
}

#[test]
fn cones_end_in_one_vertex() {
    let base = frame(3);
    let mut made = Made::default();
    let rim = made.edge(circle(&base, 0.0, 2.0, 1.0));
    let half_angle = -f64::atan(2.0 / 3.0);
    made.face(Surface::Cone { frame: base, radius: 2.0, half_angle }, false, &[&[(rim, false)]]);
    made.face(Surface::Plane(base), true, &[&[(rim, true)]]);
    assert_solid(&made, "cone");
}

#[test]
fn spheres_whole_and_cut_are_closed() {
    let base = frame(4);
    let mut made = Made::default();
    made.face(Surface::Sphere { frame: base, radius: 2.0 }, false, &[]);
    assert_solid(&made, "sphere");
    for (axis, h) in
        [([0.0, 0.0, 1.0], 0.3), ([1.0, 0.0, 0.0], -1.2), ([0.3, 0.4, 0.1], 0.9), ([0.3, 0.1, 0.9], -0.4)]
    {
        let r = 2.0;
        let other = Frame::new(base.origin, base.vector(axis), None).unwrap();
        let mut made = Made::default();
        let rim = made.edge(circle(&base, h, f64::sqrt(r * r - h * h), 0.7));
        let top = Frame { origin: base.place([0.0, 0.0, h]), ..base };
        made.face(Surface::Sphere { frame: other, radius: r }, false, &[&[(rim, false)]]);
        made.face(Surface::Plane(top), true, &[&[(rim, true)]]);
        assert_solid(&made, &format!("cap {axis:?} {h}"));
    }
}

#[test]
fn tori_are_closed() {
    let base = frame(5);
    for (major, minor) in [(3.0, 1.0), (1.0, 1.0), (1.0, 2.0), (-1.0, 2.0)] {
        let mut made = Made::default();
        made.face(Surface::Torus { frame: base, major, minor }, false, &[]);
        assert_solid(&made, &format!("torus {major} {minor}"));
    }
    let mut made = Made::default();
    let (major, minor) = (3.0, 1.0);
    let tube = |u: f64| {
        let x = base.vector([f64::cos(u), f64::sin(u), 0.0]);
        let origin = plus(base.origin, times(major, x));
        Frame::new(origin, cross(x, base.axes[2]), Some(x)).unwrap()
    };
    let a = made.edge(circle(&tube(1.0), 0.0, minor, 0.3));
    let b = made.edge(circle(&tube(1.0 + PI), 0.0, minor, 0.9));
    made.face(Surface::Torus { frame: base, major, minor }, false, &[&[(a, true)], &[(b, false)]]);
    made.face(Surface::Plane(tube(1.0)), false, &[&[(a, false)]]);
    made.face(Surface::Plane(tube(1.0 + PI)), true, &[&[(b, true)]]);
    assert_solid(&made, "half a torus");
}

#[test]
fn boxes_with_bores_are_closed() {
    let base = frame(6);
    let mut made = Made::default();
    let at = |i: usize, z: f64| {
        let (x, y) = [(-2.0, -1.5), (2.0, -1.5), (2.0, 1.5), (-2.0, 1.5)][i % 4];
        base.place([x, y, z])
    };
    let (h, r) = (1.0, 1.2);
    let low: Vec<u32> = (0..4).map(|i| made.edge(line(at(i, 0.0), at(i + 1, 0.0)))).collect();
    let high: Vec<u32> = (0..4).map(|i| made.edge(line(at(i, h), at(i + 1, h)))).collect();
    let up: Vec<u32> = (0..4).map(|i| made.edge(line(at(i, 0.0), at(i, h)))).collect();
    let (bore_low, bore_high) = (made.edge(circle(&base, 0.0, r, 1.0)), made.edge(circle(&base, h, r, 2.0)));
    let top = Frame { origin: base.place([0.0, 0.0, h]), ..base };
    let around = |edges: &[u32], reversed: bool| -> Vec<(u32, bool)> {
        let all = edges.iter().map(|e| (*e, reversed));
        if reversed { all.rev().collect() } else { all.collect() }
    };
    made.face(Surface::Plane(top), false, &[&around(&high, false), &[(bore_high, true)]]);
    made.face(Surface::Plane(base), true, &[&[(bore_low, false)], &around(&low, true)]);
    made.face(
        Surface::Cylinder { frame: base, radius: r },
        true,
        &[&[(bore_low, true)], &[(bore_high, false)]],
    );
    for i in 0..4 {
        let along = minus(at(i + 1, 0.0), at(i, 0.0));
        let side = Frame::new(at(i, 0.0), cross(along, base.axes[2]), Some(along)).unwrap();
        made.face(
            Surface::Plane(side),
            false,
            &[&[(low[i], false), (up[(i + 1) % 4], false), (high[i], true), (up[i], true)]],
        );
    }
    let exact = made
        .brep
        .faces
        .iter()
        .map(|f| Integrals::of(&Trim::new(&made.brep, f, 0.0).unwrap(), [0.0; 3]).volume)
        .sum::<f64>();
    assert!((exact - (12.0 - PI * r * r)).abs() < 1e-10, "{exact}");
    assert_solid(&made, "box with a bore");
}

#[test]
fn too_many_facets_are_told_with_the_tolerance_that_would_do() {
    let mut made = Made::default();
    made.face(Surface::Sphere { frame: frame(7), radius: 2.0 }, false, &[]);
    let trim = Trim::new(&made.brep, &made.brep.faces[0], 0.0).unwrap();
    let fineness = Fineness { distance: 1e-6, angle: 1.0 };
    let error = Tessellation::new(&made.brep, &[Some(&trim)], fineness, 10_000, &Silent).unwrap_err();
    let TessellateError::TooMany { tolerance, .. } = error else { panic!("{error}") };
    let fineness = Fineness { distance: tolerance, angle: 1.0 };
    assert!(Tessellation::new(&made.brep, &[Some(&trim)], fineness, 10_000, &Silent).is_ok());
}

#[test]
fn rectangles_close_where_their_surface_does() {
    let base = frame(8);
    for (surface, sides) in [
        (Surface::Sphere { frame: base, radius: 2.0 }, [[0.0, TAU], [-0.5 * PI, 0.5 * PI]]),
        (Surface::Torus { frame: base, major: 3.0, minor: 1.0 }, [[1.0, 1.0 + TAU], [-1.0, TAU - 1.0]]),
    ] {
        let mut made = Made::default();
        let mut face = made.face(surface, false, &[]);
        face.bounds = Bounds::Rectangle(sides);
        made.brep.faces[0] = face;
        assert_solid(&made, "rectangle");
    }
}

/// A ribbon along a helix, as the flank of a thread: cubic along it, straight across. Its own sides are its edges.
fn ribbon(turns: usize) -> Made {
    let per_turn = 12;
    let spans = per_turn * turns;
    let place = |i: usize, radius: f64| {
        let angle = TAU * i as f64 / per_turn as f64;
        [radius * angle.cos(), radius * angle.sin(), angle / TAU]
    };
    let points: Vec<([f64; 3], f64)> =
        (0..spans + 3).flat_map(|i| [4.0, 5.0].map(|r| (place(i, r), 1.0))).collect();
    let knots = [Knots::uniform(3, spans, 0.0, 1.0), Knots::uniform(1, 1, 0.0, 1.0)];
    let surface = Surface::Spline(Box::new(Nurbs::weighted(knots, &points).unwrap()));
    let mut made = Made::default();
    let side = |held: usize, at: f64| Span { curve: surface.iso_curve(held, at).unwrap(), range: [0.0, 1.0] };
    let [low, right, high, left] =
        [(1, 0.0), (0, 1.0), (1, 1.0), (0, 0.0)].map(|(held, at)| made.edge(side(held, at)));
    made.face(surface, false, &[&[(low, false), (right, false), (high, true), (left, true)]]);
    made
}

#[test]
fn threads_need_few_facets_beyond_the_places_of_their_edges() {
    let made = ribbon(4);
    for distance in [0.02, 0.002, 0.0005] {
        let (facets, trims) = tessellated(&made, distance);
        assert_within(&facets, &trims, distance, &format!("thread {distance}"));
        let places: usize = facets.edges.iter().map(|edge| edge.shares.len()).sum();
        let count = facets.mesh.faces.len();
        assert!(count <= 6 * places, "{distance}: {count} facets, {places} places");
    }
}

/// A cylinder written as a spline needs no more facets along its axis however long it is.
#[test]
fn long_cylinders_as_splines_have_few_facets() {
    let w = f64::sqrt(0.5);
    let arc = |z: f64| [([2.0, 0.0, z], 1.0), ([2.0, 2.0, z], w), ([0.0, 2.0, z], 1.0)];
    for length in [1.0, 1000.0] {
        let knots = [Knots::uniform(1, 1, 0.0, length), Knots::uniform(2, 1, 0.0, 1.0)];
        let nurbs = Nurbs::weighted(knots, &[arc(0.0), arc(length)].concat()).unwrap();
        let surface = Surface::Spline(Box::new(nurbs));
        let mut made = Made::default();
        let side = |held: usize, at: f64| {
            let range = if held == 1 { [0.0, length] } else { [0.0, 1.0] };
            Span { curve: surface.iso_curve(held, at).unwrap(), range }
        };
        let [low, right, high, left] =
            [(1, 0.0), (0, length), (1, 1.0), (0, 0.0)].map(|(held, at)| made.edge(side(held, at)));
        made.face(surface, false, &[&[(low, false), (right, false), (high, true), (left, true)]]);
        let (facets, trims) = tessellated(&made, 0.001);
        assert_within(&facets, &trims, 0.001, &format!("cylinder {length}"));
        assert!(facets.mesh.faces.len() < 300, "{length}: {}", facets.mesh.faces.len());
    }
}

/// Says stop at the question of that number, and counts the questions.
struct StopsAt {
    asked: std::sync::atomic::AtomicUsize,
    last: usize,
}

impl StopsAt {
    fn new(last: usize) -> StopsAt {
        StopsAt { asked: 0.into(), last }
    }
    fn asked(&self) -> usize {
        self.asked.load(std::sync::atomic::Ordering::Relaxed)
    }
}

impl Progress for StopsAt {
    fn cancelled(&self) -> bool {
        self.asked.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1 >= self.last
    }
}

/// Each thread asks once more at most; between two questions lie some hundred facets, or a face that is taken apart.
#[test]
fn long_threads_stop_when_they_are_asked_to() {
    let made = ribbon(6);
    let trim = Trim::new(&made.brep, &made.brep.faces[0], 0.0).unwrap();
    let fineness = Fineness { distance: 1e-3, angle: 0.6 };
    let tessellate = |progress: &StopsAt| {
        Tessellation::new(&made.brep, &[Some(&trim)], fineness, 10_000_000, progress)
            .map(|t| t.mesh.faces.len())
    };
    let all = StopsAt::new(usize::MAX);
    let facets = tessellate(&all).unwrap();
    assert!(facets < 1024 * all.asked(), "{facets} facets, {} questions", all.asked());
    let some = StopsAt::new(all.asked() / 2);
    assert!(matches!(tessellate(&some), Err(TessellateError::Cancelled(_))));
    assert!(some.asked() <= all.asked() / 2 + 2, "{}", some.asked());
    let prepare =
        |progress: &StopsAt| crate::search::Search::watched(&made.brep, vec![Some(trim.clone())], progress);
    assert!(prepare(&StopsAt::new(1)).is_err() && prepare(&StopsAt::new(3)).is_err());
    assert!(prepare(&StopsAt::new(usize::MAX)).is_ok());
}
