//! Distances of the points of a section from the section of a nominal, in its plane.

use crate::model::result::{Contour, Geometry, Segment};
use trueness_geom::progress::{Cancelled, Progress};

/// A contour of a nominal: segments that each start where the one before ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Its segments.
    pub segments: Vec<Segment>,
    /// Whether the last ends where the first starts; then the material is on its left.
    pub closed: bool,
}

/// A place of a nominal, as the nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffNominal {
    /// Distance of the point: of closed outlines positive outside of the material, of open ones to the left.
    pub deviation: f64,
    /// The place nearest to it.
    pub place: [f64; 2],
    /// Number of the outline that it is on.
    pub outline: usize,
    /// Length along the outline from its start to the place.
    pub along: f64,
}

impl Outline {
    /// Straight from each point to the next; those that repeat the one before are passed over.
    pub fn polyline(points: &[[f64; 2]], closed: bool) -> Outline {
        let mut ends: Vec<[f64; 2]> = points.to_vec();
        ends.extend(points.first().filter(|_| closed));
        ends.dedup();
        let segments = ends.windows(2).map(|w| Segment::line(w[0], w[1])).collect();
        Outline { segments, closed }
    }

    /// The segments of a contour.
    pub fn of(contour: &Contour) -> Outline {
        Outline { segments: contour.segments.clone(), closed: contour.closed }
    }

    /// Its length.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(|s| s.length).sum()
    }

    /// The area that a closed one encloses, above 0 where it runs counter-clockwise, as outer ones do; arcs and splines
    /// by chords.
    pub fn area(&self) -> f64 {
        area(&self.places())
    }

    /// The box around it, of arcs and splines around places along them: least and greatest coordinates. `None` of one without segments.
    pub fn bounds(&self) -> Option<[[f64; 2]; 2]> {
        let end = self.segments.last()?.end;
        let wider = |[low, high]: [[f64; 2]; 2], p: [f64; 2]| {
            [[0, 1].map(|k| low[k].min(p[k])), [0, 1].map(|k| high[k].max(p[k]))]
        };
        Some(self.places().into_iter().fold([end, end], wider))
    }

    /// Places along it; of lines the ends.
    fn places(&self) -> Vec<[f64; 2]> {
        let of = |s: &Segment| {
            let parts = if s.geometry == Geometry::Line { 1 } else { PLACES_PER_CURVE };
            (0..parts).map(|i| s.place(i as f64 / parts as f64)).collect::<Vec<_>>()
        };
        self.segments.iter().flat_map(of).collect()
    }

    /// How far the end of an open one is from its start, if that is a small share of its length. It was meant to be
    /// closed then.
    pub fn nearly_closed(&self) -> Option<f64> {
        let (first, last) = (self.segments.first()?, self.segments.last()?);
        let gap = libm::hypot(first.start[0] - last.end[0], first.start[1] - last.end[1]);
        (!self.closed && gap < NEARLY_CLOSED_SHARE * self.length()).then_some(gap)
    }

    /// The parts in each of these stretches, between two lengths along it, as open outlines. Stretches without length
    /// are left out.
    pub fn parts(&self, stretches: &[[f64; 2]]) -> Vec<Outline> {
        let lengths = self.segments.iter().scan(0.0, |sum, s| {
            *sum += s.length;
            Some(*sum)
        });
        let ends: Vec<f64> = lengths.collect();
        let part = |[from, to]: &[f64; 2]| {
            let mut segments = vec![];
            let first = ends.partition_point(|end| end <= from);
            for (s, end) in self.segments.iter().zip(&ends).skip(first) {
                let start = end - s.length;
                if start >= *to {
                    break;
                }
                let [a, b] = [from, to].map(|along| (along - start).clamp(0.0, s.length));
                segments.extend((a < b).then(|| s.part(a, b)));
            }
            Outline { segments, closed: false }
        };
        stretches.iter().map(part).filter(|part| !part.segments.is_empty()).collect()
    }

    fn reversed(self) -> Outline {
        let segments = self.segments.into_iter().rev().map(Segment::reversed).collect();
        Outline { segments, ..self }
    }
}

