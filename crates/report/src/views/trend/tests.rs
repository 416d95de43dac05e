use super::axes::{Axes, needed};
use serde_json::json;
use trueness_document::trend::TrendRecord;

/// A characteristic of these values and limits; without control limits.
fn record(values: &[Option<f64>], lower: Option<f64>, upper: Option<f64>) -> TrendRecord {
    let verdicts: Vec<&str> = values.iter().map(|_| "pass").collect();
    let counts = json!({"pass": 0, "fail": 0, "undecided": 0, "not_measured": 0});
    serde_json::from_value(json!({
        "id": "1", "kind": "distance", "symbol": "", "feature": "f", "datums": [], "unit": "mm", "nominal": null,
        "lower": lower, "upper": upper, "values": values, "verdicts": verdicts, "counts": counts, "measured": 0,
        "mean": null, "min": null, "max": null, "std_dev": null, "std_dev_within": null, "control": null,
        "out_of_control": [], "cp": null, "cpk": null, "pp": null, "ppk": null,
    }))
    .unwrap()
}

#[test]
fn every_value_is_in_the_chart_and_in_its_place() {
    let values = [Some(9.8), None, Some(10.4), Some(10.0)];
    let axes = Axes::of(&record(&values, Some(9.5), Some(10.5)));
    assert!(axes.from < 9.5 && axes.to > 10.5);
    for v in values.iter().flatten() {
        // As far from the foot, in shares of the height, as the value is from the lowest shown.
        let share = (v - axes.from) / (axes.to - axes.from);
        assert!((axes.y(*v, 200.0) - 200.0 * (1.0 - share)).abs() < 1e-9);
    }
    assert_eq!([0, 3].map(|n| axes.x(n, 1000.0)), [125.0, 875.0]);
}

#[test]
fn a_limit_that_is_far_off_does_not_press_the_values_into_a_line() {
    let close = Axes::of(&record(&[Some(0.01), Some(0.02)], None, Some(0.1)));
    assert!(close.holds(0.1));
    let far = Axes::of(&record(&[Some(0.01), Some(0.02)], None, Some(5.0)));
    assert!(!far.holds(5.0) && far.to - far.from < 0.02);
    // The nearer limit is shown all the same.
    let one = Axes::of(&record(&[Some(0.01), Some(0.02)], Some(0.0), Some(5.0)));
    assert!(one.holds(0.0) && !one.holds(5.0));
}

#[test]
fn values_that_are_alike_missing_or_alone_have_a_chart() {
    for values in [vec![Some(1.0); 5], vec![Some(1.0)], vec![None], vec![None, Some(1.0)], vec![]] {
        let axes = Axes::of(&record(&values, None, Some(3.0)));
        assert!(axes.to > axes.from && axes.holds(3.0), "{values:?} {axes:?}");
        assert!(values.iter().flatten().all(|v| axes.holds(*v)), "{values:?} {axes:?}");
    }
    // A value on its only limit, and 0 on 0.
    for value in [2.0, 0.0, -1e9, 1e-12] {
        let axes = Axes::of(&record(&[Some(value), Some(value)], None, Some(value)));
        assert!(axes.to > axes.from && axes.holds(value), "{value} {axes:?}");
        assert!(!axes.ticks().0.is_empty(), "{value} {axes:?}");
    }
    // What differs in the last digit alone does not differ.
    let axes = Axes::of(&record(&[Some(10.0), Some(10.0 + 4e-15)], Some(9.0), Some(11.0)));
    assert!(axes.holds(9.0) && axes.holds(11.0));
}

#[test]
fn round_values_and_numbers_of_parts_are_few_and_in_the_chart() {
    for (low, high) in [(0.0, 1.0), (9.97, 10.04), (-3e-7, 2e-7), (1e6, 1e6 + 1.0), (-900.0, 12.0)] {
        let axes = Axes::of(&record(&[Some(low), Some(high)], None, None));
        let (ticks, decimals) = axes.ticks();
        assert!((3..=8).contains(&ticks.len()), "{low} {high} {ticks:?}");
        assert!(ticks.iter().all(|t| axes.holds(*t)));
        let written: Vec<String> = ticks.iter().map(|t| format!("{t:.decimals$}")).collect();
        for (tick, text) in ticks.iter().zip(&written) {
            assert!((text.parse::<f64>().unwrap() - tick).abs() < 1e-6 * (high - low), "{text} {tick}");
        }
    }
    for count in [0, 1, 2, 9, 10, 14, 99, 1000, 12_345] {
        let axes = Axes::of(&record(&vec![Some(1.0); count], None, Some(2.0)));
        let numbered = axes.numbered();
        assert!(numbered.len() <= 10 && numbered.iter().all(|n| *n < count), "{count}: {numbered:?}");
        assert!(count == 0 || numbered[0] == 0, "{count}: {numbered:?}");
    }
}

#[test]
fn limits_have_the_digits_that_they_need() {
    assert_eq!([needed(10.5, 4), needed(0.025, 4), needed(3.0, 4), needed(1.0 / 3.0, 4)], [1, 3, 0, 4]);
}
