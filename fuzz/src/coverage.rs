//! Which edges of the program have been run through, by counters that the compiler puts there (see `.cargo/config.toml`).
//! Built without them, nothing is ever new and cases are made from the seeds alone.
#![cfg_attr(counted, expect(unsafe_code, reason = "the counters are memory that the compiler laid out"))]

use std::sync::Mutex;
use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

static COUNTERS: Mutex<Vec<&'static [AtomicU8]>> = Mutex::new(vec![]);

/// Called by every object file before `main` with the first of its counters and the end of them.
///
/// # Safety
/// The two are the limits of an array of bytes that lives as long as the program.
#[cfg(counted)]
#[unsafe(no_mangle)]
unsafe extern "C" fn __sanitizer_cov_8bit_counters_init(start: *const AtomicU8, stop: *const AtomicU8) {
    // SAFETY: promised by the compiler. The counters are also counted up without atomics, by machine code of its own.
    let counters = unsafe { std::slice::from_raw_parts(start, stop.offset_from_unsigned(start)) };
    if let Ok(mut all) = COUNTERS.lock()
        && all.iter().all(|c| !std::ptr::eq(c.as_ptr(), start))
    {
        all.push(counters);
    }
}

/// What has been seen so far: for each counter the sizes of count that occurred, one bit each.
pub struct Seen {
    counters: Vec<&'static [AtomicU8]>,
    sizes: Vec<u8>,
}

impl Seen {
    /// Nothing yet.
    pub fn new() -> Seen {
        let counters = COUNTERS.lock().map(|c| c.clone()).unwrap_or_default();
        let n = counters.iter().map(|c| c.len()).sum();
        Seen { counters, sizes: vec![0; n] }
    }

    /// Number of counters.
    pub fn counters(&self) -> usize {
        self.sizes.len()
    }

    /// Number of edges that have been run through.
    pub fn edges(&self) -> usize {
        self.sizes.iter().filter(|s| **s != 0).count()
    }

    /// Sets all counters to zero.
    pub fn reset(&self) {
        self.counters.iter().copied().flatten().for_each(|c| c.store(0, Relaxed));
    }

    /// Takes in the counts since the last reset; true if one is of a size that its edge has not had before.
    pub fn is_new(&mut self) -> bool {
        let mut new = false;
        for (count, sizes) in self.counters.iter().copied().flatten().zip(&mut self.sizes) {
            let count = count.load(Relaxed);
            if count == 0 {
                continue;
            }
            let size = match count {
                1 => 1,
                2 => 2,
                3 => 4,
                4..8 => 8,
                8..16 => 16,
                16..32 => 32,
                32..128 => 64,
                _ => 128,
            };
            if *sizes & size == 0 {
                *sizes |= size;
                new = true;
            }
        }
        new
    }
}
