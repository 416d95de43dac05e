//! Sections: the lines, arcs and curves of a row of points, and the places where they join.
//!
//! | file | what |
//! |---|---|
//! | `row` | rows as they come: what is wrong with them |
//! | `stray`, `without` | points that belong to no contour, as header rows and fillers; the row without them |
//! | `direction` | the end that a row is measured from |
//! | `levels` | the partition that the search begins with, at one level of noise or several |
//! | `begin` | models that the search begins with: lines and arcs with a common tangent |
//! | `start`, `partition` | noise; independent lines and arcs by dynamic programming |
//! | `chain`, `free` | pieces that join with a common tangent, as curvature along the length |
//! | `least` | their least-squares fit |
//! | `criterion`, `base`, `search`, `smooth` | number and kinds of pieces |
//! | `near`, `blocks` | long chains by pieces near each other; long rows by blocks of points |
//! | `polygon`, `exact` | rows that are polygons, or lines and arcs tangent to them, exactly |
//! | `vertices`, `told` | rows of the ends of lines and the vertices of arcs |
//! | `corners` | rows of the corners of a polygon |
//! | `resolved`, `kept` | rows of curves without noise, as B-splines between corners; B-splines that keep to points |
//! | `profile` | intervals of the joins |
//! | `paper` | one line and one curve by the steps of a paper |
//! | `slab`, `order`, `cells`, `link`, `untangle`, `walls` | points of a cloud near a plane; put in order; their ways linked over gaps; short stretches; both faces of thin walls |
//! | `bent` | slabs across which a surface bends |
//! | `cut`, `stack` | where a plane cuts a mesh; which facets each of many planes may cut |
//! | `facets`, `sheet`, `tessellated` | what the facets of a mesh tell exactly; contours of exact lines and arcs; of a mesh's sections |
//! | `foot` | where on a segment the foot of a point is |
//! | `dimension` | angles, widths, distances of centers, gaps |
//! | `airfoil` | chord, camber, thickness and edges of a profile |
//! | `chords` | its chord by each of the usual definitions |
//! | `crossings` | places where a contour crosses itself |
//! | `joined` | outlines of the segments of a drawing |
//! | `free_row` | rows of free forms, as one curve |
//! | `nominal` | distances from the section of a nominal |
//! | `onto` | the best fit onto that |
//! | `tidy` | relations and whole numbers that the points allow, as offers |
//! | `budget` | how long the searches of a row may take |
//! | `plan`, `task`, `span`, `doubt`, `blunt` | corners, chains between them; corners that are none, and that chains pass over |
//! | `contour`, `convert` | the contour as lines, arcs and B-splines |

#![allow(clippy::needless_range_loop, reason = "matrices are read by row and column")]

mod airfoil;
mod along;
mod assembly;
mod base;
mod begin;
mod bent;
mod blocks;
mod blunt;
mod budget;
mod cells;
mod chain;
mod chords;
mod contour;
mod convert;
mod corner;
mod corners;
mod covered;
mod criterion;
mod crossings;
mod cut;
mod dimension;
mod direction;
mod doubt;
mod edge_chain;
mod exact;
mod facets;
mod flat;
mod follow;
mod foot;
mod free;
mod free_row;
mod joined;
mod kept;
mod least;
mod levels;
mod link;
mod near;
mod nominal;
mod onto;
mod order;
mod paper;
mod partition;
mod plan;
mod polygon;
mod prior;
mod profile;
mod resolved;
mod result;
mod row;
mod scan;
mod search;
mod sheet;
mod slab;
mod smooth;
mod span;
mod stack;
mod start;
mod stray;
mod task;
mod tessellated;
#[cfg(test)]
mod tests;
mod tidy;
mod told;
mod untangle;
mod vertices;
mod walls;
mod without;

pub use airfoil::{Airfoil, AirfoilError, EdgeRadius, TrailingEdge, airfoil};
pub use bent::{Bent, bent_across};
pub use chain::SegmentKind;
pub use chords::{Chord, Chords, chords, outline_row};
pub use contour::contour;
pub use covered::{Covered, Passed, covered};
pub use crossings::crossings;
pub use cut::{Chain, Plane, PlaneFrame, area, cut, cut_facets};
pub use dimension::{Dimension, DimensionKind, dimensions};
pub use foot::SegmentFoot;
pub use joined::joined;
pub use nominal::{OffNominal, Outline, off_nominal, with_material_inside};
pub use onto::{Free, Freedom, OntoNominal, OntoNominalError, PlaneMotion, onto_nominal};
pub use order::{Order, Ordered, order};
pub use paper::{Method, Search, line_and_curve, method_contour};
pub use result::{Continuity, Contour, Geometry, Join, Options, SectionError, Segment, Taken, Uncertainty};
pub use scan::CutMesh;
pub use slab::{ordered_contour, slab};
pub use stack::facets_near;
pub use tessellated::chain_contour;
pub use tidy::{Offer, OfferKind, Untidied, tidy};
