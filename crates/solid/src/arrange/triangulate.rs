//! Triangulation of points in a plane, some of them joined by edges that must be there.
//!
//! 1. The points are added in the order of one coordinate. Each lies outside of the hull of those before and is joined
//!    with the edges of the hull that it sees. That is the sweep of de Berg et al., Computational Geometry, 2008.
//! 2. An edge is flipped where the circle of a triangle contains the point beyond the edge (Lawson, 1977). This only makes
//!    triangles rounder, so it is decided in floating point and a limited number of times.
//! 3. An edge that must be there and is missing is made by flipping the edges that cross it. (Sloan, A fast algorithm
//!    for generating constrained Delaunay triangulations, 1993).
//!
//! That triangles do not overlap and run counter-clockwise is decided exactly in every step.

use std::cmp::Ordering;
use std::collections::VecDeque;

/// Known facts about points `0..n` in the plane, no two at one place.
pub(super) trait Plane {
    /// +1 where they run counter-clockwise, 0 where they lie on a line. Exact.
    fn orient(&self, points: [u32; 3]) -> i32;
    /// In the order of x, then y. Exact.
    fn compare(&self, a: u32, b: u32) -> Ordering;
    /// About where a point is.
    fn rough(&self, point: u32) -> [f64; 2];
}

/// No half-edge.
const NO_HALF_EDGE: u32 = u32::MAX;

/// Triangles by their half-edges: half-edge `3 t + k` leads from corner `k` of triangle `t` to the next corner.
pub(super) struct Triangles {
    /// Where each half-edge starts.
    pub from: Vec<u32>,
    /// The same edge in the other triangle, [`u32::MAX`] at the hull.
    pub twin: Vec<u32>,
    /// It must stay.
    fixed: Vec<bool>,
    /// A half-edge that starts at each point.
    out: Vec<u32>,
    /// For a point on the hull the half-edge along it that starts there, and the point before.
    hull: Vec<u32>,
    before: Vec<u32>,
}

pub(super) fn next(e: u32) -> u32 {
    if e % 3 == 2 { e - 2 } else { e + 1 }
}

fn previous(e: u32) -> u32 {
    if e.is_multiple_of(3) { e + 2 } else { e - 1 }
}

/// Triangulates the hull of points
/// `0..n`, with these edges. No two edges cross, and no point lies inside an edge. Empty where all points lie on a line; `None`
/// if the edges do cross, or the plane contradicts itself.
pub(super) fn triangulate(n: u32, edges: &[[u32; 2]], plane: &impl Plane) -> Option<Triangles> {
    let none = vec![NO_HALF_EDGE; n as usize];
    let (out, hull, before) = (none.clone(), none.clone(), none);
    let mut t = Triangles { from: vec![], twin: vec![], fixed: vec![], out, hull, before };
    t.sweep(n, plane)?;
    if t.from.is_empty() {
        return Some(t);
    }
    for [a, b] in edges {
        t.insert(*a, *b, plane)?;
    }
    let all = (0..t.from.len() as u32).collect();
    t.legalise(all, plane);
    Some(t)
}

impl Triangles {
    fn add(&mut self, corners: [u32; 3]) -> u32 {
        let first = self.from.len() as u32;
        self.from.extend(corners);
        self.twin.extend([NO_HALF_EDGE; 3]);
        self.fixed.extend([false; 3]);
        for (k, v) in (0..).zip(corners) {
            self.out[v as usize] = first + k;
        }
        first
    }

    fn link(&mut self, e: u32, f: u32) {
        self.twin[e as usize] = f;
        if f != NO_HALF_EDGE {
            self.twin[f as usize] = e;
        }
    }

    fn to(&self, e: u32) -> u32 {
        self.from[next(e) as usize]
    }

    /// The corner opposite to a half-edge.
    fn apex(&self, e: u32) -> u32 {
        self.from[previous(e) as usize]
    }

