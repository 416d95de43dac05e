//! The facets of one plane that lie upon each other, with all that cuts them: segments, and the points on these.
//!
//! Mostly that is a single facet. Facets that overlap in their plane are cut together (Zhou et al., Mesh Arrangements
//! for Solid Geometry, 2016). Their common area then falls into the same pieces.

use super::meetings::{Edge, edge};
use super::points::{ExactPoint, Plane, Points};
use std::collections::BTreeMap;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::predicates::side_of_line;
use trueness_geom::space::{Point, cross, minus};

/// A segment in the plane of a cluster.
pub(super) struct Segment {
    pub ends: [u32; 2],
    /// The edge of the mesh that it is, or the facet that cuts there. Edges come first, sorted.
    pub line: Line,
    /// The points inside it, those known from the start first and ascending.
    pub on: Vec<u32>,
    known: usize,
}

/// The line that a segment is part of. Two segments of one line cross nowhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Line {
    Edge(Edge),
    Cut(u32),
}

/// Facets of one plane that are cut together.
pub(super) struct Cluster {
    /// Ascending.
    pub facets: Vec<u32>,
    /// Along which the facets are looked at.
    pub axis: usize,
    pub segments: Vec<Segment>,
    /// All points of the plane, ascending.
    pub points: Vec<u32>,
}

/// Two segments cross at a place that may have no number yet.
pub(super) struct Crossing {
    pub segments: [usize; 2],
    pub place: ExactPoint,
}

/// A cut of a facet: the facet that cuts, and the ends.
pub(super) type Cut = (u32, [u32; 2]);

impl Cluster {
    /// The cluster of these facets of `mesh`, with their cuts, further points in them, and the points on each of their
    /// edges.
    pub fn new(
        mesh: &Mesh,
        facets: Vec<u32>,
        cuts: impl Iterator<Item = Cut>,
        single: impl Iterator<Item = u32>,
        on_edge: impl Fn(Edge) -> Vec<u32>,
    ) -> Cluster {
        let axis = axis_of(mesh, facets[0]);
        let mut edges: Vec<Edge> = vec![];
        for [a, b, c] in facets.iter().map(|f| mesh.faces[*f as usize]) {
            edges.extend([edge(a, b), edge(b, c), edge(c, a)]);
        }
        edges.sort_unstable();
        edges.dedup();
        let of_edge = |e: Edge| {
            let on = on_edge(e);
            Segment { ends: e, line: Line::Edge(e), known: on.len(), on }
        };
        let mut segments: Vec<Segment> = edges.into_iter().map(of_edge).collect();
        let mut cuts: Vec<Cut> = cuts.map(|(by, [a, b])| (by, edge(a, b))).collect();
        cuts.sort_unstable();
        cuts.dedup();
        let of_cut = |(by, ends): Cut| Segment { ends, line: Line::Cut(by), on: vec![], known: 0 };
        segments.extend(cuts.into_iter().map(of_cut));
        let mut points: Vec<u32> = single.collect();
        points.extend(segments.iter().flat_map(|s| s.ends.iter().chain(&s.on)));
        points.sort_unstable();
        points.dedup();
        Cluster { facets, axis, segments, points }
    }

    /// The two axes seen.
    fn axes(&self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    /// Finds the points inside each segment, and where segments cross. Segments and points are gone through in the order of
    /// one coordinate; only those whose boxes overlap are compared.
    pub fn cross(&mut self, mesh: &Mesh, points: &Points) -> Vec<Crossing> {
        let [x, y] = self.axes();
        let flat = |b: [Point; 2]| [b[0][x], b[1][x], b[0][y], b[1][y]];
        // Segments first, then points.
        let of_segments = self.segments.iter().map(|s| flat(points.bounds(s.ends)));
        let boxes: Vec<[f64; 4]> =
            of_segments.chain(self.points.iter().map(|p| flat(points.bounds([*p, *p])))).collect();
        let overlap =
            |a: &[f64; 4], b: &[f64; 4]| a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3];
        let mut order: Vec<usize> = (0..boxes.len()).collect();
        order.sort_unstable_by(|a, b| boxes[*a][0].total_cmp(&boxes[*b][0]).then(a.cmp(b)));
        let (mut open, mut open_points): (Vec<usize>, Vec<usize>) = (vec![], vec![]);
        let (count, mut crossings, mut planes) = (self.segments.len(), vec![], Planes::new(mesh, self));
        for i in order {
            let own = boxes[i];
            open.retain(|j| boxes[*j][1] >= own[0]);
            open_points.retain(|j| boxes[*j][1] >= own[0]);
            let near = |j: &&usize| overlap(&own, &boxes[**j]);
            if i < count {
                for &j in open.iter().filter(near) {
                    if self.do_cross(points, i, j)
                        && let Some(place) = planes.crossing(mesh, self, [i, j])
                    {
                        crossings.push(Crossing { segments: [i, j], place });
                    }
                }
                for &p in open_points.iter().filter(near) {
                    self.note(points, i, self.points[p - count]);
                }
                open.push(i);
            } else {
                for &s in open.iter().filter(near) {
                    self.note(points, s, self.points[i - count]);
                }
                open_points.push(i);
            }
        }
        crossings
    }

