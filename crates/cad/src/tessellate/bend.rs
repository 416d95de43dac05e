//! How far facets may be from a surface.
//!
//! Between its corners a facet differs from a surface by no more than `(h² M₁ + 2hk M₂ + k² M₃) / 8`, where `h` and `k` are the extents of its
//! parameters and `M` bounds of the second derivatives over them: a place of the facet is a mean of its corners with weights `λ`, Taylor's
//! theorem gives each corner from there, the first derivatives cancel, and the mean square of the distances along one parameter is no
//! more than a quarter of the square of their range. (Filip, Magedson and Markot, Surface algorithms using bounds on
//! derivatives, Computer Aided Geometric Design 3, 1986, has the same for half a rectangle.) Where a surface is known by its distance
//! function, that says more: see [`facet`].

use super::net::{Net, chord};
use crate::curve::Curve;
use crate::surface::{Seconds, Surface};
use crate::trim::Chart;
use trueness_geom::space::{Point, cross, dot, minus, norm, plus, times, unit};
use trueness_geom::spline::surface::Nurbs;

/// Bounds of second derivatives.
#[derive(Clone, Debug)]
pub struct Bend<'a> {
    chart: &'a Chart,
    kind: Kind,
    /// How far borders of facets may be from the edges of the face.
    border: f64,
}

#[derive(Clone, Debug)]
enum Kind {
    /// The surface itself says all.
    Closed,
    Spline(Net),
    /// The curve that is moved; with its own bounds where it is a spline.
    Swept(Option<Net>),
    /// Second derivatives are sampled: nothing is proven.
    Sampled,
}

/// How far a facet is from the surface at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// Millimeters.
    pub distance: f64,
    /// Whether it follows from bounds of derivatives or from a distance function; else it is twice what samples say.
    pub is_proven: bool,
}

