//! Spreading over neighbours.

use super::surface::Surface;
use crate::space::dot;

/// Which pieces were looked at; kept between floods so that a small one costs little on a large surface.
#[derive(Debug)]
pub(super) struct Marks {
    seen: Vec<bool>,
    touched: Vec<u32>,
}

impl Marks {
    pub(super) fn new(surface: &Surface) -> Marks {
        Marks { seen: vec![false; surface.len()], touched: Vec::new() }
    }
    /// Whether this is the first time since the last flood.
    fn first(&mut self, piece: u32) -> bool {
        let fresh = !self.seen[piece as usize];
        if fresh {
            self.seen[piece as usize] = true;
            self.touched.push(piece);
        }
        fresh
    }
    fn clear(&mut self) {
        for piece in self.touched.drain(..) {
            self.seen[piece as usize] = false;
        }
    }
}

/// The pieces reached from `starts` over neighbours for which `accept` says yes, nearest rings first, until there are
/// `most`. `accept` gets the piece and the one it is reached from.
pub(super) fn flood(
    surface: &Surface,
    starts: &[u32],
    most: usize,
    marks: &mut Marks,
    accept: impl Fn(u32, u32) -> bool,
) -> Vec<u32> {
    let mut reached: Vec<u32> = Vec::new();
    for &start in starts {
        if reached.len() < most && marks.first(start) && accept(start, start) {
            reached.push(start);
        }
    }
    let mut next = 0;
    'spread: while next < reached.len() {
        let from = reached[next];
        next += 1;
        for &piece in surface.neighbours(from) {
            if reached.len() >= most {
                break 'spread;
            }
            if marks.first(piece) && accept(piece, from) {
                reached.push(piece);
            }
        }
    }
    marks.clear();
    reached
}

/// The pieces for which `free` says yes in the first two rings around `pieces`, the inner ring first.
pub(super) fn rings(
    surface: &Surface,
    pieces: &[u32],
    marks: &mut Marks,
    free: impl Fn(u32) -> bool,
) -> Vec<u32> {
    for &piece in pieces {
        marks.first(piece);
    }
    let mut ring = |from: &[u32]| -> Vec<u32> {
        let around = from.iter().flat_map(|&p| surface.neighbours(p)).copied();
        around.filter(|&p| marks.first(p) && free(p)).collect()
    };
    let mut found = ring(pieces);
    let outer = ring(&found);
    found.extend(outer);
    marks.clear();
    found
}

/// About `most` free pieces around `seed` without a crease between neighbours.
pub(super) fn patch(
    surface: &Surface,
    seed: u32,
    most: usize,
    crease: f64,
    marks: &mut Marks,
    free: impl Fn(u32) -> bool,
) -> Vec<u32> {
    flood(surface, &[seed], most, marks, |piece, from| {
        let across = dot(surface.normals[piece as usize], surface.normals[from as usize]).abs();
        surface.counts(piece) && free(piece) && across >= crease
    })
}
