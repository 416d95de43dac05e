use super::*;
use trueness_geom::check::intersect::self_intersections;
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::samples::{add, block, inverted, on_threads};
use trueness_geom::topology::weld;

fn of(mesh: &Mesh) -> Result<Enclosed, NotEnclosed> {
    let mesh = weld::mesh(mesh).unwrap().mesh;
    let topology = Topology::of(&mesh).unwrap();
    let pairs = self_intersections(&mesh, &topology, &Silent).unwrap();
    enclosed(&mesh, &Known::of(&mesh, topology), Some(pairs), &Silent)
}

/// A box between two corners.
fn cuboid(low: [f64; 3], high: [f64; 3]) -> Mesh {
    let mut mesh = block(1, 1.0);
    mesh.positions.iter_mut().for_each(|p| *p = std::array::from_fn(|k| low[k] + p[k] * (high[k] - low[k])));
    mesh
}

/// Boxes with corners at whole numbers below `GRID`, some of them turned inside out. Also how many unit cells have
/// winding number 1 or more, and −1 or less.
const GRID: i32 = 5;

fn boxes(random: &mut Random, count: usize, turned: bool) -> (Mesh, f64, f64) {
    let (mut mesh, mut winding) = (Mesh::default(), vec![0i32; GRID.pow(3) as usize]);
    for _ in 0..count {
        let mut ends = || {
            let (a, b) = (random.below(GRID as u64) as i32, random.below(GRID as u64) as i32);
            if a == b { (0, GRID) } else { (a.min(b), a.max(b)) }
        };
        let sides = [ends(), ends(), ends()];
        let sense = if turned && random.below(3) == 0 { -1 } else { 1 };
        let body = cuboid(sides.map(|s| f64::from(s.0)), sides.map(|s| f64::from(s.1)));
        add(&mut mesh, &if sense < 0 { inverted(body) } else { body }, [0.0; 3]);
        for (i, w) in (0..).zip(&mut winding) {
            let cell = [i / (GRID * GRID), i / GRID % GRID, i % GRID];
            *w += if (0..3).all(|k| sides[k].0 <= cell[k] && cell[k] < sides[k].1) { sense } else { 0 };
        }
    }
    let count = |wanted: &dyn Fn(i32) -> bool| winding.iter().filter(|w| wanted(**w)).count() as f64;
    (mesh, count(&|w| w >= 1), count(&|w| w <= -1))
}

/// A turn and a shift, so that facets that lay in one plane do so only to rounding.
fn moved(mut mesh: Mesh, angle: f64) -> Mesh {
    let (sin, cos) = angle.sin_cos();
    mesh.positions.iter_mut().for_each(|p| {
        let [x, y, z] = *p;
        let (x, y) = (x * cos - y * sin, x * sin + y * cos);
        let (y, z) = (y * cos - z * sin, y * sin + z * cos);
        *p = [x + 3.0, y - 2.0, z + 7.0];
    });
    mesh
}

/// Brute force: boxes that share sides, edges and corners, lie in each other, are there twice, look inwards.
#[test]
fn boxes_on_a_grid_have_the_volume_of_their_cells() {
    let random = &mut Random::new(11);
    for round in 0..120 {
        let (mesh, volume, back) = boxes(random, 1 + round % 5, round % 2 == 1);
        let found = of(&mesh).unwrap();
        let off = (found.volume - volume).abs().max((found.inverted - back).abs());
        assert!(off < 1e-11 && found.error < 1e-10, "{round}: {found:?} {volume} {back}");
    }
}

/// The same, turned: sides that lay in one plane are a rounding apart, which decides whether facets cross. The stated
/// error covers the effect. Most heaps have some sides that lie so.
#[test]
fn turned_boxes_have_it_within_the_error_stated() {
    let random = &mut Random::new(12);
    let mut good = 0;
    for round in 0..60 {
        let (mesh, volume, _) = boxes(random, 1 + round % 4, false);
        let found = of(&moved(mesh, 0.1 + round as f64)).unwrap();
        let off = (found.volume - volume).abs();
        assert!(off <= found.error + 1e-11, "{round}: {} {volume} ± {}", found.volume, found.error);
        good += usize::from(off < 1e-10);
    }
    assert!(good > 20, "{good} of 60");
}

/// A box around all looks inwards. Then the places wound around are those in both bodies, and those around the other
/// way are in neither.
#[test]
fn union_and_intersection_add_up() {
    let random = &mut Random::new(13);
    for round in 0..30 {
        let mut two = moved(block(1 + round % 4, 2.0), random.unit());
        let shift = std::array::from_fn(|_| 2.0 * random.unit() - 1.0);
        add(&mut two, &moved(block(3, 2.0), 2.0 + random.unit()), shift);
        let mut held = two.clone();
        add(&mut held, &inverted(block(2, 100.0)), [-50.0; 3]);
        let (union, other) = (of(&two).unwrap(), of(&held).unwrap());
        assert!((union.volume + other.volume - 16.0).abs() < 1e-8, "{round}: {union:?} {other:?}");
        assert!((union.volume + other.inverted - 1e6).abs() < 1e-8, "{round}: {union:?} {other:?}");
        assert!(union.error < 1e-10 && union.volume <= 16.0 + 1e-12 && union.volume >= 8.0 - 1e-12);
    }
}

