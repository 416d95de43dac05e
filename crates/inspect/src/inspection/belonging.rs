//! Where the measured data lie on the reference, and which points of a cloud belong to what is beside a feature.
//!
//! Nearness to a nominal surface alone does not tell the points of a plane from those at the upper end of a wall beside it, and a
//! cloud has no facets that would tell by their angle. Where the reference is at hand, it does: a point that lies upon one of
//! its facets that runs at an angle to the feature is none of the feature's. Upon: as near as most of the cloud lies to the
//! reference. Of what lies farther off, as a bore larger than its model, the planes of the neighbors of each point tell
//! which way it faces: a piece that faces away from the feature and goes on beyond it is of another surface if the
//! reference has one there that faces as it does. Everything else counts, so that no dent is taken for the wall beside it. Without a
//! reference such pieces are left out too, and nothing that depends on it passes.

use super::data::{Data, Stop};
use super::seed::Seeded;
use crate::plan::Plan;
use std::collections::BTreeMap;
use trueness_geom::closest::{Hit, Query, QueryError, Tree};
use trueness_geom::feature::{FeatureSearch, Nearness, Nominal, NominalSurface, Piece};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::space::{self, Point, Vector, dot, minus, norm, plus, times};
use trueness_geom::spatial::neighbors::PointTree;

/// Points farther off than this share of the size of the reference are of something else.
pub(super) const ELSEWHERE: f64 = 0.1;
/// So many times the median distance from the reference a point lies upon it: above three standard deviations of noise.
const UPON: f64 = 5.0;
/// But no farther than this share of the distance up to which points are sought.
const FARTHEST: f64 = 0.25;
/// So many times the distance up to which points are sought, or within which they lie upon the reference, a wall may be off its place.
const WALL_REACH: f64 = 3.0;
/// A piece is of the reference if this share of its points is.
const MOST: f64 = 0.75;
/// So many times nearer a face is clearly the nearer one.
const NEARER: f64 = 2.0;
/// Most steps along an edge.
const STEPS: f64 = 1e4;
/// A facet of the reference may be off the surface of the nominal by this share of the distance up to which points are sought.
const ON: f64 = 1e-3;
/// So many times the angle that a feature allows others of the reference may be turned against it that face as it does.
const ALIKE: f64 = 2.0;
/// Distances that differ by less than this share of the size of the reference are the same.
const SAME: f64 = 1e-9;

/// The measured data on the reference.
pub(super) struct Belonging<'a> {
    reference: &'a Mesh,
    measured: &'a [Point],
    /// Of the features that the reference has.
    search: FeatureSearch<'a>,
    size: f64,
    /// Of each measured point the nearest facet and how far off it is, mm; `u32::MAX` for what is elsewhere.
    nearest: Vec<(u32, f64)>,
    /// Median of the distances, mm.
    median: f64,
    /// A step of single precision, which meshes pass through in their files, mm.
    rounding: f64,
}

impl<'a> Belonging<'a> {
    /// Where there is a reference and a feature is sought by a nominal. Cost: a search tree, and a closest place for each measured
    /// point.
    pub fn new(
        plan: &Plan,
        data: &'a Data,
        seeds: &BTreeMap<usize, Seeded>,
        progress: &dyn Progress,
    ) -> Result<Option<Belonging<'a>>, Stop> {
        let sought = !seeds.is_empty() || plan.features.iter().any(|f| f.nominal.is_some());
        let (Some(measured), Some(reference)) = (&data.measured, &data.reference) else { return Ok(None) };
        if !sought || reference.faces.is_empty() {
            return Ok(None);
        }
        let tree = Tree::build_watched(reference, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let bounds = reference.bounds();
        let size = bounds.diagonal();
        let greatest = bounds.min.iter().chain(&bounds.max).fold(0.0, |m: f64, x| m.max(x.abs()));
        let rounding = f64::from(f32::EPSILON) * greatest;
        let nearest = nearest(&tree, &measured.positions, ELSEWHERE * size, progress)?;
        let mut all: Vec<f64> = nearest.iter().filter(|n| n.0 != u32::MAX).map(|n| n.1).collect();
        all.sort_unstable_by(f64::total_cmp);
        let median = all.get(all.len() / 2).copied().unwrap_or(0.0);
        let search = FeatureSearch::new(reference, tree);
        Ok(Some(Belonging {
            reference,
            measured: &measured.positions,
            search,
            size,
            nearest,
            median,
            rounding,
        }))
    }

