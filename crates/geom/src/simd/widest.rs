//! Loops over arrays for wide registers: the compiler makes vectors of them.
//!
//! Only operations that IEEE 754 rounds alike everywhere may stand in such a loop, in one order (a sum in a fixed number of
//! parts). The compiler neither reorders nor fuses them, so all levels give the same bits. Closures that are not inlined are
//! compiled for any processor: inner loops stand in the body itself or in functions that are always inlined.

/// Compiles `$body` twice, for wide registers with fused multiply-add and for any processor, and takes what this processor has
/// within the limit of [`Level`](crate::simd::Level).
#[macro_export]
macro_rules! widest {
    ($(#[$attribute:meta])* fn $name:ident [$($generics:tt)*] [$($use:tt)*] ($($arg:ident : $type:ty),* $(,)?) $(-> $out:ty)? = $body:expr) => {
        $(#[$attribute])*
        #[allow(unsafe_code)] // one call into code compiled for processor features that were asked for
        fn $name<$($generics)*>($($arg: $type),*) $(-> $out)? {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx2,fma")]
                fn wide<$($generics)*>($($arg: $type),*) $(-> $out)? { $body }
                if $crate::simd::Level::detect() >= $crate::simd::Level::Avx2 {
                    // SAFETY: the processor was just asked for both features.
                    return unsafe { wide::<$($use)*>($($arg),*) };
                }
            }
            $body
        }
    };
}
pub use widest;
