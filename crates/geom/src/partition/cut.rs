//! The nominal cut into faces.
//!
//! A segmentation finds the elements. Bores that meet leave facets out, and these are completed as drawings are. Corners of a
//! drawn face lie on its element or on a chord of it, however few and long its facets are.

use crate::fit::{self, fit};
use crate::mesh::Mesh;
use crate::progress::{Progress, Silent};
use crate::segment::{self, Options, SegmentError};
use crate::shape::{Kind, Shape};
use crate::space::{self, Aabb, Point, Vector, cross, dot, minus, norm, plus, single_step, times, unit};

/// No face.
pub const NO_FACE: u32 = u32::MAX;

/// Steps of single precision by which corners of a drawn face may be off its element.
const ROUNDED_CORNER_STEPS: f64 = 4.0;
/// Share of its size that the chords of a face may be off its element.
const MAX_CHORD_SHARE: f64 = 1e-3;
/// Corners for each unknown from which on they tell that a face lies on an element.
const CORNERS_PER_UNKNOWN: usize = 2;
/// Ratio of distances from an element: those of other facets' middles and corners over those of the middles of its own facets.
/// It is the limit for facets that join a face. Corners lie on chords where faces meet. The flat of a shaft has all its corners
/// on the shaft too.
const MAX_BULGE_RATIO: f64 = 2.0;
/// Elements that a face may lie on where the segmentation has not told: the simplest first.
const ELEMENTS: [Kind; 4] = [Kind::Plane, Kind::Cylinder, Kind::Sphere, Kind::Cone];

/// A nominal cut into faces.
pub(super) struct Cut {
    /// The face of each facet.
    pub of_facets: Vec<u32>,
    /// The facets of each face, ascending.
    pub facets: Vec<Vec<u32>>,
    /// Its element; `None` where it is free.
    pub shapes: Vec<Option<Shape>>,
}

/// Cuts a nominal with outward facets that share vertices.
pub(super) fn cut(nominal: &Mesh, progress: &dyn Progress) -> Result<Cut, SegmentError> {
    let options = Options::default();
    let found = segment::mesh(nominal, &options, progress)?;
    let drawn = Drawn::new(nominal, options.crease);
    let mut of_facets = found.labels.clone();
    let mut shapes: Vec<Option<Shape>> = found.regions.iter().map(|r| Some(r.fit.shape)).collect();
    drawn.grow(&mut of_facets, &shapes);
    drawn.free(&mut of_facets, &mut shapes);
    for (number, own) in facets_of(&of_facets, shapes.len()).iter().enumerate() {
        if shapes[number].is_none() {
            shapes[number] = any_element(nominal, own);
        }
    }
    drawn.grow(&mut of_facets, &shapes);
    let facets = facets_of(&of_facets, shapes.len());
    // A face whose facets others have all taken is none.
    let kept: Vec<usize> = (0..shapes.len()).filter(|face| !facets[*face].is_empty()).collect();
    let mut numbers = vec![NO_FACE; shapes.len()];
    (0u32..).zip(&kept).for_each(|(number, face)| numbers[*face] = number);
    of_facets.iter_mut().filter(|f| **f != NO_FACE).for_each(|f| *f = numbers[*f as usize]);
    let (facets, shapes) = kept.iter().map(|face| (facets[*face].clone(), shapes[*face])).unzip();
    Ok(Cut { of_facets, facets, shapes })
}

fn facets_of(of_facets: &[u32], count: usize) -> Vec<Vec<u32>> {
    let mut facets: Vec<Vec<u32>> = vec![vec![]; count];
    for (facet, &face) in (0u32..).zip(of_facets).filter(|f| *f.1 != NO_FACE) {
        facets[face as usize].push(facet);
    }
    facets
}

