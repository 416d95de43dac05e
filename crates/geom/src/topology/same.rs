//! Comparing many vertex numbers at once.
#![allow(unsafe_code, reason = "vendor intrinsics")]

use crate::simd::lanes::Plain;

/// Numbers compared together.
pub(crate) const ROW_WIDTH: usize = 16;

/// Sixteen numbers, aligned for vector loads.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Row<T>(pub [T; ROW_WIDTH]);

/// An instruction set that can compare `N` numbers with one number.
pub(crate) trait Same<const N: usize> {
    /// Bit `i` is set where number `i` of `row` is `x`.
    ///
    /// # Safety
    /// The processor has the instructions.
    unsafe fn same(row: &[u32; N], x: u32) -> u32;
}

impl<const N: usize> Same<N> for Plain<N> {
    #[inline(always)]
    unsafe fn same(row: &[u32; N], x: u32) -> u32 {
        (0..N).fold(0, |m, i| m | u32::from(row[i] == x) << i)
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::Same;
    use crate::simd::lanes_x86::{A16, Z16};
    use std::arch::x86_64::*;

    impl Same<16> for A16 {
        #[inline(always)]
        unsafe fn same(row: &[u32; 16], x: u32) -> u32 {
            let halves = row.as_chunks::<8>().0;
            // SAFETY: the caller answers for AVX2.
            unsafe { half(&halves[0], x) | half(&halves[1], x) << 8 }
        }
    }

    #[inline(always)]
    unsafe fn half(row: &[u32; 8], x: u32) -> u32 {
        // SAFETY: the caller answers for AVX2.
        unsafe {
            let row = _mm256_loadu_si256(row.as_ptr().cast());
            let equal = _mm256_cmpeq_epi32(row, _mm256_set1_epi32(x as i32));
            _mm256_movemask_ps(_mm256_castsi256_ps(equal)) as u32
        }
    }

    impl Same<16> for Z16 {
        #[inline(always)]
        unsafe fn same(row: &[u32; 16], x: u32) -> u32 {
            // SAFETY: the caller answers for AVX-512F.
            unsafe {
                let row = _mm512_loadu_si512(row.as_ptr().cast());
                u32::from(_mm512_cmpeq_epi32_mask(row, _mm512_set1_epi32(x as i32)))
            }
        }
    }
}
