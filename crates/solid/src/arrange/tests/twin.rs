//! The volume of a union in whole numbers: tetrahedra cut by the planes of others, and inclusion and exclusion.

use super::*;
use num_bigint::{BigInt, Sign};

/// Homogeneous coordinates; the last is positive.
type Corner = [BigInt; 4];
type Tetrahedron = [Corner; 4];

/// Bits behind the point.
const DIGITS: usize = 256;

fn corner(p: &Point) -> Corner {
    let [x, y, z] = p.map(|x| BigInt::from(x as i64));
    [x, y, z, BigInt::from(1)]
}

fn determinant(m: [[&BigInt; 3]; 3]) -> BigInt {
    let [[a, b, c], [d, e, f], [g, h, i]] = m;
    a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
}

/// The determinant of four rows, by its last column.
fn determinant4(t: [&Corner; 4]) -> BigInt {
    (0..4).fold(BigInt::from(0), |sum, i| {
        let rows: Vec<&Corner> = (0..4).filter(|j| *j != i).map(|j| t[j]).collect();
        let minor = determinant([0, 1, 2].map(|r| [&rows[r][0], &rows[r][1], &rows[r][2]]));
        let term = minor * &t[i][3];
        if i % 2 == 1 { sum + term } else { sum - term }
    })
}

/// Six times the volume, as a whole number of steps of 2^-DIGITS.
fn six_volumes(parts: &[Tetrahedron]) -> BigInt {
    parts.iter().fold(BigInt::from(0), |sum, t| {
        let d = determinant4([&t[0], &t[1], &t[2], &t[3]]);
        let d = if d.sign() == Sign::Minus { -d } else { d };
        sum + (d << DIGITS) / t.iter().fold(BigInt::from(1), |w, c| w * &c[3])
    })
}

/// The parts of the tetrahedra where `inside` is not negative.
fn clipped(parts: Vec<Tetrahedron>, inside: impl Fn(&Corner) -> BigInt) -> Vec<Tetrahedron> {
    let mut out = vec![];
    for t in parts {
        let value = t.each_ref().map(&inside);
        let (ins, outs): (Vec<usize>, Vec<usize>) = (0..4).partition(|&i| value[i].sign() != Sign::Minus);
        let at = |i: usize| t[i].clone();
        // Where the edge from an inner corner to an outer one passes the plane.
        let cut = |i: usize, o: usize| -> Corner {
            std::array::from_fn(|k| &t[o][k] * &value[i] - &t[i][k] * &value[o])
        };
        match (&ins[..], &outs[..]) {
            ([], _) => {}
            (_, []) => out.push(t.clone()),
            (&[a], &[p, q, r]) => out.push([at(a), cut(a, p), cut(a, q), cut(a, r)]),
            (&[a, b], &[p, q]) => {
                // A wedge between the triangles a, ap, aq and b, bp, bq.
                let (s, t) = ([at(a), cut(a, p), cut(a, q)], [at(b), cut(b, p), cut(b, q)]);
                out.extend(prism(s, t));
            }
            (&[a, b, c], &[p]) => out.extend(prism([at(a), at(b), at(c)], [cut(a, p), cut(b, p), cut(c, p)])),
            _ => unreachable!(),
        }
    }
    out
}

fn prism([a, b, c]: [Corner; 3], [d, e, f]: [Corner; 3]) -> [Tetrahedron; 3] {
    [[a, b.clone(), c.clone(), d.clone()], [b, c.clone(), d.clone(), e.clone()], [c, d, e, f]]
}

/// The common part of tetrahedra.
fn common(bodies: &[[Point; 4]]) -> BigInt {
    let mut parts = vec![bodies[0].each_ref().map(corner)];
    for body in &bodies[1..] {
        let c = body.each_ref().map(corner);
        for k in 0..4 {
            let [p, q, r] = [1, 2, 3].map(|i| &c[(k + i) % 4]);
            let side = |x: &Corner| determinant4([p, q, r, x]);
            let own = side(&c[k]);
            parts = clipped(parts, |x| if own.sign() == Sign::Minus { -side(x) } else { side(x) });
        }
    }
    six_volumes(&parts)
}

/// Volume of the union of tetrahedra with corners in whole numbers, to some 70 digits, rounded.
pub(super) fn union_volume(bodies: &[[Point; 4]]) -> f64 {
    let mut sum = BigInt::from(0);
    for subset in 1u32..1 << bodies.len() {
        let chosen: Vec<[Point; 4]> =
            (0..bodies.len()).filter(|i| subset >> i & 1 == 1).map(|i| bodies[i]).collect();
        let part = common(&chosen);
        sum += if subset.count_ones() % 2 == 1 { part } else { -part };
    }
    let scaled: BigInt = sum >> (DIGITS - 80);
    scaled.to_string().parse::<f64>().unwrap() / 2f64.powi(80) / 6.0
}

/// Tetrahedra with corners on a small grid share planes, edges and vertices in every way; on a large one they cross at
/// general places.
#[test]
fn unions_of_tetrahedra_have_the_volume_of_inclusion_and_exclusion() {
    let random = &mut Random::new(1);
    let (mut cut, mut tried) = (0, 0);
    for round in 0..600 {
        let size = [3, 4, 6, 20, 1 << 20][round % 5];
        let bodies: Vec<[Point; 4]> = (0..2 + round / 5 % 3)
            .map(|_| [(); 4].map(|()| [(); 3].map(|()| whole(random, size))))
            .filter(|t| !trueness_geom::num::predicates::is_flat([&t[0], &t[1], &t[2]]))
            .filter(|t| trueness_geom::num::predicates::side_of_plane(&t[0], &t[1], &t[2], &t[3]) != 0)
            .collect();
        if bodies.is_empty() {
            continue;
        }
        let mut mesh = Mesh::default();
        bodies.iter().for_each(|t| add_tetrahedron(&mut mesh, *t));
        let expected = union_volume(&bodies);
        for single in [false, true] {
            let b = union(&mesh, &Options { single, ..Options::default() });
            let found = volume(&b.mesh);
            let limit = if single { 1e-6 } else { 1e-12 };
            assert!(
                (found - expected).abs() <= limit * expected,
                "{round}: {found}, not {expected}: {bodies:?}"
            );
            cut += usize::from(b.mesh.positions.len() > mesh.positions.len());
            tried += 1;
        }
    }
    assert!(tried > 900 && cut > 400, "{tried} {cut}");
}
