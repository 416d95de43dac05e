//! Places near something, without looking at all of them: a balanced tree of boxes over points.

use crate::space::{Aabb, Point, norm};
use crate::topology::union::Sets;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::ops::Range;

/// Most points of a leaf.
const MAX_POINTS_PER_NEAR_LEAF: usize = 8;

/// Points with a number each.
pub struct Near {
    points: Vec<(Point, u32)>,
    /// Box of each node; the children of node `i` are `2 i + 1` and `2 i + 2`, each with half of its points.
    boxes: Vec<Aabb>,
}

impl Near {
    /// n log n.
    pub fn new(points: Vec<(Point, u32)>) -> Near {
        let mut near = Near { boxes: vec![], points };
        let count = near.points.len();
        let mut leaves = 1;
        while count.div_ceil(leaves) > MAX_POINTS_PER_NEAR_LEAF {
            leaves *= 2;
        }
        near.boxes = vec![Aabb::EMPTY; 2 * leaves - 1];
        build(&mut near.points, &mut near.boxes, 0);
        near
    }

    /// Hands every point of the leaves that `reaches` says yes for, and for all boxes around them, to `visit`.
    pub fn visit(&self, reaches: impl Fn(&Aabb) -> bool, mut visit: impl FnMut(&Point, u32)) {
        let look = |_: usize, b: &Aabb| if reaches(b) { Look::Into } else { Look::Past };
        self.look(look, |p, number| {
            visit(p, number);
            false
        });
    }
}

/// The decision about the points in a box.
pub enum Look {
    /// None of them counts.
    Past,
    /// Look at them one by one.
    Into,
    /// Any of them will do.
    Any,
}

impl Near {
    /// Hands points to `visit`, with the word that it need not look at all of them: it says when it has had enough.
    pub fn look(&self, look: impl Fn(usize, &Aabb) -> Look, mut visit: impl FnMut(&Point, u32) -> bool) {
        if self.points.is_empty() || matches!(look(0, &self.boxes[0]), Look::Past) {
            return;
        }
        // Each step down leaves one node behind.
        let mut stack = Vec::with_capacity(u32::BITS as usize);
        stack.push((0, 0..self.points.len()));
        while let Some((node, range)) = stack.pop() {
            if range.is_empty() {
                continue;
            }
            match look(node, &self.boxes[node]) {
                Look::Past => {}
                Look::Any => {
                    self.points[range].iter().find(|(p, number)| visit(p, *number));
                }
                Look::Into if 2 * node + 1 >= self.boxes.len() => {
                    self.points[range].iter().for_each(|(p, number)| {
                        visit(p, *number);
                    });
                }
                Look::Into => {
                    let middle = range.start + range.len() / 2;
                    stack.push((2 * node + 2, middle..range.end));
                    stack.push((2 * node + 1, range.start..middle));
                }
            }
        }
    }

    /// The nodes whose points are no farther than `gap` from one another and hang together by `join`, which says whether it
    /// joins two points. A node that is left out may hang together all the same.
    pub(crate) fn clusters(&self, gap: f64, join: &impl Fn(u32, u32) -> bool) -> Vec<bool> {
        let mut clusters = vec![false; self.boxes.len()];
        self.cluster((0, 0..self.points.len()), gap, join, &mut clusters);
        clusters
    }

    fn cluster(
        &self,
        (node, range): (usize, Range<usize>),
        gap: f64,
        join: &impl Fn(u32, u32) -> bool,
        clusters: &mut [bool],
    ) {
        let points = &self.points[range.clone()];
        let small = || !points.is_empty() && self.boxes[node].diagonal() * (1.0 + 1e-12) <= gap;
        if 2 * node + 1 >= self.boxes.len() {
            let sets = Sets::new(points.len());
            let pairs = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
            if small() {
                for (i, j) in pairs.filter(|(i, j)| join(points[*i].1, points[*j].1)) {
                    sets.join(i as u32, j as u32);
                }
                clusters[node] = (0..points.len() as u32).all(|i| sets.root(i) == sets.root(0));
            }
            return;
        }
        let middle = range.start + range.len() / 2;
        self.cluster((2 * node + 1, range.start..middle), gap, join, clusters);
        self.cluster((2 * node + 2, middle..range.end), gap, join, clusters);
        let (low, high) = (&self.points[range.start..middle], &self.points[middle..range.end]);
        clusters[node] = clusters[2 * node + 1]
            && clusters[2 * node + 2]
            && small()
            && low.iter().any(|a| high.iter().any(|b| join(a.1, b.1)));
    }
}

