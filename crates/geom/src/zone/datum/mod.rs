//! Datums and datum systems: elements associated with measured features, and the frame that they make.
//!
//! ISO 5459:2011. A single datum is the situation feature of an ideal element associated with the feature. In a system the
//! second datum keeps the first one's attitude, the third keeps that of both. Planes by minimum zone touch the material from
//! outside; by least squares they lie amid the points. A common datum is made of several features at once.

mod associate;
mod attitude;
mod common;
mod error;
mod frame;
mod joint;
mod source;
mod system;

pub use attitude::{AS_DRAWN, Freedom, System};
pub use error::DatumError;
pub use source::{Datum, Rule, Source};
