//! Parameters of points from a simple surface near them.

use super::flatten::{Flat, flatten};
use super::rectangle::minimum_rectangle;
use super::{BaseKind, SurfaceError};
use super::{fold, pole, upright};
use std::f64::consts::TAU;
use trueness_geom::fit::{self, FitError, Scatter};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times, unit};

/// The base of a surface, and how the points lie over it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Base {
    /// The kind of base.
    pub kind: BaseKind,
    /// The corner of a plane's rectangle, a place of a cylinder's axis, the center of a sphere, or the mean of a mesh's
    /// vertices.
    pub origin: Point,
    /// Right-handed unit axes. The axes of a plane are the sides of the rectangle and the normal. The third axis of a
    /// cylinder is its own, and the first points to where its angle is 0. The third axis of a sphere points to the
    /// pole, which lies with its opposite as far from the points as can be. The first axis points about amid them. The
    /// axes of a mesh are those in which its vertices spread, most in the first.
    pub axes: [Vector; 3],
    /// Angle from the longer side of the minimum bounding rectangle to the first axis, in radians from −π/2 to π/2.
    /// Only a plane whose rectangle was turned along its main bends has another angle than 0.
    pub turned: f64,
    /// Angle from the normal of the least-squares plane to the third axis, radians. It is 0 but where the points lie in
    /// layers over the least-squares plane, and in fewer over another one.
    pub tilted: f64,
    /// Radius of a cylinder or a sphere.
    pub radius: Option<f64>,
    /// Whether the points go around a cylinder, or around a sphere's axis, with no gap of more than a tenth of a
    /// radian. The surface then has a seam there.
    pub around: bool,
    /// Whether points lie within ten degrees of a pole of the sphere, whichever its axis. The parameters crowd there,
    /// and the surface is torn or creased.
    pub pole: bool,
    /// How the parameters run.
    course: Unrolling,
    /// Share of the points where several layers lie over one another: they have no common height there, and the surface lies
    /// between them.
    pub folded_share: f64,
    /// Share of the points that stand on edge on the base, at 80° and more. Where these are more than a tenth and no
    /// control point lies far off, the fitted surface passes them by, too, at 45° and more. It then follows the line
    /// that they stand on, and not the part that they belong to.
    pub standing_share: f64,
    /// Factors by which lengths grew on the facets of a mesh laid flat. 1 % of its area has less than the first, 1 %
    /// more than the second.
    pub stretch: Option<[f64; 2]>,
    /// Whether a mesh was laid within a circle: laid out freely, its rim would cross itself.
    pub round: bool,
}

/// How the parameters of a cylinder or a sphere run from the lengths along its own directions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Unrolling {
    /// The angle where they start.
    angle: f64,
    /// The lengths where they start.
    low: [f64; 2],
    /// The extent of the first one, where the second one is the first parameter.
    turned: Option<f64>,
}

impl Base {
    /// The unit normal of the base at the place nearest to one.
    pub(super) fn up(&self, p: Point) -> Vector {
        let [x, y, z] = self.axes;
        let d = minus(p, self.origin);
        let out = match self.kind {
            BaseKind::Plane | BaseKind::Xy | BaseKind::Mesh => z,
            BaseKind::Cylinder => plus(times(dot(d, x), x), times(dot(d, y), y)),
            BaseKind::Sphere => d,
        };
        unit(out).map_or(z, |(d, _)| d)
    }

    /// Whether the base is round along each parameter.
    pub(super) fn round_directions(&self) -> [bool; 2] {
        match (self.kind, self.course.turned) {
            (BaseKind::Sphere, _) => [true, true],
            (BaseKind::Cylinder, None) => [true, false],
            (BaseKind::Cylinder, Some(_)) => [false, true],
            _ => [false, false],
        }
    }

