//! A feature taken from the measured data: its points, and the element associated with them.

use super::reason::{Lack, NoElement, NotMeasured};
use super::value::{Missing, Value};
use trueness_document::plan::Class;
use trueness_geom::feature::Nominal;
use trueness_geom::fit::{Fit, FitError, Method, Options, fit};
use trueness_geom::progress::Progress;
use trueness_geom::rigid::Rigid;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::{Point, Vector, dot, minus, plus, times};
use trueness_geom::zone::datum::Datum;
use trueness_geom::zone::mean;

/// A feature of a plan, measured or not.
#[derive(Clone, Debug)]
pub struct MeasuredFeature {
    /// Its name.
    pub id: String,
    /// What it is.
    pub class: Class,
    /// Its points; of a derived median plane, those of its two planes, projected onto it.
    pub points: Vec<Point>,
    /// Points on its rim that do not count for its element, but tell how far it goes.
    pub rim: Vec<Point>,
    /// The area that each point stands for; 1 for points without facets.
    pub areas: Vec<f64>,
    /// Facets of the measured mesh that it has.
    pub facets: Vec<u32>,
    /// Whether its points have two coordinates only.
    pub planar: bool,
    /// Whether it is an edge: a line fitted to a narrow band.
    pub edge: bool,
    /// A direction out of the material, where it is known.
    pub outward: Option<Vector>,
    /// Of a cylinder, cone or sphere, whether the material is around it, where the plan says so.
    pub internal: Option<bool>,
    /// The same, where the reference says so too.
    pub inward: Option<bool>,
    /// As the model has it.
    pub nominal: Option<Nominal>,
    /// Share of the nominal area that was measured.
    pub coverage: Option<f64>,
    /// Measured points that lie over it, but too far off to be part of it.
    pub left_out: Option<ExcludedPoints>,
    /// Measured points within its reach that were taken for those of other surfaces.
    pub others: Others,
    /// The element, or why there is none.
    pub element: Result<Element, NoElement>,
}

/// Points within the reach of a feature that are not of it, or not for certain.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Others {
    /// Where those are of which it is not certain.
    pub points: Vec<Point>,
    /// How many of them lie along an edge, farther from it than scans are rounded, and are explained by no face.
    pub broken: usize,
    /// How many lie deeper in the material than the reach, or hang together with such.
    pub deep: usize,
    /// How many lie farther out of it, or hang together with such.
    pub high: usize,
    /// How many lie between it and the other side of a wall, off both.
    pub between: usize,
    /// How many are of its surface, farther off than its reach.
    pub far: usize,
    /// How many are corners of facets along it that are of no face.
    pub drawn: usize,
    /// Points on its edges, where scans are rounded: none of the others.
    pub edge: usize,
    /// Points of it in dents that are deeper than its reach: none of the others.
    pub dents: usize,
    /// Points of a scan that stick out, with no more than two together: none of the others.
    pub outliers: usize,
    /// How far off the farthest of them lies, millimeters.
    pub farthest_outlier: f64,
    /// Whether there is a reference.
    pub on_reference: bool,
}

impl Others {
    /// Counts outliers that lie so far off.
    pub(crate) fn add_outliers(&mut self, off: Vec<f64>) {
        self.outliers += off.len();
        self.farthest_outlier = off.into_iter().fold(self.farthest_outlier, f64::max);
    }
}

/// Points that were left out of a feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExcludedPoints {
    /// Their number.
    pub points: u64,
    /// Distance, mm, of the farthest of them from the nominal surface.
    pub farthest: f64,
    /// The distance, mm, that they are beyond.
    pub limit: f64,
}

impl ExcludedPoints {
    /// Of points so far off.
    pub(crate) fn of(off: &[f64], limit: f64) -> ExcludedPoints {
        let farthest = off.iter().fold(0.0, |m: f64, d| m.max(*d));
        ExcludedPoints { points: off.len() as u64, farthest, limit }
    }
}

/// What a feature is made to.
#[derive(Clone, Debug)]
pub enum Element {
    /// An element fitted to the points.
    Fit(Box<Fit>),
    /// The mean of the points, or a derived point.
    Point(Point),
    /// A derived plane or line.
    Derived(Datum),
}

impl MeasuredFeature {
    fn element(&self) -> Result<&Element, Missing> {
        self.element.as_ref().map_err(|reason| self.lacks(Lack::Element(reason.clone())))
    }

    /// Why it gives no value.
    pub(super) fn lacks(&self, lack: Lack) -> Missing {
        NotMeasured::Feature { id: self.id.clone(), lack }.into()
    }

    /// Its points.
    ///
    /// # Errors
    /// Why it has none.
    pub fn own_points(&self) -> Result<&[Point], Missing> {
        match &self.element {
            // Too few points, or too little of it measured: no zone about them would mean anything.
            Err(reason) => Err(self.lacks(Lack::Element(reason.clone()))),
            _ if self.points.is_empty() => Err(self.lacks(Lack::Points)),
            _ => Ok(&self.points),
        }
    }

    /// Its element.
    ///
    /// # Errors
    /// Why it has none.
    pub fn shape(&self) -> Result<Shape, Missing> {
        match self.element()? {
            Element::Fit(fit) => Ok(fit.shape),
            _ => Err(self.lacks(Lack::FittedElement)),
        }
    }

