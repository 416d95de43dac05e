//! Points in a plane gathered in square cells, the shortest tree over these, and the longest ways through it.

use super::gaps::Way;
use crate::model::flat::distance;
use std::collections::HashMap;

/// Fewest cells of a way; a branch of fewer hangs beside.
pub(super) const MIN_CELLS_OF_WAY: usize = 4;

/// Points gathered in square cells.
pub(super) struct Cells {
    pub width: f64,
    /// Mean of the points of each cell.
    pub middles: Vec<[f64; 2]>,
    members: Vec<Vec<usize>>,
    at: HashMap<[i64; 2], usize>,
    keys: Vec<[i64; 2]>,
}

/// Cells with the neighbors on the tree.
pub(super) type Tree = Vec<Vec<usize>>;

impl Cells {
    pub fn new(points: &[[f64; 2]], width: f64) -> Cells {
        let mut cells = Cells { width, middles: vec![], members: vec![], at: HashMap::new(), keys: vec![] };
        for (i, p) in points.iter().enumerate() {
            let key = cells.key(*p);
            let next = cells.members.len();
            let cell = *cells.at.entry(key).or_insert(next);
            if cell == next {
                cells.members.push(vec![]);
                cells.keys.push(key);
            }
            cells.members[cell].push(i);
        }
        cells.middles = cells
            .members
            .iter()
            .map(|own| [0, 1].map(|k| own.iter().map(|i| points[*i][k]).sum::<f64>() / own.len() as f64))
            .collect();
        cells
    }

    /// The shortest tree over cells, by Kruskal's method, without edges longer than `reach`; and of each cell the number of edges that some
    /// shortest tree has. In a regular grid there are many such trees.
    pub fn tree(&self, reach: f64) -> (Tree, Vec<usize>) {
        let n = self.middles.len();
        let around = ((reach / self.width).ceil() as i64).clamp(1, 12);
        let mut edges: Vec<(f64, usize, usize)> = vec![];
        for (i, [x, y]) in self.keys.iter().enumerate() {
            // Each pair from one of the two: the other half of the cells around look for this one.
            for dx in 0..=around {
                for dy in if dx == 0 { 1 } else { -around }..=around {
                    let Some(&j) = self.at.get(&[x + dx, y + dy]) else { continue };
                    let d = distance(self.middles[i], self.middles[j]);
                    if d <= reach {
                        edges.push((d, i.min(j), i.max(j)));
                    }
                }
            }
        }
        edges.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        let mut root: Vec<usize> = (0..n).collect();
        let (mut tree, mut choices) = (vec![vec![]; n], vec![0; n]);
        // Lengths are equal but for rounding.
        let rounding = 1.0 + f64::EPSILON.sqrt();
        for equal in edges.chunk_by(|a, b| b.0 <= a.0 * rounding) {
            for (_, i, j) in equal {
                if find(&mut root, *i) != find(&mut root, *j) {
                    choices[*i] += 1;
                    choices[*j] += 1;
                }
            }
            for (_, i, j) in equal {
                let (a, b) = (find(&mut root, *i), find(&mut root, *j));
                if a != b {
                    root[a.max(b)] = a.min(b);
                    tree[*i].push(*j);
                    tree[*j].push(*i);
                }
            }
        }
        (tree, choices)
    }

    /// The points of the cells along a way, each cell with the branches beside it, in order, each with its place along.
    /// Also the length of the way.
    pub fn along(&self, points: &[[f64; 2]], way: &Way, closed: bool) -> (Vec<(f64, usize)>, f64) {
        let m = way.len();
        let middle = |k: usize| self.middles[way[k].0];
        let mut all: Vec<(f64, usize)> = vec![];
        let mut station = 0.0;
        for k in 0..m {
            let (before, after) = match closed {
                true => (middle((k + m - 1) % m), middle((k + 1) % m)),
                false => (middle(k.saturating_sub(1)), middle((k + 1).min(m - 1))),
            };
            let whole = distance(before, after).max(f64::MIN_POSITIVE);
            let along = [(after[0] - before[0]) / whole, (after[1] - before[1]) / whole];
            let own = std::iter::once(&way[k].0).chain(&way[k].1).flat_map(|c| &self.members[*c]);
            for i in own {
                let (p, q) = (points[*i], middle(k));
                all.push((station + (p[0] - q[0]) * along[0] + (p[1] - q[1]) * along[1], *i));
            }
            station += if k + 1 < m { distance(middle(k), middle(k + 1)) } else { 0.0 };
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        (all, station + if closed { distance(middle(m - 1), middle(0)) } else { 0.0 })
    }

    /// Points of the cell a place is in, and of those around it.
    pub fn around(&self, place: [f64; 2]) -> impl Iterator<Item = usize> + '_ {
        let [x, y] = self.key(place);
        let keys = (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
        keys.filter_map(|key| self.at.get(&key)).flat_map(|cell| &self.members[*cell]).copied()
    }

    fn key(&self, place: [f64; 2]) -> [i64; 2] {
        place.map(|x| (x / self.width).floor() as i64)
    }
}

fn find(root: &mut [usize], mut i: usize) -> usize {
    while root[i] != i {
        root[i] = root[root[i]];
        i = root[i];
    }
    i
}

/// The longest ways through each tree: cells in order, each with the cells of short branches beside it.
pub(super) fn tree_paths(cells: &Cells, tree: &Tree) -> Vec<Way> {
    let n = tree.len();
    let mut used = vec![false; n];
    let mut ways = vec![];
    let mut open: Vec<usize> = (0..n).rev().collect();
    while let Some(start) = open.pop() {
        if used[start] {
            continue;
        }
        let (from, _) = farthest(cells, tree, &used, start);
        let (to, before) = farthest(cells, tree, &used, from);
        let mut way = vec![to];
        while let Some(&last) = before.get(&way[way.len() - 1]) {
            way.push(last);
        }
        way.iter().for_each(|c| used[*c] = true);
        let mut rows: Way = vec![];
        for cell in way {
            let mut branches = vec![];
            for &next in &tree[cell] {
                if !used[next] {
                    let branch = reachable(tree, &used, next);
                    if branch.len() < MIN_CELLS_OF_WAY {
                        branch.iter().for_each(|c| used[*c] = true);
                        branches.extend(branch);
                    }
                }
            }
            rows.push((cell, branches));
        }
        ways.push(rows);
    }
    ways
}

/// The unused cell farthest from `start` along the tree, and for each cell the one before it on the way.
fn farthest(cells: &Cells, tree: &Tree, used: &[bool], start: usize) -> (usize, HashMap<usize, usize>) {
    let mut before = HashMap::new();
    let mut best = (0.0, start);
    let mut stack = vec![(start, start, 0.0)];
    while let Some((cell, from, way)) = stack.pop() {
        if way > best.0 {
            best = (way, cell);
        }
        for &next in tree[cell].iter().filter(|c| **c != from && !used[**c]) {
            before.insert(next, cell);
            stack.push((next, cell, way + distance(cells.middles[cell], cells.middles[next])));
        }
    }
    (best.1, before)
}

fn reachable(tree: &Tree, used: &[bool], start: usize) -> Vec<usize> {
    let mut all = vec![start];
    let mut stack = vec![(start, start)];
    while let Some((cell, from)) = stack.pop() {
        for &next in tree[cell].iter().filter(|c| **c != from && !used[**c]) {
            all.push(next);
            stack.push((next, cell));
        }
    }
    all
}
