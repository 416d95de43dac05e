//! Neighbors among points: nearest, `k` nearest, all in a box.
//!
//! A balanced k-d tree (Bentley 1975) without nodes. The points lie in the order of the tree. The middle one of every range
//! splits it at the coordinate in which the range is longest. Equal distances are decided by the lower number, so answers do
//! not depend on how the tree was built.

use crate::space::{Aabb, Point, minus};

/// Ranges of at most so many points are tried one by one.
const MAX_POINTS_PER_NEIGHBOR_LEAF: usize = 8;

/// A search tree over points.
#[derive(Clone, Debug)]
pub struct PointTree {
    /// In the order of the tree.
    points: Vec<Point>,
    /// Numbers of those points.
    numbers: Vec<u32>,
    /// The coordinate in which the range with this middle is split.
    axes: Vec<u8>,
}

/// Squared distance and number of a point.
pub type Neighbor = (f64, u32);

impl PointTree {
    /// The tree of finite points, numbered from 0. Cost: `n log² n`.
    pub fn new(points: &[Point]) -> PointTree {
        let mut items: Vec<(Point, u32)> = points.iter().copied().zip(0..).collect();
        let mut axes = vec![0; items.len()];
        split(&mut items, &mut axes);
        let (points, numbers) = items.into_iter().unzip();
        PointTree { points, numbers, axes }
    }

    /// The point nearest to `p`; of several the one with the lowest number. `None` in a tree without points.
    pub fn nearest(&self, p: &Point) -> Option<Neighbor> {
        let mut best = (f64::INFINITY, u32::MAX);
        self.approach(p, 0, self.points.len(), &mut |found| {
            if before(&found, &best) {
                best = found;
            }
            best.0
        });
        (best.1 != u32::MAX).then_some(best)
    }

    /// The `k` points nearest to `p` but for number `but`, nearest first; fewer where there are no more.
    pub fn k_nearest(&self, p: &Point, k: usize, but: Option<u32>) -> Vec<Neighbor> {
        let mut best: Vec<Neighbor> = Vec::with_capacity(k + 1);
        self.approach(p, 0, self.points.len(), &mut |found| {
            if Some(found.1) != but {
                best.insert(best.partition_point(|b| before(b, &found)), found);
                best.truncate(k);
            }
            best.get(k.wrapping_sub(1)).map_or(f64::INFINITY, |b| b.0)
        });
        best
    }

    /// Calls `visit` with every point in the closed box and its number, in no particular order, until it says `false`.
    pub fn in_box(&self, window: &Aabb, mut visit: impl FnMut(&Point, u32) -> bool) {
        self.sift(window, 0, self.points.len(), &mut visit);
    }

    /// Offers the points of a range that may be nearer than the limit that `offer` answers.
    fn approach(&self, p: &Point, from: usize, to: usize, offer: &mut impl FnMut(Neighbor) -> f64) -> f64 {
        let mut limit = f64::INFINITY;
        if to - from <= MAX_POINTS_PER_NEIGHBOR_LEAF {
            for i in from..to {
                limit = offer(self.measure(p, i));
            }
            return limit;
        }
        let middle = from + (to - from) / 2;
        let axis = self.axes[middle] as usize;
        let side = p[axis] - self.points[middle][axis];
        let (near, far) =
            if side < 0.0 { ((from, middle), (middle + 1, to)) } else { ((middle + 1, to), (from, middle)) };
        self.approach(p, near.0, near.1, offer);
        limit = offer(self.measure(p, middle));
        // A point as far as the limit may still have a lower number.
        if side * side <= limit {
            limit = self.approach(p, far.0, far.1, offer);
        }
        limit
    }

    fn measure(&self, p: &Point, i: usize) -> Neighbor {
        let [x, y, z] = minus(*p, self.points[i]);
        (x * x + y * y + z * z, self.numbers[i])
    }

    fn sift(
        &self,
        window: &Aabb,
        from: usize,
        to: usize,
        visit: &mut impl FnMut(&Point, u32) -> bool,
    ) -> bool {
        let inside = |q: &Point| (0..3).all(|k| window.min[k] <= q[k] && q[k] <= window.max[k]);
        if to - from <= MAX_POINTS_PER_NEIGHBOR_LEAF {
            return (from..to).all(|i| !inside(&self.points[i]) || visit(&self.points[i], self.numbers[i]));
        }
        let middle = from + (to - from) / 2;
        let (axis, q) = (self.axes[middle] as usize, &self.points[middle]);
        (window.min[axis] > q[axis] || self.sift(window, from, middle, visit))
            && (!inside(q) || visit(q, self.numbers[middle]))
            && (window.max[axis] < q[axis] || self.sift(window, middle + 1, to, visit))
    }
}

fn before(a: &Neighbor, b: &Neighbor) -> bool {
    a.0 < b.0 || (a.0 == b.0 && a.1 < b.1)
}

fn split(items: &mut [(Point, u32)], axes: &mut [u8]) {
    if items.len() <= MAX_POINTS_PER_NEIGHBOR_LEAF {
        return;
    }
    let sides = Aabb::of(items.iter().map(|(p, _)| p)).sides();
    let axis = (0..3).fold(0, |best, k| if sides[k] > sides[best] { k } else { best });
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]));
    axes[middle] = axis as u8;
    let (low, high) = items.split_at_mut(middle);
    let (low_axes, high_axes) = axes.split_at_mut(middle);
    rayon::join(|| split(low, low_axes), || split(&mut high[1..], &mut high_axes[1..]));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// Points on a coarse lattice: many equal distances, many equal points.
    fn lattice(count: usize, seed: u64) -> Vec<Point> {
        let mut random = Random::new(seed);
        (0..count).map(|_| std::array::from_fn(|k| random.below([7, 4, 1][k]) as f64)).collect()
    }
    fn sorted(points: &[Point], p: &Point) -> Vec<Neighbor> {
        let mut all: Vec<Neighbor> = points
            .iter()
            .zip(0..)
            .map(|(q, i)| {
                let [x, y, z] = minus(*p, *q);
                (x * x + y * y + z * z, i)
            })
            .collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        all
    }

    #[test]
    fn equals_trying_all() {
        for count in [0, 1, 8, 9, 60, 700] {
            let points = lattice(count, 5);
            let tree = PointTree::new(&points);
            for p in lattice(40, 6).into_iter().chain([[2.5, 1.5, 0.5], [-9.0, 30.0, 0.0]]) {
                let expected = sorted(&points, &p);
                assert_eq!(tree.nearest(&p), expected.first().copied());
                assert_eq!(tree.k_nearest(&p, 12, None), expected[..12.min(count)]);
                let others: Vec<Neighbor> = expected.into_iter().filter(|n| n.1 != 3).take(5).collect();
                assert_eq!(tree.k_nearest(&p, 5, Some(3)), others);
            }
        }
    }

    #[test]
    fn a_box_is_closed() {
        let points = lattice(500, 8);
        let tree = PointTree::new(&points);
        let window = Aabb { min: [1.0, 0.5, 0.0], max: [3.0, 2.0, 0.0] };
        let mut found = vec![];
        tree.in_box(&window, |_, i| {
            found.push(i);
            true
        });
        found.sort_unstable();
        let inside = |q: &Point| q[0] >= 1.0 && q[0] <= 3.0 && q[1] >= 0.5 && q[1] <= 2.0;
        let expected: Vec<u32> = (0..500).filter(|i| inside(&points[*i as usize])).collect();
        assert_eq!(found, expected);
        let mut first = 0;
        tree.in_box(&window, |_, _| {
            first += 1;
            first < 3
        });
        assert_eq!(first, 3);
    }
}