#[test]
fn what_encloses_nothing_says_why() {
    let mut open = block(2, 1.0);
    open.faces.pop();
    assert_eq!(of(&open), Err(NotEnclosed::Open));
    assert_eq!(of(&Mesh::default()), Err(NotEnclosed::Open));
    let mut turned = block(2, 1.0);
    turned.faces[3].swap(0, 1);
    assert_eq!(of(&turned), Err(NotEnclosed::Inconsistent));
    let mut heap = Mesh::default();
    (0..100).for_each(|_| add(&mut heap, &block(1, 1.0), [0.0; 3]));
    assert_eq!(of(&heap), Err(NotEnclosed::Tangle));
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let mut mesh = moved(block(4, 2.0), 0.3);
    add(&mut mesh, &moved(block(4, 2.0), 1.1), [0.3; 3]);
    assert_eq!(on_threads(1, || of(&mesh)), on_threads(3, || of(&mesh)));
}

/// An octahedron between two corners.
fn octahedron(low: Point, high: Point) -> Mesh {
    let middle = times(0.5, plus(low, high));
    let tip = |k: usize| {
        let mut p = middle;
        p[k % 3] = if k < 3 { low[k % 3] } else { high[k % 3] };
        p
    };
    let faces =
        [[3, 4, 5], [4, 0, 5], [0, 1, 5], [1, 3, 5], [4, 3, 2], [0, 4, 2], [1, 0, 2], [3, 1, 2]].to_vec();
    Mesh { positions: (0..6).map(tip).collect(), faces }
}

/// A tip touches a side of a box, from inside or from outside, at places of a grid. It does so in the middle of the
/// part that is asked about too, where a ray meets both at once.
#[test]
fn what_touches_a_side_counts_where_it_lies() {
    let block = cuboid([-2.0; 3], [2.0; 3]);
    for (axis, side) in [(0, -2.0), (0, 2.0), (1, -2.0), (1, 2.0), (2, -2.0), (2, 2.0)] {
        for (i, j) in (0..25).map(|k| (k / 5 - 2, k % 5 - 2)) {
            for way in [-1.0, 1.0] {
                let (mut low, mut high) = ([0.0; 3], [0.0; 3]);
                (low[axis], high[axis]) = if way < 0.0 { (side - 1.0, side) } else { (side, side + 1.0) };
                for (k, at, reach) in [(1, 0.5 * f64::from(i), 0.5), (2, 0.5 * f64::from(j), 0.25)] {
                    let k = (axis + k) % 3;
                    (low[k], high[k]) = (at - reach, at + reach);
                }
                let mut mesh = block.clone();
                add(&mut mesh, &octahedron(low, high), [0.0; 3]);
                let found = of(&mesh).unwrap();
                let [x, y, z] = minus(high, low);
                let outside = if way * side > 0.0 { x * y * z / 6.0 } else { 0.0 };
                assert!(
                    (found.volume - 64.0 - outside).abs() < 1e-12,
                    "{axis} {side} {i} {j} {way}: {found:?}"
                );
                assert!(found.error < 1e-10);
            }
        }
    }
}

/// The corners of the union of two boxes are corners of pieces or of whole facets, and none lies within a box.
#[test]
fn pieces_reach_to_the_corners_of_what_bounds() {
    let mut mesh = cuboid([0.0; 3], [2.0; 3]);
    add(&mut mesh, &cuboid([0.0; 3], [2.0; 3]), [1.25, 0.75, 0.5]);
    let found = of(&mesh).unwrap();
    let mut corners: Vec<Point> = found.pieces.iter().flat_map(|p| p.corners).collect();
    let whole = mesh.faces.iter().zip(&found.bounds).filter(|(_, bounds)| **bounds);
    corners.extend(whole.flat_map(|(face, _)| mesh.places(face)));
    let within = |p: &Point, low: f64, shift: Vector| {
        (0..3).all(|k| low < p[k] - shift[k] && p[k] - shift[k] < 2.0 - low)
    };
    let shifts = [[0.0; 3], [1.25, 0.75, 0.5]];
    for p in &corners {
        assert!(shifts.iter().all(|shift| !within(p, 1e-12, *shift)), "{p:?}");
    }
    for shift in shifts {
        for corner in (0..8).map(|k| plus(shift, [0, 1, 2].map(|i| f64::from(k >> i & 1) * 2.0))) {
            let buried = shifts.iter().any(|shift| within(&corner, 0.0, *shift));
            let found = corners.iter().any(|p| norm(minus(*p, corner)) < 1e-12);
            assert!(found != buried, "{corner:?}");
        }
    }
}
