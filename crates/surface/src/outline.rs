//! The outline of the points in the plane of the parameters: where a surface is cut off.
//!
//! A place is inside where no disk of the *reach* as its radius holds it without holding a point. That is the α-shape
//! of Edelsbrunner, Kirkpatrick & Seidel 1983, with round notches. Gaps narrower than twice the reach are bridged;
//! wider ones are holes or lie outside. It is found on a grid of cells a sixth of the reach wide, by two exact distance
//! transforms (Felzenszwalb & Huttenlocher 2012). They widen the points by the reach, and narrow the result by it. The
//! line between inside and outside is set off by 3.5 cells, so that all points are within. Then it is made of as few
//! sides as lie within one cell of it.

use super::crossing::cross;
use super::raster::{Raster, distances};
use trueness_geom::progress::{Cancelled, Progress};

/// An outline as polygons of parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Half the width of the widest gap that is bridged, millimeters.
    pub reach: f64,
    /// The reach that was asked for: less than `reach` where the grid is no finer.
    pub wanted: f64,
    /// Regions that do not hang together, the largest first.
    pub regions: Vec<OutlineRegion>,
    /// Points of regions too small to count: not within any.
    pub left_out: usize,
}

/// A region within a closed polygon, without its holes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutlineRegion {
    /// Around it, against the clock.
    pub outer: Vec<[f64; 2]>,
    /// Around its holes, with the clock.
    pub holes: Vec<Vec<[f64; 2]>>,
}

/// Cells for each reach.
const CELLS_PER_REACH: f64 = 6.0;
/// How far the outline is set off, in cells. A point is off the middle of its cell by 0.71 at most, and a distance by
/// as much. A cut at the rim of the domain is off by one.
const OFFSET_CELLS: f64 = 3.5;
/// How far the outline's sides may be from it, in cells.
const STRAIGHT_SIDE_CELLS: f64 = 1.0;
/// Cells of the grid at most: 32 MB for each of its values.
const MAX_CELLS: f64 = (1 << 22) as f64;
/// Regions are left out with a smaller share of the points of the one that has most.
const MIN_REGION_SHARE: f64 = 0.01;
/// A region wider than this share of its reach is an island, not a line of points: no greater reach joins islands.
const ISLAND_WIDTH_REACHES: f64 = 2.0 / 3.0;
/// Where there are more regions than this a greater reach is tried.
const MAX_REGIONS: usize = 8;
/// It is so many times as great each time.
const REACH_GROWTH: f64 = 1.4;
/// It grows up to this share of the longer side.
const MAX_REACH_OF_SIDE: f64 = 0.05;

