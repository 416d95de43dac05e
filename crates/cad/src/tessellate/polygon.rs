//! Rings of a face as polygons whose corners are shared with other faces.

use super::edges::Polyline;
use crate::trim::{Piece, Side, Straight, Trim};
use std::collections::BTreeMap;
use trueness_geom::space::Point;

/// What a vertex of a face is in the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A vertex that edges share.
    Shared(u32),
    /// Of this face alone.
    Own(Point),
}

/// What lies between two corners of a polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Between {
    /// A part of an edge, between two of its shares.
    Edge(u32, [f64; 2]),
    /// A side of a cut.
    Cut,
    /// A side that is one place.
    Pole,
    /// Anything else that is straight.
    Other,
}

/// A corner, and what goes on from it.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    pub at: [f64; 2],
    /// The vertex of the face.
    pub vertex: usize,
    pub next: Between,
}

/// The polygons of a face and its vertices so far.
pub struct Polygons {
    pub rings: Vec<Vec<Corner>>,
    pub vertices: Vec<Source>,
    /// Vertices at which the parameter of that number may be any.
    pub poles: Vec<(usize, usize)>,
}

struct Builder<'a> {
    trim: &'a Trim,
    polylines: &'a [Polyline],
    lines: &'a [Vec<f64>; 2],
    vertices: Vec<Source>,
    shared: BTreeMap<u32, usize>,
    poles: BTreeMap<Side, usize>,
    /// Places of cuts: both sides of one have the same.
    places: BTreeMap<[i64; 2], usize>,
}

/// Places of a cut are the same within this part of a period, or of the window.
const STEPS: f64 = (1 << 20) as f64;
/// A line is left out nearer to the end of a cut than this share of the distance to the next line.
const APART: f64 = 0.283_1;

/// Polygons with a corner at each place of the polylines of edges, and along cuts at each of the lines.
pub fn polygons(trim: &Trim, polylines: &[Polyline], lines: &[Vec<f64>; 2]) -> Polygons {
    let mut builder = Builder {
        trim,
        polylines,
        lines,
        vertices: vec![],
        shared: BTreeMap::new(),
        poles: BTreeMap::new(),
        places: BTreeMap::new(),
    };
    builder.find_poles();
    let rings = trim.rings.iter().map(|ring| builder.ring(&ring.pieces)).collect();
    let poles = builder.poles.iter().map(|((k, _), vertex)| (1 - k, *vertex)).collect();
    Polygons { rings, vertices: builder.vertices, poles }
}

