//! Facets ordered for rays along an axis: a balanced tree of boxes over the places that they cover as seen along it.
//!
//! Long thin facets, those of a fan say, fill next to nothing of their boxes. So each facet, and each leaf of the tree, has a
//! strip too. It runs along the longest side of the facet (of the first one in the leaf).

use crate::mesh::Mesh;
use crate::num::rounding::PRODUCT_SUM_ROUNDING;
use crate::space::{Aabb, Point};

/// Most facets of a leaf.
const MAX_FACETS_PER_COLUMN_LEAF: usize = 8;
/// Parts with more facets are sorted by several threads.
const MAX_FACETS_SORTED_ALONE: usize = 1 << 14;

/// Facets of a mesh, ready for rays along an axis.
pub(crate) struct Columns {
    axis: usize,
    facets: Vec<u32>,
    /// The box of each facet.
    own: Vec<Aabb>,
    /// The box of each node, in the order of a walk that takes a node before its children. Each child has half of the facets.
    boxes: Vec<Aabb>,
    /// The strip of each facet, and of each node; all places for a node that is no leaf.
    strips: [Vec<Strip>; 2],
}

impl Columns {
    /// The columns of these facets, which must have finite corners. n log n.
    pub(crate) fn new(mesh: &Mesh, facets: &[u32], axis: usize) -> Columns {
        let bounds = |f: u32| Aabb::of(&mesh.corners(f));
        let item = |f: &u32| {
            let bounds = bounds(*f);
            let middle = |k: usize| 0.5 * bounds.min[k] + 0.5 * bounds.max[k];
            Item { middle: [middle((axis + 1) % 3), middle((axis + 2) % 3)], facet: *f }
        };
        let mut items: Vec<Item> = facets.iter().map(item).collect();
        let mut leaves = 1;
        while items.len().div_ceil(leaves) > MAX_FACETS_PER_COLUMN_LEAF {
            leaves *= 2;
        }
        let mut boxes = vec![Aabb::EMPTY; 2 * leaves - 1];
        let mut strips = vec![Strip::EVERYWHERE; boxes.len()];
        build((mesh, axis), &mut items, (&mut boxes, &mut strips));
        let own = items.iter().map(|i| bounds(i.facet)).collect();
        let facets: Vec<u32> = items.into_iter().map(|i| i.facet).collect();
        let strips = [facets.iter().map(|f| Strip::of(axis, &mesh.corners(*f))).collect(), strips];
        Columns { axis, facets, own, boxes, strips }
    }

    /// The box of all facets.
    pub(crate) fn bounds(&self) -> &Aabb {
        &self.boxes[0]
    }

    /// Hands to `visit` every facet that the line through `p` along the axis passes, with its box. It goes as far as the box
    /// and all that hold it `reach`. Others whose box the line meets come too, but most of the long thin ones that it misses do
    /// not.
    pub(crate) fn pass(&self, p: &Point, reach: impl Fn(&Aabb) -> bool, mut visit: impl FnMut(u32, &Aabb)) {
        let sides = [(self.axis + 1) % 3, (self.axis + 2) % 3];
        let meets = |b: &Aabb| reach(b) && sides.iter().all(|&k| b.min[k] <= p[k] && p[k] <= b.max[k]);
        let (seen, [of_facets, of_nodes]) = (sides.map(|k| p[k]), &self.strips);
        // Each step down leaves one node behind.
        let mut stack = Vec::with_capacity(u32::BITS as usize);
        stack.push((0, self.boxes.len(), 0..self.facets.len()));
        while let Some((node, nodes, range)) = stack.pop() {
            if range.is_empty() || !meets(&self.boxes[node]) || !of_nodes[node].holds(seen) {
                continue;
            }
            if nodes == 1 {
                let is_met = |i: &usize| meets(&self.own[*i]) && of_facets[*i].holds(seen);
                range.filter(is_met).for_each(|i| visit(self.facets[i], &self.own[i]));
                continue;
            }
            let (middle, half) = (range.start + range.len() / 2, nodes / 2);
            stack.push((node + 1 + half, half, middle..range.end));
            stack.push((node + 1, half, range.start..middle));
        }
    }
}

