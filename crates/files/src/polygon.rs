//! Polygons become triangles.
//!
//! A convex polygon becomes a fan. From any other one, ears are cut off (G. H. Meisters, Polygons have ears, Amer. Math.
//! Monthly 82, 1975). The polygon is seen along its area vector (M. E. Newell). A polygon that is far from plane or crosses itself is cut
//! somehow, but always into two triangles fewer than it has corners.

use std::collections::BTreeSet;
use trueness_geom::space::{Point, cross, minus, norm, plus};

/// Cuts the polygon `corners` (indices into `positions`, all of them valid), hands each triangle to `out`, and says how.
///
/// Fewer than three corners give nothing. Cost: linear for a convex polygon, else `n log n` as a rule in the number of corners. The
/// effort is bounded, so that no file can make it last.
pub(crate) fn triangulate(positions: &[Point], corners: &[u32], mut out: impl FnMut([u32; 3])) -> Cut {
    let [a, b, rest @ ..] = corners else { return Cut::Whole };
    if let [c] = rest {
        out([*a, *b, *c]);
        return Cut::Whole;
    }
    let at = |i: usize| positions[corners[i] as usize];
    let Some(places) = seen_along_area((0..corners.len()).map(at).collect()) else {
        fan(corners, out);
        return Cut::Somehow;
    };
    if convex(&places) {
        fan(corners, out);
        return Cut::Whole;
    }
    Ears::new(places).cut(MAX_NODE_VISITS, |triangle| out(triangle.map(|i| corners[i as usize])))
}

/// How a polygon was cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cut {
    /// Its triangles together are the polygon.
    Whole,
    /// It has no area, crosses itself or is far from plane: triangles may lie outside or upon each other.
    Somehow,
}

/// The search for corners within ears visits this many nodes at most, which takes about a second. Only polygons made to do harm ask for more.
const MAX_NODE_VISITS: u64 = 100_000_000;

fn fan(corners: &[u32], mut out: impl FnMut([u32; 3])) {
    let [first, rest @ ..] = corners else { return };
    for pair in rest.windows(2) {
        out([*first, pair[0], pair[1]]);
    }
}

/// The corners in the plane of the polygon, counter-clockwise; `None` where it has no area to look along.
fn seen_along_area(corners: Vec<Point>) -> Option<Vec<Point2>> {
    let n = corners.len();
    // Relative to the first corner: far from the origin the products would lose their digits.
    let near: Vec<Point> = corners.iter().map(|p| minus(*p, corners[0])).collect();
    let area = (0..n).fold([0.0; 3], |sum, i| plus(sum, cross(near[i], near[(i + 1) % n])));
    if !(norm(area) > 0.0 && norm(area).is_finite()) {
        return None;
    }
    // Leave out the greatest component of the normal, keeping the sense of rotation.
    let axis = (0..3).max_by(|a, b| area[*a].abs().total_cmp(&area[*b].abs()))?;
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let (u, v) = if area[axis] > 0.0 { (u, v) } else { (v, u) };
    Some(near.iter().map(|p| [p[u] + 0.0, p[v] + 0.0]).collect())
}

/// No corner turns clockwise, and all turns together go round once.
fn convex(places: &[Point2]) -> bool {
    let n = places.len();
    let edge = |i: usize| {
        let (a, b) = (places[i % n], places[(i + 1) % n]);
        [b[0] - a[0], b[1] - a[1]]
    };
    let whole = |i| {
        let (e, f) = (edge(i), edge(i + 1));
        libm::atan2(e[0] * f[1] - e[1] * f[0], e[0] * f[0] + e[1] * f[1])
    };
    let left = (0..n).all(|i| turn([places[(i + n - 1) % n], places[i], places[(i + 1) % n]]) >= 0.0);
    // Either one turn (6.28) or two (12.57) and more.
    left && (0..n).map(whole).sum::<f64>() < 9.0
}

type Point2 = [f64; 2];

