//! Elements from a patch of places with normals, by small linear systems: starts that least squares improves.
//!
//! Normals may point to either side. Cylinder: the axis is the direction that the normals avoid. Cone: all tangent planes meet
//! in the apex. Torus: every normal meets the axis, which is a linear condition on the axis' line coordinates. (H. Pottmann, J.
//! Wallner, Computational Line Geometry, 2001, chapter 7.)

use super::points::flattest;
use crate::num::dense::{eigen, solve};
use crate::shape::{Kind, Shape};
use crate::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// Places with unit normals.
pub(super) type Patch = [(Point, Vector)];

/// The kinds that can be found, the order in which they are tried.
pub const KINDS: [Kind; 5] = [Kind::Plane, Kind::Cylinder, Kind::Cone, Kind::Sphere, Kind::Torus];

/// Greatest radius, in diagonals of the part.
const MAX_RADIUS_DIAGONALS: f64 = 10.0;
/// Greatest quotient of the radii of a torus: a thicker one is as good as a sphere of the same points.
const MAX_TORUS_RATIO: f64 = 0.95;

/// An element of the kind near the patch; `None` where the patch does not show one, and of kinds that are not in [`KINDS`].
pub(super) fn estimate(kind: Kind, patch: &Patch) -> Option<Shape> {
    match kind {
        Kind::Plane => plane(patch),
        Kind::Sphere => sphere(patch),
        Kind::Cylinder => cylinder(patch),
        Kind::Cone => cone(patch),
        Kind::Torus => torus(patch),
        Kind::Line2 | Kind::Line | Kind::Circle2 | Kind::Circle | Kind::Ellipse2 => None,
    }
}

/// Whether a part of this size can show the element. A cone has no limit of its half angle but what shows. Over all of the part
/// it leaves the plane, or the cylinder, that it tends to by more than pieces may lie off.
pub(super) fn is_sound(shape: &Shape, size: f64, tolerance: f64) -> bool {
    let most = MAX_RADIUS_DIAGONALS * size;
    match *shape {
        Shape::Sphere { radius, .. } | Shape::Cylinder { radius, .. } => radius < most,
        Shape::Cone { half_angle, radius, .. } => {
            let (sin, cos) = libm::sincos(half_angle);
            // The sag of a chord as long as the part, and how far its ends are apart in radius.
            radius > 0.0 && size * size * cos > 8.0 * radius * tolerance && size * sin > tolerance
        }
        Shape::Torus { major_radius, minor_radius, .. } => {
            major_radius < most && minor_radius < MAX_TORUS_RATIO * major_radius
        }
        Shape::Plane { .. } => true,
        // Curves are no faces.
        Shape::Line2 { .. }
        | Shape::Line { .. }
        | Shape::Circle2 { .. }
        | Shape::Circle { .. }
        | Shape::Ellipse2 { .. } => false,
    }
}

fn mean(points: impl Iterator<Item = Point> + Clone) -> Point {
    let count = points.clone().count() as f64;
    times(1.0 / count, points.fold([0.0; 3], plus))
}

/// Adds `s · a bᵀ`.
fn add_outer(matrix: &mut [[f64; 3]; 3], s: f64, a: Vector, b: Vector) {
    for i in 0..3 {
        for j in 0..3 {
            matrix[i][j] += s * a[i] * b[j];
        }
    }
}

/// Sum of the products of the normals' coordinates.
fn spread(patch: &Patch) -> [[f64; 3]; 3] {
    let mut normals = [[0.0; 3]; 3];
    for &(_, n) in patch {
        add_outer(&mut normals, 1.0, n, n);
    }
    normals
}

fn solved(matrix: [[f64; 3]; 3], right: Vector) -> Option<Vector> {
    let x = solve(matrix.iter().map(|row| row.to_vec()).collect(), right.to_vec())?;
    Some([x[0], x[1], x[2]])
}

fn plane(patch: &Patch) -> Option<Shape> {
    // The middles of two facets lie on a line: their normals tell.
    Some(Shape::Plane { point: mean(patch.iter().map(|p| p.0)), normal: eigen(spread(patch)).1[2] })
}

/// Center and radius of the circle or sphere through the places, in the directions in which they spread. The normals tell more
/// of a small patch. The places alone do not care on which side the normals are.
fn round(patch: &Patch) -> Option<(Point, f64)> {
    let square = |&(center, radius): &(Point, f64)| -> f64 {
        patch.iter().map(|p| (norm(minus(p.0, center)) - radius).powi(2)).sum()
    };
    let both = by_normals(patch).into_iter().chain(by_places(patch));
    both.min_by(|a, b| square(a).total_cmp(&square(b)))
}

