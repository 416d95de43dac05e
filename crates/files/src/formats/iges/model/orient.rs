//! The sense of loops that a file gives none.
//!
//! A loop that closes in the parameters bounds an area by itself: the face lies within the outer one, outside of the others. Loops that go around a
//! surface that closes bound it together; those senses are taken that bound an area.

use super::loose::{Loose, edges_of};
use crate::formats::brep::reversed;
use trueness_cad::brep::{Bounds, Brep, Face, Loop};
use trueness_cad::measure::Integrals;
use trueness_cad::trim::Trim;

/// Loops whose senses are tried together.
const MAX_TRIED: usize = 6;

/// Gives the loops of a face their sense. Loops that bound nothing stay as they are, and are told where the face is trimmed.
pub(super) fn orient(brep: &mut Brep, loose: &Loose, tolerance: f64) {
    let Some(face) = brep.faces.get(loose.face as usize) else { return };
    let Bounds::Loops(loops) = &face.bounds else { return };
    let found = match &loops[..] {
        [_] => single(brep, face, tolerance),
        _ => several(brep, face, loops, loose.outer, tolerance),
    };
    if let (Some(found), Some(face)) = (found, brep.faces.get_mut(loose.face as usize)) {
        face.bounds = Bounds::Loops(found);
    }
}

fn with(face: &Face, loops: Vec<Loop>) -> Face {
    Face { bounds: Bounds::Loops(loops), ..face.clone() }
}

/// The one loop of a face.
fn single(brep: &Brep, face: &Face, tolerance: f64) -> Option<Vec<Loop>> {
    let Bounds::Loops(loops) = &face.bounds else { return None };
    let trim = Trim::new(brep, face, tolerance).ok()?;
    let turned: Vec<Loop> = loops.iter().cloned().map(reversed).collect();
    if trim.turned {
        return Some(turned);
    }
    // The sides of a seam lie within the face. On a sphere or a torus both senses bound something.
    let mut edges = edges_of(face);
    edges.sort_unstable();
    let seam = edges.windows(2).find(|w| w[0] == w[1]).and_then(|w| brep.edges.get(w[0] as usize))?;
    let at = face.surface.parameters(seam.span.derivatives(0.5)[0], None);
    let other = Trim::new(brep, &with(face, turned.clone()), tolerance).ok()?;
    (!other.turned && !trim.contains(at) && other.contains(at)).then_some(turned)
}

/// A loop alone: with the sense that bounds the lesser area, and this area.
fn alone(brep: &Brep, face: &Face, own: &Loop, tolerance: f64) -> Option<(Loop, f64)> {
    let area = |around: Loop| {
        let trim = Trim::new(brep, &with(face, vec![around.clone()]), tolerance).ok()?;
        (!trim.turned).then(|| (around, Integrals::of(&trim, [0.0; 3]).area))
    };
    match (area(own.clone()), area(reversed(own.clone()))) {
        (Some(a), Some(b)) => Some(if b.1 < a.1 { b } else { a }),
        (a, b) => a.or(b),
    }
}

/// Several loops of a face.
fn several(
    brep: &Brep,
    face: &Face,
    loops: &[Loop],
    outer: Option<usize>,
    tolerance: f64,
) -> Option<Vec<Loop>> {
    let known: Vec<Option<(Loop, f64)>> = loops.iter().map(|l| alone(brep, face, l, tolerance)).collect();
    let unknown: Vec<usize> = (0..loops.len()).filter(|k| known[*k].is_none()).collect();
    let area = |k: &usize| known[*k].as_ref().map_or(0.0, |(_, area)| *area);
    // Loops that go around are the outer ones.
    let largest = || (0..loops.len()).max_by(|a, b| area(a).total_cmp(&area(b)));
    let outer = if unknown.is_empty() { outer.or_else(largest) } else { None };
    let mut own: Vec<Loop> = vec![];
    for (k, around) in loops.iter().enumerate() {
        own.push(match &known[k] {
            Some((inside, _)) if outer == Some(k) => inside.clone(),
            Some((inside, _)) => reversed(inside.clone()),
            None => around.clone(),
        });
    }
    if unknown.is_empty() {
        return Some(own);
    }
    if unknown.len() > MAX_TRIED {
        return None;
    }
    (0..1 << unknown.len()).find_map(|senses: usize| {
        let mut tried = own.clone();
        for (bit, k) in unknown.iter().enumerate() {
            if senses >> bit & 1 == 1 {
                tried[*k] = reversed(tried[*k].clone());
            }
        }
        let trim = Trim::new(brep, &with(face, tried.clone()), tolerance).ok()?;
        (!trim.turned).then_some(tried)
    })
}
