//! [`Lanes`] and [`Real`] in AVX2 and AVX-512.
//!
//! SAFETY of every intrinsic below: the value it works on was made by `splat` or `load`, whose caller answers for the processor
//! having the instructions. Loads and stores go through references to arrays of exactly their size.
#![expect(unsafe_code, reason = "vendor intrinsics")]

use crate::simd::lanes::{Lanes, Real};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Sub};

/// 8 lanes, AVX2.
#[derive(Clone, Copy)]
pub struct A8(pub(crate) __m256);
/// 16 lanes as two AVX2 registers.
#[derive(Clone, Copy)]
pub struct A16(A8, A8);
/// 16 lanes, AVX-512.
#[derive(Clone, Copy)]
pub struct Z16(__m512);
/// 4 doubles, AVX2.
#[derive(Clone, Copy)]
pub struct A4d(__m256d);
/// 8 doubles, AVX-512.
#[derive(Clone, Copy)]
pub struct Z8d(__m512d);

/// The four operators of a type, one instruction each.
macro_rules! operators {
    ($w:ident: $add:ident, $sub:ident, $mul:ident, $div:ident) => {
        operators!(@ $w Add add $add);
        operators!(@ $w Sub sub $sub);
        operators!(@ $w Mul mul $mul);
        operators!(@ $w Div div $div);
    };
    (@ $w:ident $op:ident $name:ident $intrinsic:ident) => {
        impl $op for $w {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                unsafe { $w($intrinsic(self.0, o.0)) }
            }
        }
    };
}
operators!(A8: _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps, _mm256_div_ps);
operators!(Z16: _mm512_add_ps, _mm512_sub_ps, _mm512_mul_ps, _mm512_div_ps);
operators!(A4d: _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd);
operators!(Z8d: _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd);

/// The four operators of two halves.
macro_rules! halved_operators {
    ($($op:ident $name:ident),*) => { $(
        impl $op for A16 {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                A16(self.0.$name(o.0), self.1.$name(o.1))
            }
        }
    )* };
}
halved_operators!(Add add, Sub sub, Mul mul, Div div);

/// Trait methods of two values that are one instruction each.
macro_rules! methods {
    ($w:ident: $($name:ident = $intrinsic:ident),*) => { $(
        #[inline(always)]
        fn $name(self, o: Self) -> Self {
            unsafe { $w($intrinsic(self.0, o.0)) }
        }
    )* };
}

/// For each mask of eight lanes the numbers of the set ones, a byte each. (PDEP and PEXT would make them, but are very slow
/// on processors before Zen 3.)
static SET_LANES: [u64; 256] = {
    let mut table = [0; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut n) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                table[mask] |= lane << (8 * n);
                n += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
};