    /// The place of the base with these parameters.
    pub(super) fn at(&self, [u, v]: [f64; 2]) -> Point {
        let own = match self.course.turned {
            Some(extent) => [extent - v, u],
            None => [u, v],
        };
        let radius = self.radius.unwrap_or(1.0);
        let [a, b] = [0, 1].map(|k| own[k] + self.course.low[k]);
        let angle = a / radius + self.course.angle;
        let round = || plus(times(libm::cos(angle), self.axes[0]), times(libm::sin(angle), self.axes[1]));
        let off = match self.kind {
            // A mesh states nothing but the directions.
            BaseKind::Plane | BaseKind::Xy | BaseKind::Mesh => {
                plus(times(u, self.axes[0]), times(v, self.axes[1]))
            }
            BaseKind::Cylinder => plus(times(radius, round()), times(b, self.axes[2])),
            BaseKind::Sphere => {
                let up = b / radius;
                times(radius, plus(times(libm::cos(up), round()), times(libm::sin(up), self.axes[2])))
            }
        };
        plus(self.origin, off)
    }
}

impl Base {
    /// Whether so many points stand on edge over it that a surface over it is not theirs.
    pub fn is_on_edge(&self) -> bool {
        self.standing_share > MAX_STANDING_SHARE
    }
}

/// Where a point lies over the base: two lengths along it and the height.
type Seen = ([f64; 2], f64);

/// Share of the points that may stand on edge: walls of a part do, and points at its edges.
const MAX_STANDING_SHARE: f64 = 0.1;

/// Share of the points that may lie in layers: a few outliers do.
const MAX_LAYERED_SHARE: f64 = 0.01;

/// Share of the points in layers below which they are outliers, and no other plane is looked for.
const OUTLIER_SHARE: f64 = 0.002;

/// Share of the points that may stand on edge over a plane with hardly any layers. Steep ground has one height everywhere, and a
/// surface that follows it. A strip that stands on edge as a whole has no layers either, as its heights have no gap.
const MAX_STANDING_SHARE_OF_STEEP: f64 = 0.4;

/// Points in a rectangle whose sides have a lesser ratio lie on a line: across it there is the rounding of written coordinates.
const MIN_SIDE_RATIO: f64 = 1e-6;

/// The parameters of all points; over a plane it is the one that the surface has heights over, as far as there is one.
pub(super) fn parameters(
    points: &[Point],
    kind: BaseKind,
    progress: &dyn Progress,
) -> Result<(Base, Vec<[f64; 2]>), SurfaceError> {
    let over_plane = |point, normal| upright(points, point, normal, progress);
    let (mut base, seen) = seen(points, kind, over_plane, progress)?;
    let found: Vec<[f64; 2]> = seen.iter().map(|s| s.0).collect();
    no_line(&found)?;
    base.folded_share = folded_share(&seen);
    base.standing_share = upright::standing(points, |p| base.up(p), progress)?;
    Ok((base, found))
}

/// The parameters of all points over the least-squares shape itself.
pub(super) fn level(
    points: &[Point],
    kind: BaseKind,
    progress: &dyn Progress,
) -> Result<(Base, Vec<[f64; 2]>), SurfaceError> {
    let (base, seen) = seen(points, kind, |point, normal| plane(points, point, normal), progress)?;
    Ok((base, seen.iter().map(|s| s.0).collect()))
}

/// How all points lie over the base; `over_plane` tells it of a plane.
fn seen(
    points: &[Point],
    kind: BaseKind,
    over_plane: impl Fn(Point, Vector) -> Result<(Base, Vec<Seen>), SurfaceError>,
    progress: &dyn Progress,
) -> Result<(Base, Vec<Seen>), SurfaceError> {
    let shape = |kind| {
        fit::fit(points, kind, &fit::Options::default(), progress).map(|f| f.shape).map_err(|e| match e {
            FitError::Cancelled => Cancelled.into(),
            FitError::Collinear { .. }
            | FitError::AllEqual
            | FitError::Undetermined { kind: Kind::Plane } => SurfaceError::Line,
            e => SurfaceError::Base(e),
        })
    };
    Ok(match kind {
        BaseKind::Mesh => return Err(SurfaceError::NoFacets),
        BaseKind::Xy => (xy(), points.iter().map(|p| ([p[0], p[1]], p[2])).collect()),
        BaseKind::Plane => match shape(Kind::Plane)? {
            Shape::Plane { point, normal } => over_plane(point, normal)?,
            _ => return Err(SurfaceError::Line),
        },
        BaseKind::Cylinder => match shape(Kind::Cylinder)? {
            Shape::Cylinder { point, direction, radius } => cylinder(points, point, direction, radius),
            _ => return Err(SurfaceError::Line),
        },
        BaseKind::Sphere => match shape(Kind::Sphere)? {
            Shape::Sphere { center, radius } => sphere(points, center, radius),
            _ => return Err(SurfaceError::Line),
        },
    })
}

