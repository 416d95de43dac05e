//! Search among points and facets.

pub(crate) mod columns;
pub(crate) mod lists;
pub mod neighbors;
pub(crate) mod seen;
