//! Facets of one face.

use super::bend::{Bend, Bound};
use super::edges::Polyline;
use super::lines::{Fineness, lines, nodes};
use super::polygon::{Between, Corner, Polygons, Source, polygons};
use crate::stop::go_on;
use crate::trim::{Piece, Straight, Trim};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, PositionInTriangulation, Triangulation};
use std::collections::BTreeMap;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, norm};

/// Facets of a face, with corners among its own vertices.
pub struct FaceFacets {
    pub vertices: Vec<Source>,
    pub facets: Vec<[usize; 3]>,
    pub parameters: Vec<[[f64; 2]; 3]>,
    pub bound: Bound,
}

/// What becomes of a face.
pub enum Outcome {
    Done(FaceFacets),
    /// Edges need places at these shares first; with the facets as they are without.
    Finer(Vec<(u32, f64)>, Option<FaceFacets>),
    Failed(&'static str),
    /// More facets than are allowed: about that many.
    TooMany(usize),
}

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// Of the square of the tolerance, what heights over the surface may take at least, however coarse the edges are.
const HEIGHTS_AT_LEAST: f64 = 0.25;
/// Rounds in which facets that are too far from the surface are cut.
const MAX_ROUNDS: usize = 10;
/// Doublings of the lines of a face whose cuts need more places.
const MAX_DOUBLINGS: usize = 4;
/// Nothing is added nearer to an edge or vertex than this share of a cell: between them facets would be needles.
const APART: f64 = 0.3;

/// A triangulation in parameters scaled to cells.
struct Work<'a> {
    trim: &'a Trim,
    bend: &'a Bend<'a>,
    scale: [f64; 2],
    cdt: Cdt,
    /// For each vertex of the triangulation its parameters and the vertex of the face.
    corners: Vec<([f64; 2], usize)>,
    vertices: Vec<Source>,
    /// The parameter that is any number at a vertex of the face.
    free: BTreeMap<usize, usize>,
    /// How often each side is a side of a polygon, and what it is.
    sides: BTreeMap<[usize; 2], (u32, Between)>,
    positions: &'a [Point],
}

/// Facets of a face within a fineness; at most `most`.
pub fn facets(
    trim: &Trim,
    (polylines, positions): (&[Polyline], &[Point]),
    fineness: Fineness,
    most: usize,
    progress: &dyn Progress,
) -> Result<Outcome, Cancelled> {
    let has_side = |piece: &Piece| matches!(piece, Piece::Straight { kind: Straight::Side, .. });
    let is_bare = trim.rings.iter().flat_map(|r| &r.pieces).any(has_side);
    let border = trim.edges.iter().map(|e| polylines[*e as usize].off).fold(0.0, f64::max);
    let bend = Bend::new(&trim.chart, if is_bare { f64::INFINITY } else { border });
    // Beyond an edge the height over the surface and the way back to the edge are at right angles.
    let heights = HEIGHTS_AT_LEAST.max(1.0 - (border / fineness.distance).powi(2)).sqrt() * fineness.distance;
    let mut finer = 1;
    for doubling in 0..=MAX_DOUBLINGS {
        let lines = lines(trim, &bend, fineness, finer);
        let cells = (lines[0].len() - 1).saturating_mul(lines[1].len() - 1).saturating_mul(2);
        if cells > most {
            return Ok(Outcome::TooMany(cells));
        }
        let polygons = polygons(trim, polylines, &lines);
        let mut work = Work::new(trim, &bend, &lines, positions, polygons.vertices.clone(), &polygons.poles);
        if let Err(wanted) = work.constrain(&polygons) {
            return Ok(match wanted.is_empty() {
                true => Outcome::Failed("its border crosses itself in the parameters of its surface"),
                false => Outcome::Finer(wanted, None),
            });
        }
        if !work.add_nodes(nodes(trim, &lines), progress)? {
            return Ok(Outcome::Failed("its border bounds no area in the parameters of its surface"));
        }
        let (wanted, cut_is_coarse) = work.refine(heights + 2.0 * trim.gap, most, progress)?;
        if cut_is_coarse && doubling < MAX_DOUBLINGS {
            finer *= 2;
            continue;
        }
        let done = work.finish(border);
        return Ok(match wanted.is_empty() {
            true => Outcome::Done(done),
            false => Outcome::Finer(wanted, Some(done)),
        });
    }
    Ok(Outcome::Failed("its parameters cannot be divided finely enough"))
}