/// A drawn nominal with what joins its facets.
struct Drawn<'a> {
    mesh: &'a Mesh,
    normals: Vec<Option<Vector>>,
    /// Each side of a facet under its edge, in the order of edges.
    sides: Vec<(u64, u32)>,
    /// Cosine of the angle from which on there is an edge between facets.
    smooth: f64,
    /// How far off its element a corner may be, mm.
    limit: f64,
}

impl Drawn<'_> {
    fn new(mesh: &Mesh, crease: f64) -> Drawn<'_> {
        let edges = |(facet, f): (u32, &[u32; 3])| {
            let f = *f;
            (0..3).map(move |k| (edge(f[k], f[(k + 1) % 3]), facet))
        };
        let mut sides: Vec<(u64, u32)> = (0u32..).zip(&mesh.faces).flat_map(edges).collect();
        sides.sort_unstable();
        let normals = (0..mesh.faces.len() as u32).map(|f| normal(mesh, f)).collect();
        Drawn { mesh, normals, sides, smooth: libm::cos(crease), limit: rounding(&mesh.positions) }
    }

    /// The facets across the sides of one, without itself.
    fn across(&self, facet: u32) -> impl Iterator<Item = u32> {
        let f = self.mesh.faces[facet as usize];
        (0..3).flat_map(move |k| {
            let edge = edge(f[k], f[(k + 1) % 3]);
            let first = self.sides.partition_point(|s| s.0 < edge);
            let here = self.sides[first..].iter().take_while(move |s| s.0 == edge);
            here.map(|s| s.1).filter(move |other| *other != facet)
        })
    }

    /// Lets each face, the largest first, take facets beside it that lie on its element.
    fn grow(&self, of_facets: &mut [u32], shapes: &[Option<Shape>]) {
        let facets = facets_of(of_facets, shapes.len());
        let area = |face: usize| facets[face].iter().map(|f| self.area(*f)).sum::<f64>();
        let mut order: Vec<(f64, usize)> = (0..shapes.len()).map(|face| (area(face), face)).collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut done = vec![false; shapes.len()];
        for (_, face) in order {
            done[face] = true;
            let Some(shape) = shapes[face] else { continue };
            let own: Vec<u32> =
                facets[face].iter().copied().filter(|f| of_facets[*f as usize] == face as u32).collect();
            let side = own.iter().filter_map(|f| self.cosine_to(&shape, *f)).sum::<f64>().signum();
            let bulge = MAX_BULGE_RATIO * own.iter().map(|f| self.bulge(&shape, *f)).fold(0.0, f64::max);
            let bulge = bulge.max(self.limit);
            let is_on = |f: u32| {
                self.corners(f).iter().all(|p| shape.distance(*p).abs() <= bulge)
                    && self.cosine_to(&shape, f).is_some_and(|along| side * along >= self.smooth)
                    && self.bulge(&shape, f) <= bulge
            };
            let mut waiting = own;
            while let Some(facet) = waiting.pop() {
                for other in self.across(facet) {
                    let there = of_facets[other as usize];
                    let is_open = there == NO_FACE || !done[there as usize];
                    if is_open && is_on(other) {
                        of_facets[other as usize] = face as u32;
                        waiting.push(other);
                    }
                }
            }
        }
    }

    /// Gives facets without a face new ones, each up to edges and to the other faces.
    fn free(&self, of_facets: &mut [u32], shapes: &mut Vec<Option<Shape>>) {
        for start in 0..of_facets.len() {
            if of_facets[start] != NO_FACE || self.normals[start].is_none() {
                continue;
            }
            let number = shapes.len() as u32;
            shapes.push(None);
            of_facets[start] = number;
            let mut waiting = vec![start as u32];
            while let Some(facet) = waiting.pop() {
                for other in self.across(facet) {
                    let both = self.normals[facet as usize].zip(self.normals[other as usize]);
                    let is_smooth = both.is_some_and(|(a, b)| dot(a, b) >= self.smooth);
                    if is_smooth && of_facets[other as usize] == NO_FACE {
                        of_facets[other as usize] = number;
                        waiting.push(other);
                    }
                }
            }
        }
    }

    fn corners(&self, facet: u32) -> [Point; 3] {
        self.mesh.corners(facet)
    }

    fn area(&self, facet: u32) -> f64 {
        let [a, b, c] = self.corners(facet);
        0.5 * norm(cross(minus(b, a), minus(c, a)))
    }

    /// Cosine of the angle of a facet to its element; `None` of one without area.
    fn cosine_to(&self, shape: &Shape, facet: u32) -> Option<f64> {
        cosine_to(shape, self.corners(facet), self.normals[facet as usize]?)
    }

    /// How far an element bulges over the middle of a facet, mm.
    fn bulge(&self, shape: &Shape, facet: u32) -> f64 {
        shape.distance(middle(self.corners(facet))).abs()
    }
}

