//! The boundary of a part: faces that share edges, edges that share vertices.
//!
//! Faces, edges and vertices are named by their index. An edge is one curve between two vertices, whatever faces use it; a face is
//! a part of one surface within loops of edges.

use crate::curve::Span;
use crate::frame::Placement;
use crate::surface::Surface;
use trueness_geom::space::Point;

/// A corner where edges end.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertex {
    /// Millimeters.
    pub place: Point,
}

/// An edge: a part of a curve from one vertex to another.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// From the first vertex to the last.
    pub span: Span,
    /// The vertices at its start and its end; twice the same for a closed edge.
    pub vertices: [u32; 2],
    /// The number of the entity in its file.
    pub entity: u64,
}

/// An edge as a part of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeUse {
    /// The edge.
    pub edge: u32,
    /// Whether the loop goes from the end of the edge to its start.
    pub reversed: bool,
}

/// A closed line that bounds a face. The face lies on the left as one looks against its outward normal.
#[derive(Clone, Debug, PartialEq)]
pub enum Loop {
    /// Edges, each begins where the one before ends.
    Edges(Vec<EdgeUse>),
    /// One vertex: a pole of a sphere, the apex of a cone.
    Vertex(u32),
}

/// What of its surface a face is.
#[derive(Clone, Debug, PartialEq)]
pub enum Bounds {
    /// What lies within these loops. Which one is outside follows from the loops, not from their order.
    Loops(Vec<Loop>),
    /// The rectangle between first and last `u` and `v`; all of the domain where a side is not finite.
    Rectangle([[f64; 2]; 2]),
}

/// A color: red, green, blue and opacity, 0 to 1.
pub type Color = [f32; 4];

/// A face.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// The surface that it is a part of.
    pub surface: Surface,
    /// Whether its outward normal is opposite to `∂u × ∂v`.
    pub reversed: bool,
    /// Which part it is.
    pub bounds: Bounds,
    /// The number of its entity in the file: what a user names it by.
    pub entity: u64,
    /// The name that the file gives it; may be empty.
    pub name: String,
    /// Its own color, else that of its shell, its solid or its part.
    pub color: Option<Color>,
    /// The instance of the model that it is of.
    pub instance: u32,
}

/// Faces that share edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Shell {
    /// Its faces; their normals look out of the material.
    pub faces: Vec<u32>,
    /// Whether the file says that it has no border.
    pub closed: bool,
}

/// Material within shells.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Around it.
    pub outer: u32,
    /// Around hollows within.
    pub voids: Vec<u32>,
    /// The name that the file gives it.
    pub name: String,
}

/// The boundary of one part, or of all parts of an assembly where they stand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Brep {
    /// Corners.
    pub vertices: Vec<Vertex>,
    /// Edges.
    pub edges: Vec<Edge>,
    /// Faces.
    pub faces: Vec<Face>,
    /// Shells; a face that belongs to none stands alone.
    pub shells: Vec<Shell>,
    /// Solids.
    pub solids: Vec<Solid>,
}

impl Brep {
    /// Adds another part where it stands, as instance number `instance`. A mirrored part is turned so that its normals look out
    /// of the material.
    pub fn add(&mut self, part: &Brep, at: &Placement, instance: u32) {
        let [vertices, edges, faces, shells] =
            [self.vertices.len(), self.edges.len(), self.faces.len(), self.shells.len()].map(|n| n as u32);
        let mirrored = at.is_mirrored();
        self.vertices.extend(part.vertices.iter().map(|v| Vertex { place: at.point(v.place) }));
        self.edges.extend(part.edges.iter().map(|edge| Edge {
            span: edge.span.placed(at),
            vertices: edge.vertices.map(|v| v + vertices),
            entity: edge.entity,
        }));
        self.faces.extend(part.faces.iter().map(|face| Face {
            surface: face.surface.placed(at),
            reversed: face.reversed != mirrored,
            bounds: face.bounds.placed(at, &face.surface, vertices, edges, mirrored),
            instance,
            ..face.clone()
        }));
        self.shells.extend(part.shells.iter().map(|shell| Shell {
            faces: shell.faces.iter().map(|f| f + faces).collect(),
            closed: shell.closed,
        }));
        self.solids.extend(part.solids.iter().map(|solid| Solid {
            outer: solid.outer + shells,
            voids: solid.voids.iter().map(|s| s + shells).collect(),
            name: solid.name.clone(),
        }));
    }
}

impl Bounds {
    fn placed(&self, at: &Placement, surface: &Surface, vertices: u32, edges: u32, mirrored: bool) -> Bounds {
        match self {
            Bounds::Loops(loops) => {
                Bounds::Loops(loops.iter().map(|l| l.placed(vertices, edges, mirrored)).collect())
            }
            Bounds::Rectangle(sides) => {
                let scales = surface.parameter_scales(at.scale);
                Bounds::Rectangle([0, 1].map(|k| sides[k].map(|x| x * scales[k])))
            }
        }
    }
}

impl Loop {
    /// Under a mirror left becomes right: the loop is gone along the other way.
    fn placed(&self, vertices: u32, edges: u32, mirrored: bool) -> Loop {
        match self {
            Loop::Vertex(v) => Loop::Vertex(v + vertices),
            Loop::Edges(uses) => {
                let moved = |u: &EdgeUse| EdgeUse { edge: u.edge + edges, reversed: u.reversed != mirrored };
                match mirrored {
                    true => Loop::Edges(uses.iter().rev().map(moved).collect()),
                    false => Loop::Edges(uses.iter().map(moved).collect()),
                }
            }
        }
    }
}
