//! Signs, exclusions and the choice of the sign method, against closed forms and winding numbers by definition.

use super::super::sign_choice::SignReason;
use super::*;
use crate::closest::tests::TestRandom;
use crate::deviation::along::Along;
use crate::samples::{add, block, cube, inverted, sphere};
use crate::space::{cross, dot, minus, norm, plus};

fn ask(mesh: &Mesh, options: SurfaceOptions, points: &[Point]) -> (SignChoice, Vec<f64>, Disagreement) {
    let tree = Tree::build(mesh).unwrap();
    let surface = ReferenceSurface::new(&tree, mesh, &options, &Silent).unwrap();
    let deviations = surface.deviations(points, &Silent).unwrap();
    for (p, d) in points.iter().zip(&deviations) {
        let alone = surface.at(p).unwrap().map(|(deviation, _)| deviation);
        assert_eq!(alone, Some(*d).filter(|d| d.is_finite()), "{p:?}");
    }
    (*surface.sign(), deviations, surface.disagreement(points, &Silent).unwrap())
}

const POINTS: [Point; 3] = [[0.5, 0.5, 0.25], [3.0, 0.5, 0.5], [-1.0, -1.0, 0.5]];
const DEVIATIONS: [f64; 3] = [-0.25, 2.0, std::f64::consts::SQRT_2];

#[test]
fn closed_mesh_is_signed_by_pseudonormals_inside_out_or_not() {
    let mut mesh = cube(1.0);
    for inside_out in [false, true] {
        let (choice, deviations, disagreement) = ask(&mesh, SurfaceOptions::default(), &POINTS);
        assert_eq!((choice.method, choice.reason), (SignMethod::Pseudonormal, SignReason::Closed));
        assert_eq!(choice.inside_out, inside_out);
        assert_eq!(deviations, DEVIATIONS);
        assert_eq!(disagreement, Disagreement { sample: 3, differing: 0 });
        mesh.faces.iter_mut().for_each(|f| f.swap(0, 1));
    }
}

#[test]
fn mesh_with_a_gap_or_a_turned_facet_is_signed_by_winding_number() {
    let mut gap = cube(1.0);
    gap.faces.pop();
    let (choice, deviations, _) = ask(&gap, SurfaceOptions::default(), &POINTS);
    assert_eq!(
        (choice.method, choice.reason),
        (SignMethod::Winding, SignReason::NearlyClosed { boundary_edges: 3 })
    );
    assert_eq!(deviations, DEVIATIONS);
    let mut turned = cube(1.0);
    turned.faces[11].swap(0, 1);
    let (choice, _, _) = ask(&turned, SurfaceOptions::default(), &POINTS);
    assert_eq!((choice.method, choice.reason), (SignMethod::Winding, SignReason::Inconsistent));
}

/// A winding number never exceeds one half beside a sheet: every point would be outside.
#[test]
fn sheet_has_two_sides() {
    let mut sheet = cube(1.0);
    sheet.faces.truncate(2); // the bottom, facing down
    let points = [[0.5, 0.5, 0.125], [0.5, 0.5, -0.25]];
    let (choice, deviations, disagreement) = ask(&sheet, SurfaceOptions::default(), &points);
    assert_eq!(
        (choice.method, choice.reason),
        (SignMethod::Pseudonormal, SignReason::OpenSheet { openness: 1.0 })
    );
    assert_eq!(deviations, [-0.125, 0.25]);
    assert_eq!(disagreement.differing, 1);
}

#[test]
fn far_points_and_points_beyond_the_rim_are_excluded() {
    let mut sheet = cube(1.0);
    sheet.faces.truncate(2);
    let options = SurfaceOptions { max_distance: 1.0, skip_boundary: true, ..SurfaceOptions::default() };
    let points = [[0.5, 0.5, -1.0], [0.5, 0.5, -1.5], [1.5, 0.5, 0.0]];
    let (_, deviations, _) = ask(&sheet, options, &points);
    let excluded: Vec<Option<Exclusion>> = deviations.iter().map(|&d| Exclusion::of(d)).collect();
    assert_eq!(excluded, [None, Some(Exclusion::MaxDistance), Some(Exclusion::BoundaryEdge)]);
    assert_eq!(deviations[0], 1.0);
}

