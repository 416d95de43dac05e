//! Memory: what there is, and what to say when there is none left.
#![expect(unsafe_code, reason = "an allocator is unsafe by its nature; this one passes everything on")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::io::Write;

/// The system's allocator. Where it has nothing left, the program ends with a plain word instead of a crash, and without
/// unfinished files.
pub struct Allocator;

// SAFETY: every call is passed on to the system's allocator as it came; what it returns is returned, or the program ends.
unsafe impl GlobalAlloc for Allocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise is passed on.
        there(unsafe { System.alloc(layout) }, layout.size())
    }
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        there(unsafe { System.alloc_zeroed(layout) }, layout.size())
    }
    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as above.
        there(unsafe { System.realloc(place, layout, size) }, size)
    }
    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(place, layout) }
    }
}

#[inline]
fn there(place: *mut u8, size: usize) -> *mut u8 {
    if place.is_null() {
        out_of_memory(size)
    }
    place
}

/// Says so and ends. Nothing here may need memory of any size: the text is put together on the stack.
#[cold]
fn out_of_memory(size: usize) -> ! {
    let mut text = [0u8; 256];
    let mut rest = &mut text[..];
    let _ = writeln!(
        rest,
        "trueness: not enough memory: {} MB more were asked for and refused; give it a smaller file, close other \
         programs, or use a machine with more memory",
        size.div_ceil(1_000_000)
    );
    let left = rest.len();
    let _ = std::io::stderr().write_all(&text[..text.len() - left]);
    trueness_files::remove_unfinished(false);
    std::process::exit(3)
}

/// Bytes that can be had without driving other programs out, where the system tells.
#[cfg(target_os = "linux")]
pub fn available() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|l| l.strip_prefix("MemAvailable:"))?;
    let free = line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)?;
    let number = |file: &str| std::fs::read_to_string(file).ok()?.trim().parse::<u64>().ok();
    // A container may have less than the machine.
    let limit = number("/sys/fs/cgroup/memory.max");
    let used = number("/sys/fs/cgroup/memory.current").unwrap_or(0);
    Some(limit.map_or(free, |limit| free.min(limit.saturating_sub(used))))
}

/// Elsewhere that is not known.
#[cfg(not(target_os = "linux"))]
pub fn available() -> Option<u64> {
    None
}
