//! Geometry of inspection: numbers in, numbers out. No files, no clock, no printing.
//!
//! | task | where |
//! |---|---|
//! | welding, edges, shells, soundness | [`topology`] |
//! | all defects of a mesh | [`check`] |
//! | closest points, distances, signs | [`closest`] |
//! | deviations from a reference | [`deviation`] |
//! | statistics of numbers with a sign | [`stats`] |
//! | a scan brought onto its reference | [`align`] |
//! | lines, planes, cylinders …: parameters, distances | [`shape`] |
//! | elements fitted to points | [`fit`] |
//! | elements found in a mesh or cloud | [`segment`] |
//! | noise of a scan, and how far neighbors share it | [`noise`] |
//! | the points of a scan parted among the faces of its nominal | [`partition`] |
//! | features found with the nominal | [`feature`] |
//! | tolerance zones, datum systems | [`zone`] |
//! | B-splines and NURBS | [`spline`] |
//! | points, vectors, boxes | [`space`] |
//! | triangle meshes | [`mesh`] |
//! | point clouds in blocks | [`cloud`] |
//! | what was measured: a mesh or a cloud | [`scan`] |
//! | planes, and coordinates in them | [`plane`] |
//! | rigid motions | [`rigid`] |
//! | neighbors among points | [`spatial`] |
//! | sums, random numbers | [`num`] |
//! | meshes for tests and examples | [`samples`] |
//! | instruction sets | [`simd`] |
//! | progress and cancellation | [`progress`] |
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test does not hang on the last digit"))]

pub mod align;
pub mod check;
pub mod closest;
pub mod cloud;
pub mod deviation;
pub mod feature;
pub mod fit;
mod frame;
mod memory;
pub mod mesh;
pub mod noise;
pub mod num;
pub mod parallel;
pub mod partition;
pub mod plane;
pub mod progress;
pub mod rigid;
pub mod samples;
pub mod scan;
pub mod segment;
pub mod shape;
pub mod simd;
pub mod space;
pub mod spatial;
pub mod spline;
pub mod stats;
pub mod topology;
pub mod zone;
