//! What is asked beside distances, and what is kept of each point.

use super::covered::CoverageSample;
use super::facing::Facing;
use super::map::{Foot, PointMap};
use super::region::Regions;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::{Point, Vector};

/// Where a point is nearest to the reference, or where its line meets it.
pub struct Nearest {
    /// The place.
    pub place: Point,
    /// Unit normal there; `None` where there is none.
    pub normal: Option<Vector>,
    /// The facet there.
    pub face: u32,
    /// Weights of the facet's corners.
    pub weights: [f64; 3],
}

/// What is asked beside the distances of points whose first has number `start`.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    pub start: u64,
    /// Where nearest places are looked up, and the facets they lie on.
    pub map: Option<(&'a PointMap, &'a Mesh)>,
    /// The sample that tells what is covered.
    pub sample: Option<&'a CoverageSample>,
    /// Only points that look the same way count.
    pub facing: Option<&'a Facing>,
    /// Parts of the reference that are told apart.
    pub regions: Option<&'a Regions>,
}

impl Asked<'_> {
    /// Whether no more is asked than distances.
    pub fn only_distances(&self) -> bool {
        self.map.is_none() && self.sample.is_none() && self.facing.is_none() && self.regions.is_none()
    }

    /// Whether the place of point `i` of these on the reference matters.
    pub fn needs_place(&self, i: usize) -> bool {
        self.map.is_some() || self.facing.is_some() || self.regions.is_some() || self.samples(i)
    }

    /// Whether the sample asks for point `i` of these.
    fn samples(&self, i: usize) -> bool {
        self.sample.is_some_and(|s| s.wants(self.start + i as u64))
    }

    /// The place of point `i` on the reference, as map and sample need it.
    pub fn foot(&self, i: usize, face: u32, weights: [f64; 3]) -> Option<Foot> {
        match self.map {
            Some((map, mesh)) => Some(map.foot(mesh, face, weights)),
            None => self.samples(i).then(|| Foot::on_facet(face, weights)),
        }
    }

    /// What is kept of point `i` with this deviation and place on the reference.
    pub fn kept(&self, i: usize, deviation: f64, face: u32, weights: [f64; 3], place: &Point) -> Kept {
        let region = self.regions.map_or(0, |r| r.of(face, place));
        (deviation, self.foot(i, face, weights), region)
    }

    /// Whether point `i` of these may count beside a place of the reference with this normal.
    pub fn agrees(&self, i: usize, normal: impl Fn() -> Option<Vector>) -> bool {
        self.facing.is_none_or(|f| f.agrees(self.start + i as u64, normal()))
    }
}

/// A deviation, its place in the map and its region.
pub type Kept = (f64, Option<Foot>, u16);

/// What is not measured has no place.
pub fn none(deviation: f64) -> Kept {
    (deviation, None, 0)
}

/// Deviations of points; with a map, where their nearest places lie in it; and how many nearest places are not beyond doubt.
pub struct Measures {
    pub deviations: Vec<f64>,
    pub feet: Vec<Option<Foot>>,
    /// Numbers of regions, 0 for none; empty where there are no regions.
    pub regions: Vec<u16>,
    pub uncertain: u64,
}

impl Measures {
    pub fn of(found: Vec<Kept>, asked: &Asked) -> Measures {
        let regions = asked.regions.map_or(vec![], |_| found.iter().map(|f| f.2).collect());
        let (deviations, feet) = found.into_iter().map(|(d, foot, _)| (d, foot)).unzip();
        Measures { deviations, feet, regions, uncertain: 0 }
    }
}
