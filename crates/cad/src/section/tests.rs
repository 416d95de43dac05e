//! Sections of solids with closed forms.

use super::*;
use crate::brep::{Bounds, Brep, Face};
use crate::frame::Frame;
use crate::surface::Surface;
use crate::tessellate::Fineness;
use crate::trim::tests::{Made, circle, frame};
use trueness_geom::progress::Silent;
use trueness_geom::space::{Vector, plus, times};

fn shape(brep: Brep) -> (Trimmed, Tessellation) {
    let shape = Trimmed::new(brep, 0.0, &Silent).unwrap();
    let fineness = Fineness { distance: 5e-3, angle: PI / 12.0 };
    let drawn = shape.tessellate(fineness, 1 << 20, &Silent).unwrap();
    assert!(drawn.failed.is_empty());
    (shape, drawn)
}

/// A single face without edges.
fn whole(surface: Surface) -> (Trimmed, Tessellation) {
    let bounds = Bounds::Rectangle(surface.domain());
    let face =
        Face { surface, reversed: false, bounds, entity: 0, name: String::new(), color: None, instance: 0 };
    shape(Brep { faces: vec![face], ..Brep::default() })
}

fn plane(normal: Vector, through: Point) -> Plane {
    Plane { normal, offset: dot(normal, through) }
}

/// A cylinder with its ends: faces 0 around, 1 below, 2 above.
fn rod(frame: &Frame, radius: f64, height: f64) -> (Trimmed, Tessellation) {
    let mut made = Made::default();
    let low = made.edge(circle(frame, 0.0, radius, 0.3));
    let high = made.edge(circle(frame, height, radius, 2.0));
    made.face(Surface::Cylinder { frame: *frame, radius }, false, &[&[(low, false)], &[(high, true)]]);
    made.face(Surface::Plane(*frame), true, &[&[(low, true)]]);
    let top = Frame { origin: frame.place([0.0, 0.0, height]), ..*frame };
    made.face(Surface::Plane(top), false, &[&[(high, false)]]);
    shape(made.brep)
}

/// Dense places along an outline.
fn course(outline: &Outline) -> Vec<Point> {
    let along = |p: &Piece| (0..400).map(|i| p.span.derivatives(f64::from(i) / 400.0)[0]).collect::<Vec<_>>();
    outline.pieces.iter().flat_map(along).collect()
}

/// The area within outlines, those that run the other way round taken off.
fn area(section: &Section, plane: &Plane) -> f64 {
    let frame = Frame::new([0.0; 3], plane.normal, None).unwrap();
    let of = |outline: &Outline| {
        let flat: Vec<Point> = course(outline).iter().map(|p| frame.local(*p)).collect();
        let pair = |i: usize| {
            let (a, b) = (flat[i], flat[(i + 1) % flat.len()]);
            0.5 * (a[0] * b[1] - a[1] * b[0])
        };
        (0..flat.len()).map(pair).sum::<f64>()
    };
    section.outlines.iter().map(of).sum()
}

/// Each piece begins where the one before ends, and all places lie in the plane.
fn is_sound(section: &Section, plane: &Plane) {
    for outline in &section.outlines {
        assert!(outline.closed);
        let n = outline.pieces.len();
        for i in 0..n {
            let [a, b] = [&outline.pieces[i], &outline.pieces[(i + 1) % n]];
            let gap = norm(minus(a.span.ends()[1], b.span.ends()[0]));
            assert!(gap < 1e-9, "{gap} between {:?} and {:?}", a.span, b.span);
        }
        assert!(course(outline).iter().all(|p| plane.height(p).abs() < 1e-9 * norm(plane.normal)));
    }
}

