//! The cheapest chain of lines, arcs and free pieces along points without corners.
//!
//! | file | what |
//! |---|---|
//! | `parts`, `partition` | noise; independent lines and arcs by dynamic programming |
//! | `tangent_models`, `smooth_curve` | models that a search begins with |
//! | `model_edits`, `rounds`, `smooth` | models one step away, and the search over them |
//! | `known` | chains of parts that are known |
//! | `near`, `blocks` | long chains by pieces near each other; long rows by blocks of points |
//! | `profile` | intervals of the joins |
//! | `task`, `span` | the chain of a part of a row |

mod blocks;
mod gather;
mod known;
mod model_edits;
mod near;
pub(super) mod partition;
pub(super) mod parts;
mod profile;
pub(super) mod rounds;
pub(super) mod smooth;
mod smooth_curve;
pub(super) mod span;
mod tangent_models;
pub(super) mod task;
