//! Geometry of inspection: numbers in, numbers out. No files, no clock, no printing.
//!
//! | task | where |
//! |---|---|
//! | points, vectors, boxes | [`space`] |
//! | triangle meshes | [`mesh`] |
//! | point clouds in blocks | [`cloud`] |
//! | progress and cancellation | [`progress`] |

pub mod cloud;
pub mod mesh;
pub mod progress;
pub mod space;
