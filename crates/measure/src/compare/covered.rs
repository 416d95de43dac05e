//! What of a reference the points cover, by a bounded sample of them: what a verdict asks of every comparison must not slow it.
//!
//! The sample is that of reports ([`ShownPoints`](super::ShownPoints)): even, and the same however the points come in blocks. Up to
//! [`MAX_COVERED_SAMPLE`] points it holds all of them.

use super::coverage::Coverage;
use super::map::{Foot, MapSurface, PointMap};
use super::shown::scramble;
use trueness_geom::mesh::Mesh;

/// Points of the sample, at most. The border of what is covered is then certain to about a hundredth of the reference's size.
const MAX_COVERED_SAMPLE: usize = 1 << 16;

/// The nearest places of an even sample of the points that count.
#[derive(Default)]
pub struct CoverageSample {
    feet: Vec<(u64, Foot)>,
    /// Places of a measured mesh between its vertices: few, and all of them count.
    between: Vec<Foot>,
    level: u32,
}

impl CoverageSample {
    /// Asks for no more than are needed of so many points from the first on.
    pub fn expects(&mut self, points: u64) {
        while points >> self.level > MAX_COVERED_SAMPLE as u64 {
            self.level += 1;
        }
    }

    /// Whether the point of this number is asked for.
    pub fn wants(&self, index: u64) -> bool {
        scramble(index).trailing_zeros() >= self.level
    }

    /// Takes the nearest place of a point that counts.
    pub fn add(&mut self, index: u64, foot: Foot) {
        if !self.wants(index) {
            return;
        }
        self.feet.push((index, foot));
        while self.feet.len() > MAX_COVERED_SAMPLE {
            self.level += 1;
            let level = self.level;
            self.feet.retain(|(index, _)| scramble(*index).trailing_zeros() >= level);
        }
    }

    /// Takes a place between the vertices of a measured mesh.
    pub fn add_between(&mut self, foot: Foot) {
        self.between.push(foot);
    }

    /// The surface with what the sample covers.
    pub fn surface(&self, mesh: &Mesh, coverage: Coverage) -> MapSurface {
        let mut map = PointMap::new(mesh, None, false);
        for foot in self.feet.iter().map(|(_, foot)| foot).chain(&self.between) {
            let own = map.foot(mesh, foot.face(), foot.weights());
            map.add(own, 0.0);
        }
        MapSurface::of(mesh, &map, &[], coverage)
    }
}

/// What of a reference the points cover.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covered {
    /// Area of the reference, square millimeters.
    pub area: f64,
    /// Area that is not covered, square millimeters.
    pub uncovered: f64,
    /// Within what distance a point covers, millimeters.
    pub reach: f64,
    /// How far the nearest places lie apart, millimeters.
    pub spacing: f64,
}

impl Covered {
    /// What a surface shows.
    pub fn of(surface: &MapSurface) -> Covered {
        let MapSurface { area, uncovered, reach, spacing, .. } = surface;
        Covered { area: *area, uncovered: *uncovered, reach: *reach, spacing: *spacing }
    }
}
