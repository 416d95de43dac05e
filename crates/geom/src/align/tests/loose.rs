//! Walls without their ends: what rims alone hold is told, and the pose stays within its range.

use super::parts::{block, normal, random_pose, shared, together};
use crate::align::{AlignWarning, Alignment, BestFit, Freedom, Measured, Start, Target, best_fit};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::rigid::Rigid;
use crate::space::{Point, norm};

/// The caps of an L fan out from its inner corner, the first.
const ELL: [[f64; 2]; 6] = [[15.0, 12.0], [15.0, 40.0], [0.0, 40.0], [0.0, 0.0], [60.0, 0.0], [60.0, 12.0]];

/// A prism over an outline whose caps fan out from its first corner.
fn prism(outline: &[[f64; 2]], [low, high]: [f64; 2]) -> Mesh {
    let at = |k: usize, z: f64| [outline[k % outline.len()][0], outline[k % outline.len()][1], z];
    let mut soup = vec![];
    for k in 0..outline.len() {
        let [a, b, c, d] = [at(k, low), at(k + 1, low), at(k + 1, high), at(k, high)];
        soup.extend([[a, b, c], [a, c, d]]);
        if k > 0 && k + 1 < outline.len() {
            soup.push([at(0, high), at(k, high), at(k + 1, high)]);
            soup.push([at(0, low), at(k + 1, low), at(k, low)]);
        }
    }
    shared(&soup)
}

/// Points of the walls between two heights, with noise across them.
fn walls(
    random: &mut Random,
    outline: &[[f64; 2]],
    [low, high]: [f64; 2],
    count: usize,
    noise: f64,
) -> Vec<Point> {
    let sides: Vec<[[f64; 2]; 2]> =
        (0..outline.len()).map(|k| [outline[k], outline[(k + 1) % outline.len()]]).collect();
    let length = |[a, b]: &[[f64; 2]; 2]| libm::hypot(b[0] - a[0], b[1] - a[1]);
    let total: f64 = sides.iter().map(length).sum();
    let mut points = vec![];
    for k in 0..count {
        let mut along = total * (k as f64 + random.unit()) / count as f64;
        let side = sides.iter().find(|side| {
            along -= length(side);
            along < 0.0
        });
        let side = side.unwrap_or(&sides[0]);
        let [[ax, ay], [bx, by]] = *side;
        let (size, share) = (length(side), 1.0 + along / length(side));
        let off = noise * normal(random) / size;
        let z = low + (high - low) * random.unit();
        points.push([ax + share * (bx - ax) + off * (by - ay), ay + share * (by - ay) - off * (bx - ax), z]);
    }
    points
}

fn fit(points: &[Point], reference: &Mesh, start: Start) -> Alignment {
    let tree = Tree::build(reference).unwrap();
    let options = BestFit { start, ..BestFit::default() };
    best_fit(&Measured::Points { points, normals: None }, &Target::new(reference, &tree), &options, &Silent)
        .unwrap()
}

/// Motions that are told as not held: slides and turns.
fn told(found: &Alignment) -> [usize; 2] {
    let motions = |turns: bool| {
        let is = |w: &&AlignWarning| match w {
            AlignWarning::Undetermined { motion, .. } => matches!(motion, Freedom::Turns { .. }) == turns,
            _ => false,
        };
        found.warnings.iter().filter(is).count()
    };
    [motions(false), motions(true)]
}

/// The angle by which `motion` tilts z.
fn tilt(motion: &Rigid) -> f64 {
    let [x, y, _] = motion.vector([0.0, 0.0, 1.0]);
    libm::hypot(x, y)
}

/// Turned in the plane and lying anywhere: heights are told as not held, and no tilt is made of noise.
#[test]
fn walls_alone_do_not_hold_their_height_and_nothing_tilts() {
    let random = &mut Random::new(7);
    let (mut right, mut silent) = (0, 0);
    for trial in 0..24 {
        let half = [1.0, 5.0, 12.0, 2.0][trial % 4];
        let reference = prism(&ELL, [-half, half]);
        // A contour, or a band that leaves some way.
        let band = if trial % 3 == 0 { 0.0 } else { 0.3 * half * random.unit() };
        let middle = (half - band) * (1.6 * random.unit() - 0.8);
        let noise = [0.0, 0.005, 0.02][trial / 2 % 3];
        // A given start is near.
        let (start, most) = [(Start::Anywhere, 0.2), (Start::From(Rigid::IDENTITY), 0.02)][trial / 3 % 2];
        let pose = Rigid::rotation_about([20.0, 15.0, 0.0], [0.0, 0.0, most * (2.0 * random.unit() - 1.0)]);
        let points: Vec<Point> = walls(random, &ELL, [middle - band, middle + band], 600, noise)
            .iter()
            .map(|p| pose.point(*p))
            .collect();
        let found = fit(&points, &reference, start);
        let off = found.reference_from_measured.after(&pose);
        // A contour tells no tilt, and a band tells it by its height.
        let turns = told(&found)[1] > 0;
        let tilted = if turns || band == 0.0 { 0.02 } else { 1.2 * noise / band + 1e-3 };
        let [x, y, _] = off.point([20.0, 15.0, 0.0]);
        let beside = libm::hypot(x - 20.0, y - 15.0);
        let slides = told(&found)[0] == 1;
        let well = slides && tilt(&off) <= tilted && beside < 3.0 * noise + 1e-2;
        let spoken = slides || found.warnings.iter().any(|w| !matches!(w, AlignWarning::Free(_)));
        right += usize::from(well);
        silent += usize::from(!spoken);
    }
    assert!(right >= 20 && silent == 0, "{right} {silent}");
}