#[test]
fn a_cylinder_is_cut_in_a_circle_lines_or_an_ellipse() {
    let frame = frame(3);
    let [x, _, z] = frame.axes;
    let (rod, drawn) = rod(&frame, 2.0, 3.0);
    let across = plane(times(2.5, z), frame.place([0.0, 0.0, 1.0]));
    let found = section(&rod, &drawn, &across);
    is_sound(&found, &across);
    let [Outline { pieces, .. }] = &found.outlines[..] else { panic!("{found:?}") };
    let [Piece { face: 0, span: Span { curve: Curve::Circle { frame: own, radius }, range } }] = &pieces[..]
    else {
        panic!("{pieces:?}")
    };
    assert!((radius - 2.0).abs() < 1e-14 && norm(minus(own.origin, frame.place([0.0, 0.0, 1.0]))) < 1e-14);
    assert!((range[1] - range[0] - TAU).abs() < 1e-14, "the material is inside");

    let along = plane(x, frame.place([0.7, 0.0, 0.0]));
    let found = section(&rod, &drawn, &along);
    is_sound(&found, &along);
    assert_eq!(found.outlines[0].pieces.len(), 4);
    assert!(found.outlines[0].pieces.iter().all(|p| matches!(p.span.curve, Curve::Line { .. })));
    let half = (4.0f64 - 0.49).sqrt();
    assert!((area(&found, &along) - 3.0 * 2.0 * half).abs() < 1e-9);

    let normal = plus(z, times(0.4, x));
    let oblique = plane(normal, frame.place([0.0, 0.0, 1.5]));
    let found = section(&rod, &drawn, &oblique);
    is_sound(&found, &oblique);
    let size = drawn.mesh.bounds().diagonal();
    for p in course(&found.outlines[0]) {
        let [a, b, _] = frame.local(p);
        assert!((a.hypot(b) - 2.0).abs() < CURVE_SHARE * size, "{}", a.hypot(b) - 2.0);
    }
    let ellipse = PI * 4.0 * 1.16f64.sqrt();
    assert!((area(&found, &oblique) / ellipse - 1.0).abs() < 1e-4);
    // Off both ends: the ellipse is trimmed by two lines.
    let steep = plane(plus(z, times(2.0, x)), frame.place([0.0, 0.0, 1.5]));
    let found = section(&rod, &drawn, &steep);
    is_sound(&found, &steep);
    assert_eq!(found.outlines[0].pieces.len(), 4);
}

#[test]
fn spheres_and_tori_are_cut_in_circles() {
    let frame = frame(5);
    let [x, _, z] = frame.axes;
    let (ball, drawn) = whole(Surface::Sphere { frame, radius: 2.0 });
    let any = plane([0.3, -0.5, 0.8], plus(frame.origin, [0.2, 0.3, 0.4]));
    let found = section(&ball, &drawn, &any);
    is_sound(&found, &any);
    let (_, length) = unit(any.normal).unwrap();
    let h = any.height(&frame.origin) / length;
    assert!((area(&found, &any) / (PI * (4.0 - h * h)) - 1.0).abs() < 1e-4);
    assert!(
        matches!(&found.outlines[0].pieces[..], [Piece { span: Span { curve: Curve::Circle { radius, .. }, .. }, .. }]
        if (radius - (4.0 - h * h).sqrt()).abs() < 1e-14)
    );

    let (ring, drawn) = whole(Surface::Torus { frame, major: 3.0, minor: 1.0 });
    let across = plane(z, frame.place([0.0, 0.0, 0.6]));
    let found = section(&ring, &drawn, &across);
    is_sound(&found, &across);
    let mut radii: Vec<(f64, f64)> = vec![];
    for outline in &found.outlines {
        for piece in &outline.pieces {
            let Curve::Circle { radius, .. } = piece.span.curve else { panic!("{piece:?}") };
            radii.push((radius, piece.span.range[1] - piece.span.range[0]));
        }
    }
    radii.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(radii.len(), 2);
    for ((radius, sweep), (wanted, turn)) in radii.iter().zip([(2.2, -TAU), (3.8, TAU)]) {
        assert!((radius - wanted).abs() < 1e-14 && (sweep - turn).abs() < 1e-12, "{radius} {sweep}");
    }
    let along = plane(x, frame.origin);
    let found = section(&ring, &drawn, &along);
    is_sound(&found, &along);
    assert_eq!(found.outlines.len(), 2);
    assert!((area(&found, &along) / TAU - 1.0).abs() < 1e-4);
    assert!(
        found.outlines.iter().flat_map(|o| &o.pieces).all(|p| matches!(p.span.curve, Curve::Circle { .. }))
    );
}

