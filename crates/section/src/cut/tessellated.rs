//! Contours of sections of meshes. They are exact lines and arcs where the facets are those of a drawing. They are a
//! row of points where the facets are those of a scan.

use super::plane::Chain;
use super::scan::{CutMesh, ScanRow};
use crate::model::chain::SegmentKind;
use crate::model::flat::{distance, off_line};
use crate::model::prior::{KnownNoise, Prior};
use crate::model::result::{Contour, Join, Options, RowKind, SectionError, Segment};
use crate::row::clean::check;
use crate::row::contour::{contour, contour_with};
use crate::row::direction::from_the_end;
use crate::row::facets::{Item, LineOrArc, Polygon, SHARP_TURN};
use crate::row::sheet::{Sheet, nearest, starts};
use std::cell::OnceCell;
use trueness_geom::plane::PlaneFrame;
use trueness_geom::progress::Progress;

/// A polyline of fewer vertices is taken as it is where no noise is known: points so few tell none.
const MIN_VERTICES_TO_TELL_NOISE: usize = 9;
/// Facets are those of a drawing where this share of the points lies on straight runs or between the chords of arcs.
const MIN_EXACT_SHARE: f64 = 0.3;
/// So many facets and arcs that meet in a turn, but no sharp one, or so many arcs in succession, are chords of a curve.
const MIN_FACETS_AND_ARCS_OF_CURVE: (usize, usize) = (8, 3);

/// The lines, arcs and curves of a chain in which a plane cuts a mesh.
///
/// `frame` is that of the plane; `mesh` the one that the chain was cut from. The chain's points carry no random noise
/// where the facets are those of a drawing. Then the edges of flat faces are lines, exactly, and chords whose ends lie
/// on a circle are an arc. Only the rest is looked at as a row of points; distances up to that between chords and curve
/// are then not told from 0. A chain of many facets of which hardly two follow each other straight or around a circle
/// is that of a scan. So is one of flat faces of many facets beside curves that no edges run along. Then all crossings,
/// moved onto the surface between the vertices, are a row as
/// [`contour`] takes it. Each has the weight that the noise its neighbors share leaves it; so too where `options` give
/// the noise or a continuity. [`Contour::row_kind`] tells which it was.
///
/// Labels, residuals and stations are those of the chain's points. Intervals of joins of exact lines and arcs are where
/// the two are no farther apart than rounding.
/// Chains that are not of the mesh are rows of their points as they are.
///
/// # Errors
/// The errors of [`contour`]; a chain of at least two points has at least a line.
pub fn chain_contour(
    chain: &Chain,
    frame: &PlaneFrame,
    mesh: &CutMesh,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    check(options)?;
    let points: Vec<[f64; 2]> = chain.points.iter().map(|p| frame.flat(*p)).collect();
    if let Some(index) = points.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
        return Err(SectionError::NotFinite { index });
    }
    if points.len() < 2 {
        return Err(SectionError::TooFewPoints { found: points.len() });
    }
    let closed = options.closed.unwrap_or(chain.closed);
    // One direction, whichever the plane is seen from; a loop begins where it did.
    let way: Vec<[f64; 2]> =
        points.iter().copied().chain(points.first().copied().filter(|_| closed)).collect();
    if !from_the_end(&way) {
        return in_direction(points, chain, frame, mesh, closed, options, progress);
    }
    let mut turned = chain.clone();
    turned.points.reverse();
    turned.edges.reverse();
    let kept = usize::from(closed);
    turned.points.rotate_right(kept);
    turned.edges.rotate_right(kept);
    let n = points.len();
    let points = turned.points.iter().map(|p| frame.flat(*p)).collect();
    let found = in_direction(points, &turned, frame, mesh, closed, options, progress)?;
    Ok(if closed { found.begun_later(1) } else { found }.reversed(n))
}

