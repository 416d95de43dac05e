//! The range of every option that takes a number: what lies outside is refused, with the option, the value and the range.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use crate::common::*;
use std::collections::BTreeSet;

/// An option of a command: values that are refused, what tells their range, and values at the ends of the range.
struct Row {
    /// The words before the option.
    command: &'static str,
    option: &'static str,
    refused: &'static [&'static str],
    range: &'static str,
    allowed: &'static [&'static str],
}

const fn row(
    command: &'static str,
    option: &'static str,
    refused: &'static [&'static str],
    range: &'static str,
    allowed: &'static [&'static str],
) -> Row {
    Row { command, option, refused, range, allowed }
}

const NOT_NEGATIVE: &[&str] = &["-1", "nan", "inf"];
const NOT_POSITIVE: &[&str] = &["0", "-1", "nan", "inf"];
const NO_PERCENT: &[&str] = &["-1", "101", "nan"];
const NO_COUNT: &[&str] = &["-1", "0.5"];
const FROM_0: &str = "a number from 0 upwards";
const ABOVE_0: &str = "a length above 0";
const PERCENT: &str = "from 0 to 100 percent";
const COUNT: &str = "a whole number, 0 or more";

/// MESH, CLOUD, ROW, SURFACE and MODEL stand for files.
const ROWS: &[Row] = &[
    row("check MESH", "threads", &["0", "-1", "65536"], "1..=65535", &["1", "3"]),
    row("check MESH", "seed", NO_COUNT, "a whole number from 0 to", &["0", "18446744073709551615"]),
    row("check MESH", "html-budget", &["1.9", "-1", "nan", "inf"], "2 or more", &["2"]),
    row("check MESH", "gap", NOT_NEGATIVE, FROM_0, &["0"]),
    row("check MESH", "weld", NOT_NEGATIVE, FROM_0, &["0"]),
    row("check MESH", "sliver-angle", &["-1", "60.1", "100", "nan"], "from 0 to 60 degrees", &["0", "60"]),
    row("check MESH", "island", &["-1", "200", "nan"], PERCENT, &["0", "100"]),
    row("check MESH", "items", NO_COUNT, COUNT, &["0"]),
    row("repair MESH --out OUT", "gap", NOT_NEGATIVE, FROM_0, &["0"]),
    row("repair MESH --out OUT", "stitch", NOT_NEGATIVE, FROM_0, &["0"]),
    row("repair MESH --out OUT", "holes", &["-1", "200", "nan"], PERCENT, &["0", "100"]),
    row("repair MESH --out OUT", "remove-islands", NO_PERCENT, PERCENT, &["0", "100"]),
    row("repair MESH --out OUT", "max-change", NOT_NEGATIVE, FROM_0, &["0", "1000"]),
    row("repair MESH --out OUT", "items", NO_COUNT, COUNT, &["0"]),
    row("compare CLOUD MESH", "weld", NOT_NEGATIVE, FROM_0, &["0"]),
    row("compare CLOUD MESH", "max-distance", NOT_NEGATIVE, "a finite number of mm, 0 or more", &["0"]),
    row("compare CLOUD MESH", "facing", &["0", "-1", "181", "nan"], "above 0 and up to 180", &[]),
    row("compare CLOUD MESH", "outliers", &["mad:0", "mad:-1", "0sigma"], "above 0", &["mad:1", "3sigma"]),
    row("compare CLOUD MESH", "coverage", NOT_POSITIVE, "above 0", &["0.1", "auto"]),
    row("compare CLOUD MESH", "along", &["0,0,0"], "not all 0", &["0,0,1"]),
    row("compare CLOUD MESH", "tolerance", &["0", "-1"], "above 0", &["1e-9", "-1,+2"]),
    row("compare CLOUD MESH", "min-coverage", NO_PERCENT, PERCENT, &["0", "100"]),
    row("compare CLOUD MESH --tolerance 1", "inside", NO_PERCENT, PERCENT, &["0", "100"]),
    row("compare CLOUD MESH", "worst", &["0", "-1", "1001"], "1..=1000", &["1", "1000"]),
    row("compare MESH MESH", "sample", &["0", "-1"], "a whole number, 1 or more", &["1"]),
    row("align CLOUD MESH --method zones", "tolerance", &["0", "-1"], "above 0", &[]),
    row("segment MESH", "tolerance", NOT_POSITIVE, ABOVE_0, &["0.1"]),
    row("segment MESH", "crease", &["0.5", "90", "120", "nan"], "between 1 and 89 degrees", &["1", "89"]),
    row("segment MESH", "min-share", NO_PERCENT, "between 0 and 100 percent", &["0", "100"]),
    row("segment MESH", "min-points", NO_COUNT, COUNT, &["0"]),
    row("section MESH", "plane", &["0,0,0,1", "0,0,1,inf"], "give", &["0,0,1,0.5"]),
    row("section MESH", "stack", &["0,0,1,0.9,0.1,0.2", "0,0,1,0.1,0.9,0"], "step", &["0,0,1,0.1,0.9,0.2"]),
    row("section CLOUD --plane 0,0,1,0", "thickness", NOT_POSITIVE, ABOVE_0, &["0.1"]),
    row("section CLOUD --plane 0,0,1,0 --thickness 1", "gap", NOT_POSITIVE, ABOVE_0, &["0.1"]),
    row("section ROW", "noise", &["0", "-1", "nan"], ABOVE_0, &["0.001"]),
    row("section ROW", "level", &["0", "-1", "100", "nan"], "between 1 and 100", &["1.1", "99.9"]),
    row("section ROW --airfoil", "stacking", &["nan,0", "inf,0"], "two numbers in mm", &["0,-1"]),
    row("section ROW --nominal ROW", "tolerance", &["0", "-1"], "above 0", &["1e-3", "-1,+2"]),
    row("section ROW --nominal ROW --tolerance 1", "inside", NO_PERCENT, PERCENT, &["0", "100"]),
    row("section ROW --nominal ROW --tolerance 1", "min-coverage", NO_PERCENT, PERCENT, &["0", "100"]),
    row("section ROW --nominal ROW", "max-distance", NOT_POSITIVE, "a finite number of mm above 0", &["1"]),
    row("surface SURFACE", "degree", &["0", "10", "-1"], "", &["1", "9"]),
    row("surface SURFACE", "spans", &["0", "3x0"], "at least 1 in each direction", &["1", "3x2"]),
    row("surface SURFACE", "tolerance", NOT_POSITIVE, ABOVE_0, &["0.1"]),
    row(
        "surface SURFACE",
        "fairness",
        &["-1", "nan", "inf"],
        "auto, or a number from 0 upwards",
        &["auto", "1"],
    ),
    row("surface SURFACE", "corrections", &["-1", "51"], "0..=50", &["0", "50"]),
    row("surface SURFACE", "trim", &["0", "-1", "nan", "inf"], "auto, or a length above 0", &["auto", "2"]),
    row("surface SURFACE --obj OBJ", "chord", NOT_POSITIVE, ABOVE_0, &["0.1"]),
    row("curvature SURFACE", "degree", &["1", "7", "-1"], "", &["2"]),
    row("curvature SURFACE", "neighbors", &["9", "10001", "-1"], "", &["10"]),
    row("curvature SURFACE", "radius", NOT_POSITIVE, ABOVE_0, &["3"]),
    row("convert MODEL OBJ", "chord", NOT_POSITIVE, ABOVE_0, &["0.1"]),
];

