//! Whether what a repair left is still the same part.

use trueness_document::repair::Effect;
use trueness_solid::repair::{Deviation, NotEnclosed, Removes, Repaired};

/// Compares volume and surface with their limits; `volume` is that after the repair.
pub(super) fn record(
    repaired: &Repaired,
    volume: Option<f64>,
    deviation: Option<&Deviation>,
    limit: f64,
) -> Effect {
    let effect = &repaired.effect;
    let surface = surface(repaired, deviation);
    let surface_limit = limit * repaired.before.properties.bounds.diagonal();
    let enclosed = effect.enclosed.as_ref().ok();
    // What still crosses itself has a signed volume only. A body that looked inwards may have been turned or not.
    let sound = volume.filter(|_| repaired.after.sound);
    let change = enclosed.zip(sound).map(|(e, after)| {
        let [alone, with] = [after - e.volume, after - e.volume - e.inverted];
        if with.abs() < alone.abs() { with } else { alone }
    });
    let volume_limit = enclosed.map(|e| limit * (e.volume + e.inverted));
    let error = enclosed.map_or(0.0, |e| e.error);
    let beyond = |(change, limit): (f64, f64)| change.abs() + error > limit;
    let changed = change.zip(volume_limit).is_some_and(beyond) || surface.is_some_and(|x| x > surface_limit);
    Effect {
        changed: changed && !repaired.changes.is_empty(),
        bodies_before: effect.bodies[0] as u64,
        bodies_after: effect.bodies[1] as u64,
        volume_error: enclosed.map(|e| e.error),
        volume_inverted: enclosed.map(|e| e.inverted),
        volume_change: change,
        surface,
        limit,
        surface_limit,
        volume_limit,
    }
}

/// Share of the area that fins may have in all without being missed.
const MAX_FIN_AREA_SHARE: f64 = 0.1;
/// And loose sheets: flakes that hang on nothing. Parts of a model that are open have more.
const MAX_SHEET_AREA_SHARE: f64 = 0.01;

/// The largest distance that counts. Surface inside a body bounds nothing and may go. A hole has no surface: what fills it is
/// far from the old one, and what hung at its rim may go; but what was torn out because it crossed counts, and fins and sheets that
/// were removed count where together they were more than a trifle.
fn surface(repaired: &Repaired, deviation: Option<&Deviation>) -> Option<f64> {
    let deviation = deviation?;
    match &repaired.effect.enclosed {
        Ok(_) => repaired.effect.surface.map(|x| x.max(deviation.back.max)),
        Err(reason @ (NotEnclosed::Open | NotEnclosed::Inconsistent)) => {
            let removed = |what: Removes| -> f64 {
                let share = |size: f64| size / repaired.before.properties.area;
                repaired.changes.iter().filter(|c| c.step.removes == what).map(|c| share(c.size)).sum()
            };
            let crossed = repaired.changes.iter().any(|c| c.step.removes == Removes::Crossings);
            let lost = repaired
                .effect
                .surface
                .filter(|_| crossed || removed(Removes::Sheets) > MAX_SHEET_AREA_SHARE);
            let fins = (removed(Removes::Fins) > MAX_FIN_AREA_SHARE).then_some(deviation.there.max);
            // Without a hole nothing is filled: what is new lies on the old surface, or counts.
            let new = (*reason == NotEnclosed::Inconsistent).then_some(deviation.back.max);
            [lost, fins, new].into_iter().flatten().reduce(f64::max)
        }
        Err(_) => Some(deviation.there.max.max(deviation.back.max)),
    }
}
