//! Poses found from anywhere.

use super::parts::{block, bracket, moved, normal, random_pose, turned};
use crate::align::{
    AlignError, AlignWarning, Alignment, BestFit, Freedom, Measured, Start, Target, best_fit,
};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::{Progress, Silent};
use crate::rigid::Rigid;
use crate::space::{Point, cross, minus, norm, plus, times};

fn fit(measured: &Measured, reference: &Mesh) -> Alignment {
    let tree = Tree::build(reference).unwrap();
    best_fit(measured, &Target::new(reference, &tree), &BestFit::default(), &Silent).unwrap()
}

fn off(found: &Alignment, pose: &Rigid, at: Point) -> [f64; 2] {
    let off = found.reference_from_measured.after(pose);
    [off.angle(), off.displacement(at)]
}

const MIDDLE: Point = [40.0, 25.0, 10.0];

#[test]
fn the_same_part_is_found_from_random_poses() {
    let reference = bracket(4.0);
    let random = &mut Random::new(1);
    for trial in 0..8 {
        let pose = random_pose(random, 200.0);
        let found = fit(&Measured::Mesh(&moved(&reference, &pose)), &reference);
        let [angle, shift] = off(&found, &pose, MIDDLE);
        assert!(angle < 1e-10 && shift < 1e-9, "{trial}: {found:?}");
        assert!(found.converged && found.warnings.is_empty(), "{trial}: {:?}", found.warnings);
    }
}

#[test]
fn a_measured_mesh_of_few_facets_is_found_by_its_surface() {
    // Whole sides of two facets each, and a tetrahedron of four: the vertices alone determine no pose among others.
    let tetrahedron = Mesh {
        positions: vec![[0.0, 0.0, 0.0], [40.0, 0.0, 0.0], [0.0, 70.0, 0.0], [0.0, 0.0, 110.0]],
        faces: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    };
    let random = &mut Random::new(21);
    for part in [tetrahedron, bracket(200.0)] {
        for trial in 0..4 {
            let pose = random_pose(random, 200.0);
            let found = fit(&Measured::Mesh(&moved(&part, &pose)), &part);
            let [angle, shift] = off(&found, &pose, MIDDLE);
            assert!(angle < 1e-9 && shift < 1e-7, "{trial}: {angle} {shift} {found:?}");
            assert!(found.converged && found.warnings.is_empty(), "{trial}: {:?}", found.warnings);
        }
    }
}

#[test]
fn clutter_around_a_piece_of_the_part_does_not_hide_its_place() {
    // 70 % of the surface, and a fifth of all that is measured belongs to other things: a table below, a clamp.
    let reference = bracket(4.0);
    let scan = bracket(1.5);
    let random = &mut Random::new(33);
    let mut right = 0;
    for _ in 0..10 {
        let normal: Point = std::array::from_fn(|_| 2.0 * random.unit() - 1.0);
        let normal = times(1.0 / norm(normal), normal);
        let mut along: Vec<f64> =
            scan.faces.iter().map(|f| crate::space::dot(scan.positions[f[0] as usize], normal)).collect();
        along.sort_by(f64::total_cmp);
        let piece = half(&scan, normal, along[3 * along.len() / 10]);
        let other = block([-30.0, -20.0, -28.0], [60.0, 16.0, -20.0], 1.5);
        let clamp = block([70.0, 60.0, -20.0], [86.0, 80.0, 25.0], 1.5);
        let other = super::parts::together(&[
            half(&other, [0.0, 0.0, 1.0], -20.5),
            half(&clamp, [-0.6, -0.8, 0.3], -110.0),
        ]);
        let pose = random_pose(random, 200.0);
        let found = fit(&Measured::Mesh(&moved(&super::parts::together(&[piece, other]), &pose)), &reference);
        let [angle, shift] = off(&found, &pose, MIDDLE);
        println!("{angle} {shift} {:?}", found.warnings);
        right += usize::from(angle < 1e-5 && shift < 1e-4);
    }
    assert_eq!(right, 10);
}