    /// How far off the measured points are whose nearest facet is one of the nominal's, where that is beyond its distance, mm.
    pub fn beyond(&self, nominal: &Nominal, near: &Nearness, progress: &dyn Progress) -> Vec<f64> {
        let own = self.facets(nominal, near, progress);
        let far = |(face, off): &&(u32, f64)| *off > near.distance && own.binary_search(face).is_ok();
        self.nearest.iter().filter(far).map(|(_, off)| *off).collect()
    }

    /// Those of these measured points that lie upon facets beside the nominal.
    pub fn upon_others(
        &self,
        points: &[u32],
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<u32>, Stop> {
        if matches!(nominal, Nominal::Edge { .. }) {
            return Ok(vec![]);
        }
        // All of the face counts, however its facets lie to its bounds.
        let whole = Nearness { margin: -near.distance, ..*near };
        let own = self.facets(nominal, &whole, progress);
        let upon = (UPON * self.median).min(FARTHEST * near.distance).max(self.rounding);
        let is_upon_other = |p: &u32| {
            let (face, off) = self.nearest[*p as usize];
            face != u32::MAX && off <= upon && own.binary_search(&face).is_err()
        };
        let doubtful: Vec<u32> = points.iter().copied().filter(is_upon_other).collect();
        if own.is_empty() || doubtful.is_empty() {
            return Ok(vec![]);
        }
        let mesh = self.part(own.iter().copied());
        let tree = Tree::build_watched(&mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let asked: Vec<Point> = doubtful.iter().map(|p| self.measured[*p as usize]).collect();
        let on_own = nearest(&tree, &asked, f64::INFINITY, progress)?;
        let is_other = |(p, (own, away)): (&u32, (u32, f64))| {
            let (face, off) = self.nearest[*p as usize];
            let angle = normal(self.reference, face).zip(normal(&mesh, own)).map(|(a, b)| dot(a, b).abs());
            // A wall of a thin part runs along the other one: which of them a point is of is not told by its place.
            let aside = angle.is_some_and(|cosine| cosine < libm::cos(near.angle));
            (aside && off + SAME * self.size < away).then_some(*p)
        };
        Ok(doubtful.iter().zip(on_own).filter_map(is_other).collect())
    }

    /// Whether each of these places, of facets found for a nominal, is of a face of the reference beside it: beyond where its own ends, and
    /// clearly nearer to that face, as on a fillet that leaves it as a tangent.
    pub fn beside(
        &self,
        places: &[Point],
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let (own, Some(surface)) = (self.on_surface(nominal, near, progress), nominal.surface()) else {
            return Ok(vec![false; places.len()]);
        };
        if own.is_empty() {
            return Ok(vec![false; places.len()]);
        }
        // What lies on the surface of the nominal is no other face, however it was cut into facets.
        let is_other = |f: u32| !self.is_on(&surface, f, near);
        let on_all = nearest(self.search.tree(), places, f64::INFINITY, progress)?;
        let asked: Vec<usize> =
            (0..places.len()).filter(|n| on_all[*n].0 != u32::MAX && is_other(on_all[*n].0)).collect();
        let mut beside = vec![false; places.len()];
        if asked.is_empty() {
            return Ok(beside);
        }
        let part = self.part(own.iter().copied());
        let tree = Tree::build_watched(&part, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let of: Vec<Point> = asked.iter().map(|n| places[*n]).collect();
        for (n, (face, away)) in asked.into_iter().zip(nearest(&tree, &of, f64::INFINITY, progress)?) {
            let corner = part.positions[part.faces[face as usize][0] as usize];
            let over = normal(&part, face).map_or(0.0, |way| dot(minus(places[n], corner), way).abs());
            let aside = (away * away - over * over).max(0.0).sqrt();
            // At a sharp edge that is off its place both are as near.
            beside[n] = aside > over && NEARER * on_all[n].1 <= away;
        }
        Ok(beside)
    }

    /// Whether each of these places, of facets that face as the nominal does, is nearer to the facets of the nominal than to others
    /// that face so too, as the ground of a pocket that the reference has.
    pub fn nearer(
        &self,
        places: &[Point],
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let own = self.on_surface(nominal, near, progress);
        let Some(surface) = nominal.surface().filter(|_| !own.is_empty()) else {
            return Ok(vec![true; places.len()]);
        };
        let outward = |f: u32| {
            let corners = self.reference.faces[f as usize].map(|v| self.reference.positions[v as usize]);
            let way = surface.distance(times(1.0 / 3.0, plus(corners[0], plus(corners[1], corners[2]))));
            way.zip(space::normal(corners)).map_or(0.0, |((_, way), facing)| dot(way, facing))
        };
        let side: f64 = own.iter().map(|f| outward(*f).signum()).sum::<f64>().signum();
        let alike = libm::cos(ALIKE * near.angle);
        let others = (0..self.reference.faces.len() as u32)
            .filter(|f| !self.is_on(&surface, *f, near) && side * outward(*f) >= alike);
        let [own, others] = [self.part(own.iter().copied()), self.part(others)];
        if others.faces.is_empty() {
            return Ok(vec![true; places.len()]);
        }
        let away = |mesh: &Mesh| -> Result<Vec<(u32, f64)>, Stop> {
            let tree = Tree::build_watched(mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
            nearest(&tree, places, f64::INFINITY, progress)
        };
        Ok(away(&own)?.into_iter().zip(away(&others)?).map(|(own, other)| own.1 <= other.1).collect())
    }

    /// Keeps those of some pieces beside the nominal that the reference has too: near most of their points it has a surface, not
    /// the nominal's, that faces as the piece does, at least twice as nearly as the nominal's surface.
    pub fn known(
        &self,
        mut pieces: Vec<Piece>,
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<Piece>, Stop> {
        let whole = Nearness { margin: -near.distance, ..*near };
        let (own, Some(surface)) = (self.facets(nominal, &whole, progress), nominal.surface()) else {
            return Ok(vec![]);
        };
        let others =
            self.part((0..self.reference.faces.len() as u32).filter(|f| own.binary_search(f).is_err()));
        if own.is_empty() || others.faces.is_empty() || pieces.is_empty() {
            return Ok(vec![]);
        }
        let tree = Tree::build_watched(&others, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let reach = WALL_REACH * near.distance.max(UPON * self.median);
        let angle = |a: Vector, b: Vector| libm::acos(dot(a, b).abs().min(1.0));
        let mut known = vec![];
        for piece in &pieces {
            let places: Vec<Point> = piece.points.iter().map(|p| self.measured[p.0 as usize]).collect();
            let hits = nearest(&tree, &places, reach, progress)?;
            let is_there = |n: usize| {
                let facing = piece.points[n].1;
                let other = normal(&others, hits[n].0).map(|n| angle(n, facing));
                let nominal = surface.distance(places[n]).map(|(_, way)| angle(way, facing));
                other.zip(nominal).is_some_and(|(other, nominal)| NEARER * other <= nominal)
            };
            let there = (0..places.len()).filter(|n| is_there(*n)).count();
            known.push(there as f64 >= MOST * places.len() as f64);
        }
        let mut known = known.into_iter();
        pieces.retain(|_| known.next().unwrap_or(false));
        Ok(pieces)
    }

    /// Some facets of the reference.
    fn part(&self, facets: impl Iterator<Item = u32>) -> Mesh {
        let faces = facets.map(|f| self.reference.faces[f as usize]).collect();
        Mesh { positions: self.reference.positions.clone(), faces }
    }

    /// Whether each of these places lies over the nominal's facets of the reference, farther inside than its `distance` from where they
    /// end, or outside the material: edges that were broken or rounded are within that distance, and lack material.
    pub fn over(
        &self,
        places: &[Point],
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let own = self.on_surface(nominal, near, progress);
        if own.is_empty() || places.is_empty() {
            return Ok(vec![false; places.len()]);
        }
        let part = self.part(own.iter().copied());
        let border = PointTree::new(&along_border(&part, 0.5 * near.distance));
        let hits = nearest(self.search.tree(), places, ELSEWHERE * self.size, progress)?;
        let inside = |p: &Point| {
            border.nearest(p).is_none_or(|(square, _)| square > 2.0 * near.distance * near.distance)
        };
        let outside = |p: &Point, face: u32| {
            let corner = self.reference.positions[self.reference.faces[face as usize][0] as usize];
            normal(self.reference, face).is_some_and(|out| dot(minus(*p, corner), out) > self.rounding)
        };
        let over = |(p, hit): (&Point, (u32, f64))| {
            own.binary_search(&hit.0).is_ok() && (inside(p) || outside(p, hit.0))
        };
        Ok(places.iter().zip(hits).map(over).collect())
    }

    /// The facets of the reference that lie on the surface of the nominal and within its bounds, ascending. The ground of a shallow pocket
    /// and the begin of a fillet are within its reach, and none of it.
    fn on_surface(&self, nominal: &Nominal, near: &Nearness, progress: &dyn Progress) -> Vec<u32> {
        let Some(surface) = nominal.surface() else { return vec![] };
        let whole = Nearness { margin: -near.distance, ..*near };
        let mut own = self.facets(nominal, &whole, progress);
        own.retain(|f| self.is_on(&surface, *f, near));
        own
    }

    fn is_on(&self, surface: &NominalSurface, facet: u32, near: &Nearness) -> bool {
        let on = (ON * near.distance).max(self.rounding);
        let off = |v: u32| surface.distance(self.reference.positions[v as usize]).map_or(0.0, |d| d.0.abs());
        self.reference.faces[facet as usize].iter().all(|v| off(*v) <= on)
    }

    /// The facets of the reference that the nominal names, ascending: those joined to where it is begun, and those of its surface that
    /// lie apart, beyond a groove or a slot.
    fn facets(&self, nominal: &Nominal, near: &Nearness, progress: &dyn Progress) -> Vec<u32> {
        let Some(surface) = nominal.surface() else { return vec![] };
        let Ok(found) = self.search.find(nominal, near, progress) else { return vec![] };
        let mut all = self.search.apart(&found, nominal, near, progress).unwrap_or_default();
        all.retain(|f| self.is_on(&surface, *f, near));
        all.extend(&found.facets);
        all.sort_unstable();
        all
    }
}

/// Places along the edges of a mesh that one facet alone has, no farther apart than `step`.
fn along_border(mesh: &Mesh, step: f64) -> Vec<Point> {
    let mut places = vec![];
    let positions = &mesh.positions;
    let mut sides: Vec<[u32; 2]> = (mesh.faces.iter())
        .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [*a.min(b), *a.max(b)])
        .collect();
    sides.sort_unstable();
    for edge in sides.chunk_by(|a, b| a == b).filter(|edge| edge.len() == 1).map(|edge| edge[0]) {
        let [a, b] = edge.map(|v| positions[v as usize]);
        let steps = (norm(minus(b, a)) / step).ceil().clamp(1.0, STEPS);
        places.extend((0..=steps as u32).map(|k| plus(a, times(f64::from(k) / steps, minus(b, a)))));
    }
    places
}

/// The nearest facet to each place and how far off it is; `u32::MAX` beyond `farthest`.
fn nearest(
    tree: &Tree,
    places: &[Point],
    farthest: f64,
    progress: &dyn Progress,
) -> Result<Vec<(u32, f64)>, Stop> {
    let query = Query { max_distance: farthest, ..Query::default() };
    let of = |hit: Option<Hit>| hit.map_or((u32::MAX, 0.0), |h| (h.face, h.distance()));
    tree.map_closest(places, &query, progress, |_, hit| of(hit)).map_err(|e| match e {
        QueryError::Cancelled(_) => Stop::Cancelled,
        e => Stop::Mesh(e.to_string()),
    })
}

fn normal(mesh: &Mesh, face: u32) -> Option<Vector> {
    space::normal(mesh.faces.get(face as usize)?.map(|v| mesh.positions[v as usize]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inspection::run;
    use trueness_geom::num::random::Random;
    use trueness_geom::progress::Silent;

    /// A bar along y: its top at z = 0 from x = −10 to 10, then a quarter of a circle of radius 2 in steps of 10°, or a wall.
    fn bar(fillet: bool) -> Mesh {
        let mut profile = vec![[-10.0, -8.0], [-10.0, 0.0], [10.0, 0.0]];
        if fillet {
            let turn = |i: i32| f64::from(10 * i).to_radians();
            profile
                .extend((1..=9).map(|i| [10.0 + 2.0 * libm::sin(turn(i)), 2.0 * libm::cos(turn(i)) - 2.0]));
        }
        let last = profile[profile.len() - 1][0];
        profile.push([last, -8.0]);
        // From fifty to a hundred points along each side, so that every place of the surface is near one.
        let mut mesh = Mesh::default();
        let n = 50u32;
        for side in profile.windows(2) {
            let first = mesh.positions.len() as u32;
            for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
                let [s, t] = [i, j].map(|k| f64::from(k) / f64::from(n));
                let [x, z] = [0, 1].map(|k| side[0][k] + s * (side[1][k] - side[0][k]));
                mesh.positions.push([x, 20.0 * t, z]);
                if i < n && j < n {
                    let a = first + i * (n + 1) + j;
                    mesh.faces.extend([[a, a + n + 1, a + 1], [a + 1, a + n + 1, a + n + 2]]);
                }
            }
        }
        mesh
    }

    /// Flatness of the plane z = 0 over a rectangle in x and y from the points of a cloud, and how many they are.
    fn flatness(
        cloud: &Mesh,
        reference: Option<&Mesh>,
        bounds: [[f64; 2]; 2],
        extract: &str,
    ) -> (f64, usize) {
        let cloud = Mesh { positions: cloud.positions.clone(), faces: vec![] };
        // Nobody writes a nominal to the last digit.
        of_plane(cloud, reference, bounds, (1e-4, extract))
    }

    /// The same of a mesh or a cloud, for a nominal that leans.
    fn of_plane(
        measured: Mesh,
        reference: Option<&Mesh>,
        [[a, b], [c, d]]: [[f64; 2]; 2],
        (leaning, extract): (f64, &str),
    ) -> (f64, usize) {
        let plan = Plan::parse(&format!(
            r#"
            schema = "trueness/plan/1"
            measured = "part.stl"
            [[feature]]
            id = "A"
            shape = "plane"
            extract = {{ {extract} }}
            [feature.nominal]
            point = [0, 0, 0]
            normal = [{leaning}, 0, 1]
            boundary = [[{a}, {c}, 0], [{b}, {c}, 0], [{b}, {d}, 0], [{a}, {d}, 0]]
            [[characteristic]]
            id = "1"
            kind = "flatness"
            feature = "A"
            tolerance = 0.1
            "#
        ))
        .unwrap();
        let data = Data { measured: Some(measured), reference: reference.cloned(), ..Data::default() };
        let found = run(&plan, data, &Silent).unwrap();
        (found.values[0].as_ref().unwrap().value, found.features[0].points.len())
    }

    const TOP: [[f64; 2]; 2] = [[-10.0, 10.0], [0.0, 20.0]];

    /// Facets of a fillet face nearly as the plane that it leaves, and are none of it; nothing over the plane itself is lost with them.
    #[test]
    fn facets_of_a_fillet_are_no_part_of_the_plane() {
        // One surface: without it facets of the fillet are beside those of the plane and joined to none of them.
        let whole = || {
            let bar = bar(true);
            let place =
                |p: &Point| bar.positions.iter().position(|q| norm(minus(*p, *q)) < 1e-9).unwrap() as u32;
            let places: Vec<u32> = bar.positions.iter().map(place).collect();
            let faces = bar.faces.iter().map(|f| f.map(|v| places[v as usize])).collect();
            Mesh { positions: bar.positions, faces }
        };
        let model = whole();
        let of = |measured, reference| of_plane(measured, reference, TOP, (0.0, "distance = 0.5")).0;
        // The first ten degrees of the fillet.
        let leak = 2.0 - 2.0 * libm::cos(10f64.to_radians());
        let without = of(whole(), None);
        assert!((without - leak).abs() < 0.01, "{without} {leak}");
        assert!(of(whole(), Some(&model)) < 1e-9);
        // Dents of the plane next to the fillet, and the same part somewhat off its place, across and along.
        for height in [0.04, -0.04] {
            let mut dented = whole();
            let near =
                |p: &&mut Point| p[2] == 0.0 && (p[0] - 9.6).abs() < 0.01 && (p[1] - 10.0).abs() < 0.01;
            let moved = dented.positions.iter_mut().filter(near).map(|p| p[2] += height).count();
            assert_eq!(moved, 1);
            let value = of(dented, Some(&model));
            assert!((value - 0.04).abs() < 1e-6, "{height} {value}");
        }
        for shift in [[0.1, 0.0, 0.02], [-0.1, 0.0, -0.02]] {
            let mut off = whole();
            off.positions.iter_mut().for_each(|p| *p = plus(*p, shift));
            let value = of(off, Some(&model));
            assert!(value < 0.02, "{shift:?} {value}");
        }
    }

    /// Neither the upper ends of the walls nor the fillet, but for what faces as it does, are part of the plane between them.
    #[test]
    fn what_is_beside_a_plane_is_no_part_of_it() {
        let wall = bar(false);
        for extract in ["distance = 0.5", "distance = 0.5, margin = 0"] {
            let (value, points) = flatness(&wall, Some(&wall), TOP, extract);
            assert!(value < 1e-9 && points >= 49 * 49, "{extract}: {value} {points}");
        }
        // The way it goes tells the wall without a reference too, but for its rim, which lies on both.
        let (value, points) = flatness(&wall, None, TOP, "distance = 0.5");
        assert!(value < 1e-9 && points >= 49 * 51, "{value} {points}");
        let fillet = bar(true);
        let wide = "distance = 0.5, margin = -2";
        // All of it that is within reach would make 0.5.
        assert!(flatness(&fillet, None, TOP, wide).0 < 0.25);
        let (value, points) = flatness(&fillet, Some(&fillet), TOP, wide);
        // Its second facet of 10 degrees lies at 15.
        assert!(value < 2.0 * (1.0 - libm::cos(20f64.to_radians())) + 1e-3, "{value}");
        assert!(points >= 51 * 51, "{points}");
    }

    /// Sparse points with noise, whose tail lies farther off the wall than most of the cloud, on a wall beside a top that is too high:
    /// near the edge all planes of neighbors mix both.
    #[test]
    fn what_noise_carries_off_a_wall_is_no_part_of_the_plane_beside_it() {
        let (reference, sigma) = (bar(false), 0.003);
        for high in [0.0, 0.05, 0.1] {
            let random = &mut Random::new(7);
            let mut normal = || sigma * ((0..12).map(|_| random.unit()).sum::<f64>() - 6.0);
            let noise: Vec<f64> = (0..3000).map(|_| normal()).collect();
            let mut place = |low: f64, top: f64| low + (top - low) * random.unit();
            let of_top = noise[..1500].iter().map(|n| [place(-10.0, 10.0), place(0.0, 20.0), high + n]);
            let of_top: Vec<Point> = of_top.collect();
            let of_wall = noise[1500..].iter().map(|n| [10.0 + n, place(0.0, 20.0), place(-8.0, high)]);
            let positions = [of_top, of_wall.collect()].concat();
            let cloud = Mesh { positions, faces: vec![] };
            let (value, points) = flatness(&cloud, Some(&reference), TOP, "distance = 0.5");
            let range = noise[..1500].iter().fold([0.0f64; 2], |[a, b], n| [a.min(*n), b.max(*n)]);
            assert!(value < 1.5 * (range[1] - range[0]), "{high}: {value} {range:?}");
            assert!((1450..1550).contains(&points), "{high}: {points}");
        }
    }

    /// Points with these deviations from the plane z = 0.
    fn lowered(mesh: &Mesh, by: impl Fn(f64, f64) -> f64) -> Mesh {
        let mut mesh = mesh.clone();
        mesh.positions.iter_mut().filter(|p| p[2] == 0.0).for_each(|p| p[2] -= by(p[0], p[1]));
        mesh
    }

    /// Whatever lies beside or below it, no defect is taken for something else.
    #[test]
    fn defects_of_a_plane_stay_with_it() {
        // A sheet of thickness 1 with a dent deeper than half of it.
        let mut sheet = bar(false);
        let below: Vec<Point> = sheet.positions.iter().map(|p| [p[0], p[1], -1.0]).collect();
        let first = sheet.positions.len() as u32;
        sheet.faces.extend(sheet.faces.clone().iter().map(|[a, b, c]| [a + first, c + first, b + first]));
        sheet.positions.extend(below);
        let dented = lowered(&sheet, |x, y| if libm::hypot(x, y - 10.0) < 3.0 { 0.7 } else { 0.0 });
        let (value, _) = flatness(&dented, Some(&sheet), TOP, "distance = 0.8");
        assert!(value > 0.65, "{value}");
        // A bar, narrow or wide, worn down towards one end, deeper than half its width; and a dent beside its rim.
        for width in [0.2, 1.0] {
            let mut rib = bar(false);
            rib.positions.iter_mut().for_each(|p| p[0] *= 0.1 * width);
            let worn = lowered(&rib, |_, y| 0.05 * (y - 10.0).max(0.0));
            let across = [TOP[0].map(|x| 0.1 * width * x), TOP[1]];
            let (value, _) = flatness(&worn, Some(&rib), across, "distance = 0.6");
            // Half of its slope lies flat, half falls by 0.5: a quarter is left between two planes.
            assert!((0.22..0.3).contains(&value), "{width}: {value}");
        }
        let wall = bar(false);
        let nick = |x: f64, y: f64| if x > 9.0 && (y - 10.0).abs() < 3.0 { 0.3 } else { 0.0 };
        let (value, _) = flatness(&lowered(&wall, nick), Some(&wall), TOP, "distance = 0.5, margin = 0.3");
        assert!(value > 0.25, "{value}");
    }
}
