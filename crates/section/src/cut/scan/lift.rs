//! Crossings moved from the chords on which they lie onto the surface between the vertices.
//!
//! The chord between two vertices of a bent surface lies within it. The line or arc that the crossing belongs to tells
//! how far. The distances of the vertices around from it are the surface. They are a quadratic function of the way
//! along it and of the height over the plane. The mesh would be cut without noise on the chord between two places of
//! this.

use super::cut_mesh::CutMesh;
use crate::Chain;
use crate::model::chain::SegmentKind;
use crate::search::parts::{Part, Sums};
use trueness_geom::num::dense::solve;
use trueness_geom::plane::PlaneFrame;
use trueness_geom::space::{Vector, cross, dot, minus, norm};

/// Vertices about an edge: those of some three rings.
const MAX_VERTICES_ABOUT_EDGE: usize = 48;
/// Coefficients of the quadratic function.
const QUADRATIC_TERMS: usize = 6;
/// Vertices that it takes at least.
const MIN_VERTICES_OF_QUADRATIC: usize = 2 * QUADRATIC_TERMS;
/// Vertices count whose feet are no nearer to an end of the part than this share of the edge's length. Others are those
/// of the faces beside.
const MIN_INSET_EDGE_LENGTHS: f64 = 0.3;
/// Vertices farther off than so many edge lengths are of other faces.
const MAX_OFFSET_EDGE_LENGTHS: f64 = 3.0;
/// So are those about which facets look another way than about the crossings, by more than an angle of this cosine (30°).
const MIN_FACING_COSINE: f64 = 0.866;

/// An edge lies within a surface that its mesh tells by no more than this share of its length. That is an eighth of it
/// for each radian that facets turn along it. Vertices that tell more do not determine the surface.
const MAX_LIFT_EDGE_LENGTHS: f64 = 0.25;

/// Lengths along a line or arc, and distances to the left of it.
struct Course<'a> {
    part: &'a Part,
    center: [f64; 2],
}

impl Course<'_> {
    fn new(part: &Part) -> Course<'_> {
        let radius = 1.0 / part.curvature;
        let center = match part.kind {
            SegmentKind::Line => part.center,
            _ => [part.center[0] - radius * part.along[1], part.center[1] + radius * part.along[0]],
        };
        Course { part, center }
    }

    /// Length along it from its middle, and distance to the left.
    fn local(&self, p: [f64; 2]) -> [f64; 2] {
        let (along, d) = (self.part.along, [p[0] - self.center[0], p[1] - self.center[1]]);
        let (x, y) = (along[0] * d[0] + along[1] * d[1], along[0] * d[1] - along[1] * d[0]);
        if self.part.kind == SegmentKind::Line {
            return [x, y];
        }
        // The center lies to the left of an arc that turns left.
        let sense = self.part.curvature.signum();
        let radius = 1.0 / self.part.curvature.abs();
        [radius * libm::atan2(x, -sense * y), sense * (radius - libm::hypot(x, y))]
    }

    /// A direction by its parts along it where a length from its middle is, across it, and across the plane.
    fn seen_from(&self, s: f64, direction: Vector, (frame, normal): (&PlaneFrame, Vector)) -> Vector {
        let (sin, cos) = libm::sincos(s * self.part.curvature);
        let [x, y] = self.part.along;
        let [x, y] = [cos * x - sin * y, sin * x + cos * y];
        let [a, b] = [frame.x, frame.y].map(|axis| dot(axis, direction));
        [x * a + y * b, x * b - y * a, dot(normal, direction)]
    }

    fn place(&self, [s, off]: [f64; 2]) -> [f64; 2] {
        let along = self.part.along;
        let [x, y] = if self.part.kind == SegmentKind::Line {
            [s, off]
        } else {
            let sense = self.part.curvature.signum();
            let radius = 1.0 / self.part.curvature.abs();
            let (sin, cos) = libm::sincos(s / radius);
            let from = radius - sense * off;
            [from * sin, -sense * from * cos]
        };
        [self.center[0] + along[0] * x - along[1] * y, self.center[1] + along[1] * x + along[0] * y]
    }
}

