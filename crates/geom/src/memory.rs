//! Large arrays for the inner loops: zero until written, in large pages where the system has them.
//!
//! On meshes of a million facets a third of the time of a weld goes into page faults. Asking for large pages saves most of it.
#![expect(
    unsafe_code,
    reason = "advice to the system and the processor about memory, and arrays of atomics without a pass over them"
)]

use std::sync::atomic::AtomicU32;

#[cfg(target_os = "linux")]
unsafe extern "C" {
    fn madvise(at: *mut u8, length: usize, advice: i32) -> i32;
}

/// Bytes of a page of memory.
pub(crate) const PAGE_BYTES: usize = 4096;

/// `v` itself, with the advice to keep it in large pages. Useful only before the memory is first touched.
pub(crate) fn large_pages<T>(v: Vec<T>) -> Vec<T> {
    #[cfg(target_os = "linux")]
    {
        /// Bytes from which on large pages are asked for: the size of one.
        const MIN_HUGE_BYTES: usize = 1 << 21;
        /// The advice `MADV_HUGEPAGE` of `madvise`.
        const MADV_HUGEPAGE: i32 = 14;
        let (at, bytes) = (v.as_ptr() as usize, v.capacity() * size_of::<T>());
        let (from, to) = (at.next_multiple_of(PAGE_BYTES), (at + bytes) / PAGE_BYTES * PAGE_BYTES);
        if bytes >= MIN_HUGE_BYTES {
            // SAFETY: whole pages within one live allocation; this advice changes no content.
            unsafe { madvise(from as *mut u8, to - from, MADV_HUGEPAGE) };
        }
    }
    v
}

/// `n` zeros that the system has not yet had to clear.
pub(crate) fn atomics(n: usize) -> Vec<AtomicU32> {
    let mut v = std::mem::ManuallyDrop::new(large_pages(vec![0u32; n]));
    // SAFETY: AtomicU32 has the size and alignment of u32, every bit pattern is valid, and `v` is not dropped.
    unsafe { Vec::from_raw_parts(v.as_mut_ptr().cast(), v.len(), v.capacity()) }
}

/// The numbers of `v`, three by three; a remainder of one or two is dropped.
pub(crate) fn triples(v: Vec<AtomicU32>) -> Vec<[u32; 3]> {
    let mut v = std::mem::ManuallyDrop::new(v);
    let (length, capacity) = (v.len() / 3, v.capacity() / 3);
    if !v.capacity().is_multiple_of(3) {
        let v = std::mem::ManuallyDrop::into_inner(v);
        return v
            .as_chunks::<3>()
            .0
            .iter()
            .map(|t| t.each_ref().map(|x| x.load(std::sync::atomic::Ordering::Relaxed)))
            .collect();
    }
    // SAFETY: three atomics have the size and alignment of [u32; 3]. The capacity is a whole number of triples, so the
    // allocation's layout is that of the new vector; `v` is not dropped.
    unsafe { Vec::from_raw_parts(v.as_mut_ptr().cast(), length, capacity) }
}

/// Asks for `x` to be near when it is needed.
#[inline(always)]
pub(crate) fn prefetch<T>(x: &T) {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: a prefetch never faults.
    unsafe {
        std::arch::x86_64::_mm_prefetch::<{ std::arch::x86_64::_MM_HINT_T0 }>(std::ptr::from_ref(x).cast());
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = x;
}

/// A pointer through which several threads write, each to places of its own.
pub(crate) struct Shared<T>(*mut T);

// SAFETY: the pointer is only handed out; whoever writes through it keeps the places apart.
unsafe impl<T: Send> Sync for Shared<T> {}

impl<T> Shared<T> {
    /// The places of `v`, up to its capacity.
    pub(crate) fn of(v: &mut Vec<T>) -> Shared<T> {
        Shared(v.as_mut_ptr())
    }
    /// Place `i`.
    #[inline(always)]
    pub(crate) fn at(&self, i: usize) -> *mut T {
        self.0.wrapping_add(i)
    }
}
