//! The motion, among those left free, that brings points nearest to a true geometry: least greatest distance.
//!
//! A sequence of linear programs in the free small motions about where the points stand. Each stays within a box that grows
//! while the linear model holds. (R. Fletcher, Practical Methods of Optimization, 1987, section 14.) They go over a working set
//! that takes in the points that stick out most.

use super::datum::Freedom;
use super::error::{ZoneError, sane};
use crate::fit::{Function, MAX_JOINING_POINTS, MAX_POINTS_ALL_WORKING, lowest};
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::space::{Aabb, Point, Vector, cross, minus, norm, plus, times};

/// Distance of a place from the true geometry, with the sign that the geometry gives it, and its gradient. The gradient is a
/// unit vector where the distance is not zero. `None` where the geometry has no answer. The index is that of the point that
/// came to lie there: points may have geometries of their own.
pub type Distance<'a> = dyn Fn(usize, Point) -> Option<(f64, Vector)> + Sync + 'a;

/// Where the points come to lie.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Half the width of the narrowest zone about the geometry (or about its offset by the middle) that holds all points. It is
    /// the greatest magnitude of the distances less the middle.
    pub half: f64,
    /// Takes the coordinates of the points to those in which the geometry stands.
    pub motion: Rigid,
    /// Least signed distance, and the first point that has it.
    pub min: (f64, usize),
    /// Greatest signed distance, and the first point that has it.
    pub max: (f64, usize),
}

/// Most linear programs of one working set.
const MAX_WORKING_SET_STEPS: usize = 250;

/// How the search is set up.
#[derive(Clone, Copy, Debug)]
pub struct Search {
    /// Takes the coordinates of the points to those of the true geometry, before any free motion.
    pub start: Rigid,
    /// Motions left free, along and about the axes of the geometry's coordinates.
    pub free: Freedom,
    /// The zone's middle: its distance from the true geometry, for zones that are offset.
    pub middle: f64,
    /// The middle is free: the zone may lie anywhere (offset zones, ISO 1101 `OZ`).
    pub floating: bool,
    /// Distances count on the outer side only: the greatest one is the least, whatever its sign, and `half` may be negative.
    /// For boundaries that points must not pass.
    pub outer: bool,
}

/// The least greatest distance of `points` (mm) over the free motions, and the motion that has it.
///
/// Local: the motion nearest to `start`. Without freedom, one pass. Each round costs a pass over all points; two to five
/// are the rule.
///
/// # Errors
/// No points, a coordinate or distance that is no number, a search that does not settle, [`ZoneError::Cancelled`].
///
/// ```
/// use trueness_geom::progress::Silent;
/// use trueness_geom::rigid::Rigid;
/// use trueness_geom::zone::datum::Freedom;
/// use trueness_geom::zone::motion::{Search, placed};
/// // Four points of the plane z = 0, one of them 0.4 too high, held in height alone.
/// let points = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [9.0, 9.0, 0.4]];
/// let height = |_, p: [f64; 3]| Some((p[2], [0.0, 0.0, 1.0]));
/// let start = Rigid::IDENTITY;
/// let search = Search { start, free: Freedom::NONE, middle: 0.0, floating: false, outer: false };
/// assert_eq!(placed(&points, &height, &search, &Silent)?.half, 0.4);
/// // Free to tilt and to rise, it is a minimum zone: two points above, two below by 0.1 seen along z, at a slope of 0.2 / 9
/// // in both directions.
/// let free = placed(&points, &height, &Search { free: Freedom::ALL, ..search }, &Silent)?;
/// assert!((free.half - 0.1 / (1.0 + 2.0 * (0.2f64 / 9.0).powi(2)).sqrt()).abs() < 1e-12);
/// # Ok::<(), trueness_geom::zone::ZoneError>(())
/// ```
pub fn placed(
    points: &[Point],
    distance: &Distance,
    search: &Search,
    progress: &dyn Progress,
) -> Result<Placed, ZoneError> {
    placed_within(points, distance, &[], search, progress)
}

/// As [`placed`], where each point has a `room` of its own, millimeters: half the width of the zone that it may fill. It is
/// taken off the point's magnitude before the greatest counts. `half` is the greatest excess, negative where all points are
/// within their rooms. Without any rooms (an empty list) it is [`placed`]; a list of another length than `points` has rooms of
/// zero where it lacks them.
///
/// # Errors
/// The errors of [`placed`].
///
/// ```
/// use trueness_geom::progress::Silent;
/// use trueness_geom::rigid::Rigid;
/// use trueness_geom::zone::datum::Freedom;
/// use trueness_geom::zone::motion::{Search, placed_within};
/// // Points at the heights 0 and 1, free to rise. The lower may be off by 0.1, the upper by 0.5: it takes the more of what is left.
/// let height = |_, p: [f64; 3]| Some((p[2], [0.0, 0.0, 1.0]));
/// let free = Freedom { shift: [false, false, true], turn: [false; 3] };
/// let search = Search { start: Rigid::IDENTITY, free, middle: 0.0, floating: false, outer: false };
/// let found = placed_within(&[[0.0; 3], [0.0, 0.0, 1.0]], &height, &[0.1, 0.5], &search, &Silent)?;
/// assert!((found.half - 0.2).abs() < 1e-12 && (found.motion.point([0.0; 3])[2] + 0.3).abs() < 1e-12);
/// # Ok::<(), trueness_geom::zone::ZoneError>(())
/// ```
pub fn placed_within(
    points: &[Point],
    distance: &Distance,
    room: &[f64],
    search: &Search,
    progress: &dyn Progress,
) -> Result<Placed, ZoneError> {
    placed_from(points, distance, room, &[], search, progress)
}

