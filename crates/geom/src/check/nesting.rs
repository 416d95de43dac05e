//! Which closed shells lie inside which others: decided exactly.
//!
//! From a vertex of the one a ray goes in the direction of an axis. How often the facets of the other wind around it follows
//! from exact signs alone. In the projection along the ray, edges are half open, so that a ray through an edge or a vertex
//! counts once. Then the vertex lies before or behind the plane of the facet.

use crate::mesh::Mesh;
use crate::num::big;
use crate::num::predicates::{side_of_line, side_of_plane};
use crate::space::{Aabb, Point, cross, dot, minus};
use crate::spatial::columns::Columns;
use crate::spatial::seen::seen;

/// A closed shell, ready to be asked about points by rays along an axis.
pub struct Container<'a> {
    mesh: &'a Mesh,
    /// The axis of the rays.
    axis: usize,
    columns: Columns,
}

impl<'a> Container<'a> {
    /// The container of these facets, which must have finite corners, for rays along `axis`. n log n.
    pub fn new(mesh: &'a Mesh, facets: &[u32], axis: usize) -> Container<'a> {
        Container { mesh, axis, columns: Columns::new(mesh, facets, axis) }
    }

    /// As [`Container::new`], to be asked about these places only: linear, and n log n for the facets seen there.
    pub fn at(mesh: &'a Mesh, facets: &[u32], axis: usize, places: &[Point]) -> Container<'a> {
        Container::new(mesh, &seen(mesh, facets, axis, places), axis)
    }

    /// How often the shell winds around `p`: 0 outside. `None` where `p` lies on the shell. Also `None` in the plane of one of
    /// its facets, as near to it as boxes and strips along its longest side tell.
    pub fn winding(&self, p: &Point) -> Option<i32> {
        let touches = |f: u32, own: &Aabb| {
            let [a, b, c] = self.corners(f);
            (0..3).all(|k| own.min[k] <= p[k] && p[k] <= own.max[k]) && side_of_plane(&a, &b, &c, p) == 0
        };
        let (mut on_it, mut sum) = (false, 0);
        self.columns.pass(p, self.beyond(p[self.axis]), |f, own| {
            on_it = on_it || touches(f, own);
            let ([a, b, c], around) = (self.corners(f), self.around(f, p));
            sum += if around != 0 && side_of_plane(&a, &b, &c, p) == around { around } else { 0 };
        });
        (!on_it).then_some(sum)
    }

    /// Hands to `visit` each facet that a ray passes behind facet `from`, and how often it winds around the ray. The ray starts in
    /// the plane of `from` where that is seen at `target`; `from` and what lies in its plane are not behind it. Where others meet
    /// it just there, the ray beside is meant that [`Container::around`] means.
    pub fn facets_behind(&self, from: u32, target: &Point, mut visit: impl FnMut(u32, i32)) {
        let [start, end] = self.span(from);
        self.columns.pass(target, self.beyond(start), |f, own| {
            let around = if f == from { 0 } else { self.around(f, target) };
            if around != 0 && (own.min[self.axis] > end || self.is_behind([from, f], target)) {
                visit(f, around);
            }
        });
    }

    /// The same of all others that the line through `target` passes, `from` among them. Around the whole line a closed surface
    /// winds 0 times.
    pub fn facets_not_behind(&self, from: u32, target: &Point, mut visit: impl FnMut(u32, i32)) {
        let [start, end] = self.span(from);
        let before = |b: &Aabb| b.min[self.axis] <= end;
        self.columns.pass(target, before, |f, own| {
            let around = self.around(f, target);
            let is_first = || f == from || own.max[self.axis] < start || !self.is_behind([from, f], target);
            if around != 0 && is_first() {
                visit(f, around);
            }
        });
    }

    /// Whether more than half of the extent along the axis lies behind `p`.
    pub fn is_early(&self, p: &Point) -> bool {
        let Aabb { min, max } = self.columns.bounds();
        p[self.axis] < 0.5 * min[self.axis] + 0.5 * max[self.axis]
    }

    /// Whether a box reaches to `from` along the axis, or beyond.
    fn beyond(&self, from: f64) -> impl Fn(&Aabb) -> bool {
        let axis = self.axis;
        move |b| from <= b.max[axis]
    }

    /// From where to where a facet reaches along the axis.
    fn span(&self, f: u32) -> [f64; 2] {
        let [a, b, c] = self.corners(f).map(|p| p[self.axis]);
        [a.min(b).min(c), a.max(b).max(c)]
    }

    /// Whether the ray passes the plane of the second facet behind that of the first. It runs along neither.
    fn is_behind(&self, facets: [u32; 2], target: &Point) -> bool {
        /// Share of the product of the sizes that rounding cannot reach: it stays below a hundred roundings of 2^-53.
        const NESTING_ROUNDING: f64 = 1e-13;
        let corners = facets.map(|f| self.corners(f));
        let mut from = *target;
        from[self.axis] = corners[0][0][self.axis];
        // The plane is passed at the quotient of the two, and they are of the third and the second power of the size.
        let rough = corners.map(|corners| {
            let [a, b, c] = corners.map(|p| minus(p, from));
            let normal = cross(minus(b, a), minus(c, a));
            let size = [a, b, c].iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
            (dot(normal, a), normal[self.axis], size)
        });
        let [(d, m, s), (e, n, t)] = rough;
        let further = e * m - d * n;
        let clear = m.abs() > NESTING_ROUNDING * s * s && n.abs() > NESTING_ROUNDING * t * t;
        if clear && further.abs() > 32.0 * NESTING_ROUNDING * s * s * t * t * (s + t) {
            return (further > 0.0) == ((m > 0.0) == (n > 0.0));
        }
        let [(first, d), (second, e)] = corners.map(|[a, b, c]| {
            let normal = big::cross(&big::minus(b, a), &big::minus(c, a));
            let offset = big::dot(&normal, &big::minus(a, from));
            (normal, offset)
        });
        let (m, n) = (&first[self.axis], &second[self.axis]);
        // Where the planes meet just there, their slopes tell. In `around` the half open edges amount to a ray that is moved by
        // a trifle along the first of the other axes. It is moved by a trifle of that along the second.
        let offset = || &(&e * m) - &(&d * n);
        let slope = |k: usize| &(&first[k] * n) - &(&second[k] * m);
        let order = match offset().sign() {
            0 => [1, 2].map(|k| slope((self.axis + k) % 3).sign()).into_iter().find(|s| *s != 0).unwrap_or(0),
            sign => sign,
        };
        order * m.sign() * n.sign() > 0
    }

    fn corners(&self, f: u32) -> [Point; 3] {
        self.mesh.corners(f)
    }

    /// How often a facet winds around `p`, both seen along the axis. It is +1 where the facet looks along the axis, −1 where it
    /// looks back, 0 where `p` lies outside it. Its edges are half open: of facets that hang together one winds around each
    /// point.
    pub fn around(&self, f: u32, p: &Point) -> i32 {
        let [a, b, c] = self.corners(f);
        [[a, b], [b, c], [c, a]].iter().map(|e| passes(self.axis, e, p)).sum()
    }
}

/// By the two other axes in their order. It is +1 where the edge passes `p` upwards in the second, on the far side in the
/// first. It is −1 where it passes downwards there; else 0.
fn passes(axis: usize, [u, v]: &[Point; 2], p: &Point) -> i32 {
    let up = (axis + 2) % 3;
    match (u[up] <= p[up], v[up] <= p[up]) {
        (true, false) => i32::from(side_of_line(axis, u, v, p) > 0),
        (false, true) => -i32::from(side_of_line(axis, u, v, p) < 0),
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;
    use crate::samples::block;

    #[test]
    fn a_block_contains_what_lies_between_its_sides() {
        let mut mesh = block(4, 2.0);
        let all: Vec<u32> = (0..mesh.faces.len() as u32).collect();
        let random = &mut Random::new(4);
        for (inverted, axis) in [(false, 0), (true, 0), (false, 1), (true, 1), (false, 2), (true, 2)] {
            if inverted {
                mesh.faces.iter_mut().for_each(|f| f.swap(0, 1));
            }
            let container = Container::new(&mesh, &all, axis);
            for i in 0..2000 {
                // Every other point at multiples of a half: rays through edges and vertices.
                let p: Point = std::array::from_fn(|_| {
                    let x = 4.0 * random.unit() - 1.0;
                    if i % 2 == 0 { x } else { (2.0 * x).round() / 2.0 }
                });
                let inside = p.iter().all(|x| *x > 0.0 && *x < 2.0);
                let outside = p.iter().any(|x| *x < 0.0 || *x > 2.0);
                match container.winding(&p) {
                    Some(w) => assert_eq!(w, if inside { if inverted { -1 } else { 1 } } else { 0 }, "{p:?}"),
                    None => assert!(!inside && !outside, "{p:?}"),
                }
            }
            if inverted {
                mesh.faces.iter_mut().for_each(|f| f.swap(0, 1));
            }
        }
    }
}
