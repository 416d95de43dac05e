//! Working memory of a fit, kept from one fit to the next: the unknowns of a chain, and sums over the points of its
//! pieces.

use super::super::chain::Layout;

/// Weight of a squared distance that must vanish while models are compared. A chain that does not close yet is bent to where it
/// does, step by step.
pub(super) const TRIAL_CONDITION_WEIGHT: f64 = 1e3;

/// A join held where its place along a direction has a given value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Held {
    /// Number of the piece that starts there; of an open chain from 1.
    pub join: usize,
    pub along: [f64; 2],
    pub value: f64,
}

/// An unknown of the chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Variable {
    /// Shift of the start to the left, or forward.
    Left,
    Forward,
    /// Turn of the start.
    Turn,
    /// A join moves forward: the piece before becomes longer, the one after, if any, shorter.
    Join {
        before: usize,
        after: Option<usize>,
    },
    Coefficient {
        piece: usize,
        index: usize,
    },
}

impl Variable {
    /// The last piece within which it acts: all beyond it moves as a rigid body. `None` where all does.
    pub(super) fn last(self) -> Option<usize> {
        match self {
            Variable::Left | Variable::Forward | Variable::Turn => None,
            Variable::Join { before, after } => Some(after.unwrap_or(before)),
            Variable::Coefficient { piece, .. } => Some(piece),
        }
    }
}

/// Sums of products over the points of a piece: the lower triangle, and with the distances.
#[derive(Clone, Debug, Default)]
pub(crate) struct PieceSums {
    pub(super) size: usize,
    pub(super) products: Vec<f64>,
    pub(super) right: Vec<f64>,
}

impl PieceSums {
    pub(super) fn reset(&mut self, size: usize) {
        self.size = size;
        self.products.clear();
        self.products.resize(size * size, 0.0);
        self.right.clear();
        self.right.resize(size, 0.0);
    }
    #[inline]
    pub(super) fn add(&mut self, row: &[f64], weight: f64, distance: f64) {
        // Lines and arcs have few unknowns, and their numbers are known beforehand: no loops are left.
        match *row {
            [a, b, c] => self.add_few([a, b, c], weight, distance),
            [a, b, c, d] => self.add_few([a, b, c, d], weight, distance),
            _ => self.add_many(row, weight, distance),
        }
    }

    #[inline]
    fn add_few<const N: usize>(&mut self, row: [f64; N], weight: f64, distance: f64) {
        let (products, right) = (&mut self.products[..N * N], &mut self.right[..N]);
        for i in 0..N {
            let x = weight * row[i];
            right[i] += x * distance;
            for j in 0..=i {
                products[i * N + j] += x * row[j];
            }
        }
    }

    #[inline]
    fn add_many(&mut self, row: &[f64], weight: f64, distance: f64) {
        let n = row.len();
        for i in 0..n {
            let x = weight * row[i];
            self.right[i] += x * distance;
            for (p, y) in self.products[i * n..=i * n + i].iter_mut().zip(row) {
                *p += x * y;
            }
        }
    }
}

/// Memory of a fit, kept from one to the next.
#[derive(Debug, Default)]
pub(crate) struct Work {
    pub layout: Layout,
    pub(super) blocks: Vec<PieceSums>,
    pub(super) motions: Vec<Vec<[f64; 3]>>,
    pub(super) variables: Vec<Variable>,
    pub(super) matrix: Vec<f64>,
    pub(super) right: Vec<f64>,
    /// The diagonal of the points' part: steps are damped by it. Quantities that must vanish weigh far more, and would
    /// hold back all that moves them.
    pub(super) scale: Vec<f64>,
    /// Signed distances of the points last measured.
    pub(super) distances: Vec<f64>,
    /// Whether the conditions hold in every step.
    pub(super) exact: bool,
    /// How each unknown changes the conditions, and by how much they are off. Empty where that is weighed.
    pub(super) conditions: Vec<Vec<f64>>,
    pub(super) missing: Vec<f64>,
    /// Products summed so far.
    pub effort: f64,
}
