//! Which closed shells lie inside which others: decided exactly.
//!
//! From a vertex of the one a ray goes in the direction of an axis. How often the facets of the other wind around it follows
//! from exact signs alone: in the projection along the ray, edges are half open, so that a ray through an edge or a vertex
//! counts once; then the vertex lies before or behind the plane of the facet.

use crate::mesh::Mesh;
use crate::num::predicates::{side_of_line, side_of_plane};
use crate::space::Point;

/// A closed shell, ready to be asked about points by rays along an axis. Its facets lie in rows across another axis, each in
/// all rows that it reaches.
pub(crate) struct Container<'a> {
    mesh: &'a Mesh,
    /// Of the rays.
    axis: usize,
    low: f64,
    /// Rows per millimetre.
    density: f64,
    start: Vec<u32>,
    facets: Vec<u32>,
}

impl<'a> Container<'a> {
    /// Of these facets, which must have finite corners, for rays along `axis`. Linear.
    pub(crate) fn new(mesh: &'a Mesh, facets: &[u32], axis: usize) -> Container<'a> {
        let span = |f: u32| {
            let z = mesh.faces[f as usize].map(|v| mesh.positions[v as usize][(axis + 2) % 3]);
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
            return Container { mesh, axis, low, density, start, facets: sorted };
        }
    }

    /// How often the shell winds around `p`: 0 outside. `None` where `p` lies on the shell, or in the plane and the
    /// box of one of its facets.
    pub(super) fn winding(&self, p: &Point) -> Option<i32> {
        let touches = |f: u32| {
            let [a, b, c] = self.corners(f);
            let in_box = |k: usize| a[k].min(b[k]).min(c[k]) <= p[k] && p[k] <= a[k].max(b[k]).max(c[k]);
            (0..3).all(in_box) && side_of_plane(&a, &b, &c, p) == 0
        };
        let on_it = self.row(p).iter().any(|&f| touches(f));
        (!on_it).then(|| self.beyond(p, |_| true))
    }

    /// How often the facets that count wind around `p`: those that the ray passes from their inner side less those that it
    /// passes from their outer side. Facets that hold `p` are not passed.
    pub(crate) fn beyond(&self, p: &Point, counts: impl Fn(u32) -> bool) -> i32 {
        let passed = |f: u32| {
            let ([a, b, c], around) = (self.corners(f), self.around(f, p));
            if around != 0 && counts(f) && side_of_plane(&a, &b, &c, p) == around { around } else { 0 }
        };
        self.row(p).iter().map(|&f| passed(f)).sum()
    }

    fn corners(&self, f: u32) -> [Point; 3] {
        self.mesh.faces[f as usize].map(|v| self.mesh.positions[v as usize])
    }

    /// How often a facet winds around `p`, both seen along the axis: +1 where it looks along it, −1 where it looks back, 0
    /// where it lies beside. Its edges are half open: of facets that hang together one winds around each point.
    pub(crate) fn around(&self, f: u32, p: &Point) -> i32 {
        let [a, b, c] = self.corners(f);
        [[a, b], [b, c], [c, a]].iter().map(|e| passes(self.axis, e, p)).sum()
    }

    /// The facets that a ray from `p` may pass.
    pub(crate) fn row(&self, p: &Point) -> &[u32] {
        let rows = self.start.len() - 1;
        let place = (p[(self.axis + 2) % 3] - self.low) * self.density;
        if place < 0.0 {
            return &[];
        }
        let row = (place as usize).min(rows - 1);
        &self.facets[self.start[row] as usize..self.start[row + 1] as usize]
    }
}

/// Of the two other axes in their order: +1 where the edge passes `p` upwards in the second, on the far side in the first;
/// −1 where it passes downwards there; else 0.
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
    use crate::topology::tests::block;

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
