//! Normal equations of an element, summed over the points in one pass and without a stored Jacobian.
//!
//! Points are cut into blocks of fixed size; a block is summed group by group, blocks are added in their order.
//! The sums are therefore the same bits on one thread and on many.

use super::dense;
use super::family::{Element, Family, Rows};
use super::lanes::{GROUP, Lanes, Sum, groups, widest};
use super::sample::Sample;
use crate::space::{Point, Vector, dot, times};
use rayon::prelude::*;

/// Points of one block: large enough to make sharing out cheap, small enough for the nearest caches.
const BLOCK: usize = 8192;

/// What one pass over the points gives, in the unit frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sums<const P: usize> {
    /// Σ w·gᵀg, upper half.
    pub normal: [[f64; P]; P],
    /// Σ w·g·d.
    pub gradient: [f64; P],
    /// Σ of the losses: of d², where every point counts alike.
    pub square: f64,
    /// Σ w.
    pub weight: f64,
}

/// What a distance costs.
pub(super) trait Weighing: Sync {
    /// Whether every point counts alike: its loss is d², its weight 1.
    const EVEN: bool;
    /// What is summed and made least.
    fn loss(&self, d: f64) -> f64;
    /// Derivative of the loss by d²: the weight of the point's rows.
    fn weight(&self, d: f64) -> f64;
}

/// Every point counts alike.
pub(super) struct Alike;
impl Weighing for Alike {
    const EVEN: bool = true;

    #[inline(always)]
    fn loss(&self, d: f64) -> f64 {
        d * d
    }
    #[inline(always)]
    fn weight(&self, _: f64) -> f64 {
        1.0
    }
}

/// From a point of the file to the element's own frame in two operations per coordinate.
#[derive(Clone, Copy)]
pub(super) struct Placing {
    center: Point,
    axes: [Vector; 3],
    origin: Point,
}

impl Placing {
    pub(super) fn new(element: &Element, sample: &Sample) -> Placing {
        let axes = element.pose.axes;
        Placing {
            center: sample.center,
            axes: axes.map(|a| times(sample.scale, a)),
            origin: axes.map(|a| dot(a, element.pose.origin)),
        }
    }
    /// Coordinates in the element's own frame.
    #[inline(always)]
    pub(super) fn local(&self, p: Point) -> Point {
        let (c, [u, v, w], o) = (self.center, self.axes, self.origin);
        let [x, y, z] = [p[0] - c[0], p[1] - c[1], p[2] - c[2]];
        [
            (u[0] * x + u[1] * y + u[2] * z) - o[0],
            (v[0] * x + v[1] * y + v[2] * z) - o[1],
            (w[0] * x + w[1] * y + w[2] * z) - o[2],
        ]
    }
    /// The same of group `k` of the points, coordinate by coordinate. Returns how many of them count: the last group is
    /// filled up with its last point.
    #[inline(always)]
    pub(super) fn group(&self, points: &[Point], k: usize, local: &mut [Lanes; 3]) -> usize {
        let rest = &points[k * GROUP..];
        if let Some(whole) = rest.first_chunk() {
            self.locals(whole, local);
            return GROUP;
        }
        let mut filled = [[0.0; 3]; GROUP];
        for l in 0..GROUP {
            filled[l] = rest[l.min(rest.len() - 1)];
        }
        self.locals(&filled, local);
        rest.len()
    }
    #[inline(always)]
    fn locals(&self, points: &[Point; GROUP], local: &mut [Lanes; 3]) {
        for l in 0..GROUP {
            let q = self.local(points[l]);
            for k in 0..3 {
                local[k][l] = q[k];
            }
        }
    }
}

/// Rows of a point at most.
const ROWS: usize = 2;

/// The group at hand: where its points are, and one row of each, waiting for being summed. Aligned, as a wide register that
/// lies in two lines of the cache takes longer.
#[repr(align(64))]
struct Work<const P: usize> {
    local: [Lanes; 3],
    distance: Lanes,
    slope: [Lanes; P],
}

