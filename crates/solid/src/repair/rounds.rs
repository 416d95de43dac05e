//! Going through the steps until nothing is left to do, from the start or from a state on the way.
//!
//! Where the steps end worse than they began, they are gone through again without one of them. Everything is as it was
//! until that one first changed something. So the state before it is kept, and the rest is done again from there.

use super::error::RepairError;
use super::state::State;
use super::step::{Removes, Step};
use super::work::Work;
use crate::arrange::ArrangeError;

/// How often the steps are gone through at most. Two or three rounds are usual; a defect that is left then is beyond it.
pub(super) const MAX_ROUNDS: usize = 8;
/// States of larger meshes are not kept: their memory, some 100 bytes a facet each, is worth more than the time.
const MAX_FACETS_OF_KEPT_STATES: usize = 1_000_000;

/// A step and its function.
#[derive(Clone, Copy)]
pub(super) struct Entry {
    pub step: &'static Step,
    pub run: fn(&mut Work) -> Result<(), RepairError>,
}

/// A state on the way: before a step that then changed something for the first time.
pub(super) struct KeptState {
    pub state: State,
    step: &'static Step,
    pub position: StepPosition,
}

/// Where on the way a state is.
#[derive(Clone, Copy)]
pub(super) struct StepPosition {
    round: usize,
    /// The number of the next step in the list of all.
    step: usize,
    /// How many changes there were when the round began.
    done: usize,
}

impl StepPosition {
    pub(super) const START: StepPosition = StepPosition { round: 1, step: 0, done: 0 };
}

impl KeptState {
    /// The last state on the way, of those kept in its order, that none of these steps has changed; `None` where that
    /// cannot be told.
    pub(super) fn before<'k>(kept: &'k [KeptState], steps: &[&'static Step]) -> Option<&'k KeptState> {
        let all = steps.iter().all(|step| kept.iter().any(|k| k.step == *step));
        kept.iter().find(|k| all && steps.contains(&k.step))
    }
}

/// Goes through `steps`, with their numbers in the list of all, from `position` on until nothing is left to do. Returns
/// the end and the number of rounds. In `kept`, if given, the state before each step that changed something comes to
/// stand, once for each step.
pub(super) fn go_through<'a>(
    mut work: Work<'a>,
    steps: &[(usize, Entry)],
    mut position: StepPosition,
    mut kept: Option<&mut Vec<KeptState>>,
) -> Result<(Work<'a>, usize), RepairError> {
    let may_cut = steps.iter().any(|(_, entry)| entry.step.removes == Removes::Crossings);
    while position.round <= MAX_ROUNDS {
        for &(number, Entry { step, run }) in steps.iter().filter(|(number, _)| *number >= position.step) {
            let is_kept = work.mesh().faces.len() <= MAX_FACETS_OF_KEPT_STATES
                && kept.as_ref().is_some_and(|kept| kept.iter().all(|k| k.step != step));
            let before = is_kept.then(|| work.state.clone());
            run(&mut work)?;
            if let (Some(kept), Some(state)) = (&mut kept, before)
                && work.state.is_beyond(&state)
            {
                let position = StepPosition { step: number, ..position };
                kept.push(KeptState { state, step, position });
            }
        }
        // A tangle that two rounds have not undone gets no better.
        let idle = work.state.changes.len() == position.done;
        // Bodies whose union cannot be written stay whole.
        let is_close = matches!(work.state.handover.not_united, Some(ArrangeError::Unresolved { .. }));
        let round = position.round;
        position = StepPosition { round: round + 1, step: 0, done: work.state.changes.len() };
        if idle && !work.state.handover.may_cut_out && may_cut && !is_close {
            // Nothing else helps: the last resort, if there is anything to cut out.
            work.state.handover.may_cut_out = true;
            if work.crossings(|_, _| true)?.is_some_and(|pairs| !pairs.is_empty()) {
                continue;
            }
        }
        if idle || round > 1 && work.crossings(|_, _| true)?.is_none() {
            return Ok((work, round));
        }
    }
    Ok((work, MAX_ROUNDS))
}
