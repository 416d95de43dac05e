//! Boxes around parts of faces and edges, halved again and again.

use trueness_geom::space::{Aabb, Point, minus, norm};

/// A box around a part of a target.
#[derive(Clone, Copy)]
pub(super) struct Item {
    /// The number of the target.
    pub(super) target: u32,
    pub(super) bounds: Aabb,
    /// A place of the boundary within: a point is no farther from the boundary than from there. NaN where none is known.
    pub(super) place: Point,
}

/// A box around items: all of those of its two halves, or a few.
struct Node {
    bounds: Aabb,
    /// First item of a leaf, or the number of the second half; the first half follows its node.
    next: u32,
    /// Items of a leaf; 0 for a box with halves.
    count: u32,
}

/// The boxes.
pub(super) struct Boxes {
    items: Vec<Item>,
    nodes: Vec<Node>,
}

/// Items in a leaf at most.
const LEAF: usize = 4;

impl Boxes {
    /// Around these targets.
    pub(super) fn new(mut items: Vec<Item>) -> Boxes {
        let mut nodes = vec![];
        if !items.is_empty() {
            halve(&mut items, 0, &mut nodes);
        }
        Boxes { items, nodes }
    }

    /// Hands over targets, near ones first, as long as their boxes are not beyond a reach, which the callback hears and says anew each time.
    /// Known places lower it by themselves where `slack` is given, which is added to their distances. Says the last reach: where
    /// nothing was found within it, a known place was none, and what was left out may be the nearest.
    pub(super) fn visit(
        &self,
        p: &Point,
        slack: Option<f64>,
        stack: &mut Vec<(f64, u32)>,
        mut look: impl FnMut(u32, f64) -> f64,
    ) -> f64 {
        let mut reach = f64::INFINITY;
        stack.clear();
        stack.extend(self.nodes.first().map(|root| (root.bounds.distance(p), 0)));
        while let Some((distance, at)) = stack.pop() {
            if distance > reach {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.count > 0 {
                let items = &self.items[node.next as usize..(node.next + node.count) as usize];
                if let Some(slack) = slack {
                    let places = items.iter().map(|item| (norm(minus(item.place, *p)) + slack).next_up());
                    reach = places.fold(reach, f64::min);
                }
                for item in items {
                    if item.bounds.distance(p) <= reach {
                        reach = reach.min(look(item.target, reach));
                    }
                }
                continue;
            }
            let [a, b] = [at + 1, node.next].map(|n| (self.nodes[n as usize].bounds.distance(p), n));
            // The nearer one lies last.
            if a.0 <= b.0 { stack.extend([b, a]) } else { stack.extend([a, b]) }
        }
        reach
    }
}

fn halve(items: &mut [Item], first: usize, nodes: &mut Vec<Node>) {
    let bounds = items.iter().fold(Aabb::EMPTY, |b, item| b.union(&item.bounds));
    let own = nodes.len();
    if items.len() <= LEAF {
        nodes.push(Node { bounds, next: first as u32, count: items.len() as u32 });
        return;
    }
    nodes.push(Node { bounds, next: 0, count: 0 });
    let sides = bounds.sides();
    let axis = (0..3).fold(0, |best, k| if sides[k] > sides[best] { k } else { best });
    let middle = items.len() / 2;
    let center = |b: &Aabb| b.min[axis] + b.max[axis];
    items.select_nth_unstable_by(middle, |a, b| {
        center(&a.bounds).total_cmp(&center(&b.bounds)).then_with(|| a.target.cmp(&b.target))
    });
    let (left, right) = items.split_at_mut(middle);
    halve(left, first, nodes);
    nodes[own].next = nodes.len() as u32;
    halve(right, first + middle, nodes);
}