/// Twice the area of a triangle of places, positive when counter-clockwise.
fn turn([a, b, c]: [Point2; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Corners seen in the plane of the polygon, counter-clockwise, and which of them are left.
struct Ears {
    places: Vec<Point2>,
    /// The corners before and after each that are left.
    around: Vec<[u32; 2]>,
    tree: Tree,
    /// For each place in the tree the corners whose triangle it lies in: they are looked at again once it is gone.
    waiting: Vec<Vec<u32>>,
    /// Corners that may be ears.
    open: BTreeSet<u32>,
    /// Corners without a turn.
    flat: BTreeSet<u32>,
}

impl Ears {
    fn new(places: Vec<Point2>) -> Ears {
        let n = places.len() as u32;
        let around = (0..n).map(|i| [(i + n - 1) % n, (i + 1) % n]).collect();
        let tree = Tree::of(&places);
        let waiting = vec![vec![]; tree.places.len()];
        let mut ears = Ears { places, around, tree, waiting, open: BTreeSet::new(), flat: BTreeSet::new() };
        (0..n).for_each(|i| ears.turned(i));
        ears
    }

    fn triangle(&self, b: u32) -> [u32; 3] {
        let [a, c] = self.around[b as usize];
        [a, b, c]
    }

    fn turn(&self, b: u32) -> f64 {
        turn(self.triangle(b).map(|i| self.places[i as usize]))
    }

    /// The triangle of a corner is new.
    fn turned(&mut self, b: u32) {
        let turn = self.turn(b);
        set(&mut self.open, b, turn > 0.0);
        set(&mut self.flat, b, turn == 0.0);
    }

    /// Cuts ear after ear, going round. Where no corner is an ear, it cuts a flat one, which does least harm, else any.
    fn cut(mut self, effort: u64, mut out: impl FnMut([u32; 3])) -> Cut {
        let mut how = Cut::Whole;
        let mut at = 0;
        let mut first = 0;
        for _ in 3..self.places.len() {
            let b = match self.ear(at, effort).or_else(|| self.flat.first().copied()) {
                Some(b) => b,
                None => {
                    how = Cut::Somehow;
                    first
                }
            };
            let [a, b, c] = self.triangle(b);
            out([a, b, c]);
            self.around[a as usize][1] = c;
            self.around[c as usize][0] = a;
            self.open.remove(&b);
            self.flat.remove(&b);
            first = if b == first { c } else { first };
            at = c;
            if let Some(place) = self.tree.leave(b) {
                for w in std::mem::take(&mut self.waiting[place as usize]) {
                    // A corner that waited has been cut off since, has turned and been looked at, or may be an ear now.
                    if self.around[self.around[w as usize][0] as usize][1] == w && self.turn(w) > 0.0 {
                        self.open.insert(w);
                    }
                }
            }
            self.turned(a);
            self.turned(c);
        }
        let [a, b, c] = self.triangle(at);
        let mut last = [a, b, c];
        last.sort_unstable();
        out(last);
        how
    }

    /// The next ear from corner `at` on: a corner turning left whose triangle holds no other corner.
    fn ear(&mut self, at: u32, effort: u64) -> Option<u32> {
        loop {
            let b = *self.open.range(at..).next().or_else(|| self.open.first())?;
            let triangle = self.triangle(b).map(|i| self.places[i as usize]);
            if self.tree.visited > effort {
                return None;
            }
            match self.tree.within(triangle) {
                None => return Some(b),
                Some(place) => {
                    self.open.remove(&b);
                    self.waiting[place as usize].push(b);
                }
            }
        }
    }
}

fn set(of: &mut BTreeSet<u32>, b: u32, wanted: bool) {
    if wanted {
        of.insert(b)
    } else {
        of.remove(&b)
    };
}

/// The places of the corners that are left, each once, halved along their longer side again and again.
struct Tree {
    places: Vec<Point2>,
    /// Corners at each place.
    corners: Vec<u32>,
    /// The place of each corner.
    place_of: Vec<u32>,
    /// Node `i` halves into `2 i` and `2 i + 1`; node 1 is all.
    nodes: Vec<Node>,
    visited: u64,
}

#[derive(Clone, Copy)]
struct Node {
    low: Point2,
    high: Point2,
    /// Places that are left.
    left: u32,
}

/// A leaf of the tree holds this many places at most.
const MAX_PLACES_PER_LEAF: usize = 6;

impl Tree {
    fn of(corners: &[Point2]) -> Tree {
        let by_place = |a: &u32, b: &u32| {
            let [a, b] = [a, b].map(|i| corners[*i as usize]);
            a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
        };
        let mut order: Vec<u32> = (0..corners.len() as u32).collect();
        order.sort_unstable_by(by_place);
        let mut groups: Vec<(Point2, Vec<u32>)> = vec![];
        for i in order {
            match groups.last_mut().filter(|g| g.0 == corners[i as usize]) {
                Some(group) => group.1.push(i),
                None => groups.push((corners[i as usize], vec![i])),
            }
        }
        let empty = Node { low: [0.0; 2], high: [0.0; 2], left: 0 };
        let mut nodes = vec![empty; 4 * groups.len().div_ceil(MAX_PLACES_PER_LEAF).next_power_of_two()];
        halve(&mut groups, 1, &mut nodes);
        let mut place_of = vec![0; corners.len()];
        for (place, (_, members)) in (0..).zip(&groups) {
            members.iter().for_each(|i| place_of[*i as usize] = place);
        }
        let counts = groups.iter().map(|g| g.1.len() as u32).collect();
        let places = groups.into_iter().map(|g| g.0).collect();
        Tree { places, corners: counts, place_of, nodes, visited: 0 }
    }

    /// Takes a corner away; its place, if that was the last corner there.
    fn leave(&mut self, corner: u32) -> Option<u32> {
        let place = self.place_of[corner as usize];
        let corners = &mut self.corners[place as usize];
        *corners -= 1;
        if *corners > 0 {
            return None;
        }
        let (mut node, mut from, mut to) = (1, 0, self.places.len());
        loop {
            self.nodes[node].left -= 1;
            if to - from <= MAX_PLACES_PER_LEAF {
                return Some(place);
            }
            let middle = (from + to) / 2;
            if (place as usize) < middle {
                (node, to) = (2 * node, middle);
            } else {
                (node, from) = (2 * node + 1, middle);
            }
        }
    }

    /// Some place inside the triangle or on its rim that is not one of its corners.
    fn within(&mut self, triangle: [Point2; 3]) -> Option<u32> {
        let mut open = vec![(1, 0, self.places.len())];
        while let Some((node, from, to)) = open.pop() {
            self.visited += 1;
            if self.nodes[node].left == 0 || apart(&triangle, &self.nodes[node]) {
                continue;
            }
            if to - from > MAX_PLACES_PER_LEAF {
                let middle = (from + to) / 2;
                open.extend([(2 * node, from, middle), (2 * node + 1, middle, to)]);
                continue;
            }
            let inside = |i: &usize| {
                let p = self.places[*i];
                let [a, b, c] = triangle;
                self.corners[*i] > 0
                    && !triangle.contains(&p)
                    && turn([a, b, p]) >= 0.0
                    && turn([b, c, p]) >= 0.0
                    && turn([c, a, p]) >= 0.0
            };
            if let Some(i) = (from..to).find(inside) {
                return Some(i as u32);
            }
        }
        None
    }
}

/// Halves places along the longer side of their box and sets the nodes.
fn halve(groups: &mut [(Point2, Vec<u32>)], node: usize, nodes: &mut [Node]) {
    let bound = |k: usize, f: fn(f64, f64) -> f64, start: f64| groups.iter().map(|g| g.0[k]).fold(start, f);
    let low = [0, 1].map(|k| bound(k, f64::min, f64::INFINITY));
    let high = [0, 1].map(|k| bound(k, f64::max, f64::NEG_INFINITY));
    nodes[node] = Node { low, high, left: groups.len() as u32 };
    if groups.len() > MAX_PLACES_PER_LEAF {
        let k = usize::from(high[1] - low[1] > high[0] - low[0]);
        let middle = groups.len() / 2;
        groups.select_nth_unstable_by(middle, |a, b| a.0[k].total_cmp(&b.0[k]));
        let (first, second) = groups.split_at_mut(middle);
        halve(first, 2 * node, nodes);
        halve(second, 2 * node + 1, nodes);
    }
}

/// Whether the box lies wholly outside one side of the triangle or of its box, so that it holds no place of the triangle.
fn apart(triangle: &[Point2; 3], node: &Node) -> bool {
    let beside = |k: usize| {
        triangle.iter().all(|p| p[k] < node.low[k]) || triangle.iter().all(|p| p[k] > node.high[k])
    };
    let corners = [node.low, [node.low[0], node.high[1]], node.high, [node.high[0], node.low[1]]];
    let beyond = |i: usize| {
        let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
        // But for rounding, the formula is nowhere in the box less than at its least corner.
        let slack = 1e-14 * ((b[0] - a[0]).abs() * span(node, a, 1) + (b[1] - a[1]).abs() * span(node, a, 0));
        corners.iter().all(|p| turn([a, b, *p]) < -slack)
    };
    beside(0) || beside(1) || (0..3).any(beyond)
}

/// Greatest distance along axis `k` of the box from a place.
fn span(node: &Node, from: Point2, k: usize) -> f64 {
    (node.low[k] - from[k]).abs().max((node.high[k] - from[k]).abs())
}

/// Area of a triangle; used to compare cuts in tests.
#[cfg(test)]
fn area(positions: &[Point], t: [u32; 3]) -> [f64; 3] {
    let [a, b, c] = t.map(|i| positions[i as usize]);
    trueness_geom::space::times(0.5, cross(minus(b, a), minus(c, a)))
}

#[cfg(test)]
mod tests;
