//! Contours and chains, and how chains are fitted.
//!
//! | file | what |
//! |---|---|
//! | `flat` | places and directions in the plane |
//! | `result` | contours: segments, joins, options, errors |
//! | `foot` | where on a segment the foot of a point is |
//! | `crossings` | places where a contour crosses itself |
//! | `chain`, `free` | pieces that join with a common tangent, as curvature along the length |
//! | `least`, `is_followed` | their least-squares fit; whether they run along their points |
//! | `criterion` | what a chain costs |
//! | `prior` | what is known of the noise |
//! | `budget` | how long the searches of a row may take |

pub(super) mod budget;
pub(super) mod chain;
pub(super) mod criterion;
pub(super) mod crossings;
pub(super) mod flat;
pub(super) mod foot;
pub(super) mod free;
mod is_followed;
pub(super) mod least;
pub(super) mod prior;
pub(super) mod result;
