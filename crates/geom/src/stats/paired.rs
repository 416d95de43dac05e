//! Which of several references lies nearer to the same points, and whether the difference is more than chance.
//!
//! Neighboring points of a scan are not independent: their deviations go together. The effect of that on a mean is told by
//! [`super::research::blocks`], and taken into account where it is given.

use super::research::blocks::BlockMean;
use super::sketch::Sketch;
use super::statistics::{Accumulator, Missing, Number, Statistics, Summary};
use crate::num::special::{coin_p, normal_p, student_p, student_quantile};

/// Order of references, best first, by the root mean square of their deviations; equal ones keep their order, those
/// without deviations come last.
pub fn ranking(summaries: &[Summary]) -> Vec<usize> {
    let rms = |i: &usize| summaries[*i].all.rms.unwrap_or(f64::INFINITY);
    let mut order: Vec<usize> = (0..summaries.len()).collect();
    order.sort_by(|a, b| rms(a).total_cmp(&rms(b)));
    order
}

/// The differences `|deviation from the first| - |deviation from the second|`, gathered block by block.
#[derive(Clone, Debug, Default)]
pub struct Paired {
    differences: Accumulator,
}

/// The evidence of the differences. Negative: the first reference is nearer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Points that have both deviations.
    pub count: u64,
    /// Points that tell as much as an independent one, 1 or more.
    pub points_per_independent: f64,
    /// Points nearer to the first reference.
    pub first_nearer: u64,
    /// Points nearer to the second.
    pub second_nearer: u64,
    /// Mean difference, millimeters.
    pub mean: Number,
    /// Sample standard deviation of the differences, millimeters.
    pub std_dev: Number,
    /// Confidence interval of the mean at 95 %, by Student's t.
    pub interval: Result<[f64; 2], Missing>,
    /// p value of the mean being zero (paired t test, two-sided).
    pub t_test: Number,
    /// p value of the differences being symmetric about zero, by Wilcoxon's signed ranks: two-sided, normal approximation with
    /// correction for ties, zeros left out. Sizes within 2^-14 of each other count as tied.
    pub wilcoxon: Number,
    /// p value of either reference being nearer equally often (sign test, exact, two-sided, ties left out).
    pub sign_test: Number,
}

impl Paired {
    /// Nothing yet.
    pub fn new() -> Paired {
        Paired::default()
    }
    /// Adds the next points: their deviations from both references, of which the sign is not looked at. Points where one
    /// is NaN (excluded there) are passed over.
    pub fn push(&mut self, first: &[f64], second: &[f64]) {
        let differences: Vec<f64> =
            first.iter().zip(second).map(|(a, b)| a.abs() - b.abs()).filter(|d| d.is_finite()).collect();
        self.differences.push(&differences);
    }
    /// Full statistics of the differences.
    pub fn summary(&self) -> Summary {
        self.differences.summary()
    }
    /// The comparison of everything so far. `blocks` is the mean of the differences, of all points or of a sample of them, by
    /// blocks within which they may go together. Without it all points are independent.
    ///
    /// The tests then count as many points as would be independent. The test of the mean is the cluster-robust one of the
    /// blocks, for all points. The two others take it that ranks and signs go together as the differences do.
    pub fn comparison(&self, blocks: Option<&BlockMean>) -> Comparison {
        let Summary { all, positive, negative, .. } = self.summary();
        // The variance of a mean is that of one value, and the mean correlation of two times it.
        let correlation = blocks.map_or(0.0, |b| (1.0 / b.effective_count - 1.0 / b.count as f64).max(0.0));
        let points_per_independent = 1.0 + all.count as f64 * correlation;
        let independent = all.count as f64 / points_per_independent;
        let freedom = blocks.map_or(independent, |b| independent.min(b.blocks as f64)) - 1.0;
        let interval = all.std_dev.and_then(|s| Ok((all.mean?, s))).map(|(mean, s)| {
            let half = student_quantile(0.05, freedom) * s / independent.sqrt();
            [mean - half, mean + half]
        });
        Comparison {
            count: all.count,
            points_per_independent,
            first_nearer: negative.count,
            second_nearer: positive.count,
            mean: all.mean,
            std_dev: all.std_dev,
            interval,
            t_test: t_test(&all, independent, freedom),
            wilcoxon: wilcoxon(self.differences.sketch(), points_per_independent),
            sign_test: match positive.count + negative.count {
                0 => Err(if all.count == 0 { Missing::NoValues } else { Missing::NoSpread }),
                untied => {
                    let counted = |n: u64| (n as f64 / points_per_independent).round() as u64;
                    Ok(coin_p(counted(positive.count), counted(untied)))
                }
            },
        }
    }
}

