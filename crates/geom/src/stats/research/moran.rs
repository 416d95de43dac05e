//! Do neighboring deviations go together?
//!
//! Moran's I (Biometrika 37, 1950) with the weights of a nearest-neighbor graph. Its expectation and variance under random
//! rearrangement of the values follow Cliff and Ord, Spatial processes (1981).

use super::super::statistics::{Missing, Summary};
use crate::num::special::normal_p;
use crate::parallel::prelude::*;
use crate::space::Point;
use crate::spatial::neighbors::PointTree;

/// How to look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Points looked at.
    pub sample: usize,
    /// Neighbors of each.
    pub neighbors: usize,
    /// Decides which points.
    pub seed: u64,
}

impl Default for Options {
    fn default() -> Options {
        Options { sample: 10_000, neighbors: 8, seed: 1 }
    }
}

/// Spatial autocorrelation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moran {
    /// 1: neighbors have the same deviation; about 0: they have nothing to do with each other; below: they alternate.
    pub i: f64,
    /// The average that chance gives: `-1 / (count - 1)`.
    pub expected: f64,
    /// Standard deviation by chance.
    pub std_dev: f64,
    /// Two-sided p value of chance, by the normal approximation.
    pub p: f64,
    /// Points looked at.
    pub count: u64,
    /// Mean distance of the neighbors, millimeters: the length the answer is about. A sparser sample has a larger one,
    /// and less correlation.
    pub neighbor_distance: f64,
}

/// Moran's I of the finite `values` at the `points` of a sample. Cost: some 20 ms for 10,000 points.
///
/// # Errors
/// Fewer than ten values or no more than neighbors, or all equal.
pub fn autocorrelation(points: &[Point], values: &[f64], options: &Options) -> Result<Moran, Missing> {
    let (chosen, sample) =
        super::subsample(&values[..values.len().min(points.len())], options.sample, options.seed);
    let fewest = (options.neighbors + 2).max(10);
    if sample.len() < fewest || options.neighbors == 0 {
        return Err(Missing::TooFew(fewest as u64));
    }
    let all = Summary::of(&sample).all;
    let (mean, kurtosis) = (all.mean?, all.kurtosis? + 3.0);
    let places: Vec<Point> = chosen.iter().map(|i| points[*i]).collect();
    let (graph, neighbor_distance) = graph(&places, options.neighbors);
    let n = sample.len() as f64;
    let k = options.neighbors as f64;
    let i = index(&graph, &sample.iter().map(|x| x - mean).collect::<Vec<f64>>());
    let (expected, variance) = by_chance(&graph, n, k, kurtosis);
    let std_dev = variance.sqrt();
    Ok(Moran {
        i,
        expected,
        std_dev,
        p: normal_p((i - expected) / std_dev),
        count: sample.len() as u64,
        neighbor_distance,
    })
}

/// The `k` nearest of each point, and their mean distance.
fn graph(points: &[Point], k: usize) -> (Vec<Vec<u32>>, f64) {
    let tree = PointTree::new(points);
    let near: Vec<Vec<(f64, u32)>> =
        points.par_iter().enumerate().map(|(i, p)| tree.k_nearest(p, k, Some(i as u32))).collect();
    let total = near.iter().flatten().map(|(d, _)| d.sqrt()).sum::<f64>();
    let graph = near.iter().map(|row| row.iter().map(|(_, j)| *j).collect()).collect();
    (graph, total / (points.len() * k) as f64)
}

/// Moran's I of values whose mean is zero. Each row of weights adds up to one.
fn index(graph: &[Vec<u32>], centered: &[f64]) -> f64 {
    let near = |row: &[u32]| row.iter().map(|j| centered[*j as usize]).sum::<f64>() / row.len() as f64;
    let products = graph.iter().zip(centered).map(|(row, x)| x * near(row)).sum::<f64>();
    products / centered.iter().map(|x| x * x).sum::<f64>()
}

