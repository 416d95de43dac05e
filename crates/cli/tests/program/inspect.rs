//! `trueness inspect` against reference values, as users run it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, corpus, document, status, stderr, stdout, trueness};
use serde_json::Value;

/// A number of the reference: text of many digits.
fn number(v: &Value) -> f64 {
    v.as_str().unwrap().parse().unwrap()
}

fn vector(v: &Value) -> String {
    let of: Vec<&str> = v.as_array().unwrap().iter().map(|x| x.as_str().unwrap()).collect();
    format!("[{}]", of.join(", "))
}

/// The plan of one set, its expected values by id, and how near they must be.
struct Set {
    plan: String,
    expected: Vec<(String, f64, f64)>,
}

/// Least squares, and zones: allowed distance from the reference, mm.
const LSQ: f64 = 1e-9;
const ZONE: f64 = 1e-6;

impl Set {
    fn new() -> Set {
        let plan = "schema = \"trueness/plan/1\"\ntitle = \"reference\"\nunits = \"mm\"\n".to_string();
        Set { plan, expected: vec![] }
    }
    fn feature(&mut self, id: &str, shape: &str, file: &str, more: &str) {
        let path = corpus("gdt").join(file);
        let path = path.to_str().unwrap();
        self.plan += &format!("[[feature]]\nid = \"{id}\"\nshape = \"{shape}\"\npoints = '{path}'\n{more}\n");
    }
    fn zone(&mut self, kind: &str, feature: &str, more: &str, value: f64, near: f64) {
        self.characteristic(kind, feature, &format!("tolerance = 1.0\n{more}"), value, near);
    }
    fn characteristic(&mut self, kind: &str, feature: &str, more: &str, value: f64, near: f64) {
        let id = format!("{} {kind} {feature}", self.expected.len() + 1);
        self.plan += &format!(
            "[[characteristic]]\nid = \"{id}\"\nkind = \"{kind}\"\nfeature = \"{feature}\"\n{more}\n"
        );
        self.expected.push((id, value, near));
    }
    /// The same with the datum A by both rules.
    fn both(&mut self, kind: &str, feature: &str, more: &str, values: &Value) {
        for (rule, key) in [("gaussian", "lsq"), ("minimum-zone", "minimum_zone")] {
            let more = format!("datums = [\"A\"]\ndatum_method = \"{rule}\"\n{more}");
            let near = if key == "lsq" { LSQ } else { ZONE };
            self.zone(kind, feature, &more, number(&values[key]), near);
        }
    }
    fn size(&mut self, word: &str, value: f64, near: f64) {
        let more = format!("size = \"{word}\"\nnominal = {value}\nupper = 0.1\nlower = -0.1\n");
        self.characteristic("size", "BORE", &more, value, near);
    }
}

