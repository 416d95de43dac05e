//! Edges and loops.

use trueness_cad::brep::{Brep, Edge, EdgeUse, Loop};
use trueness_cad::curve::{Curve, Span};
use trueness_geom::space::{Point, minus, norm};

/// Adds an edge; its number. `entity` is what it is made of.
pub(crate) fn add_edge(brep: &mut Brep, span: Span, vertices: [u32; 2], entity: u64) -> u32 {
    brep.edges.push(Edge { span, vertices, entity });
    brep.edges.len() as u32 - 1
}

/// The straight way from one place to another; `None` where they are one.
pub(crate) fn straight([from, to]: [Point; 2]) -> Option<Span> {
    let direction = minus(to, from);
    let curve = Curve::Line { origin: from, direction };
    (norm(direction) > 0.0).then_some(Span { curve, range: [0.0, 1.0] })
}

/// The same loop, gone along the other way.
pub(crate) fn reversed(around: Loop) -> Loop {
    match around {
        Loop::Vertex(v) => Loop::Vertex(v),
        Loop::Edges(uses) => {
            let turned = |u: &EdgeUse| EdgeUse { edge: u.edge, reversed: !u.reversed };
            Loop::Edges(uses.iter().rev().map(turned).collect())
        }
    }
}
