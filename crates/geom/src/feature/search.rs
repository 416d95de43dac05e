//! The facets of a mesh that belong to nominal features.

use super::rules::Rules;
use super::{FeatureError, Found, Nearness, Nominal};
use crate::closest::Tree;
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::Progress;
use crate::space::{Aabb, Point, cross, dot, minus, norm, normal, plus, times};

/// A mesh in which features are sought, with what every search needs: made once for all of them.
pub struct FeatureSearch<'a> {
    mesh: &'a Mesh,
    tree: Tree,
    /// Each side of a facet (three times its number and 0, 1 or 2) under its edge, in the order of edges and sides.
    sides: Vec<(u64, u64)>,
    /// Of each side, the place in `sides` where its edge begins.
    first: Vec<usize>,
}

impl<'a> FeatureSearch<'a> {
    /// Of a mesh with its own search tree. Cost: one sort of all sides, 40 bytes each.
    pub fn new(mesh: &'a Mesh, tree: Tree) -> FeatureSearch<'a> {
        let of = |(f, [a, b, c]): (usize, &[u32; 3])| {
            let edge = |p: &u32, q: &u32| u64::from(*p.min(q)) << 32 | u64::from(*p.max(q));
            let side = |k: u64| 3 * f as u64 + k;
            [(edge(a, b), side(0)), (edge(b, c), side(1)), (edge(c, a), side(2))]
        };
        let mut sides: Vec<(u64, u64)> = mesh.faces.iter().enumerate().flat_map(of).collect();
        sides.par_sort_unstable();
        let mut first = vec![0; sides.len()];
        let mut begin = 0;
        for (n, (edge, side)) in sides.iter().enumerate() {
            if sides[begin].0 != *edge {
                begin = n;
            }
            first[*side as usize] = begin;
        }
        FeatureSearch { mesh, tree, sides, first }
    }

    /// The search tree of the mesh.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The facets that belong to `nominal`, and their vertices.
    ///
    /// Facets without area, or with a vertex that does not exist, belong to nothing. An empty answer is no error: the feature
    /// was not measured. Cost: some closest points, one look at each facet next to those found, one at every facet and vertex, and another where
    /// no closest facet is of the feature.
    ///
    /// # Errors
    /// [`FeatureError`]: a nominal feature that makes no sense, [`FeatureError::Cancelled`].
    ///
    /// ```
    /// use trueness_geom::closest::Tree;
    /// use trueness_geom::feature::{FeatureSearch, Nearness, Nominal};
    /// use trueness_geom::mesh::Mesh;
    /// // A square floor of two facets, and a wall.
    /// let positions = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 9.0]];
    /// let mesh = Mesh { positions, faces: vec![[0, 1, 2], [0, 2, 3], [0, 4, 1]] };
    /// let boundary = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0]];
    /// let floor = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary };
    /// let near = Nearness { distance: 0.1, angle: 0.2, margin: 0.0, rim: true, inward: None };
    /// let search = FeatureSearch::new(&mesh, Tree::build(&mesh)?);
    /// let found = search.find(&floor, &near, &trueness_geom::progress::Silent)?;
    /// assert_eq!((found.facets, found.points), (vec![0, 1], vec![0, 1, 2, 3]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn find(
        &self,
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Found, FeatureError> {
        let rules = Rules::new(nominal, near)?;
        let belongs = |f: u32| {
            self.corners(f).is_some_and(|corners| normal(corners).is_some_and(|n| rules.facet(corners, n)))
        };
        let starts = rules.starts();
        let nearest = starts.iter().filter_map(|p| self.tree.closest(p, f64::INFINITY).ok().flatten());
        let mut open: Vec<u32> = nearest.map(|c| c.face).filter(|f| belongs(*f)).collect();
        if open.is_empty() {
            // The other side of a thin wall may be nearer.
            open = self.nearest_of(&starts, &rules, belongs);
        }
        open.sort_unstable();
        open.dedup();
        let mut found = Marked::new(self.mesh.faces.len());
        open.iter().for_each(|f| found.add(*f));
        let mut beside = vec![];
        while let Some(facet) = open.pop() {
            if found.added.len().is_multiple_of(1024) && progress.cancelled() {
                return Err(FeatureError::Cancelled);
            }
            for other in [0, 1, 2].into_iter().flat_map(|k| self.across(facet, k)) {
                if found.has(other) {
                    continue;
                }
                if belongs(other) {
                    found.add(other);
                    open.push(other);
                } else {
                    beside.push(other);
                }
            }
        }
        // A spike or a dent is steep and belongs to the feature all the same: what lies near and has the feature all around it.
        let is_near = |f: u32| self.corners(f).is_some_and(|c| rules.tilted(c, normal(c)));
        self.enclosed(&mut found, &beside, is_near, progress)?;
        Ok(self.with_points(&found, near.rim))
    }

    /// The vertices, ascending, of dents and bumps of what was `found` of `nominal` that are deeper than `near` allows: of facets with the
    /// feature all around them, none a wall that leads away from it, all within `reach` of it. None of them is part of the feature, which is
    /// the better for it.
    ///
    /// # Errors
    /// As of [`FeatureSearch::find`].
    ///
    /// ```
    /// use trueness_geom::closest::Tree;
    /// use trueness_geom::feature::{FeatureSearch, Nearness, Nominal};
    /// use trueness_geom::mesh::Mesh;
    /// // A floor of 4 by 4 squares whose middle is 2 deep.
    /// let at = |i: u32, j: u32| 5 * i + j;
    /// let mut positions: Vec<[f64; 3]> = (0..25).map(|v| [f64::from(v / 5), f64::from(v % 5), 0.0]).collect();
    /// positions[12][2] = -2.0;
    /// let square = |i, j| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]];
    /// let faces = (0..4).flat_map(|i| (0..4).flat_map(move |j| square(i, j))).collect();
    /// let mesh = Mesh { positions, faces };
    /// let boundary = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];
    /// let floor = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary };
    /// let near = Nearness { distance: 0.5, angle: 0.2, margin: 0.0, rim: true, inward: None };
    /// let search = FeatureSearch::new(&mesh, Tree::build(&mesh)?);
    /// let found = search.find(&floor, &near, &trueness_geom::progress::Silent)?;
    /// assert!(!found.points.contains(&12));
    /// assert_eq!(search.deeper(&found, &floor, &near, 3.0, &trueness_geom::progress::Silent)?, [12]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn deeper(
        &self,
        found: &Found,
        nominal: &Nominal,
        near: &Nearness,
        reach: f64,
        progress: &dyn Progress,
    ) -> Result<Vec<u32>, FeatureError> {
        let Some(surface) = nominal.surface() else { return Ok(vec![]) };
        let wide = Nearness { distance: reach.max(near.distance), ..*near };
        let rules = Rules::new(nominal, &wide)?;
        let mut own = Marked::new(self.mesh.faces.len());
        found.facets.iter().for_each(|f| own.add(*f));
        let all = found.facets.iter().flat_map(|f| [0, 1, 2].map(|k| (*f, k)));
        let beside: Vec<u32> = all.flat_map(|(f, k)| self.across(f, k)).filter(|f| !own.has(*f)).collect();
        let is_near = |f: u32| self.corners(f).is_some_and(|c| rules.tilted(c, normal(c)));
        let mut with_deeper = Marked::new(self.mesh.faces.len());
        found.facets.iter().for_each(|f| with_deeper.add(*f));
        self.enclosed(&mut with_deeper, &beside, is_near, progress)?;
        let mut vertices: Vec<u32> = with_deeper
            .all()
            .into_iter()
            .filter(|f| !own.has(*f))
            .flat_map(|f| self.mesh.faces[f as usize])
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let off = |v: &u32| surface.distance(self.mesh.positions[*v as usize]).map_or(0.0, |d| d.0.abs());
        vertices.retain(|v| off(v) > near.distance);
        Ok(vertices)
    }

