//! The report as a file: the same every time, within its budget, and safe whatever the names are.

#![allow(clippy::unwrap_used, reason = "tests")]

#[path = "../examples/report_fixtures/main.rs"]
#[allow(dead_code, missing_docs, reason = "a program of its own, too")]
mod fixtures;

use fixtures::{
    check_document, check_page, cloud_page, curvature_page, defects, fit_page, heard, lobed_cylinder, page,
    repair_page, sphere, surface_page, torus,
};
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use trueness_document::inspect::InspectDocument;
use trueness_geom::fit::Method;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Progress, Silent};
use trueness_report as report;
use trueness_report::{Language, ReportError, ReportInput, ReportOptions};

const NAMES: [&str; 2] = ["scan.stl", "nominal.stl"];
const TOLERANCE: Option<[f64; 2]> = Some([-0.05, 0.05]);

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let body = sphere(60);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| page(&body, TOLERANCE, NAMES, &ReportOptions::default()).0)
    };
    assert!(with(1) == with(4));
}

#[test]
fn points_on_a_coarse_reference_give_the_same_bytes_too() {
    let (points, reference) = (fixtures::uv_sphere(90), fixtures::uv_sphere(8));
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| cloud_page(&points.positions, &reference, 0.05))
    };
    let page = with(1);
    assert!(page == with(3));
    let manifest = manifest(&page);
    let objects = manifest["objects"].as_array().unwrap();
    assert_eq!((&objects[0]["shown"], &objects[1]["shown"]), (&true.into(), &false.into()));
    assert!(objects[1]["reach"].as_f64().unwrap() > 0.0 && objects[0].get("reach").is_none());
    let [drawn, source] = ["vertices", "source_vertices"].map(|key| objects[1][key].as_u64().unwrap());
    assert_eq!(source, reference.positions.len() as u64);
    assert!(drawn > 20 * source, "{drawn}");
}

/// Says stop after so many questions, and counts what it hears.
struct Stop {
    after: u64,
    asked: AtomicU64,
    heard: AtomicU64,
}

impl Progress for Stop {
    fn advance(&self, items: u64) {
        self.heard.fetch_add(items, Relaxed);
    }
    fn cancelled(&self) -> bool {
        self.asked.fetch_add(1, Relaxed) >= self.after
    }
}

#[test]
fn writing_can_be_stopped_and_says_how_far_it_is() {
    let body = sphere(400);
    let options = ReportOptions { budget: 2_000_000, ..ReportOptions::default() };
    let run = |after| {
        let stop = Stop { after, asked: AtomicU64::new(0), heard: AtomicU64::new(0) };
        let result = heard(&body, TOLERANCE, NAMES, &options, &stop);
        (result.map(|(page, _)| page), stop.asked.into_inner(), stop.heard.into_inner())
    };
    let (whole, asked, heard) = run(u64::MAX);
    assert!(whole.is_ok() && asked > 30, "{asked}");
    // Each place of both spheres is told of twice.
    assert_eq!(heard, 2 * 2 * (2 + 399 * 400));
    for after in [0, 1, asked / 3, asked - 1] {
        assert!(matches!(run(after).0, Err(ReportError::Cancelled(_))), "after {after} of {asked}");
    }
}

#[test]
fn a_small_budget_is_kept() {
    let body = sphere(200);
    let (full, _) = page(&body, TOLERANCE, NAMES, &ReportOptions::default());
    let budget = full.len() - 200_000;
    let options = ReportOptions { budget, ..ReportOptions::default() };
    let (small, summary) = page(&body, TOLERANCE, NAMES, &options);
    assert!(small.len() <= budget && summary.bytes == small.len(), "{} of {budget}", small.len());
    let text = String::from_utf8(small).unwrap();
    assert!(text.contains("display simplified, numbers are from all points"));
}

#[test]
fn names_are_never_markup() {
    let nasty = "<img src=x onerror=alert(1)></script><style>\"'&.stl";
    let options =
        ReportOptions { title: Some(nasty.into()), operator: Some(nasty.into()), ..ReportOptions::default() };
    let text = String::from_utf8(page(&sphere(10), None, [nasty, nasty], &options).0).unwrap();
    assert!(!text.contains("<img src=x") && !text.contains(" style="));
    // The page's own and that of the running head.
    assert_eq!(text.matches("<style>").count(), 2);
    assert_eq!(text.matches("</script>").count(), text.matches("<script").count());
    assert!(text.contains("No tolerance given"));
}

