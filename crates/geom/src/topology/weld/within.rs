//! Weld with a tolerance: vertices nearer to each other than a distance become one.

use super::error::WeldError;
use super::exact::{Welded, check_corners, mesh as weld_equal, renumbered};
use crate::mesh::Mesh;
use crate::space::{Point, minus, norm};
use crate::topology::union::Sets;
use std::cmp::Ordering;

/// A vertex and the cell that it lies in.
type Placed = ([f64; 3], u32);

/// Makes one vertex of all vertices that lie within `distance` of one another, directly or through others, and drops those
/// that no face uses. It stands where the first of them stood: no place is invented.
///
/// `distance` is in millimeters; 0 joins equal positions only, and so does one that is not above 0. Vertices that are not
/// finite stay as they are. Facets whose corners have become one stay as well, as faces with a repeated vertex. Vertices are
/// numbered by first appearance in the faces. Cost: n log n, unless very many vertices crowd at two places which lie just
/// farther apart than `distance`.
///
/// # Errors
/// The errors of [`mesh`](super::mesh).
pub fn within(mesh: &Mesh, distance: f64) -> Result<Welded, WeldError> {
    check_corners(mesh)?;
    if !(distance > 0.0 && distance.is_finite()) {
        return weld_equal(mesh);
    }
    // The diagonal of a cell is `distance`: all that lie in one are near.
    let side = distance / 3f64.sqrt();
    let mut placed: Vec<Placed> = (0..)
        .zip(&mesh.positions)
        .filter(|(_, p)| p.iter().all(|x| x.is_finite()))
        .map(|(v, p)| (p.map(|x| (x / side).floor() + 0.0), v))
        .collect();
    placed.sort_unstable_by(|a, b| order(&a.0, &b.0).then(a.1.cmp(&b.1)));
    let cells: Vec<&[Placed]> = placed.chunk_by(|a, b| a.0 == b.0).collect();
    let sets = Sets::new(mesh.positions.len());
    let near =
        |a: u32, b: u32| norm(minus(mesh.positions[a as usize], mesh.positions[b as usize])) <= distance;
    for (i, cell) in cells.iter().enumerate() {
        // Where a cell is smaller than the steps between numbers, rounding may have brought strangers together.
        cell[1..].iter().filter(|p| near(cell[0].1, p.1)).for_each(|p| sets.join(cell[0].1, p.1));
        for around in OFFSETS {
            let wanted: Point = std::array::from_fn(|k| cell[0].0[k] + around[k]);
            let Ok(j) = cells[i + 1..].binary_search_by(|c| order(&c[0].0, &wanted)) else { continue };
            let other = cells[i + 1 + j];
            if sets.root(cell[0].1) != sets.root(other[0].1)
                && let Some((a, b)) =
                    cell.iter().flat_map(|a| other.iter().map(move |b| (a.1, b.1))).find(|&(a, b)| near(a, b))
            {
                sets.join(a, b);
            }
        }
    }
    Ok(renumbered(mesh, |v| sets.root(v)))
}

fn order(a: &Point, b: &Point) -> Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
}

/// From a cell to the later ones that hold anything within `distance` of it.
const OFFSETS: [[f64; 3]; 62] = {
    let mut offsets = [[0.0; 3]; 62];
    let mut i = 0;
    while i < 62 {
        let n = i + 63; // 62 is the cell itself
        offsets[i] = [(n / 25) as f64 - 2.0, (n / 5 % 5) as f64 - 2.0, (n % 5) as f64 - 2.0];
        i += 1;
    }
    offsets
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    /// By looking at all pairs.
    fn plain(mesh: &Mesh, distance: f64) -> Welded {
        let sets = Sets::new(mesh.positions.len());
        for (i, p) in mesh.positions.iter().enumerate() {
            for (j, q) in mesh.positions[..i].iter().enumerate() {
                if norm(minus(*p, *q)) <= distance {
                    sets.join(i as u32, j as u32);
                }
            }
        }
        renumbered(mesh, |v| sets.root(v))
    }

    #[test]
    fn joins_what_a_look_at_all_pairs_joins() {
        let random = &mut Random::new(9);
        for (side, distance) in
            [(3.0, 0.2), (10.0, 0.2), (1.0, 5.0), (1e6, 1.0), (1e-3, 1e-5), (4.0, 1e-18), (4.0, 0.0)]
        {
            for whole in [false, true] {
                let mut positions: Vec<Point> =
                    (0..400)
                        .map(|_| std::array::from_fn(|_| side * (random.unit() - 0.5)))
                        .map(|p: Point| {
                            if whole {
                                p.map(|x| (x / f64::max(distance, 0.01)).round() * distance)
                            } else {
                                p
                            }
                        })
                        .collect();
                positions[7] = positions[90];
                let mut corner = || random.below(400) as u32;
                let faces = (0..300).map(|_| [corner(), corner(), corner()]).collect();
                let mesh = Mesh { positions, faces };
                assert_eq!(within(&mesh, distance).unwrap(), plain(&mesh, distance), "{side} {distance}");
            }
        }
    }

    #[test]
    fn a_chain_becomes_one_and_what_is_not_finite_stays() {
        let mut positions: Vec<Point> = (0..9).map(|i| [0.9 * i as f64, 0.0, 0.0]).collect();
        positions.extend([[f64::NAN, 0.0, 0.0], [f64::INFINITY; 3]]);
        let mesh = Mesh { positions, faces: vec![[8, 4, 0], [9, 10, 1]] };
        let welded = within(&mesh, 1.0).unwrap();
        assert_eq!(welded.mesh.faces, [[0, 0, 0], [1, 2, 0]]);
        assert_eq!(welded.mesh.positions[0], [0.0; 3]);
        assert_eq!(within(&mesh, 0.8).unwrap().mesh.faces, [[0, 1, 2], [3, 4, 5]]);
    }
}
