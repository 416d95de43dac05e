//! `trueness repair`: what is mended, the document, the file written, wrong inputs.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use crate::common::*;
use serde_json::json;
use std::ffi::OsStr;
use std::path::Path;

/// The words of a repair.
fn repair<'a>(mesh: &'a Path, out: &'a Path, more: &[&'a str]) -> Vec<&'a OsStr> {
    let words = ["repair".as_ref(), mesh.as_os_str(), "-o".as_ref(), out.as_os_str()];
    words.into_iter().chain(more.iter().map(|w| OsStr::new(*w))).collect()
}

fn open_cube() -> String {
    CUBE.replace("8 12 0", "8 11 0").replace("3 0 2 1\n", "")
}

#[test]
fn every_broken_part_of_the_corpus_becomes_sound() {
    let f = Folder::new();
    let names = [
        "all_inverted",
        "crack",
        "degenerate",
        "duplicate_opposite",
        "duplicates",
        "hole_one_triangle",
        "hole_two_loops",
        "nonmanifold_edge_fin",
        "nonmanifold_edge_two_boxes",
        "nonmanifold_vertex",
        "one_flipped",
        "t_junction",
        "unwelded_noise",
        "bin_nan",
    ];
    for name in names {
        let mesh = corpus(&format!("broken/{name}.stl"));
        for extension in ["stl", "ply"] {
            let out = f.file(&format!("{name}.{extension}"));
            let d = document(repair(&mesh, &out, &[]));
            assert_eq!(d["schema"], "trueness/repair/1");
            assert_eq!((&d["sound"], &d["output"]["sound"]), (&json!(true), &json!(true)), "{name}: {d}");
            assert_eq!(
                (&d["before"]["sound"], &d["after"]["closed"]),
                (&json!(false), &json!(true)),
                "{name}"
            );
            assert_eq!(
                (&d["vertices"]["moved"], &d["effect"]["changed"]),
                (&json!(0), &json!(false)),
                "{name}"
            );
            assert!(d["change_count"].as_u64().unwrap() > 0 || name == "bin_nan", "{name}");
            let o = trueness(["check".as_ref(), out.as_os_str()]);
            assert_eq!(status(&o), 0, "{name}.{extension}: {}", stdout(&o));
        }
    }
}

/// Boxes that cross and a spike through its own base: what keeps less or more than was enclosed is not called sound.
#[test]
fn what_is_closed_but_another_part_is_said() {
    let f = Folder::new();
    for name in ["self_intersecting_boxes", "self_intersecting_spike"] {
        let (mesh, out) = (corpus(&format!("broken/{name}.stl")), f.file("o.ply"));
        let d = document(repair(&mesh, &out, &[]));
        let (effect, volume) = (
            |key: &str| d["effect"][key].as_f64().unwrap(),
            |state: &str| d[state]["volume"].as_f64().unwrap(),
        );
        let (limit, turned) = (effect("volume_limit"), effect("volume_inverted"));
        let change = volume("after") - volume("before");
        let told = effect("volume_change");
        assert!([change, change - turned].iter().any(|c| (c - told).abs() < 1e-9), "{name}: {d}");
        assert!((limit - 1e-4 * (volume("before") + turned)).abs() < 1e-12, "{name}: {d}");
        if told.abs() > limit {
            assert_eq!((&d["sound"], &d["effect"]["changed"]), (&json!(false), &json!(true)), "{name}: {d}");
            let o = trueness(repair(&mesh, &out, &[]));
            assert_eq!(status(&o), 1, "{name}: {}", stderr(&o));
            assert!(
                stdout(&o).contains("CLOSED, BUT CHANGED") && stdout(&o).contains("limit"),
                "{}",
                stdout(&o)
            );
            assert_eq!(stdout(&o).contains("What looks inwards"), turned > 0.0, "{name}: {}", stdout(&o));
            let o = trueness(repair(&mesh, &out, &["--max-change", "1000"]));
            assert_eq!(status(&o), 0, "{name}: {}", stdout(&o));
        }
    }
}

