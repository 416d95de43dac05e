//! Planes, and coordinates in them.

use crate::num::dense::eigen;
use crate::num::exact::Exact;
use crate::space::{Point, Vector, cross, dot, minus, plus, times, unit};

/// The plane of all points `p` with `normal · p = offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// At right angles to it; of any length but 0.
    pub normal: Vector,
    /// Times the length of the normal, the distance of the origin.
    pub offset: f64,
}

/// Two axes of a plane at right angles, with an origin: coordinates there and back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneFrame {
    /// The place with the coordinates 0, 0.
    pub origin: Point,
    /// Direction of the first axis.
    pub x: Vector,
    /// Direction of the second axis; with the normal the third, right-handed.
    pub y: Vector,
}

/// Components of a normal that differ by less than this are alike: rounding and noise do not decide between them.
const ALIKE_COMPONENTS: f64 = 0.1;

/// Sums of squares that differ by fewer variances do not tell two planes apart. The tilt of one of them has two unknowns, which
/// chance makes that large in one row of four hundred.
const MIN_TILT_VARIANCES: f64 = 12.0;
/// Share of the squares of the lengths up to which squares of heights are rounding.
const HEIGHT_ROUNDING: f64 = 1e-20;

impl Plane {
    /// A frame in the plane. Its origin is the foot of the coordinates' origin. Its first axis runs as that axis of the
    /// coordinates does which the normal leans on least; the first of equal ones. `None` where the normal has no direction.
    pub fn frame(&self) -> Option<PlaneFrame> {
        let (normal, length) = unit(self.normal)?;
        let low = normal.iter().fold(1.0, |low: f64, x| low.min(x.abs()));
        let least = (0..3).find(|k| normal[*k].abs() <= low + ALIKE_COMPONENTS)?;
        let mut axis = [0.0; 3];
        axis[least] = 1.0;
        let (y, _) = unit(cross(normal, axis))?;
        Some(PlaneFrame { origin: times(self.offset / length, normal), x: cross(y, normal), y })
    }

    /// The sign of `normal · p − offset`, exact.
    pub fn side(&self, p: &Point) -> i32 {
        let terms: [f64; 4] =
            [self.normal[0] * p[0], self.normal[1] * p[1], self.normal[2] * p[2], -self.offset];
        let rounded: f64 = terms.iter().sum();
        // Three products, three sums: seven roundings at most.
        let bound = 8.0 * f64::EPSILON * terms.iter().map(|t| t.abs()).sum::<f64>();
        if rounded.abs() > bound {
            return if rounded > 0.0 { 1 } else { -1 };
        }
        let mut sum = Exact::default();
        (0..3).for_each(|k| sum.add_product(self.normal[k], p[k], 1.0));
        sum.add(-self.offset);
        sum.sign()
    }

    /// `normal · p − offset`, rounded.
    pub fn height(&self, p: &Point) -> f64 {
        dot(self.normal, *p) - self.offset
    }
}

impl Default for PlaneFrame {
    /// That of the first two coordinates.
    fn default() -> PlaneFrame {
        PlaneFrame { origin: [0.0; 3], x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0] }
    }
}

impl PlaneFrame {
    /// At right angles to both axes.
    pub fn normal(&self) -> Vector {
        // 0 and no minus 0.
        cross(self.x, self.y).map(|x| x + 0.0)
    }
    /// Coordinates of a place in the plane.
    pub fn flat(&self, p: Point) -> [f64; 2] {
        let d = minus(p, self.origin);
        [dot(d, self.x), dot(d, self.y)]
    }
    /// The place with these coordinates.
    pub fn place(&self, p: [f64; 2]) -> Point {
        plus(plus(self.origin, times(p[0], self.x)), times(p[1], self.y))
    }