/// As [`placed_within`], with the points numbered in `first` in the working set from the beginning. Points that stick out at
/// the start keep a search over many points near it.
///
/// # Errors
/// The errors of [`placed`].
pub(crate) fn placed_from(
    points: &[Point],
    distance: &Distance,
    room: &[f64],
    first: &[usize],
    search: &Search,
    progress: &dyn Progress,
) -> Result<Placed, ZoneError> {
    sane(points)?;
    let moved: Vec<Point> = points.iter().map(|p| search.start.point(*p)).collect();
    let bounds = Aabb::of(&moved);
    let center = times(0.5, plus(bounds.min, bounds.max));
    let work =
        Work { points: &moved, distance, room, search, center, reach: 0.5 * bounds.diagonal().max(1e-9) };
    let mut motion = Rigid::IDENTITY;
    if search.free.is_none() && !search.floating {
        return work.surveyed(search.middle, &motion).map(|s| s.placed(search, &motion));
    }
    let stride = if points.len() <= MAX_POINTS_ALL_WORKING {
        1
    } else {
        points.len().div_ceil(MAX_POINTS_ALL_WORKING / 4)
    };
    let mut working: Vec<usize> = (0..points.len()).step_by(stride).collect();
    working.extend(first.iter().filter(|i| !i.is_multiple_of(stride)));
    let mut middle = search.middle;
    for _ in 0..60 {
        if progress.cancelled() {
            return Err(ZoneError::Cancelled);
        }
        let low = work.solved(&working, motion, middle)?;
        (motion, middle) = (low.motion, low.middle);
        let all = work.surveyed(middle, &motion)?;
        let before = working.len();
        if all.half > low.half {
            let mut out: Vec<usize> =
                (0..points.len()).filter(|&i| work.excess(i, all.values[i], middle) > low.half).collect();
            let far = |i: &usize| work.excess(*i, all.values[*i], middle);
            out.sort_by(|i, j| far(j).total_cmp(&far(i)).then(i.cmp(j)));
            out.truncate(MAX_JOINING_POINTS);
            out.retain(|i| !working.contains(i));
            working.extend(out);
        }
        if working.len() == before {
            return Ok(all.placed(search, &motion));
        }
    }
    Err(ZoneError::NotSettled)
}

struct Work<'a> {
    points: &'a [Point],
    distance: &'a Distance<'a>,
    room: &'a [f64],
    search: &'a Search,
    /// Turns are about this place, in units that move the farthest point by a millimeter.
    center: Point,
    reach: f64,
}

struct Low {
    motion: Rigid,
    middle: f64,
    half: f64,
}

struct Surveyed {
    values: Vec<f64>,
    half: f64,
}

impl Surveyed {
    fn placed(&self, search: &Search, motion: &Rigid) -> Placed {
        let (mut min, mut max) = ((f64::INFINITY, 0), (f64::NEG_INFINITY, 0));
        for (i, &d) in self.values.iter().enumerate() {
            if d < min.0 {
                min = (d, i);
            }
            if d > max.0 {
                max = (d, i);
            }
        }
        Placed { half: self.half, motion: motion.after(&search.start), min, max }
    }
}

/// Unknowns: three shifts, three turns, the middle.
const MOTION_UNKNOWNS: usize = 7;

