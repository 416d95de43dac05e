//! All facets of a mesh, cut where they meet.

use super::cluster::{Cluster, Crossing, Cut, Line, plane_of};
use super::cut::{Piece, Pieces, along, cut};
use super::error::ArrangeError;
use super::meetings::{Edge, Meeting, Name, meeting};
use super::points::{ExactPoint, Points};
use std::collections::BTreeSet;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::topology::Topology;
use trueness_geom::topology::union::Sets;

/// The pieces of a mesh.
pub(super) struct Cutting<'a> {
    pub points: Points<'a>,
    /// Facets that nothing cuts first, in their order; then the pieces of the others.
    pub pieces: Vec<Piece>,
    /// Further facets of a piece, and whether they run the same way round.
    pub further: Vec<(usize, u32, bool)>,
}

/// Points on the edges of the mesh: for each edge in turn its points from the lower vertex to the higher one.
struct EdgePoints(Vec<(Edge, Vec<u32>)>);

impl EdgePoints {
    /// From pairs in any order.
    fn of(mut pairs: Vec<(Edge, u32)>) -> EdgePoints {
        pairs.par_sort_unstable();
        pairs.dedup();
        let chunks = pairs.chunk_by(|a, b| a.0 == b.0);
        EdgePoints(chunks.map(|c| (c[0].0, c.iter().map(|p| p.1).collect())).collect())
    }

    fn at(&self, e: Edge) -> &[u32] {
        self.0.binary_search_by_key(&e, |p| p.0).map_or(&[], |i| &self.0[i].1)
    }
}

/// Cuts the facets of a welded mesh where these pairs of them meet.
pub(super) fn cutting<'a>(
    mesh: &'a Mesh,
    topology: &Topology,
    pairs: &[[u32; 2]],
    progress: &dyn Progress,
) -> Result<Cutting<'a>, ArrangeError> {
    let stopped = || if progress.cancelled() { Err(Cancelled) } else { Ok(()) };
    stopped()?;
    let meetings: Vec<Meeting> = pairs.par_iter().map(|pair| meeting(mesh, *pair)).collect();
    let mut points = Points::new(&mesh.positions, &corners_of(mesh, pairs));
    let names = Names::of(mesh, &meetings, &mut points);
    stopped()?;
    let on_edges = meetings.iter().flat_map(|m| &m.on_edges).map(|(e, name)| (*e, names.number(*name)));
    let mut on_edges: Vec<(Edge, u32)> = on_edges.collect();
    let first_edges = EdgePoints::of(on_edges.clone());
    let mut clusters = clusters(mesh, topology, pairs, &meetings, &names, &first_edges);
    let crossings: Vec<Vec<Crossing>> = clusters
        .par_iter_mut()
        .map(|c| if progress.cancelled() { vec![] } else { c.cross(mesh, &points) })
        .collect();
    stopped()?;
    for (cluster, crossings) in clusters.iter_mut().zip(crossings) {
        for Crossing { segments, place } in crossings {
            let point = points.number_of(place);
            segments.into_iter().for_each(|s| cluster.segments[s].on.push(point));
        }
        for s in &cluster.segments {
            if let Line::Edge(e) = s.line {
                on_edges.extend(s.on.iter().map(|p| (e, *p)));
            }
        }
    }
    on_edges.retain(|(e, p)| !e.contains(p));
    let mut edges = EdgePoints::of(on_edges);
    edges.0.par_iter_mut().for_each(|(e, on)| along(&points, *e, on));
    let of_edge = |e: Edge| edges.at(e).to_vec();
    let cut_one = |c: &Cluster| -> Result<Pieces, ArrangeError> {
        stopped()?;
        let position = || mesh.positions[mesh.faces[c.facets[0] as usize][0] as usize];
        cut(mesh, &points, c, &of_edge).ok_or_else(|| ArrangeError::Unresolved { position: position() })
    };
    let cut: Vec<Pieces> = clusters.par_iter().map(cut_one).collect::<Result<_, _>>()?;
    let mut is_cut = vec![false; mesh.faces.len()];
    clusters.iter().flat_map(|c| &c.facets).for_each(|f| is_cut[*f as usize] = true);
    topology.collinear.iter().for_each(|f| is_cut[*f as usize] = true);
    let whole = (0u32..)
        .zip(&mesh.faces)
        .filter(|(f, _)| !is_cut[*f as usize] && topology.shell_of[*f as usize] != u32::MAX);
    let mut pieces: Vec<Piece> =
        whole.map(|(facet, corners)| Piece { corners: *corners, facet, jump: 1 }).collect();
    let mut further = vec![];
    for part in cut {
        further.extend(part.further.into_iter().map(|(p, f, same)| (p + pieces.len(), f, same)));
        pieces.extend(part.pieces);
    }
    Ok(Cutting { points, pieces, further })
}

