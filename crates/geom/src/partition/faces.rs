//! A face, and where a point lies on it.

use super::cut::{self, Cut};
use crate::closest::{BoundaryEdges, Query, QueryError, Tree};
use crate::feature::{Extent, FeatureError, Nominal};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress, Silent};
use crate::segment::SegmentError;
use crate::shape::{Kind, Shape};
use crate::space::{self, Aabb, MIN_COORDINATE, Point, Vector, cross, dot, minus, norm, plus, times, unit};
use crate::spatial::neighbors::PointTree;
use crate::topology::weld;
use std::collections::BTreeMap;

/// A face: of a nominal mesh, a nominal feature, or an element that measured points lie on.
pub struct Face {
    /// Its facets in the nominal mesh, ascending; none of others.
    pub facets: Vec<u32>,
    /// The element that it lies on; `None` where it is free.
    pub shape: Option<Shape>,
    /// Box around it.
    pub bounds: Aabb,
    /// 1 where distances of the element are positive outside of the material, else −1.
    pub(super) outward: f64,
    extent: FaceExtent,
}

/// How far a face goes.
enum FaceExtent {
    /// As far as its facets.
    Facets(Facets),
    /// As far as the bounds of a nominal feature.
    Nominal(Extent),
    /// As far as measured points that were found to belong to it, which lie no farther apart. Narrow ones may be where a scan
    /// rounds an edge.
    Points { tree: PointTree, apart: f64, narrow: bool },
}

/// The facets of a face.
struct Facets {
    mesh: Mesh,
    tree: Tree,
    rim: BoundaryEdges,
    /// Its border as facets without area; `None` of a closed face.
    border: Option<Tree>,
}

/// Where a point lies on a face: one for each point of a scan and more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seat {
    /// Distance across the face, positive outside of the material.
    pub off: f64,
    within: f32,
    normal: [f32; 3],
}

impl Seat {
    fn new(off: f64, within: f64, normal: Vector) -> Seat {
        Seat { off, within: within as f32, normal: normal.map(|x| x as f32) }
    }

    /// Distance of its foot from the border, along the face; below 0 beyond it.
    pub(super) fn within(&self) -> f64 {
        f64::from(self.within)
    }

    /// Unit normal of the face there, out of the material, in single precision.
    pub(super) fn normal(&self) -> Vector {
        self.normal.map(f64::from)
    }
}

/// Faces, those of a nominal or others.
pub struct Faces {
    /// The faces.
    pub all: Vec<Face>,
    /// The face of each facet; [`NO_FACE`](super::NO_FACE) of those without area.
    pub of_facets: Vec<u32>,
}

impl Faces {
    /// No face yet.
    pub fn none() -> Faces {
        Faces { all: vec![], of_facets: vec![] }
    }

