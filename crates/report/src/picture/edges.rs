//! The sharp edges of a surface as lines: without them faces of one color run into each other.

use super::camera::Camera;
use super::canvas::{Band, Canvas, SAMPLES_PER_PIXEL};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point, Vector, cross, dot, minus, norm, plus, unit};

/// Cosine of the angle (30 degrees) between facets beyond which they have an edge between them.
const CREASE_COSINE: f64 = 0.866_025_403_784_438_6;
/// Cosine of the angle (15 degrees) between a facet and the mean around one of its corners. From there on the corner lies on a crease,
/// and the facet keeps its own normal throughout.
const BENT_CORNER_COSINE: f64 = 0.965_925_826_289_068_3;
/// Width of a line in samples.
const EDGE_WIDTH: f64 = 1.3 * SAMPLES_PER_PIXEL as f64;
/// How much of what lies under an edge it covers.
const EDGE_OPACITY: f64 = 0.75;
/// Edges may cover this share of the surface; where they lie denser than that they step back, for the colors' sake.
const MAX_EDGE_SHARE: f64 = 0.1;
/// Fainter than this they are left out.
const MIN_EDGE_OPACITY: f64 = 0.15;
/// Rows of edges up to this long are short, as a share of the largest extent.
const MAX_SHORT_EXTENT: f64 = 1.0 / 30.0;
/// What they are darkened to.
const EDGE_BRIGHTNESS: f64 = 20.0;

/// One facet at an edge.
struct Side {
    /// The places at its ends, the lower number first.
    ends: [u32; 2],
    facet: u32,
    /// The place of the facet's third corner.
    opposite: u32,
    /// The facet runs along it from the higher number to the lower.
    turned: bool,
}

/// Normals of the vertices, area-weighted; none on creases, and where the facets around cancel out.
pub fn smooth_normals(mesh: &Mesh) -> Vec<Option<Vector>> {
    let mut sums = vec![[0.0; 3]; mesh.positions.len()];
    let facets: Vec<Option<Vector>> = mesh.faces.par_iter().map(|f| facet(mesh, f)).collect();
    for (face, n) in mesh.faces.iter().zip(&facets) {
        let Some(n) = n else { continue };
        face.iter().for_each(|v| sums[*v as usize] = plus(sums[*v as usize], *n));
    }
    let mut normals: Vec<Option<Vector>> = sums.into_par_iter().map(|n| unit(n).map(|(n, _)| n)).collect();
    let bent = |(face, n): (&[u32; 3], &Option<Vector>)| {
        let n = n.and_then(unit).map(|(n, _)| n);
        let away =
            |v: u32, n: Vector| normals[v as usize].is_some_and(|mean| dot(mean, n) < BENT_CORNER_COSINE);
        face.map(|v| n.filter(|n| away(v, *n)).map(|_| v as usize))
    };
    let creased: Vec<usize> =
        mesh.faces.par_iter().zip(&facets).flat_map_iter(|pair| bent(pair).into_iter().flatten()).collect();
    creased.into_iter().for_each(|v| normals[v] = None);
    normals
}

/// Draws the edges of a mesh over it, where nothing is in front of them.
pub fn draw(canvas: &mut Canvas, mesh: &Mesh, edges: &[[Point; 2]], camera: &Camera) {
    let length: f64 = edges.iter().map(|[a, b]| norm(minus(*b, *a))).sum();
    let areas: Vec<f64> =
        mesh.faces.par_iter().filter_map(|f| facet(mesh, f)).map(|n| 0.5 * norm(n)).collect();
    let area: f64 = areas.iter().sum();
    let opacity = EDGE_OPACITY * (MAX_EDGE_SHARE * area * camera.scale / (EDGE_WIDTH * length)).min(1.0);
    if edges.is_empty() || opacity.is_nan() || opacity < MIN_EDGE_OPACITY {
        return;
    }
    // What lies in the surface is in front of it.
    let lift = 1e-3 * f64::from(canvas.width);
    for [a, b] in edges {
        let (a, b) = (camera.project(a), camera.project(b));
        let steps = (libm::hypot(b[0] - a[0], b[1] - a[1]) / (0.5 * EDGE_WIDTH)).ceil().clamp(1.0, 1e5);
        for i in 0..=steps as u32 {
            let t = f64::from(i) / steps;
            let [x, y, z] = [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]));
            canvas
                .whole()
                .disc([x, y], 0.5 * EDGE_WIDTH, |canvas, x, y, _| canvas.darken(x, y, z + lift, opacity));
        }
    }
}

