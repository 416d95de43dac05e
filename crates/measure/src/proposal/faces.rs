//! The faces of a model as features of plans: faces on one surface are one feature.

use std::collections::BTreeMap;
use trueness_cad::brep::{Brep, Face};
use trueness_cad::frame::Frame;
use trueness_cad::model::Model;
use trueness_cad::surface::{Surface, SurfaceKind};
use trueness_geom::shape::Shape;
use trueness_geom::space::{Vector, cross, dot, minus, norm, plus, times};

/// The uncertainty of lengths of a file that states none, millimeters: what most programs state.
const UNSTATED_UNCERTAINTY: f64 = 1e-3;
/// Sine of the angle within which directions are one: 0.001 mm over 100 mm.
const MAX_SINE_OF_AXES: f64 = 1e-5;

/// Features of one tolerance, or of a proposal without tolerances, at most.
const MAX_GROUPS: usize = 2000;

/// Faces that lie on one surface.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// The surface; the normal of a plane points out of the material.
    pub shape: Shape,
    /// Of a cylinder or sphere: whether the material is around it.
    pub internal: Option<bool>,
    /// Numbers of the faces, in their order.
    pub faces: Vec<u64>,
}

/// The faces of a model by their numbers.
pub(super) struct Faces<'m> {
    model: &'m Model,
    brep: Brep,
    of: BTreeMap<u64, Vec<usize>>,
    /// Places nearer together are one, millimeters.
    near: f64,
}

impl<'m> Faces<'m> {
    /// Those of a model where they stand.
    pub fn of(model: &'m Model) -> Faces<'m> {
        let brep = model.assembled();
        let mut of: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
        for (index, face) in brep.faces.iter().enumerate() {
            of.entry(face.entity).or_default().push(index);
        }
        Faces { model, brep, of, near: model.same_within().unwrap_or(UNSTATED_UNCERTAINTY) }
    }

    /// The numbers of all faces.
    pub fn numbers(&self) -> impl Iterator<Item = u64> + '_ {
        self.of.keys().copied()
    }

    /// Where the first instance of a face stands and how many there are, if there are several.
    pub fn instance(&self, face: u64) -> Option<(String, usize)> {
        let all = self.of.get(&face).filter(|all| all.len() > 1)?;
        let first = self.brep.faces.get(*all.first()?)?;
        Some((self.model.instances.get(first.instance as usize)?.path.join("/"), all.len()))
    }

    /// Features of these faces, each in its first instance, and what of them is none.
    pub fn groups(&self, faces: impl IntoIterator<Item = u64>) -> (Vec<Group>, Vec<String>) {
        let (mut groups, mut none): (Vec<Group>, Vec<String>) = (vec![], vec![]);
        for number in faces {
            let face = self.of.get(&number).and_then(|all| self.brep.faces.get(*all.first()?));
            let Some(face) = face else {
                none.push(format!("face {number} was not read"));
                continue;
            };
            let Some((shape, internal)) = shape(face) else {
                none.push(format!("face {number} is {}", name(face.surface.kind())));
                continue;
            };
            let is_full = groups.len() == MAX_GROUPS;
            let same = |g: &&mut Group| g.internal == internal && is_same(&g.shape, &shape, self.near);
            match groups.iter_mut().find(same) {
                Some(group) => group.faces.push(number),
                None if !is_full => {
                    groups.push(Group { shape, internal, faces: vec![number] });
                }
                None => {
                    none.push(format!("the faces from {number} on are more than {MAX_GROUPS} surfaces"));
                    break;
                }
            }
        }
        (groups, none)
    }
}

/// What a surface is that plans have no feature for.
fn name(kind: SurfaceKind) -> &'static str {
    match kind {
        SurfaceKind::Plane => "a plane",
        SurfaceKind::Cylinder => "a cylinder",
        SurfaceKind::Cone => "a cone",
        SurfaceKind::Sphere => "a sphere",
        SurfaceKind::Torus => "a torus",
        SurfaceKind::Spline => "a free form",
        SurfaceKind::Extrusion => "an extruded surface",
        SurfaceKind::Revolution => "a turned surface",
        SurfaceKind::Offset => "an offset surface",
    }
}

/// The shape of a face that plans have, and on which side its material is.
fn shape(face: &Face) -> Option<(Shape, Option<bool>)> {
    // In a mirrored frame the normal of the surface is that of the other side.
    let looks_back = |frame: &Frame| face.reversed != frame.is_mirrored();
    Some(match &face.surface {
        Surface::Plane(frame) => {
            let normal = cross(frame.axes[0], frame.axes[1]);
            let normal = times(if face.reversed { -1.0 } else { 1.0 }, normal);
            (Shape::Plane { point: frame.origin, normal }, None)
        }
        Surface::Cylinder { frame, radius } => {
            let shape = Shape::Cylinder { point: frame.origin, direction: frame.axes[2], radius: *radius };
            (shape, Some(looks_back(frame)))
        }
        Surface::Cone { frame, radius, half_angle } => {
            let slope = libm::tan(*half_angle);
            let axis = frame.axes[2];
            let apex = minus(frame.origin, times(radius / slope, axis));
            let direction = times(slope.signum(), axis);
            let (half_angle, point, radius) = (half_angle.abs(), frame.origin, *radius);
            (Shape::Cone { apex, direction, half_angle, point, radius }, None)
        }
        Surface::Sphere { frame, radius } => {
            (Shape::Sphere { center: frame.origin, radius: *radius }, Some(looks_back(frame)))
        }
        _ => return None,
    })
}

fn is_same(a: &Shape, b: &Shape, near: f64) -> bool {
    let across = |a: Vector, b: Vector| norm(cross(a, b));
    match (*a, *b) {
        (Shape::Plane { point: p, normal: m }, Shape::Plane { point: q, normal: n }) => {
            dot(m, n) > 0.0 && across(m, n) < MAX_SINE_OF_AXES && dot(minus(q, p), m).abs() < near
        }
        (
            Shape::Cylinder { point: p, direction: m, radius: r },
            Shape::Cylinder { point: q, direction: n, radius: s },
        ) => across(m, n) < MAX_SINE_OF_AXES && norm(cross(minus(q, p), m)) < near && (r - s).abs() < near,
        (
            Shape::Cone { apex: p, direction: m, half_angle: a, .. },
            Shape::Cone { apex: q, direction: n, half_angle: b, .. },
        ) => {
            let is_turned = dot(m, n) < 0.0 || across(m, n) > MAX_SINE_OF_AXES;
            !is_turned && norm(minus(p, q)) < near && (a - b).abs() < MAX_SINE_OF_AXES
        }
        (Shape::Sphere { center: p, radius: r }, Shape::Sphere { center: q, radius: s }) => {
            norm(minus(p, q)) < near && (r - s).abs() < near
        }
        _ => false,
    }
}

/// The plane amid two planes that face opposite ways, as those of a slot or a block: a point and the normal of the first.
pub(super) fn median(groups: &[Group]) -> Option<Shape> {
    let [a, b] = groups else { return None };
    match (a.shape, b.shape) {
        (Shape::Plane { point: p, normal }, Shape::Plane { point: q, normal: n })
            if dot(normal, n) < 0.0 && norm(cross(normal, n)) < MAX_SINE_OF_AXES =>
        {
            Some(Shape::Plane { point: times(0.5, plus(p, q)), normal })
        }
        _ => None,
    }
}
