//! Measured points that a feature leaves out as too far off, although they lie where the reference has it.
//!
//! A dent deeper than the extract distance is no part of its feature, and the feature is the better for it. Where the
//! reference is at hand, such points are told: those whose nearest place on it belongs to the feature. Without a reference those are told, of a
//! cloud, that lie over places of the feature where nothing of it was measured, or among its points; of a mesh see `deeper`.

use super::behind::behind;
use super::belonging::Belonging;
use super::data::{Data, Stop};
use super::found::Inspection;
use super::reference::ELSEWHERE;
use super::seed::Seeded;
use crate::characteristic::{LeftOut, Taken, Value};
use crate::plan::{Plan, Spec};
use crate::results::Verdict;
use std::collections::BTreeMap;
use trueness_geom::feature::{Nearness, Nominal, in_cloud};
use trueness_geom::progress::Progress;
use trueness_geom::space::{Aabb, Point, Vector, minus, times};
use trueness_geom::spatial::neighbors::{Neighbor, PointTree};

/// A place of the feature was not measured if no point is within so many mean spacings of it: the chance of that is one in a
/// million where points lie at random.
const GAP: f64 = 2.1;
/// A point beyond reach is a spike of the feature if so many of its points are nearer
const OWN: usize = 6;
/// than so many others beyond reach.
const OTHERS: usize = 3;

/// Tells the features which points they leave out; those of a mesh without a reference are known with its facets.
///
/// Cost: one look at each measured point for each feature, and a search for those over or below it.
pub(super) fn tell(
    plan: &Plan,
    data: &Data,
    seeds: &BTreeMap<usize, Seeded>,
    belonging: Option<&Belonging>,
    features: &mut [Taken],
    progress: &dyn Progress,
) -> Result<(), Stop> {
    let of = |n: usize| seeds.get(&n).map(|s| &s.nominal).or(plan.features[n].nominal.as_ref());
    let sought: Vec<usize> = (0..plan.features.len())
        .filter(|n| of(*n).is_some_and(|nominal| !matches!(nominal, Nominal::Edge { .. })))
        .filter(|n| !features[*n].points.is_empty() && !data.points.contains_key(n))
        .collect();
    for n in sought {
        let Some(nominal) = of(n) else { continue };
        let near = plan.features[n].near(nominal);
        let off = match (belonging, &data.measured) {
            (Some(belonging), _) => {
                let Some(own) = belonging.own(n) else { continue };
                // As far off the nominal surface as what is left out, not off the chords of the reference.
                let own_points = belonging.nearest.iter().zip(&belonging.measured.positions);
                let own_points = own_points.filter(|((face, _), _)| own.has_within(*face));
                let off = own_points.filter_map(|(_, p)| own.surface.distance(*p)).map(|(off, _)| off.abs());
                let mut off: Vec<f64> = off.filter(|off| *off > near.distance).collect();
                off.extend(behind(belonging, own, progress)?);
                off
            }
            (None, Some(cloud)) if cloud.faces.is_empty() => {
                over_gaps(&cloud.positions, &features[n].points, nominal, &near)
            }
            _ => vec![],
        };
        if !off.is_empty() {
            features[n].left_out = Some(LeftOut::of(&off, near.distance, belonging.is_some()));
        }
    }
    if progress.cancelled() { Err(Stop::Cancelled) } else { Ok(()) }
}

