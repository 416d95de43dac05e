//! A surface over a grid of cells, each with a bound on its distance from the two facets between its corners.
//!
//! Over steps `h` and `k` of the parameters a surface keeps within `(h² M₁ + 2hk M₂ + k² M₃) / 8` of the facets, with bounds
//! `M` of its second derivatives. (Filip, Magedson and Markot, Surface algorithms using bounds on derivatives, Computer Aided
//! Geometric Design 3, 1986.) Here they are bounded patch by patch by the sizes of the coefficients of its polynomial. A
//! rational surface `X / w` is bounded through the derivatives of `X` and `w`, as seen from the middle of the patch.

use super::bernstein::Bernstein;
use super::degenerate::Degenerate;
use super::patches::Jet;
use super::{Nurbs, Patches};
use crate::mesh::Mesh;
use crate::space::{Aabb, Point, minus, norm};
use crate::spline::basis::Knots;
use crate::spline::spans::Spans;
use crate::spline::value::Value;

/// The polynomials of a surface.
pub(super) enum Polynomials {
    Plain(Patches<3>),
    Rational(Patches<4>),
}

/// First and last span of a part of a surface, in both directions.
pub(super) type Part = [[usize; 2]; 2];

impl Polynomials {
    fn new(surface: &Nurbs) -> Polynomials {
        match surface {
            Nurbs::Plain(s) => Polynomials::Plain(Patches::new(s)),
            Nurbs::Rational(s) => {
                let masses = s.masses();
                let points: Vec<[f64; 4]> =
                    masses.points().iter().map(|m| [m.moment[0], m.moment[1], m.moment[2], m.mass]).collect();
                let spans = masses.knots().each_ref().map(Spans::new);
                Polynomials::Rational(Patches::of(spans, &points, masses.counts()[1]))
            }
        }
    }
    pub(super) fn spans(&self) -> &[Spans; 2] {
        match self {
            Polynomials::Plain(p) => &p.spans,
            Polynomials::Rational(p) => &p.spans,
        }
    }
    fn locate(&self, part: &Part, at: [f64; 2]) -> [(usize, f64); 2] {
        [0, 1].map(|k| self.spans()[k].locate_among(at[k], part[k][0], part[k][1]))
    }
    /// Place and derivatives, at the border of the part seen from within.
    pub(super) fn jet(&self, part: &Part, at: [f64; 2]) -> Jet {
        let [u, v] = self.locate(part, at);
        match self {
            Polynomials::Plain(p) => {
                let [place, su, sv, suu, suv, svv] = p.six(u, v);
                Jet { place, first: [su, sv], second: [suu, suv, svv] }
            }
            Polynomials::Rational(p) => quotient(p.six(u, v)),
        }
    }
    /// The place, at the border of the part seen from within.
    pub(super) fn place(&self, part: &Part, at: [f64; 2]) -> Point {
        let [(i, s), (j, t)] = self.locate(part, at);
        let cell = i * self.spans()[1].count() + j;
        match self {
            Polynomials::Plain(p) => p.value(cell, s, t),
            Polynomials::Rational(p) => {
                let [x, y, z, w] = p.value(cell, s, t);
                [x / w, y / w, z / w]
            }
        }
    }
    /// Moments of a patch about a point, and masses, as powers of its coordinates.
    fn about(&self, cell: usize, p: &Point) -> (Vec<[f64; 4]>, usize) {
        match self {
            Polynomials::Plain(all) => {
                let (own, q) = all.patch(cell);
                let mut powers: Vec<[f64; 4]> = own.iter().map(|[x, y, z]| [*x, *y, *z, 0.0]).collect();
                powers[0] = [own[0][0] - p[0], own[0][1] - p[1], own[0][2] - p[2], 1.0];
                (powers, q)
            }
            Polynomials::Rational(all) => {
                let (own, q) = all.patch(cell);
                let about = |[x, y, z, w]: &[f64; 4]| [x - p[0] * w, y - p[1] * w, z - p[2] * w, *w];
                (own.iter().map(about).collect(), q)
            }
        }
    }
    /// Bounds of the second derivatives of a patch by its own coordinates; `least` is the least weight that acts there.
    fn bounds(&self, cell: usize, least: f64) -> [f64; 3] {
        match self {
            Polynomials::Plain(p) => {
                let (own, q) = p.patch(cell);
                let [_, _, _, ss, st, tt] = sizes(own.iter().map(|c| norm(*c)), q);
                [ss, st, tt]
            }
            Polynomials::Rational(p) => {
                let (own, q) = p.patch(cell);
                let w0 = own[0][3];
                let middle = [0, 1, 2].map(|k| own[0][k] / w0);
                let seen = own.iter().map(|c| norm([0, 1, 2].map(|k| c[k] - c[3] * middle[k])));
                let x = sizes(seen, q);
                let w = sizes(own.iter().map(|c| c[3].abs()), q);
                let reach = x[0] / least;
                let [s, t] = [1, 2].map(|k| (x[k] + w[k] * reach) / least);
                [
                    (x[3] + 2.0 * w[1] * s + w[3] * reach) / least,
                    (x[4] + w[1] * t + w[2] * s + w[4] * reach) / least,
                    (x[5] + 2.0 * w[2] * t + w[5] * reach) / least,
                ]
            }
        }
    }
}

