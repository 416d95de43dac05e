//! Feet on B-spline surfaces.

use super::foot::Foot;
use super::net::Net;
use super::patch::Patch;
use super::seams::{ROUNDED_PLACE_SHARE, iso_curve};
use crate::curve::CurveFeet;
use trueness_geom::space::{Aabb, Point, dot, minus, norm};
use trueness_geom::spline::basis::Knots;
use trueness_geom::spline::curve::Curve;
use trueness_geom::spline::surface::{Direction, Jet, Nurbs, SurfaceFoot, descend};
use trueness_geom::spline::value::Mass;

/// A B-spline surface in pieces between its knots, and its lines where it may have a crease or an end.
#[derive(Clone, Debug)]
pub(super) struct SplineFeet {
    /// Row after row: those of the first span of `u` come first.
    pub(super) patches: Vec<Patch>,
    /// The same in smaller parts, for the search.
    pieces: Vec<Patch>,
    /// Ends of the spans in both directions.
    pub(super) knots: [Vec<f64>; 2],
    lines: Vec<Line>,
    /// Diagonal of the box of the control points.
    pub(super) size: f64,
    /// What is nearer by less is not looked for.
    epsilon: f64,
}

/// Pieces of a surface at most, unless it has more spans: its boxes must be looked through where nothing is known of the place.
const MAX_PIECES_OF_SURFACE: usize = 1 << 14;
/// Halvings of a span at most.
const MAX_PIECE_DEPTH: u32 = 6;
/// Cosine up to which two directions are at right angles.
const RIGHT_ANGLE: f64 = 1e-6;

/// Share of a part's size up to which a descent that ends beside a foot goes on over all of the surface: over the end of the part, or
/// anew where it had come to rest too soon.
const BESIDE_END_SHARE: f64 = 0.5;
/// Roundings up to which a descent comes to a place.
const SETTLED: f64 = 100.0;

/// A line along which a parameter is held.
#[derive(Clone, Debug)]
struct Line {
    held: usize,
    at: f64,
    feet: CurveFeet,
    /// Whether it is an end of the domain where the surface does not go on, and no pole.
    is_border: bool,
}

/// Share of the size below which a nearer place is not looked for, and roundings of the greatest coordinate.
const EPSILON: [f64; 2] = [1e-14, 32.0 * f64::EPSILON];

impl SplineFeet {
    pub(super) fn new(nurbs: &Nurbs, periods: [Option<f64>; 2]) -> SplineFeet {
        let points = nurbs.control_points();
        let [m, n] = nurbs.counts();
        let [knots_u, knots_v] = nurbs.knots();
        // First along v, then along u.
        let masses: Vec<Mass<3>> = points.iter().map(|(p, w)| Mass::new(*p, *w)).collect();
        let rows: Vec<Vec<Mass<3>>> =
            (0..m).map(|i| beziers(knots_v, masses[i * n..(i + 1) * n].to_vec())).collect();
        let width = rows.first().map_or(0, Vec::len);
        let columns: Vec<Vec<Mass<3>>> =
            (0..width).map(|j| beziers(knots_u, rows.iter().map(|r| r[j]).collect())).collect();
        let knots = [knots_u, knots_v].map(Knots::distinct);
        let [p, q] = [knots_u, knots_v].map(Knots::degree);
        let mut patches = vec![];
        for (i, u) in knots[0].windows(2).enumerate() {
            for (j, v) in knots[1].windows(2).enumerate() {
                let at = |k: usize| columns[j * q + k % (q + 1)][i * p + k / (q + 1)];
                let net = Net { counts: [p + 1, q + 1], values: (0..(p + 1) * (q + 1)).map(at).collect() };
                patches.push(Patch::new(net, [[u[0], u[1]], [v[0], v[1]]]));
            }
        }
        let depth = (MAX_PIECES_OF_SURFACE / patches.len().max(1)).max(1).ilog2();
        let pieces = patches.iter().flat_map(|patch| patch.pieces(depth.min(MAX_PIECE_DEPTH))).collect();
        let bounds = Aabb::of(&points.iter().map(|p| p.0).collect::<Vec<_>>());
        let size = bounds.diagonal();
        let mut lines = vec![];
        for held in [Direction::U, Direction::V] {
            let own = &nurbs.knots()[held as usize];
            let (from, to) = own.domain();
            let across = nurbs.knots()[1 - held as usize].domain();
            for t in own.distinct() {
                if t == from || t == to || own.multiplicity(t) >= own.degree() {
                    let feet = CurveFeet::new(&iso_curve(nurbs, held, t), across.into());
                    // At a pole no edge stands for the end.
                    let is_pole = feet.bounds().diagonal() <= ROUNDED_PLACE_SHARE * size;
                    let is_end = t == from || t == to;
                    let is_border = is_end && periods[held as usize].is_none() && !is_pole;
                    lines.push(Line { held: held as usize, at: t, feet, is_border });
                }
            }
        }
        let farthest = bounds.min.iter().chain(&bounds.max).fold(0.0, |m: f64, x| m.max(x.abs()));
        let epsilon = EPSILON[0] * size + EPSILON[1] * farthest;
        SplineFeet { patches, pieces, knots, lines, size, epsilon }
    }

