//! Airfoils in the forms of collections, under any title, and texts that are none.

use super::{Airfoil, plain};

/// Rows of a symmetrical profile from the trailing edge over the leading one and back, as x and y.
fn around(each: i32) -> Vec<[f64; 2]> {
    let place = |k: i32| {
        let x = (f64::from(k) / f64::from(each)).powi(2);
        [x, 0.1 * f64::from(k.signum()) * (x.sqrt() - x)]
    };
    (-each..=each).rev().map(place).collect()
}

fn text(title: Option<&str>, rows: &[[f64; 2]], end: &str) -> String {
    let line = |[x, y]: &[f64; 2]| format!("  {x:.6}  {y:.6}{end}");
    title.map_or(String::new(), |t| format!("{t}{end}")) + &rows.iter().map(line).collect::<String>()
}

fn numbers(text: &[u8]) -> Vec<[f64; 2]> {
    let text = String::from_utf8(text.to_vec()).unwrap();
    let row = |l: &str| l.split_whitespace().map(|w| w.parse::<f64>().unwrap()).collect::<Vec<_>>();
    text.split(['\n', '\r']).map(row).filter(|r| !r.is_empty()).map(|r| [r[0], r[1]]).collect()
}

#[test]
fn titles_that_look_like_rows_names_or_counts_are_titles() {
    for each in [6, 30, 100] {
        let rows = around(each);
        for title in ["NACA 0012", "CLARK Y", "0012", "NACA 23012 (smoothed)", "E 387", "S1223", "x of 2 3 4"]
        {
            for end in ["\n", "\r\n", "\r"] {
                let Airfoil { text: found, warning, .. } =
                    plain(text(Some(title), &rows, end).as_bytes()).unwrap();
                assert_eq!(numbers(&found), numbers(text(None, &rows, end).as_bytes()), "{title}");
                assert!(
                    warning.to_string().contains(title) && warning.to_string().contains("Selig"),
                    "{warning}"
                );
            }
        }
    }
}

#[test]
fn both_sides_of_the_other_form_become_one_row() {
    for (each, shared) in [(6, true), (30, false), (60, true)] {
        let rows = around(each);
        let nose = each as usize;
        let upper: Vec<[f64; 2]> = rows[..=nose].iter().rev().copied().collect();
        let lower = &rows[nose + usize::from(!shared)..];
        let counts = [upper.len() as f64, lower.len() as f64];
        let all = [&[counts], &upper[..], lower].concat();
        for title in [Some("CLARK Y AIRFOIL"), None] {
            let Airfoil { text: found, warning, .. } = plain(text(title, &all, "\n").as_bytes()).unwrap();
            assert_eq!(numbers(&found), numbers(text(None, &rows, "\n").as_bytes()), "{each} {shared}");
            assert!(warning.to_string().contains("Lednicer"), "{warning}");
        }
    }
}

/// Names of columns, rows of another order or number of cells, and a wrong count are left to the table's own rules.
#[test]
fn other_rows_are_no_airfoil() {
    let rows = around(30);
    assert_eq!(plain(text(None, &rows, "\n").as_bytes()), None);
    assert_eq!(plain(text(Some("x y"), &rows, "\n").as_bytes()), None);
    assert_eq!(plain(text(Some("X [mm], Y [mm]"), &rows, "\n").as_bytes()), None);
    assert_eq!(plain(text(Some("A 1"), &rows[..40], "\n").as_bytes()), None);
    let mut mixed = rows.clone();
    mixed.swap(10, 20);
    assert_eq!(plain(text(Some("A 1"), &mixed, "\n").as_bytes()), None);
    assert_eq!(plain((text(Some("A 1"), &rows, "\n") + "1 2 3\n").as_bytes()), None);
    assert_eq!(plain(b""), None);
    assert_eq!(plain(b"\n\n"), None);
}

/// Titles of any lines before both sides, whose faults stand at their lines in the file.
#[test]
fn titles_of_several_lines_and_of_numbers_are_known_by_the_counts_behind_them() {
    let rows = around(26);
    let upper: Vec<[f64; 2]> = rows[..=26].iter().rev().copied().collect();
    let all = [&[[27.0, 27.0]], &upper[..], &rows[26..]].concat();
    for title in [
        "NACA x\nline two",
        "0.12 0.5",
        "12 % thick\n0.12 0.5",
        "a\nb\nc\n\nd 1 2 3",
        "1 2 3",
        "65 65",
        "x y",
        "2412",
    ] {
        let found = plain(text(Some(title), &all, "\n").as_bytes()).unwrap_or_else(|| panic!("{title}"));
        assert_eq!(numbers(&found.text), numbers(text(None, &rows, "\n").as_bytes()), "{title}");
        assert!(found.warning.to_string().contains("Lednicer"), "{}", found.warning);
        let lines: Vec<String> = text(Some(title), &all, "\n").lines().map(str::to_owned).collect();
        for (line, of) in String::from_utf8(found.text).unwrap().lines().zip(&found.file_lines) {
            assert!(line.is_empty() || lines[*of as usize - 1] == line, "{title}: {line} {of}");
        }
    }
    for title in ["0.12 0.5", "Wing\nroot 1", "Wing\n33. 33."] {
        let found = plain(text(Some(title), &rows, "\n").as_bytes()).unwrap_or_else(|| panic!("{title}"));
        assert_eq!(numbers(&found.text), numbers(text(None, &rows, "\n").as_bytes()), "{title}");
    }
}
