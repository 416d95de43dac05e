//! A reference surface, ready to be measured against: exact, signed, with points excluded where asked.

use super::copies::without_opposite_copies;
use super::sign_choice::{SignChoice, SignMethod, SignRequest};
use crate::check::Precondition;
use crate::closest::{BoundaryEdges, Closest, Hit, MeshError, Query, QueryError, Signs, Tree, Winding};
use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress, Silent};
use crate::space::Point;
use crate::topology::{Soundness, TopologyError};

/// The options of a [`ReferenceSurface`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceOptions {
    /// Sign method.
    pub sign: SignRequest,
    /// Points farther than this are excluded, millimeters.
    pub max_distance: f64,
    /// Points whose nearest place lies on a boundary edge are excluded: the part may go on where the mesh ends.
    pub skip_boundary: bool,
}

impl Default for SurfaceOptions {
    fn default() -> Self {
        SurfaceOptions { sign: SignRequest::Auto, max_distance: f64::INFINITY, skip_boundary: false }
    }
}

/// Why a point has no deviation.
///
/// Among deviations an excluded point is a value that is not finite, so that it keeps its place and needs no second list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exclusion {
    /// Farther than the greatest distance asked for; infinite among deviations.
    MaxDistance,
    /// The nearest place lies on a boundary edge; NaN among deviations.
    BoundaryEdge,
    /// The line along which it is measured meets nothing within that distance; a NaN of its own among deviations.
    NoCrossing,
    /// It has no direction to measure along; a NaN of its own among deviations.
    NoDirection,
}

/// Bits of a NaN of its own. It is only ever copied: no arithmetic sees it.
const NO_CROSSING_BITS: u64 = 0x7ff8_0000_0000_0005;
/// The same for a point without a direction.
const NO_DIRECTION_BITS: u64 = 0x7ff8_0000_0000_0006;

impl Exclusion {
    /// All, in the order of reports.
    pub const ALL: [Exclusion; 4] =
        [Exclusion::MaxDistance, Exclusion::BoundaryEdge, Exclusion::NoCrossing, Exclusion::NoDirection];

    /// The reason that a value among deviations stands for; `None` for a deviation.
    pub fn of(value: f64) -> Option<Exclusion> {
        match value.to_bits() {
            _ if value.is_finite() => None,
            _ if value.is_infinite() => Some(Exclusion::MaxDistance),
            NO_CROSSING_BITS => Some(Exclusion::NoCrossing),
            NO_DIRECTION_BITS => Some(Exclusion::NoDirection),
            _ => Some(Exclusion::BoundaryEdge),
        }
    }

    /// The value that stands for it.
    pub fn value(self) -> f64 {
        match self {
            Exclusion::MaxDistance => f64::INFINITY,
            Exclusion::BoundaryEdge => f64::NAN,
            Exclusion::NoCrossing => f64::from_bits(NO_CROSSING_BITS),
            Exclusion::NoDirection => f64::from_bits(NO_DIRECTION_BITS),
        }
    }

    /// The word of the result document.
    pub fn name(self) -> &'static str {
        match self {
            Exclusion::MaxDistance => "max_distance",
            Exclusion::BoundaryEdge => "free_edge",
            Exclusion::NoCrossing => "no_crossing",
            Exclusion::NoDirection => "no_direction",
        }
    }
}

/// A reference mesh with all that its deviations need: built once, asked often, from any number of threads.
pub struct ReferenceSurface {
    tree: Tree,
    choice: SignChoice,
    precondition: Precondition,
    side: Side,
    boundary_edges: Option<BoundaryEdges>,
    max_distance: f64,
}

/// Winding numbers of a mesh; of facets that occur with both orientations only those count that bound it.
fn winding(
    tree: &Tree,
    mesh: &Mesh,
    soundness: &Soundness,
    progress: &dyn Progress,
) -> Result<Winding, TopologyError> {
    let bounding = (soundness.duplicate_facets > 0).then(|| without_opposite_copies(mesh)).flatten();
    match bounding.map(|mesh| Tree::build_watched(&mesh, progress)) {
        None | Some(Err(MeshError::NoFaces)) => Ok(Winding::new(tree)),
        Some(Ok(own)) => Ok(Winding::new(&own)),
        Some(Err(_)) if progress.cancelled() => Err(Cancelled.into()),
        // The mesh passed as a whole.
        Some(Err(_)) => Ok(Winding::new(tree)),
    }
}

