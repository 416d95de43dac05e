//! What several tests of the inspection ask for: the flatness of a plane at z = 0.

use crate::plan::Plan;
use trueness_geom::mesh::Mesh;

/// The plan of the flatness of a plane within these bounds in x and y, whose normal leans towards x; with keys of its `extract` and more
/// of the plan.
pub(super) fn plane_plan(
    [[a, b], [c, d]]: [[f64; 2]; 2],
    (leaning, tolerance): (f64, f64),
    extract: &str,
    more: &str,
) -> Plan {
    let text = format!(
        r#"
        schema = "trueness/plan/1"
        measured = "part.stl"
        [[feature]]
        id = "A"
        shape = "plane"
        extract = {{ {extract} }}
        [feature.nominal]
        point = [0, 0, 0]
        normal = [{leaning}, 0, 1]
        boundary = [[{a}, {c}, 0], [{b}, {c}, 0], [{b}, {d}, 0], [{a}, {d}, 0]]
        {more}
        [[characteristic]]
        id = "1"
        kind = "flatness"
        feature = "A"
        tolerance = {tolerance}
        "#
    );
    Plan::parse(&text).unwrap()
}

/// The bounds of [`floor`].
pub(super) const FLOOR: [[f64; 2]; 2] = [[0.0, 20.0], [0.0, 20.0]];

/// A floor of squares, 20 by 20, of these heights.
pub(super) fn floor(height: impl Fn(f64, f64) -> f64) -> Mesh {
    let at = |i: u32, j: u32| i * 21 + j;
    let place = |i: f64, j: f64| [i, j, height(i, j)];
    let positions = (0..21 * 21).map(|v| place(f64::from(v / 21), f64::from(v % 21))).collect();
    let square = |i, j| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    Mesh { positions, faces: (0..20).flat_map(|i| (0..20).flat_map(move |j| square(i, j))).collect() }
}
