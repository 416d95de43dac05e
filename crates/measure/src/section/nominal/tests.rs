//! Verdicts over planted deviations, coverage and doubts.

use super::super::outline::Against;
use super::*;
use crate::section::{Section, document};
use trueness_document::section::{
    FrameRecord, NominalWarning, NominalWarningKind, ProfileRule, SectionDocument,
};
use trueness_document::tolerance::Tolerance;
use trueness_document::{InputRecord, ResultDocument, Verdict};
use trueness_geom::progress::Silent;
use trueness_section::{Contour, Options, Outline, off_nominal};

/// A square of 10 measured at 400 places that lie off by `off` of their number, of which only `kept` of 1 follow.
fn compared(off: &dyn Fn(usize) -> f64, kept: f64, reach: f64) -> NominalRecord {
    let square = Outline::polyline(&[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]], true);
    let place = |i: usize| {
        let (side, t) = (i / 100, (i % 100) as f64 * 0.1 + 0.05);
        let d = off(i);
        [[t, -d], [10.0 + d, t], [10.0 - t, 10.0 + d], [-d, 10.0 - t]][side]
    };
    let points: Vec<[f64; 2]> = (0..(400.0 * kept) as usize).map(place).collect();
    let contour = Contour { closed: kept == 1.0, ..Contour::default() };
    let mut found = off_nominal(&points, std::slice::from_ref(&square), &Silent).unwrap();
    let far = |o: &Option<trueness_section::OffNominal>| o.is_some_and(|o| o.deviation.abs() > reach);
    let count = found.iter().filter(|o| far(o)).count();
    found.iter_mut().for_each(|o| *o = o.filter(|_| !far(&*o)));
    let contours = vec![Against { points: &points, found, far: count, contour: &contour }];
    nominal("n.dxf", "drawing", vec![AgainstPlane { plane: None, outlines: vec![square], contours }])
}

fn reference() -> InputRecord {
    serde_json::from_value(serde_json::json!({
        "path": "n.dxf", "format": "dxf", "role": "reference", "bytes": 1, "unit_assumed": "mm", "points": 0
    }))
    .unwrap_or_else(|e| panic!("{e}"))
}

fn judged_by(mut record: NominalRecord, [lower, upper]: [f64; 2], share: f64, cover: f64) -> NominalRecord {
    let rule =
        ProfileRule { tolerance: Tolerance { lower, upper }, required_share: share, min_coverage: cover };
    record.judge(&rule, &reference());
    record
}

fn told(record: &NominalRecord) -> (Verdict, Vec<&'static str>) {
    (record.verdict.unwrap(), record.verdict_reasons.iter().map(|r| r.kind.name()).collect())
}

#[test]
fn verdicts_by_shares_coverage_and_doubts() {
    let even = |_: usize| 0.02;
    let one_off = |i: usize| if i == 123 { 0.2 } else { 0.02 };
    let all = f64::INFINITY;
    let zone = [-0.05, 0.05];
    for (record, zone, share, cover, verdict, reasons) in [
        (compared(&even, 1.0, all), zone, 1.0, 0.9, Verdict::Pass, &[][..]),
        (compared(&even, 1.0, all), [0.0, 0.01], 1.0, 0.9, Verdict::Fail, &["out_of_tolerance"]),
        (compared(&one_off, 1.0, all), zone, 1.0, 0.9, Verdict::Fail, &["out_of_tolerance"]),
        (compared(&one_off, 1.0, all), zone, 0.99, 0.9, Verdict::Pass, &[]),
        // Half of it is not measured: undecided, unless that is meant; what fails fails all the same.
        (compared(&even, 0.5, all), zone, 1.0, 0.9, Verdict::Undecided, &["coverage"]),
        (compared(&even, 0.5, all), zone, 1.0, 0.0, Verdict::Pass, &[]),
        (compared(&one_off, 0.5, all), zone, 1.0, 0.9, Verdict::Fail, &["out_of_tolerance"]),
        // A side in five that lies far off has no counterpart.
        (
            compared(&|i| if i % 100 < 30 { 3.0 } else { 0.0 }, 1.0, 1.0),
            zone,
            1.0,
            0.9,
            Verdict::Undecided,
            &["coverage", "coverage"],
        ),
        (
            compared(&even, 1.0, 0.001),
            zone,
            1.0,
            0.9,
            Verdict::Undecided,
            &["not_measured", "coverage", "coverage"],
        ),
    ] {
        let record = judged_by(record, zone, share, cover);
        assert_eq!(told(&record), (verdict, reasons.to_vec()), "{zone:?} {share} {cover}");
    }
}

