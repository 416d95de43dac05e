//! The lines of a text.

use std::cell::OnceCell;

/// A text whose line breaks are counted once, when first a line is asked for.
pub(super) struct Lines<'t> {
    pub text: &'t [u8],
    /// Line breaks before each block of the text.
    before: OnceCell<Vec<u64>>,
}

/// Bytes of a block.
const BLOCK: usize = 1 << 12;

impl<'t> Lines<'t> {
    pub fn new(text: &'t [u8]) -> Lines<'t> {
        Lines { text, before: OnceCell::new() }
    }

    /// The line in which this byte lies, from 1.
    pub fn line(&self, at: usize) -> u64 {
        let blocks = self.before.get_or_init(|| {
            let mut sum = 0;
            let count = |block: &[u8]| {
                let before = sum;
                sum += memchr::memchr_iter(b'\n', block).count() as u64;
                before
            };
            self.text.chunks(BLOCK).map(count).collect()
        });
        // At the end of the text the last block counts whole.
        let block = (at / BLOCK).min(blocks.len().saturating_sub(1));
        let before = blocks.get(block).copied().unwrap_or_default();
        let rest = self.text.get(block * BLOCK..at).unwrap_or_default();
        1 + before + memchr::memchr_iter(b'\n', rest).count() as u64
    }
}
