//! B-spline surfaces: tensor products.

mod bend;
mod closest;
mod patches;
mod rational;
mod tensor;
mod tessellate;
#[cfg(test)]
mod tests;

pub use bend::{Bend, Principal};
pub use closest::SurfaceFoot;
pub use patches::Patches;
pub use rational::RationalSurface;
pub use tensor::{Direction, Surface};
pub use tessellate::Tessellation;
