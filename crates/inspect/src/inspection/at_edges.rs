//! Points at the edges of a feature that are of the face beside it, because one of both is off its place.
//!
//! A bore that is too wide ends the face about it earlier, and the upper end of its wall has its nearest place on the reference on that
//! face; a face that is too high lets the wall of the bore go on. Where both really are, their points clear of the edge tell: what lies
//! on the one, and off the other on the side where the one is, belongs to the one. What goes on at the other side, a burr, what the part stands on, the flank
//! of a groove, leaves the verdict open. Everything else counts, as chamfers and bell-mouths, which lie on neither.

use super::belonging::FARTHEST;
use super::data::Stop;
use super::of_others::{OfOthers, SAME, WALL_REACH};
use super::reference::{height, nearest, normal, part};
use trueness_geom::closest::Tree;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point, Vector, cross, dot, least_axis, minus, norm, unit};
use trueness_geom::spatial::neighbors::PointTree;
use trueness_geom::stats::SIGMA_OVER_MAD;

/// Points around one at an edge that tell where a surface is there, and the fewest that do of a face beside the feature.
const AROUND: usize = 24;
const FEWEST: usize = 8;
/// Points of other faces around one that are asked which of them are of that beside it.
const ASKED: usize = 192;
/// Up to so many times the angle that a feature allows facets of a face beside it turn against each other where it is curved.
const ALIKE: f64 = 2.0;
/// At a corner facets are as near that differ by no more than this share; faces that are asked there at most.
const CORNER: f64 = 0.25;
const FACES: usize = 4;
/// Over so many standard deviations a point is off a surface: one in a million of normal noise.
const OFF: f64 = 5.0;
/// Up to so many it tells where the surface is, found in so many rounds.
const KEPT: f64 = 3.0;
const ROUNDS: usize = 4;
/// Share of the variance of the points around by which they must spread for their slope that way to count.
const FLAT: f64 = 0.05;

/// The facets of the reference that the feature has an edge with.
struct Beside {
    numbers: Vec<u32>,
    mesh: Mesh,
    tree: Tree,
}

/// Measured points of a surface, clear of edges.
struct Clear {
    tree: PointTree,
    places: Vec<Point>,
    /// Of each how far off the surface of the reference it is, out of the material.
    heights: Vec<f64>,
}

impl Clear {
    /// Some of them, with their heights.
    fn of<'a>(&'a self, numbers: impl Iterator<Item = u32> + 'a) -> impl Iterator<Item = (Point, f64)> + 'a {
        numbers.map(|n| (self.places[n as usize], self.heights[n as usize]))
    }
}

/// Where a surface is near a place: its height over that of the reference, and how far a point of it may be off.
struct Level {
    height: f64,
    slack: f64,
}

impl Level {
    /// That of the points around a place: their height on a plane through most of them, for a surface off its place rises over its
    /// nominal one. `facing` is normal to the surface.
    fn at(place: Point, facing: Vector, around: impl Iterator<Item = (Point, f64)>, rounding: f64) -> Level {
        let across = unit(cross(facing, least_axis(facing))).map_or([0.0; 3], |u| u.0);
        let along = cross(facing, across);
        let flat = |(q, height): (Point, f64)| {
            let way = minus(q, place);
            [dot(way, across), dot(way, along), height]
        };
        let all: Vec<[f64; 3]> = around.map(flat).collect();
        let (mut height, mut scatter, mut kept) = (0.0, 0.0, all.clone());
        for _ in 0..ROUNDS {
            let (level, [a, b]) = rising(&kept);
            let off = |[x, y, h]: &[f64; 3]| (h - level - a * x - b * y).abs();
            height = level;
            scatter = SIGMA_OVER_MAD * middle(&mut all.iter().map(off).collect::<Vec<f64>>());
            kept = all.iter().filter(|q| off(q) <= KEPT * scatter + rounding).copied().collect();
        }
        Level { height, slack: OFF * scatter + rounding }
    }
}