    /// The facets, ascending, that lie within the reach and the bounds of `nominal` and face as what was `found` of it does, and
    /// are joined to it by none that keep its rules: the ground of a pocket, the top of a pad, a piece of something else. None
    /// of an edge.
    ///
    /// Cost: one look at each facet near it.
    ///
    /// # Errors
    /// As of [`FeatureSearch::find`].
    ///
    /// ```
    /// use trueness_geom::closest::Tree;
    /// use trueness_geom::feature::{FeatureSearch, Nearness, Nominal};
    /// use trueness_geom::mesh::Mesh;
    /// // A floor of two facets, and a third facet 0.2 above it.
    /// let square = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0]];
    /// let above = [[3.0, 3.0, 0.2], [6.0, 3.0, 0.2], [6.0, 6.0, 0.2]];
    /// let positions = [&square[..], &above].concat();
    /// let mesh = Mesh { positions, faces: vec![[0, 1, 2], [0, 2, 3], [4, 5, 6]] };
    /// let floor = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary: square.to_vec() };
    /// let near = Nearness { distance: 0.5, angle: 0.2, margin: 0.0, rim: true, inward: None };
    /// let search = FeatureSearch::new(&mesh, Tree::build(&mesh)?);
    /// let found = search.find(&floor, &near, &trueness_geom::progress::Silent)?;
    /// let apart = search.apart(&found, &floor, &near, &trueness_geom::progress::Silent)?;
    /// assert_eq!((&found.facets[..], &apart[..]), (&[0, 1][..], &[2][..]));
    /// assert_eq!(search.joined(&found, &apart, &near).points.len(), 7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn apart(
        &self,
        found: &Found,
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<u32>, FeatureError> {
        let Some(surface) = nominal.surface() else { return Ok(vec![]) };
        // Its corners are within reach: in the middle of a chord it may be a little farther off.
        let inside = Nearness { margin: near.margin.max(0.0), distance: f64::INFINITY, ..*near };
        let (rules, strict) = (Rules::new(nominal, near)?, Rules::new(nominal, &inside)?);
        // A tube faces both ways; what was found tells which of them is sought.
        let outward = |f: u32| -> Option<f64> {
            let corners = self.corners(f)?;
            Some(dot(normal(corners)?, surface.distance(center(corners))?.1))
        };
        let side: f64 = found.facets.iter().filter_map(|f| outward(*f)).map(f64::signum).sum();
        let belongs = |f: &u32| {
            let keeps = |corners| {
                normal(corners).is_some_and(|n| rules.facet(corners, n)) && strict.point(center(corners))
            };
            self.corners(*f).is_some_and(keeps) && outward(*f).is_some_and(|o| o * side > 0.0)
        };
        self.beside_found(found, &rules, belongs, progress)
    }

