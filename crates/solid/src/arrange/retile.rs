//! Facets cut along the vertices and edges that lie upon them, those that lie upon each other together.
//!
//! Facets overlap if they have three vertices in common that do not lie on a line. Such facets are triangulated together, seen along
//! one axis, so that all of them have the same triangles in the part they have in common.

use super::cluster::axis_of;
use super::imprint::Imprints;
use super::meetings::{Edge, edge};
use super::passing::MAX_PASSING_PLACES;
use super::triangulate::{self, Triangles, next, triangulate};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use trueness_geom::check::finding::area;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::predicates::side_of_line;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Point, cross, minus, norm};
use trueness_geom::topology::union::Sets;

/// Cuts the facets of `mesh`, which `source` names, along the vertices upon them. Facets upon which nothing lies come
/// first, in their order.
/// `None` where the vertices upon a facet contradict each other, or if pairs of facets share more than [`MAX_PASSING_PLACES`]
/// vertices.
pub(super) fn retiled(
    mesh: Mesh,
    source: &[u32],
    imprints: &Imprints,
    reach: f64,
) -> Option<(Mesh, Vec<u32>)> {
    let of_facet = |f: u32| (f, vertices(imprints, f, mesh.faces[f as usize]));
    let marked: BTreeMap<u32, Vec<u32>> = imprints.marked(&mesh).into_iter().map(of_facet).collect();
    let groups = groups(&mesh, &marked, reach)?;
    let adjacent_vertices = adjacent_vertices(&mesh, imprints);
    let tile = |facets: &Vec<u32>| tiled(&mesh, imprints, &marked, &adjacent_vertices, facets);
    let tiles: Vec<Vec<([u32; 3], u32)>> = groups.par_iter().map(tile).collect::<Option<_>>()?;
    let whole = (0..).zip(&mesh.faces).filter(|(f, _)| !marked.contains_key(f));
    let all = whole.map(|(f, face)| (*face, f)).chain(tiles.into_iter().flatten());
    let (faces, source) = all.map(|(face, f)| (face, source[f as usize])).unzip();
    Some((Mesh { positions: mesh.positions, faces }, source))
}

/// The sides of a face, the way it runs.
fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// All vertices of a facet, ascending.
fn vertices(imprints: &Imprints, facet: u32, face: [u32; 3]) -> Vec<u32> {
    let inside = imprints.inside.get(&facet).into_iter().flatten().copied();
    let mut all: Vec<u32> =
        sides(face).into_iter().flat_map(|side| chain(imprints, side)).chain(inside).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The facets that overlap, together.
fn groups(mesh: &Mesh, marked: &BTreeMap<u32, Vec<u32>>, reach: f64) -> Option<Vec<Vec<u32>>> {
    let mut count: BTreeMap<u32, usize> = BTreeMap::new();
    marked.values().flatten().for_each(|v| *count.entry(*v).or_default() += 1);
    // Two facets that overlap have three vertices in common: one at least is none of the two that most facets have, of either.
    // Only those are looked up, so that facets around a hub do not all meet there.
    let rare = |vertices: &Vec<u32>| {
        let mut rare = vertices.clone();
        rare.sort_by_key(|v| (count[v], *v));
        rare.truncate(rare.len().saturating_sub(2));
        rare
    };
    let rare: Vec<Vec<u32>> = marked.values().map(rare).collect();
    let mut at: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (i, vertices) in (0..).zip(&rare) {
        vertices.iter().for_each(|v| at.entry(*v).or_default().push(i));
    }
    if at.values().map(|facets| facets.len() * facets.len()).sum::<usize>() > MAX_PASSING_PLACES {
        return None;
    }
    let number: Vec<(u32, &Vec<u32>)> = marked.iter().map(|(f, vertices)| (*f, vertices)).collect();
    let sets = Sets::new(number.len());
    for (i, vertices) in (0..).zip(&rare) {
        let others: BTreeSet<u32> =
            vertices.iter().flat_map(|v| &at[v]).copied().filter(|j| *j > i).collect();
        for j in others {
            if sets.root(i) != sets.root(j)
                && is_wide(mesh, &common(number[i as usize].1, number[j as usize].1), reach)
            {
                sets.join(i, j);
            }
        }
    }
    let mut members: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for i in 0..number.len() as u32 {
        members.entry(sets.root(i)).or_default().push(number[i as usize].0);
    }
    Some(members.into_values().collect())
}

/// The common entries of two ascending lists.
fn common(a: &[u32], b: &[u32]) -> Vec<u32> {
    let (shorter, longer) = if a.len() <= b.len() { (a, b) } else { (b, a) };
    shorter.iter().filter(|v| longer.binary_search(v).is_ok()).copied().collect()
}

/// Whether some vertex lies farther than twice the reach from the line through the first and the one farthest from it.
fn is_wide(mesh: &Mesh, vertices: &[u32], reach: f64) -> bool {
    let at = |v: u32| mesh.positions[v as usize];
    let Some(first) = vertices.first() else { return false };
    let a = at(*first);
    let from = |v: &u32| norm(minus(at(*v), a));
    let Some(far) = vertices.iter().max_by(|v, w| from(v).total_cmp(&from(w))) else { return false };
    let way = minus(at(*far), a);
    vertices.iter().any(|v| norm(cross(minus(at(*v), a), way)) > 2.0 * reach * norm(way))
}

/// The next vertices along the edges of all facets that were looked at.
fn adjacent_vertices(mesh: &Mesh, imprints: &Imprints) -> BTreeMap<u32, BTreeSet<u32>> {
    let mut adjacent_vertices: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
    for side in imprints.facets.iter().flat_map(|f| sides(mesh.faces[*f as usize])) {
        for w in chain(imprints, side).windows(2) {
            adjacent_vertices.entry(w[0]).or_default().insert(w[1]);
            adjacent_vertices.entry(w[1]).or_default().insert(w[0]);
        }
    }
    adjacent_vertices
}

/// The vertices from `a` to `b`, both among them.
fn chain(imprints: &Imprints, [a, b]: Edge) -> Vec<u32> {
    let on = imprints.on_edge.get(&edge(a, b)).into_iter().flatten().copied();
    let mut all: Vec<u32> = std::iter::once(a.min(b)).chain(on).chain([a.max(b)]).collect();
    if a > b {
        all.reverse();
    }
    all
}

/// Vertices as they are seen along an axis.
struct Seen<'a> {
    mesh: &'a Mesh,
    axis: usize,
    numbers: &'a [u32],
}

