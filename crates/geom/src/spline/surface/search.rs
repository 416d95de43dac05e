//! The place of one or several surfaces nearest to a point, beyond doubt.
//!
//! Each surface is laid over a grid of cells whose distance from two facets is bounded ([`super::cells`]), and the cells into a
//! tree of boxes. Newton's method starts from a cell that may hold a nearer place than the best one known. Then the cell is
//! done away with in one of four ways. Its bound says that it is too far. Or its Bernstein coefficients do
//! ([`super::bernstein`]), which need no normal. Or it lies within a neighborhood of the best place over which the squared
//! distance is convex, by a bound of its second derivatives. Then the minimum found is the only one. Or it is halved along what
//! bends more, until its bounds are [`FOOT_TOLERANCE`] of the surfaces' size.

use super::Nurbs;
use super::bernstein::Bernstein;
use super::cells::{Bent, Grid, Part};
use super::closest::{SurfaceFoot, descend};
use super::foot_error::{FootError, check};
use super::patches::Jet;
use super::tree::{Boxes, CellId};
use crate::closest::{PointOfTriangle, QueryError, check_points, closest_point, squared_distance};
use crate::mesh::Mesh;
use crate::parallel::prelude::*;
use crate::progress::{Cancelled, Progress};
use crate::space::{Aabb, Point, Vector, cross, dot, minus, norm, unit};

/// Share of the surfaces' size: nearer places by less than this are not looked for once a minimum is found.
pub const FOOT_TOLERANCE: f64 = 1e-9;

/// The place of surfaces nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestFoot {
    /// The surface, from 0.
    pub surface: usize,
    /// The place on it.
    pub foot: SurfaceFoot,
    /// The facet of [`FootSearch::mesh`] over which it lies.
    pub face: u32,
    /// Weights of that facet's corners by the parameters.
    pub weights: [f64; 3],
    /// Whether it lies on the border of the surface, where no other one goes on.
    pub border: bool,
    /// Whether no other place is nearer by more than [`FOOT_TOLERANCE`] of the size, or by more than rounding; `false` where that took too many
    /// steps.
    pub certain: bool,
    /// Cuts of cells that it took: what it has cost beyond a look at the cells near by.
    pub cuts: usize,
}

/// Surfaces, ready to be asked for nearest places.
///
/// ```
/// use trueness_geom::progress::Silent;
/// use trueness_geom::spline::{basis::Knots, surface::{FootSearch, Nurbs}};
/// let half = 0.5f64.sqrt();
/// let arc = [([2.0, 0.0], 1.0), ([2.0, 2.0], half), ([0.0, 2.0], 1.0)];
/// let points: Vec<_> = arc.iter().flat_map(|([x, y], w)| [0.0, 5.0].map(|z| ([*x, *y, z], *w))).collect();
/// let knots = [Knots::uniform(2, 1, 0.0, 1.0), Knots::uniform(1, 1, 0.0, 1.0)];
/// let quarter = Nurbs::weighted(knots, &points).unwrap();
/// let search = FootSearch::new(&[quarter], &Silent).unwrap();
/// let found = search.nearest(&[3.0, 4.0, 1.0]);
/// assert!((found.foot.distance - 3.0).abs() < 1e-14 && found.certain);
/// assert!((found.foot.place[0] - 1.2).abs() < 1e-14);
/// ```
pub struct FootSearch {
    grids: Vec<Grid>,
    boxes: Boxes,
    /// Number of the first cell of each grid.
    first: Vec<usize>,
    /// Diagonal of the box of all places.
    size: f64,
    /// Greatest coordinate of the control points.
    farthest: f64,
}

/// Most cells of all grids together, about.
const MAX_GRID_CELLS: f64 = 200_000.0;
/// Most pairs of spans: their polynomials take some hundred bytes each.
const MAX_SPAN_PAIRS: usize = 4_000_000;
/// Most cuts of cells for one point.
const MAX_CUTS_PER_POINT: usize = 20_000;
/// Rounding of a place or distance, as a share of the greatest coordinate: a place is the sum of some dozens of products.
const PLACE_ROUNDING: f64 = 32.0 * f64::EPSILON;
/// The best place so far.
struct Best {
    foot: SurfaceFoot,
    grid: u32,
    part: Part,
    alone: Option<Alone>,
}