/// The top of a plate with two pegs is off by some millimeters and degrees. The plate holds its seen part where it is and the
/// pegs count as outliers. No small step leads to where they fit.
#[test]
fn a_pose_beside_the_right_one_is_left() {
    let plate = block([0.0; 3], [60.0, 40.0, 5.0], 2.0);
    let pegs =
        [block([12.0, 8.0, 5.0], [18.0, 14.0, 9.0], 1.0), block([40.0, 24.0, 5.0], [46.0, 28.0, 9.0], 1.0)];
    let reference = super::parts::together(&[plate.clone(), pegs[0].clone(), pegs[1].clone()]);
    let inner = |f: &&[u32; 3]| {
        f.iter().all(|v| {
            plate.positions[*v as usize][2] == 5.0 && (8.0..52.0).contains(&plate.positions[*v as usize][0])
        })
    };
    let middle = |mesh: &Mesh, f: &[u32; 3]| -> Point {
        std::array::from_fn(|k| f.iter().map(|v| mesh.positions[*v as usize][k]).sum::<f64>() / 3.0)
    };
    let under = |p: &Point| {
        pegs.iter().any(|peg| {
            let b = peg.bounds();
            (0..2).all(|k| b.min[k] - 0.1 <= p[k] && p[k] <= b.max[k] + 0.1)
        })
    };
    let mut points: Vec<Point> =
        plate.faces.iter().filter(inner).map(|f| middle(&plate, f)).filter(|p| !under(p)).collect();
    for peg in &pegs {
        points.extend(peg.faces.iter().map(|f| middle(peg, f)).filter(|p| p[2] > 5.1));
    }
    let random = &mut Random::new(4);
    for p in &mut points {
        *p = p.map(|x| x + 0.02 * (random.unit() - 0.5));
    }
    let tree = Tree::build(&reference).unwrap();
    let target = Target::new(&reference, &tree);
    let start = Rigid::translation_by([4.0, -3.0, 0.0])
        .after(&Rigid::rotation_about([30.0, 20.0, 5.0], [0.0, 0.0, 0.1]));
    let options = BestFit { start: Start::From(start), ..BestFit::default() };
    let measured = Measured::Points { points: &points, normals: None };
    let found = best_fit(&measured, &target, &options, &Silent).unwrap();
    let samples = crate::align::sample::Samples::all(&measured);
    let edges = crate::closest::BoundaryEdges::watched(&tree, &Silent).unwrap();
    let work = crate::align::work::Work::new(&target, &edges, &options, &samples);
    // Outliers alone do not count in an iteration from the start; where all count first it is left, too.
    let (pose, _) = work.choose(&[start], &samples, &Silent).unwrap();
    assert!(pose.displacement([30.0, 20.0, 5.0]) > 2.0, "{pose:?}");
    let is_right = |found: &Rigid| {
        let off = [[10.0, 10.0, 5.0], [50.0, 30.0, 5.0]].map(|p| found.displacement(p));
        assert!(off.iter().all(|d| *d < 0.05), "{off:?}");
    };
    is_right(&found.reference_from_measured);
    let stuck = Alignment { reference_from_measured: pose, ..found };
    let oriented_subset = samples.oriented_subset(400, 0);
    let search = crate::align::start::Search::new(&target, oriented_subset, 0, &Silent).unwrap();
    let found = work.around(&search, &stuck, &samples, &Silent).unwrap();
    let options = BestFit { start: Start::From(found), ..BestFit::default() };
    let found = best_fit(&measured, &target, &options, &Silent).unwrap().reference_from_measured;
    is_right(&found);
}

fn triangle_area([a, b, c]: [Point; 3]) -> f64 {
    0.5 * norm(cross(minus(b, a), minus(c, a)))
}

