//! Damaged files and files that are made to do harm: no crash, bounded time and memory, and nothing is left out in silence.

use super::{model, part, read, whole};
use crate::cad::read_from;
use crate::{Fault, MemorySources, ReadOptions};
use std::path::Path;
use std::time::Instant;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Progress;

/// A face on a cylinder between two circles, and one on a plane with a spline.
pub(super) const FACES: &str = "#50=OPEN_SHELL('',(#51,#61));\n#51=ADVANCED_FACE('',(#52,#62),#54,.T.);\n#52=FACE_BOUND('',#55,.T.);\n#54=CYLINDRICAL_SURFACE('',#9,2.);\n\
    #55=EDGE_LOOP('',(#56));\n#56=ORIENTED_EDGE('',*,*,#57,.T.);\n#57=EDGE_CURVE('',#58,#58,#59,.T.);\n#58=VERTEX_POINT('',#60);\n\
    #59=CIRCLE('',#9,2.);\n#60=CARTESIAN_POINT('',(2.,0.,0.));\n#61=ADVANCED_FACE('',(#63),#64,.F.);\n#62=FACE_BOUND('',#65,.F.);\n\
    #63=FACE_OUTER_BOUND('',#55,.F.);\n#64=PLANE('',#9);\n#65=EDGE_LOOP('',(#66));\n#66=ORIENTED_EDGE('',*,*,#67,.T.);\n#67=EDGE_CURVE('',#68,#68,#69,.T.);\n\
    #68=VERTEX_POINT('',#70);\n#69=CIRCLE('',#71,2.);\n#70=CARTESIAN_POINT('',(2.,0.,5.));\n#71=AXIS2_PLACEMENT_3D('',#72,#8,#6);\n\
    #72=CARTESIAN_POINT('',(0.,0.,5.));";

/// An entity of the file above in place of which another one stands; the faces that are still read.
#[test]
fn damage_costs_the_faces_that_need_the_entity() {
    let whole = part("#50", FACES);
    assert_eq!(model(&whole).parts[0].brep.faces.len(), 2);
    let cases = [
        ("#72=CARTESIAN_POINT('',(0.,0.,5.));", "", 1),
        ("#72=CARTESIAN_POINT('',(0.,0.,5.));", "#72=CARTESIAN_POINT('',(0.,NaN,5.));", 1),
        ("#72=CARTESIAN_POINT('',(0.,0.,5.));", "#72=CARTESIAN_POINT('',(0.,1.E999,5.));", 1),
        ("#72=CARTESIAN_POINT('',(0.,0.,5.));", "#72=CARTESIAN_POINT('',(0.,1.E308,5.));", 1),
        ("#72=CARTESIAN_POINT('',(0.,0.,5.));", "#72=CARTESIAN_POINT('',(0.,0.));", 1),
        ("#72=CARTESIAN_POINT('',(0.,0.,5.));", "#72=CARTESIAN_POINT('never ends,(0.,0.,5.));", 1),
        (
            "#72=CARTESIAN_POINT('',(0.,0.,5.));",
            "#72=CARTESIAN_POINT('',(0.,0.,5.));\n#72=DIRECTION('',(0.,0.,5.));",
            1,
        ),
        ("#69=CIRCLE('',#71,2.);", "#69=CIRCLE('',#69,2.);", 1),
        ("#69=CIRCLE('',#71,2.);", "#69=CIRCLE('',#71,-2.);", 1),
        ("#69=CIRCLE('',#71,2.);", "#69=CIRCLE('',#71,4.);", 1),
        ("#69=CIRCLE('',#71,2.);", "#69=TRIMMED_CURVE('',#69,(#70),(#70),.T.,.CARTESIAN.);", 1),
        (
            "#69=CIRCLE('',#71,2.);",
            "#69=COMPOSITE_CURVE('',(#73,#73),.U.);\n#73=COMPOSITE_CURVE_SEGMENT(.C.,.T.,#69);",
            1,
        ),
        ("#65=EDGE_LOOP('',(#66));", "#65=EDGE_LOOP('',());", 1),
        ("#65=EDGE_LOOP('',(#66));", "#65=EDGE_LOOP('',(#62));", 1),
        ("#65=EDGE_LOOP('',(#66));", "#65=EDGE_LOOP('',(#66,#56));", 1),
        ("#66=ORIENTED_EDGE('',*,*,#67,.T.);", "#66=ORIENTED_EDGE('',*,*,#66,.T.);", 1),
        ("#66=ORIENTED_EDGE('',*,*,#67,.T.);", "#66=ORIENTED_EDGE('',*,*,#99999999999999999999999,.T.);", 1),
        ("#64=PLANE('',#9);", "#64=PLANE('',#64);", 1),
        ("#64=PLANE('',#9);", "#64=OFFSET_SURFACE('',#64,1.,.F.);", 1),
        ("#61=ADVANCED_FACE('',(#63),#64,.F.);", "#61=ORIENTED_FACE('',*,#61,.F.);", 1),
        ("#61=ADVANCED_FACE('',(#63),#64,.F.);", "#61=ADVANCED_FACE(\0\u{1},(#63),#64,.F.);", 1),
        ("#8=DIRECTION('',(0.,0.,1.));", "#8=DIRECTION('',(0.,0.,0.));", 0),
        ("#50=OPEN_SHELL('',(#51,#61));", "#50=OPEN_SHELL('',(#51,'x'));", 0),
    ];
    for (from, to, left) in cases {
        assert!(whole.contains(from), "{from}");
        match read(&whole.replace(from, to)) {
            Ok(file) => {
                assert_eq!(file.model.parts[0].brep.faces.len(), left, "{to}: {:?}", file.model.unread);
                assert!(!file.model.is_complete(), "{to}");
            }
            Err(e) => assert!(left == 0 && e.to_string().contains("can be read"), "{to}: {e}"),
        }
    }
}

