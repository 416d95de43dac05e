//! Polygons become triangles.
//!
//! A fan where the polygon is convex, ears cut off where it is not (G. H. Meisters, Polygons have ears, Amer. Math.
//! Monthly 82, 1975). The polygon is seen along its area vector (M. E. Newell); what that hides, being far from
//! plane or crossing itself, is cut somehow, but always into two triangles fewer than it has corners.

use trueness_geom::space::{Point, cross, minus, norm, plus};

/// Cuts the polygon `corners` (indices into `positions`, all of them valid) and hands each triangle to `out`.
///
/// Fewer than three corners give nothing. Cost: linear where convex, else quadratic in the number of corners.
pub(crate) fn triangulate(positions: &[Point], corners: &[u32], mut out: impl FnMut([u32; 3])) {
    let [a, b, rest @ ..] = corners else { return };
    if let [c] = rest {
        return out([*a, *b, *c]);
    }
    let at = |i: usize| positions[corners[i] as usize];
    let Some(mut ears) = Ears::new((0..corners.len()).map(at).collect()) else {
        return fan(corners, out);
    };
    if ears.convex() {
        return fan(corners, out);
    }
    ears.cut(|triangle| out(triangle.map(|i| corners[i])));
}

fn fan(corners: &[u32], mut out: impl FnMut([u32; 3])) {
    let [first, rest @ ..] = corners else { return };
    for pair in rest.windows(2) {
        out([*first, pair[0], pair[1]]);
    }
}

/// Corners seen in the plane of the polygon, counter-clockwise, and which of them are left.
struct Ears {
    places: Vec<[f64; 2]>,
    left: Vec<usize>,
    gone: Vec<bool>,
    /// For each corner: no corner before this one lies in its triangle. It only grows while the triangle stays the same, so
    /// that every corner is looked at once for each triangle.
    clear: Vec<usize>,
}

/// Beyond this many corners a polygon is cut as a fan: a file full of longer ones, made to do harm, would take minutes.
const MOST: usize = 4096;

impl Ears {
    /// `None` where the polygon has no area to look along.
    fn new(corners: Vec<Point>) -> Option<Ears> {
        let n = corners.len();
        if n > MOST {
            return None;
        }
        // Relative to the first corner: far from the origin the products would lose their digits.
        let near: Vec<Point> = corners.iter().map(|p| minus(*p, corners[0])).collect();
        let area = (0..n).fold([0.0; 3], |sum, i| plus(sum, cross(near[i], near[(i + 1) % n])));
        if !(norm(area) > 0.0 && norm(area).is_finite()) {
            return None;
        }
        // Leave out the greatest component of the normal, keeping the sense of rotation.
        let axis = (0..3).max_by(|a, b| area[*a].abs().total_cmp(&area[*b].abs()))?;
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let (u, v) = if area[axis] > 0.0 { (u, v) } else { (v, u) };
        let places = near.iter().map(|p| [p[u], p[v]]).collect();
        Some(Ears { places, left: (0..n).collect(), gone: vec![false; n], clear: vec![0; n] })
    }

