//! Points near a nominal feature that are of other surfaces: the walls, bores and fillets that go on where it ends.
//!
//! A cloud has no facets that would tell by their angle. Each point gets the plane of its neighbors (Hoppe et al., Surface
//! reconstruction from unorganized points, SIGGRAPH 1992, section 3.1). Points that face otherwise than the feature are joined
//! to pieces as long as they face alike. A piece that goes on farther from the nominal surface than the feature may be
//! ([`Nearness::distance`]) is of another surface, as far as the cloud alone can tell; one that ends before (the slope
//! of a dent or a scratch) is of the feature, however steep it is. Where the planes of neighbors mix two surfaces, at a
//! sharp edge, a point is of the piece whose plane it lies on, if it does not lie on that of the feature.

use super::rules::Rules;
use super::{FeatureError, Nearness, Nominal, NominalSurface};
use crate::fit::eigen;
use crate::progress::Progress;
use crate::space::{Point, Vector, dot, minus, plus, times};
use crate::spatial::neighbors::PointTree;
use crate::stats::SIGMA_OVER_MAD;
use std::collections::{BTreeMap, BTreeSet};

/// Numbers of neighbors that are tried, until most planes are flat.
const NEIGHBORS: [usize; 5] = [12, 24, 48, 96, 192];
/// Of the points of the feature, so many are asked which number of neighbors is enough.
const ASKED: usize = 256;
/// Thickness over spread of the neighbors of a point that lie on one surface; about the half of what a plane has whose
/// neighbors lie to one fifth on a wall.
const FLAT: f64 = 0.15;
/// Thickness over spread that is sought: normals are then known to about a degree.
const SOUGHT: f64 = 0.05;
/// Over so many root mean square distances a point does not lie on the feature: one in a million of normal noise.
const OFF: f64 = 5.0;
/// Up to so many a point at the edge of a piece lies on the feature too.
const EDGE: f64 = 2.0;
/// Up to so many it may lie on a piece.
const ON: f64 = 6.0;
/// A point farther than so many root mean square distances from the plane of its neighbors is not of it; a single one among a
/// dozen is three and a half off.
const MOST_OFF_PLANE: f64 = 2.0;
/// Neighbors lie in a row if their mean square across it is below this share of that along it.
const ROW: f64 = 0.01;
/// A piece goes on if so many of its neighbors are beyond the reach of the feature.
const GOES_ON: usize = 3;
/// Distances below this share of the coordinates are rounding.
const ROUNDING: f64 = 1e-9;
/// So many times the points of sharp edges are given to the pieces around them: edges are some neighbors wide.
const PASSES: usize = 8;

/// A piece of another surface, near the feature.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Piece {
    /// Its points that are within the reach of the feature, ascending, and the unit normals of the surface there, whose
    /// sign means nothing.
    pub points: Vec<(u32, Vector)>,
}

