//! `trueness check`: verdict, document, table, wrong inputs.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use crate::common::*;
use serde_json::json;

#[test]
fn a_sound_mesh_is_described_and_conforms() {
    let f = Folder::new();
    let cube = f.write("cube.off", CUBE);
    let d = document(["check".as_ref(), cube.as_os_str()]);
    assert_eq!(d["schema"], "trueness/check/1");
    assert_eq!((&d["sound"], &d["precondition"]), (&json!(true), &json!(true)));
    for (key, want) in [("facets", 12), ("vertices", 8), ("edges", 18), ("shells", 1), ("genus", 0)] {
        assert_eq!(d[key], want, "{key}");
    }
    assert_eq!((&d["volume"], &d["area"]), (&json!(1.0), &json!(6.0)));
    assert_eq!(d["dimensions"], json!([1.0, 1.0, 1.0]));
    assert_eq!(d["centre_of_mass"], json!([0.5, 0.5, 0.5]));
    assert_eq!(d["defects"].as_object().unwrap().len(), 17);
    assert!(d["defects"]["reversed_normals"]["count"].is_null());
    let o = trueness(["check".as_ref(), cube.as_os_str()]);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    assert!(stdout(&o).contains("12 facets, 8 vertices, 18 edges, 1 shell\n"), "{}", stdout(&o));
    assert!(stdout(&o).ends_with("\nsound\n"), "{}", stdout(&o));
}

/// Two boxes that cross: the place they share is counted twice, and the table, the document and the report say so.
#[test]
fn the_volume_of_crossing_bodies_says_what_it_counts_twice() {
    let f = Folder::new();
    let (mesh, html) = (corpus("broken/self_intersecting_boxes.stl"), f.file("r.html"));
    let said = "in common counts as often as there are bodies";
    let o = trueness(["check".as_ref(), mesh.as_os_str(), "--html".as_ref(), html.as_os_str()]);
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    let row = stdout(&o).lines().find(|l| l.starts_with("volume")).unwrap().to_string();
    assert!(row.contains("mm³") && row.contains(said), "{row}");
    let d = document(["check".as_ref(), mesh.as_os_str()]);
    assert!(d["volume"].is_f64() && d["volume_note"].as_str().unwrap().contains(said));
    assert!(std::fs::read_to_string(html).unwrap().contains("data-t=\"volume.overlaps\""));
    let cube = f.write("cube.off", CUBE);
    assert!(document(["check".as_ref(), cube.as_os_str()])["volume_note"].is_null());
}

#[test]
fn a_hole_is_found_with_its_place() {
    let f = Folder::new();
    let open = f.write("open.off", CUBE.replace("8 12 0", "8 11 0").replace("3 0 2 1\n", ""));
    let json = f.file("check.json");
    let o = trueness(["check".as_ref(), open.as_os_str(), "--json".as_ref(), json.as_os_str()]);
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    assert!(stdout(&o).contains("holes") && stdout(&o).ends_with("NOT SOUND\n"), "{}", stdout(&o));
    let d: serde_json::Value = serde_json::from_slice(&std::fs::read(json).unwrap()).unwrap();
    let hole = &d["defects"]["holes"]["items"][0];
    assert_eq!((&hole["edges"], &hole["area"]), (&json!(3.0), &json!(0.5)));
    assert_eq!(hole["position"][2], 0.0);
    assert!(d["volume"].is_null() && d["volume_reason"].is_string() && d["genus"].is_null());
}

#[test]
fn wrong_inputs_are_refused_with_a_remedy() {
    let f = Folder::new();
    let points = f.write("p.xyz", "0 0 0\n1 1 1\n");
    let o = trueness(["check".as_ref(), points.as_os_str()]);
    assert_eq!(status(&o), 3);
    assert!(stderr(&o).contains("this command needs a mesh"), "{}", stderr(&o));
    let cube = f.write("cube.off", CUBE);
    let o = trueness(["check".as_ref(), cube.as_os_str(), "--gap".as_ref(), "nan".as_ref()]);
    assert_eq!(status(&o), 2, "{}", stderr(&o));
}

