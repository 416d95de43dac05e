//! Comparing sixteen vertex numbers at once.
#![allow(unsafe_code, reason = "vendor intrinsics")]

use crate::closest::lanes::Plain;

/// Numbers compared together.
pub(crate) const W: usize = 16;

/// Sixteen numbers, aligned for vector loads.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Row<T>(pub [T; W]);

/// An instruction set that can compare a row of numbers with one number.
pub(crate) trait Same {
    /// Bit `i` is set where number `i` of `row` is `x`.
    ///
    /// # Safety
    /// The processor has the instructions.
    unsafe fn same(row: &Row<u32>, x: u32) -> u32;
}

impl Same for Plain<W> {
    #[inline(always)]
    unsafe fn same(row: &Row<u32>, x: u32) -> u32 {
        (0..W).fold(0, |m, i| m | u32::from(row.0[i] == x) << i)
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{Row, Same};
    use crate::closest::lanes_x86::{A16, Z16};
    use std::arch::x86_64::*;

    impl Same for A16 {
        #[inline(always)]
        unsafe fn same(row: &Row<u32>, x: u32) -> u32 {
            // SAFETY: the caller answers for AVX2; a row is 64 aligned bytes.
            unsafe {
                let (p, x) = (row.0.as_ptr().cast::<__m256i>(), _mm256_set1_epi32(x as i32));
                let half = |i: usize| {
                    let equal = _mm256_cmpeq_epi32(_mm256_load_si256(p.add(i)), x);
                    _mm256_movemask_ps(_mm256_castsi256_ps(equal)) as u32
                };
                half(0) | half(1) << 8
            }
        }
    }

    impl Same for Z16 {
        #[inline(always)]
        unsafe fn same(row: &Row<u32>, x: u32) -> u32 {
            // SAFETY: the caller answers for AVX-512F; a row is 64 aligned bytes.
            unsafe {
                let row = _mm512_load_si512(row.0.as_ptr().cast());
                u32::from(_mm512_cmpeq_epi32_mask(row, _mm512_set1_epi32(x as i32)))
            }
        }
    }
}
