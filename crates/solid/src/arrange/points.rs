//! The points of an arrangement: vertices of the mesh, and places where cuts meet, exactly.
//!
//! A place that is no triple of `f64` is kept as four exact numbers, its homogeneous coordinates. The neighboring `f64`
//! below and above each coordinate stand beside them. Signs are first looked for in those intervals, and where they
//! cannot tell, computed exactly. (Attene, Indirect predicates for geometric constructions, 2020, does the same with
//! the terms that define a point). Two points at one place are one: places are looked up by their bounds, which follow
//! from the place alone, and compared exactly.

use std::cmp::Ordering;
use std::collections::HashMap;
use trueness_geom::num::big::{Big, cross, dot, minus};
use trueness_geom::num::interval::Interval;
use trueness_geom::num::predicates::side_of_line;
use trueness_geom::space::Point;

/// Exact homogeneous coordinates: the place is `x / w`, and `w` is positive.
#[derive(Clone, Debug)]
struct Homogeneous {
    x: [Big; 3],
    w: Big,
}

/// A place, exactly.
#[derive(Clone, Debug)]
pub(super) struct ExactPoint {
    /// The neighboring numbers below and above each coordinate; the coordinate itself twice where it is a number.
    low: Point,
    high: Point,
    /// `None` where all three coordinates are numbers.
    exact: Option<Box<Homogeneous>>,
}

/// A plane: the places `p` with `normal · p = offset`, exactly.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    pub normal: [Big; 3],
    pub offset: Big,
}

impl Plane {
    /// The plane through three places; its normal looks to where they run counter-clockwise.
    pub fn through([a, b, c]: [Point; 3]) -> Plane {
        let normal = cross(&minus(b, a), &minus(c, a));
        let offset = dot(&normal, &a.map(Big::of));
        Plane { normal, offset }
    }

    /// The plane through two places that holds the direction of an axis.
    pub fn along(axis: usize, [a, b]: [Point; 2]) -> Plane {
        let direction: [Big; 3] = std::array::from_fn(|k| Big::of(if k == axis { 1.0 } else { 0.0 }));
        let normal = cross(&minus(b, a), &direction);
        let offset = dot(&normal, &a.map(Big::of));
        Plane { normal, offset }
    }
}

impl ExactPoint {
    /// A vertex.
    pub fn of(p: Point) -> ExactPoint {
        ExactPoint { low: p, high: p, exact: None }
    }

    fn homogeneous(x: [Big; 3], w: Big) -> Option<ExactPoint> {
        let (x, w) = match w.sign() {
            0 => return None,
            1 => (x, w),
            _ => (x.map(Big::negated), w.negated()),
        };
        let [a, b, c] = [0, 1, 2].map(|k| Big::quotient(&x[k], &w));
        let (low, high) = ([a[0], b[0], c[0]], [a[1], b[1], c[1]]);
        let exact = (low != high).then(|| Box::new(Homogeneous { x, w }));
        Some(ExactPoint { low, high, exact })
    }

    /// Where a line meets a plane; `None` where it runs along it.
    pub fn on_line([p, q]: [Point; 2], plane: &Plane) -> Option<ExactPoint> {
        let way = minus(q, p);
        let from = p.map(Big::of);
        let w = dot(&plane.normal, &way);
        let t = &plane.offset - &dot(&plane.normal, &from);
        let x = std::array::from_fn(|k| &(&from[k] * &w) + &(&way[k] * &t));
        ExactPoint::homogeneous(x, w)
    }

    /// Where three planes meet; `None` where that is no single point.
    pub fn of_planes([a, b, c]: [&Plane; 3]) -> Option<ExactPoint> {
        let (bc, ca, ab) =
            (cross(&b.normal, &c.normal), cross(&c.normal, &a.normal), cross(&a.normal, &b.normal));
        let x =
            std::array::from_fn(|k| &(&(&a.offset * &bc[k]) + &(&b.offset * &ca[k])) + &(&c.offset * &ab[k]));
        ExactPoint::homogeneous(x, dot(&a.normal, &bc))
    }

    /// The place, each coordinate to the nearest number.
    pub fn nearest(&self) -> Point {
        let Some(exact) = &self.exact else { return self.low };
        std::array::from_fn(|k| {
            let (low, high) = (self.low[k], self.high[k]);
            let sum = &Big::of(low) + &Big::of(high);
            let twice = &exact.x[k] + &exact.x[k];
            // In the middle the even one, as numbers are rounded everywhere.
            match (&twice - &(&sum * &exact.w)).sign() {
                1 => high,
                -1 => low,
                _ if low.to_bits() & 1 == 0 => low,
                _ => high,
            }
        })
    }

    fn interval(&self, k: usize) -> Interval {
        Interval { low: self.low[k], high: self.high[k] }
    }