    /// Whether two segments cross inside both.
    fn do_cross(&self, points: &Points, i: usize, j: usize) -> bool {
        let (s, t) = (&self.segments[i], &self.segments[j]);
        let ([a, b], [c, d]) = (s.ends, t.ends);
        if s.line == t.line || a == c || a == d || b == c || b == d {
            return false;
        }
        let apart = |[a, b]: [u32; 2], [c, d]: [u32; 2]| {
            let first = points.orient(self.axis, [a, b, c]);
            first != 0 && points.orient(self.axis, [a, b, d]) == -first
        };
        apart(s.ends, t.ends) && apart(t.ends, s.ends)
    }

    /// Notes a point with a segment if it lies inside it.
    fn note(&mut self, points: &Points, i: usize, point: u32) {
        let s = &self.segments[i];
        let [a, b] = s.ends;
        if point == a || point == b || s.on[..s.known].binary_search(&point).is_ok() {
            return;
        }
        if points.orient(self.axis, [a, b, point]) == 0 && between(points, self.axes(), s.ends, point) {
            self.segments[i].on.push(point);
        }
    }
}

/// Whether a point of the line through two others lies between them.
fn between(points: &Points, axes: [usize; 2], [a, b]: [u32; 2], p: u32) -> bool {
    let order = |k: usize| points.compare(k, a, b);
    let k = if order(axes[0]).is_ne() { axes[0] } else { axes[1] };
    points.compare(k, a, p) == order(k) && points.compare(k, p, b) == order(k)
}

/// The axis along which a facet is seen best.
pub(super) fn axis_of(mesh: &Mesh, facet: u32) -> usize {
    let [a, b, c] = mesh.corners(facet);
    let n = cross(minus(b, a), minus(c, a)).map(f64::abs);
    let best = (0..3).fold(0, |k, j| if n[j] > n[k] { j } else { k });
    let seen = |k: &usize| side_of_line(*k, &a, &b, &c) != 0;
    [best, 0, 1, 2].into_iter().find(seen).unwrap_or(best)
}

/// The planes that segments of a cluster lie in, each made once.
struct Planes {
    own: Plane,
    of: BTreeMap<u32, Plane>,
}

impl Planes {
    fn new(mesh: &Mesh, cluster: &Cluster) -> Planes {
        Planes { own: plane_of(mesh, cluster.facets[0]), of: BTreeMap::new() }
    }

    fn crossing(&mut self, mesh: &Mesh, cluster: &Cluster, [i, j]: [usize; 2]) -> Option<ExactPoint> {
        let ends = |e: Edge| mesh.places(&e);
        let lines = [i, j].map(|i| cluster.segments[i].line);
        for line in lines {
            if let Line::Cut(facet) = line {
                self.of.entry(facet).or_insert_with(|| plane_of(mesh, facet));
            }
        }
        match lines {
            [Line::Edge(e), Line::Edge(f)] => {
                ExactPoint::on_line(ends(e), &Plane::along(cluster.axis, ends(f)))
            }
            [Line::Edge(e), Line::Cut(f)] | [Line::Cut(f), Line::Edge(e)] => {
                ExactPoint::on_line(ends(e), self.of.get(&f)?)
            }
            [Line::Cut(f), Line::Cut(g)] => {
                ExactPoint::of_planes([&self.own, self.of.get(&f)?, self.of.get(&g)?])
            }
        }
    }
}

/// The plane of a facet.
pub(super) fn plane_of(mesh: &Mesh, facet: u32) -> Plane {
    Plane::through(mesh.corners(facet))
}
