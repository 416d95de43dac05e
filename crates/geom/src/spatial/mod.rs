//! Search among points and facets.

pub(crate) mod columns;
pub mod lists;
pub mod neighbors;
pub(crate) mod seen;
