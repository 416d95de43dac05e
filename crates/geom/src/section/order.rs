//! Points in a plane put in the order in which they follow each other along contours.
//!
//! Points scatter across a contour by more than they lie apart along it, so the nearest neighbor is not the next. The points
//! are gathered in square cells, made larger until the shortest tree over their middles hardly branches: then it follows the
//! contour. The longest way through the tree is the contour's course; what hangs beside it is put in where it hangs. Ways are
//! linked over gaps that uneven points have by chance. A way along both faces of a thin wall is parted in two. (After Lee, Curve reconstruction from unorganized points, Computer Aided
//! Geometric Design 17, 2000; cells in place of moving least squares.)

use super::link::{Limits, Linked, Way, gap_to_close, link, longest_by_chance};
use super::untangle::untangle;
use super::walls::{Faces, faces};
use crate::progress::{Cancelled, Progress};
use std::collections::HashMap;

/// Points that follow each other along one contour.
#[derive(Clone, Debug, PartialEq)]
pub struct Ordered {
    /// Their numbers, in order.
    pub numbers: Vec<usize>,
    /// Whether the last is near the first.
    pub closed: bool,
    /// Length of the way along which they were put in order, mm.
    pub way: f64,
    /// They may be of both faces of a wall, which is about this thick: too little for how the points scatter to tell them apart. `None` of
    /// points of one face.
    pub layered: Option<f64>,
}

/// The contours of points in a plane, and over what gaps they go on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Order {
    /// The contours: that of the most points first.
    pub rows: Vec<Ordered>,
    /// A contour goes on over gaps up to this, mm: the one given, or told from how uneven the points are. 0 where there are too
    /// few points to tell.
    pub gap: f64,
    /// Where contours are suspiciously many and open: the gap over which most of their ends would meet others, mm.
    pub wider: Option<f64>,
}

/// Share of branching cells up to which a tree follows a contour.
const BRANCHING: f64 = 0.04;
/// A tree in more pieces than this share of its cells, and so many more, reaches too short for how uneven the points are; a
/// longer reach is worth it while it leaves no more than this share of the pieces.
const PIECES: (f64, usize) = (0.03, 4);
const FEWER: f64 = 0.7;
/// Cells grow by this factor, so many times at most.
const GROWTH: (f64, usize) = (1.4, 24);
/// A tree reaches over so many cells.
const REACH: f64 = 4.0;
/// To the middle of the next cell, across a corner too, a tree reaches over so many.
const NEXT_CELL: f64 = 1.5;
/// The longest gap by chance is no larger than this share of all.
const LARGEST: f64 = 0.25;
/// Fewest cells and points of a contour.
const FEWEST: (usize, usize) = (4, 8);
/// So many open contours are suspicious where they are more than half of all.
const SUSPICIOUS: usize = 6;

