//! Measured points that a feature leaves out as too far off, although they lie where the reference has it.
//!
//! A dent deeper than the extract distance is no part of its feature, and the feature is the better for it. Where the
//! reference is at hand, such points are told: those whose nearest place on it belongs to the feature.

use super::belonging::Belonging;
use super::data::{Data, Stop};
use super::seed::Seeded;
use crate::characteristic::{LeftOut, Taken};
use crate::plan::Plan;
use std::collections::BTreeMap;
use trueness_geom::feature::Nominal;
use trueness_geom::progress::Progress;

/// Tells the features which points they leave out. Without a reference there is nothing to tell.
///
/// Cost: one look at each measured point for each feature.
pub(super) fn tell(
    plan: &Plan,
    data: &Data,
    seeds: &BTreeMap<usize, Seeded>,
    belonging: Option<&Belonging>,
    features: &mut [Taken],
    progress: &dyn Progress,
) -> Result<(), Stop> {
    let Some(belonging) = belonging else { return Ok(()) };
    let of = |n: usize| seeds.get(&n).map(|s| &s.nominal).or(plan.features[n].nominal.as_ref());
    let sought: Vec<usize> = (0..plan.features.len())
        .filter(|n| of(*n).is_some_and(|nominal| !matches!(nominal, Nominal::Edge { .. })))
        .filter(|n| !features[*n].points.is_empty() && !data.points.contains_key(n))
        .collect();
    for n in sought {
        let Some(nominal) = of(n) else { continue };
        let near = plan.features[n].extract.near(nominal);
        let off = belonging.beyond(nominal, &near, progress);
        if !off.is_empty() {
            let farthest = off.iter().fold(0.0, |m: f64, d| m.max(*d));
            features[n].left_out = Some(LeftOut { points: off.len() as u64, farthest, limit: near.distance });
        }
    }
    if progress.cancelled() { Err(Stop::Cancelled) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inspection::run;
    use crate::results::Verdict;
    use crate::results::inspect::{InspectDocument, PlanRecord};
    use trueness_geom::mesh::Mesh;
    use trueness_geom::progress::Silent;
    use trueness_geom::space::Point;

    /// A floor of squares, 20 by 20.
    fn floor() -> Mesh {
        let at = |i: u32, j: u32| i * 21 + j;
        let positions: Vec<Point> =
            (0..21 * 21).map(|v| [f64::from(v / 21), f64::from(v % 21), 0.0]).collect();
        let square = |i, j| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        };
        Mesh { positions, faces: (0..20).flat_map(|i| (0..20).flat_map(move |j| square(i, j))).collect() }
    }

    /// A spike that is higher than the extract distance does not pass where a lower one fails.
    #[test]
    fn a_deep_dent_passes_no_more_than_a_small_one() {
        let plan = Plan::parse(
            r#"
            schema = "trueness/plan/1"
            measured = "part.stl"
            [[feature]]
            id = "A"
            shape = "plane"
            extract = { distance = 0.5 }
            [feature.nominal]
            point = [0, 0, 0]
            normal = [0, 0, 1]
            boundary = [[0, 0, 0], [20, 0, 0], [20, 20, 0], [0, 20, 0]]
            [[characteristic]]
            id = "1"
            kind = "flatness"
            feature = "A"
            tolerance = 0.1
            "#,
        )
        .unwrap();
        let cases = [
            (0.0, Verdict::Pass, None),
            (0.3, Verdict::Fail, None),
            (0.6, Verdict::Undecided, Some(1)),
            (-1.9, Verdict::Undecided, Some(1)),
            // Of something else.
            (9.0, Verdict::Pass, None),
        ];
        for (height, expected, left_out) in cases {
            for cloud in [false, true] {
                let mut measured = floor();
                measured.positions[10 * 21 + 10][2] = height;
                if cloud {
                    measured.faces.clear();
                }
                let data = Data { measured: Some(measured), reference: Some(floor()), ..Data::default() };
                let found = run(&plan, data, &Silent).unwrap();
                assert_eq!(found.features[0].left_out.map(|l| l.points), left_out, "{height} {cloud}");
                let record = PlanRecord { path: String::new(), sha256: None };
                let document = InspectDocument::new(&plan, record, &found, vec![]);
                assert_eq!(document.verdict, expected, "{height} {cloud}");
                assert_eq!(document.characteristics[0].notes.is_empty(), left_out.is_none(), "{height}");
            }
        }
    }
}
