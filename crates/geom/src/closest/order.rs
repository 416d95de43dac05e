//! Sorting the points along a space-filling curve, so that neighbors in the list are neighbors in space.
//!
//! The points themselves are not moved: what is sorted is `(key, index)` in one `u64`. A first pass scatters these into buckets
//! by the high bits of the key, in parallel. Each bucket is then sorted in cache by the thread that is about to answer it
//! ([`for_each_bucket`]). The order only decides the speed, never the answer.
#![expect(unsafe_code, reason = "several threads scatter into one list, each to places of its own")]

use crate::closest::limits::{QueryError, sane};
use crate::memory::{Shared, large_pages};
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::Point;

/// High bits of the key that choose the bucket.
const BUCKET_BITS: u32 = 12;
/// Bits of the key below the bucket's.
const LOW_BITS: u32 = 30 - BUCKET_BITS;

/// Points sorted together. It bounds the memory for the order to 64 MiB. More at once would make neighbors nearer and the
/// answers a little faster.
const POINTS_PER_SLICE: usize = 1 << 23;
/// Points that a thread takes at a time, about: buckets are joined until they have so many.
const POINTS_PER_BUCKET: usize = 8192;

/// Calls `answer(scratch, slice, base, items)` for portions of neighboring points until every point was named once. The low 32
/// bits of an item are the point's index in `slice`, which begins at point `base`. Runs on the current rayon pool; a thread
/// keeps its scratch. Tells `progress` of the points answered.
///
/// The portions and the order in them do not depend on the number of threads.
pub fn for_each_bucket<S: Default>(
    points: &[Point],
    progress: &dyn Progress,
    answer: impl Fn(&mut S, &[Point], usize, &[u64]) + Sync,
) -> Result<(), QueryError> {
    for (n, slice) in points.chunks(POINTS_PER_SLICE).enumerate() {
        let base = n * POINTS_PER_SLICE;
        let mut buckets = buckets(slice).map_err(|i| QueryError::BadPoint(base + i))?;
        chunks(&mut buckets).into_par_iter().try_for_each_init(
            || (S::default(), vec![]),
            |(scratch, spare), chunk| {
                for items in chunk {
                    if progress.cancelled() {
                        return Err(Cancelled);
                    }
                    sort_bucket(items, spare);
                    answer(scratch, slice, base, items);
                    progress.advance(items.len() as u64);
                }
                Ok(())
            },
        )?;
    }
    Ok(())
}

/// `(key << 32 | index)` of each point grouped by bucket, and the limits of the buckets.
struct Buckets {
    items: Vec<u64>,
    limits: Vec<usize>,
}

/// Spreads the low 10 bits to every third place.
#[inline(always)]
fn spread(x: u32) -> u32 {
    let x = (x | x << 16) & 0x030000FF;
    let x = (x | x << 8) & 0x0300F00F;
    let x = (x | x << 4) & 0x030C30C3;
    (x | x << 2) & 0x09249249
}

/// Box of the points, and whether all of them are sane.
fn survey(points: &[Point], chunk: usize) -> (Point, Point, bool) {
    let none = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3], true);
    let of = |part: &[Point]| {
        let (mut lo, mut hi, mut good) = none;
        for p in part {
            good &= sane(p);
            for k in 0..3 {
                lo[k] = if p[k] < lo[k] { p[k] } else { lo[k] };
                hi[k] = if p[k] > hi[k] { p[k] } else { hi[k] };
            }
        }
        (lo, hi, good)
    };
    points.par_chunks(chunk).map(of).reduce(
        || none,
        |a, b| {
            (
                std::array::from_fn(|k| a.0[k].min(b.0[k])),
                std::array::from_fn(|k| a.1[k].max(b.1[k])),
                a.2 & b.2,
            )
        },
    )
}

