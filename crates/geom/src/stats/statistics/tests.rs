use super::*;
use crate::num::random::Random;
use crate::num::sum::Sum;
use crate::stats::sketch::RELATIVE_ERROR;

fn sequence(count: usize) -> Vec<f64> {
    (0..count).map(|i| ((i * 7919) % 10007) as f64 / 1000.0 - 3.3).collect()
}
fn close(found: Number, expected: f64, relative: f64) {
    let found = found.unwrap();
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} is not {expected}");
}
fn numbers(s: &Statistics) -> Vec<Number> {
    let mut all = vec![s.min, s.max, s.range, s.mean, s.variance, s.std_dev, s.cv, s.rms, s.mean_abs];
    all.extend([s.median, s.mad, s.skewness, s.kurtosis, s.six_sigma]);
    all.extend(s.percentiles);
    all
}
fn bits(s: &Summary) -> Vec<Result<u64, Missing>> {
    [s.all, s.positive, s.negative].iter().flat_map(numbers).map(|n| n.map(f64::to_bits)).collect()
}

/// Expected: mpmath 1.3 with 60 digits for the moments, NumPy 2.4 `percentile` and SciPy 1.17
/// `median_abs_deviation`, on the same numbers.
#[test]
fn equals_numpy_and_scipy() {
    let summary = Summary::of(&sequence(10_000));
    assert_eq!((summary.all.count, summary.positive.count, summary.negative.count), (10_000, 6_702, 3_297));
    assert_eq!((summary.zeros, summary.not_finite), (1, 0));
    let expected = [
        (
            summary.all,
            [
                -3.3,
                6.706,
                10.006,
                1.7036578000000002,
                8.34676099259842,
                2.8890761486327112,
                1.6958077782009455,
                3.3538598980875753,
                2.7920162,
                1.7045,
                2.502,
                -0.0002825922052817455,
                -1.200107452259752,
                17.33445689179627,
                -3.290001,
                -3.20001,
                -3.0500249999999998,
                -2.79905,
                -0.79825,
                1.7045,
                4.20525,
                6.206049999999999,
                6.456025,
                6.606010000000001,
                6.696001000000001,
            ],
        ),
        (
            summary.negative,
            [
                -3.3,
                -0.0009999999999998899,
                3.299,
                -1.6505283591143463,
                0.9078634877422399,
                0.9528187066500321,
                0.5772810272471194,
                1.9057366007681729,
                1.6505283591143463,
                -1.651,
                0.825,
                0.00045904880901270566,
                -1.1997449378063862,
                5.716912239900193,
                -3.296704,
                -3.26704,
                -3.2176,
                -3.1352,
                -2.475,
                -1.651,
                -0.826,
                -0.16580000000000014,
                -0.0833999999999998,
                -0.03395999999999985,
                -0.004295999999999793,
            ],
        ),
    ];
    for (found, expected) in expected {
        for (i, (number, value)) in numbers(&found).into_iter().zip(expected).enumerate() {
            // The skewness here is a small rest of large terms: its error is relative to them.
            close(number, value, if i == 11 { 1e-11 } else { 1e-14 });
        }
    }
    close(summary.positive.mean, 3.3539794091316026, 1e-15);
    close(summary.positive.kurtosis, -1.1998345784325748, 1e-14);
    close(summary.positive.percentiles[2], 0.1685250000000001, 1e-14);
}

/// Equally spaced values: mean, variance and kurtosis have closed forms.
#[test]
fn closed_forms_far_from_zero() {
    let count = 1_000_001_u64;
    let (center, step) = (1e6, 2f64.powi(-28)); // σ = 1.1e-3; every value is exact.
    let n = count as f64;
    let values: Vec<f64> = (0..count).map(|i| center + (i as f64 - (n - 1.0) / 2.0) * step).collect();
    let s = Summary::of(&values).all;
    assert_eq!(s.mean, Ok(center));
    close(s.variance, n * (n + 1.0) / 12.0 * step * step, 1e-15);
    close(s.kurtosis, -1.2 * (n * n + 1.0) / (n * n - 1.0), 1e-14);
    assert!(s.skewness.unwrap().abs() < 1e-14);
    assert_eq!(s.median, Ok(center));
    close(s.percentiles[0], center + (0.001 - 0.5) * (n - 1.0) * step, 1e-16);
    close(s.mad, (n - 1.0) / 4.0 * step, 1e-10);
}

/// The stream is cut at random, by any number of threads: not a bit changes.
#[test]
fn blocks_and_threads_do_not_matter() {
    let mut random = Random::new(5);
    let mut values: Vec<f64> = (0..300_000).map(|_| random.unit() - 0.3).collect();
    values[17] = 0.0;
    values[99_999] = f64::NAN;
    let whole = {
        let mut accumulator = Accumulator::new();
        accumulator.push(&values);
        accumulator.summary()
    };
    assert_eq!((whole.zeros, whole.not_finite, whole.all.count), (1, 1, 299_999));
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut accumulator = Accumulator::new();
        let mut rest = &values[..];
        while !rest.is_empty() {
            let (block, later) = rest.split_at((random.below(20_000) as usize).min(rest.len()));
            pool.install(|| accumulator.push(block));
            rest = later;
        }
        assert_eq!(bits(&accumulator.summary()), bits(&whole));
        let kept = pool.install(|| Summary::of(&values));
        assert_eq!(kept.all.variance, whole.all.variance);
        assert_eq!(bits(&kept), bits(&Summary::of(&values)));
    }
}

