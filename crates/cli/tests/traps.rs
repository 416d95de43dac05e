//! Faults of other programs, from their public issue threads, seen from the command line. (Those that concern a single
//! distance or sign stand beside the search in `trueness-geom`.)
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;
use common::*;

/// Deviations of points given as text from a mesh given as OFF, through `--out`.
fn deviations(points: &str, mesh: &str, more: &[&str]) -> Vec<f64> {
    let f = Folder::new();
    let (p, m, out) = (f.write("points.xyz", points), f.write("mesh.off", mesh), f.file("out.csv"));
    let mut words =
        vec!["compare".into(), p.into_os_string(), m.into_os_string(), "--out".into(), out.clone().into()];
    words.extend(more.iter().map(Into::into));
    let o = trueness(words);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    let text = std::fs::read_to_string(out).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("x,y,z,deviation"));
    lines.map(|l| l.rsplit(',').next().unwrap().parse().unwrap()).collect()
}

/// Open3D 5105: sign at edges and corners.
#[test]
fn sign_at_edges_and_corners() {
    let d = deviations("-1 -1 0\n-1 -1 -1\n0.5 0.5 0.5\n", CUBE, &[]);
    assert_eq!(d, [2f64.sqrt(), 3f64.sqrt(), -0.5]);
}

/// trimesh 73: a point exactly off an edge.
#[test]
fn sign_tie() {
    // The box [0, 2]³ is the unit cube in units of 2 mm.
    let mut lines: Vec<String> = CUBE.lines().map(String::from).collect();
    for line in &mut lines[2..10] {
        *line = line.replace('1', "2");
    }
    assert_eq!(deviations("3 2 2\n", &lines.join("\n"), &[]), [1.0]);
}

/// parry 76: a triangle with two equal corners.
#[test]
fn degenerate_triangle() {
    let mesh = "OFF\n3 1 0\n2.27699995 -7.9000001 16.3180008\n-0.569999993 -8.10000038 16.6070004\n-0.569999993 -8.10000038 16.6070004\n3 0 1 2\n";
    let d = deviations("1.10000002 -7.9000001 16.5879993\n", mesh, &["--sign", "none"]);
    assert!((d[0] - 0.1714783).abs() < 5e-8, "{}", d[0]);
}

/// CloudCompare 2247: NaN now and then on a single triangle; signed and unsigned.
#[test]
fn no_nan_on_a_triangle() {
    let mesh = "OFF\n3 1 0\n0 0 0\n0 0.5 0\n0.5 0 0\n3 0 1 2\n";
    let points = "0 0 8e-6\n0 0.5 0\n0.5 0 0\n".repeat(1000);
    for sign in ["none", "pseudonormal", "auto"] {
        let d = deviations(&points, mesh, &["--sign", sign]);
        assert_eq!(d.len(), 3000);
        for three in d.chunks(3) {
            assert_eq!([three[0].abs(), three[1], three[2]], [8e-6, 0.0, 0.0], "{sign}");
        }
    }
}

/// libigl 644: a facet doubled in opposite orientation. The mesh is reported, the sign is by winding number.
#[test]
fn doubled_opposite_facet() {
    let mesh = CUBE.replace("8 12 0", "8 13 0") + "3 0 1 2\n";
    let f = Folder::new();
    let (p, m) = (f.write("p.xyz", "0.5 0.5 0.5\n2 0.5 0.5\n0.4 0.5 -1\n"), f.write("m.off", mesh));
    let d = document(["compare".as_ref(), p.as_os_str(), m.as_os_str()]);
    let c = &d["comparisons"][0];
    assert_eq!(c["soundness"]["duplicate_facets"], 1);
    assert_eq!(c["soundness"]["sound"], false);
    assert_eq!(c["sign"]["method"], "winding");
    assert_eq!(c["deviation"]["negative"]["count"], 1);
    assert_eq!(c["deviation"]["all"]["max"], 1.0);
}