/// Contours of points in the plane, in any order.
///
/// A contour goes on over gaps up to `gap`; where it is not given, over gaps that points so uneven have by chance, and four cells
/// at least. Points of no contour, fewer than eight together, are left out. Contours that touch each other are one with branches:
/// the longest way is a contour, each of the rest that is long enough another. Cost: the points' number times its logarithm.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
///
/// ```
/// use trueness_geom::section::order;
/// let line: Vec<[f64; 2]> = (0..40).map(|i| [f64::from(i * 7 % 40), 0.0]).collect();
/// let found = order(&line, None, &trueness_geom::progress::Silent).unwrap().rows;
/// assert!(found.len() == 1 && !found[0].closed);
/// let along: Vec<f64> = found[0].numbers.iter().map(|i| line[*i][0]).collect();
/// assert!(along.is_sorted() || along.iter().rev().is_sorted());
/// ```
pub fn order(points: &[[f64; 2]], gap: Option<f64>, progress: &dyn Progress) -> Result<Order, Cancelled> {
    let n = points.len();
    let range = |k: usize| {
        points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p[k]), b.max(p[k])))
    };
    let size = libm::hypot(range(0).1 - range(0).0, range(1).1 - range(1).0);
    if n < FEWEST.1 || size <= 0.0 || !size.is_finite() {
        return Ok(Order { gap: gap.unwrap_or(0.0), ..Order::default() });
    }
    let Some(grown) = grow(points, 2.0 * size / n as f64, gap, progress)? else {
        return Ok(Order::default());
    };
    let (width, levels) =
        if grown.follows { (grown.cells.width, WALL.1) } else { (2.0 * size / n as f64, GROWTH.1) };
    let mut found = rows(points, grown, gap, size);
    let mut tried = parted(points, &mut found.0, gap, progress)?;
    // A tree whose cells are smaller than a wall is thick may run now along one face, now along the other; one of larger cells runs along
    // both, and its way is parted. Where no tree follows anything, that of any cells may.
    let mut wider_cells = width;
    let (mut layered, most) = (None, |r: &Ordered| r.numbers.len() as f64 >= WALL.0 * n as f64);
    for _ in 0..levels {
        if tried {
            break;
        }
        wider_cells *= GROWTH.0;
        // Cells of this width reach over a gap that is given.
        if gap.is_some_and(|gap| NEXT_CELL * wider_cells > gap) {
            break;
        }
        let Some(cells) = Some(Cells::new(points, wider_cells)).filter(|c| c.middles.len() >= 2 * FEWEST.0)
        else {
            break;
        };
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let reach = gap.map_or(REACH * wider_cells, |g| g.min(REACH * wider_cells));
        let tree = cells.tree(reach);
        let mut other = rows(points, Grown { cells, tree, reach, follows: true }, gap, size);
        let is_parted = parted(points, &mut other.0, gap, progress)?;
        let better = ends(&other.0) < ends(&found.0) || is_mixed(&found.0, &other.0, n);
        if is_parted && better && count(&other.0) as f64 >= WALL.0 * count(&found.0) as f64 {
            (found, tried) = (other, true);
        } else if !is_parted {
            layered = layered.or(other.0.iter().filter(|r| most(r)).find_map(|r| r.layered));
        }
    }
    // What runs along both faces of a wall in places, the smaller cells cannot have told apart everywhere.
    if !tried {
        found.0.iter_mut().for_each(|row| row.layered = row.layered.or(layered));
    }
    let (mut rows, gap) = found;
    rows.retain(|r| r.numbers.len() >= FEWEST.1);
    rows.sort_by_key(|r| std::cmp::Reverse(r.numbers.len()));
    let wider = wider(points, &rows, gap);
    Ok(Order { rows, gap, wider })
}

/// Cells grow so many times more where walls may be thin; of a wall parted in two, faces keep so large a share of their points.
const WALL: (f64, usize) = (0.9, 6);

/// The rows along a tree, and over what gap they go on.
fn rows(points: &[[f64; 2]], grown: Grown, gap: Option<f64>, size: f64) -> (Vec<Ordered>, f64) {
    let Grown { cells, tree, reach, follows } = grown;
    let ways = tree_paths(&cells, &tree);
    let gap = match (gap, follows) {
        (Some(gap), _) => gap.max(NEXT_CELL * cells.width),
        (None, true) => {
            let all = ways.iter().map(|way| cells.along(points, way, false).0);
            let steps = all.flat_map(|all| all.windows(2).map(|w| w[1].0 - w[0].0).collect::<Vec<f64>>());
            longest_by_chance(steps.collect(), reach).min((LARGEST * size).max(reach))
        }
        // A tree that branches everywhere follows no contour: nothing is known of its gaps.
        (None, false) => reach,
    };
    let limits = Limits { gap, closing: reach, fewest: 2 * FEWEST.0 };
    let linked = link(ways, &cells.middles, &limits);
    (linked.iter().map(|way| cells.row(points, way)).collect(), gap)
}

fn count(rows: &[Ordered]) -> usize {
    rows.iter().map(|r| r.numbers.len()).sum()
}

/// Open ends of rows, and rows.
fn ends(rows: &[Ordered]) -> usize {
    let counted = rows.iter().filter(|r| r.numbers.len() >= FEWEST.1);
    counted.map(|r| if r.closed { 1 } else { 3 }).sum()
}

/// Share of a row's points that lie on another face by chance, as where noise hides whose they are.
const MIXED: f64 = 0.02;

/// Whether a row runs along several faces that others of the `count` points tell apart.
fn is_mixed(rows: &[Ordered], faces: &[Ordered], count: usize) -> bool {
    let mut face_of = vec![None; count];
    for (k, face) in faces.iter().enumerate() {
        face.numbers.iter().for_each(|i| face_of[*i] = Some(k));
    }
    let mixed = |row: &Ordered| {
        let mut counts = vec![0; faces.len()];
        row.numbers.iter().filter_map(|i| face_of[*i]).for_each(|k| counts[k] += 1);
        let most = counts.iter().max().copied().unwrap_or(0);
        counts.iter().sum::<usize>() - most > (MIXED * row.numbers.len() as f64).ceil() as usize
    };
    rows.iter().any(mixed)
}

