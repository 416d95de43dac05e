//! Fans of facets with a vertex of their own that are still very near to one another. A search for places meant as one
//! would join them again.

use super::work::Work;
use std::collections::BTreeMap;
use trueness_geom::check::near::{Near, segment_reaches};
use trueness_geom::space::{Aabb, Point, dot, minus, norm, plus, times};

/// Facets around a vertex that lose it.
pub(super) struct Fan {
    /// The vertex.
    pub at: u32,
    pub facets: Vec<u32>,
    /// The other ends of its boundary edges at the vertex.
    pub rim: Vec<u32>,
}

/// For each vertex that is lost the other ends of the boundary edges that stay at it.
pub(super) type Rims = BTreeMap<u32, Vec<u32>>;

/// Fans, by their number, whose new vertex (that of number
/// `first` and those after it) lies within the gap of another place. That is the vertex of an earlier fan from the same place, this place itself, or a boundary edge that begins there. Fans of a place are neighbors in `fans`.
///
/// n log n for n fans at a place, and more where most of them lie within the gap of one edge.
pub(super) fn meant_as_one(work: &Work, fans: &[Fan], rims: &Rims, first: usize) -> Vec<usize> {
    let mut bad = vec![];
    let mut start = 0;
    for group in fans.chunk_by(|a, b| a.at == b.at) {
        let place = group[0].at;
        // The place itself comes before all fans.
        let tips: Vec<(Point, u32)> = std::iter::once(work.at(place))
            .chain((start..start + group.len()).map(|i| work.mesh().positions[first + i]))
            .zip(0..)
            .collect();
        let near = Near::new(tips.clone());
        let stays = rims.get(&place).map_or(&[][..], |rim| rim);
        let all = std::iter::once(stays).chain(group.iter().map(|fan| &fan.rim[..]));
        for (rim, (tip, number)) in all.zip(&tips) {
            for other in within(&near, work.gap, *tip, *tip).filter(|other| other > number) {
                bad.push(start + other as usize - 1);
            }
            for w in rim {
                for other in within(&near, work.gap, *tip, work.at(*w)).filter(|other| other != number) {
                    // The place cannot be moved, so the edge is.
                    bad.push(start + if other == 0 { *number } else { other } as usize - 1);
                }
            }
        }
        start += group.len();
    }
    bad
}

/// Numbers of the points within `gap` of the segment from `a` to `b`.
fn within(near: &Near, gap: f64, a: Point, b: Point) -> impl Iterator<Item = u32> + use<> {
    let mut found = vec![];
    let reaches = |bounds: &Aabb| segment_reaches(a, b, gap, bounds);
    near.visit(reaches, |p, number| found.extend((to_segment(*p, a, b) <= gap).then_some(number)));
    found.into_iter()
}

/// Distance of `p` from the segment from `a` to `b`.
fn to_segment(p: Point, a: Point, b: Point) -> f64 {
    let (along, to) = (minus(b, a), minus(p, a));
    let length = dot(along, along);
    let t = if length > 0.0 { (dot(to, along) / length).clamp(0.0, 1.0) } else { 0.0 };
    norm(minus(p, plus(a, times(t, along))))
}
