//! How much may be made of a file.
//!
//! What many entities share, such as the control points of a surface that has a thousand faces, is copied into each. Real files
//! share little; a file that is made to exhaust the memory shares everything.

use super::part21::{Entity, File, Wrong};
use std::cell::Cell;

/// Copies of each entity of a file, on the average.
const COPIES: usize = 16;
/// What a small file may make.
const LEAST: usize = 1 << 16;

/// What may still be copied: places, edges of loops, faces of shells.
pub(super) struct Budget(Cell<usize>);

impl Budget {
    /// That of a file.
    pub fn of(file: &File) -> Budget {
        Budget(Cell::new(LEAST + COPIES * file.count()))
    }

    /// Takes `count` from it.
    ///
    /// # Errors
    /// More than is left.
    pub fn spend(&self, count: usize, entity: &Entity) -> Result<(), Wrong> {
        match self.0.get().checked_sub(count) {
            Some(left) => {
                self.0.set(left);
                Ok(())
            }
            None => {
                self.0.set(0);
                Err(entity.wrong("is used so often that the model would not fit into memory"))
            }
        }
    }
}
