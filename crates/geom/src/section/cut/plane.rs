//! Where a plane cuts a mesh: closed loops out of closed meshes, by the identity of edges.
//!
//! Vertices are above, below or on the plane, decided exactly. One rule settles what is on it: it counts as above, as if the
//! plane were lower by less than any number. So a facet is cut in no or in two edges, never in a vertex, and a facet in the
//! plane is not cut at all; the loops of a closed mesh close, whatever the plane passes through. The place of a cut edge is
//! computed once, from its lower-numbered end, and shared by the facets on both sides.

use super::edge_chain::{Edge, EdgeChain, edge_chains};
use crate::mesh::Mesh;
use crate::num::exact::Exact;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// The plane of all points `p` with `normal · p = offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// At right angles to it; of any length but 0.
    pub normal: Vector,
    /// Times the length of the normal, the distance of the origin.
    pub offset: f64,
}

/// Two axes of a plane at right angles, with an origin: coordinates there and back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneFrame {
    /// The place with the coordinates 0, 0.
    pub origin: Point,
    /// Direction of the first axis.
    pub x: Vector,
    /// Direction of the second axis; with the normal the third, right-handed.
    pub y: Vector,
}

/// Components of a normal that differ by less than this are alike: rounding and noise do not decide between them.
const ALIKE: f64 = 0.1;

/// Sums of squares that differ by so many variances do not tell two planes apart: the tilt of one of them has two unknowns, which chance makes
/// that large in one row of four hundred.
const UNTOLD: f64 = 12.0;
/// Squares of heights that are this share of those of the lengths are rounding.
const ROUNDING: f64 = 1e-20;

impl Plane {
    /// A frame in the plane: its origin is the foot of the coordinates' origin, its first axis runs as that axis of the coordinates does
    /// which the normal leans on least, the first of those that it leans on alike. `None` where the normal has no direction.
    pub fn frame(&self) -> Option<PlaneFrame> {
        let (normal, length) = unit(self.normal)?;
        let low = normal.iter().fold(1.0, |low: f64, x| low.min(x.abs()));
        let least = (0..3).find(|k| normal[*k].abs() <= low + ALIKE)?;
        let mut axis = [0.0; 3];
        axis[least] = 1.0;
        let (y, _) = unit(cross(normal, axis))?;
        Some(PlaneFrame { origin: times(self.offset / length, normal), x: cross(y, normal), y })
    }

    /// The sign of `normal · p − offset`, exact.
    fn side(&self, p: &Point) -> i32 {
        let terms: [f64; 4] =
            [self.normal[0] * p[0], self.normal[1] * p[1], self.normal[2] * p[2], -self.offset];
        let rounded: f64 = terms.iter().sum();
        // Three products, three sums: seven roundings at most.
        let bound = 8.0 * f64::EPSILON * terms.iter().map(|t| t.abs()).sum::<f64>();
        if rounded.abs() > bound {
            return if rounded > 0.0 { 1 } else { -1 };
        }
        let mut sum = Exact::default();
        (0..3).for_each(|k| sum.add_product(self.normal[k], p[k], 1.0));
        sum.add(-self.offset);
        sum.sign()
    }

    fn height(&self, p: &Point) -> f64 {
        dot(self.normal, *p) - self.offset
    }
}

impl Default for PlaneFrame {
    /// That of the first two coordinates.
    fn default() -> PlaneFrame {
        PlaneFrame { origin: [0.0; 3], x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0] }
    }
}

impl PlaneFrame {
    /// At right angles to both axes.
    pub fn normal(&self) -> Vector {
        // 0 and no minus 0.
        cross(self.x, self.y).map(|x| x + 0.0)
    }
    /// Coordinates of a place in the plane.
    pub fn flat(&self, p: Point) -> [f64; 2] {
        let d = minus(p, self.origin);
        [dot(d, self.x), dot(d, self.y)]
    }
    /// The place with these coordinates.
    pub fn place(&self, p: [f64; 2]) -> Point {
        plus(plus(self.origin, times(p[0], self.x)), times(p[1], self.y))
    }

