//! The best fit into tolerance zones: the pose whose greatest excess over the zones is least.
//!
//! As [`minimax`](super::minimax), but each point has the zone of the place that it lies over. Zones may lie to one side, so
//! distances have signs. A point near the border of two zones may change from one to the other as the part moves. The search is
//! made again with the zones where it ended, until none changes.

use super::counting::{Counting, NotCounted, weighted_mean};
use super::perturbed::Searched;
use super::sample::Measured;
use super::{AlignError, Alignment, BestFit, Start, Target, field};
use crate::deviation::surface::ReferenceSurface;
use crate::progress::{Progress, Silent};
use crate::rigid::Rigid;
use crate::space::{Point, Vector, minus, times};

/// Least and greatest allowed deviation at a place of a facet, millimeters, + outside; `None` where nothing is asked.
pub type ZoneAt<'a> = dyn Fn(u32, &Point) -> Option<[f64; 2]> + Sync + 'a;

/// Rounds after which points still change zones: the best pose so far is taken.
const MAX_ZONE_ROUNDS: usize = 8;

/// Deviation in the best fit over the zone up to which a point counts in the search in any case. No pose nearby has a point
/// within that is farther off.
const COUNTED_ZONE_RATIO: f64 = 10.0;

/// The pose with the least greatest excess over the zones.
#[derive(Clone, Debug, PartialEq)]
pub struct InZones {
    /// Takes measured coordinates to those of the reference.
    pub reference_from_measured: Rigid,
    /// How far the worst point of all is beyond its zone, millimeters; negative where all are within, by so much at least.
    pub excess: f64,
    /// Where that point lies on the reference's side, millimeters.
    pub at: Point,
    /// Its deviation.
    pub deviation: f64,
    /// Its zone.
    pub zone: [f64; 2],
    /// Points beyond their zones.
    pub beyond: u64,
    /// The greatest excess of the points that count in the search: what is least. Where all count, that of all.
    pub least: f64,
    /// Root of the weighted mean square deviation of the points that count and have a zone.
    pub rms: f64,
    /// Their weighted mean distance.
    pub mean_abs: f64,
    /// Points with a zone: all of them are judged.
    pub used: u64,
    /// Points that do not count in the search; they are judged with the others.
    pub not_counted: NotCounted,
    /// Points at places where nothing is asked.
    pub without_zone: u64,
}

/// The motion after which the greatest excess of a point over the zone at its place is least. It lies near `from`, a best fit
/// of the same `measured` to the same `reference`. `surface` is the reference made ready for signs; `zones` says what is
/// allowed where.
///
/// All points are judged, of a mesh its vertices. The points that count in a search of [`minimax`](super::minimax()) count
/// here, and those that are off by no more than ten times the widest zone. A local search: the best fit decides near which
/// pose. Cost: per round three to ten closest-point searches of all points, one by one; one to three rounds are the rule.
///
/// # Errors
/// [`AlignError::Free`] where the best fit left a motion free, [`AlignError::NoZone`] where no point has a zone,
/// [`AlignError::NotSettled`], [`AlignError::Cancelled`], and those of [`best_fit`](super::best_fit).
///
/// ```
/// use trueness_geom::align::{BestFit, Measured, Start, Target, best_fit, into_zones};
/// use trueness_geom::deviation::surface::{ReferenceSurface, SurfaceOptions};
/// use trueness_geom::{closest::Tree, mesh::Mesh, progress::Silent, rigid::Rigid};
/// let reference = Mesh {
///     positions: vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 11.0]],
///     faces: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
/// };
/// let mut points = vec![];
/// for face in &reference.faces {
///     let [a, b, c] = reference.places(face);
///     for (i, j) in (1..12).flat_map(|i| (1..12 - i).map(move |j| (f64::from(i) / 12.0, f64::from(j) / 12.0))) {
///         points.push(std::array::from_fn(|k| a[k] + i * (b[k] - a[k]) + j * (c[k] - a[k])));
///     }
/// }
/// let tree = Tree::build(&reference)?;
/// let target = Target::new(&reference, &tree);
/// let surface = ReferenceSurface::new(&tree, &reference, &SurfaceOptions::default(), &Silent)?;
/// let measured = Measured::Points { points: &points, normals: None };
/// let options = BestFit { start: Start::From(Rigid::IDENTITY), ..BestFit::default() };
/// let fit = best_fit(&measured, &target, &options, &Silent)?;
/// // A perfect part: 0.1 of room on every side is what is left.
/// let found = into_zones(&measured, &target, &surface, &|_, _| Some([-0.1, 0.1]), &fit, &options, &Silent)?;
/// assert!((found.excess + 0.1).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn into_zones(
    measured: &Measured,
    reference: &Target,
    surface: &ReferenceSurface,
    zones: &ZoneAt,
    from: &Alignment,
    options: &BestFit,
    progress: &dyn Progress,
) -> Result<InZones, AlignError> {
    let work = Work { reference, surface, zones, progress, seed: options.seed };
    let (all, start) = (measured.points(), from.reference_from_measured);
    let wide = |widest: f64, j: &Judged| widest.max(j.zone[0].abs()).max(j.zone[1].abs());
    let widest = work.judged(all, &start)?.iter().flatten().fold(0.0, wide);
    let counting = Counting::of(measured, reference, from, options, COUNTED_ZONE_RATIO * widest, progress)?;
    let (mut motion, mut least) = work.sought(&counting.points, start)?;
    if let Start::From(pose) = options.start {
        let there = worst(&work.judged(&counting.points, &pose)?).map(|(_, w)| w.excess());
        if there.is_some_and(|excess| excess < least) {
            (motion, least) = work.sought(&counting.points, pose)?;
        }
    }
    let judged = work.judged(all, &motion)?;
    let (i, worst) = worst(&judged).ok_or(AlignError::NoZone)?;
    let counted = work.judged(&counting.points, &motion)?;
    let pairs = || counted.iter().zip(&counting.weights).filter_map(|(j, w)| Some(((*j)?.deviation, *w)));
    let (values, weights): (Vec<f64>, Vec<f64>) = pairs().unzip();
    let used = judged.iter().flatten().count();
    Ok(InZones {
        reference_from_measured: motion,
        excess: worst.excess(),
        at: motion.point(all[i]),
        deviation: worst.deviation,
        zone: worst.zone,
        beyond: judged.iter().flatten().filter(|j| j.excess() > 0.0).count() as u64,
        least,
        rms: weighted_mean(&weights, &values, &|d| d * d).sqrt(),
        mean_abs: weighted_mean(&weights, &values, &f64::abs),
        used: used as u64,
        not_counted: counting.not_counted(&motion, reference, progress)?,
        without_zone: (judged.len() - used) as u64,
    })
}

