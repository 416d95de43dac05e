//! Which facets of a mesh each of many planes may cut.
//!
//! Most planes of a stack meet few facets. The heights of all vertices over planes of one normal are computed once.
//! Each facet goes to the planes between its lowest and its highest vertex. Heights are rounded, so they only exclude,
//! beyond an error bound. Above and below are decided exactly where the plane cuts.

use trueness_geom::mesh::Mesh;
use trueness_geom::plane::Plane;
use trueness_geom::progress::{Cancelled, Progress};

/// Facets after which the search asks whether to stop.
const FACETS_PER_STOP_CHECK: usize = 65536;

/// Numbers of facets that are held at a time, but those of one plane: 64 MB of them.
const MAX_FACET_NUMBERS: usize = 1 << 24;

/// For each plane the numbers of the facets that it may cut, in ascending order: all that it does cut, and few more.
///
/// They come plane by plane, each once, as many at a time as memory may hold. An entry is the number of the plane in
/// `planes`, and its facets. Facets that name no vertex are in no list. Nothing is promised of coordinates that are no
/// numbers but that they are none of a cut. Cost: for each normal one pass over the vertices and, for every 16 million
/// numbers, one over the facets. Then it takes as many steps as the lists are long.
///
/// # Errors
/// [`Cancelled`], when asked to stop, and the errors of `each`.
///
/// ```
/// use trueness_geom::{mesh::Mesh, plane::Plane, progress::{Cancelled, Silent}};
/// use trueness_section::facets_near;
/// let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let mesh = Mesh { positions, faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] };
/// let planes = [0.5, 2.0].map(|offset| Plane { normal: [0.0, 0.0, 1.0], offset });
/// let mut near = vec![vec![]; 2];
/// facets_near::<Cancelled>(&mesh, &planes, &Silent, |some| {
///     some.into_iter().for_each(|(plane, facets)| near[plane] = facets);
///     Ok(())
/// })?;
/// assert_eq!(near, [vec![1, 2, 3], vec![]]);
/// # Ok::<(), Cancelled>(())
/// ```
pub fn facets_near<E: From<Cancelled>>(
    mesh: &Mesh,
    planes: &[Plane],
    progress: &dyn Progress,
    mut each: impl FnMut(Vec<(usize, Vec<u32>)>) -> Result<(), E>,
) -> Result<(), E> {
    let mut left: Vec<usize> = (0..planes.len()).collect();
    while let Some(first) = left.first().copied() {
        let normal = planes[first].normal;
        let (mut own, rest): (Vec<usize>, Vec<usize>) =
            left.into_iter().partition(|k| planes[*k].normal == normal);
        left = rest;
        // A normal that is no number equals none, not even itself.
        if own.is_empty() {
            left.retain(|k| *k != first);
            each(vec![(first, vec![])])?;
            continue;
        }
        own.sort_by(|a, b| planes[*a].offset.total_cmp(&planes[*b].offset));
        let offsets: Vec<f64> = own.iter().map(|k| planes[*k].offset).collect();
        let between = between(mesh, normal, &offsets, progress)?;
        let counts = counts(&between, offsets.len());
        let mut from = 0;
        while from < own.len() {
            let mut to = from + 1;
            let mut room = MAX_FACET_NUMBERS.saturating_sub(counts[from]);
            while to < own.len() && counts[to] <= room {
                room -= counts[to];
                to += 1;
            }
            let mut lists: Vec<Vec<u32>> = counts[from..to].iter().map(|n| Vec::with_capacity(*n)).collect();
            for (n, range) in between.iter().enumerate() {
                if n % FACETS_PER_STOP_CHECK == 0 && progress.cancelled() {
                    return Err(Cancelled.into());
                }
                for k in range[0].max(from as u32)..range[1].min(to as u32) {
                    lists[k as usize - from].push(n as u32);
                }
            }
            each(own[from..to].iter().copied().zip(lists).collect())?;
            from = to;
        }
    }
    Ok(())
}

/// For each facet the planes of one normal, by ascending offsets, that it may lie across: the first, and the one after the last.
fn between(
    mesh: &Mesh,
    normal: [f64; 3],
    offsets: &[f64],
    progress: &dyn Progress,
) -> Result<Vec<[u32; 2]>, Cancelled> {
    let heights: Vec<[f64; 2]> = mesh.positions.iter().map(|p| height(normal, *p)).collect();
    let mut all = Vec::with_capacity(mesh.faces.len());
    for (n, face) in mesh.faces.iter().enumerate() {
        if n % FACETS_PER_STOP_CHECK == 0 && progress.cancelled() {
            return Err(Cancelled);
        }
        let [Some(a), Some(b), Some(c)] = face.map(|v| heights.get(v as usize)) else {
            all.push([0; 2]);
            continue;
        };
        let (low, high) = (a[0].min(b[0]).min(c[0]), a[1].max(b[1]).max(c[1]));
        let from = offsets.partition_point(|o| *o < low);
        let past = offsets[from..].iter().take_while(|o| **o <= high).count();
        all.push([from as u32, (from + past) as u32]);
    }
    Ok(all)
}

/// How many facets lie across each plane.
fn counts(between: &[[u32; 2]], planes: usize) -> Vec<usize> {
    // Where lists begin and end, then the sums of that.
    let mut change = vec![0i64; planes + 1];
    for range in between {
        change[range[0] as usize] += 1;
        change[range[1] as usize] -= 1;
    }
    change[..planes]
        .iter()
        .scan(0, |sum, change| {
            *sum += change;
            Some(*sum as usize)
        })
        .collect()
}

/// The bounds of the height of a place along a normal: three products and two sums are rounded.
fn height(normal: [f64; 3], p: [f64; 3]) -> [f64; 2] {
    let terms = [normal[0] * p[0], normal[1] * p[1], normal[2] * p[2]];
    let sum: f64 = terms.iter().sum();
    let bound = 8.0 * f64::EPSILON * terms.iter().map(|t| t.abs()).sum::<f64>() + f64::MIN_POSITIVE;
    [sum - bound, sum + bound]
}

#[cfg(test)]
mod tests {
    use super::super::plane::{cut, cut_facets};
    use super::*;
    use trueness_geom::num::random::Random;
    use trueness_geom::progress::Silent;

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
        let mut near = vec![None; planes.len()];
        facets_near::<Cancelled>(&mesh, &planes, &Silent, |batch| {
            batch.into_iter().for_each(|(plane, facets)| assert!(near[plane].replace(facets).is_none()));
            Ok(())
        })
        .unwrap();
        let near: Vec<Vec<u32>> = near.into_iter().map(Option::unwrap).collect();
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