    /// The facets, ascending, whose middles lie within the reach and the bounds of `nominal` and that face otherwise, without being walls that lead
    /// away from it, and that are none of what was `found`: slopes that nothing of the feature encloses. None of an edge.
    ///
    /// Cost: one look at each facet near it.
    ///
    /// # Errors
    /// As of [`FeatureSearch::find`].
    ///
    /// ```
    /// use trueness_geom::closest::Tree;
    /// use trueness_geom::feature::{FeatureSearch, Nearness, Nominal};
    /// use trueness_geom::mesh::Mesh;
    /// // A floor of two facets, and two that rise along its side.
    /// let row = |x: f64, z: f64| [[x, 0.0, z], [x, 9.0, z]];
    /// let positions = [row(0.0, 0.0), row(8.0, 0.0), row(9.0, 0.4)].concat();
    /// let mesh = Mesh { positions, faces: vec![[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]] };
    /// let boundary = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0]];
    /// let floor = Nominal::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], boundary };
    /// let near = Nearness { distance: 0.5, angle: 0.2, margin: 0.0, rim: true, inward: None };
    /// let search = FeatureSearch::new(&mesh, Tree::build(&mesh)?);
    /// let found = search.find(&floor, &near, &trueness_geom::progress::Silent)?;
    /// let slopes = search.slopes(&found, &floor, &near, &trueness_geom::progress::Silent)?;
    /// assert_eq!((&found.facets[..], &slopes[..]), (&[0, 1][..], &[2, 3][..]));
    /// assert_eq!(search.of(&slopes, &near).points, [2, 3, 4, 5]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn slopes(
        &self,
        found: &Found,
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<u32>, FeatureError> {
        if matches!(nominal, Nominal::Edge { .. }) {
            return Ok(vec![]);
        }
        let inside = Nearness { margin: near.margin.max(0.0), ..*near };
        let rules = Rules::new(nominal, &inside)?;
        let slopes = |f: &u32| {
            let corners = self.corners(*f);
            let facing = corners.and_then(|c| Some((c, normal(c)?)));
            facing.is_some_and(|(c, n)| rules.sloped(center(c), n) && !rules.facet(c, n))
        };
        self.beside_found(found, &rules, slopes, progress)
    }

    /// The facets, ascending, near what `rules` tell of that are none of what was `found` and of which `is` says yes.
    fn beside_found(
        &self,
        found: &Found,
        rules: &Rules,
        is: impl Fn(&u32) -> bool + Sync,
        progress: &dyn Progress,
    ) -> Result<Vec<u32>, FeatureError> {
        let all = self.tree.in_box(&rules.bounds()).into_par_iter();
        let others = all.filter(|f| !progress.cancelled() && found.facets.binary_search(f).is_err());
        let others = others.filter(is).collect();
        if progress.cancelled() { Err(FeatureError::Cancelled) } else { Ok(others) }
    }

