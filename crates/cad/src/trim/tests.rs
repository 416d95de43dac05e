//! Faces as files give them: with and without seams, around and not, over poles.

use super::*;
use crate::brep::{Edge, EdgeUse, Vertex};
use crate::curve::Curve;
use crate::frame::Frame;
use crate::surface::Surface;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_geom::num::random::Random;

pub(crate) fn frame(seed: u64) -> Frame {
    let mut random = Random::new(seed);
    let mut vector = || [0, 1, 2].map(|_| 2.0 * random.unit() - 1.0);
    Frame::new(vector().map(|x| 5.0 * x), vector(), Some(vector())).unwrap()
}

pub(crate) fn circle(frame: &Frame, height: f64, radius: f64, start: f64) -> Span {
    let origin = frame.place([0.0, 0.0, height]);
    Span { curve: Curve::Circle { frame: Frame { origin, ..*frame }, radius }, range: [start, start + TAU] }
}

pub(crate) fn line(a: Point, b: Point) -> Span {
    let direction = trueness_geom::space::minus(b, a);
    Span { curve: Curve::Line { origin: a, direction }, range: [0.0, 1.0] }
}

/// A part of edges that are not joined to others, and faces of loops of (edge, reversed).
#[derive(Default)]
pub(crate) struct Made {
    pub brep: Brep,
}

impl Made {
    pub fn edge(&mut self, span: Span) -> u32 {
        let [a, b] = span.ends();
        let mut vertex = |p: Point| {
            let near =
                |v: &Vertex| trueness_geom::space::norm(trueness_geom::space::minus(v.place, p)) < 1e-9;
            let at = self.brep.vertices.iter().position(near).unwrap_or_else(|| {
                self.brep.vertices.push(Vertex { place: p });
                self.brep.vertices.len() - 1
            });
            at as u32
        };
        let vertices = [vertex(a), vertex(b)];
        self.brep.edges.push(Edge { span, vertices, entity: 0 });
        self.brep.edges.len() as u32 - 1
    }

    pub fn face(&mut self, surface: Surface, reversed: bool, loops: &[&[(u32, bool)]]) -> Face {
        let uses = |l: &&[(u32, bool)]| {
            Loop::Edges(
                l.iter().map(|(edge, reversed)| EdgeUse { edge: *edge, reversed: *reversed }).collect(),
            )
        };
        let bounds = Bounds::Loops(loops.iter().map(uses).collect());
        let face =
            Face { surface, reversed, bounds, entity: 0, name: String::new(), color: None, instance: 0 };
        self.brep.faces.push(face.clone());
        face
    }
}

/// A cylinder with caps, turned by `turn` about its axis, on both ends cut at right angles.
pub(crate) fn drum(frame: &Frame, radius: f64, height: f64, start: f64) -> Made {
    let mut made = Made::default();
    let low = made.edge(circle(frame, 0.0, radius, start));
    let high = made.edge(circle(frame, height, radius, -start));
    let top = Frame { origin: frame.place([0.0, 0.0, height]), ..*frame };
    made.face(Surface::Cylinder { frame: *frame, radius }, false, &[&[(low, false)], &[(high, true)]]);
    made.face(Surface::Plane(top), false, &[&[(high, false)]]);
    made.face(Surface::Plane(*frame), true, &[&[(low, true)]]);
    made
}

fn parameter_area(trim: &Trim) -> f64 {
    trim.outline.area()
}

