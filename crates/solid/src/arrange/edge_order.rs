//! The pieces around an edge, sorted exactly.
//!
//! A piece leaves its edge in the direction normal × edge, where the normal is turned over if the piece runs down the
//! edge. So these directions are the normals, turned by a quarter about the edge, and sorting the pieces is sorting the
//! normals. These are the facets' normals, which are known by their corners. The vector product of two of them lies
//! along the edge, so one of its coordinates has the sign that is looked for.

use super::cluster::plane_of;
use super::meetings::Edge;
use super::points::Points;
use std::cmp::Ordering;
use trueness_geom::mesh::Mesh;
use trueness_geom::num::interval::{Interval, cross};

/// A piece at an edge: its number, its facet, and whether it runs from the lower to the higher point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    pub ends: Edge,
    pub piece: u32,
    pub facet: u32,
    pub up: bool,
}

/// Sorts pieces around an edge: counter-clockwise as seen against the way from its lower to its higher point. `None` if two of
/// them leave the edge in the same direction.
pub(super) fn sort(mesh: &Mesh, points: &Points, sides: &mut [Side]) -> Option<()> {
    let Some(first) = sides.first().copied() else { return Some(()) };
    if sides.len() < 3 {
        return Some(());
    }
    let [a, b] = first.ends;
    let (from, to) = (points.rough(a), points.rough(b));
    let reach = |k: usize| (to[k] - from[k]).abs();
    let mut axes = [0, 1, 2];
    axes.sort_by(|i, j| reach(*j).total_cmp(&reach(*i)));
    let axis = axes.into_iter().find(|&k| points.compare(k, a, b).is_ne())?;
    let up = if points.compare(axis, a, b).is_lt() { 1 } else { -1 };
    let turn = |s: &Side, t: &Side| up * turn(mesh, axis, s, t);
    // From the direction of the first: less than half a turn on, half a turn, more.
    let half = |s: &Side| match turn(&first, s) {
        1 => 1,
        -1 => 3,
        _ if same_direction(mesh, &first, s) => 0,
        _ => 2,
    };
    let mut keyed: Vec<(u8, Side)> = sides.iter().map(|s| (half(s), *s)).collect();
    let order = |(g, s): &(u8, Side), (h, t): &(u8, Side)| g.cmp(h).then_with(|| turn(t, s).cmp(&0));
    keyed.sort_by(order);
    if keyed.windows(2).any(|w| order(&w[0], &w[1]) == Ordering::Equal) {
        return None;
    }
    for (place, (_, side)) in sides.iter_mut().zip(keyed) {
        *place = side;
    }
    Some(())
}

/// Sign of coordinate `axis` of the vector product of two normals.
fn turn(mesh: &Mesh, axis: usize, s: &Side, t: &Side) -> i32 {
    if s.facet == t.facet {
        return 0;
    }
    let sign = if s.up == t.up { 1 } else { -1 };
    let (m, n) = (normal(mesh, s.facet), normal(mesh, t.facet));
    if let Some(known) = cross(m, n)[axis].sign() {
        return sign * known;
    }
    let (m, n) = (plane_of(mesh, s.facet).normal, plane_of(mesh, t.facet).normal);
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    sign * (&(&m[i] * &n[j]) - &(&m[j] * &n[i])).sign()
}

/// Whether two normals that are parallel look the same way.
fn same_direction(mesh: &Mesh, s: &Side, t: &Side) -> bool {
    if s.facet == t.facet {
        return s.up == t.up;
    }
    let (m, n) = (plane_of(mesh, s.facet).normal, plane_of(mesh, t.facet).normal);
    let agree = (0..3).find(|k| m[*k].sign() != 0).is_none_or(|k| m[k].sign() == n[k].sign());
    agree == (s.up == t.up)
}

fn normal(mesh: &Mesh, facet: u32) -> [Interval; 3] {
    let [a, b, c] = mesh.faces[facet as usize].map(|v| mesh.positions[v as usize].map(Interval::of));
    let minus = |p: [Interval; 3], q: [Interval; 3]| std::array::from_fn(|k| p[k] - q[k]);
    cross(minus(b, a), minus(c, a))
}