impl Band<'_> {
    /// Darkens a sample once, where nothing is in front of the place.
    fn darken(&mut self, x: u32, y: u32, depth: f64, opacity: f64) {
        let at = self.at(x, y);
        // Beside the surface there is nothing to darken.
        if self.edged[at] || depth < f64::from(self.depth[at]) || self.depth[at] == f32::NEG_INFINITY {
            return;
        }
        self.edged[at] = true;
        self.color[at] = self.color[at]
            .map(|c| (f64::from(c) * (1.0 - opacity) + EDGE_BRIGHTNESS * opacity).round() as u8);
    }
}

/// The parts of lines.
pub fn segments(lines: &[Vec<Point>]) -> Vec<[Point; 2]> {
    lines.iter().flat_map(|line| line.windows(2)).map(|ends| [ends[0], ends[1]]).collect()
}

/// The edges at which facets meet at more than 30 degrees. Vertices at one place are one; boundary edges are none, nor is an edge
/// where a facet lies on another, nor a short row of edges that ends on the surface: such are of its roughness.
pub fn sharp(mesh: &Mesh, normals: &[Option<Vector>]) -> Vec<[Point; 2]> {
    let (place, folded) = places(mesh, normals);
    let around = |(n, face): (usize, &[u32; 3])| {
        let whole = face.iter().all(|v| (*v as usize) < place.len());
        let corners = face.map(|v| if whole { place[v as usize] } else { u32::MAX });
        (0..3).filter(move |_| whole).map(move |k| {
            let [a, b, opposite] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
            Side { ends: [a.min(b), a.max(b)], facet: n as u32, opposite, turned: a > b }
        })
    };
    let can_be_sharp = |s: &Side| s.ends[0] != s.ends[1] && s.ends.iter().all(|v| folded[*v as usize]);
    let mut sides: Vec<Side> =
        mesh.faces.par_iter().enumerate().flat_map_iter(around).filter(can_be_sharp).collect();
    sides.par_sort_unstable_by_key(|s| (s.ends, s.facet));
    let edges = sides.chunk_by(|a, b| a.ends == b.ends);
    let sharp = edges.filter(|sides| sides[1..].iter().any(|s| meet_sharply(mesh, &sides[0], s)));
    rows(mesh, sharp.map(|sides| sides[0].ends).collect())
}

/// The edges without short rows of them that end on the surface.
fn rows(mesh: &Mesh, edges: Vec<[u32; 2]>) -> Vec<[Point; 2]> {
    fn root(up: &mut [u32], mut v: u32) -> u32 {
        while up[v as usize] != v {
            up[v as usize] = up[up[v as usize] as usize];
            v = up[v as usize];
        }
        v
    }
    let count = mesh.positions.len();
    let finite = mesh.positions.iter().filter(|p| p.iter().all(|x| x.is_finite()));
    let short = MAX_SHORT_EXTENT * Aabb::of(finite).sides().into_iter().fold(0.0, f64::max);
    let mut up: Vec<u32> = (0..count as u32).collect();
    let mut meeting = vec![0u8; count];
    for [a, b] in &edges {
        let (p, q) = (root(&mut up, *a), root(&mut up, *b));
        up[p as usize] = q;
        for v in [*a, *b] {
            meeting[v as usize] = meeting[v as usize].saturating_add(1);
        }
    }
    let places = |[a, b]: &[u32; 2]| [*a, *b].map(|v| mesh.positions[v as usize]);
    // Of each row by its root.
    let (mut lengths, mut open) = (vec![0.0; count], vec![false; count]);
    for edge in &edges {
        let ([a, b], row) = (places(edge), root(&mut up, edge[0]) as usize);
        lengths[row] += norm(minus(b, a));
        open[row] |= edge.iter().any(|v| meeting[*v as usize] == 1);
    }
    let mut kept = |edge: &&[u32; 2]| {
        let row = root(&mut up, edge[0]) as usize;
        !open[row] || lengths[row] > short
    };
    edges.iter().filter(|edge| kept(edge)).map(places).collect()
}

/// For each vertex the first one at its place, and for that whether an edge can begin there: it has no normal, or is several.
fn places(mesh: &Mesh, normals: &[Option<Vector>]) -> (Vec<u32>, Vec<bool>) {
    // Zero has two signs and is one place.
    let at = |v: &u32| mesh.positions[*v as usize].map(|x| x + 0.0);
    let compare = |a: &u32, b: &u32| {
        let (p, q) = (at(a), at(b));
        let by = |k: usize| p[k].total_cmp(&q[k]);
        by(0).then(by(1)).then(by(2)).then(a.cmp(b))
    };
    let mut order: Vec<u32> = (0..).zip(&mesh.positions).map(|(v, _)| v).collect();
    order.par_sort_unstable_by(compare);
    let mut place = vec![0; order.len()];
    let mut folded = vec![false; order.len()];
    for same in order.chunk_by(|a, b| at(a) == at(b)) {
        let first = same[0] as usize;
        for v in same {
            place[*v as usize] = same[0];
            folded[first] |= normals.get(*v as usize).is_none_or(Option::is_none);
        }
        folded[first] |= same.len() > 1;
    }
    (place, folded)
}

