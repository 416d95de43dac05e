//! Points, vectors and boxes in space.
//!
//! A point is a plain array of three `f64` (millimeters, right-handed). So a cloud is one flat block of memory that any caller
//! can hand over without a copy.

/// A place, millimeters.
pub type Point = [f64; 3];
/// A direction or difference of two places, millimeters.
pub type Vector = [f64; 3];

/// Smallest coordinate of a place that is not zero, millimeters. The fourth power of a smaller one leaves the range of normal
/// numbers, and distances would lose their digits without a word. Searches refuse smaller ones.
pub const MIN_COORDINATE: f64 = 1e-50;

/// Scalar product.
#[inline(always)]
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
/// `a - b`.
#[inline(always)]
pub fn minus(a: Point, b: Point) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
/// `a + b`.
#[inline(always)]
pub fn plus(a: Point, b: Vector) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
/// `a` times the number `s`.
#[inline(always)]
pub fn times(s: f64, a: Vector) -> Vector {
    [s * a[0], s * a[1], s * a[2]]
}
/// Vector product.
#[inline(always)]
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
/// Euclidean length.
#[inline(always)]
pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}
/// Unit vector and length, or `None` where the length is zero, not finite, or too small to invert.
#[inline]
pub fn unit(a: Vector) -> Option<(Vector, f64)> {
    let length = norm(a);
    let inverse = 1.0 / length;
    (length > 0.0 && inverse.is_finite() && length.is_finite()).then(|| (times(inverse, a), length))
}

/// The unit normal of a triangle, by the right hand; `None` without an area.
///
/// ```
/// use trueness_geom::space::normal;
/// assert_eq!(normal([[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]), Some([0.0, 0.0, 1.0]));
/// assert_eq!(normal([[0.0; 3]; 3]), None);
/// ```
pub fn normal([a, b, c]: [Point; 3]) -> Option<Vector> {
    unit(cross(minus(b, a), minus(c, a))).map(|(n, _)| n)
}

/// The coordinate axis that stands most across `a`: the first of those along which `a` reaches least.
pub fn least_axis(a: Vector) -> Vector {
    let least = (0..3).min_by(|&i, &j| a[i].abs().total_cmp(&a[j].abs())).unwrap_or(0);
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    axis
}

/// Step of single precision at the greatest coordinate of some points: what files in that precision leave of them.
///
/// ```
/// use trueness_geom::space::single_step;
/// assert_eq!(single_step(&[[0.5, -8.0, 1.0]]), 8.0 * f64::from(f32::EPSILON));
/// ```
pub fn single_step(points: &[Point]) -> f64 {
    points.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs())) * f64::from(f32::EPSILON)
}

/// Axis-parallel box. Empty when `min > max` in some coordinate, as [`Aabb::EMPTY`] is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Least coordinates.
    pub min: Point,
    /// Greatest coordinates.
    pub max: Point,
}

impl Aabb {
    /// The box of nothing: the neutral element of [`Aabb::union`].
    pub const EMPTY: Aabb = Aabb { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };

    /// The smallest box around `points`. NaN coordinates are passed over.
    pub fn of<'a>(points: impl IntoIterator<Item = &'a Point>) -> Aabb {
        points.into_iter().fold(Aabb::EMPTY, |b, p| b.union(&Aabb { min: *p, max: *p }))
    }
    /// The smallest box around both.
    pub fn union(&self, other: &Aabb) -> Aabb {
        Aabb {
            min: std::array::from_fn(|k| self.min[k].min(other.min[k])),
            max: std::array::from_fn(|k| self.max[k].max(other.max[k])),
        }
    }
    /// Distance of a point from the box; 0 within.
    pub fn distance(&self, p: &Point) -> f64 {
        norm(std::array::from_fn(|k| (self.min[k] - p[k]).max(p[k] - self.max[k]).max(0.0)))
    }
    /// Whether both have a place in common, their sides included.
    pub fn meets(&self, other: &Aabb) -> bool {
        (0..3).all(|k| self.min[k] <= other.max[k] && other.min[k] <= self.max[k])
    }
    /// Whether it holds a place, its sides included.
    pub fn holds(&self, p: &Point) -> bool {
        (0..3).all(|k| self.min[k] <= p[k] && p[k] <= self.max[k])
    }
    /// The box that reaches farther by `by` on all sides; the empty box stays empty.
    pub fn widened(&self, by: f64) -> Aabb {
        Aabb { min: self.min.map(|x| x - by), max: self.max.map(|x| x + by) }
    }
    /// Side lengths; negative where empty.
    pub fn sides(&self) -> Vector {
        minus(self.max, self.min)
    }
    /// Length of the diagonal; 0 for the empty box.
    pub fn diagonal(&self) -> f64 {
        if self.is_empty() { 0.0 } else { norm(self.sides()) }
    }
    /// Its eight corners.
    pub fn corners(&self) -> [Point; 8] {
        let corner =
            |i: usize| std::array::from_fn(|k| if i >> k & 1 == 0 { self.min[k] } else { self.max[k] });
        std::array::from_fn(corner)
    }
    /// True if it holds no point.
    pub fn is_empty(&self) -> bool {
        (0..3).any(|k| self.min[k] > self.max[k])
    }
}
