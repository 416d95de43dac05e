//! Meshes and points for the tests, and what several of them ask.

mod crossing;
mod exact;
mod limit;
mod sign;
mod traps;
mod winding;
mod window;

use crate::closest::{Closest, Hit, Query, Tree};
use crate::mesh::Mesh;
use crate::progress::{Progress, Silent};
pub(crate) use crate::samples::{cube, sphere};
use crate::simd::Level;
use crate::space::{Point, plus};
use std::f64::consts::PI;
use std::sync::Mutex;

/// Small repeatable generator (SplitMix64).
pub struct TestRandom(pub u64);

impl TestRandom {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E3779B97F4A7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58476D1CE4E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D049BB133111EB);
        z ^ (z >> 31)
    }
    /// In -1..1.
    pub fn unit(&mut self) -> f64 {
        self.bits() as f64 / (1u64 << 63) as f64 - 1.0
    }
    /// In a cube of half side `size`.
    pub fn point(&mut self, size: f64) -> Point {
        std::array::from_fn(|_| self.unit() * size)
    }
    /// On the unit sphere.
    pub fn direction(&mut self) -> Point {
        loop {
            if let Some((d, length)) = crate::space::unit(self.point(1.0))
                && length <= 1.0
            {
                return d;
            }
        }
    }
}

/// `n` triangles without a common vertex.
pub fn soup(d: &mut TestRandom, n: usize, triangle: impl Fn(&mut TestRandom) -> [Point; 3]) -> Mesh {
    let positions = (0..n).flat_map(|_| triangle(d)).collect();
    Mesh { positions, faces: (0..n as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect() }
}

/// The answers to a query; fails if a point is answered twice or not at all.
pub fn hits(tree: &Tree, points: &[Point], query: &Query) -> Vec<Option<Hit>> {
    let out = Mutex::new(vec![None; points.len()]);
    tree.for_each_closest(points, query, &Silent, |i, h| {
        assert!(out.lock().unwrap()[i].replace(h).is_none(), "point {i} answered twice");
    })
    .unwrap();
    out.into_inner().unwrap().into_iter().map(|h| h.expect("every point is answered")).collect()
}

/// A query with the given instructions.
pub fn with(instructions: Level) -> Query {
    Query { instructions, ..Query::default() }
}

/// Wants to stop at once.
pub struct Stop;

impl Progress for Stop {
    fn cancelled(&self) -> bool {
        true
    }
}

/// All instruction sets; those that the processor lacks count as the best it has.
pub const LEVELS: [Level; 3] = [Level::Plain, Level::Avx2, Level::Avx512];

/// Runs `f` in a pool of `threads`.
pub fn in_pool<T: Send>(threads: usize, f: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(f)
}

/// Turns places about the origin by the length of `axis`, radians.
pub fn turned(axis: Point) -> impl Fn(Point) -> Point {
    let (k, angle) = crate::space::unit(axis).unwrap_or(([0.0, 0.0, 1.0], 0.0));
    move |p| {
        let (s, c) = (angle.sin(), angle.cos());
        let (across, along) = (crate::space::cross(k, p), crate::space::dot(k, p) * (1.0 - c));
        std::array::from_fn(|i| c * p[i] + s * across[i] + along * k[i])
    }
}