    /// Twice the area of a triangle of places, positive when counter-clockwise.
    fn turn(&self, a: usize, b: usize, c: usize) -> f64 {
        let [a, b, c] = [a, b, c].map(|i| self.places[i]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    fn around(&self, i: usize) -> [usize; 3] {
        let n = self.left.len();
        [self.left[(i + n - 1) % n], self.left[i], self.left[(i + 1) % n]]
    }

    /// No corner turns clockwise, and all turns together go round once.
    fn convex(&self) -> bool {
        let n = self.left.len();
        let edge = |i: usize| {
            let (a, b) = (self.places[i], self.places[(i + 1) % n]);
            [b[0] - a[0], b[1] - a[1]]
        };
        let whole: f64 = (0..n)
            .map(|i| {
                let (e, f) = (edge(i), edge((i + 1) % n));
                (e[0] * f[1] - e[1] * f[0]).atan2(e[0] * f[0] + e[1] * f[1])
            })
            .sum();
        let left = (0..n).all(|i| {
            let [a, b, c] = self.around(i);
            self.turn(a, b, c) >= 0.0
        });
        // Either one turn (6.28) or two (12.57) and more.
        left && whole < 9.0
    }

    /// An ear: a corner turning left whose triangle holds no other corner.
    fn ear(&mut self, i: usize) -> bool {
        let [a, b, c] = self.around(i);
        let inside = |p: usize| {
            let same = |q: usize| self.places[p] == self.places[q];
            !(same(a) || same(b) || same(c))
                && self.turn(a, b, p) >= 0.0
                && self.turn(b, c, p) >= 0.0
                && self.turn(c, a, p) >= 0.0
        };
        let n = self.places.len();
        if self.turn(a, b, c) > 0.0 {
            let first = (self.clear[b]..n).find(|&p| !self.gone[p] && inside(p));
            self.clear[b] = first.unwrap_or(n);
            return first.is_none();
        }
        false
    }

    fn cut(&mut self, mut out: impl FnMut([usize; 3])) {
        let mut i = 0;
        while self.left.len() > 3 {
            let n = self.left.len();
            // Where no corner is an ear, one that is flat does least harm, else any.
            let next = (i..i + n).map(|k| k % n).find(|&k| self.ear(k));
            let flat = || {
                (0..n).find(|&k| {
                    let [a, b, c] = self.around(k);
                    self.turn(a, b, c) == 0.0
                })
            };
            i = next.or_else(flat).unwrap_or(0);
            let [a, b, c] = self.around(i);
            out([a, b, c]);
            self.left.remove(i);
            self.gone[b] = true;
            (self.clear[a], self.clear[c]) = (0, 0);
        }
        if let [a, b, c] = self.left[..] {
            out([a, b, c]);
        }
    }
}

/// Area of a triangle; used to compare cuts in tests.
#[cfg(test)]
fn area(positions: &[Point], t: [u32; 3]) -> [f64; 3] {
    let [a, b, c] = t.map(|i| positions[i as usize]);
    trueness_geom::space::times(0.5, cross(minus(b, a), minus(c, a)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every triangle must point where the polygon does, and their areas must add up to its own.
    fn check(outline: &[[f64; 2]], expected: f64) {
        // Lifted into a slanted plane far from the origin.
        let lift = |p: &[f64; 2]| [p[0] + 1e4, p[1] - 1e4, 0.5 * p[0] - 0.25 * p[1]];
        let positions: Vec<Point> = outline.iter().map(lift).collect();
        let corners: Vec<u32> = (0..outline.len() as u32).collect();
        let mut triangles = vec![];
        triangulate(&positions, &corners, |t| triangles.push(t));
        assert_eq!(triangles.len(), outline.len() - 2);
        let z: Vec<f64> = triangles.iter().map(|t| area(&positions, *t)[2]).collect();
        assert!(z.iter().all(|a| *a >= -1e-12), "{z:?}");
        let sum: f64 = z.iter().sum();
        assert!((sum - expected).abs() < 1e-9, "{sum} {expected}");
    }

    #[test]
    fn concave_outlines() {
        check(&[[0., 0.], [4., 0.], [4., 4.], [0., 4.]], 16.0);
        check(&[[0., 0.], [4., 0.], [4., 4.], [2., 1.], [0., 4.]], 10.0);
        // A comb: reflex corners, corners in line.
        check(
            &[
                [0., 0.],
                [6., 0.],
                [6., 5.],
                [5., 5.],
                [5., 1.],
                [4., 1.],
                [4., 5.],
                [3., 5.],
                [3., 1.],
                [0., 1.],
            ],
            14.0,
        );
        // A star of ten corners, radii 1 and 3.
        let star: Vec<[f64; 2]> = (0..10)
            .map(|i| {
                let (r, a) = (if i % 2 == 0 { 3.0 } else { 1.0 }, f64::from(i) * std::f64::consts::PI / 5.0);
                [r * a.cos(), r * a.sin()]
            })
            .collect();
        check(&star, 15.0 * (std::f64::consts::PI / 5.0).sin());
    }

    /// The triangles of [`Ears::cut`], every corner looked at anew for every ear.
    fn plain(places: &[[f64; 2]]) -> Vec<[usize; 3]> {
        let (mut left, mut all, mut i) = ((0..places.len()).collect::<Vec<_>>(), vec![], 0);
        while left.len() > 2 {
            let now = |left: &[usize]| Ears {
                places: places.to_vec(),
                left: left.to_vec(),
                gone: (0..places.len()).map(|p| !left.contains(&p)).collect(),
                clear: vec![0; places.len()],
            };
            let n = left.len();
            let ears = &mut now(&left);
            let next = (i..i + n).map(|k| k % n).find(|&k| n > 3 && ears.ear(k));
            let turn = |k: usize| {
                let [a, b, c] = ears.around(k);
                ears.turn(a, b, c)
            };
            i = if n == 3 { 1 } else { next.or_else(|| (0..n).find(|&k| turn(k) == 0.0)).unwrap_or(0) };
            all.push(ears.around(i));
            left.remove(i);
        }
        all
    }

    #[test]
    fn what_is_remembered_changes_nothing() {
        let random = &mut trueness_geom::num::random::Random::new(5);
        for case in 0..60 {
            let n = 4 + random.below(40) as usize;
            let place = |k: usize| {
                let (r, angle) = (1.0 + random.unit(), k as f64 * std::f64::consts::TAU / n as f64);
                match case % 3 {
                    0 => [r * angle.cos(), r * angle.sin()],
                    1 => [random.unit(), random.unit()],
                    _ => [random.below(5) as f64, random.below(5) as f64],
                }
            };
            let places: Vec<[f64; 2]> = (0..n).map(place).collect();
            let mut ears = Ears {
                places: places.clone(),
                left: (0..n).collect(),
                gone: vec![false; n],
                clear: vec![0; n],
            };
            let mut got = vec![];
            ears.cut(|t| got.push(t));
            assert_eq!(got, plain(&places), "{case}");
        }
    }

    #[test]
    fn degenerate_outlines_still_give_all_triangles() {
        let positions = vec![[0.0; 3]; 5];
        let mut n = 0;
        triangulate(&positions, &[0, 1, 2, 3, 4], |_| n += 1);
        assert_eq!(n, 3);
        triangulate(&positions, &[0, 1], |_| n += 1);
        assert_eq!(n, 3);
        // A bow tie has as much area one way as the other: none to look along.
        let tie = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        triangulate(&tie, &[0, 1, 2, 3], |_| n += 1);
        assert_eq!(n, 5);
    }
}
