//! Making a patch as smooth as the surface that it joins.
//!
//! The umbrella vector of a vertex points from it to the mean of its neighbors. The new vertices are moved to where the
//! squares of the umbrella vectors have the least sum. All vertices of the patch count, the rim included. At the rim
//! the neighbors outside take part, so the patch starts in their direction. (Kobbelt, Campagna, Vorsatz and Seidel,
//! Interactive multi-resolution modeling on arbitrary meshes, 1998). A sparse linear least-squares problem, solved by
//! conjugate gradients in a fixed order.

use super::patch::{FIRST_NEW_VERTEX, Patch};
use super::ring::Ring;
use super::site::Site;
use std::collections::{BTreeMap, BTreeSet};
use trueness_geom::space::{Point, minus, plus, times};

/// Steps of the solver at most: stopping early leaves a patch that is less smooth.
const MAX_SOLVER_STEPS: usize = 500;
/// Where the squared residual has sunk to this share of the first one, the solver stops.
const FINAL_RESIDUAL_SHARE: f64 = 1e-20;

/// An umbrella vector: its part that is known, and the new vertices with their weights.
struct Umbrella {
    known: Point,
    of: Vec<(usize, f64)>,
}

/// Moves the new vertices of the patch.
pub(super) fn fair(site: &Site, ring: &Ring, patch: &mut Patch) {
    let mut around: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
    for f in &patch.facets {
        for k in 0..3 {
            around.entry(f[k]).or_default().extend([f[(k + 1) % 3], f[(k + 2) % 3]]);
        }
    }
    for &v in &ring.vertices {
        around.entry(v).or_default().extend(site.neighbors(v));
    }
    let umbrellas: Vec<Umbrella> = around.iter().map(|(v, near)| umbrella(site, *v, near)).collect();
    solve(&umbrellas, &mut patch.places);
    patch.places.iter_mut().for_each(|p| *p = site.work.rounded(*p));
}

fn umbrella(site: &Site, v: u32, near: &BTreeSet<u32>) -> Umbrella {
    let weight = 1.0 / near.len() as f64;
    let mut umbrella = Umbrella { known: [0.0; 3], of: vec![] };
    for (w, weight) in near.iter().map(|w| (*w, weight)).chain([(v, -1.0)]) {
        match w.checked_sub(FIRST_NEW_VERTEX) {
            Some(new) => umbrella.of.push((new as usize, weight)),
            None => umbrella.known = plus(umbrella.known, times(weight, site.work.at(w))),
        }
    }
    umbrella
}

/// The umbrella vectors with the new vertices at `x`, without their known parts.
fn apply(umbrellas: &[Umbrella], x: &[Point]) -> Vec<Point> {
    let one = |u: &Umbrella| u.of.iter().fold([0.0; 3], |s, (i, w)| plus(s, times(*w, x[*i])));
    umbrellas.iter().map(one).collect()
}

/// The transpose of [`apply`].
fn gather(umbrellas: &[Umbrella], y: &[Point], n: usize) -> Vec<Point> {
    let mut x = vec![[0.0; 3]; n];
    for (u, y) in umbrellas.iter().zip(y) {
        u.of.iter().for_each(|(i, w)| x[*i] = plus(x[*i], times(*w, *y)));
    }
    x
}

/// Conjugate gradients on the normal equations, for the three coordinates side by side.
fn solve(umbrellas: &[Umbrella], x: &mut [Point]) {
    let n = x.len();
    let product = |a: &[Point], b: &[Point]| -> Point {
        a.iter().zip(b).fold([0.0; 3], |s, (a, b)| std::array::from_fn(|k| s[k] + a[k] * b[k]))
    };
    let all: Vec<Point> = umbrellas.iter().zip(apply(umbrellas, x)).map(|(u, y)| plus(u.known, y)).collect();
    let mut residual: Vec<Point> = gather(umbrellas, &all, n).into_iter().map(|r| times(-1.0, r)).collect();
    let mut direction = residual.clone();
    let mut size = product(&residual, &residual);
    let enough = size.map(|s| s * FINAL_RESIDUAL_SHARE);
    for _ in 0..MAX_SOLVER_STEPS {
        if (0..3).all(|k| size[k] <= enough[k]) {
            break;
        }
        let image = apply(umbrellas, &direction);
        let bent = product(&image, &image);
        let step: Point = std::array::from_fn(|k| if bent[k] > 0.0 { size[k] / bent[k] } else { 0.0 });
        let back = gather(umbrellas, &image, n);
        for i in 0..n {
            x[i] = std::array::from_fn(|k| x[i][k] + step[k] * direction[i][k]);
            residual[i] = minus(residual[i], std::array::from_fn(|k| step[k] * back[i][k]));
        }
        let next = product(&residual, &residual);
        let keep: Point = std::array::from_fn(|k| if size[k] > 0.0 { next[k] / size[k] } else { 0.0 });
        for (d, r) in direction.iter_mut().zip(&residual) {
            *d = std::array::from_fn(|k| r[k] + keep[k] * d[k]);
        }
        size = next;
    }
}