/// Groups the points by the high bits of their Morton key (Morton 1966). The key interleaves the bits of their cell in a grid
/// of 1024 cells along the longest side. Fails with the index of the first point that is not finite or too large.
fn buckets(points: &[Point]) -> Result<Buckets, usize> {
    let n = points.len();
    let chunk = n.div_ceil(4 * rayon::current_num_threads()).max(1 << 14);
    let (lo, hi, good) = survey(points, chunk);
    if !good {
        return Err(points.iter().position(|p| !sane(p)).unwrap_or(0));
    }
    let extent = (0..3).map(|k| hi[k] - lo[k]).fold(0.0, f64::max);
    let factor = if extent > 0.0 { 1023.999 / extent } else { 0.0 };
    let key = |p: &Point| {
        let c = |k: usize| ((p[k] - lo[k]) * factor) as u32;
        spread(c(0)) | spread(c(1)) << 1 | spread(c(2)) << 2
    };
    let count = |part: &[Point]| {
        let mut counts = vec![0; 1 << BUCKET_BITS];
        part.iter().for_each(|p| counts[(key(p) >> LOW_BITS) as usize] += 1);
        counts
    };
    let mut counts: Vec<Vec<usize>> = points.par_chunks(chunk).map(count).collect();
    let limits = limits(&mut counts);
    let mut items: Vec<u64> = large_pages(Vec::with_capacity(n));
    let out = Shared::of(&mut items);
    points.par_chunks(chunk).zip(counts).enumerate().for_each(|(c, (part, mut next))| {
        for (i, p) in part.iter().enumerate() {
            let k = key(p);
            let at = &mut next[(k >> LOW_BITS) as usize];
            // SAFETY: the counts give every point a place of its own in 0..n.
            unsafe { *out.at(*at) = (k as u64) << 32 | (c * chunk + i) as u64 };
            *at += 1;
        }
    });
    // SAFETY: all n places were written.
    unsafe { items.set_len(n) };
    Ok(Buckets { items, limits })
}

/// Turns the counts of each chunk and bucket into the chunk's first place in the bucket; returns where buckets begin.
fn limits(counts: &mut [Vec<usize>]) -> Vec<usize> {
    let mut limits = Vec::with_capacity((1 << BUCKET_BITS) + 1);
    let mut total = 0;
    for b in 0..1 << BUCKET_BITS {
        limits.push(total);
        for h in counts.iter_mut() {
            total += std::mem::replace(&mut h[b], total);
        }
    }
    limits.push(total);
    limits
}

/// Sorts one bucket by key: two counting passes over the low bits, in cache. `spare` is scratch.
fn sort_bucket(items: &mut [u64], spare: &mut Vec<u64>) {
    if items.len() < 256 {
        return items.sort_unstable();
    }
    spare.clear();
    spare.resize(items.len(), 0);
    let bits = LOW_BITS.div_ceil(2);
    counting_pass(items, spare, 32, bits);
    counting_pass(spare, items, 32 + bits, bits);
}

fn counting_pass(from: &[u64], to: &mut [u64], shift: u32, bits: u32) {
    let mask = (1usize << bits) - 1;
    let mut next = [0u32; 2048];
    from.iter().for_each(|x| next[(x >> shift) as usize & mask] += 1);
    let mut total = 0;
    for n in &mut next[..=mask] {
        total += std::mem::replace(n, total);
    }
    for &x in from {
        let at = &mut next[(x >> shift) as usize & mask];
        to[*at as usize] = x;
        *at += 1;
    }
}

/// Neighboring buckets joined to portions of about [`POINTS_PER_BUCKET`] points.
fn chunks(buckets: &mut Buckets) -> Vec<Vec<&mut [u64]>> {
    let mut chunks: Vec<Vec<&mut [u64]>> = vec![];
    let (mut rest, mut filled) = (&mut buckets.items[..], usize::MAX);
    for w in buckets.limits.windows(2).filter(|w| w[1] > w[0]) {
        let (part, tail) = rest.split_at_mut(w[1] - w[0]);
        rest = tail;
        if filled.saturating_add(part.len()) > POINTS_PER_BUCKET {
            chunks.push(vec![]);
            filled = 0;
        }
        filled += part.len();
        if let Some(c) = chunks.last_mut() {
            c.push(part);
        }
    }
    chunks
}
