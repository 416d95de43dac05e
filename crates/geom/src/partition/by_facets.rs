//! What the facets of a mesh tell: which face each is of, and where faces are that have no vertices clear of their borders.

use super::best::Candidate;
use super::faces::{Face, Seat};
use super::terms::{Class, NO_FACE};
use super::{FEWEST_SURE, Work};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, Vector, dot, normal, plus, times};

/// Cosine of the angle (15°) up to which a facet faces as its face does.
const PARALLEL: f64 = 0.966;

/// Adds, to the faces with few sure points, the corners of facets that are surely theirs: over the face, facing as it does, and nearer to
/// it than to any other. A mesh with long facets has no vertices but those on edges.
pub(super) fn add(
    scan: &Mesh,
    work: &Work,
    sure: &mut [Vec<Candidate>],
    progress: &dyn Progress,
) -> Result<(), Cancelled> {
    let lacking: Vec<usize> = (0..sure.len()).filter(|f| sure[*f].len() < FEWEST_SURE).collect();
    if scan.faces.is_empty() || lacking.is_empty() {
        return Ok(());
    }
    let bounds: Vec<_> =
        lacking.iter().map(|f| work.faces[*f].bounds.widened(super::AWAY * work.reach[*f])).collect();
    let corners = |f: u32| scan.faces[f as usize].map(|v| work.points[v as usize]);
    let middle = |[a, b, c]: [Point; 3]| times(1.0 / 3.0, plus(a, plus(b, c)));
    let facets: Vec<(u32, Point, Vector)> = (0..scan.faces.len() as u32)
        .into_par_iter()
        .filter_map(|f| {
            let (middle, normal) = (middle(corners(f)), normal(corners(f))?);
            bounds.iter().any(|b| b.holds(&middle)).then_some((f, middle, normal))
        })
        .collect();
    let middles: Vec<Point> = facets.iter().map(|f| f.1).collect();
    let mut nearest: Vec<(f64, usize)> = vec![(f64::INFINITY, usize::MAX); facets.len()];
    for (number, face) in work.faces.iter().enumerate() {
        let reach = super::AWAY * work.reach[number];
        let inside: Vec<usize> =
            (0..middles.len()).filter(|i| face.bounds.widened(reach).holds(&middles[*i])).collect();
        let places: Vec<Point> = inside.iter().map(|i| middles[*i]).collect();
        let seats = face.seats(&places, reach, 0.0, progress)?;
        let is_over = |seat: &Seat, i: usize| dot(seat.normal, facets[i].2) > PARALLEL;
        for (i, seat) in inside.into_iter().zip(seats) {
            if let Some(seat) = seat.filter(|s| is_over(s, i) && s.off.abs() < nearest[i].0) {
                nearest[i] = (seat.off.abs(), number);
            }
        }
    }
    for face in lacking {
        let reach = work.reach[face];
        let own = (facets.iter().zip(&nearest)).filter(|(_, n)| n.1 == face && n.0 <= reach);
        let mut vertices: Vec<u32> = own.flat_map(|(f, _)| scan.faces[f.0 as usize]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let near = work.candidates[face].iter();
        let mut more: Vec<Candidate> =
            near.filter(|c| vertices.binary_search(&c.point).is_ok()).copied().collect();
        if more.len() > sure[face].len() {
            std::mem::swap(&mut sure[face], &mut more);
        }
    }
    Ok(())
}

/// The face of each facet of a mesh: one that explains all its corners, or has them. Of several that which the facet faces as.
pub(super) fn owners(
    scan: &Mesh,
    (owners, classes): (&[u32], &[Class]),
    shared: &[(u32, u32)],
    faces: &[&Face],
) -> Vec<u32> {
    let owner = |v: u32| if classes[v as usize] == Class::Face { owners[v as usize] } else { NO_FACE };
    let of = |v: u32| {
        let first = shared.partition_point(|s| s.0 < v);
        shared[first..].iter().take_while(move |s| s.0 == v).map(|s| s.1)
    };
    let is_of = |v: u32, face: u32| owner(v) == face || of(v).any(|f| f == face);
    let facet = |corners: &[u32; 3]| {
        let [a, b, c] = *corners;
        let own = owner(a);
        let all = of(a).chain((own != NO_FACE).then_some(own));
        let mut fit: Vec<u32> = all.filter(|f| is_of(b, *f) && is_of(c, *f)).collect();
        fit.sort_unstable();
        fit.dedup();
        if fit.len() < 2 {
            return fit.first().copied().unwrap_or(NO_FACE);
        }
        let places = corners.map(|v| scan.positions[v as usize]);
        let facing = normal(places).unwrap_or_default();
        let middle = times(1.0 / 3.0, plus(places[0], plus(places[1], places[2])));
        let along = |f: &u32| faces[*f as usize].facing(&middle).map_or(-1.0, |n| dot(n, facing));
        fit.into_iter().max_by(|a, b| along(a).total_cmp(&along(b)).then(b.cmp(a))).unwrap_or(NO_FACE)
    };
    scan.faces.par_iter().map(facet).collect()
}