    /// The plane of least squares through points in space, and their greatest distance from it. `None` where they lie on a
    /// line, or are fewer than three. The greatest component of its normal is positive, the first of those that are alike; where the points do
    /// not tell it from that axis of the coordinates, the normal is the axis: far from the origin the least tilt moves all coordinates.
    pub fn through(points: &[Point]) -> Option<(PlaneFrame, f64)> {
        let n = points.len() as f64;
        // From the same end whichever way round they are given: sums round as their order is.
        let last = points.last().filter(|last| last.iter().lt(points[0].iter()));
        let in_turn = |i: usize| if last.is_some() { points[points.len() - 1 - i] } else { points[i] };
        let middle: Point = std::array::from_fn(|k| (0..points.len()).map(|i| in_turn(i)[k] / n).sum());
        let mut scatter = [[0.0; 3]; 3];
        for i in 0..points.len() {
            let d = minus(in_turn(i), middle);
            (0..9).for_each(|k| scatter[k / 3][k % 3] += d[k / 3] * d[k % 3]);
        }
        let (values, rows) = crate::fit::eigen(scatter);
        if points.len() < 3 || values[1] <= 1e-12 * values[2] {
            return None;
        }
        let high = rows[0].iter().fold(0.0, |high: f64, x| high.max(x.abs()));
        let greatest = (0..3).find(|k| rows[0][*k].abs() >= high - ALIKE)?;
        let mut normal = times(1.0_f64.copysign(rows[0][greatest]), rows[0]);
        let square = |i: usize| dot(normal, minus(in_turn(i), middle)).powi(2);
        let squares: f64 = (0..points.len()).map(square).sum();
        let untold = UNTOLD * squares / (n - 3.0).max(1.0) + ROUNDING * values[2];
        if scatter[greatest][greatest] - squares <= untold {
            normal = std::array::from_fn(|k| if k == greatest { 1.0 } else { 0.0 });
        }
        let frame = Plane { normal, offset: dot(normal, middle) }.frame()?;
        let off = points.iter().map(|p| dot(minus(*p, frame.origin), normal).abs()).fold(0.0, f64::max);
        Some((frame, off))
    }
}

/// A chain of points where a plane cuts a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Its points in space, neighbors different; the first is not repeated at the end.
    pub points: Vec<Point>,
    /// The edge of the mesh that each point lies on: its vertices, the lower first.
    pub edges: Vec<[u32; 2]>,
    /// Whether the last point joins the first.
    pub closed: bool,
}

/// The chains in which `plane` cuts `mesh`, each with the material on its left as seen against the normal where facets run
/// counter-clockwise outside. Open where the mesh is.
///
/// Vertices at the same place count as different: weld first. Facets that name no vertex, or hold a coordinate that is no
/// number, are passed over. Where more than two facets share an edge, chains go on in the order of the facets. Cost: linear.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
///
/// ```
/// use trueness_geom::{mesh::Mesh, progress::Silent, section::{cut, Plane}};
/// let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let mesh = Mesh { positions, faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] };
/// let chains = cut(&mesh, &Plane { normal: [0.0, 0.0, 1.0], offset: 0.5 }, &Silent).unwrap();
/// assert!(chains.len() == 1 && chains[0].closed && chains[0].points.len() == 3);
/// ```
pub fn cut(mesh: &Mesh, plane: &Plane, progress: &dyn Progress) -> Result<Vec<Chain>, Cancelled> {
    let above: Vec<bool> = mesh.positions.iter().map(|p| plane.side(p) >= 0).collect();
    chains(mesh, plane, mesh.faces.iter(), |v| above[v as usize], progress)
}

/// As [`cut`], of the facets with these numbers alone: those of [`facets_near`](crate::section::facets_near), in ascending order, give the same
/// chains. Numbers beyond the mesh are passed over. Cost: linear in their number.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
pub fn cut_facets(
    mesh: &Mesh,
    plane: &Plane,
    facets: &[u32],
    progress: &dyn Progress,
) -> Result<Vec<Chain>, Cancelled> {
    let own = facets.iter().filter_map(|f| mesh.faces.get(*f as usize));
    chains(mesh, plane, own, |v| plane.side(&mesh.positions[v as usize]) >= 0, progress)
}