    /// Another element through its points.
    ///
    /// # Errors
    /// Too few points, points that determine none.
    pub fn refitted(&self, kind: Kind, method: Method, progress: &dyn Progress) -> Result<Fit, Missing> {
        if let Element::Fit(fit) = self.element()?
            && fit.shape.kind() == kind
            && fit.method == method
        {
            return Ok((**fit).clone());
        }
        let options = Options { method, ..Options::default() };
        fit(self.own_points()?, kind, &options, progress).map_err(|e| match e {
            FitError::Cancelled => Missing::Cancelled,
            e => self.lacks(Lack::Fit(e)),
        })
    }

    /// The circle of its points in the plane of the section: of points in space, that of least squares.
    ///
    /// # Errors
    /// Too few points, points that determine none.
    pub fn profile(&self, method: Method, progress: &dyn Progress) -> Result<Fit, Missing> {
        if self.planar {
            return self.refitted(Kind::Circle2, method, progress);
        }
        let shape = self.refitted(Kind::Plane, Method::Gaussian, progress)?.shape;
        let none = || self.lacks(Lack::Plane);
        let (Shape::Plane { point, normal }, Some(first)) = (shape, self.points.first()) else {
            return Err(none());
        };
        let seen = Rigid::into_frame(point, normal, minus(*first, point)).ok_or_else(none)?;
        let flat: Vec<Point> =
            self.points.iter().map(|p| seen.point(*p)).map(|[x, y, _]| [x, y, 0.0]).collect();
        let options = Options { method, ..Options::default() };
        Ok(fit(&flat, Kind::Circle2, &options, progress)?)
    }

    /// The form of its points against an element: value, and where it is reached.
    pub fn form(&self, fit: &Fit) -> Value {
        form(&self.points, fit)
    }

    /// Its element as a datum, if it is made of others.
    ///
    /// # Errors
    /// Why it has none.
    pub fn derived_datum(&self) -> Result<Option<Datum>, Missing> {
        match self.element()? {
            Element::Derived(datum) => Ok(Some(*datum)),
            Element::Point(p) => Ok(Some(Datum::Point(*p))),
            Element::Fit(_) => Ok(None),
        }
    }

    /// The points that a zone must hold. A surface or median line has all of its points, an axis both ends over the extent of the points,
    /// anything round its center.
    ///
    /// # Errors
    /// Why there are none.
    pub fn zoned(&self) -> Result<Vec<Point>, Missing> {
        let element = self.element()?;
        match (self.class, element) {
            (_, Element::Point(p)) => Ok(vec![*p]),
            (Class::Plane | Class::Torus, _) => self.own_points().map(<[Point]>::to_vec),
            (Class::Line, _) if !self.edge => self.own_points().map(<[Point]>::to_vec),
            (Class::Line | Class::Cylinder | Class::Cone, Element::Fit(fit)) => self.ends(&fit.shape),
            (_, Element::Fit(fit)) => match fit.shape {
                Shape::Sphere { center, .. }
                | Shape::Circle { center, .. }
                | Shape::Circle2 { center, .. } => Ok(vec![center]),
                _ => Err(self.lacks(Lack::Center)),
            },
            (_, Element::Derived(_)) => Err(self.lacks(Lack::Extent)),
        }
    }

    /// Both ends of an axis over the extent of the points, with those of the rim.
    fn ends(&self, shape: &Shape) -> Result<Vec<Point>, Missing> {
        let (Some(foot), Some(direction)) = (shape.foot(), shape.direction()) else {
            return Err(self.lacks(Lack::Axis));
        };
        let along = |p: &Point| dot(minus(*p, foot), direction);
        let all = || self.points.iter().chain(&self.rim).map(along);
        let (first, last) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
        Ok([first, last].map(|t| plus(foot, times(t, direction))).to_vec())
    }

    /// The middle of its points on its element.
    ///
    /// # Errors
    /// Why there is none.
    pub fn middle(&self) -> Result<Point, Missing> {
        let zoned = self.zoned()?;
        Ok(mean(&zoned))
    }

    /// Direction of its axis, or its normal.
    ///
    /// # Errors
    /// Why there is none.
    pub fn direction(&self) -> Result<Vector, Missing> {
        let found = match self.element()? {
            Element::Fit(fit) => fit.shape.direction(),
            Element::Derived(Datum::Plane { normal, .. }) => Some(*normal),
            Element::Derived(Datum::Axis { direction, .. }) => Some(*direction),
            _ => None,
        };
        found.ok_or_else(|| self.lacks(Lack::Direction))
    }
}

/// The form of points against the element fitted to them: value, and where it is reached.
pub(super) fn form(points: &[Point], fit: &Fit) -> Value {
    let mut at: Vec<usize> = fit.touching.iter().map(|t| t.point).collect();
    if at.is_empty() {
        at = vec![fit.residuals.max.1, fit.residuals.min.1];
    }
    let witness = at.into_iter().filter_map(|i| points.get(i).copied()).collect();
    Value { value: fit.residuals.form_error, witness, ..Value::default() }
}
