//! The reference as it is drawn: pieces as large as the points are apart, each vertex with the worst point near it.

use super::super::coverage::Coverage;
use super::bisection::{Edges, edges, half_corners, half_edges, half_weights, in_second, longest};
use super::creases;
use super::facet::place;
use super::fill::fill;
use super::point_map::{Flagged, PointMap, worse};
use crate::spacing::spacing;
use std::collections::HashMap;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Point, cross, dot, minus, norm};

/// Longest edge of a drawn piece over the spacing of the points: there are then about as many vertices as points.
const EDGE_PER_SPACING: f64 = 1.7;
/// How far, in spacings, a place may be from the nearest one with points of its own.
const REACH_PER_SPACING: f64 = 3.0;
/// A point says nothing about places farther away than this share of the reference's diagonal, however few there are.
const MAX_REACH_DIAGONAL_SHARE: f64 = 0.02;
/// Facets up to which creases part the values: with more, pieces are so small that it cannot be seen.
const MAX_CREASED_FACETS: usize = 200_000;

/// A surface to draw, with one value a vertex.
pub struct MapSurface {
    /// The refined surface; `None` where the reference itself is fine enough, and the values are for its vertices.
    pub mesh: Option<Mesh>,
    /// Of a refined surface, the facet of the reference that each of its facets is a part of.
    pub facets: Vec<u32>,
    /// Millimeters; NaN where no point is near.
    pub values: Vec<f64>,
    /// Vertices that show flagged points.
    pub keep: Vec<u32>,
    /// Farthest that a shown point's nearest place can be from the vertex that shows it, millimeters.
    pub reach: f64,
    /// How far the points' nearest places lie apart, millimeters.
    pub spacing: f64,
    /// How far deviations go over to places without points, millimeters.
    pub carried: f64,
    /// Area of the surface, square millimeters.
    pub area: f64,
    /// Area of the facets with a corner that has no value, which are drawn gray.
    pub uncovered: f64,
}

/// The surface under construction.
struct Drawing<'a> {
    reference: &'a Mesh,
    map: &'a PointMap,
    /// Square of the longest edge.
    limit: f64,
    positions: Vec<Point>,
    faces: Vec<[u32; 3]>,
    /// The facet of the reference that each of `faces` is a part of.
    facets: Vec<u32>,
    values: Vec<f64>,
    /// Middle of the edge between two vertices. Looked up only, never walked through.
    middles: HashMap<[u32; 2], u32>,
    keep: Vec<u32>,
    /// Farthest that a point's nearest place lies from its vertex so far.
    farthest: f64,
}

/// A piece of a facet, with the flagged points in it and their weights for its corners.
struct Piece {
    node: u32,
    corners: [u32; 3],
    edges: Edges,
    flagged: Vec<(f64, [f64; 3])>,
}

/// A point and the vertex that may show it.
struct Shown {
    vertex: u32,
    deviation: f64,
    /// How far the point's nearest place is from the vertex.
    away: f64,
}

impl MapSurface {
    /// Draws `map` on `reference`; each of `flagged` becomes a vertex of its own.
    ///
    /// Deviations go over to places that are no farther away, along the surface, than `coverage` says.
    pub fn of(reference: &Mesh, map: &PointMap, flagged: &[Flagged], coverage: Coverage) -> MapSurface {
        let found = spacing(&feet(reference, map));
        let apart = match coverage {
            Coverage::Auto => found.min(MAX_REACH_DIAGONAL_SHARE * reference.bounds().diagonal()),
            Coverage::Within(reach) => reach / REACH_PER_SPACING,
        };
        let edge = map.pieces.edge.max(EDGE_PER_SPACING * apart);
        let mut drawing = Drawing::new(reference, map, edge * edge);
        let starts = drawing.starts();
        let mut flags = flagged.to_vec();
        flags.sort_by_key(|f| f.face);
        let mut rest = flags.as_slice();
        let shown: Vec<Option<Shown>> = starts
            .par_iter()
            .enumerate()
            .map(|(face, corners)| drawing.shown(face as u32, *corners, face as u32))
            .collect();
        for ((face, corners), shown) in (0u32..).zip(starts).zip(shown) {
            let here = rest.iter().take_while(|f| f.face == face).count();
            let (mine, others) = rest.split_at(here);
            match mine.is_empty() && map.pieces.halves(face).is_none() {
                true => drawing.whole(face, corners, shown),
                false => drawing.facet(face, corners, mine),
            }
            rest = others;
        }
        let refined = drawing.faces.len() > reference.faces.len();
        let Drawing { positions, faces, facets, mut values, keep, farthest, .. } = drawing;
        let mesh = Mesh { positions, faces };
        fill(&mesh, &mut values, REACH_PER_SPACING * apart);
        let [area, uncovered] = areas(&mesh, &values);
        let reach = farthest + REACH_PER_SPACING * apart;
        let carried = REACH_PER_SPACING * apart;
        MapSurface {
            mesh: refined.then_some(mesh),
            facets: if refined { facets } else { vec![] },
            values,
            keep,
            reach,
            spacing: found,
            carried,
            area,
            uncovered,
        }
    }
}

