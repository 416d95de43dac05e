//! Surfaces that coincide but for rounding get the same vertices and edges.
//!
//! The problem: two bodies touch in a face. After their corners have been rotated and rounded, the two faces have no common plane.
//! Facets of one cross those of the other at random, and the space between them is as thin as the spacing of numbers.
//!
//! The method, with a reach of some such spacings:
//! - vertices no farther apart than the reach become one;
//! - where two edges pass each other within the reach, both get a new vertex;
//! - vertices within the reach of an edge or a facet become points of it;
//! - facets are cut along everything that lies upon them (`retile`).
//!
//! The result: where the two faces overlap, both consist of the same triangles, and an arrangement cancels or merges these. No
//! place of the surface moves farther than three times the reach.
//!
//! Snap rounding (Hobby, Practical segment intersection with finite precision output, 1999) in space. The vertices that
//! are there stand in place of the pixels of a grid.

use super::error::ArrangeError;
use super::meetings::{Edge, edges};
use super::passing::{MAX_PASSING_PLACES, Passing, passing};
use super::snap::{snap, used};
use std::collections::{BTreeMap, BTreeSet};
use trueness_geom::check::intersect::{reaching, reaching_any};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::predicates::{axis, height, side_of_line};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Aabb, Point, dot, minus, norm, times};
use trueness_geom::topology::Topology;

/// Vertices that lie upon the edges and facets of a mesh.
pub(super) struct Imprints {
    /// Vertices on an edge, from its lower end to the higher one.
    pub on_edge: BTreeMap<Edge, Vec<u32>>,
    /// Vertices inside a facet, ascending.
    pub inside: BTreeMap<u32, Vec<u32>>,
    /// The facets whose edges may lie upon others, ascending.
    pub facets: Vec<u32>,
}

impl Imprints {
    /// The facets upon which something lies, ascending.
    pub fn marked(&self, mesh: &Mesh) -> Vec<u32> {
        let is_marked = |f: u32, face: [u32; 3]| {
            self.inside.contains_key(&f) || edges(face).iter().any(|e| self.on_edge.contains_key(e))
        };
        (0..).zip(&mesh.faces).filter(|(f, face)| is_marked(*f, **face)).map(|(f, _)| f).collect()
    }
}

/// The mesh in which vertices no farther apart than
/// `reach` are one, around the facets of these pairs. Also, for each face, the facet that it was, and the vertices upon its edges and facets. New vertices come last, their coordinates made with `round`;
/// those given stay where they are. `None` if more than [`MAX_PASSING_PLACES`] pairs of edges pass each other there, or
/// of vertices and the boxes of facets meet. Cost: n log n, and about a microsecond for each such pair.
pub(super) fn imprints(
    mesh: &Mesh,
    pairs: &[[u32; 2]],
    reach: f64,
    round: &(impl Fn(f64) -> f64 + Sync),
    progress: &dyn Progress,
) -> Result<Option<(Mesh, Vec<u32>, Imprints)>, ArrangeError> {
    let mut crossing: Vec<u32> = pairs.iter().flatten().copied().collect();
    crossing.sort_unstable();
    crossing.dedup();
    let near = reaching_any(mesh, &Topology::of(mesh)?, &boxes(mesh, &crossing, reach), progress)?;
    let near: BTreeSet<u32> = near.into_iter().collect();
    let (mesh, source) = joined(mesh, &near, reach);
    let topology = Topology::of(&mesh)?;
    let of_near = (0..).zip(&source).filter(|(_, s)| near.contains(s));
    let mut facets: BTreeSet<u32> = of_near.map(|(f, _)| f).collect();
    loop {
        let known = facets.len();
        let looked_at = facets.iter().copied().collect();
        let Some((positions, imprints)) = imprints_near(&mesh, &topology, looked_at, reach, round, progress)?
        else {
            return Ok(None);
        };
        // Vertices upon further facets may lie across their edges too.
        facets.extend(imprints.marked(&mesh));
        if facets.len() == known {
            return Ok(Some((Mesh { positions, ..mesh }, source, imprints)));
        }
    }
}

/// The vertices upon these facets and others no farther off than `reach`; and all vertices, new ones last.
fn imprints_near(
    mesh: &Mesh,
    topology: &Topology,
    facets: Vec<u32>,
    reach: f64,
    round: &impl Fn(f64) -> f64,
    progress: &dyn Progress,
) -> Result<Option<(Vec<Point>, Imprints)>, Cancelled> {
    let near = reaching_any(mesh, topology, &boxes(mesh, &facets, reach), progress)?;
    let Some(passing) = passing(mesh, &facets, &near, reach, progress)? else { return Ok(None) };
    let (positions, mut on_edge) = met(mesh, passing, reach, round);
    let mut vertices: BTreeSet<u32> = facets.iter().flat_map(|f| mesh.faces[*f as usize]).collect();
    vertices.extend(on_edge.iter().map(|(_, v)| *v));
    let places: Vec<Aabb> = vertices.iter().map(|v| grown([&positions[*v as usize]], reach)).collect();
    let Some(below) = reaching(mesh, topology, &places, MAX_PASSING_PLACES, progress)? else {
        return Ok(None);
    };
    let mut inside: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (v, below) in vertices.into_iter().zip(below) {
        for f in below {
            match lies(mesh, (v, &positions[v as usize]), f, reach) {
                VertexPosition::Apart => {}
                VertexPosition::On(edges) => on_edge.extend(edges.into_iter().map(|e| (e, v))),
                VertexPosition::Inside => inside.entry(f).or_default().push(v),
            }
        }
    }
    let on_edge = ordered(&positions, on_edge);
    Ok(Some((positions, Imprints { on_edge, inside, facets })))
}