    fn sweep(&mut self, n: u32, plane: &impl Plane) -> Option<()> {
        let mut order: Vec<u32> = (0..n).collect();
        order.sort_unstable_by(|a, b| plane.compare(*a, *b));
        let Some(first) = (2..order.len()).find(|&i| plane.orient([order[0], order[1], order[i]]) != 0)
        else {
            return Some(());
        };
        let (apex, side) = (order[first], plane.orient([order[0], order[1], order[first]]));
        // A fan over the points on the first line.
        let mut before = NO_HALF_EDGE;
        for pair in order[..first].windows(2) {
            let [a, b] = if side > 0 { [pair[0], pair[1]] } else { [pair[1], pair[0]] };
            let e = self.add([a, b, apex]);
            self.at_hull(e);
            // The edges from and to the apex.
            let (joint, free) = if side > 0 { (e + 2, e + 1) } else { (e + 1, e + 2) };
            if before != NO_HALF_EDGE {
                self.link(before, joint);
            } else {
                self.at_hull(joint);
            }
            before = free;
        }
        if before != NO_HALF_EDGE {
            self.at_hull(before);
        }
        let mut last = apex;
        for &p in &order[first + 1..] {
            self.join(p, last, plane)?;
            last = p;
        }
        Some(())
    }

    /// Joins a point with the edges of the hull that it sees, `last` being one that it sees. `None` where it sees all
    /// of the hull, or where that is no ring. A plane may contradict itself: it may take points to lie on a line that
    /// do not.
    fn join(&mut self, p: u32, last: u32, plane: &impl Plane) -> Option<()> {
        let sees = |a: u32, b: u32| plane.orient([a, b, p]) < 0;
        let mut left = self.out.len();
        let mut start = last;
        loop {
            let before = self.before[start as usize];
            if before == NO_HALF_EDGE || left == 0 {
                return None;
            }
            if !sees(before, start) {
                break;
            }
            (start, left) = (before, left - 1);
        }
        let (mut at, mut before, mut new) = (start, NO_HALF_EDGE, vec![]);
        loop {
            let seen = self.hull[at as usize];
            if seen == NO_HALF_EDGE || new.len() > self.out.len() {
                return None;
            }
            let b = self.to(seen);
            if !sees(at, b) {
                break;
            }
            let e = self.add([b, at, p]);
            self.link(e, seen);
            if before == NO_HALF_EDGE {
                self.at_hull(e + 1);
            } else {
                self.link(before, e + 1);
            }
            before = e + 2;
            new.push(e);
            at = b;
        }
        if before != NO_HALF_EDGE {
            self.at_hull(before);
            self.legalise(new, plane);
        }
        Some(())
    }

    /// A half-edge lies at the hull.
    fn at_hull(&mut self, e: u32) {
        let (a, b) = (self.from[e as usize], self.to(e));
        self.hull[a as usize] = e;
        self.before[b as usize] = a;
    }

    /// Flips edges, beginning with these, as long as that makes triangles rounder.
    fn legalise(&mut self, mut edges: Vec<u32>, plane: &impl Plane) {
        // Each flip leads to a rounder triangulation; rounding might see it otherwise in a ring.
        let mut left = 64 + 32 * edges.len();
        while let Some(e) = edges.pop() {
            let f = self.twin[e as usize];
            if f == NO_HALF_EDGE || self.fixed[e as usize] {
                continue;
            }
            let corners = [self.from[e as usize], self.to(e), self.apex(e), self.apex(f)];
            if !in_circle(corners.map(|p| plane.rough(p))) || !self.flips(e, plane) {
                continue;
            }
            if left == 0 {
                return;
            }
            left -= 1;
            edges.extend(self.flip(e));
        }
    }

    /// Whether the two triangles at an edge form a quadrilateral with corners less than straight.
    fn flips(&self, e: u32, plane: &impl Plane) -> bool {
        let f = self.twin[e as usize];
        let (u, v, w, x) = (self.from[e as usize], self.to(e), self.apex(e), self.apex(f));
        plane.orient([w, u, x]) > 0 && plane.orient([x, v, w]) > 0
    }