fn t_test(differences: &Statistics, independent: f64, freedom: f64) -> Number {
    let (mean, std_dev) = (differences.mean?, differences.std_dev?);
    if std_dev == 0.0 {
        return Err(Missing::NoSpread);
    }
    Ok(student_p(mean / (std_dev / independent.sqrt()), freedom))
}

/// Signed ranks from counts by size: a bin of the sketch is a group of ties.
fn wilcoxon(sketch: &Sketch, points_per_independent: f64) -> Number {
    let mut sizes: Vec<(f64, bool, u64)> =
        sketch.bins().filter(|(d, _)| *d != 0.0).map(|(d, count)| (d.abs(), d > 0.0, count)).collect();
    sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut passed, mut positive_ranks, mut ties) = (0.0, 0.0, 0.0);
    for group in sizes.chunk_by(|a, b| a.0 == b.0) {
        let total: f64 = group.iter().map(|g| g.2 as f64).sum();
        let positive: f64 = group.iter().filter(|g| g.1).map(|g| g.2 as f64).sum();
        positive_ranks += positive * (passed + 0.5 * (total + 1.0));
        ties += total * total * total - total;
        passed += total;
    }
    if passed == 0.0 {
        return Err(if sketch.count() == 0 { Missing::NoValues } else { Missing::NoSpread });
    }
    let expected = passed * (passed + 1.0) / 4.0;
    let variance = passed * (passed + 1.0) * (2.0 * passed + 1.0) / 24.0 - ties / 48.0;
    Ok(normal_p((positive_ranks - expected) / (variance * points_per_independent).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::super::research::blocks::mean_of_blocks;
    use super::*;
    use crate::num::random::Random;

    fn close(found: Number, expected: f64, relative: f64) {
        let found = found.unwrap();
        assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
    }
    fn paired(first: &[f64], second: &[f64]) -> Comparison {
        let mut paired = Paired::new();
        paired.push(first, second);
        paired.comparison(None)
    }

    /// Expected: SciPy 1.17 `ttest_1samp`, `wilcoxon(zero_method="wilcox", correction=False, method="approx")`,
    /// `binomtest`. The values are multiples of 1/64, which the sketch keeps apart.
    #[test]
    fn equals_scipy() {
        let first: Vec<f64> = (0..100).map(|i| f64::from((i * 37) % 101) / 64.0).collect();
        let second: Vec<f64> = (0..100).map(|i| -f64::from((i * 53) % 97) / 64.0).collect();
        let found = paired(&first, &second);
        assert_eq!((found.count, found.first_nearer, found.second_nearer), (100, 47, 51));
        close(found.mean, 0.041875, 1e-15);
        close(found.std_dev, 0.6096314372370217, 1e-15);
        close(found.interval.map(|i| i[0]), -0.07908910319856896, 1e-12);
        close(found.interval.map(|i| i[1]), 0.16283910319856895, 1e-12);
        close(found.t_test, 0.4937576370014078, 1e-12);
        close(found.wilcoxon, 0.5767579949614035, 1e-12);
        close(found.sign_test, 0.7620362195292442, 1e-12);
        let swapped = paired(&second, &first);
        close(swapped.mean, -0.041875, 1e-14);
        close(swapped.wilcoxon, 0.5767579949614035, 1e-12);
    }

    #[test]
    fn a_clear_difference_is_seen_and_none_is_not() {
        let first: Vec<f64> = (0..5000).map(|i| 1.0 + f64::from((i * 37) % 101) / 64.0).collect();
        let second: Vec<f64> = first.iter().map(|d| -d - 0.01 - 0.002 * (d * 99.0).sin()).collect();
        let found = paired(&first, &second);
        assert!(found.t_test.unwrap() < 1e-100 && found.sign_test.unwrap() < 1e-100);
        assert!(found.interval.unwrap()[1] < 0.0 && found.wilcoxon.unwrap() < 1e-100);
        let same = paired(&first, &first);
        assert_eq!((same.mean, same.interval), (Ok(0.0), Ok([0.0, 0.0])));
        assert_eq!((same.t_test, same.wilcoxon), (Err(Missing::NoSpread), Err(Missing::NoSpread)));
        let none = paired(&[f64::NAN], &[1.0]);
        assert_eq!(
            (none.count, none.mean, none.sign_test),
            (0, Err(Missing::NoValues), Err(Missing::NoValues))
        );
        let one = paired(&[2.0], &[1.0]);
        assert_eq!((one.interval, one.t_test), (Err(Missing::OneValue), Err(Missing::OneValue)));
    }

    /// Deviations from two references that are equal in truth, with errors that neighbors along a line share: how often a difference is told at 5 %.
    #[test]
    fn neighbors_that_go_together_do_not_make_a_difference() {
        let places: Vec<[f64; 3]> = (0..4000).map(|i| [f64::from(i), 0.0, 0.0]).collect();
        let told = |shared: usize, by_blocks: bool| {
            let scans = 200;
            let told = (0..scans).filter(|scan| {
                let mut random = Random::stream(7, *scan);
                let white: Vec<f64> = (0..4000 + shared).map(|_| random.unit() - 0.5).collect();
                let smooth: Vec<f64> = (0..4000).map(|i| white[i..i + shared].iter().sum()).collect();
                // The errors lead nearer to the first as often as to the second.
                let first: Vec<f64> = smooth.iter().map(|d| 100.0 + d).collect();
                let second = vec![100.0; 4000];
                let blocks = mean_of_blocks(&places, &smooth, 80.0).unwrap();
                let mut paired = Paired::new();
                paired.push(&first, &second);
                let found = paired.comparison(by_blocks.then_some(&blocks));
                found.t_test.unwrap() < 0.05
            });
            told.count() as f64 / scans as f64
        };
        // A share of 5 % out of 200 scatters by 1.5 %.
        assert!(told(16, false) > 0.4, "{}", told(16, false));
        for shared in [1, 4, 16] {
            assert!(told(shared, true) < 0.12, "{shared}: {}", told(shared, true));
        }
    }

    /// A sample tells how far neighbors go together; of all points it follows how many count as one.
    #[test]
    fn a_sample_tells_of_all_points() {
        let mut random = Random::new(3);
        let level: Vec<f64> = (0..400).map(|_| random.unit()).collect();
        let place = |i: u32| [f64::from(i / 50) + 0.5, 0.01 * f64::from(i % 50), 0.5];
        let points: Vec<[f64; 3]> = (0..20_000).map(place).collect();
        let values: Vec<f64> = (0..20_000).map(|i| level[i / 50] + random.unit()).collect();
        let sample = random.choose(2000, 20_000);
        let of = |all: &[usize]| {
            let places: Vec<[f64; 3]> = all.iter().map(|i| points[*i]).collect();
            let blocks =
                mean_of_blocks(&places, &all.iter().map(|i| values[*i]).collect::<Vec<_>>(), 1.0).unwrap();
            let mut paired = Paired::new();
            paired.push(&values, &vec![0.0; values.len()]);
            paired.comparison(Some(&blocks)).points_per_independent
        };
        let [whole, part] = [of(&(0..20_000).collect::<Vec<_>>()), of(&sample)];
        // Half of the variance is that of the 50 points of a level.
        assert!((whole / 25.5 - 1.0).abs() < 0.15 && (part / whole - 1.0).abs() < 0.25, "{whole} {part}");
    }

    #[test]
    fn ranks_by_root_mean_square() {
        let of = |v: &[f64]| Summary::of(v);
        assert_eq!(ranking(&[of(&[3.0, -3.0]), of(&[]), of(&[1.0, 4.0]), of(&[-3.0, 3.0])]), [2, 0, 3, 1]);
    }
}