/// An open outline whose ends are apart by less than this share of its length is nearly closed.
const NEARLY_CLOSED_SHARE: f64 = 0.01;
/// Places of an arc or a spline that tell which side of it is inside.
const PLACES_PER_CURVE: usize = 32;
/// Points after which the search asks whether to stop.
const POINTS_PER_STOP_CHECK: usize = 1024;

/// Closed outlines turned so that the material is on their left. The inside of an odd number of outlines is material:
/// the outer one runs counter-clockwise, holes in it clockwise. Within a nearly closed outline is inside of it too.
pub fn with_material_inside(outlines: Vec<Outline>) -> Vec<Outline> {
    let encloses = |o: &Outline| o.closed || o.nearly_closed().is_some();
    let polygons: Vec<Option<Vec<[f64; 2]>>> =
        outlines.iter().map(|o| encloses(o).then(|| o.places())).collect();
    let turned = |n: usize| {
        let Some(own) = polygons[n].as_ref().filter(|_| outlines[n].closed) else { return false };
        let Some(first) = own.first() else { return false };
        let around = |m: &usize| *m != n && polygons[*m].as_ref().is_some_and(|p| inside(p, *first));
        let hole = (0..polygons.len()).filter(around).count() % 2 == 1;
        (area(own) < 0.0) != hole
    };
    let turned: Vec<bool> = (0..outlines.len()).map(turned).collect();
    outlines.into_iter().zip(turned).map(|(o, turned)| if turned { o.reversed() } else { o }).collect()
}

