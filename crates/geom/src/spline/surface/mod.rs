//! B-spline surfaces: tensor products.

mod bend;
mod bernstein;
mod cells;
mod closest;
mod degenerate;
mod foot_error;
mod line;
mod nurbs;
mod patches;
mod rational;
mod reach;
mod search;
mod tensor;
mod tessellate;
#[cfg(test)]
mod tests;
mod tree;

pub use bend::{Bend, Principal};
pub use closest::{SurfaceFoot, descend};
pub use degenerate::Degenerate;
pub use foot_error::FootError;
pub use nurbs::Nurbs;
pub use patches::Jet;
pub use patches::Patches;
pub use rational::RationalSurface;
pub use search::{FOOT_TOLERANCE, FootSearch, NearestFoot};
pub use tensor::{Direction, Surface};
pub use tessellate::Tessellation;
