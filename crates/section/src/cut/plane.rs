//! Where a plane cuts a mesh: closed loops out of closed meshes, by the identity of edges.
//!
//! Vertices are above, below or on the plane, decided exactly. One rule settles places on it: they count as above, as
//! if the plane were lower by less than any number. So a facet is cut in no or in two edges, never in a vertex. A facet
//! in the plane is not cut at all. The loops of a closed mesh close, whatever the plane passes through. The place of a
//! cut edge is computed once, from its lower-numbered end, and shared by the facets on both sides.

use super::edge_chain::{Edge, EdgeChain, edge_chains};
use trueness_geom::mesh::Mesh;
use trueness_geom::plane::{Plane, PlaneFrame};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, minus, norm, plus, times};

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
/// use trueness_geom::{mesh::Mesh, plane::Plane, progress::Silent};
/// use trueness_section::cut;
/// let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let mesh = Mesh { positions, faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] };
/// let chains = cut(&mesh, &Plane { normal: [0.0, 0.0, 1.0], offset: 0.5 }, &Silent).unwrap();
/// assert!(chains.len() == 1 && chains[0].closed && chains[0].points.len() == 3);
/// ```
pub fn cut(mesh: &Mesh, plane: &Plane, progress: &dyn Progress) -> Result<Vec<Chain>, Cancelled> {
    let above: Vec<bool> = mesh.positions.iter().map(|p| plane.side(p) >= 0).collect();
    chains(mesh, plane, mesh.faces.iter(), |v| above[v as usize], progress)
}

/// As [`cut`], of the facets with these numbers alone: those of [`facets_near`](crate::facets_near), in ascending order, give the same
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
    let [a, b] = mesh.places(&edge);
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
/// Each chain counts by the way it runs round. An area that several enclose, as where shells overlap or are doubled,
/// counts as often, and chains of shells turned inside out count below 0. Open chains do not count.
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
    use trueness_geom::num::random::Random;
    use trueness_geom::progress::Silent;
    use trueness_geom::space::{cross, dot};

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
            let p = mesh.places(face);
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
