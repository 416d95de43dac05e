//! `trueness section` of what is exact: outlines by the ends of lines and the vertices of arcs, and circles through facets.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, corpus, document};

/// Rows, kinds and lengths of the segments, and whether the row must be told that it is closed.
type Outline = (String, Vec<(&'static str, f64)>, bool);

/// A rectangle of 20 by 12 with corners of radius 3, an obround of radius 4, and a half disc, in `count` points to an arc.
fn outlines(count: usize) -> [Outline; 3] {
    let arc = |center: [f64; 2], r: f64, from: f64, sweep: f64| -> String {
        let at = |i: usize| (from + sweep * i as f64 / (count - 1) as f64).to_radians();
        (0..count)
            .map(|i| format!("{:.6} {:.6}\n", center[0] + r * at(i).cos(), center[1] + r * at(i).sin()))
            .collect()
    };
    let corners = [([7.0, 3.0], 0.0), ([-7.0, 3.0], 90.0), ([-7.0, -3.0], 180.0), ([7.0, -3.0], 270.0)];
    let quarter = 1.5 * std::f64::consts::PI;
    [
        (
            corners.iter().map(|(c, a)| arc(*c, 3.0, *a, 90.0)).collect(),
            [14.0, 6.0].repeat(2).into_iter().flat_map(|l| [("arc", quarter), ("line", l)]).collect(),
            false,
        ),
        (
            arc([10.0, 0.0], 4.0, -90.0, 180.0) + &arc([-10.0, 0.0], 4.0, 90.0, 180.0),
            [4.0 * std::f64::consts::PI, 20.0]
                .repeat(2)
                .into_iter()
                .zip(["arc", "line"].repeat(2))
                .map(|(l, k)| (k, l))
                .collect(),
            false,
        ),
        (
            arc([0.0, 0.0], 10.0, -90.0, 180.0),
            vec![("arc", 10.0 * std::f64::consts::PI), ("line", 20.0)],
            true,
        ),
    ]
}

/// No side is lost, and tangents close the row by themselves; corners need `--closed`.
#[test]
fn outlines_by_vertices_keep_their_sides() {
    let folder = Folder::new();
    for count in [5, 9, 17] {
        for (k, (text, truth, asks)) in outlines(count).into_iter().enumerate() {
            let file = folder.write(&format!("{k}_{count}.txt"), text);
            let file = file.to_str().unwrap();
            let answer =
                if asks { document(["section", file, "--closed"]) } else { document(["section", file]) };
            let contour = &answer["contours"][0];
            assert_eq!(contour["closed"], true, "{k} {count}");
            let found: Vec<(&str, f64)> = contour["segments"]
                .as_array()
                .unwrap()
                .iter()
                .map(|s| (s["kind"].as_str().unwrap(), s["length"].as_f64().unwrap()))
                .collect();
            assert_eq!(found.len(), truth.len(), "{k} {count}: {found:?}");
            // A closed list may start at any segment.
            let same = |by: usize| {
                let ahead = truth.iter().cycle().skip(by);
                found.iter().zip(ahead).all(|(f, t)| f.0 == t.0 && (f.1 - t.1).abs() < 1e-4)
            };
            assert!((0..truth.len()).any(same), "{k} {count}: {found:?}");
        }
    }
}

/// The pocket of the plate, a part of a sphere, is a circle at all heights between two rings of its facets.
#[test]
fn circles_of_a_pocket_run_along_their_facets() {
    let plate = corpus("examples/plate/nominal.stl");
    let plate = plate.to_str().unwrap();
    for k in 1..=9 {
        let answer = document(["section", plate, "--plane", &format!("0,0,1,16.{k}")]);
        let contours = answer["contours"].as_array().unwrap();
        assert!(contours.iter().all(|c| c["astray"].as_array().is_none_or(Vec::is_empty)), "16.{k}");
        let z = 16.0 + 0.1 * f64::from(k);
        let radius = (100.0 - (23.0 - z).powi(2)).sqrt();
        let near = |r: f64| (r - radius).abs() < 0.05;
        let radii = contours.iter().filter_map(|c| c["segments"][0]["radius"].as_f64());
        assert!(radii.into_iter().any(near), "16.{k}: {radius}");
    }
}

/// Plates with rounded corners, as their meshes are drawn and with their facets in any order: four lines and four arcs of one radius outside.
#[test]
fn drawn_plates_are_exact_in_any_order() {
    let folder = Folder::new();
    let table = std::fs::read_to_string(corpus("sections/README.md")).unwrap();
    let rows: Vec<(String, String)> = table
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split_once("` | "))
        .map(|(file, plane)| (file.to_string(), plane.split(" |").next().unwrap().to_string()))
        .collect();
    assert_eq!(rows.len(), 4);
    let check = |file: &std::path::Path, plane: &str| {
        let answer = document(["section", file.to_str().unwrap(), "--plane", plane]);
        let outer = answer["contours"].as_array().unwrap().iter().filter_map(|c| c["segments"].as_array());
        let outer = outer.filter(|all| all.len() > 4).collect::<Vec<_>>();
        let radii =
            |all: &[serde_json::Value]| all.iter().filter_map(|s| s["radius"].as_f64()).collect::<Vec<f64>>();
        let is_right = |all: &&&Vec<serde_json::Value>| {
            let arcs = radii(all);
            let lines = all.iter().filter(|s| s["kind"] == "line").count();
            let same = arcs.iter().all(|r| (r - arcs[0]).abs() < 1e-3 * arcs[0]);
            all.len() == 8 && lines == 4 && arcs.len() == 4 && same
        };
        assert!(outer.iter().any(|all| is_right(&all)), "{}: {answer:#}", file.display());
    };
    for (file, plane) in &rows {
        let plane = if plane.starts_with("the same") { &rows[2].1 } else { plane };
        check(&corpus(&format!("sections/{file}")), plane);
    }
    // Fifty bytes a facet, behind 84 of the head.
    let (stl, plane) = (std::fs::read(corpus("sections/rounded_rectangle.stl")).unwrap(), &rows[2].1);
    let mut facets: Vec<&[u8]> = stl[84..].chunks_exact(50).collect();
    let mut state = 1u64;
    for round in 0..30 {
        for i in (1..facets.len()).rev() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            facets.swap(i, (state >> 33) as usize % (i + 1));
        }
        let all = [&stl[..84], &facets.concat()].concat();
        check(&folder.write(&format!("order{round}.stl"), all), plane);
    }
}
