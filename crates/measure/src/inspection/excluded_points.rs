//! What a verdict is worth where a feature leaves points out.

use super::found::Inspection;
use crate::characteristic::{MeasuredFeature, NotMeasured, Others, Spec, Value};
use crate::plan::Plan;
use trueness_document::Verdict;

/// A verdict, and what is to be said of the points that were left out.
pub(super) struct Judged {
    pub verdict: Verdict,
    pub notes: Vec<String>,
}

/// The verdict of a characteristic that was reached without the points which its features, its datums and what they are derived
/// from leave out; `with_others` is the value, and its verdict, with those of which it is not certain that they are of other surfaces.
///
/// Where the verdict depends on points of which it is not certain whose they are, there is none.
pub(super) fn judge(
    plan: &Plan,
    found: &Inspection,
    spec: &Spec,
    judged: Verdict,
    with_others: Option<(&Result<Value, NotMeasured>, Verdict)>,
) -> Judged {
    let mut result = Judged { verdict: judged, notes: vec![] };
    if judged == Verdict::NotMeasured {
        return result;
    }
    let features: Vec<&MeasuredFeature> =
        spec.numbers(&plan.features).into_iter().map(|n| &found.features[n]).collect();
    for (taken, out) in features.iter().filter_map(|t| Some((t, t.left_out?))) {
        result.notes.push(format!(
            "feature \"{}\": {} measured points, up to {:.3} mm off, lie over it and are left out as farther than its extract \
             distance of {:.3} mm; give a larger one to judge them",
            taken.id, out.points, out.farthest, out.limit
        ));
    }
    let outliers = features.iter().filter(|t| t.others.outliers > 0);
    result.notes.extend(outliers.map(|taken| {
        format!(
            "feature \"{}\": {}, up to {:.3} mm off, stick out by themselves and are left out as outliers; with outliers = true they count",
            taken.id,
            points(taken.others.outliers),
            taken.others.farthest_outlier
        )
    }));
    let dents = features.iter().filter(|t| t.others.dents > 0);
    result.notes.extend(dents.map(|taken| {
        format!(
            "feature \"{}\": {} of it are in dents deeper than its extract distance, and count",
            taken.id,
            points(taken.others.dents)
        )
    }));
    let Some((value, verdict)) = with_others else { return result };
    // Noise and burrs leave some at every edge: they are told where they matter.
    if verdict == judged {
        return result;
    }
    for taken in features.iter().filter(|t| !t.others.points.is_empty()) {
        let why = not_certain(taken);
        result.notes.push(format!("feature \"{}\": {why}, and are left out", taken.id));
    }
    let value = match value {
        Ok(v) => format!("the value would be {}: {}", round(v.value), verdict.word()),
        Err(why) => format!("there would be no value: {why}"),
    };
    let known = features.iter().any(|t| t.others.on_reference);
    let remedy = if known { "a margin" } else { "a reference, or a margin," };
    result.notes.push(format!("with these points {value}; {remedy} that keeps them out decides it"));
    result.verdict = Verdict::Undecided;
    result
}

/// Why it is not certain that some points within the reach of a feature are of it.
fn not_certain(taken: &MeasuredFeature) -> String {
    let Others { broken, deep, high, between, far, drawn, .. } = &taken.others;
    let why = [
        (
            *broken,
            "along its edges are explained by no face, as burrs, grooves and chamfers that are not drawn",
        ),
        (*deep, "go on into the material beyond its extract distance"),
        (*high, "go on out of the material beyond its extract distance, as what stands on it"),
        (*between, "lie off it and off the other side of the wall, and may be of either"),
        (*far, "are of its surface, farther off than its extract distance"),
        (*drawn, "are corners of facets that face as it does and are of no face"),
    ];
    let told = why.iter().filter(|w| w.0 > 0).map(|(count, why)| format!("{} {why}", points(*count)));
    told.collect::<Vec<_>>().join("; ")
}

fn points(count: usize) -> String {
    if count == 1 { "1 point".into() } else { format!("{count} points") }
}

/// To the micrometer.
pub(super) fn round(x: f64) -> f64 {
    (1e6 * x).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inspection::data::Data;
    use crate::inspection::run;
    use crate::inspection::test_parts::{FLOOR, floor, plane_plan};
    use trueness_document::inspect::PlanRecord;
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
                let data = Data { measured: Some(measured.into()), reference, ..Data::default() };
                let found = run(&plan, data, &Silent).unwrap();
                assert_eq!(found.features[0].left_out.map(|l| l.points), left_out, "{height} {cloud}");
                let record = PlanRecord { path: String::new(), sha256: None };
                let document = crate::inspection::document(&plan, record, &found, vec![]);
                assert_eq!(document.verdict, expected, "{height} {cloud}");
                assert_eq!(document.characteristics[0].notes.is_empty(), left_out.is_none(), "{height}");
            }
        }
    }

    /// Of a scan one or two points that stick out by themselves are outliers, steeper than surfaces are; three together are form, and all are where the plan says so.
    #[test]
    fn spikes_of_a_scan_are_told_and_left_out() {
        let plans = ["", ", outliers = true"]
            .map(|more| plane_plan(FLOOR, (0.0, 0.1), &format!("distance = 2{more}"), ""));
        let spikes: [&[(usize, f64)]; 6] = [
            &[],
            &[(220, 1.5)],
            &[(220, 1.5), (221, 1.2), (60, -1.9)],
            &[(220, 1.5), (221, 1.5), (222, 1.5)],
            &[(220, 2.5)],
            // As flat as a surface may be that was hit once.
            &[(220, 0.3)],
        ];
        let pass = |outliers| (Verdict::Pass, outliers);
        let fail = (Verdict::Fail, 0);
        let expected = [
            [pass(0), pass(1), pass(3), fail, pass(1), fail],
            [pass(0), fail, fail, fail, (Verdict::Undecided, 0), fail],
        ];
        for (plan, expected) in plans.iter().zip(expected) {
            for (n, (spikes, (verdict, outliers))) in spikes.into_iter().zip(expected).enumerate() {
                for cloud in [false, true] {
                    let mut random = trueness_geom::num::random::Random::new(n as u64);
                    let mut measured = floor(|_, _| 0.0);
                    measured.positions.iter_mut().for_each(|p| p[2] = 0.004 * (random.unit() - 0.5));
                    spikes.iter().for_each(|(i, height)| measured.positions[*i][2] = *height);
                    if cloud {
                        measured.faces.clear();
                    }
                    let reference = Some(floor(|_, _| 0.0));
                    let data = Data { measured: Some(measured.into()), reference, ..Data::default() };
                    let found = run(plan, data, &Silent).unwrap();
                    assert_eq!(found.features[0].others.outliers, outliers, "{n} {cloud}");
                    let record = PlanRecord { path: String::new(), sha256: None };
                    let document = crate::inspection::document(plan, record, &found, vec![]);
                    assert_eq!(document.verdict, verdict, "{n} {cloud}");
                    let told = document.characteristics[0].notes.iter().any(|note| note.contains("outliers"));
                    assert_eq!(told, outliers > 0, "{n} {cloud}");
                }
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
            let data = Data {
                measured: Some(measured.into()),
                reference: Some(reference.clone()),
                ..Data::default()
            };
            let record = PlanRecord { path: String::new(), sha256: None };
            crate::inspection::document(&plan, record, &run(&plan, data, &Silent).unwrap(), vec![]).verdict
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
