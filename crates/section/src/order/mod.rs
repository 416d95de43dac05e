//! Points of a cloud near a plane, in order.
//!
//! | file | what |
//! |---|---|
//! | `slab`, `ways` | points near a plane; put in order |
//! | `cells`, `gaps`, `untangle` | their ways linked over gaps |
//! | `walls` | both faces of thin walls |
//! | `bent` | slabs across which a surface bends |

pub(super) mod bent;
mod cells;
mod gaps;
pub(super) mod slab;
mod untangle;
mod walls;
pub(super) mod ways;
