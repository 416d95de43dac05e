//! The entries of the list of steps.

/// Surface that a step takes away so that the rest is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Removes {
    /// None: at most facets that lie twice, lie inside, are not finite, or were asked to go.
    Nothing,
    /// Facets that cross others, and the pieces that they cut off.
    Crossings,
    /// Open sheets that hang on nothing.
    Sheets,
    /// Sheets that hang on an edge where two other facets meet.
    Fins,
}

/// A step of the repair: an entry of [`STEPS`](super::STEPS). Two are equal when their names are.
#[derive(Debug)]
pub struct Step {
    /// Its name on the command line and in result documents.
    pub name: &'static str,
    /// Its effect, for the manual.
    pub about: &'static str,
    /// Surface that it takes away.
    pub removes: Removes,
}

impl PartialEq for Step {
    fn eq(&self, other: &Step) -> bool {
        self.name == other.name
    }
}
