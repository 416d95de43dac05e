//! What sections are measured against: the outlines of a nominal, and how much of each was measured.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_section::{Contour, OffNominal, Outline, Passed, Taken, covered};

/// What the points of a contour were measured against.
#[derive(Clone, Debug)]
pub struct Against<'a> {
    /// The points.
    pub points: &'a [[f64; 2]],
    /// Of each, the nearest place; `None` beyond the end of an open outline.
    pub found: Vec<Option<OffNominal>>,
    /// So many of these are farther off than was said.
    pub far: usize,
    /// The contour.
    pub contour: &'a Contour,
}

/// What the contours of a plane were measured against.
#[derive(Clone, Debug)]
pub struct AgainstPlane<'a> {
    /// Number of the plane; of points in order none.
    pub plane: Option<u64>,
    /// The outlines of the nominal in it.
    pub outlines: Vec<Outline>,
    /// Its contours.
    pub contours: Vec<Against<'a>>,
}

/// An outline of a nominal. Documents do not hold its lines, arcs and curves, which may be far more than those of the contours; a report
/// draws them.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct OutlineRecord {
    /// Number of its plane in `planes`, from 0; of points in order `null`.
    pub plane: Option<u64>,
    /// Whether its end is its start.
    pub closed: bool,
    /// Whether the material is outside of it.
    pub hole: bool,
    /// Its length.
    pub length: f64,
    /// Middle of the box around it.
    pub center: [f64; 2],
    /// Width and height of that.
    pub size: [f64; 2],
    /// Points that are nearest to it.
    pub points: u64,
    /// Share of its length that successive points run along, from 0 to 1; 0: it was not measured.
    pub covered: f64,
    /// What it is.
    #[serde(skip)]
    pub drawn: Outline,
    /// Where points run along it: lengths from its start, in ascending order.
    #[serde(skip)]
    pub measured: Vec<[f64; 2]>,
}

/// So much of an outline counts as all of it: points of open rows end beside its ends.
const WHOLE: f64 = 0.98;

impl OutlineRecord {
    /// Whether it was not measured as a whole.
    pub fn lacks(&self) -> bool {
        self.covered < WHOLE
    }

    /// What of it was measured, and what was not; one that lacks so little that it counts as whole is measured as it is.
    pub fn divided(&self) -> [Vec<Outline>; 2] {
        let whole = || vec![self.drawn.clone()];
        if !self.lacks() {
            return [whole(), vec![]];
        }
        if self.covered == 0.0 {
            return [vec![], whole()];
        }
        let ends = self.measured.iter().flatten().copied();
        let ends: Vec<f64> = std::iter::once(0.0).chain(ends).chain([self.length]).collect();
        let missed: Vec<[f64; 2]> = ends.chunks(2).filter_map(|w| w.try_into().ok()).collect();
        [&self.measured, &missed].map(|stretches| self.drawn.parts(stretches))
    }
}

/// The row of a contour.
fn passed<'a>(c: &'a Against) -> Passed<'a> {
    // Facets lie across the gaps between points of a mesh.
    let gaps = if c.contour.taken == Taken::Row { &c.contour.gaps[..] } else { &[] };
    Passed { points: c.points, found: &c.found, closed: c.contour.closed, gaps }
}

/// Those of a plane.
pub(super) fn records(against: AgainstPlane) -> Vec<OutlineRecord> {
    let rows: Vec<Passed> = against.contours.iter().map(passed).collect();
    let found = covered(&rows, &against.outlines);
    let plane = against.plane;
    (against.outlines.into_iter().zip(found))
        .map(|(drawn, covered)| {
            let length = drawn.length();
            let [low, high] = drawn.bounds().unwrap_or_default();
            OutlineRecord {
                plane,
                closed: drawn.closed,
                hole: drawn.closed && drawn.area() < 0.0,
                length,
                center: [0, 1].map(|k| 0.5 * (low[k] + high[k])),
                size: [0, 1].map(|k| high[k] - low[k]),
                points: covered.points as u64,
                covered: if length > 0.0 { (covered.length() / length).min(1.0) } else { 0.0 },
                measured: covered.stretches,
                drawn,
            }
        })
        .collect()
}
