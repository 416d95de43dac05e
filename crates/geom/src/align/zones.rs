//! The best fit into tolerance zones: the pose whose greatest excess over the zones is least.
//!
//! As [`minimax`](super::minimax), but each point has the zone of the place that it lies over. Zones may lie to one side, so distances have
//! signs. A point near the border of two zones may change from one to the other as the part moves: the search is done again with the
//! zones where it ended, until none changes.

use super::counting::{Counting, unsettled, weighted_mean};
use super::sample::Measured;
use super::{AlignError, Alignment, BestFit, Target, field};
use crate::deviation::surface::ReferenceSurface;
use crate::parallel::prelude::*;
use crate::progress::{Progress, Silent};
use crate::rigid::Rigid;
use crate::space::{Point, Vector, minus, times};
use crate::zone::datum::Freedom;
use crate::zone::motion::{Search, placed_within};

/// Least and greatest allowed deviation at a place of a facet, millimeters, + outside; `None` where nothing is asked.
pub type ZoneAt<'a> = dyn Fn(u32, &Point) -> Option<[f64; 2]> + Sync + 'a;

/// Rounds after which points still change zones: the best pose so far is taken.
const ROUNDS: usize = 8;

/// The pose with the least greatest excess over the zones.
#[derive(Clone, Debug, PartialEq)]
pub struct InZones {
    /// Takes measured coordinates to those of the reference.
    pub reference_from_measured: Rigid,
    /// How far the worst point is beyond its zone, millimeters; negative where all are within, by so much at least.
    pub excess: f64,
    /// Where that point lies on the reference's side, millimeters.
    pub at: Point,
    /// Its deviation.
    pub deviation: f64,
    /// Its zone.
    pub zone: [f64; 2],
    /// Root of the weighted mean square deviation of the points with a zone.
    pub rms: f64,
    /// Their weighted mean distance.
    pub mean_abs: f64,
    /// Points with a zone that count in the best fit.
    pub used: u64,
    /// Points that do not count in the best fit.
    pub left_out: u64,
    /// Points that count, at places where nothing is asked.
    pub without_zone: u64,
}

/// The motion near `from`, a best fit of the same `measured` to the same `reference`, after which the greatest excess of a point over the zone
/// at its place is least. `surface` is the reference made ready for signs; `zones` says what is allowed where.
///
/// The points that count are those of the best fit, of a mesh its vertices. A local search: the best fit decides near which pose. Cost: per round three to ten
/// closest-point searches of all points, one by one; one to three rounds are the rule.
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
///     let [a, b, c] = face.map(|v| reference.positions[v as usize]);
///     for (i, j) in (1..12).flat_map(|i| (1..12 - i).map(move |j| (f64::from(i) / 12.0, f64::from(j) / 12.0))) {
///         points.push(std::array::from_fn(|k| a[k] + i * (b[k] - a[k]) + j * (c[k] - a[k])));
///     }
/// }
/// let tree = Tree::build(&reference)?;
/// let target = Target::new(&reference, &tree);
/// let surface = ReferenceSurface::new(&tree, &reference, &SurfaceOptions::default(), &Silent)?;
/// let measured = Measured::Points { points: &points, normals: None };
/// let options = BestFit { start: Start::Given(Rigid::IDENTITY), ..BestFit::default() };
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
    let counting = Counting::of(measured, reference, from, options, progress)?;
    let work = Work { counting: &counting, reference, surface, zones };
    let mut start = from.reference_from_measured;
    let mut own = work.own(&start);
    let mut best: Option<InZones> = None;
    for _ in 0..ROUNDS {
        let end = work.placed(start, &own, progress)?;
        let found = work.worth(&end)?;
        let changed = work.own(&end);
        let settled = changed == own;
        if best.as_ref().is_none_or(|b| found.excess < b.excess) {
            best = Some(found);
        }
        if settled {
            break;
        }
        (start, own) = (end, changed);
    }
    best.ok_or(AlignError::NotSettled)
}