    /// These facets as what was found of a feature.
    pub fn of(&self, facets: &[u32], near: &Nearness) -> Found {
        let mut all = Marked::new(self.mesh.faces.len());
        facets.iter().for_each(|f| all.add(*f));
        self.with_points(&all, near.rim)
    }

    /// What was found of a feature, and these facets with it. Of a piece of them that has no vertices of its own, those of its rim
    /// count even where the rim does not: a pad of two facets is as high as they are.
    pub fn joined(&self, found: &Found, facets: &[u32], near: &Nearness) -> Found {
        let all: Vec<u32> = found.facets.iter().chain(facets).copied().collect();
        let mut joined = self.of(&all, near);
        if joined.rim.is_empty() {
            return joined;
        }
        let mut left = Marked::new(self.mesh.faces.len());
        facets.iter().for_each(|f| left.add(*f));
        let mut rims = vec![];
        for start in facets {
            let (mut piece, mut next) = (vec![], 0);
            if left.has(*start) {
                left.remove(*start);
                piece.push(*start);
            }
            while let Some(facet) = piece.get(next).copied() {
                next += 1;
                for other in [0, 1, 2].into_iter().flat_map(|k| self.across(facet, k)) {
                    if left.has(other) {
                        left.remove(other);
                        piece.push(other);
                    }
                }
            }
            let vertices = || piece.iter().flat_map(|f| self.mesh.faces[*f as usize]);
            if vertices().all(|v| joined.points.binary_search(&v).is_err()) {
                rims.extend(vertices());
            }
        }
        joined.points.extend(rims);
        joined.points.sort_unstable();
        joined.points.dedup();
        joined.rim.retain(|v| joined.points.binary_search(v).is_err());
        joined
    }

    /// Of the facets of which `is` says yes the nearest to each place, by their middles.
    fn nearest_of(&self, places: &[Point], rules: &Rules, is: impl Fn(u32) -> bool + Sync) -> Vec<u32> {
        let all: Vec<(u32, Point)> = (self.tree.in_box(&rules.bounds()).into_par_iter())
            .filter(|f| is(*f))
            .filter_map(|f| Some((f, center(self.corners(f)?))))
            .collect();
        let away = |p: &Point, q: &Point| norm(minus(*p, *q));
        let nearest = |p: &Point| {
            all.iter().min_by(|a, b| away(p, &a.1).total_cmp(&away(p, &b.1))).map(|found| found.0)
        };
        places.iter().filter_map(nearest).collect()
    }

