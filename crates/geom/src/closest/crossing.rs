//! The nearest place where a line through a point meets the mesh.
//!
//! The line goes down the tree of `tree` one node at a time, the nearest boxes first. Boxes are widened by more than what
//! rounding takes from the line, so they only exclude; `line` decides.
#![expect(unsafe_code, reason = "answers written to places of their own")]

use crate::closest::layout::Node;
use crate::closest::limits::{QueryError, sane};
use crate::closest::line::Line;
use crate::closest::order;
use crate::closest::query::Query;
use crate::closest::tree::{TREE_ROUNDING, Tree};
use crate::memory::{Shared, large_pages};
use crate::progress::Progress;
use crate::space::{Point, Vector, plus, times};

/// Where a line through a point meets a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// How far from the point along the line's direction, negative behind it, millimeters.
    pub along: f64,
    /// Where it is.
    pub point: Point,
    /// The face it lies on; where several are met equally near, the lowest.
    pub face: u32,
    /// Weights of the face's corners: `point` is their weighted mean.
    pub barycentric: [f64; 3],
}

/// The nearest crossing found so far.
#[derive(Clone, Copy)]
struct Best {
    along: f64,
    face: u32,
    slot: u32,
    weights: [f64; 3],
}

impl Best {
    fn none(max_distance: f64) -> Best {
        Best { along: max_distance, face: u32::MAX, slot: u32::MAX, weights: [0.0; 3] }
    }
}

/// A line in the coordinates of the tree's boxes.
struct Scaled {
    origin: [f64; 3],
    inverse: [f64; 3],
    /// The amount by which boxes are widened.
    pad: f64,
}

impl Scaled {
    fn of(tree: &Tree, line: &Line) -> Scaled {
        let origin = std::array::from_fn(|k| (line.point[k] - tree.center[k]) * tree.scale);
        let far =
            origin.iter().chain(&tree.center.map(|c| c * tree.scale)).fold(1.0f64, |m, x| m.max(x.abs()));
        Scaled { origin, inverse: line.direction.map(|d| 1.0 / d), pad: TREE_ROUNDING * far }
    }

    /// Least distance along the line from its point to the box of a node's child; infinite where it passes by.
    #[inline(always)]
    fn reach(&self, node: &Node, child: usize) -> f64 {
        let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
        for k in 0..3 {
            let low = f64::from(node.bounds[k][child]) - self.pad - self.origin[k];
            let high = f64::from(node.bounds[k + 3][child]) + self.pad - self.origin[k];
            if low > high {
                return f64::INFINITY;
            }
            if self.inverse[k].is_infinite() {
                if low > 0.0 || high < 0.0 {
                    return f64::INFINITY;
                }
                continue;
            }
            let (s, t) = (low * self.inverse[k], high * self.inverse[k]);
            from = from.max(s.min(t));
            to = to.min(s.max(t));
        }
        let slack = TREE_ROUNDING * (from.abs() + to.abs());
        if from > to + slack {
            return f64::INFINITY;
        }
        (from.max(-to) - slack).max(0.0)
    }
}

/// Where to go on: a child and the least distance to it.
type Open = (f64, i32);

fn nearest(tree: &Tree, line: &Line, max_distance: f64, open: &mut Vec<Open>) -> Option<Best> {
    let scaled = Scaled::of(tree, line);
    let mut best = Best::none(max_distance);
    open.clear();
    open.push((0.0, tree.root));
    while let Some((reach, child)) = open.pop() {
        if reach > best.along.abs() * tree.scale {
            continue;
        }
        if child < 0 {
            for slot in tree.slots_of(!child as usize) {
                try_slot(tree, line, slot, &mut best);
            }
            continue;
        }
        let node = &tree.nodes[child as usize];
        let first = open.len();
        for lane in 0..8 {
            let reach = scaled.reach(node, lane);
            if reach.is_finite() && reach <= best.along.abs() * tree.scale {
                open.push((reach, node.child[lane]));
            }
        }
        open[first..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(b.1.cmp(&a.1)));
    }
    (best.slot != u32::MAX).then_some(best)
}

