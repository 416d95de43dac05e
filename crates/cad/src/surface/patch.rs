//! Where the distance from a polynomial or rational piece of a surface has minima.
//!
//! As with curves ([`crate::curve`]), the squared distance `Y·Y / w²` and the numerators `D` of its two derivatives are polynomials in
//! Bernstein form. A part of the piece is done away with in one of four ways. No coefficient of `Y·Y − r²·w²` is below 0: it is nowhere
//! nearer than `r`. All coefficients of one `D`, or of a combination of both, have one sign: the distance stands still nowhere within. The
//! derivatives of both `D`, times the inverse of those in the middle, differ from the unit matrix by less than 1: `D` takes every value
//! once at most, and a descent finds the only place. Else it is halved. Mostly none of this is needed: bounds of the derivatives say
//! that there is one foot, or none ([`super::convex`]).

use super::bends::Bends;
use super::convex::{Convexity, Minima, PRODUCT_ROUNDING};
use super::net::{Net, one_sign};
use trueness_geom::space::{Aabb, Point, Vector, dot, minus, norm, unit};
use trueness_geom::spline::surface::Jet;
use trueness_geom::spline::value::{Mass, Value};

/// Halvings of a part at most; by then it is as short as a rounding of its parameters.
const DEPTH: u32 = 90;
/// Parts looked at for one point at most.
const MAX_PARTS_SEARCHED: usize = 20_000;
/// Parts of a piece that bounds of its derivatives are asked of at most, and that are open at a time.
const MAX_PARTS_BY_BOUNDS: usize = 48;
const MAX_OPEN_PARTS: usize = 16;
/// A piece is halved until the distance is convex over it for points of so many times its size.
const CONVEX_SIZES: f64 = 1.0;
/// How far the derivatives may differ from those in the middle of a part that has one foot at most; below 1.
const UNIQUE: f64 = 0.9;

/// A piece of a surface over a rectangle of its parameters.
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    pub(crate) net: Net<Mass<3>>,
    /// First and last `u`, first and last `v`.
    pub(crate) range: [[f64; 2]; 2],
    /// Around the control points.
    pub(super) bounds: Aabb,
    /// Of a piece that is searched.
    convexity: Option<Convexity>,
}

/// A part of a patch that is not done with.
struct Part {
    /// First and last share of the way along `u` and `v`.
    range: [[f64; 2]; 2],
    square: Net<f64>,
    weights: Net<f64>,
    slopes: [Net<f64>; 2],
    depth: u32,
}

/// What becomes of a part.
enum Verdict {
    Nothing,
    OneFoot,
    Halved(usize),
}

impl Patch {
    pub(super) fn new(net: Net<Mass<3>>, range: [[f64; 2]; 2]) -> Patch {
        let places: Vec<Point> = net.values.iter().filter_map(Mass::place).collect();
        Patch { net, range, bounds: Aabb::of(&places), convexity: None }
    }

    /// A piece of a curve, along `u`.
    pub(crate) fn of_curve(points: &[Mass<3>], range: [f64; 2]) -> Patch {
        Patch::new(Net { counts: [points.len(), 1], values: points.to_vec() }, [range, [0.0, 1.0]])
    }

    /// Parts of it over each of which the distance is convex from points no farther away than some of its sizes. Next to a pole there is no
    /// such part, so none is halved more than `depth` times.
    pub(super) fn pieces(&self, depth: u32) -> Vec<Patch> {
        let mut open = vec![(self.clone(), Bends::new(&self.net), [1.0; 2], depth)];
        let mut done: Vec<Patch> = vec![];
        while let Some((mut piece, bends, sides, depth)) = open.pop() {
            let jet = piece.jet([0.5; 2]);
            let convexity = Convexity::new(&bends, sides, &jet, &piece.bounds);
            if depth == 0 || convexity.holds(CONVEX_SIZES * piece.bounds.diagonal()) {
                piece.convexity = Some(convexity);
                done.push(piece);
                continue;
            }
            let k = usize::from(norm(jet.first[1]) > norm(jet.first[0]));
            let mut half = sides;
            half[k] *= 0.5;
            let [first, second] = bends.halves(k);
            let [a, b] = piece.halves(k);
            open.extend([(b, second, half, depth - 1), (a, first, half, depth - 1)]);
        }
        done
    }

    fn halves(&self, k: usize) -> [Patch; 2] {
        let middle = 0.5 * (self.range[k][0] + self.range[k][1]);
        let mut ranges = [self.range; 2];
        (ranges[0][k][1], ranges[1][k][0]) = (middle, middle);
        let [a, b] = self.net.halves(k);
        [Patch::new(a, ranges[0]), Patch::new(b, ranges[1])]
    }

