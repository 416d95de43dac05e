//! Points sorted into sections across a direction.

use crate::space::{Point, Vector, dot, minus};

/// Most sections that points which lie in no rings are sorted into.
const MAX_SECTIONS: usize = 24;
/// Least points that each of these sections has on average: noise moves its center by 0.3 of itself or less.
const MIN_POINTS_PER_SECTION: usize = 24;
/// Fewest points of a ring.
pub(super) const MIN_POINTS_PER_RING: usize = 6;
/// Share of the extent along the direction: a gap above it separates two rings, and no ring is higher.
const RING_GAP_SHARE: f64 = 0.01;

/// The sections of points (mm) across a direction (of length 1), each by the indices of its points, in the order along it.
///
/// Points that were taken in thin rings or rows across the direction, at least three with six points each, have a section for
/// each. Others are sorted into up to 24 sections of equal height with 24 points or more on average. A point that is not finite
/// belongs to none. Cost: `n log n`.
///
/// ```
/// // Three rows of six points.
/// let row = |z: f64| (0..6).map(move |k| [f64::from(k), 0.0, z]);
/// let points: Vec<[f64; 3]> = row(0.0).chain(row(9.0)).chain(row(4.0)).collect();
/// let found = trueness_geom::zone::sections(&points, [0.0, 0.0, 1.0]);
/// assert!(found.len() == 3 && found[1] == [12, 13, 14, 15, 16, 17]);
/// ```
pub fn sections(points: &[Point], direction: Vector) -> Vec<Vec<usize>> {
    // About the first point: heights far from the origin would lose digits.
    let origin = points.iter().find(|p| p.iter().all(|x| x.is_finite())).copied().unwrap_or_default();
    let height = |p: &Point| dot(minus(*p, origin), direction);
    let mut sorted: Vec<(f64, usize)> =
        points.iter().map(height).zip(0..).filter(|(h, _)| h.is_finite()).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let found = rings(&sorted).unwrap_or_else(|| slabs(&sorted));
    found.into_iter().map(|section| section.iter().map(|(_, i)| *i).collect()).collect()
}

/// Heights with their indices, sorted.
type Heights = [(f64, usize)];

/// The rings that points lie in, if they do.
fn rings(sorted: &Heights) -> Option<Vec<&Heights>> {
    let extent = sorted.last()?.0 - sorted.first()?.0;
    let found: Vec<&Heights> = sorted.chunk_by(|a, b| b.0 - a.0 <= RING_GAP_SHARE * extent).collect();
    // The points between two gaps of a scan are no ring.
    let thin = |ring: &Heights| ring[ring.len() - 1].0 - ring[0].0 <= RING_GAP_SHARE * extent;
    (found.len() >= 3 && found.iter().all(|ring| ring.len() >= MIN_POINTS_PER_RING && thin(ring)))
        .then_some(found)
}

/// Sections of equal height; some may have no points.
fn slabs(sorted: &Heights) -> Vec<&Heights> {
    let (Some(first), Some(last)) = (sorted.first(), sorted.last()) else { return vec![] };
    let count = (sorted.len() / MIN_POINTS_PER_SECTION).clamp(1, MAX_SECTIONS);
    let height = (last.0 - first.0) / count as f64;
    let ends = (1..count).map(|k| sorted.partition_point(|p| p.0 < first.0 + height * k as f64));
    let mut start = 0;
    ends.chain([sorted.len()]).map(|end| &sorted[std::mem::replace(&mut start, end)..end]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every point is in one section, the sections do not overlap, and none is higher than the others.
    #[test]
    fn sections_share_all_points_among_them() {
        let points: Vec<Point> = (0..1000).map(|k| [1.0, 2.0, f64::from((k * 7) % 1000) + 1e6]).collect();
        let found = sections(&points, [0.0, 0.0, 1.0]);
        assert_eq!((found.len(), found.iter().map(Vec::len).sum::<usize>()), (24, 1000));
        let heights = |s: &Vec<usize>| s.iter().map(|i| points[*i][2]).collect::<Vec<_>>();
        for pair in found.windows(2) {
            let (below, above) = (heights(&pair[0]), heights(&pair[1]));
            assert!(below.iter().all(|b| above.iter().all(|a| b < a)));
            assert!((41..=42).contains(&below.len()));
        }
        // Two grooves without points make no three rings of a scan.
        let grooved: Vec<Point> =
            points.iter().copied().filter(|p| !(300..340).contains(&(p[2] as i64 % 1000 % 600))).collect();
        assert_eq!(sections(&grooved, [0.0, 0.0, 1.0]).len(), 24);
        assert_eq!(sections(&[[f64::NAN, 0.0, 0.0]], [0.0, 0.0, 1.0]), Vec::<Vec<usize>>::new());
    }
}
