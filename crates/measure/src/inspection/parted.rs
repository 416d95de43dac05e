//! The measured data parted among faces, and what of them is of a feature.

use super::measured;
use super::nominals::Nominals;
use super::own_faces::OwnFaces;
use super::stop::{NominalFault, Stop};
use crate::area::mesh_area;
use crate::characteristic::{ExcludedPoints, Others};
use crate::plan::Plan;
use std::collections::BTreeMap;
use std::sync::OnceLock;
use trueness_geom::feature::{FeatureError, Found, Nearness, Nominal, facets_near, in_cloud};
use trueness_geom::mesh::FacetsAround;
use trueness_geom::partition::{
    Beyond, Class, Face, Faces, NO_FACE, Options, Partition, PartitionError, partition,
};
use trueness_geom::progress::Progress;
use trueness_geom::scan::Scan;
use trueness_geom::space::{Point, cross, dot, minus, plus, times};

/// The measured data parted among faces.
pub(super) struct Parted<'a> {
    scan: &'a Scan,
    nominals: &'a Nominals,
    /// The faces beside those of the reference: nominals that it does not have, and what else was measured where there is no reference.
    more: Faces,
    /// Of features that the reference does not have, their faces.
    own: BTreeMap<usize, OwnFaces>,
    partition: Partition,
    /// Of each face its points and its facets, ascending.
    points: Vec<Vec<u32>>,
    facets: Vec<Vec<u32>>,
    /// The facets of none.
    loose: Vec<u32>,
    /// The facets about each vertex.
    around: OnceLock<FacetsAround>,
}

/// Share of the greatest distance from its borders that a point of a face has, up to which a margin leaves points out there: some of a narrow face stays.
const MAX_MARGIN_SHARE: f64 = 0.5;

/// Share of the area of a face from which on facets along it without corners of their own may be a step.
const MIN_STEP_AREA_SHARE: f64 = 0.05;
/// Points of a face from which on those at its edges are not needed.
const MIN_INNER_POINTS: usize = 20;
/// Points farther off than this share of the size of what was measured are of something else.
const MAX_OFF_SIZE_SHARE: f64 = 0.1;
/// Cosine of the angle (60°) up to which a face lies along a nominal.
const MIN_ALONG_COSINE: f64 = 0.5;

/// What is of a feature.
pub(super) struct OfFeature {
    pub found: Found,
    /// The points that tell how much of it was measured, where those found are others.
    pub covering: Option<Vec<u32>>,
    pub others: Others,
    pub left_out: Option<ExcludedPoints>,
}

