//! The shapes that are fitted, and how.

use crate::word::words;

words! {
    /// What an element is. Those with a `2` lie in the plane; another key of the document tells them from those in space.
    ShapeKind, "shape", {
        /// Straight line in the plane.
        Line2 = "line",
        /// Straight line in space.
        Line = "line",
        /// Plane.
        Plane = "plane",
        /// Circle in the plane.
        Circle2 = "circle",
        /// Circle in space.
        Circle = "circle",
        /// Ellipse in the plane.
        Ellipse2 = "ellipse",
        /// Sphere.
        Sphere = "sphere",
        /// Right circular cylinder.
        Cylinder = "cylinder",
        /// Right circular cone.
        Cone = "cone",
        /// Ring torus.
        Torus = "torus",
    }
}

words! {
    /// What makes an element the best.
    FitMethod, "method of a fit", {
        /// Least sum of squared distances.
        Gaussian = "gaussian",
        /// Least deviation of form.
        MinimumZone = "minimum-zone",
        /// The smallest one around all points.
        MinimumCircumscribed = "minimum-circumscribed",
        /// The largest one free of points.
        MaximumInscribed = "maximum-inscribed",
        /// Outliers do not count.
        Robust = "robust",
    }
}
