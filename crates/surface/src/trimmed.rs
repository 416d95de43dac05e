//! Facets of a surface within an outline.

use super::outline::{Outline, from_segment};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::Point;
use trueness_geom::spline::surface::{Patches, Surface};
use trueness_geom::topology::union::Sets;

/// Share of the tolerance for the rows and columns that facets are made of. At the outline a facet may reach over a
/// little more than two of them in each direction. Its distance from the surface grows with the square.
const GRID_TOLERANCE_SHARE: f64 = 0.2;
/// Nothing is added nearer to a place or side of the outline than this share of a cell: between them facets would be needles.
const MIN_DISTANCE_CELLS: f64 = 0.2;

/// A place in the parameters.
type Parameters = Point2<f64>;

/// Facets of the surface within the outline, within `tolerance` of it; `None` if that takes more than `most`.
///
/// Vertices are those of
/// [`Surface::tessellate`] that lie inside and not close to the outline. Others are places of the outline where its rows and columns cross it. Facets are those of their constrained Delaunay triangulation in the parameters, and look the way of the surface's normal. Parts that do not hang together share no vertex. Cost: `n
/// log n`.
///
/// # Errors
/// [`Cancelled`].
pub fn trimmed(
    surface: &Surface<Point>,
    outline: &Outline,
    tolerance: f64,
    most: usize,
    progress: &dyn Progress,
) -> Result<Option<Mesh>, Cancelled> {
    let Some([us, vs]) = surface.grid(GRID_TOLERANCE_SHARE * tolerance, most) else { return Ok(None) };
    let grid = Grid { lines: [&us, &vs] };
    let (mut places, mut edges) = (vec![], vec![]);
    let mut is_close = vec![false; us.len() * vs.len()];
    for corners in outline.regions.iter().flat_map(|region| region.loops()) {
        let first = places.len();
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).for_each(|(a, b)| grid.side(*a, *b, &mut places));
        for k in first..places.len() {
            let next = if k + 1 == places.len() { first } else { k + 1 };
            grid.close_to(places[k], places[next], |[i, j]| is_close[i * vs.len() + j] = true);
            edges.push([k, next]);
        }
    }
    let mut places: Vec<Parameters> = places.into_iter().map(|[u, v]| Parameters::new(u, v)).collect();
    for i in 1..us.len() - 1 {
        let crossings = outline.crossings(us[i]);
        let is_inside = |j: &usize| {
            !crossings.partition_point(|c| *c < vs[*j]).is_multiple_of(2) && !is_close[i * vs.len() + j]
        };
        places.extend((1..vs.len() - 1).filter(is_inside).map(|j| Parameters::new(us[i], vs[j])));
    }
    if progress.cancelled() {
        return Err(Cancelled);
    }
    let Some(made) = triangulation(places, edges) else { return Ok(None) };
    let patches = Patches::new(surface);
    let positions = made.vertices().map(|v| patches.at(v.position().x, v.position().y)).collect();
    let is_inside = inside(&made, outline);
    let kept = made.inner_faces().filter(|face| is_inside[face.fix().index()]);
    let faces: Vec<[u32; 3]> = kept.map(|face| face.vertices().map(|v| v.fix().index() as u32)).collect();
    Ok((faces.len() <= most).then_some(Mesh { positions, faces }))
}

/// The triangulation with these edges; where edges cross, with a vertex there. `None` if a coordinate is not finite.
fn triangulation(
    places: Vec<Parameters>,
    edges: Vec<[usize; 2]>,
) -> Option<ConstrainedDelaunayTriangulation<Parameters>> {
    let mut crossing = vec![];
    let mut made =
        ConstrainedDelaunayTriangulation::try_bulk_load_cdt(places, edges, |edge| crossing.push(edge))
            .ok()?;
    for ends in crossing {
        let [from, to] = ends.map(FixedVertexHandle::from_index);
        made.add_constraint_and_split(from, to, |place| place);
    }
    Some(made)
}

