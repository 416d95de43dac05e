//! Solids with closed forms: extruded and turned profiles.

use super::super::Region;
use super::profile::{Piece, seen};
use crate::brep::{Bounds, Brep, Edge, EdgeUse, Face, Loop, Vertex};
use crate::curve::{Curve, Span};
use crate::frame::Frame;
use crate::surface::Surface;
use std::f64::consts::{FRAC_PI_2, TAU};
use trueness_geom::space::{Point, minus, norm, times};

/// Part of a surface: a rectangle of the parameters, or what lies within a profile.
#[derive(Clone, Debug)]
pub enum Part {
    Rectangle { sides: [[f64; 2]; 2], periods: [Option<f64>; 2] },
    Profile { chains: Vec<Vec<Piece>>, window: [[f64; 2]; 2] },
}

const BORDER: f64 = 1e-12;

impl Region for Part {
    fn contains(&self, at: [f64; 2]) -> bool {
        match self {
            Part::Rectangle { sides, periods } => (0..2).all(|k| {
                let [from, to] = sides[k];
                let t = periods[k].map_or(at[k], |p| at[k] - p * ((at[k] - from + BORDER) / p).floor());
                t >= from - BORDER && t <= to + BORDER
            }),
            Part::Profile { chains, .. } => {
                let (distance, inside) = seen(chains, at);
                inside || distance <= BORDER
            }
        }
    }
    fn window(&self) -> [[f64; 2]; 2] {
        match self {
            Part::Rectangle { sides, .. } => *sides,
            Part::Profile { window, .. } => *window,
        }
    }
}

/// A boundary, the parts of its faces, and what is inside of it.
pub struct Solid {
    pub brep: Brep,
    pub parts: Vec<Option<Part>>,
    frame: Frame,
    chains: Vec<Vec<Piece>>,
    /// Of an extrusion; `None` for a turned profile.
    height: Option<f64>,
}

impl Solid {
    /// Whether a place is inside; its distance from the profile's border in the plane where that is what decides.
    pub fn holds(&self, p: Point) -> bool {
        let [x, y, z] = self.frame.local(p);
        match self.height {
            Some(height) => z > 0.0 && z < height && seen(&self.chains, [x, y]).1,
            None => seen(&self.chains, [x.hypot(y), z]).1,
        }
    }
}

fn face(surface: Surface, reversed: bool, loops: Vec<Loop>) -> Face {
    let bounds = if loops.is_empty() { Bounds::Rectangle(surface.domain()) } else { Bounds::Loops(loops) };
    Face { surface, reversed, bounds, entity: 0, name: String::new(), color: None, instance: 0 }
}

fn window(chains: &[Vec<Piece>]) -> [[f64; 2]; 2] {
    let mut window = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    for piece in chains.iter().flatten() {
        for i in 0..=200 {
            let at = piece.at(f64::from(i) / 200.0);
            (0..2).for_each(|k| window[k] = [window[k][0].min(at[k]), window[k][1].max(at[k])]);
        }
    }
    window.map(|[a, b]| [a - 0.05, b + 0.05])
}

/// The curve of a piece in a plane at a height.
fn span(frame: &Frame, piece: &Piece, z: f64) -> Span {
    match piece {
        Piece::Line { from, to } => {
            let [a, b] = [from, to].map(|p| frame.place([p[0], p[1], z]));
            Span { curve: Curve::Line { origin: a, direction: minus(b, a) }, range: [0.0, 1.0] }
        }
        Piece::Arc { center, radius, angles } => {
            let own = Frame { origin: frame.place([center[0], center[1], z]), axes: frame.axes };
            Span { curve: Curve::Circle { frame: own, radius: *radius }, range: *angles }
        }
    }
}

/// A profile moved along the third axis.
pub fn extruded(frame: Frame, chains: Vec<Vec<Piece>>, height: f64) -> Solid {
    let mut brep = Brep::default();
    let mut parts = vec![];
    let (mut bottoms, mut tops) = (vec![], vec![]);
    let z = frame.axes[2];
    for chain in &chains {
        let n = chain.len() as u32;
        let (vertices, edges) = (brep.vertices.len() as u32, brep.edges.len() as u32);
        for piece in chain {
            let [x, y] = piece.at(0.0);
            brep.vertices.extend([0.0, height].map(|z| Vertex { place: frame.place([x, y, z]) }));
        }
        for (k, piece) in chain.iter().enumerate() {
            let k = k as u32;
            let (own, next) = (vertices + 2 * k, vertices + 2 * ((k + 1) % n));
            let edge = |span, vertices| Edge { span, vertices, entity: 0 };
            brep.edges.push(edge(span(&frame, piece, 0.0), [own, next]));
            brep.edges.push(edge(span(&frame, piece, height), [own + 1, next + 1]));
            let [x, y] = piece.at(0.0);
            let line = Curve::Line { origin: frame.place([x, y, 0.0]), direction: z };
            brep.edges.push(edge(Span { curve: line, range: [0.0, height] }, [own, own + 1]));
        }
        let along = |edge: u32, reversed: bool| EdgeUse { edge, reversed };
        for (k, piece) in chain.iter().enumerate() {
            let own = edges + 3 * k as u32;
            let next = edges + 3 * ((k as u32 + 1) % n);
            let uses =
                vec![along(own, false), along(next + 2, false), along(own + 1, true), along(own + 2, true)];
            let (surface, reversed, sides) = match piece {
                Piece::Line { from, to } => {
                    let [a, b] = [from, to].map(|p| frame.place([p[0], p[1], 0.0]));
                    let length = norm(minus(b, a));
                    let x = times(1.0 / length, minus(b, a));
                    let own = Frame { origin: a, axes: [x, z, trueness_geom::space::cross(x, z)] };
                    (Surface::Plane(own), false, [0.0, length])
                }
                Piece::Arc { center, radius, angles } => {
                    let own = Frame { origin: frame.place([center[0], center[1], 0.0]), axes: frame.axes };
                    let sides = [angles[0].min(angles[1]), angles[0].max(angles[1])];
                    (Surface::Cylinder { frame: own, radius: *radius }, angles[0] > angles[1], sides)
                }
            };
            let periods = surface.periods();
            brep.faces.push(face(surface, reversed, vec![Loop::Edges(uses)]));
            parts.push(Some(Part::Rectangle { sides: [sides, [0.0, height]], periods }));
        }
        let pieces = 0..n;
        tops.push(Loop::Edges(pieces.clone().map(|k| along(edges + 3 * k + 1, false)).collect()));
        bottoms.push(Loop::Edges(pieces.rev().map(|k| along(edges + 3 * k, true)).collect()));
    }
    for (z, loops, reversed) in [(0.0, bottoms, true), (height, tops, false)] {
        let own = Frame { origin: frame.place([0.0, 0.0, z]), axes: frame.axes };
        brep.faces.push(face(Surface::Plane(own), reversed, loops));
        parts.push(Some(Part::Profile { chains: chains.clone(), window: window(&chains) }));
    }
    Solid { brep, parts, frame, chains, height: Some(height) }
}