/// libigl 1060, 2348: where the winding number is a fraction, the distance is not scaled by it.
#[test]
fn winding_number_never_scales() {
    let open = CUBE.replace("8 12 0", "8 11 0").replace("3 3 7 5\n", "");
    let d = deviations("0.9 0.5 0.5\n0.5 0.5 0.5\n", &open, &["--sign", "winding"]);
    for (got, want) in d.iter().zip([0.1, 0.5]) {
        assert!((got.abs() - want).abs() < 1e-12, "{got}");
    }
}

/// PyMeshLab 34: per-point values in file order, also when some are excluded.
#[test]
fn values_in_file_order() {
    let f = Folder::new();
    let points: String =
        (0..1000).map(|i| format!("0.5 0.5 {}\n", 1.0 + (i * 7919 % 1000) as f64 / 100.0)).collect();
    let (p, m, out) = (f.write("p.xyz", points), f.write("m.off", CUBE), f.file("out.csv"));
    let words = ["compare".as_ref(), p.as_os_str(), m.as_os_str(), "--max-distance".as_ref(), "5".as_ref()];
    let o = trueness(words.into_iter().chain(["--out".as_ref(), out.as_os_str()]));
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    let text = std::fs::read_to_string(out).unwrap();
    for (i, line) in text.lines().skip(1).enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        let distance = (i * 7919 % 1000) as f64 / 100.0;
        match cells[3] {
            "" => assert!(distance > 5.0, "{line}"),
            d => assert!((d.parse::<f64>().unwrap() - distance).abs() < 1e-12 && distance <= 5.0, "{line}"),
        }
    }
    assert_eq!(text.lines().count(), 1001);
}

/// CloudCompare 1672: one answer, whatever the version: documents kept beside this test. After a change that is meant, write them anew
/// with `TRUENESS_BLESS=numbers`.
#[test]
fn documents_stay_as_they_are() {
    let golden = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    for (name, more) in [("cube", &["--research"][..]), ("cube-tolerance", &["--tolerance", "-0.2,0.6"])] {
        let f = Folder::new();
        let points: String =
            (0..200).map(|i| format!("{} {} {}\n", i % 7, i % 5, i as f64 / 40.0 - 1.0)).collect();
        let (p, m) = (f.write("p.xyz", points), f.write("m.off", CUBE));
        let words = ["compare".as_ref(), p.as_os_str(), m.as_os_str()];
        let mut d = document(words.into_iter().chain(more.iter().map(AsRef::as_ref)));
        d["version"] = "any".into();
        for input in d["inputs"].as_array_mut().unwrap() {
            input["path"] = "any".into();
        }
        d["comparisons"][0]["reference"] = "any".into();
        let text = serde_json::to_string_pretty(&d).unwrap() + "\n";
        let path = golden.join(format!("{name}.json"));
        if is_blessed("numbers") {
            std::fs::write(&path, &text).unwrap();
        }
        let kept = std::fs::read_to_string(&path).unwrap();
        assert!(text == kept, "{name}: the document changed:\n{text}");
    }
}

/// The vertices of a measured mesh are compared as they stand in the file, doubled ones too; only an STL is welded.
#[test]
fn vertices_of_a_mesh_keep_their_order() {
    let f = Folder::new();
    let doubled = "OFF\n6 2 0\n0 0 2\n1 0 3\n0 1 4\n1 0 3\n1 1 5\n0 1 4\n3 0 1 2\n3 3 4 5\n";
    let (m, r, out) = (f.write("m.off", doubled), f.write("r.off", CUBE), f.file("out.csv"));
    let o = trueness(["compare".as_ref(), m.as_os_str(), r.as_os_str(), "--out".as_ref(), out.as_os_str()]);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    let text = std::fs::read_to_string(out).unwrap();
    let d: Vec<f64> = text.lines().skip(1).map(|l| l.rsplit(',').next().unwrap().parse().unwrap()).collect();
    assert_eq!(d, [1.0, 2.0, 3.0, 2.0, 4.0, 3.0]);
}
