//! Shells so small that they are likely dust: removed on request.

use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;
use trueness_geom::check;

pub(super) const STEP: Step = Step {
    name: "islands",
    about: "Removes shells with a diagonal below the given share of the whole (--remove-islands); without it, none.",
    removes: Removes::Nothing,
};

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    if work.options.islands.is_none() {
        return Ok(());
    }
    let dust = work.find(check::ISLANDS)?;
    if dust.is_empty() {
        return Ok(());
    }
    let known = work.known()?;
    let shell_of = &known.topology.shell_of;
    let mut size = vec![None; known.topology.shells];
    for finding in &dust {
        size[shell_of[finding.facets[0] as usize] as usize] = Some((finding.size, finding.position, 0));
    }
    let mut removed = vec![];
    for (f, &s) in (0..).zip(shell_of) {
        if let Some(Some((_, _, count))) = size.get_mut(s as usize) {
            *count += 1;
            removed.push(f);
        }
    }
    for (diagonal, place, count) in size.into_iter().flatten() {
        work.log(&STEP, "small shell removed", place, count, diagonal);
    }
    work.replace(&removed, &[]);
    Ok(())
}
