//! Feet of points on surfaces.
//!
//! Planes, quadrics and tori have closed forms. The feet on an extrusion are those on the shadow of its curve, the feet on a turned
//! curve those of the point turned into the plane of the curve, and an offset has those of its basis.

use super::Jet;
use super::foot::Foot;
use super::kinds::Surface;
use super::patch::Patch;
use super::profile::Profile;
use super::seams::Pole;
use super::spline::SplineFeet;
use crate::curve::CurveFeet;
use crate::frame::Frame;
use std::f64::consts::{FRAC_PI_2, PI};
use trueness_geom::space::{Aabb, Point, Vector, dot, minus, norm, plus, times, unit};

/// Share of a spline's size within which a point is taken to lie on it, at the parameters next to those before.
const ON_SURFACE: f64 = 1e-4;
/// The same for parameters beside those before.
const OFF_SURFACE: f64 = 1e-2;
/// Parameters are beside others within this share of the domain: an eighth of an edge is no longer.
const BESIDE: f64 = 0.125;

/// A surface, ready to be asked for feet many times.
#[derive(Clone, Debug)]
pub struct SurfaceFeet {
    surface: Surface,
    kind: Kind,
    periods: [Option<f64>; 2],
    poles: Vec<Pole>,
}

#[derive(Clone, Debug)]
enum Kind {
    /// The surface itself says all.
    Closed,
    /// The shadow of the curve along the direction.
    Extrusion(CurveFeet),
    Revolution(Box<Profile>),
    Spline(Box<SplineFeet>),
    Offset(Box<SurfaceFeet>),
}

impl SurfaceFeet {
    /// Takes the surface apart. Cheap but for splines.
    pub fn new(surface: &Surface) -> SurfaceFeet {
        let periods = surface.periods();
        let kind = match surface {
            Surface::Extrusion { curve, direction } => {
                let way = unit(*direction).map_or([0.0; 3], |(way, _)| way);
                Kind::Extrusion(CurveFeet::along(curve, curve.domain(), way))
            }
            Surface::Revolution { curve, origin, axis } => {
                Kind::Revolution(Box::new(Profile::new(curve, *origin, *axis)))
            }
            Surface::Spline(nurbs) => Kind::Spline(Box::new(SplineFeet::new(nurbs, periods))),
            Surface::Offset { basis, .. } => Kind::Offset(Box::new(SurfaceFeet::new(basis))),
            _ => Kind::Closed,
        };
        SurfaceFeet { surface: surface.clone(), kind, periods, poles: surface.poles() }
    }

    /// The surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// See [`Surface::periods`].
    pub fn periods(&self) -> [Option<f64>; 2] {
        self.periods
    }

    /// See [`Surface::poles`].
    pub fn poles(&self) -> &[Pole] {
        &self.poles
    }

    /// Of a spline the foot that a descent from `near` comes to, if the point lies near to it.
    pub(super) fn continued(&self, p: Point, near: [f64; 2]) -> Option<Foot> {
        let Kind::Spline(spline) = &self.kind else { return None };
        let foot = spline.local(p, near, self.periods);
        // Edges of files are off their surfaces by more than that; then the foot must lie beside the one before.
        let domain = self.surface.domain();
        let is_beside = (0..2).all(|k| {
            let away = (foot.parameters[k] - near[k]).abs();
            let away = self.periods[k].map_or(away, |p| (away - p * (away / p).round()).abs());
            away <= BESIDE * (domain[k][1] - domain[k][0])
        });
        let most = if is_beside { OFF_SURFACE } else { ON_SURFACE };
        (foot.distance <= most * spline.size).then_some(foot)
    }