/// Lets parts take the crossings between them that lie on the line or arc of either.
pub(super) fn lengthen(parts: &mut [Part], points: &[[f64; 2]], within: f64) {
    for k in 1..parts.len() {
        let on = |part: &Part, i: usize| Course::new(part).local(points[i])[1].abs() <= within;
        let [mut end, mut start] = [parts[k - 1].to, parts[k].from];
        while end < start && on(&parts[k - 1], end) {
            end += 1;
        }
        while end < start && on(&parts[k], start - 1) {
            start -= 1;
        }
        (parts[k - 1].to, parts[k].from) = (end, start);
    }
}

/// Crossings of the lines and arcs by which they are moved: half before each, half behind, or all on one side.
const CROSSINGS_PER_WINDOW: usize = 11;

/// The crossings of a chain with these places in the plane, on the surface.
///
/// The power of a point on a chord of a circle is known without the circle. The point lies within by the product of the
/// two parts of the chord. So lines and arcs through a few crossings are found as if these were on the surface. Among
/// the windows about a crossing, before and behind it, the one counts whose crossings lie nearest to one line or arc.
/// No window reaches over a corner where another does not.
pub(super) fn on_surface(
    cut: &CutMesh,
    chain: &Chain,
    frame: &PlaneFrame,
    points: &[[f64; 2]],
    closed: bool,
) -> Vec<[f64; 2]> {
    let n = points.len();
    let width = CROSSINGS_PER_WINDOW.min(n);
    // Round a closed chain windows go on.
    let total = if closed { n + width } else { n };
    let row: Vec<[f64; 2]> = (0..total).map(|i| points[i % n]).collect();
    let powers: Vec<f64> = (0..n)
        .map(|i| {
            let ends = chain.edges[i].map(|v| frame.flat(cut.mesh.positions[v as usize]));
            let way = |a: [f64; 2], b: [f64; 2]| libm::hypot(b[0] - a[0], b[1] - a[1]);
            way(ends[0], points[i]) * way(points[i], ends[1])
        })
        .collect();
    let all: Vec<f64> = (0..total).map(|i| powers[i % n]).collect();
    let sums = Sums::within(&row, &vec![1.0; total], &all);
    let windows: Vec<(f64, Part)> = (0..if closed { n } else { n + 1 - width })
        .map(|from| {
            let (line, arc) = sums.fit(from, from + width);
            let sum = arc.map_or(line, |(arc, _, _)| arc.min(line));
            let kind =
                if arc.is_some_and(|(arc, _, _)| arc < line) { SegmentKind::Arc } else { SegmentKind::Line };
            (sum, sums.part(&row, kind, from, from + width))
        })
        .collect();
    let normal = cross(frame.x, frame.y);
    let moved = |i: usize| {
        let last = width - 1;
        let starts = [0, last / 2, last].map(|back| match closed {
            true => (i + n - back) % n,
            false => i.saturating_sub(back).min(n - width),
        });
        let best = starts.into_iter().min_by(|a, b| windows[*a].0.total_cmp(&windows[*b].0));
        let part = &windows[best.unwrap_or(0)].1;
        let edges = (part.from..part.to).map(|i| chain.edges[i % n]);
        lifted((cut, edges), chain.edges[i], points[i], part, &row, (frame, normal))
    };
    (0..n).map(moved).collect()
}