/// The chains through some facets; `above` tells of a vertex of the mesh on which side it is.
fn chains<'a>(
    mesh: &Mesh,
    plane: &Plane,
    faces: impl Iterator<Item = &'a [u32; 3]>,
    above: impl Fn(u32) -> bool,
    progress: &dyn Progress,
) -> Result<Vec<Chain>, Cancelled> {
    let sound = |v: &u32| mesh.positions.get(*v as usize).is_some_and(|p| p.iter().all(|x| x.is_finite()));
    // Each cut facet leads from the edge at which its rim goes down to the one at which it comes up.
    let mut cut: Vec<[Edge; 2]> = vec![];
    for (n, face) in faces.enumerate() {
        if n % 65536 == 0 && progress.cancelled() {
            return Err(Cancelled);
        }
        if !face.iter().all(sound) {
            continue;
        }
        let up = face.map(&above);
        let (mut from, mut to) = (None, None);
        for k in 0..3 {
            let (a, b) = (face[k], face[(k + 1) % 3]);
            let edge = [a.min(b), a.max(b)];
            match (up[k], up[(k + 1) % 3]) {
                (true, false) => from = Some(edge),
                (false, true) => to = Some(edge),
                _ => {}
            }
        }
        cut.extend(from.zip(to).map(|(from, to)| [from, to]));
    }
    let mut chains = vec![];
    for EdgeChain { edges, closed } in edge_chains(&cut) {
        let mut places: Vec<(Point, Edge)> = edges.into_iter().map(|e| (place(mesh, plane, e), e)).collect();
        places.dedup_by_key(|(point, _)| *point);
        while closed && places.len() > 1 && places[0].0 == places[places.len() - 1].0 {
            places.pop();
        }
        if places.len() > 1 {
            // Loops begin at their least place, whatever the order of the facets.
            let least = |a: &(Point, Edge), b: &(Point, Edge)| order(&a.0, &b.0).then(a.1.cmp(&b.1));
            let first = (0..places.len()).min_by(|i, j| least(&places[*i], &places[*j]));
            places.rotate_left(first.filter(|_| closed).unwrap_or(0));
            let (points, edges) = places.into_iter().unzip();
            chains.push(Chain { points, edges, closed });
        }
    }
    Ok(chains)
}

/// The order of places by their coordinates, one after the other.
fn order(a: &Point, b: &Point) -> std::cmp::Ordering {
    a.iter().zip(b).map(|(x, y)| x.total_cmp(y)).find(|o| o.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
}

/// Where the plane cuts an edge, within its box.
fn place(mesh: &Mesh, plane: &Plane, edge: Edge) -> Point {
    let [a, b] = edge.map(|v| mesh.positions[v as usize]);
    let (low, high) = (plane.height(&a), plane.height(&b));
    let t = low / (low - high);
    let t = if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.5 };
    // A vertex in the plane is the place itself.
    if plane.side(&a) == 0 {
        return a;
    }
    if plane.side(&b) == 0 {
        return b;
    }
    plus(a, times(t, minus(b, a)))
}

/// Area inside closed chains, holes taken off, seen against the normal of the frame.
///
/// Each chain counts by the way it runs round: what several enclose, as where shells overlap or are doubled, counts as often, and chains of
/// shells turned inside out count below 0. Open chains do not count.
pub fn area(chains: &[Chain], frame: &PlaneFrame) -> f64 {
    let twice = |chain: &Chain| -> f64 {
        let flat: Vec<[f64; 2]> = chain.points.iter().map(|p| frame.flat(*p)).collect();
        (0..flat.len())
            .map(|i| {
                let (a, b) = (flat[i], flat[(i + 1) % flat.len()]);
                a[0] * b[1] - a[1] * b[0]
            })
            .sum()
    };
    0.5 * chains.iter().filter(|c| c.closed).map(twice).sum::<f64>()
}