/// Whether two facets of an edge meet at more than 30 degrees.
fn meet_sharply(mesh: &Mesh, a: &Side, b: &Side) -> bool {
    let normal = |s: &Side| mesh.faces.get(s.facet as usize).and_then(|f| facet(mesh, f)).and_then(unit);
    let (Some((m, _)), Some((n, _))) = (normal(a), normal(b)) else { return false };
    // Facets of one orientation run along their edge in opposite ways.
    let along = if a.turned == b.turned { -1.0 } else { 1.0 };
    a.opposite != b.opposite && along * dot(m, n) < CREASE_COSINE
}

/// The normal of a facet, as long as twice its area; none where a corner is missing or not finite.
fn facet(mesh: &Mesh, face: &[u32; 3]) -> Option<Vector> {
    let corner = |k: usize| mesh.positions.get(face[k] as usize).filter(|p| p.iter().all(|x| x.is_finite()));
    let (a, b, c) = (corner(0)?, corner(1)?, corner(2)?);
    Some(cross(minus(*b, *a), minus(*c, *a)))
}

#[cfg(test)]
mod tests {
    use super::super::super::up::Up;
    use super::*;

    /// The cube from −1 to 1, its facets with vertices of their own where `apart`.
    fn cube(apart: bool) -> Mesh {
        let corner = |i: u32| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 1.0 } else { -1.0 });
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces: Vec<[u32; 3]> =
            quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        if !apart {
            return Mesh { positions: (0..8).map(corner).collect(), faces };
        }
        let positions = faces.iter().flatten().map(|v| corner(*v)).collect();
        Mesh { positions, faces: (0..12).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect() }
    }

    #[test]
    fn a_cube_has_twelve_edges_and_no_diagonals() {
        for apart in [false, true] {
            let mut mesh = cube(apart);
            // A facet that lies on another makes no edges.
            mesh.faces.push(mesh.faces[3]);
            let edges = sharp(&mesh, &smooth_normals(&mesh));
            assert_eq!(edges.len(), 12, "{apart}");
            assert!(edges.iter().all(|[a, b]| norm(minus(*b, *a)) == 2.0), "{edges:?}");
        }
    }

    #[test]
    fn a_short_crease_on_a_face_is_roughness() {
        let long = 100.0;
        // A sheet folded by a right angle along its middle, and the same as a scrap beside a large facet.
        let fold = |x: f64| vec![[0.0, 0.0, 0.0], [0.0, x, 0.0], [x, 0.0, 0.0], [0.0, 0.0, x]];
        let faces = vec![[0, 2, 1], [0, 1, 3]];
        let sheet = Mesh { positions: fold(long), faces: faces.clone() };
        assert_eq!(sharp(&sheet, &smooth_normals(&sheet)).len(), 1);
        let beside = [[long, long, 0.0], [0.0, long, 0.0], [0.0, long, long]];
        let scrap = Mesh {
            positions: [fold(1.0), beside.to_vec()].concat(),
            faces: [faces, vec![[4, 5, 6]]].concat(),
        };
        assert!(sharp(&scrap, &smooth_normals(&scrap)).is_empty());
    }

    #[test]
    fn edges_are_darker_than_faces_and_hidden_ones_are_not_drawn() {
        let mesh = cube(false);
        let camera = Camera::first_view(mesh.positions.iter(), Up::Z, [1.0, -1.0, 1.0], [400, 400, 0]);
        let mut canvas = Canvas::new(400, 400);
        for face in &mesh.faces {
            let corners = face.map(|v| camera.project(&mesh.positions[v as usize]));
            canvas.whole().each_sample(&corners, |canvas, x, y, depth, _| {
                canvas.put(x, y, depth as f32, || [200; 3]);
            });
        }
        draw(&mut canvas, &mesh, &sharp(&mesh, &smooth_normals(&mesh)), &camera);
        let at = |p: Point| {
            let [x, y, _] = camera.project(&p);
            canvas.color[y as usize * 400 + x as usize][0]
        };
        assert!(at([0.2, -1.0, 1.0]) < 100, "an edge in front");
        assert_eq!(at([0.2, 0.2, 1.0]), 200, "a diagonal of a face");
        // The edges at the back meet in the middle of the picture too, but the front corner's go the other way.
        assert_eq!(at([-1.0, 0.6, -1.0]), 200, "an edge at the back");
    }
}
