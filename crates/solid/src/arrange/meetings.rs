//! The common places of two facets that meet: the ends of a segment, or that they lie in one plane.
//!
//! The planes of two facets meet in a line, and each facet has an interval of it. The common part ends where one of the
//! intervals does. That is at a corner in the plane of the other facet, or where an edge passes through it. All of it
//! is decided by the corners alone. No point is computed here: an edge that passes through a facet is a name for one.

use trueness_geom::mesh::Mesh;
use trueness_geom::num::predicates::{axis, side_of_line, side_of_plane};

/// An edge of the mesh, the lower vertex first.
pub(super) type Edge = [u32; 2];

pub(super) fn edge(a: u32, b: u32) -> Edge {
    [a.min(b), a.max(b)]
}

/// The edges of a face.
pub(super) fn edges([a, b, c]: [u32; 3]) -> [Edge; 3] {
    [edge(a, b), edge(b, c), edge(c, a)]
}

/// A point, as two facets define it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Name {
    /// A corner.
    Vertex(u32),
    /// Where an edge passes through the plane of a facet.
    Pierced(Edge, u32),
}

/// The common places of two facets.
#[derive(Debug, Default)]
pub(super) struct Meeting {
    /// They lie in one plane.
    pub coplanar: bool,
    /// The ends of the common part, perhaps under several names each.
    pub ends: Vec<Name>,
    /// Points that lie on an edge of one of the two, inside it.
    pub on_edges: Vec<(Edge, Name)>,
}

/// A facet: its number, its corners, and where they are.
struct Facet<'a> {
    number: u32,
    corners: [u32; 3],
    at: [&'a [f64; 3]; 3],
}

impl Facet<'_> {
    fn of(mesh: &Mesh, number: u32) -> Facet<'_> {
        let corners = mesh.faces[number as usize];
        Facet { number, corners, at: corners.map(|v| &mesh.positions[v as usize]) }
    }

    fn edge(&self, k: usize) -> Edge {
        edge(self.corners[k], self.corners[(k + 1) % 3])
    }
}

/// The common places of facets `a` and `b`. Neither is flat.
pub(super) fn meeting(mesh: &Mesh, [a, b]: [u32; 2]) -> Meeting {
    let (a, b) = (Facet::of(mesh, a), Facet::of(mesh, b));
    let (of_a, of_b) = (sides(&a, &b), sides(&b, &a));
    let mut meeting = Meeting { coplanar: of_a == [0; 3], ..Meeting::default() };
    if !meeting.coplanar {
        collect(&a, &b, of_a, &mut meeting);
        collect(&b, &a, of_b, &mut meeting);
    }
    meeting
}

/// On which sides of the plane of `u` the corners of `t` lie.
fn sides(t: &Facet, u: &Facet) -> [i32; 3] {
    let [p, q, r] = u.at;
    [0, 1, 2].map(|k| if u.corners.contains(&t.corners[k]) { 0 } else { side_of_plane(p, q, r, t.at[k]) })
}

/// The ends of the interval of `t` that lie in `u`.
fn collect(t: &Facet, u: &Facet, sides: [i32; 3], meeting: &mut Meeting) {
    for k in 0..3 {
        if sides[k] == 0 {
            vertex(t, k, u, meeting);
        } else if sides[k] * sides[(k + 1) % 3] < 0 {
            pierced(t, k, u, meeting);
        }
    }
}

/// Corner `k` of `t` lies in the plane of `u`: does it lie in `u`?
fn vertex(t: &Facet, k: usize, u: &Facet, meeting: &mut Meeting) {
    let name = Name::Vertex(t.corners[k]);
    if u.corners.contains(&t.corners[k]) {
        meeting.ends.push(name);
        return;
    }
    let Some(axis) = axis(&u.at.map(|p| *p)) else { return };
    let turn = side_of_line(axis, u.at[0], u.at[1], u.at[2]);
    let side = [0, 1, 2].map(|i| turn * side_of_line(axis, u.at[i], u.at[(i + 1) % 3], t.at[k]));
    if side.contains(&-1) {
        return;
    }
    meeting.ends.push(name);
    meeting.on_edges.extend((0..3).filter(|i| side[*i] == 0).map(|i| (u.edge(i), name)));
}

/// Edge `k` of `t` passes through the plane of `u`: does it pass through `u`?
fn pierced(t: &Facet, k: usize, u: &Facet, meeting: &mut Meeting) {
    let (p, q) = (t.at[k], t.at[(k + 1) % 3]);
    let side = [0, 1, 2].map(|i| side_of_plane(p, q, u.at[i], u.at[(i + 1) % 3]));
    if side.contains(&1) && side.contains(&-1) {
        return;
    }
    let own = t.edge(k);
    match [0, 1, 2].map(|i| side[i] == 0) {
        [false, false, false] => {}
        [true, false, false] | [false, true, false] | [false, false, true] => {
            let name = Name::Pierced(own, u.number);
            meeting.on_edges.extend((0..3).filter(|i| side[*i] == 0).map(|i| (u.edge(i), name)));
        }
        zero => {
            // Through the corner that two edges have in common.
            let corner = (0..3).find(|i| zero[*i] && zero[(i + 2) % 3]).unwrap_or(0);
            let name = Name::Vertex(u.corners[corner]);
            meeting.ends.push(name);
            meeting.on_edges.push((own, name));
            return;
        }
    }
    let name = Name::Pierced(own, u.number);
    meeting.ends.push(name);
    meeting.on_edges.push((own, name));
}
