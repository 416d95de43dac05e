//! Tables that once were read as other numbers than they mean, and what is said of them.

use crate::common;

use common::{Folder, read};
use std::path::PathBuf;
use trueness_files::{ReadOptions, Unit, UnitFrom, open};

fn corpus(file: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../corpus/tables")).join(file)
}

#[test]
fn unreadable_cells_are_refused_with_line_and_column() {
    for (file, place, found) in [
        ("gap_0.csv", "line 2: column 1 (x)", "nothing"),
        ("gap_1.csv", "line 3: column 1 (x)", "nothing"),
        ("gap_10.csv", "line 12: column 1 (x)", "\"-\""),
        ("dash_first.csv", "line 2: column 1 (x)", "\"-\""),
        ("dash_later.csv", "line 3: column 1 (x)", "\"-\""),
        ("empty_first.csv", "line 2: column 1 (x)", "nothing"),
        ("mm.csv", "line 3: column 1 (x)", "\"1mm\""),
        ("mm_first.csv", "line 2: column 1 (x)", "\"1mm\""),
        ("na_first.csv", "line 2: column 1 (x)", "\"NaN?\""),
        ("ref_first.csv", "line 2: column 1 (x)", "\"#REF!\""),
        ("thousands_de.csv", "line 2: column 1 (x)", "\"1.234,5\""),
        ("thousands_en.csv", "line 2: column 1 (x)", "\"1,234.5\""),
    ] {
        let said = read(&corpus(file)).unwrap_err().to_string();
        assert!(said.contains(file) && said.contains(place) && said.contains(found), "{said}");
    }
}

#[test]
fn the_minus_of_typesetting_and_units_of_headers_are_understood() {
    let minus = read(&corpus("minus_u2212.xyz")).unwrap();
    assert_eq!(minus.points, [[-1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    let inch = read(&corpus("p_hdr_inch.csv")).unwrap();
    assert_eq!(inch.points, [[0.1 * 25.4, 0.2 * 25.4, 0.3 * 25.4]]);
    let told = open(&corpus("p_hdr_inch.csv"), &ReadOptions::default()).unwrap().provenance;
    assert_eq!((told.unit_assumed, told.unit_from), (Unit::Inch, UnitFrom::Header));
    let options = ReadOptions { units: Some(Unit::Centimeter), ..ReadOptions::default() };
    let told = open(&corpus("p_hdr_inch.csv"), &options).unwrap();
    assert_eq!(
        (told.provenance.unit_assumed, told.provenance.unit_from),
        (Unit::Centimeter, UnitFrom::Option)
    );
    assert_eq!(told.warnings.len(), 1);
}

#[test]
fn text_without_an_extension_is_refused_with_its_fault_as_well() {
    let folder = Folder::new();
    let said = read(&folder.file("points", b"x;y;z\n1;2;3\n4;-;6\n7;8;9\n")).unwrap_err().to_string();
    assert!(said.contains("line 3: column 2 (y)"), "{said}");
}

#[test]
fn a_fault_far_behind_the_first_lines_names_its_line() {
    let folder = Folder::new();
    let rows = |n: usize| (0..n).map(|i| format!("{i}.5;2;3\n")).collect::<String>();
    for (bad, place) in [("1;;3", "column 2 (y)"), ("1;2;3;4", "a row of 3 cells"), (";;", "without numbers")]
    {
        let text = format!("x;y;z\n{}{bad}\n{}", rows(300_000), rows(10));
        let said = read(&folder.file("long.csv", text.as_bytes())).unwrap_err().to_string();
        assert!(said.contains(", line 300002: ") && said.contains(place), "{said}");
    }
}

#[test]
fn encodings_of_spreadsheets() {
    let folder = Folder::new();
    let text = "X [mm];Y [mm];Z [mm]\r\n1,5;-2,5;3\r\n4;5;6\r\n";
    let units = |big: bool, mark: bool| -> Vec<u8> {
        let mark = if mark { "\u{feff}" } else { "" };
        let all = mark.encode_utf16().chain(text.encode_utf16());
        all.flat_map(|u| if big { u.to_be_bytes() } else { u.to_le_bytes() }).collect()
    };
    let mut ways = vec![text.into(), format!("\u{feff}{text}").into_bytes()];
    ways.extend([(false, false), (false, true), (true, false), (true, true)].map(|(b, m)| units(b, m)));
    for bytes in ways {
        let whole = read(&folder.file("t.csv", &bytes)).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(whole.points, [[1.5, -2.5, 3.0], [4.0, 5.0, 6.0]]);
    }
    let cut = units(false, true);
    let said = read(&folder.file("t.csv", &cut[..cut.len() - 1])).unwrap_err().to_string();
    assert!(said.contains("even number of bytes"), "{said}");
}
