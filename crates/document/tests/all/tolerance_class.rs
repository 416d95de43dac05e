//! Tolerance classes against published values, and against the formulas that the standards took them from.

use trueness_document::tolerance_class::{ClassError, Table};

fn limits(class: &str, nominal: f64) -> Result<[f64; 2], ClassError> {
    Table::Size.limits(class, nominal, None)
}

/// Values of the common tables of fits (upper and lower deviation, micrometers).
#[test]
fn classes_have_their_published_limits() {
    let known = [
        ("H7", 25.0, 21.0, 0.0),
        ("H8", 60.0, 46.0, 0.0),
        ("H6", 6.0, 8.0, 0.0),
        ("H11", 10.0, 90.0, 0.0),
        ("H9", 400.0, 140.0, 0.0),
        ("h6", 25.0, 0.0, -13.0),
        ("h9", 100.0, 0.0, -87.0),
        ("g6", 25.0, -7.0, -20.0),
        ("g6", 8.0, -5.0, -14.0),
        ("f7", 25.0, -20.0, -41.0),
        ("f7", 100.0, -36.0, -71.0),
        ("e8", 25.0, -40.0, -73.0),
        ("e8", 60.0, -60.0, -106.0),
        ("d9", 25.0, -65.0, -117.0),
        ("d9", 10.0, -40.0, -76.0),
        ("k6", 25.0, 15.0, 2.0),
        ("k6", 60.0, 21.0, 2.0),
        ("k5", 100.0, 18.0, 3.0),
        ("m6", 25.0, 21.0, 8.0),
        ("m6", 60.0, 30.0, 11.0),
        ("n6", 25.0, 28.0, 15.0),
        ("n6", 10.0, 19.0, 10.0),
        ("p6", 25.0, 35.0, 22.0),
        ("p6", 60.0, 51.0, 32.0),
        ("r6", 25.0, 41.0, 28.0),
        ("r6", 60.0, 60.0, 41.0),
        ("r6", 70.0, 62.0, 43.0),
        ("s6", 25.0, 48.0, 35.0),
        ("s6", 60.0, 72.0, 53.0),
        ("s6", 70.0, 78.0, 59.0),
        ("js6", 25.0, 6.5, -6.5),
        ("js9", 50.0, 31.0, -31.0),
        ("j6", 25.0, 9.0, -4.0),
        ("j6", 40.0, 11.0, -5.0),
        ("j5", 100.0, 6.0, -9.0),
        ("j7", 25.0, 13.0, -8.0),
        ("G7", 25.0, 28.0, 7.0),
        ("F8", 25.0, 53.0, 20.0),
        ("F7", 60.0, 60.0, 30.0),
        ("E9", 25.0, 92.0, 40.0),
        ("D10", 25.0, 149.0, 65.0),
        ("K7", 25.0, 6.0, -15.0),
        ("K7", 60.0, 9.0, -21.0),
        ("K6", 25.0, 2.0, -11.0),
        ("K8", 25.0, 10.0, -23.0),
        ("M7", 25.0, 0.0, -21.0),
        ("M7", 60.0, 0.0, -30.0),
        ("M6", 300.0, -9.0, -41.0),
        ("M6", 350.0, -10.0, -46.0),
        ("N7", 25.0, -7.0, -28.0),
        ("N7", 60.0, -9.0, -39.0),
        ("N9", 25.0, 0.0, -52.0),
        ("N9", 8.0, 0.0, -36.0),
        ("N9", 3.0, -4.0, -29.0),
        ("P7", 25.0, -14.0, -35.0),
        ("P7", 60.0, -21.0, -51.0),
        ("P7", 3.0, -6.0, -16.0),
        ("P9", 25.0, -22.0, -74.0),
        ("R7", 25.0, -20.0, -41.0),
        ("R7", 60.0, -30.0, -60.0),
        ("S7", 25.0, -27.0, -48.0),
        ("S7", 70.0, -48.0, -78.0),
        ("JS7", 25.0, 10.5, -10.5),
        ("K7", 2.0, 0.0, -10.0),
        ("M7", 2.0, -2.0, -12.0),
        ("N7", 2.0, -4.0, -14.0),
    ];
    for (class, nominal, upper, lower) in known {
        let found = limits(class, nominal).unwrap();
        let wanted = [lower / 1000.0, upper / 1000.0];
        let near = found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near, "{class} {nominal}: {found:?} instead of {wanted:?}");
    }
    // A range ends with its end.
    assert_eq!(limits("H7", 30.0).unwrap()[1], 0.021);
    assert_eq!(limits("H7", 30.001).unwrap()[1], 0.025);
}

