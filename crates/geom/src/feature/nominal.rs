//! Nominal features: what is looked for, and how near to it.

use super::bounds::Polygon;
use crate::shape::Shape;
use crate::space::{Point, Vector, plus, times, unit};

/// A feature as the model has it, in the model's coordinates, millimeters and radians. Directions need not be unit vectors.
#[derive(Clone, Debug, PartialEq)]
pub enum Nominal {
    /// A plane within a boundary: the corners of a polygon, in order.
    Plane {
        /// A point of it.
        point: Point,
        /// Normal, out of the material.
        normal: Vector,
        /// Corners, at least three.
        boundary: Vec<Point>,
    },
    /// A cylinder between two planes across its axis.
    Cylinder {
        /// Start of the axis.
        point: Point,
        /// Direction of the axis, from the start.
        direction: Vector,
        /// Radius.
        radius: f64,
        /// Length of the axis.
        length: f64,
    },
    /// A cone between two planes across its axis.
    Cone {
        /// Its tip.
        apex: Point,
        /// Direction of the axis, from the tip into the cone.
        direction: Vector,
        /// Angle between axis and surface.
        half_angle: f64,
        /// Where it begins and ends, as distances from the tip along the axis.
        between: [f64; 2],
    },
    /// A sphere, or the part of one that is there.
    Sphere {
        /// Its center.
        center: Point,
        /// Radius.
        radius: f64,
    },
    /// An edge where two planes meet: its rounding or chamfer.
    Edge {
        /// Start of the edge.
        point: Point,
        /// Direction, from the start.
        direction: Vector,
        /// Length.
        length: f64,
        /// Normals of the two planes, out of the material.
        normals: [Vector; 2],
    },
}

/// How near a facet must be to the nominal feature to belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearness {
    /// Greatest distance of its corners from the nominal surface, millimeters.
    pub distance: f64,
    /// Greatest angle of its normal to the nominal one, radians.
    pub angle: f64,
    /// The width left out along the bounds of the feature, millimeters; below zero, how far it may reach beyond them.
    pub margin: f64,
    /// Whether vertices that facets of other features share count: on a sharp edge they belong to both.
    pub rim: bool,
    /// Whether the facets of a cylinder, cone or sphere face its axis or center, as those of a bore do. Both ways count where
    /// it is `None`.
    pub inward: Option<bool>,
}

/// Why a feature cannot be sought.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FeatureError {
    /// A number of the nominal feature is not finite.
    #[error("a number of the nominal feature is not finite")]
    NotFinite,
    /// A direction has no length.
    #[error("the {what} of the nominal feature has no length")]
    NoDirection {
        /// Which.
        what: &'static str,
    },
    /// A size is not above zero.
    #[error("the {what} of the nominal feature is {value}; it must be above 0")]
    Size {
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// The boundary of a plane encloses nothing.
    #[error("the boundary of the nominal plane needs at least three corners that enclose an area")]
    Boundary,
    /// An edge is no face.
    #[error("an edge is no face")]
    NoFace,
}

impl Nominal {
    /// Places that tell roughly where it is, millimeters: corners, ends of an axis, a center. Not exact bounds.
    pub fn places(&self) -> Vec<Point> {
        let along = |p: &Point, d: &Vector, by: f64| {
            let way = unit(*d).map_or([0.0; 3], |(d, _)| times(by, d));
            plus(*p, way)
        };
        match self {
            Nominal::Plane { boundary, .. } => boundary.clone(),
            Nominal::Cylinder { point, direction, length, .. }
            | Nominal::Edge { point, direction, length, .. } => {
                vec![*point, along(point, direction, *length)]
            }
            Nominal::Cone { apex, direction, between, .. } => {
                between.iter().map(|by| along(apex, direction, *by)).collect()
            }
            Nominal::Sphere { center, .. } => vec![*center],
        }
    }

    /// Its normal or the direction of its axis, of any length; of a sphere, `None`.
    pub fn direction(&self) -> Option<Vector> {
        match self {
            Nominal::Plane { normal, .. } => Some(*normal),
            Nominal::Cylinder { direction, .. }
            | Nominal::Cone { direction, .. }
            | Nominal::Edge { direction, .. } => Some(*direction),
            Nominal::Sphere { .. } => None,
        }
    }

    /// The element that it lies on, with unit directions; `None` of an edge, and where a direction has no length.
    ///
    /// ```
    /// use trueness_geom::{feature::Nominal, shape::Shape};
    /// let bore = Nominal::Cylinder { point: [0.0; 3], direction: [0.0, 0.0, 2.0], radius: 4.0, length: 9.0 };
    /// assert_eq!(bore.shape(), Some(Shape::Cylinder { point: [0.0; 3], direction: [0.0, 0.0, 1.0], radius: 4.0 }));
    /// ```
    pub fn shape(&self) -> Option<Shape> {
        let way = |v: Vector| unit(v).map(|u| u.0);
        Some(match *self {
            Nominal::Plane { point, normal, .. } => Shape::Plane { point, normal: way(normal)? },
            Nominal::Cylinder { point, direction, radius, .. } => {
                Shape::Cylinder { point, direction: way(direction)?, radius }
            }
            Nominal::Cone { apex, direction, half_angle, between: [from, to] } => {
                let (direction, along) = (way(direction)?, 0.5 * (from + to));
                let radius = along * libm::tan(half_angle);
                Shape::Cone {
                    apex,
                    direction,
                    half_angle,
                    point: plus(apex, times(along, direction)),
                    radius,
                }
            }
            Nominal::Sphere { center, radius } => Shape::Sphere { center, radius },
            Nominal::Edge { .. } => return None,
        })
    }

    /// Area of the feature as the model has it, holes in it not taken off, mm²; of an edge, `None`.
    pub fn area(&self) -> Option<f64> {
        let turn = std::f64::consts::TAU;
        match self {
            Nominal::Plane { point, normal, boundary } => {
                Polygon::new(*point, *normal, boundary).map(|p| p.area())
            }
            Nominal::Cylinder { radius, length, .. } => Some(turn * radius * length),
            Nominal::Cone { half_angle, between: [from, to], .. } => {
                let slope = libm::tan(*half_angle);
                Some(0.5 * turn * slope * (to * to - from * from).abs() / libm::cos(*half_angle))
            }
            Nominal::Sphere { radius, .. } => Some(2.0 * turn * radius * radius),
            Nominal::Edge { .. } => None,
        }
    }
}