/// A neighborhood of a place in which the squared distance is convex. It holds all within the parameters `from` to `to` whose
/// scaled distance from `at` is no more than `radius`.
struct Alone {
    at: [f64; 2],
    scale: [f64; 2],
    radius: f64,
    from: [f64; 2],
    to: [f64; 2],
}

/// A part of a cell.
struct Piece {
    from: [f64; 2],
    to: [f64; 2],
    /// In the order of parameters.
    corners: [Point; 4],
    /// Its patch.
    patch: [usize; 2],
    slack: f64,
}

/// A part of a cell that is to be cut.
struct Open {
    piece: Piece,
    own: Bernstein,
}

impl FootSearch {
    /// Lays the surfaces over grids. Cost: some microseconds a cell of at most about 200 thousand, or of as many as they have
    /// pairs of spans.
    ///
    /// # Errors
    /// [`FootError`].
    pub fn new(surfaces: &[Nurbs], progress: &dyn Progress) -> Result<FootSearch, FootError> {
        let bounds = check(surfaces)?;
        let spans = |s: &Nurbs| s.knots().iter().map(|k| k.distinct().len() - 1).product::<usize>();
        let pairs: usize = surfaces.iter().map(spans).sum();
        if pairs > MAX_SPAN_PAIRS {
            return Err(FootError::TooMany(pairs));
        }
        let farthest = bounds.min.iter().chain(&bounds.max).fold(0.0, |m: f64, x| m.max(x.abs()));
        // A surface smaller than the rounding of its places is one cell.
        let mut slack = (1e-5 * bounds.diagonal()).max(PLACE_ROUNDING * farthest).max(f64::MIN_POSITIVE);
        let bent: Vec<Bent> = surfaces.par_iter().map(Bent::new).collect();
        let cells = |slack: f64| bent.iter().map(|b| b.cells(slack)).sum::<f64>();
        while cells(slack) > MAX_GRID_CELLS.max(1.5 * cells(f64::INFINITY)) {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            slack *= 2.0;
        }
        let grids: Vec<Grid> = bent.into_par_iter().map(|b| Grid::new(b, slack)).collect();
        let mut first = vec![0];
        for grid in &grids {
            let [m, n] = grid.counts();
            first.push(first[first.len() - 1] + m * n);
        }
        let size = grids.iter().fold(Aabb::EMPTY, |b, g| b.union(&Aabb::of(&g.places))).diagonal();
        Ok(FootSearch { boxes: Boxes::new(&grids, PLACE_ROUNDING * farthest), grids, first, size, farthest })
    }

    /// Number of surfaces.
    pub fn surfaces(&self) -> usize {
        self.grids.len()
    }

    /// The surfaces as a mesh, two facets for each cell, whose vertices lie on them; facets look the way of the normal.
    pub fn mesh(&self) -> Mesh {
        let mut mesh = Mesh::default();
        self.grids.iter().for_each(|g| g.facets(&mut mesh));
        mesh
    }

    /// How far the mesh may be from the surfaces, a bound.
    pub fn mesh_distance(&self) -> f64 {
        let of = |g: &Grid| {
            let [m, n] = g.counts();
            (0..m * n).map(|c| g.slack([c / n, c % n])).fold(0.0, f64::max)
        };
        self.grids.iter().map(of).fold(0.0, f64::max)
    }

    /// The place nearest to a point. The normals decide between two that are equally far. The one whose normal the point lies
    /// along more is taken, as both sides of a crease must have one sign.
    ///
    /// Cost: a few microseconds; a hundred times that where very many places are nearly as near. A point that is not finite
    /// has a distance that is not.
    pub fn nearest(&self, point: &Point) -> NearestFoot {
        if !point.iter().all(|x| x.is_finite()) {
            return self.describe(None, 0);
        }
        let Search { best, cuts, .. } = self.searched(point, None);
        self.describe(best, cuts)
    }

    /// `f(index, foot)` of every point, in their order.
    ///
    /// # Errors
    /// [`QueryError::BadPoint`] for a point that is not finite, [`QueryError::Cancelled`]. `progress` hears of points.
    pub fn map<T: Send>(
        &self,
        points: &[Point],
        progress: &dyn Progress,
        f: impl Fn(usize, NearestFoot) -> T + Sync,
    ) -> Result<Vec<T>, QueryError> {
        /// Points answered between two questions whether to go on.
        const POINTS_PER_QUESTION: usize = 256;
        check_points(points)?;
        let chunk = |(n, part): (usize, &[Point])| -> Result<Vec<T>, QueryError> {
            if progress.cancelled() {
                return Err(Cancelled.into());
            }
            let found = part
                .iter()
                .enumerate()
                .map(|(i, p)| f(n * POINTS_PER_QUESTION + i, self.nearest(p)))
                .collect();
            progress.advance(part.len() as u64);
            Ok(found)
        };
        let parts: Result<Vec<Vec<T>>, QueryError> =
            points.par_chunks(POINTS_PER_QUESTION).enumerate().map(chunk).collect();
        Ok(parts?.into_iter().flatten().collect())
    }