const ENDS: [f64; 13] = [3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0, 250.0, 315.0, 400.0, 500.0];
/// Ends of the finer ranges of r and s above 50 mm.
const FINE: [f64; 17] = [
    50.0, 65.0, 80.0, 100.0, 120.0, 140.0, 160.0, 180.0, 200.0, 225.0, 250.0, 280.0, 315.0, 355.0, 400.0,
    450.0, 500.0,
];

/// The standard's formulas, before its rounding: a wrong digit anywhere in the tables is farther off than rounding.
#[test]
fn tables_keep_to_the_formulas_of_the_standard() {
    let lower = |class: &str, x: f64| 1000.0 * limits(class, x).unwrap()[0];
    let upper = |class: &str, x: f64| 1000.0 * limits(class, x).unwrap()[1];
    let it = |grade: u32, x: f64| upper(&format!("H{grade}"), x);
    // Up to 3 mm the standard departs from its formulas by a micrometer or two.
    for ends in ENDS.windows(2) {
        let (d, x) = ((ends[0] * ends[1]).sqrt(), ends[1]);
        let i = 0.45 * d.cbrt() + 0.001 * d;
        for (grade, units) in
            [(5, 7.0), (6, 10.0), (7, 16.0), (8, 25.0), (9, 40.0), (10, 64.0), (11, 100.0), (12, 160.0)]
        {
            assert!(
                (it(grade, x) / (units * i) - 1.0).abs() < 0.1,
                "IT{grade} {x}: {} {}",
                it(grade, x),
                units * i
            );
        }
        // From IT6 on, five grades farther is ten times as wide, but for two roundings of the standard.
        for grade in 6..=13 {
            let ratio = it(grade + 5, x) / it(grade, x);
            assert!((ratio / 10.0 - 1.0).abs() < 0.07, "IT{} {x}: {ratio}", grade + 5);
        }
        for grade in 1..18 {
            assert!(it(grade, x) < it(grade + 1, x), "IT{grade} {x}");
        }
        for (letter, factor, power) in
            [("d", 16.0, 0.44), ("e", 11.0, 0.41), ("f", 5.5, 0.41), ("g", 2.5, 0.34)]
        {
            let (found, formula): (f64, f64) = (-upper(&format!("{letter}7"), x), factor * d.powf(power));
            assert!(
                (found - formula).abs() <= f64::max(1.0, 0.04 * formula),
                "{letter} {x}: {found} {formula}"
            );
        }
        assert!((lower("n6", x) - 5.0 * d.powf(0.34)).abs() <= 1.5, "n {x}");
        assert!((lower("m6", x) - (it(7, x) - it(6, x))).abs() <= 2.0, "m {x}");
        assert!((-1e-9..=5.0).contains(&(lower("p6", x) - it(7, x))), "p {x}");
        assert!((lower("k6", x) - 0.6 * d.cbrt()).abs() <= 1.0, "k {x}");
        if x <= 50.0 {
            assert!((-1e-9..=4.0).contains(&(lower("s6", x) - it(8, x))), "s {x}");
            assert!((lower("r6", x) - (lower("p6", x) * lower("s6", x)).sqrt()).abs() <= 1.0, "r {x}");
        }
    }
    for ends in FINE.windows(2) {
        let (d, x) = ((ends[0] * ends[1]).sqrt(), ends[1]);
        assert!((lower("s6", x) - it(7, x) - 0.4 * d).abs() <= 1.0, "s {x}");
        assert!((lower("r6", x) - (lower("p6", x) * lower("s6", x)).sqrt()).abs() <= 1.2, "r {x}");
    }
}