    /// Replaces the edge by the other diagonal; the four edges around.
    fn flip(&mut self, e: u32) -> [u32; 4] {
        let f = self.twin[e as usize];
        let (s, t) = (e / 3 * 3, f / 3 * 3);
        let (u, v, w, x) = (self.from[e as usize], self.to(e), self.apex(e), self.apex(f));
        let kept = [previous(e), next(f), previous(f), next(e)];
        let (twins, fixed) = (kept.map(|k| self.twin[k as usize]), kept.map(|k| self.fixed[k as usize]));
        // w u x and x v w; the diagonal is the last edge of each.
        for (k, corner) in [w, u, x].into_iter().enumerate() {
            self.from[s as usize + k] = corner;
        }
        for (k, corner) in [x, v, w].into_iter().enumerate() {
            self.from[t as usize + k] = corner;
        }
        let around = [s, s + 1, t, t + 1];
        for ((e, twin), fixed) in around.into_iter().zip(twins).zip(fixed) {
            self.link(e, twin);
            self.fixed[e as usize] = fixed;
            if twin == NO_HALF_EDGE {
                self.hull[self.from[e as usize] as usize] = e;
            }
        }
        self.link(s + 2, t + 2);
        self.fixed[s as usize + 2] = false;
        self.fixed[t as usize + 2] = false;
        for e in [s, s + 1, t, t + 1] {
            self.out[self.from[e as usize] as usize] = e;
        }
        around
    }

    /// The half-edges that start at a point: one way round, and where the hull is met the other way for the rest.
    fn around(&self, point: u32) -> impl Iterator<Item = u32> {
        let first = self.out[point as usize];
        let back = |e: u32| match self.twin[e as usize] {
            NO_HALF_EDGE => NO_HALF_EDGE,
            twin => next(twin),
        };
        let (mut at, mut is_back) = (first, false);
        std::iter::from_fn(move || {
            let e = at;
            if e == NO_HALF_EDGE {
                return None;
            }
            at = if is_back { back(e) } else { self.twin[previous(e) as usize] };
            if at == NO_HALF_EDGE && !is_back {
                (at, is_back) = (back(first), true);
            } else if at == first {
                at = NO_HALF_EDGE;
            }
            Some(e)
        })
    }

    /// The half-edge from `a` to `b`, or else that from `b` to `a`.
    fn between(&self, a: u32, b: u32) -> Option<u32> {
        self.directed(a, b).or_else(|| self.directed(b, a))
    }

    /// The half-edge from `a` to `b`, if there is one. Looked for around both, as one may have very many.
    pub fn directed(&self, a: u32, b: u32) -> Option<u32> {
        let (mut of_a, mut of_b) = (self.around(a), self.around(b).map(previous));
        loop {
            let e = of_a.next()?;
            if self.to(e) == b {
                return Some(e);
            }
            let e = of_b.next()?;
            if self.from[e as usize] == a {
                return Some(e);
            }
        }
    }

    fn fix(&mut self, e: u32) {
        self.fixed[e as usize] = true;
        let twin = self.twin[e as usize];
        if twin != NO_HALF_EDGE {
            self.fixed[twin as usize] = true;
        }
    }

    /// Makes the edge from `a` to `b`.
    fn insert(&mut self, a: u32, b: u32, plane: &impl Plane) -> Option<()> {
        if let Some(e) = self.between(a, b) {
            self.fix(e);
            return Some(());
        }
        let mut crossing: VecDeque<[u32; 2]> = self.crossing(a, b, plane)?.into();
        let mut tries = 100 + 10 * crossing.len() * crossing.len();
        let mut new = vec![];
        while let Some([p, q]) = crossing.pop_front() {
            tries = tries.checked_sub(1)?;
            let e = self.between(p, q)?;
            if self.fixed[e as usize] || self.twin[e as usize] == NO_HALF_EDGE {
                return None;
            }
            if !self.flips(e, plane) {
                crossing.push_back([p, q]);
                continue;
            }
            let (r, s) = (self.apex(e), self.apex(self.twin[e as usize]));
            self.flip(e);
            let ends = [r, s].iter().any(|p| *p == a || *p == b);
            if !ends && plane.orient([a, b, r]) * plane.orient([a, b, s]) < 0 {
                crossing.push_back([r, s]);
            } else {
                new.push([r, s]);
            }
        }
        let e = self.between(a, b)?;
        self.fix(e);
        let new = new.into_iter().filter_map(|[r, s]| self.between(r, s)).collect();
        self.legalise(new, plane);
        Some(())
    }

