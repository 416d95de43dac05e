//! Which direction shows most, and what is hidden from it.

use super::*;

#[test]
fn a_line_meets_a_triangle_where_it_lies() {
    let [a, b, c] = [[0.0, 0.0, 5.0], [4.0, 0.0, 5.0], [0.0, 4.0, 7.0]];
    let up = [0.0, 0.0, 1.0];
    assert_eq!(crossing([1.0, 2.0, 0.0], up, a, b, c), Some(6.0));
    assert_eq!(crossing([1.0, 2.0, 9.0], up, a, b, c), Some(-3.0));
    assert_eq!(crossing([3.0, 2.0, 0.0], up, a, b, c), None);
    assert_eq!(crossing([1.0, 2.0, 0.0], [1.0, 0.0, 0.0], a, b, [0.0, 4.0, 5.0]), None);
}

/// Patches leave out nothing that a facet alone would block.
#[test]
fn patches_block_what_their_facets_do() {
    let random = &mut trueness_geom::num::random::Random::new(5);
    let mut around = |middle: Point, size: f64| middle.map(|x| x + size * (random.unit() - 0.5));
    let directions: Vec<Vector> = (0..20).map(|_| unit(around([0.0; 3], 2.0)).unwrap().0).collect();
    let probes: Vec<(Point, f64)> = (0..40).map(|n| (around([0.0; 3], 4.0), 0.02 * f64::from(n))).collect();
    let mut blocked = 0;
    for n in 0..300 {
        let (middle, size) = (around([0.0; 3], 6.0), 0.1 * f64::from(n % 30));
        let mut corner = || around(middle, size);
        let facets: Vec<[Point; 3]> = (0..1 + n % 7).map(|_| [corner(), corner(), corner()]).collect();
        let mut bits = vec![0; probes.len()];
        patch_blocks(&mut bits, &probes, &directions, &facets);
        for ((from, near), bits) in probes.iter().zip(bits) {
            for (d, toward) in directions.iter().enumerate() {
                let blocks =
                    |[a, b, c]: &[Point; 3]| crossing(*from, *toward, *a, *b, *c).is_some_and(|t| t > *near);
                let any = facets.iter().any(blocks);
                assert_eq!(bits >> d & 1 == 1, any, "{n} {d}");
                blocked += usize::from(any);
            }
        }
    }
    assert!(blocked > 1000, "{blocked}");
}

/// The cube from −1 to 1.
fn cube() -> Mesh {
    let corner = |i: u32| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 1.0 } else { -1.0 });
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Mesh { positions: (0..8).map(corner).collect(), faces }
}

fn object<'a>(role: ViewRole, geometry: Geometry<'a>, values: &'a [f64]) -> ViewObject<'a> {
    ViewObject {
        role,
        name: "",
        color: None,
        comparison: None,
        geometry,
        fields: vec![crate::ViewField { comparison: 0, values, reasons: &[] }],
        keep: &[],
        gathered: None,
        faces: None,
    }
}

/// The middles of the cube's faces, a little off the middle, `depth` under the surface.
fn middles(depth: f64) -> Vec<PlaceToSee> {
    let axes =
        (0..3).flat_map(|k| [1.0, -1.0].map(|s| std::array::from_fn(|i| if i == k { s } else { 0.0 })));
    axes.map(|n: Vector| PlaceToSee {
        any: false,
        reached: 0,
        samples: vec![plus(times(1.0 - depth, n), [0.0123 * n[1], 0.0123 * n[2], 0.0123 * n[0]])],
        normal: Some(n),
        near: (MAX_OBLIQUE_FACTOR * depth).max(0.01),
    })
    .collect()
}

/// Every candidate sees of a convex body what looks to it, unless that is more `oblique`, and nothing else.
fn sees_one_side_only(places: &[PlaceToSee], opaque: &[&ViewObject], oblique: f64) {
    for view in View::of(places, &candidates(Up::Z, None, places), opaque) {
        for (place, seen) in places.iter().zip(&view.seen) {
            let looks = place.normal.map_or(0.0, |n| dot(n, view.toward));
            if !(0.0..oblique).contains(&looks) {
                assert_eq!(seen.is_some(), looks > 0.0, "{:?} from {:?}", place.normal, view.toward);
            }
        }
    }
}

/// Every candidate against every place of a cube's faces, by what is known of a convex body.
#[test]
fn a_convex_body_hides_what_looks_away() {
    let mesh = cube();
    sees_one_side_only(&middles(0.0), &[&object(ViewRole::Part, Geometry::Mesh(&mesh), &[0.0; 8])], 0.0);
}

/// A cloud of 30,000 points scattered on the cube: one looks between them, but not through the part. Decided by the
/// reference, though it is not drawn; without one by the points as discs that close the surface.
#[test]
fn a_cloud_hides_what_looks_away() {
    let mut random = trueness_geom::num::random::Random::new(7);
    let mut on_the_cube = || {
        let mut p: Point = [0.0; 3].map(|_: f64| 2.0 * random.unit() - 1.0);
        p[random.below(3) as usize] = if random.below(2) == 1 { 1.0 } else { -1.0 };
        p
    };
    let points: Vec<Point> = (0..30_000).map(|_| on_the_cube()).collect();
    let (mesh, values) = (cube(), vec![0.0; 30_000]);
    let cloud = || object(ViewRole::Measured, Geometry::Points(&points), &values);
    let objects = [cloud(), object(ViewRole::Reference, Geometry::Mesh(&mesh), &[0.0; 8])];
    let shown = shown_objects(&objects);
    assert_eq!(shown.len(), 1, "the reference is not drawn");
    sees_one_side_only(&middles(0.025), &opaque(&objects, &shown), MIN_SEEN_COSINE);
    let alone = [cloud()];
    sees_one_side_only(&middles(0.0), &opaque(&alone, &shown_objects(&alone)), MIN_SEEN_COSINE);
}

/// The leader of a frame ends where the value is reached as well, before it ends anywhere on the feature.
#[test]
fn other_places_of_a_frame_are_first_those_that_reach_the_value() {
    let frame = crate::subject::Frame {
        id: "1".into(),
        sign: None,
        parameter: None,
        diametral: false,
        lower: None,
        upper: 0.1,
        unit: "",
        letters: vec![],
        material: None,
        datums: vec![],
        value: Some(0.05),
        decimals: 3,
        verdict: "verdict.pass",
    };
    let [worst, rim] = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
    let mark = Mark { points: vec![worst], segments: vec![[rim, worst]], ..Mark::default() };
    let pick = Pick { frame: Some(frame), ..Pick::default() };
    assert_eq!((others(&pick, Some(&mark)), reached(&pick, Some(&mark))), (vec![worst, rim], 1));
    let shell = Mark { triangles: vec![[worst, rim, rim]], ..Mark::default() };
    assert_eq!(
        (others(&Pick::default(), Some(&shell)), reached(&Pick::default(), Some(&shell))),
        (vec![worst], 1)
    );
}
