//! What cannot be answered: right exit status, one clear message with file, place and remedy, nothing half written.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use crate::common::*;
use std::path::Path;

const POINTS: &str = "0 0 2\n1 1 3\n0.5 0.5 0.5\n";

/// Runs `compare`, expects `want` as exit status and all `words` in a short message, and that no file appeared.
fn refused(f: &Folder, measured: &Path, reference: &Path, want: i32, words: &[&str]) {
    let before = f.names();
    let (json, out, html) = (f.file("new.json"), f.file("new.csv"), f.file("new.html"));
    let all = ["compare".as_ref(), measured.as_os_str(), reference.as_os_str()];
    let files = [
        "--json".as_ref(),
        json.as_os_str(),
        "--out".as_ref(),
        out.as_os_str(),
        "--html".as_ref(),
        html.as_os_str(),
    ];
    let o = trueness(all.into_iter().chain(files));
    let text = stderr(&o);
    assert_eq!(status(&o), want, "{text}");
    for w in words {
        assert!(text.contains(w), "‘{w}’ is missing in: {text}");
    }
    assert!(text.lines().count() <= 3, "one message, not a page: {text}");
    assert!(stdout(&o).is_empty(), "no table: {}", stdout(&o));
    assert_eq!(f.names(), before, "nothing may be left behind");
}

fn binary_stl(facets: u32, count: u32) -> Vec<u8> {
    let mut b = vec![b' '; 80];
    b.extend(count.to_le_bytes());
    for i in 0..facets {
        b.extend([0u8; 12]);
        for c in [[0.0, 0.0, i as f32], [1.0, 0.0, i as f32], [0.0, 1.0, i as f32]] {
            b.extend(c.iter().flat_map(|x: &f32| x.to_le_bytes()));
        }
        b.extend([0u8; 2]);
    }
    b
}

#[test]
fn empty_files() {
    let f = Folder::new();
    let (points, cube) = (f.write("p.xyz", POINTS), f.write("c.off", CUBE));
    for name in ["e.stl", "e.ply", "e.xyz", "e.obj", "e.off"] {
        let empty = f.write(name, "");
        refused(&f, &empty, &cube, 3, &[name, "empty"]);
        refused(&f, &points, &empty, 3, &[name, "empty"]);
    }
}

#[test]
fn truncated_files() {
    let f = Folder::new();
    let points = f.write("p.xyz", POINTS);
    let stl = f.write("cut.stl", &binary_stl(100, 100)[..3000]);
    refused(&f, &points, &stl, 3, &["cut.stl", "100"]);
    let off = f.write("cut.off", &CUBE[..CUBE.len() - 30]);
    refused(&f, &points, &off, 3, &["cut.off", "line"]);
}

#[test]
fn wrong_counts() {
    let f = Folder::new();
    let points = f.write("p.xyz", POINTS);
    let stl = f.write("count.stl", binary_stl(100, 4_000_000_000));
    refused(&f, &points, &stl, 3, &["count.stl", "4000000000"]);
    let ply = "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n";
    let ply = f.write("count.ply", ply);
    refused(&f, &ply, &f.write("c.off", CUBE), 3, &["count.ply", "9"]);
}

#[test]
fn not_a_number() {
    let f = Folder::new();
    let (cube, bad) = (f.write("c.off", CUBE), f.write("nan.xyz", "0 0 1\n0 nan 1\n"));
    refused(&f, &bad, &cube, 3, &["nan.xyz", "line 2"]);
}

#[test]
fn not_a_mesh() {
    let f = Folder::new();
    let (points, picture) =
        (f.write("p.xyz", POINTS), f.write("photo.stl", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"));
    refused(&f, &points, &picture, 3, &["photo.stl"]);
    refused(&f, &points, &points, 3, &["p.xyz", "mesh"]);
}

#[test]
fn directory_missing_and_unreadable() {
    let f = Folder::new();
    let (points, cube) = (f.write("p.xyz", POINTS), f.write("c.off", CUBE));
    refused(&f, &points, &f.0.clone(), 3, &[f.0.to_str().unwrap(), "folder"]);
    refused(&f, &f.file("none.ply"), &cube, 3, &["none.ply"]);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let locked = f.write("locked.stl", CUBE);
        std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(0o000)).unwrap();
        // Whoever may read everything cannot be refused.
        if std::fs::read(&locked).is_err() {
            refused(&f, &points, &locked, 3, &["locked.stl"]);
        }
    }
}

