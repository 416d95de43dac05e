//! Normal equations of an element, summed over the points in one pass and without a stored Jacobian.
//!
//! Points are cut into blocks of fixed size; a block is summed lane by lane, blocks are added in their order.
//! The sums are therefore the same bits on one thread and on many.

use super::dense;
use super::family::{Element, Family, Rows};
use super::sample::Sample;
use super::scalar::{LANES, Lane, Scalar};
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
    /// What is summed and made least.
    fn loss<S: Scalar>(&self, d: S) -> S;
    /// Derivative of the loss by d²: the weight of the point's rows.
    fn weight<S: Scalar>(&self, d: S) -> S;
}

/// Every point counts alike.
pub(super) struct Alike;
impl Weighing for Alike {
    #[inline(always)]
    fn loss<S: Scalar>(&self, d: S) -> S {
        d * d
    }
    #[inline(always)]
    fn weight<S: Scalar>(&self, _: S) -> S {
        S::of(1.0)
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
    pub(super) fn local<S: Scalar>(&self, p: [S; 3]) -> [S; 3] {
        let [x, y, z]: [S; 3] = std::array::from_fn(|k| p[k] - S::of(self.center[k]));
        std::array::from_fn(|k| {
            let a = self.axes[k];
            (S::of(a[0]) * x + S::of(a[1]) * y + S::of(a[2]) * z) - S::of(self.origin[k])
        })
    }
}

/// Four points as three registers.
#[inline(always)]
pub(super) fn lanes(four: &[Point; LANES]) -> [Lane; 3] {
    std::array::from_fn(|k| Lane(std::array::from_fn(|l| four[l][k])))
}

struct Accumulator<S, const P: usize> {
    normal: [[S; P]; P],
    gradient: [S; P],
    square: S,
    weight: S,
    /// Of the point whose rows come.
    present: S,
}

impl<S: Scalar, const P: usize> Accumulator<S, P> {
    #[inline(always)]
    fn new() -> Self {
        let zero = S::of(0.0);
        Accumulator { normal: [[zero; P]; P], gradient: [zero; P], square: zero, weight: zero, present: zero }
    }
    #[inline(always)]
    fn add<F: Family<P>, W: Weighing>(&mut self, size: [f64; 2], q: [S; 3], weigh: &W) {
        let distance = F::distance(size, q);
        self.present = weigh.weight(distance);
        self.weight = self.weight + self.present;
        self.square = self.square + weigh.loss(distance);
        F::rows(size, q, self);
    }
}

impl<S: Scalar, const P: usize> Rows<S, P> for Accumulator<S, P> {
    #[inline(always)]
    fn row(&mut self, d: S, g: [S; P]) {
        let heavy = self.present * d;
        for i in 0..P {
            self.gradient[i] = self.gradient[i] + heavy * g[i];
            let row = self.present * g[i];
            for j in i..P {
                self.normal[i][j] = self.normal[i][j] + row * g[j];
            }
        }
    }
}

#[inline(always)]
fn block<const P: usize, F: Family<P>, W: Weighing>(
    points: &[Point],
    size: [f64; 2],
    placing: &Placing,
    weigh: &W,
) -> Sums<P> {
    let (fours, rest) = points.as_chunks::<LANES>();
    let mut wide = Accumulator::<Lane, P>::new();
    for four in fours {
        wide.add::<F, W>(size, placing.local(lanes(four)), weigh);
    }
    let mut last = Accumulator::<f64, P>::new();
    for p in rest {
        last.add::<F, W>(size, placing.local(*p), weigh);
    }
    let both = |a: Lane, b: f64| a.sum() + b;
    Sums {
        normal: std::array::from_fn(|i| std::array::from_fn(|j| both(wide.normal[i][j], last.normal[i][j]))),
        gradient: std::array::from_fn(|i| both(wide.gradient[i], last.gradient[i])),
        square: both(wide.square, last.square),
        weight: both(wide.weight, last.weight),
    }
}

/// Compiles `$body` twice, for wide registers and for any processor, and takes what this processor has.
macro_rules! widest {
    (fn $name:ident [$($generics:tt)*] [$($use:tt)*] ($($arg:ident : $type:ty),*) -> $out:ty = $body:expr) => {
        #[allow(unsafe_code)] // one call into code compiled for a processor feature that was asked for
        fn $name<$($generics)*>($($arg: $type),*) -> $out {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2")]
                fn wide<$($generics)*>($($arg: $type),*) -> $out { $body }
                if std::arch::is_x86_feature_detected!("avx2") {
                    // SAFETY: the processor was just asked for the feature.
                    return unsafe { wide::<$($use)*>($($arg),*) };
                }
            }
            $body
        }
    };
}
pub(super) use widest;

widest! {
    fn block_sums [const P: usize, F: Family<P>, W: Weighing] [P, F, W]
    (points: &[Point], size: [f64; 2], placing: &Placing, weigh: &W) -> Sums<P>
    = block::<P, F, W>(points, size, placing, weigh)
}

/// The sums of `element` over all points of `sample`.
pub(super) fn sums<const P: usize, F: Family<P>, W: Weighing>(
    element: &Element,
    sample: &Sample,
    weigh: &W,
) -> Sums<P> {
    let placing = Placing::new(element, sample);
    let of = |points: &[Point]| block_sums::<P, F, W>(points, element.size, &placing, weigh);
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