/// Refuses places on one line.
fn no_line(places: &[[f64; 2]]) -> Result<(), SurfaceError> {
    let [u, v] = ranges(places.iter().copied());
    let (long, short) = ((u.1 - u.0).max(v.1 - v.0), (u.1 - u.0).min(v.1 - v.0));
    // Also points aslant on one line.
    if short <= MIN_SIDE_RATIO * long
        || minimum_rectangle(places).is_none_or(|r| r.sides[1] <= MIN_SIDE_RATIO * r.sides[0])
    {
        return Err(SurfaceError::Line);
    }
    Ok(())
}

/// The parameters of all vertices of a mesh laid flat, in its minimum bounding rectangle.
pub(super) fn laid_flat(mesh: &Mesh, progress: &dyn Progress) -> Result<(Base, Vec<[f64; 2]>), SurfaceError> {
    let Scatter { mean, axes: [_, middle, most], variance } = Scatter::of(&mesh.positions);
    if variance[1] <= MIN_SIDE_RATIO * MIN_SIDE_RATIO * variance[2] {
        return Err(SurfaceError::Line);
    }
    let Flat { places, stretch, folded_share, round } = flatten(mesh, progress)?;
    let rectangle = minimum_rectangle(&places).ok_or(SurfaceError::Line)?;
    let [a, b] = rectangle.along;
    let seen = |p: &[f64; 2]| {
        let d = [0, 1].map(|k| p[k] - rectangle.corner[k]);
        [a * d[0] + b * d[1], a * d[1] - b * d[0]]
    };
    let axes = [most, middle, cross(most, middle)];
    let kind = BaseKind::Mesh;
    let stretch = Some(stretch);
    let base = Base { kind, origin: mean, axes, folded_share, stretch, round, ..xy() };
    Ok((base, places.iter().map(seen).collect()))
}

/// Share of the points that lie in layers.
fn folded_share(seen: &[Seen]) -> f64 {
    fold::share(seen, ranges(seen.iter().map(|s| s.0)))
}

/// The least-squares plane, or another one where the points lie in layers or stand on edge over it. The other one is
/// the plane over which the surface is least steep. At most half as many points lie in layers over that, or hardly any
/// do either.
fn upright(
    points: &[Point],
    point: Point,
    normal: Vector,
    progress: &dyn Progress,
) -> Result<(Base, Vec<Seen>), SurfaceError> {
    let flat = plane(points, point, normal)?;
    let standing = |base: &Base| upright::standing(points, |_| base.axes[2], progress);
    let (folded, on_edge) = (folded_share(&flat.1), standing(&flat.0)?);
    if folded <= OUTLIER_SHARE && on_edge <= MAX_STANDING_SHARE {
        return Ok(flat);
    }
    for (n, direction) in upright::directions(points, normal, progress)?.into_iter().enumerate() {
        // As that of the least-squares plane: to the side of its largest coordinate.
        let largest = direction.into_iter().fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m });
        let direction = times(largest.signum(), direction);
        let (base, seen) = plane(points, point, direction)?;
        let (layers, edges) = (folded_share(&seen), standing(&base)?);
        let steep =
            if layers <= MAX_LAYERED_SHARE { MAX_STANDING_SHARE_OF_STEEP } else { MAX_STANDING_SHARE };
        // Some outliers look like layers from all sides, and from some a little less.
        let layers_vanish = layers == 0.0 || folded > MAX_LAYERED_SHARE && 2.0 * layers <= folded;
        let fewer_layers = folded > OUTLIER_SHARE && layers_vanish && edges <= on_edge.max(steep);
        // Normals of noise are upright in some direction of several.
        let upright = n == 0
            && on_edge > MAX_STANDING_SHARE
            && edges <= MAX_STANDING_SHARE
            && layers <= MAX_LAYERED_SHARE;
        if fewer_layers || upright {
            let tilted = libm::atan2(norm(cross(normal, direction)), dot(normal, direction).abs());
            return Ok((Base { tilted, ..base }, seen));
        }
    }
    Ok(flat)
}