/// How far off the points of a cloud are that lie beyond the reach of a nominal, up to a tenth of the size of the cloud, over
/// places of it where nothing was measured or among its points, mm.
fn over_gaps(cloud: &[Point], taken: &[Point], nominal: &Nominal, near: &Nearness) -> Vec<f64> {
    let (Some(surface), Some(area)) = (nominal.surface(), nominal.area()) else { return vec![] };
    let farthest = ELSEWHERE * Aabb::of(cloud).diagonal();
    let wide = Nearness { distance: farthest.max(near.distance), margin: near.margin.max(0.0), ..*near };
    let Ok(found) = in_cloud(cloud, nominal, &wide) else { return vec![] };
    let height = |p: u32| cloud.get(p as usize).and_then(|p| Some((*p, surface.distance(*p)?)));
    let far: Vec<(Point, f64, Vector)> = found
        .points
        .iter()
        .filter_map(|p| height(*p))
        .filter(|(_, (off, _))| off.abs() > near.distance)
        .map(|(p, (off, way))| (p, off, way))
        .collect();
    if far.is_empty() {
        return vec![];
    }
    let own = PointTree::new(taken);
    let others: Vec<Point> = far.iter().map(|f| f.0).collect();
    let beyond = PointTree::new(&others);
    let gap = GAP * (area / taken.len() as f64).sqrt();
    let counts = |n: usize, (p, off, way): &(Point, f64, Vector)| {
        let foot = minus(*p, times(*off, *way));
        let is_gap = own.nearest(&foot).is_none_or(|(square, _)| square > gap * gap);
        let last = |n: Vec<Neighbor>, count: usize| n.get(count - 1).map_or(f64::INFINITY, |n| n.0);
        let reach = last(own.k_nearest(p, OWN, None), OWN);
        is_gap || last(beyond.k_nearest(p, OTHERS, Some(n as u32)), OTHERS) > reach
    };
    far.iter().enumerate().filter(|(n, f)| counts(*n, f)).map(|(_, f)| f.1.abs()).collect()
}

/// A verdict, and what is to be said of the points that were left out.
pub(super) struct Judged {
    pub verdict: Verdict,
    pub notes: Vec<String>,
}

/// The verdict of a characteristic that was reached without the points which its features, its datums and what they are derived
/// from leave out; `with_others` is the value, and its verdict, with those of which it is not certain that they are of other surfaces.
///
/// What lies where the feature is and was not judged leaves no pass: nothing is proven by the others alone. Where the verdict depends on
/// points of which it is not certain whose they are, there is none.
pub(super) fn judge_left_out(
    plan: &Plan,
    found: &Inspection,
    spec: &Spec,
    judged: Verdict,
    with_others: Option<(&Result<Value, String>, Verdict)>,
) -> Judged {
    let mut result = Judged { verdict: judged, notes: vec![] };
    if judged == Verdict::NotMeasured {
        return result;
    }
    let features: Vec<&Taken> =
        spec.numbers(&plan.features).into_iter().map(|n| &found.features[n]).collect();
    for (taken, out) in features.iter().filter_map(|t| Some((t, t.left_out?))) {
        let where_to = if out.on_reference {
            "lie where the reference has it"
        } else {
            "lie where nothing else of it was measured"
        };
        result.notes.push(format!(
            "feature \"{}\": {} measured points, up to {:.3} mm off, {where_to} and are left out as farther than its extract \
             distance of {:.3} mm; give a larger one to judge them",
            taken.id, out.points, out.farthest, out.limit
        ));
        if judged == Verdict::Pass {
            result.verdict = Verdict::Undecided;
        }
    }
    for taken in features.iter().filter(|t| t.others.known > 0) {
        result.notes.push(format!(
            "feature \"{}\": {} points within its reach are of other surfaces of the reference and are left out",
            taken.id, taken.others.known
        ));
    }
    let Some((value, verdict)) = with_others else { return result };
    let mut known = false;
    for taken in features.iter().filter(|t| !t.others.points.is_empty()) {
        let count = taken.others.points.len();
        known |= taken.others.on_reference;
        let why = match (taken.others.on_reference, taken.facets.is_empty()) {
            (false, true) => "face another way and go on beyond it, as walls and bores do,",
            // Noise leaves some at every edge: they are told where they matter.
            _ if verdict == judged => continue,
            (true, true) => "are nearer to other surfaces of the reference, without lying on them,",
            (_, false) => {
                "lie where it is, but are joined to it by no facet that faces as it does, or are steep,"
            }
        };
        result.notes.push(format!(
            "feature \"{}\": {count} points within its reach {why} and are left out",
            taken.id
        ));
    }
    if verdict != judged {
        let value = match value {
            Ok(v) => format!("the value would be {}: {}", round(v.value), verdict.word()),
            Err(why) => format!("there would be no value: {why}"),
        };
        let remedy = if known { "" } else { "; a reference, or a margin that keeps them out, decides it" };
        result.notes.push(format!("with these points {value}{remedy}"));
        result.verdict = Verdict::Undecided;
    }
    result
}

