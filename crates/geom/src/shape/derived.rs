//! Elements made of fitted elements: planes, lines, points, angles and distances.
//!
//! Directions are unit vectors. Nothing here decides what "parallel" tolerates: where arithmetic cannot tell a
//! place, the answer is `None`.

use crate::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// A point and a unit normal or direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// A point of the plane or line, millimeters.
    pub point: Point,
    /// Unit normal or direction.
    pub direction: Vector,
}

/// Sines of angles below this are rounding of the directions themselves.
const MAX_PARALLEL_SINE: f64 = 8.0 * f64::EPSILON;

/// Angle between two lines or two normals without regard to their sense, 0 to π/2. Exact to rounding for small
/// angles too.
pub fn angle(a: Vector, b: Vector) -> f64 {
    libm::atan2(norm(cross(a, b)), dot(a, b).abs())
}

/// The middle of two points.
pub fn midpoint(a: Point, b: Point) -> Point {
    times(0.5, plus(a, b))
}

/// Median plane of two planes: through the middle of their points' feet on each other, its normal halving the
/// smaller angle between theirs. For parallel planes: half way between.
///
/// `None` where the normals are at right angles to rounding, so that neither of the two halving planes is nearer.
pub fn median_plane(a: Ray, b: Ray) -> Option<Ray> {
    let cosine = dot(a.direction, b.direction);
    if cosine.abs() <= MAX_PARALLEL_SINE {
        return None;
    }
    let other = times(cosine.signum(), b.direction);
    let (direction, _) = unit(plus(a.direction, other))?;
    // All points with equal distances from both planes, in the sense of the two normals.
    let middle = midpoint(a.point, b.point);
    let (da, db) = (dot(minus(middle, a.point), a.direction), dot(minus(middle, b.point), other));
    let along = dot(direction, plus(a.direction, other));
    let point = minus(middle, times((da + db) / along, direction));
    Some(Ray { point, direction })
}

/// Intersection line of two planes; its point is the one nearest to `near`. `None` for parallel planes.
pub fn plane_plane(a: Ray, b: Ray, near: Point) -> Option<Ray> {
    let across = cross(a.direction, b.direction);
    let sine = norm(across);
    if sine <= MAX_PARALLEL_SINE {
        return None;
    }
    let direction = times(1.0 / sine, across);
    let (da, db) = (dot(minus(a.point, near), a.direction), dot(minus(b.point, near), b.direction));
    let cosine = dot(a.direction, b.direction);
    let (x, y) = ((da - db * cosine) / (sine * sine), (db - da * cosine) / (sine * sine));
    Some(Ray { point: plus(near, plus(times(x, a.direction), times(y, b.direction))), direction })
}

/// Where a line meets a plane. `None` for a line parallel to it.
pub fn line_plane(line: Ray, plane: Ray) -> Option<Point> {
    let slope = dot(line.direction, plane.direction);
    if slope.abs() <= MAX_PARALLEL_SINE {
        return None;
    }
    let along = dot(minus(plane.point, line.point), plane.direction) / slope;
    Some(plus(line.point, times(along, line.direction)))
}

/// Distance of a point from a plane, positive on the side of its normal.
pub fn point_plane(point: Point, plane: Ray) -> f64 {
    dot(minus(point, plane.point), plane.direction)
}

/// Distance of a point from a line.
pub fn point_line(point: Point, line: Ray) -> f64 {
    norm(cross(minus(point, line.point), line.direction))
}

/// Least distance of two lines; of parallel ones, their common distance.
pub fn line_line(a: Ray, b: Ray) -> f64 {
    let between = minus(b.point, a.point);
    let across = cross(a.direction, b.direction);
    let sine = norm(across);
    if sine <= MAX_PARALLEL_SINE { point_line(b.point, a) } else { dot(between, across).abs() / sine }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ray(point: Point, direction: Vector) -> Ray {
        Ray { point, direction: unit(direction).unwrap().0 }
    }

    #[test]
    fn median_planes_are_as_far_from_one_as_from_the_other() {
        let cases = [
            (ray([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]), ray([9.0, 4.0, 5.0], [0.0, 0.0, -1.0])),
            (ray([1.0, 2.0, 3.0], [0.1, 0.2, 1.0]), ray([-3.0, 5.0, 8.0], [0.3, -0.1, 1.0])),
            (ray([1.0, 2.0, 3.0], [1.0, 0.2, 1.0]), ray([-3.0, 5.0, 8.0], [-1.0, -0.1, 0.4])),
        ];
        for (a, b) in cases {
            let median = median_plane(a, b).unwrap();
            let u = cross(median.direction, [0.6, 0.8, 0.0]);
            for s in [-7.0, 0.0, 11.0] {
                let p = plus(median.point, times(s, u));
                assert!((point_plane(p, a).abs() - point_plane(p, b).abs()).abs() < 1e-13);
            }
            assert!(
                (angle(median.direction, a.direction) - angle(median.direction, b.direction)).abs() < 1e-15
            );
        }
        let parallel = median_plane(cases[0].0, cases[0].1).unwrap();
        assert_eq!((parallel.point[2], parallel.direction), (3.0, [0.0, 0.0, 1.0]));
    }

    #[test]
    fn intersections_lie_in_both() {
        let (a, b) = (ray([1.0, 2.0, 3.0], [1.0, 0.2, 1.0]), ray([-3.0, 5.0, 8.0], [-1.0, -0.1, 0.4]));
        let near = [4.0, -5.0, 6.0];
        let line = plane_plane(a, b, near).unwrap();
        for s in [-3.0, 0.0, 8.0] {
            let p = plus(line.point, times(s, line.direction));
            assert!(point_plane(p, a).abs() < 1e-13 && point_plane(p, b).abs() < 1e-13);
        }
        assert!(dot(minus(line.point, near), line.direction).abs() < 1e-13);
        let p = line_plane(line, ray([0.0, 0.0, 7.0], [0.1, 0.0, 1.0])).unwrap();
        assert!(point_line(p, line) < 1e-13);
        assert!(point_plane(p, ray([0.0, 0.0, 7.0], [0.1, 0.0, 1.0])).abs() < 1e-13);
        assert!(plane_plane(a, a, near).is_none() && line_plane(line, a).is_none());
    }

    #[test]
    fn lines_have_their_common_perpendicular() {
        let (a, b) = (ray([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]), ray([5.0, 3.0, 2.0], [0.0, 1.0, 0.0]));
        assert!((line_line(a, b) - 2.0).abs() < 1e-15);
        assert!((line_line(a, ray([9.0, 3.0, 4.0], [-1.0, 0.0, 0.0])) - 5.0).abs() < 1e-15);
        assert!((angle([1.0, 0.0, 0.0], [-1.0, 1e-9, 0.0]) - 1e-9).abs() < 1e-24);
    }
}