/// Distance from `at` to the farthest place of a box.
pub(crate) fn farthest(at: Point, bounds: &Aabb) -> f64 {
    norm([0, 1, 2].map(|k| (at[k] - bounds.min[k]).abs().max((bounds.max[k] - at[k]).abs())))
}

impl Near {
    /// The numbers of the `most` points nearest to `at`, no farther than `reach` in each coordinate, among those that `counts`.
    /// The nearest come first, among equally near ones the lowest number. Visits little more than it finds.
    pub fn nearest(&self, at: Point, reach: f64, most: usize, counts: impl Fn(u32) -> bool) -> Vec<u32> {
        // The points found, farthest first out; nodes still to be looked at, nearest first.
        let mut found: BinaryHeap<(Far, u32)> = BinaryHeap::new();
        let mut nodes = BinaryHeap::from([(Reverse(Far(0.0)), 0usize, 0, self.points.len())]);
        let is_full = |found: &BinaryHeap<(Far, u32)>, far: Far| {
            found.len() >= most && found.peek().is_none_or(|worst| worst.0 < far)
        };
        while let Some((Reverse(far), node, start, end)) = nodes.pop() {
            let range = start..end;
            if range.is_empty() || is_full(&found, far) {
                continue;
            }
            if 2 * node + 1 < self.boxes.len() {
                let middle = range.start + range.len() / 2;
                for (child, part) in [(2 * node + 1, range.start..middle), (2 * node + 2, middle..range.end)]
                {
                    let b = &self.boxes[child];
                    let outside = |k: usize| (b.min[k] - at[k]).max(at[k] - b.max[k]).max(0.0);
                    if (0..3).all(|k| outside(k) <= reach) {
                        let far = (0..3).map(|k| outside(k) * outside(k)).sum();
                        nodes.push((Reverse(Far(far)), child, part.start, part.end));
                    }
                }
                continue;
            }
            for (p, number) in self.points[range].iter().filter(|(_, number)| counts(*number)) {
                let away: Point = std::array::from_fn(|k| (p[k] - at[k]).abs());
                if away.iter().all(|x| *x <= reach) {
                    found.push((Far(away.iter().map(|x| x * x).sum()), *number));
                }
                if found.len() > most {
                    found.pop();
                }
            }
        }
        found.into_sorted_vec().into_iter().map(|(_, number)| number).collect()
    }
}

/// A squared distance, in order.
#[derive(Clone, Copy, PartialEq)]
struct Far(f64);

impl Eq for Far {}

