//! The tolerances of a STEP file (ISO 10303-242, -214; ISO 10303-47 and -519): datums, geometric tolerances, dimensions.
//!
//! Files tie a tolerance to an aspect of the shape, and aspects to others and to faces, by entities that point at both. All such
//! entities are therefore gathered first, in one pass ([`graph`]). What points nowhere is told with its tolerance.

mod datum;
mod dimension;
mod geometric;
mod graph;
mod target;
#[cfg(test)]
mod tests;

use super::part21::File;
use crate::formats::brep::Budget;
use trueness_cad::tolerances::Tolerances;

/// The tolerances of a file.
pub(super) fn read(file: &File, budget: &Budget) -> Tolerances {
    let graph = graph::Graph::of(file, budget);
    Tolerances {
        datums: datum::datums(&graph),
        geometric: geometric::tolerances(&graph),
        dimensions: dimension::dimensions(&graph),
    }
}