/// The pieces of other surfaces among `own`, the points of a cloud that [`super::in_cloud`] found for `nominal`. `tree` holds
/// all points of the cloud, which are finite, in their order.
///
/// Of an edge, which is told by its angles, there are none. Fewer points than a dozen tell nothing. Cost: some hundred
/// neighbors at most for each point of `own` and around it, usually a dozen.
///
/// # Errors
/// [`FeatureError`]: a nominal feature that makes no sense, [`FeatureError::Cancelled`].
///
/// ```
/// use trueness_geom::feature::{Nearness, Nominal, in_cloud, pieces_beside};
/// use trueness_geom::spatial::neighbors::PointTree;
/// // A floor of 20 by 20, and a wall along its side that rises from it.
/// let floor = (0..400).map(|i| [f64::from(i % 20), f64::from(i / 20), 0.0]);
/// let wall = (0..2000).map(|i| [0.0, f64::from(i % 20), 0.1 * f64::from(1 + i / 20)]);
/// let points: Vec<[f64; 3]> = floor.chain(wall).collect();
/// let boundary = vec![[0.0, 0.0, 0.0], [19.0, 0.0, 0.0], [19.0, 19.0, 0.0], [0.0, 19.0, 0.0]];
/// let nominal = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary };
/// let near = Nearness { distance: 0.55, angle: 0.26, margin: 0.0, rim: true, inward: None };
/// let own = in_cloud(&points, &nominal, &near)?.points;
/// assert_eq!(own.len(), 400 + 5 * 20);
/// let tree = PointTree::new(&points);
/// let found = pieces_beside(&points, &tree, &own, &nominal, &near, &trueness_geom::progress::Silent)?;
/// assert_eq!(found.iter().map(|p| p.points.len()).sum::<usize>(), 100);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn pieces_beside(
    points: &[Point],
    tree: &PointTree,
    own: &[u32],
    nominal: &Nominal,
    near: &Nearness,
    progress: &dyn Progress,
) -> Result<Vec<Piece>, FeatureError> {
    Rules::new(nominal, near)?;
    let Some(surface) = nominal.surface() else { return Ok(vec![]) };
    if own.len() < NEIGHBORS[0] {
        return Ok(vec![]);
    }
    let mut cloud =
        Cloud { points, tree, surface, near, count: NEIGHBORS[0], patches: BTreeMap::new(), progress };
    cloud.choose_count(own)?;
    let mut label: BTreeMap<u32, u32> = BTreeMap::new();
    let mut pieces = 0;
    let mut seen: BTreeSet<u32> = BTreeSet::new();
    let fringe = cloud.fringe(own)?;
    for start in own.iter().chain(&fringe) {
        if seen.contains(start) || !cloud.is_aside(*start) {
            continue;
        }
        let (piece, goes_on) = cloud.piece(*start, (own, &fringe), &mut seen)?;
        if goes_on {
            label.extend(piece.into_iter().map(|p| (p, pieces)));
            pieces += 1;
        }
    }
    if pieces > 0 {
        cloud.edges(own, &mut label)?;
    }
    let mut found = vec![Piece::default(); pieces as usize];
    for (point, piece) in label.into_iter().filter(|(p, _)| own.binary_search(p).is_ok()) {
        let normal = cloud.patch(point).normal;
        found[piece as usize].points.push((point, normal));
    }
    Ok(found)
}

/// The plane of the neighbors of a point.
#[derive(Clone, Copy)]
struct Patch {
    center: Point,
    normal: Vector,
    /// Root mean square distance of the neighbors from it.
    rms: f64,
    /// Whether the point and its neighbors lie on one surface.
    flat: bool,
}

/// Where the feature lies, as most of its points tell.
#[derive(Clone, Copy)]
struct Level {
    height: f64,
    scatter: f64,
}

struct Cloud<'a> {
    points: &'a [Point],
    tree: &'a PointTree,
    surface: NominalSurface,
    near: &'a Nearness,
    /// Neighbors that make a plane.
    count: usize,
    patches: BTreeMap<u32, Patch>,
    progress: &'a dyn Progress,
}