/// Parts rows along both faces of a wall in one for each face; whether there was one.
fn parted(
    points: &[[f64; 2]],
    rows: &mut Vec<Ordered>,
    gap: Option<f64>,
    progress: &dyn Progress,
) -> Result<bool, Cancelled> {
    let mut any = false;
    let mut all = vec![];
    for mut row in std::mem::take(rows) {
        let places: Vec<[f64; 2]> = row.numbers.iter().map(|i| points[*i]).collect();
        let upper = match faces(&places, row.closed) {
            Faces::Two { upper, unclear } => {
                row.layered = unclear;
                upper
            }
            Faces::One => {
                all.push(row);
                continue;
            }
            Faces::Unclear { apart } => {
                row.layered = Some(apart);
                all.push(row);
                continue;
            }
        };
        any = true;
        for side in [false, true] {
            let numbers: Vec<usize> =
                row.numbers.iter().zip(&upper).filter(|(_, u)| **u == side).map(|(i, _)| *i).collect();
            all.extend(face(points, numbers, &row, gap, progress)?);
        }
    }
    *rows = all;
    Ok(any)
}

/// The rows of the points of one face of a wall: as they follow each other by themselves, or as they lay along the wall.
fn face(
    points: &[[f64; 2]],
    mut numbers: Vec<usize>,
    wall: &Ordered,
    gap: Option<f64>,
    progress: &dyn Progress,
) -> Result<Vec<Ordered>, Cancelled> {
    let own: Vec<[f64; 2]> = numbers.iter().map(|i| points[*i]).collect();
    let size = super::row::size(&own);
    let alone = match size > 0.0 {
        true => grow(&own, 2.0 * size / own.len() as f64, gap, progress)?,
        false => None,
    };
    let found = alone.map(|grown| rows(&own, grown, gap, size).0);
    if let Some([one]) = found.as_deref()
        && one.numbers.len() as f64 >= WALL.0 * own.len() as f64
        && one.closed == wall.closed
    {
        return Ok(vec![Ordered {
            numbers: one.numbers.iter().map(|k| numbers[*k]).collect(),
            layered: wall.layered,
            ..one.clone()
        }]);
    }
    untangle(points, &mut numbers, wall.closed, wall.way);
    Ok(vec![Ordered { numbers, ..wall.clone() }])
}

/// The gap that would let most ends of open contours meet, where these are suspiciously many.
fn wider(points: &[[f64; 2]], rows: &[Ordered], gap: f64) -> Option<f64> {
    let open: Vec<&Ordered> = rows.iter().filter(|r| !r.closed).collect();
    if open.len() < SUSPICIOUS || 2 * open.len() <= rows.len() {
        return None;
    }
    let ends = open.iter().flat_map(|r| [r.numbers[0], r.numbers[r.numbers.len() - 1]]);
    let ends: Vec<[f64; 2]> = ends.map(|i| points[i]).collect();
    gap_to_close(&ends, 2 * SUSPICIOUS).map(|wider| wider.max(gap))
}

/// Cells of the width that was found, and the tree over them.
struct Grown {
    cells: Cells,
    tree: Tree,
    reach: f64,
    /// The tree hardly branches: it follows contours.
    follows: bool,
}

/// Cells made larger until the tree over them hardly branches, and as long as that leaves far fewer pieces.
fn grow(
    points: &[[f64; 2]],
    mut width: f64,
    gap: Option<f64>,
    progress: &dyn Progress,
) -> Result<Option<Grown>, Cancelled> {
    let mut best: Option<(Grown, usize)> = None;
    for _ in 0..GROWTH.1 {
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let cells = Cells::new(points, width);
        let reach = gap.map_or(REACH * width, |g| g.min(REACH * width).max(NEXT_CELL * width));
        let tree = cells.tree(reach);
        let n = cells.middles.len();
        let branching = tree.iter().filter(|near| near.len() > 2).count() as f64;
        let lonely = tree.iter().filter(|near| near.is_empty()).count() as f64;
        let pieces = n - tree.iter().map(Vec::len).sum::<usize>() / 2;
        let enough = n >= 2 * FEWEST.0;
        let follows = (branching + lonely) / n as f64 <= BRANCHING;
        if best.is_some() && !enough {
            break;
        }
        if let Some((_, before)) = best.as_ref().filter(|(b, _)| b.follows)
            && (!follows || pieces as f64 > FEWER * *before as f64)
        {
            break;
        }
        let fragmented = gap.is_none() && pieces as f64 > PIECES.0 * n as f64 + PIECES.1 as f64;
        best = Some((Grown { cells, tree, reach, follows }, pieces));
        if follows && !fragmented {
            break;
        }
        width *= GROWTH.0;
    }
    Ok(best.map(|(grown, _)| grown))
}

