//! Why a file was not read or written.

mod read;
mod write;

pub use read::{Fault, Place, ReadError};
pub(crate) use read::{Located, Result, quoted};
pub use write::{WriteError, WriteFault};