impl<'a> Bend<'a> {
    pub fn new(chart: &'a Chart, border: f64) -> Bend<'a> {
        let kind = match chart.surface() {
            Surface::Spline(nurbs) => chart.spans().map_or(Kind::Sampled, |(patches, knots)| {
                Kind::Spline(Net::new(patches, knots.clone(), creases(nurbs)))
            }),
            Surface::Extrusion { curve, .. } | Surface::Revolution { curve, .. } => match &**curve {
                Curve::Joined(_) | Curve::Polyline(_) => Kind::Sampled,
                curve => Kind::Swept(Net::of_curve(curve)),
            },
            Surface::Offset { .. } => Kind::Sampled,
            _ => Kind::Closed,
        };
        Bend { chart, kind, border }
    }

    /// Bounds over a box of parameters, of splines along their normals alone, and whether they are proven.
    pub fn seconds(&self, sides: [[f64; 2]; 2]) -> (Seconds, bool) {
        let [us, vs] = sides;
        match (self.chart.surface(), &self.kind) {
            (Surface::Plane(_), _) => ([0.0; 3], true),
            (Surface::Cylinder { radius, .. }, _) => ([*radius, 0.0, 0.0], true),
            (Surface::Cone { radius, half_angle, .. }, _) => {
                let slope = libm::tan(*half_angle);
                let most = vs.iter().map(|v| (radius + v * slope).abs()).fold(0.0, f64::max);
                ([most, slope.abs(), 0.0], true)
            }
            (Surface::Sphere { radius, .. }, _) => ([*radius, *radius, *radius], true),
            (Surface::Torus { major, minor, .. }, _) => {
                let most = (major.abs() + minor).min(major + minor * greatest_cosine(vs)).max(0.0);
                ([most, *minor, *minor], true)
            }
            (Surface::Spline(_), Kind::Spline(net)) => {
                let all = self.within(sides).into_iter().map(|p| net.along_normals(p));
                (all.fold([0.0; 3], |a, b| [0, 1, 2].map(|n| f64::max(a[n], b[n]))), false)
            }
            (Surface::Extrusion { curve, .. }, Kind::Swept(net)) => {
                let most = of_curve(curve, net.as_ref(), us);
                ([most, 0.0, 0.0], true)
            }
            (Surface::Revolution { curve, origin, axis }, Kind::Swept(net)) => {
                // |X_uu| is the distance from the axis, |X_uv| how fast that changes: both no more than the curve's.
                let second = of_curve(curve, net.as_ref(), vs);
                let middle = 0.5 * (vs[0] + vs[1]);
                let half = 0.5 * (vs[1] - vs[0]);
                let [place, first, _] = curve.derivatives(middle);
                let radius = norm(cross(minus(place, *origin), *axis));
                let speed = norm(cross(first, *axis)) + half * second;
                ([radius + half * speed, speed, second], true)
            }
            _ => (self.sampled(sides), false),
        }
    }

    /// Values of a parameter within a range at which bounds change: knots.
    pub fn stops(&self, k: usize, [from, to]: [f64; 2]) -> Vec<f64> {
        let knots = match (self.chart.surface(), &self.kind) {
            (Surface::Spline(_), Kind::Spline(net)) => &net.knots[k],
            (Surface::Extrusion { .. }, Kind::Swept(Some(net))) if k == 0 => &net.knots[0],
            (Surface::Revolution { .. }, Kind::Swept(Some(net))) if k == 1 => &net.knots[0],
            _ => return vec![],
        };
        let turns: Vec<f64> = self.chart.periods[k].map_or(vec![0.0], |p| vec![-p, 0.0, p]);
        let mut all: Vec<f64> = turns.iter().flat_map(|by| knots.iter().map(move |x| x + by)).collect();
        let least = 1e-6 * (to - from);
        all.retain(|x| *x > from + least && *x < to - least);
        all.sort_by(f64::total_cmp);
        all.dedup_by(|b, a| *b - *a < least);
        all
    }

    /// Parts of a box in the domain, where a parameter repeats.
    fn within(&self, sides: [[f64; 2]; 2]) -> Vec<[[f64; 2]; 2]> {
        let ranges = [0, 1].map(|k| {
            let [a, b] = sides[k];
            let Some(period) = self.chart.periods[k] else { return vec![[a, b]] };
            let [first, last] = [self.chart.domain[k][0], self.chart.domain[k][0] + period];
            let start = a - period * ((a - first) / period).floor();
            let end = start + (b - a);
            if end <= last {
                vec![[start, end]]
            } else {
                vec![[start, last], [first, (end - period).min(last)]]
            }
        });
        let [us, vs] = ranges;
        us.iter().flat_map(|u| vs.iter().map(move |v| [*u, *v])).collect()
    }

    fn sampled(&self, sides: [[f64; 2]; 2]) -> Seconds {
        let mut most = [0.0f64; 3];
        for i in 0..3 {
            for j in 0..3 {
                let at = |k: usize, n: i32| {
                    sides[k][0] + (0.02 + 0.48 * f64::from(n)) * (sides[k][1] - sides[k][0])
                };
                let jet = self.chart.jet([at(0, i), at(1, j)]);
                (0..3).for_each(|n| {
                    let size = norm(jet.second[n]);
                    most[n] = most[n].max(if size.is_finite() { 2.0 * size } else { 0.0 });
                });
            }
        }
        most
    }

    /// How far a facet between places is from the surface at most, where the places have these parameters.
    pub fn facet(&self, corners: [Point; 3], parameters: [[f64; 2]; 3]) -> Bound {
        let proven = |distance| Bound { distance, is_proven: true };
        let flat = |frame: &crate::frame::Frame| corners.map(|p| frame.local(p)).map(|[x, y, _]| [x, y, 0.0]);
        let off_circle = |triangle: [Point; 3], radius: f64| {
            // The distance from a center is greatest at a corner.
            let most = triangle.iter().map(|p| (norm(*p) - radius).abs()).fold(0.0, f64::max);
            most.max((radius - nearest_to_origin(triangle)).abs())
        };
        match self.chart.surface() {
            Surface::Plane(frame) => {
                proven(corners.iter().map(|p| frame.local(*p)[2].abs()).fold(0.0, f64::max))
            }
            Surface::Sphere { frame, radius } => proven(off_circle(corners.map(|p| frame.local(p)), *radius)),
            Surface::Cylinder { frame, radius } => proven(off_circle(flat(frame), *radius)),
            Surface::Cone { frame, radius, half_angle } => {
                let cosine = libm::cos(*half_angle);
                let slope = libm::tan(*half_angle);
                // The distance function is convex, so it is above a corner's nowhere; and it lies above each plane that touches it.
                let off = corners.map(|p| {
                    let [x, y, z] = frame.local(p);
                    cosine * (libm::hypot(x, y) - (radius + z * slope).abs())
                });
                let places = flat(frame);
                let mean = places.iter().fold([0.0; 3], |s, p| [s[0] + p[0], s[1] + p[1], 0.0]);
                let Some((way, _)) = unit(mean) else { return self.by_seconds(parameters) };
                let sunk = places.iter().map(|p| cosine * (norm(*p) - dot(*p, way))).fold(0.0, f64::max);
                let most = off.iter().fold(0.0f64, |m, d| m.max(d.abs()));
                proven(most + sunk)
            }
            _ => self.by_seconds(parameters),
        }
    }

    fn by_seconds(&self, parameters: [[f64; 2]; 3]) -> Bound {
        let sides = box_of(&parameters);
        let extents = sides.map(|[a, b]| b - a);
        let Kind::Spline(net) = &self.kind else {
            let (seconds, is_proven) = self.seconds(sides);
            return Bound { distance: chord(seconds, extents), is_proven };
        };
        let parts = self.within(sides);
        let is_proven = parts
            .iter()
            .all(|part| (0..2).all(|k| !net.creases[k].iter().any(|t| part[k][0] < *t && *t < part[k][1])));
        let (distance, shift) = net.facet(&parts, extents);
        // Beyond an end of the surface the facet's border is nearest, and within its own distance of the edge.
        let is_inner = (0..2).all(|k| {
            let [first, last] = self.chart.domain[k];
            self.chart.periods[k].is_some()
                || sides[k][0] - shift[k] >= first && sides[k][1] + shift[k] <= last
        });
        let most = || {
            chord(
                parts.iter().fold([0.0; 3], |m, p| {
                    let own = net.over(*p);
                    [0, 1, 2].map(|n| f64::max(m[n], own[n]))
                }),
                extents,
            )
        };
        let distance = if is_inner { distance } else { libm::hypot(distance, self.border).min(most()) };
        Bound { distance, is_proven }
    }

    /// How much of the bound a side of a facet takes: the greatest one is to be halved.
    pub fn of_side(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        self.by_seconds([a, b, b]).distance
    }
}

/// Inner knots of a surface at which it may have a crease.
fn creases(nurbs: &Nurbs) -> [Vec<f64>; 2] {
    nurbs.knots().each_ref().map(|own| {
        let all = own.distinct();
        let inner = all.get(1..all.len().max(2) - 1).unwrap_or_default();
        inner.iter().copied().filter(|t| own.multiplicity(*t) >= own.degree()).collect()
    })
}

/// First and last values of both parameters.
pub fn box_of(places: &[[f64; 2]]) -> [[f64; 2]; 2] {
    [0, 1].map(|k| {
        let of = |start: f64, pick: fn(f64, f64) -> f64| places.iter().map(|p| p[k]).fold(start, pick);
        [of(f64::INFINITY, f64::min), of(f64::NEG_INFINITY, f64::max)]
    })
}

/// Distance of a triangle from the origin.
fn nearest_to_origin([a, b, c]: [Point; 3]) -> f64 {
    let wide = cross(minus(b, a), minus(c, a));
    // The origin lies over the triangle where it is on the inner side of all its sides.
    let is_over = [(a, b), (b, c), (c, a)].iter().all(|(p, q)| dot(cross(wide, minus(*q, *p)), *p) <= 0.0);
    if let Some((normal, _)) = unit(wide).filter(|_| is_over) {
        return dot(a, normal).abs();
    }
    let to_side = |p: Point, q: Point| {
        let way = minus(q, p);
        let square = dot(way, way);
        let share = if square > 0.0 { (-dot(p, way) / square).clamp(0.0, 1.0) } else { 0.0 };
        norm(plus(p, times(share, way)))
    };
    to_side(a, b).min(to_side(b, c)).min(to_side(c, a))
}

/// The greatest cosine over a range of angles.
fn greatest_cosine([a, b]: [f64; 2]) -> f64 {
    let turns = (b / std::f64::consts::TAU).floor() * std::f64::consts::TAU;
    if turns >= a { 1.0 } else { libm::cos(a).max(libm::cos(b)) }
}

/// A bound of the second derivative of a curve over a range.
fn of_curve(curve: &Curve, net: Option<&Net>, [a, b]: [f64; 2]) -> f64 {
    let far = a.abs().max(b.abs());
    match (curve, net) {
        (_, Some(net)) => {
            let domain = [net.knots[0][0], net.knots[0][net.knots[0].len() - 1]];
            // A closed spline is asked for beyond its ends.
            let side = if a >= domain[0] && b <= domain[1] { [a, b] } else { domain };
            net.over([side, [0.0, 1.0]])[0]
        }
        (Curve::Circle { radius, .. }, _) => *radius,
        (Curve::Ellipse { radii, .. }, _) => radii[0].max(radii[1]),
        (Curve::Hyperbola { radii, .. }, _) => {
            libm::hypot(radii[0] * libm::cosh(far), radii[1] * libm::sinh(far))
        }
        (Curve::Parabola { focal, .. }, _) => 2.0 * focal,
        _ => 0.0,
    }
}