/// The area of a mesh, and that of its facets with a vertex without a value. Summed in the order of the facets.
fn areas(mesh: &Mesh, values: &[f64]) -> [f64; 2] {
    let (mut all, mut gray) = (0.0, 0.0);
    for f in &mesh.faces {
        let [a, b, c] = f.map(|v| mesh.positions[v as usize]);
        let area = 0.5 * norm(cross(minus(b, a), minus(c, a)));
        // A facet with a coordinate that is not finite is no part of the reference.
        if area.is_finite() {
            all += area;
            gray += if f.iter().any(|v| values[*v as usize].is_nan()) { area } else { 0.0 };
        }
    }
    [all, gray]
}

impl<'a> Drawing<'a> {
    fn new(reference: &'a Mesh, map: &'a PointMap, limit: f64) -> Drawing<'a> {
        Drawing {
            reference,
            map,
            limit,
            positions: reference.positions.clone(),
            faces: Vec::with_capacity(reference.faces.len()),
            facets: Vec::with_capacity(reference.faces.len()),
            values: vec![f64::NAN; reference.positions.len()],
            middles: HashMap::new(),
            keep: vec![],
            farthest: 0.0,
        }
    }

    /// The facets to begin with: those of the reference, parted at creases if any is cut.
    fn starts(&mut self) -> Vec<[u32; 3]> {
        let mesh = self.reference;
        let long =
            |f: &[u32; 3]| edges(f.map(|v| mesh.positions[v as usize])).iter().any(|l| *l > self.limit);
        if mesh.faces.len() > MAX_CREASED_FACETS || !mesh.faces.iter().any(long) {
            return mesh.faces.clone();
        }
        let numbers = creases::corners(mesh);
        let mut vertices = HashMap::new();
        (self.positions, self.values) = (vec![], vec![]);
        let mut vertex = |corner: usize| {
            *vertices.entry(numbers[corner]).or_insert_with(|| {
                self.positions.push(mesh.positions[mesh.faces[corner / 3][corner % 3] as usize]);
                self.values.push(f64::NAN);
                self.values.len() as u32 - 1
            })
        };
        (0..mesh.faces.len()).map(|f| [0, 1, 2].map(|k| vertex(3 * f + k))).collect()
    }

    /// A facet that is not cut, with the point that it shows.
    fn whole(&mut self, face: u32, corners: [u32; 3], shown: Option<Shown>) {
        shown.into_iter().for_each(|shown| self.show(&shown));
        self.faces.push(corners);
        self.facets.push(face);
    }

    /// Cuts a facet and gives the points on it to the vertices.
    fn facet(&mut self, face: u32, corners: [u32; 3], flagged: &[Flagged]) {
        let flagged = flagged.iter().map(|f| (f.deviation, f.weights)).collect();
        let edges = edges(corners.map(|v| self.positions[v as usize]));
        let mut open = vec![Piece { node: face, corners, edges, flagged }];
        while let Some(piece) = open.pop() {
            let cut = longest(&piece.edges);
            match self.map.pieces.halves(piece.node).filter(|_| piece.edges[cut] > self.limit) {
                None => self.place(face, piece),
                Some((nodes, cut)) => {
                    let middle = self.middle(piece.corners[cut], piece.corners[(cut + 1) % 3]);
                    let (second, first) = piece.flagged.iter().partition(|(_, w)| in_second(cut, w));
                    let flagged: [Vec<(f64, [f64; 3])>; 2] = [first, second];
                    for ((node, flagged), second) in nodes.into_iter().zip(flagged).zip([false, true]) {
                        let within = |(d, w)| (d, half_weights(cut, second, w));
                        open.push(Piece {
                            node,
                            corners: half_corners(cut, second, piece.corners, middle),
                            edges: half_edges(cut, second, piece.edges),
                            flagged: flagged.into_iter().map(within).collect(),
                        });
                    }
                }
            }
        }
    }

    fn middle(&mut self, a: u32, b: u32) -> u32 {
        *self.middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            let (p, q) = (self.positions[a as usize], self.positions[b as usize]);
            self.positions.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
            self.values.push(f64::NAN);
            self.values.len() as u32 - 1
        })
    }

    /// A piece that is drawn as it is: its points go to the nearest corner each, and the worst of them stays there.
    fn place(&mut self, face: u32, piece: Piece) {
        let mut open = vec![piece.node];
        while let Some(node) = open.pop() {
            open.extend(self.map.pieces.halves(node).into_iter().flat_map(|(halves, _)| halves));
            let shown = self.shown(face, piece.corners, node);
            shown.into_iter().for_each(|shown| self.show(&shown));
        }
        let mut parts = vec![(piece.corners, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])];
        for (deviation, weights) in piece.flagged {
            self.flag(&mut parts, piece.corners, deviation, weights);
        }
        self.facets.extend(std::iter::repeat_n(face, parts.len()));
        self.faces.extend(parts.into_iter().map(|(corners, _)| corners));
    }

    /// The point that a node holds, for the nearest of the corners.
    fn shown(&self, face: u32, corners: [u32; 3], node: u32) -> Option<Shown> {
        let kept = self.map.worst[node as usize];
        if kept.deviation.is_nan() {
            return None;
        }
        let foot = place(self.reference, face, kept.weights());
        let away = corners.map(|v| norm(minus(foot, self.positions[v as usize])));
        let k = (1..3).fold(0, |best, k| if away[k] < away[best] { k } else { best });
        Some(Shown { vertex: corners[k], deviation: kept.deviation, away: away[k] })
    }

    /// Gives a point to its vertex, where it stays if it is the worst; of equally bad ones the first.
    fn show(&mut self, shown: &Shown) {
        self.farthest = self.farthest.max(shown.away);
        let value = &mut self.values[shown.vertex as usize];
        if worse(shown.deviation, *value, self.map.tolerance) {
            *value = shown.deviation;
        }
    }

    /// Makes a flagged point a vertex: the part that holds it becomes three.
    fn flag(&mut self, parts: &mut Vec<Part>, corners: [u32; 3], deviation: f64, weights: [f64; 3]) {
        let at = |k: usize| (0..3).map(|j| weights[j] * self.positions[corners[j] as usize][k]).sum();
        self.positions.push([0, 1, 2].map(at));
        self.values.push(deviation);
        let vertex = self.values.len() as u32 - 1;
        self.keep.push(vertex);
        let inside = |(_, w): &Part| least_share(w, weights);
        let holding = (0..parts.len()).max_by(|a, b| inside(&parts[*a]).total_cmp(&inside(&parts[*b])));
        let Some((corners, w)) = holding.map(|h| parts.swap_remove(h)) else { return };
        for k in 0..3 {
            let (mut c, mut ws) = (corners, w);
            (c[k], ws[k]) = (vertex, weights);
            parts.push((c, ws));
        }
    }
}

