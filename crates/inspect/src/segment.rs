//! What a report draws of a segmentation.

mod view;

pub use view::View;
