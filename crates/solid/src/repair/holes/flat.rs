//! Sheets that lie in one plane: a patch of their border lies upon them, and encloses nothing.

use super::super::work::Work;
use super::ring::Ring;
use std::collections::BTreeMap;
use trueness_geom::check::Known;
use trueness_geom::space::{Vector, cross, dot, minus, norm, plus, times};

/// The normals of facets of a flat sheet agree. The length of their sum, each as long as the facet's area, is at least
/// this share of the area. Slivers may look anywhere.
const MIN_AGREEMENT: f64 = 0.999;

/// And no vertex is farther from the plane than this share of the root of the area: vertices that were parted lie off it.
const MAX_OFF_PLANE_SHARE: f64 = 1e-3;

/// The sum of the facets' normals, each as long as twice the facet's area, for each shell with a ring that lies in one
/// plane. Linear time.
pub(super) fn sheets(work: &Work, known: &Known, rings: &[Ring]) -> BTreeMap<u32, Vector> {
    let mut sums: BTreeMap<u32, (Vector, &Ring)> = rings.iter().map(|r| (r.shell, ([0.0; 3], r))).collect();
    let (faces, shell_of) = (&work.mesh().faces, &known.topology.shell_of);
    for (f, shell) in (0..faces.len() as u32).zip(shell_of) {
        if let Some((sum, _)) = sums.get_mut(shell) {
            let [a, b, c] = work.corners(f);
            *sum = plus(*sum, cross(minus(b, a), minus(c, a)));
        }
    }
    sums.retain(|_, (sum, ring)| norm(*sum) > 2.0 * MIN_AGREEMENT * ring.shell_area);
    for (face, shell) in faces.iter().zip(shell_of) {
        if let Some((sum, ring)) = sums.get(shell) {
            let (normal, on) = (times(1.0 / norm(*sum), *sum), work.at(ring.vertices[0]));
            let reach = work.gap.max(MAX_OFF_PLANE_SHARE * ring.shell_area.sqrt());
            let off = |v: &u32| dot(normal, minus(work.at(*v), on)).abs() > reach;
            if face.iter().any(off) {
                sums.remove(shell);
            }
        }
    }
    sums.into_iter().map(|(shell, (sum, _))| (shell, sum)).collect()
}

/// Whether the ring is the border of such a sheet: a patch would look the other way.
pub(super) fn is_border(work: &Work, ring: &Ring, sheets: &BTreeMap<u32, Vector>) -> bool {
    let Some(sheet) = sheets.get(&ring.shell) else { return false };
    let (n, from) = (ring.vertices.len(), work.at(ring.vertices[0]));
    let arm = |i: usize| minus(work.at(ring.vertices[i % n]), from);
    let patch = (1..n).fold([0.0; 3], |sum, i| plus(sum, cross(arm(i), arm(i + 1))));
    dot(patch, *sheet) < 0.0
}