/// The simplest element on which all corners of some facets lie.
pub(super) fn any_element(mesh: &Mesh, facets: &[u32]) -> Option<Shape> {
    let crease = Options::default().crease;
    ELEMENTS.iter().find_map(|kind| element(mesh, facets, *kind, crease))
}

/// The element of a kind on which all corners of some facets lie, and which they face within so many radians. `None` where
/// there is none.
///
/// Cost: one fit.
/// ```
/// use trueness_geom::{mesh::Mesh, partition::element, shape::Kind};
/// // A part of a bore of radius 5 in chords.
/// let at = |k: u32| (f64::from(k) * 0.2).sin_cos();
/// let positions = (0..8).flat_map(|k| [0.0, 9.0].map(|z| [5.0 * at(k).1, 5.0 * at(k).0, z])).collect();
/// let faces = (0..7).flat_map(|k| [[2 * k, 2 * k + 1, 2 * k + 2], [2 * k + 2, 2 * k + 1, 2 * k + 3]]).collect();
/// let mesh = Mesh { positions, faces };
/// let all: Vec<u32> = (0..14).collect();
/// assert!(element(&mesh, &all, Kind::Cylinder, 0.5).is_some());
/// assert!(element(&mesh, &all, Kind::Plane, 0.5).is_none());
/// ```
pub fn element(mesh: &Mesh, facets: &[u32], kind: Kind, angle: f64) -> Option<Shape> {
    let mut corners: Vec<u32> = facets.iter().flat_map(|f| mesh.faces[*f as usize]).collect();
    corners.sort_unstable();
    corners.dedup();
    let places: Vec<Point> = corners.iter().map(|v| mesh.positions[*v as usize]).collect();
    if places.len() < CORNERS_PER_UNKNOWN * kind.unknowns() {
        return None;
    }
    let shape = fit(&places, kind, &fit::Options::default(), &Silent).ok()?.shape;
    let limit = rounding(&places).max(MAX_CHORD_SHARE * Aabb::of(&places).diagonal());
    let facing = |f: &u32| {
        let corners = mesh.corners(*f);
        cosine_to(&shape, corners, normal(mesh, *f)?)
    };
    let along: Vec<f64> = facets.iter().filter_map(facing).collect();
    let side = along.iter().sum::<f64>().signum();
    let is_on = places.iter().all(|p| shape.distance(*p).abs() <= limit);
    (is_on && along.iter().all(|c| side * c >= libm::cos(angle))).then_some(shape)
}

fn cosine_to(shape: &Shape, corners: [Point; 3], facing: Vector) -> Option<f64> {
    Some(dot(facing, unit(shape.normal(middle(corners)))?.0))
}

fn middle([a, b, c]: [Point; 3]) -> Point {
    times(1.0 / 3.0, plus(a, plus(b, c)))
}

/// How far places that are the same may lie apart, mm.
pub(super) fn rounding(places: &[Point]) -> f64 {
    ROUNDED_CORNER_STEPS * single_step(places)
}

fn normal(mesh: &Mesh, facet: u32) -> Option<Vector> {
    space::normal(mesh.corners(facet))
}

fn edge(a: u32, b: u32) -> u64 {
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}
