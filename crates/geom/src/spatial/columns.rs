//! Facets ordered for rays along an axis: a balanced tree of boxes over the places that they cover as seen along it.

use crate::mesh::Mesh;
use crate::space::{Aabb, Point};

/// Facets of a leaf, at most.
const LEAF: usize = 8;
/// Parts of more facets than this are ordered side by side.
const ALONE: usize = 1 << 14;

/// Facets of a mesh, ready for rays along an axis.
pub(crate) struct Columns {
    axis: usize,
    facets: Vec<u32>,
    /// Of each facet.
    own: Vec<Aabb>,
    /// Of each node, in the order of a walk that takes a node before its children. Each child has half of the facets.
    boxes: Vec<Aabb>,
}

impl Columns {
    /// Of these facets, which must have finite corners. n log n.
    pub(crate) fn new(mesh: &Mesh, facets: &[u32], axis: usize) -> Columns {
        let bounds = |f: u32| Aabb::of(&mesh.faces[f as usize].map(|v| mesh.positions[v as usize]));
        let item = |f: &u32| {
            let bounds = bounds(*f);
            let middle = |k: usize| 0.5 * bounds.min[k] + 0.5 * bounds.max[k];
            Item { middle: [middle((axis + 1) % 3), middle((axis + 2) % 3)], facet: *f }
        };
        let mut items: Vec<Item> = facets.iter().map(item).collect();
        let mut leaves = 1;
        while items.len().div_ceil(leaves) > LEAF {
            leaves *= 2;
        }
        let mut boxes = vec![Aabb::EMPTY; 2 * leaves - 1];
        build(mesh, &mut items, &mut boxes);
        let own = items.iter().map(|i| bounds(i.facet)).collect();
        Columns { axis, facets: items.into_iter().map(|i| i.facet).collect(), own, boxes }
    }

    /// The box of all facets.
    pub(crate) fn bounds(&self) -> &Aabb {
        &self.boxes[0]
    }

    /// Hands to `take` every facet whose box the line through `p` along the axis meets, with that box, as far as the box and all
    /// that hold it `reach`.
    pub(crate) fn visit(&self, p: &Point, reach: impl Fn(&Aabb) -> bool, mut take: impl FnMut(u32, &Aabb)) {
        let sides = [(self.axis + 1) % 3, (self.axis + 2) % 3];
        let meets = |b: &Aabb| reach(b) && sides.iter().all(|&k| b.min[k] <= p[k] && p[k] <= b.max[k]);
        // Each step down leaves one node behind.
        let mut stack = Vec::with_capacity(u32::BITS as usize);
        stack.push((0, self.boxes.len(), 0..self.facets.len()));
        while let Some((node, nodes, range)) = stack.pop() {
            if range.is_empty() || !meets(&self.boxes[node]) {
                continue;
            }
            if nodes == 1 {
                let facets = self.facets[range.clone()].iter().zip(&self.own[range]);
                facets.filter(|(_, own)| meets(own)).for_each(|(f, own)| take(*f, own));
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

/// Orders the facets of a node and its children, and finds their boxes.
fn build(mesh: &Mesh, items: &mut [Item], boxes: &mut [Aabb]) {
    let Some((own, children)) = boxes.split_first_mut() else { return };
    if children.is_empty() {
        let corners = items.iter().flat_map(|i| mesh.faces[i.facet as usize]);
        *own = Aabb::of(&corners.map(|v| mesh.positions[v as usize]).collect::<Vec<Point>>());
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
    if low.len() > ALONE {
        rayon::join(|| build(mesh, low, first), || build(mesh, high, second));
    } else {
        build(mesh, low, first);
        build(mesh, high, second);
    }
    *own = first[0].union(&second[0]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// Every facet whose box the ray meets is there, once, and no other, by brute force.
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
                let mut found = vec![];
                columns.visit(&p, |b| p[axis] <= b.max[axis], |f, _| found.push(f));
                found.sort_unstable();
                let meets = |f: &&u32| {
                    let b = Aabb::of(&mesh.faces[**f as usize].map(|v| mesh.positions[v as usize]));
                    let beside = |k: usize| p[k] < b.min[k] || b.max[k] < p[k];
                    p[axis] <= b.max[axis] && !beside((axis + 1) % 3) && !beside((axis + 2) % 3)
                };
                let mut all: Vec<u32> = facets.iter().filter(meets).copied().collect();
                all.sort_unstable();
                assert_eq!(found, all, "{p:?}");
            }
        }
    }
}
