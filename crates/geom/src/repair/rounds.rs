//! Going through the steps until nothing is left to do, from the start or from a state on the way.
//!
//! Where the steps end worse than they began, they are gone through again without one of them. Until that one first changed
//! something, everything is as it was: so the state before it is kept, and what follows is done again from there.

use super::error::RepairError;
use super::options::Options;
use super::self_intersections;
use super::step::Step;
use super::work::Work;
use crate::arrange::ArrangeError;
use crate::progress::Progress;

/// How often the steps are gone through at most. Two or three rounds are usual; what is not mended by then is beyond it.
pub(super) const ROUNDS: usize = 8;
/// Of larger meshes no states are kept: what they take of memory, some 100 bytes a facet each, is worth more than the time.
const MOST_FACETS: usize = 1_000_000;

/// A state on the way: before a step that then changed something for the first time.
pub(super) struct Kept<'a> {
    pub work: Work<'a>,
    name: &'static str,
    place: Place,
}

/// Where on the way a state is.
#[derive(Clone, Copy)]
pub(super) struct Place {
    round: usize,
    /// The number of the next step in the list of all.
    step: usize,
    /// How many changes there were when the round began.
    done: usize,
}

impl Place {
    pub(super) const START: Place = Place { round: 1, step: 0, done: 0 };
}

impl<'a> Kept<'a> {
    /// Of states in the order of the way the last one that none of these steps has changed; `None` where that cannot be told.
    pub(super) fn before<'k>(kept: &'k [Kept<'a>], steps: &[&'static str]) -> Option<&'k Kept<'a>> {
        let all = steps.iter().all(|name| kept.iter().any(|k| k.name == *name));
        kept.iter().find(|k| all && steps.contains(&k.name))
    }

    pub(super) fn place(&self) -> Place {
        self.place
    }
}

/// What keeps states on the way.
pub(super) struct Keeper<'a> {
    pub options: &'a Options,
    pub progress: &'a dyn Progress,
    pub kept: Vec<Kept<'a>>,
}

impl<'a> Keeper<'a> {
    /// The state before a step that has changed nothing so far.
    fn state(&self, work: &Work, name: &'static str) -> Option<Work<'a>> {
        let is_wanted = work.mesh().faces.len() <= MOST_FACETS && self.kept.iter().all(|k| k.name != name);
        is_wanted.then(|| work.copy(self.options, self.progress))
    }
}

/// Goes through `steps`, with their numbers in the list of all, from `place` on until nothing is left to do; how often.
pub(super) fn go_through(
    work: &mut Work,
    steps: &[(usize, &'static Step)],
    mut place: Place,
    mut keeper: Option<&mut Keeper>,
) -> Result<usize, RepairError> {
    let tears = steps.iter().any(|(_, s)| s.name == self_intersections::STEP.name);
    while place.round <= ROUNDS {
        for &(number, step) in steps.iter().filter(|(number, _)| *number >= place.step) {
            let state = keeper.as_ref().and_then(|keeper| keeper.state(work, step.name));
            (step.run)(work)?;
            if let (Some(keeper), Some(state)) = (&mut keeper, state)
                && work.is_beyond(&state)
            {
                keeper.kept.push(Kept {
                    work: state,
                    name: step.name,
                    place: Place { step: number, ..place },
                });
            }
        }
        // A tangle that two rounds have not undone gets no better.
        let idle = work.changes.len() == place.done;
        // Bodies whose union cannot be written stay whole.
        let is_close = matches!(work.not_united, Some(ArrangeError::Unresolved { .. }));
        let round = place.round;
        place = Place { round: round + 1, step: 0, done: work.changes.len() };
        if idle && !work.may_tear && tears && !is_close {
            // Nothing else helps: the last resort, if there is anything to tear out.
            work.may_tear = true;
            if work.crossings(|_, _| true)?.is_some_and(|pairs| !pairs.is_empty()) {
                continue;
            }
        }
        if idle || round > 1 && work.crossings(|_, _| true)?.is_none() {
            return Ok(round);
        }
    }
    Ok(ROUNDS)
}
