//! The facets seen from a place, halved again and again: boxes of directions together with boxes in space.

use crate::space::Aabb;
use std::ops::Range;

/// A facet or an edge as it is seen.
pub struct View {
    /// Which one.
    pub number: u32,
    /// The box of its directions.
    pub seen: Aabb,
    /// Where it lies.
    pub bounds: Aabb,
}

/// Some of the views.
pub struct Node {
    /// Which of the views.
    pub range: Range<usize>,
    /// Their directions.
    pub seen: Aabb,
    /// Where they lie.
    pub bounds: Aabb,
    /// Both halves of them; none where they are few.
    pub halves: Option<Box<[Node; 2]>>,
}

/// Most views of a node that is not halved.
const MAX_VIEWS_PER_LEAF: usize = 8;

impl Node {
    /// The box of all views; puts neighbors near each other.
    pub fn of(views: &mut [View]) -> Node {
        node(views, 0)
    }
}

/// Halves the views, which begin at number `start`, again and again where they spread most.
fn node(views: &mut [View], start: usize) -> Node {
    let seen = views.iter().fold(Aabb::EMPTY, |all, v| all.union(&v.seen));
    let bounds = views.iter().fold(Aabb::EMPTY, |all, v| all.union(&v.bounds));
    let range = start..start + views.len();
    if views.len() <= MAX_VIEWS_PER_LEAF {
        return Node { range, seen, bounds, halves: None };
    }
    let sides = seen.sides();
    let axis = (0..3).fold(0, |k, j| if sides[j] > sides[k] { j } else { k });
    let middle = |v: &View| v.seen.min[axis] + v.seen.max[axis];
    let half = views.len() / 2;
    views.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.number.cmp(&b.number)));
    let (left, right) = views.split_at_mut(half);
    Node { range, seen, bounds, halves: Some(Box::new([node(left, start), node(right, start + half)])) }
}

/// Whether two boxes have a place in common.
pub fn overlap(a: &Aabb, b: &Aabb) -> bool {
    (0..3).all(|k| a.min[k] <= b.max[k] && b.min[k] <= a.max[k])
}
