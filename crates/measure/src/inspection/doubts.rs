//! Whether the data lie where the reference or the plan's features are, and in their unit.

use super::data::Data;
use crate::align::note;
use crate::characteristic::MeasuredFeature;
use crate::compare::plausibility;
use crate::plan::Plan;
use crate::requirement::{Feature, Source};
use trueness_document::compare::{Warning, WarningKind};
use trueness_geom::align::{AlignWarning, Alignment};
use trueness_geom::feature::Nominal;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::{Aabb, Point, norm, times};

/// Factors between units that are confused, and how they are told.
const UNIT_FACTORS: [(f64, &str); 6] =
    [(25.4, "25.4"), (1.0 / 25.4, "0.03937"), (10.0, "10"), (0.1, "0.1"), (1000.0, "1000"), (1e-3, "0.001")];
/// The box of what was measured is at most so many times larger than that of the features: in a larger one they lie by chance.
const MAX_BOX_RATIO: f64 = 5.0;
/// Features may lie outside of the box of what was measured by this share of their size: a surface may be off.
const BOX_MARGIN_SHARE: f64 = 0.05;
/// How a unit is set where it is asked.
const UNITS_KEY: &str = "`units` of the plan";

/// What makes it unlikely that aligned data, with the features that were found in them, are of the part.
pub(super) fn doubts(plan: &Plan, data: &Data, motion: &Rigid, features: &[MeasuredFeature]) -> Vec<Warning> {
    if data.reference.is_some() {
        return boxes(plan, data);
    }
    // Of places of features alone the ratio of sizes tells nothing.
    let mut found = boxes(plan, data);
    found.retain(|w| w.kind == WarningKind::HardlyOverlapping);
    // A face through the origin is itself in every unit: one feature that is missing is enough.
    let missing =
        |(f, t): (&Feature, &MeasuredFeature)| matches!(f.source, Source::Nominal) && t.element.is_err();
    if plan.features.iter().zip(features).any(missing) {
        found.extend(unit_of_features(plan, data, motion));
    }
    found
}

/// In which unit data would lie where the plan has them that could not be aligned by its datums, in words. They were laid
/// for the search by `motion`, which is that of the best fit where there is one.
pub(super) fn unit(plan: &Plan, data: &Data, motion: &Rigid, fit: Option<&Alignment>) -> Option<String> {
    let of_fit = fit.and_then(|fit| fit.warnings.iter().find(|w| matches!(w, AlignWarning::Scale { .. })));
    if let Some(warning) = of_fit {
        return Some(note(warning).text);
    }
    let found = match data.reference {
        Some(_) => boxes(plan, data).into_iter().find(|w| w.kind == WarningKind::SizeRatio),
        None => unit_of_features(plan, data, motion),
    };
    found.map(|w| w.text)
}

/// What the boxes of data and reference, or where there is none of the places of features, tell.
fn boxes(plan: &Plan, data: &Data) -> Vec<Warning> {
    let Some(measured) = &data.measured else { return vec![] };
    let reference = match &data.reference {
        Some(reference) => reference.bounds(),
        None => Aabb::of(&places(plan)),
    };
    let bounds = crate::bounds(&measured.bounds()).zip(crate::bounds(&reference));
    bounds.map_or(vec![], |(m, r)| plausibility::warnings(&m, &r, UNITS_KEY))
}

fn places(plan: &Plan) -> Vec<Point> {
    plan.features.iter().filter_map(|f| f.nominal.as_ref()).flat_map(Nominal::places).collect()
}

