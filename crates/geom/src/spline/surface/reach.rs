//! How near a point must be to a surface for a foot of it to be the nearest place beyond doubt.
//!
//! Let the derivatives `J` of a surface, as seen on a plane, differ from fixed ones `J₀` by no more than `e`. Let `m` be the
//! least stretch of `J₀` seen there less `e`. Then places lie at least `m` times as far apart as their parameters. For the
//! domain is convex, and `J` is integrated along the straight line between them. Let a point have the distance `d` from a foot,
//! and let another place be no farther. Their parameters are at most `2d / m` apart. So on the line between them the surface is
//! nowhere farther from the point than `d + L d / m`, with the greatest stretch `L`. Half the second derivative of the squared
//! distance along it is at least `m² − M d (1 + L / m)`, with a bound `M` of the second derivatives. Where that is above 0 the
//! squared distance is convex along the line and stands still at the foot: the other place is not nearer. (What is the same for
//! all points within: a bound of the reach of Federer, Curvature measures, Transactions of the American Mathematical Society
//! 93, 1959.)

use super::Patches;
use crate::space::{Vector, cross, dot, minus, norm, times, unit};

/// Steps to the direction of the greatest spread. It need not be met: any plane is valid, the best one says most.
const SPREAD_STEPS: usize = 32;

impl Patches {
    /// A distance: of points nearer than that to a foot, a place where the squared distance stands still, no other place is nearer.
    ///
    /// It is 0 where the surface may turn back over itself, or bends without a bound. The bound fails where a derivative jumps,
    /// as at a knot that stands as often as the degree. Infinite for a plane. Cost: one pass over the patches.
    ///
    /// ```
    /// use trueness_geom::spline::{basis::Knots, surface::{Patches, Surface}};
    /// let knots = || Knots::uniform(2, 1, 0.0, 2.0);
    /// let height = |k: usize| if k == 4 { 0.4 } else { 0.0 };
    /// let points = (0..9).map(|k| [(k / 3) as f64, (k % 3) as f64, height(k)]).collect();
    /// let reach = Patches::new(&Surface::new([knots(), knots()], points).unwrap()).reach();
    /// // At its top it bends by a radius of 2.5.
    /// assert!(reach > 0.1 && reach < 2.5);
    /// ```
    pub fn reach(&self) -> f64 {
        let smooth =
            self.spans.iter().all(|s| (1..s.count()).all(|i| s.first(i) - s.first(i - 1) < s.degree()));
        let middle = self.mean_stretch();
        let normal = self.turning(middle);
        let Some(plane) = Plane::of(middle, normal).filter(|_| smooth) else { return 0.0 };
        let (mut off, mut most, mut bend) = (0.0f64, 0.0f64, 0.0f64);
        for cell in 0..self.spans[0].count() * self.spans[1].count() {
            let all = self.derivatives_of(cell);
            let own = all.stretch(|c| norm(*c), [[0.0; 3]; 2]);
            let shifted = all.stretch(|c| plane.seen(c), middle);
            most = most.max(libm::hypot(own[0], own[1]));
            off = off.max(libm::hypot(shifted[0], shifted[1]));
            bend = bend.max(all.bend());
        }
        let least = plane.least - off;
        if least > 0.0 { least * least / (bend * (1.0 + most / least)) } else { 0.0 }
    }

    /// The mean of the derivatives by `u` and by `v` in the middles of the patches.
    fn mean_stretch(&self) -> [Vector; 2] {
        let cells = self.spans[0].count() * self.spans[1].count();
        let mut sum = [[0.0; 3]; 2];
        for cell in 0..cells {
            let all = self.derivatives_of(cell);
            for (k, sum) in sum.iter_mut().enumerate() {
                let at = if k == 0 { all.q } else { 1 };
                (0..3).for_each(|d| sum[d] += all.coefficients[at][d] / (all.half[k] * cells as f64));
            }
        }
        sum
    }

