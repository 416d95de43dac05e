//! Points of a row that belong to no contour, told by the row alone: header rows, fillers, points far off.
//!
//! A contour's points follow each other by steps of like length. A stray point is as far off as nothing else: few
//! points without which the longest step of the way is many times shorter. The criterion is therefore a ratio of two
//! steps of one row, whatever its size. A long step may be right, too. The far end of a line that is given by its ends
//! alone goes straight on. The last corner of a closed row is near the first point. Where a step is long and neither
//! holds, the point may be left out. The rest of the row must be far smaller than the way to it. Else it is listed as
//! doubtful: nothing is lost in silence.

mod ends;
mod limits;

use crate::model::flat::{angle, distance};
use ends::{End, Scatter};
use limits::{BENT_TURN_SHARE, FAR_STEP_RATIO, MIN_POINTS_TO_TELL_STRAYS, STRAIGHT_TURN};

/// Points of a row that lie off it, by their numbers, ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Strays {
    /// They are none of the contour's.
    pub out: Vec<usize>,
    /// They may be.
    pub doubtful: Vec<usize>,
    /// They are as far off, and lie where the row leads straight on.
    pub straight_on: Vec<usize>,
}

/// The verdict on a run of few points.
enum Verdict {
    Stray,
    Doubtful,
    StraightOn,
    Sound,
}

/// Without a stray the longest step is so many times shorter. Among 200 rows of even, cosine and random spacing without a stray
/// none came to 4.
const LONG_STEP_RATIO: f64 = 8.0;
/// Strays follow each other in runs of so many points; more are a piece of the contour beyond a gap.
const MIN_POINTS_OF_PIECE: usize = 2;
/// Strays are this share of a row at most.
const MAX_STRAY_SHARE: f64 = 0.05;
/// So many strays are allowed in any row; no more than these follow each other.
const MIN_STRAYS_ALLOWED: usize = 3;
/// A line is at most so many times as long as the row that it leads to.
const MAX_LINE_LENGTH_RATIO: f64 = 100.0;

impl Strays {
    /// The strays of a row; points that repeat the one before are as it is.
    pub fn of(points: &[[f64; 2]]) -> Strays {
        let mut groups: Vec<Vec<usize>> = vec![];
        for (i, p) in points.iter().enumerate() {
            match groups.last_mut().filter(|g| points[g[0]] == *p) {
                Some(group) => group.push(i),
                None => groups.push(vec![i]),
            }
        }
        let mut rest: Vec<usize> = (0..groups.len()).collect();
        let most = MIN_STRAYS_ALLOWED.max((MAX_STRAY_SHARE * rest.len() as f64) as usize);
        let mut found = Strays::default();
        // Behind a stray of a thousand times the row's size may be one of twice.
        while found.count() < most {
            let way: Vec<[f64; 2]> = rest.iter().map(|g| points[groups[*g][0]]).collect();
            let Some(strays) = Way(&way).strays(most - found.count()) else { break };
            let numbers =
                |list: &[usize]| list.iter().flat_map(|k| groups[rest[*k]].clone()).collect::<Vec<_>>();
            found.out.extend(numbers(&strays.out));
            found.doubtful.extend(numbers(&strays.doubtful));
            found.straight_on.extend(numbers(&strays.straight_on));
            let seen = |k: &usize| {
                [&strays.out, &strays.doubtful, &strays.straight_on].iter().any(|list| list.contains(k))
            };
            rest = (0..rest.len()).filter(|k| !seen(k)).map(|k| rest[k]).collect();
        }
        found.beside_the_ends(points, &groups, most);
        [&mut found.out, &mut found.doubtful, &mut found.straight_on]
            .into_iter()
            .for_each(|list| list.sort_unstable());
        found
    }
}

