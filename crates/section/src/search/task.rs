//! Points of one chain, and how it is looked for.

use super::rounds::Search;
use crate::model::budget::Budget;
use crate::model::criterion::Criterion;
use crate::model::least::{Row, Work};

/// Least length of a piece that is known, in distances between points.
const MIN_KNOWN_LENGTH_SPACINGS: f64 = 0.1;

/// Points of one chain, in a row of their own.
#[derive(Clone, Debug)]
pub(crate) struct Span {
    /// Their numbers in the cleaned row.
    pub numbers: Vec<usize>,
    pub points: Vec<[f64; 2]>,
    pub weights: Vec<f64>,
}

/// How the chain of a span is looked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Task<'a> {
    pub criterion: Criterion,
    /// Standard deviation of the noise, given or of local fits, whichever is more.
    pub scatter: f64,
    pub spacing: f64,
    /// Step at which points are followed.
    pub step: usize,
    pub closed: bool,
    /// At joins of free pieces the curvature must not jump.
    pub even: bool,
    pub level: f64,
    /// The pieces are those of the parts: nothing is searched.
    pub known: bool,
    /// As of the search.
    pub budget: &'a Budget,
    /// The pieces are those of the parts, refined together: neither others nor intervals are looked for.
    pub draft: bool,
}

impl Span {
    pub fn new(all: &[[f64; 2]], weights: &[f64], numbers: Vec<usize>) -> Span {
        let points = numbers.iter().map(|i| all[*i]).collect();
        let weights = numbers.iter().map(|i| weights[*i]).collect();
        Span { numbers, points, weights }
    }

    /// Cost of models of its points.
    pub fn criterion(&self, task: &Task) -> Criterion {
        let points = (self.points.len() as f64).max(2.0);
        Criterion { count: self.weights.iter().sum::<f64>().max(2.0), points, ..task.criterion }
    }

    pub fn search<'a>(&'a self, task: &Task<'a>) -> Search<'a> {
        let row = self.row();
        let criterion = self.criterion(task);
        let (work, kinds) = (Work::default(), [true, true]);
        Search {
            row,
            criterion,
            work,
            spacing: task.spacing,
            kinds,
            even: task.even,
            budget: task.budget,
            shortest: if task.known { MIN_KNOWN_LENGTH_SPACINGS } else { 2.0 * task.step as f64 },
            until: f64::INFINITY,
        }
    }

    pub fn row(&self) -> Row<'_> {
        Row { points: &self.points, weights: &self.weights }
    }
}