struct Work<'a> {
    counting: &'a Counting,
    reference: &'a Target<'a>,
    surface: &'a ReferenceSurface,
    zones: &'a ZoneAt<'a>,
}

/// Where a point lies over the reference.
struct Over {
    deviation: f64,
    /// How the deviation grows.
    gradient: Vector,
    face: u32,
    place: Point,
}

impl Work<'_> {
    fn over(&self, p: Point) -> Option<Over> {
        let found = self.surface.map(&[p], &Silent, |_, deviation, hit| (deviation, hit.copied()));
        let (deviation, hit) = found.ok()?.into_iter().next()?;
        let (hit, deviation) = (hit?, Some(deviation).filter(|d| d.is_finite())?);
        let place = self.reference.tree.place(&p, &hit);
        let away = minus(p, place.point);
        let gradient = match deviation {
            // On the surface it goes up along the normal.
            0.0 => {
                let turn = if self.surface.sign().inside_out { -1.0 } else { 1.0 };
                times(turn, field::facet_normal(self.reference.mesh, place.face)?)
            }
            d => times(1.0 / d, away),
        };
        Some(Over { deviation, gradient, face: place.face, place: place.point })
    }

    /// The zone of each point at a pose.
    fn own(&self, motion: &Rigid) -> Vec<Option<[f64; 2]>> {
        let of = |p: &Point| self.over(motion.point(*p)).and_then(|o| (self.zones)(o.face, &o.place));
        self.counting.points.par_iter().map(of).collect()
    }

    /// The best pose with these zones.
    fn placed(
        &self,
        start: Rigid,
        own: &[Option<[f64; 2]>],
        progress: &dyn Progress,
    ) -> Result<Rigid, AlignError> {
        let zoned = || self.counting.points.iter().zip(own).filter_map(|(p, zone)| Some((*p, (*zone)?)));
        let points: Vec<Point> = zoned().map(|z| z.0).collect();
        if points.is_empty() {
            return Err(AlignError::NoZone);
        }
        let middles: Vec<f64> = zoned().map(|(_, [l, u])| 0.5 * (l + u)).collect();
        let rooms: Vec<f64> = zoned().map(|(_, [l, u])| 0.5 * (u - l)).collect();
        let distance = |i: usize, p: Point| -> Option<(f64, Vector)> {
            let over = self.over(p)?;
            Some((over.deviation - middles[i], over.gradient))
        };
        let search = Search { start, free: Freedom::ALL, middle: 0.0, floating: false, outer: false };
        Ok(placed_within(&points, &distance, &rooms, &search, progress).map_err(unsettled)?.motion)
    }

    /// What a pose is worth, every point by the zone where it lies.
    fn worth(&self, motion: &Rigid) -> Result<InZones, AlignError> {
        let of = |p: &Point| {
            let over = self.over(motion.point(*p))?;
            let [lower, upper] = (self.zones)(over.face, &over.place)?;
            Some((over.deviation, [lower, upper], (over.deviation - upper).max(lower - over.deviation)))
        };
        let found: Vec<Option<(f64, [f64; 2], f64)>> = self.counting.points.par_iter().map(of).collect();
        let zoned = || found.iter().enumerate().filter_map(|(i, f)| Some((i, (*f)?)));
        let worst = zoned().reduce(|best, one| if one.1.2 > best.1.2 { one } else { best });
        let (i, (deviation, zone, excess)) = worst.ok_or(AlignError::NoZone)?;
        let values: Vec<f64> = zoned().map(|z| z.1.0).collect();
        let weights: Vec<f64> = zoned().map(|z| self.counting.weights[z.0]).collect();
        let sum = |f: &dyn Fn(f64) -> f64| weighted_mean(&weights, &values, f);
        Ok(InZones {
            reference_from_measured: *motion,
            excess,
            at: motion.point(self.counting.points[i]),
            deviation,
            zone,
            rms: sum(&|d| d * d).sqrt(),
            mean_abs: sum(&f64::abs),
            used: values.len() as u64,
            left_out: self.counting.left_out,
            without_zone: (found.len() - values.len()) as u64,
        })
    }
}