fn try_slot(tree: &Tree, line: &Line, slot: u32, best: &mut Best) {
    let Some(met) = line.meeting(&tree.triangle(slot)) else { return };
    let face = tree.face[slot as usize];
    let (near, least) = (met.along.abs(), best.along.abs());
    if near < least || (near == least && face < best.face) {
        *best = Best { along: met.along, face, slot, weights: met.weights };
    }
}

impl Tree {
    /// Where the line through `p` along `direction` (any length) meets the mesh nearest to `p`, ahead or behind. It is exactly
    /// the face, of all that it meets, whose crossing is nearest in double precision, ties to the lowest. `None` where it meets
    /// none within `max_distance` (which may be infinite), or without a direction. Whether a face is met is decided without
    /// rounding, and its rim belongs to it. A face that the line lies in is not met, its neighbors are.
    ///
    /// Cost: about as for [`Tree::closest`] of one point; in proportion to the faces that the line grazes.
    ///
    /// # Errors
    /// [`QueryError::BadPoint`] and [`QueryError::BadMaxDistance`].
    ///
    /// ```
    /// use trueness_geom::{closest::Tree, mesh::Mesh};
    /// let positions = vec![[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [0.0, 4.0, 5.0]];
    /// let tree = Tree::build(&Mesh { positions, faces: vec![[0, 1, 2]] })?;
    /// let found = tree.crossing(&[1.0, 1.0, 5.0], [0.0, 0.0, 2.0], f64::INFINITY)?.map(|c| (c.along, c.point));
    /// assert_eq!(found, Some((-3.0, [1.0, 1.0, 2.0])));
    /// assert!(tree.crossing(&[3.0, 3.0, 0.0], [0.0, 0.0, 1.0], f64::INFINITY)?.is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn crossing(
        &self,
        p: &Point,
        direction: Vector,
        max_distance: f64,
    ) -> Result<Option<Crossing>, QueryError> {
        Query { max_distance, ..Query::default() }.check()?;
        if !sane(p) {
            return Err(QueryError::BadPoint(0));
        }
        let line = Line::new(*p, direction);
        Ok(line.and_then(|line| nearest(self, &line, max_distance, &mut vec![])).map(|b| self.at(&b)))
    }

    /// `f(index, crossing)` of the line through every point, in the order of `points`, as [`Tree::crossing`] finds it.
    /// `direction(index)` is the direction of a line, which is not asked for where it is `None`.
    ///
    /// Runs on the current rayon pool and tells `progress` of points. Memory: 8 bytes a point, 64 MiB at most.
    ///
    /// # Errors
    /// The errors of [`Tree::for_each_closest`].
    pub fn map_crossings<T: Copy + Send>(
        &self,
        points: &[Point],
        direction: impl Fn(usize) -> Option<Vector> + Sync,
        max_distance: f64,
        progress: &dyn Progress,
        f: impl Fn(usize, Option<Crossing>) -> T + Sync,
    ) -> Result<Vec<T>, QueryError> {
        Query { max_distance, ..Query::default() }.check()?;
        let mut out = large_pages(Vec::with_capacity(points.len()));
        let places = Shared::of(&mut out);
        order::for_each_bucket(points, progress, |open: &mut Vec<Open>, slice, base, items| {
            for &item in items {
                let i = base + item as u32 as usize;
                let line = direction(i).and_then(|d| Line::new(slice[item as u32 as usize], d));
                let found = line.and_then(|line| nearest(self, &line, max_distance, open));
                let x = f(i, found.map(|b| self.at(&b)));
                // SAFETY: there is room for all, and each index comes exactly once.
                unsafe { *places.at(i) = x }
            }
        })?;
        // SAFETY: no error: every index has come.
        unsafe { out.set_len(points.len()) };
        Ok(out)
    }

    fn at(&self, best: &Best) -> Crossing {
        let [a, b, c] = self.triangle(best.slot);
        let [u, v, w] = best.weights;
        let point = plus(plus(times(u, a), times(v, b)), times(w, c));
        Crossing { along: best.along, point, face: best.face, barycentric: best.weights }
    }
}
