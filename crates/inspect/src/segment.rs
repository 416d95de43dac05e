//! What a report draws of a segmentation.

mod view;

pub use view::{View, color};
pub(crate) use view::{cut_out, rim};
