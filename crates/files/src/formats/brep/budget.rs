//! How much may be made of a file.
//!
//! What many entities share, such as the control points of a surface that has a thousand faces, is copied into each. Real files
//! share little; a file that is made to exhaust the memory shares everything.

use super::{Faulty, Wrong};
use std::cell::Cell;

/// Copies of each entity of a file, on the average.
const COPIES: usize = 16;
/// What a small file may make.
const LEAST: usize = 1 << 16;

/// What may still be copied: places, edges of loops, faces of shells.
pub(crate) struct Budget(Cell<usize>);

impl Budget {
    /// That of a file of so many entities.
    pub fn of(entities: usize) -> Budget {
        Budget(Cell::new(COPIES.saturating_mul(entities).saturating_add(LEAST)))
    }

    /// Takes `count` from it.
    ///
    /// # Errors
    /// More than is left.
    pub fn spend(&self, count: usize, entity: &impl Faulty) -> Result<(), Wrong> {
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