impl Work<'_> {
    fn room(&self, i: usize) -> f64 {
        self.room.get(i).copied().unwrap_or(0.0)
    }

    /// How far the distance of point `i` is out of the middle and its room, on the sides that count.
    fn excess(&self, i: usize, d: f64, middle: f64) -> f64 {
        let out = if self.search.outer { d - middle } else { (d - middle).abs() };
        out - self.room(i)
    }

    fn surveyed(&self, middle: f64, motion: &Rigid) -> Result<Surveyed, ZoneError> {
        let one = |(i, p): (usize, &Point)| {
            (self.distance)(i, motion.point(*p)).map(|d| d.0).filter(|d| d.is_finite())
        };
        let values: Vec<Option<f64>> = self.points.par_iter().enumerate().map(one).collect();
        let lost = values.iter().position(Option::is_none);
        if let Some(index) = lost {
            return Err(ZoneError::NotFinite { index });
        }
        let values: Vec<f64> = values.into_iter().flatten().collect();
        let off = values.iter().enumerate().map(|(i, d)| self.excess(i, *d, middle));
        let half = off.fold(f64::NEG_INFINITY, f64::max);
        Ok(Surveyed { values, half })
    }

    fn greatest(&self, working: &[usize], motion: &Rigid, middle: f64) -> Option<f64> {
        working.iter().try_fold(f64::NEG_INFINITY, |most, &i| {
            let (d, _) = (self.distance)(i, motion.point(self.points[i]))?;
            d.is_finite().then(|| most.max(self.excess(i, d, middle)))
        })
    }

    /// How far the distances that count range: the size of the first box.
    fn range(&self, working: &[usize], motion: &Rigid, middle: f64, half: f64) -> f64 {
        let at = |i: &usize| (self.distance)(*i, motion.point(self.points[*i])).map_or(0.0, |d| d.0 - middle);
        if !self.search.outer {
            return match self.room.is_empty() {
                true => half,
                false => working.iter().map(|i| at(i).abs()).fold(0.0, f64::max),
            };
        }
        half - working.iter().map(at).fold(f64::INFINITY, f64::min)
    }

    /// Both sides of each point's zone, and how they answer to the free motions.
    fn functions(
        &self,
        working: &[usize],
        motion: &Rigid,
        middle: f64,
    ) -> Option<Vec<Function<MOTION_UNKNOWNS>>> {
        let mut all = Vec::with_capacity(2 * working.len());
        for &i in working {
            let p = motion.point(self.points[i]);
            let (d, gradient) = (self.distance)(i, p)?;
            let lever = times(1.0 / self.reach, cross(minus(p, self.turning()), gradient));
            let free = self.search.free;
            let held = |free: bool, x: f64| if free { x } else { 0.0 };
            let mut slope: [f64; MOTION_UNKNOWNS] = std::array::from_fn(|k| match k {
                0..3 => held(free.shift[k], gradient[k]),
                3..6 => held(free.turn[k - 3], lever[k - 3]),
                _ => 0.0,
            });
            slope[6] = if self.search.floating { -1.0 } else { 0.0 };
            let room = self.room(i);
            all.push(Function { level: d - middle - room, slope });
            if !self.search.outer {
                all.push(Function { level: middle - d - room, slope: slope.map(|x| -x) });
            }
        }
        Some(all)
    }

    /// The step without what is held: no function tells the program where those unknowns are, so it leaves them at a side of
    /// the box.
    fn freed(&self, mut x: [f64; MOTION_UNKNOWNS]) -> [f64; MOTION_UNKNOWNS] {
        let Search { free, floating, .. } = self.search;
        let all = free.shift.iter().chain(&free.turn).chain([floating]);
        x.iter_mut().zip(all).filter(|(_, free)| !**free).for_each(|(x, _)| *x = 0.0);
        x
    }

    fn stepped(&self, motion: &Rigid, x: &[f64; MOTION_UNKNOWNS]) -> Rigid {
        let turn = times(1.0 / self.reach, [x[3], x[4], x[5]]);
        let turned = Rigid::rotation_about(self.turning(), turn);
        Rigid::translation_by([x[0], x[1], x[2]]).after(&turned).after(motion)
    }

    /// Turns are about the frame's axes where shifts are held, and about the middle of the points where they are free.
    fn turning(&self) -> Point {
        let free = &self.search.free;
        let mut at = self.center;
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            if free.turn[k] && !(free.shift[a] && free.shift[b]) {
                (at[a], at[b]) = (0.0, 0.0);
            }
        }
        at
    }

    fn solved(&self, working: &[usize], start: Rigid, start_middle: f64) -> Result<Low, ZoneError> {
        let (mut motion, mut middle) = (start, start_middle);
        let lost = ZoneError::NotSettled;
        let mut half = self.greatest(working, &motion, middle).ok_or(lost)?;
        let mut reach = 4.0 * self.range(working, &motion, middle, half).max(1e-9);
        for _ in 0..MAX_WORKING_SET_STEPS {
            let functions = self.functions(working, &motion, middle).ok_or(lost)?;
            let program = lowest(&functions, reach).ok_or(lost)?;
            let step = self.freed(program.x);
            let fall = half - program.value;
            if fall <= 1e-15 * (half.abs() + norm(self.center)).max(1e-3) || reach < 1e-14 {
                break;
            }
            let next = self.stepped(&motion, &step);
            let to = middle + step[6];
            let value = self.greatest(working, &next, to).unwrap_or(f64::INFINITY);
            let gain = (half - value) / fall;
            if gain > 0.75 {
                reach *= 4.0;
            } else if gain < 0.25 {
                let length = step.iter().fold(0.0f64, |m, x| m.max(x.abs()));
                reach = 0.25 * reach.min(length);
            }
            if value < half {
                (motion, middle, half) = (next, to, value);
            }
        }
        Ok(Low { motion, middle, half })
    }
}
