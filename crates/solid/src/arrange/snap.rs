//! Points that rounding has left too close to other points are moved to these.
//!
//! Facets between points that are only some spacings of numbers apart cross again after every rounding. If the points become one, such
//! facets lose their area or coincide, and the next cut cancels those that coincide.

use std::collections::{HashMap, HashSet};
use trueness_geom::space::Point;

type Cell = [i64; 3];

/// For each point of `may_move` (ascending) the nearest of the points `used` that is no farther than `reach` along any
/// axis. Only points count that may not move or are not moved, and the lowest of equally near ones. Points without one,
/// or not used, are not listed. Cost: linear.
pub(super) fn snap(positions: &[Point], used: &[bool], may_move: &[u32], reach: f64) -> HashMap<u32, u32> {
    let cell = |p: &Point| -> Cell { p.map(|x| (x / reach).floor() as i64) };
    let around = |c: Cell| {
        let by = |i: i64| [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1];
        (0..27).map(move |i| std::array::from_fn(|k| c[k].saturating_add(by(i)[k])))
    };
    let cells_near: HashSet<Cell> =
        may_move.iter().flat_map(|p| around(cell(&positions[*p as usize]))).collect();
    let mut stay: HashMap<Cell, Vec<u32>> = HashMap::new();
    let mut movable = may_move.iter().peekable();
    for (v, p) in (0..).zip(positions) {
        if movable.next_if(|m| **m == v).is_none() && used[v as usize] && cells_near.contains(&cell(p)) {
            stay.entry(cell(p)).or_default().push(v);
        }
    }
    let mut to = HashMap::new();
    for &v in may_move.iter().filter(|v| used[**v as usize]) {
        let p = positions[v as usize];
        let far = |w: u32| {
            let q = positions[w as usize];
            (0..3).map(|k| (p[k] - q[k]).abs()).fold(0.0, f64::max)
        };
        let near = around(cell(&p)).filter_map(|c| stay.get(&c)).flatten().map(|w| (far(*w), *w));
        match near.filter(|n| n.0 <= reach).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))) {
            Some((_, w)) => drop(to.insert(v, w)),
            None => stay.entry(cell(&p)).or_default().push(v),
        }
    }
    to
}

/// Which of so many points are corners of these faces.
pub(super) fn used(points: usize, faces: &[[u32; 3]]) -> Vec<bool> {
    let mut used = vec![false; points];
    faces.iter().flatten().for_each(|v| used[*v as usize] = true);
    used
}
