//! The face of each point that costs least.

use super::cut::NO_FACE;
use super::faces::Seat;

/// A point near a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub point: u32,
    pub seat: Seat,
}

/// The face of each point that costs least.
pub(super) struct Best {
    pub owner: Vec<u32>,
    pub cost: Vec<f64>,
    pub second: Vec<f64>,
    pub seat: Vec<Option<Seat>>,
    /// How far off it lies from the nearest face beside its own, which faces otherwise, millimeters.
    pub adjacent_face: Vec<f32>,
}

impl Best {
    pub(super) fn new(count: usize) -> Best {
        let far = vec![f64::INFINITY; count];
        Best {
            owner: vec![NO_FACE; count],
            cost: far.clone(),
            second: far,
            seat: vec![None; count],
            adjacent_face: vec![f32::INFINITY; count],
        }
    }
    pub(super) fn forget(&mut self, p: usize) {
        (self.owner[p], self.cost[p], self.seat[p]) = (NO_FACE, f64::INFINITY, None);
    }
    pub(super) fn add(&mut self, c: &Candidate, face: u32, cost: f64) {
        let p = c.point as usize;
        if cost < self.cost[p] {
            self.second[p] = self.cost[p];
            (self.owner[p], self.cost[p], self.seat[p]) = (face, cost, Some(c.seat));
        } else if cost < self.second[p] {
            self.second[p] = cost;
        }
    }
}