#[test]
fn a_band_of_a_cylinder_needs_no_seam() {
    for start in [0.0, 1.0, 4.0, -2.5] {
        let frame = frame(1);
        let mut made = Made::default();
        let low = made.edge(circle(&frame, 0.0, 2.0, start));
        let high = made.edge(circle(&frame, 3.0, 2.0, 0.3 * start));
        let surface = Surface::Cylinder { frame, radius: 2.0 };
        let face = made.face(surface.clone(), false, &[&[(low, false)], &[(high, true)]]);
        let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
        assert!((parameter_area(&trim) - 3.0 * TAU).abs() < 1e-9);
        assert!(trim.gap < 1e-14);
        for (u, v, inside) in
            [(0.0, 1.0, true), (17.0, 2.9, true), (-40.0, 3.1, false), (1.0, -0.1, false), (9.0, 0.0, true)]
        {
            assert_eq!(trim.contains([u, v]), inside, "{u} {v}");
        }
        // With a seam, used twice.
        let seam = made.edge(line(frame.place([2.0, 0.0, 0.0]), frame.place([2.0, 0.0, 3.0])));
        let face =
            made.face(surface.clone(), false, &[&[(low, false), (seam, false), (high, true), (seam, true)]]);
        let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
        assert!((parameter_area(&trim) - 3.0 * TAU).abs() < 1e-9);
        // Inside out: as a bore.
        let face = made.face(surface.clone(), true, &[&[(low, true)], &[(high, false)]]);
        assert!(Trim::new(&made.brep, &face, 0.0).is_ok());
        // Both circles the same way around: only the band between them bounds an area.
        for reversed in [false, true] {
            let face = made.face(surface.clone(), false, &[&[(low, reversed)], &[(high, reversed)]]);
            let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
            assert!(trim.turned && (parameter_area(&trim) - 3.0 * TAU).abs() < 1e-9);
        }
        // The band outside of them: gone along the other way, and told.
        let face = made.face(surface, false, &[&[(low, true)], &[(high, false)]]);
        let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
        assert!(trim.turned && (parameter_area(&trim) - 3.0 * TAU).abs() < 1e-9);
    }
}

#[test]
fn caps_reach_the_pole_that_their_direction_says() {
    let frame = frame(2);
    let mut made = Made::default();
    let (r, h) = (2.0, 0.7);
    let ring = made.edge(circle(&frame, h, f64::sqrt(r * r - h * h), 1.0));
    let latitude = f64::asin(h / r);
    let surface = Surface::Sphere { frame, radius: r };
    for (reversed, area) in [(false, FRAC_PI_2 - latitude), (true, FRAC_PI_2 + latitude)] {
        let face = made.face(surface.clone(), false, &[&[(ring, reversed)]]);
        let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
        assert!((parameter_area(&trim) - TAU * area).abs() < 1e-9);
        assert_eq!(trim.contains([1.0, 1.5]), !reversed);
        assert_eq!(trim.contains([8.0, -1.5]), reversed);
    }
    // The same through another sphere whose axis lies in the plane of the circle, or anywhere.
    for axis in [[1.0, 0.0, 0.0], [0.3, 0.4, 0.1], [0.0, 0.6, 0.05]] {
        let other = Frame::new(frame.origin, frame.vector(axis), None).unwrap();
        let surface = Surface::Sphere { frame: other, radius: r };
        for reversed in [false, true] {
            let face = made.face(surface.clone(), false, &[&[(ring, reversed)]]);
            let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
            let above = |z: f64| {
                let s = f64::sqrt(r * r - z * z);
                trim.chart.parameters(frame.place([s * 0.6, s * 0.8, z]), None)
            };
            for z in [-1.9, 0.0, 0.69, 0.71, 1.9] {
                assert_eq!(trim.contains(above(z)), (z > h) != reversed, "{axis:?} {z}");
            }
        }
    }
}

#[test]
fn whole_surfaces_have_no_loops() {
    let frame = frame(3);
    let mut made = Made::default();
    let sphere = made.face(Surface::Sphere { frame, radius: 2.0 }, false, &[]);
    let trim = Trim::new(&made.brep, &sphere, 0.0).unwrap();
    assert!((parameter_area(&trim) - TAU * PI).abs() < 1e-12);
    let torus = made.face(Surface::Torus { frame, major: 2.0, minor: 0.5 }, false, &[]);
    let trim = Trim::new(&made.brep, &torus, 0.0).unwrap();
    assert!((parameter_area(&trim) - TAU * TAU).abs() < 1e-12);
    assert!(trim.contains([100.0, -77.0]));
    let cylinder = made.face(Surface::Cylinder { frame, radius: 2.0 }, false, &[]);
    assert_eq!(Trim::new(&made.brep, &cylinder, 0.0).unwrap_err(), TrimError::NoBorder);
    let plane = made.face(Surface::Plane(frame), false, &[]);
    assert_eq!(Trim::new(&made.brep, &plane, 0.0).unwrap_err(), TrimError::NoBorder);
}