    /// Hands over every place where the distance from a point has a minimum that is below `limit`, which the callback says anew. Places where
    /// it stands still without one, poles, ends and corners may be among them. Where a whole line or all places are equally far,
    /// as from the axis of a cylinder or the center of a sphere, one of them stands for all: that at the angle 0, or 0 and 0.
    ///
    /// An offset's places are those at the parameters of its basis' feet.
    pub fn visit(&self, p: Point, limit: f64, visit: &mut dyn FnMut(Foot) -> f64) {
        let surface = &self.surface;
        match &self.kind {
            Kind::Closed => closed(surface, p, limit, visit),
            Kind::Extrusion(shadow) => {
                let Surface::Extrusion { curve, direction } = surface else { return };
                let way = unit(*direction).map_or([0.0; 3], |(way, _)| way);
                let flat = minus(p, times(dot(p, way), way));
                shadow.candidates(flat, limit, |foot| {
                    let start = curve.at(foot.parameter);
                    let v = dot(minus(p, start), *direction) / dot(*direction, *direction);
                    let place = plus(start, times(v, *direction));
                    visit(Foot { parameters: [foot.parameter, v], place, distance: norm(minus(place, p)) })
                });
            }
            Kind::Revolution(profile) => profile.visit(surface, p, limit, visit),
            Kind::Spline(spline) => spline.visit(p, limit, visit),
            Kind::Offset(basis) => basis.visit(p, f64::INFINITY, &mut |foot| {
                let [u, v] = foot.parameters;
                let place = surface.at(u, v);
                visit(Foot { parameters: [u, v], place, distance: norm(minus(place, p)) });
                f64::INFINITY
            }),
        }
    }

    /// Place and derivatives: of a spline by the piece that is known already.
    pub(crate) fn jet(&self, [u, v]: [f64; 2]) -> Jet {
        if let Kind::Spline(spline) = &self.kind { spline.jet([u, v]) } else { self.surface.jet(u, v) }
    }

    /// Of a spline its pieces between knots, row after row, and these.
    pub(crate) fn spans(&self) -> Option<(&[Patch], &[Vec<f64>; 2])> {
        if let Kind::Spline(spline) = &self.kind { Some((&spline.patches, &spline.knots)) } else { None }
    }

    /// Number of units that can be asked one by one: the pieces and creases of a spline; 1 of all others.
    pub(crate) fn units(&self) -> usize {
        if let Kind::Spline(spline) = &self.kind { spline.units() } else { 1 }
    }

    /// A box around a unit of a spline, and parameters in its middle.
    pub(crate) fn unit(&self, unit: usize) -> Option<(Aabb, [f64; 2])> {
        if let Kind::Spline(spline) = &self.kind { spline.unit(unit) } else { None }
    }

    /// [`SurfaceFeet::visit`] of one unit; ends of a spline that are not its seam are left out.
    pub(crate) fn visit_unit(&self, unit: usize, p: Point, limit: f64, visit: &mut dyn FnMut(Foot) -> f64) {
        match &self.kind {
            Kind::Spline(spline) => spline.visit_unit(unit, p, limit, visit),
            _ => self.visit(p, limit, visit),
        }
    }

    /// The nearest place; of several that are equally near, the one that [`SurfaceFeet::visit`] hands over first.
    pub fn nearest(&self, p: Point) -> Foot {
        let mut best = Foot { parameters: [f64::NAN; 2], place: [f64::NAN; 3], distance: f64::INFINITY };
        self.visit(p, f64::INFINITY, &mut |foot| {
            if foot.distance < best.distance {
                best = foot;
            }
            best.distance
        });
        best
    }
}

impl Surface {
    /// All places where the distance from a point has a minimum, and perhaps some more: see [`SurfaceFeet::visit`]. Of planes, quadrics and
    /// tori all where it stands still.
    pub fn feet(&self, p: Point) -> Vec<Foot> {
        let mut all = vec![];
        SurfaceFeet::new(self).visit(p, f64::INFINITY, &mut |foot| {
            all.push(foot);
            f64::INFINITY
        });
        all
    }
}

