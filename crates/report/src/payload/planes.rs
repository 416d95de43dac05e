//! Integers near their prediction as bytes that compress well.

use trueness_geom::parallel::{Loop, Source};

/// The differences `value - prediction` modulo 2^(8·`width`), as `width` planes of bytes, the lowest first. They are folded so that small
/// ones of either sign are small: 0, −1, 1, −2 become 0, 1, 2, 3.
pub fn pack(differences: Loop<impl Source<Item = i32>>, width: usize) -> Vec<u8> {
    let folded: Vec<u32> = differences.map(|d| fold(d, width)).collect();
    (0..width).flat_map(|plane| folded.iter().map(move |d| (d >> (8 * plane)) as u8)).collect()
}

fn fold(difference: i32, width: usize) -> u32 {
    let shift = 32 - 8 * width;
    let wrapped = (difference << shift) >> shift;
    ((wrapped << 1) ^ (wrapped >> 31)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::parallel::prelude::*;

    #[test]
    fn small_differences_are_small() {
        assert_eq!([0, -1, 1, -2, 2].map(|d| fold(d, 2)), [0, 1, 2, 3, 4]);
        // 65,535 apart is one apart on the circle of 16 bits.
        assert_eq!((fold(65_535, 2), fold(-65_535, 2), fold(32_767, 2)), (1, 2, 65_534));
        assert_eq!(fold((1 << 24) - 1, 3), 1);
    }

    #[test]
    fn planes_lie_one_after_the_other() {
        assert_eq!(pack([1, 256, -1].par_iter().copied(), 2), [2, 0, 1, 0, 2, 0]);
    }
}
