//! Facets of a surface within an outline.

use super::outline::Outline;
use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress};
use crate::space::Point;
use crate::spline::surface::{Patches, Surface};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Of the tolerance, for the rows and columns that facets are made of: at the outline a facet may reach over two of them in each
/// direction, and its distance from the surface grows with the square.
const FINER: f64 = 0.25;
/// Vertices of rows and columns nearer to the outline than this share of the domain are left out: the outline has its own there.
const APART: f64 = 1e-9;

/// A place in the parameters.
type Place = Point2<f64>;

/// Facets of the surface within the outline, within `tolerance` of it; `None` if that takes more than `most`.
///
/// Vertices are those of [`Surface::tessellate`] that lie inside, and places of the outline where its rows and columns cross it; facets are
/// those of their constrained Delaunay triangulation in the parameters, and look the way of the surface's normal. Parts that
/// do not hang together share no vertex. Cost: `n log n`.
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
    let Some([us, vs]) = surface.grid(FINER * tolerance, most) else { return Ok(None) };
    let (mut places, mut edges) = (vec![], vec![]);
    for corners in outline.regions.iter().flat_map(|region| region.loops()) {
        let first = places.len();
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).for_each(|(a, b)| side(*a, *b, [&us, &vs], &mut places));
        let last = places.len();
        edges.extend((first..last).map(|k| [k, if k + 1 == last { first } else { k + 1 }]));
    }
    let of_outline = places.len();
    let margin = [&us, &vs].map(|lines| APART * (lines[lines.len() - 1] - lines[0]));
    for u in &us[1..us.len() - 1] {
        let crossings = outline.crossings(*u);
        let is_inside = |v: &&f64| {
            let before = crossings.partition_point(|c| c < *v);
            let near =
                crossings[before.saturating_sub(1)..].iter().take(2).any(|c| (c - **v).abs() <= margin[1]);
            !before.is_multiple_of(2) && !near
        };
        places.extend(vs[1..vs.len() - 1].iter().filter(is_inside).map(|v| Place::new(*u, *v)));
    }
    if progress.cancelled() {
        return Err(Cancelled);
    }
    // A part of the outline that crosses another one is left out; all coordinates are finite.
    let made = ConstrainedDelaunayTriangulation::<Place>::try_bulk_load_cdt(places.clone(), edges, |_| {});
    let Ok(made) = made else { return Ok(None) };
    let rim: std::collections::HashSet<[u64; 2]> = places[..of_outline].iter().map(bits).collect();
    let patches = Patches::new(surface);
    let mut mesh = Mesh::default();
    mesh.positions.extend(made.vertices().map(|v| patches.at(v.position().x, v.position().y)));
    for face in made.inner_faces() {
        let corners = face.vertices();
        let middle = || {
            let sum =
                corners.iter().fold([0.0; 2], |sum, v| [sum[0] + v.position().x, sum[1] + v.position().y]);
            sum.map(|x| x / 3.0)
        };
        // A facet with a corner inside is inside: no facet crosses the outline.
        if corners.iter().any(|v| !rim.contains(&bits(&v.position()))) || outline.holds(middle()) {
            mesh.faces.push(corners.map(|v| v.fix().index() as u32));
        }
    }
    Ok((mesh.faces.len() <= most).then_some(mesh))
}

fn bits(p: &Place) -> [u64; 2] {
    [p.x, p.y].map(|x| (x + 0.0).to_bits())
}

/// Adds the start of a side, and where lines of either direction cross it.
fn side(a: [f64; 2], b: [f64; 2], lines: [&[f64]; 2], places: &mut Vec<Place>) {
    let mut crossings: Vec<(f64, [f64; 2])> = vec![];
    for k in 0..2 {
        let (low, high) = (a[k].min(b[k]), a[k].max(b[k]));
        let within = lines[k].partition_point(|x| *x <= low)..lines[k].partition_point(|x| *x < high);
        for x in lines[k].get(within).into_iter().flatten() {
            let share = (x - a[k]) / (b[k] - a[k]);
            let mut place: [f64; 2] = std::array::from_fn(|j| a[j] + share * (b[j] - a[j]));
            place[k] = *x;
            crossings.push((share, place));
        }
    }
    crossings.sort_by(|x, y| x.0.total_cmp(&y.0));
    places.push(Place::new(a[0], a[1]));
    let mut last = 0.0;
    for (share, [u, v]) in crossings {
        // Where two lines cross on the side, one place stands for both.
        if share - last > APART && share < 1.0 - APART {
            places.push(Place::new(u, v));
            last = share;
        }
    }
}