/// A flake beside a body is no part of it; a larger sheet is, and the advice that is given closes or keeps it.
#[test]
fn a_loose_sheet_that_was_removed_is_said() {
    let f = Folder::new();
    for (size, changed) in [(0.1, false), (0.5, true)] {
        let (far, top) = (3.0 + size, size);
        let corners = format!("3 0 0\n{far} 0 0\n{far} {top} 0\n3 {top} {size}\n");
        let text = CUBE.replace("8 12 0", "12 14 0").replace("1 1 1\n", &format!("1 1 1\n{corners}"));
        let mesh = f.write("m.off", format!("{text}3 8 9 10\n3 8 10 11\n").as_bytes());
        let out = f.file("o.ply");
        let o = trueness(repair(&mesh, &out, &[]));
        assert_eq!(status(&o), i32::from(changed), "{size}: {}", stdout(&o));
        assert_eq!(stdout(&o).contains("CLOSED, BUT CHANGED"), changed, "{size}: {}", stdout(&o));
        assert_eq!(stdout(&o).contains("--all-holes closes them"), changed, "{size}: {}", stdout(&o));
        let o = trueness(repair(&mesh, &out, &["--all-holes"]));
        assert_eq!(status(&o), 0, "{size}: {}", stdout(&o));
    }
}

/// Facets around one edge: a body made of two of them is no mended book, however sound it is.
/// Bodies that touch in a part of a face become one: the contact vanishes, and what bounded the bodies stays where it was.
#[test]
fn bodies_that_touch_become_one_part_and_no_other() {
    let f = Folder::new();
    let mut touched = 0;
    for shift in 0..8u32 {
        let by = [f64::from(shift % 3), f64::from(shift % 4), 6.0];
        let boxes = [([0.0; 3], [6.0, 4.0, 6.0]), (by, [6.0, 8.0, 6.0])];
        let mut text = String::from("OFF\n16 24 0\n");
        for (low, size) in boxes {
            for i in 0..8u32 {
                let at = [0, 1, 2].map(|k| low[k] + if i >> (2 - k) & 1 == 1 { size[k] } else { 0.0 });
                text += &format!("{} {} {}\n", at[0], at[1], at[2]);
            }
        }
        for first in [0, 8] {
            for [a, b, c] in BOX {
                text += &format!("3 {} {} {}\n", a + first, b + first, c + first);
            }
        }
        let (mesh, out) = (f.write("touching.off", text), f.0.join(format!("{shift}.ply")));
        let d = document(repair(&mesh, &out, &[]));
        assert_eq!(
            (&d["sound"], &d["effect"]["changed"]),
            (&json!(true), &json!(false)),
            "{shift}: {}",
            d["effect"]
        );
        let volume = d["after"]["volume"].as_f64().unwrap();
        assert!((volume - 432.0).abs() < 1e-9, "{shift}: {volume}");
        touched += u32::from(d["effect"]["bodies_after"] == 1);
    }
    assert_eq!(touched, 8);
}

/// Facets of a box whose corner 4 x + 2 y + z lies at (x, y, z), outward.
const BOX: [[u32; 3]; 12] = [
    [1, 3, 0],
    [4, 1, 0],
    [0, 3, 2],
    [2, 4, 0],
    [1, 7, 3],
    [5, 1, 4],
    [5, 7, 1],
    [3, 7, 2],
    [6, 4, 2],
    [2, 7, 6],
    [6, 5, 4],
    [7, 5, 6],
];

#[test]
fn an_open_mesh_that_loses_its_surface_is_another_one() {
    let f = Folder::new();
    for pages in [8u32, 40, 100] {
        let page = |i: u32| {
            let turn = std::f64::consts::TAU * f64::from(i) / f64::from(pages);
            format!("v {} {} 0.5\n", turn.cos(), turn.sin())
        };
        let facets = (0..pages).map(|i| format!("f 1 2 {}\n", i + 3));
        let text: String =
            ["v 0 0 0\nv 0 0 1\n".into()].into_iter().chain((0..pages).map(page)).chain(facets).collect();
        let (book, out) = (f.write("book.obj", text), f.file("o.ply"));
        let d = document(repair(&book, &out, &[]));
        let [before, after] = ["before", "after"].map(|state| d[state]["area"].as_f64().unwrap());
        assert!(d["sound"] == false, "{d}");
        assert!(after > 0.9 * before || d["effect"]["changed"] == true, "{pages}: {before} {after}");
    }
}

