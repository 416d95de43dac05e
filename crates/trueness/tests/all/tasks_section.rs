//! Sections asked by JSON, of files and of memory.

use crate::common::{is_read_back, refuses_what_it_lacks};
use serde_json::json;
use trueness::document::ResultDocument;
use trueness::files::{FileSources, MemorySources};
use trueness::geom::progress::Silent;
use trueness::task::{ErrorKind, Outcome, Request};
use trueness::tasks::section::{Fit, Interval, SectionRequest};

const PART: &str = "../../corpus/sections/rounded_rectangle.stl";
const NOMINAL: &str = "../../corpus/sections/rounded_rectangle_other_order.stl";
const PLANE: [f64; 4] = [0.07229382650079952, -0.8569996931911372, 0.5102206664965356, 110.26353072993271];

fn request() -> SectionRequest {
    serde_json::from_value(json!({
        "input": PART,
        "plane": [PLANE],
        "nominal": NOMINAL,
        "fit": "xy",
        "tolerance": "-0.01,+0.01",
        "level": 99,
        "independent": true,
    }))
    .unwrap()
}

/// The outline of a square of 10 by 10, 40 points to a side.
fn square() -> String {
    let side = |from: [f64; 2], to: [f64; 2]| {
        (0..40).map(move |i| {
            let t = (f64::from(i) + 0.5) / 40.0;
            format!("{} {}\n", from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]))
        })
    };
    let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
    (0..4).flat_map(|k| side(corners[k], corners[(k + 1) % 4])).collect()
}

#[test]
fn memory_gives_the_document_of_the_files() {
    let request = request();
    let sources: MemorySources =
        [PART, NOMINAL].into_iter().map(|name| (name, std::fs::read(name).unwrap())).collect();
    let memory = request.run(&sources, &Silent).unwrap();
    let file = request.run(&FileSources, &Silent).unwrap();
    assert_eq!(memory.json().unwrap(), file.json().unwrap());
    let document = &memory.document;
    assert_eq!((document.level, document.inputs.len()), (0.99, 2));
    let nominal = document.nominal.as_ref().unwrap();
    assert_eq!(nominal.fits[0].freedom, "xy");
    assert!(nominal.deviation.all.rms.unwrap() < 1e-4, "{:?}", nominal.deviation.all);
    assert_eq!((memory.outcome, document.conforms()), (Outcome::Conforming, true));
    assert!(memory.outputs.is_empty() && memory.scene.is_none());
}

#[test]
fn a_request_is_read_back_as_it_was_written() {
    let request = SectionRequest { fit: Some(Fit::None), interval: Interval::Paper, ..request() };
    is_read_back(&request);
}

#[test]
fn an_unknown_field_is_refused_by_its_name() {
    refuses_what_it_lacks::<SectionRequest>(json!({ "input": PART }));
}

/// What the words of a command line cannot say together, JSON can.
#[test]
fn fields_that_do_not_go_together_are_refused() {
    for (fields, said) in [
        (json!({ "closed": true, "open": true }), "--closed and --open"),
        (json!({ "level": 0.95 }), "--level 0.95: it is in percent: write 95"),
        (json!({ "level": 100 }), "--level 100: give a number of percent"),
        (json!({ "stacking": [1, 2] }), "--stacking needs --airfoil"),
        (json!({ "fit": "free" }), "--fit needs --nominal"),
        (json!({ "tolerance": "0.1" }), "--tolerance needs --nominal"),
        (json!({ "max_distance": 1 }), "--max-distance needs --nominal"),
        (json!({ "nominal": NOMINAL, "inside": 90 }), "--inside needs --tolerance"),
        (json!({ "nominal": NOMINAL, "min_coverage": 0 }), "--min-coverage needs --tolerance"),
        (json!({ "reference_units": "mm" }), "--reference-units is for the file of --nominal"),
    ] {
        let mut request = fields.clone();
        request["input"] = PART.into();
        let request: SectionRequest = serde_json::from_value(request).unwrap();
        let error = request.run(&FileSources, &Silent).err().unwrap();
        assert_eq!(error.kind(), ErrorKind::Usage, "{fields}");
        assert!(error.to_string().contains(said), "{fields}: {error}");
    }
}

#[test]
fn drawings_are_in_their_places_once_they_are_committed() {
    let folder = std::env::temp_dir().join(format!("trueness-section-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let [dxf, out] = ["square.dxf", "square.csv"].map(|name| folder.join(name));
    let sources: MemorySources = [("square.xy", square())].into_iter().collect();
    let request = SectionRequest {
        input: "square.xy".into(),
        dxf: Some(dxf.clone()),
        out: Some(out.clone()),
        view: true,
        ..SectionRequest::default()
    };
    request.files(&FileSources).unwrap().check(&Silent).unwrap();
    let mut done = request.run(&sources, &Silent).unwrap();
    assert!(!dxf.exists() && !out.exists() && done.scene.is_some());
    assert_eq!(done.document.contours[0].segments.len(), 4);
    done.commit().unwrap();
    assert_eq!(std::fs::read_to_string(&dxf).unwrap().matches("\nLINE\n").count(), 4);
    assert_eq!(std::fs::read_to_string(&out).unwrap().lines().count(), 161);
    std::fs::remove_dir_all(&folder).unwrap();
}
