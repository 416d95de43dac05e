//! Polygons along the rings of a face, and what they wind around.

use super::chart::Chart;
use super::ring::{Piece, Ring};
use trueness_geom::space::norm;

/// The number of a ring, and of a piece of it.
pub type PieceId = (usize, usize);

/// A side of a polygon; the border lies within its box, widened by the band.
#[derive(Clone, Copy, Debug)]
struct Segment {
    ends: [[f64; 2]; 2],
    band: [f64; 2],
    /// Distance of the border from the straight line through the ends at most.
    width: f64,
    piece: PieceId,
    /// Shares of the edge at its ends; of a straight piece none.
    shares: Option<[f64; 2]>,
}

/// All sides of all rings, in rows by `v`.
#[derive(Clone, Debug)]
pub struct Outline {
    segments: Vec<Segment>,
    window: [[f64; 2]; 2],
    /// The first of `lists` of each row.
    first: Vec<u32>,
    lists: Vec<u32>,
}

/// Halvings of a side after which a place is on the border: the bits of a share.
const MAX_HALVINGS: u32 = 45;
/// The band of half a side: a quarter, and something for what is not parabolic.
const BAND_OF_HALF: f64 = 0.35;
/// Shares of a side at which its distance from the straight line is taken: where the border turns the other way, the middle says nothing.
const WIDTH_SHARES: [f64; 3] = [0.25, 0.5, 0.75];
/// The greatest distance as a multiple of those, so that it holds for the halves of a cubic piece by `WIDTH_OF_HALF` too.
const WIDTH_OF_DISTANCES: f64 = 2.25;
/// The width of half a side: of a parabola it is a quarter, of a cubic piece that turns about its middle as much as the whole.
const WIDTH_OF_HALF: f64 = 0.5;
/// Rounding of parameters, as a share of the window.
const ROUNDED: f64 = 16.0 * f64::EPSILON;
/// Places of a ring that are asked whether they lie as it says: the cost grows with the places of all rings.
const MAX_PLACES_OF_RING: usize = 64;

/// Where a place is to a side.
enum Turn {
    Apart(i32),
    OnBorder,
}

impl Outline {
    /// Of these rings; `at` gives the parameters of a piece at a share of its edge.
    pub fn new(rings: &[Ring], at: impl Fn(PieceId, f64) -> [f64; 2]) -> Outline {
        let mut segments = vec![];
        for (i, ring) in rings.iter().enumerate() {
            for (j, piece) in ring.pieces.iter().enumerate() {
                let places = piece.places();
                for (n, w) in places.windows(2).enumerate() {
                    let shares = match piece {
                        Piece::Edge(s) => Some([s.samples[n].share, s.samples[n + 1].share]),
                        Piece::Straight { .. } => None,
                    };
                    let (ends, piece) = ([w[0].0, w[1].0], (i, j));
                    let width = shares.map_or(0.0, |[from, to]| {
                        let off = |s: &f64| distance(ends, at(piece, from + s * (to - from)));
                        WIDTH_OF_DISTANCES * WIDTH_SHARES.iter().map(off).fold(0.0, f64::max)
                    });
                    segments.push(Segment { ends, band: w[0].1, width, piece, shares });
                }
            }
        }
        let mut window = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for (k, side) in window.iter_mut().enumerate() {
            for s in &segments {
                let [a, b] = s.range(k);
                *side = [side[0].min(a), side[1].max(b)];
            }
            let slack = ROUNDED * side[0].abs().max(side[1].abs());
            segments.iter_mut().for_each(|s| s.band[k] += slack);
        }
        let mut outline = Outline { segments, window, first: vec![], lists: vec![] };
        outline.sort_into_rows();
        outline
    }

    fn sort_into_rows(&mut self) {
        let rows = self.segments.len().clamp(1, 1 << 16);
        let mut pairs: Vec<(u32, u32)> = vec![];
        for (i, s) in self.segments.iter().enumerate() {
            let [a, b] = s.range(1);
            let [from, to] = [a, b].map(|v| self.row(v, rows));
            pairs.extend((from..=to).map(|row| (row as u32, i as u32)));
        }
        pairs.sort_unstable();
        self.first = (0..=rows as u32).map(|row| pairs.partition_point(|p| p.0 < row) as u32).collect();
        self.lists = pairs.into_iter().map(|p| p.1).collect();
    }

    fn row(&self, v: f64, rows: usize) -> usize {
        let [low, high] = self.window[1];
        let share = (v - low) / (high - low);
        // What is not a number goes to the first row.
        ((share * rows as f64).max(0.0) as usize).min(rows - 1)
    }