#[test]
fn every_word_is_in_the_table() {
    let options = ReportOptions { language: Language::De, ..ReportOptions::default() };
    let pages = [
        (page(&sphere(10), TOLERANCE, NAMES, &options).0, ["Nicht in Ordnung", "−0,050"]),
        (check_page(&defects(), &options), ["Nicht fehlerfrei", "Löcher"]),
        (fit_page(&lobed_cylinder(), Method::MinimumZone, &options).0, ["Zylinder", "kleinste Zone"]),
        (repair_page(&defects(), &options), ["Repariert: fehlerfrei", "Loch gefüllt"]),
        (curvature_page(&torus(), &options), ["Gaußsche Krümmung", "Nachbarn"]),
        (surface_page(&options), ["Fläche durch die Punkte", "Kontrollpunkte"]),
        (inspect_page(&options), ["Nicht in Ordnung", "Ebenheit"]),
    ];
    let mut missing = BTreeSet::new();
    for (page, known) in pages {
        let text = String::from_utf8(page).unwrap();
        for part in text.split("data-t=\"").skip(1) {
            let (key, rest) = part.split_once("\">").unwrap();
            if rest.starts_with(key) {
                missing.insert(key.to_string());
            }
        }
        assert!(known.iter().all(|word| text.contains(word)), "{known:?}");
    }
    assert!(missing.is_empty(), "no German words for {missing:?}");
}

/// The page of an inspection with two failures out of three.
fn inspect_page(options: &ReportOptions) -> Vec<u8> {
    let characteristic = |id: &str, kind: &str, symbol: &str, verdict: &str, value: f64| {
        serde_json::json!({
            "id": id, "kind": kind, "symbol": symbol, "feature": "TOP", "datums": [], "modifiers": [], "zone": "width",
            "nominal": null, "tolerance": 0.05, "lower": null, "upper": 0.05, "value": value, "unit": "mm",
            "uncertainty": null, "decision_rule": "simple", "verdict": verdict, "reason": null, "utilisation": value / 0.05,
            "witness": [], "anchor": null, "parts": {}, "notes": [], "standard": "ISO 1101:2017",
        })
    };
    let document: InspectDocument = serde_json::from_value(serde_json::json!({
        "schema": "trueness/inspect/1", "version": "0", "units": "mm", "title": "Plate 7",
        "plan": {"path": "plate.toml", "sha256": null}, "inputs": [],
        "alignment": {
            "method": "none", "transform": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], "rms": null,
            "mean_abs": null, "iterations": null, "converged": null, "warnings": [],
        },
        "features": [], "deviation": null, "decision_rule": "simple", "verdict": "fail",
        "counts": {"pass": 1, "fail": 2, "undecided": 0, "not_measured": 0},
        "characteristics": [
            characteristic("1", "flatness", "⏥", "pass", 0.01),
            characteristic("2", "cylindricity", "⌭", "fail", 0.06),
            characteristic("3", "texture", "", "fail", 0.050004),
        ],
    }))
    .unwrap();
    let result = &document;
    let mut page = vec![];
    report::write(&ReportInput { result, objects: &[], marks: &[], options }, &Silent, &mut page).unwrap();
    page
}

#[test]
fn an_inspection_says_first_what_fails_and_what_it_is_called() {
    let text = String::from_utf8(inspect_page(&ReportOptions::default())).unwrap();
    let body = &text[text.find("<body").unwrap()..text.find("id=\"manifest\"").unwrap()];
    assert!(body.contains("<p class=\"title\"><bdi class=\"name\" title=\"Plate 7\">Plate 7</bdi>"));
    let lead = body.split("<div class=\"lead\">").nth(1).unwrap();
    assert!(lead.starts_with("<dt><span data-t=\"verdict.fail\">Fail</span></dt><dd>"), "{}", &lead[..120]);
    let plain: String =
        lead[..lead.find("</dd>").unwrap()].split('<').map(|p| p.rsplit('>').next().unwrap()).collect();
    assert!(plain.ends_with("2 /\u{a0}3"), "{plain}");
    // Signs are drawn, whatever fonts there are.
    assert_eq!(body.matches("<svg class=\"gdt\"").count(), 2);
    assert!(!body.contains(['⏥', '⌭']));
    // A value just beyond its limit does not look like it.
    assert!(body.contains("0.050004") && body.contains("0.0600") && !body.contains("0.060000"));
}

