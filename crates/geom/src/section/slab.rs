//! Points of a cloud near a plane, projected and put in the order in which they follow each other along contours.
//!
//! Points scatter across a contour by more than they lie apart along it, so the nearest neighbor is not the next. The points
//! are gathered in square cells, made larger until the shortest tree over their middles hardly branches: then it follows the
//! contour. The longest way through the tree is the contour's course; what hangs beside it is put in where it hangs. Ways are
//! linked over gaps that uneven points have by chance. (After Lee, Curve reconstruction from unorganized points, Computer Aided
//! Geometric Design 17, 2000; cells in place of moving least squares.)

use super::contour::{contour, rms};
use super::cut::{Plane, PlaneFrame};
use super::link::{Limits, Linked, Way, gap_to_close, link, longest_by_chance};
use super::nominal::Outline;
use super::result::{Contour, Options, SectionError};
use super::untangle::untangle;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, dot, norm};
use std::collections::{HashMap, HashSet};

/// Numbers of the points in a slab around a plane, and their places in it. Points that hold no number are left out, and so are
/// those that fall upon an earlier one: copies would let the points look nearer to each other than they are.
///
/// `thickness` is that of the slab, half on either side.
pub fn slab(
    points: &[Point],
    plane: &Plane,
    frame: &PlaneFrame,
    thickness: f64,
) -> (Vec<usize>, Vec<[f64; 2]>) {
    let reach = 0.5 * thickness * norm(plane.normal);
    let inside = |p: &Point| (dot(plane.normal, *p) - plane.offset).abs() <= reach;
    let mut seen = HashSet::new();
    let mut first = |p: &[f64; 2]| seen.insert(p.map(|x| (x + 0.0).to_bits()));
    let near = points.iter().enumerate().filter(|(_, p)| inside(p)).map(|(i, p)| (i, frame.flat(*p)));
    near.filter(|(_, p)| first(p)).unzip()
}