#[test]
fn cut_short_anywhere_it_is_never_taken_for_whole() {
    let text = part("#50", FACES);
    let last = text.find("END-ISO").unwrap();
    for end in 0..text.len() - 1 {
        if let Ok(file) = read(&text[..end]) {
            assert!(!file.model.is_complete() || end > last, "{end}");
        }
    }
}

#[test]
fn changed_anywhere_it_does_no_harm() {
    let text = part("#50", FACES).into_bytes();
    let mut random = Random::stream(5, 0);
    for _ in 0..2000 {
        let mut bytes = text.clone();
        for _ in 0..1 + random.below(4) {
            let at = random.below(bytes.len() as u64) as usize;
            bytes[at] = b"0123456789#(),;'.$*-E/ABS\n"[random.below(26) as usize];
        }
        let _ = read(&String::from_utf8_lossy(&bytes));
    }
}

/// Files whose parts share all they have: the model may not grow beyond measure.
#[test]
fn what_is_shared_is_not_copied_without_end() {
    let list = |from: usize, count: usize| {
        (from..from + count).map(|n| format!("#{n}")).collect::<Vec<_>>().join(",")
    };
    let n = 5000;
    // A surface of many control points under many faces.
    let net = format!("({})", vec!["#5"; n].join(","));
    let faces: String = (0..n).map(|k| format!("#{}=ADVANCED_FACE('',(),#49,.T.);\n", 100 + k)).collect();
    let spline = format!(
        "#48=OPEN_SHELL('',({}));\n{faces}#49=B_SPLINE_SURFACE_WITH_KNOTS('',1,1,({net},{net}),.U.,.F.,.F.,.U.,(2,2),({}2,{}2),(0.,1.),({}),.U.);",
        list(100, n),
        "",
        ",1".repeat(n - 2).trim_start_matches(',').to_string() + ",",
        (0..n).map(|k| format!("{k}.")).collect::<Vec<_>>().join(",")
    );
    // Many shells of the same faces, many faces of the same loop, sets within sets.
    let shells: String =
        (0..n).map(|k| format!("#{}=OPEN_SHELL('',({}));\n", 100 + k, vec!["#51"; 200].join(","))).collect();
    let shells = format!("#48=SHELL_BASED_SURFACE_MODEL('',({}));\n{shells}{FACES}", list(100, n));
    let sets: String = (0..40)
        .map(|k| {
            format!("#{}=GEOMETRIC_SET('',({}));\n", 100 + k, vec![format!("#{}", 101 + k); 50].join(","))
        })
        .collect();
    let chains: String = (0..14)
        .map(|k| {
            let members = vec![format!("#{}", 200 + k); 10].join(",");
            format!(
                "#{}=COMPOSITE_CURVE('',({members}),.U.);\n#{}=COMPOSITE_CURVE_SEGMENT(.C.,.T.,#{});\n",
                100 + k,
                200 + k,
                101 + k
            )
        })
        .collect();
    let chains = format!(
        "#48=SURFACE_OF_LINEAR_EXTRUSION('',#100,#40);\n#40=VECTOR('',#6,1.);\n{chains}#114=POLYLINE('',(#5,#41,#5));\n#41=CARTESIAN_POINT('',(1.,0.,0.));"
    );
    for (items, entities) in [("#48", spline), ("#48", shells), ("#100", sets), ("#48", chains)] {
        let text = part(items, &entities);
        let start = Instant::now();
        let size = match read(&text) {
            Ok(file) => {
                assert!(!file.model.unread.is_empty());
                file.model.parts.iter().map(|p| p.brep.faces.len() + p.brep.shells.len()).sum()
            }
            Err(_) => 0,
        };
        assert!(size < 4 * n && start.elapsed().as_secs() < 20, "{size} {:?}", start.elapsed());
    }
}

/// Names, numbers and references without measure.
#[test]
fn long_and_deep_files_end_soon() {
    let deep = format!("#50=CARTESIAN_POINT('',{}1.{});", "(".repeat(200_000), ")".repeat(200_000));
    let typed = format!("#50=X({}1.{});", "A(".repeat(200_000), ")".repeat(200_000));
    let chain: String =
        (100..50_000).map(|n| format!("#{n}=OFFSET_SURFACE('',#{},1.,.F.);\n", n + 1)).collect();
    let replicas: String =
        (100..50_000).map(|n| format!("#{n}=SOLID_REPLICA('',#{},#9);\n", n + 1)).collect();
    let long =
        format!("#50=ADVANCED_FACE('{}',(),#51,.T.);\n#51=SPHERICAL_SURFACE('',#9,1.);", "x".repeat(1 << 20));
    for (items, entities) in
        [("#50", deep), ("#50", typed), ("#100", chain), ("#100", replicas), ("#50", long)]
    {
        let start = Instant::now();
        let found = read(&part(items, &entities));
        assert!(start.elapsed().as_secs() < 10);
        if let Ok(file) = found {
            assert!(file.model.parts[0].brep.faces.iter().all(|f| f.name.len() < 4096));
        }
    }
    assert!(read(&whole("")).is_err());
}

struct Stopped;
impl Progress for Stopped {
    fn cancelled(&self) -> bool {
        true
    }
}

#[test]
fn it_stops_when_it_is_told_to() {
    let mut sources = MemorySources::new();
    sources.insert("model.step", part("#50", FACES).into_bytes());
    let read = read_from(&sources, Path::new("model.step"), &ReadOptions::default(), &Stopped);
    assert!(matches!(read.map(|_| ()), Err(e) if matches!(e.fault, Fault::Cancelled)));
}
