//! The cheapest chain of lines, arcs and free pieces along points without corners.
//!
//! | file | what |
//! |---|---|
//! | `start`, `partition` | noise; independent lines and arcs by dynamic programming |
//! | `begin`, `along` | models that a search begins with |
//! | `base`, `rounds`, `smooth` | models one step away, and the search over them |
//! | `known` | chains of parts that are known |
//! | `near`, `blocks` | long chains by pieces near each other; long rows by blocks of points |
//! | `profile` | intervals of the joins |
//! | `task`, `span` | the chain of a part of a row |

mod along;
mod base;
mod begin;
mod blocks;
mod gather;
mod known;
mod near;
pub(super) mod partition;
mod profile;
pub(super) mod rounds;
pub(super) mod smooth;
pub(super) mod span;
pub(super) mod start;
pub(super) mod task;