/// The unit in which the measured data, laid by the same `motion`, would lie at the features of the plan. `None` if they do as they are.
fn unit_of_features(plan: &Plan, data: &Data, motion: &Rigid) -> Option<Warning> {
    let (measured, back) = (data.measured.as_ref()?, motion.inverse());
    let sought = places(plan);
    let size = Aabb::of(&sought).diagonal();
    let as_measured: Vec<Point> = measured.points().iter().map(|p| back.point(*p)).collect();
    let larger = |factor: f64| -> Option<f64> {
        let there: Vec<Point> = as_measured.iter().map(|p| motion.point(times(factor, *p))).collect();
        let bounds = Aabb::of(&there);
        let holds = sought.iter().all(|p| bounds.distance(p) <= BOX_MARGIN_SHARE * size);
        let times_larger = norm(bounds.sides()) / size;
        (holds && times_larger <= MAX_BOX_RATIO).then_some(times_larger)
    };
    if size == 0.0 || larger(1.0).is_some() {
        return None;
    }
    // Of several the one in which the features take up most of it.
    let fits = UNIT_FACTORS.iter().filter_map(|(factor, word)| Some((larger(*factor)?, *factor, *word)));
    let (_, factor, word) = fits.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let text = format!(
        "the measured lies where the plan has its features when it is {word} times as large: is a unit wrong? ({UNITS_KEY})"
    );
    Some(Warning { kind: WarningKind::SizeRatio, value: 1.0 / factor, text })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inspection::run;
    use trueness_geom::progress::Silent;
    use trueness_geom::scan::Scan;

    /// Three sides of a block of 60 by 40 by 20 from (10, 10, 10), and its alignment.
    fn plan(align: &str) -> Plan {
        let plane = |id: &str, normal: [i32; 3], corners: [[i32; 3]; 4]| {
            let corners = corners.map(|c| c.map(|x| x + 10));
            format!(
                "[[feature]]\nid = \"{id}\"\nshape = \"plane\"\n\
                 nominal = {{ point = [10, 10, 10], normal = {normal:?}, boundary = {corners:?} }}\n"
            )
        };
        let text = [
            "schema = \"trueness/plan/1\"\nmeasured = \"points.xyz\"\n".into(),
            align.to_string(),
            plane("A", [0, 0, -1], [[0, 0, 0], [60, 0, 0], [60, 40, 0], [0, 40, 0]]),
            plane("B", [-1, 0, 0], [[0, 0, 0], [0, 40, 0], [0, 40, 20], [0, 0, 20]]),
            plane("C", [0, -1, 0], [[0, 0, 0], [60, 0, 0], [60, 0, 20], [0, 0, 20]]),
            "[[characteristic]]\nid = \"1\"\nkind = \"flatness\"\nfeature = \"A\"\ntolerance = 0.05\n".into(),
        ];
        Plan::parse(&text.concat()).unwrap()
    }

    /// A cloud of these sides, `factor` times as large, moved by `by`.
    fn points(factor: f64, by: Point) -> Data {
        let grid = (0..31).flat_map(|i| (0..21).map(move |j| (f64::from(i) / 30.0, f64::from(j) / 20.0)));
        let sides = grid.flat_map(|(u, v)| {
            [[60.0 * u, 40.0 * v, 0.0], [0.0, 40.0 * u, 20.0 * v], [60.0 * u, 0.0, 20.0 * v]]
        });
        let positions = sides.map(|p| [0, 1, 2].map(|k| factor * (10.0 + p[k]) + by[k])).collect();
        Data { measured: Some(Scan::Cloud(positions)), ..Data::default() }
    }

    #[test]
    fn a_wrong_unit_is_named_without_a_reference() {
        for (factor, word) in [
            (25.4, "0.03937"),
            (1.0 / 25.4, "25.4"),
            (1000.0, "0.001"),
            (1e-3, "1000"),
            (10.0, "0.1"),
            (0.1, "10"),
        ] {
            let found = run(&plan(""), points(factor, [0.0; 3]), &Silent).unwrap();
            let texts: Vec<&str> = found.doubts.iter().map(|w| w.text.as_str()).collect();
            let wanted = format!("when it is {word} times as large: is a unit wrong?");
            assert!(texts.iter().any(|t| t.contains(&wanted)), "{factor}: {texts:?}");
        }
        for (data, what) in
            [(points(1.0, [0.0; 3]), "as it is"), (points(1.0, [0.0, 0.0, 15.0]), "elsewhere")]
        {
            let found = run(&plan(""), data, &Silent).unwrap();
            assert!(
                found.doubts.iter().all(|w| w.kind != WarningKind::SizeRatio),
                "{what}: {:?}",
                found.doubts
            );
        }
    }

    #[test]
    fn datums_that_are_not_found_say_which_unit_would_do() {
        let align = "[align]\nmethod = \"datum\"\ndatums = [\"A\", \"B\", \"C\"]\n\
                     transform = [[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n";
        for (factor, word) in [(25.4, "0.03937"), (1.0 / 25.4, "25.4"), (1000.0, "0.001"), (1e-3, "1000")] {
            let error = run(&plan(align), points(factor, [-5.0 * factor, 0.0, 0.0]), &Silent).err().unwrap();
            let wanted = format!("when it is {word} times as large: is a unit wrong? (`units` of the plan)");
            assert!(error.to_string().ends_with(&wanted), "{error}");
        }
        assert!(run(&plan(align), points(1.0, [-5.0, 0.0, 0.0]), &Silent).is_ok());
        let error = run(&plan(align), points(1.0, [0.0, 0.0, 15.0]), &Silent).err().unwrap();
        assert!(!error.to_string().contains("unit"), "{error}");
    }
}