impl<'a> Work<'a> {
    fn new(
        trim: &'a Trim,
        bend: &'a Bend<'a>,
        lines: &[Vec<f64>; 2],
        positions: &'a [Point],
        vertices: Vec<Source>,
        poles: &[(usize, usize)],
    ) -> Work<'a> {
        let window = trim.window;
        let cells = [0, 1].map(|k| (lines[k].len() - 1) as f64);
        let scale = if cells == [1.0, 1.0] {
            // Flat: lengths in space count.
            let middle = window.map(|[a, b]| 0.5 * (a + b));
            let sizes = trim.chart.jet(middle).first.map(norm);
            let extent = (0..2).map(|k| sizes[k] * (window[k][1] - window[k][0])).fold(0.0, f64::max);
            sizes.map(|s| if s > 0.0 { s / extent } else { 1.0 })
        } else {
            [0, 1].map(|k| cells[k] / (window[k][1] - window[k][0]))
        };
        let free = poles.iter().map(|(k, vertex)| (*vertex, *k)).collect();
        Work {
            trim,
            bend,
            scale,
            cdt: Cdt::new(),
            corners: vec![],
            vertices,
            free,
            sides: BTreeMap::new(),
            positions,
        }
    }

    fn scaled(&self, at: [f64; 2]) -> Point2<f64> {
        let x = |k: usize| {
            let x = (at[k] - self.trim.window[k][0]) * self.scale[k];
            if x.abs() < spade::MIN_ALLOWED_VALUE { 0.0 } else { x }
        };
        Point2::new(x(0), x(1))
    }

    fn add(&mut self, at: [f64; 2], vertex: impl FnOnce(&mut Self) -> usize) -> Option<FixedVertexHandle> {
        let handle = self.cdt.insert(self.scaled(at)).ok()?;
        if handle.index() == self.corners.len() {
            let vertex = vertex(self);
            self.corners.push((at, vertex));
        }
        Some(handle)
    }

    /// Adds the sides of all polygons. Where two cross, or a polygon has no area, the shares at which edges need places; none where no
    /// edge can be made finer.
    fn constrain(&mut self, polygons: &Polygons) -> Result<(), Vec<(u32, f64)>> {
        let halves = |corners: &[&Corner]| -> Vec<(u32, f64)> {
            corners
                .iter()
                .filter_map(|c| match c.next {
                    Between::Edge(edge, [a, b]) if (b - a).abs() > LEAST_SHARE => Some((edge, 0.5 * (a + b))),
                    _ => None,
                })
                .collect()
        };
        let mut all: Vec<([FixedVertexHandle; 2], &Corner)> = vec![];
        for ring in &polygons.rings {
            let handles: Option<Vec<FixedVertexHandle>> =
                ring.iter().map(|corner| self.add(corner.at, |_| corner.vertex)).collect();
            let Some(handles) = handles else { return Err(vec![]) };
            let n = ring.len();
            let is_flat = n < 3 && ring.iter().any(|c| matches!(c.next, Between::Edge(..)));
            if is_flat {
                return Err(halves(&ring.iter().collect::<Vec<_>>()));
            }
            all.extend((0..n).map(|i| ([handles[i], handles[(i + 1) % n]], &ring[i])));
        }
        for (n, ([from, to], corner)) in all.iter().enumerate() {
            if from == to {
                continue;
            }
            let edges = self.cdt.try_add_constraint(*from, *to);
            if edges.is_empty() {
                let crossed =
                    all[..n].iter().filter(|(ends, _)| self.cross(*ends, [*from, *to])).map(|(_, c)| *c);
                let crossing: Vec<&Corner> = crossed.chain([*corner]).collect();
                return Err(halves(&crossing));
            }
            for edge in edges {
                let ends = self.cdt.directed_edge(edge).vertices().map(|v| v.fix().index());
                let side = self.sides.entry(sorted(ends)).or_insert((0, corner.next));
                side.0 += 1;
            }
        }
        Ok(())
    }

    fn cross(&self, a: [FixedVertexHandle; 2], b: [FixedVertexHandle; 2]) -> bool {
        let [p, q] = a.map(|h| self.cdt.vertex(h).position());
        let [r, s] = b.map(|h| self.cdt.vertex(h).position());
        let side = |a: Point2<f64>, b: Point2<f64>, c: Point2<f64>| {
            (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
        };
        side(p, q, r) * side(p, q, s) <= 0.0 && side(r, s, p) * side(r, s, q) <= 0.0
    }

    /// For each face of the triangulation, by its number, whether it lies within the polygons.
    fn inside(&self) -> Vec<bool> {
        let mut inside = vec![false; self.cdt.num_all_faces()];
        let mut seen = vec![false; inside.len()];
        let mut open = vec![self.cdt.outer_face().fix().index()];
        seen[0] = true;
        // The outer face has no list of its sides.
        for edge in self.cdt.convex_hull() {
            let edge = edge.rev();
            let inner = edge.face().fix().index();
            if !std::mem::replace(&mut seen[inner], true) {
                inside[inner] = self.is_border(edge.vertices().map(|v| v.fix().index()));
                open.push(inner);
            }
        }
        let faces: Vec<_> = self.cdt.all_faces().collect();
        while let Some(at) = open.pop() {
            let Some(face) = faces.get(at).and_then(|f| f.as_inner()) else { continue };
            for edge in face.adjacent_edges() {
                let next = edge.rev().face().fix().index();
                if !std::mem::replace(&mut seen[next], true) {
                    inside[next] = inside[at] != self.is_border(edge.vertices().map(|v| v.fix().index()));
                    open.push(next);
                }
            }
        }
        inside[0] = false;
        inside
    }

    /// Whether one side of a side is within and the other one not.
    fn is_border(&self, ends: [usize; 2]) -> bool {
        self.sides.get(&sorted(ends)).is_some_and(|(times, _)| times % 2 == 1)
    }

    /// Adds places of the grid that lie within, not close to the border. Whether there is anything within.
    fn add_nodes(&mut self, nodes: Vec<[f64; 2]>, progress: &dyn Progress) -> Result<bool, Cancelled> {
        let inside = self.inside();
        if !inside.contains(&true) {
            return Ok(false);
        }
        let is_clear = |face: spade::handles::FixedFaceHandle<spade::handles::InnerTag>, p: Point2<f64>| {
            let face = self.cdt.face(face);
            let square = APART * APART;
            inside[face.fix().index()]
                && face.adjacent_edges().iter().all(|e| {
                    !self.sides.contains_key(&sorted(e.vertices().map(|v| v.fix().index())))
                        || e.distance_2(p) > square
                })
                && face.vertices().iter().all(|v| v.position().distance_2(p) > square)
        };
        let is_apart = |at: &[f64; 2]| {
            let p = self.scaled(*at);
            match self.cdt.locate(p) {
                PositionInTriangulation::OnFace(face) => is_clear(face, p),
                PositionInTriangulation::OnEdge(edge) => {
                    let edge = self.cdt.directed_edge(edge);
                    let both = [edge.face(), edge.rev().face()];
                    both.iter().all(|f| f.as_inner().is_some_and(|f| is_clear(f.fix(), p)))
                }
                _ => false,
            }
        };
        let mut kept: Vec<[f64; 2]> = vec![];
        for part in nodes.chunks(BETWEEN_QUESTIONS) {
            go_on(progress)?;
            kept.extend(part.iter().filter(|at| is_apart(at)));
        }
        self.add_all(kept, progress)?;
        Ok(true)
    }

    fn add_all(&mut self, places: Vec<[f64; 2]>, progress: &dyn Progress) -> Result<(), Cancelled> {
        for part in places.chunks(BETWEEN_QUESTIONS) {
            go_on(progress)?;
            part.iter().for_each(|at| self.add_own(*at));
        }
        Ok(())
    }

    fn add_own(&mut self, at: [f64; 2]) {
        let place = self.trim.chart.place(at);
        self.add(at, |own| {
            own.vertices.push(Source::Own(place));
            own.vertices.len() - 1
        });
    }

    fn place(&self, vertex: usize) -> Point {
        match self.vertices[vertex] {
            Source::Shared(v) => self.positions[v as usize],
            Source::Own(p) => p,
        }
    }

    /// Parameters of corners; that which is any number at a pole lies between those of the others.
    fn parameters(&self, corners: [usize; 3]) -> [[f64; 2]; 3] {
        let own = corners.map(|c| self.corners[c].0);
        std::array::from_fn(|i| {
            let mut at = own[i];
            if let Some(k) = self.free.get(&self.corners[corners[i]].1) {
                let others: Vec<f64> = (0..3)
                    .filter(|j| self.free.get(&self.corners[corners[*j]].1) != Some(k))
                    .map(|j| own[j][*k])
                    .collect();
                if !others.is_empty() {
                    at[*k] = others.iter().sum::<f64>() / others.len() as f64;
                }
            }
            at
        })
    }

    /// Facets with their parameters; those without area, at poles, are left out.
    fn all(&self) -> Vec<([usize; 3], [[f64; 2]; 3])> {
        let inside = self.inside();
        let mut all = vec![];
        for face in self.cdt.inner_faces().filter(|f| inside[f.fix().index()]) {
            let corners = face.vertices().map(|v| v.fix().index());
            let [a, b, c] = corners.map(|c| self.corners[c].1);
            if a != b && b != c && c != a {
                all.push((corners, self.parameters(corners)));
            }
        }
        all
    }

    /// Cuts facets that are too far from the surface. The shares at which edges need places, and whether a cut needs more.
    fn refine(
        &mut self,
        distance: f64,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<(Vec<(u32, f64)>, bool), Cancelled> {
        for round in 0..MAX_ROUNDS {
            let (mut wanted, mut middles, mut cut_is_coarse) = (vec![], BTreeMap::new(), false);
            let all = self.all();
            for (n, (corners, parameters)) in all.iter().enumerate() {
                if n % BETWEEN_QUESTIONS == 0 {
                    go_on(progress)?;
                }
                let places = corners.map(|c| self.place(self.corners[c].1));
                if self.bend.facet(places, *parameters).distance <= distance {
                    continue;
                }
                let of = |i: usize| self.bend.of_side(parameters[i], parameters[(i + 1) % 3]);
                let longest = (0..3).max_by(|a, b| of(*a).total_cmp(&of(*b))).unwrap_or(0);
                let ends = sorted([corners[longest], corners[(longest + 1) % 3]]);
                match self.sides.get(&ends).map(|s| s.1) {
                    Some(Between::Edge(edge, [a, b])) => wanted.push((edge, 0.5 * (a + b))),
                    Some(Between::Cut | Between::Other) => cut_is_coarse = true,
                    Some(Between::Pole) => {}
                    None => {
                        let [a, b] = ends.map(|e| self.corners[e].0);
                        middles.insert(ends, [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
                    }
                }
            }
            let is_last = round + 1 == MAX_ROUNDS || all.len() + 2 * middles.len() > most;
            if middles.is_empty() || cut_is_coarse || is_last {
                return Ok((wanted, cut_is_coarse));
            }
            self.add_all(middles.into_values().collect(), progress)?;
        }
        Ok((vec![], false))
    }

    fn finish(self, border: f64) -> FaceFacets {
        let all = self.all();
        let mut bound = Bound { distance: 0.0, is_proven: true };
        let (mut facets, mut parameters) = (vec![], vec![]);
        for (corners, own) in all {
            let vertices = corners.map(|c| self.corners[c].1);
            let facet = self.bend.facet(vertices.map(|v| self.place(v)), own);
            bound.distance = bound.distance.max(facet.distance);
            bound.is_proven &= facet.is_proven;
            let turned = self.trim.reversed;
            let order = if turned { [0, 2, 1] } else { [0, 1, 2] };
            facets.push(order.map(|i| vertices[i]));
            parameters.push(order.map(|i| own[i]));
        }
        // Corners on edges are as far from the surface as the edges.
        bound.distance = libm::hypot(bound.distance, border) + self.trim.gap;
        FaceFacets { vertices: self.vertices, facets, parameters, bound }
    }
}

/// Places or facets between two questions whether to go on: some milliseconds.
const BETWEEN_QUESTIONS: usize = 512;

/// Shares of an edge nearer than this are not parted.
const LEAST_SHARE: f64 = 1e-6;

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}
