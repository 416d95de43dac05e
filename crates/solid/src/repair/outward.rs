//! Closed shells that look the wrong way.

use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;
use trueness_geom::check;

pub(super) const STEP: Step = Step {
    name: "outward",
    about: "Turns closed shells over that are inside out, with those inside them: what they enclose is no material. A shell that \
            looks inwards inside material bounds a cavity and stays. Decided exactly.",
    removes: Removes::Nothing,
};

pub(super) fn run(work: &mut Work) -> Result<(), RepairError> {
    let mut wrong = work.find(check::INSIDE_OUT_SHELLS)?;
    // In material that a shell lies in already, turning it would make a cavity of it.
    wrong.retain(|finding| finding.measures.iter().all(|(name, x)| *name != "depth" || *x <= 0.0));
    if wrong.is_empty() {
        return Ok(());
    }
    let known = work.known()?;
    let shell_of = &known.topology.shell_of;
    let mut turn = vec![false; known.topology.shells];
    let mut count = vec![0; known.topology.shells];
    for &shell in shell_of.iter().filter(|s| **s != u32::MAX) {
        count[shell as usize] += 1;
    }
    for finding in wrong {
        let shell = shell_of[finding.facets[0] as usize] as usize;
        turn[shell] = true;
        work.log(&STEP, "shell turned over", finding.position, count[shell], finding.size);
    }
    let facets = (0..).zip(shell_of).filter(|(_, s)| turn.get(**s as usize) == Some(&true)).map(|(f, _)| f);
    work.turn(facets);
    Ok(())
}