/// To the micrometer.
pub(super) fn round(x: f64) -> f64 {
    (1e6 * x).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inspection::run;
    use crate::inspection::test_parts::{FLOOR, floor, plane_plan};
    use crate::results::inspect::{InspectDocument, PlanRecord};
    use trueness_geom::mesh::Mesh;
    use trueness_geom::progress::Silent;

    /// A spike that is higher than the extract distance does not pass where a lower one fails.
    #[test]
    fn a_deep_dent_passes_no_more_than_a_small_one() {
        let plan = plane_plan(FLOOR, (0.0, 0.1), "distance = 0.5", "");
        let cases = [
            (0.0, Verdict::Pass, None),
            (0.3, Verdict::Fail, None),
            (0.6, Verdict::Undecided, Some(1)),
            (-1.9, Verdict::Undecided, Some(1)),
            // Of something else.
            (9.0, Verdict::Pass, None),
        ];
        for (height, expected, left_out) in cases {
            for (cloud, with_reference) in [(false, true), (true, true), (false, false)] {
                let mut measured = floor(|_, _| 0.0);
                measured.positions[10 * 21 + 10][2] = height;
                if cloud {
                    measured.faces.clear();
                }
                let reference = with_reference.then(|| floor(|_, _| 0.0));
                let data = Data { measured: Some(measured), reference, ..Data::default() };
                let found = run(&plan, data, &Silent).unwrap();
                assert_eq!(found.features[0].left_out.map(|l| l.points), left_out, "{height} {cloud}");
                let record = PlanRecord { path: String::new(), sha256: None };
                let document = InspectDocument::new(&plan, record, &found, vec![]);
                assert_eq!(document.verdict, expected, "{height} {cloud}");
                assert_eq!(document.characteristics[0].notes.is_empty(), left_out.is_none(), "{height}");
            }
        }
    }

    /// The wall of a bore of 40 sides, seen from its axis: from each of these heights with its radius to the next.
    fn bore(profile: &[[f64; 2]]) -> Mesh {
        const TURNS: u32 = 40;
        let place = |[z, radius]: [f64; 2], k: u32| {
            let turn = std::f64::consts::TAU * f64::from(k) / f64::from(TURNS);
            [radius * libm::cos(turn), radius * libm::sin(turn), z]
        };
        let positions = profile.iter().flat_map(|ring| (0..TURNS).map(|k| place(*ring, k))).collect();
        let rows = (1..profile.len() as u32).flat_map(|row| (0..TURNS).map(move |k| (row * TURNS, k)));
        let square = |(above, k): (u32, u32)| {
            let [a, b] = [k, (k + 1) % TURNS];
            let [low, high] = [above - TURNS, above];
            [[low + a, high + a, low + b], [low + b, high + a, high + b]]
        };
        Mesh { positions, faces: rows.flat_map(square).collect() }
    }

    /// A neck about as far off as the extract distance is within it or farther, never neither.
    #[test]
    fn a_neck_at_the_extract_distance_is_not_lost() {
        let plan = Plan::parse(
            r#"
            schema = "trueness/plan/1"
            measured = "part.stl"
            [[feature]]
            id = "B"
            shape = "cylinder"
            internal = true
            extract = { distance = 0.4 }
            nominal = { point = [0, 0, 0], direction = [0, 0, 1], radius = 6, length = 20 }
            [[characteristic]]
            id = "1"
            kind = "cylindricity"
            feature = "B"
            tolerance = 0.1
            "#,
        )
        .unwrap();
        let reference = bore(&[[0.0, 6.0], [10.0, 6.0], [20.0, 6.0]]);
        let verdict = |off: f64| {
            let neck = [[12.0, 6.0], [12.0, 6.0 - off], [14.0, 6.0 - off], [14.0, 6.0]];
            let measured = bore(&[&[[0.0, 6.0]], &neck[..], &[[20.0, 6.0]]].concat());
            let data =
                Data { measured: Some(measured), reference: Some(reference.clone()), ..Data::default() };
            let record = PlanRecord { path: String::new(), sha256: None };
            InspectDocument::new(&plan, record, &run(&plan, data, &Silent).unwrap(), vec![]).verdict
        };
        assert_eq!(verdict(0.0), Verdict::Pass);
        for off in [0.39, 0.398, 0.399, 0.3999, 0.39999] {
            assert_eq!(verdict(off), Verdict::Fail, "{off}");
        }
        assert_ne!(verdict(0.4), Verdict::Pass);
        for off in [0.40001, 0.4001, 0.401, 0.402, 0.41] {
            assert_eq!(verdict(off), Verdict::Undecided, "{off}");
        }
    }
}