fn boxes(mesh: &Mesh, facets: &[u32], reach: f64) -> Vec<Aabb> {
    facets.iter().map(|f| grown(&mesh.corners(*f), reach)).collect()
}

/// The box of some points, and `reach` more on all sides.
fn grown<'a>(points: impl IntoIterator<Item = &'a Point>, reach: f64) -> Aabb {
    let Aabb { min, max } = Aabb::of(points);
    Aabb { min: min.map(|x| x - reach), max: max.map(|x| x + reach) }
}

/// The mesh whose facets near those given name one vertex where several are no farther apart than `reach`. Facets that lose a
/// corner by it are left out. For each facet the one that it was.
fn joined(mesh: &Mesh, near: &BTreeSet<u32>, reach: f64) -> (Mesh, Vec<u32>) {
    let movable: BTreeSet<u32> = near.iter().flat_map(|f| mesh.faces[*f as usize]).collect();
    let movable: Vec<u32> = movable.into_iter().collect();
    let to = snap(&mesh.positions, &used(mesh.positions.len(), &mesh.faces), &movable, reach);
    let is_whole = |f: &[u32; 3]| f[0] != f[1] && f[1] != f[2] && f[2] != f[0];
    let faces = mesh.faces.iter().map(|f| f.map(|v| to.get(&v).copied().unwrap_or(v)));
    let (faces, source) = faces.zip(0..).filter(|(f, _)| is_whole(f)).unzip();
    (Mesh { positions: mesh.positions.clone(), faces }, source)
}

/// Adds a vertex where edges pass each other, or takes one that is there already no farther off than `reach`. Returns
/// all vertices, and pairs of an edge and a vertex on it.
fn met(
    mesh: &Mesh,
    passing: Vec<Passing>,
    reach: f64,
    round: impl Fn(f64) -> f64,
) -> (Vec<Point>, Vec<(Edge, u32)>) {
    let mut positions = mesh.positions.clone();
    positions.extend(passing.iter().map(|p| p.1.map(&round)));
    let new: Vec<u32> = (mesh.positions.len() as u32..positions.len() as u32).collect();
    let mut used = used(mesh.positions.len(), &mesh.faces);
    used.resize(positions.len(), true);
    let to = snap(&positions, &used, &new, reach);
    let put = |v: u32| to.get(&v).copied().unwrap_or(v);
    let on = passing.iter().zip(new).flat_map(|((edges, _), v)| edges.map(|e| (e, put(v))));
    let on = on.filter(|(e, v)| !e.contains(v)).collect();
    (positions, on)
}

/// How a vertex lies to a facet.
enum VertexPosition {
    Apart,
    /// Upon some of its edges.
    On(Vec<Edge>),
    Inside,
}

fn lies(mesh: &Mesh, (v, p): (u32, &Point), facet: u32, reach: f64) -> VertexPosition {
    let face = mesh.faces[facet as usize];
    if face.contains(&v) {
        return VertexPosition::Apart;
    }
    let on: Vec<Edge> = edges(face).into_iter().filter(|e| is_on(mesh, p, *e, reach)).collect();
    if !on.is_empty() {
        return VertexPosition::On(on);
    }
    let [a, b, c] = mesh.corners(facet);
    // Flat facets have edges only.
    let Some(axis) = axis(&[a, b, c]) else { return VertexPosition::Apart };
    let turn = side_of_line(axis, &a, &b, &c);
    let is_within = [[&a, &b], [&b, &c], [&c, &a]].iter().all(|[a, b]| side_of_line(axis, a, b, p) == turn);
    if is_within && height([&a, &b, &c], p).abs() <= reach {
        VertexPosition::Inside
    } else {
        VertexPosition::Apart
    }
}

/// Whether a place is no farther than `reach` from an edge.
fn is_on(mesh: &Mesh, p: &Point, e: Edge, reach: f64) -> bool {
    let [a, b] = mesh.places(&e);
    let (u, w) = (minus(b, a), minus(*p, a));
    let t = dot(u, w) / dot(u, u);
    (0.0..=1.0).contains(&t) && norm(minus(w, times(t, u))) <= reach
}

/// The vertices on each edge, in their order along it.
fn ordered(positions: &[Point], mut pairs: Vec<(Edge, u32)>) -> BTreeMap<Edge, Vec<u32>> {
    pairs.sort_unstable();
    pairs.dedup();
    let chain = |on: &[(Edge, u32)]| {
        let e = on[0].0;
        let [a, b] = e.map(|v| positions[v as usize]);
        let along = |v: &u32| dot(minus(positions[*v as usize], a), minus(b, a));
        let mut on: Vec<u32> = on.iter().map(|p| p.1).collect();
        on.sort_by(|v, w| along(v).total_cmp(&along(w)));
        (e, on)
    };
    pairs.chunk_by(|a, b| a.0 == b.0).map(chain).collect()
}
