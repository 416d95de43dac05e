//! Deviations of each face of a CAD model.

use super::excluded::Excluded;
use crate::cad_faces::CadFaces;
use trueness_document::Word;
use trueness_document::face::FaceDeviation;
use trueness_geom::num::sum::Sum;

/// What is counted of one face.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    count: u64,
    sum: Sum,
    squares: Sum,
    lowest: f64,
    highest: f64,
    /// Points that have a tolerance, and those that keep it.
    judged: u64,
    inside: u64,
}

/// Deviations of each face of a CAD model, counted point by point.
pub struct FaceTallies<'a> {
    faces: &'a CadFaces,
    all: Vec<Tally>,
}

impl<'a> FaceTallies<'a> {
    pub fn new(faces: &'a CadFaces) -> FaceTallies<'a> {
        FaceTallies { faces, all: vec![Tally::default(); faces.faces.len()] }
    }

    /// Counts a point, whose deviation may have a zone to keep; points that do not count have none.
    pub fn add(&mut self, face: u32, deviation: f64, zone: Option<[f64; 2]>) {
        let Some(own) = self.all.get_mut(face as usize).filter(|_| Excluded::of(deviation).is_none()) else {
            return;
        };
        let is_first = own.count == 0;
        own.count += 1;
        own.sum = own.sum.plus(deviation);
        own.squares = own.squares.plus(deviation * deviation);
        own.lowest = if is_first { deviation } else { own.lowest.min(deviation) };
        own.highest = if is_first { deviation } else { own.highest.max(deviation) };
        if let Some([lower, upper]) = zone {
            own.judged += 1;
            own.inside += u64::from(lower <= deviation && deviation <= upper);
        }
    }

    /// The faces that have points, in the order of the model.
    pub fn records(&self) -> Vec<FaceDeviation> {
        let of = |(face, tally): (u32, &Tally)| {
            let count = tally.count as f64;
            FaceDeviation {
                face: self.faces.record(face),
                kind: Word(crate::cad::word(self.faces.faces[face as usize].kind)),
                count: tally.count,
                mean: tally.sum.value() / count,
                rms: (tally.squares.value() / count).sqrt(),
                min: tally.lowest,
                max: tally.highest,
                inside: (tally.judged > 0).then(|| tally.inside as f64 / tally.judged as f64),
            }
        };
        (0u32..).zip(&self.all).filter(|(_, tally)| tally.count > 0).map(of).collect()
    }
}
