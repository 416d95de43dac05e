//! How much of a nominal's outlines the points of a section run along.

use super::nominal::{OffNominal, Outline};

/// A row of measured points, with the places nearest to each.
#[derive(Clone, Copy, Debug)]
pub struct MatchedRow<'a> {
    /// The points.
    pub points: &'a [[f64; 2]],
    /// The place of the outlines nearest to each.
    pub found: &'a [Option<OffNominal>],
    /// Whether the first follows the last.
    pub closed: bool,
    /// Numbers of the points that a gap follows, in ascending order: the stretch across it was not measured.
    pub gaps: &'a [usize],
}

/// The part of an outline that was measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Covered {
    /// Points that are nearest to it.
    pub points: usize,
    /// Where points run along it: lengths from its start, in ascending order, that have no place in common.
    pub stretches: Vec<[f64; 2]>,
}

impl Covered {
    /// Length of it that points run along.
    pub fn length(&self) -> f64 {
        self.stretches.iter().map(|[from, to]| to - from).sum()
    }
}

/// The points may not have taken a way along the outline. It is then so many times as long as that from point to point,
/// to the outline and back. Around a half circle it is π / 2 times as long, around a square's corner √2.
const MAX_WAY_ROUND_RATIO: f64 = 1.75;

/// How much of each outline was measured: the stretches between the places nearest to successive points of the rows.
/// Stretches that several pairs of points pass count once. One point alone passes nothing.
///
/// Cost: that of sorting the points.
pub fn covered(rows: &[MatchedRow], outlines: &[Outline]) -> Vec<Covered> {
    let lengths: Vec<f64> = outlines.iter().map(Outline::length).collect();
    let mut all = vec![Covered::default(); outlines.len()];
    for row in rows {
        row.found.iter().flatten().for_each(|off| all[off.outline].points += 1);
        let n = row.points.len().min(row.found.len());
        let pairs = if row.closed { n } else { n.saturating_sub(1) };
        for i in (0..pairs).filter(|i| row.gaps.binary_search(i).is_err()) {
            let j = (i + 1) % n;
            let (Some(a), Some(b)) = (row.found[i], row.found[j]) else { continue };
            if a.outline != b.outline {
                continue;
            }
            let [p, q] = [row.points[i], row.points[j]];
            let apart = libm::hypot(q[0] - p[0], q[1] - p[1]) + a.deviation.abs() + b.deviation.abs();
            let closed = outlines[a.outline].closed;
            all[a.outline].stretches.extend(between(
                a.along,
                b.along,
                closed.then_some(lengths[a.outline]),
                MAX_WAY_ROUND_RATIO * apart,
            ));
        }
    }
    for covered in &mut all {
        covered.stretches = union(std::mem::take(&mut covered.stretches));
    }
    all
}

/// The shorter way along an outline from one place to another, if it is no longer than
/// `most`. Where the way around the start of a closed one of the length `around` is shorter, it is that, in two parts.
fn between(a: f64, b: f64, around: Option<f64>, most: f64) -> Vec<[f64; 2]> {
    let [low, high] = [a.min(b), a.max(b)];
    match around {
        Some(length) if length - (high - low) < high - low => match length - (high - low) <= most {
            true => vec![[0.0, low], [high, length]],
            false => vec![],
        },
        _ if high - low <= most => vec![[low, high]],
        _ => vec![],
    }
}