    /// The best place on all surfaces but one.
    fn searched(&self, p: &Point, but: Option<usize>) -> Search<'_> {
        // Below the rounding of a distance nothing is nearer.
        let rounding = PLACE_ROUNDING * p.iter().fold(self.farthest, |m, x| m.max(x.abs()));
        let epsilon = (FOOT_TOLERANCE * self.size).max(rounding);
        let mut search = Search { all: self, p: *p, best: None, cuts: 0, epsilon };
        self.boxes.visit(p, f64::INFINITY, |cell| {
            if but != Some(cell.grid as usize) {
                search.cell(cell);
            }
            search.reach() + search.epsilon
        });
        search
    }

    fn describe(&self, best: Option<Best>, cuts: usize) -> NearestFoot {
        let Some(Best { foot, grid, .. }) = best else {
            let nowhere = [f64::NAN; 3];
            let foot = SurfaceFoot {
                parameters: [f64::NAN; 2],
                place: nowhere,
                distance: f64::NAN,
                normal: None,
                settled: false,
            };
            return NearestFoot {
                surface: 0,
                foot,
                face: 0,
                weights: nowhere,
                border: false,
                certain: false,
                cuts,
            };
        };
        let surface = grid as usize;
        let ([i, j], [x, y]) = self.grids[surface].cell(foot.parameters);
        let cell = self.first[surface] + i * self.grids[surface].counts()[1] + j;
        let (half, weights) = if x >= y { (0, [1.0 - x, x - y, y]) } else { (1, [1.0 - y, x, y - x]) };
        let border = self.on_border(surface, &foot);
        let (face, certain) = ((2 * cell + half) as u32, cuts <= MAX_CUTS_PER_POINT);
        NearestFoot { surface, foot, face, weights, border, certain, cuts }
    }

    /// Whether a place lies on the border of its surface, and on no other surface.
    fn on_border(&self, surface: usize, foot: &SurfaceFoot) -> bool {
        let grid = &self.grids[surface];
        let ends = [0, 1].map(|k| [grid.lines[k][0], grid.lines[k][grid.lines[k].len() - 1]]);
        let on = |k: usize, end: usize| {
            foot.parameters[k] == ends[k][end] && !grid.closed[k] && !grid.pole[k][end]
        };
        let on_end = (0..4).any(|e| on(e / 2, e % 2));
        on_end
            && (self.grids.len() < 2
                || self
                    .searched(&foot.place, Some(surface))
                    .best
                    .is_none_or(|b| b.foot.distance > JOINED_SURFACE_SHARE * self.size))
    }
}

/// Surfaces nearer to one another than this share of their size are joined there.
const JOINED_SURFACE_SHARE: f64 = 1e-5;

/// A search under way.
struct Search<'a> {
    all: &'a FootSearch,
    p: Point,
    best: Option<Best>,
    cuts: usize,
    epsilon: f64,
}

