//! Places and directions in the plane.

/// The way from `b` to `a`.
pub(crate) fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// How far two places are apart.
pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

/// Angle from one direction to another, left positive, radians.
pub(crate) fn angle(u: [f64; 2], v: [f64; 2]) -> f64 {
    libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
}

/// Distance of a point to the left of the line through `at` along a unit vector.
pub(crate) fn left(p: [f64; 2], at: [f64; 2], along: [f64; 2]) -> f64 {
    let d = minus(p, at);
    along[0] * d[1] - along[1] * d[0]
}

/// Distance of a point from the line through two others.
pub(crate) fn off_line([a, b]: [[f64; 2]; 2], p: [f64; 2]) -> f64 {
    let size = distance(a, b).max(f64::MIN_POSITIVE);
    left(p, a, minus(b, a).map(|x| x / size)).abs()
}

/// Distance of a point from the circle, or line, through three others.
pub(crate) fn off_circle([a, b, c]: [[f64; 2]; 3], p: [f64; 2]) -> f64 {
    let (u, v, w) = (minus(b, a), minus(c, a), minus(p, a));
    let det = 2.0 * (u[0] * v[1] - u[1] * v[0]);
    let size = distance(a, c).max(f64::MIN_POSITIVE);
    if det.abs() <= 1e-12 * dot(u, u).max(dot(v, v)) {
        return left(p, a, v.map(|x| x / size)).abs();
    }
    let (uu, vv) = (dot(u, u), dot(v, v));
    let center = [(v[1] * uu - u[1] * vv) / det, (u[0] * vv - v[0] * uu) / det];
    (distance(w, center) - distance([0.0; 2], center)).abs()
}