/// For each face, by its number, whether it is inside. Faces that no edge of the outline parts are so together; the largest of them
/// decides, for of a needle at the outline rounding would.
fn inside(made: &ConstrainedDelaunayTriangulation<Parameters>, outline: &Outline) -> Vec<bool> {
    let sets = Sets::new(made.num_all_faces());
    for edge in made.undirected_edges().filter(|edge| !edge.is_constraint_edge()) {
        let side = edge.as_directed();
        sets.join(side.face().fix().index() as u32, side.rev().face().fix().index() as u32);
    }
    let mut largest = vec![(0.0, [0.0; 2]); made.num_all_faces()];
    for face in made.inner_faces() {
        let of_all = &mut largest[sets.root(face.fix().index() as u32) as usize];
        let area = face.area();
        if area > of_all.0 {
            let middle = face.center();
            *of_all = (area, [middle.x, middle.y]);
        }
    }
    // Faces that hang together with the outer one, of number 0, are outside.
    let outer = sets.root(0);
    let holds: Vec<bool> =
        (0..).zip(&largest).map(|(i, (area, at))| i != outer && *area > 0.0 && outline.holds(*at)).collect();
    (0..largest.len() as u32).map(|i| holds[sets.root(i) as usize]).collect()
}

/// Rows and columns of parameters, ascending.
struct Grid<'a> {
    lines: [&'a [f64]; 2],
}

impl Grid<'_> {
    /// How far two places are from each other, in cells at the first.
    fn cells(&self, a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
        std::array::from_fn(|k| {
            let lines = self.lines[k];
            let after = lines.partition_point(|x| *x <= a[k]).clamp(1, lines.len() - 1);
            (b[k] - a[k]) / (lines[after] - lines[after - 1])
        })
    }

    /// Adds the start of a side, and where lines of either direction cross it.
    fn side(&self, a: [f64; 2], b: [f64; 2], places: &mut Vec<[f64; 2]>) {
        let mut crossings: Vec<(f64, [f64; 2])> = vec![];
        for k in 0..2 {
            let (low, high) = (a[k].min(b[k]), a[k].max(b[k]));
            let lines = self.lines[k];
            let within = lines.partition_point(|x| *x <= low)..lines.partition_point(|x| *x < high);
            for x in lines.get(within).into_iter().flatten() {
                let share = (x - a[k]) / (b[k] - a[k]);
                let mut place: [f64; 2] = std::array::from_fn(|j| a[j] + share * (b[j] - a[j]));
                place[k] = *x;
                crossings.push((share, place));
            }
        }
        crossings.sort_by(|x, y| x.0.total_cmp(&y.0));
        places.push(a);
        let is_apart =
            |p: [f64; 2], q: [f64; 2]| self.cells(p, q).iter().any(|x| x.abs() > MIN_DISTANCE_CELLS);
        let mut last = a;
        for (_, place) in crossings {
            if is_apart(place, last) && is_apart(place, b) {
                places.push(place);
                last = place;
            }
        }
    }

    /// Names the nodes that are close to the side from `a` to `b`.
    fn close_to(&self, a: [f64; 2], b: [f64; 2], mut take: impl FnMut([usize; 2])) {
        let around = |k: usize| {
            let (lines, low, high) = (self.lines[k], a[k].min(b[k]), a[k].max(b[k]));
            lines.partition_point(|x| *x < low).saturating_sub(1)
                ..(lines.partition_point(|x| *x <= high) + 1).min(lines.len())
        };
        for i in around(0) {
            for j in around(1) {
                let node = [self.lines[0][i], self.lines[1][j]];
                let [to_a, to_b] = [a, b].map(|p| self.cells(node, p));
                if from_segment([0.0; 2], to_a, to_b) < MIN_DISTANCE_CELLS {
                    take([i, j]);
                }
            }
        }
    }
}