impl Search<'_> {
    fn reach(&self) -> f64 {
        self.best.as_ref().map_or(f64::INFINITY, |b| b.foot.distance)
    }

    fn cell(&mut self, id: CellId) {
        let cell = [id.row as usize, id.column as usize];
        let grid = &self.all.grids[id.grid as usize];
        let part = grid.part(cell);
        let own = self.best.as_ref().is_some_and(|b| b.grid == id.grid && b.part == part);
        let piece = Piece {
            from: [0, 1].map(|k| grid.lines[k][cell[k]]),
            to: [0, 1].map(|k| grid.lines[k][cell[k] + 1]),
            corners: grid.corners(cell),
            patch: grid.patch_of(cell),
            slack: grid.slack(cell),
        };
        let (distance, half) = piece.distance(&self.p);
        // Beyond a crease a place as near as the best one may have the better normal.
        let limit = if own { self.reach() - self.epsilon } else { self.reach() + self.epsilon };
        if distance - piece.slack > limit || own && self.is_alone(&piece) {
            return;
        }
        let start = piece.parameters(&self.p, half);
        if !own || norm(minus(grid.shape.place(&part, start), self.p)) < self.reach() {
            self.start(grid, id.grid, part, start);
        }
        self.exclude(grid, id.grid, part, piece);
    }

    /// Newton's method from here; what it finds is kept if it is better.
    fn start(&mut self, grid: &Grid, number: u32, part: Part, start: [f64; 2]) {
        let domain = grid.domain(&part);
        let (mut foot, jet) = descend(|at| grid.shape.jet(&part, at), domain, self.p, start);
        if !grid.has_area {
            foot.normal = None;
        } else if foot.normal.is_none() {
            foot.normal = normal_near(grid, &part, foot.parameters);
        }
        let along = |f: &SurfaceFoot| f.normal.map_or(0.0, |n| dot(n, minus(self.p, f.place)).abs());
        let better = self.best.as_ref().is_none_or(|b| {
            let equal = (foot.distance - b.foot.distance).abs() <= 1e-12 * (self.all.size + foot.distance);
            let other = b.grid != number || b.part != part;
            if equal && other { along(&foot) > along(&b.foot) } else { foot.distance < b.foot.distance }
        });
        if better {
            let alone = alone(grid, &part, &foot, &jet, self.p, self.all.size);
            self.best = Some(Best { foot, grid: number, part, alone });
        }
    }

    fn is_alone(&self, piece: &Piece) -> bool {
        self.best.as_ref().and_then(|b| b.alone.as_ref()).is_some_and(|a| a.holds(piece))
    }

    /// Cuts a cell until no part of it can hold the nearest place.
    fn exclude(&mut self, grid: &Grid, number: u32, part: Part, piece: Piece) {
        let own = grid.about(piece.patch, &self.p, piece.from, piece.to);
        let mut open = vec![Open { piece, own }];
        while let Some(Open { piece, own }) = open.pop() {
            let (distance, half) = piece.distance(&self.p);
            let is_own = self.best.as_ref().is_some_and(|b| b.grid == number && b.part == part);
            let least = self.reach() - self.epsilon;
            if distance - piece.slack >= least || is_own && self.is_alone(&piece) {
                continue;
            }
            let way = self.best.as_ref().and_then(|b| unit(minus(b.foot.place, self.p)));
            if way.is_none_or(|(way, _)| own.is_beyond(least, way)) {
                continue;
            }
            if self.cuts > MAX_CUTS_PER_POINT {
                return;
            }
            self.cuts += 1;
            let start = piece.parameters(&self.p, half);
            if norm(minus(grid.shape.place(&part, start), self.p)) < self.reach() {
                self.start(grid, number, part, start);
            }
            let along = own.bent();
            let halves = piece.halves(
                along,
                |at| grid.shape.place(&part, at),
                |from, to| grid.slack_of(piece.patch, from, to),
            );
            open.extend(halves.into_iter().zip(own.halves(along)).map(|(piece, own)| Open { piece, own }));
        }
    }
}

impl Piece {
    fn facets(&self) -> [[Point; 3]; 2] {
        let [a, b, c, d] = self.corners;
        [[a, c, d], [a, d, b]]
    }
    /// Distance from the nearer facet, and which one that is.
    fn distance(&self, p: &Point) -> (f64, usize) {
        let [x, y] = self.facets().map(|f| squared_distance(p, &f).0);
        if x <= y { (x.sqrt(), 0) } else { (y.sqrt(), 1) }
    }
    /// Parameters of the place of a facet nearest to a point.
    fn parameters(&self, p: &Point, half: usize) -> [f64; 2] {
        let PointOfTriangle { barycentric: [_, second, third], .. } = closest_point(p, &self.facets()[half]);
        let share = if half == 0 { [second + third, third] } else { [second, second + third] };
        [0, 1].map(|k| self.from[k] + share[k] * (self.to[k] - self.from[k]))
    }
    /// Both halves along a direction.
    fn halves(
        &self,
        k: usize,
        place: impl Fn([f64; 2]) -> Point,
        slack: impl Fn([f64; 2], [f64; 2]) -> f64,
    ) -> [Piece; 2] {
        let middle = 0.5 * (self.from[k] + self.to[k]);
        let other = 1 - k;
        let ends = [self.from[other], self.to[other]].map(|t| {
            let mut at = [middle; 2];
            at[other] = t;
            place(at)
        });
        let [a, b, c, d] = self.corners;
        let corners = match k {
            0 => [[a, b, ends[0], ends[1]], [ends[0], ends[1], c, d]],
            _ => [[a, ends[0], c, ends[1]], [ends[0], b, ends[1], d]],
        };
        let half = |n: usize| {
            let (mut from, mut to) = (self.from, self.to);
            if n == 0 {
                to[k] = middle
            } else {
                from[k] = middle
            }
            Piece { from, to, corners: corners[n], patch: self.patch, slack: slack(from, to) }
        };
        [half(0), half(1)]
    }
}

