//! Bounds of second derivatives of splines, cell by cell.
//!
//! A facet differs from the surface by a vector `e` no longer than `b`, which follows from all of the second derivatives. What of it lies
//! along the surface moves the foot and is hardly a distance: with the unit normal `n` of the surface, and the steps of the parameters
//! `δ` that go along `e`, the facet is within `|e·n| + (δu² M₁ + 2 δu δv M₂ + δv² M₃) / 2`. A thread turns about its axis while its normals
//! hardly turn: by `e·n` its facets may be a hundred times longer.

use crate::curve::{Curve, CurveFeet};
use crate::surface::{Bends, Patch, Seconds, Slopes};
use trueness_geom::space::{Vector, dot, minus, norm, plus, unit};

/// Bounds for each cell: a part of a span between knots over which the surface hardly turns.
#[derive(Clone, Debug)]
pub struct Net {
    /// Ends of the spans along both parameters.
    pub knots: [Vec<f64>; 2],
    /// Ends of the cells.
    ends: [Vec<f64>; 2],
    /// Row after row: cells of the first part of `u` come first.
    cells: Vec<Cell>,
    /// Values of both parameters at which the surface may have a crease.
    pub creases: [Vec<f64>; 2],
}

/// What holds all over a cell.
#[derive(Clone, Copy, Debug)]
struct Cell {
    seconds: Seconds,
    /// Extents of the second derivatives along `up` at most.
    across: Seconds,
    /// Unit normal in the middle; 0 where there is none.
    up: Vector,
    /// By how much unit normals differ from that at most.
    tilt: f64,
    /// How fast the surface moves with each parameter at least, at right angles to the other one.
    speeds: [f64; 2],
}

/// Share of its length by which a first derivative may change over a cell.
const CHANGE_IN_CELL: f64 = 0.25;
/// Parts of a span along a parameter at most.
const MAX_PARTS_OF_SPAN: usize = 16;
/// Cells at most, unless there are more spans.
const MAX_CELLS_OF_NET: usize = 1 << 17;

impl Net {
    /// Of a curve, along `u`; `None` where it is no spline.
    pub fn of_curve(curve: &Curve) -> Option<Net> {
        let patches: Vec<Patch> = CurveFeet::new(curve, curve.domain())
            .beziers()
            .map(|(points, range)| Patch::of_curve(points, range))
            .collect();
        let last = patches.last()?.range[0][1];
        let knots = patches.iter().map(|p| p.range[0][0]).chain([last]).collect();
        Some(Net::new(&patches, [knots, vec![0.0, 1.0]], [vec![], vec![]]))
    }

    /// Of a surface in pieces, row after row, between `knots`.
    pub fn new(patches: &[Patch], knots: [Vec<f64>; 2], creases: [Vec<f64>; 2]) -> Net {
        let width = knots[1].len() - 1;
        let mut parts = knots.each_ref().map(|k| vec![1usize; k.len() - 1]);
        for (n, patch) in patches.iter().enumerate() {
            let own = parts_of(patch);
            for (k, i) in [n / width, n % width].into_iter().enumerate() {
                parts[k][i] = parts[k][i].max(own[k]);
            }
        }
        let count =
            |parts: &[Vec<usize>; 2]| parts.iter().map(|p| p.iter().sum::<usize>()).product::<usize>();
        while count(&parts) > MAX_CELLS_OF_NET && parts.iter().flatten().any(|n| *n > 1) {
            parts.iter_mut().flatten().for_each(|n| *n = (*n / 2).max(1));
        }
        let ends = [0, 1].map(|k| divided(&knots[k], &parts[k]));
        let mut cells = vec![];
        for (i, row) in patches.chunks(width).enumerate() {
            let columns: Vec<Vec<Cell>> =
                row.iter().enumerate().map(|(j, p)| cells_of(p, [parts[0][i], parts[1][j]])).collect();
            for u in 0..parts[0][i] {
                for (j, own) in columns.iter().enumerate() {
                    let n = parts[1][j];
                    cells.extend_from_slice(&own[u * n..(u + 1) * n]);
                }
            }
        }
        Net { knots, ends, cells, creases }
    }

    fn touched(&self, sides: [[f64; 2]; 2]) -> impl Iterator<Item = &Cell> {
        let [us, vs] = [0, 1].map(|k| {
            let ends = &self.ends[k];
            let last = ends.len() - 2;
            let from = ends.partition_point(|t| *t <= sides[k][0]).saturating_sub(1).min(last);
            let to = ends.partition_point(|t| *t < sides[k][1]).saturating_sub(1).min(last);
            from..to.max(from) + 1
        });
        let width = self.ends[1].len() - 1;
        us.flat_map(move |i| self.cells[i * width + vs.start..i * width + vs.end].iter())
    }

    /// The greatest second derivatives over a box of parameters.
    pub fn over(&self, sides: [[f64; 2]; 2]) -> Seconds {
        greatest(self.touched(sides).map(|cell| cell.seconds))
    }

    /// The greatest extents of the second derivatives along the normals.
    pub fn along_normals(&self, sides: [[f64; 2]; 2]) -> Seconds {
        let of = |c: &Cell| [0, 1, 2].map(|n| (c.across[n] + c.tilt * c.seconds[n]).min(c.seconds[n]));
        greatest(self.touched(sides).map(of))
    }

