//! `trueness inspect --qif`: what stands in the results, whatever the names are.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods, missing_docs)]

use crate::common::{Folder, status, stderr, stdout, trueness};
use serde_json::Value;
use std::fmt::Write;

/// A name that would be markup.
const HOSTILE: &str = "<b x=\\\"1\\\">&'";

/// A plane and a cylinder of points, and kinds that QIF knows and does not know.
fn plan() -> String {
    format!(
        "schema = \"trueness/plan/1\"\ntitle = \"{HOSTILE}\\u0001\"\n\
         [[feature]]\nid = \"A\"\nshape = \"plane\"\npoints = \"floor.xyz\"\n\
         [[feature]]\nid = \"{HOSTILE}\"\nshape = \"plane\"\npoints = \"roof.xyz\"\n\
         [[feature]]\nid = \"bore\"\nshape = \"cylinder\"\npoints = \"bore.xyz\"\ninternal = true\n\
         [[feature]]\nid = \"none\"\nshape = \"plane\"\npoints = \"two.xyz\"\n\
         [[characteristic]]\nid = \"1\"\nkind = \"distance\"\nfeature = \"{HOSTILE}\"\ndatums = [\"A\"]\n\
         nominal = 10\nupper = 0.1\nlower = -0.1\nuncertainty = 0.02\n\
         [[characteristic]]\nid = \"{HOSTILE}\"\nkind = \"parallelism\"\nfeature = \"A\"\ndatums = [\"{HOSTILE}\"]\ntolerance = 0.5\n\
         [[characteristic]]\nid = \"3\"\nkind = \"texture\"\nfeature = \"A\"\nparameter = \"Sa\"\ntolerance = 0.02\n\
         [[characteristic]]\nid = \"4\"\nkind = \"texture\"\nfeature = \"A\"\nparameter = \"Sku\"\ntolerance = 9\n\
         [[characteristic]]\nid = \"5\"\nkind = \"flatness\"\nfeature = \"none\"\ntolerance = 0.02\n\
         [[characteristic]]\nid = \"6\"\nkind = \"size\"\nfeature = \"bore\"\nsize = \"GG\"\nnominal = 8\nupper = 0.1\nlower = -0.1\n\
         [[characteristic]]\nid = \"7\"\nkind = \"perpendicularity\"\nfeature = \"bore\"\ndatums = [\"A\"]\ntolerance = 0.05\nmaterial = \"M\"\n\
         [[characteristic]]\nid = \"8\"\nkind = \"straightness\"\nfeature = \"bore\"\ntolerance = 0.05\nmaterial = \"M\"\n"
    )
}

fn written(folder: &Folder) -> (String, Value) {
    let square = |z: f64, bump: f64| {
        let corners = [[0.0, 0.0], [10.0, 0.0], [0.0, 10.0], [10.0, 10.0], [5.0, 0.0], [0.0, 5.0]];
        corners.map(|[x, y]| format!("{x} {y} {z}\n")).concat() + &format!("5 5 {}\n", z + bump)
    };
    folder.write("floor.xyz", square(0.0, 0.01));
    folder.write("roof.xyz", square(10.0, 0.01));
    folder.write("two.xyz", "0 0 0\n1 0 0\n");
    let mut bore = String::new();
    for (k, z) in (0..24).flat_map(|k| [0.0, 5.0, 10.0].map(|z| (k, z))) {
        let a = f64::from(k) * std::f64::consts::TAU / 24.0;
        writeln!(bore, "{} {} {z}", 4.01 * a.cos() + 0.001 * z, 4.01 * a.sin()).unwrap();
    }
    folder.write("bore.xyz", bore);
    let plan = folder.write("plan <1>.toml", plan());
    let [qif, json] = ["r.qif", "r.json"].map(|name| folder.file(name).to_str().unwrap().to_string());
    let o = trueness(["inspect", plan.to_str().unwrap(), "--qif", &qif, "--json", &json]);
    assert_eq!(status(&o), 1, "{}", stderr(&o));
    let read = |p: &str| std::fs::read_to_string(p).unwrap();
    (read(&qif), serde_json::from_str(&read(&json)).unwrap())
}

/// What stands between this start and end, all of them.
fn between<'a>(text: &'a str, start: &str, end: &str) -> Vec<&'a str> {
    text.split(start).skip(1).map(|rest| rest.split(end).next().unwrap()).collect()
}