/// The union of these stretches.
fn union(mut stretches: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    stretches.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut all: Vec<[f64; 2]> = vec![];
    for [from, to] in stretches {
        match all.last_mut() {
            Some(last) if from <= last[1] => last[1] = last[1].max(to),
            _ => all.push([from, to]),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::super::nominal::off_nominal;
    use super::*;
    use std::f64::consts::TAU;
    use trueness_geom::progress::Silent;

    /// A square of 10 and a triangle within it, which begins amid the square.
    fn nominal() -> Vec<Outline> {
        let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
        let triangle = [[4.0, 4.0], [4.0, 6.0], [6.0, 4.0]];
        vec![Outline::polyline(&square, true), Outline::polyline(&triangle, true)]
    }

    fn shares(points: &[[f64; 2]], closed: bool, gaps: &[usize]) -> Vec<(usize, f64)> {
        let outlines = nominal();
        let found = off_nominal(points, &outlines, &Silent).unwrap();
        let rows = [MatchedRow { points, found: &found, closed, gaps }];
        covered(&rows, &outlines)
            .iter()
            .zip(&outlines)
            .map(|(c, o)| (c.points, c.length() / o.length()))
            .collect()
    }

    fn near(found: &[(usize, f64)], wanted: &[(usize, f64)]) {
        for (f, w) in found.iter().zip(wanted) {
            assert!(f.0 == w.0 && (f.1 - w.1).abs() < 1e-12, "{found:?} {wanted:?}");
        }
    }

    #[test]
    fn what_points_run_along_is_covered() {
        // Every millimeter around the square, from amid a side and a little outside; the corners are cut short and yet passed.
        let around: Vec<[f64; 2]> = (0..40)
            .map(|i| f64::from(i) + 5.5)
            .map(|s| match s % 40.0 {
                s if s < 10.0 => [s, -0.01],
                s if s < 20.0 => [10.01, s - 10.0],
                s if s < 30.0 => [30.0 - s, 10.01],
                s => [-0.01, 40.0 - s],
            })
            .collect();
        near(&shares(&around, true, &[]), &[(40, 1.0), (0, 0.0)]);
        // Without the way from the last to the first, and without two gaps: three of forty.
        near(&shares(&around, false, &[3, 20]), &[(40, 37.0 / 40.0), (0, 0.0)]);
        let outlines = nominal();
        let found = off_nominal(&around, &outlines, &Silent).unwrap();
        let rows = [MatchedRow { points: &around, found: &found, closed: false, gaps: &[3] }];
        // Along the square from its lower left corner, begun at 5.5.
        let [ref square, ref triangle] = covered(&rows, &outlines)[..] else { panic!() };
        let is = |k: usize, [from, to]: [f64; 2]| {
            let [a, b] = square.stretches[k];
            (a - from).abs() < 1e-12 && (b - to).abs() < 1e-12
        };
        assert!(is(0, [0.0, 4.5]) && is(1, [5.5, 8.5]) && is(2, [9.5, 40.0]), "{square:?}");
        assert_eq!(square.stretches.len(), 3);
        assert!(triangle.stretches.is_empty());
        // There and back counts once.
        let back: Vec<[f64; 2]> = around.iter().chain(around.iter().rev()).copied().collect();
        near(&shares(&back, false, &[]), &[(80, 39.0 / 40.0), (0, 0.0)]);
    }

    #[test]
    fn no_way_is_taken_that_the_points_did_not_take() {
        // From the lower side to the upper, through the square: half of the way around is twice as long.
        near(&shares(&[[5.0, 0.0], [5.0, 10.0]], false, &[]), &[(2, 0.0), (0, 0.0)]);
        // One point alone.
        near(&shares(&[[4.2, 4.2]], true, &[]), &[(0, 0.0), (1, 0.0)]);
        // Around a circle in the shorter direction, over its start.
        let circle = [Outline { segments: vec![crate::Segment::arc([0.0; 2], 3.0, 0.0, TAU)], closed: true }];
        let points = [-0.2_f64, 0.1].map(|a| [3.1 * a.cos(), 3.1 * a.sin()]);
        let found = off_nominal(&points, &circle, &Silent).unwrap();
        let rows = [MatchedRow { points: &points, found: &found, closed: false, gaps: &[] }];
        assert!((covered(&rows, &circle)[0].length() - 0.9).abs() < 1e-12);
    }
}
