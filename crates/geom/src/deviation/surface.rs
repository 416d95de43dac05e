//! A reference surface, ready to be measured against: exact, signed, with points excluded where asked.

use super::sign_choice::{SignChoice, SignMethod, SignRequest};
use crate::check::Precondition;
use crate::closest::{FreeEdges, Hit, Query, QueryError, Signs, Tree, Winding};
use crate::mesh::Mesh;
use crate::progress::{Progress, Silent};
use crate::space::Point;
use crate::topology::Soundness;
use crate::topology::weld::WeldError;

/// What is asked of a [`Surface`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceOptions {
    /// Sign method.
    pub sign: SignRequest,
    /// Points farther than this are excluded, millimetres.
    pub max_distance: f64,
    /// Points whose nearest place lies on a free edge are excluded: the part may go on where the mesh ends.
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
    /// The nearest place lies on a free edge; NaN among deviations.
    FreeEdge,
}

impl Exclusion {
    /// All, in the order of reports.
    pub const ALL: [Exclusion; 2] = [Exclusion::MaxDistance, Exclusion::FreeEdge];

    /// What a value among deviations stands for; `None` for a deviation.
    pub fn of(value: f64) -> Option<Exclusion> {
        if value.is_finite() {
            None
        } else if value.is_nan() {
            Some(Exclusion::FreeEdge)
        } else {
            Some(Exclusion::MaxDistance)
        }
    }

    /// The value that stands for it.
    pub fn value(self) -> f64 {
        match self {
            Exclusion::MaxDistance => f64::INFINITY,
            Exclusion::FreeEdge => f64::NAN,
        }
    }

    /// The word of the result document.
    pub fn name(self) -> &'static str {
        match self {
            Exclusion::MaxDistance => "max_distance",
            Exclusion::FreeEdge => "free_edge",
        }
    }
}

/// A reference mesh with all that its deviations need: built once, asked often.
pub struct Surface<'t> {
    tree: &'t Tree,
    choice: SignChoice,
    precondition: Precondition,
    side: Side<'t>,
    free_edges: Option<FreeEdges>,
    max_distance: f64,
}

/// Flaws of each kind that are listed; all are counted.
const FLAWS: usize = 100;

enum Side<'t> {
    Pseudonormal(Signs<'t>),
    Winding(Winding<'t>),
    None,
}

impl<'t> Surface<'t> {
    /// Prepares `mesh`, whose search tree is `tree`: looks at its topology and chooses the sign method.
    ///
    /// # Errors
    /// Those of [`Soundness::of`].
    pub fn new(tree: &'t Tree, mesh: &Mesh, options: &SurfaceOptions) -> Result<Surface<'t>, WeldError> {
        let precondition = Precondition::of(mesh, FLAWS)?;
        let soundness = &precondition.soundness;
        let choice = SignChoice::new(options.sign, soundness, mesh);
        let side = match choice.method {
            SignMethod::Pseudonormal => Side::Pseudonormal(Signs::new(tree)),
            SignMethod::Winding => Side::Winding(Winding::new(tree)),
            SignMethod::None => Side::None,
        };
        let free_edges = (options.skip_boundary && !soundness.closed).then(|| FreeEdges::new(tree));
        Ok(Surface { tree, choice, precondition, side, free_edges, max_distance: options.max_distance })
    }

    /// The search tree.
    pub fn tree(&self) -> &'t Tree {
        self.tree
    }
    /// The sign method and why.
    pub fn sign(&self) -> &SignChoice {
        &self.choice
    }
    /// What the topology says about the mesh.
    pub fn soundness(&self) -> &Soundness {
        &self.precondition.soundness
    }
    /// What breaks the rule that statistics rest on, with its places; nothing where the mesh is sound.
    pub fn precondition(&self) -> &Precondition {
        &self.precondition
    }

    /// The deviation of each point, millimetres, in the order of `points`: + outside, − inside, unsigned without a
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
    /// Those of [`Surface::deviations`].
    pub fn map<T: Copy + Send>(
        &self,
        points: &[Point],
        progress: &dyn Progress,
        f: impl Fn(usize, f64, Option<&Hit>) -> T + Sync,
    ) -> Result<Vec<T>, QueryError> {
        let inside = match &self.side {
            Side::Winding(w) => self.inside(w, points)?,
            _ => vec![],
        };
        let outward = self.outward();
        let query = Query { max_distance: self.max_distance, ..Query::default() };
        self.tree.map_closest(points, &query, progress, |i, hit| {
            let Some(hit) = hit else { return f(i, Exclusion::MaxDistance.value(), None) };
            if let Some(edges) = &self.free_edges
                && edges.holds(&self.tree.place(&points[i], &hit))
            {
                return f(i, Exclusion::FreeEdge.value(), Some(&hit));
            }
            let sign = match &self.side {
                Side::Pseudonormal(signs) => outward * signs.sign(&points[i], &hit),
                Side::Winding(_) if inside[i] => -1.0,
                Side::Winding(_) | Side::None => 1.0,
            };
            f(i, sign * hit.distance(), Some(&hit))
        })
    }

    /// −1 for a mesh that is inside out.
    fn outward(&self) -> f64 {
        if self.choice.inside_out { -1.0 } else { 1.0 }
    }

    /// Whether the mesh winds around each point: once in the positive sense, or in the negative one if it is inside out.
    fn inside(&self, winding: &Winding, points: &[Point]) -> Result<Vec<bool>, QueryError> {
        let above = winding.above(0.5 * self.outward(), points, &Silent)?;
        Ok(above.into_iter().map(|above| above != self.choice.inside_out).collect())
    }
}

/// Share of points on which the two sign methods differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disagreement {
    /// Points compared.
    pub sample: u64,
    /// Points with different signs.
    pub differing: u64,
}

