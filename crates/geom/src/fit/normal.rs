//! Normal equations of an element, summed over the points in one pass and without a stored Jacobian.
//!
//! Points are cut into blocks of fixed size; a block is summed group by group, blocks are added in their order.
//! The sums are therefore the same bits on one thread and on many.

use super::family::{Element, Family, Rows};
use super::lanes::{Lanes, POINTS_PER_GROUP, Sum, group, groups};
use super::sample::Sample;
use crate::num::dense;
use crate::parallel::prelude::*;
use crate::simd::widest::widest;
use crate::space::{Point, Vector, dot, times};

/// Points of one block: large enough to make sharing out cheap, small enough for the nearest caches.
pub(super) const POINTS_PER_NORMAL_BLOCK: usize = 8192;

/// The sums of one pass over the points, in the unit frame.
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

/// The cost of a distance.
pub(super) trait Weighing: Sync {
    /// Whether every point counts alike: its loss is d², its weight 1.
    const EVEN: bool;
    /// The sum that is made least.
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
            u[0].mul_add(x, u[1].mul_add(y, u[2].mul_add(z, -o[0]))),
            v[0].mul_add(x, v[1].mul_add(y, v[2].mul_add(z, -o[1]))),
            w[0].mul_add(x, w[1].mul_add(y, w[2].mul_add(z, -o[2]))),
        ]
    }
}

/// Most rows of a point.
const MAX_ROWS_PER_POINT: usize = 2;

/// One row of each point of the group at hand, waiting for being summed. Aligned, as a wide register that lies in two lines
/// of the cache takes longer.
#[repr(align(64))]
struct Work<const P: usize> {
    distance: Lanes,
    slope: [Lanes; P],
    /// The weights of the points, where they do not count alike.
    weight: Lanes,
    loss: Lanes,
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
    /// Adds the rows at hand; to the normal matrix only where `CURVED`.
    #[inline(always)]
    fn add<W: Weighing, const CURVED: bool>(&mut self, work: &Work<P>) {
        let Work { distance, slope, weight, .. } = work;
        if W::EVEN {
            self.square.add_products(distance, distance);
        }
        for i in 0..P {
            let mut weighted = [0.0; POINTS_PER_GROUP];
            let heavy = if W::EVEN {
                &slope[i]
            } else {
                for lane in 0..POINTS_PER_GROUP {
                    weighted[lane] = weight[lane] * slope[i][lane];
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
    let mut work = Work {
        distance: [0.0; POINTS_PER_GROUP],
        slope: [[0.0; POINTS_PER_GROUP]; P],
        weight: [0.0; POINTS_PER_GROUP],
        loss: [0.0; POINTS_PER_GROUP],
    };
    let mut filled = [[0.0; 3]; POINTS_PER_GROUP];
    for k in 0..groups(points) {
        let (group, count) = group(points, k, &mut filled);
        if !W::EVEN {
            for lane in 0..POINTS_PER_GROUP {
                let d = F::distance(size, placing.local(group[lane]));
                (work.weight[lane], work.loss[lane]) = (weigh.weight(d), weigh.loss(d));
            }
            work.loss[count..].fill(0.0);
            work.weight[count..].fill(0.0);
            all.square.add_products(&work.loss, &[1.0; POINTS_PER_GROUP]);
            all.weight.add_products(&work.weight, &[1.0; POINTS_PER_GROUP]);
        }
        for wanted in 0..if F::SIGNED { 1 } else { MAX_ROWS_PER_POINT } {
            for lane in 0..POINTS_PER_GROUP {
                let Work { distance, slope, .. } = &mut work;
                let mut writer = Writer { distance, slope, lane, wanted, row: 0 };
                F::rows(size, placing.local(group[lane]), &mut writer);
            }
            for lane in count..POINTS_PER_GROUP {
                work.distance[lane] = 0.0;
                for k in 0..P {
                    work.slope[k][lane] = 0.0;
                }
            }
            all.add::<W, CURVED>(&work);
        }
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
    if sample.len() <= POINTS_PER_NORMAL_BLOCK {
        return of(&sample.points);
    }
    let blocks: Vec<Sums<P>> = sample.points.par_chunks(POINTS_PER_NORMAL_BLOCK).map(of).collect();
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
    /// The step that minimizes the linearized sum of squares, each unknown held back by `damping` times its own weight. `None`
    /// where the rows do not determine one.
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
    /// How much the linearized sum of squares falls by `step`.
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

#[cfg(test)]
mod tests {
    use super::super::cylinder::Cylinder;
    use super::super::torus::Torus;
    use super::*;
    use crate::frame::Pose;

    #[test]
    fn wide_registers_give_the_same_bits() {
        struct Heavier;
        impl Weighing for Heavier {
            const EVEN: bool = false;
            fn loss(&self, d: f64) -> f64 {
                (1.0 + d * d).ln()
            }
            fn weight(&self, d: f64) -> f64 {
                1.0 / (1.0 + d * d)
            }
        }
        fn same<const P: usize, F: Family<P>, W: Weighing>(points: &[Point], element: &Element, weigh: &W) {
            let sample = Sample::new(points).unwrap();
            let placing = Placing::new(element, &sample);
            let wide = block_sums::<P, F, W, true>(points, element.size, &placing, weigh);
            let plain = block::<P, F, W, true>(points, element.size, &placing, weigh);
            assert_eq!(wide.normal, plain.normal);
            assert_eq!(wide.gradient, plain.gradient);
            assert_eq!((wide.square, wide.weight), (plain.square, plain.weight));
        }
        let element = Element { pose: Pose::along([0.1, 0.02, -0.3], [0.3, -0.5, 0.8]), size: [0.61, 0.17] };
        for count in [5, 32, 777] {
            let points: Vec<Point> = (0..count)
                .map(f64::from)
                .map(|k| [k.sin(), 1.3 * (2.7 * k).cos(), 0.7 * (0.9 * k).sin()])
                .collect();
            same::<5, Cylinder, _>(&points, &element, &Alike);
            same::<5, Cylinder, _>(&points, &element, &Heavier);
            same::<7, Torus, _>(&points, &element, &Alike);
        }
    }
}