/// Options with these values take words, or the names of files.
const WORDS: [&str; 21] = [
    "FILE", "TEXT", "UNIT", "NAME", "LANG", "SIGN", "LIST", "AXES", "STEPS", "G", "WAY", "WHICH", "METHOD",
    "SHAPE", "BASE", "SIGN", "COLOR", "PROGRESS", "UP", "STYLE", "FORMAT",
];

/// A flat square of two triangles as STEP has faces: a plane within four lines.
fn square_face() -> String {
    let mut lines = vec![];
    let mut entity = |text: String| {
        lines.push(format!("#{} = {text};", lines.len() + 1));
        format!("#{}", lines.len())
    };
    let corners = [[0, 0], [9, 0], [9, 9], [0, 9]];
    let points = corners.map(|[x, y]| entity(format!("CARTESIAN_POINT('',({x}.,{y}.,0.))")));
    let vertices = points.clone().map(|p| entity(format!("VERTEX_POINT('',{p})")));
    let edges: Vec<String> = (0..4)
        .map(|k| {
            let [a, b] = [corners[k], corners[(k + 1) % 4]];
            let [x, y] = [(b[0] - a[0]) / 9, (b[1] - a[1]) / 9];
            let direction = entity(format!("DIRECTION('',({x}.,{y}.,0.))"));
            let vector = entity(format!("VECTOR('',{direction},1.)"));
            let line = entity(format!("LINE('',{},{vector})", points[k]));
            let edge = entity(format!("EDGE_CURVE('',{},{},{line},.T.)", vertices[k], vertices[(k + 1) % 4]));
            entity(format!("ORIENTED_EDGE('',*,*,{edge},.T.)"))
        })
        .collect();
    let bound = entity(format!("EDGE_LOOP('',({}))", edges.join(",")));
    let bound = entity(format!("FACE_OUTER_BOUND('',{bound},.T.)"));
    let [z, x] = ["0.,0.,1.", "1.,0.,0."].map(|d| entity(format!("DIRECTION('',({d}))")));
    let axes = entity(format!("AXIS2_PLACEMENT_3D('',{},{z},{x})", points[0]));
    let plane = entity(format!("PLANE('',{axes})"));
    let face = entity(format!("ADVANCED_FACE('',({bound}),{plane},.T.)"));
    let shell = entity(format!("OPEN_SHELL('',({face}))"));
    entity(format!("SHELL_BASED_SURFACE_MODEL('',({shell}))"));
    let head = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n\
                FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n";
    format!("{head}{}\nENDSEC;\nEND-ISO-10303-21;\n", lines.join("\n"))
}