#[test]
fn octants_have_corners_at_the_pole() {
    for turn in 0..8 {
        let base = frame(4);
        let a = f64::from(turn) * 0.9;
        let axis = |t: f64| [f64::cos(t), f64::sin(t), 0.0];
        let surface = Surface::Sphere { frame: base, radius: 1.5 };
        for (angle, pole) in [(0.5, 1.0), (3.5, 1.0), (6.0, 1.0), (0.5, -1.0), (3.5, -1.0)] {
            let mut made = Made::default();
            // Along the equator, up a meridian, down the other.
            let meridian = |t: f64| {
                let x = base.vector(axis(t));
                let frame =
                    Frame::new(base.origin, trueness_geom::space::cross(x, base.axes[2]), Some(x)).unwrap();
                Span { curve: Curve::Circle { frame, radius: 1.5 }, range: [0.0, pole * FRAC_PI_2] }
            };
            let low =
                made.edge(Span { curve: Curve::Circle { frame: base, radius: 1.5 }, range: [a, a + angle] });
            let up = made.edge(meridian(a + angle));
            let down = made.edge(meridian(a));
            let loops = if pole > 0.0 {
                vec![(low, false), (up, false), (down, true)]
            } else {
                vec![(low, true), (down, false), (up, true)]
            };
            let face = made.face(surface.clone(), false, &[&loops]);
            let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
            assert!((parameter_area(&trim) - angle * FRAC_PI_2).abs() < 1e-9, "{turn} {angle} {pole}");
            assert!(trim.contains([a + 0.1, pole * 0.3]) && trim.contains([a + angle - 0.1, pole * 1.5]));
            assert!(!trim.contains([a - 0.1, pole * 0.3]) && !trim.contains([a + 0.1, -pole * 0.3]));
        }
    }
}

#[test]
fn loops_go_around_a_torus_either_way() {
    let frame = frame(5);
    let (major, minor) = (3.0, 1.0);
    let surface = Surface::Torus { frame, major, minor };
    let mut made = Made::default();
    let tube = |u: f64| {
        let x = frame.vector([f64::cos(u), f64::sin(u), 0.0]);
        let origin = trueness_geom::space::plus(frame.origin, x.map(|c| major * c));
        let normal = trueness_geom::space::cross(x, frame.axes[2]);
        circle(&Frame::new(origin, normal, Some(x)).unwrap(), 0.0, minor, 0.4)
    };
    // From u = 1 to u = 5, and the rest.
    let (a, b) = (made.edge(tube(1.0)), made.edge(tube(5.0)));
    for (reversed, width) in [(false, TAU - 4.0), (true, 4.0)] {
        let face = made.face(surface.clone(), false, &[&[(a, reversed)], &[(b, !reversed)]]);
        let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
        assert!((parameter_area(&trim) - width * TAU).abs() < 1e-9);
        assert_eq!(trim.contains([2.0, 9.0]), reversed);
    }
    // Around the axis: outside of the height 0.5, and inside.
    let high = f64::asin(0.5);
    let (c, d) = (
        made.edge(circle(&frame, 0.5, major + f64::cos(high), 0.0)),
        made.edge(circle(&frame, -0.5, major + f64::cos(high), 2.0)),
    );
    for (reversed, width) in [(false, 2.0 * high), (true, TAU - 2.0 * high)] {
        let face = made.face(surface.clone(), false, &[&[(c, !reversed)], &[(d, reversed)]]);
        let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
        assert!((parameter_area(&trim) - width * TAU).abs() < 1e-9);
        assert_eq!(trim.contains([2.0, 0.0]), !reversed);
    }
    // One circle alone parts nothing.
    let face = made.face(surface.clone(), false, &[&[(a, false)]]);
    assert!(Trim::new(&made.brep, &face, 0.0).is_err());
    // Both seams twice: the whole torus; one seam is a loop that bounds nothing.
    let (u, v) = (made.edge(circle(&frame, 0.0, major + minor, 0.0)), made.edge(tube(0.0)));
    let face = made.face(surface.clone(), false, &[&[(u, false), (v, false), (u, true), (v, true)]]);
    let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
    assert!((parameter_area(&trim) - TAU * TAU).abs() < 1e-9);
}