/// Flaws of each kind that are listed; all are counted.
const MAX_LISTED_FLAWS: usize = 100;

enum Side {
    Pseudonormal(Signs),
    Winding(Winding),
    None,
}

impl ReferenceSurface {
    /// Prepares `mesh`, whose search tree is `tree`: looks at its topology and chooses the sign method.
    ///
    /// # Errors
    /// The errors of [`Precondition::of`].
    pub fn new(
        tree: &Tree,
        mesh: &Mesh,
        options: &SurfaceOptions,
        progress: &dyn Progress,
    ) -> Result<ReferenceSurface, TopologyError> {
        let precondition = Precondition::of(mesh, MAX_LISTED_FLAWS, progress)?;
        let soundness = &precondition.soundness;
        let choice = SignChoice::new(options.sign, &precondition, mesh);
        let side = match choice.method {
            SignMethod::Pseudonormal => Side::Pseudonormal(Signs::watched(tree, progress)?),
            SignMethod::Winding => Side::Winding(winding(tree, mesh, soundness, progress)?),
            SignMethod::None | SignMethod::Normal => Side::None,
        };
        let boundary_edges = (options.skip_boundary && !soundness.closed)
            .then(|| BoundaryEdges::watched(tree, progress))
            .transpose()?;
        Ok(ReferenceSurface {
            tree: tree.clone(),
            choice,
            precondition,
            side,
            boundary_edges,
            max_distance: options.max_distance,
        })
    }

    /// The search tree.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }
    /// The greatest distance that counts.
    pub(super) fn max_distance(&self) -> f64 {
        self.max_distance
    }
    /// The sign method and why.
    pub fn sign(&self) -> &SignChoice {
        &self.choice
    }
    /// The topology's verdict on the mesh.
    pub fn soundness(&self) -> &Soundness {
        &self.precondition.soundness
    }
    /// The faults that break the rule that statistics rest on, with their places; none where the mesh is sound.
    pub fn precondition(&self) -> &Precondition {
        &self.precondition
    }

    /// The deviation of each point, millimeters, in the order of `points`: + outside, − inside, unsigned without a
    /// sign method; see [`Exclusion`] for points that have none.
    ///
    /// # Errors
    /// [`QueryError::BadPoint`] for a point that is not finite, [`QueryError::Cancelled`]. `progress` hears of points.
    pub fn deviations(&self, points: &[Point], progress: &dyn Progress) -> Result<Vec<f64>, QueryError> {
        self.map(points, progress, |_, deviation, _| deviation)
    }

    /// `f(index, deviation, hit)` of each point, in the order of `points`; the hit is missing beyond the greatest distance.
    ///
    /// # Errors
    /// The errors of [`ReferenceSurface::deviations`].
    pub fn map<T: Copy + Send>(
        &self,
        points: &[Point],
        progress: &dyn Progress,
        f: impl Fn(usize, f64, Option<&Hit>) -> T + Sync,
    ) -> Result<Vec<T>, QueryError> {
        let inside = match &self.side {
            Side::Winding(w) => self.inside(w, points, progress)?,
            _ => vec![],
        };
        let outward = self.outward();
        let query = Query { max_distance: self.max_distance, ..Query::default() };
        self.tree.map_closest(points, &query, progress, |i, hit| {
            let Some(hit) = hit else { return f(i, Exclusion::MaxDistance.value(), None) };
            if let Some(edges) = &self.boundary_edges
                && edges.holds(&self.tree.place(&points[i], &hit))
            {
                return f(i, Exclusion::BoundaryEdge.value(), Some(&hit));
            }
            let sign = match &self.side {
                Side::Pseudonormal(signs) => outward * signs.sign(&points[i], &hit),
                Side::Winding(_) if inside[i] => -1.0,
                Side::Winding(_) | Side::None => 1.0,
            };
            f(i, sign * hit.distance(), Some(&hit))
        })
    }