    /// How far a facet between places of these boxes, all parts of one box with these extents, is from the surface or from what would
    /// continue it; and by how much the parameters of its feet may leave the boxes.
    pub fn facet(&self, boxes: &[[[f64; 2]; 2]], extents: [f64; 2]) -> (f64, [f64; 2]) {
        let cells = || boxes.iter().flat_map(|sides| self.touched(*sides));
        let most = chord(greatest(cells().map(|c| c.seconds)), extents);
        let doubt = (most, [0.0; 2]);
        let Some((up, _)) = unit(cells().fold([0.0; 3], |sum, c| plus(sum, c.up))) else { return doubt };
        if cells().any(|c| dot(c.up, up) <= 0.0) {
            return doubt;
        }
        let turn = |c: &Cell| norm(minus(c.up, up));
        let across = greatest(cells().map(|c| [0, 1, 2].map(|n| c.across[n] + turn(c) * c.seconds[n])));
        let tilt = cells().map(|c| turn(c) + c.tilt).fold(0.0, f64::max);
        let shift = [0, 1].map(|k| most / cells().map(|c| c.speeds[k]).fold(f64::INFINITY, f64::min));
        if shift.iter().any(|s| !s.is_finite()) {
            return doubt;
        }
        let wider = |[from, to]: [f64; 2], by: f64| [from - by, to + by];
        let around = boxes.iter().map(|[u, v]| self.over([wider(*u, shift[0]), wider(*v, shift[1])]));
        let moved = 4.0 * chord(greatest(around), shift);
        let distance = chord(across, extents) + tilt * most + moved;
        if distance < most { (distance, shift) } else { doubt }
    }
}

/// How far a facet with these extents differs from the surface.
pub fn chord([uu, uv, vv]: Seconds, [h, k]: [f64; 2]) -> f64 {
    0.125 * (h * h * uu + 2.0 * h * k * uv + k * k * vv)
}

fn greatest(all: impl Iterator<Item = Seconds>) -> Seconds {
    all.fold([0.0; 3], |a, b| [0, 1, 2].map(|n| f64::max(a[n], b[n])))
}

/// Parts of a patch along both parameters, powers of 2.
fn parts_of(patch: &Patch) -> [usize; 2] {
    let [uu, uv, vv] = Bends::new(&patch.net).greatest();
    let [du, dv] = patch.jet([0.5; 2]).first.map(norm);
    let change = |a: f64, b: f64| {
        let share = |s: f64, d: f64| if s > 0.0 { s / d } else { 0.0 };
        0.5 * share(a, du).max(share(b, dv))
    };
    [change(uu, uv), change(uv, vv)].map(|c| {
        let parts = (c / CHANGE_IN_CELL).clamp(1.0, MAX_PARTS_OF_SPAN as f64);
        (parts.ceil() as usize).next_power_of_two()
    })
}

/// The cells of a patch.
fn cells_of(patch: &Patch, parts: [usize; 2]) -> Vec<Cell> {
    let widths = patch.range.map(|[a, b]| b - a);
    let mut cells = vec![];
    for (i, row) in divisions(Bends::new(&patch.net), 0, parts[0]).into_iter().enumerate() {
        for (j, bends) in divisions(row, 1, parts[1]).into_iter().enumerate() {
            let middle = [0, 1].map(|k| ([i, j][k] as f64 + 0.5) / parts[k] as f64);
            let half = parts.map(|n| 0.5 / n as f64);
            cells.push(cell(&bends, patch.jet(middle).first, half, widths));
        }
    }
    cells
}

fn cell(bends: &Bends, middle: [Vector; 2], half: [f64; 2], [h, k]: [f64; 2]) -> Cell {
    let seconds = bends.greatest();
    let slopes = Slopes::new(middle, seconds, half);
    let (wide, off) = slopes.normal();
    let (up, area) = unit(wide).unwrap_or(([0.0; 3], 0.0));
    let least = (area - off).max(0.0);
    let speed = |other: usize| least / (norm(middle[other]) + slopes.off[other]);
    let speeds = [speed(1), speed(0)];
    // A unit vector along the surface is a sum of both first derivatives, each no more than once over its speed: what these rise by along
    // `up` is the sine of the angle between the planes at most.
    let across = bends.along(up);
    let rises = Slopes::new(middle, across, half).off;
    let sine = rises[0] / speeds[0] + rises[1] / speeds[1];
    // The chord of the angle.
    let tilt = if sine < 1.0 { (2.0 - 2.0 * (1.0 - sine * sine).sqrt()).sqrt() } else { 2.0 };
    let own = |[uu, uv, vv]: Seconds| [uu / (h * h), uv / (h * k), vv / (k * k)];
    Cell { seconds: own(seconds), across: own(across), up, tilt, speeds: [speeds[0] / h, speeds[1] / k] }
}

/// Equal parts along a direction; their number is a power of 2.
fn divisions(whole: Bends, k: usize, parts: usize) -> Vec<Bends> {
    if parts == 1 {
        return vec![whole];
    }
    whole.halves(k).into_iter().flat_map(|half| divisions(half, k, parts / 2)).collect()
}

/// Ends of the parts of spans.
fn divided(knots: &[f64], parts: &[usize]) -> Vec<f64> {
    let mut ends = vec![knots[0]];
    for (w, n) in knots.windows(2).zip(parts) {
        let inner = |i: usize| w[0] + (w[1] - w[0]) * i as f64 / *n as f64;
        ends.extend((1..=*n).map(|i| if i == *n { w[1] } else { inner(i) }));
    }
    ends
}