/// How often the facets wind around a point, by the definition: the sum of their solid angles (van Oosterom and Strackee).
fn winding(mesh: &Mesh, p: &Point) -> f64 {
    let angle = |f: &[u32; 3]| {
        let [a, b, c] = f.map(|v| minus(mesh.positions[v as usize], *p));
        let (la, lb, lc) = (norm(a), norm(b), norm(c));
        let re = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        2.0 * dot(a, cross(b, c)).atan2(re)
    };
    mesh.faces.iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

/// The points whose side is not that which the winding number tells.
fn on_the_wrong_side(mesh: &Mesh, points: &[Point]) -> (SignChoice, usize) {
    let (choice, deviations, _) = ask(mesh, SurfaceOptions::default(), points);
    let wrong = |(p, d): (&Point, &f64)| d.abs() > 1e-9 && (winding(mesh, p) > 0.5) != (*d < 0.0);
    (choice, points.iter().zip(&deviations).filter(|pair| wrong(*pair)).count())
}

#[test]
fn overlapping_shells_are_signed_by_what_winds_around_a_point() {
    let d = &mut TestRandom(21);
    let mut overlapping = 0;
    for case in 0..12 {
        let mut mesh = Mesh::default();
        for i in 0..2 + case % 3 {
            let at = d.point(if i == 0 { 0.0 } else { 1.0 });
            let part = if d.bits().is_multiple_of(2) { sphere(12, 1.0, [0.0; 3]) } else { block(3, 1.25) };
            add(&mut mesh, &part, at);
        }
        let points: Vec<Point> = (0..2000).map(|_| d.point(2.5)).collect();
        let (choice, wrong) = on_the_wrong_side(&mesh, &points);
        assert_eq!(wrong, 0, "{case} {choice:?}");
        overlapping += u32::from(choice.reason == SignReason::Overlapping);
    }
    // One in twelve happens to lie apart.
    assert_eq!(overlapping, 11);
}

/// Shells in shells, each one either way round; and apart from each other, where boxes overlap or not.
#[test]
fn nested_shells_are_material_or_cavities() {
    let d = &mut TestRandom(22);
    for inwards in 0..8 {
        let mut mesh = Mesh::default();
        for (i, radius) in [3.0, 2.0, 1.0].into_iter().enumerate() {
            let part = sphere(10, radius, [0.0; 3]);
            add(&mut mesh, &if inwards >> i & 1 == 1 { inverted(part) } else { part }, [0.5; 3]);
        }
        let points: Vec<Point> = (0..1500).map(|_| plus([0.5; 3], d.point(3.5))).collect();
        let (choice, wrong) = on_the_wrong_side(&mesh, &points);
        // Material, cavity, material; or the same inside out.
        let alternates = inwards == 0b010 || inwards == 0b101;
        assert_eq!(choice.reason == SignReason::Closed, alternates, "{inwards:b}");
        assert!(choice.inside_out || wrong == 0, "{inwards:b}: {wrong}");
    }
    for (apart, reason) in
        [(0.9, SignReason::Overlapping), (1.5, SignReason::Closed), (3.0, SignReason::Closed)]
    {
        let mut mesh = sphere(12, 1.0, [0.0; 3]);
        add(&mut mesh, &sphere(12, 1.0, [0.0; 3]), [apart; 3]);
        let points: Vec<Point> = (0..1500).map(|_| d.point(3.0)).collect();
        let (choice, wrong) = on_the_wrong_side(&mesh, &points);
        assert_eq!((choice.reason, wrong), (reason, 0), "{apart}");
    }
}

/// Two cubes that share a wall: of the two facets there, each looks away from one of them.
#[test]
fn shells_that_touch_are_signed_by_winding_number() {
    let d = &mut TestRandom(23);
    let mut mesh = block(3, 1.0);
    add(&mut mesh, &block(2, 1.0), [1.0, 0.0, 0.0]);
    let points: Vec<Point> = (0..3000).map(|_| plus([1.0, 0.5, 0.5], d.point(1.2))).collect();
    let (choice, wrong) = on_the_wrong_side(&mesh, &points);
    assert_eq!((choice.reason, wrong), (SignReason::Overlapping, 0));
}

#[test]
fn points_on_the_surface_take_no_part_in_the_disagreement() {
    let mesh = sphere(20, 10.0, [100.0; 3]);
    let middles = mesh.faces.iter().map(|f| {
        let [a, b, c] = mesh.places(f);
        std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0)
    });
    let on: Vec<Point> = mesh.positions.iter().copied().chain(middles).collect();
    let (_, _, disagreement) = ask(&mesh, SurfaceOptions::default(), &on);
    assert_eq!(disagreement, Disagreement { sample: 0, differing: 0 });
    let off: Vec<Point> = on.iter().map(|p| plus(*p, [0.125, 0.0, 0.0])).collect();
    let (_, _, disagreement) = ask(&mesh, SurfaceOptions::default(), &off);
    assert!(disagreement.sample > 1000 && disagreement.differing == 0, "{disagreement:?}");
}