/// The feet on planes, quadrics and tori.
fn closed(surface: &Surface, p: Point, limit: f64, visit: &mut dyn FnMut(Foot) -> f64) {
    let mut limit = limit;
    let mut offer = |distance: f64, foot: &dyn Fn() -> ([f64; 2], Point)| {
        if distance < limit {
            let (parameters, place) = foot();
            limit = visit(Foot { parameters, place, distance });
        }
    };
    match surface {
        Surface::Plane(frame) => {
            let [u, v, w] = frame.local(p);
            offer(w.abs(), &|| ([u, v], frame.place([u, v, 0.0])));
        }
        Surface::Cylinder { frame, radius } => {
            let own = Meridian::new(frame, p);
            for side in [1.0, -1.0] {
                let place = [side * radius, own.height];
                offer((own.rho - side * radius).abs(), &|| ([own.angle(side), own.height], own.place(place)));
            }
        }
        Surface::Cone { frame, radius, half_angle } => {
            let own = Meridian::new(frame, p);
            let (c, s) = (libm::cos(*half_angle), libm::sin(*half_angle));
            for side in [1.0, -1.0] {
                let off = side * own.rho - radius;
                let v = (off * s + own.height * c) * c;
                let wide = radius + v * (s / c);
                let distance = (off * c - own.height * s).abs();
                offer(distance, &|| ([own.angle(side), v], own.place([side * wide, v])));
            }
            if s != 0.0 {
                let apex = -radius * c / s;
                let distance = libm::hypot(own.rho, own.height - apex);
                offer(distance, &|| ([own.angle(1.0), apex], own.place([0.0, apex])));
            }
        }
        Surface::Sphere { frame, radius } => {
            let own = Meridian::new(frame, p);
            own.circle([0.0, *radius], 1.0, &mut offer);
        }
        Surface::Torus { frame, major, minor } => {
            let own = Meridian::new(frame, p);
            own.circle([*major, *minor], 1.0, &mut offer);
            own.circle([*major, *minor], -1.0, &mut offer);
            if major < minor {
                let at = libm::acos(-major / minor);
                for v in [at, -at] {
                    let height = minor * libm::sin(v);
                    let distance = libm::hypot(own.rho, own.height - height);
                    offer(distance, &|| ([own.angle(1.0), v], own.place([0.0, height])));
                }
            }
        }
        _ => {}
    }
}

/// What [`closed`] offers a place to, with its distance.
type Offer<'a> = dyn FnMut(f64, &dyn Fn() -> ([f64; 2], Point)) + 'a;

/// A point seen in the half-plane of it and an axis.
struct Meridian<'a> {
    frame: &'a Frame,
    /// Unit vector from the axis to the point; the first axis of the frame where the point lies on it.
    way: Vector,
    flat: [f64; 2],
    /// Distance from the axis.
    rho: f64,
    /// Along the axis.
    height: f64,
}

impl<'a> Meridian<'a> {
    fn new(frame: &'a Frame, p: Point) -> Meridian<'a> {
        let [x, y, height] = frame.local(p);
        let rho = (x * x + y * y).sqrt();
        let (flat, unit) = if rho > 0.0 { ([x, y], [x / rho, y / rho]) } else { ([1.0, 0.0], [1.0, 0.0]) };
        Meridian { frame, way: frame.vector([unit[0], unit[1], 0.0]), flat, rho, height }
    }
    /// The angle of the point, or with −1 the opposite one.
    fn angle(&self, side: f64) -> f64 {
        libm::atan2(side * self.flat[1], side * self.flat[0])
    }
    /// The place at a radius, below 0 on the opposite side, and a height.
    fn place(&self, [radius, height]: [f64; 2]) -> Point {
        let z = self.frame.axes[2];
        std::array::from_fn(|k| self.frame.origin[k] + (radius * self.way[k] + height * z[k]))
    }
    /// The nearest and the farthest place of a circle about a place on this or the opposite side.
    fn circle(&self, [major, minor]: [f64; 2], side: f64, offer: &mut Offer) {
        let [x, z] = [side * self.rho - major, self.height];
        let reach = (x * x + z * z).sqrt();
        let (c, s) = if reach > 0.0 { (x / reach, z / reach) } else { (1.0, 0.0) };
        for sense in [1.0, -1.0] {
            let radius = major + sense * minor * c;
            let v = libm::atan2(sense * s, sense * c);
            let place = [side * radius, sense * minor * s];
            // That is on the other part of a torus that meets itself.
            if major < minor && major != 0.0 && radius < 0.0 {
                continue;
            }
            // On a sphere a place beyond the pole is that at the opposite angle.
            let beyond = major == 0.0 && v.abs() > FRAC_PI_2;
            let parameters = || match beyond {
                true => [self.angle(-side), v.signum() * PI - v],
                false => [self.angle(side), v],
            };
            offer((reach - sense * minor).abs(), &|| (parameters(), self.place(place)));
        }
    }
}
