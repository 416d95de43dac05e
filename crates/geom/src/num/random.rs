//! Random numbers that are the same on every machine and for every number of threads.
//!
//! SplitMix64: Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014. One addition and one mixing
//! function per number. So the state after `n` numbers is known without drawing them, and item `i` of a parallel loop can own
//! stream `i`.

/// A seeded generator of uniform 64-bit numbers (period 2^64).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Random {
    state: u64,
}

/// The golden section of 2⁶⁴: its multiples, taken modulo 2⁶⁴, lie evenly spread, however many.
pub(crate) const GOLDEN_STEP: u64 = 0x9e37_79b9_7f4a_7c15;

impl Random {
    /// The generator with this seed.
    pub fn new(seed: u64) -> Random {
        Random { state: seed }
    }
    /// Stream number `stream` of this seed. Streams start at scattered places of the one long period: 10,000 streams
    /// of 10^6 numbers overlap with a chance below 10^-5.
    pub fn stream(seed: u64, stream: u64) -> Random {
        let mut of_seed = Random::new(seed);
        let start = of_seed.next_u64();
        Random { state: mix(start ^ mix(stream.wrapping_mul(GOLDEN_STEP).wrapping_add(1))) }
    }
    /// The next 64 random bits.
    pub fn next_u64(&mut self) -> u64 {
        self.state = self.state.wrapping_add(GOLDEN_STEP);
        mix(self.state)
    }
    /// The next number of [0, 1): one of 2^53 equally spaced ones.
    pub fn unit(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }
    /// A number below `bound`, each equally often (Lemire's multiplication, with rejection of the uneven rest).
    /// 0 where `bound` is 0.
    pub fn below(&mut self, bound: u64) -> u64 {
        loop {
            let product = u128::from(self.next_u64()) * u128::from(bound);
            let rest = product as u64;
            if rest >= bound || rest >= bound.wrapping_neg().checked_rem(bound).unwrap_or(0) {
                return (product >> 64) as u64;
            }
        }
    }
    /// A Poisson number of this mean; 0 for a mean that is not positive.
    ///
    /// Products of uniform numbers for small means, transformed rejection for others (Hörmann, The transformed rejection
    /// method for generating Poisson random variables, 1993, algorithm PTRS).
    pub fn poisson(&mut self, mean: f64) -> f64 {
        if mean < 10.0 {
            let limit = libm::exp(-mean.max(0.0));
            let (mut product, mut count) = (self.unit(), 0.0);
            while product > limit {
                product *= self.unit();
                count += 1.0;
            }
            return count;
        }
        let b = 0.931 + 2.53 * mean.sqrt();
        let a = 0.02483 * b - 0.059;
        let scale = libm::log(1.1239 + 1.1328 / (b - 3.4));
        let log_mean = libm::log(mean);
        loop {
            let (u, v) = (self.unit() - 0.5, self.unit());
            let edge = 0.5 - u.abs();
            let count = ((2.0 * a / edge + b) * u + mean + 0.43).floor();
            if edge >= 0.07 && v <= 0.9277 - 3.6224 / (b - 2.0) {
                return count;
            }
            if count < 0.0 || (edge < 0.013 && v > edge) {
                continue;
            }
            let hat = libm::log(v) + scale - libm::log(a / (edge * edge) + b);
            if hat <= count * log_mean - mean - libm::lgamma(count + 1.0) {
                return count;
            }
        }
    }
    /// `count` different numbers below `total`, ascending, each set equally likely; all of them where there are no
    /// more. Floyd's algorithm (Bentley, Programming Pearls: a sample of brilliance, 1987); time and memory grow with
    /// `count` only.
    pub fn choose(&mut self, count: usize, total: usize) -> Vec<usize> {
        let count = count.min(total);
        let mut chosen = std::collections::BTreeSet::new();
        for last in total - count..total {
            let candidate = self.below(last as u64 + 1) as usize;
            if !chosen.insert(candidate) {
                chosen.insert(last);
            }
        }
        chosen.into_iter().collect()
    }
}

fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_numbers_are_the_published_ones() {
        // The test vector that goes round with the algorithm's public-domain C code, seed 1234567.
        let mut random = Random::new(1_234_567);
        let first: Vec<u64> = (0..5).map(|_| random.next_u64()).collect();
        let published = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!(first, published);
    }

    #[test]
    fn bounded_numbers_are_even() {
        let mut random = Random::new(7);
        let mut counts = [0u32; 7];
        for _ in 0..70_000 {
            counts[random.below(7) as usize] += 1;
        }
        // 5 standard deviations of a binomial with mean 10,000.
        assert!(counts.iter().all(|c| c.abs_diff(10_000) < 463), "{counts:?}");
        assert_eq!(random.below(1), 0);
        assert_eq!(random.below(0), 0);
    }

    #[test]
    fn poisson_numbers_have_their_moments() {
        let mut random = Random::new(17);
        for mean in [0.0, 0.7, 9.9, 10.0, 250.0, 1e7] {
            let (n, mut sum, mut squares) = (40_000.0, 0.0, 0.0);
            for _ in 0..40_000 {
                let d = random.poisson(mean) - mean;
                sum += d;
                squares += d * d;
            }
            // Five standard deviations of the mean and of the variance.
            assert!(sum.abs() <= 5.0 * (mean * n).sqrt(), "mean {mean}: {sum}");
            let spread = mean * ((2.0 + 1.0 / mean.max(1e-9)) * n).sqrt();
            assert!((squares - mean * n).abs() <= 5.0 * spread, "mean {mean}: {squares}");
        }
        let none = (0..40_000).filter(|_| random.poisson(0.7) == 0.0).count() as f64 / 40_000.0;
        assert!((none - (-0.7f64).exp()).abs() < 0.0125);
    }

    #[test]
    fn a_choice_is_a_set_of_the_wanted_size() {
        let mut seen = vec![0u32; 20];
        for stream in 0..4000 {
            let chosen = Random::stream(3, stream).choose(5, 20);
            assert_eq!(chosen.len(), 5);
            assert!(chosen.windows(2).all(|w| w[0] < w[1]));
            chosen.iter().for_each(|i| seen[*i] += 1);
        }
        assert!(seen.iter().all(|c| c.abs_diff(1000) < 140), "{seen:?}");
        assert_eq!(Random::new(1).choose(9, 4), [0, 1, 2, 3]);
    }
}
