//! The CAD model of a STEP file: parts with exact faces, and where their instances stand.
//!
//! Read from the top: a representation has items in one context, which says their units; solids and shells among the items lead to
//! faces, edges and vertices; products and placements tell which representations stand where. A damaged entity costs the faces that
//! need it, which are told with entity, line and reason.

mod assembly;
mod curve;
mod face;
mod groups;
mod item;
mod links;
mod looks;
mod part;
mod placement;
mod read;
mod representation;
mod shape;
mod surface;
#[cfg(test)]
mod tests;
mod topology;

pub(crate) use read::read;
