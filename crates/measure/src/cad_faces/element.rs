//! The element that a surface is.

use trueness_cad::frame::Frame;
use trueness_cad::surface::Surface;
use trueness_geom::shape::Shape;
use trueness_geom::space::{Point, plus, times};

/// Which way a face looks out of the material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sense {
    /// Along the normal of its plane.
    Flat,
    /// Towards its axis or center.
    Inward,
    /// Away from its axis or center.
    Outward,
}

/// An element, and what of it a face is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub shape: Shape,
    pub sense: Sense,
    /// Places on the axis of a cylinder or cone between which the face lies.
    pub ends: Option<[Point; 2]>,
}

/// The element of a face that has these parameters at most; `None` where it is none: a free form, or a torus that meets itself.
pub(super) fn of(surface: &Surface, reversed: bool, window: [[f64; 2]; 2]) -> Option<Found> {
    let found = |shape, frame: &Frame, ends| {
        // ∂u × ∂v looks away from the axis in right-handed frames, on both nappes of a cone.
        let is_inward = reversed != frame.is_mirrored();
        let sense = if is_inward { Sense::Inward } else { Sense::Outward };
        Some(Found { shape, sense, ends })
    };
    let on_axis = |frame: &Frame| window[1].map(|v| plus(frame.origin, times(v, frame.axes[2])));
    match surface {
        Surface::Plane(frame) => {
            let side = if reversed != frame.is_mirrored() { -1.0 } else { 1.0 };
            let shape = Shape::Plane { point: frame.origin, normal: times(side, frame.axes[2]) };
            Some(Found { shape, sense: Sense::Flat, ends: None })
        }
        Surface::Cylinder { frame, radius } => {
            let shape = Shape::Cylinder { point: frame.origin, direction: frame.axes[2], radius: *radius };
            found(shape, frame, Some(on_axis(frame)))
        }
        Surface::Cone { frame, radius, half_angle } => {
            let slope = libm::tan(*half_angle);
            let middle = 0.5 * (window[1][0] + window[1][1]);
            let wide = radius + middle * slope;
            let at = |v: f64| plus(frame.origin, times(v, frame.axes[2]));
            let apex = at(-radius / slope);
            if apex.iter().any(|x| !x.is_finite()) || wide == 0.0 {
                return None;
            }
            let shape = Shape::Cone {
                apex,
                // Into the nappe that the face is on.
                direction: times((slope * wide).signum(), frame.axes[2]),
                half_angle: half_angle.abs(),
                point: at(middle),
                radius: wide.abs(),
            };
            found(shape, frame, Some(on_axis(frame)))
        }
        Surface::Sphere { frame, radius } => {
            found(Shape::Sphere { center: frame.origin, radius: *radius }, frame, None)
        }
        Surface::Torus { frame, major, minor } if major > minor => {
            let shape = Shape::Torus {
                center: frame.origin,
                direction: frame.axes[2],
                major_radius: *major,
                minor_radius: *minor,
            };
            found(shape, frame, None)
        }
        _ => None,
    }
}