    /// Adds a nominal feature as a face: its number. `inward` is whether it faces its axis or center. Where it ends is known by its bounds alone, not where
    /// other faces cut it.
    ///
    /// # Errors
    /// [`FeatureError`]: a nominal feature that makes no sense, or an edge, which is no face.
    ///
    /// ```
    /// use trueness_geom::feature::Nominal;
    /// use trueness_geom::partition::{Class, Faces, NO_FACE, Options, partition};
    /// use trueness_geom::{progress::Silent, scan::Scan};
    /// let pin = Nominal::Cylinder { point: [0.0; 3], direction: [0.0, 0.0, 1.0], radius: 5.0, length: 9.0 };
    /// let mut faces = Faces::none();
    /// faces.add_nominal(&pin, false)?;
    /// // Places all around it, and one far off.
    /// let turn = |k: u32| (2.4 * f64::from(k)).sin_cos();
    /// let mut positions: Vec<_> = (0..500).map(|k| [5.0 * turn(k).1, 5.0 * turn(k).0, 0.018 * f64::from(k)]).collect();
    /// positions.push([9.0, 0.0, 4.0]);
    /// let scan = Scan::Cloud(positions);
    /// let options = Options { distance: Some(0.5), ..Options::default() };
    /// let found = partition(&scan, &[&faces.all[0]], &options, &Silent)?;
    /// assert!(found.owners[..500].iter().all(|face| *face == 0));
    /// assert_eq!((found.owners[500], found.classes[500]), (NO_FACE, Class::Alone));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn add_nominal(&mut self, nominal: &Nominal, inward: bool) -> Result<u32, FeatureError> {
        let extent = Extent::new(nominal)?;
        let shape = nominal.shape().ok_or(FeatureError::NoFace)?;
        let is_plane = matches!(nominal, Nominal::Plane { .. });
        let outward = if inward && !is_plane { -1.0 } else { 1.0 };
        let bounds = extent.bounds();
        Ok(self.add(Face {
            facets: vec![],
            shape: Some(shape),
            bounds,
            outward,
            extent: FaceExtent::Nominal(extent),
        }))
    }

    /// Adds an element that measured points were found to lie on as a face: its number. It goes as far as these points, which
    /// lie no farther apart than `apart`. `outward` is whether distances of the element are positive outside of the material.
    /// `narrow` is whether the face may be where a scan rounds an edge: then no edge is told by it.
    pub fn add_measured(
        &mut self,
        points: &[Point],
        shape: Shape,
        apart: f64,
        (outward, narrow): (bool, bool),
    ) -> u32 {
        let extent = FaceExtent::Points { tree: PointTree::new(points), apart, narrow };
        let outward = if outward { 1.0 } else { -1.0 };
        self.add(Face { facets: vec![], shape: Some(shape), bounds: Aabb::of(points), outward, extent })
    }

    fn add(&mut self, face: Face) -> u32 {
        self.all.push(face);
        self.all.len() as u32 - 1
    }

    /// The faces of a nominal with outward facets. Facets without area are of none.
    ///
    /// # Errors
    /// [`SegmentError`]: no facets, coordinates that are no numbers.
    pub fn of(nominal: &Mesh, progress: &dyn Progress) -> Result<Faces, SegmentError> {
        // Seams of what was turned are often open by the digits of a file.
        let nominal = weld::within(nominal, cut::rounding(&nominal.positions))?.mesh;
        let Cut { of_facets, facets, shapes } = cut::cut(&nominal, progress)?;
        let faces = facets.into_par_iter().zip(shapes);
        let all = faces.map(|(facets, shape)| Face::new(&nominal, facets, shape)).collect::<Option<_>>();
        Ok(Faces { all: all.ok_or(SegmentError::NoSurface)?, of_facets })
    }

    /// Faces that are known, as those of a CAD model are: facets of each in a mesh that draws them, and its element. Where none is told, it is sought.
    /// Facets look out of the material and share vertices within a face. Faces without facets that have an area are left out; the others keep their order.
    ///
    /// ```
    /// use trueness_geom::{mesh::Mesh, partition::{Faces, NO_FACE}, shape::Shape};
    /// let positions = vec![[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 9.0, 0.0]];
    /// let mesh = Mesh { positions, faces: vec![[0, 1, 2], [0, 2, 3], [1, 1, 1]] };
    /// let floor = Shape::Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    /// let (faces, places) = Faces::known(&mesh, vec![(vec![], None), (vec![0, 1], Some(floor))]);
    /// assert_eq!((faces.all.len(), faces.of_facets, places), (1, vec![0, 0, NO_FACE], vec![1]));
    /// ```
    pub fn known(nominal: &Mesh, pieces: Vec<(Vec<u32>, Option<Shape>)>) -> (Faces, Vec<usize>) {
        let face = |(facets, shape): (Vec<u32>, Option<Shape>)| {
            if facets.is_empty() {
                return None;
            }
            let shape = shape.or_else(|| cut::any_element(nominal, &facets));
            Face::new(nominal, facets, shape)
        };
        let made: Vec<Option<Face>> = pieces.into_par_iter().map(face).collect();
        let (mut faces, mut places) = (Faces::none(), vec![]);
        faces.of_facets = vec![cut::NO_FACE; nominal.faces.len()];
        for (place, face) in made.into_iter().enumerate() {
            let Some(face) = face else { continue };
            let number = faces.all.len() as u32;
            face.facets.iter().for_each(|f| faces.of_facets[*f as usize] = number);
            faces.all.push(face);
            places.push(place);
        }
        (faces, places)
    }
}

fn normal(mesh: &Mesh, f: &[u32; 3]) -> Option<Vector> {
    space::normal(mesh.places(f))
}

/// Facets of a mesh as one of their own.
fn piece(of: &Mesh, faces: &[[u32; 3]]) -> Mesh {
    let mut numbers: BTreeMap<u32, u32> = BTreeMap::new();
    let mut positions = vec![];
    let mut number = |v: u32| {
        *numbers.entry(v).or_insert_with(|| {
            positions.push(of.positions[v as usize]);
            positions.len() as u32 - 1
        })
    };
    let faces = faces.iter().map(|f| f.map(&mut number)).collect();
    Mesh { positions, faces }
}

