//! The form of a kind of defect and of what is found.

use super::{Options, boundary::Boundary, intersect::Crossings};
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::space::{Aabb, Point};
use crate::topology::{Properties, Topology};
use std::sync::OnceLock;

/// How much a defect matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The mesh does not bound a solid, or not a sensible one.
    Error,
    /// The mesh is sound, but something may be meant otherwise.
    Warning,
}

impl Severity {
    /// All of them.
    pub const ALL: [Severity; 2] = [Severity::Error, Severity::Warning];

    /// Its name: `error` or `warning`.
    pub fn name(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
        }
    }
}

impl PartialEq for DefectKind {
    fn eq(&self, other: &DefectKind) -> bool {
        self.name == other.name
    }
}

/// The quantity that the size of a finding measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Length of an edge or a line.
    Length,
    /// Length of a ring.
    Perimeter,
    /// Height of a facet over its longest edge: the less, the worse.
    Height,
    /// Distance of two places.
    Distance,
    /// Diagonal of a box.
    Diagonal,
    /// Area.
    Area,
    /// Volume.
    Volume,
    /// Number of facets.
    Facets,
    /// Number of neighbors that are missing.
    Missing,
}

impl Measure {
    /// Whether a finding is the worse, the less it measures.
    pub fn less_is_worse(self) -> bool {
        self == Measure::Height
    }
}

/// The part of a finding that shows where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shows {
    /// Its vertices.
    Points,
    /// The line through its vertices.
    Line,
    /// The ring through its vertices.
    Ring,
    /// The first vertex, which lies on the edge between the others.
    PointAndLine,
    /// Its facets.
    Facets,
    /// All facets connected with the first of its own.
    Shell,
}

/// A kind of defect: an entry of [`KINDS`](super::KINDS).
#[derive(Debug)]
pub struct DefectKind {
    /// Its name in result documents.
    pub name: &'static str,
    /// How much it matters.
    pub severity: Severity,
    /// One sentence for the manual.
    pub about: &'static str,
    /// The quantity that [`Finding::size`] measures, with its unit.
    pub size: &'static str,
    /// The same as one of few.
    pub measure: Measure,
    /// The part of a finding that shows where it is.
    pub shows: Shows,
    /// Whether it only follows from holes and cracks, which are told before it.
    pub follows: bool,
    /// Why it may not be looked for; `None`: it always is.
    pub missing: Option<&'static str>,
    /// Looks for it; `None` where it cannot be looked for.
    pub find: fn(&Inspected) -> Option<Found>,
}

/// One place where something is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The facets concerned, ascending unless the kind says otherwise.
    pub facets: Vec<u32>,
    /// The vertices concerned, in the order the kind says.
    pub vertices: Vec<u32>,
    /// A place to look at: the middle of `bounds`.
    pub position: Point,
    /// Box of the vertices, or of the facets where there are none.
    pub bounds: Aabb,
    /// How big it is; the kind says in what sense.
    pub size: f64,
    /// Further numbers, by name.
    pub measures: Vec<(&'static str, f64)>,
}

/// All findings of a kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// Their number.
    pub count: usize,
    /// There are more than `count`: they were not counted to the end.
    pub at_least: bool,
    /// The first ones, as many as [`Options::limit`] allows.
    pub items: Vec<Finding>,
}

/// The data that a kind may look at.
pub struct Inspected<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// How its facets hang together.
    pub topology: &'a Topology,
    /// Size and place.
    pub properties: &'a Properties,
    /// Its boundary, taken apart.
    pub(crate) boundary: &'a Boundary,
    /// For each shell how often the other closed shells wind around it, made when first asked for.
    pub(crate) depths: &'a OnceLock<Vec<i32>>,
    /// The normals that a file stores with its facets.
    pub stored_normals: Option<&'a [[f32; 3]]>,
    /// Pairs of facets that meet where they should not, if looked for.
    pub crossings: Option<&'a Crossings>,
    /// The options asked for.
    pub options: &'a Options,
    /// Distance, mm, up to which two places may have been meant as one.
    pub gap: f64,
    /// Asked by kinds that may take long; whoever calls them throws away what they found by then.
    pub(crate) progress: &'a dyn Progress,
}

impl Inspected<'_> {
    /// A finding that concerns these facets and vertices.
    pub(super) fn finding(&self, facets: Vec<u32>, vertices: Vec<u32>, size: f64) -> Finding {
        let place = |v: &u32| self.mesh.positions.get(*v as usize);
        let of_facets = facets.iter().filter_map(|f| self.mesh.faces.get(*f as usize)).flatten();
        let bounds = if vertices.is_empty() {
            Aabb::of(of_facets.filter_map(place))
        } else {
            Aabb::of(vertices.iter().filter_map(place))
        };
        let position = std::array::from_fn(|k| bounds.min[k] / 2.0 + bounds.max[k] / 2.0);
        Finding { facets, vertices, position, bounds, size, measures: vec![] }
    }

    /// A finding for each of `places`, as far as the limit allows; all are counted.
    pub(super) fn each<T>(&self, places: &[T], finding: impl Fn(&T) -> Finding) -> Option<Found> {
        let items = places.iter().take(self.options.limit).map(finding).collect();
        Some(Found { count: places.len(), at_least: false, items })
    }

    /// The corners of a facet.
    pub(super) fn corners(&self, facet: u32) -> [Point; 3] {
        self.mesh.corners(facet)
    }

    /// Distance of two vertices.
    pub(super) fn distance(&self, [a, b]: [u32; 2]) -> f64 {
        let at = |v: u32| self.mesh.positions[v as usize];
        crate::space::norm(crate::space::minus(at(a), at(b)))
    }
}

/// Area of a triangle.
pub fn area([a, b, c]: [Point; 3]) -> f64 {
    use crate::space::{cross, minus, norm};
    0.5 * norm(cross(minus(b, a), minus(c, a)))
}