impl Alone {
    fn holds(&self, piece: &Piece) -> bool {
        let far = [0, 1].map(|k| {
            let inside = piece.from[k] >= self.from[k] && piece.to[k] <= self.to[k];
            let away = (piece.from[k] - self.at[k]).abs().max((piece.to[k] - self.at[k]).abs());
            if inside { away * self.scale[k] } else { f64::INFINITY }
        });
        libm::hypot(far[0], far[1]) <= self.radius
    }
}

/// The neighborhood in which a place is the only minimum, if one can be named.
///
/// Parameters are scaled so that the derivatives have length 1 at the place. With the cosine `c` of their angle, the derivative
/// in any direction is there at least `√(1 − c)` long. Within `r` of it, it is no shorter than `√(1 − c) − M r`, with a bound
/// `M` of the second derivatives. Half the second derivative of the squared distance is that squared plus the difference times
/// the second derivative: above `(√(1 − c) − M r)² − M (d + r (√2 + M r / 2))`.
fn alone(grid: &Grid, part: &Part, foot: &SurfaceFoot, jet: &Jet, p: Point, size: f64) -> Option<Alone> {
    let scale = jet.first.map(norm);
    let away: Vector = minus(jet.place, p);
    let domain = grid.domain(part);
    let at = foot.parameters;
    let still = |k: usize| {
        let slope = dot(away, jet.first[k]) / scale[k];
        let held = at[k] <= domain[k].0 && slope > 0.0 || at[k] >= domain[k].1 && slope < 0.0;
        held || slope.abs() <= 1e-8 * size
    };
    if !(foot.settled && still(0) && still(1)) {
        return None;
    }
    let cosine = (dot(jet.first[0], jet.first[1]) / (scale[0] * scale[1])).abs();
    let least = (1.0 - cosine).max(0.0).sqrt();
    // The patch of the place and those around it.
    let spans = grid.shape.spans();
    let near = [0, 1].map(|k| {
        let (i, _) = spans[k].locate_among(at[k], part[k][0], part[k][1]);
        [i.saturating_sub(1).max(part[k][0]), (i + 1).min(part[k][1])]
    });
    let mut most = 0.0f64;
    for i in near[0][0]..=near[0][1] {
        for j in near[1][0]..=near[1][1] {
            let [ss, st, tt] = grid.patch_bounds([i, j]);
            let by = [spans[0].half(i) * scale[0], spans[1].half(j) * scale[1]];
            most = most.max((ss / (by[0] * by[0])).max(tt / (by[1] * by[1])) + st / (by[0] * by[1]));
        }
    }
    let convex = |x: &f64| {
        let root = least - x;
        root > 0.0 && root * root > most * foot.distance + x * (std::f64::consts::SQRT_2 + 0.5 * x)
    };
    let share = [0.25, 0.2, 0.15, 0.1, 0.06, 0.03, 0.01].into_iter().find(convex)?;
    let radius = if most > 0.0 { share / most } else { f64::INFINITY };
    let limits = |k: usize| (spans[k].limits(near[k][0]).0, spans[k].limits(near[k][1]).1);
    let [(u0, u1), (v0, v1)] = [limits(0), limits(1)];
    Some(Alone { at, scale, radius, from: [u0, v0], to: [u1, v1] })
}

/// The normal a little towards the middle, where a place has none, as a pole.
fn normal_near(grid: &Grid, part: &Part, at: [f64; 2]) -> Option<Vector> {
    let middle = grid.domain(part).map(|(from, to)| 0.5 * (from + to));
    [1e-6, 1e-4].iter().find_map(|share| {
        let jet = grid.shape.jet(part, [0, 1].map(|k| at[k] + share * (middle[k] - at[k])));
        unit(cross(jet.first[0], jet.first[1])).map(|(n, _)| n)
    })
}