impl Chain {
    /// Length of its polyline.
    pub fn length(&self) -> f64 {
        let closing = if self.closed { self.points.first().zip(self.points.last()) } else { None };
        let steps: f64 = self.points.windows(2).map(|w| norm(minus(w[1], w[0]))).sum();
        steps + closing.map_or(0.0, |(a, b)| norm(minus(*a, *b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;
    use crate::progress::Silent;

    /// A sphere of latitudes and longitudes.
    fn sphere(rings: u32, around: u32) -> Mesh {
        let mut mesh = Mesh::default();
        mesh.positions.push([0.0, 0.0, 1.0]);
        for r in 1..rings {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(r) / f64::from(rings));
            for a in 0..around {
                let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(a) / f64::from(around));
                mesh.positions.push([sin * c, sin * s, cos]);
            }
        }
        let last = mesh.positions.len() as u32;
        mesh.positions.push([0.0, 0.0, -1.0]);
        let at = |r: u32, a: u32| 1 + (r - 1) * around + a % around;
        for a in 0..around {
            mesh.faces.push([0, at(1, a), at(1, a + 1)]);
            mesh.faces.push([last, at(rings - 1, a + 1), at(rings - 1, a)]);
            for r in 1..rings - 1 {
                mesh.faces.push([at(r, a), at(r + 1, a), at(r + 1, a + 1)]);
                mesh.faces.push([at(r, a), at(r + 1, a + 1), at(r, a + 1)]);
            }
        }
        mesh
    }

    /// Area by the segments of all facets, each by itself: the divergence theorem in the plane.
    fn brute(mesh: &Mesh, plane: &Plane, frame: &PlaneFrame) -> f64 {
        let mut sum = 0.0;
        for face in &mesh.faces {
            let p = face.map(|v| mesh.positions[v as usize]);
            let h = p.map(|p| plane.height(&p));
            let cross_at =
                |i: usize, j: usize| frame.flat(plus(p[i], times(h[i] / (h[i] - h[j]), minus(p[j], p[i]))));
            let (mut from, mut to) = (None, None);
            for k in 0..3 {
                let l = (k + 1) % 3;
                if h[k] >= 0.0 && h[l] < 0.0 {
                    from = Some(cross_at(k, l));
                } else if h[k] < 0.0 && h[l] >= 0.0 {
                    to = Some(cross_at(k, l));
                }
            }
            if let (Some(a), Some(b)) = (from, to) {
                sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
            }
        }
        sum
    }

    #[test]
    fn loops_of_a_closed_mesh_close_and_have_the_area_of_brute_force() {
        let mesh = sphere(12, 24);
        let random = &mut Random::new(8);
        let mut planes: Vec<Plane> = (0..50)
            .map(|_| Plane {
                normal: std::array::from_fn(|_| random.unit() - 0.5),
                offset: 0.4 * (random.unit() - 0.5),
            })
            .collect();
        // Through vertices, edges, and the axis.
        planes.push(Plane { normal: [0.0, 0.0, 1.0], offset: mesh.positions[1][2] });
        planes.push(Plane { normal: [0.0, 0.0, 1.0], offset: 0.0 });
        planes.push(Plane { normal: [1.0, 0.0, 0.0], offset: 0.0 });
        planes.push(Plane { normal: [0.0, 1.0, 0.0], offset: 0.0 });
        for plane in planes {
            let chains = cut(&mesh, &plane, &Silent).unwrap();
            assert!(!chains.is_empty());
            for chain in &chains {
                assert!(chain.closed, "{plane:?}");
                let n = chain.points.len();
                assert!((0..n).all(|i| chain.points[i] != chain.points[(i + 1) % n]), "{plane:?}");
            }
            let frame = plane.frame().unwrap();
            let (a, b) = (area(&chains, &frame), brute(&mesh, &plane, &frame));
            assert!((a - b).abs() < 1e-12 && a > 0.0, "{plane:?}: {a} {b}");
        }
    }

    /// A ring of square section on whole numbers, and a staircase of boxes: planes through their vertices, edges and facets.
    #[test]
    fn planes_through_vertices_edges_and_facets_close_too() {
        let mut ring = Mesh::default();
        let corners = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]];
        let inner = [[3.0, 3.0], [6.0, 3.0], [6.0, 6.0], [3.0, 6.0]];
        for (z, outline) in [(0.0, corners), (0.0, inner), (4.0, corners), (4.0, inner)] {
            outline.iter().for_each(|p| ring.positions.push([p[0], p[1], z]));
        }
        let mut quad = |a: u32, b: u32, c: u32, d: u32| ring.faces.extend([[a, b, c], [a, c, d]]);
        for i in 0..4 {
            let j = (i + 1) % 4;
            quad(i, j, j + 8, i + 8);
            quad(j + 4, i + 4, i + 12, j + 12);
            quad(j, i, i + 4, j + 4);
            quad(i + 8, j + 8, j + 12, i + 12);
        }
        let random = &mut Random::new(21);
        let mut planes = vec![];
        for axis in 0..3 {
            for at in 0..10 {
                let mut normal = [0.0; 3];
                normal[axis] = 1.0;
                planes.push(Plane { normal, offset: f64::from(at) });
                normal[axis] = -1.0;
                planes.push(Plane { normal, offset: -f64::from(at) });
            }
        }
        for _ in 0..300 {
            // Whole numbers: the plane of three vertices passes through them exactly.
            let [a, b, c] = [0, 1, 2].map(|_| ring.positions[random.below(16) as usize]);
            let normal = cross(minus(b, a), minus(c, a));
            if norm(normal) > 0.0 {
                planes.push(Plane { normal, offset: dot(normal, a) });
            }
        }
        for plane in planes {
            let chains = cut(&ring, &plane, &Silent).unwrap();
            for chain in &chains {
                let n = chain.points.len();
                assert!(chain.closed && chain.edges.len() == n, "{plane:?}");
                assert!((0..n).all(|i| chain.points[i] != chain.points[(i + 1) % n]), "{plane:?}");
            }
            let frame = plane.frame().unwrap();
            let (a, b) = (area(&chains, &frame), brute(&ring, &plane, &frame));
            assert!((a - b).abs() < 1e-12 * (1.0 + b.abs()), "{plane:?}: {a} {b}");
        }
        // Between the planes of its faces: the ring's area.
        let flat = Plane { normal: [0.0, 0.0, 1.0], offset: 2.5 };
        let chains = cut(&ring, &flat, &Silent).unwrap();
        assert!(chains.len() == 2 && (area(&chains, &flat.frame().unwrap()) - 72.0).abs() < 1e-12);
    }