/// Triangles cut into four equal ones by the middles of their sides, so many times.
fn quartered(all: &[[Point; 3]], rounds: usize) -> Vec<[Point; 3]> {
    let cut = |[a, b, c]: &[Point; 3]| {
        let middle = |p: &Point, q: &Point| times(0.5, plus(*p, *q));
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        [[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]
    };
    (0..rounds).fold(all.to_vec(), |all, _| all.iter().flat_map(cut).collect())
}

/// The part with waves of form, as a scan has them.
fn wavy(mesh: &Mesh, size: f64) -> Mesh {
    let wave = |p: &Point| {
        let s = |a: f64, b: f64| size * libm::sin(0.21 * a + 0.13 * b);
        [p[0] + s(p[1], p[2]), p[1] + s(p[2], p[0]), p[2] + s(p[0], p[1])]
    };
    Mesh { positions: mesh.positions.iter().map(wave).collect(), faces: mesh.faces.clone() }
}

#[test]
fn the_pose_is_the_least_of_the_sum_of_squares() {
    // By brute force: no small motion about the result has a lower integral of squared distances over the surface. Each facet
    // is cut into 64 equal ones, whose middles are taken. The figures are those of the vertices, with a third of the area
    // around.
    let reference = bracket(8.0);
    let scan = wavy(&bracket(3.0), 0.02);
    let tree = Tree::build(&reference).unwrap();
    let options = BestFit { robust: false, ..BestFit::default() };
    let found = best_fit(&Measured::Mesh(&scan), &Target::new(&reference, &tree), &options, &Silent).unwrap();
    let (mut places, mut vertices, mut total) = (vec![], vec![], 0.0);
    for f in &scan.faces {
        let corners = scan.places(f);
        let area = triangle_area(corners);
        total += area;
        for piece in quartered(&[corners], 3) {
            let middle = times(1.0 / 3.0, plus(plus(piece[0], piece[1]), piece[2]));
            places.push((middle, area / 64.0));
        }
        vertices.extend(corners.map(|p| (p, area / 3.0)));
    }
    let squares = |motion: &Rigid, places: &[(Point, f64)]| -> f64 {
        let pose = motion.after(&found.reference_from_measured);
        let of = |(p, w): &(Point, f64)| {
            let hit = tree.closest(&pose.point(*p), f64::INFINITY).unwrap().unwrap();
            w * hit.distance * hit.distance
        };
        places.iter().map(of).sum()
    };
    let rms = (squares(&Rigid::IDENTITY, &vertices) / total).sqrt();
    assert!((rms / found.rms - 1.0).abs() < 1e-9, "{rms} {}", found.rms);
    let least = squares(&Rigid::IDENTITY, &places);
    for k in 0..6 {
        for sign in [-1.0, 1.0] {
            let mut v = [0.0; 3];
            // A tenth of what an independent pose may be off.
            v[k % 3] = sign * if k < 3 { 0.000_05f64.to_radians() } else { 0.000_015 };
            let motion =
                if k < 3 { Rigid::rotation_about(found.center, v) } else { Rigid::translation_by(v) };
            let there = squares(&motion, &places);
            assert!(there > least, "{k} {sign}: {}", there / least - 1.0);
        }
    }
}

/// The facets of `mesh` whose middles lie on one side of a plane.
fn half(mesh: &Mesh, normal: Point, beyond: f64) -> Mesh {
    let middle = |f: &[u32; 3]| {
        f.iter().map(|&v| crate::space::dot(mesh.positions[v as usize], normal)).sum::<f64>() / 3.0
    };
    Mesh {
        positions: mesh.positions.clone(),
        faces: mesh.faces.iter().copied().filter(|f| middle(f) > beyond).collect(),
    }
}

#[test]
fn a_piece_of_the_part_finds_its_place() {
    let reference = bracket(4.0);
    let scan = bracket(1.5);
    let random = &mut Random::new(3);
    for (normal, beyond) in [([1.0, 0.3, 0.2], 48.0), ([0.0, 0.0, 1.0], 9.5), ([-0.5, 1.0, 0.4], 6.0)] {
        let pose = random_pose(random, 200.0);
        let found = fit(&Measured::Mesh(&moved(&half(&scan, normal, beyond), &pose)), &reference);
        let [angle, shift] = off(&found, &pose, MIDDLE);
        assert!(angle < 1e-6 && shift < 1e-5, "{normal:?}: {angle} {shift} {:?}", found.warnings);
    }
}

#[test]
fn points_without_normals_find_their_place_and_strays_do_not_count() {
    let reference = bracket(4.0);
    let random = &mut Random::new(5);
    let mut points = bracket(1.5).positions;
    let there = points.len();
    for _ in 0..there / 10 {
        points.push(std::array::from_fn(|k| [100.0, 70.0, 50.0][k] * random.unit() - 10.0));
    }
    let pose = random_pose(random, 200.0);
    points.iter_mut().for_each(|p| *p = pose.point(*p));
    let found = fit(&Measured::Points { points: &points, normals: None }, &reference);
    let [angle, shift] = off(&found, &pose, MIDDLE);
    assert!(angle < 1e-6 && shift < 1e-5, "{angle} {shift} {found:?}");
    assert!(found.excluded_points >= there as u64 / 20, "{}", found.excluded_points);
}

#[test]
fn turned_normals_are_noticed() {
    let reference = bracket(4.0);
    let pose = random_pose(&mut Random::new(8), 50.0);
    let mut scan = moved(&reference, &pose);
    scan.faces.iter_mut().for_each(|f| f.swap(1, 2));
    let found = fit(&Measured::Mesh(&scan), &reference);
    assert!(found.warnings.contains(&AlignWarning::NormalsTurned), "{:?}", found.warnings);
    assert!(off(&found, &pose, MIDDLE)[1] < 1e-8);
}

/// The rest fits to the last digit, so that what is off counts as an outlier: nobody shall have to guess from a share.
#[test]
fn a_face_that_does_not_count_is_told() {
    let reference = block([0.0; 3], [80.0, 50.0, 20.0], 4.0);
    let higher = block([0.0; 3], [80.0, 50.0, 20.1], 4.0);
    let found = fit(&Measured::Mesh(&higher), &reference);
    let told: Vec<&AlignWarning> =
        found.warnings.iter().filter(|w| matches!(w, AlignWarning::Excluded { .. })).collect();
    let [AlignWarning::Excluded { share, farthest, limit }] = told[..] else {
        panic!("{:?}", found.warnings)
    };
    assert!((share + found.share - 1.0).abs() < 1e-12 && (0.25..0.35).contains(share), "{share}");
    assert!((farthest - 0.1).abs() < 1e-6 && *limit < 0.01, "{farthest} {limit}");
    // With noise all of it counts.
    let random = &mut Random::new(3);
    let mut noisy = higher;
    noisy.positions.iter_mut().flatten().for_each(|x| *x += 0.1 * (random.unit() - 0.5));
    let told = fit(&Measured::Mesh(&noisy), &reference).warnings;
    assert!(!told.iter().any(|w| matches!(w, AlignWarning::Excluded { .. })), "{told:?}");
}

#[test]
fn a_wrong_unit_is_noticed() {
    let reference = bracket(4.0);
    let mut random = Random::new(3);
    for (factor, inward) in [(25.4, false), (1e-3, false), (1000.0, true), (0.1, true)] {
        for _ in 0..2 {
            let mut scan = moved(&reference, &random_pose(&mut random, 50.0));
            scan.positions.iter_mut().for_each(|p| *p = times(1.0 / factor, *p));
            if inward {
                scan.faces.iter_mut().for_each(|f| f.swap(1, 2));
            }
            let warnings = fit(&Measured::Mesh(&scan), &reference).warnings;
            assert!(warnings.contains(&AlignWarning::Scale { factor }), "{factor}: {warnings:?}");
            assert_eq!(warnings.contains(&AlignWarning::NormalsTurned), inward, "{factor}: {warnings:?}");
        }
    }
}

#[test]
fn a_part_that_looks_the_same_in_several_ways_is_told() {
    // A box of three different sides: three half turns.
    let reference = block([0.0; 3], [40.0, 25.0, 10.0], 2.0);
    let found = fit(&Measured::Mesh(&reference), &reference);
    assert_eq!(found.alternatives.len(), 3, "{:?}", found.alternatives);
    assert!(found.alternatives.iter().all(|a| (a.angle - std::f64::consts::PI).abs() < 1e-6));
    assert!(found.warnings.contains(&AlignWarning::Ambiguous { count: 3 }));
    assert!(found.freedoms.is_empty() && found.condition.is_some());
}

/// Out of poses that fit equally the one that moves least is taken, whatever the samples.
#[test]
fn a_symmetric_part_is_not_turned_without_need() {
    for sides in [[40.0, 25.0, 10.0], [40.0, 40.0, 10.0], [20.0, 20.0, 20.0]] {
        let reference = block([0.0; 3], sides, 2.0);
        let tree = Tree::build(&reference).unwrap();
        let target = Target::new(&reference, &tree);
        for seed in 0..4 {
            let pose = Rigid::rotation_about([5.0, 0.0, 3.0], [0.02, -0.1, 0.03 * seed as f64]);
            let measured = moved(&reference, &pose);
            let options = BestFit { seed, ..BestFit::default() };
            let found = best_fit(&Measured::Mesh(&measured), &target, &options, &Silent).unwrap();
            let [angle, shift] = off(&found, &pose, MIDDLE);
            assert!(angle < 1e-9 && shift < 1e-8, "{sides:?} {seed}: {angle} {shift}");
            assert!(!found.alternatives.is_empty());
        }
    }
}

#[test]
fn a_body_of_revolution_turns_about_its_axis() {
    let profile = [[0.0, 0.0], [12.0, 0.0], [12.0, 10.0], [7.0, 14.0], [7.0, 30.0], [0.0, 30.0]];
    let reference = turned(&profile, 64);
    let pose = Rigid::rotation_about([0.0; 3], [0.3, 0.1, 0.2]);
    let found = fit(&Measured::Mesh(&moved(&turned(&profile, 90), &pose)), &reference);
    let [Freedom::Turns { point, direction }] = found.freedoms[..] else { panic!("{:?}", found.freedoms) };
    assert!(norm(cross(direction, [0.0, 0.0, 1.0])) < 1e-2, "{direction:?}");
    assert!(libm::hypot(point[0], point[1]) < 0.1, "{point:?}");
    assert_eq!(found.condition, None);
}

#[test]
fn a_patch_of_a_plane_slides_and_turns() {
    let reference = block([0.0; 3], [40.0, 25.0, 10.0], 5.0);
    let points: Vec<Point> =
        (0..400).map(|k| [10.0 + (k % 20) as f64, 8.0 + 0.5 * (k / 20) as f64, 10.0]).collect();
    let found = fit(&Measured::Points { points: &points, normals: None }, &reference);
    let slides = found.freedoms.iter().filter(|f| matches!(f, Freedom::Slides { .. })).count();
    assert_eq!((found.freedoms.len(), slides), (3, 2), "{:?}", found.freedoms);
}

#[test]
fn noise_and_uncertainty_agree() {
    // Noisy copies put the pose off by its covariance: the mean of the squared normalized error of each of the six is 1.
    let reference = bracket(6.0);
    let tree = Tree::build(&reference).unwrap();
    let target = Target::new(&reference, &tree);
    let random = &mut Random::new(12);
    let clean = bracket(2.5);
    let options = BestFit { start: Start::From(Rigid::IDENTITY), ..BestFit::default() };
    let (mut sum, trials) = (0.0, 60);
    for _ in 0..trials {
        let noisy = clean.positions.iter().map(|p| p.map(|x| x + 0.01 * normal(random))).collect();
        let scan = Mesh { positions: noisy, faces: clean.faces.clone() };
        let found = best_fit(&Measured::Mesh(&scan), &target, &options, &Silent).unwrap();
        let pose = found.reference_from_measured;
        let r = pose.rotation();
        let turn = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]].map(|x| 0.5 * x);
        let shift = minus(pose.point(found.center), found.center);
        for k in 0..3 {
            sum += turn[k] * turn[k] / found.covariance[k][k];
            sum += shift[k] * shift[k] / found.covariance[k + 3][k + 3];
        }
    }
    let mean = sum / f64::from(6 * trials);
    assert!((0.7..1.4).contains(&mean), "{mean}");
}

