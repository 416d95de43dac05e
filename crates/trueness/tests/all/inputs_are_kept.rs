//! A task of the library never writes over what it reads.

use serde_json::{Value, json};
use trueness::files::FileSources;
use trueness::geom::progress::Silent;
use trueness::task::{ErrorKind, Request};
use trueness::tasks::{
    align::AlignRequest, compare::CompareRequest, convert::ConvertRequest, curvature::CurvatureRequest,
    inspect::InspectRequest, plan_init::PlanInitRequest, repair::RepairRequest, segment::SegmentRequest,
    trend::TrendRequest,
};

/// What a task says that is to write over an input; nothing is written.
fn refused<R: Request>(asked: Value) -> (&'static str, ErrorKind, String) {
    let request: R = serde_json::from_value(asked).unwrap();
    match request.run(&FileSources, &Silent) {
        Ok(_) => panic!("{}: it ran", R::COMMAND),
        Err(e) => (R::COMMAND, e.kind(), e.to_string()),
    }
}

#[test]
fn an_output_that_is_an_input_is_refused_before_any_work() {
    let folder = std::env::temp_dir().join(format!("inputs_are_kept_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let (scan, nominal, plan) = (folder.join("a.ply"), folder.join("b.ply"), folder.join("plan.toml"));
    let bytes = std::fs::read("../../corpus/bunny/zipper_res4.ply").unwrap();
    std::fs::write(&scan, &bytes).unwrap();
    std::fs::write(&nominal, &bytes).unwrap();
    let text = "schema = \"trueness/plan/1\"\nmeasured = \"a.ply\"\n[[feature]]\nid = \"A\"\nshape = \"plane\"\n\
                points = \"b.ply\"\n[[characteristic]]\nid = \"1\"\nkind = \"flatness\"\nfeature = \"A\"\ntolerance = 1\n";
    std::fs::write(&plan, text).unwrap();
    let reached = [
        refused::<CompareRequest>(json!({"measured": scan, "references": [nominal], "out": scan})),
        refused::<CompareRequest>(json!({"measured": scan, "references": [nominal], "out": nominal})),
        refused::<AlignRequest>(json!({"measured": scan, "reference": nominal, "out": scan})),
        refused::<ConvertRequest>(json!({"input": scan, "out": scan})),
        refused::<RepairRequest>(json!({"mesh": scan, "out": scan})),
        refused::<SegmentRequest>(json!({"input": scan, "out": scan})),
        refused::<CurvatureRequest>(json!({"input": scan, "out": scan})),
        refused::<InspectRequest>(json!({"plan": plan, "csv": plan})),
        refused::<InspectRequest>(json!({"plan": plan, "csv": scan})),
        refused::<InspectRequest>(json!({"plan": plan, "csv": nominal})),
        refused::<TrendRequest>(json!({"results": [plan], "csv": plan})),
        refused::<PlanInitRequest>(json!({"nominal": nominal, "out": nominal})),
    ];
    for (command, kind, text) in reached {
        assert_eq!(kind, ErrorKind::Usage, "{command}: {text}");
        assert!(text.contains("would overwrite the input"), "{command}: {text}");
    }
    let kept = [&scan, &nominal].map(|path| std::fs::read(path).unwrap() == bytes);
    assert_eq!((kept, std::fs::read_to_string(&plan).unwrap().as_str()), ([true; 2], text));
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A variable of a script that was never set gives an empty name.
#[test]
fn an_empty_name_is_told_as_such() {
    let scan = "../../corpus/bunny/zipper_res4.ply";
    for (asked, said) in [
        (json!({"measured": "", "references": [""]}), "the name of an input is empty; name a file"),
        (
            json!({"measured": scan, "references": [scan], "out": ""}),
            "--out: the name of the file is empty; name a file",
        ),
    ] {
        let (_, kind, text) = refused::<CompareRequest>(asked);
        assert_eq!((kind, text.as_str()), (ErrorKind::Usage, said));
    }
}