struct Work<'a> {
    reference: &'a Target<'a>,
    surface: &'a ReferenceSurface,
    zones: &'a ZoneAt<'a>,
    progress: &'a dyn Progress,
    seed: u64,
}

/// A point at a place where something is asked.
#[derive(Clone, Copy)]
struct Judged {
    deviation: f64,
    zone: [f64; 2],
}

impl Judged {
    fn excess(&self) -> f64 {
        (self.deviation - self.zone[1]).max(self.zone[0] - self.deviation)
    }
}

/// The first of those with the greatest excess, and its number.
fn worst(judged: &[Option<Judged>]) -> Option<(usize, Judged)> {
    let zoned = judged.iter().enumerate().filter_map(|(i, j)| Some((i, (*j)?)));
    zoned.reduce(|best, one| if one.1.excess() > best.1.excess() { one } else { best })
}

impl Work<'_> {
    /// The deviation of a place, and how it grows.
    fn over(&self, p: Point) -> Option<(f64, Vector)> {
        let (deviation, place) = self.surface.at(&p).ok()??;
        let away = minus(p, place.point);
        let gradient = match deviation {
            // On the surface it goes up along the normal.
            0.0 => {
                let turn = if self.surface.sign().inside_out { -1.0 } else { 1.0 };
                times(turn, field::facet_normal(self.reference.mesh, place.face)?)
            }
            d => times(1.0 / d, away),
        };
        Some((deviation, gradient))
    }

    /// Points at a pose, each by the zone of the place that it lies over there.
    fn judged(&self, points: &[Point], motion: &Rigid) -> Result<Vec<Option<Judged>>, AlignError> {
        let moved: Vec<Point> = points.iter().map(|p| motion.point(*p)).collect();
        Ok(self.surface.map(&moved, &Silent, |i, deviation, hit| {
            let place = self.reference.tree.place(&moved[i], hit.filter(|_| deviation.is_finite())?);
            Some(Judged { deviation, zone: (self.zones)(place.face, &place.point)? })
        })?)
    }

    /// The best pose near `start`, no worse than that, and the greatest excess there.
    fn sought(&self, points: &[Point], mut start: Rigid) -> Result<(Rigid, f64), AlignError> {
        let zones = |judged: &[Option<Judged>]| judged.iter().map(|j| j.map(|j| j.zone)).collect::<Vec<_>>();
        let judged = self.judged(points, &start)?;
        let mut own = zones(&judged);
        let mut best = worst(&judged).map(|(_, w)| (start, w.excess()));
        for _ in 0..MAX_ZONE_ROUNDS {
            let end = self.placed(points, start, &own)?;
            let judged = self.judged(points, &end)?;
            let excess = worst(&judged).ok_or(AlignError::NoZone)?.1.excess();
            if best.is_none_or(|b| excess < b.1) {
                best = Some((end, excess));
            }
            let changed = zones(&judged);
            if changed == own {
                break;
            }
            (start, own) = (end, changed);
        }
        best.ok_or(AlignError::NotSettled)
    }

    /// The best pose with these zones.
    fn placed(&self, points: &[Point], start: Rigid, own: &[Option<[f64; 2]>]) -> Result<Rigid, AlignError> {
        let zoned = || points.iter().zip(own).filter_map(|(p, zone)| Some((*p, (*zone)?)));
        let points: Vec<Point> = zoned().map(|z| z.0).collect();
        if points.is_empty() {
            return Err(AlignError::NoZone);
        }
        let middles: Vec<f64> = zoned().map(|(_, [l, u])| 0.5 * (l + u)).collect();
        let rooms: Vec<f64> = zoned().map(|(_, [l, u])| 0.5 * (u - l)).collect();
        let distance = |i: usize, p: Point| -> Option<(f64, Vector)> {
            let (deviation, gradient) = self.over(p)?;
            Some((deviation - middles[i], gradient))
        };
        let searched = Searched { points: &points, distance: &distance, room: &rooms, seed: self.seed };
        Ok(searched.lowest(start, self.progress)?.motion)
    }
}