/// A facet and the middle of its box, as seen along the axis.
struct Item {
    middle: [f64; 2],
    facet: u32,
}

/// A strip of the plane that is seen along the axis.
#[derive(Clone, Copy)]
struct Strip {
    /// A unit vector across it, or zero.
    across: [f64; 2],
    low: f64,
    high: f64,
}

impl Strip {
    const EVERYWHERE: Strip = Strip { across: [0.0; 2], low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// Along the longest side of the triangle that the first three corners form, as wide as all need.
    fn of(axis: usize, corners: &[Point]) -> Strip {
        let seen = |p: &Point| [p[(axis + 1) % 3], p[(axis + 2) % 3]];
        let [a, b, c, ..] = corners else { return Strip::EVERYWHERE };
        let way = |p: &Point, q: &Point| {
            let (p, q) = (seen(p), seen(q));
            [q[0] - p[0], q[1] - p[1]]
        };
        let size = |v: &[f64; 2]| v[0].abs() + v[1].abs();
        let sides = [way(a, b), way(b, c), way(c, a)];
        let longest = sides.into_iter().fold([0.0; 2], |l, v| if size(&v) > size(&l) { v } else { l });
        let across = [-longest[1], longest[0]].map(|x| x / size(&longest));
        if !across.iter().all(|x| x.is_finite()) {
            return Strip::EVERYWHERE;
        }
        let (mut low, mut high, mut most) = (f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE);
        for p in corners.iter().map(seen) {
            let at = across[0] * p[0] + across[1] * p[1];
            (low, high, most) = (low.min(at), high.max(at), most.max(size(&p)));
        }
        // Places beyond the box are none of its concern, so no coordinate asked about is larger.
        Strip {
            across,
            low: low - 2.0 * PRODUCT_SUM_ROUNDING * most,
            high: high + 2.0 * PRODUCT_SUM_ROUNDING * most,
        }
    }

    fn holds(&self, p: [f64; 2]) -> bool {
        let at = self.across[0] * p[0] + self.across[1] * p[1];
        // True for what is no number.
        !(at < self.low || at > self.high)
    }
}

/// Orders the facets of a node and its children, and finds their boxes and strips.
fn build((mesh, axis): (&Mesh, usize), items: &mut [Item], (boxes, strips): (&mut [Aabb], &mut [Strip])) {
    let (Some((own, children)), Some((strip, inner))) = (boxes.split_first_mut(), strips.split_first_mut())
    else {
        return;
    };
    if children.is_empty() {
        let corners: Vec<Point> = items.iter().flat_map(|i| mesh.corners(i.facet)).collect();
        (*own, *strip) = (Aabb::of(&corners), Strip::of(axis, &corners));
        return;
    }
    let range = |k: usize| {
        let wider = |(l, h): (f64, f64), i: &Item| (l.min(i.middle[k]), h.max(i.middle[k]));
        let (low, high) = items.iter().fold((f64::INFINITY, f64::NEG_INFINITY), wider);
        high - low
    };
    let k = usize::from(range(1) > range(0));
    let middle = items.len() / 2;
    if !items.is_empty() {
        let order = |a: &Item, b: &Item| a.middle[k].total_cmp(&b.middle[k]).then(a.facet.cmp(&b.facet));
        items.select_nth_unstable_by(middle, order);
    }
    let (low, high) = items.split_at_mut(middle);
    let (first, second) = children.split_at_mut(children.len() / 2);
    let (of_first, of_second) = inner.split_at_mut(inner.len() / 2);
    let mut one = || build((mesh, axis), low, (&mut *first, of_first));
    let mut other = || build((mesh, axis), high, (&mut *second, of_second));
    if middle > MAX_FACETS_SORTED_ALONE {
        rayon::join(one, other);
    } else {
        one();
        other();
    }
    *own = first[0].union(&second[0]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::predicates::side_of_line;
    use crate::num::random::Random;

    /// Every facet that the ray passes is there, once, and none whose box it misses, by brute force.
    #[test]
    fn rays_meet_what_lies_in_their_column() {
        let random = &mut Random::new(5);
        let mut mesh = Mesh::default();
        for i in 0..3000u32 {
            let size = if i % 100 == 0 { 4.0 } else { 0.2 };
            let at: Point = std::array::from_fn(|_| 10.0 * random.unit());
            let mut corner = || -> Point { std::array::from_fn(|k| at[k] + size * random.unit()) };
            mesh.positions.extend([at, corner(), corner()]);
            mesh.faces.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        for (axis, count) in [(0, 3000), (1, 3000), (2, 3000), (0, 0), (1, 1), (2, 9)] {
            let facets: Vec<u32> = (0..3000).rev().take(count).collect();
            let columns = Columns::new(&mesh, &facets, axis);
            for i in 0..500 {
                // Half of them through corners.
                let p = match i % 2 {
                    0 => mesh.positions[random.below(9000) as usize],
                    _ => std::array::from_fn(|_| 11.0 * random.unit()),
                };
                let meets = |f: &&u32| {
                    let b = Aabb::of(&mesh.corners(**f));
                    let is_outside = |k: usize| p[k] < b.min[k] || b.max[k] < p[k];
                    p[axis] <= b.max[axis] && !is_outside((axis + 1) % 3) && !is_outside((axis + 2) % 3)
                };
                let mut all: Vec<u32> = facets.iter().filter(meets).copied().collect();
                all.sort_unstable();
                let mut found = vec![];
                columns.pass(&p, |b| p[axis] <= b.max[axis], |f, _| found.push(f));
                found.sort_unstable();
                assert!(found.iter().all(|f| all.binary_search(f).is_ok()), "{p:?}");
                all.retain(|f| is_seen(&mesh.corners(*f), &p, axis));
                assert!(all.iter().all(|f| found.binary_search(f).is_ok()), "{p:?}");
            }
        }
    }

    /// Whether a place is seen in a triangle or on its rim, decided exactly.
    fn is_seen([a, b, c]: &[Point; 3], p: &Point, axis: usize) -> bool {
        let sides = [[a, b], [b, c], [c, a]].map(|[u, v]| side_of_line(axis, u, v, p));
        !(sides.contains(&1) && sides.contains(&-1))
    }

    /// A fan is turned so that the boxes of its thin facets overlap with a quarter of the others. A ray is handed some few of
    /// them, however many there are.
    #[test]
    fn of_a_fan_few_facets_are_handed_out() {
        for n in [500u32, 4000, 32_000] {
            let (random, mut mesh) = (&mut Random::new(9), Mesh::default());
            mesh.positions.push([0.3, 0.1, 0.2]);
            for i in 0..n {
                let turn = std::f64::consts::TAU * f64::from(i) / f64::from(n);
                mesh.positions.push([0.3 + libm::cos(turn), 0.1 + libm::sin(turn), 0.2 + libm::cos(turn)]);
                mesh.faces.push([0, 1 + i, 1 + (i + 1) % n]);
            }
            let facets: Vec<u32> = (0..n).collect();
            let columns = Columns::new(&mesh, &facets, 2);
            let mut handed = 0;
            for _ in 0..500 {
                let turn = std::f64::consts::TAU * random.unit();
                let far = 0.2 + 0.8 * random.unit();
                let p = [0.3 + far * libm::cos(turn), 0.1 + far * libm::sin(turn), -9.0];
                let mut seen = 0;
                columns.pass(
                    &p,
                    |_| true,
                    |f, _| {
                        handed += 1;
                        seen += usize::from(is_seen(&mesh.corners(f), &p, 2));
                    },
                );
                assert!(seen > 0 || far > 0.999);
            }
            assert!(handed < 500 * 8, "{n}: {handed}");
        }
    }
}
