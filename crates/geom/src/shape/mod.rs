//! Geometric elements: line, plane, circle, ellipse, sphere, cylinder, cone, torus, and what is made of them.
//!
//! | task | where |
//! |---|---|
//! | which kinds there are | [`Kind`] |
//! | parameters of an element, distance of a point from it | [`Shape`] |
//! | planes, lines, points, angles and distances made of others | [`derived`] |

pub mod derived;
pub(crate) mod ellipse;
mod kind;
mod shapes;

pub use kind::Kind;
pub(crate) use shapes::MOST_NUMBERS;
pub use shapes::{Parameter, Shape};
