//! The per-point files of `trueness compare`.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use crate::common::*;

#[test]
fn what_people_look_at_is_colored_without_a_scale_too() {
    let f = Folder::new();
    let cube = f.write("cube.off", CUBE);
    let points = f.write("p.xyz", "0.5 0.5 1.25\n0.5 0.5 0.875\n0.5 1.5 0.5\n0.5 0.5 30\n");
    let compare = |more: &[&std::ffi::OsStr]| {
        let files = [
            "compare".as_ref(),
            points.as_os_str(),
            cube.as_os_str(),
            "--max-distance".as_ref(),
            "9".as_ref(),
        ];
        document(files.into_iter().chain(more.iter().copied()))
    };
    for extension in ["ply", "vtp", "csv"] {
        let [plain, scaled] = ["plain", "scaled"].map(|name| f.file(&format!("{name}.{extension}")));
        let d = compare(&["--out".as_ref(), plain.as_os_str()]);
        let scale = f.write("scale.json", d["scale"].to_string());
        compare(&["--out".as_ref(), scaled.as_os_str(), "--scale".as_ref(), scale.as_os_str()]);
        let same = std::fs::read(plain).unwrap() == std::fs::read(scaled).unwrap();
        assert_eq!(same, extension != "csv", "{extension}");
    }
    let ply = String::from_utf8_lossy(&std::fs::read(f.file("plain.ply")).unwrap()).into_owned();
    assert!(ply.contains("property uchar red"), "{ply}");
}

#[test]
fn every_format_is_listed_and_has_its_page() {
    let list = stdout(&trueness(["formats"]));
    for format in trueness::files::FORMATS {
        assert!(list.lines().any(|l| l.split_whitespace().next() == Some(format.name)), "{}", format.name);
        assert_eq!(stdout(&trueness(["formats", format.name])), format.manual);
        for ending in format.extensions.iter().chain(format.written_as) {
            assert!(list.contains(&format!(".{ending}")), "{ending}");
            assert_eq!(stdout(&trueness(["formats", &format!(".{ending}")])), page(ending), "{ending}");
        }
    }
    let unknown = trueness(["formats", "doc"]);
    assert_eq!(status(&unknown), 2);
    assert!(
        stderr(&unknown).contains("doc: there is no such format; there are ply, "),
        "{}",
        stderr(&unknown)
    );
}

/// The page of the only format that files of this ending have.
fn page(ending: &str) -> &'static str {
    let has =
        |f: &&&trueness::files::Format| f.extensions.contains(&ending) || f.written_as.contains(&ending);
    let all: Vec<_> = trueness::files::FORMATS.iter().filter(has).collect();
    assert_eq!(all.len(), 1, "{ending}");
    all[0].manual
}
