//! Ways through cells linked at their ends, where the points between are missing by chance.
//!
//! Points sampled at random are uneven: of n gaps along a contour the longest is about ln n times as long as the mean.
//! A tree that reaches so far would reach across walls, too. So the tree reaches a few cells only, and the ways that it
//! falls into are linked end to end. Links go over gaps that points so uneven have by chance, rather straight on than
//! aside, and each end is linked once.

use crate::model::flat::distance;

/// Cells of a way in order, each with the cells of short branches beside it.
pub(super) type Way = Vec<(usize, Vec<usize>)>;

/// A way made of those that were linked, and whether its ends are linked too.
pub(super) struct Linked {
    pub way: Way,
    pub closed: bool,
}

/// Limits of the ends that may be linked.
pub(super) struct Limits {
    /// Farthest that two ends may be apart.
    pub gap: f64,
    /// Ends of one way that are no farther apart close it, wherever they head.
    pub closing: f64,
    /// A way of fewer cells does not close.
    pub fewest: usize,
}

/// A gap is longer than those that uneven points have by chance: one row in a thousand has a longer one.
const LONGEST_STEP_CHANCE: f64 = 7.0;
/// The direction of an end is that over so many cells.
const CELLS_OF_END_DIRECTION: usize = 4;
/// Two ends head for a common corner where the cosines of their angles with the line between them sum up to more than this. The sum
/// is 0 for two that run side by side.
const MIN_COSINE_SUM: f64 = 0.25;

/// The gap that neighbors on a contour are not farther apart than, by the steps between them that are no longer than
/// `reach`. The upper quarter of the steps falls off exponentially where points are sampled at random, at once where
/// they are even.
pub(super) fn longest_by_chance(mut steps: Vec<f64>, reach: f64) -> f64 {
    steps.sort_by(f64::total_cmp);
    let upper = &steps[steps.len() - steps.len().div_ceil(4)..];
    let Some(&first) = upper.first() else { return reach };
    let mean = upper.iter().map(|s| s - first).sum::<f64>() / upper.len() as f64;
    let most = (reach - first).max(f64::MIN_POSITIVE);
    // Steps beyond the reach are missing: the mean of a truncated exponential distribution, solved for its scale.
    let mut scale = mean;
    for _ in 0..20 {
        scale = (mean + most / libm::expm1(most / scale.max(f64::MIN_POSITIVE))).min(most);
    }
    reach.max(first + scale * (libm::log(steps.len() as f64) + LONGEST_STEP_CHANCE))
}

/// One end of a way.
struct End {
    at: [f64; 2],
    /// Direction in which the way leaves; none of a single cell.
    out: Option<[f64; 2]>,
}

fn end(way: &Way, last: bool, middles: &[[f64; 2]]) -> End {
    let n = way.len();
    let back = CELLS_OF_END_DIRECTION.min(n - 1);
    let (tip, inner) = if last { (n - 1, n - 1 - back) } else { (0, back) };
    let (at, from) = (middles[way[tip].0], middles[way[inner].0]);
    let size = distance(from, at);
    End { at, out: (size > 0.0).then(|| [(at[0] - from[0]) / size, (at[1] - from[1]) / size]) }
}

/// Number of the other end of the same way: ends are numbered by twos.
fn other(end: usize) -> usize {
    end ^ 1
}

/// Links the ends of ways, the nearest and straightest first.
pub(super) fn link_over_gaps(ways: Vec<Way>, middles: &[[f64; 2]], limits: &Limits) -> Vec<Linked> {
    let ends: Vec<End> = ways.iter().flat_map(|w| [false, true].map(|last| end(w, last, middles))).collect();
    // Ways that hang together: the far end of each end, and the number of cells.
    let mut far: Vec<usize> = (0..ends.len()).map(other).collect();
    let mut cells: Vec<usize> = ways.iter().flat_map(|w| [w.len(); 2]).collect();
    let mut partner: Vec<Option<usize>> = vec![None; ends.len()];
    for (_, a, b) in candidates(&ends, limits) {
        if partner[a].is_some() || partner[b].is_some() {
            continue;
        }
        if far[a] == b {
            if cells[a] > limits.fewest {
                (partner[a], partner[b]) = (Some(b), Some(a));
            }
            continue;
        }
        (partner[a], partner[b]) = (Some(b), Some(a));
        let (x, y, sum) = (far[a], far[b], cells[a] + cells[b]);
        (far[x], far[y]) = (y, x);
        (cells[x], cells[y]) = (sum, sum);
    }
    chains(ways, &partner)
}

