//! Edges that pass each other no farther off than a reach.
//!
//! The edges at a vertex with very many (a hub) have boxes that all overlap, and long thin facets have such boxes too.
//! But seen from the hub each of its edges is a single direction, and any other edge is an arc. An edge that passes one
//! no farther off than the reach is seen in its direction, but for the angle of the reach. So directions are compared
//! beside boxes. Two fans take n log n and the pairs that they find, whether they have the hub in common or not.

use super::meetings::{Edge, edges};
use std::collections::BTreeMap;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;
use trueness_geom::check::intersect::seen;
use trueness_geom::check::intersect::views::{Node, View, overlap};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::predicates::height;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Aabb, Point, cross, dot, minus, norm, plus, times};

/// Beyond so many places where edges pass each other, or so many facets around vertices, surfaces are not taken to lie upon each
/// other.
pub(super) const MAX_PASSING_PLACES: usize = 1 << 24;

/// Two edges that pass each other, and the place on the first where they do.
pub(super) type Passing = ([Edge; 2], Point);

/// From so many edges on, a vertex is a hub.
const MIN_EDGES_OF_HUB: usize = 32;
/// Boxes and directions are widened by so many reaches: one, and much more than places are rounded.
const WIDENING_REACHES: f64 = 2.0;
/// No hub.
const NO_HUB: u32 = u32::MAX;

/// The edges of `facets` (ascending) that pass edges of `near` (ascending: the facets no farther from them than
/// `reach`), sorted. Each pair of facets is looked at whose lower one is among `facets`.
/// `None` if more than [`MAX_PASSING_PLACES`] pairs of edges pass. Cost: n log n, and a microsecond for each pair that
/// is near.
pub(super) fn passing(
    mesh: &Mesh,
    facets: &[u32],
    near: &[u32],
    reach: f64,
    progress: &dyn Progress,
) -> Result<Option<Vec<Passing>>, Cancelled> {
    let sides = sides(mesh, facets, near);
    let bundles = bundles(mesh, &sides, reach);
    let found = AtomicUsize::new(0);
    let of_edge = |number: usize| {
        let mut all = vec![];
        if progress.cancelled() || found.load(Relaxed) > MAX_PASSING_PLACES {
            return all;
        }
        let mut take = |other: usize| {
            let pair = [&sides[number.min(other)], &sides[number.max(other)]];
            let edges = pair.map(|side| side.edge);
            let place = pass(mesh, edges, reach).filter(|_| is_looked_at(mesh, pair, reach));
            all.extend(place.map(|place| (edges, place)));
        };
        bundles.iter().for_each(|bundle| bundle.near(mesh, &sides, number, reach, &mut take));
        found.fetch_add(all.len(), Relaxed);
        all
    };
    let mut all: Vec<Passing> = (0..sides.len()).into_par_iter().flat_map_iter(of_edge).collect();
    if progress.cancelled() {
        return Err(Cancelled);
    }
    if found.into_inner() > MAX_PASSING_PLACES {
        return Ok(None);
    }
    all.par_sort_unstable_by_key(|p| p.0);
    all.dedup_by_key(|p| p.0);
    Ok(Some(all))
}

/// An edge and its facets.
struct Sides {
    edge: Edge,
    /// Edges that are asked about.
    own: Vec<u32>,
    /// Edges near them.
    near: Vec<u32>,
    /// Its hub, if it is an edge asked about; else none.
    hub: u32,
}

/// All edges, sorted.
fn sides(mesh: &Mesh, facets: &[u32], near: &[u32]) -> Vec<Sides> {
    let mut all: BTreeMap<Edge, (Vec<u32>, Vec<u32>)> = BTreeMap::new();
    for f in facets {
        edges(mesh.faces[*f as usize]).iter().for_each(|e| all.entry(*e).or_default().0.push(*f));
    }
    for g in near {
        edges(mesh.faces[*g as usize]).iter().for_each(|e| all.entry(*e).or_default().1.push(*g));
    }
    let mut count: BTreeMap<u32, usize> = BTreeMap::new();
    for v in all.iter().filter(|(_, (own, _))| !own.is_empty()).flat_map(|(edge, _)| edge) {
        *count.entry(*v).or_default() += 1;
    }
    let hub = |[a, b]: Edge| {
        let [of_a, of_b] = [a, b].map(|v| count.get(&v).copied().unwrap_or(0));
        if of_a.max(of_b) < MIN_EDGES_OF_HUB {
            NO_HUB
        } else if of_b > of_a {
            b
        } else {
            a
        }
    };
    let side = |(edge, (own, near)): (Edge, (Vec<u32>, Vec<u32>))| {
        let hub = if own.is_empty() { NO_HUB } else { hub(edge) };
        Sides { edge, own, near, hub }
    };
    all.into_iter().map(side).collect()
}

/// Edges asked about that have a hub in common, or have none.
struct Bundle {
    hub: u32,
    /// Neighbors stand near each other.
    items: Vec<View>,
    root: Node,
}