impl Outline {
    /// The outline of points in a rectangle of parameters, with this reach. Without one it is three times the mean
    /// distance of neighbors. Where that gives more than eight regions which are lines of points, it is the least that
    /// gives fewer. It is at most a twentieth of the longer side, and grows only as long as no islands grow together.
    ///
    /// Regions with less than 1 % of the points of the one with most are left out. No region comes of no points. Cost: linear in points
    /// and cells, 4 million cells at most; of finer ones the reach is greater than asked for, and told.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn new(
        points: &[[f64; 2]],
        domain: [(f64, f64); 2],
        reach: Option<f64>,
        progress: &dyn Progress,
    ) -> Result<Outline, Cancelled> {
        let sides = domain.map(|(from, to)| to - from);
        let longest = sides[0].max(sides[1]);
        let fine = |reach: f64| -> Option<f64> {
            let reach = reach.max(1e-3 * longest);
            (1..40).map(|k| reach * f64::from(k)).find(|r| room(sides, *r) <= MAX_CELLS)
        };
        if points.is_empty() {
            return Ok(Outline::default());
        }
        if let Some(wanted) = reach {
            let Some(reach) = fine(wanted) else { return Ok(Outline::default()) };
            return Ok(Outline { wanted, ..Outline::over(points, domain, reach, progress)? });
        }
        let Some(least) = fine(3.0 * spacing(points, domain)) else { return Ok(Outline::default()) };
        let (first, islands) = Outline::counted(points, domain, least, progress)?;
        // Points in lines lie nearer to each other along these than across: then the lines are parts, and a greater reach joins them.
        let mut reach = least;
        while first.regions.len() > MAX_REGIONS
            && islands <= MAX_REGIONS
            && reach < MAX_REACH_OF_SIDE * longest
        {
            reach = (REACH_GROWTH * reach).min(MAX_REACH_OF_SIDE * longest);
            let wider = Outline::over(points, domain, reach, progress)?;
            if wider.regions.len() < islands {
                break;
            }
            if wider.regions.len() <= MAX_REGIONS {
                return Ok(wider);
            }
        }
        Ok(first)
    }

    /// With this reach.
    fn over(
        points: &[[f64; 2]],
        domain: [(f64, f64); 2],
        reach: f64,
        progress: &dyn Progress,
    ) -> Result<Outline, Cancelled> {
        Ok(Outline::counted(points, domain, reach, progress)?.0)
    }

    /// With this reach, and how many of the regions are islands.
    fn counted(
        points: &[[f64; 2]],
        domain: [(f64, f64); 2],
        reach: f64,
        progress: &dyn Progress,
    ) -> Result<(Outline, usize), Cancelled> {
        let cell_size = reach / CELLS_PER_REACH;
        let margin = (CELLS_PER_REACH + OFFSET_CELLS).ceil() + 2.0;
        let raster = Raster::new(domain, cell_size, margin as usize);
        let mut near = raster.empty(f64::INFINITY);
        points.iter().for_each(|p| near[raster.cell(*p)] = 0.0);
        distances(&mut near, raster.counts);
        if progress.cancelled() {
            return Err(Cancelled);
        }
        // Squares, in cells.
        let mut inside: Vec<f64> = near
            .iter()
            .map(|d| if *d > CELLS_PER_REACH * CELLS_PER_REACH { 0.0 } else { f64::INFINITY })
            .collect();
        distances(&mut inside, raster.counts);
        if progress.cancelled() {
            return Err(Cancelled);
        }
        let depth: Vec<f64> = inside.into_iter().map(f64::sqrt).collect();
        let clamp =
            |p: [f64; 2]| -> [f64; 2] { std::array::from_fn(|k| p[k].clamp(domain[k].0, domain[k].1)) };
        let (part, count) = raster.parts(&depth, CELLS_PER_REACH - OFFSET_CELLS);
        let mut regions = vec![(0, OutlineRegion::default()); count];
        points.iter().for_each(|p| regions[part[raster.cell(*p)] as usize].0 += 1);
        // The points of a line are as deep as the reach.
        let mut deepest = vec![0.0f64; count];
        for (part, depth) in part.iter().zip(&depth).filter(|(part, _)| **part != u32::MAX) {
            deepest[*part as usize] = deepest[*part as usize].max(*depth);
        }
        let (cells, mut lines): (Vec<usize>, Vec<Vec<[f64; 2]>>) =
            raster.contours(&depth, CELLS_PER_REACH - OFFSET_CELLS).into_iter().unzip();
        for line in &mut lines {
            line.iter_mut().for_each(|p| *p = clamp(*p));
            line.dedup();
            while line.len() > 1 && line.first() == line.last() {
                line.pop();
            }
        }
        for (cell, line) in cells.into_iter().zip(made_straight(&lines, domain, cell_size)) {
            let region = &mut regions[part[cell] as usize].1;
            match area(&line) {
                size if size > 0.0 => region.outer = line,
                size if size < 0.0 => region.holes.push(line),
                _ => {}
            }
        }
        let is_wide =
            |deepest: f64| 2.0 * (deepest - CELLS_PER_REACH) >= ISLAND_WIDTH_REACHES * CELLS_PER_REACH;
        let most = regions.iter().map(|(count, _)| *count).max().unwrap_or(0);
        let islands = regions.iter().zip(deepest).filter(|((count, _), deepest)| {
            *count as f64 >= MIN_REGION_SHARE * most as f64 && is_wide(*deepest)
        });
        let islands = islands.count();
        Ok((kept(regions, reach), islands))
    }

    /// Whether a place is within, or on the rim.
    pub fn holds(&self, p: [f64; 2]) -> bool {
        self.regions.iter().any(|region| region.holds(p))
    }

    /// Where the line of parameters with this `u` crosses the outline, ascending: between the first and the second it is inside, and
    /// so on. Sides along the line do not count.
    pub(super) fn crossings(&self, u: f64) -> Vec<f64> {
        let mut all = vec![];
        for line in self.regions.iter().flat_map(OutlineRegion::loops) {
            let next = line.iter().cycle().skip(1);
            for (a, b) in line.iter().zip(next).filter(|(a, b)| (a[0] <= u) != (b[0] <= u)) {
                all.push(a[1] + (u - a[0]) / (b[0] - a[0]) * (b[1] - a[1]));
            }
        }
        all.sort_by(f64::total_cmp);
        all
    }

    /// Area of all regions.
    pub fn area(&self) -> f64 {
        self.regions.iter().flat_map(OutlineRegion::loops).map(area).sum()
    }
}