/// From `place = center + radius · normal`, with normals turned to the side of the first one.
fn by_normals(patch: &Patch) -> Option<(Point, f64)> {
    let first = patch.first()?.1;
    let sided = patch.iter().map(|&(p, n)| (p, if dot(n, first) < 0.0 { times(-1.0, n) } else { n }));
    let (place, normal) = (mean(sided.clone().map(|s| s.0)), mean(sided.clone().map(|s| s.1)));
    let (mut both, mut square) = (0.0, 0.0);
    for (p, n) in sided {
        let n = minus(n, normal);
        both += dot(minus(p, place), n);
        square += dot(n, n);
    }
    let radius = both / square;
    radius.is_finite().then(|| (minus(place, times(radius, normal)), radius.abs()))
}

/// From |q|² = 2 center · q + constant, for q about the mean (I. Kåsa, 1976).
fn by_places(patch: &Patch) -> Option<(Point, f64)> {
    let middle = mean(patch.iter().map(|p| p.0));
    let (mut matrix, mut right, mut square) = ([[0.0; 3]; 3], [0.0; 3], 0.0);
    for &(p, _) in patch {
        let q = minus(p, middle);
        add_outer(&mut matrix, 2.0, q, q);
        right = plus(right, times(dot(q, q), q));
        square += dot(q, q);
    }
    // A direction in which there is no spread, across a section, shall be left out.
    for (k, row) in matrix.iter_mut().enumerate() {
        row[k] += 1e-12 * square;
    }
    let center = solved(matrix, right)?;
    let radius = (square / patch.len() as f64 + dot(center, center)).sqrt();
    Some((plus(middle, center), radius))
}

fn sphere(patch: &Patch) -> Option<Shape> {
    round(patch).map(|(center, radius)| Shape::Sphere { center, radius })
}

fn cylinder(patch: &Patch) -> Option<Shape> {
    let direction = eigen(spread(patch)).1[0];
    let across = |v: Vector| minus(v, times(dot(v, direction), direction));
    let section: Vec<(Point, Vector)> = patch.iter().map(|&(p, n)| (across(p), across(n))).collect();
    let (center, radius) = round(&section)?;
    let along = dot(mean(patch.iter().map(|p| p.0)), direction);
    Some(Shape::Cylinder { point: plus(center, times(along, direction)), direction, radius })
}

fn cone(patch: &Patch) -> Option<Shape> {
    let middle = mean(patch.iter().map(|p| p.0));
    let right = patch.iter().fold([0.0; 3], |sum, &(p, n)| plus(sum, times(dot(n, minus(p, middle)), n)));
    let apex = plus(middle, solved(spread(patch), right)?);
    // Seen from the apex, the places lie on a circle about the axis.
    let rays: Vec<Vector> = patch.iter().filter_map(|p| Some(unit(minus(p.0, apex))?.0)).collect();
    let direction = flattest(&rays);
    let cosine = dot(mean(rays.into_iter()), direction);
    let direction = times(cosine.signum(), direction);
    let half_angle = libm::acos(cosine.abs().min(1.0));
    let height = dot(minus(middle, apex), direction);
    let point = plus(apex, times(height, direction));
    let sound = height > 0.0 && half_angle > 0.0 && norm(direction) > 0.5;
    sound.then(|| Shape::Cone { apex, direction, half_angle, point, radius: height * libm::tan(half_angle) })
}

/// By its axis, which a large piece shows best, or as a bent tube, as which a short piece of a fillet looks.
fn torus(patch: &Patch) -> Option<Shape> {
    let square = |shape: &Shape| -> f64 { patch.iter().map(|p| shape.distance(p.0).powi(2)).sum() };
    let both = about_axis(patch).into_iter().chain(bent_tube(patch));
    both.min_by(|a, b| square(a).total_cmp(&square(b)))
}