#[test]
fn what_is_in_no_table_is_refused() {
    let says = |class: &str, nominal: f64, what: &str| {
        let e = limits(class, nominal).unwrap_err().to_string();
        assert!(e.contains(what) && e.contains("write the limits"), "{class}: {e}");
    };
    says("c11", 25.0, "not in the tables of this program");
    says("zc8", 25.0, "not in the tables of this program");
    says("J7", 25.0, "not in the tables of this program");
    says("Js7", 25.0, "not in the tables of this program");
    says("H19", 25.0, "not in the tables of this program");
    says("H07", 25.0, "not in the tables of this program");
    says("7", 25.0, "not in the tables of this program");
    says("H7H8", 25.0, "not in the tables of this program");
    says("j9", 25.0, "grades 5 to 7");
    says("K9", 25.0, "grades 3 to 8");
    says("H7", 501.0, "up to 500 mm");
    says("H7", 0.0, "above 0");
    says("H7", f64::NAN, "above 0");
    says("H14", 0.8, "grades 1 to 13");
}

#[test]
fn general_tolerances_are_those_of_the_standard() {
    let linear = |class: &str, x: f64| Table::Linear.limits(class, x, None).map(|l| l[1]);
    assert_eq!(linear("m", 0.5), Ok(0.1));
    assert_eq!([linear("m", 6.0), linear("m", 6.1)], [Ok(0.1), Ok(0.2)]);
    assert_eq!([linear("f", 100.0), linear("c", 100.0), linear("v", 100.0)], [Ok(0.15), Ok(0.8), Ok(1.5)]);
    assert_eq!([linear("mK", 500.0), linear("cL", 500.0)], [Ok(0.8), Ok(2.0)]);
    let angular = |class: &str, x: f64| Table::Angular.limits(class, 90.0, Some(x)).map(|l| l[1]);
    assert_eq!([angular("m", 10.0), angular("m", 30.0), angular("c", 10.0)], [Ok(1.0), Ok(0.5), Ok(1.5)]);
    assert_eq!(angular("v", 5000.0), Ok(20.0 / 60.0));
    let of = |table: Table, class: &str, x: f64| table.limits(class, 0.0, Some(x)).map(|l| l[1]);
    assert_eq!([of(Table::Form, "H", 10.0), of(Table::Form, "mK", 80.0)], [Ok(0.02), Ok(0.2)]);
    assert_eq!(of(Table::Perpendicularity, "K", 250.0), Ok(0.6));
    assert_eq!([of(Table::Symmetry, "H", 250.0), of(Table::Symmetry, "L", 250.0)], [Ok(0.5), Ok(1.0)]);
    assert_eq!(of(Table::Runout, "L", 1.0), Ok(0.5));
}

/// Within a class limits grow with the length, and a coarser class is nowhere tighter.
#[test]
fn coarser_and_longer_is_never_tighter() {
    let tables = [
        (Table::Form, ["H", "K", "L"]),
        (Table::Perpendicularity, ["H", "K", "L"]),
        (Table::Symmetry, ["H", "K", "L"]),
        (Table::Linear, ["f", "m", "c"]),
    ];
    for (table, classes) in tables {
        for length in [1.0, 5.0, 20.0, 90.0, 250.0, 900.0, 1900.0] {
            let t = |class: &str, x: f64| table.limits(class, x, Some(x)).unwrap()[1];
            let values = classes.map(|c| t(c, length));
            assert!(values[0] <= values[1] && values[1] <= values[2], "{table:?} {length} {values:?}");
            classes.iter().for_each(|c| assert!(t(c, 0.5) <= t(c, length)));
        }
    }
}

#[test]
fn general_tolerances_refuse_what_is_in_no_table() {
    let unknown = |e: Result<[f64; 2], ClassError>| matches!(e, Err(ClassError::Unknown { .. }));
    assert!(unknown(Table::Linear.limits("x", 10.0, None)));
    assert!(unknown(Table::Linear.limits("H7", 10.0, None)));
    assert!(unknown(Table::Form.limits("m", 10.0, Some(10.0))));
    assert!(unknown(Table::Size.limits("", 10.0, None)));
    assert!(unknown(Table::Linear.limits("µK", 10.0, None)));
    let range = |e: Result<[f64; 2], ClassError>| matches!(e, Err(ClassError::Range { .. }));
    assert!(range(Table::Linear.limits("m", 0.4, None)));
    assert!(range(Table::Linear.limits("f", 3000.0, None)));
    assert!(range(Table::Linear.limits("v", 2.0, None)));
    assert!(range(Table::Form.limits("H", 0.0, Some(4000.0))));
    assert!(range(Table::Form.limits("H", 0.0, Some(f64::NAN))));
    assert!(matches!(Table::Form.limits("H", 0.0, None), Err(ClassError::NoLength { .. })));
}
