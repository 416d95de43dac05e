//! The contour of a row of points: what is wrong with the row, its corners, and the ways to a contour.
//!
//! | file | what |
//! |---|---|
//! | `clean` | rows as they come: what is wrong with them |
//! | `direction` | the end that a row is measured from; contours turned round |
//! | `stray`, `without` | points that belong to no contour, as header rows and fillers; the row without them |
//! | `contour`, `candidate` | the ways to a contour, and which of those that they propose is taken |
//! | `chains`, `levels`, `plan` | the partition that the search begins with, at one level of noise or several; chains between its corners |
//! | `doubt`, `blunt` | corners that are none, and that chains pass over |
//! | `corner`, `convert`, `assembly` | where chains cross; the contour put together |
//! | `facets`, `sheet` | polygons: what facets and vertices tell exactly; contours of exact lines and arcs |
//! | `polygon`, `exact` | rows that are polygons, or lines and arcs tangent to them, exactly |
//! | `vertices`, `told` | rows of the ends of lines and the vertices of arcs |
//! | `corners` | rows of the corners of a polygon |
//! | `resolved`, `kept` | rows of curves without noise, as B-splines between corners; B-splines that keep to points |
//! | `free_row` | rows of free forms, as one curve |
//! | `shared` | noise that neighbors share |

mod assembly;
mod blunt;
mod candidate;
mod chains;
pub(super) mod clean;
pub(super) mod contour;
mod convert;
mod corner;
mod corners;
pub(super) mod direction;
mod doubt;
mod exact;
pub(super) mod facets;
mod free_row;
mod kept;
mod levels;
mod plan;
mod polygon;
mod resolved;
mod shared;
pub(super) mod sheet;
mod stray;
mod told;
pub(super) mod vertices;
mod without;