/// A small bore that was not made, or not measured, is no pass, however little of the whole length it is.
#[test]
fn a_bore_that_is_not_measured_is_no_pass() {
    let at = |i: i32| libm::sincos(-std::f64::consts::TAU * f64::from(i) / 24.0);
    let bore: Vec<[f64; 2]> = (0..24).map(at).map(|(s, c)| [5.0 + 0.4 * c, 5.0 + 0.4 * s]).collect();
    let bore = Outline::polyline(&bore, true);
    for (cover, verdict, reasons) in [(0.9, Verdict::Undecided, &["coverage"][..]), (0.0, Verdict::Pass, &[])]
    {
        let mut record = compared(&|_| 0.02, 1.0, f64::INFINITY);
        let plane = AgainstPlane { plane: None, outlines: vec![bore.clone()], contours: vec![] };
        record.outlines.extend(nominal("n.dxf", "drawing", vec![plane]).outlines);
        let record = judged_by(record, [-0.05, 0.05], 1.0, cover);
        assert_eq!(told(&record), (verdict, reasons.to_vec()), "{cover}");
        let [.., reason] = &record.verdict_reasons[..] else { continue };
        assert!(reason.text.contains("0.8000 by 0.8000 about (5.0000, 5.0000)"), "{}", reason.text);
    }
}

#[test]
fn the_worst_place_is_the_one_farthest_beyond() {
    let off = |i: usize| match i {
        7 => -0.03,
        9 => 0.04,
        _ => 0.01,
    };
    let worst = |zone: [f64; 2]| {
        let record = judged_by(compared(&off, 1.0, f64::INFINITY), zone, 1.0, 0.9);
        let profile = record.profile.unwrap();
        assert_eq!(profile.zone_width, zone[1] - zone[0]);
        profile.worst.unwrap().index
    };
    assert_eq!([worst([-0.05, 0.05]), worst([-0.01, 0.1]), worst([-0.1, 0.02])], [9, 7, 9]);
}

#[test]
fn doubts_leave_it_undecided() {
    let mut record = compared(&|_| 0.2, 1.0, f64::INFINITY);
    record.warnings.push(NominalWarning {
        kind: NominalWarningKind::SizeRatio,
        value: 25.4,
        text: String::new(),
    });
    let record = judged_by(record, [-0.1, 0.1], 1.0, 0.9);
    assert_eq!(told(&record), (Verdict::Undecided, vec!["size_ratio"]));
}

/// A section without doubts conforms; a stray segment, a doubt, a slab that holds an area and a verdict other than a pass say no, each alone.
#[test]
fn a_section_conforms_beyond_doubt_and_within_tolerance() {
    let found = |plane| Section::new(FrameRecord::FLAT, plane, Err("none"), vec![Contour::default()]);
    let made = |section| document(&[section], vec![], &Options::default());
    let with = |change: &dyn Fn(&mut SectionDocument)| {
        let mut document = made(found(None));
        change(&mut document);
        document.conforms()
    };
    let judged = |verdict| {
        let nominal = NominalRecord { verdict, ..compared(&|_| 0.02, 1.0, f64::INFINITY) };
        with(&|document| document.nominal = Some(nominal.clone()))
    };
    assert!(with(&|_| ()));
    assert!(!with(&|document| document.contours[0].astray.push(0)));
    assert!(!with(&|document| document.contours[0].doubts.push("thin".into())));
    let slab = Section { fills_area: true, ..found(Some(([0.0, 0.0, 1.0], 0.0))) };
    assert!(!made(slab).conforms());
    let verdicts = [None, Some(Verdict::Pass), Some(Verdict::Fail), Some(Verdict::Undecided)];
    assert_eq!(verdicts.map(judged), [true, true, false, false]);
}