impl Ord for Far {
    fn cmp(&self, other: &Far) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Far {
    fn partial_cmp(&self, other: &Far) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Sorts the points of node `node` into its subtree.
fn build(points: &mut [(Point, u32)], boxes: &mut [Aabb], node: usize) {
    let all = Aabb::of(points.iter().map(|(p, _)| p));
    boxes[node] = all;
    if 2 * node + 1 >= boxes.len() || points.is_empty() {
        return;
    }
    let sides = all.sides();
    let axis = (0..3).max_by(|&a, &b| sides[a].total_cmp(&sides[b])).unwrap_or(0);
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
    let (low, high) = points.split_at_mut(middle);
    build(low, boxes, 2 * node + 1);
    build(high, boxes, 2 * node + 2);
}

/// Whether the segment from `a` to `b` comes within `gap` of the box, in each coordinate.
pub fn segment_reaches(a: Point, b: Point, gap: f64, bounds: &Aabb) -> bool {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for k in 0..3 {
        let (low, high) = (bounds.min[k] - gap - a[k], bounds.max[k] + gap - a[k]);
        let along = b[k] - a[k];
        if along == 0.0 {
            if low > 0.0 || high < 0.0 {
                return false;
            }
            continue;
        }
        let (x, y) = (low / along, high / along);
        (from, to) = (from.max(x.min(y)), to.min(x.max(y)));
    }
    // The divisions round; a box just missed costs little.
    from <= to + 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    #[test]
    fn finds_what_looking_at_all_finds() {
        let random = &mut Random::new(5);
        for n in [0, 1, 8, 9, 300] {
            let points: Vec<(Point, u32)> =
                (0..n).map(|i| (std::array::from_fn(|_| (random.unit() * 20.0).floor()), i)).collect();
            let near = Near::new(points.clone());
            for _ in 0..50 {
                let [a, b]: [Point; 2] =
                    std::array::from_fn(|_| std::array::from_fn(|_| random.unit() * 20.0));
                let gap = random.unit();
                let point = |p: &Point| segment_reaches(a, b, gap, &Aabb { min: *p, max: *p });
                let mut got = vec![];
                near.visit(|x| segment_reaches(a, b, gap, x), |p, i| got.extend(point(p).then_some(i)));
                got.sort_unstable();
                let want: Vec<u32> = points.iter().filter(|(p, _)| point(p)).map(|(_, i)| *i).collect();
                assert_eq!(got, want);
            }
        }
    }

    /// However many points lie together, each needs to look at one of them only.
    #[test]
    fn of_a_crowd_one_will_do() {
        let random = &mut Random::new(5);
        for n in [10, 1000, 4000] {
            let place = |random: &mut Random| std::array::from_fn(|_| 0.1 * random.unit());
            let points: Vec<(Point, u32)> = (0..n).map(|i| (place(random), i)).collect();
            let near = Near::new(points.clone());
            let joined = std::cell::Cell::new(0);
            let clusters = near.clusters(1.0, &|a, b| {
                joined.set(joined.get() + 1);
                a / 3 != b / 3
            });
            assert!(clusters[0] && joined.get() < 10 * n, "{}", joined.get());
            let mut looked = 0;
            for (p, v) in &points {
                let look = |node: usize, b: &Aabb| match clusters[node] && farthest(*p, b) <= 1.0 {
                    true => Look::Any,
                    false => Look::Into,
                };
                near.look(look, |_, w| {
                    looked += 1;
                    w / 3 != v / 3
                });
            }
            assert!(looked <= 4 * n, "{looked}");
        }
    }

    #[test]
    fn the_nearest_are_those_of_a_sorted_list() {
        let random = &mut Random::new(6);
        for n in [0, 1, 9, 400] {
            let points: Vec<(Point, u32)> =
                (0..n).map(|i| (std::array::from_fn(|_| (random.unit() * 6.0).floor()), i)).collect();
            let near = Near::new(points.clone());
            for most in [1, 5, 40] {
                let at: Point = std::array::from_fn(|_| random.unit() * 6.0);
                let (reach, counts) = (3.0 * random.unit(), |i: u32| !i.is_multiple_of(3));
                let away = |p: &Point| -> Point { std::array::from_fn(|k| (p[k] - at[k]).abs()) };
                let square = |p: &Point| away(p).iter().map(|x| x * x).sum::<f64>();
                let mut want: Vec<(f64, u32)> = (points.iter())
                    .filter(|(p, i)| counts(*i) && away(p).iter().all(|x| *x <= reach))
                    .map(|(p, i)| (square(p), *i))
                    .collect();
                want.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                want.truncate(most);
                let want: Vec<u32> = want.into_iter().map(|w| w.1).collect();
                assert_eq!(near.nearest(at, reach, most, counts), want);
            }
        }
    }
}