/// The height at the origin and both slopes of a plane through some places; of places in a row none across it.
fn rising(places: &[[f64; 3]]) -> (f64, [f64; 2]) {
    let share = 1.0 / places.len().max(1) as f64;
    let mean = |of: &dyn Fn(&[f64; 3]) -> f64| share * places.iter().map(of).sum::<f64>();
    let [x, y, h] = [0, 1, 2].map(|k| mean(&|q| q[k]));
    let product = |i: usize, j: usize, [a, b]: [f64; 2]| mean(&|q| (q[i] - a) * (q[j] - b));
    let least = FLAT * (product(0, 0, [x, x]) + product(1, 1, [y, y]));
    let (xx, yy) = (product(0, 0, [x, x]) + least, product(1, 1, [y, y]) + least);
    let (xy, xh, yh) = (product(0, 1, [x, y]), product(0, 2, [x, h]), product(1, 2, [y, h]));
    let det = xx * yy - xy * xy;
    if det <= 0.0 {
        return (h, [0.0; 2]);
    }
    let slopes = [(yy * xh - xy * yh) / det, (xx * yh - xy * xh) / det];
    (h - slopes[0] * x - slopes[1] * y, slopes)
}

/// A measured point near an edge of the feature, with its height over it, the way out of it, and the nearest facet beside it with its distance.
struct Asked {
    point: u32,
    place: Point,
    off: f64,
    out: Vector,
    beside: u32,
    away: f64,
    /// Whether it is of a piece beside the feature, or else among its points.
    of_piece: bool,
}

/// The points of the faces beside the feature, with the sides of them.
struct OthersClear {
    clear: Clear,
    /// Normal of the facet of the reference each is nearest to, and its height over the feature.
    facing: Vec<Vector>,
    off: Vec<f64>,
}

/// Whose a point is that is not the feature's, the most certain first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Whose {
    /// Of the face beside it.
    Face,
    /// It goes on beyond the feature along such a face, or may be of one.
    Nobody,
}

/// A feature and the faces beside it, as they really are.
struct Edges<'a> {
    of: &'a OfOthers<'a>,
    own_clear: Clear,
    others: OthersClear,
    beside: Beside,
    /// How far off its place a face beside the feature is at most.
    highest: f64,
}