/// Writing breaks off in the middle, as on a full disk: a limit on the size of files does the same to any program.
#[test]
#[cfg(target_os = "linux")]
fn disk_full_while_writing() {
    let f = Folder::new();
    let points: String = (0..20_000).map(|i| format!("{}.5 0.25 0.125\n", i)).collect();
    let (points, cube) = (f.write("p.xyz", points), f.write("c.off", CUBE));
    let before = f.names();
    for (option, name) in [
        ("--out", "d.csv"),
        ("--out", "d.ply"),
        ("--out", "d.npz"),
        ("--out", "d.parquet"),
        ("--out", "d.vtp"),
        ("--html", "d.html"),
    ] {
        let script = format!("trap '' XFSZ; ulimit -f 16; exec \"$0\" compare \"$1\" \"$2\" {option} \"$3\"");
        let mut command = std::process::Command::new("bash");
        command.args(["-c", &script]).arg(env!("CARGO_BIN_EXE_trueness"));
        let o = command.arg(&points).arg(&cube).arg(f.file(name)).output().unwrap();
        assert_eq!(status(&o), 3, "{name}: {}", stderr(&o));
        assert!(stderr(&o).contains(name), "{}", stderr(&o));
        assert_eq!(f.names(), before, "{name}: nothing may be left behind");
    }
}

#[test]
fn output_that_cannot_be_written() {
    let f = Folder::new();
    let (points, cube) = (f.write("p.xyz", POINTS), f.write("c.off", CUBE));
    for (option, name, want) in [
        ("--json", "no/such/out.json", 3),
        ("--html", "no/such/out.html", 3),
        ("--out", "no/such/out.csv", 3),
        ("--out", "out.xyzzy", 2),
    ] {
        let target = f.file(name);
        let words =
            ["compare".as_ref(), points.as_os_str(), cube.as_os_str(), option.as_ref(), target.as_os_str()];
        let o = trueness(words);
        assert_eq!(status(&o), want, "{option}: {}", stderr(&o));
        assert!(stderr(&o).contains(name), "{}", stderr(&o));
    }
}

#[test]
fn wrong_usage() {
    let f = Folder::new();
    let (points, cube) = (f.write("p.xyz", POINTS), f.write("c.off", CUBE));
    let (p, c) = (points.to_str().unwrap(), cube.to_str().unwrap());
    for (words, hint) in [
        (&["compare", p][..], "REFERENCE"),
        (&["compare", p, c, "--tolerance", "x"], "±0.1"),
        (&["compare", p, c, "--tolerence", "1"], "--tolerance"),
        (&["compare", p, c, "--sign", "windng"], "winding"),
        (&["compare", p, c, "--max-distance", "-1"], "0 or more"),
        (&["compare", p, c, "--max-distance", "1e400"], "a finite number of mm"),
        (&["compare", p, c, "--inside", "101", "--tolerance", "1"], "percent"),
        (&["compare", p, c, "--both"], "measured mesh"),
        (&["compare", p, c, "--sample", "10"], "measured mesh"),
        (&["compare", p, c, "--units", "furlong"], "mm"),
        (&["compare", p, c, "--threads", "0"], "threads"),
        (&["compare", p, c, "--json", "a", "--html", "a"], "same file"),
        (&["compear", p, c], "compare"),
    ] {
        let o = trueness(words);
        assert_eq!(status(&o), 2, "{words:?}: {}", stderr(&o));
        assert!(stderr(&o).contains(hint), "{words:?}: ‘{hint}’ is missing in {}", stderr(&o));
    }
}