/// The contour of a chain in the direction in which it is looked for.
fn in_direction(
    points: Vec<[f64; 2]>,
    chain: &Chain,
    frame: &PlaneFrame,
    mesh: &CutMesh,
    closed: bool,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Contour, SectionError> {
    let rounding = mesh.rounding();
    let polygon = Polygon::new(&points, closed, rounding);
    let forced = options.noise.is_some() || options.continuity.is_some();
    let scan = OnceCell::new();
    let as_scan = || ScanRow::of(mesh, chain, frame, closed);
    if polygon.at.len() >= 2 && !forced {
        let items = polygon.items(rounding);
        if is_exact(&points, &polygon, &items, mesh)
            && !is_remeshed(&points, &polygon, &items, mesh.scatters)
            && !(mesh.is_quiet()
                && is_even(&points)
                && scan.get_or_init(as_scan).is_smoother_than(&points, &polygon.numbers, closed))
        {
            return Sheet { points: &points, polygon, rounding, options }.contour(&items, progress);
        }
    }
    let ScanRow { kept, points: row, weights, noise } = scan.into_inner().unwrap_or_else(as_scan);
    let own = Options { closed: Some(closed), ordered: true, ..*options };
    let mut places = points.clone();
    kept.iter().zip(&row).for_each(|(i, p)| places[*i] = *p);
    let free_form = mesh.free_form;
    let find = |noise: Option<KnownNoise>| {
        let found = contour_with(&row, &Prior { noise, weights: Some(&weights), free_form }, &own, progress)?;
        let found = Contour { moved: places.clone(), ..found };
        Ok(within_facets(spread(found, &kept, noise, &places), &points))
    };
    let known = KnownNoise::stated(options).or(noise);
    let first = find(known);
    // Where the noise of the whole mesh is not that of the section, this tells its own.
    let unreliable = first.as_ref().map_or(0, |c| c.unreliable.len());
    let most = MAX_KNOWN_NOISES * known.map_or(0.0, |n| n.deviation);
    let found = match options.noise.is_none() && mesh.scatters && known.is_some() && unreliable > 0 {
        true => match find(None) {
            Ok(other) if other.unreliable.len() <= unreliable && other.noise <= most => Ok(other),
            Err(SectionError::Cancelled(e)) => Err(e.into()),
            _ => first,
        },
        false => first,
    };
    match found {
        // A chain too short for a row, as a loop around one vertex, is its lines, whatever the options.
        Err(SectionError::TooFewPoints { .. }) if polygon.at.len() >= 2 => {
            let items = polygon.items(rounding);
            Sheet { points: &points, polygon, rounding, options }.contour(&items, progress)
        }
        found => found,
    }
}

fn is_exact(points: &[[f64; 2]], polygon: &Polygon, items: &[Item], mesh: &CutMesh) -> bool {
    let straight = points.len() - polygon.at.len();
    let chords: usize = items.iter().filter(|i| i.shape != LineOrArc::Line).map(|i| i.to - i.from - 1).sum();
    let enough = |count: usize| count as f64 >= MIN_EXACT_SHARE * points.len() as f64;
    let is_short = polygon.at.len() < MIN_VERTICES_TO_TELL_NOISE && !mesh.scatters;
    is_short || enough(straight + chords) || enough(straight + polygon.round(mesh.rounding()))
}

/// Flat faces of so many facets each, cut at even distances, are those of a mesh of a surface, not of a drawing.
const MIN_STEPS_ON_FLAT_FACE: usize = 8;
/// Distances are even to this factor.
const MAX_EVEN_RATIO: f64 = 4.0;
/// So many percent of the distances are even.
const EVEN_PERCENT: usize = 98;
/// Lines of no more than so many steps are between others. They are chords of curves that the edges do not run along,
/// or the bevels of corners that no edge runs along. Where more chords are those of circles the vertices are a
/// drawing's.
const MAX_SHORT_LINE_STEPS: f64 = 2.5;
/// Where vertices scatter, smooth noise leaves a few crossings on a line or circle by chance, to rounding; those of a drawing are
/// more.
const MIN_POINTS_PER_ITEM: usize = 6;

fn is_remeshed(points: &[[f64; 2]], polygon: &Polygon, items: &[Item], scatters: bool) -> bool {
    let n = points.len();
    let mut sizes: Vec<f64> = points.windows(2).map(|w| distance(w[0], w[1])).collect();
    sizes.sort_by(f64::total_cmp);
    let middle = sizes[sizes.len() / 2];
    let number = |i: usize| polygon.numbers[i % polygon.at.len()];
    let (mut flat, mut short, mut chords) = (0, 0, 0);
    for item in items {
        let steps = (number(item.to) + n - number(item.from)) % n;
        if item.shape != LineOrArc::Line {
            chords += item.to - item.from;
        } else if steps >= MIN_STEPS_ON_FLAT_FACE {
            flat += steps;
        } else if distance(polygon.vertex(item.from), polygon.vertex(item.to))
            <= MAX_SHORT_LINE_STEPS * middle
        {
            short += 1;
        }
    }
    let is_flat = flat as f64 >= MIN_EXACT_SHARE * n as f64 && short > chords;
    scatters && n < MIN_POINTS_PER_ITEM * items.len()
        || n >= 3 * MIN_VERTICES_TO_TELL_NOISE && is_flat && is_even(points)
}

/// Whether a plane cuts the facets at even distances, as those of a mesh of a surface.
fn is_even(points: &[[f64; 2]]) -> bool {
    let mut sizes: Vec<f64> = points.windows(2).map(|w| distance(w[0], w[1])).collect();
    sizes.sort_by(f64::total_cmp);
    sizes[EVEN_PERCENT * (sizes.len() - 1) / 100] <= MAX_EVEN_RATIO * sizes[sizes.len() / 2]
}

/// Noises of the points that a contour was found from, beyond which others lie off it: the contour does not run there.
const OFF_CONTOUR_NOISES: f64 = 20.0;

/// Points of a segment, so many at least, that scatter by more noises than this about it do not follow it.
const MIN_POINTS_AND_NOISES_OF_SCATTER: (usize, f64) = (8, 2.0);

/// Scatter of more than so many known noises hides form.
const MAX_KNOWN_NOISES: f64 = 1.5;

/// Vertices on a curve lie off the chord between their neighbors. A chord between them lies off the curve by a quarter
/// of that. Points within facets are off by no more than the first share of that in the root mean square. They are off
/// by the second at most, and where they lie in and out by turns.
const MAX_SAGITTA_SHARES: [f64; 2] = [0.25, 0.5];
/// Points on edges around and across a curve lie in and out by turns. The products of neighboring distances sum to less
/// than this share of the squares. Products of noise do so once in 300 rows of 80 points.
const MAX_PRODUCT_BY_TURNS: f64 = -0.3;
/// A line or arc that runs along its points is as long as the way through them, to this factor.
const MAX_WAY_RATIO_OF_SEGMENT: f64 = 1.25;

/// Lines and arcs whose points lie off them by no more than facets lie off the curve they stand for run along these. An
/// apparent form there, with the period of the facets, is the facets'. Points of a scan, whose heights are its noise,
/// lie farther off.
fn within_facets(contour: Contour, points: &[[f64; 2]]) -> Contour {
    let (n, mut all) = (points.len(), contour);
    let inner = if all.closed { 0..n } else { 1..n.saturating_sub(1) };
    let mut heights = vec![[0.0_f64; 2]; all.segments.len()];
    let mut ways = vec![0.0; all.segments.len()];
    let mut products = vec![[0.0; 2]; all.segments.len()];
    for i in inner {
        let [a, b, c] = [(i + n - 1) % n, i, (i + 1) % n].map(|i| points[i]);
        let (k, height) = (all.labels[i] as usize, off_line([a, c], b));
        heights[k] = [heights[k][0] + height * height, heights[k][1].max(height)];
        ways[k] += 0.5 * (distance(a, b) + distance(b, c));
        let [off, next] = [i, (i + 1) % n].map(|i| all.residuals[i]);
        products[k] = [products[k][0] + off * next, products[k][1] + off * off];
    }
    let (segments, ends) = (&all.segments, if all.closed { 0.0 } else { 2.0 * all.spacing });
    let runs_along = |k: &usize| {
        let (s, [sum, most], way) = (&segments[*k], heights[*k], ways[*k]);
        let as_long = s.length <= MAX_WAY_RATIO_OF_SEGMENT * way + ends
            && way <= MAX_WAY_RATIO_OF_SEGMENT * s.length + ends;
        let rms = (sum / s.count.max(1) as f64).sqrt();
        let share = MAX_SAGITTA_SHARES[usize::from(products[*k][0] < MAX_PRODUCT_BY_TURNS * products[*k][1])];
        s.geometry.kind() != SegmentKind::Spline
            && as_long
            && s.rms <= share * rms
            && s.max <= MAX_SAGITTA_SHARES[1] * most
    };
    let unreliable = all.unreliable.iter().copied().filter(|k| !runs_along(k)).collect();
    all.unreliable = unreliable;
    all
}

/// A contour found from some of the points, of this noise where it is known, for all of them. Segments that others lie far off are unreliable.
fn spread(found: Contour, kept: &[usize], known: Option<KnownNoise>, points: &[[f64; 2]]) -> Contour {
    let starts: Vec<f64> = starts(&found.segments);
    let n = kept.len();
    let mut all = Contour { row_kind: RowKind::Scan, ..found };
    for list in [&mut all.outliers, &mut all.repeated, &mut all.gaps, &mut all.doubtful, &mut all.straight_on]
    {
        list.iter_mut().for_each(|i| *i = kept[*i]);
    }
    all.bevels = (0..points.len()).filter(|i| kept.binary_search(i).is_err()).collect();
    let own = (all.labels.clone(), all.residuals.clone(), all.stations.clone());
    all.labels = vec![0; points.len()];
    all.residuals = vec![0.0; points.len()];
    all.stations = vec![0.0; points.len()];
    let mut next = 0;
    for i in 0..points.len() {
        if next < n && kept[next] == i {
            (all.labels[i], all.residuals[i], all.stations[i]) = (own.0[next], own.1[next], own.2[next]);
            next += 1;
            continue;
        }
        let around = [own.0[(next + n - 1) % n], own.0[next % n]];
        (all.labels[i], all.stations[i], all.residuals[i]) =
            nearest(&all.segments, &starts, around.into_iter(), points[i]);
    }
    let left_out = |i: &usize| all.outliers.binary_search(i).is_ok() || all.repeated.binary_search(i).is_ok();
    let counted: Vec<usize> = kept.iter().copied().filter(|i| !left_out(i)).collect();
    all.segments.iter_mut().for_each(|s| (s.count, s.rms, s.max) = (0, 0.0, 0.0));
    for i in counted {
        let (segment, off) = (&mut all.segments[all.labels[i] as usize], all.residuals[i]);
        segment.count += 1;
        segment.rms += off * off;
        segment.max = segment.max.max(off.abs());
    }
    all.segments.iter_mut().for_each(|s| s.rms = (s.rms / s.count.max(1) as f64).sqrt());
    let noise = known.map_or(all.noise, |n| all.noise.clamp(n.deviation, MAX_KNOWN_NOISES * n.deviation));
    let most = OFF_CONTOUR_NOISES * noise;
    let scattered = |s: &Segment| {
        s.count >= MIN_POINTS_AND_NOISES_OF_SCATTER.0 && s.rms > MIN_POINTS_AND_NOISES_OF_SCATTER.1 * noise
    };
    let far = all.segments.iter().enumerate().filter(|(_, s)| s.max > most || scattered(s));
    all.unreliable.extend(far.map(|(k, _)| k).collect::<Vec<_>>());
    all.unreliable.sort_unstable();
    all.unreliable.dedup();
    all
}

/// An edge so many times as long as the median of the facets beside it is that of a flat face.
const LONG_EDGE_RATIO: f64 = 8.0;

/// Consecutive items of one treatment: exact, or a curve of segments found from its points.
struct Run {
    items: Vec<Item>,
    curve: Option<Contour>,
}

impl Sheet<'_> {
    fn contour(&self, items: &[Item], progress: &dyn Progress) -> Result<Contour, SectionError> {
        if items.len() == 1 && self.polygon.closed {
            return Ok(self.finish(vec![self.segment(&items[0])], vec![], &[(items[0], 0..1)]));
        }
        let smooth_runs = self.smooth_runs(items);
        let mut runs: Vec<Run> = smooth_runs.into_iter().flat_map(|run| self.without_lines(run)).collect();
        let closed = self.polygon.closed;
        // A run of all facets starts at the corner, if there is one.
        let smooth = |run: &Run| self.is_smooth(&run.items[run.items.len() - 1], &run.items[0]);
        let whole = closed && runs.len() == 1 && smooth(&runs[0]);
        for run in &mut runs {
            if self.is_curve(&run.items) {
                run.curve = Some(self.fit(&run.items, whole, progress)?);
            }
        }
        if let ([run], true) = (&mut runs[..], whole)
            && let Some(found) = run.curve.take()
        {
            let range = 0..found.segments.len();
            let item = Item { from: 0, to: self.polygon.facets(), ..run.items[0] };
            let mut all = self.finish(found.segments, found.joins, &[(item, range)]);
            all.spacing = found.spacing;
            return Ok(all);
        }
        let mut segments: Vec<Segment> = vec![];
        let mut joins: Vec<Option<Join>> = vec![];
        let mut owners: Vec<(Item, std::ops::Range<usize>)> = vec![];
        // The vertex at which each segment ends, and the slack of its direction there.
        let mut ends: Vec<(usize, f64)> = vec![];
        for run in &runs {
            let first = segments.len();
            let (from, to) = (run.items[0].from, run.items[run.items.len() - 1].to);
            let Some(found) = &run.curve else {
                for item in &run.items {
                    owners.push((*item, segments.len()..segments.len() + 1));
                    segments.push(self.segment(item));
                    joins.push(None);
                    ends.push((item.to, 0.0));
                }
                continue;
            };
            segments.extend(found.segments.iter().cloned());
            let last = segments.len() - 1;
            let (start, end) = (segments[last].start, segments[first].end);
            if first == last {
                segments[first].end_at(self.polygon.vertex(from), self.polygon.vertex(to));
            } else {
                segments[first].end_at(self.polygon.vertex(from), end);
                segments[last].end_at(start, self.polygon.vertex(to));
            }
            joins.extend(found.joins.iter().cloned().map(Some));
            joins.push(None);
            let slack = self.chord_turn(&run.items);
            ends.extend((first..=last).map(|_| (to, slack)));
            owners.push((Item { from, to, ..run.items[0] }, first..last + 1));
        }
        let count = if self.polygon.closed { segments.len() } else { segments.len() - 1 };
        let joins = (0..count)
            .map(|k| {
                let after = (k + 1) % segments.len();
                let slack = ends[k].1.max(ends[after].1);
                joins[k]
                    .clone()
                    .unwrap_or_else(|| self.join(&segments[k], &segments[after], ends[k].0, slack))
            })
            .collect();
        Ok(self.finish(segments, joins, &owners))
    }

    fn is_smooth(&self, before: &Item, after: &Item) -> bool {
        debug_assert_eq!(before.to % self.polygon.at.len(), after.from % self.polygon.at.len());
        let at = after.from % self.polygon.at.len();
        self.polygon.turn(at).abs() <= SHARP_TURN
    }

    /// Items between corners. Runs of a closed polygon start at one, if there is any.
    fn smooth_runs(&self, items: &[Item]) -> Vec<Run> {
        let n = items.len();
        let mut items = items.to_vec();
        if self.polygon.closed {
            let corner = (0..n).find(|k| !self.is_smooth(&items[(k + n - 1) % n], &items[*k]));
            items.rotate_left(corner.unwrap_or(0));
            // Numbers go on over the start.
            let mut at = items[0].from;
            for item in &mut items {
                (item.from, item.to) = (at, at + item.to - item.from);
                at = item.to;
            }
        }
        let mut runs: Vec<Run> = vec![];
        for (k, item) in items.iter().enumerate() {
            match runs.last_mut() {
                Some(run) if self.is_smooth(&items[k - 1], item) => run.items.push(*item),
                _ => runs.push(Run { items: vec![*item], curve: None }),
            }
        }
        runs
    }

    /// A run of chords of a curve without the edges of flat faces in it: these are far longer than chords, and lines exactly.
    fn without_lines(&self, run: Run) -> Vec<Run> {
        if !self.is_curve(&run.items) {
            return vec![run];
        }
        let facets = |item: &Item| (item.from..item.to).map(|i| self.polygon.facet_length(i));
        let mut lengths: Vec<f64> = run.items.iter().flat_map(facets).collect();
        lengths.sort_by(f64::total_cmp);
        let long = LONG_EDGE_RATIO * lengths[lengths.len() / 2];
        let is_long = |item: &Item| item.shape == LineOrArc::Line && facets(item).sum::<f64>() > long;
        let parts = run.items.chunk_by(|a, b| !is_long(a) && !is_long(b));
        parts.map(|items| Run { items: items.to_vec(), curve: None }).collect()
    }

    /// Whether items without a corner are chords of a curve.
    fn is_curve(&self, items: &[Item]) -> bool {
        let segments: Vec<Segment> = items.iter().map(|i| self.segment(i)).collect();
        let bent = |w: &[usize]| !self.is_tangent(&segments[w[0]], &segments[w[1]], items[w[1]].from, 0.0);
        let numbers: Vec<usize> = (0..items.len()).collect();
        let turns = numbers.windows(2).filter(|w| bent(w)).count();
        let arcs = items.split(|i| i.shape == LineOrArc::Line).map(<[Item]>::len).max();
        turns >= MIN_FACETS_AND_ARCS_OF_CURVE.0 || arcs.unwrap_or(0) >= MIN_FACETS_AND_ARCS_OF_CURVE.1
    }

    /// Median turn between the facets of a curve.
    fn chord_turn(&self, items: &[Item]) -> f64 {
        let (from, to) = (items[0].from, items[items.len() - 1].to);
        let n = self.polygon.at.len();
        let mut turns: Vec<f64> = (from + 1..to).map(|i| self.polygon.turn(i % n).abs()).collect();
        turns.sort_by(f64::total_cmp);
        turns.get(turns.len() / 2).copied().unwrap_or(0.0)
    }

    /// A curve as a row of points: its vertices, and on long facets places between them.
    fn fit(&self, items: &[Item], closed: bool, progress: &dyn Progress) -> Result<Contour, SectionError> {
        let (from, to) = (items[0].from, items[items.len() - 1].to);
        let n = self.polygon.at.len();
        let mut lengths: Vec<f64> = (from..to).map(|i| self.polygon.facet_length(i)).collect();
        lengths.sort_by(f64::total_cmp);
        let spacing = lengths[lengths.len() / 2];
        let mut off: Vec<f64> = (from + 1..to)
            .map(|i| {
                let shorter = self.polygon.facet_length(i - 1).min(self.polygon.facet_length(i));
                0.125 * shorter * self.polygon.turn(i % n).abs()
            })
            .collect();
        off.sort_by(f64::total_cmp);
        let chordal = off[off.len() / 2].max(self.rounding);
        let mut row = vec![];
        for i in from..to {
            let (a, b) = (self.polygon.vertex(i), self.polygon.vertex(i + 1));
            let parts = (distance(a, b) / spacing).round().clamp(1.0, 1000.0) as usize;
            for k in 0..parts {
                let t = k as f64 / parts as f64;
                row.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
            }
        }
        if !closed {
            row.push(self.polygon.vertex(to));
        }
        let options =
            Options { closed: Some(closed), ordered: true, resolution: Some(chordal), ..*self.options };
        contour(&row, &options, progress)
    }
}

#[cfg(test)]
mod round;
#[cfg(test)]
mod tests;