    /// Coordinate `k` as a fraction.
    fn fraction(&self, k: usize) -> (Big, Big) {
        match &self.exact {
            Some(h) => (h.x[k].clone(), h.w.clone()),
            None => (Big::of(self.low[k]), Big::of(1.0)),
        }
    }
}

/// Order along axis `k`.
pub(super) fn compare(k: usize, a: &ExactPoint, b: &ExactPoint) -> Ordering {
    if a.high[k] < b.low[k] {
        return Ordering::Less;
    }
    if b.high[k] < a.low[k] {
        return Ordering::Greater;
    }
    if a.low[k] == a.high[k] && b.low[k] == b.high[k] {
        return a.low[k].partial_cmp(&b.low[k]).unwrap_or(Ordering::Equal);
    }
    let ((x, w), (y, v)) = (a.fraction(k), b.fraction(k));
    (&(&x * &v) - &(&y * &w)).sign().cmp(&0)
}

/// Side of `c` on the line through `a` and `b`, all seen along `axis`: +1 on the left, 0 on the line.
pub(super) fn orient(axis: usize, [a, b, c]: [&ExactPoint; 3]) -> i32 {
    if let (None, None, None) = (&a.exact, &b.exact, &c.exact) {
        return side_of_line(axis, &a.low, &b.low, &c.low);
    }
    let (x, y) = ((axis + 1) % 3, (axis + 2) % 3);
    let difference = |p: &ExactPoint, k: usize| p.interval(k) - a.interval(k);
    let filtered = difference(b, x) * difference(c, y) - difference(b, y) * difference(c, x);
    if let Some(sign) = filtered.sign() {
        return sign;
    }
    // All w are positive: the determinant of the homogeneous coordinates has the sign.
    let row = |p: &ExactPoint| {
        let ((x, w), (y, _)) = (p.fraction(x), p.fraction(y));
        [x, y, w]
    };
    dot(&row(a), &cross(&row(b), &row(c))).sign()
}

/// All points: first the vertices of the mesh, then those that were found.
pub(super) struct Points<'a> {
    vertices: &'a [Point],
    found: Vec<ExactPoint>,
    /// Points by the bits of their lower bounds.
    at: HashMap<[u64; 3], Vec<u32>>,
}

/// A vertex or a point that was found.
pub(super) enum At<'a> {
    Vertex(ExactPoint),
    Found(&'a ExactPoint),
}

impl std::ops::Deref for At<'_> {
    type Target = ExactPoint;
    fn deref(&self) -> &ExactPoint {
        match self {
            At::Vertex(place) => place,
            At::Found(place) => place,
        }
    }
}

fn key(p: &Point) -> [u64; 3] {
    p.map(|x| (x + 0.0).to_bits())
}

impl<'a> Points<'a> {
    /// With the vertices of a mesh, no two at one place. The vertices of `known` can be found again.
    pub fn new(vertices: &'a [Point], known: &[u32]) -> Points<'a> {
        let mut at = HashMap::with_capacity(2 * known.len());
        for v in known {
            at.insert(key(&vertices[*v as usize]), vec![*v]);
        }
        Points { vertices, found: vec![], at }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.vertices.len() + self.found.len()
    }

    /// A point.
    pub fn at(&self, point: u32) -> At<'_> {
        let i = point as usize;
        match self.vertices.get(i) {
            Some(p) => At::Vertex(ExactPoint::of(*p)),
            None => At::Found(&self.found[i - self.vertices.len()]),
        }
    }

    /// Number of the point at this place, a new one if there is none.
    pub fn number_of(&mut self, place: ExactPoint) -> u32 {
        let next = self.len() as u32;
        let key = key(&place.low);
        let same = |&p: &u32| {
            let other = self.at(p);
            (0..3).all(|k| compare(k, &other, &place).is_eq())
        };
        if let Some(known) = self.at.get(&key).and_then(|all| all.iter().copied().find(|p| same(p))) {
            return known;
        }
        self.at.entry(key).or_default().push(next);
        self.found.push(place);
        next
    }

    /// About where a point is.
    pub fn rough(&self, point: u32) -> Point {
        self.at(point).low
    }

    /// As [`orient`].
    pub fn orient(&self, axis: usize, [a, b, c]: [u32; 3]) -> i32 {
        orient(axis, [&self.at(a), &self.at(b), &self.at(c)])
    }

    /// As [`compare`].
    pub fn compare(&self, k: usize, a: u32, b: u32) -> Ordering {
        if a == b { Ordering::Equal } else { compare(k, &self.at(a), &self.at(b)) }
    }

    /// Box in which a segment lies.
    pub fn bounds(&self, [a, b]: [u32; 2]) -> [Point; 2] {
        let (a, b) = (self.at(a), self.at(b));
        [std::array::from_fn(|k| a.low[k].min(b.low[k])), std::array::from_fn(|k| a.high[k].max(b.high[k]))]
    }
}
