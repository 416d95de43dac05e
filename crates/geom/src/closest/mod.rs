//! The point of a triangle mesh closest to each of many points: exactly, and fast.
//!
//! | task | where |
//! |---|---|
//! | prepare a mesh | [`Tree::build`] |
//! | closest place of one point | [`Tree::closest`] |
//! | distance of many points | [`Tree::distances`]; signed: [`Signs::distances`] |
//! | anything else of many points | [`Tree::for_each_closest`], [`Tree::map_closest`], then [`Tree::place`], [`Signs::sign`] |
//! | inside or outside of a mesh with holes | [`Winding`] |
//! | is the closest place on the rim? | [`BoundaryEdges`] |
//! | where a line through a point meets it | [`Tree::crossing`]; of many points [`Tree::map_crossings`] |
//! | the definition of the answers | [`brute::closest`], [`brute::crossing`] |
//!
//! "Exact" means the least, over all faces, of the distance to a face evaluated in double precision. Thin faces take twice that
//! precision, see `thin`. Ties go to the lowest face. It is off by no more than 2^-40 of the distance from the face's first
//! corner, mostly by 2^-52. The answer is the same bit for bit as that of trying all faces. The number of threads, the order of
//! the points, the instruction set and the shape of the triangles do not change it. A point farther than `max_distance` has no
//! answer, decided on the rounded distance.
//!
//! How it is fast, in the order in which a point meets it. `order` sorts the points along a space-filling curve. `query`
//! answers them in blocks of sixteen that go through the stages of `search` together, down the tree of `tree` and `build`.
//! `kernel` tests triangles in single precision, which may only say "cannot be nearer"; `triangle` decides in double. To answer
//! a stream, call for each block of it; blocks of 100,000 points and more cost nothing extra.

mod block;
pub mod brute;
mod build;
mod crossing;
mod decide;
mod edges;
mod frame;
mod hit;
mod kernel;
mod layout;
mod leaf_triangles;
mod limits;
mod line;
mod lockstep;
mod order;
mod prune;
mod query;
mod search;
mod segment;
mod sign;
mod solid_angle;
mod thin;
mod tree;
mod triangle;
mod winding;
mod window;

pub use crossing::Crossing;
pub use edges::BoundaryEdges;
pub use hit::Hit;
pub use limits::{
    MAX_COORDINATE, MAX_FACES, MAX_VERTEX, MIN_COORDINATE, MIN_EXTENT, MeshError, QueryError, sane,
};
pub use limits::{check_mesh, check_points, sane_vertex};
pub use query::Query;
pub use sign::Signs;
pub use tree::{Closest, Tree};
pub use triangle::Feature;
pub(crate) use triangle::{PointOfTriangle, closest_point, squared_distance};
pub use winding::Winding;

#[cfg(test)]
pub(crate) mod tests;
