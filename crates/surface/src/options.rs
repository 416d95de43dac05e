//! Options of a fit.

use trueness_geom::spline::basis::Knots;

/// The base that the parameters are taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BaseKind {
    /// The least-squares plane: lengths along the sides of the minimum bounding rectangle.
    Plane,
    /// x and y themselves.
    Xy,
    /// The least-squares cylinder: lengths around and along it.
    Cylinder,
    /// The least-squares sphere: lengths along its equator and its meridians, whose cross lies amid the points.
    Sphere,
    /// The facets of a mesh, laid flat: lengths as far as they can be kept.
    Mesh,
}

impl BaseKind {
    /// All of them.
    pub const ALL: [BaseKind; 5] =
        [BaseKind::Plane, BaseKind::Xy, BaseKind::Cylinder, BaseKind::Sphere, BaseKind::Mesh];

    /// The word for it: `plane`, `xy`, …
    pub fn name(self) -> &'static str {
        match self {
            BaseKind::Plane => "plane",
            BaseKind::Xy => "xy",
            BaseKind::Cylinder => "cylinder",
            BaseKind::Sphere => "sphere",
            BaseKind::Mesh => "mesh",
        }
    }
}

/// Highest degree that is fitted.
pub const HIGHEST_DEGREE: usize = 9;

/// Where the knots come from.
#[derive(Clone, Debug, PartialEq)]
pub enum Layout {
    /// Eight equal spans along `u` and `v`. A cylinder or a sphere has one for each 15° of it, where that is more and
    /// the points allow it.
    Auto,
    /// So many equal spans along `u` and `v`.
    Spans([usize; 2]),
    /// These knots. Their degrees count.
    Knots([Knots; 2]),
    /// As many as keep all points within this distance, millimeters, or as the noise of the points allows.
    Tolerance(f64),
}

/// The weight of the thin-plate term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fairness {
    /// That of least generalized cross-validation.
    Auto,
    /// This one, mm²; 0 for none. The fit minimizes the sum of the squared distances plus the weight times the integral
    /// of `|S_uu|² + 2 |S_uv|² + |S_vv|²` over the parameters.
    Weight(f64),
}

/// How to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Degrees along `u` and `v`, from 1 to [`HIGHEST_DEGREE`].
    pub degree: [usize; 2],
    /// Where the knots come from.
    pub layout: Layout,
    /// Where the parameters come from.
    pub base: BaseKind,
    /// The weight of the thin-plate term.
    pub fairness: Fairness,
    /// How often the parameters are replaced by those of the nearest places at most. With [`BaseKind::Xy`] they never are. With them the ends
    /// of the domain move outward as far as nearest places lie beyond, but those of given knots.
    pub corrections: usize,
    /// Whether points that contradict their neighbors are left out.
    pub robust: bool,
    /// Bytes that the matrix of the normal equations may take.
    pub memory: usize,
}

impl Options {
    /// Corrections of the parameters at most, as far as the base allows.
    pub(super) fn corrections_made(&self) -> usize {
        if self.base == BaseKind::Xy { 0 } else { self.corrections }
    }

    /// Whether the ends of the domain move outward to where the outermost points have their nearest places. They do as
    /// the parameters are corrected, and over knots that are not given.
    pub(super) fn ends_move(&self) -> bool {
        self.corrections_made() > 0 && !matches!(self.layout, Layout::Knots(_))
    }
}

impl Default for Options {
    fn default() -> Options {
        Options {
            degree: [3, 3],
            layout: Layout::Spans([8, 8]),
            base: BaseKind::Plane,
            fairness: Fairness::Auto,
            corrections: 5,
            robust: false,
            memory: 2 << 30,
        }
    }
}
