//! What lies near a feature that was not measured, but farther off than its extract distance.

use super::nominals::Nominals;
use super::parted::Parted;
use super::stop::Stop;
use super::{MeasuredFeature, extract_features};
use crate::characteristic::{NoElement, PointsBeyond};
use crate::plan::Plan;
use trueness_geom::feature::{Nearness, in_cloud};
use trueness_geom::progress::Progress;
use trueness_geom::scan::Scan;
use trueness_geom::space::Aabb;

/// How far off such points are looked for, as a share of the size of the feature.
const SEARCHED_SIZE_SHARE: f64 = 0.1;

/// Adds to the reasons of features that were not measured what lies over or below their places, up to a tenth of their size off: a
/// part that is off as a whole is not told from one without the face by "nothing was measured".
///
/// Cost: nothing where all was measured; else a look at each point for each feature that was not.
pub(super) fn add(
    plan: &Plan,
    measured: Option<&Scan>,
    nominals: &Nominals,
    parted: Option<&Parted>,
    features: &mut Vec<MeasuredFeature>,
    progress: &dyn Progress,
) -> Result<(), Stop> {
    let Some(scan) = measured else { return Ok(()) };
    let sought = |n: &usize| plan.features[*n].is_sought();
    let missing: Vec<usize> =
        (0..features.len()).filter(sought).filter(|n| features[*n].element.is_err()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let mut any = false;
    for n in missing {
        let Some(nominal) = nominals.of(n, &plan.features[n]) else {
            continue;
        };
        let near = plan.features[n].near(nominal);
        let wide = Nearness {
            distance: near.distance.max(SEARCHED_SIZE_SHARE * Aabb::of(&nominal.places()).diagonal()),
            ..near
        };
        if progress.cancelled() {
            return Err(Stop::Cancelled);
        }
        // Why it cannot be sought was told when it was.
        let Ok(found) = in_cloud(scan.points(), nominal, &wide) else { continue };
        let own = parted.and_then(|parted| Some((parted, parted.own(n)?)));
        let is_other = |p: &u32| own.is_some_and(|(parted, own)| parted.is_of_others(*p, own, nominal));
        let places = found.points.iter().filter(|p| !is_other(p));
        let places = places.filter_map(|p| scan.points().get(*p as usize));
        let off = |p: &_| Some(nominal.surface()?.distance(*p)?.0.abs());
        let beyond: Vec<f64> = places.filter_map(off).filter(|off| *off > near.distance).collect();
        if let (Some(beyond), Err(reason)) = (points_beyond(&beyond, near.distance), &mut features[n].element)
        {
            *reason = NoElement::Beyond { reason: Box::new(reason.clone()), beyond };
            any = true;
        }
    }
    if any {
        // What is made of them has their reasons.
        *features = extract_features::associated_anew(plan, features, |_| false, progress)?;
    }
    Ok(())
}

/// How many points lie so far off, beyond `limit`; `None` where there are none.
fn points_beyond(off: &[f64], limit: f64) -> Option<PointsBeyond> {
    let nearest = off.iter().copied().min_by(f64::total_cmp)?;
    let farthest = off.iter().copied().max_by(f64::total_cmp)?;
    Some(PointsBeyond { count: off.len(), nearest, farthest, limit })
}

#[cfg(test)]
mod tests {
    use crate::inspection::data::Data;
    use crate::inspection::run;
    use crate::inspection::test_parts::{FLOOR, floor, plane_plan};
    use trueness_geom::progress::Silent;

    #[test]
    fn a_face_that_is_off_is_told_with_the_setting_that_judges_it() {
        let line = "[[feature]]\nid = \"line\"\nderived = \"median-plane\"\nof = [\"A\", \"A\"]";
        let plan = plane_plan(FLOOR, (0.0, 0.1), "distance = 0.2, margin = 0", line);
        for cloud in [false, true] {
            let reasons = |height: f64, slope: f64| {
                let mut mesh = floor(|x, _| height + slope * x / 20.0);
                if cloud {
                    mesh.faces.clear();
                }
                let found =
                    run(&plan, Data { measured: Some(mesh.into()), ..Data::default() }, &Silent).unwrap();
                let reason = |n: usize| found.features[n].element.as_ref().err().map(ToString::to_string);
                assert_eq!(found.values[0].as_ref().err().is_some(), reason(0).is_some());
                [0, 1].map(reason)
            };
            assert_eq!(reasons(0.1, 0.0), [None, None]);
            let wanted = "; 441 points lie 0.300 to 0.600 mm off its place, farther than the `distance` of 0.200 mm in its `extract`: a \
                          larger one judges them";
            for reason in reasons(0.3, 0.3) {
                assert!(reason.as_ref().is_some_and(|r| r.ends_with(wanted)), "{cloud}: {reason:?}");
            }
            // Part of it is measured, too little.
            let [few, _] = reasons(0.15, 1.0);
            let few = few.unwrap();
            assert!(few.contains("; ") && few.contains(" to 1.150 mm off its place"), "{few}");
            // Nothing lies near.
            let [far, _] = reasons(5.0, 0.0);
            assert!(!far.unwrap().contains(';'), "{cloud}");
        }
    }
}
