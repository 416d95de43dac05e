//! The report as a file: the same every time, within its budget, and safe whatever the names are.

#[path = "../examples/report_fixtures.rs"]
#[allow(dead_code, missing_docs, reason = "a program of its own, too")]
mod fixtures;

use fixtures::{page, sphere};
use trueness_inspect::report::{Language, ReportOptions};

const NAMES: [&str; 2] = ["scan.stl", "nominal.stl"];
const TOLERANCE: Option<[f64; 2]> = Some([-0.05, 0.05]);

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let body = sphere(60);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| page(&body, TOLERANCE, NAMES, &ReportOptions::default()).0)
    };
    assert!(with(1) == with(4));
}

#[test]
fn a_small_budget_is_kept() {
    let body = sphere(200);
    let (full, _) = page(&body, TOLERANCE, NAMES, &ReportOptions::default());
    let budget = full.len() - 200_000;
    let options = ReportOptions { budget, ..ReportOptions::default() };
    let (small, summary) = page(&body, TOLERANCE, NAMES, &options);
    assert!(small.len() <= budget && summary.bytes == small.len(), "{} of {budget}", small.len());
    let text = String::from_utf8(small).unwrap();
    assert!(text.contains("display simplified, numbers are from all points"));
}

#[test]
fn names_are_never_markup() {
    let nasty = "<img src=x onerror=alert(1)></script><style>\"'&.stl";
    let options =
        ReportOptions { title: Some(nasty.into()), operator: Some(nasty.into()), ..ReportOptions::default() };
    let text = String::from_utf8(page(&sphere(10), None, [nasty, nasty], &options).0).unwrap();
    assert!(!text.contains("<img src=x") && !text.contains(" style="));
    assert_eq!(text.matches("<style>").count(), 1);
    assert_eq!(text.matches("</script>").count(), text.matches("<script").count());
    assert!(text.contains("No tolerance given"));
}

#[test]
fn every_word_is_in_the_table() {
    let options = ReportOptions { language: Language::De, ..ReportOptions::default() };
    let text = String::from_utf8(page(&sphere(10), TOLERANCE, NAMES, &options).0).unwrap();
    for part in text.split("data-t=\"").skip(1) {
        let (key, rest) = part.split_once("\">").unwrap();
        assert!(!rest.starts_with(key), "no German word for {key}");
    }
    assert!(text.contains("Nicht in Ordnung") && text.contains("−0,050"));
}