    /// First and last values of both parameters.
    pub fn window(&self) -> [[f64; 2]; 2] {
        self.window
    }

    /// The area in parameters.
    pub fn area(&self) -> f64 {
        let origin = [self.window[0][0], self.window[1][0]];
        let of = |s: &Segment| {
            let [a, b] = s.ends.map(|p| [p[0] - origin[0], p[1] - origin[1]]);
            0.5 * (a[0] * b[1] - a[1] * b[0])
        };
        self.segments.iter().map(of).sum()
    }

    /// Whether each ring has the face on its left and nothing on its right: one that runs around the face lies in no other one, one around a
    /// hole within one. Decided by the polygons, at several places of each ring, most of which do not lie upon another one.
    pub fn nests(&self) -> bool {
        let rings = self.segments.last().map_or(0, |s| s.piece.0 + 1);
        (0..rings).all(|ring| self.is_placed(ring))
    }

    fn is_placed(&self, ring: usize) -> bool {
        let own: Vec<&Segment> = self.segments.iter().filter(|s| s.piece.0 == ring).collect();
        let Some(first) = own.first() else { return true };
        let origin = first.ends[0];
        let cross = |s: &&Segment| {
            let [a, b] = s.ends.map(|p| [p[0] - origin[0], p[1] - origin[1]]);
            a[0] * b[1] - a[1] * b[0]
        };
        let wanted = i32::from(own.iter().map(cross).sum::<f64>() < 0.0);
        let (mut right, mut wrong) = (0, 0);
        let tried = own.iter().step_by(own.len().div_ceil(MAX_PLACES_OF_RING));
        for place in tried.map(|s| [0, 1].map(|k| 0.5 * (s.ends[0][k] + s.ends[1][k]))) {
            match self.winding_of_others(ring, place) == wanted {
                true => right += 1,
                false => wrong += 1,
            }
        }
        right >= wrong
    }

    /// How often the polygons of the other rings wind around a place.
    fn winding_of_others(&self, ring: usize, p: [f64; 2]) -> i32 {
        let row = self.row(p[1], self.first.len() - 1);
        let listed = &self.lists[self.first[row] as usize..self.first[row + 1] as usize];
        let others = listed.iter().map(|i| &self.segments[*i as usize]).filter(|s| s.piece.0 != ring);
        others.map(|s| s.upward(p)).sum()
    }

    /// Whether the rings wind around a place, or it lies on one; `at` gives the parameters of a piece at a share of its edge.
    pub fn contains(&self, p: [f64; 2], at: impl Fn(PieceId, f64) -> [f64; 2]) -> bool {
        let is_outside = (0..2).any(|k| {
            let [a, b] = self.window[k];
            let slack = ROUNDED * a.abs().max(b.abs());
            !(p[k] >= a - slack && p[k] <= b + slack)
        });
        if is_outside {
            return false;
        }
        let row = self.row(p[1], self.first.len() - 1);
        let mut winding = 0;
        for i in self.first[row]..self.first[row + 1] {
            match self.segments[self.lists[i as usize] as usize].turn(p, &at, MAX_HALVINGS) {
                Turn::Apart(turn) => winding += turn,
                Turn::OnBorder => return true,
            }
        }
        winding > 0
    }

    /// Two edges that cross, by more than `tolerance` in space.
    pub fn crossing(&self, rings: &[Ring], chart: &Chart, tolerance: f64) -> Option<[u32; 2]> {
        let edge = |s: &Segment| match &rings[s.piece.0].pieces[s.piece.1] {
            Piece::Edge(strand) => Some(strand.edge),
            Piece::Straight { .. } => None,
        };
        for row in 0..self.first.len() - 1 {
            let own = &self.lists[self.first[row] as usize..self.first[row + 1] as usize];
            for (n, i) in own.iter().enumerate() {
                let a = &self.segments[*i as usize];
                let Some(edge_a) = edge(a) else { continue };
                for j in &own[n + 1..] {
                    let b = &self.segments[*j as usize];
                    let Some(edge_b) = edge(b) else { continue };
                    if a.crosses(b) && a.depth(b, chart) > tolerance {
                        return Some([edge_a, edge_b]);
                    }
                }
            }
        }
        None
    }
}