impl Strays {
    /// Adds the points beside an end of the row.
    fn beside_the_ends(&mut self, points: &[[f64; 2]], groups: &[Vec<usize>], most: usize) {
        let passed = |g: &&Vec<usize>| !self.out.contains(&g[0]) && !self.straight_on.contains(&g[0]);
        let mut kept: Vec<&Vec<usize>> = groups.iter().filter(passed).collect();
        let row = |kept: &[&Vec<usize>]| kept.iter().map(|g| points[g[0]]).collect::<Vec<_>>();
        let scatter = Scatter::of(&row(&kept));
        for _ in 0..2 {
            kept.reverse();
            let Some(end) = kept.first() else { return };
            match ends::judge_first(&row(&kept), scatter) {
                End::Stray if self.doubtful.contains(&end[0]) || self.count() < most => {
                    self.doubtful.retain(|i| !end.contains(i));
                    self.out.extend(*end);
                    kept.remove(0);
                }
                End::Doubtful if !self.doubtful.contains(&end[0]) && self.count() < most => {
                    self.doubtful.extend(*end);
                }
                _ => (),
            }
        }
    }

    fn count(&self) -> usize {
        self.out.len() + self.doubtful.len() + self.straight_on.len()
    }
}

/// A row whose points differ from those before.
struct Way<'a>(&'a [[f64; 2]]);

/// Few points between long steps.
#[derive(Clone, Copy, Debug)]
struct Run {
    from: usize,
    to: usize,
}

/// Runs of so few points that they may be stray, and the pieces of the contour. Short runs one behind another are a piece that is sparser
/// than the rest, where they are too many for strays.
fn parted(runs: Vec<Run>) -> (Vec<Run>, Vec<Run>) {
    let is_short = |r: &Run| r.to - r.from < MIN_POINTS_OF_PIECE;
    let (mut short, mut main) = (vec![], vec![]);
    for group in runs.chunk_by(|a, b| is_short(a) && is_short(b)) {
        let (first, last) = (group[0], group[group.len() - 1]);
        match is_short(&first) && last.to - first.from < MIN_STRAYS_ALLOWED {
            true => short.extend(group),
            false => main.push(Run { from: first.from, to: last.to }),
        }
    }
    (short, main)
}

/// The row without its strays.
struct Rest {
    runs: Vec<Run>,
    /// The longest step.
    longest: f64,
    /// Diagonal of the box around its points.
    size: f64,
    count: usize,
    closes: bool,
}

