//! Poses from pairs of points with normals: two places of the measured surface that lie to each other as two places of
//! the reference do.
//!
//! Four numbers say how two points with normals lie to each other, whatever the pose. They are their distance, the angles of
//! both normals with the line between them, and the angle between the normals. (Drost, Ulrich, Navab, Ilic: Model globally,
//! match locally, CVPR 2010.) All pairs of a sample of the reference are sorted into cells of these four numbers. A pair of the
//! measured surface looks its cell up. Each pair there gives one pose, which is tried at once. (Papazov, Burschka: An efficient
//! RANSAC for 3D object recognition, ACCV 2010.) Pairs with few counterparts are tried first: they tell most.

use super::sample::Samples;
use crate::parallel::prelude::*;
use crate::rigid::Rigid;
use crate::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};
use std::f64::consts::PI;

/// Cells of each of the angles from 0 to π.
const CELLS_PER_ANGLE: usize = 16;

/// A place with its normal.
pub(super) type Oriented = (Point, Vector);

/// Pairs of a sample, by the way in which they lie.
pub(super) struct PairTable {
    sample: Vec<Oriented>,
    walls: Walls,
    /// Width of the cells of distance.
    step: f64,
    /// Cells of distance.
    lengths: usize,
    /// Where the pairs of each cell begin.
    first: Vec<u32>,
    pairs: Vec<[u16; 2]>,
}

/// Cosines at the ends of the cells of the angles and at their middles, descending.
struct Walls {
    ends: [f64; CELLS_PER_ANGLE - 1],
    middles: [f64; CELLS_PER_ANGLE],
}

impl Walls {
    fn new() -> Walls {
        let cosine = |cells: f64| libm::cos(cells * (PI / CELLS_PER_ANGLE as f64));
        Walls {
            ends: std::array::from_fn(|k| cosine((k + 1) as f64)),
            middles: std::array::from_fn(|k| cosine(k as f64 + 0.5)),
        }
    }
}

/// How two places with normals lie to each other.
struct Relation {
    /// Their distance in cells, and the cosines of the three angles.
    length: f64,
    cosines: [f64; 3],
    /// The cells of these four numbers.
    cells: [usize; 4],
}

impl Relation {
    /// Without arc cosines: these would take most of the time. `None` for places nearer than `least`, and for one and the same.
    #[inline(always)]
    fn of(a: Oriented, b: Oriented, step: f64, least: f64, walls: &Walls) -> Option<Relation> {
        let away = minus(b.0, a.0);
        let length = dot(away, away).sqrt();
        if length.partial_cmp(&least.max(f64::MIN_POSITIVE)).is_none_or(|o| o.is_lt()) {
            return None;
        }
        let angle = |c: f64| {
            let mut beyond = 0u32;
            for wall in &walls.ends {
                beyond += u32::from(c <= *wall);
            }
            beyond as usize
        };
        let cosines = [dot(a.1, away) / length, dot(b.1, away) / length, dot(a.1, b.1)];
        let length = length / step;
        let cells = [length as usize, angle(cosines[0]), angle(cosines[1]), angle(cosines[2])];
        Some(Relation { length, cosines, cells })
    }

    /// For each number whether it lies in the second half of its cell.
    fn beyond_middle(&self, walls: &Walls) -> [bool; 4] {
        let angle = |k: usize| self.cosines[k] <= walls.middles[self.cells[k + 1]];
        [self.length.fract() >= 0.5, angle(0), angle(1), angle(2)]
    }
}

impl PairTable {
    /// The table of at most 65,535 places with normals; pairs nearer than `least` are left out. `step` is the accuracy of
    /// places.
    pub fn new(sample: &Samples, step: f64, least: f64) -> PairTable {
        let sample: Vec<Oriented> =
            sample.points.iter().copied().zip(sample.normals.iter().copied()).collect();
        let mut longest = 0.0f64;
        for a in &sample {
            for b in &sample {
                let away = minus(b.0, a.0);
                longest = longest.max(dot(away, away));
            }
        }
        let lengths = (longest.sqrt() / step) as usize + 1;
        let walls = Walls::new();
        let keys: Vec<Vec<u32>> = (sample.par_iter())
            .map(|&a| {
                let key = |&b: &Oriented| {
                    Relation::of(a, b, step, least, &walls)
                        .map_or(u32::MAX, |r| cell(r.cells, lengths) as u32)
                };
                sample.iter().map(key).collect()
            })
            .collect();
        let mut first = vec![0u32; lengths * CELLS_PER_ANGLE.pow(3) + 1];
        let known = || keys.iter().flatten().filter(|&&k| k != u32::MAX);
        known().for_each(|&k| first[k as usize + 1] += 1);
        for i in 1..first.len() {
            first[i] += first[i - 1];
        }
        let mut next = first.clone();
        let mut pairs = vec![[0u16; 2]; known().count()];
        for (i, row) in keys.iter().enumerate() {
            for (j, &k) in row.iter().enumerate().filter(|(_, k)| **k != u32::MAX) {
                pairs[next[k as usize] as usize] = [i as u16, j as u16];
                next[k as usize] += 1;
            }
        }
        PairTable { sample, walls, step, lengths, first, pairs }
    }