impl Seen<'_> {
    fn at(&self, point: u32) -> &Point {
        &self.mesh.positions[self.numbers[point as usize] as usize]
    }
}

impl triangulate::Plane for Seen<'_> {
    fn orient(&self, points: [u32; 3]) -> i32 {
        let [a, b, c] = points.map(|p| self.at(p));
        side_of_line(self.axis, a, b, c)
    }
    fn compare(&self, a: u32, b: u32) -> Ordering {
        let ([px, py], [qx, qy]) = (self.rough(a), self.rough(b));
        px.total_cmp(&qx).then(py.total_cmp(&qy))
    }
    fn rough(&self, point: u32) -> [f64; 2] {
        let p = self.at(point);
        // Without the sign of zero.
        [p[(self.axis + 1) % 3] + 0.0, p[(self.axis + 2) % 3] + 0.0]
    }
}

/// The pieces of facets that overlap, each with its facet.
fn tiled(
    mesh: &Mesh,
    imprints: &Imprints,
    marked: &BTreeMap<u32, Vec<u32>>,
    adjacent_vertices: &BTreeMap<u32, BTreeSet<u32>>,
    facets: &[u32],
) -> Option<Vec<([u32; 3], u32)>> {
    let numbers: BTreeSet<u32> = facets.iter().flat_map(|f| &marked[f]).copied().collect();
    let numbers: Vec<u32> = numbers.into_iter().collect();
    let local = |v: &u32| numbers.binary_search(v).ok().map(|i| i as u32);
    let size = |f: u32| area(mesh.corners(f));
    let largest = facets.iter().max_by(|f, g| size(**f).total_cmp(&size(**g)).then(g.cmp(f)))?;
    let seen = Seen { mesh, axis: axis_of(mesh, *largest), numbers: &numbers };
    let mut fixed: Vec<[u32; 2]> = vec![];
    for (i, v) in (0..).zip(&numbers) {
        fixed.extend(adjacent_vertices[v].iter().filter_map(local).filter(|j| i < *j).map(|j| [i, j]));
    }
    let triangles = triangulate(numbers.len() as u32, &fixed, &seen)?;
    let mut pieces = vec![];
    for &f in facets {
        let [a, b, c] = mesh.faces[f as usize];
        let [p, q, r] = [a, b, c].map(|v| &mesh.positions[v as usize]);
        let turn = side_of_line(seen.axis, p, q, r);
        let outline = outline(imprints, [a, b, c], local)?;
        for t in within(&triangles, &outline, turn > 0)? {
            let [a, b, c] = [0, 1, 2].map(|k| numbers[triangles.from[3 * t as usize + k] as usize]);
            pieces.push((if turn > 0 { [a, b, c] } else { [a, c, b] }, f));
        }
    }
    Some(pieces)
}

