//! Places where a contour crosses itself: then it has no inside, and none of the measures that ask for one.

use super::result::{Geometry, Segment};
use trueness_geom::num::predicates::side_of_line;
use trueness_geom::progress::{Cancelled, Progress};

/// Chords over a whole circle, and over a span of a free curve. They differ, and are odd, so that ends of chords of one curve seldom
/// lie on another.
const CHORDS_PER_CIRCLE_AND_SPAN: (f64, usize) = (143.0, 11);
/// At most so many crossings are listed.
const MAX_CROSSINGS: usize = 100;
/// Chords looked at after which the search asks whether to stop.
const CHORDS_PER_STOP_CHECK: usize = 1024;
/// Steps towards the place where two curves cross.
const CROSSING_STEPS: usize = 4;
/// Each step leaves this share of the chord's half length.
const CHORD_SHRINK_RATIO: f64 = 0.1;

/// A chord of a segment: from a share of its parameter to another.
struct Chord {
    ends: [[f64; 2]; 2],
    segment: usize,
    shares: [f64; 2],
}

/// Whether two chords cross. A point on a chord counts as left of it: a way through the end of a chord crosses once.
fn cross(a: &[[f64; 2]; 2], b: &[[f64; 2]; 2]) -> bool {
    let left = |c: &[[f64; 2]; 2], p: [f64; 2]| {
        let space = |p: [f64; 2]| [p[0], p[1], 0.0];
        side_of_line(2, &space(c[0]), &space(c[1]), &space(p)) >= 0
    };
    left(a, b[0]) != left(a, b[1]) && left(b, a[0]) != left(b, a[1])
}

/// Pairs of chords of a way that cross, but for neighbors; at most `most`. `closed` tells that the last is the first one's neighbor.
///
/// They are looked for in the order of one coordinate, that in which they overlap less. Cost: by the number of pairs that overlap.
pub(crate) fn crossing_chords(
    chords: &[[[f64; 2]; 2]],
    closed: bool,
    most: usize,
    progress: &dyn Progress,
) -> Result<Vec<(usize, usize)>, Cancelled> {
    let range = |c: &[[f64; 2]; 2], k: usize| (c[0][k].min(c[1][k]), c[0][k].max(c[1][k]));
    let sum = |k: usize| chords.iter().map(|c| range(c, k)).map(|(a, b)| b - a).sum::<f64>();
    let size = |k: usize| {
        let all = chords.iter().map(|c| range(c, k));
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), (c, d)| (a.min(c), b.max(d)));
        (high - low).max(f64::MIN_POSITIVE)
    };
    let k = usize::from(sum(1) / size(1) < sum(0) / size(0));
    let mut order: Vec<usize> = (0..chords.len()).collect();
    order.sort_by(|a, b| range(&chords[*a], k).0.total_cmp(&range(&chords[*b], k).0).then(a.cmp(b)));
    let (mut open, mut found): (Vec<usize>, Vec<(usize, usize)>) = (vec![], vec![]);
    for (n, i) in order.into_iter().enumerate() {
        if n % CHORDS_PER_STOP_CHECK == 0 && progress.cancelled() {
            return Err(Cancelled);
        }
        let own = &chords[i];
        let (low, across) = (range(own, k).0, range(own, 1 - k));
        open.retain(|j| range(&chords[*j], k).1 >= low);
        for &j in &open {
            let (from, to) = range(&chords[j], 1 - k);
            let apart = i.abs_diff(j);
            let are_neighbors = apart < 2 || closed && apart + 1 == chords.len();
            if from <= across.1 && across.0 <= to && !are_neighbors && cross(own, &chords[j]) {
                found.push((i.min(j), i.max(j)));
            }
        }
        if found.len() >= most {
            break;
        }
        open.push(i);
    }
    found.sort_unstable();
    found.truncate(most);
    Ok(found)
}

