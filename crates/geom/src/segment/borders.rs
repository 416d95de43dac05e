//! The borders between regions: each piece goes to the neighboring region that it fits best.

use super::grow::Context;
use super::pieces::{Band, NO_PIECE};
use super::probe::Probe;
use super::region::GrownRegion;
use crate::parallel::prelude::*;

/// Rings by which a border may move.
const BORDER_RINGS: usize = 4;

/// Moves borders and lets pieces of no region join a neighboring one that they nearly belong to. Normals at an edge belong to
/// neither face.
pub(super) fn move_borders(context: &Context, regions: &[GrownRegion], labels: &mut Vec<u32>) {
    let surface = context.surface;
    // Twice the angle.
    let loose = Band { cosine: 2.0 * context.band.cosine * context.band.cosine - 1.0, ..context.band };
    let elements: Vec<Probe> = regions.iter().map(|region| Probe::new(&region.shape)).collect();
    for _ in 0..BORDER_RINGS {
        let moved: Vec<u32> = (0..surface.len() as u32)
            .into_par_iter()
            .map(|piece| {
                let own = labels[piece as usize];
                let misfit = |label: u32| {
                    let element = &elements[label as usize];
                    let band = if own == NO_PIECE { &loose } else { &context.band };
                    surface.belongs(piece, element, band).then(|| surface.misfit(piece, element, band))
                };
                let mut best = (own, if own == NO_PIECE { None } else { misfit(own) });
                let mut last = own;
                for &neighbor in surface.neighbors(piece) {
                    let label = labels[neighbor as usize];
                    if label == NO_PIECE || label == last {
                        continue;
                    }
                    last = label;
                    if let Some(found) = misfit(label)
                        && best.1.is_none_or(|b| found < b || (found == b && label < best.0))
                    {
                        best = (label, Some(found));
                    }
                }
                best.0
            })
            .collect();
        if moved == *labels {
            break;
        }
        *labels = moved;
    }
}
