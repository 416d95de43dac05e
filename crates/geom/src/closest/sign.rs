//! Inside or outside a closed mesh, by angle-weighted pseudonormals.
//!
//! The sign is that of `(p - c) · n`, where `c` is the closest point and `n` the pseudonormal of its feature. The pseudonormal
//! is the face's normal, the sum of the two unit normals at an edge, the angle-weighted sum at a corner. With the normal of the
//! closest *face* alone some points near sharp edges and corners get the wrong sign. With the pseudonormal none does on a
//! closed, consistently oriented mesh without self-intersections. (Bærentzen & Aanæs, "Signed distance computation using the
//! angle weighted pseudonormal", IEEE TVCG 2005.) For other meshes see the module `winding`.

use crate::closest::edges::{Across, Fans, ITEMS_PER_QUESTION};
use crate::closest::hit::Hit;
use crate::closest::limits::QueryError;
use crate::closest::query::Query;
use crate::closest::tree::Tree;
use crate::closest::triangle::{self, Feature};
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress, Silent};
use crate::space::{Aabb, Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// The means that the sign of a distance needs in addition to the tree: the neighbors and the pseudonormals. 36 bytes a face.
///
/// Vertices must be shared by index (weld an STL first), and edges must have two faces each. Else the sign near them is that of
/// the closest face alone: [`Signs::loose_edges`] tells. A face without area has no normal and adds nothing to those of its
/// edges and corners.
pub struct Signs {
    tree: Tree,
    /// The face across edge `i` (corner `i` to `i + 1`) of each slot.
    across: Vec<[Across; 3]>,
    /// Angle-weighted normal of each vertex of the tree (not of unit length).
    corner: Vec<Vector>,
    /// Farther away than this all places have the sign `outer`, where the mesh is closed. So far away rounding has eaten the
    /// direction to it.
    far: f64,
    outer: f64,
}

/// Diagonals of the box from which on a point is far.
const FAR_DIAGONALS: f64 = 1e9;

/// Unit normal of a triangle, or zero if it has none.
fn normal(t: &[Point; 3]) -> Vector {
    unit(triangle::normal(t)).map_or([0.0; 3], |n| n.0)
}

/// Signed volume, up to a factor and rounding; the same for any number of threads.
fn volume(tree: &Tree, origin: Point) -> f64 {
    let part = |slots: std::ops::Range<u32>| -> f64 {
        slots.map(|s| tree.triangle(s).map(|p| minus(p, origin))).map(|[a, b, c]| dot(a, cross(b, c))).sum()
    };
    let parts: Vec<f64> = (0..tree.leaves.len()).into_par_iter().map(|l| part(tree.slots_of(l))).collect();
    parts.into_iter().sum()
}

/// Angle of a triangle at corner `i`.
fn angle(t: &[Point; 3], i: usize) -> f64 {
    let (u, v) = (minus(t[(i + 1) % 3], t[i]), minus(t[(i + 2) % 3], t[i]));
    libm::atan2(norm(cross(u, v)), dot(u, v))
}

impl Signs {
    /// Finds neighbors and corner normals, in linear time where no two vertices with more than 64 faces are neighbors. The result does not depend on the number of threads.
    pub fn new(tree: &Tree) -> Self {
        Signs::with_progress(tree, &Silent)
    }

    /// As [`Signs::new`], asking `progress` whether to go on.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn watched(tree: &Tree, progress: &dyn Progress) -> Result<Self, Cancelled> {
        let signs = Signs::with_progress(tree, progress);
        if progress.cancelled() { Err(Cancelled) } else { Ok(signs) }
    }

    /// Worth nothing where `progress` says that it is cancelled.
    fn with_progress(tree: &Tree, progress: &dyn Progress) -> Self {
        let fans = Fans::new(tree);
        let of_vertex = |v: u32| {
            if v.is_multiple_of(ITEMS_PER_QUESTION) && progress.cancelled() {
                return [0.0; 3];
            }
            // Summed in slot order.
            fans.around(v).fold([0.0; 3], |n, (s, i)| {
                let t = tree.triangle(s);
                plus(n, times(angle(&t, i), normal(&t)))
            })
        };
        let corner = (0..tree.corners.len() as u32).into_par_iter().map(of_vertex).collect();
        let across = fans.across(progress);
        let bounds = Aabb::of(&tree.corners);
        let outer = if volume(tree, bounds.min) < 0.0 { -1.0 } else { 1.0 };
        let mut signs = Signs { tree: tree.clone(), across, corner, far: f64::INFINITY, outer };
        if signs.loose_edges() == 0 {
            signs.far = FAR_DIAGONALS * bounds.diagonal();
        }
        signs
    }

    /// Number of edges with other than two faces, counted once for each of their faces. Above zero the sign is not to be
    /// trusted near them.
    pub fn loose_edges(&self) -> usize {
        self.across.iter().flatten().filter(|a| !matches!(a, Across::One(_))).count()
    }

    /// The side of the surface that `p` is on, `hit` being its closest place in the same tree: +1 outside, -1 inside. It is +1
    /// on the surface too, and where the pseudonormal is zero. Farther away than 10⁹ diagonals of a closed mesh it is that of
    /// all places outside.
    ///
    /// # Panics
    /// If `hit` comes from another tree with more faces.
    #[inline]
    pub fn sign(&self, p: &Point, hit: &Hit) -> f64 {
        if hit.distance() > self.far {
            return self.outer;
        }
        // Most points of a scan lie over the inside of their face: the search has already found the side.
        if hit.height != 0.0 { hit.height.signum() } else { self.sign_at_rim(p, hit) }
    }

    fn sign_at_rim(&self, p: &Point, hit: &Hit) -> f64 {
        let place = triangle::closest_point(p, &self.tree.triangle(hit.slot));
        if dot(minus(*p, place.point), self.pseudonormal(hit, place.feature)) < 0.0 { -1.0 } else { 1.0 }
    }

    /// Normal of the surface at the place that `hit` found for `p`, not of unit length. It is that of the face; on an edge the
    /// sum of both unit normals, at a corner the sum weighted by angle. `None` where it is zero.
    ///
    /// # Panics
    /// If `hit` comes from another tree with more faces.
    pub fn normal(&self, p: &Point, hit: &Hit) -> Option<Vector> {
        let feature = match hit.height != 0.0 {
            true => Feature::Face,
            false => triangle::closest_point(p, &self.tree.triangle(hit.slot)).feature,
        };
        Some(self.pseudonormal(hit, feature)).filter(|n| *n != [0.0; 3])
    }

    /// Pseudonormal of a feature of the face that was hit.
    fn pseudonormal(&self, hit: &Hit, feature: Feature) -> Vector {
        let t = self.tree.triangle(hit.slot);
        match feature {
            Feature::Face => normal(&t),
            Feature::Edge(i) => match self.across[hit.slot as usize][i as usize] {
                Across::One(o) => plus(normal(&t), normal(&self.tree.triangle(o))),
                Across::Free | Across::Unclear => normal(&t),
            },
            Feature::Vertex(i) => self.corner[self.tree.slots[hit.slot as usize][i as usize] as usize],
        }
    }

    /// Signed distance of each point, millimeters, positive outside, in the order of `points`; NaN beyond
    /// `query.max_distance`. Its size is the one of [`Tree::distances`] in every bit.
    ///
    /// # Errors
    /// The errors of [`Tree::for_each_closest`].
    pub fn distances(
        &self,
        points: &[Point],
        query: &Query,
        progress: &dyn Progress,
    ) -> Result<Vec<f64>, QueryError> {
        self.tree.map_closest(points, query, progress, |i, hit| {
            hit.map_or(f64::NAN, |h| h.distance() * self.sign(&points[i], &h))
        })
    }
}