fn xy() -> Base {
    Base {
        kind: BaseKind::Xy,
        origin: [0.0; 3],
        axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        turned: 0.0,
        tilted: 0.0,
        radius: None,
        around: false,
        pole: false,
        course: Unrolling::default(),
        folded_share: 0.0,
        standing_share: 0.0,
        stretch: None,
        round: false,
    }
}

/// A unit vector at right angles to `w`: the first coordinate's direction as far as it goes.
fn across(w: Vector) -> Vector {
    let axis = if w[0].abs() < 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    unit(minus(axis, times(dot(axis, w), w))).map_or([0.0, 0.0, 1.0], |(d, _)| d)
}

fn plane(points: &[Point], point: Point, normal: Vector) -> Result<(Base, Vec<Seen>), SurfaceError> {
    let x = across(normal);
    let y = cross(normal, x);
    let flat: Vec<[f64; 2]> =
        points.iter().map(|p| minus(*p, point)).map(|d| [dot(d, x), dot(d, y)]).collect();
    let rectangle = minimum_rectangle(&flat).ok_or(SurfaceError::Line)?;
    let [a, b] = rectangle.along;
    let u = plus(times(a, x), times(b, y));
    let origin = plus(point, plus(times(rectangle.corner[0], x), times(rectangle.corner[1], y)));
    let axes = [u, cross(normal, u), normal];
    let seen = points
        .iter()
        .map(|p| minus(*p, origin))
        .map(|d| ([dot(d, axes[0]), dot(d, axes[1])], dot(d, normal)))
        .collect();
    Ok((Base { kind: BaseKind::Plane, origin, axes, ..xy() }, seen))
}

/// The same plane with its parameters along and across `direction`, which is one of its own parameters; the longer side first.
pub(super) fn turned(points: &[Point], base: &Base, direction: [f64; 2]) -> (Base, Vec<[f64; 2]>) {
    let [u, v, normal] = base.axes;
    let along = |[a, b]: [f64; 2]| plus(times(a, u), times(b, v));
    let seen = |axes: [Vector; 2]| -> Vec<[f64; 2]> {
        points.iter().map(|p| minus(*p, base.origin)).map(|d| axes.map(|a| dot(d, a))).collect()
    };
    let [a, b] = direction;
    let mut axes = [along([a, b]), along([-b, a])];
    let mut parameters = seen(axes);
    let [along, across] = ranges(parameters.iter().copied()).map(|(low, high)| high - low);
    if across > along {
        axes = [axes[1], times(-1.0, axes[0])];
    }
    let largest = axes[0].into_iter().fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m });
    if largest < 0.0 {
        axes = axes.map(|a| times(-1.0, a));
    }
    parameters = seen(axes);
    let low = ranges(parameters.iter().copied()).map(|r| r.0);
    parameters.iter_mut().for_each(|p| (0..2).for_each(|k| p[k] -= low[k]));
    let origin = plus(base.origin, plus(times(low[0], axes[0]), times(low[1], axes[1])));
    let angle = base.turned + libm::atan2(dot(axes[0], v), dot(axes[0], u));
    let turned = angle - std::f64::consts::PI * (angle / std::f64::consts::PI).round();
    (Base { origin, axes: [axes[0], axes[1], normal], turned, ..*base }, parameters)
}

