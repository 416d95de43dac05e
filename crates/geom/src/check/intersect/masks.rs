//! Answers about eight lanes at once: they stay in vector registers until all that hangs on them has been put together.
#![allow(unsafe_code, reason = "vendor intrinsics")]

use super::tree::TREE_WIDTH;
use crate::simd::lanes::{Lanes, Plain};

/// Lanes with comparisons whose outcome is a vector.
pub(super) trait Masks: Lanes<TREE_WIDTH> {
    /// Yes or no, lane by lane.
    type Mask: Copy;
    /// `self <= o`
    fn at_most(self, o: Self) -> Self::Mask;
    /// Where `row` is `x`.
    ///
    /// # Safety
    /// The processor has the instructions.
    unsafe fn equal(row: &[u32; TREE_WIDTH], x: u32) -> Self::Mask;
    /// Where both say yes.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Where one says yes.
    fn either(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Bit `i` is set where lane `i` says yes.
    fn bits(mask: Self::Mask) -> u32;
}

impl Masks for Plain<TREE_WIDTH> {
    type Mask = u32;
    #[inline(always)]
    fn at_most(self, o: Self) -> u32 {
        self.le(o)
    }
    #[inline(always)]
    unsafe fn equal(row: &[u32; TREE_WIDTH], x: u32) -> u32 {
        (0..TREE_WIDTH).fold(0, |m, i| m | u32::from(row[i] == x) << i)
    }
    #[inline(always)]
    fn both(a: u32, b: u32) -> u32 {
        a & b
    }
    #[inline(always)]
    fn either(a: u32, b: u32) -> u32 {
        a | b
    }
    #[inline(always)]
    fn bits(mask: u32) -> u32 {
        mask
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    //! SAFETY of every intrinsic: the values were made by `splat` or `load`, whose caller answers for AVX2, as does that of
    //! `equal`.
    use super::{Masks, TREE_WIDTH};
    use crate::simd::lanes_x86::A8;
    use std::arch::x86_64::*;

    impl Masks for A8 {
        type Mask = __m256;
        #[inline(always)]
        fn at_most(self, o: Self) -> __m256 {
            unsafe { _mm256_cmp_ps::<_CMP_LE_OQ>(self.0, o.0) }
        }
        #[inline(always)]
        unsafe fn equal(row: &[u32; TREE_WIDTH], x: u32) -> __m256 {
            unsafe {
                let row = _mm256_loadu_si256(row.as_ptr().cast());
                _mm256_castsi256_ps(_mm256_cmpeq_epi32(row, _mm256_set1_epi32(x as i32)))
            }
        }
        #[inline(always)]
        fn both(a: __m256, b: __m256) -> __m256 {
            unsafe { _mm256_and_ps(a, b) }
        }
        #[inline(always)]
        fn either(a: __m256, b: __m256) -> __m256 {
            unsafe { _mm256_or_ps(a, b) }
        }
        #[inline(always)]
        fn bits(mask: __m256) -> u32 {
            unsafe { _mm256_movemask_ps(mask) as u32 }
        }
    }
}
