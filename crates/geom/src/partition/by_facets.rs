//! The evidence of the facets of a mesh: the face of each, and faces that have no vertices clear of their borders.

use super::best::{Best, Candidate};
use super::cut::NO_FACE;
use super::faces::{Face, Seat};
use super::facing::Facing;
use super::terms::{Class, EXPLAINED_SIGMAS};
use super::work::{MIN_SURE_POINTS, SEARCH_REACHES, Work};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::{Point, Vector, dot, plus, times};

/// Cosine of the angle (15°) up to which a facet faces as its face does.
const FACING_FACET_COSINE: f64 = 0.966;

/// Adds, to the faces with few sure points, the corners of facets that are surely theirs. Such a facet lies over the face,
/// faces as it does, and is nearer to it than to any other. A mesh with long facets has no vertices but those on edges.
pub(super) fn add(
    scan: &Mesh,
    (work, facing): (&Work, &Facing),
    sure: &mut [Vec<Candidate>],
    progress: &dyn Progress,
) -> Result<(), Cancelled> {
    let lacking: Vec<usize> = (0..sure.len()).filter(|f| sure[*f].len() < MIN_SURE_POINTS).collect();
    if lacking.is_empty() {
        return Ok(());
    }
    let bounds: Vec<_> =
        lacking.iter().map(|f| work.faces[*f].bounds.widened(SEARCH_REACHES * work.reach[*f])).collect();
    let corners = |f: u32| scan.faces[f as usize].map(|v| work.points[v as usize]);
    let middle = |[a, b, c]: [Point; 3]| times(1.0 / 3.0, plus(a, plus(b, c)));
    let facets: Vec<(u32, Point, Vector)> = (0..scan.faces.len() as u32)
        .into_par_iter()
        .filter_map(|f| {
            let middle = middle(corners(f));
            bounds.iter().any(|b| b.holds(&middle)).then_some((f, middle, facing.facets[f as usize]))
        })
        .collect();
    let middles: Vec<Point> = facets.iter().map(|f| f.1).collect();
    let mut nearest: Vec<(f64, usize)> = vec![(f64::INFINITY, usize::MAX); facets.len()];
    for (number, face) in work.faces.iter().enumerate() {
        let reach = SEARCH_REACHES * work.reach[number];
        let inside: Vec<usize> =
            (0..middles.len()).filter(|i| face.bounds.widened(reach).holds(&middles[*i])).collect();
        let places: Vec<Point> = inside.iter().map(|i| middles[*i]).collect();
        let seats = face.seats(&places, reach, 0.0, progress)?;
        let is_over = |seat: &Seat, i: usize| dot(seat.normal(), facets[i].2) > FACING_FACET_COSINE;
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

/// Whether facets of a mesh straddle the edges of its part, as those of a scan do. Then more of them straddle than it has
/// vertices on edges. The facets of a computed mesh end there.
pub(super) fn straddle_edges(
    scan: &Mesh,
    best: &Best,
    shared: &[(u32, u32)],
    (faces, facing): (&[&Face], &Facing),
) -> bool {
    let explained = |v: u32| best.cost[v as usize] <= EXPLAINED_SIGMAS;
    let class = |v: usize| if explained(v as u32) { Class::Face } else { Class::Beyond };
    let classes: Vec<Class> = (0..best.owner.len()).map(class).collect();
    let owners = owners(scan, (&best.owner, &classes), shared, (faces, facing));
    let straddles = |(f, own): (&[u32; 3], &u32)| *own == NO_FACE && f.iter().all(|v| explained(*v));
    let straddling = scan.faces.iter().zip(&owners).filter(|f| straddles(*f)).count();
    let is_on_edge = |v: &u32| {
        let mut about = facing.about(*v).iter().map(|f| owners[*f as usize]).filter(|own| *own != NO_FACE);
        about.next().is_some_and(|first| about.any(|own| own != first))
    };
    let on_edges = (0..best.owner.len() as u32).filter(is_on_edge).count();
    straddling > on_edges
}

/// The face of each facet of a mesh: one that explains all its corners, or has them, and of which it is no wall. The face, out
/// of several, that the facet faces as.
pub(super) fn owners(
    scan: &Mesh,
    (owners, classes): (&[u32], &[Class]),
    shared: &[(u32, u32)],
    (faces, facing): (&[&Face], &Facing),
) -> Vec<u32> {
    let is_of_face = |v: u32| matches!(classes[v as usize], Class::Face | Class::Dent);
    let owner = |v: u32| if is_of_face(v) { owners[v as usize] } else { NO_FACE };
    let of = |v: u32| {
        let first = shared.partition_point(|s| s.0 < v);
        shared[first..].iter().take_while(move |s| s.0 == v).map(|s| s.1)
    };
    let is_of = |v: u32, face: u32| owner(v) == face || of(v).any(|f| f == face);
    let facet = |(number, corners): (usize, &[u32; 3])| {
        let [a, b, c] = *corners;
        let own = owner(a);
        let all = of(a).chain((own != NO_FACE).then_some(own));
        let mut fit: Vec<u32> = all.filter(|f| is_of(b, *f) && is_of(c, *f)).collect();
        fit.sort_unstable();
        fit.dedup();
        let places = scan.places(corners);
        let middle = times(1.0 / 3.0, plus(places[0], plus(places[1], places[2])));
        let out = |face: u32| faces[face as usize].facing(&middle).unwrap_or_default();
        let all = fit.into_iter().map(|face| (face, out(face)));
        let all = all.filter(|(_, normal)| facing.is_along(number as u32, *normal));
        let all = all.map(|(face, normal)| (face, dot(facing.facets[number], normal)));
        all.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0))).map_or(NO_FACE, |best| best.0)
    };
    scan.faces.par_iter().enumerate().map(facet).collect()
}
