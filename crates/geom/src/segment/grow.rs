//! One region: from a patch to all that belongs to its element.

use super::chords::is_chord;
use super::criterion::{BETTER_RMS, CLEARLY_BETTER_RMS, better, has_circles, is_shown, may_give_way};
use super::estimate::{estimate, is_sound};
use super::flood::{Marks, Order, flood, patch, rings, strip};
use super::pieces::{Band, PieceGraph};
use super::probe::Probe;
use super::region::GrownRegion;
use crate::fit::{Options, fit, improved};
use crate::progress::Silent;
use crate::shape::{Kind, Shape};
use crate::space::Point;

/// Pieces of the first patches: small ones for small faces, large ones against noise.
const PIECES_PER_PATCH: [usize; 3] = [20, 64, 250];
/// Pieces of the first strips, and how they grow.
const STRIPS: [(usize, Order); 4] =
    [(20, Order::Turn), (20, Order::Edge), (64, Order::Turn), (64, Order::Edge)];
/// Facets of the shortest strip: a plane may have no more.
const MIN_STRIP_FACETS: usize = 2;
/// Strips where the surface is drawn: two facets of a plane, a fillet of few chords.
const DRAWN_STRIPS: [(usize, Order); 3] =
    [(MIN_STRIP_FACETS, Order::Turn), (6, Order::Alike), (16, Order::Alike)];
/// Most points of a region that its element is fitted to while regions grow and merge.
pub(super) const MAX_FITTED_POINTS: usize = 1500;
/// A region may grow this many times before its element is fitted again.
const GROWTH_PER_FIT: usize = 3;
/// A trial, and a region that is taken, has stopped growing when it gains less than one piece in so many.
const STOP_GAIN_DIVISORS: [usize; 2] = [16, 100];
/// Most fits of one growing region. With threefold growth each time it has covered any surface before.
const MAX_GROWTH_FITS: usize = 30;
/// Share of a patch that must belong to the element estimated from it.
const MIN_AGREEING_SHARE: f64 = 0.6;
/// The same for a region with the two rings around it.
const MIN_FITTING_SHARE: f64 = 0.8;
/// Share of those rings that must belong to another kind of element before it is tried.
const MIN_GOING_ON_SHARE: f64 = 0.3;

/// Pieces whose points a start is looked for on.
const START_PIECES: usize = 60;
/// Share of the least weight asked for that a region must have for other kinds to be tried on it. They may cover more, but not
/// many times as much.
pub(super) const PROMISING_SHARE: f64 = 0.3;
/// How often a whole region may change its kind.
const MAX_KIND_CHANGES: usize = 3;

/// The inputs that all regions of a search have in common.
#[derive(Debug)]
pub(super) struct Context<'a> {
    pub surface: &'a PieceGraph<'a>,
    /// Elements looked for, simple ones first.
    pub kinds: &'a [Kind],
    pub band: Band,
    /// Standard deviation of the points, millimeters.
    pub noise: f64,
    /// Cosine of the angle between neighbors from which on there is an edge between them.
    pub crease: f64,
    /// Diagonal of the whole, millimeters.
    pub size: f64,
}

