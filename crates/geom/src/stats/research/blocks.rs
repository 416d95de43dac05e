//! The interval of a mean when neighboring values go together.

use super::super::statistics::{Missing, Summary};
use crate::num::special::student_quantile;
use crate::num::sum::Sum;
use crate::space::Point;

/// A mean with an interval that allows for correlation within blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockMean {
    /// Mean of all values.
    pub mean: f64,
    /// Confidence interval at 95 %.
    pub interval: [f64; 2],
    /// How many independent values would give the same uncertainty.
    pub effective_count: f64,
    /// Values used.
    pub count: u64,
    /// Blocks that hold values.
    pub blocks: u64,
}

/// Fewest blocks from which a spread can be told.
const MIN_BLOCKS: u64 = 10;

/// The mean of the finite `values` at `points`, its uncertainty taken from the scatter of whole cubes of side `size`
/// (millimeters) instead of single points.
///
/// Values in different cubes are taken as independent, those in one cube as correlated in any way whatever. The variance is the
/// cluster-robust one (Liang and Zeger 1986), with Student's t for the number of cubes. So `size` should exceed the distance
/// over which deviations go together; too small a size gives too small an interval. The paired differences of two references
/// may be put in as well as deviations.
///
/// # Errors
/// Fewer than ten occupied cubes, or values that are all equal.
pub fn mean_of_blocks(points: &[Point], values: &[f64], size: f64) -> Result<BlockMean, Missing> {
    let cell = |p: &Point| p.map(|x| (x / size).floor() as i64);
    let mut items: Vec<([i64; 3], f64)> =
        points.iter().zip(values).filter(|(_, v)| v.is_finite()).map(|(p, v)| (cell(p), *v)).collect();
    // Stable: within a block the file's order decides the last bits.
    items.sort_by_key(|i| i.0);
    let blocks = items.chunk_by(|a, b| a.0 == b.0).count() as u64;
    if blocks < MIN_BLOCKS {
        return Err(Missing::TooFew(MIN_BLOCKS));
    }
    let all = Summary::of(&items.iter().map(|i| i.1).collect::<Vec<f64>>()).all;
    let (mean, variance, n) = (all.mean?, all.variance?, items.len() as f64);
    if variance == 0.0 {
        return Err(Missing::NoSpread);
    }
    let squares: Sum = items
        .chunk_by(|a, b| a.0 == b.0)
        .map(|block| {
            let sum = block.iter().map(|i| i.1 - mean).sum::<f64>();
            sum * sum
        })
        .sum();
    let b = blocks as f64;
    let of_mean = squares.value() / (n * n) * (b / (b - 1.0));
    let half = student_quantile(0.05, b - 1.0) * of_mean.sqrt();
    Ok(BlockMean {
        mean,
        interval: [mean - half, mean + half],
        effective_count: variance / of_mean,
        count: items.len() as u64,
        blocks,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// Values that are equal within each cube: the cubes are the independent values.
    #[test]
    fn equal_neighbors_count_once() {
        let mut random = Random::new(4);
        let level: Vec<f64> = (0..400).map(|_| random.unit()).collect();
        let points: Vec<Point> =
            (0..400 * 25).map(|i| [f64::from(i / 25) + 0.5, 0.1 * f64::from(i % 5), 0.5]).collect();
        let values: Vec<f64> = (0..400 * 25).map(|i| level[i / 25]).collect();
        let found = mean_of_blocks(&points, &values, 1.0).unwrap();
        assert_eq!((found.count, found.blocks), (10_000, 400));
        assert!((found.effective_count / 400.0 - 1.0).abs() < 0.01, "{found:?}");
        let alone = Summary::of(&level).all;
        let half = student_quantile(0.05, 399.0) * alone.std_dev.unwrap() / 20.0;
        assert!(((found.interval[1] - found.mean) / half - 1.0).abs() < 1e-10);
        // Independent values: as many as there are.
        let free: Vec<f64> = values.iter().map(|_| random.unit()).collect();
        let found = mean_of_blocks(&points, &free, 1.0).unwrap();
        assert!((found.effective_count / 10_000.0 - 1.0).abs() < 0.25, "{found:?}");
    }

    #[test]
    fn few_blocks_tell_nothing() {
        let points = [[0.0; 3]; 50];
        assert_eq!(mean_of_blocks(&points, &[1.0; 50], 1.0), Err(Missing::TooFew(10)));
        let spread: Vec<Point> = (0..50).map(|i| [f64::from(i), 0.0, 0.0]).collect();
        assert_eq!(mean_of_blocks(&spread, &[1.0; 50], 1.0), Err(Missing::NoSpread));
    }
}