/// The steps along the sides of a face, the way it runs. Where they run back along themselves, there is nothing between.
fn outline(
    imprints: &Imprints,
    face: [u32; 3],
    local: impl Fn(&u32) -> Option<u32>,
) -> Option<BTreeSet<[u32; 2]>> {
    let mut outline = BTreeSet::new();
    for side in sides(face) {
        let along: Vec<u32> = chain(imprints, side).iter().map(&local).collect::<Option<_>>()?;
        for w in along.windows(2) {
            if !outline.remove(&[w[1], w[0]]) && !outline.insert([w[0], w[1]]) {
                return None;
            }
        }
    }
    Some(outline)
}

/// The triangles to the left of a closed outline, or to its right; `None` if the hull is reached from there.
fn within(triangles: &Triangles, outline: &BTreeSet<[u32; 2]>, left: bool) -> Option<Vec<u32>> {
    // Sets, as there may be many facets, each with few of very many triangles.
    let mut barrier = HashSet::new();
    let mut stack = vec![];
    for [p, q] in outline {
        let e = if left { triangles.directed(*p, *q) } else { triangles.directed(*q, *p) }?;
        barrier.insert(e);
        stack.push(e / 3);
    }
    let mut reached = HashSet::new();
    let mut all = vec![];
    while let Some(t) = stack.pop() {
        if !reached.insert(t) {
            continue;
        }
        all.push(t);
        for e in [3 * t, next(3 * t), 3 * t + 2].into_iter().filter(|e| !barrier.contains(e)) {
            match triangles.twin[e as usize] {
                u32::MAX => return None,
                twin => stack.push(twin / 3),
            }
        }
    }
    all.sort_unstable();
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::num::random::Random;

    /// Facets with few vertices in common, or with many, and hubs: as all pairs tell.
    #[test]
    fn facets_that_overlap_are_grouped_as_all_pairs_tell() {
        let random = &mut Random::new(12);
        for case in 0..200 {
            let count = 20 + random.below(200);
            let place = |_| -> Point { std::array::from_fn(|_| random.below(4) as f64) };
            let mesh = Mesh { positions: (0..count).map(place).collect(), faces: vec![] };
            let mut vertices = || {
                // The first few are hubs.
                let any = |_| if random.below(3) == 0 { random.below(3) } else { random.below(count) };
                let all: BTreeSet<u32> = (0..3 + case % 6).map(any).map(|v| v as u32).collect();
                all.into_iter().collect::<Vec<u32>>()
            };
            let marked: BTreeMap<u32, Vec<u32>> = (0..60).map(|f| (3 * f, vertices())).collect();
            let sets = Sets::new(marked.len());
            for (i, of_i) in (0..).zip(marked.values()) {
                for (j, of_j) in (0..i).zip(marked.values()) {
                    if is_wide(&mesh, &common(of_i, of_j), 1e-9) {
                        sets.join(i, j);
                    }
                }
            }
            let mut want: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
            (0..).zip(marked.keys()).for_each(|(i, f)| want.entry(sets.root(i)).or_default().push(*f));
            let want: Vec<Vec<u32>> = want.into_values().collect();
            assert_eq!(groups(&mesh, &marked, 1e-9).unwrap(), want, "{case}");
        }
    }

    /// Facets around a hub meet in no more places than around a ring.
    #[test]
    fn a_hub_of_many_facets_is_no_heap() {
        let n = 20_000u32;
        let positions = (0..n + 1).map(|i| [f64::from(i), f64::from(i % 7), 0.0]).collect();
        let mesh = Mesh { positions, faces: vec![] };
        let marked: BTreeMap<u32, Vec<u32>> = (0..n)
            .map(|i| {
                let mut all = vec![0, 1 + i, 1 + (i + 1) % n];
                all.sort_unstable();
                (i, all)
            })
            .collect();
        assert_eq!(groups(&mesh, &marked, 1e-9).unwrap().len(), n as usize);
    }
}