impl<'a> Parted<'a> {
    /// `None` where no feature is a face. Cost: one partition, and one segmentation of the measured data where there is no reference.
    pub fn new(
        plan: &Plan,
        scan: &'a Scan,
        nominals: &'a Nominals,
        seed: u64,
        progress: &dyn Progress,
    ) -> Result<Option<Parted<'a>>, Stop> {
        let of_reference = nominals.faces.as_ref().map_or(&[][..], |faces| &faces.all);
        let first = of_reference.len() as u32;
        let (mut more, mut own) = (Faces::none(), BTreeMap::new());
        for (number, feature) in plan.features.iter().enumerate() {
            let nominal = nominals.of(number, feature).filter(|_| nominals.own(number).is_none());
            let Some(nominal) = nominal else { continue };
            let near = feature.near(nominal);
            let inward = near.inward.or_else(|| inward(scan, nominal, &near));
            // An edge is no face; what makes no sense is told where it is sought.
            if let Ok(face) = more.add_nominal(nominal, inward == Some(true)) {
                own.insert(number, OwnFaces { faces: vec![first + face], inward, is_over: true, part: None });
            }
        }
        let reaches = reaches(plan, nominals, &own);
        if reaches.is_empty() {
            return Ok(None);
        }
        if of_reference.is_empty() {
            measured::add(&mut more, scan, plan, seed, progress)?;
        }
        let faces: Vec<&Face> = of_reference.iter().chain(&more.all).collect();
        let distance = reaches.values().copied().reduce(f64::max).filter(|_| of_reference.is_empty());
        let options = Options { distance, reaches, seed };
        let partition = partition(scan, &faces, &options, progress).map_err(|e| match e {
            PartitionError::Cancelled(e) => e.into(),
            e @ (PartitionError::Nominal(_) | PartitionError::Reach { .. }) => {
                Stop::Nominal(NominalFault::Partition(e))
            }
            e => Stop::Mesh(e),
        })?;
        let of_faces = |labels: &[u32]| {
            let mut all = vec![vec![]; faces.len()];
            for (number, face) in (0u32..).zip(labels).filter(|l| *l.1 != NO_FACE) {
                all[*face as usize].push(number);
            }
            all
        };
        let (points, facets) = (of_faces(&partition.owners), of_faces(&partition.facets));
        let loose = (0..).zip(&partition.facets).filter(|f| *f.1 == NO_FACE).map(|f| f.0).collect();
        let around = OnceLock::new();
        Ok(Some(Parted { scan, nominals, more, own, partition, points, facets, loose, around }))
    }

    /// What was parted: a cloud with each place once.
    pub fn scan(&self) -> &Scan {
        self.scan
    }

    /// How it was parted.
    pub fn partition(&self) -> &Partition {
        &self.partition
    }

    /// The faces of a feature; `None` of an edge, and of what was not sought.
    pub fn own(&self, number: usize) -> Option<&OwnFaces> {
        self.nominals.own(number).or_else(|| self.own.get(&number))
    }

    fn face(&self, number: u32) -> &Face {
        let of_reference = self.nominals.faces.as_ref().map_or(&[][..], |faces| &faces.all);
        let number = number as usize;
        of_reference.get(number).unwrap_or_else(|| &self.more.all[number - of_reference.len()])
    }

    /// Whether a point is of another face than these: where no reference tells, of one that faces otherwise.
    pub fn is_of_others(&self, point: u32, own: &OwnFaces, nominal: &Nominal) -> bool {
        let owner = self.partition.owners[point as usize];
        let is_other = owner != NO_FACE && !own.faces.contains(&owner);
        if !is_other || self.nominals.faces.is_some() {
            return is_other;
        }
        let place = self.scan.points()[point as usize];
        let way = nominal.surface().and_then(|s| s.distance(place));
        let along = self.face(owner).facing(&place).zip(way).map(|(a, (_, b))| dot(a, b).abs());
        along.is_none_or(|cosine| cosine < MIN_ALONG_COSINE)
    }

    /// What is of a feature that has these faces; with `outliers` those that stick out by themselves are of it too.
    ///
    /// # Errors
    /// [`FeatureError`]: a nominal feature that makes no sense.
    pub fn of(
        &self,
        (number, own): (usize, &OwnFaces),
        (nominal, near): (&Nominal, &Nearness),
        outliers: bool,
    ) -> Result<OfFeature, FeatureError> {
        let scan = self.scan;
        let within = Within { parted: self, own, nominal, near, outliers };
        let own_facets = of_faces(own, &self.facets);
        let mut corners: Vec<u32> = own_facets.iter().flat_map(|f| scan.facets()[*f as usize]).collect();
        let mut points: Vec<u32> = self.of_class(own, Class::Face);
        let alone = self.of_class(own, Class::Alone);
        if outliers {
            points.extend(&alone);
        }
        // At a sharp edge a vertex is of all faces about it. A scan has none there that tells anything of a face with many others.
        if !self.partition.is_scan || points.len() < MIN_INNER_POINTS {
            points.extend(&corners);
        }
        for numbers in [&mut points, &mut corners] {
            numbers.sort_unstable();
            numbers.dedup();
        }
        let (mut outlined, far) = within.reach(within.bounds(points)?);
        let dents = match self.nominals.faces.is_some() {
            true => within.bounds(self.of_class(own, Class::Dent))?,
            false => vec![],
        };
        outlined.extend(&dents);
        outlined.sort_unstable();
        let border = within.border(&outlined);
        // Facets may have corners that are of another face as points.
        let corners = within.reach(within.bounds(corners)?).0;
        let area = match self.partition.is_scan {
            true => {
                self.area_about(&[&outlined[..], &within.bounds(self.of_class(own, Class::Edge))?].concat())
            }
            false => area(scan, &with_corners(scan, &own_facets, &corners)),
        };
        let facets = with_corners(scan, &own_facets, &within.clear(&corners, border));
        let found = Found { area, ..self.found(within.clear(&outlined, border), facets, near.rim) };
        // Where edges are rounded something was measured all the same.
        let mut covering = [&outlined[..], &within.bounds(self.of_class(own, Class::Edge))?].concat();
        covering.retain(|p| self.partition.inside[*p as usize]);
        let (mut others, left_out) = self.others(number, &within, (border, far))?;
        if !outliers {
            let alone = within.clear(&within.reach(within.bounds(alone)?).0, border);
            others.add_outliers(within.off(&alone));
        }
        others.dents = within.clear(&dents, border).len();
        Ok(OfFeature { found, covering: Some(covering), others, left_out })
    }

    /// What is within the reach of a feature, or over it, and not of it for certain; what lies beyond its reach is told with what is known of that.
    fn others(
        &self,
        number: usize,
        within: &Within,
        (border, far): (f64, Vec<u32>),
    ) -> Result<(Others, Option<ExcludedPoints>), FeatureError> {
        let Within { own, near, .. } = *within;
        let far = within.clear(&far, border);
        let mut left_out = within.off(&far);
        let clear = |points: Vec<u32>| -> Result<Vec<u32>, FeatureError> {
            Ok(within.clear(&within.reach(within.bounds(points)?).0, border))
        };
        let of_class = |class: Class| clear(self.of_class(own, class));
        let [edge, broken] = [of_class(Class::Edge)?, of_class(Class::Broken)?];
        let [mut deep, mut high] = [of_class(Class::Deep)?, of_class(Class::High)?];
        if self.nominals.faces.is_none() {
            // Where no reference tells what was drawn, dents may be other faces.
            let dents = within.clear(&within.bounds(self.of_class(own, Class::Dent))?, border);
            left_out.extend(within.off(&dents).into_iter().filter(|off| *off > near.distance));
            deep.extend(dents);
        }
        let between = self.partition.between.iter().filter(|b| own.faces.contains(&b.face)).map(|b| b.point);
        let between = clear(between.chain(self.of_class(own, Class::Between)).collect())?;
        let over = self.partition.beyond.iter().filter(|b| own.faces.contains(&b.face));
        let is_outlier = |b: &Beyond| {
            let is_alone = self.partition.classes[b.point as usize] == Class::Alone;
            self.partition.is_scan && !within.outliers && is_alone
        };
        let (outliers, beyond): (Vec<&Beyond>, Vec<&Beyond>) = over.partition(|b| is_outlier(b));
        let numbers = |of: &[&Beyond]| -> Result<Vec<u32>, FeatureError> {
            Ok(within.clear(&within.bounds(of.iter().map(|b| b.point).collect())?, border))
        };
        let (deeper, higher): (Vec<&Beyond>, Vec<&Beyond>) = beyond.into_iter().partition(|b| b.off < 0.0);
        let (deeper, higher) = (numbers(&deeper)?, numbers(&higher)?);
        left_out.extend(within.off(&deeper).into_iter().chain(within.off(&higher)));
        left_out.extend(self.other_faces(own, within)?);
        deep.extend(deeper);
        high.extend(higher);
        let drawn = within.straddled()?;
        let places = [&broken[..], &deep, &high, &between, &far, &drawn].concat();
        let mut others = Others {
            points: places.iter().map(|p| within.place(*p)).collect(),
            edge: edge.len(),
            dents: 0,
            broken: broken.len(),
            deep: deep.len(),
            high: high.len(),
            between: between.len(),
            far: far.len(),
            drawn: drawn.len(),
            outliers: 0,
            farthest_outlier: 0.0,
            on_reference: self.nominals.own(number).is_some(),
        };
        others.add_outliers(within.off(&numbers(&outliers)?));
        Ok((others, (!left_out.is_empty()).then(|| ExcludedPoints::of(&left_out, near.distance))))
    }

    /// The points of a class of some faces.
    fn of_class(&self, own: &OwnFaces, class: Class) -> Vec<u32> {
        let mut points = of_faces(own, &self.points);
        points.retain(|p| self.partition.classes[*p as usize] == class);
        points
    }

    /// How far off a nominal points lie on a face that runs along it, where no reference tells whether that face was drawn.
    fn other_faces(&self, own: &OwnFaces, within: &Within) -> Result<Vec<f64>, FeatureError> {
        if self.nominals.faces.is_some() {
            return Ok(vec![]);
        }
        let Some(surface) = within.nominal.surface() else { return Ok(vec![]) };
        let farthest = MAX_OFF_SIZE_SHARE * self.scan.bounds().diagonal();
        let mut points = vec![];
        for (number, face) in (0u32..).zip(&self.more.all) {
            let is_along = |p: &&u32| {
                let place = within.place(**p);
                let way = face.facing(&place).zip(surface.distance(place));
                way.is_some_and(|(facing, (off, way))| {
                    off.abs() <= farthest && dot(facing, way).abs() >= libm::cos(within.near.angle)
                })
            };
            if !own.faces.contains(&number) {
                points.extend(self.points[number as usize].iter().filter(is_along));
            }
        }
        let clear = Nearness {
            distance: f64::INFINITY,
            margin: within.near.margin.max(self.partition.spacing),
            ..*within.near
        };
        let places: Vec<Point> = points.iter().map(|p| within.place(*p)).collect();
        let over = in_cloud(&places, within.nominal, &clear)?.points;
        let (_, far) = within.reach(over.into_iter().map(|i| points[i as usize]).collect());
        Ok(within.off(&far))
    }

    /// The area that vertices stand for: at the edges of a scan facets straddle two faces.
    fn area_about(&self, vertices: &[u32]) -> f64 {
        match self.scan {
            Scan::Cloud(_) => 0.0,
            Scan::Mesh(_) => vertices.iter().map(|v| area(self.scan, self.around(*v)) / 3.0).sum(),
        }
    }

    fn found(&self, points: Vec<u32>, facets: Vec<u32>, rim: bool) -> Found {
        // Walls of a computed mesh that were not drawn are of no face: what they bound is form.
        let is_other = |facet: &u32| {
            let no_face = self.partition.facets[*facet as usize] == NO_FACE;
            facets.binary_search(facet).is_err() && (self.partition.is_scan || !no_face)
        };
        // No other face is about a dent.
        let is_shared = |v: &u32| {
            self.partition.classes[*v as usize] != Class::Dent && self.around(*v).iter().any(is_other)
        };
        let (rim, points) = points.into_iter().partition(|v| !rim && is_shared(v));
        Found { facets, points, rim, area: 0.0 }
    }

    /// The facets about a point; none of a cloud.
    fn around(&self, point: u32) -> &[u32] {
        match self.scan {
            Scan::Cloud(_) => &[],
            Scan::Mesh(mesh) => self.around.get_or_init(|| FacetsAround::new(mesh)).of(point),
        }
    }
}

