//! The map while the points pass by: the worst point of each piece.

use super::bisection::{Bisection, PIECE_AREA_RATIO};
use super::facet::whole_area;
use super::places::Places;
use trueness_document::tolerance::{Tolerance, badness};
use trueness_geom::mesh::Mesh;

/// Cuts of the reference's facets, at most: beyond, more detail cannot be seen and costs room in the report.
const MAX_MAP_CUTS: usize = 400_000;

/// The worst point of each piece so far.
pub struct PointMap {
    pub(super) pieces: Bisection,
    pub(super) worst: Vec<Kept>,
    pub(super) tolerance: Option<Tolerance>,
    /// Where means are kept, if they are asked for.
    pub(super) places: Option<Places>,
}

/// Where the nearest place of a point lies: the facet, the piece, and the weights of the facet's first two corners.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    face: u32,
    /// Where there is a map.
    piece: u32,
    weights: [f32; 2],
    /// The place at which the point counts, where there are such.
    place: u32,
}

/// A point that a piece shows; NaN where there is none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kept {
    pub(super) deviation: f64,
    weights: [f32; 2],
}

/// A measured point that must be seen.
#[derive(Clone, Copy, Debug)]
pub struct Flagged {
    /// The facet with its nearest place.
    pub face: u32,
    /// Weights of the facet's corners there.
    pub weights: [f64; 3],
    /// Its deviation.
    pub deviation: f64,
}

impl Foot {
    /// Of a facet, in no map.
    pub fn on_facet(face: u32, weights: [f64; 3]) -> Foot {
        Foot { face, piece: u32::MAX, weights: [weights[0] as f32, weights[1] as f32], place: u32::MAX }
    }

    /// The facet.
    pub fn face(&self) -> u32 {
        self.face
    }

    /// The weights of its corners.
    pub fn weights(&self) -> [f64; 3] {
        whole(self.weights)
    }
}

impl PointMap {
    /// An empty map on `mesh`. With a tolerance the worst point is the one farthest beyond it, else the one farthest away.
    /// With `places` means are kept, too.
    pub fn new(mesh: &Mesh, tolerance: Option<Tolerance>, places: bool) -> PointMap {
        let edge = (whole_area(mesh) / (PIECE_AREA_RATIO * MAX_MAP_CUTS as f64)).sqrt();
        let edge = if edge > 0.0 { edge } else { f64::INFINITY };
        let pieces = Bisection::of(mesh, edge, MAX_MAP_CUTS);
        let none = Kept { deviation: f64::NAN, weights: [0.0; 2] };
        let places = places.then(|| Places::new(mesh));
        PointMap { worst: vec![none; pieces.len()], pieces, tolerance, places }
    }

    /// The piece that a place on a facet of `mesh` lies in.
    pub fn foot(&self, mesh: &Mesh, face: u32, weights: [f64; 3]) -> Foot {
        let place = self.places.as_ref().map_or(u32::MAX, |places| places.at(mesh, face, weights));
        let piece = self.pieces.piece(face, weights);
        Foot { piece, place, ..Foot::on_facet(face, weights) }
    }

    /// The places with what was added so far.
    pub fn take_places(&mut self) -> Option<Places> {
        self.places.take()
    }

    /// Adds a point; of equally bad ones the first stays.
    pub fn add(&mut self, foot: Foot, deviation: f64) {
        let kept = &mut self.worst[foot.piece as usize];
        if worse(deviation, kept.deviation, self.tolerance) {
            *kept = Kept { deviation, weights: foot.weights };
        }
        if let Some(places) = &mut self.places {
            places.add(foot.place, deviation);
        }
    }
}

/// Whether deviation `a` is worse than `b`: farther beyond the tolerance, else of greater size. Anything is worse than NaN.
pub(super) fn worse(a: f64, b: f64, tolerance: Option<Tolerance>) -> bool {
    let zone = tolerance.map(|t| [t.lower, t.upper]);
    b.is_nan() || badness(a, zone) > badness(b, zone)
}

impl Kept {
    pub(super) fn weights(&self) -> [f64; 3] {
        whole(self.weights)
    }
}

/// All three weights.
fn whole(weights: [f32; 2]) -> [f64; 3] {
    let [a, b] = weights.map(f64::from);
    [a, b, 1.0 - a - b]
}