impl Cloud<'_> {
    /// Chooses the number of neighbors.
    fn choose_count(&mut self, own: &[u32]) -> Result<(), FeatureError> {
        let step = own.len().div_ceil(ASKED);
        let mut best = (f64::INFINITY, NEIGHBORS[0]);
        for count in NEIGHBORS.into_iter().filter(|n| *n <= own.len()) {
            self.asked()?;
            self.count = count;
            let mut all: Vec<f64> =
                own.iter().step_by(step).map(|p| self.plane(*p)).map(|(_, [a, b])| ratio(a, b)).collect();
            all.sort_unstable_by(f64::total_cmp);
            let thick = all[all.len() / 2];
            if thick < best.0 {
                best = (thick, count);
            }
            if thick <= SOUGHT {
                break;
            }
        }
        self.count = best.1;
        Ok(())
    }

    fn asked(&self) -> Result<(), FeatureError> {
        if self.progress.cancelled() { Err(FeatureError::Cancelled) } else { Ok(()) }
    }

    fn at(&self, p: u32) -> Point {
        self.points[p as usize]
    }

    fn around(&self, p: u32, count: usize) -> Vec<u32> {
        self.tree.k_nearest(&self.at(p), count, Some(p)).into_iter().map(|n| n.1).collect()
    }

    /// The plane of a point and its neighbors, and the two least mean squares. Of neighbors in a row, as scan lines have them,
    /// more are taken.
    fn plane(&self, p: u32) -> (Patch, [f64; 2]) {
        let mut count = self.count;
        let mut found = self.plane_of(p, count);
        while found.1[1] < ROW * found.1[2] && count < NEIGHBORS[NEIGHBORS.len() - 1] {
            count *= 2;
            found = self.plane_of(p, count);
        }
        (found.0, [found.1[0], found.1[1]])
    }

    /// The plane of a point and so many neighbors, and the mean squares along its axes, the least first.
    fn plane_of(&self, p: u32, count: usize) -> (Patch, [f64; 3]) {
        let mut places: Vec<Point> = self.around(p, count).into_iter().map(|q| self.at(q)).collect();
        places.push(self.at(p));
        let share = 1.0 / places.len() as f64;
        let center = times(share, places.iter().fold([0.0; 3], |sum, q| plus(sum, *q)));
        let mut matrix = [[0.0; 3]; 3];
        for q in &places {
            let d = minus(*q, center);
            for (row, x) in matrix.iter_mut().zip(d) {
                row.iter_mut().zip(d).for_each(|(cell, y)| *cell += share * x * y);
            }
        }
        let (values, rows) = eigen(matrix);
        let values = values.map(|v| v.max(0.0));
        // A point beside a wall may have all of its neighbors on it.
        let off = dot(minus(self.at(p), center), rows[0]).abs();
        let rounding = ROUNDING * self.at(p).iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let rms = values[0].sqrt();
        let flat = ratio(values[0], values[1]) <= FLAT && off <= MOST_OFF_PLANE * rms + rounding;
        (Patch { center, normal: rows[0], rms, flat }, values)
    }

    fn patch(&mut self, p: u32) -> Patch {
        if let Some(patch) = self.patches.get(&p) {
            return *patch;
        }
        let patch = self.plane(p).0;
        self.patches.insert(p, patch);
        patch
    }

    /// Whether the neighbors of a point lie on a surface that runs at an angle to the feature.
    fn is_aside(&mut self, p: u32) -> bool {
        let patch = self.patch(p);
        let own = self.surface.distance(self.at(p));
        patch.flat && own.is_some_and(|(_, way)| dot(way, patch.normal).abs() < libm::cos(self.near.angle))
    }

    /// The points beyond the reach of the feature, beside its edges, that lie on surfaces which run at an angle to it. Of a cloud so sparse
    /// that within reach all planes of neighbors mix two surfaces, they alone show the other one.
    fn fringe(&mut self, own: &[u32]) -> Result<BTreeSet<u32>, FeatureError> {
        let mut fringe = BTreeSet::new();
        for (n, p) in own.iter().enumerate() {
            if n.is_multiple_of(1024) {
                self.asked()?;
            }
            if self.patch(*p).flat {
                continue;
            }
            for q in self.around(*p, NEIGHBORS[0]) {
                let is_beyond = own.binary_search(&q).is_err()
                    && self.surface.distance(self.at(q)).is_some_and(|d| d.0.abs() > self.near.distance);
                if is_beyond && !fringe.contains(&q) && self.is_aside(q) {
                    fringe.insert(q);
                }
            }
        }
        Ok(fringe)
    }

    /// What faces like `start` around it, within reach or on its fringe, and whether it goes on beyond.
    fn piece(
        &mut self,
        start: u32,
        (own, fringe): (&[u32], &BTreeSet<u32>),
        seen: &mut BTreeSet<u32>,
    ) -> Result<(Vec<u32>, bool), FeatureError> {
        seen.insert(start);
        let (mut piece, mut next) = (vec![start], 0);
        let mut beyond: BTreeSet<u32> = BTreeSet::new();
        while let Some(p) = piece.get(next).copied() {
            if next.is_multiple_of(1024) {
                self.asked()?;
            }
            next += 1;
            let normal = self.patch(p).normal;
            for q in self.around(p, NEIGHBORS[0]) {
                if seen.contains(&q) || beyond.contains(&q) || !self.is_aside(q) {
                    continue;
                }
                if dot(normal, self.patch(q).normal).abs() < libm::cos(self.near.angle) {
                    continue;
                }
                let off = self.surface.distance(self.at(q)).map_or(0.0, |d| d.0.abs());
                if own.binary_search(&q).is_ok() || fringe.contains(&q) {
                    seen.insert(q);
                    piece.push(q);
                } else if off > self.near.distance {
                    beyond.insert(q);
                }
            }
        }
        Ok((piece, beyond.len() >= GOES_ON))
    }

    /// Gives the points of sharp edges to the pieces they lie on.
    fn edges(&mut self, own: &[u32], label: &mut BTreeMap<u32, u32>) -> Result<(), FeatureError> {
        let level = self.level(own);
        // What lies on a piece and on the feature, at their edge, is of the feature.
        if let Some(level) = level {
            for p in own {
                let Some((height, _)) = self.surface.distance(self.at(*p)) else { continue };
                let rounding = ROUNDING * self.at(*p).iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                if (height - level.height).abs() <= EDGE * level.scatter + rounding {
                    label.remove(p);
                }
            }
        }
        let mut left: Vec<u32> = own.iter().copied().filter(|p| !label.contains_key(p)).collect();
        for _ in 0..PASSES {
            let mut given: Vec<(u32, u32, Patch)> = vec![];
            for (n, p) in left.iter().enumerate() {
                if n.is_multiple_of(1024) {
                    self.asked()?;
                }
                if let Some((piece, patch)) = self.given(*p, own, level, label) {
                    given.push((*p, piece, patch));
                }
            }
            if given.is_empty() {
                break;
            }
            for (p, piece, patch) in given {
                label.insert(p, piece);
                self.patches.insert(p, Patch { flat: true, ..patch });
            }
            left.retain(|p| !label.contains_key(p));
        }
        Ok(())
    }

    /// The middle of the distances of what faces as the feature, and its scatter: that of the planes of neighbors, or of the heights
    /// over the nominal surface against those around, whichever is less. Those planes scatter by the sag of a round feature too.
    fn level(&mut self, own: &[u32]) -> Option<Level> {
        let (mut heights, mut scatter, mut off) = (vec![], vec![], vec![]);
        for p in own.iter().step_by(own.len().div_ceil(ASKED)) {
            let Some(height) = self.height_facing(*p) else { continue };
            heights.push(height);
            scatter.push(self.patch(*p).rms);
            let around = self.around(*p, NEIGHBORS[0]);
            let mut around: Vec<f64> = around
                .into_iter()
                .filter(|q| own.binary_search(q).is_ok())
                .filter_map(|q| self.height_facing(q))
                .collect();
            if around.len() >= NEIGHBORS[0] / 2 {
                off.extend(middle(&mut around).map(|middle| (height - middle).abs()));
            }
        }
        let height = middle(&mut heights)?;
        let of_heights = middle(&mut off).map_or(f64::INFINITY, |off| SIGMA_OVER_MAD * off);
        Some(Level { height, scatter: middle(&mut scatter)?.min(of_heights) })
    }

    /// The height of a point over the nominal surface, if it and its neighbors face as the feature.
    fn height_facing(&mut self, p: u32) -> Option<f64> {
        if !self.patch(p).flat || self.is_aside(p) {
            return None;
        }
        self.surface.distance(self.at(p)).map(|d| d.0)
    }

    /// The piece that a point lies on, and its plane there, unless it lies as near to what the feature has around it.
    fn given(
        &mut self,
        p: u32,
        own: &[u32],
        level: Option<Level>,
        label: &BTreeMap<u32, u32>,
    ) -> Option<(u32, Patch)> {
        let around = self.around(p, 2 * NEIGHBORS[0]);
        if !around.iter().any(|q| label.contains_key(q)) {
            return None;
        }
        let at = self.at(p);
        let rounding = ROUNDING * at.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let height = self.surface.distance(at)?.0;
        let mut other: Option<(f64, u32, Patch)> = None;
        // Of what faces as the feature, its height counts, as planes of neighbors near an edge lean; of slopes their planes.
        let (mut heights, mut slope) = (vec![], f64::INFINITY);
        for q in around {
            let patch = self.patch(q);
            let off = dot(minus(at, patch.center), patch.normal).abs();
            match label.get(&q) {
                Some(piece) => {
                    if other.is_none_or(|o| off < o.0) {
                        other = Some((off, *piece, patch));
                    }
                }
                None if !patch.flat || own.binary_search(&q).is_err() => (),
                None if self.is_aside(q) => slope = slope.min(off),
                None => heights.extend(self.surface.distance(self.at(q)).map(|d| (d.0 - height).abs())),
            }
        }
        let (off, piece, patch) = other?;
        let all = level.map_or(f64::INFINITY, |l| (l.height - height).abs());
        let near = middle(&mut heights).unwrap_or(all).min(slope);
        let is_on = off <= ON * patch.rms + rounding;
        let is_off = near > OFF * level.map_or(0.0, |l| l.scatter) + rounding;
        (is_on && is_off && off < near).then_some((piece, patch))
    }
}

/// The middle one of some numbers.
fn middle(numbers: &mut [f64]) -> Option<f64> {
    numbers.sort_unstable_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied()
}

fn ratio(least: f64, middle: f64) -> f64 {
    if middle > 0.0 { (least.max(0.0) / middle).sqrt() } else { f64::INFINITY }
}

#[cfg(test)]
mod tests;
