//! Wrong units, a scan that lies elsewhere, words that can mean two things: noticed, and never guessed.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use crate::common::*;
use serde_json::json;

/// The corners and middles of a block of 100 × 60 × 20 mm, times `scale`, moved by `shift` along x.
fn block(scale: f64, shift: f64) -> String {
    let mut text = String::new();
    for i in 0..27 {
        let at = |k: i32, side: f64| f64::from(i / 3i32.pow(k as u32) % 3) * side / 2.0;
        text +=
            &format!("{} {} {}\n", scale * (at(0, 100.0) + shift), scale * at(1, 60.0), scale * at(2, 20.0));
    }
    text
}

fn block_mesh(scale: f64) -> String {
    let sides = [100.0 * scale, 60.0 * scale, 20.0 * scale];
    let corner = |line: &str| {
        let numbers: Vec<f64> = line.split(' ').map(|w| w.parse().unwrap()).collect();
        format!("{} {} {}", numbers[0] * sides[0], numbers[1] * sides[1], numbers[2] * sides[2])
    };
    CUBE.lines()
        .enumerate()
        .map(|(n, l)| if (2..10).contains(&n) { corner(l) } else { l.into() } + "\n")
        .collect()
}

#[test]
fn wrong_units_and_a_pose_of_its_own_are_noticed() {
    let f = Folder::new();
    let kinds = |d: &serde_json::Value| -> Vec<String> {
        let warnings = d["comparisons"][0]["warnings"].as_array().cloned().unwrap_or_default();
        warnings.iter().map(|w| w["kind"].as_str().unwrap().to_string()).collect()
    };
    let nominal = f.write("mm.off", block_mesh(1.0));
    let inches = f.write("in.off", block_mesh(1.0 / 25.4));
    for (name, points, reference, want) in [
        ("right.xyz", block(1.0, 0.0), &nominal, vec![]),
        ("metres.xyz", block(0.001, 0.0), &nominal, vec!["size_ratio"]),
        ("centimetres.xyz", block(0.1, 0.0), &nominal, vec!["size_ratio"]),
        ("both.xyz", block(0.001, 0.0), &inches, vec!["size_ratio"]),
        ("elsewhere.xyz", block(1.0, 300.0), &nominal, vec!["hardly_overlapping"]),
    ] {
        let points = f.write(name, points);
        let html = f.file("r.html");
        let words = ["compare".as_ref(), points.as_os_str(), reference.as_os_str()];
        let d = document(words.into_iter().chain(["--html".as_ref(), html.as_os_str()]));
        assert_eq!(kinds(&d), want, "{name}");
        assert!(d["inputs"][0]["bounds"]["max"].is_array() && d["inputs"][1]["bounds"]["max"].is_array());
        let o = trueness(words);
        let page = std::fs::read_to_string(html).unwrap();
        for (kind, word) in [("size_ratio", "is a unit wrong?"), ("hardly_overlapping", "not aligned")] {
            let there = want.contains(&kind);
            assert_eq!(stdout(&o).contains(word), there, "{name}: {}", stdout(&o));
            assert_eq!(page.contains(&format!("data-t=\"warning.{kind}\"")), there, "{name}");
        }
        if name == "metres.xyz" {
            let o = trueness(words.into_iter().chain(["-v".as_ref()]));
            assert!(stdout(&o).contains("0.100000 × 0.0600000 × 0.0200000 mm"), "{}", stdout(&o));
            assert!(stdout(&o).contains("100.000 × 60.0000 × 20.0000 mm"), "{}", stdout(&o));
            let right = document(
                words.into_iter().chain(["--units", "m", "--reference-units", "mm"].map(AsRef::as_ref)),
            );
            assert_eq!(kinds(&right), Vec::<String>::new());
        }
    }
}

#[test]
fn limits_without_signs_are_refused() {
    let f = Folder::new();
    let (p, c) = (f.write("p.xyz", "0 0 2\n"), f.write("c.off", CUBE));
    let (p, c) = (p.to_str().unwrap(), c.to_str().unwrap());
    for (text, hints) in [("0,1", ["0.1", "+0,+1"]), ("0.1,0.2", ["+0.1,+0.2", "signs"])] {
        let o = trueness(["compare", p, c, "--tolerance", text]);
        assert_eq!(status(&o), 2, "{text}: {}", stderr(&o));
        for hint in hints {
            assert!(stderr(&o).contains(hint), "{text}: {}", stderr(&o));
        }
    }
}

