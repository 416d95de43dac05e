//! Which facets of a mesh each of many planes may cut.
//!
//! Most planes of a stack meet few facets. The heights of all vertices over planes of one normal are computed once, then each
//! facet goes to the planes between its lowest and its highest vertex. Heights are rounded, so they only exclude, beyond an error
//! bound; what is above and below is decided exactly where the plane cuts.

use super::cut::Plane;
use crate::mesh::Mesh;
use crate::progress::{Cancelled, Progress};

/// Planes that are best given at a time: enough to pay for the heights, few enough for the memory of their lists.
pub const AT_ONCE: usize = 64;
/// Facets after which it is asked whether to stop.
const ASKED: usize = 65536;

/// For each plane the numbers of the facets that it may cut, in ascending order: all that it does cut, and few more.
///
/// Facets that name no vertex are in no list; of coordinates that are no numbers nothing is promised but that they are none of a
/// cut. Cost: for each normal one pass over vertices and facets, then as many steps as the lists are long.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
///
/// ```
/// use trueness_geom::{mesh::Mesh, progress::Silent, section::{facets_near, Plane}};
/// let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let mesh = Mesh { positions, faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] };
/// let planes = [0.5, 2.0].map(|offset| Plane { normal: [0.0, 0.0, 1.0], offset });
/// assert_eq!(facets_near(&mesh, &planes, &Silent).unwrap(), [vec![1, 2, 3], vec![]]);
/// ```
pub fn facets_near(
    mesh: &Mesh,
    planes: &[Plane],
    progress: &dyn Progress,
) -> Result<Vec<Vec<u32>>, Cancelled> {
    let mut near: Vec<Vec<u32>> = vec![vec![]; planes.len()];
    let mut left: Vec<usize> = (0..planes.len()).collect();
    while let Some(first) = left.first().copied() {
        let normal = planes[first].normal;
        let (mut own, rest): (Vec<usize>, Vec<usize>) =
            left.into_iter().partition(|k| planes[*k].normal == normal);
        left = rest;
        // A normal that is no number equals none, not even itself.
        if own.is_empty() {
            left.retain(|k| *k != first);
            continue;
        }
        own.sort_by(|a, b| planes[*a].offset.total_cmp(&planes[*b].offset));
        let offsets: Vec<f64> = own.iter().map(|k| planes[*k].offset).collect();
        let heights: Vec<[f64; 2]> = mesh.positions.iter().map(|p| height(normal, *p)).collect();
        for (n, face) in mesh.faces.iter().enumerate() {
            if n % ASKED == 0 && progress.cancelled() {
                return Err(Cancelled);
            }
            let ends = face.map(|v| heights.get(v as usize).copied());
            let [Some(a), Some(b), Some(c)] = ends else { continue };
            let (low, high) = (a[0].min(b[0]).min(c[0]), a[1].max(b[1]).max(c[1]));
            let from = offsets.partition_point(|o| *o < low);
            let between = own[from..].iter().zip(&offsets[from..]).take_while(|(_, o)| **o <= high);
            between.for_each(|(k, _)| near[*k].push(n as u32));
        }
    }
    Ok(near)
}

/// Between what the height of a place along a normal lies: three products and two sums are rounded.
fn height(normal: [f64; 3], p: [f64; 3]) -> [f64; 2] {
    let terms = [normal[0] * p[0], normal[1] * p[1], normal[2] * p[2]];
    let sum: f64 = terms.iter().sum();
    let bound = 8.0 * f64::EPSILON * terms.iter().map(|t| t.abs()).sum::<f64>() + f64::MIN_POSITIVE;
    [sum - bound, sum + bound]
}

#[cfg(test)]
mod tests {
    use super::super::cut::{cut, cut_facets};
    use super::*;
    use crate::num::random::Random;
    use crate::progress::Silent;

    /// A grid of heights, with facets that point down closed by nothing, and planes through its vertices, edges and between.
    #[test]
    fn planes_of_a_stack_cut_as_each_by_itself() {
        let random = &mut Random::new(7);
        let side = 30;
        let mut positions = vec![];
        for i in 0..side * side {
            // Quarters: many vertices lie in planes exactly.
            let z = (4.0 * random.unit()).floor() / 4.0;
            positions.push([f64::from(i % side), f64::from(i / side), z]);
        }
        let mut faces = vec![];
        for i in (0..side * side - side).filter(|i| i % side + 1 < side) {
            let (a, b, c, d) = (i as u32, i as u32 + 1, (i + side) as u32, (i + side) as u32 + 1);
            faces.extend([[a, b, d], [a, d, c]]);
        }
        faces.push([0, 1, 99_999]);
        positions[5] = [f64::NAN; 3];
        let mesh = Mesh { positions, faces };
        let mut planes = vec![];
        for normal in [[0.0, 0.0, 1.0], [1.0, 2.0, 3.0], [0.1, 0.0, -1.0]] {
            planes.extend((-8..60).map(|k| Plane { normal, offset: f64::from(k) * 0.125 }));
        }
        planes.push(Plane { normal: [f64::NAN; 3], offset: 0.0 });
        let near = facets_near(&mesh, &planes, &Silent).unwrap();
        let mut listed = 0;
        for (plane, facets) in planes.iter().zip(&near) {
            assert!(facets.is_sorted());
            listed += facets.len();
            let both =
                [cut(&mesh, plane, &Silent).unwrap(), cut_facets(&mesh, plane, facets, &Silent).unwrap()];
            assert_eq!(both[0], both[1], "{plane:?}");
        }
        assert!(listed > 5000 && listed < planes.len() * mesh.faces.len() / 3, "{listed}");
    }
}
