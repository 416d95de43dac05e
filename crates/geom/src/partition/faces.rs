//! The nominal cut into faces, and where a point lies on a face.

use crate::closest::{BoundaryEdges, Tree};
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::segment::{self, Options, SegmentError};
use crate::shape::Shape;
use crate::space::{self, Aabb, Point, Vector, cross, dot, minus, norm, plus, times, unit};
use std::collections::BTreeMap;

/// No face.
pub const NO_FACE: u32 = u32::MAX;

/// A face of the nominal.
pub struct Face {
    /// Its facets, ascending.
    pub facets: Vec<u32>,
    /// The element that it lies on; `None` where it is free.
    pub shape: Option<Shape>,
    /// Box around it.
    pub bounds: Aabb,
    /// 1 where distances of the element are positive outside of the material, else −1.
    pub(super) outward: f64,
    mesh: Mesh,
    tree: Tree,
    rim: BoundaryEdges,
    /// Its border as facets without area; `None` of a closed face.
    border: Option<Tree>,
}

/// Where a point lies on a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seat {
    /// Distance across the face, positive outside of the material.
    pub off: f64,
    /// Distance of its foot from the border, along the face; below 0 beyond it.
    pub within: f64,
    /// Unit normal of the face there, out of the material.
    pub normal: Vector,
}

/// A nominal cut into faces.
pub struct Faces {
    /// The faces.
    pub all: Vec<Face>,
    /// The face of each facet; [`NO_FACE`] of those without area.
    pub of_facets: Vec<u32>,
}

impl Faces {
    /// The faces of a nominal with outward facets that share vertices. Facets without area are of none.
    ///
    /// # Errors
    /// [`SegmentError`]: no facets, coordinates that are no numbers.
    pub fn of(nominal: &Mesh, progress: &dyn Progress) -> Result<Faces, SegmentError> {
        let options = Options::default();
        let found = segment::mesh(nominal, &options, progress)?;
        let mut of_facets = found.labels.clone();
        let mut shapes: Vec<Option<Shape>> = found.regions.iter().map(|r| Some(r.fit.shape)).collect();
        free(nominal, options.crease, &mut of_facets, &mut shapes);
        let mut facets: Vec<Vec<u32>> = vec![vec![]; shapes.len()];
        for (facet, &face) in (0u32..).zip(&of_facets).filter(|f| *f.1 != NO_FACE) {
            facets[face as usize].push(facet);
        }
        let all = facets.into_iter().zip(shapes).map(|(facets, shape)| Face::new(nominal, facets, shape));
        Ok(Faces { all: all.collect::<Option<_>>().ok_or(SegmentError::NoSurface)?, of_facets })
    }
}

/// Gives facets without a face new ones, each up to creases from this angle on and to the other faces.
fn free(nominal: &Mesh, crease: f64, of_facets: &mut [u32], shapes: &mut Vec<Option<Shape>>) {
    let normals: Vec<Option<Vector>> = nominal.faces.iter().map(|f| normal(nominal, f)).collect();
    let mut sides: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    let is_free = |facet: usize, of: &[u32]| of[facet] == NO_FACE && normals[facet].is_some();
    for (facet, f) in nominal.faces.iter().enumerate().filter(|(i, _)| is_free(*i, of_facets)) {
        for k in 0..3 {
            let (a, b) = (f[k], f[(k + 1) % 3]);
            sides.entry([a.min(b), a.max(b)]).or_default().push(facet as u32);
        }
    }
    for start in 0..of_facets.len() {
        if !is_free(start, of_facets) {
            continue;
        }
        let number = shapes.len() as u32;
        shapes.push(None);
        of_facets[start] = number;
        let mut waiting = vec![start as u32];
        while let Some(facet) = waiting.pop() {
            let f = nominal.faces[facet as usize];
            for k in 0..3 {
                let (a, b) = (f[k], f[(k + 1) % 3]);
                for &other in sides.get(&[a.min(b), a.max(b)]).into_iter().flatten() {
                    let smooth = match (normals[facet as usize], normals[other as usize]) {
                        (Some(a), Some(b)) => dot(a, b) >= libm::cos(crease),
                        _ => false,
                    };
                    if smooth && of_facets[other as usize] == NO_FACE {
                        of_facets[other as usize] = number;
                        waiting.push(other);
                    }
                }
            }
        }
    }
}

fn normal(mesh: &Mesh, f: &[u32; 3]) -> Option<Vector> {
    space::normal(f.map(|v| mesh.positions[v as usize]))
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
            let [a, b, c] = f.map(|v| mesh.positions[v as usize]);
            let middle = times(1.0 / 3.0, plus(a, plus(b, c)));
            dot(shape.normal(middle), cross(minus(b, a), minus(c, a)))
        };
        let facing = shape.map_or(1.0, |s| mesh.faces.iter().map(|f| towards(s, f)).sum());
        let bounds = Aabb::of(&mesh.positions);
        Some(Face { facets, shape, bounds, outward: 1f64.copysign(facing), mesh, tree, rim, border })
    }

    /// Where a point lies on the face; `None` where that is farther than the reach, or the element has no direction there.
    pub(super) fn seat(&self, p: Point, reach: f64) -> Option<Seat> {
        match self.shape {
            Some(shape) => {
                let off = self.outward * shape.distance(p);
                if off.is_nan() || off.abs() > reach {
                    return None;
                }
                let normal = times(self.outward, unit(shape.normal(p))?.0);
                let foot = minus(p, times(off, normal));
                let place = self.tree.closest(&foot, f64::INFINITY).ok()??;
                let within = match self.rim.holds(&place) {
                    true => -place.distance,
                    false => self.to_border(&foot),
                };
                Some(Seat { off, within, normal })
            }
            None => {
                let place = self.tree.closest(&p, f64::INFINITY).ok()??;
                let away = minus(p, place.point);
                let normal = normal(&self.mesh, self.mesh.faces.get(place.face as usize)?)?;
                let across = dot(away, normal);
                let along = norm(minus(away, times(across, normal)));
                let (off, within) = match self.rim.holds(&place) {
                    true => (across, -along),
                    false => (norm(away).copysign(across), self.to_border(&place.point)),
                };
                (off.abs() <= reach).then_some(Seat { off, within, normal })
            }
        }
    }

    fn to_border(&self, foot: &Point) -> f64 {
        let Some(border) = &self.border else { return f64::INFINITY };
        border.closest(foot, f64::INFINITY).ok().flatten().map_or(f64::INFINITY, |c| c.distance)
    }
}