/// One case of the reference, by the beginning of its name.
fn add(set: &mut Set, case: &Value) {
    let name = case["characteristic"].as_str().unwrap();
    let file = case["file"].as_str().unwrap();
    let value = &case["value"];
    match name {
        "flatness" => {
            set.feature("A", "plane", file, "");
            set.zone("flatness", "A", "", number(value), ZONE);
            set.zone("flatness", "A", "method = \"gaussian\"", number(&case["lsq_value"]), LSQ);
        }
        "parallelism plane to plane" => {
            set.feature("P", "plane", file, "");
            set.both("parallelism", "P", "", value);
            let centroid = &case["distance_of_centroid_to_datum"];
            for (rule, key, near) in
                [("gaussian", "lsq", LSQ), ("minimum-zone", "minimum_zone_tangent_outside_material", ZONE)]
            {
                let more = format!(
                    "datums = [\"A\"]\ndatum_method = \"{rule}\"\nnominal = 25.0\nupper = 0.1\nlower = -0.1\n"
                );
                set.characteristic("distance", "P", &more, number(&centroid[key]), near);
            }
        }
        "perpendicularity plane to plane" => {
            set.feature("Q", "plane", file, "");
            set.both("perpendicularity", "Q", "", value);
        }
        "angularity plane to plane" => {
            set.feature("G", "plane", file, "");
            let angle = case["basic_angle_deg"].as_f64().unwrap();
            set.both("angularity", "G", &format!("basic = {{ angle = {angle} }}"), value);
        }
        "size and cylindricity of a bore" => {
            set.feature("BORE", "cylinder", file, "");
            set.size("GG", number(&case["GG_least_squares_diameter"]), LSQ);
            set.size("GX", number(&case["GX_maximum_inscribed_diameter"]), ZONE);
            set.size("GN", number(&case["GN_minimum_circumscribed_diameter"]), ZONE);
            set.zone("cylindricity", "BORE", "", number(&case["cylindricity_minimum_zone"]), ZONE);
            let gaussian = number(&case["cylindricity_lsq"]);
            set.zone("cylindricity", "BORE", "method = \"gaussian\"", gaussian, LSQ);
        }
        "perpendicularity of the bore axis to A" => set.both("perpendicularity", "BORE", "", value),
        "position of the bore axis" => {
            let rows = &case["frame_rows_x_y_z"];
            let (origin, x, z) = (vector(&case["frame_origin"]), vector(&rows[0]), vector(&rows[2]));
            let place = &case["true_position_xy"];
            let more = format!(
                "frame = {{ origin = {origin}, x = {x}, z = {z} }}\nbasic = {{ x = {}, y = {} }}",
                number(&place[0]),
                number(&place[1])
            );
            set.zone("position", "BORE", &more, number(value), LSQ);
        }
        "profile of a surface (sphere R75)" => {
            let center = vector(&case["nominal_center"]);
            let nominal = format!("nominal = {{ center = {center}, radius = 75.0 }}");
            set.feature("FREE", "sphere", file, &nominal);
            set.zone("surface-profile", "FREE", "", number(&case["value_best_fit_minimax"]), ZONE);
            set.feature("HELD", "sphere", file, "nominal = { center = [0.0, 0.0, 0.0], radius = 75.0 }");
            let frame = format!("frame = {{ origin = {center}, x = [1.0, 0.0, 0.0], z = [0.0, 0.0, 1.0] }}");
            set.zone("surface-profile", "HELD", &frame, number(&case["value_with_datum_frame"]), LSQ);
        }
        "straightness of an axis (diameter zone)" => {
            set.feature("AXIS", "line", file, "");
            set.zone("straightness", "AXIS", "", number(value), ZONE);
        }
        "perpendicularity of an extracted axis to A (diameter zone)" => {
            set.both("perpendicularity", "AXIS", "", value);
        }
        other => unreachable!("{other}"),
    }
}

/// All 30 cases of the reference, both datum rules.
#[test]
fn reference_values_are_met() {
    let reference: Value =
        serde_json::from_str(&std::fs::read_to_string(corpus("gdt/reference.json")).unwrap()).unwrap();
    let cases = reference["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 30);
    for k in 0..3 {
        let ending = format!("_{k}.xyz");
        let mut set = Set::new();
        let of_set = cases.iter().filter(|c| c["file"].as_str().unwrap().ends_with(&ending));
        of_set.for_each(|case| add(&mut set, case));
        let folder = Folder::new();
        let plan = folder.write("plan.toml", &set.plan);
        let answer = document(["inspect", plan.to_str().unwrap()]);
        let found = answer["characteristics"].as_array().unwrap();
        assert_eq!(found.len(), set.expected.len());
        for (record, (id, value, near)) in found.iter().zip(&set.expected) {
            assert_eq!(record["id"], id.as_str());
            let off = (record["value"].as_f64().unwrap_or(f64::NAN) - value).abs();
            println!("{k} {id}: {value} off by {off:.1e}");
            assert!(off <= *near, "set {k}, {id}: {} instead of {value}", record["value"]);
        }
        assert_eq!(answer["verdict"], "pass");
        let table = trueness(["inspect", plan.to_str().unwrap()]);
        assert_eq!(status(&table), 0, "{}", stderr(&table));
        assert!(stdout(&table).contains("pass: 23 pass, 0 fail"), "{}", stdout(&table));
    }
}
