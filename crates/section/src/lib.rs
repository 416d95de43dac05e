//! Sections: the lines, arcs and curves of a row of points, and the places where they join.
//!
//! Rooms, each on those above it:
//!
//! | room | what |
//! |---|---|
//! | `model` | contours; chains of pieces with common tangents, and their least-squares fit |
//! | `search` | the cheapest chain along points without corners: number and kinds of pieces, intervals of joins |
//! | `row` | the contour of a row: what is wrong with the row, its corners, the ways to a contour |
//! | `cut` | where planes cut a mesh; contours of drawings' facets and of scans |
//! | `measure` | angles, widths, airfoils, distances from a nominal, relations that the points allow |
//! | `order` | points of a cloud near a plane, in order |
//! | `paper` | one line and one curve by the steps of a paper |
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test does not hang on the last digit"))]
#![allow(clippy::needless_range_loop, reason = "matrices are read by row and column")]

mod cut;
mod measure;
mod model;
mod order;
mod paper;
mod row;
mod search;
#[cfg(test)]
mod tests;

pub use cut::plane::{Chain, area, cut, cut_facets};
pub use cut::scan::CutMesh;
pub use cut::stack::facets_near;
pub use cut::tessellated::chain_contour;
pub use measure::airfoil::{Airfoil, AirfoilError, EdgeRadius, TrailingEdge, airfoil};
pub use measure::chords::{Chord, Chords, chords, outline_row};
pub use measure::covered::{Covered, MatchedRow, covered};
pub use measure::dimension::{Dimension, DimensionKind, dimensions};
pub use measure::joined::joined;
pub use measure::nominal::{OffNominal, Outline, off_nominal, with_material_inside};
pub use measure::onto::{Free, Freedom, OntoNominal, OntoNominalError, PlaneMotion, onto_nominal};
pub use measure::tidy::{Offer, OfferKind, Untidied, tidy};
pub use model::chain::SegmentKind;
pub use model::crossings::crossings;
pub use model::foot::SegmentFoot;
pub use model::result::{
    Continuity, Contour, Geometry, Join, Options, RowKind, SectionError, Segment, Uncertainty,
};
pub use order::bent::{Bent, bent_across};
pub use order::slab::{ordered_contour, slab};
pub use order::ways::{Order, Ordered, order};
pub use paper::{Method, Search, line_and_curve, method_contour};
pub use row::contour::contour;
