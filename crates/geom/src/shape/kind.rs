//! The kinds of shape.

/// The meaning of the sign of a distance from an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// Nothing: a curve in space has no sides.
    None,
    /// Positive is the side that the normal points to, or the left of a line in the plane.
    OfNormal,
    /// Positive is away from the axis or center.
    InAndOut,
}

/// How one of the two coordinates of the places of an element runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// Not at all: it is 0.
    None,
    /// Along an axis of its frame, millimeters.
    Length,
    /// Around, radians.
    Turn,
    /// Up from the equator, radians, −π/2 to π/2.
    Latitude,
}

/// The kind of quantity of a parameter of an element, and so its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A number in millimeters.
    Length,
    /// A number in radians.
    Angle,
    /// Three numbers in millimeters.
    Place,
    /// Three numbers without unit: a direction of length 1.
    Direction,
}

/// The kinds, and the list of all of them.
macro_rules! kinds {
    ($(#[$about:meta] $name:ident,)*) => {
        /// Which element is fitted. Kinds with a `2` lie in the plane z = 0 and take no notice of z.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Kind {
            $(#[$about] $name,)*
        }

        impl Kind {
            /// All kinds.
            pub const ALL: [Kind; [$(Kind::$name),*].len()] = [$(Kind::$name),*];
        }
    };
}

kinds! {
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
    /// Names of its parameters, in the order of [`Shape::parameters`](super::Shape::parameters), and what they are.
    pub fn parameters(self) -> &'static [(&'static str, Quantity)] {
        use Quantity::{Angle, Direction, Length, Place};
        match self {
            Kind::Line2 | Kind::Line => &[("point", Place), ("direction", Direction)],
            Kind::Plane => &[("point", Place), ("normal", Direction)],
            Kind::Circle2 | Kind::Sphere => &[("center", Place), ("radius", Length)],
            Kind::Circle => &[("center", Place), ("normal", Direction), ("radius", Length)],
            Kind::Cylinder => &[("point", Place), ("direction", Direction), ("radius", Length)],
            Kind::Cone => &[
                ("apex", Place),
                ("direction", Direction),
                ("half_angle", Angle),
                ("point", Place),
                ("radius", Length),
            ],
            Kind::Ellipse2 | Kind::Torus => &[
                ("center", Place),
                ("direction", Direction),
                ("major_radius", Length),
                ("minor_radius", Length),
            ],
        }
    }
    /// The quantity of its parameter of this name; `None` where it has none.
    pub fn quantity(self, parameter: &str) -> Option<Quantity> {
        self.parameters().iter().find(|(name, _)| *name == parameter).map(|(_, quantity)| *quantity)
    }
    /// Number of unknowns.
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
    /// The meaning of the sign of a distance from it.
    pub fn sides(self) -> Sides {
        match self {
            Kind::Line | Kind::Circle => Sides::None,
            Kind::Line2 | Kind::Plane => Sides::OfNormal,
            Kind::Circle2 | Kind::Ellipse2 | Kind::Sphere | Kind::Cylinder | Kind::Cone | Kind::Torus => {
                Sides::InAndOut
            }
        }
    }
    /// How the two coordinates of its places run, as [`Shape::coordinates`](super::Shape::coordinates) gives them: of what is
    /// round, around the third axis of its frame first.
    pub fn coordinates(self) -> [Coordinate; 2] {
        use Coordinate::{Latitude, Length, None, Turn};
        match self {
            Kind::Line2 | Kind::Line => [None, Length],
            Kind::Plane => [Length, Length],
            Kind::Circle2 | Kind::Circle | Kind::Ellipse2 => [Turn, None],
            Kind::Cylinder | Kind::Cone => [Turn, Length],
            Kind::Sphere => [Turn, Latitude],
            Kind::Torus => [Turn, Turn],
        }
    }
    /// Whether plans seek it in a part by its nominal form ([`Nominal`](crate::feature::Nominal)).
    pub fn has_nominal(self) -> bool {
        matches!(self, Kind::Plane | Kind::Cylinder | Kind::Cone | Kind::Sphere)
    }
    /// The kind with this name, in the plane z = 0 or not.
    pub fn named(name: &str, flat: bool) -> Option<Kind> {
        Kind::ALL.into_iter().find(|kind| kind.name() == name && kind.is_flat() == flat)
    }
    /// Whether it is a curve, not a surface.
    pub fn is_curve(self) -> bool {
        matches!(self, Kind::Line2 | Kind::Line | Kind::Circle2 | Kind::Circle | Kind::Ellipse2)
    }
    /// Whether it lies in the plane z = 0.
    pub fn is_flat(self) -> bool {
        matches!(self, Kind::Line2 | Kind::Circle2 | Kind::Ellipse2)
    }
}