impl Edges<'_> {
    /// `None` of a point that may be the feature's.
    fn whose(&self, asked: &Asked) -> Option<(u32, Whose)> {
        let rounding = self.of.belonging.reference.rounding;
        let facets: Vec<u32> =
            self.facets_at(asked).into_iter().filter(|f| self.may_lie_on(asked, *f)).collect();
        if facets.is_empty() {
            return None;
        }
        let near = self.own_clear.tree.k_nearest(&asked.place, AROUND, None);
        let level = Level::at(asked.place, asked.out, self.own_clear.of(near.iter().map(|n| n.1)), rounding);
        if (asked.off - level.height).abs() <= level.slack {
            return None;
        }
        let whose = facets.iter().filter_map(|facet| self.on_face(asked, *facet, &level)).min()?;
        Some((asked.point, whose))
    }

    /// The nearest facet beside the feature, and of those of other faces that are as near, at a corner, one each.
    fn facets_at(&self, asked: &Asked) -> Vec<u32> {
        let Beside { mesh, tree, .. } = &self.beside;
        let around = Aabb::of([&asked.place]).widened(asked.away * (1.0 + CORNER));
        let mut found = vec![asked.beside];
        for facet in tree.in_box(&around) {
            let facing = normal(mesh, facet);
            let is_new = |other: &u32| {
                let angle = facing.zip(normal(mesh, *other)).map(|(a, b)| dot(a, b));
                angle.is_some_and(|cosine| cosine < self.cosine())
            };
            if found.len() < FACES && found.iter().all(is_new) {
                found.push(facet);
            }
        }
        found
    }

    /// Whether a point is no farther off the plane of a facet than its face may be off its place.
    fn may_lie_on(&self, asked: &Asked, facet: u32) -> bool {
        let sag = self.of.sag(self.beside.numbers[facet as usize]);
        // Where it rises, near the edge a face may be somewhat farther off than where it was measured.
        let farthest = 2.0 * self.highest + sag + self.of.belonging.reference.rounding;
        height(&self.beside.mesh, facet, asked.place).abs() <= farthest
    }

    /// Whose a point is that is off the feature, by the face that a facet beside it is of; `None` if it is not on this.
    fn on_face(&self, asked: &Asked, facet: u32, level: &Level) -> Option<Whose> {
        let Asked { place, off, of_piece, .. } = *asked;
        let OfOthers { belonging, own, .. } = *self.of;
        let facing = normal(&self.beside.mesh, facet)?;
        let near = self.others.clear.tree.k_nearest(&place, ASKED, None);
        let sag = self.of.sag(self.beside.numbers[facet as usize]);
        let Clear { places, heights, .. } = &self.others.clear;
        // As far off the plane of the facet as the surface has turned on the way there: the next step of a bore faces so too.
        let is_alike = |n: &u32| {
            let n = *n as usize;
            let (cosine, way) = (dot(self.others.facing[n], facing), norm(minus(places[n], place)));
            let off = (height(&self.beside.mesh, facet, places[n]) - heights[n]).abs();
            let turned = way * (1.0 - cosine * cosine).max(0.0).sqrt();
            cosine >= self.cosine() && off <= turned + sag + belonging.reference.rounding
        };
        let alike: Vec<u32> = near.iter().map(|n| n.1).filter(is_alike).take(AROUND).collect();
        if alike.len() < FEWEST {
            return None;
        }
        let of_face = self.others.clear.of(alike.iter().copied());
        let face = Level::at(place, facing, of_face, belonging.reference.rounding);
        let off_face = (height(&self.beside.mesh, facet, place) - face.height).abs() - sag;
        if off_face > face.slack {
            return None;
        }
        let mut offs: Vec<f64> = alike.iter().map(|n| self.others.off[*n as usize]).collect();
        let side = middle(&mut offs).signum();
        if side * (off - level.height) > level.slack {
            // A face that was hardly measured tells nothing for certain.
            let is_known = off_face <= FARTHEST * own.near.distance;
            return Some(if is_known { Whose::Face } else { Whose::Nobody });
        }
        // What goes on into the material counts, but for what only its way would tell to be of the face: the flank of a groove.
        let goes_on = off > level.height.max(0.0) + level.slack || of_piece;
        goes_on.then_some(Whose::Nobody)
    }

    fn cosine(&self) -> f64 {
        libm::cos(ALIKE * self.of.own.near.angle)
    }
}