/// The area of some facets, mm²; 0 of a cloud, which has none.
fn area(scan: &Scan, facets: &[u32]) -> f64 {
    scan.mesh().map_or(0.0, |mesh| mesh_area(mesh, facets))
}

/// What some faces have, ascending.
fn of_faces(own: &OwnFaces, all: &[Vec<u32>]) -> Vec<u32> {
    let mut those: Vec<u32> = own.faces.iter().flat_map(|f| all[*f as usize].iter().copied()).collect();
    those.sort_unstable();
    those
}

/// Those of some facets whose corners are all among these.
fn with_corners(scan: &Scan, facets: &[u32], corners: &[u32]) -> Vec<u32> {
    let has_all = |f: &u32| scan.facets()[*f as usize].iter().all(|v| corners.binary_search(v).is_ok());
    facets.iter().copied().filter(has_all).collect()
}

/// What of a feature lies within its bounds and its reach.
struct Within<'a> {
    parted: &'a Parted<'a>,
    own: &'a OwnFaces,
    nominal: &'a Nominal,
    near: &'a Nearness,
    /// Whether outliers count.
    outliers: bool,
}

impl Within<'_> {
    fn place(&self, p: u32) -> Point {
        self.parted.scan.points()[p as usize]
    }

    /// Those within the bounds of the nominal, and of the part of its faces that it is.
    fn bounds(&self, mut points: Vec<u32>) -> Result<Vec<u32>, FeatureError> {
        if let Some(part) = &self.own.part {
            points.retain(|p| part.holds(&self.place(*p)));
        }
        let places: Vec<Point> = points.iter().map(|p| self.place(*p)).collect();
        let wide = Nearness { distance: f64::INFINITY, ..*self.near };
        let found = in_cloud(&places, self.nominal, &wide)?;
        Ok(found.points.into_iter().map(|i| points[i as usize]).collect())
    }

    /// How far a point lies from the borders of its face, or of that of the feature's which is first.
    fn to_border(&self, p: u32) -> f64 {
        let owner = self.parted.partition.owners[p as usize];
        let own = if self.own.faces.contains(&owner) { owner } else { self.own.faces[0] };
        self.parted.face(own).to_border(&self.place(p))
    }

    /// The margin at the borders of the faces, inner ones too.
    fn border(&self, points: &[u32]) -> f64 {
        if self.near.margin <= 0.0 {
            return 0.0;
        }
        let most = points.iter().map(|p| self.to_border(*p)).fold(0.0, f64::max);
        self.near.margin.min(MAX_MARGIN_SHARE * most)
    }

    fn clear(&self, points: &[u32], border: f64) -> Vec<u32> {
        points.iter().copied().filter(|p| border <= 0.0 || self.to_border(*p) >= border).collect()
    }

    fn off(&self, points: &[u32]) -> Vec<f64> {
        let surface = self.nominal.surface();
        let off =
            |p: &u32| surface.as_ref().and_then(|s| s.distance(self.place(*p))).map_or(0.0, |d| d.0.abs());
        points.iter().map(off).collect()
    }

    /// Those within its distance, and the others.
    fn reach(&self, points: Vec<u32>) -> (Vec<u32>, Vec<u32>) {
        let off = self.off(&points);
        let (near, far): (Vec<_>, Vec<_>) =
            points.into_iter().zip(off).partition(|(_, off)| *off <= self.near.distance);
        (near.into_iter().map(|n| n.0).collect(), far.into_iter().map(|f| f.0).collect())
    }

    /// The corners of facets that face as the feature does and are of no face, as all of their corners are of others: a step down to its border has none of its own.
    fn straddled(&self) -> Result<Vec<u32>, FeatureError> {
        let Parted { scan, partition, loose, .. } = self.parted;
        let Scan::Mesh(mesh) = scan else { return Ok(vec![]) };
        let is_other = |v: &u32| {
            let owner = partition.owners[*v as usize];
            owner != NO_FACE
                && !self.own.faces.contains(&owner)
                && partition.classes[*v as usize] == Class::Face
        };
        let is_free = |f: &&u32| mesh.faces[**f as usize].iter().all(is_other);
        let free: Vec<u32> = loose.iter().filter(is_free).copied().collect();
        let facets = facets_near(mesh, &free, self.nominal, self.near)?;
        // Corners of a part leave some.
        if mesh_area(mesh, &facets)
            < MIN_STEP_AREA_SHARE * mesh_area(mesh, &of_faces(self.own, &self.parted.facets))
        {
            return Ok(vec![]);
        }
        let mut corners: Vec<u32> = facets.iter().flat_map(|f| mesh.faces[*f as usize]).collect();
        corners.sort_unstable();
        corners.dedup();
        Ok(corners)
    }
}

