//! Whether closed shells bound solids that lie apart, or in each other's cavities.
//!
//! Only then does the surface wind around every place once or not at all, which pseudonormals need. Where two solids overlap,
//! the nearest facet may be one that lies inside the other solid and looks the wrong way. It is so if no two facets meet
//! outside of the parts they share, and one condition holds. The winding number on either side of each shell is 0 or 1. Where
//! the whole is inside out it is 0 or −1. Both are decided exactly. A mesh of one shell is not looked at.

use super::Inspected;
use super::inside_out_shells::orientations;
use super::intersect::any_self_intersection;
use super::islands::shell_bounds;
use crate::progress::Cancelled;
use crate::space::Aabb;

/// Whether the shells of a closed mesh, all of them oriented, overlap. They do where two meet, or one lies in another and looks
/// the way that one does. Costs a search for self-intersections where boxes of shells overlap, else n log n of the shells.
pub(super) fn shells_overlap(m: &Inspected) -> Result<bool, Cancelled> {
    if m.topology.shells < 2 {
        return Ok(false);
    }
    let bounds: Vec<Aabb> = shell_bounds(m).into_iter().map(|(_, bounds)| bounds).collect();
    if !apart(bounds) && any_self_intersection(m.mesh, m.topology, m.progress)? {
        return Ok(true);
    }
    let outwards = if m.properties.signed_volume > 0.0 { 1 } else { -1 };
    let once = |winding: i32| winding == 0 || winding == outwards;
    let parts_once = |(looks, outside): (i32, i32)| looks != 0 && once(outside) && once(outside + looks);
    Ok(!orientations(m).into_iter().all(parts_once))
}

/// True where planes across the axes, one cut after the other, part each box from all others. False where boxes overlap, or
/// where no such cuts are found. n log n for each level of cuts.
fn apart(bounds: Vec<Aabb>) -> bool {
    let mut parts = vec![bounds];
    while let Some(part) = parts.pop() {
        if part.len() < 2 {
            continue;
        }
        match (0..3).map(|axis| cut(&part, axis)).find(|groups| groups.len() > 1) {
            Some(groups) => parts.extend(groups),
            None => return false,
        }
    }
    true
}

/// The boxes in groups whose extents along the axis do not overlap.
fn cut(part: &[Aabb], axis: usize) -> Vec<Vec<Aabb>> {
    let mut sorted = part.to_vec();
    sorted.sort_by(|a, b| a.min[axis].total_cmp(&b.min[axis]));
    let (mut groups, mut reach) = (Vec::<Vec<Aabb>>::new(), f64::NEG_INFINITY);
    for bounds in sorted {
        match groups.last_mut() {
            Some(group) if bounds.min[axis] <= reach => group.push(bounds),
            _ => groups.push(vec![bounds]),
        }
        reach = reach.max(bounds.max[axis]);
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    #[test]
    fn boxes_are_apart_only_if_no_two_overlap() {
        let random = &mut Random::new(8);
        let (mut yes, mut no) = (0, 0);
        for case in 0..400 {
            let size = if case % 2 == 0 { 0.3 } else { 0.05 };
            let boxes: Vec<Aabb> = (0..2 + case % 7)
                .map(|_| {
                    let min: [f64; 3] = std::array::from_fn(|_| random.unit());
                    Aabb { min, max: min.map(|x| x + size * random.unit()) }
                })
                .collect();
            let overlap = |a: &Aabb, b: &Aabb| (0..3).all(|k| a.min[k] <= b.max[k] && b.min[k] <= a.max[k]);
            let any = (0..boxes.len()).any(|i| boxes[..i].iter().any(|b| overlap(b, &boxes[i])));
            let found = apart(boxes.clone());
            assert!(!(found && any), "{boxes:?}");
            (yes, no) = (yes + u32::from(found), no + u32::from(any));
        }
        assert!(yes > 100 && no > 20, "{yes} {no}");
        assert!(apart(vec![]));
    }
}