#[test]
fn threads_change_nothing_and_bad_input_is_refused() {
    let reference = bracket(5.0);
    let scan = wavy(&moved(&reference, &random_pose(&mut Random::new(2), 90.0)), 0.02);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| fit(&Measured::Mesh(&scan), &reference))
    };
    assert_eq!(with(1), with(4));
    let tree = Tree::build(&reference).unwrap();
    let target = Target::new(&reference, &tree);
    let of = |points: &[Point], progress: &dyn Progress| {
        best_fit(&Measured::Points { points, normals: None }, &target, &BestFit::default(), progress)
    };
    assert!(matches!(of(&[[0.0; 3]; 2], &Silent), Err(AlignError::TooFewPoints { found: 2, .. })));
    assert_eq!(of(&[[1.0; 3]; 9], &Silent), Err(AlignError::Collinear));
    let line: Vec<Point> = (0..9).map(|k| [f64::from(k), 2.0 * f64::from(k), 1.0]).collect();
    assert_eq!(of(&line, &Silent), Err(AlignError::Collinear));
    assert!(matches!(of(&[[0.0; 3], [f64::NAN; 3], [1.0; 3]], &Silent), Err(AlignError::Point(_))));
    struct Stop;
    impl Progress for Stop {
        fn cancelled(&self) -> bool {
            true
        }
    }
    assert!(matches!(of(&scan.positions, &Stop), Err(AlignError::Cancelled(_))));
}