/// Mean and variance of I when the values are put to the points in random order.
fn by_chance(graph: &[Vec<u32>], n: f64, k: f64, kurtosis: f64) -> (f64, f64) {
    let mut columns = vec![0.0; graph.len()];
    let mut mutual = 0.0;
    for (i, row) in graph.iter().enumerate() {
        for j in row {
            columns[*j as usize] += 1.0 / k;
            mutual += f64::from(u8::from(graph[*j as usize].contains(&(i as u32))));
        }
    }
    // Half the sum of (w_ij + w_ji)² over all pairs.
    let s1 = (n * k + mutual) / (k * k);
    let s2 = columns.iter().map(|c| (1.0 + c) * (1.0 + c)).sum::<f64>();
    let s0 = n * n;
    let expected = -1.0 / (n - 1.0);
    let flat = n * ((n * n - 3.0 * n + 3.0) * s1 - n * s2 + 3.0 * s0);
    let peaked = kurtosis * ((n * n - n) * s1 - 2.0 * n * s2 + 6.0 * s0);
    (expected, (flat - peaked) / ((n - 1.0) * (n - 2.0) * (n - 3.0) * s0) - expected * expected)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    fn scattered(count: usize, seed: u64) -> Vec<Point> {
        let mut random = Random::new(seed);
        (0..count).map(|_| [random.unit(), random.unit(), 0.1 * random.unit()]).collect()
    }

    /// Mean and spread over many random rearrangements are what the formula says.
    #[test]
    fn chance_is_as_computed() {
        let points = scattered(60, 1);
        let mut random = Random::new(2);
        let mut values: Vec<f64> = points.iter().map(|_| random.unit().powi(6)).collect();
        let options = Options { neighbors: 5, ..Options::default() };
        let formula = autocorrelation(&points, &values, &options).unwrap();
        let (graph, _) = graph(&points, options.neighbors);
        let mean = values.iter().sum::<f64>() / 60.0;
        values.iter_mut().for_each(|x| *x -= mean);
        let mut drawn = vec![];
        for _ in 0..20_000 {
            for i in (1..values.len()).rev() {
                values.swap(i, random.below(i as u64 + 1) as usize);
            }
            drawn.push(index(&graph, &values));
        }
        let found = Summary::of(&drawn).all;
        assert!((found.mean.unwrap() - formula.expected).abs() < 4.0 * formula.std_dev / 20_000f64.sqrt());
        assert!((found.std_dev.unwrap() / formula.std_dev - 1.0).abs() < 0.02, "{found:?} {formula:?}");
    }

    #[test]
    fn smooth_values_go_together_and_random_ones_do_not() {
        let points = scattered(3000, 5);
        let smooth: Vec<f64> = points.iter().map(|p| (6.0 * p[0]).sin() + p[1]).collect();
        let found = autocorrelation(&points, &smooth, &Options::default()).unwrap();
        assert!(found.i > 0.95 && found.p < 1e-100, "{found:?}");
        let mut random = Random::new(6);
        let free: Vec<f64> = points.iter().map(|_| random.unit()).collect();
        let found = autocorrelation(&points, &free, &Options::default()).unwrap();
        assert!(found.i.abs() < 0.03 && found.p > 1e-3, "{found:?}");
        let smaller = Options { sample: 500, ..Options::default() };
        assert_eq!(autocorrelation(&points, &free, &smaller).unwrap().count, 500);
        assert_eq!(autocorrelation(&points, &[1.0; 3000], &smaller), Err(Missing::NoSpread));
        assert_eq!(autocorrelation(&points[..5], &free, &smaller), Err(Missing::TooFew(10)));
    }

    /// Four values around a ring of ten, by hand: each point's two neighbors on a line of pairs.
    #[test]
    fn equals_the_sum_by_hand() {
        let points: Vec<Point> = (0..10).map(|i| [f64::from(i), 0.0, 0.0]).collect();
        let values = [1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let found =
            autocorrelation(&points, &values, &Options { neighbors: 1, ..Options::default() }).unwrap();
        // The nearest of i is i - 1 (the lower number of two equally near), of 0 it is 1. Centered: 0.8, 0.8, -0.2 …
        let products = 0.64 + 0.64 - 0.16 + 7.0 * 0.04;
        assert!((found.i - products / (2.0 * 0.64 + 8.0 * 0.04)).abs() < 1e-15, "{found:?}");
        assert_eq!(found.neighbor_distance, 1.0);
    }
}
