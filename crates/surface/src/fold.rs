//! Layers: where several parts of a surface lie over the same place of the base.

use trueness_geom::parallel::prelude::*;

/// Points to a cell in the mean.
const POINTS_PER_CELL: f64 = 16.0;

/// Share of the points in cells where two layers lie over one another.
///
/// The points of a cell fall into two groups at the widest gap of their heights. Where the gap is wider than the cell,
/// there are two layers. The exception is groups that can be told apart by where they lie in the cell, as those of a
/// step. Where groups have very different sizes the smaller one counts alone: outliers are no layer.
pub(super) fn share(seen: &[([f64; 2], f64)], domain: [(f64, f64); 2]) -> f64 {
    let sides = domain.map(|d| d.1 - d.0);
    let cell = (sides[0] * sides[1] * POINTS_PER_CELL / seen.len() as f64).sqrt();
    let counts = sides.map(|s| (s / cell).ceil().clamp(1.0, 4096.0) as usize);
    let rates = [0, 1].map(|k| counts[k] as f64 / sides[k]);
    let cell_of = |p: [f64; 2]| {
        let at = |k: usize| (((p[k] - domain[k].0) * rates[k]) as usize).min(counts[k] - 1);
        (at(0) * counts[1] + at(1)) as u32
    };
    let cells: Vec<u32> = seen.par_iter().map(|s| cell_of(s.0)).collect();
    let mut heights = vec![(f64::INFINITY, f64::NEG_INFINITY); counts[0] * counts[1]];
    for (cell, (_, height)) in cells.iter().zip(seen) {
        let (low, high) = &mut heights[*cell as usize];
        (*low, *high) = (low.min(*height), high.max(*height));
    }
    // No gap is wider than all of it: most cells need no look at their points.
    let tall: Vec<bool> = heights.iter().map(|(low, high)| high - low > cell).collect();
    let tall_points = || (0..).zip(&cells).filter(|(_, cell)| tall[**cell as usize]);
    // Their points sorted by cell, in their order.
    let mut starts = vec![0u32; tall.len() + 1];
    tall_points().for_each(|(_, cell): (u32, _)| starts[*cell as usize + 1] += 1);
    (1..starts.len()).for_each(|k| starts[k] += starts[k - 1]);
    let (mut next, mut order) = (starts.clone(), vec![0u32; starts[tall.len()] as usize]);
    for (i, cell) in tall_points() {
        let at = &mut next[*cell as usize];
        order[*at as usize] = i;
        *at += 1;
    }
    let folded = |k: usize| {
        let own = &order[starts[k] as usize..starts[k + 1] as usize];
        let own: Vec<([f64; 2], f64)> = own.iter().map(|i| seen[*i as usize]).collect();
        layered(own, cell)
    };
    (0..tall.len()).into_par_iter().map(folded).sum::<usize>() as f64 / seen.len() as f64
}

/// How many of the points of a cell lie in layers. That is all; but where one of two layers has less than a quarter of
/// them, it is that layer's points.
fn layered(mut own: Vec<([f64; 2], f64)>, cell: f64) -> usize {
    if own.len() < 4 {
        return 0;
    }
    own.sort_unstable_by(|a, b| a.1.total_cmp(&b.1));
    let gap = |i: &usize| own[*i].1 - own[*i - 1].1;
    let Some(at) = (1..own.len()).max_by(|a, b| gap(a).total_cmp(&gap(b))) else { return 0 };
    if gap(&at) <= cell {
        return 0;
    }
    let (low, high) = own.split_at(at);
    if low.len().min(high.len()) < 2 {
        return 0;
    }
    let middle = |part: &[([f64; 2], f64)]| {
        let n = part.len() as f64;
        [0, 1].map(|k| part.iter().map(|p| p.0[k]).sum::<f64>() / n)
    };
    let (a, b) = (middle(low), middle(high));
    // Fisher's discriminant: the direction in which the groups lie farthest apart for their own spread.
    let mut spread = [[0.0; 2]; 2];
    for (part, m) in [(low, a), (high, b)] {
        for (p, _) in part {
            let d = [p[0] - m[0], p[1] - m[1]];
            (0..2).for_each(|i| (0..2).for_each(|j| spread[i][j] += d[i] * d[j]));
        }
    }
    let [[xx, xy], [_, yy]] = spread;
    let apart = [b[0] - a[0], b[1] - a[1]];
    let direction = [yy * apart[0] - xy * apart[1], xx * apart[1] - xy * apart[0]];
    let along = |p: &[f64; 2]| p[0] * direction[0] + p[1] * direction[1];
    let half = along(&[0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
    let wrong_low = low.iter().filter(|p| along(&p.0) > half).count();
    let wrong_high = high.iter().filter(|p| along(&p.0) < half).count();
    let apart = 10 * (wrong_low + wrong_high) <= own.len() || wrong_low.min(wrong_high) == 0;
    let fewer = low.len().min(high.len());
    if apart {
        0
    } else if 4 * fewer < own.len() {
        // A few points far off are outliers, and the layer of all others is one.
        fewer
    } else {
        own.len()
    }
}