/// Closed forms along a direction, along the reference's normal and along each point's own; what is not met is told why.
#[test]
fn deviations_along_lines() {
    let mesh = cube(1.0);
    let tree = Tree::build(&mesh).unwrap();
    let options = SurfaceOptions { max_distance: 2.5, ..SurfaceOptions::default() };
    let surface = ReferenceSurface::new(&tree, &mesh, &options, &Silent).unwrap();
    // Over the top; beside it; inside, nearest to the bottom; too far from everything; in reach, but not along the line.
    let points = [[0.5, 0.5, 1.25], [1.5, 0.25, 0.5], [0.5, 0.5, 0.25], [0.5, 0.5, 4.0], [0.5, 0.5, 3.0]];
    let ask = |start, along: &Along| {
        let got =
            surface.map_along(start, &points, along, &Silent, |_, d, c| (d, c.map(|c| c.point))).unwrap();
        got.into_iter()
            .map(|(d, at)| Exclusion::of(d).map_or_else(|| Ok((d, at.unwrap())), Err))
            .collect::<Vec<_>>()
    };
    use Exclusion::{MaxDistance, NoCrossing, NoDirection};
    let up = ask(0, &Along::Direction([0.0, 0.0, -3.0]));
    let top = Ok((0.25, [0.5, 0.5, 1.0]));
    let bottom = Ok((-0.25, [0.5, 0.5, 0.0]));
    assert_eq!(up, [top, Err(NoCrossing), bottom, Err(MaxDistance), Ok((2.0, [0.5, 0.5, 1.0]))]);
    let normals = surface.normals(&Silent).unwrap();
    let nearest = ask(0, &normals);
    assert_eq!(nearest[..3], [top, Ok((0.5, [1.0, 0.25, 0.5])), bottom]);
    // Its own normals, from the second of a list on: aslant by 3 : 4, across, none, and no number.
    let own = [[9.0; 3], [0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0], [f64::NAN; 3]];
    let own = ask(1, &Along::Measured(own.to_vec().into()));
    let (d, at) = own[0].unwrap();
    assert!((d - 0.25 / 0.8).abs() < 1e-15 && (at[0] - (0.5 - 0.25 * 0.75)).abs() < 1e-15, "{d} {at:?}");
    assert_eq!(own[1..], [Err(NoCrossing), Err(NoDirection), Err(MaxDistance), Err(NoDirection)]);
}

/// Lines through the center of a sphere have the nearest distance; the normal of points beyond an edge is that of both facets.
#[test]
fn normals_of_the_reference_are_those_of_the_nearest_place() {
    let center = [1.0, 2.0, 3.0];
    let mesh = sphere(60, 5.0, center);
    let tree = Tree::build(&mesh).unwrap();
    let surface = ReferenceSurface::new(&tree, &mesh, &SurfaceOptions::default(), &Silent).unwrap();
    let d = &mut TestRandom(7);
    let points: Vec<Point> = (0..500).map(|_| plus(center, d.point(6.0))).collect();
    let normals = surface.normals(&Silent).unwrap();
    let along = surface.map_along(0, &points, &normals, &Silent, |_, d, _| d).unwrap();
    let nearest = surface.deviations(&points, &Silent).unwrap();
    for ((a, n), p) in along.iter().zip(&nearest).zip(&points) {
        // The normal of a facet leans by up to a facet's turn of 6° from the way to the nearest place.
        let most = n.abs() / (6f64.to_radians()).cos() + 1e-9;
        assert!(a.signum() == n.signum() && a.abs() >= n.abs() - 1e-12 && a.abs() <= most, "{p:?}: {a} {n}");
    }
    let (mesh, beside) = (cube(1.0), [[1.3, 0.4, 1.1]]);
    let tree = Tree::build(&mesh).unwrap();
    let surface = ReferenceSurface::new(&tree, &mesh, &SurfaceOptions::default(), &Silent).unwrap();
    let found = surface
        .map_along(0, &beside, &surface.normals(&Silent).unwrap(), &Silent, |_, d, c| (d, *c.unwrap()));
    let (d, crossing) = found.unwrap()[0];
    // Along (1, 0, 1) from there the side x = 1 is met at z = 0.8.
    assert!(
        (d - 0.3 * 2f64.sqrt()).abs() < 1e-14 && (crossing.point[2] - 0.8).abs() < 1e-14,
        "{d} {crossing:?}"
    );
}