    /// The deviation of one point, as [`ReferenceSurface::deviations`] tells it of many, and the place that is nearest; `None` where it has none. For searches that
    /// ask for few points many times.
    ///
    /// # Errors
    /// The errors of [`ReferenceSurface::deviations`].
    pub fn at(&self, p: &Point) -> Result<Option<(f64, Closest)>, QueryError> {
        let Some(hit) = self.tree.hit(p, self.max_distance)? else { return Ok(None) };
        let place = self.tree.place(p, &hit);
        if self.boundary_edges.as_ref().is_some_and(|edges| edges.holds(&place)) {
            return Ok(None);
        }
        let sign = match &self.side {
            Side::Pseudonormal(signs) => self.outward() * signs.sign(p, &hit),
            Side::Winding(w) if self.inside(w, std::slice::from_ref(p), &Silent)?.contains(&true) => -1.0,
            Side::Winding(_) | Side::None => 1.0,
        };
        Ok(Some((sign * hit.distance(), place)))
    }

    /// −1 for a mesh that is inside out.
    fn outward(&self) -> f64 {
        if self.choice.inside_out { -1.0 } else { 1.0 }
    }

    /// Whether the mesh winds around each point: once in the positive sense, or in the negative one if it is inside out.
    fn inside(
        &self,
        winding: &Winding,
        points: &[Point],
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, QueryError> {
        let above = winding.above(0.5 * self.outward(), points, &OnlyCancels(progress))?;
        Ok(above.into_iter().map(|above| above != self.choice.inside_out).collect())
    }
}

/// Points on which the two sign methods differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disagreement {
    /// Points compared: those that do not lie on the surface.
    pub sample: u64,
    /// Points with different signs.
    pub differing: u64,
}

/// Points nearer to a facet than this share of its longest edge have no side that winding numbers could tell.
const ON_SURFACE_SHARE: f64 = 1e-6;

impl ReferenceSurface {
    /// Asks both sign methods about `points`, whichever is in use. Points on the surface are left out: they have no side.
    /// Cost: that of preparing the other method, and of the points.
    ///
    /// # Errors
    /// The errors of [`ReferenceSurface::deviations`].
    pub fn disagreement(
        &self,
        points: &[Point],
        progress: &dyn Progress,
    ) -> Result<Disagreement, QueryError> {
        let (outward, other) = (self.outward(), OnlyCancels(progress));
        let sides = match &self.side {
            Side::Pseudonormal(s) => self.sides(s, points, &other)?,
            _ => self.sides(&Signs::watched(&self.tree, progress)?, points, &other)?,
        };
        let inside = match &self.side {
            Side::Winding(w) => self.inside(w, points, progress)?,
            _ => self.inside(&Winding::new(&self.tree), points, progress)?,
        };
        let decided = || sides.iter().zip(&inside).filter(|(side, _)| **side != 0.0);
        let differing = decided().filter(|(side, inside)| (outward * **side < 0.0) != **inside).count();
        Ok(Disagreement { sample: decided().count() as u64, differing: differing as u64 })
    }

    /// The side that each point is on, by pseudonormals; 0 for those on the surface.
    fn sides(
        &self,
        signs: &Signs,
        points: &[Point],
        progress: &dyn Progress,
    ) -> Result<Vec<f64>, QueryError> {
        self.tree.map_closest(points, &Query::default(), progress, |i, hit| {
            let Some(hit) = hit else { return 0.0 };
            let away = hit.distance() > ON_SURFACE_SHARE * self.tree.longest_edge(&hit);
            if away { signs.sign(&points[i], &hit) } else { 0.0 }
        })
    }
}

/// Hands on whether to stop, but not what is done: points count once, by their distances.
pub struct OnlyCancels<'a>(pub &'a dyn Progress);

impl Progress for OnlyCancels<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

#[cfg(test)]
mod tests;