/// Against sums carried with 32 digits, on values over ten orders of magnitude with a far outlier.
#[test]
fn equals_sums_of_double_length() {
    let mut random = Random::new(9);
    let mut values: Vec<f64> =
        (0..100_000).map(|_| (random.unit() - 0.5) * 10f64.powf(-10.0 * random.unit())).collect();
    values[5] = 7e3;
    let s = Summary::of(&values).all;
    let n = values.len() as f64;
    let mean = values.iter().copied().sum::<Sum>().value() / n;
    let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<Sum>().value() / (n - 1.0);
    let mean_abs = values.iter().map(|x| x.abs()).sum::<Sum>().value() / n;
    close(s.mean, mean, 1e-15);
    close(s.mean_abs, mean_abs, 1e-15);
    close(s.variance, variance, 1e-15);
    close(s.rms, (values.iter().map(|x| x * x).sum::<Sum>().value() / n).sqrt(), 1e-15);
}

#[test]
fn what_does_not_exist_says_why() {
    let none = Summary::of(&[]).all;
    assert!(numbers(&none).iter().all(|n| *n == Err(Missing::NoValues)), "{none:?}");
    let one = Summary::of(&[-2.0]);
    assert_eq!(one.positive.median, Err(Missing::NoValues));
    assert_eq!((one.all.mean, one.all.rms, one.all.mad), (Ok(-2.0), Ok(2.0), Ok(0.0)));
    assert_eq!((one.all.variance, one.all.cv), (Err(Missing::OneValue), Err(Missing::OneValue)));
    assert_eq!(one.all.skewness, Err(Missing::NoSpread));
    let same = Summary::of(&[0.1; 10_000]).all;
    assert_eq!((same.mean, same.std_dev, same.cv), (Ok(0.1), Ok(0.0), Ok(0.0)));
    assert_eq!(same.kurtosis, Err(Missing::NoSpread));
    assert_eq!(Summary::of(&[0.1, 0.2, -0.3]).all.cv, Err(Missing::MeanIsZero));
    assert_eq!(Summary::of(&[f64::NAN, f64::INFINITY]).all.mean, Err(Missing::NoValues));
    let huge = Summary::of(&[1e300, -1e300, 2e300]).all;
    assert_eq!((huge.max, huge.variance), (Ok(2e300), Err(Missing::Overflow)));
    for s in [none, one.all, same, huge] {
        assert!(numbers(&s).iter().flatten().all(|x| x.is_finite()));
    }
}

/// Moving the values moves places and leaves spreads; scaling scales both.
#[test]
fn moves_and_scales_with_the_values() {
    let values: Vec<f64> = sequence(5_000).iter().map(|x| (x * 1024.0).round() / 1024.0).collect();
    let s = Summary::of(&values).all;
    let moved = Summary::of(&values.iter().map(|x| -4.0 * x + 64.0).collect::<Vec<f64>>()).all;
    close(moved.mean, -4.0 * s.mean.unwrap() + 64.0, 1e-14);
    close(moved.std_dev, 4.0 * s.std_dev.unwrap(), 1e-14);
    close(moved.mad, 4.0 * s.mad.unwrap(), 1e-14);
    close(moved.skewness, -s.skewness.unwrap(), 1e-10);
    close(moved.percentiles[10], -4.0 * s.percentiles[0].unwrap() + 64.0, 1e-14);
}

#[test]
fn streamed_quantiles_keep_their_promise() {
    let mut random = Random::new(2);
    let values: Vec<f64> =
        (0..200_000).map(|_| (random.unit() - 0.4) * (5.0 * random.unit()).exp()).collect();
    let mut accumulator = Accumulator::new();
    accumulator.push(&values);
    let (streamed, kept) = (accumulator.summary(), Summary::of(&values));
    assert_eq!((streamed.quantile_error, kept.quantile_error), (RELATIVE_ERROR, 0.0));
    for (s, k) in
        [(streamed.all, kept.all), (streamed.positive, kept.positive), (streamed.negative, kept.negative)]
    {
        for (s, k) in s.percentiles.into_iter().zip(k.percentiles) {
            close(s, k.unwrap(), RELATIVE_ERROR);
        }
        let largest = k.median.unwrap().abs() + k.mad.unwrap();
        assert!((s.mad.unwrap() - k.mad.unwrap()).abs() <= 2.0 * RELATIVE_ERROR * largest);
        assert_eq!(s.std_dev, k.std_dev);
    }
}

/// Whole numbers far from zero: their central moments are known in whole numbers.
#[test]
fn far_from_zero_the_shape_keeps_its_digits() {
    let random = &mut crate::num::random::Random::new(9);
    let parts: Vec<i64> = (0..1 << 13).map(|_| (random.unit() * random.unit() * 16384.0) as i64).collect();
    let values: Vec<f64> = parts.iter().map(|r| ((1i64 << 43) + r) as f64).collect();
    let n = parts.len() as i128;
    let sum: i128 = parts.iter().map(|r| i128::from(*r)).sum();
    let central = |power: u32| {
        let whole: i128 = parts.iter().map(|r| (n * i128::from(*r) - sum).pow(power)).sum();
        whole as f64 / (n as f64).powi(power as i32 + 1)
    };
    let all = Summary::of(&values).all;
    assert!(all.mean.unwrap() > 1e9 * all.std_dev.unwrap());
    let near = |a: f64, b: f64| (a - b).abs() < 1e-12 * b.abs();
    assert!(near(all.skewness.unwrap(), central(3) / central(2).powf(1.5)), "{:?}", all.skewness);
    assert!(near(all.kurtosis.unwrap() + 3.0, central(4) / central(2).powi(2)), "{:?}", all.kurtosis);
}