impl Builder<'_> {
    fn new_vertex(&mut self, source: Source) -> usize {
        self.vertices.push(source);
        self.vertices.len() - 1
    }

    fn shared_vertex(&mut self, vertex: u32) -> usize {
        if let Some(own) = self.shared.get(&vertex) {
            return *own;
        }
        let own = self.new_vertex(Source::Shared(vertex));
        self.shared.insert(vertex, own);
        own
    }

    /// The vertex of each pole: that of an edge that ends there, if there is one.
    fn find_poles(&mut self) {
        let trim = self.trim;
        for strand in trim
            .rings
            .iter()
            .flat_map(|r| &r.pieces)
            .filter_map(|p| if let Piece::Edge(s) = p { Some(s) } else { None })
        {
            for (side, share) in strand.poles.iter().zip(strand.shares()) {
                if let Some(side) = side {
                    let polyline = &self.polylines[strand.edge as usize];
                    let vertex = polyline.vertices[polyline.index(share)];
                    let own = self.shared_vertex(vertex);
                    self.poles.entry(*side).or_insert(own);
                }
            }
        }
    }

    fn pole(&mut self, (k, end): Side) -> usize {
        if let Some(own) = self.poles.get(&(k, end)) {
            return *own;
        }
        let place = self.trim.chart.poles[k][end].unwrap_or([f64::NAN; 3]);
        let own = self.new_vertex(Source::Own(place));
        self.poles.insert((k, end), own);
        own
    }

    /// The vertex at a place without an edge: one for both sides of a cut.
    fn place(&mut self, at: [f64; 2]) -> usize {
        let key = [0, 1].map(|k| {
            let [from, to] = self.trim.window[k];
            match (self.trim.chart.periods[k], self.trim.cuts[k]) {
                (Some(period), Some(cut)) => {
                    (((at[k] - cut) / period * STEPS).round() as i64).rem_euclid(STEPS as i64)
                }
                _ => ((at[k] - from) / (to - from) * STEPS).round() as i64,
            }
        });
        if let Some(own) = self.places.get(&key) {
            return *own;
        }
        let own = self.new_vertex(Source::Own(self.trim.chart.place(at)));
        self.places.insert(key, own);
        own
    }

    fn ring(&mut self, pieces: &[Piece]) -> Vec<Corner> {
        let mut ring: Vec<Corner> = vec![];
        for (i, piece) in pieces.iter().enumerate() {
            let before = &pieces[(i + pieces.len() - 1) % pieces.len()];
            let after = &pieces[(i + 1) % pieces.len()];
            match piece {
                Piece::Edge(strand) => self.along_edge(strand, &mut ring),
                Piece::Straight { ends: [from, to], kind } => {
                    let vertex = match (before, kind) {
                        (_, Straight::Pole(side)) => self.pole(*side),
                        (Piece::Straight { kind: Straight::Pole(side), .. }, _) => self.pole(*side),
                        (Piece::Edge(strand), _) => self.end_of(strand, 1),
                        _ => self.place(*from),
                    };
                    let next = match kind {
                        Straight::Pole(_) => Between::Pole,
                        Straight::Cut(_) => Between::Cut,
                        Straight::Joint | Straight::Side => Between::Other,
                    };
                    let is_nothing = *kind == Straight::Joint
                        && matches!(after, Piece::Edge(strand) if self.end_of(strand, 0) == vertex);
                    if is_nothing {
                        continue;
                    }
                    ring.push(Corner { at: *from, vertex, next });
                    if matches!(kind, Straight::Cut(_) | Straight::Side) {
                        for at in self.between(*from, *to) {
                            let vertex = self.place(at);
                            ring.push(Corner { at, vertex, next });
                        }
                    }
                }
            }
        }
        ring
    }

    /// The vertex at the start (0) or the end (1) of a strand.
    fn end_of(&mut self, strand: &crate::trim::Strand, end: usize) -> usize {
        if let Some(side) = strand.poles[end] {
            return self.pole(side);
        }
        let polyline = &self.polylines[strand.edge as usize];
        let vertex = polyline.vertices[polyline.index(strand.shares()[end])];
        self.shared_vertex(vertex)
    }

    fn along_edge(&mut self, strand: &crate::trim::Strand, ring: &mut Vec<Corner>) {
        let polyline = &self.polylines[strand.edge as usize];
        let [from, to] = strand.shares().map(|s| polyline.index(s));
        let order: Vec<usize> = if to >= from { (from..=to).collect() } else { (to..=from).rev().collect() };
        for w in order.windows(2) {
            let shares = [polyline.shares[w[0]], polyline.shares[w[1]]];
            let at = if w[0] == from {
                strand.ends()[0]
            } else {
                strand.at(&self.trim.chart, &self.trim.spans[strand.slot], shares[0])
            };
            let vertex = match strand.poles[0] {
                Some(side) if w[0] == from => self.pole(side),
                _ => self.shared_vertex(polyline.vertices[w[0]]),
            };
            ring.push(Corner { at, vertex, next: Between::Edge(strand.edge, shares) });
        }
    }

    /// Places on lines between two others that differ in one parameter.
    fn between(&self, from: [f64; 2], to: [f64; 2]) -> Vec<[f64; 2]> {
        let k = usize::from((to[1] - from[1]).abs() > (to[0] - from[0]).abs());
        let lines = &self.lines[k];
        let (low, high) = (from[k].min(to[k]), from[k].max(to[k]));
        let mut inner: Vec<[f64; 2]> = vec![];
        for i in lines.partition_point(|x| *x <= low)..lines.partition_point(|x| *x < high) {
            let x = lines[i];
            let step =
                |j: Option<usize>| j.and_then(|j| lines.get(j)).map_or(f64::INFINITY, |y| (y - x).abs());
            let near = APART * step(i.checked_sub(1)).min(step(Some(i + 1)));
            if x - low > near && high - x > near {
                let mut at = from;
                at[k] = x;
                inner.push(at);
            }
        }
        if to[k] < from[k] {
            inner.reverse();
        }
        inner
    }
}