/// The manifest that a page carries.
fn manifest(page: &[u8]) -> serde_json::Value {
    let text = std::str::from_utf8(page).unwrap();
    let start = text.split_once("id=\"manifest\">").unwrap().1;
    serde_json::from_str(start.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn rows_lead_to_the_places_of_the_document() {
    let document = check_document(&defects());
    let page = check_page(&defects(), &ReportOptions::default());
    let manifest = manifest(&page);
    let text = String::from_utf8(page).unwrap();
    let picks = manifest["picks"].as_array().unwrap();
    assert_eq!(text.matches("<tr data-pick=").count(), picks.len());
    let marks = manifest["objects"].as_array().unwrap().iter().find(|o| o["kind"] == "marks").unwrap();
    let total: u64 = marks["groups"].as_array().unwrap().iter().map(|g| g["count"].as_u64().unwrap()).sum();
    assert_eq!(total, document.defects.values().map(|d| d.items.len() as u64).sum::<u64>());
    // The longest boundary edge comes first among its kind, wherever it stands in the document.
    let found = trueness_measure::check::found(&document.defects);
    let before: Vec<usize> = found
        .iter()
        .take_while(|(kind, _)| kind.name != "boundary_edges")
        .map(|(_, d)| d.items.len())
        .collect();
    let rows: usize = before.iter().map(|n| n.min(&100)).sum();
    let edges = &document.defects["boundary_edges"].items;
    let longest =
        edges.iter().enumerate().max_by(|a, b| a.1.size.total_cmp(&b.1.size).then(b.0.cmp(&a.0))).unwrap();
    assert!(longest.0 > 0 && !before.is_empty());
    assert_eq!(picks[rows]["position"], serde_json::json!(longest.1.position));
    assert_eq!(picks[rows]["mark"], before.iter().sum::<usize>() + longest.0);
}

#[test]
fn a_long_list_says_how_many_there_are() {
    // A strip of separate triangles: three boundary edges each.
    let mut mesh = Mesh::default();
    for i in 0..60u32 {
        let x = f64::from(i);
        mesh.positions.extend([[x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], [x, 0.5, 0.0]]);
        mesh.faces.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let text = String::from_utf8(check_page(&mesh, &ReportOptions::default())).unwrap();
    let kind = text.split("data-t=\"defect.boundary_edges\"").nth(1).unwrap();
    let kind = kind.split("</details>").next().unwrap();
    assert_eq!(kind.matches("<tr data-pick").count(), 100);
    assert!(kind.contains(">180</span>") && kind.contains(">100</span> / <span"), "{kind}");
}

#[test]
fn a_sound_mesh_has_nothing_to_list() {
    let page = check_page(&fixtures::uv_sphere(12), &ReportOptions::default());
    let text = String::from_utf8(page).unwrap();
    assert!(text.contains("h-pass") && text.contains("Looked for, none found") && !text.contains("<details"));
    assert!(!text.contains("id=\"scale\""));
}

#[test]
fn a_fit_shows_what_its_document_says() {
    let (page, document) = fit_page(&lobed_cylinder(), Method::MinimumZone, &ReportOptions::default());
    assert!((document.form_error - 0.2).abs() < 1e-9, "{}", document.form_error);
    let extent = document.extent.unwrap();
    assert!((extent.v[1] - extent.v[0] - 30.0).abs() < 1e-9 && extent.u == [0.0, std::f64::consts::TAU]);
    let histogram = document.histogram.unwrap();
    assert_eq!(histogram.counts.iter().sum::<u64>() + histogram.below + histogram.above, document.count);
    let manifest = manifest(&page);
    let roles: Vec<&str> =
        manifest["objects"].as_array().unwrap().iter().map(|o| o["role"].as_str().unwrap()).collect();
    assert_eq!(roles, ["measured", "element", "touching", "element"]);
    let picks = manifest["picks"].as_array().unwrap();
    assert_eq!(picks.len(), 2 + document.touching.len());
    assert_eq!(picks[2]["position"], serde_json::json!(document.touching[0].position.unwrap()));
    assert_eq!(picks[0]["value"], document.maximum.distance);
}

#[test]
fn curvatures_have_maps_of_their_own() {
    let manifest = manifest(&curvature_page(&torus(), &ReportOptions::default()));
    let maps = manifest["maps"].as_array().unwrap();
    let units: Vec<&str> = maps.iter().map(|m| m["scale"]["unit"].as_str().unwrap()).collect();
    assert_eq!(units, ["mm⁻¹", "mm⁻²", "mm⁻¹", "mm⁻¹"]);
    let fields = manifest["objects"][0]["fields"].as_array().unwrap();
    for ((map, field), kind) in maps.iter().zip(fields).zip(["mean", "gaussian", "k1", "k2"]) {
        let scale = &map["scale"];
        let width = scale["upper"].as_f64().unwrap() - scale["lower"].as_f64().unwrap();
        // Stored as finely as this map's own scale asks for.
        assert!(field["step"].as_f64().unwrap() <= width / 500.0, "{kind}");
        assert_eq!(map["histogram"], manifest["result"][kind]["histogram"]);
        let counted: u64 = map["slots"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).sum();
        assert_eq!((counted, &map["count"]), (180 * 90, &counted.into()));
    }
    let picks = manifest["picks"].as_array().unwrap();
    assert_eq!((picks.len(), &picks[2]["map"]), (8, &1.into()));
    assert_eq!(picks[2]["value"], manifest["result"]["gaussian"]["maximum"]["gaussian"]);
}

#[test]
fn a_surface_is_drawn_with_its_points_lines_and_net() {
    let manifest = manifest(&surface_page(&ReportOptions::default()));
    let objects = manifest["objects"].as_array().unwrap();
    let roles: Vec<&str> = objects.iter().map(|o| o["role"].as_str().unwrap()).collect();
    assert_eq!(roles, ["measured", "surface", "iso_lines", "reflection_lines", "net"]);
    let shown: Vec<bool> = objects.iter().map(|o| o["shown"].as_bool().unwrap()).collect();
    assert_eq!(shown, [true, true, true, false, false]);
    // Points have their deviation alone and are there for it alone; the surface has the four curvatures.
    assert_eq!((&objects[0]["comparison"], objects[0]["fields"].as_array().unwrap().len()), (&0.into(), 1));
    let maps = |o: &serde_json::Value| -> Vec<u64> {
        o["fields"].as_array().unwrap().iter().map(|f| f["comparison"].as_u64().unwrap()).collect()
    };
    assert_eq!(maps(&objects[1]), [1, 2, 3, 4]);
    // 7 by 6 control points; lines at 5 and 4 knots.
    assert!(objects[3]["segments"].as_u64().unwrap() > 100);
    assert_eq!((&objects[4]["points"], &objects[4]["segments"]), (&42.into(), &(7 * 5 + 6 * 6).into()));
    assert_eq!(manifest["maps"].as_array().unwrap().len(), 5);
    assert!(manifest["maps"][1]["slots"].is_null(), "what was not counted is not told as counted");
    assert_eq!(manifest["picks"][0]["position"], manifest["result"]["worst"]["position"]);
}

#[test]
fn a_repair_shows_the_mesh_before_and_after() {
    let manifest = manifest(&repair_page(&defects(), &ReportOptions::default()));
    let objects = manifest["objects"].as_array().unwrap();
    let roles: Vec<&str> = objects.iter().map(|o| o["role"].as_str().unwrap()).collect();
    assert_eq!(roles, ["after", "before", "changes", "after", "before"]);
    assert_eq!((&objects[0]["shown"], &objects[1]["shown"]), (&true.into(), &false.into()));
    let result = &manifest["result"];
    // As many areas in green and red as the document counts.
    assert_eq!(objects[3]["triangles"], result["facets"]["added"]);
    assert!(objects[4]["triangles"].as_u64().unwrap() > 0);
    let picks = manifest["picks"].as_array().unwrap();
    assert_eq!(picks.len() as u64, result["change_count"].as_u64().unwrap());
    assert!(picks.iter().all(|p| p["normal"].is_array() && p["mark"].is_u64()));
}