#[test]
fn a_number_out_of_range_is_refused_with_its_range() {
    let f = Folder::new();
    let at = |x: u32, y: u32| [f64::from(x), f64::from(y)];
    let grid = || (0..20).flat_map(|x| (0..20).map(move |y| at(x, y)));
    let surface: String =
        grid().map(|[x, y]| format!("{x} {y} {}\n", 0.01 * (x - 9.0) * (y - 9.0))).collect();
    let cloud: String = (0..400)
        .map(|i| f64::from(i) * 0.05)
        .map(|a| format!("{} {} 0\n", 5.0 + libm::cos(a), libm::sin(a)))
        .collect();
    let bend: String =
        (0..90).map(|i| f64::from(i) * 0.1).map(|s| format!("{s} {}\n", 0.1 * (s - 4.5).abs())).collect();
    let files = [
        ("MESH", f.write("mesh.off", CUBE)),
        ("CLOUD", f.write("cloud.xyz", cloud)),
        ("ROW", f.write("row.txt", bend)),
        ("SURFACE", f.write("surface.xyz", surface)),
        ("MODEL", f.write("model.stp", square_face())),
        ("OUT", f.file("out.off")),
        ("OBJ", f.file("out.obj")),
    ];
    let run = |row: &Row, value: &str| {
        let file =
            |word: &str| files.iter().find(|(name, _)| *name == word).map(|(_, path)| path.to_str().unwrap());
        let words = row.command.split(' ').map(|word| file(word).unwrap_or(word).to_string());
        trueness(words.chain([format!("--{}={value}", row.option)]))
    };
    for row in ROWS {
        let name = format!("{} --{}", row.command, row.option);
        for value in row.refused {
            let o = run(row, value);
            let told = stderr(&o);
            assert_eq!(status(&o), 2, "{name} {value}: {told}");
            for part in [&format!("--{}", row.option), *value, row.range] {
                assert!(
                    told.to_lowercase().contains(&part.to_lowercase()),
                    "{name} {value} without {part:?}: {told}"
                );
            }
        }
        for value in row.allowed {
            let o = run(row, value);
            assert_ne!(status(&o), 2, "{name} {value}: {}", stderr(&o));
        }
    }
}

/// Every option with a value has its row, or takes words.
#[test]
fn every_number_option_has_its_range() {
    let commands = stdout(&trueness(["--help"]));
    let commands = commands.lines().skip_while(|l| *l != "Commands:").skip(1).take_while(|l| !l.is_empty());
    let commands: Vec<String> = commands
        .filter(|l| l.starts_with("  ") && !l.starts_with("   "))
        .filter_map(|l| l.split_whitespace().next())
        .map(String::from)
        .collect();
    assert!(commands.len() > 10, "{commands:?}");
    let known: BTreeSet<(&str, &str)> =
        ROWS.iter().map(|r| (r.command.split(' ').next().unwrap(), r.option)).collect();
    let common = |option: &str| ["threads", "seed", "html-budget"].contains(&option);
    let mut missing = vec![];
    for command in commands.iter().filter(|c| *c != "help") {
        let help = stdout(&trueness([command, "--help"]));
        for line in help.lines().filter(|l| l.trim_start().starts_with('-')) {
            let Some((_, rest)) = line.split_once("--") else { continue };
            let Some((option, value)) = rest.split_once(['<']) else { continue };
            let option = option.trim_end_matches([' ', '[', '=']);
            let value = value.split('>').next().unwrap();
            if !common(option) && !WORDS.contains(&value) && !known.contains(&(command.as_str(), option)) {
                missing.push(format!("{command} --{option} <{value}>"));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}
