//! What the program says of tables of text, and of files that it cannot trust.
#![allow(clippy::unwrap_used, missing_docs)]

use crate::common::{CUBE, Folder, corpus, document, status, stderr, stdout, trueness};
use serde_json::json;

const ROWS: &str = "\
part 4711
Nr;Z [in];Y [in];X [in];note
7;0;0;0;a
9;0;0;1,5;b
10;0;1,5;0;c
11;0;1,25;1;d
";

#[test]
fn what_was_taken_for_what_stands_in_document_and_table_of_every_command() {
    let f = Folder::new();
    let (points, cube) = (f.write("p.csv", ROWS), f.write("c.off", CUBE));
    let (points, cube) = (points.to_str().unwrap(), cube.to_str().unwrap());
    let column = |axis: &str, number: u32, name: &str| json!({"axis": axis, "number": number, "name": name});
    let want = json!({
        "separator": "semicolons",
        "decimal_sign": ",",
        "columns": [column("x", 4, "X [in]"), column("y", 3, "Y [in]"), column("z", 2, "Z [in]")],
        "of": 5,
        "header_line": 2,
        "lines_skipped": 2,
    });
    let line = "x = column 4 \"X [in]\", y = column 3 \"Y [in]\", z = column 2 \"Z [in]\" of 5, separated by semicolons, \
                decimal commas, unit in from the header, 2 lines before the rows skipped";
    let commands = [
        vec!["fit", points, "--shape", "plane"],
        vec!["compare", points, cube, "-v"],
        vec!["segment", points, "--min-points", "4"],
    ];
    for words in commands {
        let table = trueness(words.clone());
        // Four points are too few to segment; the others answer.
        if words[0] == "segment" && status(&table) == 3 {
            continue;
        }
        assert!(stdout(&table).contains(line), "{}{}", stdout(&table), stderr(&table));
        let answer = document(words);
        let input = &answer["inputs"][0];
        assert_eq!(input["table"], want);
        assert_eq!((&input["unit_assumed"], &input["unit_from"]), (&json!("in"), &json!("header")));
        for other in answer["inputs"].as_array().unwrap().iter().skip(1) {
            assert_eq!((&other["table"], &other["unit_from"]), (&json!(null), &json!("assumed")));
        }
    }
}

#[test]
fn a_segmented_cloud_says_how_its_table_was_read() {
    let f = Folder::new();
    let rows: String = (0..400).map(|i| format!("{},{},0.5\n", f64::from(i % 20) + 0.5, i / 20)).collect();
    let points = f.write("p.csv", format!("x,y,z\n{rows}"));
    let words = ["segment", points.to_str().unwrap()];
    let table = trueness(words);
    assert_eq!(status(&table), 0, "{}", stderr(&table));
    let line = "x = column 1 \"x\", y = column 2 \"y\", z = column 3 \"z\" of 3, separated by commas, decimal points, 1 line";
    assert!(stdout(&table).contains(line), "{}", stdout(&table));
    assert_eq!(document(words)["inputs"][0]["table"]["separator"], "commas");
}

#[test]
fn unreadable_cells_end_with_status_3_file_line_column_and_remedy() {
    for (file, words) in [
        ("tables/gap_1.csv", ["line 3", "column 1 (x)", "fill the cell"]),
        ("tables/thousands_en.csv", ["line 2", "column 1 (x)", "thousands separators"]),
        ("tables/ref_first.csv", ["line 2", "column 1 (x)", "#REF!"]),
    ] {
        let answer = trueness(["fit", corpus(file).to_str().unwrap(), "--shape", "plane"]);
        let said = stderr(&answer);
        assert_eq!(status(&answer), 3, "{said}");
        assert!(words.iter().all(|w| said.contains(w)) && said.contains(file), "{said}");
    }
}

#[test]
fn coordinates_below_the_least_are_refused_as_those_beyond_the_greatest() {
    let f = Folder::new();
    let cube = f.write("c.off", CUBE);
    for (name, text, point) in [("tiny.xyz", "0 0 2\n1e-51 0 2\n", "1"), ("far.xyz", "0 0 1e61\n", "0")] {
        let points = f.write(name, text);
        let answer = trueness(["compare", points.to_str().unwrap(), cube.to_str().unwrap()]);
        let said = stderr(&answer);
        assert_eq!(status(&answer), 3, "{said}");
        assert!(
            said.contains(&format!("point {point} ")) && said.contains("from 1e-50 to 1e60 mm"),
            "{said}"
        );
    }
    // Every other command says the same.
    let least = ["fit --shape plane", "segment", "curvature", "surface", "section --plane 0,0,1,0"];
    for words in least {
        let points = f.write("tiny.xyz", "0 0 2\n1e-55 0 2\n0 3 2\n4 1 2\n5 5 2\n");
        let mut words: Vec<&str> = words.split(' ').collect();
        words.insert(1, points.to_str().unwrap());
        let answer = trueness(&words);
        let said = stderr(&answer);
        assert_eq!(status(&answer), 3, "{words:?}: {said}");
        assert!(said.contains("tiny.xyz: point 1 ") && said.contains("from 1e-50 to 1e60 mm"), "{said}");
    }
    let mesh = f.write("least.off", CUBE.replacen("0 0 0\n", "0 0 1e-55\n", 1));
    let (mesh, out) = (mesh.to_str().unwrap(), f.file("out.off"));
    for words in [
        vec!["check", mesh],
        vec!["repair", mesh, "-o", out.to_str().unwrap()],
        vec!["segment", mesh],
        vec!["curvature", mesh],
        vec!["section", mesh, "--plane", "0,0,1,0.5"],
    ] {
        let answer = trueness(&words);
        let said = stderr(&answer);
        assert_eq!(status(&answer), 3, "{words:?}: {said}");
        assert!(said.contains("least.off: vertex 0 ") && said.contains("from 1e-50 to 1e45 mm"), "{said}");
    }
    assert!(!out.exists());
    let tiny = f.write("tiny.off", CUBE.replacen("0 0 0\n", "0 0 1e-60\n", 1));
    let points = f.write("p.xyz", "0 0 2\n");
    let answer = trueness(["compare", points.to_str().unwrap(), tiny.to_str().unwrap()]);
    assert_eq!(status(&answer), 3);
    assert!(stderr(&answer).contains("from 1e-50 to 1e45 mm"), "{}", stderr(&answer));
}