/// The corners of these facets.
fn corners_of(mesh: &Mesh, pairs: &[[u32; 2]]) -> Vec<u32> {
    let mut all: Vec<u32> = pairs.iter().flatten().flat_map(|f| mesh.faces[*f as usize]).collect();
    all.par_sort_unstable();
    all.dedup();
    all
}

/// The points that were named, with their numbers.
struct Names(Vec<(Edge, u32, u32)>);

impl Names {
    /// Computes each place that is named once.
    fn of(mesh: &Mesh, meetings: &[Meeting], points: &mut Points) -> Names {
        let named = |m: &Meeting| -> Vec<(Edge, u32)> {
            let pierced = |name: &Name| match name {
                Name::Pierced(e, f) => Some((*e, *f)),
                Name::Vertex(_) => None,
            };
            m.ends.iter().filter_map(pierced).collect()
        };
        let mut names: Vec<(Edge, u32)> = meetings.par_iter().flat_map_iter(named).collect();
        names.par_sort_unstable();
        names.dedup();
        let place = |(e, f): &(Edge, u32)| {
            let ends = mesh.places(e);
            // Its ends lie on either side of the plane.
            ExactPoint::on_line(ends, &plane_of(mesh, *f)).unwrap_or_else(|| ExactPoint::of(ends[0]))
        };
        let places: Vec<ExactPoint> = names.par_iter().map(place).collect();
        let number = |((e, f), place): ((Edge, u32), ExactPoint)| (e, f, points.number_of(place));
        Names(names.into_iter().zip(places).map(number).collect())
    }

    fn number(&self, name: Name) -> u32 {
        match name {
            Name::Vertex(v) => v,
            Name::Pierced(e, f) => {
                let at = self.0.binary_search_by_key(&(e, f), |n| (n.0, n.1));
                at.map_or(u32::MAX, |i| self.0[i].2)
            }
        }
    }
}

/// The facets that are to be cut, by plane, those that overlap together.
fn clusters(
    mesh: &Mesh,
    topology: &Topology,
    pairs: &[[u32; 2]],
    meetings: &[Meeting],
    names: &Names,
    edges: &EdgePoints,
) -> Vec<Cluster> {
    let sets = Sets::new(mesh.faces.len());
    let mut facets: BTreeSet<u32> = pairs.iter().flatten().copied().collect();
    for [a, b] in &topology.duplicate_facets {
        sets.join(*a, *b);
        facets.extend([*a, *b]);
    }
    let mut cuts: Vec<(u32, Cut)> = vec![];
    let mut single: Vec<(u32, u32)> = vec![];
    for (pair, meeting) in pairs.iter().zip(meetings) {
        let [f, g] = *pair;
        if meeting.coplanar {
            sets.join(f, g);
        }
        let mut ends: Vec<u32> = meeting.ends.iter().map(|name| names.number(*name)).collect();
        ends.sort_unstable();
        ends.dedup();
        match ends[..] {
            [a, b] => cuts.extend([(f, (g, [a, b])), (g, (f, [a, b]))]),
            _ => ends.iter().for_each(|p| single.extend([(f, *p), (g, *p)])),
        }
    }
    cuts.par_sort_unstable();
    single.par_sort_unstable();
    let mut members: Vec<(u32, u32)> = facets.into_iter().map(|f| (sets.root(f), f)).collect();
    members.sort_unstable();
    let groups: Vec<Vec<u32>> =
        members.chunk_by(|a, b| a.0 == b.0).map(|g| g.iter().map(|m| m.1).collect()).collect();
    let cluster = |facets: Vec<u32>| {
        let cuts = of_facets(&cuts, &facets);
        let points = of_facets(&single, &facets);
        let on_edge = |e: Edge| edges.at(e).to_vec();
        Cluster::new(mesh, facets, cuts.into_iter(), points.into_iter(), on_edge)
    };
    groups.into_par_iter().map(cluster).collect()
}

/// The entries for these facets in a sorted list.
fn of_facets<T: Copy>(list: &[(u32, T)], facets: &[u32]) -> Vec<T> {
    let of = |f: &u32| {
        let from = list.partition_point(|entry| entry.0 < *f);
        let count = list[from..].partition_point(|entry| entry.0 == *f);
        list[from..from + count].iter().map(|entry| entry.1)
    };
    facets.iter().flat_map(of).collect()
}