impl Surface<'_> {
    /// Asks both sign methods about `points`, whichever is in use. Cost: that of preparing the other method, and of the
    /// points.
    ///
    /// # Errors
    /// Those of [`Surface::deviations`].
    pub fn disagreement(&self, points: &[Point]) -> Result<Disagreement, QueryError> {
        let outward = self.outward();
        let sides = match &self.side {
            Side::Pseudonormal(s) => s.distances(points, &Query::default(), &Silent)?,
            _ => Signs::new(self.tree).distances(points, &Query::default(), &Silent)?,
        };
        let inside = match &self.side {
            Side::Winding(w) => self.inside(w, points)?,
            _ => self.inside(&Winding::new(self.tree), points)?,
        };
        let differing = sides.iter().zip(inside).filter(|&(d, inside)| (outward * d < 0.0) != inside).count();
        Ok(Disagreement { sample: points.len() as u64, differing: differing as u64 })
    }
}

#[cfg(test)]
mod tests {
    use super::super::sign_choice::SignReason;
    use super::*;

    /// The unit cube, outward.
    fn cube() -> Mesh {
        let positions = (0..8).map(|i| [(i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64]).collect();
        let faces = vec![
            [0, 2, 1],
            [1, 2, 3],
            [4, 5, 6],
            [5, 7, 6],
            [0, 1, 4],
            [1, 5, 4],
            [2, 6, 3],
            [3, 6, 7],
            [0, 4, 2],
            [2, 4, 6],
            [1, 3, 5],
            [3, 7, 5],
        ];
        Mesh { positions, faces }
    }

    fn ask(mesh: &Mesh, options: SurfaceOptions, points: &[Point]) -> (SignChoice, Vec<f64>, Disagreement) {
        let tree = Tree::build(mesh).unwrap();
        let surface = Surface::new(&tree, mesh, &options).unwrap();
        let deviations = surface.deviations(points, &Silent).unwrap();
        (*surface.sign(), deviations, surface.disagreement(points).unwrap())
    }

    const POINTS: [Point; 3] = [[0.5, 0.5, 0.25], [3.0, 0.5, 0.5], [-1.0, -1.0, 0.5]];
    const DEVIATIONS: [f64; 3] = [-0.25, 2.0, std::f64::consts::SQRT_2];

    #[test]
    fn closed_mesh_is_signed_by_pseudonormals_inside_out_or_not() {
        let mut mesh = cube();
        for inside_out in [false, true] {
            let (choice, deviations, disagreement) = ask(&mesh, SurfaceOptions::default(), &POINTS);
            assert_eq!((choice.method, choice.reason), (SignMethod::Pseudonormal, SignReason::Closed));
            assert_eq!(choice.inside_out, inside_out);
            assert_eq!(deviations, DEVIATIONS);
            assert_eq!(disagreement, Disagreement { sample: 3, differing: 0 });
            mesh.faces.iter_mut().for_each(|f| f.swap(0, 1));
        }
    }

    #[test]
    fn mesh_with_a_gap_or_a_turned_facet_is_signed_by_winding_number() {
        let mut gap = cube();
        gap.faces.pop();
        let (choice, deviations, _) = ask(&gap, SurfaceOptions::default(), &POINTS);
        assert_eq!(
            (choice.method, choice.reason),
            (SignMethod::Winding, SignReason::NearlyClosed { boundary_edges: 3 })
        );
        assert_eq!(deviations, DEVIATIONS);
        let mut turned = cube();
        turned.faces[11].swap(0, 1);
        let (choice, _, _) = ask(&turned, SurfaceOptions::default(), &POINTS);
        assert_eq!((choice.method, choice.reason), (SignMethod::Winding, SignReason::Inconsistent));
    }

    /// A winding number never exceeds one half beside a sheet: every point would be outside.
    #[test]
    fn sheet_has_two_sides() {
        let mut sheet = cube();
        sheet.faces.truncate(2); // the bottom, facing down
        let points = [[0.5, 0.5, 0.125], [0.5, 0.5, -0.25]];
        let (choice, deviations, disagreement) = ask(&sheet, SurfaceOptions::default(), &points);
        assert_eq!(
            (choice.method, choice.reason),
            (SignMethod::Pseudonormal, SignReason::OpenSheet { openness: 1.0 })
        );
        assert_eq!(deviations, [-0.125, 0.25]);
        assert_eq!(disagreement.differing, 1);
    }

    #[test]
    fn far_points_and_points_beyond_the_rim_are_excluded() {
        let mut sheet = cube();
        sheet.faces.truncate(2);
        let options = SurfaceOptions { max_distance: 1.0, skip_boundary: true, ..SurfaceOptions::default() };
        let points = [[0.5, 0.5, -1.0], [0.5, 0.5, -1.5], [1.5, 0.5, 0.0]];
        let (_, deviations, _) = ask(&sheet, options, &points);
        let excluded: Vec<Option<Exclusion>> = deviations.iter().map(|&d| Exclusion::of(d)).collect();
        assert_eq!(excluded, [None, Some(Exclusion::MaxDistance), Some(Exclusion::FreeEdge)]);
        assert_eq!(deviations[0], 1.0);
    }
}