    /// The plane of least squares through points in space, and their greatest distance from it. `None` where they lie on a
    /// line, or are fewer than three. The greatest component of its normal is positive, the first of those that are alike.
    /// Where the points do not tell it from that axis of the coordinates, the normal is the axis. Far from the origin the least
    /// tilt moves all coordinates.
    pub fn through(points: &[Point]) -> Option<(PlaneFrame, f64)> {
        let n = points.len() as f64;
        // From the same end whichever way round they are given: sums round as their order is.
        let last = points.last().filter(|last| last.iter().lt(points[0].iter()));
        let in_turn = |i: usize| if last.is_some() { points[points.len() - 1 - i] } else { points[i] };
        let middle: Point = std::array::from_fn(|k| (0..points.len()).map(|i| in_turn(i)[k] / n).sum());
        let mut scatter = [[0.0; 3]; 3];
        for i in 0..points.len() {
            let d = minus(in_turn(i), middle);
            (0..9).for_each(|k| scatter[k / 3][k % 3] += d[k / 3] * d[k % 3]);
        }
        let (values, rows) = eigen(scatter);
        if points.len() < 3 || values[1] <= 1e-12 * values[2] {
            return None;
        }
        let high = rows[0].iter().fold(0.0, |high: f64, x| high.max(x.abs()));
        let greatest = (0..3).find(|k| rows[0][*k].abs() >= high - ALIKE_COMPONENTS)?;
        let mut normal = times(1.0_f64.copysign(rows[0][greatest]), rows[0]);
        let square = |i: usize| dot(normal, minus(in_turn(i), middle)).powi(2);
        let squares: f64 = (0..points.len()).map(square).sum();
        let untold = MIN_TILT_VARIANCES * squares / (n - 3.0).max(1.0) + HEIGHT_ROUNDING * values[2];
        if scatter[greatest][greatest] - squares <= untold {
            normal = std::array::from_fn(|k| if k == greatest { 1.0 } else { 0.0 });
        }
        let frame = Plane { normal, offset: dot(normal, middle) }.frame()?;
        let off = points.iter().map(|p| dot(minus(*p, frame.origin), normal).abs()).fold(0.0, f64::max);
        Some((frame, off))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::random::Random;
    use crate::space::norm;

    /// Rows around an ellipse in planes whose normals are on the verge of another frame, of exact numbers and with noise,
    /// either way round. The result is always the frame of the plane itself.
    #[test]
    fn rows_in_space_have_the_frame_of_their_plane() {
        let random = &mut Random::new(3);
        let root = 0.5_f64.sqrt();
        for (normal, offset) in [
            ([0.0, 0.0, 1.0], 5.0),
            ([0.0, 0.0, 1.0], -500.0),
            ([0.0, 1.0, 0.0], 0.1),
            ([1.0, 0.0, 0.0], 7.3),
            ([root, root, 0.0], 20.0),
            ([root, 0.0, -root], 20.0),
            ([0.6, -0.64, 0.48], 3.0),
        ] {
            let frame = Plane { normal, offset }.frame().unwrap();
            for (round, noise) in [0.0, 1e-15, 1e-9, 0.003, 0.03].into_iter().cycle().take(40).enumerate() {
                let place = |i: u32, random: &mut Random| {
                    let (s, c) = libm::sincos(0.063 * f64::from(i));
                    let p = frame.place([30.0 + 12.0 * c, 8.0 * s]);
                    let chance: f64 = (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
                    plus(p, times(noise * chance, normal))
                };
                let mut points: Vec<Point> = (0..100).map(|i| place(i, random)).collect();
                if round % 2 == 1 {
                    points.reverse();
                }
                let (found, off) = PlaneFrame::through(&points).unwrap();
                let turn = [minus(found.x, frame.x), minus(found.y, frame.y)].map(norm);
                assert!(turn.iter().all(|t| *t <= noise + 1e-12), "{normal:?} {noise} {found:?}");
                assert!(off <= 5.0 * noise + 1e-12);
                // The tilt of an axis by chance moves nothing that far off, but for a row or two.
                if normal.contains(&1.0) && offset == 5.0 {
                    assert_eq!([found.x, found.y], [frame.x, frame.y], "{noise}");
                }
                assert!(
                    norm(cross(found.origin, found.normal())) < 1e-9 * offset.abs(),
                    "foot of the origin"
                );
            }
        }
        // As planes that cut: what is no more than rounding does not turn the axes.
        let flat = Plane { normal: [1e-17, 0.0, 1.0], offset: 5.0 }.frame().unwrap();
        assert_eq!((flat.x[0], flat.y[1]), (1.0, 1.0));
        // A tilt that the points tell is kept.
        let told = Plane { normal: [1e-3, 0.0, 1.0], offset: 5.0 }.frame().unwrap();
        let points: Vec<Point> =
            (0..100).map(|i| libm::sincos(0.06 * f64::from(i))).map(|(s, c)| told.place([s, c])).collect();
        assert!(norm(minus(PlaneFrame::through(&points).unwrap().0.x, told.x)) < 1e-12);
    }
}