    /// Hands over shares of the way along `u` and `v` that are near to each place within where the distance from `p` may have a minimum of
    /// less than `limit`, with the rectangle in which a descent from there finds it. The callback says a new limit. Minima on the border
    /// are handed over where the distance stands still there. What is nearer than `limit` by less than `epsilon` may be left out.
    pub(super) fn minima(
        &self,
        p: Point,
        mut limit: f64,
        epsilon: f64,
        mut visit: impl FnMut([f64; 2], [[f64; 2]; 2]) -> f64,
    ) {
        if self.is_beyond(p, limit) {
            return;
        }
        if self.is_done_by_bounds(p, &mut limit, &mut visit) {
            return;
        }
        let about = self.net.map(|m| Mass { moment: m.moment.plus(-m.mass, p), mass: m.mass });
        let square = about.product(&about, |a, b| dot(a.moment, b.moment));
        let masses = about.map(|m| m.mass);
        let weights = masses.product(&masses, |a, b| a * b);
        let lost = PRODUCT_ROUNDING * square.greatest();
        // Most pieces are done away with at once: the slopes cost more.
        let reach = (limit - epsilon).max(0.0);
        let is_beyond = |(s, w): (&f64, &f64)| *s > reach * reach * w + lost;
        if square.values.iter().zip(&weights.values).all(is_beyond) {
            return;
        }
        let slopes = [0, 1].map(|k| slope(&square, &masses, k));
        let noise = [0, 1].map(|k| lost * (square.counts[k] - 1).max(1) as f64 * masses.greatest());
        let mut open = vec![Part { range: [[0.0, 1.0]; 2], square, weights, slopes, depth: 0 }];
        for _ in 0..MAX_PARTS_SEARCHED {
            let Some(part) = open.pop() else { return };
            let reach = (limit - epsilon).max(0.0);
            let beyond = reach * reach;
            let is_beyond = |(s, w): (&f64, &f64)| *s > beyond * w + lost;
            if reach == 0.0 || part.square.values.iter().zip(&part.weights.values).all(is_beyond) {
                continue;
            }
            let middle = part.range.map(|[a, b]| 0.5 * (a + b));
            match part.verdict(noise) {
                Verdict::Nothing => {}
                Verdict::OneFoot => limit = visit(middle, part.range),
                Verdict::Halved(_) if part.depth >= DEPTH => limit = visit(middle, part.range),
                Verdict::Halved(k) => {
                    // A first foot lets most parts be done away with.
                    if part.depth < 2 {
                        limit = visit(middle, [[0.0, 1.0]; 2]);
                    }
                    let [first, second] = part.halves(k);
                    // The one that may be nearer lies last: what it holds does away with the other one.
                    let is_nearer = second.square.least() < first.square.least();
                    open.extend(if is_nearer { [first, second] } else { [second, first] });
                }
            }
        }
    }

    /// Halves it as long as bounds of its derivatives leave open what is within; whether they do not in the end.
    fn is_done_by_bounds(
        &self,
        p: Point,
        limit: &mut f64,
        visit: &mut impl FnMut([f64; 2], [[f64; 2]; 2]) -> f64,
    ) -> bool {
        let Some(whole) = &self.convexity else { return false };
        match whole.minima(&p, &self.bounds, *limit) {
            Minima::None => return true,
            Minima::One => {
                *limit = visit([0.5; 2], [[0.0, 1.0]; 2]);
                return true;
            }
            Minima::Unknown => {}
        }
        let mut open = [[[0.0, 1.0]; 2]; MAX_OPEN_PARTS];
        let mut count = 1;
        for _ in 0..MAX_PARTS_BY_BOUNDS {
            if count == 0 {
                return true;
            }
            count -= 1;
            let range = open[count];
            let middle = range.map(|[a, b]| 0.5 * (a + b));
            let jet = self.jet(middle);
            let (part, bounds) = whole.part(range, &jet, &self.bounds);
            match part.minima(&p, &bounds, *limit) {
                Minima::None => {}
                Minima::One => *limit = visit(middle, range),
                Minima::Unknown if count + 2 > MAX_OPEN_PARTS => return false,
                Minima::Unknown => {
                    let extent = |k: usize| norm(jet.first[k]) * (range[k][1] - range[k][0]);
                    let k = usize::from(extent(1) > extent(0));
                    let mut halves = [range; 2];
                    (halves[0][k][1], halves[1][k][0]) = (middle[k], middle[k]);
                    // The one that is nearer about lies last: what it holds does away with the other one.
                    if dot(minus(jet.place, p), jet.first[k]) > 0.0 {
                        halves.reverse();
                    }
                    open[count..count + 2].copy_from_slice(&halves);
                    count += 2;
                }
            }
        }
        count == 0
    }

    /// Whether all control points lie beyond a plane at this distance across the way to their middle.
    fn is_beyond(&self, p: Point, limit: f64) -> bool {
        let middle = [0, 1, 2].map(|k| 0.5 * (self.bounds.min[k] + self.bounds.max[k]));
        let Some((way, _)) = unit(minus(middle, p)) else { return false };
        let height = dot(p, way) + limit;
        self.net.values.iter().all(|m| dot(m.moment, way) > height * m.mass)
    }

