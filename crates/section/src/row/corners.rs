//! Rows of few points that are the corners of a polygon.
//!
//! The polygon through its points is always an exact explanation of a row, with as many lines as points. Lines and arcs
//! of fewer unknowns must earn their place. Three points always have a circle, and smoothness of points that hardly
//! repeat each other says nothing about noise. The evidence is how many points lie on the contour beyond those that
//! determine it, and how near: coincidences that chance does not make. Where there are none, the points are corners,
//! unless they turn gently into each other as those of a curve do.

use super::assembly::Joined;
use super::candidate::{Candidate, Question};
use super::chains;
use super::clean::{Clean, size};
use super::evidence::{COINCIDENCE_SHARE, MAX_NEIGHBOR_CHORD_RATIO, is_no_chance};
use super::facets::{Item, LineOrArc, Polygon, SHARP_TURN, round};
use super::noise_levels::MAX_POINTS_WITH_FORM_IN_NOISE;
use super::polygon::MIN_CORNER_TURN;
use super::sheet::Sheet;
use crate::model::flat::{angle, distance};
use crate::model::prior::Prior;
use crate::model::result::{Contour, Geometry, Options, RowKind, SectionError};
use trueness_geom::progress::Progress;

/// Coordinates are exact to this share of the size.
const EXACT_COORDINATE_SHARE: f64 = 1e-6;
/// Where others turn gently, fewer sharp corners are those of no polygon.
const MIN_SHARP_CORNERS: usize = 3;
/// Corners of one circle lie off it by no more than this share of its radius.
const MAX_OFF_CIRCLE_SHARE: f64 = 1e-3;

/// The circle that the points scatter about where they speak for one, and the contour found is another one.
pub(super) fn propose_circle(
    question: &Question,
    best: Option<&Contour>,
    progress: &dyn Progress,
) -> Result<Option<Candidate>, SectionError> {
    let Some(noise) = Corners::of_question(question).and_then(|corners| corners.off_a_circle(best)) else {
        return Ok(None);
    };
    let options = Options { noise: Some(noise), ..*question.options };
    let scattered = Question::new(question.points, Prior::of(&options), &options, question.budget)?;
    let found = scattered.cheapest(&[chains::propose], progress)?;
    Ok(found.filter(is_round).and_then(Candidate::instead))
}

/// The polygon whose corners the points are, where these speak for no other contour. Where they speak for neither, the
/// contour tells that it may be both.
pub(super) fn propose(
    question: &Question,
    best: Option<&Contour>,
    _: &dyn Progress,
) -> Result<Option<Candidate>, SectionError> {
    let corners = Corners::of_question(question);
    Ok(corners.and_then(|corners| Candidate::instead(corners.or(best.cloned(), question.options))))
}

/// A polygon that a row may be.
struct Corners {
    clean: Clean,
    polygon: Polygon,
    lines: Vec<Item>,
    rounding: f64,
    /// Some of its corners turn gently into each other, as points of a curve do, or hardly at all.
    is_curve: bool,
}

impl Corners {
    /// The polygon of the row that is asked for. Points put in order, of a cloud or a scan, are no corners that
    /// somebody chose.
    fn of_question(question: &Question) -> Option<Corners> {
        let is_given = !question.options.ordered && question.may_be_exact();
        if is_given { Corners::of(&question.clean) } else { None }
    }

    /// The polygon of a row of few points; `None` where it has fewer corners than a polygon.
    fn of(clean: &Clean) -> Option<Corners> {
        let clean = Some(clean).filter(|c| c.points.len() < MAX_POINTS_WITH_FORM_IN_NOISE)?.clone();
        let (n, closed, rounding) =
            (clean.points.len(), clean.closed, EXACT_COORDINATE_SHARE * size(&clean.points));
        let polygon = Polygon { at: clean.points.clone(), numbers: (0..n).collect(), closed };
        let is_straight = |i: usize| {
            let (u, v) = (polygon.facet((i + n - 1) % n), polygon.facet(i));
            let turn = angle(u, v).abs();
            turn < SHARP_TURN
                && libm::sin(turn) * libm::hypot(u[0], u[1]).min(libm::hypot(v[0], v[1])) <= rounding
        };
        let inner = if closed { 0..n } else { 1..n - 1 };
        let bends: Vec<usize> = inner.filter(|i| !is_straight(*i)).collect();
        let ends: Vec<usize> = match closed {
            true => bends.iter().copied().chain(bends.first().map(|i| i + n)).collect(),
            false => std::iter::once(0).chain(bends).chain([n - 1]).collect(),
        };
        let line = |w: &[usize]| Item { shape: LineOrArc::Line, from: w[0], to: w[1] };
        let lines: Vec<Item> = ends.windows(2).map(line).collect();
        let mut corners = Corners { clean, polygon, lines, rounding, is_curve: false };
        let turns = (corners.lines.len() + usize::from(closed)).saturating_sub(1);
        // Points that lie on a side but for their scatter are no corners.
        corners.is_curve = corners.has_a_curve() || (0..turns).any(|k| corners.turn(k) < MIN_CORNER_TURN);
        let sharp = (0..turns).filter(|k| corners.turn(*k) > SHARP_TURN).count();
        (corners.lines.len() > 1 && (!corners.is_curve || sharp >= MIN_SHARP_CORNERS)).then_some(corners)
    }