/// Turns angles so that the widest gap between them is where they start and end. The answers are where they start, and whether
/// there is no gap.
fn unrolled(angles: &mut [f64]) -> (f64, bool) {
    let mut sorted = angles.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let (Some(first), Some(last)) = (sorted.first().copied(), sorted.last().copied()) else {
        return (0.0, false);
    };
    let (mut start, mut widest) = (first, first + TAU - last);
    for w in sorted.windows(2) {
        if w[1] - w[0] > widest {
            (start, widest) = (w[1], w[1] - w[0]);
        }
    }
    for a in angles {
        *a -= start;
        if *a < 0.0 {
            *a += TAU;
        }
    }
    (start, widest < 0.1)
}

/// The longer direction as the first parameter, with the same side outside.
fn longer_first(seen: &mut [Seen], angle: f64) -> Unrolling {
    let [u, v] = ranges(seen.iter().map(|s| s.0));
    let turned = v.1 - v.0 > u.1 - u.0;
    for ([a, b], _) in seen {
        let own = [*a - u.0, *b - v.0];
        [*a, *b] = if turned { [own[1], u.1 - u.0 - own[0]] } else { own };
    }
    Unrolling { angle, low: [u.0, v.0], turned: turned.then_some(u.1 - u.0) }
}

fn cylinder(points: &[Point], origin: Point, axis: Vector, radius: f64) -> (Base, Vec<Seen>) {
    let x = across(axis);
    let axes = [x, cross(axis, x), axis];
    let local: Vec<Vector> =
        points.iter().map(|p| minus(*p, origin)).map(|d| axes.map(|a| dot(d, a))).collect();
    let mut angles: Vec<f64> = local.iter().map(|d| libm::atan2(d[1], d[0])).collect();
    let (start, around) = unrolled(&mut angles);
    let mut seen: Vec<Seen> = local
        .iter()
        .zip(&angles)
        .map(|(d, a)| ([radius * a, d[2]], libm::hypot(d[0], d[1]) - radius))
        .collect();
    let course = longer_first(&mut seen, start);
    let radius = Some(radius);
    (Base { kind: BaseKind::Cylinder, origin, axes, radius, around, course, ..xy() }, seen)
}

fn sphere(points: &[Point], center: Point, radius: f64) -> (Base, Vec<Seen>) {
    let middle = points.iter().fold([0.0; 3], |sum, p| plus(sum, minus(*p, center)));
    let z = pole::axis(points, center).unwrap_or([0.0, 0.0, 1.0]);
    let x = unit(minus(middle, times(dot(middle, z), z))).map_or_else(|| across(z), |(d, _)| d);
    let axes = [x, cross(z, x), z];
    let local: Vec<Vector> =
        points.iter().map(|p| minus(*p, center)).map(|d| axes.map(|a| dot(d, a))).collect();
    let mut angles: Vec<f64> = local.iter().map(|d| libm::atan2(d[1], d[0])).collect();
    let (start, around) = unrolled(&mut angles);
    // Sine of ten degrees.
    let pole = local.iter().any(|d| libm::hypot(d[0], d[1]) < 0.1736 * norm(*d));
    let mut seen: Vec<Seen> = local
        .iter()
        .zip(&angles)
        .map(|(d, a)| ([radius * a, radius * libm::atan2(d[2], libm::hypot(d[0], d[1]))], norm(*d) - radius))
        .collect();
    let course = longer_first(&mut seen, start);
    (
        Base {
            kind: BaseKind::Sphere,
            origin: center,
            axes,
            radius: Some(radius),
            around,
            pole,
            course,
            ..xy()
        },
        seen,
    )
}

/// Least and greatest of both parameters.
pub(super) fn ranges(parameters: impl Iterator<Item = [f64; 2]>) -> [(f64, f64); 2] {
    let none = [(f64::INFINITY, f64::NEG_INFINITY); 2];
    parameters.fold(none, |both, p| {
        let wider = |(low, high): (f64, f64), x: f64| (low.min(x), high.max(x));
        [wider(both[0], p[0]), wider(both[1], p[1])]
    })
}