impl Way<'_> {
    /// The strays that the fewest long steps part from the rest; `None` where there are none.
    fn strays(&self, most: usize) -> Option<Strays> {
        let steps: Vec<f64> = self.0.windows(2).map(|w| distance(w[0], w[1])).collect();
        let mut order: Vec<usize> = (0..steps.len()).collect();
        order.sort_by(|a, b| steps[*b].total_cmp(&steps[*a]).then(a.cmp(b)));
        for cuts in 1..=(2 * most).min(order.len().saturating_sub(1)) {
            if steps[order[cuts - 1]] < FAR_STEP_RATIO * steps[order[cuts]] {
                continue;
            }
            let mut at: Vec<usize> = order[..cuts].to_vec();
            at.sort_unstable();
            let found = self.cut(&at, most);
            if found.count() > 0 {
                return Some(found);
            }
        }
        None
    }

    /// The strays among the runs that the row falls into at the steps behind the points `at`.
    fn cut(&self, at: &[usize], most: usize) -> Strays {
        let starts = std::iter::once(0).chain(at.iter().map(|i| i + 1));
        let ends = at.iter().copied().chain(std::iter::once(self.0.len() - 1));
        let runs: Vec<Run> = starts.zip(ends).map(|(from, to)| Run { from, to }).collect();
        let (short, main) = parted(runs);
        let strays: usize = short.iter().map(|r| r.to + 1 - r.from).sum();
        if short.is_empty() || main.is_empty() || strays > most {
            return Strays::default();
        }
        let rest = self.rest(main);
        let mut found = Strays::default();
        for run in &short {
            let list = match self.judge(run, &rest) {
                Verdict::Stray => &mut found.out,
                Verdict::Doubtful => &mut found.doubtful,
                Verdict::StraightOn => &mut found.straight_on,
                Verdict::Sound => continue,
            };
            list.extend(run.from..=run.to);
        }
        found
    }

    fn rest(&self, runs: Vec<Run>) -> Rest {
        let points = || runs.iter().flat_map(|r| &self.0[r.from..=r.to]).copied();
        let way: Vec<[f64; 2]> = points().collect();
        let longest = way.windows(2).map(|w| distance(w[0], w[1])).fold(0.0, f64::max);
        let closes = way.len() > 2 && distance(way[0], way[way.len() - 1]) <= FAR_STEP_RATIO * longest;
        Rest { longest, size: super::clean::size(&way), count: way.len(), closes, runs }
    }

    /// The verdict on a run, where the rest of the row is known.
    fn judge(&self, run: &Run, rest: &Rest) -> Verdict {
        let [Some(first), Some(last)] = [rest.runs.first(), rest.runs.last()] else { return Verdict::Sound };
        let tip = self.0[run.from];
        let jumps = [run.from.checked_sub(1).map(|i| (i, run.from)), Some((run.to, run.to + 1))];
        let jumps = jumps.into_iter().flatten().filter(|(_, j)| *j < self.0.len());
        let jump = jumps.map(|(i, j)| distance(self.0[i], self.0[j])).fold(f64::INFINITY, f64::min);
        let points = rest.runs.iter().flat_map(|r| &self.0[r.from..=r.to]);
        let off = points.map(|p| distance(*p, tip)).fold(f64::INFINITY, f64::min);
        let (far, ratio) = (off > rest.size, jump / rest.longest);
        let is_long =
            if far { ratio >= FAR_STEP_RATIO } else { ratio >= LONG_STEP_RATIO && run.from == run.to };
        if rest.count < MIN_POINTS_TO_TELL_STRAYS[1] || !is_long {
            return Verdict::Sound;
        }
        let certain = ratio >= LONG_STEP_RATIO && rest.count >= MIN_POINTS_TO_TELL_STRAYS[0];
        let verdict = |certain: bool| if certain { Verdict::Stray } else { Verdict::Doubtful };
        if run.from > first.to && run.to < last.from {
            // Two points in succession may be corners of the part as well.
            return verdict(certain && run.from == run.to);
        }
        // The last corner of a closed row is near its first point.
        let (end, other) = if run.to < first.from { (first, last.to) } else { (last, first.from) };
        if distance(self.0[other], tip) <= FAR_STEP_RATIO * rest.longest {
            return Verdict::Sound;
        }
        match self.goes_on(run, end, far) {
            true if !far => Verdict::Sound,
            true if off <= MAX_LINE_LENGTH_RATIO * rest.size => Verdict::StraightOn,
            _ => verdict(certain && (far || rest.closes)),
        }
    }

    /// Whether a point before or behind a run of the contour lies where that leads: straight on, or of one nearby on as it bends.
    fn goes_on(&self, run: &Run, end: &Run, far: bool) -> bool {
        let before = run.to < end.from;
        let (tip, near) = if before {
            (run.to, [end.from, end.from + 1, end.from + 2])
        } else {
            (run.from, [end.to, end.to - 1, end.to.saturating_sub(2)])
        };
        if end.to - end.from < 2 {
            return false;
        }
        let [a, b, c] = near.map(|i| self.0[i]);
        let way = |p: [f64; 2], q: [f64; 2]| [q[0] - p[0], q[1] - p[1]];
        let bend = angle(way(c, b), way(b, a));
        let off = angle(way(b, a), way(a, self.0[tip])) - 0.5 * bend;
        let straight = 0.5 * bend.abs() + STRAIGHT_TURN;
        let gap = distance(a, self.0[tip]) / distance(a, b).max(f64::MIN_POSITIVE);
        let bent = if far { 0.0 } else { (bend.abs() * gap).min(BENT_TURN_SHARE) };
        off.abs() <= straight.max(bent)
    }
}

#[cfg(test)]
mod tests;