/// Points gathered in square cells.
struct Cells {
    width: f64,
    /// Mean of the points of each cell.
    middles: Vec<[f64; 2]>,
    members: Vec<Vec<usize>>,
    at: HashMap<[i64; 2], usize>,
    keys: Vec<[i64; 2]>,
}

/// Cells with the neighbors on the tree.
type Tree = Vec<Vec<usize>>;

fn far(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

impl Cells {
    fn new(points: &[[f64; 2]], width: f64) -> Cells {
        let mut cells = Cells { width, middles: vec![], members: vec![], at: HashMap::new(), keys: vec![] };
        for (i, p) in points.iter().enumerate() {
            let key = p.map(|x| (x / width).floor() as i64);
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

    /// The shortest tree over cells, by Kruskal's method, without edges longer than `reach`.
    fn tree(&self, reach: f64) -> Tree {
        let n = self.middles.len();
        let around = ((reach / self.width).ceil() as i64).clamp(1, 12);
        let mut edges: Vec<(f64, usize, usize)> = vec![];
        for (i, [x, y]) in self.keys.iter().enumerate() {
            // Each pair from one of the two: the other half of the cells around look for this one.
            for dx in 0..=around {
                for dy in if dx == 0 { 1 } else { -around }..=around {
                    let Some(&j) = self.at.get(&[x + dx, y + dy]) else { continue };
                    let d = far(self.middles[i], self.middles[j]);
                    if d <= reach {
                        edges.push((d, i.min(j), i.max(j)));
                    }
                }
            }
        }
        edges.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        let mut root: Vec<usize> = (0..n).collect();
        let mut tree = vec![vec![]; n];
        for (_, i, j) in edges {
            let (a, b) = (find(&mut root, i), find(&mut root, j));
            if a != b {
                root[a.max(b)] = a.min(b);
                tree[i].push(j);
                tree[j].push(i);
            }
        }
        tree
    }

    /// The points of the cells along a way, each cell with what hangs beside it, in order, each with its place along; the length
    /// of the way.
    fn along(&self, points: &[[f64; 2]], way: &Way, closed: bool) -> (Vec<(f64, usize)>, f64) {
        let m = way.len();
        let middle = |k: usize| self.middles[way[k].0];
        let mut all: Vec<(f64, usize)> = vec![];
        let mut station = 0.0;
        for k in 0..m {
            let (before, after) = match closed {
                true => (middle((k + m - 1) % m), middle((k + 1) % m)),
                false => (middle(k.saturating_sub(1)), middle((k + 1).min(m - 1))),
            };
            let length = far(before, after).max(f64::MIN_POSITIVE);
            let along = [(after[0] - before[0]) / length, (after[1] - before[1]) / length];
            let own = std::iter::once(&way[k].0).chain(&way[k].1).flat_map(|c| &self.members[*c]);
            for i in own {
                let (p, q) = (points[*i], middle(k));
                all.push((station + (p[0] - q[0]) * along[0] + (p[1] - q[1]) * along[1], *i));
            }
            station += if k + 1 < m { far(middle(k), middle(k + 1)) } else { 0.0 };
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        (all, station + if closed { far(middle(m - 1), middle(0)) } else { 0.0 })
    }

    fn row(&self, points: &[[f64; 2]], Linked { way, closed }: &Linked) -> Ordered {
        let (all, way) = self.along(points, way, *closed);
        let mut numbers: Vec<usize> = all.into_iter().map(|(_, i)| i).collect();
        untangle(points, &mut numbers, *closed, way);
        Ordered { numbers, closed: *closed, way, layered: None }
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
fn tree_paths(cells: &Cells, tree: &Tree) -> Vec<Way> {
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
            let mut beside = vec![];
            for &next in &tree[cell] {
                if !used[next] {
                    let branch = reachable(tree, &used, next);
                    if branch.len() < FEWEST.0 {
                        branch.iter().for_each(|c| used[*c] = true);
                        beside.extend(branch);
                    }
                }
            }
            rows.push((cell, beside));
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
    while let Some((cell, from, length)) = stack.pop() {
        if length > best.0 {
            best = (length, cell);
        }
        for &next in tree[cell].iter().filter(|c| **c != from && !used[**c]) {
            before.insert(next, cell);
            stack.push((next, cell, length + far(cells.middles[cell], cells.middles[next])));
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
