//! Intervals, tests and models of the deviations from one reference.

use super::found::Comparisons;
use super::reference::{Compared, Values};
use super::shown::ShownPoints;
use trueness_document::research::*;
use trueness_geom::stats::research::distributions::{Family, fits};
use trueness_geom::stats::research::{blocks, bootstrap, moran, normality};
use trueness_geom::stats::statistics::Missing;

/// Points, at most, of the sample that has places.
pub const MAX_PLACED_SAMPLE: usize = 1 << 18;
/// Deviations that tests and fits look at.
const MAX_TESTED_SAMPLE: usize = 5000;
/// Side of the cubes within which deviations may go together, as a share of the sample's diagonal.
const BLOCK_SHARE: f64 = 0.05;

/// Everything about reference number `i`, of which `places` is a sample.
pub fn research(c: &Compared, places: &ShownPoints, i: usize, seed: u64) -> Research {
    let sample = places.deviations.get(i).map_or(&[][..], Vec::as_slice);
    let values = match &c.values {
        Values::All(values) => values.as_slice(),
        Values::Many(_) => sample,
    };
    let size = BLOCK_SHARE * c.diagonal;
    Research {
        bootstrap: finding(intervals(c, seed)),
        block_mean: finding(blocks::mean_of_blocks(&places.points, sample, size).map(|b| BlockMean {
            block_size: size,
            mean: b.mean,
            interval: b.interval,
            effective_count: b.effective_count,
            blocks: b.blocks,
            count: b.count,
        })),
        normality: Normality {
            d_agostino: finding(normality::d_agostino(&c.summary.all).map(test)),
            anderson_darling: finding(normality::anderson_darling(values, MAX_TESTED_SAMPLE, seed).map(test)),
        },
        distributions: finding(fits(values, MAX_TESTED_SAMPLE, seed).map(|all| {
            let record = |f: &trueness_geom::stats::research::distributions::Fit| Distribution {
                family: name(f.family).into(),
                location: f.location,
                scale: f.scale,
                shape: f.shape,
                aic: f.aic,
                bic: f.bic,
                ks_distance: f.ks_distance,
            };
            all.iter().map(record).collect()
        })),
        moran: finding({
            let options = moran::Options { seed, ..moran::Options::default() };
            moran::autocorrelation(&places.points, sample, &options).map(|m| Moran {
                i: m.i,
                expected: m.expected,
                p_value: m.p,
                count: m.count,
                neighbor_distance: m.neighbor_distance,
            })
        }),
    }
}

/// Why two references are not compared by blocks.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotTogether {
    /// Nothing was looked for, as errors were said to be independent.
    #[error("errors are independent, as was asked for")]
    Independent,
    /// The points lie too near each other.
    #[error(
        "points lie in fewer than {least} of the cubes within which they may go together, a twentieth of the reference's diagonal wide"
    )]
    FewBlocks {
        /// Cubes that would do.
        least: u64,
    },
    /// The statistics do not exist.
    #[error(transparent)]
    Missing(Missing),
}

/// The mean of the differences of two references, by blocks within which they may go together.
pub fn together(found: &Comparisons, first: usize, second: usize) -> Result<blocks::BlockMean, NotTogether> {
    let of = |n: usize| found.together.deviations.get(n).map_or(&[][..], Vec::as_slice);
    let differences: Vec<f64> = of(first).iter().zip(of(second)).map(|(a, b)| a.abs() - b.abs()).collect();
    // Single points far off are no measure of the part.
    let size = found.references.get(first).map_or(0.0, |c| c.diagonal);
    blocks::mean_of_blocks(&found.together.points, &differences, BLOCK_SHARE * size).map_err(|e| match e {
        Missing::TooFew(least) => NotTogether::FewBlocks { least },
        e => NotTogether::Missing(e),
    })
}

fn intervals(c: &Compared, seed: u64) -> Result<Bootstrap, trueness_geom::stats::statistics::Missing> {
    let options = bootstrap::Options { seed, ..bootstrap::Options::default() };
    let found = match &c.values {
        Values::All(values) => bootstrap::bootstrap(values, &options),
        Values::Many(many) => bootstrap::bootstrap_sketch(many.sketch(), &options),
    }?;
    Ok(Bootstrap {
        mean: found.mean,
        std_dev: found.std_dev,
        confidence: options.confidence,
        replicates: options.replicates,
        count: found.count,
    })
}

fn finding<T, E: std::fmt::Display>(found: Result<T, E>) -> Finding<T> {
    match found {
        Ok(x) => Finding::Found(x),
        Err(e) => Finding::Missing { reason: e.to_string() },
    }
}

fn test(t: normality::Test) -> Test {
    Test { statistic: t.statistic, p_value: t.p, count: t.count }
}

fn name(family: Family) -> &'static str {
    match family {
        Family::Normal => "normal",
        Family::Laplace => "laplace",
        Family::Logistic => "logistic",
        Family::StudentT => "student-t",
        Family::HalfNormal => "half-normal",
        Family::Exponential => "exponential",
        Family::LogNormal => "log-normal",
    }
}