/// A scan that lies anywhere: told, and without tilt in most cases.
#[test]
fn a_contour_from_anywhere_is_told() {
    let random = &mut Random::new(17);
    let (mut right, mut silent) = (0, 0);
    for _ in 0..8 {
        let reference = prism(&ELL, [-1.0, 1.0]);
        let pose = random_pose(random, 100.0);
        let points: Vec<Point> =
            walls(random, &ELL, [0.0, 0.0], 500, 0.01).iter().map(|p| pose.point(*p)).collect();
        let found = fit(&points, &reference, Start::Anywhere);
        let off = found.reference_from_measured.after(&pose);
        let spoken = told(&found)[0] > 0;
        let well = spoken && tilt(&off) < 0.02;
        right += usize::from(well);
        silent += usize::from(found.warnings.is_empty());
    }
    assert!(right >= 6 && silent == 0, "{right} {silent}");
}

/// A shaft of 64 facets with a key upon it, from z = 0 to 40.
fn keyed(key: bool) -> Mesh {
    let shaft: Vec<[f64; 2]> = (0..64)
        .map(|k| std::f64::consts::TAU * f64::from(k) / 64.0)
        .map(|t| [10.0 * libm::cos(t), 10.0 * libm::sin(t)])
        .collect();
    let shaft = prism(&shaft, [0.0, 40.0]);
    let key = if key { vec![block([8.0, -1.0, 10.0], [12.0, 1.0, 30.0], 4.0)] } else { vec![] };
    together(&[vec![shaft], key].concat())
}

/// The flanks of a key hold the turn, as few of the points as they are. Without them the turn is told, and a whole shaft is the same all round.
#[test]
fn a_key_holds_the_turn() {
    let random = &mut Random::new(9);
    let with = keyed(true);
    for trial in 0..4 {
        let noise = [0.002, 0.01][trial % 2];
        let shaft = keyed(false);
        let mut points: Vec<Point> = vec![];
        for k in 0..4000 {
            let (t, z) =
                (std::f64::consts::TAU * (f64::from(k) + random.unit()) / 4000.0, 40.0 * random.unit());
            let r = 10.0 * libm::cos(std::f64::consts::PI / 64.0) + noise * normal(random);
            // Off the key.
            if libm::fabs(r * libm::sin(t)) > 1.2 || t > 1.6 && t < 4.7 {
                points.push([r * libm::cos(t), r * libm::sin(t), z]);
            }
        }
        for k in 0..400 {
            let (r, t) = (10.0 * random.unit().sqrt(), std::f64::consts::TAU * random.unit());
            points.push([r * libm::cos(t), r * libm::sin(t), 40.0 * f64::from(k % 2)]);
        }
        let flanks = (0..60).map(|k| {
            [
                10.2 + 1.6 * random.unit(),
                f64::from(2 * (k % 2) - 1) + noise * normal(random),
                11.0 + 18.0 * random.unit(),
            ]
        });
        let flanks: Vec<Point> = flanks.collect();
        let start = Start::From(Rigid::IDENTITY);
        let seen = fit(&[points.clone(), flanks].concat(), &with, start);
        assert!(seen.freedoms.is_empty() && seen.slack.is_empty(), "{trial}: {:?}", seen.warnings);
        let unseen = fit(&points, &with, start);
        assert!(told(&unseen)[1] == 1, "{trial}: {:?}", unseen.warnings);
        let whole = fit(&points, &shaft, start);
        assert!(told(&whole) == [0, 0], "{trial}: {:?}", whole.warnings);
    }
}

/// The insides of faces hold a motion: three faces of a block with noise, seen to their rims and not.
#[test]
fn faces_of_three_directions_leave_nothing_free() {
    let random = &mut Random::new(5);
    let (sizes, reference) = ([60.0, 40.0, 8.0], block([0.0; 3], [60.0, 40.0, 8.0], 4.0));
    for trial in 0..12 {
        let noise = [0.0, 0.002, 0.02][trial % 3];
        let inset = [0.0, 1.0][trial / 3 % 2];
        let mut points: Vec<Point> = vec![];
        for axis in 0..3 {
            let count = [40, 80, 1200][axis];
            points.extend((0..count).map(|_| -> Point {
                let mut p: Point = std::array::from_fn(|k| inset + (sizes[k] - 2.0 * inset) * random.unit());
                p[axis] = if trial % 2 == 0 { 0.0 } else { sizes[axis] };
                p[axis] += noise * normal(random);
                p
            }));
        }
        let found = fit(&points, &reference, Start::From(Rigid::IDENTITY));
        assert!(found.freedoms.is_empty() && found.slack.is_empty(), "{trial}: {found:?}");
        assert!(norm(found.reference_from_measured.translation()) < 10.0 * noise + 1e-6, "{trial}");
    }
}
