//! A box with each fault planted in turn.

use super::*;
use crate::brep::{Bounds, Brep, Edge, EdgeUse, Face, Loop, Shell, Solid, Vertex};
use crate::curve::{Curve, Span};
use crate::frame::Frame;
use crate::surface::Surface;
use trueness_geom::progress::Silent;
use trueness_geom::space::{Point, cross, minus};

/// Vertices of the box by the bits of their number.
const SIDES: [f64; 3] = [3.0, 2.0, 1.0];

fn corner(v: u32) -> Point {
    std::array::from_fn(|k| if v >> k & 1 == 1 { SIDES[k] } else { 0.0 })
}

/// Corners of each face, counter-clockwise seen from outside.
const FACES: [[u32; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

fn block() -> Brep {
    let mut brep =
        Brep { vertices: (0..8).map(|v| Vertex { place: corner(v) }).collect(), ..Brep::default() };
    for around in FACES {
        let [a, b, c] = [0, 1, 2].map(|k| corner(around[k]));
        let frame = Frame::new(a, cross(minus(b, a), minus(c, b)), None).unwrap();
        let uses = (0..4).map(|k| edge(&mut brep, around[k], around[(k + 1) % 4])).collect();
        brep.faces.push(Face {
            surface: Surface::Plane(frame),
            reversed: false,
            bounds: Bounds::Loops(vec![Loop::Edges(uses)]),
            entity: 0,
            name: String::new(),
            color: None,
            instance: 0,
        });
    }
    brep.shells.push(Shell { faces: (0..6).collect(), closed: true });
    brep.solids.push(Solid { outer: 0, voids: vec![], name: String::new() });
    brep
}

fn edge(brep: &mut Brep, from: u32, to: u32) -> EdgeUse {
    if let Some(i) = brep.edges.iter().position(|e| e.vertices == [to, from]) {
        return EdgeUse { edge: i as u32, reversed: true };
    }
    let origin = corner(from);
    let curve = Curve::Line { origin, direction: minus(corner(to), origin) };
    brep.edges.push(Edge { span: Span { curve, range: [0.0, 1.0] }, vertices: [from, to], entity: 0 });
    EdgeUse { edge: brep.edges.len() as u32 - 1, reversed: false }
}

fn found(brep: Brep) -> Vec<Fault> {
    let shape = Trimmed::new(brep, 0.0, &Silent).unwrap();
    let integrals = shape.integrals(&Silent).unwrap();
    faults(&shape, &integrals, 1e-3)
}

fn kinds(brep: Brep) -> Vec<FaultKind> {
    let mut all: Vec<FaultKind> = found(brep).iter().map(|f| f.kind).collect();
    all.dedup();
    all
}

fn loops(face: &mut Face) -> &mut Vec<EdgeUse> {
    let Bounds::Loops(loops) = &mut face.bounds else { panic!() };
    let Loop::Edges(uses) = &mut loops[0] else { panic!() };
    uses
}

fn turn(face: &mut Face) {
    face.reversed = !face.reversed;
    let uses = loops(face);
    uses.reverse();
    uses.iter_mut().for_each(|u| u.reversed = !u.reversed);
}

#[test]
fn a_sound_box_has_no_fault() {
    assert_eq!(found(block()), []);
}

#[test]
fn a_missing_face_leaves_free_edges_of_known_length() {
    let mut brep = block();
    brep.faces.pop();
    brep.shells[0].faces.pop();
    let found = found(brep);
    assert_eq!(found.len(), 4);
    let mut lengths: Vec<f64> = found.iter().map(|f| f.size).collect();
    lengths.sort_by(f64::total_cmp);
    assert!(found.iter().all(|f| f.kind == FaultKind::FreeEdge && f.place[0] == 3.0));
    assert!(lengths.iter().zip([1.0, 1.0, 2.0, 2.0]).all(|(a, b)| (a - b).abs() < 1e-14));
}

#[test]
fn a_doubled_face_makes_edges_of_three() {
    let mut brep = block();
    brep.faces.push(brep.faces[5].clone());
    assert_eq!(kinds(brep), [FaultKind::SharedEdge]);
}

#[test]
fn a_turned_face_does_not_agree_with_its_neighbors() {
    let mut brep = block();
    turn(&mut brep.faces[1]);
    let all = found(brep.clone());
    assert!(all.iter().filter(|f| f.kind == FaultKind::OppositeFaces).count() == 4, "{all:?}");
    let mut turned = block();
    turned.faces.iter_mut().for_each(turn);
    let all = found(turned);
    assert_eq!(all.len(), 1);
    assert!(all[0].kind == FaultKind::InsideOutSolid && (all[0].size - 6.0).abs() < 1e-9);
    // Loops alone the wrong way round.
    let mut brep = block();
    let uses = loops(&mut brep.faces[1]);
    uses.reverse();
    uses.iter_mut().for_each(|u| u.reversed = !u.reversed);
    assert!(kinds(brep).contains(&FaultKind::TurnedLoops));
}

#[test]
fn gaps_are_measured() {
    // The plane of the lid is 5 µm too high: its four edges are off it by that.
    let mut brep = block();
    let Surface::Plane(frame) = &mut brep.faces[1].surface else { panic!() };
    frame.origin[2] += 5e-3;
    let all = found(brep);
    assert_eq!(all.len(), 4);
    assert!(
        all.iter().all(|f| f.kind == FaultKind::EdgeGap && f.faces == [1] && (f.size - 5e-3).abs() < 1e-12)
    );
    // A vertex beside its edges.
    let mut brep = block();
    brep.vertices[7].place[0] += 2e-3;
    let all = found(brep);
    assert_eq!(all.len(), 3);
    assert!(all.iter().all(|f| f.kind == FaultKind::VertexGap && (f.size - 2e-3).abs() < 1e-12));
}

#[test]
fn a_face_whose_border_is_open_is_refused() {
    let mut brep = block();
    loops(&mut brep.faces[3]).pop();
    let all = found(brep);
    assert!(all.iter().any(|f| f.kind == FaultKind::RefusedFace && f.faces == [3]));
    assert!(all.iter().any(|f| f.kind == FaultKind::FreeEdge));
}

#[test]
fn what_is_smaller_than_the_uncertainty_is_told() {
    // A box of 0.5 µm height.
    let mut brep = block();
    let low = |p: &mut Point| p[2] *= 5e-4;
    brep.vertices.iter_mut().for_each(|v| low(&mut v.place));
    for edge in &mut brep.edges {
        let Curve::Line { origin, direction } = &mut edge.span.curve else { panic!() };
        low(origin);
        low(direction);
    }
    for face in &mut brep.faces {
        let Surface::Plane(frame) = &mut face.surface else { panic!() };
        low(&mut frame.origin);
    }
    let all = found(brep);
    assert_eq!(all.iter().filter(|f| f.kind == FaultKind::TinyEdge).count(), 4);
    let slivers: Vec<&Fault> = all.iter().filter(|f| f.kind == FaultKind::SliverFace).collect();
    assert!(!slivers.is_empty() && slivers.iter().all(|f| f.size < 5e-4), "{all:?}");
}

/// A band of a cylinder given by its parameters: both circles are free, the line where it closes is not.
#[test]
fn a_face_without_edges_ends_at_its_sides() {
    let frame = Frame::new([0.0; 3], [0.0, 0.0, 1.0], None).unwrap();
    let face = Face {
        surface: Surface::Cylinder { frame, radius: 2.0 },
        reversed: false,
        bounds: Bounds::Rectangle([[0.0, std::f64::consts::TAU], [0.0, 3.0]]),
        entity: 0,
        name: String::new(),
        color: None,
        instance: 0,
    };
    let all = found(Brep { faces: vec![face], ..Brep::default() });
    assert_eq!(all.len(), 2);
    let around = 4.0 * std::f64::consts::PI;
    assert!(
        all.iter().all(|f| f.kind == FaultKind::FreeEdge && (f.size / around - 1.0).abs() < 2e-3),
        "{all:?}"
    );
}
