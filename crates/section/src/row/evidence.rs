//! Whether a cover of exact points by lines and arcs is told by these, or by chance.

use super::facets::{Item, LineOrArc, Polygon, SHARP_TURN, round};
use crate::model::flat::{angle, distance};

/// A cover is no chance where so many coincidences among as many points are less likely than e to the power of minus this.
const MIN_CHANCE_EXPONENT: f64 = 5.0;
/// A coincidence is one to within rounding of this share of the median chord. The scale is less where vertices lie
/// nearer to the chord between their neighbors, and these are no corners of a few sides. It is also less where they lie
/// nearer to one circle.
pub(super) const COINCIDENCE_SHARE: f64 = 0.25;
/// So many vertices between lines of one chord are no corners of a few sides.
const MIN_VERTICES_OF_SCALE: usize = 3;
/// A segment ends where the next vertex lies off it by more than so many roundings.
const END_ROUNDINGS: f64 = 5.0;
/// Between points that are not at joins chords are as long as those beside, to this factor.
pub(super) const MAX_NEIGHBOR_CHORD_RATIO: f64 = 2.0;
/// A chord over missing vertices is one over a whole number of the others, to this share of one.
const WHOLE_MULTIPLE_SHARE: f64 = 0.02;
/// Curves touch each other to within so many roundings.
const TOUCH_ROUNDINGS: f64 = 4.0;

/// A line or an arc between two vertices, and the facts known of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub item: Item,
    /// Directions at its ends.
    pub along: [[f64; 2]; 2],
    /// Uncertainty of these, radians.
    pub slack: f64,
    /// Coordinates of its own that it explains, its curvature taken off.
    pub saves: f64,
    /// Cost by which covers that save as much are told apart.
    pub uneven: f64,
}

impl Piece {
    pub fn is_arc(&self) -> bool {
        self.item.shape != LineOrArc::Line
    }
    pub fn chords(&self) -> usize {
        self.item.to - self.item.from
    }
    /// Whether it goes on into another one with the same direction.
    pub fn is_tangent(&self, next: &Piece) -> bool {
        // Two chords of an arc prove an arc beside as little as that proves them: so any smooth curve is covered.
        let proves = |p: &Piece| p.chords() > 2 || !p.is_arc();
        (self.is_arc() || next.is_arc())
            && (proves(self) || proves(next))
            && angle(self.along[1], next.along[0]).abs() <= self.slack + next.slack
    }
}

/// Whether the points tell these pieces.
pub(super) fn is_evident(polygon: &Polygon, pieces: &[Piece], rounding: f64) -> bool {
    let seen = PieceCover { polygon, pieces, rounding };
    let is_a_cover = || seen.is_no_chance() && seen.is_no_curve() && seen.all_end();
    seen.has_an_arc() && is_a_cover() && seen.joins_at_points() && seen.is_no_circle()
}

/// Whether so many coincidences are none of chance where so many are expected, by the upper tail of the binomial distribution. One is no evidence: the
/// four corners of a rectangle lie on a circle.
pub(super) fn is_no_chance(saved: f64, expected: f64) -> bool {
    saved >= 2.0 && saved * (libm::log(saved / expected) - 1.0) >= MIN_CHANCE_EXPONENT
}

struct PieceCover<'a> {
    polygon: &'a Polygon,
    pieces: &'a [Piece],
    rounding: f64,
}