    /// How far the round surface that a facet stands for may bulge over it, mm: for each side across which the mesh turns by less than
    /// `crease` radians, an eighth of the turn times the width there. 0 of a facet without area.
    ///
    /// ```
    /// use trueness_geom::closest::Tree;
    /// use trueness_geom::feature::FeatureSearch;
    /// use trueness_geom::mesh::Mesh;
    /// // Two chords of a circle of radius 5, a tenth of a radian each.
    /// let at = |k: i32| [5.0 * (0.1 * f64::from(k)).sin(), 5.0 * (0.1 * f64::from(k)).cos()];
    /// let positions = (-1..=1).flat_map(|k| [[at(k)[0], 0.0, at(k)[1]], [at(k)[0], 1.0, at(k)[1]]]).collect();
    /// let mesh = Mesh { positions, faces: vec![[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]] };
    /// let search = FeatureSearch::new(&mesh, Tree::build(&mesh)?);
    /// let arrow = 5.0 * (1.0 - 0.05_f64.cos());
    /// assert!((search.sag(0, 0.5) - arrow).abs() < 0.01 * arrow);
    /// assert_eq!(search.sag(0, 0.05), 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sag(&self, facet: u32, crease: f64) -> f64 {
        let Some((corners, own)) = self.corners(facet).and_then(|c| Some((c, normal(c)?))) else {
            return 0.0;
        };
        let [a, b, c] = corners;
        let twice = norm(cross(minus(b, a), minus(c, a)));
        let of_side = |k: usize| {
            let edge = norm(minus(corners[(k + 1) % 3], corners[k]));
            let facing = |f: u32| self.corners(f).and_then(normal);
            let turns =
                self.across(facet, k).filter_map(facing).map(|n| libm::acos(dot(own, n).clamp(-1.0, 1.0)));
            turns.filter(|turn| *turn < crease).fold(0.0, f64::max) * twice / edge / 8.0
        };
        [0, 1, 2].map(of_side).into_iter().fold(0.0, f64::max)
    }

    fn corners(&self, f: u32) -> Option<[Point; 3]> {
        let [a, b, c] = *self.mesh.faces.get(f as usize)?;
        let at = |v: u32| self.mesh.positions.get(v as usize).copied();
        Some([at(a)?, at(b)?, at(c)?])
    }

    /// The facets at a side of a facet, itself among them.
    fn across(&self, facet: u32, side: usize) -> impl Iterator<Item = u32> + '_ {
        let first = self.first[3 * facet as usize + side];
        let edge = self.sides[first].0;
        self.sides[first..].iter().take_while(move |s| s.0 == edge).map(|s| (s.1 / 3) as u32)
    }

    /// Adds the parts, of those that begin with `beside`, whose facets are all near and lie among others on all sides.
    fn enclosed(
        &self,
        found: &mut Marked,
        beside: &[u32],
        is_near: impl Fn(u32) -> bool,
        progress: &dyn Progress,
    ) -> Result<(), FeatureError> {
        let mut seen = Marked::new(self.mesh.faces.len());
        for start in beside.iter().copied() {
            if found.has(start) || seen.has(start) || !is_near(start) {
                continue;
            }
            seen.add(start);
            let (mut part, mut next, mut enclosed) = (vec![start], 0, true);
            while let Some(facet) = part.get(next).copied() {
                if next.is_multiple_of(1024) && progress.cancelled() {
                    return Err(FeatureError::Cancelled);
                }
                next += 1;
                for side in 0..3 {
                    // Nothing encloses what ends at a boundary edge.
                    enclosed &= self.across(facet, side).count() > 1;
                    for other in self.across(facet, side) {
                        if found.has(other) {
                            continue;
                        }
                        if !is_near(other) {
                            enclosed = false;
                        } else if !seen.has(other) {
                            seen.add(other);
                            part.push(other);
                        }
                    }
                }
            }
            if enclosed {
                part.into_iter().for_each(|f| found.add(f));
            }
        }
        Ok(())
    }

    /// These facets with their vertices; those that others share only with `rim`.
    fn with_points(&self, found: &Marked, rim: bool) -> Found {
        let facets = found.all();
        let area =
            |f: &u32| self.corners(*f).map_or(0.0, |[a, b, c]| 0.5 * norm(cross(minus(b, a), minus(c, a))));
        let mut points = Marked::new(self.mesh.positions.len());
        facets.iter().flat_map(|f| self.mesh.faces[*f as usize]).for_each(|v| points.add(v));
        let mut out = Marked::new(self.mesh.positions.len());
        if !rim {
            let near = Aabb::of(points.all().iter().map(|v| &self.mesh.positions[*v as usize]));
            let others = self.tree.in_box(&near).into_iter().filter(|f| !found.has(*f));
            let corners = others.flat_map(|f| self.mesh.faces[f as usize]);
            corners.filter(|v| points.has(*v)).for_each(|v| out.add(v));
            out.all().into_iter().for_each(|v| points.remove(v));
        }
        let area = facets.iter().map(area).sum();
        Found { area, facets, points: points.all(), rim: out.all() }
    }
}

fn center([a, b, c]: [Point; 3]) -> Point {
    times(1.0 / 3.0, plus(a, plus(b, c)))
}

/// A set of numbers below a limit.
struct Marked {
    is: Vec<bool>,
    /// Those that were ever added: far fewer than the limit.
    added: Vec<u32>,
}

impl Marked {
    fn new(limit: usize) -> Marked {
        Marked { is: vec![false; limit], added: vec![] }
    }

    fn has(&self, n: u32) -> bool {
        self.is.get(n as usize).copied().unwrap_or(false)
    }

    fn add(&mut self, n: u32) {
        if let Some(is) = self.is.get_mut(n as usize).filter(|is| !**is) {
            *is = true;
            self.added.push(n);
        }
    }

    fn remove(&mut self, n: u32) {
        if let Some(is) = self.is.get_mut(n as usize) {
            *is = false;
        }
    }

    /// All of them, ascending.
    fn all(&self) -> Vec<u32> {
        let mut all: Vec<u32> = self.added.iter().copied().filter(|n| self.has(*n)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}