impl OutlineRegion {
    /// The polygon around it, then those around its holes.
    pub fn loops(&self) -> impl Iterator<Item = &[[f64; 2]]> {
        std::iter::once(&self.outer).chain(&self.holes).map(Vec::as_slice)
    }

    /// Whether a place is within, or on the rim.
    pub fn holds(&self, p: [f64; 2]) -> bool {
        self.loops().map(|line| winding(line, p)).sum::<i32>() != 0 || self.loops().any(|line| is_on(line, p))
    }
}

/// Cells that a grid for this reach takes.
fn room(sides: [f64; 2], reach: f64) -> f64 {
    sides
        .iter()
        .map(|side| side * CELLS_PER_REACH / reach + 2.0 * (CELLS_PER_REACH + OFFSET_CELLS + 3.0))
        .product()
}

/// Mean distance of neighbors where there are any. Squares hold eight points in the mean; the distance is their side
/// over the root of their number of points.
fn spacing(points: &[[f64; 2]], domain: [(f64, f64); 2]) -> f64 {
    const POINTS_PER_SQUARE: f64 = 8.0;
    /// Where a square holds fewer points in the mean, their number tells more of chance than of their distance.
    const MIN_POINTS_PER_SQUARE: f64 = 4.0;
    /// Squares of half the side tell less by this factor where they are no longer wider than the island that they hold.
    const NO_WIDER_RATIO: f64 = 0.75;
    // A place that is there several times is no neighbor of itself.
    let mut points: Vec<[u64; 2]> = points.iter().map(|p| p.map(|x| (x + 0.0).to_bits())).collect();
    points.sort_unstable();
    points.dedup();
    let points: Vec<[f64; 2]> = points.into_iter().map(|p| p.map(f64::from_bits)).collect();
    let [long, short] = domain.map(|(from, to)| to - from);
    let n = points.len().max(1) as f64;
    let least = (long * short / MAX_CELLS).sqrt().max(long.max(short) / MAX_CELLS);
    let mut side = (long * short * POINTS_PER_SQUARE / n).sqrt().max(least);
    let held = |side: f64| {
        let raster = Raster::new(domain, side, 0);
        let mut filled = vec![false; raster.counts[0] * raster.counts[1]];
        points.iter().for_each(|p| filled[raster.cell(*p)] = true);
        n / filled.iter().filter(|f| **f).count() as f64
    };
    // Where much of the domain is empty, the rest holds more: its squares are made smaller.
    let mut own = held(side);
    for _ in 0..4 {
        if own < 1.5 * POINTS_PER_SQUARE {
            break;
        }
        side = (side * (POINTS_PER_SQUARE / own).sqrt()).max(least);
        own = held(side);
    }
    // Squares wider than an island hold all of it, however near to each other its points lie: then smaller ones tell less.
    while own > MIN_POINTS_PER_SQUARE && side > 2.0 * least {
        let half = held(0.5 * side);
        if 0.5 * side / half.sqrt() > NO_WIDER_RATIO * side / own.sqrt() {
            break;
        }
        (side, own) = (0.5 * side, half);
    }
    side / own.sqrt()
}

/// Area of a polygon that runs against the clock; negative where it runs with the clock.
fn area(line: &[[f64; 2]]) -> f64 {
    let next = line.iter().cycle().skip(1);
    0.5 * line.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
}

/// Above 0 where a place lies to the left of the way from one to another.
fn side(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// Whether a place lies on a side of a polygon; those along the rim of the domain tell it without rounding.
fn is_on(line: &[[f64; 2]], p: [f64; 2]) -> bool {
    let next = line.iter().cycle().skip(1);
    line.iter().zip(next).any(|(a, b)| {
        (0..2).all(|k| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k])) && side(*a, *b, p) == 0.0
    })
}