#[test]
fn what_contradicts_itself_is_told() {
    let frame = frame(6);
    let at = |x: f64, y: f64| frame.place([x, y, 0.0]);
    let mut made = Made::default();
    let corners = [at(0.0, 0.0), at(2.0, 0.0), at(2.0, 1.0), at(0.0, 1.0)];
    let sides: Vec<u32> = (0..4).map(|i| made.edge(line(corners[i], corners[(i + 1) % 4]))).collect();
    let forward: Vec<(u32, bool)> = sides.iter().map(|e| (*e, false)).collect();
    let backward: Vec<(u32, bool)> = sides.iter().rev().map(|e| (*e, true)).collect();
    let trim = |made: &mut Made, loops: &[(u32, bool)]| {
        let face = made.face(Surface::Plane(frame), false, &[loops]);
        Trim::new(&made.brep, &face, 0.0)
    };
    assert!((parameter_area(&trim(&mut made, &forward).unwrap()) - 2.0).abs() < 1e-12);
    assert!(!trim(&mut made, &forward).unwrap().turned && trim(&mut made, &backward).unwrap().turned);
    assert!(matches!(trim(&mut made, &forward[..3]).unwrap_err(), TrimError::Open { edge: 0, .. }));
    assert_eq!(trim(&mut made, &[(77, false)]).unwrap_err(), TrimError::NoEdge(77));
    // Over cross: a bow tie.
    let bow: Vec<Point> =
        [(0.0, 0.0), (2.0, 0.3), (2.0, 0.0), (0.0, 1.0)].iter().map(|(x, y)| at(*x, *y)).collect();
    let bow: Vec<(u32, bool)> = (0..4).map(|i| (made.edge(line(bow[i], bow[(i + 1) % 4])), false)).collect();
    assert!(matches!(trim(&mut made, &bow).unwrap_err(), TrimError::Crossing(..) | TrimError::Contradiction));
    // Beside the plane.
    let up = frame.place([0.0, 0.0, 1.0]);
    let off = [
        (made.edge(line(up, corners[1])), false),
        (sides[1], false),
        (made.edge(line(corners[2], up)), false),
    ];
    assert!(matches!(trim(&mut made, &off).unwrap_err(), TrimError::Off { .. }));
}

#[test]
fn polygons_and_edges_agree_close_to_the_border() {
    let frame = frame(7);
    let mut made = Made::default();
    let outer =
        made.edge(Span { curve: Curve::Ellipse { frame, radii: [3.0, 1.0] }, range: [0.4, 0.4 + TAU] });
    let inner = made.edge(circle(&frame, 0.0, 0.5, 0.0));
    let face = made.face(Surface::Plane(frame), false, &[&[(inner, true)], &[(outer, false)]]);
    let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
    let mut random = Random::new(1);
    for _ in 0..20_000 {
        let t = TAU * random.unit();
        let off = 1.0 + (random.unit() - 0.5) * libm::exp(-20.0 * random.unit());
        let (u, v) = (3.0 * off * f64::cos(t), off * f64::sin(t));
        let inside = off <= 1.0 && u * u + v * v >= 0.25;
        assert!(
            (off - 1.0).abs() < 1e-12
                || (u * u + v * v - 0.25).abs() < 1e-12
                || trim.contains([u, v]) == inside,
            "{off}"
        );
    }
}

/// A plate with two holes, every loop either way: the holes are holes, and what runs wrong is told.
#[test]
fn holes_are_holes_whatever_way_they_run() {
    let frame = frame(7);
    let mut made = Made::default();
    let at = |x: f64| Frame { origin: frame.place([x, 0.0, 0.0]), ..frame };
    let loops = [(0.0, 5.0), (-2.0, 1.0), (2.5, 1.5)].map(|(x, r)| made.edge(circle(&at(x), 0.0, r, 0.3)));
    for senses in 0..8u32 {
        let uses: Vec<[(u32, bool); 1]> = (0..3).map(|k| [(loops[k], senses >> k & 1 == 1)]).collect();
        let uses: Vec<&[(u32, bool)]> = uses.iter().map(|u| &u[..]).collect();
        let face = made.face(Surface::Plane(frame), false, &uses);
        let trim = Trim::new(&made.brep, &face, 0.0).unwrap();
        assert_eq!(trim.turned, senses != 0b110, "{senses:b}");
        for (place, inside) in
            [([0.0, 0.0], true), ([-2.0, 0.0], false), ([2.5, 0.5], false), ([0.0, 4.9], true)]
        {
            assert_eq!(trim.contains(place), inside, "{senses:b} {place:?}");
        }
    }
}
