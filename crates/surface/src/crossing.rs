//! Whether lines in the plane cross each other or themselves.

use trueness_geom::num::predicates::side_of_line;
use trueness_geom::space::{Aabb, Point};

/// Pieces of the lines between two corners, in a tree of boxes over their order.
struct Pieces {
    ends: Vec<[Point; 2]>,
    corners: Vec<[u32; 2]>,
}

/// Whether closed lines, given by numbers of places, cross or touch each other or themselves anywhere but at a common corner. Decided
/// exactly.
///
/// Cost: about `n log n` for lines that go their way; up to `n²` for lines that lie on each other.
pub(super) fn cross(lines: &[Vec<u32>], places: &[[f64; 2]]) -> bool {
    let place = |v: u32| [places[v as usize][0], places[v as usize][1], 0.0];
    let corners: Vec<[u32; 2]> = lines
        .iter()
        .flat_map(|line| line.iter().zip(line.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]))
        .collect();
    let ends = corners.iter().map(|c| c.map(place)).collect();
    let pieces = Pieces { ends, corners };
    let boxes = pieces.boxes();
    let mut open = vec![(Range::all(pieces.ends.len()), Range::all(pieces.ends.len()))];
    while let Some((a, b)) = open.pop() {
        if !overlap(&boxes[a.node], &boxes[b.node]) {
            continue;
        }
        if a.count() == 1 && b.count() == 1 {
            if a.from != b.from && pieces.meet(a.from, b.from) {
                return true;
            }
        } else if a.node == b.node {
            let [low, high] = a.halves();
            open.extend([(low, low), (low, high), (high, high)]);
        } else if a.count() >= b.count() {
            open.extend(a.halves().map(|half| (half, b)));
        } else {
            open.extend(b.halves().map(|half| (a, half)));
        }
    }
    false
}

/// Pieces `from..to`, and the number of their box.
#[derive(Clone, Copy)]
struct Range {
    node: usize,
    from: usize,
    to: usize,
}

impl Range {
    fn all(count: usize) -> Range {
        Range { node: 1, from: 0, to: count }
    }
    fn count(self) -> usize {
        self.to - self.from
    }
    fn halves(self) -> [Range; 2] {
        let middle = self.from + self.count() / 2;
        [
            Range { node: 2 * self.node, from: self.from, to: middle },
            Range { node: 2 * self.node + 1, from: middle, to: self.to },
        ]
    }
}

impl Pieces {
    fn boxes(&self) -> Vec<Aabb> {
        let mut boxes = vec![Aabb::EMPTY; 4 * self.ends.len().next_power_of_two()];
        let mut open = vec![Range::all(self.ends.len())];
        while let Some(range) = open.pop() {
            boxes[range.node] = Aabb::of(self.ends[range.from..range.to].iter().flatten());
            if range.count() > 1 {
                open.extend(range.halves());
            }
        }
        boxes
    }

    fn meet(&self, i: usize, j: usize) -> bool {
        if self.corners[i].iter().any(|v| self.corners[j].contains(v)) {
            return false;
        }
        let ([a, b], [c, d]) = (&self.ends[i], &self.ends[j]);
        let side = |a: &Point, b: &Point, c: &Point| side_of_line(2, a, b, c);
        side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0
    }
}

fn overlap(a: &Aabb, b: &Aabb) -> bool {
    (0..2).all(|k| a.min[k] <= b.max[k] && b.min[k] <= a.max[k])
}