impl Face {
    fn new(nominal: &Mesh, facets: Vec<u32>, shape: Option<Shape>) -> Option<Face> {
        let own: Vec<[u32; 3]> = facets.iter().map(|f| nominal.faces[*f as usize]).collect();
        let mesh = piece(nominal, &own);
        let mut sides: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for f in &mesh.faces {
            for k in 0..3 {
                let (a, b) = (f[k], f[(k + 1) % 3]);
                *sides.entry([a.min(b), a.max(b)]).or_default() += 1;
            }
        }
        let border: Vec<[u32; 3]> =
            sides.into_iter().filter(|e| e.1 == 1).map(|([a, b], _)| [a, b, b]).collect();
        let tree = Tree::build(&mesh).ok()?;
        let rim = BoundaryEdges::new(&tree);
        let border = match border.is_empty() {
            true => None,
            false => Some(Tree::build(&piece(&mesh, &border)).ok()?),
        };
        let towards = |shape: Shape, f: &[u32; 3]| {
            let [a, b, c] = mesh.places(f);
            let middle = times(1.0 / 3.0, plus(a, plus(b, c)));
            dot(shape.normal(middle), cross(minus(b, a), minus(c, a)))
        };
        let facing = shape.map_or(1.0, |s| mesh.faces.iter().map(|f| towards(s, f)).sum());
        let bounds = Aabb::of(&mesh.positions);
        let extent = FaceExtent::Facets(Facets { mesh, tree, rim, border });
        Some(Face { facets, shape, bounds, outward: 1f64.copysign(facing), extent })
    }

    /// Where points lie on the face. `None` for those farther off than `reach`, or beyond its border by more than `far`, and
    /// where the element has no direction. Borders farther than `far` are not looked for: infinitely far within.
    ///
    /// Cost: two closest points each, in batches.
    pub(super) fn seats(
        &self,
        points: &[Point],
        reach: f64,
        far: f64,
        progress: &dyn Progress,
    ) -> Result<Vec<Option<Seat>>, Cancelled> {
        let across: Vec<Option<(f64, Vector)>> = match self.shape {
            Some(shape) => points.par_iter().map(|p| self.across(shape, *p, reach)).collect(),
            None => vec![None; points.len()],
        };
        let foot = |(p, across): (&Point, &Option<(f64, Vector)>)| match across {
            Some((off, normal)) => searched(minus(*p, times(*off, *normal))),
            None => searched(*p),
        };
        let feet: Vec<Point> = points.iter().zip(&across).map(foot).collect();
        let within: Vec<f64> = match &self.extent {
            FaceExtent::Nominal(extent) => feet.par_iter().map(|p| extent.within(*p)).collect(),
            FaceExtent::Points { tree, apart, .. } => {
                feet.par_iter().map(|p| gap_to_points(tree, *apart, p)).collect()
            }
            FaceExtent::Facets(facets) => match self.shape {
                Some(_) => facets.within(&feet, far, progress)?,
                None => return facets.free(&feet, reach, far, progress),
            },
        };
        let seat = |(across, within): (Option<(f64, Vector)>, f64)| {
            let (off, normal) = across?;
            (within >= -far).then(|| Seat::new(off, within, normal))
        };
        Ok(across.into_par_iter().zip(within).map(seat).collect())
    }

    /// How far a point is off the element, positive outside of the material, and the normal there.
    fn across(&self, shape: Shape, p: Point, reach: f64) -> Option<(f64, Vector)> {
        let off = self.outward * shape.distance(p);
        (off.abs() <= reach).then_some((off, times(self.outward, unit(shape.normal(p))?.0)))
    }

    /// Whether its border is known; of a nominal feature the bounds are, but not where other faces cut it.
    pub(super) fn is_bounded(&self) -> bool {
        matches!(self.extent, FaceExtent::Facets(_))
    }

    /// Whether it goes as far as measured points that were found to be of it.
    pub(super) fn is_measured(&self) -> bool {
        matches!(self.extent, FaceExtent::Points { .. })
    }

    /// Whether it may be no face, but where a scan rounds an edge.
    pub(super) fn is_narrow(&self) -> bool {
        matches!(self.extent, FaceExtent::Points { narrow: true, .. })
    }

    /// Its unit normal near a place, out of the material.
    pub fn facing(&self, p: &Point) -> Option<Vector> {
        match (self.shape, &self.extent) {
            (Some(shape), _) => self.across(shape, *p, f64::INFINITY).map(|a| a.1),
            (None, FaceExtent::Facets(facets)) => facets.facing(p),
            (None, _) => None,
        }
    }

    /// How far points lie off the face, positive outside of the material, and the unit normals there. `None` for points that do
    /// not lie over it or are farther off than `reach`.
    pub fn over(&self, points: &[Point], reach: f64) -> Vec<Option<(f64, Vector)>> {
        let seats = self.seats(points, reach, 0.0, &Silent).unwrap_or_default();
        seats.into_iter().map(|seat| seat.map(|seat| (seat.off, seat.normal()))).collect()
    }

    /// For a cylinder, cone, sphere or torus, whether it faces its axis or center, as a bore does.
    pub fn inward(&self) -> Option<bool> {
        let plane = self.shape.is_none_or(|s| s.kind() == Kind::Plane);
        (!plane).then_some(self.outward < 0.0)
    }