#[test]
fn every_characteristic_is_there_with_its_value_status_and_kind() {
    let folder = Folder::new();
    let (qif, json) = written(&folder);
    let kinds = [
        "DistanceBetween",
        "Parallelism",
        "UserDefinedLinear",
        "UserDefinedAttribute",
        "Flatness",
        "Diameter",
        "Perpendicularity",
        "Straightness",
    ];
    let all = json["characteristics"].as_array().unwrap();
    assert_eq!(all.len(), kinds.len());
    for (c, kind) in all.iter().zip(kinds) {
        for aspect in ["Definition", "Nominal", "Item"] {
            assert_eq!(
                between(&qif, &format!("<{kind}Characteristic{aspect} id="), ">").len(),
                1,
                "{kind} {aspect}"
            );
        }
        let found = between(
            &qif,
            &format!("<{kind}CharacteristicMeasurement id="),
            &format!("</{kind}CharacteristicMeasurement>"),
        );
        let found = found[0];
        let wanted = match c["verdict"].as_str().unwrap() {
            "pass" => "PASS",
            "fail" => "FAIL",
            "undecided" => "INDETERMINATE",
            _ => "NOT_ANALYZED",
        };
        assert_eq!(between(found, "<CharacteristicStatusEnum>", "<"), [wanted], "{c}");
        let value = between(found, "<Value", "</Value>")
            .first()
            .map(|v| v.split('>').nth(1).unwrap().parse::<f64>().unwrap());
        assert_eq!(value, c["value"].as_f64(), "{c}");
        assert_eq!(
            between(found, "name=\"upper\" value=\"", "\"")[0].parse::<f64>().unwrap(),
            c["upper"].as_f64().unwrap()
        );
    }
    // What QIF gives no limits has them beside it.
    let ratio = between(&qif, "<UserDefinedAttributeCharacteristicDefinition", "</UserDefined")[0];
    assert!(ratio.contains("name=\"upper\" value=\"9\""), "{ratio}");
    // The standard uncertainty is half the expanded one.
    assert!(qif.contains("<Value combinedUncertainty=\"0.01\">"), "{qif}");
    // Both tolerances with a material requirement say so, and have their bonus.
    for start in ["<MaterialCondition>MAXIMUM<", "<Bonus>"] {
        assert_eq!(between(&qif, start, "/").len(), 2, "{start} {qif}");
    }
    assert!(qif.contains("name=\"reason\""), "{qif}");
}

#[test]
fn no_name_becomes_markup_and_numbers_are_counted() {
    let folder = Folder::new();
    let (qif, _) = written(&folder);
    assert!(
        !qif.contains("<b ") && !qif.contains('\u{1}') && qif.contains("&lt;b x=&quot;1&quot;&gt;&amp;"),
        "{qif}"
    );
    assert!(qif.contains("plan%20%3C1%3E.toml"), "{qif}");
    // Datum labels are name tokens.
    for label in between(&qif, "<DatumLabel>", "<") {
        assert!(label.chars().all(|c| c.is_ascii_alphanumeric() || "._:-".contains(c)), "{label}");
    }
    let ids: Vec<u32> = between(&qif, " id=\"", "\"").iter().map(|id| id.parse().unwrap()).collect();
    let mut unlike = ids.clone();
    unlike.sort_unstable();
    unlike.dedup();
    assert_eq!(unlike.len(), ids.len(), "a number stands twice");
    assert_eq!(between(&qif, "idMax=\"", "\""), [unlike.last().unwrap().to_string()]);
    // The same results have the same identifier.
    assert_eq!(written(&folder).0, qif);
}

#[test]
fn several_parts_are_results_of_one_plan() {
    let folder = Folder::new();
    let corpus = crate::common::corpus("examples/plate");
    let path = |name: &str| corpus.join(name).to_str().unwrap().to_string();
    let qif = folder.file("parts.qif").to_str().unwrap().to_string();
    let scan = path("scan.stl");
    let o = trueness(["inspect", &path("plate.toml"), "--measured", &scan, &scan, "--qif", &qif]);
    assert!(status(&o) <= 1, "{}", stderr(&o));
    // The table of each names it.
    assert_eq!(stdout(&o).matches(&format!("   {scan}\n")).count(), 2, "{}", stdout(&o));
    let text = std::fs::read_to_string(&qif).unwrap();
    assert_eq!(between(&text, "<MeasurementResults id", ">").len(), 2);
    assert_eq!(between(&text, "<ActualComponent id", ">").len(), 2);
    assert_eq!(between(&text, "<CharacteristicItems n=\"", "\"").len(), 1);
}