/// Bundles with hubs come first, ascending.
fn bundles(mesh: &Mesh, sides: &[Sides], reach: f64) -> Vec<Bundle> {
    let mut members: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (i, side) in sides.iter().enumerate().filter(|(_, side)| !side.own.is_empty()) {
        members.entry(side.hub).or_default().push(i);
    }
    let bundle = |(hub, members): (u32, Vec<usize>)| {
        let item = |number: usize| {
            let (seen, bounds) = views(mesh, hub, sides[number].edge, reach);
            View { number: number as u32, seen, bounds }
        };
        let mut items: Vec<View> = members.into_iter().map(item).collect();
        let root = Node::of(&mut items);
        Bundle { hub, items, root }
    };
    members.into_iter().map(bundle).collect()
}

/// Box of the directions from a hub to an edge (without one, the box of the edge), and box of the edge. Both are
/// widened by the reach.
fn views(mesh: &Mesh, hub: u32, edge: Edge, reach: f64) -> (Aabb, Aabb) {
    let [a, b] = mesh.places(&edge);
    let bounds = widened(Aabb::of([&a, &b]), WIDENING_REACHES * reach);
    if hub == NO_HUB {
        return (bounds, bounds);
    }
    let center = mesh.positions[hub as usize];
    let [p, q] = match edge {
        [v, _] if v == hub => return (seen::segment(center, b, b), bounds),
        [_, v] if v == hub => return (seen::segment(center, a, a), bounds),
        _ => [a, b],
    };
    // Two places no farther apart than the reach are seen so far apart at most: twice the reach over the distance.
    let way = minus(q, p);
    let t = (dot(minus(center, p), way) / dot(way, way)).clamp(0.0, 1.0);
    let far = norm(minus(center, plus(p, times(t, way))));
    let angle = 2.0 * WIDENING_REACHES * reach / far;
    let angle = if angle < 1.0 { angle } else { f64::INFINITY };
    (widened(seen::segment(center, p, q), angle), bounds)
}

fn widened(b: Aabb, by: f64) -> Aabb {
    Aabb { min: b.min.map(|x| x - by), max: b.max.map(|x| x + by) }
}

impl Bundle {
    /// Hands to `take` the edges of the bundle that an edge may pass. One of two edges asked about looks for the other.
    /// That is one without a hub for one with a hub, else the one with the higher hub, or the lower number.
    fn near(&self, mesh: &Mesh, sides: &[Sides], number: usize, reach: f64, take: &mut impl FnMut(usize)) {
        let side = &sides[number];
        let is_asked = !side.own.is_empty();
        // No hub is the highest.
        if side.edge.contains(&self.hub) || is_asked && self.hub > side.hub {
            return;
        }
        let is_same = is_asked && self.hub == side.hub;
        let (seen, bounds) = views(mesh, self.hub, side.edge, reach);
        let is_near = |s: &Aabb, b: &Aabb| overlap(&bounds, b) && overlap(&seen, s);
        let mut stack = vec![&self.root];
        while let Some(node) = stack.pop() {
            if !is_near(&node.seen, &node.bounds) {
                continue;
            }
            if let Some(halves) = &node.halves {
                stack.extend(halves.iter());
                continue;
            }
            let items = self.items[node.range.clone()].iter();
            let near =
                items.filter(|i| is_near(&i.seen, &i.bounds) && !(is_same && i.number as usize <= number));
            near.for_each(|i| take(i.number as usize));
        }
    }
}

/// Whether two edges belong to a pair of facets that are not apart, the lower one of them asked about.
fn is_looked_at(mesh: &Mesh, [e, d]: [&Sides; 2], reach: f64) -> bool {
    let any = |lower: &Sides, higher: &Sides| {
        let mut pairs = lower.own.iter().flat_map(|f| higher.near.iter().map(move |g| (*f, *g)));
        pairs.any(|(f, g)| f < g && !are_apart(mesh, f, g, reach))
    };
    any(e, d) || any(d, e)
}

/// Whether one of two facets lies wholly on one side of the plane of the other, and farther off than `reach`.
fn are_apart(mesh: &Mesh, f: u32, g: u32, reach: f64) -> bool {
    let (t, u) = (mesh.corners(f), mesh.corners(g));
    let beyond = |[a, b, c]: [Point; 3], of: [Point; 3]| {
        let high = of.map(|p| height([&a, &b, &c], &p));
        high.iter().all(|h| *h > reach) || high.iter().all(|h| *h < -reach)
    };
    beyond(t, u) || beyond(u, t)
}