    /// The parameters of shares of the way.
    pub(super) fn parameters(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.range[k][0] + at[k] * (self.range[k][1] - self.range[k][0]))
    }

    /// Place and derivatives by the shares of the way.
    pub(crate) fn jet(&self, at: [f64; 2]) -> Jet {
        let six = self.net.six(at);
        let w = six[0].mass;
        let part = |k: usize, less: &[(f64, Point)]| -> Vector {
            let top = less.iter().fold(six[k].moment, |sum, (by, p)| sum.plus(-by, *p));
            top.map(|x| x / w)
        };
        let place = part(0, &[]);
        let [wu, wv, wuu, wuv, wvv] = [1, 2, 3, 4, 5].map(|k| six[k].mass);
        let (su, sv) = (part(1, &[(wu, place)]), part(2, &[(wv, place)]));
        let second = [
            part(3, &[(2.0 * wu, su), (wuu, place)]),
            part(4, &[(wu, sv), (wv, su), (wuv, place)]),
            part(5, &[(2.0 * wv, sv), (wvv, place)]),
        ];
        Jet { place, first: [su, sv], second }
    }
}

impl Part {
    fn verdict(&self, noise: [f64; 2]) -> Verdict {
        let [u, v] = &self.slopes;
        if u.has_one_sign(noise[0]) || v.has_one_sign(noise[1]) {
            return Verdict::Nothing;
        }
        let wider = {
            let bends = [0, 1].map(|k| self.square.bend(k));
            usize::from(bends[1] > bends[0])
        };
        // Below its rounding a slope says nothing: the distance is the same all along.
        if u.greatest() <= noise[0] && v.greatest() <= noise[1] {
            return Verdict::OneFoot;
        }
        let Some(inverse) = inverse(&self.slopes) else { return Verdict::Halved(wider) };
        for row in inverse {
            let sizes = row[0].abs() * noise[0] + row[1].abs() * noise[1];
            if u.counts == v.counts {
                let both = u.values.iter().zip(&v.values).map(|(a, b)| row[0] * a + row[1] * b);
                if one_sign(both, sizes) {
                    return Verdict::Nothing;
                }
            }
        }
        let [of_u, of_v] = self.slopes.each_ref().map(|s| [0, 1].map(|k| s.steps(k)));
        let mut off = 0.0f64;
        for (i, row) in inverse.iter().enumerate() {
            let mut sum = 0.0;
            for (k, (u, v)) in of_u.iter().zip(&of_v).enumerate() {
                let [p, q] = [u.map(|x| row[0] * x), v.map(|x| row[1] * x)];
                let target = f64::from(u8::from(i == k));
                let low = p[0].min(p[1]) + q[0].min(q[1]) - target;
                let high = p[0].max(p[1]) + q[0].max(q[1]) - target;
                sum += low.abs().max(high.abs());
            }
            off = off.max(sum);
        }
        if off.is_nan() || off >= UNIQUE {
            return Verdict::Halved(wider);
        }
        let determinant = inverse[0][0] * inverse[1][1] - inverse[0][1] * inverse[1][0];
        // A saddle is not a minimum.
        if determinant < 0.0 { Verdict::Nothing } else { Verdict::OneFoot }
    }

    fn halves(self, k: usize) -> [Part; 2] {
        let [s0, s1] = self.square.halves(k);
        let [w0, w1] = self.weights.halves(k);
        let [[u0, u1], [v0, v1]] = self.slopes.each_ref().map(|s| s.halves(k));
        let middle = 0.5 * (self.range[k][0] + self.range[k][1]);
        let (mut first, mut second) = (self.range, self.range);
        first[k][1] = middle;
        second[k][0] = middle;
        let depth = self.depth + 1;
        [
            Part { range: first, square: s0, weights: w0, slopes: [u0, v0], depth },
            Part { range: second, square: s1, weights: w1, slopes: [u1, v1], depth },
        ]
    }
}

/// The numerator of the derivative of the squared distance along a direction.
fn slope(square: &Net<f64>, masses: &Net<f64>, k: usize) -> Net<f64> {
    let by = square.derivative(k);
    if masses.values.iter().all(|w| *w == masses.values[0]) {
        return by.map(|d| d * masses.values[0]);
    }
    let multiply = |a: &Net<f64>, b: &Net<f64>| a.product(b, |x, y| x * y);
    let (first, second) = (multiply(&by, masses), multiply(square, &masses.derivative(k)));
    let values = first.values.iter().zip(&second.values).map(|(a, b)| a - 2.0 * b).collect();
    Net { counts: first.counts, values }
}

/// The inverse of the derivatives of both slopes in the middle of the part.
fn inverse(slopes: &[Net<f64>; 2]) -> Option<[[f64; 2]; 2]> {
    let [[a, b], [c, d]] = slopes.each_ref().map(|s| [0, 1].map(|k| s.middle_step(k)));
    let determinant = a * d - b * c;
    let rows = [[d / determinant, -b / determinant], [-c / determinant, a / determinant]];
    rows.iter().flatten().all(|x| x.is_finite()).then_some(rows)
}
