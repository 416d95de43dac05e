//! Boxes around what is seen from a place: of directions, as points of the unit sphere.

use crate::space::{Aabb, Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// Rounding of directions: some ten roundings of 2^-53, and much to spare.
const DIRECTION_ROUNDING: f64 = 1e-12;

/// All directions.
const ANYWHERE: Aabb = Aabb { min: [-1.0; 3], max: [1.0; 3] };

/// Unit vector from one place to another, whatever their distance; `None` where it is beyond numbers.
fn direction(from: Point, to: Point) -> Option<Point> {
    let way = minus(to, from);
    let size = way.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    unit(way.map(|x| x / size)).map(|(direction, _)| direction)
}

/// Box of the directions from `center` to the places of a segment.
pub fn segment(center: Point, a: Point, b: Point) -> Aabb {
    match (direction(center, a), direction(center, b)) {
        (Some(u), Some(v)) => arc(u, v),
        _ => ANYWHERE,
    }
}

/// Box of the directions from `center` to the places of a triangle.
pub(super) fn triangle(center: Point, [a, b, c]: [Point; 3]) -> Aabb {
    /// Beyond 113 degrees between two corners the center may lie in the triangle.
    const MIN_CORNER_COSINE: f64 = -0.4;
    let (Some(u), Some(v), Some(w)) = (direction(center, a), direction(center, b), direction(center, c))
    else {
        return ANYWHERE;
    };
    if dot(u, v).min(dot(v, w)).min(dot(w, u)) < MIN_CORNER_COSINE {
        return ANYWHERE;
    }
    let mut bounds = arc(u, v).union(&arc(v, w)).union(&arc(w, u));
    // A coordinate is greatest on the rim, or at the end of its axis where that is seen through the triangle.
    let normals = [cross(u, v), cross(v, w), cross(w, u)];
    for k in 0..3 {
        let through = |sign: f64| {
            let along = normals.map(|n| sign * n[k]);
            let inside = along.iter().all(|x| *x >= -DIRECTION_ROUNDING)
                || along.iter().all(|x| *x <= DIRECTION_ROUNDING);
            // Seen, and not behind.
            inside && sign * (u[k] + v[k] + w[k]) > 0.0
        };
        if through(1.0) {
            bounds.max[k] = 1.0;
        }
        if through(-1.0) {
            bounds.min[k] = -1.0;
        }
    }
    bounds
}

/// Half-spaces through `center`, one at each side, that hold the directions to all places of a triangle.
///
/// A long thin triangle fills next to nothing of its box: these tell what lies beside it. The other hub of two that cross sees
/// every facet so.
pub(super) struct Sides([Vector; 3]);

impl Sides {
    pub fn of(center: Point, [a, b, c]: [Point; 3]) -> Sides {
        let (Some(u), Some(v), Some(w)) = (direction(center, a), direction(center, b), direction(center, c))
        else {
            return Sides([[0.0; 3]; 3]);
        };
        let inward = |u: Point, v: Point, w: Point| {
            let normal = cross(u, v);
            let height = dot(normal, w);
            // Seen edge-on there is no telling the side: none.
            if height.abs() > DIRECTION_ROUNDING { times(height.signum(), normal) } else { [0.0; 3] }
        };
        Sides([inward(u, v, w), inward(v, w, u), inward(w, u, v)])
    }

    /// Whether all directions of a box are outside.
    pub fn miss(&self, seen: &Aabb) -> bool {
        let highest = |n: &Vector| (0..3).map(|k| (n[k] * seen.min[k]).max(n[k] * seen.max[k])).sum::<f64>();
        self.0.iter().any(|n| highest(n) < -DIRECTION_ROUNDING)
    }
}

/// Box of the shorter arc of a great circle between two directions.
fn arc(u: Point, v: Point) -> Aabb {
    /// Shorter arcs rise so little over their chord that this is as good a bound.
    const MAX_SHORT_ARC_SINE: f64 = 1e-3;
    /// Cosine of the arc from which on an arc may be seen either way round.
    const MAX_LONG_ARC_COSINE: f64 = -0.999_999;
    let cosine = dot(u, v);
    if cosine < MAX_LONG_ARC_COSINE {
        return ANYWHERE;
    }
    let normal = cross(u, v);
    let ends = Aabb::of([&u, &v]);
    let widened = |b: Aabb, by: f64| Aabb { min: b.min.map(|x| x - by), max: b.max.map(|x| x + by) };
    let Some((n, sine)) = unit(normal).filter(|(_, sine)| *sine > MAX_SHORT_ARC_SINE || cosine < 0.0) else {
        // No place of an arc is farther from its chord than its middle is.
        return widened(ends, 1.0 - 0.5 * norm(plus(u, v)) + DIRECTION_ROUNDING);
    };
    let mut bounds = ends;
    for k in 0..3 {
        // The place of the circle that is greatest in this coordinate, and whether it lies between the ends.
        let axis: Point = std::array::from_fn(|i| f64::from(u8::from(i == k)));
        let top = minus(axis, times(n[k], n));
        let height = norm(top);
        let between = |p: Point| {
            dot(cross(u, p), n) >= -DIRECTION_ROUNDING * height
                && dot(cross(p, v), n) >= -DIRECTION_ROUNDING * height
        };
        if between(top) {
            bounds.max[k] = height;
        }
        if between(times(-1.0, top)) {
            bounds.min[k] = -height;
        }
    }
    // The normal is off by the rounding over the sine.
    widened(bounds, DIRECTION_ROUNDING / sine.max(MAX_SHORT_ARC_SINE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;

    #[test]
    fn boxes_hold_all_that_is_seen() {
        let random = &mut Random::new(6);
        for case in 0..3000 {
            let thin = [1.0, 1e-2, 1e-5, 1e-9][case % 4];
            let mut place = || -> Point { std::array::from_fn(|_| 2.0 * random.unit() - 1.0) };
            let (center, a, b) = (place(), place(), place());
            let c = plus(b, times(thin, place()));
            let (seen, line) = (triangle(center, [a, b, c]), segment(center, a, b));
            let holds = |bounds: &Aabb, p: Point| {
                let d = direction(center, p).unwrap();
                (0..3).all(|k| bounds.min[k] <= d[k] && d[k] <= bounds.max[k])
            };
            for _ in 0..30 {
                let (s, t) = (random.unit(), random.unit());
                let on = plus(a, times(s, minus(b, a)));
                assert!(holds(&line, on), "{case} {center:?} {a:?} {b:?} {s}");
                let inside = plus(on, times(s * t, minus(c, b)));
                assert!(holds(&seen, inside), "{case} {center:?} {a:?} {b:?} {c:?} {s} {t}");
            }
        }
    }

    /// A quarter of a circle reaches no farther than its ends.
    #[test]
    fn boxes_are_narrow() {
        let bounds = segment([0.0; 3], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0]);
        let want = Aabb { min: [0.0; 3], max: [1.0, 1.0, 0.0] };
        let off = |a: Point, b: Point| minus(a, b).iter().fold(0.0f64, |m, x| m.max(x.abs()));
        assert!(off(bounds.min, want.min) < 1e-8 && off(bounds.max, want.max) < 1e-8, "{bounds:?}");
        let leaf = triangle([0.0; 3], [[0.0, 0.0, 9.0], [1.0, 0.0, 1.0], [1.0, 1e-3, 1.0]]);
        assert!(leaf.min[0] > -1e-8 && leaf.max[0] < 0.7072 && leaf.max[1] < 1e-3, "{leaf:?}");
    }
}
