//! The least greatest distance over a small set of points, solved to the end.
//!
//! A sequence of linear programs in the small motions of the element, each within a box that grows while the linear model
//! holds. Where as many points touch as there are unknowns and one, this is Newton's method. Where fewer touch, curvature
//! decides. Then a Newton step on the conditions of Karush, Kuhn and Tucker is tried with the points that hold the linear
//! program. R. Fletcher, Practical Methods of Optimization (1987), section 14.

use super::family::{Element, Family, slope};
use super::linear::{Function, HIDDEN_FALL, Lowest, lowest};
use crate::num::dense;
use crate::space::Point;

/// The quantity that is made least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Aim {
    /// Distances count on the outer side.
    pub outer: bool,
    /// Distances count on the inner side.
    pub inner: bool,
    /// The first size stays as it is: it is the answer, not an unknown.
    pub pinned: bool,
}

/// A touching point: its place among the points given, the side, and its multiplier.
pub(super) type Held = (usize, f64, f64);

/// Where the search ended.
#[derive(Clone, Debug)]
pub(super) struct Low {
    pub element: Element,
    /// The greatest distance that counts, in the unit frame.
    pub value: f64,
    pub held: Vec<Held>,
    /// Length of the sum of the held gradients, each times its multiplier: zero at a true optimum.
    pub slack: f64,
    pub steps: usize,
}

/// Most linear programs of one search.
const MAX_PROGRAMS: usize = 120;
/// Box in which the multipliers of the optimum are found. It is larger than the error of the optimum, smaller than anything
/// that matters.
const CERTIFICATE_BOX: f64 = 1e-7;

/// All functions of the points at one element.
fn functions<const P: usize, F: Family<P>>(
    element: &Element,
    points: &[Point],
    aim: Aim,
) -> (Vec<Function<P>>, Vec<(usize, f64)>) {
    let both = usize::from(aim.outer) + usize::from(aim.inner);
    let mut functions = Vec::with_capacity(both * points.len());
    let mut origin = Vec::with_capacity(functions.capacity());
    for (i, &p) in points.iter().enumerate() {
        let (d, mut g) = slope::<P, F>(element.size, element.pose.local(p));
        if aim.pinned {
            pin::<P, F>(&mut g);
        }
        if aim.outer {
            functions.push(Function { level: d, slope: g });
            origin.push((i, 1.0));
        }
        if aim.inner {
            functions.push(Function { level: -d, slope: g.map(|x| -x) });
            origin.push((i, -1.0));
        }
    }
    (functions, origin)
}

fn pin<const P: usize, F: Family<P>>(g: &mut [f64; P]) {
    for (x, local) in g.iter_mut().zip(F::LOCAL) {
        if local == super::unknown::Local::Size(0) {
            *x = 0.0;
        }
    }
}

/// The greatest distance that counts.
fn greatest<const P: usize, F: Family<P>>(element: &Element, points: &[Point], aim: Aim) -> f64 {
    points.iter().fold(f64::NEG_INFINITY, |most, &p| {
        let d: f64 = F::distance(element.size, element.pose.local(p));
        let outer = if aim.outer { d } else { f64::NEG_INFINITY };
        let inner = if aim.inner { -d } else { f64::NEG_INFINITY };
        most.max(outer).max(inner)
    })
}

/// The local optimum reached from `start` over `points` (unit frame, not empty), with a first box of
/// `first_reach` times the effect of each unknown.
pub(super) fn minimax<const P: usize, F: Family<P>>(
    start: &Element,
    points: &[Point],
    aim: Aim,
    first_reach: f64,
) -> Option<Low> {
    let mut element = *start;
    let mut reach = first_reach;
    let mut value = greatest::<P, F>(&element, points, aim);
    for steps in 1..=MAX_PROGRAMS {
        let (mut all, origin) = functions::<P, F>(&element, points, aim);
        let unit = scales(&all);
        for f in &mut all {
            for k in 0..P {
                f.slope[k] *= unit[k];
            }
        }
        let program = lowest(&all, reach)?;
        let fall = value - program.value;
        if fall <= HIDDEN_FALL || reach < 1e-15 || steps == MAX_PROGRAMS {
            // In a box that has become tiny its sides would hold the program, not the points.
            let certificate = lowest(&all, CERTIFICATE_BOX)?;
            return Some(finished(element, value, &certificate, &all, &origin, steps));
        }
        let try_step = |x: &[f64; P]| -> Option<(Element, f64)> {
            let step = std::array::from_fn(|k| x[k] * unit[k]);
            let moved = element.moved(&F::LOCAL, &step).filter(|e| F::sound(e.size))?;
            Some((moved, greatest::<P, F>(&moved, points, aim)))
        };
        let straight = try_step(&program.x);
        let gain = straight.map_or(f64::NEG_INFINITY, |(_, v)| (value - v) / fall);
        let mut next = straight.filter(|s| s.1 < value);
        if gain < 0.9 && (program.boxed > 1e-14 || gain < 0.25) {
            let curved = newton::<P, F>(&element, points, aim, &program, &all, &origin, &unit);
            // Beyond the first box the curvature is another one; a shorter step may still go down the valley.
            let curved = curved.and_then(|x| {
                let length = x.iter().fold(0.0f64, |m, x| m.max(x.abs()));
                let whole = (first_reach / length).min(1.0);
                [1.0, 0.3, 0.1]
                    .into_iter()
                    .find_map(|part| try_step(&x.map(|x| part * whole * x)).filter(|s| s.1 < value))
            });
            if let Some(c) = curved
                && next.is_none_or(|n| c.1 < n.1)
            {
                next = Some(c);
            }
        }
        if gain > 0.75 {
            reach *= 4.0;
        } else if gain < 0.25 {
            let length = program.x.iter().fold(0.0f64, |m, x| m.max(x.abs()));
            reach = 0.25 * reach.min(length);
        }
        if let Some((e, v)) = next {
            (element, value) = (e, v);
        }
    }
    None
}

