//! Neighbouring regions that are one face: pieces of one element that form error or a scratch kept apart.

use super::grow::{Grown, Terms};
use super::probe::Probe;
use super::surface::NONE;
use crate::fit::{Shape, improved};
use crate::space::Point;

/// Points of each region that a joint element is fitted to.
const ENOUGH: usize = 1500;
/// Root mean square about one element over that about two, from which on they are two. Equal regions whose elements
/// are off by one standard deviation of the points have 1.12.
const TELLS: f64 = 1.25;

/// Joins regions that one element explains as well as two. Labels of regions that are gone are replaced; the regions
/// themselves stay in place, without pieces.
pub(super) fn merge(terms: &Terms, regions: &mut [Grown], labels: &mut [u32]) {
    // Each pass may bring new neighbours together.
    while let Some((kept, gone, shape, rms)) = next(terms, regions, labels) {
        let pieces = std::mem::take(&mut regions[gone].pieces);
        pieces.iter().for_each(|&p| labels[p as usize] = kept as u32);
        let weight = std::mem::take(&mut regions[gone].weight);
        let whole = &mut regions[kept];
        whole.pieces.extend(pieces);
        whole.weight += weight;
        (whole.shape, whole.rms) = (shape, rms);
    }
}

/// The first pair of neighbours that are one, the heavier one first, and their element.
fn next(terms: &Terms, regions: &[Grown], labels: &[u32]) -> Option<(usize, usize, Shape, f64)> {
    neighbours(terms, labels).into_iter().find_map(|[a, b]| {
        let (a, b) = (a as usize, b as usize);
        let (large, small) = if regions[b].weight > regions[a].weight { (b, a) } else { (a, b) };
        let joint = joint(terms, &regions[large], &regions[small])?;
        Some((large, small, joint.0, joint.1))
    })
}

/// The element of both, where it explains them as well as their own do.
fn joint(terms: &Terms, large: &Grown, small: &Grown) -> Option<(Shape, f64)> {
    let surface = terms.surface;
    let places = |region: &Grown| -> Vec<Point> {
        let mut places = surface.some_places(&region.pieces, ENOUGH);
        places.retain(|&p| region.shape.distance(p).abs() <= terms.band.distance);
        places
    };
    let (one, other) = (places(large), places(small));
    let both: Vec<Point> = one.iter().chain(&other).copied().collect();
    let (shape, _) = improved(&both, &large.shape)?;
    let square =
        |points: &[Point], shape: &Shape| points.iter().map(|&p| shape.distance(p).powi(2)).sum::<f64>();
    let apart = square(&one, &large.shape) + square(&other, &small.shape);
    let together = square(&one, &shape) + square(&other, &shape);
    let count = both.len() as f64;
    let floor = (terms.noise * terms.noise).max(1e-30);
    // The small one counts by itself too: among many points of the large one it would not show.
    let alone = square(&other, &shape) / other.len() as f64;
    let own = square(&other, &small.shape) / other.len() as f64;
    let element = Probe::new(&shape);
    let belong = small.pieces.iter().filter(|&&p| turned(terms, p, &element)).count();
    let fits = together / count <= TELLS * TELLS * (apart / count).max(floor)
        && alone <= 4.0 * own.max(floor)
        && 10 * belong >= 9 * small.pieces.len();
    fits.then(|| (shape, (together / count).sqrt()))
}

/// Whether the piece looks the way the element does.
fn turned(terms: &Terms, piece: u32, element: &Probe) -> bool {
    let i = piece as usize;
    crate::space::dot(terms.surface.normals[i], element.normal(terms.surface.places[i])).abs()
        >= terms.band.cosine
}

/// Pairs of regions that touch, or that one piece of no region lies between.
fn neighbours(terms: &Terms, labels: &[u32]) -> Vec<[u32; 2]> {
    let surface = terms.surface;
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    let mut around: Vec<u32> = Vec::new();
    for piece in 0..surface.len() as u32 {
        around.clear();
        around.extend(surface.neighbours(piece).iter().map(|&n| labels[n as usize]).filter(|&l| l != NONE));
        let own = labels[piece as usize];
        if own != NONE {
            around.retain(|&l| l != own);
            around.insert(0, own);
        }
        around.sort_unstable();
        around.dedup();
        for (i, &a) in around.iter().enumerate() {
            pairs.extend(around[i + 1..].iter().map(|&b| [a, b]));
        }
        if pairs.len() > 1 << 16 {
            pairs.sort_unstable();
            pairs.dedup();
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
