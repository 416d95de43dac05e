//! Geometric elements: line, plane, circle, ellipse, sphere, cylinder, cone, torus, and what is made of them.
//!
//! | task | where |
//! |---|---|
//! | which kinds there are, and what distances from them tell | [`Kind`], [`Sides`] |
//! | where its places lie, by two coordinates | [`Shape::frame`], [`Shape::coordinates`], [`Shape::at`] |
//! | parameters of an element, distance of a point from it | [`Shape`] |
//! | planes, lines, points, angles and distances made of others | [`derived`] |

pub mod derived;
pub(crate) mod ellipse;
mod kind;
mod shapes;

pub use kind::{Coordinate, Kind, Quantity, Sides};
pub(crate) use shapes::MAX_SHAPE_NUMBERS;
pub use shapes::{Parameter, Shape, axes_along};