/// Where segments that follow each other cross, in their order; at most a hundred places. `closed` tells that the last is followed by
/// the first.
///
/// Curves are looked at by chords. Two of them that run beside each other nearer than chords to their arcs (3e-4 of a
/// radius) may be taken for crossing. Where segments touch there is no crossing. Cost: a sort of the chords, and a look
/// at those that overlap in one coordinate.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
///
/// ```
/// use trueness_geom::progress::Silent;
/// use trueness_section::{Segment, crossings};
/// let tie = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
/// let sides: Vec<Segment> = (0..4).map(|i| Segment::straight(tie[i], tie[(i + 1) % 4])).collect();
/// assert_eq!(crossings(&sides, true, &Silent).unwrap(), [[1.0, 1.0]]);
/// ```
pub fn crossings(
    segments: &[Segment],
    closed: bool,
    progress: &dyn Progress,
) -> Result<Vec<[f64; 2]>, Cancelled> {
    crossings_with_loops(segments, closed, 0.0, progress)
}

/// The same where both ways round from the place to itself are longer than `least`: of an open contour the one way there is. Where curves
/// overshoot the place where they join, they cross in a loop that no point of the row is on.
pub(crate) fn crossings_with_loops(
    segments: &[Segment],
    closed: bool,
    least: f64,
    progress: &dyn Progress,
) -> Result<Vec<[f64; 2]>, Cancelled> {
    let chords: Vec<Chord> = segments.iter().enumerate().flat_map(|(n, s)| chords(n, s)).collect();
    let ends: Vec<[[f64; 2]; 2]> = chords.iter().map(|c| c.ends).collect();
    let mut ways = vec![0.0];
    for [a, b] in &ends {
        ways.push(ways[ways.len() - 1] + libm::hypot(b[0] - a[0], b[1] - a[1]));
    }
    let is_long = |(i, j): &(usize, usize)| {
        let way = ways[*j] - ways[*i];
        way > least && (!closed || ways[ends.len()] - way > least)
    };
    let pairs = crossing_chords(&ends, closed, MAX_CROSSINGS, progress)?.into_iter().filter(is_long);
    Ok(pairs.map(|(i, j)| place_of(segments, &chords[i], &chords[j])).collect())
}

/// The place where the curves of two chords cross: of ever shorter chords about where the ones before meet.
fn place_of(segments: &[Segment], a: &Chord, b: &Chord) -> [f64; 2] {
    let (mut shares, mut ends) = ([a.shares, b.shares], [a.ends, b.ends]);
    for _ in 0..CROSSING_STEPS {
        let along = [ends, [ends[1], ends[0]]].map(|[own, other]| meeting(own, other));
        for (k, chord) in [a, b].into_iter().enumerate() {
            let [from, to] = shares[k];
            let (at, half) = (from + along[k] * (to - from), CHORD_SHRINK_RATIO * (to - from));
            shares[k] = [(at - half).max(0.0), (at + half).min(1.0)];
            ends[k] = shares[k].map(|s| segments[chord.segment].place(s));
        }
    }
    let [own, other] = ends;
    let t = meeting(own, other);
    [0, 1].map(|k| own[0][k] + t * (own[1][k] - own[0][k]))
}

