//! The pieces of facets: they tile each facet, exactly, and meet in whole edges only.

use super::*;
use crate::arrange::cut::Piece;
use crate::arrange::cutting::cutting;
use crate::arrange::points::ExactPoint;
use num_bigint::BigInt;

/// Random triangles with corners in whole numbers.
fn soup(random: &mut Random, facets: usize, size: u64) -> Mesh {
    let mut mesh = Mesh::default();
    for _ in 0..facets {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([(); 3].map(|()| [(); 3].map(|()| whole(random, size))));
        mesh.faces.push([first, first + 1, first + 2]);
    }
    as_it_is(&mesh).unwrap()
}

/// Coordinates of a place as fractions of whole numbers: numerators and the common denominator. Walking down the
/// continued fraction of its bounds would need care. A place of the arrangement of whole numbers below 2^5 has a small
/// denominator, and is found by trying them all.
fn fraction(place: &ExactPoint) -> [BigInt; 4] {
    let p = place.nearest();
    let fits = |w: &i64| {
        p.iter().all(|x| {
            let scaled = x * *w as f64;
            (scaled - scaled.round()).abs() <= 4.0 * f64::EPSILON * scaled.abs().max(1.0)
        })
    };
    let w = (1..200_000).find(fits).unwrap();
    let [x, y, z] = p.map(|x| BigInt::from((x * w as f64).round() as i64));
    [x, y, z, BigInt::from(w)]
}

/// Twice the area of a triangle seen along an axis, as a fraction.
fn area(axis: usize, corners: [[BigInt; 4]; 3]) -> (BigInt, BigInt) {
    let (x, y) = ((axis + 1) % 3, (axis + 2) % 3);
    let [a, b, c] = &corners;
    let d = &a[x] * (&b[y] * &c[3] - &c[y] * &b[3]) - &a[y] * (&b[x] * &c[3] - &c[x] * &b[3])
        + &a[3] * (&b[x] * &c[y] - &c[x] * &b[y]);
    (d, &a[3] * &b[3] * &c[3])
}

/// Areas add up, all pieces run the way of their facet, and no two pieces meet but in common corners and edges. That is
/// checked pair by pair on the places themselves, which small whole numbers make fractions that brute force can find.
#[test]
fn pieces_tile_their_facets() {
    let random = &mut Random::new(7);
    let mut count = 0;
    for round in 0..60 {
        let mesh = soup(random, 2 + round % 5, [3, 4, 6][round % 3]);
        let topology = Topology::of(&mesh).unwrap();
        let pairs = intersect::self_intersections(&mesh, &topology, &Silent).unwrap();
        let cutting = cutting(&mesh, &topology, &pairs, &Silent).unwrap();
        let places: Vec<[BigInt; 4]> =
            (0..cutting.points.len() as u32).map(|p| fraction(&cutting.points.at(p))).collect();
        let mut of_facet: Vec<Vec<[u32; 3]>> = vec![vec![]; mesh.faces.len()];
        for Piece { corners, facet, .. } in &cutting.pieces {
            of_facet[*facet as usize].push(*corners);
        }
        for (p, facet, same) in &cutting.further {
            let [a, b, c] = cutting.pieces[*p].corners;
            of_facet[*facet as usize].push(if *same { [a, b, c] } else { [a, c, b] });
        }
        for (face, pieces) in mesh.faces.iter().zip(&of_facet) {
            let at = mesh.places(face);
            let Some(axis) = trueness_geom::num::predicates::axis(&at) else {
                assert!(pieces.is_empty());
                continue;
            };
            let of = |c: [u32; 3]| area(axis, c.map(|p| places[p as usize].clone()));
            let (whole, _) = of(*face);
            let (mut n, mut d) = (BigInt::from(0), BigInt::from(1));
            for piece in pieces {
                let (m, e) = of(*piece);
                assert_eq!(m.sign(), whole.sign(), "{round}: a piece is flat or runs the other way");
                (n, d) = (n * &e + m * &d, d * e);
            }
            assert_eq!(n, whole * d, "{round}: the pieces do not make up the facet");
            count += pieces.len();
        }
        // In the mesh of the pieces, as far as numbers can hold it, nothing is left to cut.
        let mut cut = arrange(&mesh, &Silent).unwrap().mesh;
        cut.faces.sort_unstable();
        cut.positions.iter_mut().flatten().for_each(|x| *x *= 27720.0);
        let exact = cut.positions.iter().flatten().all(|x| (x - x.round()).abs() < 1e-9);
        if exact {
            cut.positions.iter_mut().flatten().for_each(|x| *x = x.round());
            let topology = Topology::of(&cut).unwrap();
            let left = intersect::self_intersections(&cut, &topology, &Silent).unwrap();
            assert_eq!(left, Vec::<[u32; 2]>::new(), "{round}");
        }
    }
    assert!(count > 400, "{count}");
}

#[test]
fn the_same_pieces_on_any_number_of_threads() {
    let random = &mut Random::new(8);
    let mesh = soup(random, 60, 1 << 12);
    let on = |threads| trueness_geom::samples::on_threads(threads, || arrange(&mesh, &Silent).unwrap());
    assert_eq!(on(1), on(3));
}