/// Writes the row `wanted` of one point of the group.
struct Writer<'a, const P: usize> {
    distance: &'a mut Lanes,
    slope: &'a mut [Lanes; P],
    lane: usize,
    wanted: usize,
    row: usize,
}

impl<const P: usize> Rows<P> for Writer<'_, P> {
    #[inline(always)]
    fn row(&mut self, d: f64, g: [f64; P]) {
        if self.row == self.wanted {
            self.distance[self.lane] = d;
            for k in 0..P {
                self.slope[k][self.lane] = g[k];
            }
        }
        self.row += 1;
    }
}

struct Accumulator<const P: usize> {
    normal: [[Sum; P]; P],
    gradient: [Sum; P],
    square: Sum,
    weight: Sum,
}

impl<const P: usize> Accumulator<P> {
    /// Adds the first `count` points of a group; to the normal matrix only where `CURVED`.
    #[inline(always)]
    fn add<F: Family<P>, W: Weighing, const CURVED: bool>(
        &mut self,
        size: [f64; 2],
        count: usize,
        weigh: &W,
        work: &mut Work<P>,
    ) {
        let Work { local: [x, y, z], distance, slope } = work;
        let mut weights = [0.0; GROUP];
        if !W::EVEN {
            let mut losses = [0.0; GROUP];
            for lane in 0..GROUP {
                let d = F::distance(size, [x[lane], y[lane], z[lane]]);
                (weights[lane], losses[lane]) = (weigh.weight(d), weigh.loss(d));
            }
            losses[count..].fill(0.0);
            weights[count..].fill(0.0);
            self.square.add_products(&losses, &[1.0; GROUP]);
            self.weight.add_products(&weights, &[1.0; GROUP]);
        }
        for wanted in 0..if F::SIGNED { 1 } else { ROWS } {
            for lane in 0..GROUP {
                let mut writer = Writer { distance, slope, lane, wanted, row: 0 };
                F::rows(size, [x[lane], y[lane], z[lane]], &mut writer);
            }
            for lane in count..GROUP {
                distance[lane] = 0.0;
                for k in 0..P {
                    slope[k][lane] = 0.0;
                }
            }
            if W::EVEN {
                self.square.add_products(distance, distance);
            }
            for i in 0..P {
                let mut weighted = [0.0; GROUP];
                let heavy = if W::EVEN {
                    &slope[i]
                } else {
                    for lane in 0..GROUP {
                        weighted[lane] = weights[lane] * slope[i][lane];
                    }
                    &weighted
                };
                self.gradient[i].add_products(heavy, distance);
                if CURVED {
                    for j in i..P {
                        self.normal[i][j].add_products(heavy, &slope[j]);
                    }
                }
            }
        }
    }
}

#[inline(always)]
fn block<const P: usize, F: Family<P>, W: Weighing, const CURVED: bool>(
    points: &[Point],
    size: [f64; 2],
    placing: &Placing,
    weigh: &W,
) -> Sums<P> {
    let mut all = Accumulator::<P> {
        normal: [[Sum::ZERO; P]; P],
        gradient: [Sum::ZERO; P],
        square: Sum::ZERO,
        weight: Sum::ZERO,
    };
    let mut work = Work { local: [[0.0; GROUP]; 3], distance: [0.0; GROUP], slope: [[0.0; GROUP]; P] };
    for k in 0..groups(points) {
        let count = placing.group(points, k, &mut work.local);
        all.add::<F, W, CURVED>(size, count, weigh, &mut work);
    }
    Sums {
        normal: all.normal.map(|row| row.map(Sum::total)),
        gradient: all.gradient.map(Sum::total),
        square: all.square.total(),
        weight: if W::EVEN { points.len() as f64 } else { all.weight.total() },
    }
}

