//! Whether two triangles meet anywhere else than in their common corners or edge: decided exactly.

use crate::num::predicates::{axis, side_of_line, side_of_plane};
use crate::space::Point;

/// A triangle and the numbers of its corners.
pub(super) type Triangle = ([Point; 3], [u32; 3]);

/// Not both signs among three.
fn agree(signs: [i32; 3]) -> bool {
    !(signs.contains(&1) && signs.contains(&-1))
}

/// Whether `p`, in the plane of `t`, lies in it, seen along axis `k`.
fn in_triangle(k: usize, p: &Point, t: &[Point; 3]) -> bool {
    agree(std::array::from_fn(|i| side_of_line(k, &t[i], &t[(i + 1) % 3], p)))
}

/// Whether two segments of one plane meet, seen along axis `k`.
fn segments(k: usize, [a, b]: [&Point; 2], [c, d]: [&Point; 2]) -> bool {
    let (x, y) = ((k + 1) % 3, (k + 2) % 3);
    let within = |a: &Point, b: &Point, p: &Point, i: usize| a[i].min(b[i]) <= p[i] && p[i] <= a[i].max(b[i]);
    let on = |o: i32, a: &Point, b: &Point, p: &Point| o == 0 && within(a, b, p, x) && within(a, b, p, y);
    let (oc, od) = (side_of_line(k, a, b, c), side_of_line(k, a, b, d));
    let (oa, ob) = (side_of_line(k, c, d, a), side_of_line(k, c, d, b));
    oc * od < 0 && oa * ob < 0 || on(oc, a, b, c) || on(od, a, b, d) || on(oa, c, d, a) || on(ob, c, d, b)
}

/// Whether the closed segment meets the closed triangle, which is not flat.
fn segment_triangle(p: &Point, q: &Point, t: &[Point; 3]) -> bool {
    let (a, b) = (side_of_plane(&t[0], &t[1], &t[2], p), side_of_plane(&t[0], &t[1], &t[2], q));
    if a * b > 0 {
        return false;
    }
    if a != 0 || b != 0 {
        return agree(std::array::from_fn(|i| side_of_plane(p, q, &t[i], &t[(i + 1) % 3])));
    }
    let Some(k) = axis(t) else { return false };
    let edge = |i: usize| [&t[i], &t[(i + 1) % 3]];
    in_triangle(k, p, t) || in_triangle(k, q, t) || (0..3).any(|i| segments(k, [p, q], edge(i)))
}

/// Whether these corners of a triangle lie strictly on one side of the plane of another.
fn on_one_side(corners: &[&Point], [a, b, c]: &[Point; 3]) -> bool {
    let first = side_of_plane(a, b, c, corners[0]);
    first != 0 && corners[1..].iter().all(|p| side_of_plane(a, b, c, p) == first)
}

/// Which corners of `i` are not among those of `j`, and how many.
fn only(i: &[u32; 3], j: &[u32; 3]) -> ([usize; 3], usize) {
    let (mut which, mut n) = ([0; 3], 0);
    for k in (0..3).filter(|&k| !j.contains(&i[k])) {
        which[n] = k;
        n += 1;
    }
    (which, n)
}

/// The definition of a self-intersecting pair. Neither triangle may be flat. Three common corners do not count: that
/// is a duplicate.
pub(super) fn meet((t, i): &Triangle, (u, j): &Triangle) -> bool {
    let own = only(i, j);
    let other = only(j, i);
    match (&own.0[..own.1], &other.0[..other.1]) {
        ([_, _, _], _) => {
            !on_one_side(&[&t[0], &t[1], &t[2]], u)
                && !on_one_side(&[&u[0], &u[1], &u[2]], t)
                && (0..3).any(|k| {
                    segment_triangle(&t[k], &t[(k + 1) % 3], u) || segment_triangle(&u[k], &u[(k + 1) % 3], t)
                })
        }
        // One common corner: what they have in common ends on the side opposite to it, of one or the other.
        (&[a, b], &[c, d]) => {
            !on_one_side(&[&t[a], &t[b]], u)
                && !on_one_side(&[&u[c], &u[d]], t)
                && (segment_triangle(&t[a], &t[b], u) || segment_triangle(&u[c], &u[d], t))
        }
        // A common edge: only if folded flat onto each other.
        (&[a], &[b]) => {
            let (e, f) = (&t[(a + 1) % 3], &t[(a + 2) % 3]);
            side_of_plane(&t[0], &t[1], &t[2], &u[b]) == 0
                && axis(t).is_some_and(|k| side_of_line(k, e, f, &t[a]) * side_of_line(k, e, f, &u[b]) > 0)
        }
        _ => false,
    }
}
