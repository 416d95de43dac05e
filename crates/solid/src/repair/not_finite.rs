//! Facets at no place.

use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;

pub(super) const STEP: Step = Step {
    name: "not_finite",
    about: "Removes facets with a coordinate that is NaN or infinite.",
    removes: Removes::Nothing,
};

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    let known = work.known()?;
    let facets = &known.topology.not_finite;
    if facets.is_empty() {
        return Ok(());
    }
    let bounds = known.properties.bounds;
    let middle = std::array::from_fn(|k| bounds.min[k] / 2.0 + bounds.max[k] / 2.0);
    work.log(&STEP, "facets removed", middle, facets.len(), 0.0);
    work.replace(facets, &[]);
    Ok(())
}