impl PieceCover<'_> {
    /// The pieces before and after one.
    fn neighbors(&self, k: usize) -> [Option<&Piece>; 2] {
        let n = self.pieces.len();
        if self.polygon.closed && n > 1 {
            return [Some(&self.pieces[(k + n - 1) % n]), Some(&self.pieces[(k + 1) % n])];
        }
        [k.checked_sub(1).and_then(|k| self.pieces.get(k)), self.pieces.get(k + 1)]
    }

    /// Whether a piece goes on into those before and after it with the same direction.
    fn tangent(&self, k: usize) -> [bool; 2] {
        let [before, after] = self.neighbors(k);
        let own = &self.pieces[k];
        [before.is_some_and(|b| b.is_tangent(own)), after.is_some_and(|a| own.is_tangent(a))]
    }

    /// Points that lie on a piece though they need not: beyond the two of a line, and the three of a circle. The four corners of a trapezoid
    /// with equal legs always lie on one, as of any symmetric curve.
    fn explains(&self, piece: &Piece) -> f64 {
        let beyond = piece.chords().saturating_sub(if piece.is_arc() { 2 } else { 1 });
        let chord = |k: usize| self.polygon.facet_length(piece.item.from + k);
        let same = |a: f64, b: f64| (a - b).abs() <= TOUCH_ROUNDINGS * self.rounding;
        let is_trapezoid =
            piece.is_arc() && piece.chords() == 3 && same(chord(0), chord(2)) && !same(chord(0), chord(1));
        if is_trapezoid { 0.0 } else { beyond as f64 }
    }

    /// Distance of the points from one circle, as of a round part that scatters.
    fn off_one_circle(&self) -> f64 {
        let points = &self.polygon.at;
        let Some((center, radius)) = round(points) else { return f64::INFINITY };
        let sum: f64 = points.iter().map(|p| (distance(center, *p) - radius).powi(2)).sum();
        (sum / points.len() as f64).sqrt()
    }

    /// Four points of a circle, or three of one that is tangent to its neighbor.
    fn has_an_arc(&self) -> bool {
        let arc = |(k, p): (usize, &Piece)| p.is_arc() && (p.chords() > 2 || self.tangent(k) == [true; 2]);
        self.pieces.iter().enumerate().any(arc)
    }

    /// Whether so many coincidences as the cover saves are none of chance.
    fn is_no_chance(&self) -> bool {
        let n = self.pieces.len();
        let count = self.polygon.at.len() as f64;
        let joins = if self.polygon.closed { n } else { n - 1 };
        let tangent = (0..joins).filter(|k| self.tangent(*k)[1]).count() as f64;
        let saved = tangent + self.pieces.iter().map(|p| self.explains(p)).sum::<f64>();
        let mut chords: Vec<f64> = (0..self.polygon.facets()).map(|i| self.polygon.facet_length(i)).collect();
        chords.sort_by(f64::total_cmp);
        let mut scale = COINCIDENCE_SHARE * chords[chords.len() / 2];
        // Hardly a vertex of a row with noise is explained: these lie off each other by the noise.
        let plain = |k: usize| self.pieces[k % n].chords() == 1 && self.pieces[(k + 1) % n].chords() == 1;
        let height = |k: usize| {
            let at = self.pieces[k].item.to;
            let [a, b, c] = [at - 1, at, at + 1].map(|i| self.polygon.vertex(i));
            let whole = distance(a, c).max(f64::MIN_POSITIVE);
            ((c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0])).abs() / whole
        };
        let mut free: Vec<f64> = (0..joins).filter(|k| plain(*k)).map(height).collect();
        if free.len() >= MIN_VERTICES_OF_SCALE {
            free.sort_by(f64::total_cmp);
            scale = scale.min(free[free.len() / 2]);
        }
        // An arc and its chord have all their points on one circle.
        if self.polygon.closed && (n > 2 || self.pieces.iter().all(Piece::is_arc)) {
            scale = scale.min(self.off_one_circle());
        }
        let expected = count * self.rounding / scale.max(f64::MIN_POSITIVE);
        is_no_chance(saved, expected)
    }

    /// Whether nowhere three chords turn gently into each other: these are those of a curve.
    fn is_no_curve(&self) -> bool {
        let n = self.pieces.len();
        let is_chord = |k: usize| !self.pieces[k % n].is_arc() && self.pieces[k % n].chords() == 1;
        let turn = |k: usize| angle(self.pieces[k % n].along[1], self.pieces[(k + 1) % n].along[0]).abs();
        let last = if self.polygon.closed { n } else { n.saturating_sub(2) };
        !(0..last).any(|k| (k..k + 3).all(is_chord) && turn(k).max(turn(k + 1)) <= SHARP_TURN)
    }

    /// Whether each segment of more than two points ends for certain: the vertices beyond its ends lie off it. Where a smooth curve is covered by
    /// arcs they hardly do.
    fn all_end(&self) -> bool {
        let n = self.polygon.at.len();
        let ends = |(k, piece): (usize, &Piece)| {
            let [before, after] = self.neighbors(k);
            let beyond = [before.map(|_| piece.item.from + n - 1), after.map(|_| piece.item.to + 1)]
                .into_iter()
                .flatten();
            // One chord closes an arc: the piece beyond is its other end.
            let own = |i: usize| (i + n - piece.item.from % n) % n <= piece.chords();
            piece.chords() < 2
                || beyond.filter(|i| !own(*i)).all(|i| self.off(piece, i) > END_ROUNDINGS * self.rounding)
        };
        self.pieces.iter().enumerate().all(ends)
    }

    /// Distance of a vertex from the line or circle of a piece.
    fn off(&self, piece: &Piece, i: usize) -> f64 {
        let p = self.polygon.vertex(i);
        match piece.item.shape {
            LineOrArc::Arc(center, curvature) => (distance(center, p) - 1.0 / curvature.abs()).abs(),
            LineOrArc::Line => {
                let (a, u) = (self.polygon.vertex(piece.item.from), piece.along[0]);
                (u[0] * (p[1] - a[1]) - u[1] * (p[0] - a[0])).abs()
            }
        }
    }

    /// Whether joins lie at points. Where they lie between points, the chord over a join is none of the segments. The
    /// ones on both sides of it touch each other, or may cross in it, and it is no longer than the chords beside.
    fn joins_at_points(&self) -> bool {
        (0..self.pieces.len()).all(|k| {
            let chord = &self.pieces[k];
            let [Some(before), Some(after)] = self.neighbors(k) else { return true };
            // Only of an arc and its chord alone it is asked whether they are a circle.
            let is_only_chord = self.polygon.closed && self.pieces.len() == 2;
            if is_only_chord || chord.chords() > 1 || self.tangent(k) == [true; 2] {
                return true;
            }
            let several = [before, after].map(|p| p.chords() > 1);
            let step =
                |p: &Piece, at: usize| if p.chords() > 1 { self.polygon.facet_length(at) } else { 0.0 };
            let near = step(before, before.item.to - 1).max(step(after, after.item.from));
            if several == [false; 2]
                || self.polygon.facet_length(chord.item.from) > MAX_NEIGHBOR_CHORD_RATIO * near
            {
                return true;
            }
            several != [true; 2] && !self.touch(before, after)
        })
    }

    /// Whether the circles or lines of two pieces touch each other.
    fn touch(&self, a: &Piece, b: &Piece) -> bool {
        let most = TOUCH_ROUNDINGS * self.rounding;
        match (a.item.shape, b.item.shape) {
            (LineOrArc::Line, LineOrArc::Line) => false,
            (LineOrArc::Arc(c, k), LineOrArc::Arc(d, m)) => {
                let (apart, r, s) = (distance(c, d), 1.0 / k.abs(), 1.0 / m.abs());
                (apart - (r + s)).abs().min((apart - (r - s).abs()).abs()) <= most
            }
            (LineOrArc::Arc(c, k), LineOrArc::Line) => self.touches(b, c, k, most),
            (LineOrArc::Line, LineOrArc::Arc(c, k)) => self.touches(a, c, k, most),
        }
    }

    fn touches(&self, line: &Piece, center: [f64; 2], curvature: f64, most: f64) -> bool {
        let (a, u) = (self.polygon.vertex(line.item.from), line.along[0]);
        let off = (u[0] * (center[1] - a[1]) - u[1] * (center[0] - a[0])).abs();
        (off - 1.0 / curvature.abs()).abs() <= most
    }

    /// Whether one arc and one chord of its circle are no whole circle, or regular polygon. The chord is far longer
    /// than those of the arc. Or these are even to rounding, and no whole number of them goes into the chord.
    fn is_no_circle(&self) -> bool {
        let [a, b] = self.pieces else { return self.pieces.len() > 1 };
        if !self.polygon.closed || a.is_arc() == b.is_arc() {
            return true;
        }
        let (arc, line) = if a.is_arc() { (a, b) } else { (b, a) };
        let LineOrArc::Arc(_, curvature) = arc.item.shape else { return true };
        let chords = || (arc.item.from..arc.item.to).map(|i| self.polygon.facet_length(i));
        let (least, longest) = chords().fold((f64::INFINITY, 0.0_f64), |(a, b), c| (a.min(c), b.max(c)));
        let own = self.polygon.facet_length(line.item.from);
        let half_turn = |chord: f64| libm::asin((0.5 * chord * curvature.abs()).min(1.0));
        let fits = half_turn(own) / half_turn(longest);
        let is_uneven = longest - least > TOUCH_ROUNDINGS * self.rounding
            || (fits - fits.round()).abs() < WHOLE_MULTIPLE_SHARE;
        own > MAX_NEIGHBOR_CHORD_RATIO * longest || fits > 1.0 && !is_uneven
    }
}