/// Where on a chord the line through another meets it: 0 at its start, 1 at its end; the middle of parallel ones.
fn meeting(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> f64 {
    let minus = |p: [f64; 2], q: [f64; 2]| [p[0] - q[0], p[1] - q[1]];
    let (u, v, d) = (minus(a[1], a[0]), minus(b[1], b[0]), minus(b[0], a[0]));
    let t = (d[0] * v[1] - d[1] * v[0]) / (u[0] * v[1] - u[1] * v[0]);
    if t.is_finite() { t } else { 0.5 }
}

fn chords(number: usize, segment: &Segment) -> Vec<Chord> {
    let count = match &segment.geometry {
        Geometry::Line => 1,
        Geometry::Arc { sweep, .. } => {
            ((sweep.abs() / std::f64::consts::TAU * CHORDS_PER_CIRCLE_AND_SPAN.0).ceil() as usize).max(3) | 1
        }
        Geometry::Spline { curve, .. } => {
            CHORDS_PER_CIRCLE_AND_SPAN.1 * (curve.points().len() - curve.knots().degree())
        }
    };
    let share = |i: usize| i as f64 / count as f64;
    let places: Vec<[f64; 2]> = (0..=count).map(|i| segment.place(share(i))).collect();
    let chord = |i: usize| Chord {
        ends: [places[i], places[i + 1]],
        segment: number,
        shares: [share(i), share(i + 1)],
    };
    (0..count).map(chord).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Options, contour};
    use trueness_geom::num::random::Random;
    use trueness_geom::progress::Silent;

    /// All pairs of chords, by their lines in double precision.
    fn brute(chords: &[[[f64; 2]; 2]], closed: bool) -> Vec<(usize, usize)> {
        let n = chords.len();
        let side = |c: &[[f64; 2]; 2], p: [f64; 2]| {
            (c[1][0] - c[0][0]) * (p[1] - c[0][1]) - (c[1][1] - c[0][1]) * (p[0] - c[0][0]) >= 0.0
        };
        let are_neighbors = |i: usize, j: usize| j - i < 2 || closed && j - i + 1 == n;
        let pairs =
            (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).filter(|(i, j)| !are_neighbors(*i, *j));
        let crosses = |(i, j): &(usize, usize)| {
            let (a, b) = (&chords[*i], &chords[*j]);
            side(a, b[0]) != side(a, b[1]) && side(b, a[0]) != side(b, a[1])
        };
        pairs.filter(crosses).collect()
    }

    #[test]
    fn crossings_are_those_of_brute_force() {
        let random = &mut Random::new(4);
        for round in 0..60 {
            let n = 4 + random.below(60) as usize;
            let flat = if round % 3 == 0 { 0.01 } else { 1.0 };
            let points: Vec<[f64; 2]> = (0..n).map(|_| [random.unit(), flat * random.unit()]).collect();
            let closed = round % 2 == 0;
            let count = if closed { n } else { n - 1 };
            let chords: Vec<_> = (0..count).map(|i| [points[i], points[(i + 1) % n]]).collect();
            let found = crossing_chords(&chords, closed, usize::MAX, &Silent).unwrap();
            assert_eq!(found, brute(&chords, closed), "{round}");
        }
    }

    /// A figure of eight crosses itself once where its formula says; a row that is no such figure nowhere.
    #[test]
    fn a_figure_of_eight_crosses_itself_in_its_middle() {
        let random = &mut Random::new(8);
        let mut normal = || (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
        for noise in [0.0, 0.002, 0.02] {
            let eight: Vec<[f64; 2]> = (0..400)
                .map(|i| libm::sincos((f64::from(i) + 0.3) * std::f64::consts::TAU / 400.0))
                .map(|(s, c)| [3.0 + 10.0 * s, 1.0 + 10.0 * s * c])
                .map(|p| p.map(|x| x + noise * normal()))
                .collect();
            let found = contour(&eight, &Options::default(), &Silent).unwrap();
            let places = crossings(&found.segments, true, &Silent).unwrap();
            assert_eq!(places.len(), 1, "{noise} {places:?}");
            let off = libm::hypot(places[0][0] - 3.0, places[0][1] - 1.0);
            assert!(off < 1e-3 + 2.0 * noise, "{noise} {off}");
            let ellipse: Vec<[f64; 2]> = (0..400)
                .map(|i| libm::sincos(f64::from(i) * std::f64::consts::TAU / 400.0))
                .map(|(s, c)| [10.0 * s + noise * normal(), 2.0 * c + noise * normal()])
                .collect();
            let found = contour(&ellipse, &Options::default(), &Silent).unwrap();
            assert_eq!(crossings(&found.segments, true, &Silent).unwrap(), [[0.0; 2]; 0], "{noise}");
        }
        // Lines cross where theirs do, to rounding; a bow tie whose middle is a point of the row too.
        let tie: Vec<[f64; 2]> = (0..20)
            .map(f64::from)
            .flat_map(|i| [[i, i]])
            .chain((0..20).map(|i| [20.0, 20.0 - f64::from(i)]))
            .chain((0..20).map(|i| [20.0 - f64::from(i), f64::from(i)]))
            .chain((0..20).map(|i| [0.0, 20.0 - f64::from(i)]))
            .collect();
        let found = contour(&tie, &Options::default(), &Silent).unwrap();
        let places = crossings(&found.segments, true, &Silent).unwrap();
        assert_eq!(places.len(), 1, "{places:?}");
        assert!(libm::hypot(places[0][0] - 10.0, places[0][1] - 10.0) < 1e-9, "{places:?}");
    }
}