/// Value and derivatives of `X / w`.
fn quotient(six: [[f64; 4]; 6]) -> Jet {
    let w = six[0][3];
    let part = |k: usize, less: &[(f64, Point)]| -> Point {
        let top = less.iter().fold([six[k][0], six[k][1], six[k][2]], |sum, (by, p)| sum.plus(-by, *p));
        top.map(|x| x / w)
    };
    let place = part(0, &[]);
    let [wu, wv, wuu, wuv, wvv] = [1, 2, 3, 4, 5].map(|k| six[k][3]);
    let (su, sv) = (part(1, &[(wu, place)]), part(2, &[(wv, place)]));
    let suu = part(3, &[(2.0 * wu, su), (wuu, place)]);
    let suv = part(4, &[(wu, sv), (wv, su), (wuv, place)]);
    let svv = part(5, &[(2.0 * wv, sv), (wvv, place)]);
    Jet { place, first: [su, sv], second: [suu, suv, svv] }
}

/// Bounds of a polynomial on `[−1, 1]²` and of its derivatives, from the sizes of its coefficients: itself, by `s`, `t`, `ss`,
/// `st`, `tt`.
fn sizes(coefficients: impl Iterator<Item = f64>, q: usize) -> [f64; 6] {
    let mut out = [0.0; 6];
    for (k, size) in coefficients.enumerate() {
        let (a, b) = ((k / q) as f64, (k % q) as f64);
        for (sum, by) in out.iter_mut().zip([1.0, a, b, a * (a - 1.0), a * b, b * (b - 1.0)]) {
            *sum += by * size;
        }
    }
    out
}

/// A surface of which it is known how much it bends, but not yet how fine its grid must be.
pub(super) struct Bent<'a> {
    surface: &'a Nurbs,
    shape: Polynomials,
    bounds: Vec<[f64; 3]>,
    has_area: bool,
}

impl<'a> Bent<'a> {
    pub(super) fn new(surface: &'a Nurbs) -> Bent<'a> {
        let shape = Polynomials::new(surface);
        let has_area = surface.degenerate().iter().all(|d| matches!(d, Degenerate::Edge(..)));
        Bent { surface, bounds: patch_bounds(surface, &shape), shape, has_area }
    }
    /// Cells of a grid that keep within `slack` of their facets.
    pub(super) fn cells(&self, slack: f64) -> f64 {
        // Without an area cells lie on one another, and many are as near as the nearest.
        let slack = if self.has_area { slack } else { f64::INFINITY };
        let steps = steps(&self.shape, &self.bounds, slack);
        steps.iter().map(|s| s.iter().map(|n| *n as f64).sum::<f64>()).product()
    }
}

/// A surface over a grid.
pub(super) struct Grid {
    pub(super) shape: Polynomials,
    /// Parameters of the lines in both directions.
    pub(super) lines: [Vec<f64>; 2],
    /// The span of each step between lines.
    pub(super) span: [Vec<usize>; 2],
    /// First and last span of the smooth run that each span belongs to: at its ends the surface may have a crease.
    run: [Vec<[usize; 2]>; 2],
    /// Places at the crossings, row after row.
    pub(super) places: Vec<Point>,
    /// Bounds of the second derivatives of each patch, by its own coordinates.
    pub(super) bounds: Vec<[f64; 3]>,
    /// Whether the first and the last line of a direction are no border, but lie on one another.
    pub(super) closed: [bool; 2],
    /// Whether the first, the last line of a direction is a single place, as at a pole.
    pub(super) pole: [[bool; 2]; 2],
    /// Whether it has an area: without one, what derivatives tell of a normal is rounding.
    pub(super) has_area: bool,
}

impl Grid {
    /// A grid whose cells keep within `slack` of their facets.
    pub(super) fn new(bent: Bent, slack: f64) -> Grid {
        let Bent { surface, shape, bounds, has_area } = bent;
        let slack = if has_area { slack } else { f64::INFINITY };
        let steps = steps(&shape, &bounds, slack);
        let (mut lines, mut span) = ([vec![], vec![]], [vec![], vec![]]);
        for k in 0..2 {
            let spans = &shape.spans()[k];
            for (i, n) in steps[k].iter().enumerate() {
                let (from, to) = spans.limits(i);
                for step in 0..*n {
                    lines[k].push(from + (to - from) * step as f64 / *n as f64);
                    span[k].push(i);
                }
            }
            lines[k].push(spans.limits(spans.count() - 1).1);
        }
        let run = [0, 1].map(|k| runs(&surface.knots()[k]));
        let whole: Part = [0, 1].map(|k| [0, shape.spans()[k].count() - 1]);
        let place = |u: &f64| lines[1].iter().map(|v| shape.place(&whole, [*u, *v])).collect::<Vec<_>>();
        let places = lines[0].iter().flat_map(place).collect();
        let (closed, pole) = ([false; 2], [[false; 2]; 2]);
        let mut grid = Grid { shape, lines, span, run, places, bounds, closed, pole, has_area };
        grid.find_border(surface);
        grid
    }

