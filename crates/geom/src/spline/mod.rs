//! B-splines and NURBS.
//!
//! | task | where |
//! |---|---|
//! | what can be combined: points, vectors, mass points | [`value`] |
//! | interpolation by the pyramid of Neville, evaluation by that of de Boor | [`pyramid`] |
//! | knots, basis functions and their derivatives | [`basis`] |
//! | B-spline curves: evaluation, knots, degree, closest point, length, fit | [`curve`] |
//! | rational curves as curves of mass points | [`rational`] |
//! | B-spline and rational surfaces: evaluation, normals, curvatures, knots, closest point, facets | [`surface`] |
//! | the polynomials of the basis functions, span by span | [`spans`] |
//!
//! Sources: Piegl and Tiller, The NURBS Book, 2nd edition, 1997; Ramshaw, Blossoming, 1987, for everything about knots. A
//! control point is the blossom of consecutive knots, so insertion and elevation need no case of their own.

#![allow(clippy::needless_range_loop, reason = "knots, control points and basis functions are read by index")]

pub mod basis;
pub mod curve;
pub mod pyramid;
pub mod rational;
pub mod spans;
pub mod surface;
pub mod value;
