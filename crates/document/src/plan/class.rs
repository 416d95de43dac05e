//! What a feature is to a characteristic.

use crate::word::named;

/// What a feature is to a characteristic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// A place.
    Point,
    /// An axis or median line.
    Line,
    /// A plane, median planes too.
    Plane,
    /// One section of something round.
    Circle,
    /// A sphere.
    Sphere,
    /// A cylinder.
    Cylinder,
    /// A cone.
    Cone,
    /// A torus.
    Torus,
}

impl Class {
    /// All of them.
    pub const ALL: [Class; 8] = [
        Class::Point,
        Class::Line,
        Class::Plane,
        Class::Circle,
        Class::Sphere,
        Class::Cylinder,
        Class::Cone,
        Class::Torus,
    ];

    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Class::Point => "point",
            Class::Line => "line",
            Class::Plane => "plane",
            Class::Circle => "circle",
            Class::Sphere => "sphere",
            Class::Cylinder => "cylinder",
            Class::Cone => "cone",
            Class::Torus => "torus",
        }
    }
}

named!(Class, "class of features", Self::ALL, |class| class.word());