    /// Rows around an ellipse in planes whose normals are on the verge of another frame, of exact numbers and with noise, either way round:
    /// always the frame of the plane itself.
    #[test]
    fn rows_in_space_have_the_frame_of_their_plane() {
        let random = &mut Random::new(3);
        let root = 0.5_f64.sqrt();
        for (normal, offset) in [
            ([0.0, 0.0, 1.0], 5.0),
            ([0.0, 0.0, 1.0], -500.0),
            ([0.0, 1.0, 0.0], 0.1),
            ([1.0, 0.0, 0.0], 7.3),
            ([root, root, 0.0], 20.0),
            ([root, 0.0, -root], 20.0),
            ([0.6, -0.64, 0.48], 3.0),
        ] {
            let frame = Plane { normal, offset }.frame().unwrap();
            for (round, noise) in [0.0, 1e-15, 1e-9, 0.003, 0.03].into_iter().cycle().take(40).enumerate() {
                let place = |i: u32, random: &mut Random| {
                    let (s, c) = libm::sincos(0.063 * f64::from(i));
                    let p = frame.place([30.0 + 12.0 * c, 8.0 * s]);
                    let chance: f64 = (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
                    plus(p, times(noise * chance, normal))
                };
                let mut points: Vec<Point> = (0..100).map(|i| place(i, random)).collect();
                if round % 2 == 1 {
                    points.reverse();
                }
                let (found, off) = PlaneFrame::through(&points).unwrap();
                let turn = [minus(found.x, frame.x), minus(found.y, frame.y)].map(norm);
                assert!(turn.iter().all(|t| *t <= noise + 1e-12), "{normal:?} {noise} {found:?}");
                assert!(off <= 5.0 * noise + 1e-12);
                // What chance tilts an axis by moves nothing that far off, but for a row or two.
                if normal.contains(&1.0) && offset == 5.0 {
                    assert_eq!([found.x, found.y], [frame.x, frame.y], "{noise}");
                }
                assert!(
                    norm(cross(found.origin, found.normal())) < 1e-9 * offset.abs(),
                    "foot of the origin"
                );
            }
        }
        // As planes that cut: what is no more than rounding does not turn the axes.
        let flat = Plane { normal: [1e-17, 0.0, 1.0], offset: 5.0 }.frame().unwrap();
        assert_eq!((flat.x[0], flat.y[1]), (1.0, 1.0));
        // A tilt that the points tell is kept.
        let told = Plane { normal: [1e-3, 0.0, 1.0], offset: 5.0 }.frame().unwrap();
        let points: Vec<Point> =
            (0..100).map(|i| libm::sincos(0.06 * f64::from(i))).map(|(s, c)| told.place([s, c])).collect();
        assert!(norm(minus(PlaneFrame::through(&points).unwrap().0.x, told.x)) < 1e-12);
    }

    /// A pyramid of five vertices at two heights that broke loops elsewhere; its tip; a plane beside it.
    #[test]
    fn heights_at_and_near_vertices() {
        let positions = vec![
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [4.0, 4.0, 0.0],
            [0.0, 4.0, 0.0],
            [2.0, 2.0, 3.0283334255218506],
        ];
        let faces = vec![[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let mesh = Mesh { positions, faces };
        for (offset, loops) in [(3.0, 1), (3.0283334255218506, 0), (0.0, 0), (1e-300, 1), (-1.0, 0), (9.0, 0)]
        {
            let chains = cut(&mesh, &Plane { normal: [0.0, 0.0, 1.0], offset }, &Silent).unwrap();
            assert_eq!(chains.len(), loops, "{offset}: {chains:?}");
            assert!(chains.iter().all(|c| c.closed));
        }
        let open = Mesh { faces: mesh.faces[2..5].to_vec(), ..mesh };
        let chains = cut(&open, &Plane { normal: [0.0, 0.0, 1.0], offset: 1.0 }, &Silent).unwrap();
        assert!(chains.len() == 1 && !chains[0].closed && chains[0].points.len() == 4);
    }
}
