//! What characteristics and features are called in tables, CSV and JUnit, whatever the plan calls them.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, status, stderr, stdout, trueness};

/// Points of a pin of radius 4 with two lobes, so that each of its sizes is another.
fn pin() -> String {
    let point = |k: u32| {
        let (angle, z) = (f64::from(k % 24) * std::f64::consts::TAU / 24.0, f64::from(k / 24) * 3.0);
        let r = 4.0 + 0.02 * (2.0 * angle).cos();
        format!("{} {} {z}\n", r * angle.cos(), r * angle.sin())
    };
    (0..144).map(point).collect()
}

/// A plan on the pin with these characteristics.
fn plan(characteristics: &str) -> String {
    format!(
        "schema = \"trueness/plan/1\"\n[[feature]]\nid = \"pin\"\nshape = \"cylinder\"\npoints = \"pin.xyz\"\ninternal = false\n{characteristics}"
    )
}

/// The text that the file behind this option has.
fn written(folder: &Folder, plan: &str, option: &str) -> String {
    folder.write("pin.xyz", pin());
    let (plan, out) = (folder.write("plan.toml", plan), folder.file("out"));
    let o = trueness(["inspect".as_ref(), plan.as_os_str(), option.as_ref(), out.as_os_str()]);
    assert!(status(&o) <= 1, "{}", stderr(&o));
    std::fs::read_to_string(out).unwrap()
}

#[test]
fn sizes_of_one_feature_are_told_apart() {
    let words = ["GG", "GN", "GX", "GC", "LP"];
    let sizes = words.map(|word| {
        format!(
            "[[characteristic]]\nid = \"{}\"\nkind = \"size\"\nfeature = \"pin\"\nsize = \"{word}\"\nnominal = 8\nclass = \"h9\"\n",
            word.len() * 10 + word.as_bytes()[1] as usize
        )
    });
    let (folder, plan) = (Folder::new(), plan(&sizes.concat()));
    let csv = written(&folder, &plan, "--csv");
    let mut lines = csv.lines();
    assert!(lines.next().unwrap().contains(",interval_to,modifiers,"), "{csv}");
    let junit = written(&folder, &plan, "--junit");
    let table = stdout(&trueness(["inspect".as_ref(), folder.file("plan.toml").as_os_str()]));
    for (word, line) in words.iter().zip(lines) {
        assert!(line.contains(&format!(",h9; {word},")), "{line}");
        assert!(junit.contains(&format!(" size h9 {word} pin\"")), "{junit}");
        assert!(table.contains(&format!("size h9 {word}  ")), "{table}");
    }
}

#[test]
fn what_is_usual_is_not_named() {
    let forms = ["minimum-zone", "gaussian"].map(|method| {
        format!("[[characteristic]]\nid = \"{method}\"\nkind = \"cylindricity\"\nfeature = \"pin\"\ntolerance = 0.1\nmethod = \"{method}\"\n")
    });
    let (folder, plan) = (Folder::new(), plan(&forms.concat()));
    let junit = written(&folder, &plan, "--junit");
    assert!(junit.contains("name=\"minimum-zone cylindricity pin\""), "{junit}");
    assert!(junit.contains("name=\"gaussian cylindricity gaussian pin\""), "{junit}");
    assert!(written(&folder, &plan, "--csv").lines().nth(1).unwrap().contains(",minimum-zone,"));
}

/// A flatness with this name.
fn named(id: &str) -> String {
    plan(&format!(
        "[[characteristic]]\nid = {id}\nkind = \"cylindricity\"\nfeature = \"pin\"\ntolerance = 0.1\n"
    ))
}

#[test]
fn no_name_runs_as_a_formula_of_a_spreadsheet() {
    let folder = Folder::new();
    for (id, cell) in [
        ("'=1+1'", "'=1+1"),
        ("'=HYPERLINK(\"http://x\",\"y\")'", "\"'=HYPERLINK(\"\"http://x\"\",\"\"y\"\")\""),
        ("'+X'", "'+X"),
        ("'-X'", "'-X"),
        ("'@SUM(A1)'", "'@SUM(A1)"),
        // What is a number cannot run.
        ("'-12.5'", "-12.5"),
        ("'4-7'", "4-7"),
    ] {
        let csv = written(&folder, &named(id), "--csv");
        let line = csv.lines().nth(1).unwrap();
        assert!(line.contains(&format!(",{cell},cylindricity,")), "{line}");
    }
}

#[test]
fn names_that_nobody_can_read_are_refused() {
    let folder = Folder::new();
    folder.write("pin.xyz", pin());
    for (id, says) in [
        ("\"\"", "line 8, column 6: an id cannot be empty; give a name or number"),
        ("\"  \"", "line 8, column 6: an id cannot be empty; give a name or number"),
        (r#""a\u0007b""#, "line 8, column 6: the id holds the control character U+0007; leave it out"),
        (r#""a\nb""#, "line 8, column 6: the id holds the control character U+000A; leave it out"),
    ] {
        let plan = folder.write("plan.toml", named(id));
        let o = trueness(["inspect".as_ref(), plan.as_os_str()]);
        assert_eq!(status(&o), 3, "{id}: {}", stdout(&o));
        assert!(stderr(&o).contains(says), "{id}: {}", stderr(&o));
    }
}

#[test]
fn numbers_that_no_part_has_are_refused() {
    let folder = Folder::new();
    folder.write("pin.xyz", pin());
    let sound = named("\"1\"");
    for (number, says) in [
        ("1e308", "line 11, column 13: 1e308 is no number of a part; give less than 1e12"),
        ("2000000000000", "line 11, column 13: 2000000000000 is no number of a part; give less than 1e12"),
        ("inf", "line 11, column 13: the tolerance is inf; give a finite number"),
    ] {
        let plan =
            folder.write("plan.toml", sound.replace("tolerance = 0.1", &format!("tolerance = {number}")));
        let o = trueness(["inspect".as_ref(), plan.as_os_str()]);
        assert_eq!(status(&o), 3, "{number}: {}", stdout(&o));
        assert!(stderr(&o).contains(says), "{number}: {}", stderr(&o));
    }
}