    /// See [`super::SurfaceFeet::visit`].
    pub(super) fn visit(&self, p: Point, limit: f64, visit: &mut dyn FnMut(Foot) -> f64) {
        let mut limit = limit;
        for line in &self.lines {
            limit = line.visit(p, limit, visit);
        }
        let mut order: Vec<(f64, &Patch)> =
            self.pieces.iter().map(|piece| (piece.bounds.distance(&p), piece)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (distance, patch) in order {
            if distance >= limit {
                break;
            }
            limit = self.visit_patch(patch, p, limit, visit);
        }
    }

    /// The pieces, then the lines that are no border.
    pub(super) fn units(&self) -> usize {
        self.pieces.len() + self.creases().count()
    }

    fn creases(&self) -> impl Iterator<Item = &Line> {
        self.lines.iter().filter(|line| !line.is_border)
    }

    /// See [`super::SurfaceFeet::unit`].
    pub(super) fn unit(&self, unit: usize) -> Option<(Aabb, [f64; 2])> {
        if let Some(patch) = self.pieces.get(unit) {
            return Some((patch.bounds, patch.range.map(|[a, b]| 0.5 * (a + b))));
        }
        let line = self.creases().nth(unit - self.pieces.len())?;
        let other = &self.knots[1 - line.held];
        let middle = 0.5 * (other[0] + other[other.len() - 1]);
        Some((line.feet.bounds(), if line.held == 0 { [line.at, middle] } else { [middle, line.at] }))
    }

    /// The feet on one unit.
    pub(super) fn visit_unit(&self, unit: usize, p: Point, limit: f64, visit: &mut dyn FnMut(Foot) -> f64) {
        if let Some(patch) = self.pieces.get(unit) {
            self.visit_patch(patch, p, limit, visit);
        } else if let Some(line) = self.creases().nth(unit - self.pieces.len()) {
            line.visit(p, limit, visit);
        }
    }

    /// The feet on one patch; says the new limit.
    fn visit_patch(&self, patch: &Patch, p: Point, limit: f64, visit: &mut dyn FnMut(Foot) -> f64) -> f64 {
        let mut limit = limit;
        patch.minima(p, limit, self.epsilon, |start, [[a, b], [c, d]]| {
            let (foot, jet) = descend(|at| patch.jet(at), [(a, b), (c, d)], p, start);
            let SurfaceFoot { parameters, place, distance, .. } = foot;
            let found = Foot { parameters: patch.parameters(parameters), place, distance };
            // What a descent comes to at an end of the part is no foot: that is another part's, or a line's. A foot on the end
            // itself would be of neither, as both come near to it only.
            let found = if self.is_foot(&found, &jet, p) {
                Some(found)
            } else if tangential(&found, &jet, p) <= BESIDE_END_SHARE * patch.bounds.diagonal() {
                let over = self.local(p, found.parameters, [None; 2]);
                self.is_foot(&over, &self.jet(over.parameters), p).then_some(over)
            } else {
                None
            };
            if let Some(foot) = found {
                limit = visit(foot);
            }
            limit
        });
        limit
    }

    /// Whether the way to the point is at right angles to the surface.
    fn is_foot(&self, foot: &Foot, jet: &Jet, p: Point) -> bool {
        tangential(foot, jet, p) <= RIGHT_ANGLE * foot.distance + SETTLED * self.epsilon
    }

    /// The foot that a descent from these parameters comes to; where a parameter has a period, over the seam.
    pub(super) fn local(&self, p: Point, near: [f64; 2], periods: [Option<f64>; 2]) -> Foot {
        let domain = self.knots.each_ref().map(|k| (k[0], k[k.len() - 1]));
        let mut start = [0, 1].map(|k| match periods[k] {
            Some(period) => domain[k].0 + (near[k] - domain[k].0).rem_euclid(period),
            None => near[k],
        });
        let mut best: Option<Foot> = None;
        // Over the seam of each direction once, and from there once more.
        for _ in 0..4 {
            let (foot, _) = descend(|at| self.jet(at), domain, p, start);
            let SurfaceFoot { parameters, place, distance, .. } = foot;
            if best.is_none_or(|b| distance < b.distance) {
                best = Some(Foot { parameters, place, distance });
            } else {
                break;
            }
            let mut is_over = false;
            start = [0, 1].map(|k| {
                let at = parameters[k];
                let (from, to) = domain[k];
                if periods[k].is_none() || at > from && at < to {
                    return at;
                }
                is_over = true;
                if at == from { to } else { from }
            });
            if !is_over {
                break;
            }
        }
        best.unwrap_or(Foot { parameters: near, place: [f64::NAN; 3], distance: f64::NAN })
    }

    pub(super) fn jet(&self, at: [f64; 2]) -> Jet {
        let span = |k: usize| {
            let knots = &self.knots[k];
            knots.partition_point(|t| *t <= at[k]).clamp(1, knots.len() - 1) - 1
        };
        let patch = &self.patches[span(0) * (self.knots[1].len() - 1) + span(1)];
        let widths = patch.range.map(|[a, b]| b - a);
        let own = [0, 1].map(|k| ((at[k] - patch.range[k][0]) / widths[k]).clamp(0.0, 1.0));
        let mut jet = patch.jet(own);
        for k in 0..3 {
            (0..2).for_each(|d| jet.first[d][k] /= widths[d]);
            jet.second[0][k] /= widths[0] * widths[0];
            jet.second[1][k] /= widths[0] * widths[1];
            jet.second[2][k] /= widths[1] * widths[1];
        }
        jet
    }
}

/// The longer of the two parts of the way to the point along the derivatives.
fn tangential(foot: &Foot, jet: &Jet, p: Point) -> f64 {
    let away = minus(p, foot.place);
    jet.first.iter().map(|d| dot(*d, away).abs() / norm(*d)).filter(|x| !x.is_nan()).fold(0.0, f64::max)
}

impl Line {
    /// Hands over its nearest places and ends; says the new limit.
    fn visit(&self, p: Point, limit: f64, visit: &mut dyn FnMut(Foot) -> f64) -> f64 {
        let mut limit = limit;
        self.feet.candidates(p, limit, |foot| {
            let parameters =
                if self.held == 0 { [self.at, foot.parameter] } else { [foot.parameter, self.at] };
            limit = visit(Foot { parameters, place: foot.place, distance: foot.distance });
            limit
        });
        limit
    }
}

/// Control points of the pieces between the knots, ends shared.
fn beziers(knots: &Knots, points: Vec<Mass<3>>) -> Vec<Mass<3>> {
    let (from, to) = knots.domain();
    let Ok(curve) = Curve::new(knots.clone(), points) else { return vec![] };
    // Knots that do not stand as often as the degree at the ends are made to.
    curve.part(from, to).as_ref().unwrap_or(&curve).bezier()
}