widest! {
    fn block_sums [const P: usize, F: Family<P>, W: Weighing, const CURVED: bool] [P, F, W, CURVED]
    (points: &[Point], size: [f64; 2], placing: &Placing, weigh: &W) -> Sums<P>
    = block::<P, F, W, CURVED>(points, size, placing, weigh)
}

/// The sums of `element` over all points of `sample`.
pub(super) fn sums<const P: usize, F: Family<P>, W: Weighing>(
    element: &Element,
    sample: &Sample,
    weigh: &W,
) -> Sums<P> {
    all_sums::<P, F, W, true>(element, sample, weigh)
}

/// As [`sums`], in less time, with the normal matrix of `near`: the sums of an element nearby.
pub(super) fn sums_near<const P: usize, F: Family<P>, W: Weighing>(
    element: &Element,
    sample: &Sample,
    weigh: &W,
    near: &Sums<P>,
) -> Sums<P> {
    Sums { normal: near.normal, ..all_sums::<P, F, W, false>(element, sample, weigh) }
}

fn all_sums<const P: usize, F: Family<P>, W: Weighing, const CURVED: bool>(
    element: &Element,
    sample: &Sample,
    weigh: &W,
) -> Sums<P> {
    let placing = Placing::new(element, sample);
    let of = |points: &[Point]| block_sums::<P, F, W, CURVED>(points, element.size, &placing, weigh);
    if sample.len() <= BLOCK {
        return of(&sample.points);
    }
    let blocks: Vec<Sums<P>> = sample.points.par_chunks(BLOCK).map(of).collect();
    blocks.into_iter().reduce(|a, b| a.plus(&b)).unwrap_or_else(|| of(&[]))
}

impl<const P: usize> Sums<P> {
    fn plus(&self, other: &Sums<P>) -> Sums<P> {
        Sums {
            normal: std::array::from_fn(|i| std::array::from_fn(|j| self.normal[i][j] + other.normal[i][j])),
            gradient: std::array::from_fn(|i| self.gradient[i] + other.gradient[i]),
            square: self.square + other.square,
            weight: self.weight + other.weight,
        }
    }
    /// Σ w·gᵀg in full.
    pub(super) fn symmetric(&self) -> [[f64; P]; P] {
        std::array::from_fn(|i| std::array::from_fn(|j| self.normal[i.min(j)][i.max(j)]))
    }
    /// The step that minimises the linearised sum of squares, each unknown held back by `damping` times its own
    /// weight; `None` where the rows do not determine one.
    pub(super) fn step(&self, damping: f64) -> Option<[f64; P]> {
        let scale: [f64; P] = std::array::from_fn(|i| 1.0 / self.normal[i][i].sqrt());
        if scale.iter().any(|s| !s.is_finite()) {
            return None;
        }
        let full = self.symmetric();
        let even: [[f64; P]; P] = std::array::from_fn(|i| {
            std::array::from_fn(|j| full[i][j] * scale[i] * scale[j] + if i == j { damping } else { 0.0 })
        });
        let l = dense::cholesky(&even)?;
        let right: [f64; P] = std::array::from_fn(|i| -self.gradient[i] * scale[i]);
        let x = dense::cholesky_solve(&l, &right);
        Some(std::array::from_fn(|i| x[i] * scale[i]))
    }
    /// How much the linearised sum of squares falls by `step`.
    pub(super) fn fall(&self, step: &[f64; P]) -> f64 {
        let full = self.symmetric();
        (0..P)
            .map(|i| {
                let curved: f64 = (0..P).map(|j| full[i][j] * step[j]).sum();
                -step[i] * (2.0 * self.gradient[i] + curved)
            })
            .sum()
    }
    /// Root mean square of what `step` does to the distances.
    pub(super) fn length(&self, step: &[f64; P]) -> f64 {
        let full = self.symmetric();
        let square: f64 = (0..P).map(|i| (0..P).map(|j| step[i] * full[i][j] * step[j]).sum::<f64>()).sum();
        (square.max(0.0) / self.weight).sqrt()
    }
}
