//! A value never lies outside its own interval, whatever noise does to it.

use crate::common;

use common::{grid, round};
use std::collections::BTreeMap;
use trueness_document::inspect::PlanRecord;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::Point;
use trueness_measure::inspection::{self, Data, OwnPoints, run};
use trueness_measure::plan::Plan;

const KINDS: &[(&str, &str, &str)] = &[
    ("flatness", "A", "tolerance = 1"),
    ("flatness", "A", "tolerance = 1\nmethod = \"gaussian\""),
    ("parallelism", "T", "tolerance = 1\ndatums = [\"A\"]"),
    ("perpendicularity", "H", "tolerance = 1\ndatums = [\"A\"]"),
    ("cylindricity", "H", "tolerance = 1"),
    ("straightness", "H", "tolerance = 1"),
    ("roundness", "C", "tolerance = 1"),
    ("circular-runout", "C", "tolerance = 1\ndatums = [\"H\"]"),
    ("total-runout", "H", "tolerance = 1\ndatums = [\"S\"]"),
    ("coaxiality", "H", "tolerance = 1\ndatums = [\"S\"]"),
    ("texture", "A", "tolerance = 1\nparameter = \"Sz\""),
    ("size", "H", "size = \"GG\"\nnominal = 16\nupper = 1\nlower = -1"),
    ("size", "H", "size = \"GX\"\nnominal = 16\nupper = 1\nlower = -1"),
    ("size", "H", "size = \"GN\"\nnominal = 16\nupper = 1\nlower = -1"),
    ("distance", "T", "nominal = 7\nupper = 1\nlower = -1\ndatums = [\"A\"]"),
    ("angle", "T", "nominal = 0\nupper = 1\nlower = 0\ndatums = [\"A\"]"),
];

#[test]
fn values_lie_within_their_intervals() {
    let mut text = String::from(
        "schema = \"trueness/plan/1\"\n[decision]\nrule = \"iso14253-1\"\nnoise = 0.01\ndraws = 20\n",
    );
    for (id, shape) in [("A", "plane"), ("T", "plane"), ("H", "cylinder"), ("C", "circle"), ("S", "cylinder")]
    {
        text += &format!("[[feature]]\nid = \"{id}\"\nshape = \"{shape}\"\npoints = \"p\"\n");
    }
    for (n, (kind, feature, more)) in KINDS.iter().enumerate() {
        text += &format!(
            "[[characteristic]]\nid = \"{n}\"\nkind = \"{kind}\"\nfeature = \"{feature}\"\n{more}\n"
        );
    }
    let plan = Plan::parse(&text).unwrap();
    let mut random = Random::new(7);
    let mut biased = 0;
    for form in [0.0, 0.02, 0.0, 0.1] {
        let bump = |k: usize| if k.is_multiple_of(7) { form } else { 0.0 };
        let lobes = |k: usize| 8.0 + bump(k);
        let own: [Vec<Point>; 5] = [
            grid(|x, y| [x, y, bump((x + 3.0 * y) as usize)]),
            grid(|x, y| [x, y, 7.0]),
            round([3.0, 4.0], &[0.0, 5.0, 10.0], 12, lobes),
            round([3.0, 4.0], &[3.0], 24, lobes),
            round([3.0, 4.0], &[20.0, 25.0, 30.0], 12, lobes),
        ];
        let mut points = BTreeMap::new();
        for (n, mut own) in own.into_iter().enumerate() {
            for x in own.iter_mut().flatten() {
                *x += 0.02 * (random.unit() + random.unit() + random.unit() - 1.5);
            }
            points.insert(n, OwnPoints { points: own, planar: false });
        }
        let found = run(&plan, Data { points, ..Data::default() }, &Silent).unwrap();
        let record = PlanRecord { path: "plan".into(), sha256: None };
        for c in inspection::document(&plan, record, &found, vec![]).characteristics {
            let (Some(value), Some([from, to])) = (c.value, c.interval) else {
                panic!("{}: {:?}", c.id, c.reason)
            };
            assert!(from <= value && value <= to, "{} {}: {value} of {from} to {to}", c.id, c.kind);
            biased += u32::from(c.noise_bias.is_some());
        }
    }
    assert!(biased > 10, "{biased}");
}
