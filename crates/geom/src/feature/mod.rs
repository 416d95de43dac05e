//! Features of a measured part, found with the help of the nominal model.
//!
//! The facet nearest to a place of the nominal feature is the start; facets next to those found join them as long as they
//! keep the rules of the feature: near the nominal surface, facing as it does, within its bounds. The points of the feature
//! are the distinct vertices of the facets found. After Xu and Yang, A digital quality characterization technique for 3D
//! printing based on the STL model (in Chinese), section 3. Where they start from one facet, several starts are taken, so
//! that a hole at the middle or a gap in the scan loses nothing; and a distance from the nominal bounds planes too.

mod beside;
mod bounds;
mod nominal;
mod rules;
mod surface;

pub use beside::{Piece, pieces_beside};
pub use nominal::{FeatureError, Nearness, Nominal};
pub use surface::NominalSurface;

use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::space::{Point, cross, minus, norm, normal};
use rules::Rules;
use std::collections::BTreeSet;

/// What was found of a feature.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// Numbers of the facets, ascending; none in a cloud.
    pub facets: Vec<u32>,
    /// Numbers of their vertices (without the rim, where it does not count), or of the points of a cloud, ascending.
    pub points: Vec<u32>,
    /// Area of the facets, mm².
    pub area: f64,
}

/// The facets of `mesh` that belong to `nominal`, and their vertices. `tree` is the search tree of the same mesh.
///
/// Facets without area, or with a vertex that does not exist, belong to nothing. An empty answer is no error: the feature
/// was not measured. Cost: some searches, one table of edges, and one look at each facet next to those found.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense, [`FeatureError::Cancelled`].
///
/// ```
/// use trueness_geom::closest::Tree;
/// use trueness_geom::feature::{Nearness, Nominal, in_mesh};
/// use trueness_geom::mesh::Mesh;
/// // A square floor of two facets, and a wall.
/// let positions = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 9.0]];
/// let mesh = Mesh { positions, faces: vec![[0, 1, 2], [0, 2, 3], [0, 4, 1]] };
/// let tree = Tree::build(&mesh)?;
/// let boundary = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0]];
/// let floor = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary };
/// let near = Nearness { distance: 0.1, angle: 0.2, margin: 0.0, rim: true };
/// let found = in_mesh(&mesh, &tree, &floor, &near, &trueness_geom::progress::Silent)?;
/// assert_eq!((found.facets, found.points), (vec![0, 1], vec![0, 1, 2, 3]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn in_mesh(
    mesh: &Mesh,
    tree: &Tree,
    nominal: &Nominal,
    near: &Nearness,
    progress: &dyn Progress,
) -> Result<Found, FeatureError> {
    let rules = Rules::new(nominal, near)?;
    let corners = |f: u32| -> Option<[Point; 3]> {
        let [a, b, c] = *mesh.faces.get(f as usize)?;
        let at = |v: u32| mesh.positions.get(v as usize).copied();
        Some([at(a)?, at(b)?, at(c)?])
    };
    let belongs =
        |f: u32| corners(f).is_some_and(|corners| normal(corners).is_some_and(|n| rules.facet(corners, n)));
    let starts = rules.starts();
    let nearest = starts.iter().filter_map(|p| tree.closest(p, f64::INFINITY).ok().flatten());
    let mut found: BTreeSet<u32> = nearest.map(|c| c.face).filter(|f| belongs(*f)).collect();
    if found.is_empty() {
        return Ok(Found::default());
    }
    let edges = edges(mesh);
    let across = |edge: [u32; 2]| {
        let first = edges.partition_point(|e| e.0 < edge);
        edges[first..].iter().take_while(move |e| e.0 == edge).map(|e| e.1)
    };
    let mut front: Vec<u32> = found.iter().copied().collect();
    let mut beside = vec![];
    while let Some(facet) = front.pop() {
        if found.len().is_multiple_of(1024) && progress.cancelled() {
            return Err(FeatureError::Cancelled);
        }
        for other in sides(&mesh.faces[facet as usize]).into_iter().flat_map(across) {
            if found.contains(&other) {
                continue;
            }
            if belongs(other) {
                found.insert(other);
                front.push(other);
            } else {
                beside.push(other);
            }
        }
    }
    // A spike or a dent is steep and belongs to the feature all the same: what lies near and has the feature all around it.
    let is_near = |f: u32| corners(f).is_some_and(|c| rules.tilted(c));
    let across_all =
        |facet: u32| sides(&mesh.faces[facet as usize]).map(|edge| across(edge).collect::<Vec<u32>>());
    enclosed(&mut found, beside, is_near, across_all, progress)?;
    let area = |f: &u32| corners(*f).map_or(0.0, |[a, b, c]| 0.5 * norm(cross(minus(b, a), minus(c, a))));
    let mut points: BTreeSet<u32> = found.iter().flat_map(|f| mesh.faces[*f as usize]).collect();
    if !near.rim {
        let others = (0..).zip(&mesh.faces).filter(|(f, _)| !found.contains(f));
        others.flat_map(|(_, face)| face).for_each(|v| {
            points.remove(v);
        });
    }
    Ok(Found {
        area: found.iter().map(area).sum(),
        facets: found.into_iter().collect(),
        points: points.into_iter().collect(),
    })
}

/// The points of a cloud that belong to `nominal`: those near it and within its bounds. A cloud without normals does not
/// tell which way it faces; what lies behind a thin wall is kept apart by the distance alone.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense.
pub fn in_cloud(points: &[Point], nominal: &Nominal, near: &Nearness) -> Result<Found, FeatureError> {
    let rules = Rules::new(nominal, near)?;
    let points = (0..points.len() as u32).filter(|i| rules.point(points[*i as usize])).collect();
    Ok(Found { facets: vec![], points, area: 0.0 })
}

/// Adds the parts, of those that begin with `beside`, whose facets are all near and lie among others on all sides.
fn enclosed(
    found: &mut BTreeSet<u32>,
    beside: Vec<u32>,
    is_near: impl Fn(u32) -> bool,
    across: impl Fn(u32) -> [Vec<u32>; 3],
    progress: &dyn Progress,
) -> Result<(), FeatureError> {
    let mut seen: BTreeSet<u32> = BTreeSet::new();
    for start in beside {
        if found.contains(&start) || !is_near(start) || !seen.insert(start) {
            continue;
        }
        let (mut part, mut next, mut enclosed) = (vec![start], 0, true);
        while let Some(facet) = part.get(next).copied() {
            if next.is_multiple_of(1024) && progress.cancelled() {
                return Err(FeatureError::Cancelled);
            }
            next += 1;
            for there in across(facet) {
                // Nothing encloses what ends at a free edge.
                enclosed &= there.len() > 1;
                for other in there.into_iter().filter(|f| !found.contains(f)) {
                    if !is_near(other) {
                        enclosed = false;
                    } else if seen.insert(other) {
                        part.push(other);
                    }
                }
            }
        }
        if enclosed {
            found.extend(part);
        }
    }
    Ok(())
}

/// Each facet under each of its edges, in the order of the edges.
fn edges(mesh: &Mesh) -> Vec<([u32; 2], u32)> {
    let of = |(f, face): (usize, &[u32; 3])| sides(face).map(|edge| (edge, f as u32));
    let mut all: Vec<([u32; 2], u32)> = mesh.faces.iter().enumerate().flat_map(of).collect();
    all.sort_unstable();
    all
}

/// The edges of a facet, lower vertex first.
fn sides([a, b, c]: &[u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[p, q]| [*p.min(q), *p.max(q)])
}