/// A torus cut anyhow: all places are on it, and the areas of many parallel sections add up to its volume.
#[test]
fn the_oblique_sections_of_a_torus_make_up_its_volume() {
    let frame = frame(8);
    let (ring, drawn) = whole(Surface::Torus { frame, major: 3.0, minor: 1.0 });
    let normal = unit(plus(frame.axes[2], times(0.7, frame.axes[0]))).unwrap().0;
    let size = drawn.mesh.bounds().diagonal();
    let (reach, steps) = (4.2, 60);
    let mut volume = 0.0;
    for i in 0..steps {
        let h = reach * (2.0 * (f64::from(i) + 0.5) / f64::from(steps) - 1.0);
        let plane = plane(normal, plus(frame.origin, times(h, normal)));
        let found = section(&ring, &drawn, &plane);
        is_sound(&found, &plane);
        for p in found.outlines.iter().flat_map(course) {
            let [x, y, z] = frame.local(p);
            let off = (x.hypot(y) - 3.0).hypot(z) - 1.0;
            assert!(off.abs() < CURVE_SHARE * size, "{off}");
        }
        volume += area(&found, &plane) * 2.0 * reach / f64::from(steps);
    }
    let exact = 2.0 * PI * PI * 3.0;
    assert!((volume / exact - 1.0).abs() < 5e-3, "{volume} {exact}");
}

/// Half a cone: base, apex; a plane through the axis cuts it in a triangle, one across in a circle, one beside in a hyperbola.
#[test]
fn a_cone_is_cut_in_lines_through_its_apex() {
    let frame = frame(11);
    let mut made = Made::default();
    let base = made.edge(circle(&frame, 0.0, 2.0, 1.0));
    made.face(Surface::Cone { frame, radius: 2.0, half_angle: -libm::atan(0.5) }, false, &[&[(base, false)]]);
    made.face(Surface::Plane(frame), true, &[&[(base, true)]]);
    let (cone, drawn) = shape(made.brep);
    let through = plane(frame.axes[1], frame.origin);
    let found = section(&cone, &drawn, &through);
    is_sound(&found, &through);
    assert_eq!(found.outlines[0].pieces.len(), 3);
    assert!((area(&found, &through) - 8.0).abs() < 1e-9);
    let across = plane(frame.axes[2], frame.place([0.0, 0.0, 2.0]));
    let found = section(&cone, &drawn, &across);
    assert!(
        matches!(found.outlines[0].pieces[0].span.curve, Curve::Circle { radius, .. } if (radius - 1.0).abs() < 1e-14)
    );
    let beside = plane(frame.axes[0], frame.place([0.5, 0.0, 0.0]));
    let found = section(&cone, &drawn, &beside);
    is_sound(&found, &beside);
    for p in course(&found.outlines[0]).into_iter().map(|p| frame.local(p)).filter(|p| p[2] > 1e-9) {
        assert!((p[0].hypot(p[1]) - (2.0 - 0.5 * p[2])).abs() < 1e-7);
    }
}

/// A plane in the end of a rod: it is told, and the section is that just below.
#[test]
fn a_face_in_the_plane_is_told() {
    let frame = frame(13);
    let (rod, drawn) = rod(&frame, 2.0, 3.0);
    let top = plane(frame.axes[2], frame.place([0.0, 0.0, 3.0]));
    let found = section(&rod, &drawn, &top);
    assert_eq!(found.in_plane, [2]);
    is_sound(&found, &top);
    assert!((area(&found, &top) / (4.0 * PI) - 1.0).abs() < 1e-4);
    let bottom = plane(frame.axes[2], frame.origin);
    let found = section(&rod, &drawn, &bottom);
    assert_eq!((found.in_plane, found.outlines.len()), (vec![1], 0));
}
