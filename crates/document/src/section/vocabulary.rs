//! The words of sections.

use crate::word::words;

words! {
    /// How smoothly two segments join.
    Continuity, "continuity", {
        /// At a corner.
        G0 = "g0",
        /// With a common tangent.
        G1 = "g1",
        /// With a common tangent and, as far as the data can tell, curvature.
        G2 = "g2",
    }
}

words! {
    /// What the points of a contour were taken for.
    Taken, "kind of row", {
        /// Measured points in order.
        Row = "row",
        /// Where a plane cuts the exact facets of a drawing.
        Facets = "facets",
        /// Where a plane cuts the facets of a scan.
        Scan = "scan",
    }
}

words! {
    /// What a dimension is of.
    DimensionKind, "kind of dimension", {
        /// The angle that a line and the next line of a contour enclose.
        Angle = "angle",
        /// The distance of two parallel lines that face each other.
        Width = "width",
        /// The distance of the centers of two arcs.
        Centers = "centers",
        /// The least distance of two contours.
        Gap = "gap",
    }
}

words! {
    /// What a drawing of a contour would have.
    OfferKind, "kind of offer", {
        /// A line runs along the first axis.
        Horizontal = "horizontal",
        /// A line runs along the second axis.
        Vertical = "vertical",
        /// Two lines have one direction.
        Parallel = "parallel",
        /// A line lies on another.
        InLine = "in_line",
        /// Two lines of a contour, one after the other, enclose a right angle.
        RightAngle = "right_angle",
        /// Two segments that join at a corner have a common tangent there.
        Tangent = "tangent",
        /// Two arcs have one radius.
        EqualRadii = "equal_radii",
        /// Two arcs have one center.
        Concentric = "concentric",
        /// The radius of an arc is a whole number of steps.
        Radius = "radius",
        /// The diameter of a circle is a whole number of steps.
        Diameter = "diameter",
        /// The length of a line is a whole number of steps.
        Length = "length",
        /// The distance of two parallel lines is a whole number of steps.
        Distance = "distance",
        /// The distance of the centers of two arcs is a whole number of steps.
        Centers = "centers",
    }
}

impl OfferKind {
    /// Whether its values are angles, in radians; else they are lengths.
    pub fn is_angle(self) -> bool {
        matches!(
            self,
            OfferKind::Horizontal | OfferKind::Vertical | OfferKind::Parallel | OfferKind::RightAngle
        )
    }
}