/// Distance of a place from the straight line through two others.
fn distance([a, b]: [[f64; 2]; 2], p: [f64; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let side = way[0] * (p[1] - a[1]) - way[1] * (p[0] - a[0]);
    let length = libm::hypot(way[0], way[1]);
    if length > 0.0 { side.abs() / length } else { libm::hypot(p[0] - a[0], p[1] - a[1]) }
}

impl Segment {
    /// Lowest and highest value of a parameter.
    fn range(&self, k: usize) -> [f64; 2] {
        let [a, b] = self.ends;
        [a[k].min(b[k]) - self.band[k], a[k].max(b[k]) + self.band[k]]
    }

    /// How often the ray from a place along `u` is crossed upward.
    fn turn(&self, p: [f64; 2], at: &impl Fn(PieceId, f64) -> [f64; 2], halvings: u32) -> Turn {
        let is_within = (0..2).all(|k| {
            let [low, high] = self.range(k);
            p[k] >= low && p[k] <= high
        });
        let [a, b] = self.ends;
        if is_within {
            match self.shares {
                None if self.is_at(p) => return Turn::OnBorder,
                None => {}
                Some(_) if !self.is_near(p) => {}
                Some(_) if halvings == 0 => return Turn::OnBorder,
                Some([from, to]) => {
                    let middle = 0.5 * (from + to);
                    let m = at(self.piece, middle);
                    let band = self.band.map(|b| (BAND_OF_HALF * b).max(f64::EPSILON));
                    let halves = [([a, m], [from, middle]), ([m, b], [middle, to])];
                    let mut sum = 0;
                    for (ends, shares) in halves {
                        let width = WIDTH_OF_HALF * self.width;
                        let half = Segment { ends, band, width, piece: self.piece, shares: Some(shares) };
                        match half.turn(p, at, halvings - 1) {
                            Turn::Apart(turn) => sum += turn,
                            Turn::OnBorder => return Turn::OnBorder,
                        }
                    }
                    return Turn::Apart(sum);
                }
            }
        }
        Turn::Apart(self.upward(p))
    }

    /// How often the straight line between its ends crosses the ray from a place along `u` upward.
    fn upward(&self, p: [f64; 2]) -> i32 {
        let [a, b] = self.ends;
        let side = (b[0] - a[0]) * (p[1] - a[1]) - (p[0] - a[0]) * (b[1] - a[1]);
        match (a[1] <= p[1], b[1] <= p[1]) {
            (true, false) if side > 0.0 => 1,
            (false, true) if side < 0.0 => -1,
            _ => 0,
        }
    }

    /// Whether a place is on the straight line between its ends, up to its band.
    fn is_at(&self, p: [f64; 2]) -> bool {
        let [a, b] = self.ends;
        let way = [b[0] - a[0], b[1] - a[1]];
        let off = [p[0] - a[0], p[1] - a[1]];
        let side = way[0] * off[1] - way[1] * off[0];
        side.abs() <= way[0].abs() * self.band[1] + way[1].abs() * self.band[0]
    }

    /// Whether the border may pass by a place on either side. From outside of a convex part of the plane it winds as the straight line does.
    fn is_near(&self, p: [f64; 2]) -> bool {
        let [a, b] = self.ends;
        let way = [b[0] - a[0], b[1] - a[1]];
        let rounded = [0, 1].map(|k| ROUNDED * a[k].abs().max(b[k].abs()));
        let side = way[0] * (p[1] - a[1]) - way[1] * (p[0] - a[0]);
        let most =
            libm::hypot(way[0], way[1]) * self.width + way[0].abs() * rounded[1] + way[1].abs() * rounded[0];
        side.abs() <= most || side.is_nan()
    }

    fn crosses(&self, other: &Segment) -> bool {
        let side = |[a, b]: [[f64; 2]; 2], p: [f64; 2]| {
            (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        };
        let parts = |s: &Segment, o: &Segment| side(s.ends, o.ends[0]) * side(s.ends, o.ends[1]) < 0.0;
        parts(self, other) && parts(other, self)
    }

    /// How far the nearest of four ends is from the other side, in space, beyond what bands leave open.
    fn depth(&self, other: &Segment, chart: &Chart) -> f64 {
        let sizes = chart.jet(self.ends[0]).first.map(norm);
        let to_line = |s: &Segment, p: [f64; 2]| {
            let [a, b] = s.ends.map(|e| [sizes[0] * e[0], sizes[1] * e[1]]);
            let q = [sizes[0] * p[0], sizes[1] * p[1]];
            let way = [b[0] - a[0], b[1] - a[1]];
            let length = libm::hypot(way[0], way[1]);
            ((way[0] * (q[1] - a[1]) - way[1] * (q[0] - a[0])) / length).abs()
        };
        let nearest = [
            to_line(self, other.ends[0]),
            to_line(self, other.ends[1]),
            to_line(other, self.ends[0]),
            to_line(other, self.ends[1]),
        ];
        let bands: f64 = (0..2).map(|k| sizes[k] * (self.band[k] + other.band[k])).sum();
        nearest.into_iter().fold(f64::INFINITY, f64::min) - bands
    }
}