/// Nothing that makes a mesh unsound is there more often in the result than in the file.
#[test]
fn no_file_of_the_corpus_gets_worse() {
    let f = Folder::new();
    let mut tried = 0;
    for folder in ["broken", "shapes"] {
        let mut files: Vec<_> =
            std::fs::read_dir(corpus(folder)).unwrap().map(|e| e.unwrap().path()).collect();
        files.sort();
        for mesh in files {
            let o = trueness(repair(&mesh, &f.file("o.ply"), &["--json", "-"]));
            // Files without a mesh are refused.
            let Ok(d) = serde_json::from_slice::<serde_json::Value>(&o.stdout) else { continue };
            let of = |state: &str| d[state]["defects"].as_object().unwrap().clone();
            let (before, after) = (of("before"), of("after"));
            let only_warnings = ["islands", "sliver_facets", "reversed_normals"];
            for (kind, count) in after.iter().filter(|(kind, _)| !only_warnings.contains(&kind.as_str())) {
                let was = before.get(kind).and_then(serde_json::Value::as_u64).unwrap_or(0);
                assert!(count.as_u64().unwrap() <= was, "{}: {kind}: {was}, then {count}", mesh.display());
            }
            assert!(d["after"]["closed"] == true || d["before"]["closed"] == false, "{}", mesh.display());
            tried += 1;
        }
    }
    assert!(tried > 80, "{tried}");
}

#[test]
fn the_table_tells_what_was_done_and_left() {
    let f = Folder::new();
    let (mesh, out) = (f.write("open.off", open_cube()), f.file("closed.obj"));
    let o = trueness(repair(&mesh, &out, &[]));
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    for words in ["hole filled", "0 moved, 8 kept", "holes", "sound; written to"] {
        assert!(stdout(&o).contains(words), "‘{words}’ is missing in: {}", stdout(&o));
    }
    let o = trueness(repair(&mesh, &out, &["--skip", "holes"]));
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    assert!(stdout(&o).contains("NOT SOUND") && stdout(&o).contains("--all-holes"), "{}", stdout(&o));
    let o = trueness(repair(&mesh, &out, &["--skip", "holes", "--all-holes"]));
    assert!(stdout(&o).contains("NOT SOUND") && !stdout(&o).contains("--all-holes"), "{}", stdout(&o));
    assert_eq!(f.names(), ["closed.obj", "open.off"]);
}

#[test]
fn what_a_mended_ply_loses_is_said() {
    let f = Folder::new();
    let header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n\
                  property uchar green\nproperty uchar blue\nelement face 4\nproperty list uchar int vertex_indices\nproperty float quality\n\
                  end_header\n";
    let rows = "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n0 0 1 9 9 9\n3 0 2 1 1\n3 0 1 3 1\n3 1 2 3 1\n3 2 0 3 1\n";
    let (mesh, out) = (f.write("colored.ply", format!("{header}{rows}")), f.file("o.ply"));
    let lost = "places and facets only; the file's other data are not in it: red, green, blue, quality";
    let o = trueness(repair(&mesh, &out, &[]));
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    assert!(stdout(&o).contains(lost), "{}", stdout(&o));
    assert!(document(repair(&mesh, &out, &[]))["inputs"][0]["warnings"][0].as_str().unwrap().contains(lost));
    // What the program writes itself has nothing to lose.
    assert!(
        document(repair(&out, &f.file("again.ply"), &[]))["inputs"][0]["warnings"]
            .as_array()
            .is_none_or(Vec::is_empty)
    );
}

#[test]
fn options_choose_steps_and_limits() {
    let f = Folder::new();
    let (mesh, out) = (f.write("open.off", open_cube()), f.file("o.ply"));
    for (options, closed) in [
        (&["--holes", "5"][..], false),
        (&["--holes", "10"], true),
        (&["--all-holes"], true),
        (&["--only", "orient,outward"], false),
        (&["--only", "holes"], true),
    ] {
        let d = document(repair(&mesh, &out, options));
        assert_eq!(d["after"]["closed"], closed, "{options:?}");
    }
    let d = document(repair(&mesh, &out, &["--only", "orient,holes"]));
    assert_eq!(d["steps"], json!(["orient", "holes"]));
    let d = document(repair(&mesh, &out, &["--items", "0"]));
    assert_eq!((&d["changes"], &d["change_count"], &d["truncated"]), (&json!([]), &json!(1), &json!(true)));
}

