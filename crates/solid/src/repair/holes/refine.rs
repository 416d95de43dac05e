//! Patches as fine and as smooth as their surroundings (Liepa, Filling holes in meshes, 2003).
//!
//! Facets of the patch of least area are divided at their middle as long as they are coarse beside the edges around.
//! Edges are flipped where that makes the triangles more compact. Then the patch is faired. A hole in a plane, or with
//! a sharp rim (the open end of a pipe), is better filled as it is.

use super::fair;
use super::minimal::{self, Aim};
use super::patch::{FIRST_NEW_VERTEX, Patch};
use super::ring::Ring;
use super::site::Site;
use std::collections::{BTreeMap, BTreeSet};
use trueness_geom::num::predicates;
use trueness_geom::space::{self, Point, Vector, cross, dot, minus, norm, plus, times};

/// New vertices of a patch at most; a patch that would need more is filled plainly.
const MAX_NEW_VERTICES: usize = 1000;
/// How often facets are divided.
const MAX_DIVISIONS: usize = 8;
/// How often edges are flipped after each division.
const FLIPS_PER_DIVISION: usize = 4;

/// The patch; `None` where a plain one will do.
pub(super) fn patch(site: &Site, ring: &Ring) -> Option<Patch> {
    let mut patch = minimal::patch(site, ring, Aim::Area)?;
    if !is_smooth(site, ring, &patch) {
        return None;
    }
    let mut scale: BTreeMap<u32, f64> = ring.vertices.iter().map(|&v| (v, mean_edge(site, v))).collect();
    for _ in 0..MAX_DIVISIONS {
        if !divide(site, &mut patch, &mut scale) {
            break;
        }
        if patch.places.len() > MAX_NEW_VERTICES {
            return None;
        }
        for _ in 0..FLIPS_PER_DIVISION {
            if !flip(site, &mut patch) {
                break;
            }
        }
    }
    if patch.places.is_empty() {
        return None;
    }
    fair::fair(site, ring, &mut patch);
    Some(patch)
}

fn normal(corners: [Point; 3]) -> Vector {
    space::normal(corners).unwrap_or([0.0; 3])
}

/// Whether the surroundings run on smoothly into the patch, and are not simply flat.
fn is_smooth(site: &Site, ring: &Ring, patch: &Patch) -> bool {
    /// Cosine of the largest bend at the rim that is smooth: 60°.
    const MIN_SMOOTH_COSINE: f64 = 0.5;
    /// Cosine of the largest bend that is still flat: 0.5°.
    const MIN_FLAT_COSINE: f64 = 0.99996;
    let n = ring.vertices.len();
    let mut inside = BTreeMap::new();
    for f in &patch.facets {
        let normal = normal(f.map(|v| patch.at(site.work, v)));
        inside.extend((0..3).map(|k| ([f[k], f[(k + 1) % 3]], normal)));
    }
    let outside = |i: usize| normal(site.work.corners(ring.facets[i]));
    let bend = |i: usize| {
        let own = inside.get(&[ring.vertices[i], ring.vertices[(i + 1) % n]]).copied().unwrap_or_default();
        dot(own, outside(i))
    };
    let bends: Vec<f64> = (0..n).map(bend).collect();
    bends.iter().all(|b| *b > MIN_SMOOTH_COSINE) && bends.iter().any(|b| *b < MIN_FLAT_COSINE)
}

/// Mean length of the edges at a vertex of the mesh.
fn mean_edge(site: &Site, v: u32) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for w in site.neighbors(v) {
        sum += norm(minus(site.work.at(w), site.work.at(v)));
        count += 1.0;
    }
    sum / count
}

/// Divides the facets that are coarse. True if there were any.
fn divide(site: &Site, patch: &mut Patch, scale: &mut BTreeMap<u32, f64>) -> bool {
    let (mut facets, before) = (vec![], patch.places.len());
    for f in std::mem::take(&mut patch.facets) {
        let corners = f.map(|v| patch.at(site.work, v));
        let middle = times(1.0 / 3.0, corners.into_iter().fold([0.0; 3], plus));
        let scales = f.map(|v| scale.get(&v).copied().unwrap_or(f64::INFINITY));
        let own = (scales[0] + scales[1] + scales[2]) / 3.0;
        let coarse = corners.iter().zip(scales).all(|(p, s)| {
            let reach = std::f64::consts::SQRT_2 * norm(minus(middle, *p));
            reach > own && reach > s
        });
        if coarse && patch.places.len() <= MAX_NEW_VERTICES {
            let new = FIRST_NEW_VERTEX + patch.places.len() as u32;
            patch.places.push(middle);
            scale.insert(new, own);
            let [a, b, c] = f;
            facets.extend([[a, b, new], [b, c, new], [c, a, new]]);
        } else {
            facets.push(f);
        }
    }
    patch.facets = facets;
    patch.places.len() > before
}

/// Flips edges inside the patch where the angles opposite to them sum up to more than two right angles. True if any was.
fn flip(site: &Site, patch: &mut Patch) -> bool {
    let mut sides: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (i, f) in patch.facets.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (f[k], f[(k + 1) % 3]);
            sides.entry([a.min(b), a.max(b)]).or_default().push(i);
        }
    }
    let mut touched = vec![false; patch.facets.len()];
    let mut made: BTreeSet<[u32; 2]> = BTreeSet::new();
    for (&[a, b], at) in &sides {
        let [i, j] = at[..] else { continue };
        if touched[i] || touched[j] {
            continue;
        }
        // From a to b along the first facet; c and d are opposite.
        let runs = |f: [u32; 3]| (0..3).any(|k| f[k] == a && f[(k + 1) % 3] == b);
        let (i, j) = if runs(patch.facets[i]) { (i, j) } else { (j, i) };
        let other = |f: [u32; 3]| f.into_iter().find(|v| *v != a && *v != b);
        let (Some(c), Some(d)) = (other(patch.facets[i]), other(patch.facets[j])) else { continue };
        let edge = [c.min(d), c.max(d)];
        let exists = sides.contains_key(&edge)
            || made.contains(&edge)
            || (edge[1] < FIRST_NEW_VERTEX && site.has_edge(c, d));
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| patch.at(site.work, v));
        let new = [[a, d, c], [d, b, c]];
        let fine = |f: &[u32; 3]| !predicates::is_flat(f.map(|v| patch.at(site.work, v)).each_ref());
        if c != d
            && !exists
            && angle(pc, pa, pb) + angle(pd, pa, pb) > std::f64::consts::PI + 1e-9
            && new.iter().all(fine)
        {
            [patch.facets[i], patch.facets[j]] = new;
            [touched[i], touched[j]] = [true; 2];
            made.insert(edge);
        }
    }
    !made.is_empty()
}

/// Angle at `p` between the directions to `a` and `b`.
fn angle(p: Point, a: Point, b: Point) -> f64 {
    let (u, v) = (minus(a, p), minus(b, p));
    libm::atan2(norm(cross(u, v)), dot(u, v))
}
