//! The smallest circle around points of the plane.
//!
//! The circle of at most three points is held. The point farthest outside joins them, and the smallest circle around these four
//! is the next one. The radius grows in every round, so no set of three comes twice. (The dual simplex method for this problem;
//! B. Gärtner, Fast and robust smallest enclosing balls, 1999.)

/// The circle and the points on it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Circle {
    pub center: [f64; 2],
    pub radius: f64,
    /// Two or three indices; one where all points are equal.
    pub touching: Vec<usize>,
}

/// Rounding of distances, relative to the radius.
const RADIUS_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The smallest circle around all `points`; of none, a circle of radius 0 about the origin.
pub(super) fn smallest(points: &[[f64; 2]]) -> Circle {
    let Some(&first) = points.first() else {
        return Circle { center: [0.0; 2], radius: 0.0, touching: vec![] };
    };
    let mut circle = Circle { center: first, radius: 0.0, touching: vec![0] };
    for _ in 0..points.len().max(64) {
        let far = |i: usize| distance(points[i], circle.center);
        let farthest = (0..points.len()).fold((0.0, 0), |m, i| if far(i) > m.0 { (far(i), i) } else { m });
        if farthest.0 <= circle.radius * (1.0 + RADIUS_ROUNDING) || circle.touching.contains(&farthest.1) {
            // Points that rounding leaves outside belong to the zone.
            circle.radius = circle.radius.max(farthest.0);
            break;
        }
        let mut four = circle.touching.clone();
        four.push(farthest.1);
        match smallest_around(points, &four) {
            Some(next) if next.radius > circle.radius => circle = next,
            _ => break,
        }
    }
    circle
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// The smallest circle around at most four points: that of two or three of them that holds the others.
fn smallest_around(points: &[[f64; 2]], chosen: &[usize]) -> Option<Circle> {
    let mut candidates = Vec::new();
    for (k, &i) in chosen.iter().enumerate() {
        for (l, &j) in chosen.iter().enumerate().skip(k + 1) {
            let (a, b) = (points[i], points[j]);
            let center = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            candidates.push(Circle { center, radius: 0.5 * distance(a, b), touching: vec![i, j] });
            for &m in &chosen[l + 1..] {
                let center = through(a, b, points[m]);
                candidates.extend(center.map(|center| {
                    let radius =
                        [a, b, points[m]].map(|p| distance(p, center)).into_iter().fold(0.0, f64::max);
                    Circle { center, radius, touching: vec![i, j, m] }
                }));
            }
        }
    }
    let holds = |c: &Circle| {
        chosen.iter().all(|&i| distance(points[i], c.center) <= c.radius * (1.0 + 4.0 * RADIUS_ROUNDING))
    };
    candidates.into_iter().filter(holds).min_by(|a, b| a.radius.total_cmp(&b.radius))
}

/// Center of the circle through three points; `None` where they lie on a line.
fn through(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Option<[f64; 2]> {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let twice = 2.0 * (u[0] * v[1] - u[1] * v[0]);
    let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
    let offset = [(v[1] * uu - u[1] * vv) / twice, (u[0] * vv - v[0] * uu) / twice];
    offset.iter().all(|x| x.is_finite()).then_some([a[0] + offset[0], a[1] + offset[1]])
}