/// How far each face reaches by the features that it is of, mm: as far as the one that is sought farthest.
fn reaches(plan: &Plan, nominals: &Nominals, own: &BTreeMap<usize, OwnFaces>) -> BTreeMap<u32, f64> {
    let mut reaches: BTreeMap<u32, f64> = BTreeMap::new();
    for (number, feature) in plan.features.iter().enumerate() {
        let Some(own) = nominals.own(number).or_else(|| own.get(&number)) else { continue };
        let distance = nominals.of(number, feature).map_or(0.0, |nominal| feature.near(nominal).distance);
        for face in &own.faces {
            reaches.entry(*face).and_modify(|r| *r = r.max(distance)).or_insert(distance);
        }
    }
    reaches
}

/// Whether the facets near a nominal face its axis or center, by their area; `None` of a plane, of a cloud, and where there are none.
fn inward(scan: &Scan, nominal: &Nominal, near: &Nearness) -> Option<bool> {
    let surface = nominal.surface().filter(|_| !matches!(nominal, Nominal::Plane { .. }))?;
    let mesh = scan.mesh()?;
    let all: Vec<u32> = (0..mesh.faces.len() as u32).collect();
    let facets = facets_near(mesh, &all, nominal, near).ok()?;
    let along = |f: &u32| {
        let [a, b, c] = mesh.corners(*f);
        let middle = times(1.0 / 3.0, plus(a, plus(b, c)));
        Some(dot(cross(minus(b, a), minus(c, a)), surface.distance(middle)?.1))
    };
    let sum: f64 = facets.iter().filter_map(along).sum();
    (sum != 0.0).then_some(sum < 0.0)
}

#[cfg(test)]
mod tests;
