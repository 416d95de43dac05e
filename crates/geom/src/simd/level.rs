//! The instruction set that the inner loops use, chosen at run time.

use std::sync::atomic::{AtomicU8, Ordering};

/// Instruction set of the inner loops. All give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// No vector instructions beyond those of every processor of the family.
    Plain,
    /// AVX2 with fused multiply-add.
    Avx2,
    /// AVX-512 (F, VL, DQ, BW).
    Avx512,
}

/// [`Level::limit`].
static LIMIT: AtomicU8 = AtomicU8::new(Level::Avx512 as u8);

impl Level {
    /// From now on no better instructions than these are used in this process. Results do not depend on it: for comparing, and for finding
    /// out whether a fault does. Threads that are at work may go on with what they began with.
    ///
    /// ```
    /// use trueness_geom::simd::Level;
    /// Level::limit(Level::Plain);
    /// assert_eq!(Level::detect(), Level::Plain);
    /// ```
    pub fn limit(level: Level) {
        LIMIT.store(level as u8, Ordering::Relaxed);
    }

    /// The best this processor has, within the [`limit`](Level::limit).
    pub fn detect() -> Level {
        let limit = LIMIT.load(Ordering::Relaxed);
        let all = [Level::Plain, Level::Avx2, Level::Avx512];
        let there = Level::of_processor();
        all.into_iter().rfind(|l| *l as u8 <= limit && *l <= there).unwrap_or(Level::Plain)
    }

    /// The best this processor has.
    pub fn of_processor() -> Level {
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("fma")
                && is_x86_feature_detected!("bmi1")
                && is_x86_feature_detected!("bmi2")
                && is_x86_feature_detected!("lzcnt")
                && is_x86_feature_detected!("popcnt");
            let avx512 = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw");
            match (avx2, avx512) {
                (true, true) => return Level::Avx512,
                (true, false) => return Level::Avx2,
                _ => {}
            }
        }
        Level::Plain
    }
}
