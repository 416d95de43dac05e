//! Facets that occur with both orientations: which of the copies bounds a body.
//!
//! In a winding number they cancel, as if the mesh had a hole there. The edges around them tell which they are. Facets that
//! close what the others leave open belong to the surface with the orientation that closes it. The copies that look the other
//! way do not count. A sheet that closes nothing has no inside, and its copies may cancel. Such facets are judged together as
//! far as they hang together through edges: one alone, amid its like, has nothing around it to tell by.

use crate::mesh::Mesh;
use std::collections::BTreeMap;

/// Corners of a facet by the lowest numbers of their places, least first, and whether it turns the way of ascending corners.
type Facet = ([u32; 3], bool);

/// The mesh without the copies of facets that look against the surface they close; `None` if there are none.
///
/// Cost: `n log n` in vertices and facets.
pub(super) fn without_opposite_copies(mesh: &Mesh) -> Option<Mesh> {
    let own = places(mesh);
    let facets: Vec<Option<Facet>> = mesh.faces.iter().map(|f| facet(f.map(|v| own[v as usize]))).collect();
    let mut counts: BTreeMap<[u32; 3], [u32; 2]> = BTreeMap::new();
    for (corners, up) in facets.iter().flatten() {
        counts.entry(*corners).or_default()[usize::from(*up)] += 1;
    }
    counts.retain(|_, [down, up]| *down > 0 && *up > 0);
    if counts.is_empty() {
        return None;
    }
    // The edges that the others leave open: how often each is passed upward less how often downward.
    let mut open: BTreeMap<[u32; 2], i64> = BTreeMap::new();
    let others = facets.iter().flatten().filter(|(corners, _)| !counts.contains_key(corners));
    others.flat_map(edges).for_each(|(edge, way)| *open.entry(edge).or_default() += way);
    let doubled: Vec<[u32; 3]> = counts.keys().copied().collect();
    let kept = orientations(&doubled, &open);
    let kept: BTreeMap<[u32; 3], bool> =
        doubled.iter().zip(kept).filter_map(|(corners, up)| Some((*corners, up?))).collect();
    if kept.is_empty() {
        return None;
    }
    let counts =
        |f: &Option<Facet>| f.is_none_or(|(corners, up)| kept.get(&corners).is_none_or(|k| *k == up));
    let faces = mesh.faces.iter().zip(&facets).filter(|(_, f)| counts(f)).map(|(face, _)| *face).collect();
    Some(Mesh { positions: mesh.positions.clone(), faces })
}

/// For each vertex the lowest number of those at its place.
fn places(mesh: &Mesh) -> Vec<u32> {
    // Adding zero makes −0 the 0 that it equals.
    let key = |v: u32| mesh.positions[v as usize].map(|x| (x + 0.0).to_bits());
    let mut order: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    order.sort_unstable_by_key(|v| (key(*v), *v));
    let mut own = vec![0; order.len()];
    for same in order.chunk_by(|a, b| key(*a) == key(*b)) {
        same.iter().for_each(|v| own[*v as usize] = same[0]);
    }
    own
}

/// `None` for a facet without three corners.
fn facet([a, b, c]: [u32; 3]) -> Option<Facet> {
    let mut corners = [a, b, c];
    corners.sort_unstable();
    let distinct = corners[0] < corners[1] && corners[1] < corners[2];
    let up = [a, b, c] == corners || [b, c, a] == corners || [c, a, b] == corners;
    distinct.then_some((corners, up))
}

/// The edges of a facet, ends ascending, and 1 where it passes them so, else −1.
fn edges((corners, up): &Facet) -> [([u32; 2], i64); 3] {
    let [a, b, c] = *corners;
    let way = if *up { 1 } else { -1 };
    [([a, b], way), ([b, c], way), ([a, c], -way)]
}

/// For each of these facets the orientation in which it closes what is open; `None` where none does.
fn orientations(doubled: &[[u32; 3]], open: &BTreeMap<[u32; 2], i64>) -> Vec<Option<bool>> {
    let mut at_edge: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (n, corners) in doubled.iter().enumerate() {
        edges(&(*corners, true)).iter().for_each(|(edge, _)| at_edge.entry(*edge).or_default().push(n));
    }
    let mut up: Vec<Option<bool>> = vec![None; doubled.len()];
    let mut out = vec![None; doubled.len()];
    for start in 0..doubled.len() {
        if up[start].is_some() {
            continue;
        }
        up[start] = Some(true);
        let mut part = vec![start];
        let mut next = 0;
        while next < part.len() {
            let n = part[next];
            next += 1;
            for (edge, way) in edges(&(doubled[n], up[n] == Some(true))) {
                let Some([a, b]) = at_edge.get(&edge).and_then(|b| <[usize; 2]>::try_from(b.as_slice()).ok())
                else {
                    continue;
                };
                // An edge that others leave open as well is a corner of the sheet: it does not go on there.
                let other = if a == n { b } else { a };
                if up[other].is_some() || open.get(&edge).is_some_and(|o| *o != 0) {
                    continue;
                }
                let agrees = edges(&(doubled[other], true)).iter().any(|(e, w)| *e == edge && *w == -way);
                up[other] = Some(agrees);
                part.push(other);
            }
        }
        let mut own: BTreeMap<[u32; 2], i64> = BTreeMap::new();
        for n in &part {
            edges(&(doubled[*n], up[*n] == Some(true)))
                .iter()
                .for_each(|(e, w)| *own.entry(*e).or_default() += w);
        }
        // How much less is open with the part this way, and the other.
        let gain = |turn: i64| -> i64 {
            let less = |(edge, way): (&[u32; 2], &i64)| {
                let before = open.get(edge).copied().unwrap_or(0);
                before.abs() - (before + turn * way).abs()
            };
            own.iter().map(less).sum()
        };
        let turned = match (gain(1), gain(-1)) {
            (a, b) if a.max(b) <= 0 => None,
            (a, b) => Some(b > a),
        };
        if let Some(turned) = turned {
            part.iter().for_each(|n| out[*n] = up[*n].map(|u| u != turned));
        }
    }
    out
}
