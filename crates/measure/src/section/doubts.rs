//! What of a nominal and of a part makes their deviations doubtful.

use super::hints::digits;
use super::outline::{Against, AgainstPlane};
use crate::bounds::bounds;
use trueness_document::Bounds;
use trueness_document::section::{NominalWarning, NominalWarningKind};
use trueness_geom::space::{Aabb, minus, norm};
use trueness_section::Outline;

/// A contour is nowhere near the nominal if all of it is farther off than this share of the nominal's size or its own, …
const FAR_SIZE_SHARE: f64 = 0.05;
/// … and than so many times the median of the others.
const FAR_MEDIANS: f64 = 10.0;

/// All that there is.
pub(super) fn doubts(planes: &[AgainstPlane]) -> Vec<NominalWarning> {
    nearly_closed(planes).into_iter().chain(nowhere_near(planes)).collect()
}

/// A contour by its number, and of several planes by that of its plane.
fn numbered(number: usize, plane: Option<u64>, several: bool) -> String {
    let plane = plane.filter(|_| several).map_or(String::new(), |n| format!(" in plane {}", n + 1));
    format!("contour {}{plane}", number + 1)
}

fn and_more(count: usize) -> String {
    match count {
        0 => String::new(),
        1 => " (and one more)".into(),
        _ => format!(" (and {count} more)"),
    }
}

/// Outlines whose ends nearly meet: the widest gap.
fn nearly_closed(planes: &[AgainstPlane]) -> Option<NominalWarning> {
    let all = planes.iter().flat_map(|p| p.outlines.iter().map(|o| (p.plane, o))).enumerate();
    let open: Vec<_> = all.filter_map(|(n, (plane, o))| Some((n, plane, o, o.nearly_closed()?))).collect();
    let (n, plane, outline, gap) = open.iter().copied().max_by(|a, b| a.3.total_cmp(&b.3))?;
    let [x, y] = outline.segments.first()?.start;
    let text = format!(
        "{} of the nominal{} is open by {} mm at ({x:.4}, {y:.4}): + is to its left, and no side of it is outside; close it",
        numbered(n, plane, planes.len() > 1),
        and_more(open.len() - 1),
        digits(gap)
    );
    Some(NominalWarning { kind: NominalWarningKind::NearlyClosed, value: gap, text })
}

/// A contour of the part with its number, its plane, and the least of its distances.
type Candidate = (usize, Option<u64>, Bounds, f64);

/// Contours of which all is far off: the farthest.
fn nowhere_near(planes: &[AgainstPlane]) -> Option<NominalWarning> {
    let (mut far, mut others): (Vec<Candidate>, Vec<f64>) = (vec![], vec![]);
    let mut number = 0;
    for plane in planes {
        let size = size_of(&plane.outlines);
        for contour in &plane.contours {
            let distances = || contour.found.iter().flatten().map(|off| off.deviation.abs());
            let least = distances().fold(f64::INFINITY, f64::min);
            match bounds_of(contour) {
                Some(b)
                    if least.is_finite()
                        && least > (FAR_SIZE_SHARE * size).min(norm(minus(b.max, b.min))) =>
                {
                    far.push((number, plane.plane, b, least));
                }
                _ => others.extend(distances()),
            }
            number += 1;
        }
    }
    // Where all of the part lies off, it lies apart, and that is told by the boxes.
    let middle = others.len().checked_sub(1)? / 2;
    let median = *others.select_nth_unstable_by(middle, f64::total_cmp).1;
    far.retain(|(.., least)| *least > FAR_MEDIANS * median);
    let (n, plane, b, least) = far.iter().copied().max_by(|a, b| a.3.total_cmp(&b.3))?;
    let [[x, y], [w, h]] = [[0, 1].map(|k| 0.5 * (b.min[k] + b.max[k])), [0, 1].map(|k| b.max[k] - b.min[k])];
    let text = format!(
        "{} of the part{} lies nowhere near the nominal: all of it is {least:.3} mm off or more (about {w:.3} × {h:.3} at {x:.3} {y:.3}), \
         and all statistics count it",
        numbered(n, plane, planes.len() > 1),
        and_more(far.len() - 1)
    );
    Some(NominalWarning { kind: NominalWarningKind::NowhereNear, value: least, text })
}

/// The box of a contour's points.
fn bounds_of(contour: &Against) -> Option<Bounds> {
    bounds(&Aabb::of(&contour.points.iter().map(|[x, y]| [*x, *y, 0.0]).collect::<Vec<_>>()))
}

/// Diagonal of the box around outlines.
fn size_of(outlines: &[Outline]) -> f64 {
    let corners = outlines.iter().filter_map(Outline::bounds).flatten().map(|[x, y]| [x, y, 0.0]);
    bounds(&Aabb::of(&corners.collect::<Vec<_>>())).map_or(0.0, |b| norm(minus(b.max, b.min)))
}