/// A profile of radii and heights turned about the third axis. It may begin and end on the axis.
pub fn turned(frame: Frame, chain: Vec<Piece>) -> Solid {
    let mut brep = Brep::default();
    let mut parts = vec![];
    let ends = chain.iter().map(|piece| piece.at(0.0));
    // The number of the circle, or of the vertex on the axis, at the start of each piece.
    let mut joints = vec![];
    for [rho, z] in ends.chain([chain[chain.len() - 1].at(1.0)]) {
        let closes = joints.len() == chain.len() && {
            let [x, y] = chain[0].at(0.0);
            (x - rho).hypot(y - z) < 1e-12
        };
        if closes {
            joints.push(joints[0]);
            continue;
        }
        let vertex = brep.vertices.len() as u32;
        let is_on_axis = rho.abs() < 1e-12;
        brep.vertices.push(Vertex { place: frame.place([rho, 0.0, z]) });
        if is_on_axis {
            joints.push((None, vertex));
            continue;
        }
        let own = Frame { origin: frame.place([0.0, 0.0, z]), axes: frame.axes };
        let span = Span { curve: Curve::Circle { frame: own, radius: rho }, range: [0.0, TAU] };
        joints.push((Some(brep.edges.len() as u32), vertex));
        brep.edges.push(Edge { span, vertices: [vertex, vertex], entity: 0 });
    }
    for (k, piece) in chain.iter().enumerate() {
        let mut loops = vec![];
        for (end, reversed) in [(k, false), (k + 1, true)] {
            match joints[end] {
                (Some(edge), _) => loops.push(Loop::Edges(vec![EdgeUse { edge, reversed }])),
                (None, _) if is_flat(piece) => {}
                (None, vertex) => loops.push(Loop::Vertex(vertex)),
            }
        }
        let (surface, reversed, part) = turned_piece(&frame, piece);
        brep.faces.push(face(surface, reversed, loops));
        parts.push(Some(part));
    }
    Solid { brep, parts, frame, chains: vec![chain], height: None }
}

/// Whether a piece turns into a plane.
fn is_flat(piece: &Piece) -> bool {
    matches!(piece, Piece::Line { from, to } if (from[1] - to[1]).abs() < 1e-12)
}

/// The surface of a turned piece, whether it is reversed, and the part of it.
fn turned_piece(frame: &Frame, piece: &Piece) -> (Surface, bool, Part) {
    let at = |z: f64| Frame { origin: frame.place([0.0, 0.0, z]), axes: frame.axes };
    let whole = |sides: [f64; 2], periods| Part::Rectangle { sides: [[0.0, TAU], sides], periods };
    match *piece {
        Piece::Line { from, to } if is_flat(piece) => {
            let [inner, outer] = [from[0].min(to[0]), from[0].max(to[0])];
            let full = |radius: f64| Piece::Arc { center: [0.0; 2], radius, angles: [0.0, TAU] };
            let hole = Piece::Arc { center: [0.0; 2], radius: inner, angles: [TAU, 0.0] };
            let mut chains = vec![vec![full(outer)]];
            if inner > 1e-12 {
                chains.push(vec![hole]);
            }
            let window = window(&chains);
            (Surface::Plane(at(from[1])), to[0] > from[0], Part::Profile { chains, window })
        }
        Piece::Line { from, to } => {
            let slope = (to[0] - from[0]) / (to[1] - from[1]);
            let mut sides = [0.0, to[1] - from[1]];
            sides.sort_by(f64::total_cmp);
            let frame = at(from[1]);
            let surface = match slope.abs() < 1e-12 {
                true => Surface::Cylinder { frame, radius: from[0] },
                false => Surface::Cone { frame, radius: from[0], half_angle: slope.atan() },
            };
            let periods = surface.periods();
            (surface, to[1] < from[1], whole(sides, periods))
        }
        Piece::Arc { center, radius, angles } => {
            let mut sides = angles;
            sides.sort_by(f64::total_cmp);
            let frame = at(center[1]);
            let surface = match center[0].abs() < 1e-12 {
                true => Surface::Sphere { frame, radius },
                false => Surface::Torus { frame, major: center[0], minor: radius },
            };
            let mut periods = surface.periods();
            if center[0].abs() < 1e-12 {
                sides = sides.map(|s| s.clamp(-FRAC_PI_2, FRAC_PI_2));
                periods[1] = None;
            }
            (surface, angles[1] < angles[0], whole(sides, periods))
        }
    }
}
