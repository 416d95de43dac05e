//! The minimum bounding rectangle of points in the plane.

/// A rectangle: its corner and the unit direction of its first side, the longer one; the second stands to its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// The corner from which both sides start.
    pub corner: [f64; 2],
    /// Unit direction of the longer side.
    pub along: [f64; 2],
    /// Lengths of the longer and the shorter side.
    pub sides: [f64; 2],
}

/// The rectangle of least area around `points`; `None` of fewer than three points or of points on one straight line.
///
/// One of its sides lies along a side of the convex hull. (Freeman and Shapira, Determining the minimum-area encasing
/// rectangle for an arbitrary closed curve, Communications of the ACM 18, 1975). The first of several is returned, with
/// a first side that points to positive coordinates. Cost: a sort of the points.
///
/// ```
/// use trueness_surface::minimum_rectangle;
/// let found = minimum_rectangle(&[[0.0, 0.0], [2.0, 2.0], [1.0, 3.0], [-1.0, 1.0], [0.5, 1.5]]).unwrap();
/// assert!((found.sides[0] - 8f64.sqrt()).abs() < 1e-15 && (found.sides[1] - 2f64.sqrt()).abs() < 1e-15);
/// ```
pub fn minimum_rectangle(points: &[[f64; 2]]) -> Option<Rectangle> {
    let hull = hull(points);
    if hull.len() < 3 {
        return None;
    }
    let n = hull.len();
    let mut best: Option<(f64, Rectangle)> = None;
    // The corners farthest along a side, away from it, and back along it: they only move on as the side does.
    let (mut ahead, mut away, mut behind) = (1, 1, 1);
    for i in 0..n {
        let (a, b) = (hull[i], hull[(i + 1) % n]);
        let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
        let x = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        let own = |k: usize| {
            let p = hull[k % n];
            [p[0] * x[0] + p[1] * x[1], p[1] * x[0] - p[0] * x[1]]
        };
        let climb = |mut k: usize, rises: &dyn Fn(usize) -> bool| {
            while k < i + n && rises(k) {
                k += 1;
            }
            k
        };
        ahead = climb(ahead.max(i + 1), &|k| own(k + 1)[0] > own(k)[0]);
        away = climb(away.max(ahead), &|k| own(k + 1)[1] > own(k)[1]);
        behind = climb(behind.max(away), &|k| own(k + 1)[0] < own(k)[0]);
        let (low, high) = ([own(behind)[0], own(i)[1]], [own(ahead)[0], own(away)[1]]);
        let sides = [high[0] - low[0], high[1] - low[1]];
        let area = sides[0] * sides[1];
        // An area that is smaller by rounding only is no reason to turn.
        if best.as_ref().is_none_or(|(least, _)| area < least * (1.0 - 1e-12)) {
            best = Some((area, oriented(x, low, high, sides)));
        }
    }
    best.map(|(_, r)| r).filter(|r| r.sides[1] > 4.0 * f64::EPSILON * r.sides[0])
}

/// The longer side first, pointing to where its larger coordinate is positive.
fn oriented(x: [f64; 2], low: [f64; 2], high: [f64; 2], sides: [f64; 2]) -> Rectangle {
    let y = [-x[1], x[0]];
    let place = |a: f64, b: f64| [a * x[0] + b * y[0], a * x[1] + b * y[1]];
    // The four ways to stand on a corner with the second side to the left.
    let ways = [
        (place(low[0], low[1]), x, sides),
        (place(high[0], low[1]), y, [sides[1], sides[0]]),
        (place(high[0], high[1]), [-x[0], -x[1]], sides),
        (place(low[0], high[1]), [-y[0], -y[1]], [sides[1], sides[0]]),
    ];
    let longer = sides[0].max(sides[1]) * (1.0 - 1e-12);
    // A square has that side first which is nearest to the first coordinate.
    let score = |way: &([f64; 2], [f64; 2], [f64; 2])| {
        let [a, b] = way.1;
        let positive = if a.abs() >= b.abs() { a } else { b };
        (way.2[0] >= longer, positive > 0.0, a.abs() >= b.abs())
    };
    let mut best = ways[0];
    for way in &ways[1..] {
        if score(way) > score(&best) {
            best = *way;
        }
    }
    Rectangle { corner: best.0, along: best.1, sides: best.2 }
}

/// The points without those inside of the octagon of the farthest ones in eight directions: none of them is a corner of
/// the hull. (Akl and Toussaint, A fast convex hull algorithm, Information Processing Letters 7, 1978).
fn outer(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let directions: [[f64; 2]; 8] = [
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [-1.0, 1.0],
        [-1.0, 0.0],
        [-1.0, -1.0],
        [0.0, -1.0],
        [1.0, -1.0],
    ];
    let mut far = [(f64::NEG_INFINITY, [0.0; 2]); 8];
    for p in points {
        for (far, d) in far.iter_mut().zip(directions) {
            let along = d[0] * p[0] + d[1] * p[1];
            if along > far.0 {
                *far = (along, *p);
            }
        }
    }
    let size = far.iter().fold(0.0, |m: f64, (_, p)| m.max(p[0].abs()).max(p[1].abs()));
    // Beyond the rounding of the products.
    let least = 64.0 * f64::EPSILON * size * size;
    let inside = |p: &[f64; 2]| {
        (0..8).all(|k| {
            let (a, b) = (far[k].1, far[(k + 1) % 8].1);
            a == b || (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > least
        })
    };
    let corner = far.windows(2).any(|w| w[0].1 != w[1].1);
    points.iter().filter(|p| !(corner && inside(p))).copied().collect()
}

/// The corners of the convex hull, counter-clockwise from the least (Andrew's monotone chain).
fn hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = outer(points);
    sorted.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    let turn =
        |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let mut chain: Vec<[f64; 2]> = vec![];
    let mut least = 0;
    let back = sorted.iter().rev().skip(1);
    for (n, p) in sorted.iter().chain(back).enumerate() {
        if n == sorted.len() {
            least = chain.len() - 1;
        }
        while chain.len() >= least + 2 && turn(chain[chain.len() - 2], chain[chain.len() - 1], *p) <= 0.0 {
            chain.pop();
        }
        chain.push(*p);
    }
    if chain.len() > 1 {
        chain.pop();
    }
    chain
}
