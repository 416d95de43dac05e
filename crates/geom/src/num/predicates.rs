//! On which side a point lies: decided exactly, whatever the rounding.
//!
//! Every sign comes from adaptive predicates (Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust
//! Geometric Predicates, 1997). They are exact for finite coordinates that are 0 or between 1e-80 and 1e60 in
//! magnitude; beyond that, products may leave the range of `f64`.

use crate::space::{Point, cross, minus, norm};
use robust::{Coord, Coord3D, orient2d, orient3d};

fn sign(x: f64) -> i32 {
    i32::from(x > 0.0) - i32::from(x < 0.0)
}

/// Side of `d` on the plane through `a`, `b`, `c`. It is +1 where the three run clockwise as seen from `d`, 0 in the plane. It
/// is −1 where they run counter-clockwise: then `d` lies outside of that face.
pub fn side_of_plane(a: &Point, b: &Point, c: &Point, d: &Point) -> i32 {
    // Sides of boxes: long arithmetic would find the same.
    if (0..3).any(|k| a[k] == d[k] && b[k] == d[k] && c[k] == d[k]) {
        return 0;
    }
    let p = |p: &Point| Coord3D { x: p[0], y: p[1], z: p[2] };
    sign(orient3d(p(a), p(b), p(c), p(d)))
}

/// Distance of `d` from the plane through `a`, `b`, `c`, with the sign of [`side_of_plane`] the other way round: positive where
/// the face looks to. As exact as the length of the normal; NaN for a flat triangle.
pub fn height([a, b, c]: [&Point; 3], d: &Point) -> f64 {
    let p = |p: &Point| Coord3D { x: p[0], y: p[1], z: p[2] };
    -orient3d(p(a), p(b), p(c), p(d)) / norm(cross(minus(*b, *a), minus(*c, *a)))
}

/// Side of `c` on the line through `a` and `b`, all seen along axis `axis` (0, 1 or 2). It is +1 on the left, 0 on the line.
pub fn side_of_line(axis: usize, a: &Point, b: &Point, c: &Point) -> i32 {
    let p = |p: &Point| Coord { x: p[(axis + 1) % 3], y: p[(axis + 2) % 3] };
    sign(orient2d(p(a), p(b), p(c)))
}

/// The first axis along which the triangle is seen as a triangle, or `None` if its corners lie on one line.
pub fn axis(triangle: &[Point; 3]) -> Option<usize> {
    let [a, b, c] = triangle;
    (0..3).find(|&k| side_of_line(k, a, b, c) != 0)
}

/// True if the corners of the triangle lie on one line. Nearly always settled by one rounded vector product.
#[inline]
pub fn is_flat(triangle: [&Point; 3]) -> bool {
    // Each component is formed with fewer than ten roundings of 2^-53; this allows for a hundred.
    const PRODUCT_DIFFERENCE_ROUNDING: f64 = 1e-14;
    let d = |j: usize, k: usize| triangle[j][k] - triangle[0][k];
    let clear = |a: usize, b: usize| {
        let (s, t) = (d(1, a) * d(2, b), d(1, b) * d(2, a));
        (s - t).abs() > PRODUCT_DIFFERENCE_ROUNDING * (s.abs() + t.abs())
    };
    !(clear(0, 1) || clear(1, 2) || clear(2, 0)) && axis(&triangle.map(|p| *p)).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_have_the_stated_sign() {
        let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!([1.0, 0.0, -1.0].map(|z| side_of_plane(&a, &b, &c, &[0.2, 0.2, z])), [-1, 0, 1]);
        assert_eq!([1.0, 0.0, -1.0].map(|y| side_of_line(2, &a, &b, &[0.5, y, 7.0])), [1, 0, -1]);
        assert_eq!(axis(&[a, b, c]), Some(2));
    }

    #[test]
    fn rounding_does_not_decide() {
        // 0.1 + 0.2 is one unit in the last place off the line through 0.3.
        let p = |x: f64| [x, x, 1.0];
        let off = [0.1 + 0.2, 0.3, 1.0];
        assert!(is_flat([&p(-1.0), &p(0.3), &p(1e9)]));
        assert!(!is_flat([&p(-1.0), &off, &p(1e9)]));
        assert_eq!(side_of_line(2, &p(-1.0), &p(1e9), &off), -1);
        assert!(is_flat([&[1.0, 2.0, 3.0], &[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0]]));
    }
}
