//! The order in which points are stored: level by level, each level along a Morton curve.
//!
//! Stopping after any level leaves an even subsample, so a level of detail is no more than a number of points.

use trueness_geom::parallel::prelude::*;

/// Points of the first level.
const FIRST_LEVEL_POINTS: usize = 2048;

/// An order of points and where its levels end.
pub struct Levels {
    /// Numbers of the points, in the order of storing.
    pub order: Vec<u32>,
    /// How many points the levels up to each one hold, rising; the last is all.
    pub ends: Vec<usize>,
}

/// Orders at most `limit` of the points, evenly chosen along the curve. Those in `keep` are among them, and come first.
pub fn levels(places: &[[u16; 3]], keep: &[u32], limit: usize) -> Levels {
    let mut curve: Vec<(u64, u32)> = places.iter().zip(0..).map(|(q, i)| (morton(q), i)).collect();
    curve.par_sort_unstable();
    let mut taken = vec![false; places.len()];
    let mut order: Vec<u32> = keep.iter().copied().filter(|k| (*k as usize) < places.len()).collect();
    order.iter().for_each(|k| taken[*k as usize] = true);
    let wanted = limit.max(order.len()).min(places.len());
    let chosen: Vec<u32> = (0..wanted)
        .map(|i| curve[(i as u64 * places.len() as u64 / wanted.max(1) as u64) as usize].1)
        .collect();

    let mut depth = 0;
    while (wanted >> depth) > FIRST_LEVEL_POINTS {
        depth += 1;
    }
    let mut ends = vec![];
    for level in 0..=depth {
        // Level 0 takes every 2^depth-th, each further level what lies halfway between those already taken.
        let (first, stride) =
            if level == 0 { (0, 1 << depth) } else { (1 << (depth - level), 1 << (depth - level + 1)) };
        for &point in chosen.iter().skip(first).step_by(stride) {
            if !std::mem::replace(&mut taken[point as usize], true) {
                order.push(point);
            }
        }
        ends.push(order.len());
    }
    Levels { order, ends }
}

/// Bits of the three coordinates interleaved.
pub fn morton(q: &[u16; 3]) -> u64 {
    (0..3).fold(0, |key, k| key | spread(q[k]) << k)
}

/// Two zero bits after every bit.
fn spread(x: u16) -> u64 {
    let x = u64::from(x);
    let x = (x | x << 16) & 0x0000_ff00_00ff;
    let x = (x | x << 8) & 0x00f0_0f00_f00f;
    let x = (x | x << 4) & 0x0c30_c30c_30c3;
    (x | x << 2) & 0x2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice(n: u16) -> Vec<[u16; 3]> {
        (0..n * n).map(|i| [i % n * 256, i / n * 256, 7]).collect()
    }

    #[test]
    fn spread_puts_bits_three_apart() {
        assert_eq!(spread(0xffff), (0..16).fold(0, |m, i| m | 1 << (3 * i)));
        assert_eq!(morton(&[1, 2, 4]), 0b100_010_001);
    }

    #[test]
    fn every_point_once() {
        let l = levels(&lattice(100), &[17, 3], usize::MAX);
        let mut order = l.order.clone();
        assert_eq!(order[..2], [17, 3]);
        order.sort_unstable();
        assert!(order.iter().zip(0..10_000).all(|(a, b)| *a == b));
        assert_eq!(*l.ends.last().unwrap(), 10_000);
    }

    #[test]
    fn every_level_is_even() {
        let places = lattice(100);
        for limit in [usize::MAX, 6_000] {
            let l = levels(&places, &[], limit);
            for end in l.ends {
                let left = l.order[..end].iter().filter(|i| places[**i as usize][0] < 50 * 256).count();
                assert!((left as f64 / end as f64 - 0.5).abs() < 0.03, "{left} of {end}");
            }
        }
    }

    #[test]
    fn a_limit_keeps_the_kept() {
        let l = levels(&lattice(100), &[9_999], 500);
        assert_eq!(l.order[0], 9_999);
        assert!((500..=501).contains(&l.order.len()));
    }
}