    /// How far the foot of a point is from the border of the face; infinite where it has none.
    pub fn to_border(&self, p: &Point) -> f64 {
        let across = self.shape.and_then(|shape| self.across(shape, *p, f64::INFINITY));
        let foot = across.map_or(*p, |(off, normal)| minus(*p, times(off, normal)));
        match &self.extent {
            FaceExtent::Facets(facets) => facets.to_border(&foot),
            FaceExtent::Nominal(extent) => extent.within(foot).abs(),
            FaceExtent::Points { .. } => f64::INFINITY,
        }
    }
}

/// A place that can be searched for: what is less than the least coordinate is none.
fn searched(p: Point) -> Point {
    p.map(|x| if x.abs() < MIN_COORDINATE { 0.0 } else { x })
}

/// Infinite within measured points; how far beyond them, below zero.
fn gap_to_points(points: &PointTree, apart: f64, p: &Point) -> f64 {
    let away = points.nearest(p).map_or(f64::INFINITY, |n| n.0.sqrt());
    if away <= apart { f64::INFINITY } else { apart - away }
}

impl Facets {
    /// How far feet lie within the border; borders farther than `far` are not looked for: infinitely far within.
    fn within(&self, feet: &[Point], far: f64, progress: &dyn Progress) -> Result<Vec<f64>, Cancelled> {
        let on = self.on(feet, progress)?;
        let borders = self.borders(feet, far, progress)?;
        let within = |(on, border): (Option<On>, Option<f64>)| match on {
            Some(on) if on.rim => -on.distance,
            Some(_) => border.unwrap_or(f64::INFINITY),
            None => f64::NEG_INFINITY,
        };
        Ok(on.into_iter().zip(borders).map(within).collect())
    }

    /// Where points lie on a free face.
    fn free(
        &self,
        points: &[Point],
        reach: f64,
        far: f64,
        progress: &dyn Progress,
    ) -> Result<Vec<Option<Seat>>, Cancelled> {
        let on = self.on(points, progress)?;
        let feet: Vec<Point> = points.iter().zip(&on).map(|(p, on)| on.map_or(*p, |on| on.point)).collect();
        let borders = self.borders(&feet, far, progress)?;
        let seat = |i: usize| {
            let (on, border) = (on[i]?, borders[i].unwrap_or(f64::INFINITY));
            let away = minus(points[i], on.point);
            let normal = normal(&self.mesh, self.mesh.faces.get(on.face as usize)?)?;
            let across = dot(away, normal);
            let along = norm(minus(away, times(across, normal)));
            let seat = match on.rim {
                true => Seat::new(across, -along, normal),
                false => Seat::new(norm(away).copysign(across), border, normal),
            };
            (seat.off.abs() <= reach && seat.within() >= -far).then_some(seat)
        };
        Ok((0..points.len()).into_par_iter().map(seat).collect())
    }

    fn on(&self, feet: &[Point], progress: &dyn Progress) -> Result<Vec<Option<On>>, Cancelled> {
        let on = self.tree.map_closest(feet, &Query::default(), progress, |i, hit| {
            let place = self.tree.place(&feet[i], &hit?);
            let rim = self.rim.holds(&place);
            Some(On { face: place.face, point: place.point, distance: place.distance, rim })
        });
        asked(on, feet.len())
    }

    fn borders(
        &self,
        feet: &[Point],
        far: f64,
        progress: &dyn Progress,
    ) -> Result<Vec<Option<f64>>, Cancelled> {
        let Some(border) = &self.border else { return Ok(vec![None; feet.len()]) };
        let query = Query { max_distance: far, ..Query::default() };
        let found = border.map_closest(feet, &query, progress, |_, hit| hit.map(|h| h.distance()));
        asked(found, feet.len())
    }

    fn facing(&self, p: &Point) -> Option<Vector> {
        let place = self.tree.closest(&searched(*p), f64::INFINITY).ok()??;
        normal(&self.mesh, self.mesh.faces.get(place.face as usize)?)
    }

    fn to_border(&self, foot: &Point) -> f64 {
        let Some(border) = &self.border else { return f64::INFINITY };
        border.closest(&searched(*foot), f64::INFINITY).ok().flatten().map_or(f64::INFINITY, |c| c.distance)
    }
}

/// The place of some facets that is closest to a foot.
#[derive(Clone, Copy)]
struct On {
    face: u32,
    point: Point,
    distance: f64,
    rim: bool,
}

/// Closest places of points near a face: what is near it can be asked.
fn asked<T: Copy>(
    found: Result<Vec<Option<T>>, QueryError>,
    count: usize,
) -> Result<Vec<Option<T>>, Cancelled> {
    match found {
        Err(QueryError::Cancelled(e)) => Err(e),
        found => Ok(found.unwrap_or_else(|_| vec![None; count])),
    }
}
