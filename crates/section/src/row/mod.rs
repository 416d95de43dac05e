//! The contour of a row of points: faults of the row, its corners, and the ways to a contour.
//!
//! | file | what |
//! |---|---|
//! | `clean` | rows as they come: what is wrong with them |
//! | `direction` | the end that a row is measured from; contours turned round |
//! | `stray`, `without_strays` | points that belong to no contour, as header rows and fillers; the row without them |
//! | `contour`, `candidate` | the ways to a contour, and the choice among their proposals |
//! | `chains`, `noise_levels`, `corner_search` | the partition that the search begins with, at one level of noise or several; chains between its corners |
//! | `remove_corners`, `insert_corners` | corners that are none, and that chains pass over |
//! | `corner`, `convert`, `assembly` | where chains cross; the contour put together |
//! | `facets`, `sheet` | polygons: exact lines and arcs of facets and vertices; their contours |
//! | `polygon`, `exact` | rows that are polygons, or lines and arcs tangent to them, exactly |
//! | `vertices`, `evidence` | rows of the ends of lines and the vertices of arcs |
//! | `corners` | rows of the corners of a polygon |
//! | `resolved`, `spline_through_points` | rows of curves without noise, as B-splines between corners; B-splines that keep to points |
//! | `free_row` | rows of free forms, as one curve |
//! | `shared_noise` | noise that neighbors share |

mod assembly;
mod candidate;
mod chains;
pub(super) mod clean;
pub(super) mod contour;
mod convert;
mod corner;
mod corner_search;
mod corners;
pub(super) mod direction;
mod evidence;
mod exact;
pub(super) mod facets;
mod free_row;
mod insert_corners;
mod noise_levels;
mod polygon;
mod remove_corners;
mod resolved;
mod shared_noise;
pub(super) mod sheet;
mod spline_through_points;
mod stray;
pub(super) mod vertices;
mod without_strays;
