//! Where the unit of a file comes from.

/// Where the unit of a file's numbers comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitFrom {
    /// [`ReadOptions::units`](crate::ReadOptions::units), or [`ReadOptions::unit_else`](crate::ReadOptions::unit_else).
    Option,
    /// The file: the names of its columns, or what a CAD file says of its unit.
    Header,
    /// Nowhere: millimeters are assumed.
    Assumed,
}

impl UnitFrom {
    /// `option`, `header` or `assumed`.
    pub const fn name(self) -> &'static str {
        match self {
            UnitFrom::Option => "option",
            UnitFrom::Header => "header",
            UnitFrom::Assumed => "assumed",
        }
    }
}