    /// Which lines at the border lie on one another or are single places, as their control points do.
    fn find_border(&mut self, surface: &Nurbs) {
        let points: Vec<Point> = surface.control_points().iter().map(|p| p.0).collect();
        let [m, n] = surface.counts();
        let near = 1e-9 * Aabb::of(&points).diagonal();
        let same = |a: &Point, b: &Point| norm(minus(*a, *b)) <= near;
        let line = |k: usize, last: bool| -> Vec<Point> {
            let at = if last { [m, n][k] - 1 } else { 0 };
            (0..[n, m][k]).map(|i| if k == 0 { points[at * n + i] } else { points[i * n + at] }).collect()
        };
        for k in 0..2 {
            let ends = [line(k, false), line(k, true)];
            self.closed[k] = ends[0].iter().zip(&ends[1]).all(|(a, b)| same(a, b));
            self.pole[k] = ends.map(|e| e.iter().all(|p| same(p, &e[0])));
        }
    }

    /// Cells along `u` and `v`.
    pub(super) fn counts(&self) -> [usize; 2] {
        self.lines.each_ref().map(|l| l.len() - 1)
    }
    /// The corners of a cell, in the order of its parameters.
    pub(super) fn corners(&self, [i, j]: [usize; 2]) -> [Point; 4] {
        let n = self.lines[1].len();
        let a = i * n + j;
        [a, a + 1, a + n, a + n + 1].map(|k| self.places[k])
    }
    /// The smooth part that a cell belongs to.
    pub(super) fn part(&self, cell: [usize; 2]) -> Part {
        [0, 1].map(|k| self.run[k][self.span[k][cell[k]]])
    }
    /// How far a cell may be from its facets, but for rounding.
    pub(super) fn slack(&self, cell: [usize; 2]) -> f64 {
        let spans = [0, 1].map(|k| self.span[k][cell[k]]);
        let step = |k: usize| {
            (self.lines[k][cell[k] + 1] - self.lines[k][cell[k]]) / self.shape.spans()[k].half(spans[k])
        };
        slack([step(0), step(1)], self.patch_bounds(spans))
    }
    /// The same of a part of a patch between parameters.
    pub(super) fn slack_of(&self, patch: [usize; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
        let step = |k: usize| (to[k] - from[k]) / self.shape.spans()[k].half(patch[k]);
        slack([step(0), step(1)], self.patch_bounds(patch))
    }
    /// The patch of a cell.
    pub(super) fn patch_of(&self, cell: [usize; 2]) -> [usize; 2] {
        [0, 1].map(|k| self.span[k][cell[k]])
    }
    /// A part of a patch about a point.
    pub(super) fn about(&self, patch: [usize; 2], p: &Point, from: [f64; 2], to: [f64; 2]) -> Bernstein {
        let (powers, q) = self.shape.about(self.number(patch), p);
        let [from, to] = self.within(patch, [from, to]);
        Bernstein::new(powers, q, from, to)
    }
    /// A box around a cell, with room for rounding.
    pub(super) fn bounds_of(&self, cell: [usize; 2], rounding: f64) -> Aabb {
        let (corners, mut room) = (Aabb::of(&self.corners(cell)), self.slack(cell));
        let mut bounds = corners;
        // Bounds by the derivatives of a whole patch say little where its weights differ much, or a point lies far off.
        if room > corners.diagonal() {
            let patch = self.patch_of(cell);
            let (powers, q) = self.shape.about(self.number(patch), &[0.0; 3]);
            let ends = [0, 1].map(|end| [0, 1].map(|k| self.lines[k][cell[k] + end]));
            let [from, to] = self.within(patch, ends);
            let hull = Bernstein::hull(powers, q, from, to);
            if hull.diagonal() <= corners.diagonal() + room {
                (bounds, room) = (hull.union(&corners), rounding);
            }
        }
        Aabb { min: bounds.min.map(|x| x - room), max: bounds.max.map(|x| x + room) }
    }
    fn number(&self, [i, j]: [usize; 2]) -> usize {
        i * self.shape.spans()[1].count() + j
    }
    /// Parameters by the coordinates of a patch.
    fn within(&self, patch: [usize; 2], places: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        let spans = self.shape.spans();
        places.map(|at| {
            [0, 1].map(|k| {
                let (a, b) = spans[k].limits(patch[k]);
                (2.0 * at[k] - a - b) / (b - a)
            })
        })
    }
    pub(super) fn patch_bounds(&self, [i, j]: [usize; 2]) -> [f64; 3] {
        self.bounds[i * self.shape.spans()[1].count() + j]
    }
    /// First and last parameters of a part.
    pub(super) fn domain(&self, part: &Part) -> [(f64, f64); 2] {
        [0, 1].map(|k| {
            let spans = &self.shape.spans()[k];
            (spans.limits(part[k][0]).0, spans.limits(part[k][1]).1)
        })
    }
    /// The cell of parameters, and how far they are through it in both directions.
    pub(super) fn cell(&self, at: [f64; 2]) -> ([usize; 2], [f64; 2]) {
        let of = |k: usize| {
            let lines = &self.lines[k];
            let i = lines.partition_point(|t| *t <= at[k]).clamp(1, lines.len() - 1) - 1;
            (i, ((at[k] - lines[i]) / (lines[i + 1] - lines[i])).clamp(0.0, 1.0))
        };
        let [(i, x), (j, y)] = [of(0), of(1)];
        ([i, j], [x, y])
    }
    /// Adds the facets to a mesh: two for each cell, cells row after row.
    pub(super) fn facets(&self, mesh: &mut Mesh) {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(&self.places);
        let n = self.lines[1].len() as u32;
        let [rows, columns] = self.counts().map(|c| c as u32);
        for i in 0..rows {
            for j in 0..columns {
                let a = first + i * n + j;
                mesh.faces.extend([[a, a + n, a + n + 1], [a, a + n + 1, a + 1]]);
            }
        }
    }
}

/// How far a part of a patch may be from its facets. It follows from its steps and the bounds of the second derivatives by
/// coordinates of the patch.
pub(super) fn slack([h, k]: [f64; 2], [ss, st, tt]: [f64; 3]) -> f64 {
    (h * h * ss + 2.0 * h * k * st + k * k * tt) / 8.0
}

/// First and last span of each span's smooth run: as far as no knot stands as often as the degree.
fn runs(knots: &Knots) -> Vec<[usize; 2]> {
    let distinct = knots.distinct();
    let (last, mut out) = (distinct.len() - 2, vec![]);
    let mut first = 0;
    for i in 0..=last {
        if i == last || knots.multiplicity(distinct[i + 1]) >= knots.degree() {
            out.resize(i + 1, [first, i]);
            first = i + 1;
        }
    }
    out
}

fn patch_bounds(surface: &Nurbs, shape: &Polynomials) -> Vec<[f64; 3]> {
    let spans = shape.spans();
    let n = surface.counts()[1];
    let least = |i: usize, j: usize| match surface {
        Nurbs::Plain(_) => 1.0,
        Nurbs::Rational(s) => {
            let (a, b) = (spans[0].first(i), spans[1].first(j));
            let rows = a..=a + spans[0].degree();
            let all = rows.flat_map(|r| (b..=b + spans[1].degree()).map(move |c| r * n + c));
            all.map(|k| s.masses().points()[k].mass).fold(f64::INFINITY, f64::min)
        }
    };
    let columns = spans[1].count();
    (0..spans[0].count() * columns).map(|c| shape.bounds(c, least(c / columns, c % columns))).collect()
}

/// Most steps in a span.
const MAX_STEPS_PER_SPAN: f64 = 65536.0;

/// Steps in each span of both directions, so that each direction has half of the slack.
fn steps(shape: &Polynomials, bounds: &[[f64; 3]], slack: f64) -> [Vec<usize>; 2] {
    let most = |which: usize| bounds.iter().map(|b| b[which]).fold(0.0, f64::max);
    let counts = shape.spans().each_ref().map(Spans::count);
    // 2hk M₂ is no more than (r h² + k² / r) M₂.
    let ratio = Some((most(0) / most(2)).sqrt()).filter(|r| *r > 0.0 && r.is_finite()).unwrap_or(1.0);
    let mut out = [vec![1; counts[0]], vec![1; counts[1]]];
    for (cell, [ss, st, tt]) in bounds.iter().enumerate() {
        let bends = [ss + ratio * st, tt + st / ratio];
        for (k, at) in [cell / counts[1], cell % counts[1]].into_iter().enumerate() {
            let n = (bends[k] / slack).sqrt().ceil().clamp(1.0, MAX_STEPS_PER_SPAN);
            out[k][at] = out[k][at].max(n as usize);
        }
    }
    out
}