    /// The edges that cross the segment from `a` to `b`, from there to here.
    fn crossing(&self, a: u32, b: u32, plane: &impl Plane) -> Option<Vec<[u32; 2]>> {
        let leaves = |e: &u32| {
            let (p, q) = (self.to(*e), self.apex(*e));
            plane.orient([a, b, p]) < 0 && plane.orient([a, b, q]) > 0
        };
        let mut e = next(self.around(a).find(leaves)?);
        let mut all = vec![];
        loop {
            all.push([self.from[e as usize], self.to(e)]);
            let f = self.twin[e as usize];
            if f == NO_HALF_EDGE {
                return None;
            }
            let apex = self.apex(f);
            if apex == b {
                return Some(all);
            }
            // Each crossing half-edge e runs from the right of the segment to its left, and f back.
            e = match plane.orient([a, b, apex]) {
                0 => return None,
                1 => next(f),
                _ => previous(f),
            };
            if all.len() > self.from.len() {
                return None;
            }
        }
    }
}

/// Whether the circle through the first three, which run counter-clockwise, clearly holds the last.
fn in_circle([a, b, c, d]: [[f64; 2]; 4]) -> bool {
    /// Share of the sum of magnitudes: rounding takes less.
    const ROUNDING_SHARE: f64 = 1e-12;
    let row = |p: [f64; 2]| {
        let (x, y) = (p[0] - d[0], p[1] - d[1]);
        (x, y, x * x + y * y)
    };
    let ((ax, ay, aa), (bx, by, bb), (cx, cy, cc)) = (row(a), row(b), row(c));
    let terms = [(aa, bx * cy - by * cx), (bb, cx * ay - cy * ax), (cc, ax * by - ay * bx)];
    let sum: f64 = terms.iter().map(|(l, m)| l * m).sum();
    let size: f64 = terms.iter().map(|(l, m)| (l * m).abs()).sum();
    sum > ROUNDING_SHARE * size
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::num::random::Random;

    /// Points at random, of which some triples are told to lie on a line, or the wrong way round.
    struct Contradictory {
        points: Vec<[f64; 2]>,
        lies: u64,
    }

    impl Plane for Contradictory {
        fn orient(&self, corners: [u32; 3]) -> i32 {
            let [a, b, c] = corners.map(|p| self.points[p as usize]);
            let true_one = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            let seed = corners.iter().fold(self.lies, |seed, p| 64 * seed + u64::from(*p));
            match Random::new(seed).below(8) {
                0 => 0,
                1 => -(true_one.total_cmp(&0.0) as i32),
                _ => true_one.total_cmp(&0.0) as i32,
            }
        }
        fn compare(&self, a: u32, b: u32) -> Ordering {
            self.points[a as usize][0].total_cmp(&self.points[b as usize][0])
        }
        fn rough(&self, point: u32) -> [f64; 2] {
            self.points[point as usize]
        }
    }

    /// It is given up, or ends in some triangulation; it neither hangs nor names an edge that is none.
    #[test]
    fn a_plane_that_contradicts_itself_is_given_up() {
        let random = &mut Random::new(4);
        let mut given_up = 0;
        for lies in 0..400 {
            let n = 4 + random.below(40) as u32;
            let points = (0..n).map(|_| [random.unit(), random.unit()]).collect();
            let mut end = || random.below(u64::from(n)) as u32;
            let edges: Vec<[u32; 2]> = (0..10).map(|_| [end(), end()]).filter(|[a, b]| a != b).collect();
            given_up += usize::from(triangulate(n, &edges, &Contradictory { points, lies }).is_none());
        }
        assert!(given_up > 0);
    }
}