/// How often a polygon winds around a place.
fn winding(line: &[[f64; 2]], p: [f64; 2]) -> i32 {
    let next = line.iter().cycle().skip(1);
    let passes = |(a, b): (&[f64; 2], &[f64; 2])| match (a[1] <= p[1], b[1] <= p[1]) {
        (true, false) => i32::from(side(*a, *b, p) > 0.0),
        (false, true) => -i32::from(side(*a, *b, p) < 0.0),
        _ => 0,
    };
    line.iter().zip(next).map(passes).sum()
}

/// The regions with enough of the points, the largest first.
fn kept(regions: Vec<(usize, OutlineRegion)>, reach: f64) -> Outline {
    let most = regions.iter().map(|(count, _)| *count).max().unwrap_or(0) as f64;
    let enough = |(count, region): &(usize, OutlineRegion)| {
        *count as f64 >= MIN_REGION_SHARE * most && region.outer.len() > 2
    };
    let (kept, dropped): (Vec<_>, Vec<_>) = regions.into_iter().partition(enough);
    let mut regions: Vec<OutlineRegion> = kept.into_iter().map(|(_, region)| region).collect();
    regions.sort_by(|a, b| area(&b.outer).total_cmp(&area(&a.outer)));
    Outline { reach, wanted: reach, regions, left_out: dropped.into_iter().map(|(count, _)| count).sum() }
}

/// The lines of as few sides as they can be without crossing each other or themselves, each within [`STRAIGHT_SIDE_CELLS`] cells. Where they touch
/// as they are, at the rim of the domain, so do these.
fn made_straight(lines: &[Vec<[f64; 2]>], domain: [(f64, f64); 2], cell_size: f64) -> Vec<Vec<[f64; 2]>> {
    let within = |share: f64| -> Vec<Vec<[f64; 2]>> {
        lines.iter().map(|line| straightened(line, domain, share * STRAIGHT_SIDE_CELLS * cell_size)).collect()
    };
    let is_simple = |lines: &Vec<Vec<[f64; 2]>>| {
        let places: Vec<[f64; 2]> = lines.iter().flatten().copied().collect();
        let mut number = 0..;
        !cross(
            &lines.iter().map(|line| number.by_ref().take(line.len()).collect()).collect::<Vec<_>>(),
            &places,
        )
    };
    [1.0, 0.5, 0.25].into_iter().map(within).find(is_simple).unwrap_or_else(|| within(1.0))
}

/// A closed line of as few sides as keep it within the distance of all its places (Douglas & Peucker 1973). Where it comes to the rim
/// of the domain, goes around its corners and leaves it, its places stay: points may lie on the rim.
fn straightened(line: &[[f64; 2]], domain: [(f64, f64); 2], distance: f64) -> Vec<[f64; 2]> {
    let n = line.len();
    let rims = |i: usize| -> u32 {
        let on = |k: usize| [line[i % n][k] == domain[k].0, line[i % n][k] == domain[k].1];
        [on(0), on(1)].concat().iter().fold(0, |mask, on| 2 * mask + u32::from(*on))
    };
    let stays = |i: &usize| {
        let own = rims(*i);
        own.count_ones() > 1 || own != 0 && (own & rims(i + n - 1) == 0 || own & rims(i + 1) == 0)
    };
    let away = |p: &[f64; 2]| (0..2).map(|k| (p[k] - line[0][k]).powi(2)).sum::<f64>();
    let far = (0..n).fold(0, |far, i| if away(&line[i]) > away(&line[far]) { i } else { far });
    let mut kept: Vec<usize> = [0, far].into_iter().chain((0..n).filter(stays)).collect();
    kept.sort_unstable();
    kept.dedup();
    let mut open: Vec<[usize; 2]> =
        kept.iter().zip(kept.iter().skip(1).chain([&n])).map(|(a, b)| [*a, *b]).collect();
    while let Some([from, to]) = open.pop() {
        let (a, b) = (line[from], line[to % n]);
        let off = |i: usize| from_segment(line[i], a, b);
        let worst =
            (from + 1..to).fold((from, distance), |w, i| if off(i) > w.1 { (i, off(i)) } else { w }).0;
        if worst > from {
            kept.push(worst);
            open.extend([[from, worst], [worst, to]]);
        }
    }
    kept.sort_unstable();
    kept.into_iter().map(|i| line[i]).collect()
}

/// Distance of a place from a segment.
pub(super) fn from_segment(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, way) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = along[0] * along[0] + along[1] * along[1];
    let t =
        if square > 0.0 { ((along[0] * way[0] + along[1] * way[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(way[0] - t * along[0], way[1] - t * along[1])
}
