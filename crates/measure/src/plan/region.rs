//! A region of a segmented nominal mesh as the nominal of a feature: the element within the bounds of its facets.

use trueness_geom::feature::Nominal;
use trueness_geom::mesh::Mesh;
use trueness_geom::rigid::Rigid;
use trueness_geom::segment::Segmentation;
use trueness_geom::shape::Shape;
use trueness_geom::space::{Point, Vector, cross, dot, least_axis, minus, plus, times};

/// The corners of the facets of a region.
pub fn facets_of(mesh: &Mesh, found: &Segmentation, label: u32) -> Vec<[Point; 3]> {
    let own = mesh.faces.iter().zip(&found.labels).filter(|(_, l)| **l == label);
    let corner = |v: u32| mesh.positions.get(v as usize).copied();
    own.filter_map(|(f, _)| Some([corner(f[0])?, corner(f[1])?, corner(f[2])?])).collect()
}

/// The nominal of an element with these facets, outward ones; of a plane, the smallest rectangle along its own axes.
/// `None` for what has no nominal form (a torus) or no facets.
pub fn nominal_of(shape: &Shape, facets: &[[Point; 3]]) -> Option<Nominal> {
    let points = || facets.iter().flatten();
    let range = |origin: Point, way: Vector| {
        let along = points().map(|p| dot(minus(*p, origin), way));
        let low = along.clone().fold(f64::INFINITY, f64::min);
        (low, along.fold(f64::NEG_INFINITY, f64::max))
    };
    let at = |origin: Point, way: Vector, t: f64| plus(origin, times(t, way));
    if facets.is_empty() {
        return None;
    }
    match *shape {
        Shape::Plane { point, normal } => {
            let facing =
                facets.iter().fold([0.0; 3], |s, [a, b, c]| plus(s, cross(minus(*b, *a), minus(*c, *a))));
            let normal = if dot(facing, normal) < 0.0 { times(-1.0, normal) } else { normal };
            let [u, v, _] = Rigid::into_frame(point, normal, least_axis(normal))?.rotation();
            let ((a, b), (c, d)) = (range(point, u), range(point, v));
            let corner = |s: f64, t: f64| at(at(point, u, s), v, t);
            let boundary = vec![corner(a, c), corner(b, c), corner(b, d), corner(a, d)];
            Some(Nominal::Plane { point, normal, boundary })
        }
        Shape::Cylinder { point, direction, radius } => {
            let (from, to) = range(point, direction);
            Some(Nominal::Cylinder {
                point: at(point, direction, from),
                direction,
                radius,
                length: to - from,
            })
        }
        Shape::Cone { apex, direction, half_angle, .. } => {
            let (from, to) = range(apex, direction);
            Some(Nominal::Cone { apex, direction, half_angle, between: [from.max(0.0), to] })
        }
        Shape::Sphere { center, radius } => Some(Nominal::Sphere { center, radius }),
        // Those without, as `Kind::has_nominal` says.
        _ => None,
    }
}