    /// Whether three chords turn gently into each other.
    fn has_a_curve(&self) -> bool {
        let n = self.lines.len();
        let is_chord = |k: usize| self.lines[k % n].to - self.lines[k % n].from == 1;
        let last = if self.polygon.closed { n } else { n.saturating_sub(2) };
        (0..last).any(|k| (k..k + 3).all(is_chord) && self.turn(k).max(self.turn(k + 1)) <= SHARP_TURN)
    }

    /// Turn from one line to the next.
    fn turn(&self, k: usize) -> f64 {
        let along = |k: usize| {
            let item = self.lines[k % self.lines.len()];
            let (a, b) = (self.polygon.vertex(item.from), self.polygon.vertex(item.to));
            [b[0] - a[0], b[1] - a[1]]
        };
        angle(along(k), along(k + 1)).abs()
    }

    /// The contour found of the same row where coincidences speak for it, or the polygon. Where the points speak for neither, they may be of both.
    fn or(self, found: Option<Contour>, options: &Options) -> Contour {
        match found {
            Some(found) if self.speaks_for(&found) => {
                let may_be_polygon = !self.is_curve && found.closed && is_round(&found);
                Contour { may_be_polygon, ..found }
            }
            Some(found) if self.is_curve => Contour { may_be_polygon: true, ..found },
            _ => Contour { may_be_polygon: self.is_square(), ..self.contour(options) },
        }
    }

    /// The scatter of the points about one circle, where they speak for it and the contour found is another one.
    fn off_a_circle(&self, found: Option<&Contour>) -> Option<f64> {
        let points = &self.polygon.at;
        let (count, (center, radius)) = (points.len() as f64, round(points)?);
        let sum: f64 = points.iter().map(|p| (distance(center, *p) - radius).powi(2)).sum();
        let off = (sum / (count - 3.0).max(1.0)).sqrt().max(self.rounding);
        let speaks = self.is_even() && is_no_chance(count - 3.0, count * off / self.scale());
        (speaks && !found.is_some_and(|f| self.speaks_for(f))).then_some(off)
    }

    /// Whether chords all around are about as long as those beside, as those of points taken along a curve.
    fn is_even(&self) -> bool {
        let n = self.polygon.facets();
        let chords_at = |i: usize| [i, (i + 1) % n].map(|k| self.polygon.facet_length(k));
        self.polygon.closed
            && (0..n).map(chords_at).all(|[a, b]| a.max(b) <= MAX_NEIGHBOR_CHORD_RATIO * a.min(b))
    }

    /// A coincidence is one to within a share of this.
    fn scale(&self) -> f64 {
        let mut chords: Vec<f64> = (0..self.polygon.facets()).map(|i| self.polygon.facet_length(i)).collect();
        chords.sort_by(f64::total_cmp);
        (COINCIDENCE_SHARE * chords[chords.len() / 2]).max(f64::MIN_POSITIVE)
    }

    /// Whether chance does not make so many points lie so near to a contour.
    fn speaks_for(&self, found: &Contour) -> bool {
        let is_curve = found.segments.iter().any(|s| matches!(s.geometry, Geometry::Spline { .. }));
        let count = self.clean.points.len() as f64;
        let expected = count * found.rms().max(self.rounding) / self.scale();
        let saved = count - found.outliers.len() as f64 - found.unknowns;
        found.unreliable.is_empty() && !is_curve && is_no_chance(saved, expected)
    }

    /// Whether the corners are those of a square, or of another regular polygon.
    fn is_square(&self) -> bool {
        let points = &self.polygon.at;
        let chords = || (0..self.polygon.facets()).map(|i| self.polygon.facet_length(i));
        let (least, most) = chords().fold((f64::INFINITY, 0.0_f64), |(a, b), c| (a.min(c), b.max(c)));
        round(points).is_some_and(|(center, radius)| {
            let on = |p: &[f64; 2]| (distance(center, *p) - radius).abs() <= MAX_OFF_CIRCLE_SHARE * radius;
            self.polygon.closed && most - least <= MAX_OFF_CIRCLE_SHARE * radius && points.iter().all(on)
        })
    }

    /// The polygon.
    fn contour(self, options: &Options) -> Contour {
        let Corners { clean, polygon, lines, rounding, .. } = self;
        let total = clean.numbers.iter().chain(&clean.repeated).max().map_or(0, |i| i + 1);
        let contour = Sheet { points: &clean.points, polygon, rounding, options }.exact(&lines);
        let mut all = Joined::of(Contour { row_kind: RowKind::Row, ..contour });
        all.finish(&clean, 0, total, vec![]);
        all.contour
    }
}

/// Whether a contour is one circle.
fn is_round(found: &Contour) -> bool {
    matches!(found.segments[..], [ref s] if matches!(s.geometry, Geometry::Arc { .. }))
}
