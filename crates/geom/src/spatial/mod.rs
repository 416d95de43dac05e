//! Search among points and facets.

pub(crate) mod columns;
pub(crate) mod lists;
pub mod neighbours;
pub(crate) mod seen;