/// Pairs of ends that may be linked, the likeliest first, with the cost of each.
fn candidates(ends: &[End], limits: &Limits) -> Vec<(f64, usize, usize)> {
    let mut by_x: Vec<usize> = (0..ends.len()).collect();
    by_x.sort_by(|a, b| ends[*a].at[0].total_cmp(&ends[*b].at[0]).then(a.cmp(b)));
    let mut all = vec![];
    for (k, &i) in by_x.iter().enumerate() {
        for &j in by_x[k + 1..].iter().take_while(|j| ends[**j].at[0] - ends[i].at[0] <= limits.gap) {
            let (a, b) = (i.min(j), i.max(j));
            let apart = distance(ends[a].at, ends[b].at);
            let ahead = |from: &End, to: &End| match from.out {
                Some(out) if apart > 0.0 => {
                    (out[0] * (to.at[0] - from.at[0]) + out[1] * (to.at[1] - from.at[1])) / apart
                }
                _ => 0.5,
            };
            let sum = ahead(&ends[a], &ends[b]) + ahead(&ends[b], &ends[a]);
            let closes = other(a) == b && apart <= limits.closing;
            if apart <= limits.gap && (sum > MIN_COSINE_SUM || closes) {
                all.push((apart * (3.0 - sum), a, b));
            }
        }
    }
    all.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)).then(x.2.cmp(&y.2)));
    all
}

/// The ways run through from an end that is linked to none; the others are closed.
fn chains(ways: Vec<Way>, partner: &[Option<usize>]) -> Vec<Linked> {
    let mut rest: Vec<Option<Way>> = ways.into_iter().map(Some).collect();
    let mut all = vec![];
    for closed in [false, true] {
        for start in 0..partner.len() {
            if !closed && partner[start].is_some() {
                continue;
            }
            let mut way: Way = vec![];
            let mut enter = Some(start);
            while let Some((end, mut next)) = enter.and_then(|e| Some((e, rest[e / 2].take()?))) {
                if end % 2 == 1 {
                    next.reverse();
                }
                way.extend(next);
                enter = partner[other(end)];
            }
            if !way.is_empty() {
                all.push(Linked { way, closed });
            }
        }
    }
    all
}

/// Most open ends whose nearest ones are looked for.
const MAX_OPEN_ENDS: usize = 4000;

/// The gap over which three quarters of these ends would meet another one. `None` where there are fewer than `fewest`.
pub(super) fn gap_to_close(ends: &[[f64; 2]], fewest: usize) -> Option<f64> {
    if ends.len() < fewest.max(2) || ends.len() > MAX_OPEN_ENDS {
        return None;
    }
    let nearest = |i: usize| {
        let others = (0..ends.len()).filter(|j| *j != i);
        others.map(|j| distance(ends[i], ends[j])).fold(f64::INFINITY, f64::min)
    };
    let mut all: Vec<f64> = (0..ends.len()).map(nearest).collect();
    all.sort_by(f64::total_cmp);
    Some(all[3 * (all.len() - 1) / 4])
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::num::random::Random;

    /// The longest of exponential steps with the mean 1 that are cut off at 4 is told: the logarithm of their number and seven more.
    #[test]
    fn the_longest_step_is_told_by_the_short_ones() {
        let random = &mut Random::new(4);
        let steps = |random: &mut Random| -> Vec<f64> {
            (0..2000).map(|_| -libm::log(1.0 - random.unit())).filter(|s| *s <= 4.0).collect()
        };
        for _ in 0..20 {
            let found = longest_by_chance(steps(random), 4.0);
            let want = libm::log(4.0) + libm::log(2000.0) + LONGEST_STEP_CHANCE;
            assert!((found / want - 1.0).abs() < 0.25, "{found} {want}");
        }
        // Even steps have no longer one by chance.
        assert_eq!(longest_by_chance(vec![1.0; 500], 4.0), 4.0);
        assert_eq!(longest_by_chance(vec![], 4.0), 4.0);
    }

    /// Two walls side by side with a gap in each are linked each with itself, though the other is nearer; their ends are not.
    #[test]
    fn ends_are_linked_straight_on_and_not_across() {
        let mut middles: Vec<[f64; 2]> = vec![];
        let mut wall = |y: f64, from: usize, to: usize| -> Way {
            (from..to)
                .map(|x| {
                    middles.push([x as f64, y]);
                    (middles.len() - 1, vec![])
                })
                .collect()
        };
        let mut ways = vec![wall(0.0, 0, 20), wall(0.0, 26, 40), wall(3.0, 0, 21), wall(3.0, 27, 40)];
        ways[3].reverse();
        let limits = Limits { gap: 8.0, closing: 4.0, fewest: 8 };
        let found = link_over_gaps(ways, &middles, &limits);
        assert_eq!(found.len(), 2);
        for linked in found {
            let along: Vec<f64> = linked.way.iter().map(|(c, _)| middles[*c][0]).collect();
            assert!(!linked.closed && along.len() > 30);
            assert!(along.is_sorted() || along.iter().rev().is_sorted());
            assert!(linked.way.iter().all(|(c, _)| middles[*c][1] == middles[linked.way[0].0][1]));
        }
    }
}