    /// The direction in which the derivatives differ most from their mean: of heights over a plane that plane's normal. Any one,
    /// if they are all the same.
    fn turning(&self, [u, v]: [Vector; 2]) -> Vector {
        let mut spread = [[0.0; 3]; 3];
        for cell in 0..self.spans[0].count() * self.spans[1].count() {
            let all = self.derivatives_of(cell);
            // Ends of the patch as well: a single one has nothing to differ from.
            for (n, c) in all.coefficients.iter().enumerate() {
                let powers = [n / all.q, n % all.q];
                for k in 0..2 {
                    let own = c.map(|x| powers[k] as f64 / all.half[k] * x);
                    let constant = powers[k] == 1 && powers[1 - k] == 0;
                    let off = if constant { minus(own, [u, v][k]) } else { own };
                    (0..9).for_each(|e| spread[e / 3][e % 3] += off[e / 3] * off[e % 3]);
                }
            }
        }
        let mut found = unit(cross(u, v)).map_or([0.0, 0.0, 1.0], |(n, _)| n);
        for _ in 0..SPREAD_STEPS {
            let next = spread.map(|row| dot(row, found));
            found = unit(next).map_or(found, |(n, _)| n);
        }
        found
    }

    fn derivatives_of(&self, cell: usize) -> Derivatives<'_> {
        let columns = self.spans[1].count();
        let (coefficients, q) = self.patch(cell);
        let half = [self.spans[0].half(cell / columns), self.spans[1].half(cell % columns)];
        Derivatives { coefficients, q, half }
    }
}

/// A plane that a surface is seen on.
struct Plane {
    axes: [Vector; 2],
    /// Least stretch of the mean derivatives, as seen there.
    least: f64,
}

impl Plane {
    /// At right angles to `normal`; `None` where the derivatives are seen to span none.
    fn of(derivatives: [Vector; 2], normal: Vector) -> Option<Plane> {
        let [u, v] = derivatives.map(|d| minus(d, times(dot(d, normal), normal)));
        let (first, _) = unit(u)?;
        let (trace, area) = (dot(u, u) + dot(v, v), norm(cross(u, v)));
        // The smaller singular value, without a difference of near numbers.
        let root = (trace * trace - 4.0 * area * area).max(0.0).sqrt();
        let least = area * (2.0 / (trace + root)).sqrt();
        Some(Plane { axes: [first, cross(normal, first)], least })
    }
    /// Length of what is seen of a vector in the plane.
    fn seen(&self, a: &Vector) -> f64 {
        libm::hypot(dot(*a, self.axes[0]), dot(*a, self.axes[1]))
    }
}

/// The derivatives of a patch, by its polynomial.
struct Derivatives<'a> {
    coefficients: &'a [Vector],
    q: usize,
    half: [f64; 2],
}

impl Derivatives<'_> {
    /// How far the derivatives by `u` and by `v` are from these at most, lengths taken as told.
    fn stretch(&self, length: impl Fn(&Vector) -> f64, from: [Vector; 2]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (n, c) in self.coefficients.iter().enumerate() {
            let powers = [n / self.q, n % self.q];
            for k in 0..2 {
                let by = powers[k] as f64 / self.half[k];
                let constant = powers[k] == 1 && powers[1 - k] == 0;
                let own = c.map(|x| by * x);
                sum[k] += if constant { length(&minus(own, from[k])) } else { length(&own) };
            }
        }
        sum
    }
    /// Greatest second derivative in any direction, a bound.
    fn bend(&self) -> f64 {
        let [mut uu, mut uv, mut vv] = [0.0; 3];
        for (n, c) in self.coefficients.iter().enumerate() {
            let (a, b, size) = ((n / self.q) as f64, (n % self.q) as f64, norm(*c));
            uu += a * (a - 1.0) * size;
            uv += a * b * size;
            vv += b * (b - 1.0) * size;
        }
        let [h, k] = self.half;
        // With a direction of length 1, twice the product of its parts is no more than 1.
        (uu / (h * h)).max(vv / (k * k)) + uv / (h * k)
    }
}
