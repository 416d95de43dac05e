//! Which closed shells lie inside which others: decided exactly.
//!
//! From a vertex of the one a ray goes in the direction of x. How often the facets of the other wind around it follows from
//! exact signs alone: in the projection along the ray, edges are half open, so that a ray through an edge or a vertex counts
//! once; then the vertex lies before or behind the plane of the facet.

use crate::mesh::Mesh;
use crate::num::predicates::{side_of_line, side_of_plane};
use crate::space::Point;

/// A closed shell, ready to be asked about points. Its facets lie in rows by z, each in all rows that it reaches.
pub(super) struct Container<'a> {
    mesh: &'a Mesh,
    low: f64,
    /// Rows per millimetre.
    density: f64,
    start: Vec<u32>,
    facets: Vec<u32>,
}

impl<'a> Container<'a> {
    /// Of these facets, which must have finite corners. Linear.
    pub(super) fn new(mesh: &'a Mesh, facets: &[u32]) -> Container<'a> {
        let span = |f: u32| {
            let z = mesh.faces[f as usize].map(|v| mesh.positions[v as usize][2]);
            (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]))
        };
        let whole = |(l, h): (f64, f64), (a, b): (f64, f64)| (l.min(a), h.max(b));
        let (low, high) = facets.iter().map(|&f| span(f)).fold((f64::INFINITY, f64::NEG_INFINITY), whole);
        let mut rows = facets.len().isqrt().max(1);
        loop {
            let density = if high > low { rows as f64 / (high - low) } else { 0.0 };
            let row = |z: f64| (((z - low) * density) as usize).min(rows - 1);
            let of = |f: u32| {
                let (a, b) = span(f);
                row(a)..=row(b)
            };
            let entries: usize = facets.iter().map(|&f| of(f).count()).sum();
            if rows > 1 && entries > 4 * facets.len() {
                rows /= 2;
                continue;
            }
            let mut start = vec![0u32; rows + 1];
            facets.iter().flat_map(|&f| of(f)).for_each(|r| start[r + 1] += 1);
            (0..rows).for_each(|r| start[r + 1] += start[r]);
            let (mut next, mut sorted) = (start.clone(), vec![0; entries]);
            for &f in facets {
                for r in of(f) {
                    sorted[next[r] as usize] = f;
                    next[r] += 1;
                }
            }
            return Container { mesh, low, density, start, facets: sorted };
        }
    }

    /// How often the shell winds around `p`: 0 outside. `None` where `p` lies on the shell, or in the plane and the
    /// box of one of its facets.
    pub(super) fn winding(&self, p: &Point) -> Option<i32> {
        let rows = self.start.len() - 1;
        let place = (p[2] - self.low) * self.density;
        if place < 0.0 {
            return Some(0);
        }
        let row = (place as usize).min(rows - 1);
        let mut total = 0;
        for &f in &self.facets[self.start[row] as usize..self.start[row + 1] as usize] {
            let [a, b, c] = self.mesh.faces[f as usize].map(|v| self.mesh.positions[v as usize]);
            let in_box = |k: usize| a[k].min(b[k]).min(c[k]) <= p[k] && p[k] <= a[k].max(b[k]).max(c[k]);
            if (0..3).all(in_box) && side_of_plane(&a, &b, &c, p) == 0 {
                return None;
            }
            let around: i32 = [[a, b], [b, c], [c, a]].iter().map(|e| passes(e, p)).sum();
            if around != 0 && side_of_plane(&a, &b, &c, p) == around {
                total += around;
            }
        }
        Some(total)
    }
}

/// +1 where the edge passes `p` upwards (in z) on the far side in y, −1 where it passes downwards there, else 0.
fn passes([u, v]: &[Point; 2], p: &Point) -> i32 {
    match (u[2] <= p[2], v[2] <= p[2]) {
        (true, false) => i32::from(side_of_line(0, u, v, p) > 0),
        (false, true) => -i32::from(side_of_line(0, u, v, p) < 0),
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;
    use crate::topology::tests::block;

    #[test]
    fn a_block_contains_what_lies_between_its_sides() {
        let mut mesh = block(4, 2.0);
        let all: Vec<u32> = (0..mesh.faces.len() as u32).collect();
        let random = &mut Random::new(4);
        for inverted in [false, true] {
            let container = Container::new(&mesh, &all);
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
            mesh.faces.iter_mut().for_each(|f| f.swap(0, 1));
        }
    }
}