fn area(polygon: &[[f64; 2]]) -> f64 {
    let n = polygon.len();
    let cross = |i: usize| {
        let (a, b, o) = (polygon[i], polygon[(i + 1) % n], polygon[0]);
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    0.5 * (0..n).map(cross).sum::<f64>()
}

pub(super) fn inside(polygon: &[[f64; 2]], p: [f64; 2]) -> bool {
    let n = polygon.len();
    let crosses = |i: &usize| {
        let (a, b) = (polygon[*i], polygon[(i + 1) % n]);
        (a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    (0..n).filter(crosses).count() % 2 == 1
}

/// A segment within its box.
struct BoxedSegment {
    low: [f64; 2],
    high: [f64; 2],
    outline: usize,
    number: usize,
    /// Length of the outline before it.
    before: f64,
}

impl BoxedSegment {
    fn new(segment: &Segment, outline: usize, number: usize, before: f64) -> BoxedSegment {
        let mut all =
            BoxedSegment { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2], outline, number, before };
        for p in segment.hull() {
            for k in 0..2 {
                all.low[k] = all.low[k].min(p[k]);
                all.high[k] = all.high[k].max(p[k]);
            }
        }
        all
    }

    /// Squared distance of a point from the box.
    fn square(&self, p: [f64; 2]) -> f64 {
        let off = |k: usize| (self.low[k] - p[k]).max(p[k] - self.high[k]).max(0.0);
        off(0) * off(0) + off(1) * off(1)
    }
}

/// The deviation of each point from the nearest of all outlines: the true least distance, ties to the first segment. `None` of
/// points beyond a free end of an open outline, of those that are no numbers, and where there is no outline.
///
/// At a corner the sign is that of the mean direction of the segments beside, which is the side that the point is on.
/// (Bærentzen and Aanæs, Signed distance computation using the angle weighted pseudonormal, 2005). Cost: a look at the
/// box of each segment for each point.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
///
/// ```
/// use trueness_section::{off_nominal, Outline};
/// let square = Outline::polyline(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]], true);
/// let found = off_nominal(&[[2.0, 0.5], [7.0, 8.0]], &[square], &trueness_geom::progress::Silent).unwrap();
/// assert_eq!([0, 1].map(|i| found[i].unwrap().deviation), [-0.5, 5.0]);
/// ```
pub fn off_nominal(
    points: &[[f64; 2]],
    outlines: &[Outline],
    progress: &dyn Progress,
) -> Result<Vec<Option<OffNominal>>, Cancelled> {
    let each = |(n, o): (usize, &Outline)| -> Vec<BoxedSegment> {
        let lengths = o.segments.iter().scan(0.0, |sum, s| Some(std::mem::replace(sum, *sum + s.length)));
        o.segments
            .iter()
            .zip(lengths)
            .enumerate()
            .map(|(k, (s, before))| BoxedSegment::new(s, n, k, before))
            .collect()
    };
    let boxes: Vec<BoxedSegment> = outlines.iter().enumerate().flat_map(each).collect();
    let mut all = Vec::with_capacity(points.len());
    // The segment nearest to the point before: a good guess.
    let mut last = 0;
    for (i, p) in points.iter().enumerate() {
        if i % POINTS_PER_STOP_CHECK == 0 && progress.cancelled() {
            return Err(Cancelled);
        }
        if boxes.is_empty() || p.iter().any(|x| !x.is_finite()) {
            all.push(None);
            continue;
        }
        let segment = |b: &BoxedSegment| &outlines[b.outline].segments[b.number];
        let guess = segment(&boxes[last]).nearest(*p).distance.abs();
        // A box at the same distance may hold an earlier segment as near.
        let limit = guess * guess * (1.0 + 1e-12);
        let mut best = (f64::INFINITY, last);
        for (n, b) in boxes.iter().enumerate().filter(|(_, b)| b.square(*p) <= limit) {
            let distance = segment(b).nearest(*p).distance.abs();
            if distance < best.0 {
                best = (distance, n);
            }
        }
        last = best.1;
        let b = &boxes[last];
        all.push(signed(*p, &outlines[b.outline], b.number).map(|(deviation, place)| {
            let along = b.before + segment(b).foot(*p).0;
            OffNominal { deviation, place, outline: b.outline, along }
        }));
    }
    Ok(all)
}

/// The deviation of a point from the segment of an outline nearest to it, and the place nearest to it.
fn signed(point: [f64; 2], outline: &Outline, number: usize) -> Option<(f64, [f64; 2])> {
    let (segments, count) = (&outline.segments, outline.segments.len());
    let foot = segments[number].nearest(point);
    let d = [point[0] - foot.place[0], point[1] - foot.place[1]];
    let next = match foot.share {
        s if s >= 1.0 && (outline.closed || number + 1 < count) => Some((number, (number + 1) % count)),
        s if s <= 0.0 && (outline.closed || number > 0) => Some(((number + count - 1) % count, number)),
        _ => None,
    };
    let at_end = foot.share <= 0.0 || foot.share >= 1.0;
    let left = match next {
        Some((before, after)) => {
            let [a, b] = [segments[before].directions()[1], segments[after].directions()[0]].map(unit);
            let along = [a[0] + b[0], a[1] + b[1]];
            along[0] * d[1] - along[1] * d[0]
        }
        None => {
            let along = unit(foot.along);
            // Beyond a free end the nearest side is not the outline's.
            let ahead = (along[0] * d[0] + along[1] * d[1]) * if foot.share >= 1.0 { 1.0 } else { -1.0 };
            if at_end && ahead > BEYOND_END_SHARE * foot.distance.abs() {
                return None;
            }
            foot.distance
        }
    };
    let distance = foot.distance.abs();
    let outside = if outline.closed { left < 0.0 } else { left > 0.0 };
    let deviation = if outside { distance } else { -distance };
    Some((deviation + 0.0, foot.place))
}

/// A point lies beyond a free end if that is ahead of it by more than this share of its distance. At right angles it is
/// not.
const BEYOND_END_SHARE: f64 = 1e-9;

fn unit(v: [f64; 2]) -> [f64; 2] {
    let size = libm::hypot(v[0], v[1]).max(f64::MIN_POSITIVE);
    [v[0] / size, v[1] / size]
}

#[cfg(test)]
mod tests;
