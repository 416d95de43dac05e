//! The facets near some that changed. All facets that these may cross lie there, and the rest of the mesh need not be
//! looked at again.

use std::cell::Cell;
use trueness_geom::check::near::{Look, Near};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point};

/// From this share of the facets on, looking at all of them is no slower.
const SLOWER_SHARE_DIVISOR: usize = 16;

/// Facets of a mesh, over the same vertices.
pub struct Neighborhood {
    /// The chosen facets and all whose boxes overlap theirs, as a mesh; others too.
    pub mesh: Mesh,
    /// Their numbers in the whole mesh, ascending.
    pub numbers: Vec<u32>,
    /// Which of them were asked about.
    pub is_chosen: Vec<bool>,
}

impl Neighborhood {
    /// Around the facets that `is_chosen` names by a flag each; `None` where they are too many for it to pay, or none.
    ///
    /// n log k for k of n facets, where the k are about equally large. A single large one brings in facets as near as
    /// it is large.
    pub fn new(mesh: &Mesh, is_chosen: &[bool]) -> Option<Neighborhood> {
        let bounds = |f: &[u32; 3]| Aabb::of(&mesh.places(f));
        let count = is_chosen.iter().filter(|is_chosen| **is_chosen).count();
        if count == 0 || SLOWER_SHARE_DIVISOR * count > mesh.faces.len() {
            return None;
        }
        let chosen: Vec<Aabb> = mesh
            .faces
            .iter()
            .zip(is_chosen)
            .filter(|(_, is_chosen)| **is_chosen)
            .map(|(f, _)| bounds(f))
            .collect();
        let half = chosen.iter().fold([0.0; 3], |half: Point, b| {
            let sides = b.sides();
            std::array::from_fn(|k| half[k].max(0.5 * sides[k]))
        });
        let middle = |b: &Aabb| std::array::from_fn(|k| 0.5 * b.min[k] + 0.5 * b.max[k]);
        let near = Near::new((0..).zip(&chosen).map(|(i, b)| (middle(b), i)).collect());
        // A box that overlaps a chosen one is no farther from its middle than half the largest, and the rounding error.
        let reaches = |f: &[u32; 3]| {
            let own = bounds(f);
            let wide = |k: usize| half[k] * (1.0 + 1e-12) + 1e-15 * own.min[k].abs().max(own.max[k].abs());
            let window = Aabb {
                min: std::array::from_fn(|k| own.min[k] - wide(k)),
                max: std::array::from_fn(|k| own.max[k] + wide(k)),
            };
            let found = Cell::new(false);
            let look = |_: usize, b: &Aabb| {
                let apart = (0..3).any(|k| b.min[k] > window.max[k] || b.max[k] < window.min[k]);
                if found.get() || apart { Look::Past } else { Look::Into }
            };
            near.look(look, |p, _| {
                found.set(found.get() || (0..3).all(|k| window.min[k] <= p[k] && p[k] <= window.max[k]));
                found.get()
            });
            found.get()
        };
        let inside: Vec<bool> =
            mesh.faces.par_iter().zip(is_chosen).map(|(f, is_chosen)| *is_chosen || reaches(f)).collect();
        let numbers: Vec<u32> = (0..).zip(&inside).filter(|(_, inside)| **inside).map(|(f, _)| f).collect();
        let faces = numbers.iter().map(|f| mesh.faces[*f as usize]).collect();
        let is_chosen = numbers.iter().map(|f| is_chosen[*f as usize]).collect();
        Some(Neighborhood { mesh: Mesh { positions: mesh.positions.clone(), faces }, numbers, is_chosen })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::num::random::Random;

    /// Every facet whose box overlaps that of one asked about is there, by brute force.
    #[test]
    fn nothing_near_is_left_out() {
        let random = &mut Random::new(4);
        let mut mesh = Mesh::default();
        for i in 0..600u32 {
            let size = if i % 50 == 0 { 3.0 } else { 0.2 };
            let at: Point = std::array::from_fn(|_| 10.0 * random.unit());
            let corner =
                |random: &mut Random| -> Point { std::array::from_fn(|k| at[k] + size * random.unit()) };
            mesh.positions.extend([at, corner(random), corner(random)]);
            mesh.faces.push([3 * i, 3 * i + 1, 3 * i + 2]);
        }
        let bounds = |f: usize| Aabb::of(&mesh.places(&mesh.faces[f]));
        for count in [1, 7, 30] {
            let is_chosen: Vec<bool> = (0..600).map(|f| f % (600 / count) == 3).collect();
            let around = Neighborhood::new(&mesh, &is_chosen).unwrap();
            assert!(around.numbers.is_sorted() && around.numbers.len() < 400, "{}", around.numbers.len());
            for f in 0..600 {
                let overlaps = |g: usize| {
                    let (a, b) = (bounds(f), bounds(g));
                    (0..3).all(|k| a.min[k] <= b.max[k] && b.min[k] <= a.max[k])
                };
                if (0..600).any(|g| is_chosen[g] && overlaps(g)) {
                    assert!(around.numbers.binary_search(&(f as u32)).is_ok(), "{f}");
                }
            }
            let count = |flags: &[bool]| flags.iter().filter(|f| **f).count();
            assert_eq!(count(&around.is_chosen), count(&is_chosen));
        }
        assert!(Neighborhood::new(&mesh, &[true; 600]).is_none());
    }
}