#[test]
fn a_report_says_what_the_document_says() {
    let f = Folder::new();
    let open = f.write("open.off", CUBE.replace("8 12 0", "8 11 0").replace("3 0 2 1\n", ""));
    let html = f.file("report.html");
    let o = trueness(["check".as_ref(), open.as_os_str(), "--html".as_ref(), html.as_os_str()]);
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    let text = std::fs::read_to_string(html).unwrap();
    assert!(text.starts_with("<!doctype html>") && text.contains(">Not sound · open.off</title>"));
    assert!(text.contains("data-t=\"defect.holes\">Holes</span>"));
    assert_eq!(f.names(), ["open.off", "report.html"]);
}

#[test]
fn an_empty_model_is_not_sound_in_any_format() {
    for file in ["shapes/trimesh__empty.ply", "shapes/trimesh__obj_empty.obj", "broken/bin_zero.stl"] {
        let o = trueness(["check".as_ref(), corpus(file).as_os_str()]);
        assert_eq!(status(&o), 1, "{file}: {}", stderr(&o));
        assert!(stdout(&o).contains("0 facets") && stdout(&o).contains("neither faces nor points"), "{file}");
    }
}

#[test]
fn an_unsound_reference_is_compared_all_the_same_and_its_flaws_are_named() {
    let f = Folder::new();
    let open = f.write("open.off", CUBE.replace("8 12 0", "8 11 0").replace("3 0 2 1\n", ""));
    let points = f.write("p.xyz", "0.5 0.5 1.25\n0.5 0.5 0.75\n");
    let d = document(["compare".as_ref(), points.as_os_str(), open.as_os_str()]);
    let c = &d["comparisons"][0];
    assert_eq!((&c["soundness"]["sound"], &c["sign"]["method"]), (&json!(false), &json!("winding")));
    let findings = c["soundness"]["findings"].as_object().unwrap();
    assert_eq!(findings.keys().collect::<Vec<_>>(), ["boundary_edges", "holes"]);
    assert_eq!(
        (&findings["holes"]["count"], &findings["holes"]["items"][0]["area"]),
        (&json!(1), &json!(0.5))
    );
    assert_eq!(c["deviation"]["all"]["max"], 0.25);
    assert_eq!(c["deviation"]["all"]["min"], -0.25);
    let words = ["compare".as_ref(), points.as_os_str(), open.as_os_str()];
    let text = stdout(&trueness(words));
    assert!(text.contains("the reference is not sound (3 boundary edges); signs by winding"), "{text}");
    // Where the flaws are the whole table tells.
    let text = stdout(&trueness(words.into_iter().chain(["-v".as_ref()])));
    for words in [
        "not sound: 3 boundary edges",
        "holes: 1, the largest at",
        "compared all the same; the signs are those of the method winding",
    ] {
        assert!(text.contains(words), "{text}");
    }
    let whole = f.write("cube.off", CUBE);
    let d = document(["compare".as_ref(), points.as_os_str(), whole.as_os_str()]);
    assert!(d["comparisons"][0]["soundness"].get("findings").is_none());
}

#[test]
fn a_comparison_shows_where_its_reference_is_not_sound() {
    let f = Folder::new();
    let cube = f.write("cube.off", CUBE);
    let open = f.write("open.off", CUBE.replace("8 12 0", "8 11 0").replace("3 0 2 1\n", ""));
    let html = f.file("report.html");
    let o = trueness([
        "compare".as_ref(),
        cube.as_os_str(),
        open.as_os_str(),
        "--html".as_ref(),
        html.as_os_str(),
    ]);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    let text = std::fs::read_to_string(html).unwrap();
    let list = text.split_once("data-t=\"reference.defects\"").unwrap().1;
    assert!(list.contains("data-t=\"defect.boundary_edges\"") && list.contains("<tr data-pick="));
    assert!(text.contains("\"role\":\"defects\"") && text.contains("\"comparison\":0"));
}

