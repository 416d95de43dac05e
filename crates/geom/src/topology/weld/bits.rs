//! Positions as bit patterns: what makes two of them one vertex.

use crate::space::Point;

/// Odd numbers with their bits spread evenly: products by them mix the bits of a key.
const HASH_MULTIPLIERS: [u64; 3] = [0x9E37_79B9_7F4A_7C15, 0xD1B5_4A32_D192_ED03, 0xBF58_476D_1CE4_E5B9];

fn finish(h: u64) -> u64 {
    (h ^ (h >> 32)).wrapping_mul(HASH_MULTIPLIERS[2])
}

pub trait Bits: Sized {
    /// With +0 for −0: adding zero does that and changes nothing else.
    fn normal(self) -> Self;
    /// Equality of the bits of normal positions.
    fn same(&self, other: &Self) -> bool;
    /// Hash of a normal position; the highest bits are the best.
    fn hash(&self) -> u64;
    fn point(self) -> Point;
}

impl Bits for [f32; 3] {
    #[inline(always)]
    fn normal(self) -> Self {
        self.map(|x| x + 0.0)
    }
    #[inline(always)]
    fn same(&self, other: &Self) -> bool {
        self.map(f32::to_bits) == other.map(f32::to_bits)
    }
    #[inline(always)]
    fn hash(&self) -> u64 {
        let [x, y, z] = self.map(|x| u64::from(x.to_bits()));
        finish((x | y << 32).wrapping_mul(HASH_MULTIPLIERS[0]) ^ z.wrapping_mul(HASH_MULTIPLIERS[1]))
    }
    fn point(self) -> Point {
        self.map(f64::from)
    }
}

impl Bits for [f64; 3] {
    #[inline(always)]
    fn normal(self) -> Self {
        self.map(|x| x + 0.0)
    }
    #[inline(always)]
    fn same(&self, other: &Self) -> bool {
        self.map(f64::to_bits) == other.map(f64::to_bits)
    }
    #[inline(always)]
    fn hash(&self) -> u64 {
        // Coordinates read from single precision end in zeros, so each is folded before it is multiplied.
        let [x, y, z] = self.map(|x| x.to_bits() ^ (x.to_bits() >> 29));
        finish(
            x.wrapping_mul(HASH_MULTIPLIERS[0])
                ^ y.wrapping_mul(HASH_MULTIPLIERS[1]).rotate_left(21)
                ^ z.wrapping_mul(HASH_MULTIPLIERS[2]).rotate_left(42),
        )
    }
    fn point(self) -> Point {
        self
    }
}
