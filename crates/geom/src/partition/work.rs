//! Which faces points may be of, and which explains each best.

use super::best::{Best, Candidate};
use super::continuation::Sure;
use super::faces::Face;
use super::facing::Facing;
use super::placed::Placed;
use super::terms::{Beyond, EXPLAINED_SIGMAS};
use crate::parallel::prelude::*;
use crate::space::{Point, Vector, dot};
use std::collections::BTreeMap;

/// Reaches from the nominal within which a face is looked for: the reach is about where it really is.
pub(super) const SEARCH_REACHES: f64 = 2.0;
/// Cost of a point for each spacing beyond a border. Borders move with the faces that make them, and are known no sharper.
const COST_PER_SPACING_BEYOND: f64 = 2.0;
/// Spacings from an edge up to which scans may round it. The edge may lie so far beyond the points that were found to belong to
/// an element.
pub(super) const ROUNDED_EDGE_SPACINGS: f64 = 3.0;
/// Distances of neighbors beyond a border that cost nothing.
const FREE_SPACINGS: f64 = 0.3;
/// A point is asked again, by the points around it, where the second of its faces costs less.
const MAX_RIVAL_COST: f64 = 6.0 * EXPLAINED_SIGMAS;
/// It is asked again too where its best face costs more.
const MIN_ASKED_COST: f64 = 0.6 * EXPLAINED_SIGMAS;
/// A corner of facets belongs to each face that costs at most so much more than its best one: at a sharp edge to two.
const MAX_SHARED_COST: f64 = 3.0;
/// Cosine of the angle (120°) from which on faces are the two sides of a wall.
const OPPOSITE_FACE_COSINE: f64 = -0.5;
/// Cosine of the angle (37°) up to which a sure point faces as its face does.
const FACING_POINT_COSINE: f64 = 0.8;
/// Spacings from the border from which on points surely belong to a face: the first of these that leaves enough points.
pub(super) const SURE_BORDER_SPACINGS: [f64; 3] = [2.5, 1.5, 0.75];
/// Points of a face from which on it was scanned: fewer may be probed one by one, each on purpose.
pub(super) const MIN_SCANNED_POINTS: usize = 200;
/// Least sure points that are enough.
pub(super) const MIN_SURE_POINTS: usize = 20;

/// Points and the faces that they may be of.
pub(super) struct Work<'a> {
    pub points: &'a [Point],
    pub faces: &'a [&'a Face],
    /// The reach of each face.
    pub reach: Vec<f64>,
    pub candidates: Vec<Vec<Candidate>>,
    pub spacing: f64,
    /// Of each point, how far off it is the nearest face over which it lies.
    pub least: Vec<f64>,
}

/// Of each of so many points, how far off it is the nearest face over which it lies; infinite where it lies over none.
pub(super) fn least_off(count: usize, candidates: &[Vec<Candidate>]) -> Vec<f64> {
    let mut least = vec![f64::INFINITY; count];
    for c in candidates.iter().flatten().filter(|c| c.seat.within() > 0.0) {
        let least = &mut least[c.point as usize];
        *least = least.min(c.seat.off.abs());
    }
    least
}

