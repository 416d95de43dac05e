//! Points of a cloud near a plane, in order.
//!
//! | file | what |
//! |---|---|
//! | `slab`, `ways` | points near a plane; put in order |
//! | `cells`, `link`, `untangle` | their ways linked over gaps |
//! | `walls` | both faces of thin walls |
//! | `bent` | slabs across which a surface bends |

pub(super) mod bent;
mod cells;
mod link;
pub(super) mod slab;
mod untangle;
mod walls;
pub(super) mod ways;