/// Points that follow each other along one contour.
#[derive(Clone, Debug, PartialEq)]
pub struct Ordered {
    /// Their numbers, in order.
    pub numbers: Vec<usize>,
    /// Whether the last is near the first.
    pub closed: bool,
    /// Length of the way along which they were put in order, mm.
    pub way: f64,
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

/// A contour that is so many times as long as the way along its points goes to and fro between them.
const LONGEST: f64 = 2.0;

/// The contour of points in order that were found among `points` in the plane.
///
/// Points that cover an area, as of a slab that is thick for how obliquely it cuts, follow no curve: where the segments are
/// more than twice as long as the way along which the points were put in order, or where points scatter from one side of the
/// contour to the other, all of them are [`Contour::astray`].
///
/// # Errors
/// As [`contour`].
pub fn ordered_contour(
    points: &[[f64; 2]],
    row: &Ordered,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    let own: Vec<[f64; 2]> = row.numbers.iter().map(|i| points[*i]).collect();
    let closed = options.closed.unwrap_or(row.closed);
    let options = Options { closed: Some(closed), ordered: true, ..*options };
    let mut found = contour(&own, &options, progress)?;
    if found.length() > LONGEST * row.way || scatters_across(&found) {
        found.astray = (0..found.segments.len()).collect();
    }
    Ok(found)
}

/// Whether the band of two standard deviations on either side of a contour is wider than what a closed one encloses is in the mean, or
/// than half of an open one is long: then nothing tells which points are of which side.
fn scatters_across(found: &Contour) -> bool {
    let (band, length) = (4.0 * rms(found), found.length());
    if found.closed { band * length > 2.0 * Outline::of(found).area().abs() } else { 2.0 * band > length }
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
    let Grown { cells, tree, reach, follows } = grown;
    let ways = tree_paths(&cells, &tree);
    let gap = match (gap, follows) {
        (Some(gap), _) => gap.max(1.5 * cells.width),
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
    let mut rows: Vec<Ordered> = linked.iter().map(|way| cells.row(points, way)).collect();
    rows.retain(|r| r.numbers.len() >= FEWEST.1);
    rows.sort_by_key(|r| std::cmp::Reverse(r.numbers.len()));
    let wider = wider(points, &rows, gap);
    Ok(Order { rows, gap, wider })
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
        let reach = gap.map_or(REACH * width, |g| g.min(REACH * width).max(1.5 * width));
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
        Ordered { numbers, closed: *closed, way }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;
    use crate::progress::Silent;

    /// Every point of a shuffled ring and a shuffled wave comes in order, though the scatter is three spacings.
    #[test]
    fn shuffled_contours_come_in_order() {
        let random = &mut Random::new(7);
        let mut points: Vec<([f64; 2], f64)> = vec![];
        for i in 0..1500 {
            let a = f64::from(i) * std::f64::consts::TAU / 1500.0;
            let (sin, cos) = libm::sincos(a);
            let r = 20.0 + 0.5 * (random.unit() - 0.5);
            points.push(([r * cos, r * sin], a));
        }
        for i in 0..600 {
            let x = f64::from(i) * 0.1;
            points.push(([x - 30.0, 40.0 + 3.0 * libm::sin(0.2 * x) + 0.1 * random.unit()], 100.0 + x));
        }
        (1..points.len()).rev().for_each(|i| points.swap(i, random.below(i as u64 + 1) as usize));
        let flat: Vec<[f64; 2]> = points.iter().map(|p| p.0).collect();
        let rows = order(&flat, None, &Silent).unwrap().rows;
        assert_eq!(
            rows.iter().map(|r| (r.numbers.len(), r.closed)).collect::<Vec<_>>(),
            [(1500, true), (600, false)]
        );
        for row in &rows {
            let along: Vec<f64> = row.numbers.iter().map(|i| points[*i].1).collect();
            let period = if row.closed { std::f64::consts::TAU } else { f64::INFINITY };
            let forward = along.windows(2).filter(|w| w[1] > w[0]).count() * 2 > along.len();
            // Back by no more than what the scatter hides: half a millimeter.
            let most = if row.closed { 0.5 / 20.0 } else { 0.5 };
            for w in along.windows(2) {
                let step = if forward { w[1] - w[0] } else { w[0] - w[1] };
                let step = if period.is_finite() { step - period * (step / period).round() } else { step };
                assert!(step > -most && step < 3.0 * most, "{step}");
            }
        }
    }

    /// A grid of points that covers an area is no contour, a thin band is.
    #[test]
    fn an_area_is_no_contour() {
        let astray = |rows: u32, step: f64| {
            let random = &mut Random::new(3);
            let points: Vec<[f64; 2]> = (0..300)
                .flat_map(|i| (0..rows).map(move |j| [f64::from(i) * 0.1, f64::from(j) * step]))
                .map(|[x, y]| [x, y + 0.01 * random.unit()])
                .collect();
            let found = order(&points, None, &Silent).unwrap().rows;
            let contour = ordered_contour(&points, &found[0], &Options::default(), &Silent).unwrap();
            contour.astray.len() == contour.segments.len()
        };
        assert!(astray(30, 0.1));
        assert!(!astray(3, 0.02));
    }

    /// A ring whose points scatter by more than a quarter of its radius is a disk, and a row that does so by more than an eighth of its
    /// length is one of no direction.
    #[test]
    fn scatter_from_side_to_side_is_no_contour() {
        let contour = |sigma: f64, closed: bool| {
            let (random, count) = (&mut Random::new(7), if closed { 400 } else { 40 });
            let points: Vec<[f64; 2]> = (0..count)
                .map(|i| {
                    let off = sigma * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0);
                    let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(count));
                    if closed { [(10.0 + off) * c, (10.0 + off) * s] } else { [f64::from(i), off] }
                })
                .collect();
            let row = Ordered { numbers: (0..points.len()).collect(), closed, way: f64::INFINITY };
            let options = Options { noise: Some(sigma), ..Options::default() };
            let found = ordered_contour(&points, &row, &options, &Silent).unwrap();
            (found.astray.len() == found.segments.len(), rms(&found), found.length())
        };
        for (sigma, closed, want) in
            [(1.0, true, false), (3.5, true, true), (1.0, false, false), (8.0, false, true)]
        {
            let (across, rms, length) = contour(sigma, closed);
            assert_eq!(across, want, "{sigma} {closed}: {rms} {length}");
        }
    }

    #[test]
    fn nothing_comes_of_nothing() {
        assert!(order(&[], None, &Silent).unwrap().rows.is_empty());
        assert!(order(&[[1.0, 2.0]; 50], None, &Silent).unwrap().rows.is_empty());
        // A gap divides, or not, as told.
        let line: Vec<[f64; 2]> =
            (0..200).map(|i| [f64::from(i) + if i < 100 { 0.0 } else { 20.0 }, 0.0]).collect();
        assert_eq!(order(&line, Some(3.0), &Silent).unwrap().rows.len(), 2);
        assert_eq!(order(&line, Some(30.0), &Silent).unwrap().rows.len(), 1);
    }
}
