//! Which way is up.

/// The axis that points up in the standard views.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Up {
    /// The model's y axis; the front looks along −z.
    Y,
    /// The model's z axis; the front looks along +y.
    #[default]
    Z,
}