    /// Where the pairs of the reference are that lie to each other about as these two: those of its cell and of the nearer neighbors.
    fn ranges_near(&self, a: Oriented, b: Oriented) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let limits = [self.lengths, CELLS_PER_ANGLE, CELLS_PER_ANGLE, CELLS_PER_ANGLE];
        let relation = Relation::of(a, b, self.step, 0.0, &self.walls);
        // The cell in which a number lies, and the one on the side to which it is nearer: from the lower of both on.
        let upper = relation.map(|r| {
            let beyond = r.beyond_middle(&self.walls);
            std::array::from_fn::<usize, 4, _>(|k| r.cells[k] + usize::from(beyond[k]))
        });
        let range = move |corner: usize| {
            let mut at = upper?;
            for k in 0..4 {
                at[k] = (at[k] + (corner >> k & 1)).checked_sub(1).filter(|c| *c < limits[k])?;
            }
            let k = cell(at, self.lengths);
            Some(self.first[k] as usize..self.first[k + 1] as usize)
        };
        (0..16).filter_map(range)
    }

    /// The pairs of the reference that lie to each other about as these two.
    pub fn like(&self, a: Oriented, b: Oriented) -> Vec<[u16; 2]> {
        self.ranges_near(a, b).flat_map(|range| &self.pairs[range]).copied().collect()
    }

    /// How many these are.
    pub fn count_like(&self, a: Oriented, b: Oriented) -> usize {
        self.ranges_near(a, b).map(|range| range.len()).sum()
    }

    /// The motion that lays the measured pair on a pair of the reference. `None` where a frame has no direction.
    pub fn pose(&self, from: &PairFrame, [i, j]: [u16; 2]) -> Option<Rigid> {
        let (a, b) = (self.sample[i as usize], self.sample[j as usize]);
        let to = PairFrame::new(a, b, from.sum)?;
        // Columns of the frames are the images of the axes: R = Σ to_k from_kᵀ.
        let rows = std::array::from_fn(|r| {
            (0..3).fold([0.0; 3], |s, k| plus(s, times(to.axes[k][r], from.axes[k])))
        });
        Some(Rigid::of_rotation(rows, from.middle, to.middle))
    }
}

/// Index of a cell.
#[inline(always)]
fn cell(at: [usize; 4], lengths: usize) -> usize {
    let angle = |k: usize| at[k].min(CELLS_PER_ANGLE - 1);
    ((at[0].min(lengths - 1) * CELLS_PER_ANGLE + angle(1)) * CELLS_PER_ANGLE + angle(2)) * CELLS_PER_ANGLE
        + angle(3)
}

/// A frame that goes with a pair: the first axis along the pair, the third along the normals.
pub(super) struct PairFrame {
    middle: Point,
    axes: [Vector; 3],
    /// Whether the third axis follows the sum of the normals or their difference.
    sum: bool,
}

impl PairFrame {
    /// The frame by the sum or difference of the normals. `None` where it lies along the pair.
    fn new(a: Oriented, b: Oriented, sum: bool) -> Option<PairFrame> {
        let (x, _) = unit(minus(b.0, a.0))?;
        let n = if sum { plus(a.1, b.1) } else { minus(a.1, b.1) };
        let across = minus(n, times(dot(n, x), x));
        let (z, length) = unit(across)?;
        (length > 0.2).then(|| PairFrame {
            middle: times(0.5, plus(a.0, b.0)),
            axes: [x, cross(z, x), z],
            sum,
        })
    }

    /// The frame by whichever of the two is farther from the direction of the pair.
    pub fn best(a: Oriented, b: Oriented) -> Option<PairFrame> {
        let x = minus(b.0, a.0);
        let across = |n: Vector| norm(cross(n, x));
        PairFrame::new(a, b, across(plus(a.1, b.1)) >= across(minus(a.1, b.1)))
    }
}