impl Lanes<8> for A8 {
    methods!(A8: min = _mm256_min_ps, max = _mm256_max_ps);
    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        unsafe { A8(_mm256_set1_ps(x)) }
    }
    #[inline(always)]
    unsafe fn load(p: &[f32; 8]) -> Self {
        unsafe { A8(_mm256_loadu_ps(p.as_ptr())) }
    }
    #[inline(always)]
    fn keep(self, mask: u32) -> Self {
        unsafe {
            let bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
            let set = _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(mask as i32), bit), bit);
            A8(_mm256_and_ps(_mm256_castsi256_ps(set), self.0))
        }
    }
    #[inline(always)]
    fn store(self, out: &mut [f32; 8]) {
        unsafe { _mm256_storeu_ps(out.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        unsafe { A8(_mm256_fmadd_ps(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        unsafe { A8(_mm256_fnmadd_ps(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn le(self, o: Self) -> u32 {
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, o.0)) as u32 }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        unsafe { A8(_mm256_sqrt_ps(self.0)) }
    }
    #[inline(always)]
    fn least(self) -> f32 {
        unsafe {
            let h = _mm_min_ps(_mm256_castps256_ps128(self.0), _mm256_extractf128_ps::<1>(self.0));
            let h = _mm_min_ps(h, _mm_movehl_ps(h, h));
            _mm_cvtss_f32(_mm_min_ss(h, _mm_movehdup_ps(h)))
        }
    }
    #[inline(always)]
    fn zero_where_negative(self, s: Self) -> Self {
        unsafe { A8(_mm256_andnot_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(s.0, _mm256_setzero_ps()), self.0)) }
    }
    #[inline(always)]
    unsafe fn negative(p: &[i32; 8]) -> u32 {
        unsafe { _mm256_movemask_ps(_mm256_loadu_ps(p.as_ptr().cast())) as u32 }
    }
    #[inline(always)]
    unsafe fn compress(mask: u32, tag: i32, p: &[i32; 8], out: *mut [i32; 2]) {
        unsafe {
            let order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(SET_LANES[mask as usize & 255] as i64));
            let c = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(p.as_ptr().cast()), order);
            let t = _mm256_set1_epi32(tag);
            let (a, b) = (_mm256_unpacklo_epi32(t, c), _mm256_unpackhi_epi32(t, c));
            let out = out.cast::<__m256i>();
            _mm256_storeu_si256(out, _mm256_permute2x128_si256::<0x20>(a, b));
            _mm256_storeu_si256(out.add(1), _mm256_permute2x128_si256::<0x31>(a, b));
        }
    }
}

impl Lanes<16> for A16 {
    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        unsafe { A16(A8::splat(x), A8::splat(x)) }
    }
    #[inline(always)]
    unsafe fn load(p: &[f32; 16]) -> Self {
        unsafe { A16(A8(_mm256_loadu_ps(p.as_ptr())), A8(_mm256_loadu_ps(p.as_ptr().add(8)))) }
    }
    #[inline(always)]
    fn keep(self, mask: u32) -> Self {
        A16(self.0.keep(mask), self.1.keep(mask >> 8))
    }
    #[inline(always)]
    fn store(self, out: &mut [f32; 16]) {
        unsafe {
            _mm256_storeu_ps(out.as_mut_ptr(), self.0.0);
            _mm256_storeu_ps(out.as_mut_ptr().add(8), self.1.0);
        }
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        A16(self.0.mul_add(b.0, c.0), self.1.mul_add(b.1, c.1))
    }
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        A16(self.0.neg_mul_add(b.0, c.0), self.1.neg_mul_add(b.1, c.1))
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        A16(self.0.min(o.0), self.1.min(o.1))
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        A16(self.0.max(o.0), self.1.max(o.1))
    }
    #[inline(always)]
    fn le(self, o: Self) -> u32 {
        self.0.le(o.0) | self.1.le(o.1) << 8
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        A16(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn least(self) -> f32 {
        self.0.min(self.1).least()
    }
    #[inline(always)]
    fn zero_where_negative(self, s: Self) -> Self {
        A16(self.0.zero_where_negative(s.0), self.1.zero_where_negative(s.1))
    }
}

impl Lanes<16> for Z16 {
    methods!(Z16: min = _mm512_min_ps, max = _mm512_max_ps);
    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        unsafe { Z16(_mm512_set1_ps(x)) }
    }
    #[inline(always)]
    unsafe fn load(p: &[f32; 16]) -> Self {
        unsafe { Z16(_mm512_loadu_ps(p.as_ptr())) }
    }
    #[inline(always)]
    fn keep(self, mask: u32) -> Self {
        unsafe { Z16(_mm512_maskz_mov_ps(mask as __mmask16, self.0)) }
    }
    #[inline(always)]
    fn store(self, out: &mut [f32; 16]) {
        unsafe { _mm512_storeu_ps(out.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        unsafe { Z16(_mm512_fmadd_ps(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        unsafe { Z16(_mm512_fnmadd_ps(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn le(self, o: Self) -> u32 {
        unsafe { _mm512_cmp_ps_mask::<_CMP_LE_OQ>(self.0, o.0) as u32 }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        unsafe { Z16(_mm512_sqrt_ps(self.0)) }
    }
    #[inline(always)]
    fn least(self) -> f32 {
        unsafe { _mm512_reduce_min_ps(self.0) }
    }
    #[inline(always)]
    fn zero_where_negative(self, s: Self) -> Self {
        unsafe {
            let keep = _mm512_cmp_ps_mask::<_CMP_NLT_UQ>(s.0, _mm512_setzero_ps());
            Z16(_mm512_maskz_mov_ps(keep, self.0))
        }
    }
}

impl Real for A4d {
    type Mask = __m256d;
    const LANES: usize = 4;
    methods!(A4d: least = _mm256_min_pd, most = _mm256_max_pd);
    #[inline(always)]
    unsafe fn splat(x: f64) -> Self {
        unsafe { A4d(_mm256_set1_pd(x)) }
    }
    #[inline(always)]
    unsafe fn load(p: &[f64; 8]) -> Self {
        unsafe { A4d(_mm256_loadu_pd(p.as_ptr())) }
    }
    #[inline(always)]
    fn store(self, out: &mut [f64; 8]) {
        unsafe { _mm256_storeu_pd(out.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn above(self, o: Self) -> __m256d {
        unsafe { _mm256_cmp_pd::<_CMP_GT_OQ>(self.0, o.0) }
    }
    #[inline(always)]
    fn at_least(self, o: Self) -> __m256d {
        unsafe { _mm256_cmp_pd::<_CMP_GE_OQ>(self.0, o.0) }
    }
    #[inline(always)]
    fn both(a: __m256d, b: __m256d) -> __m256d {
        unsafe { _mm256_and_pd(a, b) }
    }
    #[inline(always)]
    fn select(m: __m256d, a: Self, b: Self) -> Self {
        unsafe { A4d(_mm256_blendv_pd(b.0, a.0, m)) }
    }
}

impl Real for Z8d {
    type Mask = __mmask8;
    const LANES: usize = 8;
    methods!(Z8d: least = _mm512_min_pd, most = _mm512_max_pd);
    #[inline(always)]
    unsafe fn splat(x: f64) -> Self {
        unsafe { Z8d(_mm512_set1_pd(x)) }
    }
    #[inline(always)]
    unsafe fn load(p: &[f64; 8]) -> Self {
        unsafe { Z8d(_mm512_loadu_pd(p.as_ptr())) }
    }
    #[inline(always)]
    fn store(self, out: &mut [f64; 8]) {
        unsafe { _mm512_storeu_pd(out.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn above(self, o: Self) -> __mmask8 {
        unsafe { _mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, o.0) }
    }
    #[inline(always)]
    fn at_least(self, o: Self) -> __mmask8 {
        unsafe { _mm512_cmp_pd_mask::<_CMP_GE_OQ>(self.0, o.0) }
    }
    #[inline(always)]
    fn both(a: __mmask8, b: __mmask8) -> __mmask8 {
        a & b
    }
    #[inline(always)]
    fn select(m: __mmask8, a: Self, b: Self) -> Self {
        unsafe { Z8d(_mm512_mask_blend_pd(m, b.0, a.0)) }
    }
}
