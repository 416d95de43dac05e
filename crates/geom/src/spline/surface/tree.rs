//! Boxes around the cells of grids, halved again and again.

use super::cells::Grid;
use crate::space::{Aabb, Point};

/// A cell of one of several grids.
#[derive(Clone, Copy)]
pub(super) struct CellId {
    pub grid: u32,
    pub row: u32,
    pub column: u32,
}

/// A box around cells: all of those of its two halves, or a few.
struct Node {
    bounds: Aabb,
    /// First cell of a leaf, or the number of the second half; the first half follows its node.
    next: u32,
    /// Cells of a leaf; 0 for a box with halves.
    count: u32,
}

/// The boxes.
pub(super) struct Boxes {
    cells: Vec<CellId>,
    nodes: Vec<Node>,
}

/// Most cells of a leaf.
const MAX_CELLS_PER_LEAF: usize = 4;

impl Boxes {
    /// Around all cells of the grids, each with room for its slack or for rounding.
    pub(super) fn new(grids: &[Grid], rounding: f64) -> Boxes {
        let mut all = vec![];
        for (g, grid) in grids.iter().enumerate() {
            let [rows, columns] = grid.counts();
            for i in 0..rows {
                for j in 0..columns {
                    let bounds = grid.bounds_of([i, j], rounding);
                    all.push((CellId { grid: g as u32, row: i as u32, column: j as u32 }, bounds));
                }
            }
        }
        let mut nodes = vec![];
        halve(&mut all, 0, &mut nodes);
        Boxes { cells: all.into_iter().map(|c| c.0).collect(), nodes }
    }

    /// Hands over cells, near ones first, as long as their boxes are not beyond `reach`, which the callback says anew each time.
    pub(super) fn visit(&self, p: &Point, mut reach: f64, mut cell: impl FnMut(CellId) -> f64) {
        let mut stack = vec![(0.0, 0u32)];
        while let Some((distance, at)) = stack.pop() {
            if distance > reach {
                continue;
            }
            let node = &self.nodes[at as usize];
            if node.count > 0 {
                for c in &self.cells[node.next as usize..(node.next + node.count) as usize] {
                    reach = cell(*c);
                }
                continue;
            }
            let halves = [at + 1, node.next].map(|n| (self.nodes[n as usize].bounds.distance(p), n));
            // The nearer one lies last.
            let [a, b] = halves;
            if a.0 <= b.0 { stack.extend([b, a]) } else { stack.extend([a, b]) }
        }
    }
}

fn halve(cells: &mut [(CellId, Aabb)], first: usize, nodes: &mut Vec<Node>) {
    let bounds = cells.iter().fold(Aabb::EMPTY, |b, c| b.union(&c.1));
    let own = nodes.len();
    if cells.len() <= MAX_CELLS_PER_LEAF {
        nodes.push(Node { bounds, next: first as u32, count: cells.len() as u32 });
        return;
    }
    nodes.push(Node { bounds, next: 0, count: 0 });
    let sides = bounds.sides();
    let axis = (0..3).fold(0, |best, k| if sides[k] > sides[best] { k } else { best });
    let middle = cells.len() / 2;
    let center = |b: &Aabb| b.min[axis] + b.max[axis];
    let order = |c: &CellId| (c.grid, c.row, c.column);
    cells.select_nth_unstable_by(middle, |a, b| {
        center(&a.1).total_cmp(&center(&b.1)).then_with(|| order(&a.0).cmp(&order(&b.0)))
    });
    let (left, right) = cells.split_at_mut(middle);
    halve(left, first, nodes);
    nodes[own].next = nodes.len() as u32;
    halve(right, first + middle, nodes);
}
