//! Planes of a drawn mesh that are only the chords of a curved face.

use super::flood::{Marks, flood};
use super::pieces::{NO_PIECE, PieceGraph};
use crate::space::{Vector, cross, dot, minus, norm};
use std::collections::BTreeMap;

/// Planes in a row from which on they are chords: a chamfer with the adjacent planes makes three.
const MIN_CHORDS_IN_ROW: usize = 4;
/// Facets looked at for them.
const MAX_ROW_FACETS: usize = 64;
/// Least quotient of the areas of neighbors that are about equally wide.
const MIN_CHORD_LIKENESS: f64 = 0.8;
/// Share by which equal turns may differ.
const MAX_TURN_DIFFERENCE: f64 = 0.02;
/// Cosine of the angle below which planes are two: 0.08°.
const ONE_PLANE_COSINE: f64 = 1.0 - 1e-6;

/// Whether some facets in a plane are one of several in a row that run into each other: chords of a curved face.
pub(super) fn is_chord(surface: &PieceGraph, facets: &[u32], crease: f64, marks: &mut Marks) -> bool {
    like_planes(surface, facets, crease, marks) >= MIN_CHORDS_IN_ROW
        || turning_planes(surface, facets, crease) >= MIN_CHORDS_IN_ROW
}

/// The planes, with that of some facets, that run into each other and are about equally wide.
fn like_planes(surface: &PieceGraph, facets: &[u32], crease: f64, marks: &mut Marks) -> usize {
    let across = |a: u32, b: u32| dot(surface.normals[a as usize], surface.normals[b as usize]);
    let near = flood(surface, facets, MAX_ROW_FACETS, marks, |piece, from| {
        let turn = across(piece, from);
        // Areas of facets with a side in common are as their widths, whatever their lengths.
        turn >= ONE_PLANE_COSINE || turn >= crease && surface.likeness(piece, from) >= MIN_CHORD_LIKENESS
    });
    let mut planes: Vec<u32> = vec![];
    for piece in near {
        if planes.iter().all(|p| across(*p, piece) < ONE_PLANE_COSINE) {
            planes.push(piece);
        }
    }
    planes.len()
}

/// The planes, with that of some facets, that turn one after the other by the same angle about the same direction, to both sides. A plane that
/// runs into a fillet as a tangent turns by half of what the chords there do.
fn turning_planes(surface: &PieceGraph, facets: &[u32], crease: f64) -> usize {
    // Facets with the last turn before them, the facet where they left the plane, and the planes from there on.
    let mut reached: Vec<(u32, Option<Vector>, u32, usize)> =
        facets.iter().map(|f| (*f, None, NO_PIECE, 0)).collect();
    let mut next = 0;
    while let Some((from, last, way, planes)) = reached.get(next).copied() {
        next += 1;
        for &piece in surface.neighbors(from) {
            if reached.len() >= MAX_ROW_FACETS || reached.iter().any(|r| r.0 == piece) {
                continue;
            }
            let [own, other] = [from, piece].map(|p| surface.normals[p as usize]);
            let (cosine, turn) = (dot(own, other), cross(own, other));
            let goes_on = |last: Vector| norm(minus(turn, last)) <= MAX_TURN_DIFFERENCE * norm(last);
            if cosine >= ONE_PLANE_COSINE {
                reached.push((piece, last, way, planes));
            } else if cosine >= crease && last.is_none_or(goes_on) {
                reached.push((piece, Some(turn), if way == NO_PIECE { piece } else { way }, planes + 1));
            }
        }
    }
    let mut ways: BTreeMap<u32, usize> = BTreeMap::new();
    for (_, _, way, planes) in reached {
        let most = ways.entry(way).or_insert(0);
        *most = planes.max(*most);
    }
    let mut most: Vec<usize> = ways.into_values().collect();
    most.sort_unstable_by(|a, b| b.cmp(a));
    1 + most.iter().take(2).sum::<usize>()
}