impl Context<'_> {
    /// The best region around `seed` with at most `most` pieces, over all kinds.
    pub(super) fn around(
        &self,
        seed: u32,
        most: usize,
        marks: &mut Marks,
        free: &impl Fn(u32) -> bool,
    ) -> Option<GrownRegion> {
        let mut best: Option<GrownRegion> = None;
        let mut last = 0;
        for count in PIECES_PER_PATCH {
            let patch = patch(self.surface, seed, count, self.crease, marks, free);
            if patch.len() <= last {
                break;
            }
            last = patch.len();
            if self.tried(&mut best, &patch, most, marks, free) {
                return best;
            }
            // No larger patch can show more; which kind it is, the whole region tells.
            if best.as_ref().is_some_and(|b| b.pieces.len() >= most) {
                break;
            }
        }
        // Where facets are as long as the face, the patch goes beyond it on all sides: it shows nothing, or what only corners are of.
        let may_be_of_corners = best.as_ref().is_none_or(|b| may_give_way(b, self.noise));
        if self.surface.is_mesh() && may_be_of_corners {
            let drawn = if self.surface.is_drawn { &DRAWN_STRIPS[..] } else { &[] };
            for &first in drawn.iter().chain(&STRIPS) {
                let strip = strip(self.surface, seed, first, self.crease, marks, free);
                if strip.len() <= MIN_STRIP_FACETS && is_chord(self.surface, &strip, self.crease, marks) {
                    continue;
                }
                self.tried(&mut best, &strip, most, marks, free);
            }
        }
        best
    }

    /// Grows each kind of element that a patch shows and keeps the best. Also whether no other can cover more than it, all that
    /// a trial may reach.
    fn tried(
        &self,
        best: &mut Option<GrownRegion>,
        patch: &[u32],
        most: usize,
        marks: &mut Marks,
        free: &impl Fn(u32) -> bool,
    ) -> bool {
        for &kind in self.kinds {
            let Some((shape, _)) = self.shown(kind, patch, MIN_AGREEING_SHARE) else { continue };
            let Some(grown) = self.grown(shape, patch, most, marks, free) else { continue };
            *best = Some(better(best.take(), grown, self.noise));
            if best.as_ref().is_some_and(|b| b.pieces.len() >= most && !b.is_doubtful(self.noise)) {
                return true;
            }
        }
        false
    }

    /// The region that a trial began, grown to its end. How it goes on beyond tells the kinds apart better than the
    /// patch did. `enough` is the weight below which the region is of no use.
    pub(super) fn whole(
        &self,
        trial: &GrownRegion,
        enough: f64,
        marks: &mut Marks,
        free: &impl Fn(u32) -> bool,
    ) -> Option<GrownRegion> {
        let mut best = self.grown(trial.shape, &trial.pieces, usize::MAX, marks, free)?;
        if best.is_doubtful(self.noise) && best.weight >= PROMISING_SHARE * enough {
            // It may have gone beyond its face: begin again with the other kinds.
            for &kind in self.kinds.iter().filter(|&&kind| kind != trial.shape.kind()) {
                let Some((shape, _)) = self.shown(kind, &trial.pieces, MIN_AGREEING_SHARE) else { continue };
                let Some(grown) = self.grown(shape, &trial.pieces, usize::MAX, marks, free) else { continue };
                best = better(Some(best), grown, self.noise);
            }
        }
        for _ in 0..MAX_KIND_CHANGES {
            if best.weight < PROMISING_SHARE * enough {
                break;
            }
            let before = (best.shape.kind(), best.pieces.len());
            let beyond = rings(self.surface, &best.pieces, marks, free);
            let wider = [&best.pieces[..], &beyond].concat();
            for &kind in self.kinds.iter().filter(|&&kind| kind != before.0) {
                let Some((shape, rms)) = self.shown(kind, &wider, MIN_FITTING_SHARE) else { continue };
                if rms > BETTER_RMS * best.rms && self.agreeing(&shape, &beyond) < MIN_GOING_ON_SHARE {
                    continue;
                }
                let Some(grown) = self.grown(shape, &wider, usize::MAX, marks, free) else { continue };
                best = better(Some(best), grown, self.noise);
            }
            if (best.shape.kind(), best.pieces.len()) == before {
                break;
            }
        }
        // The corners of two circles lie on a ball, whatever the facets between them go along: all of it shows that, without a start.
        let is_ball = self.surface.is_drawn && best.shape.kind() == Kind::Sphere;
        if is_ball && may_give_way(&best, self.noise) {
            let start_places = self.surface.sampled_places(&best.pieces, START_PIECES);
            for &kind in self.kinds.iter().filter(|&&kind| matches!(kind, Kind::Cylinder | Kind::Cone)) {
                let Ok(start) = fit(&start_places, kind, &Options::default(), &Silent) else { continue };
                if let Some(grown) = self.grown(start.shape, &best.pieces, usize::MAX, marks, free) {
                    best = better(Some(best), grown, self.noise);
                }
            }
        }
        Some(best)
    }

    /// A ball as another kind, where its pieces fit a ball worse than noise and that kind clearly better. A short fillet passes
    /// for a ball where its small patches are too noisy to show a torus. All of it shows one, without a start.
    pub(super) fn reconsidered(&self, region: &mut GrownRegion) {
        let own = region.shape.kind();
        if own != Kind::Sphere || !region.is_doubtful(self.noise) {
            return;
        }
        let [start_places, points] =
            [START_PIECES, MAX_FITTED_POINTS].map(|most| self.surface.sampled_places(&region.pieces, most));
        for &kind in self.kinds.iter().filter(|kind| kind.unknowns() > own.unknowns()) {
            let Ok(start) = fit(&start_places, kind, &Options::default(), &Silent) else { continue };
            let Some((shape, rms)) = improved(&points, &start.shape) else { continue };
            let clearly =
                rms < CLEARLY_BETTER_RMS * region.rms && is_sound(&shape, self.size, self.band.distance);
            if clearly && self.agreeing(&shape, &region.pieces) >= MIN_FITTING_SHARE {
                (region.shape, region.rms) = (shape, rms);
            }
        }
    }

    /// The share of the pieces that belong to the element; of many, some are asked.
    fn agreeing(&self, shape: &Shape, pieces: &[u32]) -> f64 {
        let sampled = pieces.iter().step_by(pieces.len().div_ceil(MAX_FITTED_POINTS).max(1));
        let all = sampled.clone().count().max(1);
        let element = Probe::new(shape);
        sampled.filter(|&&p| self.surface.belongs(p, &element, &self.band)).count() as f64 / all as f64
    }

    /// The element of one kind that the patch shows, if the given share of it agrees, and its root mean square distance.
    fn shown(&self, kind: Kind, patch: &[u32], share: f64) -> Option<(Shape, f64)> {
        let surface = self.surface;
        let oriented: Vec<_> = (patch.iter().step_by(patch.len().div_ceil(MAX_FITTED_POINTS).max(1)))
            .map(|&p| (surface.places[p as usize], surface.normals[p as usize]))
            .filter(|o| o.1 != [0.0; 3])
            .collect();
        let first = estimate(kind, &oriented)?;
        let points = surface.sampled_places(patch, MAX_FITTED_POINTS);
        if !is_shown(surface, kind, patch, points.len()) {
            return None;
        }
        let (shape, rms) =
            improved(&points, &first).filter(|f| is_sound(&f.0, self.size, self.band.distance))?;
        (self.agreeing(&shape, patch) >= share).then_some((shape, rms))
    }

    /// Grows and fits in turns until nothing joins any more.
    fn grown(
        &self,
        mut shape: Shape,
        patch: &[u32],
        most: usize,
        marks: &mut Marks,
        free: &impl Fn(u32) -> bool,
    ) -> Option<GrownRegion> {
        let kind = shape.kind();
        let mut limit = GROWTH_PER_FIT * patch.len();
        let stop_gain = if most == usize::MAX { STOP_GAIN_DIVISORS[1] } else { STOP_GAIN_DIVISORS[0] };
        let mut last = 0;
        for _ in 0..MAX_GROWTH_FITS {
            let element = Probe::new(&shape);
            let pieces = flood(self.surface, patch, limit.min(most), marks, |piece, from| {
                let belongs = free(piece) && self.surface.belongs(piece, &element, &self.band);
                belongs && !self.surface.folds_back(piece, from)
            });
            let points = self.within(&element, &pieces);
            if !is_shown(self.surface, kind, &pieces, points.len()) {
                return None;
            }
            let (better, rms) =
                improved(&points, &shape).filter(|f| is_sound(&f.0, self.size, self.band.distance))?;
            let full = pieces.len() >= limit.min(most);
            if pieces.len() >= most || (!full && pieces.len() <= last + last / stop_gain) {
                if pieces.len() < most && !has_circles(self.surface, &better, &pieces) {
                    return None;
                }
                let (weight, middles) = (self.surface.weight(&pieces), self.middles(&better, &pieces));
                return Some(GrownRegion { shape: better, pieces, weight, rms, middles });
            }
            shape = better;
            last = if full { 0 } else { pieces.len() };
            if full {
                limit *= GROWTH_PER_FIT;
            }
        }
        None
    }

    /// Root mean square distance of the middles of the pieces, each with its weight; of many, some are asked.
    fn middles(&self, shape: &Shape, pieces: &[u32]) -> f64 {
        let element = Probe::new(shape);
        let (mut squares, mut weights) = (0.0, 0.0);
        for piece in
            pieces.iter().step_by(pieces.len().div_ceil(MAX_FITTED_POINTS).max(1)).map(|p| *p as usize)
        {
            let weight = self.surface.weights[piece];
            squares += weight * element.distance(self.surface.places[piece]).powi(2);
            weights += weight;
        }
        (squares / weights).sqrt()
    }

    /// Some points of the pieces, those that lie within the band.
    fn within(&self, element: &Probe, pieces: &[u32]) -> Vec<Point> {
        let mut points = self.surface.sampled_places(pieces, MAX_FITTED_POINTS);
        points.retain(|&p| element.distance(p).abs() <= self.band.distance);
        points
    }
}