#[test]
fn two_columns_are_said_to_lie_in_a_plane() {
    let f = Folder::new();
    let (p, c) = (f.write("p.xyz", "0 0\n1 1\n0.5 0.5\n"), f.write("c.off", CUBE));
    let words = ["compare".as_ref(), p.as_os_str(), c.as_os_str()];
    let warnings = document(words)["inputs"][0]["warnings"].to_string();
    assert!(warnings.contains("z = 0"), "{warnings}");
    assert!(stdout(&trueness(words)).contains("z = 0"));
}

#[test]
fn columns_are_named_as_the_help_says() {
    let f = Folder::new();
    let p = f.write("p.xyz", "1 0 0 2\n2 1 1 3\n3 0.5 0.5 0.5\n");
    let c = f.write("c.off", CUBE);
    let (p, c) = (p.to_str().unwrap(), c.to_str().unwrap());
    let want = document(["compare", p, c, "--columns", "2,3,4"]);
    for words in [&["--columns", "-,x,y,z"][..], &["--columns=-,x,y,z"]] {
        let d = document(["compare", p, c].iter().chain(words));
        assert_eq!(d["comparisons"], want["comparisons"], "{words:?}");
    }
    let o = trueness(["compare", p, c, "--columns", "-,1,2,3"]);
    assert_eq!(status(&o), 2);
    assert!(stderr(&o).contains("-,x,y,z"), "{}", stderr(&o));
    let o = trueness(["fit", c, "--shape", "plane", "--columns", "1,2,3"]);
    assert_eq!(status(&o), 2, "{}", stderr(&o));
    assert!(stderr(&o).contains("no table") && stderr(&o).contains("leave --columns out"), "{}", stderr(&o));
}

#[test]
fn a_format_can_be_named() {
    let f = Folder::new();
    // A table of words alone is told by nothing.
    let odd = f.write("scan.foo", "hello\nworld\n");
    let odd = odd.to_str().unwrap();
    let o = trueness(["check", odd]);
    assert_eq!(status(&o), 3);
    assert!(stderr(&o).contains("--format"), "{}", stderr(&o));
    let o = trueness(["check", odd, "--format", "off"]);
    assert_eq!(status(&o), 3);
    assert!(stderr(&o).contains("line 1"), "{}", stderr(&o));
    let o = trueness(["check", odd, "--format", "foo"]);
    assert_eq!(status(&o), 2);
    assert!(stderr(&o).contains("ply, npy, pcd, ptx, las, e57, off, stl, obj"), "{}", stderr(&o));
    let cube = f.write("cube.foo", CUBE);
    assert_eq!(
        document(["check".as_ref(), cube.as_os_str(), "--format".as_ref(), "OFF".as_ref()])["sound"],
        true
    );
    for command in ["compare", "fit", "segment", "check", "repair"] {
        assert!(stdout(&trueness([command, "--help"])).contains("--format <NAME>"), "{command}");
    }
}

#[test]
fn all_points_excluded_have_no_shares() {
    let f = Folder::new();
    let (p, c) = (f.write("p.xyz", "0 0 20\n1 1 30\n"), f.write("c.off", CUBE));
    let html = f.file("r.html");
    let words = ["compare".as_ref(), p.as_os_str(), c.as_os_str()].into_iter();
    let words = words.chain(["--max-distance", "1", "--tolerance", "0.1", "--html"].map(AsRef::as_ref));
    let d = document(words.clone().chain([html.as_os_str()]));
    let t = &d["comparisons"][0]["tolerance"];
    for key in ["inside", "above", "below"] {
        assert!(t[key].is_null(), "{key}: {t}");
        assert_eq!(t[format!("{key}_reason")], "all points are excluded");
    }
    assert_eq!(d["verdict"], "undecided");
    let o = trueness(words.chain([html.as_os_str(), "-v".as_ref()]));
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    assert!(stdout(&o).contains("– % inside"), "{}", stdout(&o));
}