impl OfOthers<'_> {
    /// Of these measured points, and of those of pieces beside the feature, those that are of a face beside it, and those that go on
    /// beyond the feature along such a face.
    ///
    /// Cost: one look at each measured point, a closest place on the faces beside for each of those asked, and neighbors of those near an
    /// edge.
    pub(super) fn at_edges(&self, points: &[u32], of_pieces: &[u32]) -> Result<[Vec<u32>; 2], Stop> {
        let Some(beside) = self.beside()? else { return Ok(Default::default()) };
        let (own_clear, asked) = self.clear_and_asked(&beside, points, of_pieces)?;
        let Some(own_clear) = own_clear.filter(|_| !asked.is_empty()) else { return Ok(Default::default()) };
        let others = self.others_clear();
        let highest = others.clear.heights.iter().fold(0.0, |m: f64, h| m.max(h.abs()));
        let edges = Edges { of: self, own_clear, others, beside, highest };
        let of = |asked: Asked| if self.progress.cancelled() { None } else { edges.whose(&asked) };
        let told: Vec<(u32, Whose)> = asked.into_par_iter().filter_map(of).collect();
        if self.progress.cancelled() {
            return Err(Stop::Cancelled);
        }
        let those = |whose| {
            let mut numbers: Vec<u32> = told.iter().filter(|t| t.1 == whose).map(|t| t.0).collect();
            numbers.sort_unstable();
            numbers
        };
        Ok([those(Whose::Face), those(Whose::Nobody)])
    }

    /// The points of the feature clear of its edges, `None` if too few are, and the points near an edge.
    fn clear_and_asked(
        &self,
        beside: &Beside,
        points: &[u32],
        of_pieces: &[u32],
    ) -> Result<(Option<Clear>, Vec<Asked>), Stop> {
        let own = self.own;
        let all = [points, of_pieces].concat();
        let places = self.places(&all);
        let hits = nearest(&beside.tree, &places, WALL_REACH * own.near.distance, self.progress)?;
        let away = |hit: &(u32, f64)| if hit.0 == u32::MAX { f64::INFINITY } else { hit.1 };
        let mut of_own: Vec<f64> = hits[..points.len()].iter().map(away).collect();
        // Of a narrow feature those are clear that half of the others are not.
        let clearance = middle(&mut of_own).min(own.near.distance);
        let (mut clear, mut heights, mut asked) = (vec![], vec![], vec![]);
        for (n, (place, hit)) in places.into_iter().zip(hits).enumerate() {
            let Some((off, out)) = own.surface.distance(place) else { continue };
            let off = own.side * off;
            if n < points.len() && away(&hit) >= clearance {
                clear.push(place);
                heights.push(off);
            }
            if hit.0 != u32::MAX {
                asked.push(Asked {
                    point: all[n],
                    place,
                    off,
                    out,
                    beside: hit.0,
                    away: hit.1,
                    of_piece: n >= points.len(),
                });
            }
        }
        let is_enough = clear.len() >= AROUND;
        Ok((is_enough.then(|| Clear { tree: PointTree::new(&clear), places: clear, heights }), asked))
    }

    /// The measured points near the feature that are of other faces and clear of it.
    fn others_clear(&self) -> OthersClear {
        let OfOthers { belonging, own, .. } = *self;
        let reference = belonging.reference.mesh;
        let reach = WALL_REACH * (own.near.distance + self.spacing);
        let bounds = Aabb::of(&own.mesh.positions).widened(reach);
        let (mut places, mut heights, mut facing, mut offs) = (vec![], vec![], vec![], vec![]);
        for ((face, _), place) in belonging.nearest.iter().zip(&belonging.measured.positions) {
            if *face == u32::MAX || !bounds.holds(place) || own.has(*face) {
                continue;
            }
            let Some((off, out)) = own.surface.distance(*place).map(|d| d.0).zip(normal(reference, *face))
            else {
                continue;
            };
            if off.abs() >= own.near.distance && off.abs() <= reach {
                places.push(*place);
                heights.push(height(reference, *face, *place));
                facing.push(out);
                offs.push(own.side * off);
            }
        }
        OthersClear { clear: Clear { tree: PointTree::new(&places), places, heights }, facing, off: offs }
    }

    /// `None` where the feature has an edge with none.
    fn beside(&self) -> Result<Option<Beside>, Stop> {
        let OfOthers { belonging, own, progress, .. } = *self;
        let same = SAME * belonging.reference.size;
        let reference = belonging.reference.mesh;
        let bounds = Aabb::of(&own.mesh.positions).widened(same);
        let near: Vec<u32> = belonging.reference.tree().in_box(&bounds);
        let near: Vec<u32> = near.into_iter().filter(|f| !own.has(*f)).collect();
        let mut corners: Vec<u32> = near.iter().flat_map(|f| reference.faces[*f as usize]).collect();
        corners.sort_unstable();
        corners.dedup();
        let places: Vec<Point> = corners.iter().map(|v| reference.positions[*v as usize]).collect();
        let hits = nearest(&own.tree, &places, same, progress)?;
        let cosine = libm::cos(own.near.angle);
        let has_edge = |face: &u32| {
            let Some(facing) = normal(reference, *face) else { return false };
            let facet = |v: &u32| corners.binary_search(v).ok().map(|n| hits[n].0);
            let touched = reference.faces[*face as usize].iter().filter_map(facet);
            let turns = |facet| normal(&own.mesh, facet).is_some_and(|n| dot(n, facing).abs() < cosine);
            touched.filter(|facet| *facet != u32::MAX).any(turns)
        };
        let numbers: Vec<u32> = near.into_iter().filter(has_edge).collect();
        if numbers.is_empty() {
            return Ok(None);
        }
        let mesh = part(reference, &numbers);
        let tree = Tree::build_watched(&mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        Ok(Some(Beside { numbers, mesh, tree }))
    }
}

/// The middle one of some numbers, which are sorted.
fn middle(numbers: &mut [f64]) -> f64 {
    numbers.sort_unstable_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(0.0)
}
