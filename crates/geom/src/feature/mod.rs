//! Features of a measured part, found with the help of the nominal model.
//!
//! The facet nearest to a place of the nominal feature is the start; facets next to those found join them as long as they
//! keep the rules of the feature: near the nominal surface, facing as it does, within its bounds. The points of the feature
//! are the distinct vertices of the facets found. After Xu and Yang, A digital quality characterization technique for 3D
//! printing based on the STL model (in Chinese), section 3. Where they start from one facet, several starts are taken, so
//! that a hole at the middle or a gap in the scan loses nothing; and a distance from the nominal bounds planes too.

mod bounds;
mod rules;
mod surface;

use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::space::{Point, Vector, cross, minus, norm, plus, times, unit};
use rules::Rules;
use std::collections::BTreeSet;
pub use surface::Surface;

/// A feature as the model has it, in the model's coordinates, millimetres and radians. Directions need not be unit vectors.
#[derive(Clone, Debug, PartialEq)]
pub enum Nominal {
    /// A plane within a boundary: the corners of a polygon, in order.
    Plane {
        /// A point of it.
        point: Point,
        /// Normal, out of the material.
        normal: Vector,
        /// Corners, at least three.
        boundary: Vec<Point>,
    },
    /// A cylinder between two planes across its axis.
    Cylinder {
        /// Start of the axis.
        point: Point,
        /// Direction of the axis, from the start.
        direction: Vector,
        /// Radius.
        radius: f64,
        /// Length of the axis.
        length: f64,
    },
    /// A cone between two planes across its axis.
    Cone {
        /// Its tip.
        apex: Point,
        /// Direction of the axis, from the tip into the cone.
        direction: Vector,
        /// Angle between axis and surface.
        half_angle: f64,
        /// Where it begins and ends, as distances from the tip along the axis.
        between: [f64; 2],
    },
    /// A sphere, or the part of one that is there.
    Sphere {
        /// Its center.
        center: Point,
        /// Radius.
        radius: f64,
    },
    /// An edge where two planes meet: its rounding or chamfer.
    Edge {
        /// Start of the edge.
        point: Point,
        /// Direction, from the start.
        direction: Vector,
        /// Length.
        length: f64,
        /// Normals of the two planes, out of the material.
        normals: [Vector; 2],
    },
}

/// How near a facet must be to the nominal feature to belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearness {
    /// Greatest distance of its corners from the nominal surface, millimetres.
    pub distance: f64,
    /// Greatest angle of its normal to the nominal one, radians. Facets of any angle that others of the feature enclose count
    /// too: a spike or a dent.
    pub angle: f64,
    /// What is left out along the bounds of the feature, millimetres; below zero, how far it may reach beyond them.
    pub margin: f64,
    /// Whether vertices that facets of other features share count: on a sharp edge they belong to both.
    pub rim: bool,
}

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

/// Why a feature cannot be sought.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FeatureError {
    /// A number of the nominal feature is not finite.
    #[error("a number of the nominal feature is not finite")]
    NotFinite,
    /// A direction has no length.
    #[error("the {what} of the nominal feature has no length")]
    NoDirection {
        /// Which.
        what: &'static str,
    },
    /// A size is not above zero.
    #[error("the {what} of the nominal feature is {value}; it must be above 0")]
    Size {
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// The boundary of a plane encloses nothing.
    #[error("the boundary of the nominal plane needs at least three corners that enclose an area")]
    Boundary,
    /// Stopped through the progress argument.
    #[error("cancelled")]
    Cancelled,
}

impl Nominal {
    /// Places that tell roughly where it is, millimetres: corners, ends of an axis, a center. Not exact bounds.
    pub fn places(&self) -> Vec<Point> {
        let along = |p: &Point, d: &Vector, by: f64| {
            let way = unit(*d).map_or([0.0; 3], |(d, _)| times(by, d));
            plus(*p, way)
        };
        match self {
            Nominal::Plane { boundary, .. } => boundary.clone(),
            Nominal::Cylinder { point, direction, length, .. }
            | Nominal::Edge { point, direction, length, .. } => {
                vec![*point, along(point, direction, *length)]
            }
            Nominal::Cone { apex, direction, between, .. } => {
                between.iter().map(|by| along(apex, direction, *by)).collect()
            }
            Nominal::Sphere { center, .. } => vec![*center],
        }
    }

    /// Area of the feature as the model has it, holes in it not taken off, mm²; of an edge, `None`.
    pub fn area(&self) -> Option<f64> {
        let turn = std::f64::consts::TAU;
        match self {
            Nominal::Plane { point, normal, boundary } => {
                bounds::Polygon::new(*point, *normal, boundary).map(|p| p.area())
            }
            Nominal::Cylinder { radius, length, .. } => Some(turn * radius * length),
            Nominal::Cone { half_angle, between: [from, to], .. } => {
                let slope = libm::tan(*half_angle);
                Some(0.5 * turn * slope * (to * to - from * from).abs() / libm::cos(*half_angle))
            }
            Nominal::Sphere { radius, .. } => Some(2.0 * turn * radius * radius),
            Nominal::Edge { .. } => None,
        }
    }
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
    let belongs = |f: u32| {
        corners(f).is_some_and(|[a, b, c]| {
            unit(cross(minus(b, a), minus(c, a))).is_some_and(|(n, _)| rules.facet([a, b, c], n))
        })
    };
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
