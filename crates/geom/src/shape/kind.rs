//! The kinds of shape.

/// Which element is fitted. Those with a `2` lie in the plane z = 0 and take no notice of z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// Straight line in the plane.
    Line2,
    /// Straight line in space.
    Line,
    /// Plane.
    Plane,
    /// Circle in the plane.
    Circle2,
    /// Circle in space.
    Circle,
    /// Ellipse in the plane.
    Ellipse2,
    /// Sphere.
    Sphere,
    /// Right circular cylinder.
    Cylinder,
    /// Right circular cone.
    Cone,
    /// Ring torus.
    Torus,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Kind; 10] = [
        Kind::Line2,
        Kind::Line,
        Kind::Plane,
        Kind::Circle2,
        Kind::Circle,
        Kind::Ellipse2,
        Kind::Sphere,
        Kind::Cylinder,
        Kind::Cone,
        Kind::Torus,
    ];
    /// The word for it: `line`, `plane`, … The same in the plane and in space.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Line2 | Kind::Line => "line",
            Kind::Plane => "plane",
            Kind::Circle2 | Kind::Circle => "circle",
            Kind::Ellipse2 => "ellipse",
            Kind::Sphere => "sphere",
            Kind::Cylinder => "cylinder",
            Kind::Cone => "cone",
            Kind::Torus => "torus",
        }
    }
    /// Number of unknowns: fewer points do not determine it.
    pub fn unknowns(self) -> usize {
        match self {
            Kind::Line2 => 2,
            Kind::Plane | Kind::Circle2 => 3,
            Kind::Line | Kind::Sphere => 4,
            Kind::Ellipse2 | Kind::Cylinder => 5,
            Kind::Circle | Kind::Cone => 6,
            Kind::Torus => 7,
        }
    }
    /// Fewest points that can determine it. A point of a curve in space counts for two.
    pub fn fewest_points(self) -> usize {
        match self {
            Kind::Line => 2,
            Kind::Circle => 3,
            kind => kind.unknowns(),
        }
    }
    /// Whether it lies in the plane z = 0.
    pub fn is_flat(self) -> bool {
        matches!(self, Kind::Line2 | Kind::Circle2 | Kind::Ellipse2)
    }
}