/// A crossing on the surface, as the vertices about its edge beside this part of the row, and of these edges, tell.
fn lifted(
    (cut, edges): (&CutMesh, impl Iterator<Item = [u32; 2]>),
    edge: [u32; 2],
    point: [f64; 2],
    part: &Part,
    row: &[[f64; 2]],
    (frame, normal): (&PlaneFrame, [f64; 3]),
) -> [f64; 2] {
    let course = Course::new(part);
    let ends = [part.from, part.to - 1].map(|i| course.local(row[i])[0]);
    let local = |v: u32| {
        let p = cut.mesh.positions[v as usize];
        let [s, off] = course.local(frame.flat(p));
        [s, off, dot(normal, minus(p, frame.origin))]
    };
    let [a, b] = edge.map(local);
    let here = course.local(point);
    let length = libm::hypot(b[0] - a[0], b[2] - a[2]).max(f64::MIN_POSITIVE);
    let inside = MIN_INSET_EDGE_LENGTHS * length;
    let looks = |v: u32, s: f64| course.seen_from(s, cut.facing(v), (frame, normal));
    let face = middle(edges.flatten().map(|v| looks(v, local(v)[0])).collect());
    let own = around(cut, edge).into_iter().filter_map(|v| {
        let [s, off, z] = local(v);
        let is_inside =
            s >= ends[0] + inside && s <= ends[1] - inside && off.abs() <= MAX_OFFSET_EDGE_LENGTHS * length;
        (is_inside && dot(looks(v, s), face) >= MIN_FACING_COSINE * norm(face)).then_some([s, off, z])
    });
    let surface = quadratic(own.collect(), here[0], length);
    let height = |s: f64, z: f64| {
        let [x, z] = [(s - here[0]) / length, z / length];
        let terms = [1.0, z, x, z * z, x * z, x * x];
        terms.iter().zip(&surface).map(|(t, c)| t * c).sum::<f64>()
    };
    let [from, to] = [a, b].map(|[s, _, z]| course.place([s, height(s, z)]));
    let t = if b[2] == a[2] { 0.5 } else { (-a[2] / (b[2] - a[2])).clamp(0.0, 1.0) };
    let chord = course.local([0, 1].map(|k| from[k] + t * (to[k] - from[k])));
    let lift = height(chord[0], 0.0) - chord[1];
    if lift.abs() > MAX_LIFT_EDGE_LENGTHS * length {
        return point;
    }
    course.place([here[0], here[1] + lift])
}

/// The medians of the parts of directions.
fn middle(all: Vec<Vector>) -> Vector {
    std::array::from_fn(|k| {
        let mut parts: Vec<f64> = all.iter().map(|d| d[k]).collect();
        parts.sort_by(f64::total_cmp);
        let n = parts.len();
        // As of the parts seen from the other side.
        if n == 0 { 0.0 } else { 0.5 * (parts[(n - 1) / 2] + parts[n / 2]) }
    })
}

/// The vertices about an edge, ring by ring.
fn around(cut: &CutMesh, edge: [u32; 2]) -> Vec<u32> {
    let mut found = edge.to_vec();
    let mut next = 0;
    while next < found.len() && found.len() < MAX_VERTICES_ABOUT_EDGE {
        for &v in cut.neighbors_of(found[next]) {
            if found.len() == MAX_VERTICES_ABOUT_EDGE {
                break;
            }
            if !found.contains(&v) {
                found.push(v);
            }
        }
        next += 1;
    }
    found
}

/// The quadratic function of length along and height, in edge lengths, nearest to these distances; nothing where they are too few.
fn quadratic(places: Vec<[f64; 3]>, middle: f64, length: f64) -> [f64; QUADRATIC_TERMS] {
    if places.len() < MIN_VERTICES_OF_QUADRATIC {
        return [0.0; QUADRATIC_TERMS];
    }
    let mut a = vec![vec![0.0; QUADRATIC_TERMS]; QUADRATIC_TERMS];
    let mut b = vec![0.0; QUADRATIC_TERMS];
    for [s, off, z] in places {
        let [x, z] = [(s - middle) / length, z / length];
        let terms = [1.0, z, x, z * z, x * z, x * x];
        for i in 0..QUADRATIC_TERMS {
            (0..QUADRATIC_TERMS).for_each(|j| a[i][j] += terms[i] * terms[j]);
            b[i] += terms[i] * off;
        }
    }
    let found = solve(a, b).filter(|x| x.iter().all(|c| c.is_finite()));
    found.map_or([0.0; QUADRATIC_TERMS], |x| std::array::from_fn(|k| x[k]))
}