#[test]
fn a_sound_mesh_is_written_as_it_is() {
    let f = Folder::new();
    let (mesh, out) = (f.write("cube.off", CUBE), f.file("same.off"));
    let d = document(repair(&mesh, &out, &[]));
    assert_eq!((&d["change_count"], &d["vertices"]["kept"]), (&json!(0), &json!(8)));
    assert_eq!(d["deviation"]["removed"], json!({"max": 0.0, "mean": 0.0}));
    let lines =
        |text: &str| text.lines().filter(|l| !l.starts_with('#')).map(String::from).collect::<Vec<_>>();
    assert_eq!(lines(&std::fs::read_to_string(out).unwrap())[1..], lines(CUBE)[1..]);
}

/// Places that single precision cannot tell apart: sound as PLY, not as STL.
#[test]
fn what_a_format_cannot_hold_is_said() {
    let f = Folder::new();
    let far = CUBE.lines().map(|line| {
        let words: Vec<&str> = line.split(' ').collect();
        match words[..] {
            [x, y, z] if line != "8 12 0" => {
                let number = |w: &str| w.parse::<f64>().unwrap();
                format!("{} {} {}\n", 1e6 + 1e-3 * number(x), number(y), number(z))
            }
            _ => format!("{line}\n"),
        }
    });
    let mesh = f.write("far.off", far.collect::<String>());
    let d = document(repair(&mesh, &f.file("far.stl"), &[]));
    // Rounded first, as STL holds it, nothing would be left of it: it stays as it is, and the file is not sound.
    assert_eq!(
        (&d["after"]["sound"], &d["output"]["sound"], &d["sound"]),
        (&json!(true), &json!(false), &json!(false))
    );
    assert_eq!(d["after"]["facets"], 12);
    assert!(d["output"]["rounded_vertices"].as_u64().unwrap() > 0);
    let o = trueness(repair(&mesh, &f.file("far.stl"), &[]));
    assert_eq!(status(&o), 1);
    assert!(stdout(&o).contains("SOUND IN MEMORY ONLY"), "{}", stdout(&o));
    let d = document(repair(&mesh, &f.file("far.ply"), &[]));
    assert_eq!(d["sound"], true);
}

#[test]
fn wrong_usage_and_inputs_leave_nothing_behind() {
    let f = Folder::new();
    let (cube, points) = (f.write("cube.off", CUBE), f.write("p.xyz", "0 0 0\n1 1 1\n"));
    let cut = f.write("cut.stl", [b' '; 83]);
    let (out, odd, lost) = (f.file("o.stl"), f.file("o.png"), f.file("no/such/o.stl"));
    let before = f.names();
    let cases: [(&Path, &Path, &[&str], i32, &str); 9] = [
        (&cube, &out, &["--gap", "nan"], 2, "--gap"),
        (&cube, &out, &["--holes=-1"], 2, "--holes"),
        (&cube, &out, &["--max-change", "nan"], 2, "--max-change"),
        (&cube, &out, &["--only", "wonders"], 2, "outward"),
        (&cube, &out, &["--only", "holes", "--skip", "orient"], 2, "--skip"),
        (&cube, &odd, &[], 2, ".stl"),
        (&cube, &lost, &[], 3, "o.stl"),
        (&points, &out, &[], 3, "p.xyz"),
        (&cut, &out, &[], 3, "cut.stl"),
    ];
    for (mesh, out, options, want, word) in cases {
        let o = trueness(repair(mesh, out, options));
        assert_eq!(status(&o), want, "{options:?} {}: {}", out.display(), stderr(&o));
        assert!(stderr(&o).contains(word), "‘{word}’ is missing in: {}", stderr(&o));
        assert!(stdout(&o).is_empty(), "{}", stdout(&o));
    }
    assert_eq!(f.names(), before);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported() {
    let f = Folder::new();
    let cube = f.write("cube.off", CUBE);
    std::os::unix::fs::symlink("/dev/full", f.file("full.stl")).unwrap();
    let o = trueness(repair(&cube, &f.file("full.stl"), &[]));
    assert_eq!(status(&o), 3, "{}", stderr(&o));
    assert!(stderr(&o).contains("full.stl"), "{}", stderr(&o));
}