/// Steps of the unknowns that move some distance by one.
fn scales<const P: usize>(all: &[Function<P>]) -> [f64; P] {
    let mut most = [0.0f64; P];
    for f in all {
        for k in 0..P {
            most[k] = most[k].max(f.slope[k].abs());
        }
    }
    most.map(|m| if m > 0.0 { 1.0 / m } else { 0.0 })
}

fn finished<const P: usize>(
    element: Element,
    value: f64,
    program: &Lowest<P>,
    all: &[Function<P>],
    origin: &[(usize, f64)],
    steps: usize,
) -> Low {
    let mut sum = [0.0; P];
    let mut held = Vec::with_capacity(program.holding.len());
    for &(i, multiplier) in &program.holding {
        for k in 0..P {
            sum[k] += multiplier * all[i].slope[k];
        }
        if multiplier > 1e-12 {
            held.push((origin[i].0, origin[i].1, multiplier));
        }
    }
    held.sort_by_key(|h| h.0);
    Low { element, value, held, slack: sum.iter().map(|x| x * x).sum::<f64>().sqrt(), steps }
}

/// Step to the point where the functions that hold the program are equal and their gradients cancel, to second
/// order; in units of `unit`.
fn newton<const P: usize, F: Family<P>>(
    element: &Element,
    points: &[Point],
    aim: Aim,
    program: &Lowest<P>,
    all: &[Function<P>],
    origin: &[(usize, f64)],
    unit: &[f64; P],
) -> Option<[f64; P]> {
    let held = &program.holding;
    let count = P + 1 + held.len();
    let mut matrix = vec![vec![0.0; count]; count];
    let mut right = vec![0.0; count];
    // Curvature of the sum: differences of its gradient.
    let gradient = |e: &Element| {
        let mut sum = [0.0; P];
        for &(i, multiplier) in held {
            let (point, side) = origin[i];
            let (_, mut g) = slope::<P, F>(e.size, e.pose.local(points[point]));
            if aim.pinned {
                pin::<P, F>(&mut g);
            }
            for k in 0..P {
                sum[k] += multiplier * side * g[k] * unit[k];
            }
        }
        sum
    };
    /// Step to either side of the central differences of gradients, in the unit frame.
    const DIFFERENCE_STEP: f64 = 1e-5;
    for k in 0..P {
        if unit[k] == 0.0 {
            matrix[k][k] = 1.0;
            continue;
        }
        let at = |h: f64| {
            element.moved(&F::LOCAL, &std::array::from_fn(|i| if i == k { h * unit[k] } else { 0.0 }))
        };
        let (more, less) = (gradient(&at(DIFFERENCE_STEP)?), gradient(&at(-DIFFERENCE_STEP)?));
        for i in 0..P {
            matrix[i][k] = (more[i] - less[i]) / (2.0 * DIFFERENCE_STEP);
        }
    }
    for (j, &(i, _)) in held.iter().enumerate() {
        let row = P + 1 + j;
        for k in 0..P {
            matrix[k][row] = all[i].slope[k];
            matrix[row][k] = all[i].slope[k];
        }
        matrix[row][P] = -1.0;
        matrix[P][row] = 1.0;
        right[row] = -all[i].level;
    }
    right[P] = 1.0;
    let x = dense::solve(matrix, right)?;
    Some(std::array::from_fn(|k| x[k]))
}