impl Work<'_> {
    /// The points that surely belong to each face. It is the nearest of those over which they lie, they face as it does and lie
    /// clear of its border.
    pub(super) fn sure(&self, facing: Option<&Facing>) -> Vec<Vec<Candidate>> {
        let clear = |near: &[Candidate], reach: f64, times: f64| -> Vec<Candidate> {
            let is_own = |c: &&Candidate| {
                let (p, off) = (c.point as usize, c.seat.off.abs());
                c.seat.within() > times * self.spacing
                    && off <= reach.min(self.least[p])
                    && facing.is_none_or(|f| dot(f.vertices[p], c.seat.normal()) > FACING_POINT_COSINE)
            };
            near.iter().filter(is_own).copied().collect()
        };
        let of_face = |(near, reach): (&Vec<Candidate>, &f64)| {
            let mut found = vec![];
            for times in SURE_BORDER_SPACINGS {
                found = clear(near, *reach, times);
                if found.len() >= MIN_SURE_POINTS {
                    break;
                }
            }
            found
        };
        self.candidates.par_iter().zip(&self.reach).map(of_face).collect()
    }

    /// In a cloud with few points over each face, as a probe takes them, their deviation is not known where they are fewest.
    /// All within the reach is explained. Where a scan has few over a face, the face was hidden.
    pub(super) fn sparse(&self, is_cloud: bool) -> Vec<Option<f64>> {
        let over = |(near, reach): (&Vec<Candidate>, &f64)| {
            let is_over = |c: &&Candidate| c.seat.within() >= 0.0 && c.seat.off.abs() <= *reach;
            near.iter().filter(is_over).take(MIN_SCANNED_POINTS).count()
        };
        let counts: Vec<usize> = self.candidates.par_iter().zip(&self.reach).map(over).collect();
        let is_probed = is_cloud && counts.iter().all(|count| *count < MIN_SCANNED_POINTS);
        let probed =
            |(count, reach): (&usize, &f64)| (is_probed && *count < MIN_SURE_POINTS).then_some(*reach);
        counts.iter().zip(&self.reach).map(probed).collect()
    }

    /// The face of each point by the distance from where the faces really are.
    pub(super) fn by_faces(&self, placed: &[Placed], noise: f64) -> Best {
        let mut best = Best::new(self.points.len());
        for (number, face) in self.faces.iter().enumerate() {
            let scale = placed[number].deviation.max(noise);
            for c in &self.candidates[number] {
                let off = placed[number].off(face, self.points[c.point as usize], c.seat).abs();
                let is_there =
                    c.seat.within() > -FREE_SPACINGS * self.spacing || off <= EXPLAINED_SIGMAS * scale;
                if is_there && off <= self.reach[number] && self.may_own(&placed[number], c) {
                    best.add(c, number as u32, off / scale + self.beyond(c.seat.within()));
                }
            }
        }
        best
    }

    /// Whether a face may have a point. One without sure points is known by its nominal alone, and explains all within its reach: it has what no
    /// other face is nearer to.
    fn may_own(&self, placed: &Placed, c: &Candidate) -> bool {
        placed.points > 0 || c.seat.off.abs() <= self.least[c.point as usize]
    }

    /// Tells how far off points lie from the nearest face adjacent to their own. They lie over that face, or hardly beyond its
    /// border, and it faces otherwise. For points of no face it is adjacent to the nearest.
    pub(super) fn adjacent_face(&self, best: &mut Best, placed: &[Placed]) {
        let off = |number: usize, c: &Candidate| {
            let ends = if self.faces[number].is_measured() { ROUNDED_EDGE_SPACINGS } else { 1.0 };
            let off = placed[number].off(self.faces[number], self.points[c.point as usize], c.seat).abs();
            (!self.faces[number].is_narrow() && c.seat.within() >= -ends * self.spacing).then_some(off)
        };
        let mut nearest: BTreeMap<u32, (f64, Vector)> = BTreeMap::new();
        for (number, near) in self.candidates.iter().enumerate() {
            for c in near.iter().filter(|c| best.seat[c.point as usize].is_none()) {
                let Some(off) = off(number, c) else { continue };
                let least = nearest.entry(c.point).or_insert((f64::INFINITY, c.seat.normal()));
                if off < least.0 {
                    *least = (off, c.seat.normal());
                }
            }
        }
        for (number, near) in self.candidates.iter().enumerate() {
            for c in near {
                let own = best.seat[c.point as usize].map(|seat| seat.normal());
                let own = own.or_else(|| nearest.get(&c.point).map(|n| n.1));
                // The other side of a wall is no edge.
                let otherwise = |own: Vector| {
                    (OPPOSITE_FACE_COSINE..FACING_POINT_COSINE).contains(&dot(own, c.seat.normal()))
                };
                let faces_otherwise = own.is_some_and(otherwise);
                if let Some(off) = off(number, c).filter(|_| faces_otherwise) {
                    let adjacent_face = &mut best.adjacent_face[c.point as usize];
                    *adjacent_face = adjacent_face.min(off as f32);
                }
            }
        }
    }

    /// Points whose face is not certain by that, by the points around them. Tells points, ascending, with all faces that
    /// explain them about as well as the best.
    pub(super) fn by_what_is_around(
        &self,
        best: &mut Best,
        around: &[Sure],
        noise: f64,
    ) -> (Vec<(u32, u32)>, Vec<Beyond>) {
        let asked: Vec<bool> = (best.cost.iter().zip(&best.second))
            .map(|(cost, second)| cost.is_finite() && (*second < MAX_RIVAL_COST || *cost > MIN_ASKED_COST))
            .collect();
        let again: Vec<Vec<(Candidate, f64)>> = (self.candidates.par_iter().zip(around).zip(&self.reach))
            .map(|((near, around), reach)| {
                let ask = |c: &Candidate| {
                    let z = around.off_over(self.points[c.point as usize], c.seat, *reach, noise)?;
                    Some((*c, z + self.beyond(c.seat.within() + FREE_SPACINGS * self.spacing)))
                };
                let is_asked = |c: &&Candidate| asked[c.point as usize] && self.may_own(around.placed, c);
                near.par_iter().filter(is_asked).filter_map(ask).collect()
            })
            .collect();
        (0..self.points.len()).filter(|p| asked[*p]).for_each(|p| best.forget(p));
        let (mut shared, mut between) = (vec![], vec![]);
        for (number, near) in (0u32..).zip(&again) {
            near.iter().for_each(|(c, cost)| best.add(c, number, *cost));
        }
        for (number, near) in (0u32..).zip(&again) {
            let is_alike = |n: &&(Candidate, f64)| {
                n.1 <= EXPLAINED_SIGMAS.min(best.cost[n.0.point as usize] + MAX_SHARED_COST)
            };
            shared.extend(near.iter().filter(is_alike).map(|n| (n.0.point, number)));
            // A point that no face explains may belong to the other side of a wall too.
            let is_other_side = |c: &Candidate| {
                let p = c.point as usize;
                let own = best.seat[p].filter(|_| best.cost[p] > EXPLAINED_SIGMAS && best.owner[p] != number);
                c.seat.within() > 0.0
                    && own.is_some_and(|own| dot(own.normal(), c.seat.normal()) < OPPOSITE_FACE_COSINE)
            };
            let other_side = near.iter().map(|n| n.0).filter(is_other_side);
            between.extend(other_side.map(|c| Beyond { point: c.point, face: number, off: c.seat.off }));
        }
        shared.sort_unstable();
        (shared, between)
    }

    fn beyond(&self, within: f64) -> f64 {
        COST_PER_SPACING_BEYOND * (-within).max(0.0) / self.spacing
    }
}