#[test]
fn vertices_within_the_distance_of_weld_are_one() {
    let f = Folder::new();
    // The first face of the cube has a corner of its own, a tenth of a millimeter beside the other's.
    let torn = CUBE.replace("8 12 0", "9 12 0").replace("\n3 0 2 1\n", "\n0.1 0 0\n3 8 2 1\n");
    let torn = f.write("torn.off", torn);
    let with = |weld: &str| document(["check".as_ref(), torn.as_os_str(), "--weld".as_ref(), weld.as_ref()]);
    assert_eq!(document(["check".as_ref(), torn.as_os_str()])["sound"], false);
    assert_eq!((&with("0.05")["sound"], &with("0.05")["vertices"]), (&json!(false), &json!(9)));
    let d = with("0.2");
    assert_eq!((&d["sound"], &d["vertices"], &d["volume"]), (&json!(true), &json!(8), &json!(1.0)));
    assert_eq!(d["inputs"][0]["warnings"], json!(["9 vertices became 8: those within 0.2 mm were joined"]));
    let sound = |weld: &[&str]| {
        let files = ["compare".as_ref(), torn.as_os_str(), torn.as_os_str()];
        let d = document(files.into_iter().chain(weld.iter().map(|w| (*w).as_ref())));
        d["comparisons"][0]["soundness"]["sound"].clone()
    };
    assert_eq!((sound(&[]), sound(&["--weld", "0.2"])), (json!(false), json!(true)));
    let o = trueness(["check".as_ref(), torn.as_os_str(), "--weld".as_ref(), "-1".as_ref()]);
    assert_eq!(status(&o), 2, "{}", stderr(&o));
    assert!(stderr(&o).contains("--weld -1: give a number from 0 upwards"), "{}", stderr(&o));
}

/// What the reader leaves out moves no number: those of the document are those of the file.
#[test]
fn facets_have_the_numbers_of_the_file() {
    let f = Folder::new();
    let facet = |t: [[f64; 3]; 3]| {
        let corner = |p: [f64; 3]| format!("vertex {} {} {}\n", p[0], p[1], p[2]);
        format!("facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n", t.map(corner).concat())
    };
    let [o, x, y, z] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let nan = [[f64::NAN, 0.0, 0.0], x, y];
    let facets = [nan, [o, y, x], [o, x, z], [x, y, z], nan, [o, y, x], [y, o, z]];
    let stl = f.write("p.stl", format!("solid p\n{}endsolid p\n", facets.map(facet).concat()));
    let checked = document(["check".as_ref(), stl.as_os_str()]);
    assert_eq!(checked["facets"], 7);
    assert_eq!(checked["defects"]["duplicate_facets"]["items"][0]["facets"], serde_json::json!([1, 5]));
    assert_eq!(checked["defects"]["not_finite_facets"]["count"], 2);
    let points = f.write("p.xyz", "0 0 0\n0.1 0.1 0.2\n");
    let compared = document(["compare".as_ref(), points.as_os_str(), stl.as_os_str()]);
    let soundness = &compared["comparisons"][0]["soundness"];
    for kind in ["duplicate_facets", "not_finite_facets"] {
        assert_eq!(checked["defects"][kind], soundness["findings"][kind], "{kind}");
    }
    assert_eq!((&soundness["sound"], &soundness["not_finite_facets"]), (&json!(false), &json!(2)));
    let part = trueness::read(&stl).unwrap();
    assert_eq!(part.nonfinite_facets, [0, 4]);
    let report = trueness::check(&part).unwrap();
    assert!(!report.sound && report.count(trueness::geom::check::NOT_FINITE_FACETS) == 2);
}
