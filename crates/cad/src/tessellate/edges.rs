//! Edges as polylines: one for all faces that an edge bounds.

use super::lines::Fineness;
use crate::brep::Brep;
use crate::trim::{Piece, Trim};
use trueness_geom::space::Point;

/// Places of an edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    /// Shares of the way along the edge, from 0 to 1.
    pub shares: Vec<f64>,
    /// The vertex of the mesh at each.
    pub vertices: Vec<u32>,
    /// How far the edge may be from its chords, millimeters.
    pub off: f64,
}

/// Of the tolerance, what edges take: facets between two edges whose places do not face each other are larger than their sides.
const EDGE_SHARE: f64 = 0.4;
/// The angle between neighboring sides of a polyline at most, whatever is asked for: a circle has seven.
const MAX_ANGLE: f64 = 0.9;
/// Shares of an edge nearer than this are one.
const SAME_SHARE: f64 = 1e-9;
/// A place nearer to one that must be there than this share of the distance to the next is left out.
const APART: f64 = 0.25;

impl Polyline {
    /// The place with a share.
    pub fn index(&self, share: f64) -> usize {
        let i = self.shares.partition_point(|s| *s < share).min(self.shares.len().saturating_sub(1));
        let is_before = i > 0 && share - self.shares[i - 1] < self.shares[i] - share;
        if is_before { i - 1 } else { i }
    }
}

/// Shares at which each edge must have a place: where faces are cut open, and where an edge passes over a pole.
pub fn required(brep: &Brep, trims: &[Option<&Trim>]) -> Vec<Vec<f64>> {
    let mut all: Vec<Vec<f64>> = vec![vec![]; brep.edges.len()];
    for piece in trims.iter().flatten().flat_map(|t| &t.rings).flat_map(|r| &r.pieces) {
        if let Piece::Edge(strand) = piece {
            all[strand.edge as usize].extend(strand.shares());
        }
    }
    for shares in all.iter_mut().filter(|s| !s.is_empty()) {
        shares.extend([0.0, 1.0]);
        shares.sort_by(f64::total_cmp);
        shares.dedup_by(|b, a| *b - *a <= SAME_SHARE);
        if let Some(last) = shares.last_mut() {
            *last = 1.0;
        }
    }
    all
}

/// Shares of an edge for a fineness; all that are required, and so many others that chords keep to the edge.
pub fn shares(brep: &Brep, edge: usize, required: &[f64], fineness: Fineness) -> Vec<f64> {
    if required.is_empty() {
        return vec![];
    }
    let span = &brep.edges[edge].span;
    let [from, to] = span.range;
    let sampled = span.sample(EDGE_SHARE * fineness.distance, fineness.angle.min(MAX_ANGLE));
    let mut own: Vec<f64> = sampled.iter().map(|t| (t - from) / (to - from)).collect();
    own.sort_by(f64::total_cmp);
    let mut all: Vec<f64> = required.to_vec();
    for (i, share) in own.iter().enumerate() {
        let step = |j: Option<usize>| j.and_then(|j| own.get(j)).map_or(f64::INFINITY, |s| (s - share).abs());
        let near = APART * step(i.checked_sub(1)).min(step(Some(i + 1)));
        let after = required.partition_point(|s| s < share);
        let to_required = [after.checked_sub(1), Some(after)]
            .into_iter()
            .flatten()
            .filter_map(|j| required.get(j))
            .map(|s| (s - share).abs())
            .fold(f64::INFINITY, f64::min);
        if to_required > near {
            all.push(*share);
        }
    }
    all.sort_by(f64::total_cmp);
    all
}

/// Numbers of vertices for the places of all edges, and where they are. Ends of edges are vertices of the part.
pub fn numbered(brep: &Brep, shares: Vec<Vec<f64>>) -> (Vec<Polyline>, Vec<Point>) {
    let mut positions: Vec<Point> = vec![];
    let mut corners: Vec<Option<u32>> = vec![None; brep.vertices.len()];
    let mut polylines = vec![];
    for (edge, shares) in brep.edges.iter().zip(shares) {
        let last = shares.len().saturating_sub(1);
        let mut vertices = vec![];
        for (i, share) in shares.iter().enumerate() {
            let corner = match i {
                0 => Some(edge.vertices[0]),
                i if i == last => Some(edge.vertices[1]),
                _ => None,
            };
            let known = corner.and_then(|c| corners.get(c as usize).copied().flatten());
            let vertex = known.unwrap_or_else(|| {
                let own = corner.and_then(|c| brep.vertices.get(c as usize)).map(|v| v.place);
                positions.push(own.unwrap_or_else(|| edge.span.derivatives(*share)[0]));
                (positions.len() - 1) as u32
            });
            if let Some(slot) = corner.and_then(|c| corners.get_mut(c as usize)) {
                *slot = Some(vertex);
            }
            vertices.push(vertex);
        }
        polylines.push(Polyline { off: edge.span.chords_off(&shares), shares, vertices });
    }
    (polylines, positions)
}

/// Adds places to edges; the edges that have more now, ascending.
pub fn insert<'a>(
    brep: &Brep,
    wanted: impl Iterator<Item = &'a (u32, f64)>,
    polylines: &mut [Polyline],
    positions: &mut Vec<Point>,
) -> Vec<u32> {
    let mut touched = vec![];
    for (edge, share) in wanted {
        let own = &mut polylines[*edge as usize];
        let at = own.shares.partition_point(|s| s < share);
        if own.shares.get(at) != Some(share) {
            positions.push(brep.edges[*edge as usize].span.derivatives(*share)[0]);
            own.shares.insert(at, *share);
            own.vertices.insert(at, (positions.len() - 1) as u32);
            touched.push(*edge);
        }
    }
    touched.sort_unstable();
    touched.dedup();
    for edge in &touched {
        let own = &mut polylines[*edge as usize];
        own.off = brep.edges[*edge as usize].span.chords_off(&own.shares);
    }
    touched
}