/// Where the first of two edges passes the second no farther off than `reach`. Not where they share an end, or run side by
/// side: then the ends of one lie upon the other.
fn pass(mesh: &Mesh, [e, d]: [Edge; 2], reach: f64) -> Option<Point> {
    if e.iter().any(|v| d.contains(v)) {
        return None;
    }
    let ([a, b], [p, q]) = (mesh.places(&e), mesh.places(&d));
    let (u, v, w) = (minus(b, a), minus(q, p), minus(p, a));
    let n = cross(u, v);
    if norm(n) <= reach * norm(u).max(norm(v)) {
        return None;
    }
    let [s, t] = [v, u].map(|other| dot(cross(w, other), n) / dot(n, n));
    let is_within = |x: f64| (0.0..=1.0).contains(&x);
    let place = plus(a, times(s, u));
    let away = minus(place, plus(p, times(t, v)));
    (is_within(s) && is_within(t) && norm(away) <= reach).then_some(place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;
    use trueness_geom::num::random::Random;
    use trueness_geom::progress::Silent;

    /// Adds a fan around vertex `hub` near the plane z = 0.
    fn add_fan(mesh: &mut Mesh, random: &mut Random, hub: u32, n: u32, radius: f64, rough: f64) {
        let ([x, y, _], first, turn) =
            (mesh.positions[hub as usize], mesh.positions.len() as u32, random.unit());
        for i in 0..n {
            let angle = TAU * (f64::from(i) + turn) / f64::from(n);
            let z = rough * (random.unit() - 0.5);
            mesh.positions.push([x + radius * libm::cos(angle), y + radius * libm::sin(angle), z]);
        }
        mesh.faces.extend((0..n).map(|i| [hub, first + i, first + (i + 1) % n]));
    }

    /// All pairs of facets, as it is meant.
    fn by_pairs(mesh: &Mesh, facets: &[u32], near: &[u32], reach: f64) -> Vec<Passing> {
        let mut all = vec![];
        for f in facets {
            for g in near.iter().filter(|g| *g > f && !are_apart(mesh, *f, **g, reach)) {
                for e in edges(mesh.faces[*f as usize]) {
                    for d in edges(mesh.faces[*g as usize]) {
                        let pair = [e.min(d), e.max(d)];
                        all.extend(pass(mesh, pair, reach).map(|place| (pair, place)));
                    }
                }
            }
        }
        all.sort_by_key(|p| p.0);
        all.dedup_by_key(|p| p.0);
        all
    }

    #[test]
    fn edges_pass_where_all_pairs_of_facets_say_so() {
        let (random, mut found_count) = (&mut Random::new(8), 0);
        for case in 0..60 {
            let reach = [1e-9, 1e-4, 0.02][case % 3];
            let mut mesh =
                Mesh { positions: vec![[0.0; 3], [0.3, 0.2, 0.0], [4.0, 0.0, 0.0]], faces: vec![] };
            for hub in [0, 0, 1, 2] {
                let n = 3 + random.below(60) as u32;
                let radius = 0.5 + random.unit();
                add_fan(&mut mesh, random, hub, n, radius, 2.0 * reach);
            }
            for _ in 0..40 {
                let first = mesh.positions.len() as u32;
                let at = || -> Point {
                    [2.0 * random.unit() - 1.0, 2.0 * random.unit() - 1.0, 2.0 * reach * random.unit()]
                };
                mesh.positions.extend(std::iter::repeat_with(at).take(3));
                mesh.faces.push([first, first + 1, first + 2]);
            }
            let near: Vec<u32> = (0..mesh.faces.len() as u32).collect();
            let facets: Vec<u32> = near.iter().copied().filter(|f| case % 2 == 0 || f % 3 > 0).collect();
            let found = passing(&mesh, &facets, &near, reach, &Silent).unwrap().unwrap();
            assert_eq!(found, by_pairs(&mesh, &facets, &near, reach), "{case}");
            found_count += found.len();
        }
        assert!(found_count > 10_000, "{found_count}");
    }

    /// Fans upon each other around one hub, a fan beside them, and small facets upon a fan. As many pairs are looked at
    /// as edges pass, and some for each edge.
    #[test]
    fn fans_take_what_they_find() {
        for n in [500, 4000] {
            let (random, reach) = (&mut Random::new(2), 1e-9);
            let mut mesh = Mesh { positions: vec![[0.0; 3], [2.1, 0.0, 0.0]], faces: vec![] };
            for (hub, radius) in [(0, 1.0), (0, 0.8), (1, 1.0)] {
                add_fan(&mut mesh, random, hub, n, radius, 0.0);
            }
            for i in 0..n {
                let first = mesh.positions.len() as u32;
                let angle = TAU * f64::from(i) / f64::from(n);
                let corner =
                    |far: f64, by: f64| [far * libm::cos(angle + by), far * libm::sin(angle + by), 0.0];
                mesh.positions.extend([corner(0.9, 0.0), corner(0.91, 0.0), corner(0.9, 0.5 / f64::from(n))]);
                mesh.faces.push([first, first + 1, first + 2]);
            }
            let all: Vec<u32> = (0..mesh.faces.len() as u32).collect();
            let sides = sides(&mesh, &all, &all);
            let (bundles, mut looked_at) = (bundles(&mesh, &sides, reach), 0);
            for number in 0..sides.len() {
                bundles.iter().for_each(|b| b.near(&mesh, &sides, number, reach, &mut |_| looked_at += 1));
            }
            let found = passing(&mesh, &all, &all, reach, &Silent).unwrap().unwrap().len();
            assert!(looked_at < 2 * found + 8 * sides.len(), "{n}: {looked_at} for {found}, {}", sides.len());
        }
    }
}
