//! Vertices that very many long facets end near: a hub that is not one vertex.
//!
//! Needles whose tips lie a hair apart, at other vertices each, have boxes that all overlap, as those of facets at one vertex have.
//! They are seen from one place among the tips in directions of their own, and are searched by these as a [`Hub`] is.

use super::hub::Hub;
use crate::mesh::Mesh;
use crate::num::cholesky::Cholesky;
use crate::space::{Point, Vector, dot, minus, norm, plus, times, unit};

/// Sides of the cells in which tips are gathered, as shares of the diagonal, the largest first.
const CELL_SHARES: [f64; 3] = [1.0 / (1 << 9) as f64, 1.0 / (1 << 14) as f64, 1.0 / (1 << 19) as f64];
/// Least length of both edges at a tip, in sides of a cell.
const MIN_EDGE_CELLS: f64 = 8.0;
/// Facets in a cell from which on it pays not to compare each with each.
const MIN_CROWD_FACETS: usize = 200;

/// The crowds among the facets that are `free`, and takes these. Cost: n log n.
pub(super) fn crowds(mesh: &Mesh, free: &mut [bool]) -> Vec<Hub> {
    let bounds = mesh.finite_bounds();
    let mut found = vec![];
    for side in CELL_SHARES.map(|share| share * bounds.diagonal()) {
        let mut tips = tips(mesh, free, bounds.min, side);
        tips.sort_unstable();
        let mut cells: Vec<&[([i64; 3], u32, usize)]> = tips.chunk_by(|a, b| a.0 == b.0).collect();
        cells.retain(|cell| cell.len() > MIN_CROWD_FACETS);
        cells.sort_by(|a, b| b.len().cmp(&a.len()).then(a[0].cmp(&b[0])));
        for cell in cells {
            let claimed = cell.iter().filter(|(_, f, _)| std::mem::take(&mut free[*f as usize]));
            let (facets, corners): (Vec<u32>, Vec<usize>) = claimed.map(|(_, f, k)| (*f, *k)).unzip();
            if !facets.is_empty() {
                found.push(Hub::crowd(mesh, middle(mesh, &facets, &corners), &facets));
            }
        }
    }
    found
}

/// Corners between two long edges, with the cell that they lie in.
fn tips(mesh: &Mesh, free: &[bool], from: Point, side: f64) -> Vec<([i64; 3], u32, usize)> {
    let mut tips = vec![];
    for (f, _) in (0u32..).zip(free).filter(|(_, free)| **free) {
        let corners = mesh.corners(f);
        let far = |a: usize, b: usize| norm(minus(corners[a], corners[b])) > MIN_EDGE_CELLS * side;
        let long = [far(0, 1), far(1, 2), far(2, 0)];
        for k in (0..3).filter(|k| long[*k] && long[(k + 2) % 3]) {
            tips.push((std::array::from_fn(|i| ((corners[k][i] - from[i]) / side) as i64), f, k));
        }
    }
    tips
}

/// The place that the facets point at with these corners: nearest, by least squares, to the lines through their middles.
///
/// Any place gives the right pairs. From one that is off by more than the tips are apart, facets are seen in wide boxes.
fn middle(mesh: &Mesh, facets: &[u32], corners: &[usize]) -> Point {
    /// Weight of the mean of the tips: it tells only where the lines leave a direction open.
    const MEAN_TIP_WEIGHT: f64 = 1e-9;
    let n = facets.len() as f64;
    let tip = |(f, k): (&u32, &usize)| mesh.corners(*f)[*k];
    let all = || facets.iter().zip(corners);
    let mean = times(1.0 / n, all().map(tip).fold([0.0; 3], plus));
    let mut matrix = vec![0.0; 9];
    let mut right: Vector = [0.0; 3];
    (0..3).for_each(|i| matrix[4 * i] = MEAN_TIP_WEIGHT * n);
    for (f, k) in all() {
        let c = mesh.corners(*f);
        let to = times(0.5, plus(c[(k + 1) % 3], c[(k + 2) % 3]));
        let Some((along, _)) = unit(minus(to, c[*k])) else { continue };
        let off = minus(c[*k], mean);
        let across = minus(off, times(dot(off, along), along));
        for i in 0..3 {
            right[i] += across[i];
            for j in 0..3 {
                matrix[3 * i + j] += f64::from(u8::from(i == j)) - along[i] * along[j];
            }
        }
    }
    match Cholesky::new(matrix, 3) {
        Some(factor) => {
            factor.solve(&mut right);
            plus(mean, right)
        }
        None => mean,
    }
}