/// A part of a piece: its vertices, and their weights for the piece's corners.
type Part = ([u32; 3], [[f64; 3]; 3]);

/// The least of the weights that a place has for a part's corners; below zero outside. −1 for a part without area.
fn least_share(part: &[[f64; 3]; 3], place: [f64; 3]) -> f64 {
    let whole = dot(part[0], cross(part[1], part[2]));
    let share = |k: usize| {
        let mut moved = *part;
        moved[k] = place;
        dot(moved[0], cross(moved[1], moved[2])) / whole
    };
    if whole.abs() > 0.0 { share(0).min(share(1)).min(share(2)) } else { -1.0 }
}

/// The nearest places of the points that the pieces show.
fn feet(reference: &Mesh, map: &PointMap) -> Vec<Point> {
    const POINTS_PER_CHUNK: usize = 1 << 10;
    let count = reference.faces.len();
    let of = |part: usize| -> Vec<Point> {
        let (mut open, mut feet) = (vec![], vec![]);
        for face in (part * POINTS_PER_CHUNK..count.min((part + 1) * POINTS_PER_CHUNK)).map(|f| f as u32) {
            open.push(face);
            while let Some(node) = open.pop() {
                open.extend(map.pieces.halves(node).into_iter().flat_map(|(halves, _)| halves));
                let kept = map.worst[node as usize];
                if !kept.deviation.is_nan() {
                    feet.push(place(reference, face, kept.weights()));
                }
            }
        }
        feet
    };
    (0..count.div_ceil(POINTS_PER_CHUNK)).into_par_iter().flat_map_iter(of).collect()
}
