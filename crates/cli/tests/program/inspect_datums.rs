//! Datum systems with a cross bore, and the place of one.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, status, stderr, stdout, trueness};

/// Points of a floor (z = 0), a wall (x = 0), a bore along x through y = 15, z = 10, and one along z at x = 45, y = 30.
fn parts(folder: &Folder) {
    let grid = |f: &dyn Fn(f64, f64) -> [f64; 3]| -> String {
        let all = (0..25).map(|k| f(f64::from(k % 5) * 10.0, f64::from(k / 5) * 10.0));
        all.map(|[x, y, z]| format!("{x} {y} {z}\n")).collect()
    };
    folder.write("floor.xyz", grid(&|x, y| [x, y, 0.0]));
    folder.write("wall.xyz", grid(&|x, y| [0.0, x, y]));
    let ring = |k: u32| f64::from(k % 24) * std::f64::consts::TAU / 24.0;
    let bore = |f: &dyn Fn(f64, f64, f64) -> [f64; 3]| -> String {
        let all = (0..96).map(|k| f(3.0 * ring(k).cos(), 3.0 * ring(k).sin(), f64::from(k / 24) * 5.0));
        all.map(|[x, y, z]| format!("{x} {y} {z}\n")).collect()
    };
    folder.write("side.xyz", grid(&|x, z| [x, 0.0, z]));
    folder.write("cross.xyz", bore(&|a, b, c| [c, 15.0 + a, 10.0 + b]));
    folder.write("hole.xyz", bore(&|a, b, c| [45.0 + a, 30.0 + b, c]));
}

/// The table of the position of the hole to these datums.
fn position(datums: &str) -> String {
    position_of("H", datums, "x = 45, y = 15")
}

/// The same of any feature with its exact place.
fn position_of(feature: &str, datums: &str, basic: &str) -> String {
    let folder = Folder::new();
    parts(&folder);
    let features = [
        ("A", "plane", "floor"),
        ("B", "plane", "wall"),
        ("C", "plane", "side"),
        ("X", "cylinder", "cross"),
        ("H", "cylinder", "hole"),
    ];
    let features = features.map(|(id, shape, file)| {
        format!("[[feature]]\nid = \"{id}\"\nshape = \"{shape}\"\npoints = \"{file}.xyz\"\n")
    });
    let plan = format!(
        "schema = \"trueness/plan/1\"\n{}[[characteristic]]\nid = \"1\"\nkind = \"position\"\nfeature = \"{feature}\"\ndatums = {datums}\n\
         basic = {{ {basic} }}\ntolerance = 0.01\n",
        features.concat()
    );
    let o = trueness(["inspect".as_ref(), "-v".as_ref(), folder.write("plan.toml", plan).as_os_str()]);
    assert!(status(&o) <= 1, "{}", stderr(&o));
    stdout(&o)
}

#[test]
fn a_cross_bore_behind_two_planes_is_where_y_begins() {
    let table = position(r#"["A", "B", "X"]"#);
    assert!(table.contains("pass: 1 pass"), "{table}");
}

#[test]
fn a_cross_bore_as_second_datum_says_what_to_write() {
    let table = position(r#"["A", "X"]"#);
    let says = "! 1: datum 2 is an axis across those before it, which leave a turn free; such an axis is evaluated only behind datums that \
                hold all turns; in place of `datums` give the frame that they make by numbers, in the coordinates of the aligned data, as in \
                frame = { origin = [0, 0, 0], x = [1, 0, 0], z = [0, 0, 1] }";
    assert!(table.contains(says), "{table}");
}

/// A bore along x is placed by y and z.
#[test]
fn a_cross_bore_is_placed_by_the_coordinates_across_it() {
    let of = |basic: &str| position_of("X", r#"["A", "B", "C"]"#, basic);
    let table = of("y = 15, z = 10");
    assert!(table.contains("pass: 1 pass"), "{table}");
    let off = of("y = 15.03, z = 9.96");
    assert!(off.contains("0.1000") && off.contains("1 fail"), "{off}");
    let along = of("x = 1, y = 15");
    let says =
        "its axis runs along x in the datum system, which places nothing: basic = { y = …, z = … } places it";
    assert!(along.contains(says), "{along}");
}
