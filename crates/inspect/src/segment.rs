//! What a report draws of a segmentation.

mod view;

pub use view::View;
pub(crate) use view::{cut_out, rim};