#[test]
fn a_weld_beyond_the_part_is_refused() {
    let f = Folder::new();
    let c = f.write("c.off", CUBE);
    let c = c.to_str().unwrap();
    for words in [&["check", c, "--weld", "1.8"][..], &["compare", c, c, "--weld", "1.8"]] {
        let o = trueness(words);
        assert_eq!(status(&o), 2, "{}", stderr(&o));
        assert!(stderr(&o).contains("--weld") && stderr(&o).contains("1.73"), "{}", stderr(&o));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn more_samples_than_memory_are_refused() {
    let f = Folder::new();
    let c = f.write("c.off", CUBE);
    let c = c.to_str().unwrap();
    let o = trueness(["compare", c, c, "--sample", "100000000000"]);
    assert_eq!(status(&o), 2, "{}", stderr(&o));
    assert!(stderr(&o).contains("7.2 TB of memory"), "{}", stderr(&o));
}

/// A limit on the memory of the program does what an exhausted machine does.
#[cfg(target_os = "linux")]
#[test]
fn too_little_memory_is_a_plain_word() {
    let f = Folder::new();
    let c = f.write("c.off", CUBE);
    let script =
        "ulimit -v 1500000; exec \"$0\" compare \"$1\" \"$1\" --sample 60000000 --threads 1 --json \"$2\"";
    let mut bash = std::process::Command::new("bash");
    bash.args(["-c", script, env!("CARGO_BIN_EXE_trueness")]).arg(&c).arg(f.file("o.json"));
    let o = bash.env("RUST_BACKTRACE", "1").output().unwrap();
    assert_eq!(status(&o), 3, "{}", stderr(&o));
    assert!(stderr(&o).contains("not enough memory") && stderr(&o).lines().count() == 1, "{}", stderr(&o));
    assert_eq!(f.names(), ["c.off"]);
}

#[test]
fn a_mesh_by_itself_is_no_reference() {
    let f = Folder::new();
    let (c, out) = (f.write("c.off", CUBE), f.file("o.off"));
    let role = |words: &[&std::ffi::OsStr]| document(words)["inputs"][0]["role"].clone();
    assert_eq!(role(&["check".as_ref(), c.as_os_str()]), json!("mesh"));
    assert_eq!(role(&["repair".as_ref(), c.as_os_str(), "-o".as_ref(), out.as_os_str()]), json!("mesh"));
}

/// One minus sign in all tables, plain ones in documents, and one point is one point.
#[test]
fn tables_speak_alike() {
    let f = Folder::new();
    let shifted = CUBE.replace("0 0 0\n1 0 0\n", "-0.5 0 0\n1 0 0\n");
    let (c, p) = (f.write("c.off", shifted), f.write("p.xyz", "-1 -1 -1\n"));
    let plane = f.write("q.xyz", "-5 -1 -2\n-6 -3 -2\n-7 -2 -2\n-8 -9 -2\n");
    let (c, p, plane, out) =
        (c.to_str().unwrap(), p.to_str().unwrap(), plane.to_str().unwrap(), f.file("o.off"));
    for words in [
        vec!["check", c],
        vec!["repair", c, "-o", out.to_str().unwrap()],
        vec!["compare", p, c],
        vec!["fit", plane, "--shape", "plane"],
        vec!["segment", c],
    ] {
        let o = trueness(&words);
        let folder = f.0.to_str().unwrap();
        let text = stdout(&o).replace(folder, "");
        assert!(!text.is_empty(), "{words:?}: {}", stderr(&o));
        let hyphen = text.as_bytes().windows(2).any(|w| w[0] == b'-' && w[1].is_ascii_digit());
        assert!(!hyphen, "{words:?}: {text}");
        for wrong in [" 1 points", " 1 shells", " 1 facets", " 1 vertices", "1 regions"] {
            assert!(!format!(" {text}").contains(wrong), "{words:?}: ‘{wrong}’ in {text}");
        }
    }
    let d = document(["compare", p, c]).to_string();
    assert!(d.contains("-1.0") && !d.contains('−'));
}