/// From the cylinder through the patch: the middle of the tube is c + δ + t τ + ½ t² κ at height t. To first order that changes
/// the distance by its product with the direction outwards.
fn bent_tube(patch: &Patch) -> Option<Shape> {
    let Shape::Cylinder { point, direction, radius } = cylinder(patch)? else { return None };
    let first = minus(patch.first()?.0, point);
    let (u, _) = unit(minus(first, times(dot(first, direction), direction)))?;
    let v = cross(direction, u);
    let (mut matrix, mut right) = (vec![vec![0.0; 7]; 7], vec![0.0; 7]);
    for &(p, _) in patch {
        let q = minus(p, point);
        let t = dot(q, direction);
        let (x, y) = (dot(q, u), dot(q, v));
        let rho = libm::hypot(x, y);
        let [cos, sin] = [x / rho, y / rho];
        let row = [1.0, cos, sin, t * cos, t * sin, 0.5 * t * t * cos, 0.5 * t * t * sin];
        for i in 0..7 {
            right[i] += row[i] * (rho - radius);
            for j in 0..7 {
                matrix[i][j] += row[i] * row[j];
            }
        }
    }
    let x = solve(matrix, right)?;
    let bend = plus(times(x[5], u), times(x[6], v));
    let (inwards, curvature) = unit(bend)?;
    let middle = plus(point, plus(times(x[1], u), times(x[2], v)));
    let (major_radius, minor_radius) = (1.0 / curvature, radius + x[0]);
    (minor_radius > 0.0 && major_radius > minor_radius).then(|| Shape::Torus {
        center: plus(middle, times(major_radius, inwards)),
        direction: cross(direction, inwards),
        major_radius,
        minor_radius,
    })
}

fn about_axis(patch: &Patch) -> Option<Shape> {
    let (axis, point) = axis_of_revolution(patch)?;
    let section: Vec<(Point, Vector)> = (patch.iter())
        .filter_map(|&(p, n)| {
            let q = minus(p, point);
            let height = dot(q, axis);
            let (out, rho) = unit(minus(q, times(height, axis)))?;
            Some(([rho, height, 0.0], [dot(n, out), dot(n, axis), 0.0]))
        })
        .collect();
    let (center, minor_radius) = round(&section)?;
    let major_radius = center[0];
    (major_radius > minor_radius).then(|| Shape::Torus {
        center: plus(point, times(center[1], axis)),
        direction: axis,
        major_radius,
        minor_radius,
    })
}

/// Direction and a point of the line that the lines along the normals meet best.
fn axis_of_revolution(patch: &Patch) -> Option<(Vector, Point)> {
    let middle = mean(patch.iter().map(|p| p.0));
    let (mut moments, mut mixed) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
    for &(p, n) in patch {
        let moment = cross(minus(p, middle), n);
        add_outer(&mut moments, 1.0, moment, moment);
        add_outer(&mut mixed, 1.0, n, moment);
    }
    let normals = spread(patch);
    // The axis' own moment that is best for a given direction a: −normals⁻¹ · mixed · a.
    let columns: Vec<Vector> =
        (0..3).map(|j| solved(normals, std::array::from_fn(|i| -mixed[i][j]))).collect::<Option<_>>()?;
    let mut rest = moments;
    for i in 0..3 {
        for j in 0..3 {
            rest[i][j] += (0..3).map(|k| mixed[k][i] * columns[j][k]).sum::<f64>();
        }
    }
    let axis = eigen(rest).1[0];
    let moment = (0..3).fold([0.0; 3], |m, j| plus(m, times(axis[j], columns[j])));
    Some((axis, plus(middle, cross(axis, moment))))
}

#[cfg(test)]
mod tests {
    use super::super::{probe::Probe, tests::one_of_each};
    use super::*;

    /// A piece of each element is recognized from places and normals of either side.
    #[test]
    fn patches_give_their_element() {
        let direction = unit([0.3, -0.5, 0.8]).unwrap().0;
        let center = [10.0, -4.0, 7.0];
        for shape in one_of_each(center, direction, 0.3) {
            let probe = Probe::new(&shape);
            let patch: Vec<(Point, Vector)> = (0..60)
                .map(|k| {
                    let t = f64::from(k);
                    let mut p =
                        plus(center, [4.0 + (0.9 * t).sin(), 2.0 * (1.7 * t).cos(), 1.5 * (2.3 * t).sin()]);
                    for _ in 0..3 {
                        p = minus(p, times(shape.distance(p), unit(probe.normal(p)).unwrap().0));
                    }
                    let side = if k % 3 == 0 { -1.0 } else { 1.0 };
                    (p, times(side, unit(probe.normal(p)).unwrap().0))
                })
                .collect();
            let found = estimate(shape.kind(), &patch).unwrap();
            for (p, _) in &patch {
                assert!(found.distance(*p).abs() < 1e-9, "{shape:?} {found:?}");
            }
            let far = plus(center, times(3.0, direction));
            assert!(
                (found.distance(far).abs() - shape.distance(far).abs()).abs() < 1e-7,
                "{shape:?} {found:?}"
            );
        }
    }
}
