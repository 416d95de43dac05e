//! The best line, plane, circle, … through points.

use crate::read::{self, Opened};
use crate::task::{
    Choice, Done, Independence, PointReading, Request, RunFiles, Scene, TaskError, Watch, choices, ended,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use trueness_document::Role;
use trueness_document::fit::FitDocument;
use trueness_files::Sources;
use trueness_geom::fit::{self, FitError, Options};
use trueness_geom::progress::Cancelled;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::Point;
use trueness_report::views::fit::View;
use trueness_report::{Marks, ViewObject};

choices! {
    /// What is fitted.
    pub enum Element {
        Line = "line": "",
        Plane = "plane": "",
        Circle = "circle": "",
        Ellipse = "ellipse": "In the plane: of points of two columns, or of x and y",
        Sphere = "sphere": "",
        Cylinder = "cylinder": "",
        Cone = "cone": "",
        Torus = "torus": "",
    }
}

impl Element {
    /// The kind of shape: in the plane where the points are and there is such, else as there is one.
    fn kind(self, planar: bool) -> Kind {
        match (self, planar) {
            (Element::Line, true) => Kind::Line2,
            (Element::Line, false) => Kind::Line,
            (Element::Plane, _) => Kind::Plane,
            (Element::Circle, true) => Kind::Circle2,
            (Element::Circle, false) => Kind::Circle,
            (Element::Ellipse, _) => Kind::Ellipse2,
            (Element::Sphere, _) => Kind::Sphere,
            (Element::Cylinder, _) => Kind::Cylinder,
            (Element::Cone, _) => Kind::Cone,
            (Element::Torus, _) => Kind::Torus,
        }
    }
}

choices! {
    /// What makes an element the best.
    pub enum Method {
        Gaussian = "gaussian": "Least squares",
        MinimumZone = "minimum-zone": "The narrowest zone that holds all points",
        MinimumCircumscribed = "minimum-circumscribed": "The smallest circle, sphere or cylinder around all points",
        MaximumInscribed = "maximum-inscribed": "The largest circle, sphere or cylinder within the points",
        Robust = "robust": "Outliers do not count",
    }
}

impl From<Method> for fit::Method {
    fn from(method: Method) -> fit::Method {
        match method {
            Method::Gaussian => fit::Method::Gaussian,
            Method::MinimumZone => fit::Method::MinimumZone,
            Method::MinimumCircumscribed => fit::Method::MinimumCircumscribed,
            Method::MaximumInscribed => fit::Method::MaximumInscribed,
            Method::Robust => fit::Method::Robust,
        }
    }
}

/// What a fit is asked.
///
/// ```
/// use trueness::task::Request;
/// use trueness::{files::MemorySources, geom::progress::Silent, tasks::fit::{Element, FitRequest}};
/// let corners = "10 2 0\n5 7 0\n0 2 0\n5 -3 0\n";
/// let sources: MemorySources = [("corners.xyz", corners)].into_iter().collect();
/// let request =
///     FitRequest { points: "corners.xyz".into(), shape: Some(Element::Circle), ..FitRequest::default() };
/// let done = request.run(&sources, &Silent)?;
/// assert!(done.document.form_error < 1e-9);
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FitRequest {
    /// The points, or a mesh, whose vertices are taken.
    pub points: PathBuf,
    /// What is fitted; it has to be given.
    pub shape: Option<Element>,
    /// What makes an element the best.
    pub method: Method,
    /// How the points are taken.
    #[serde(flatten)]
    pub reading: PointReading,
    /// How far neighbors share errors.
    #[serde(flatten)]
    pub noise: Independence,
    /// Seed of everything random.
    pub seed: u64,
    /// Keep what a report draws.
    pub view: bool,
}

impl Request for FitRequest {
    type Document = FitDocument;
    const COMMAND: &'static str = "fit";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        Ok(RunFiles::of([&self.points]))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<FitDocument>, TaskError> {
        let element = self.shape.ok_or_else(|| {
            let known: Vec<&str> = Element::ALL.iter().map(|(_, word, _)| *word).collect();
            TaskError::usage(format!("--shape is missing: give {}", known.join(", ")))
        })?;
        let Opened { mut record, body, planar, .. } =
            read::open(sources, &self.points, Role::Measured, &self.reading.options())?;
        let scan = read::scan(&self.points, body, &mut record)?;
        let points = scan.points();
        read::describe(&mut record, points);
        read::hash(sources, &mut record, &self.points)?;
        let options = Options { method: self.method.into(), start: None, seed: self.seed };
        let stage = watch.stage("fitting", "points", Some(points.len() as u64));
        let fit = fit::fit(points, element.kind(planar), &options, &*stage);
        let fit = ended(stage, fit).map_err(|e| match e {
            FitError::Cancelled => Cancelled.into(),
            e @ FitError::NoSuchMethod { .. } => TaskError::usage(e.to_string()),
            e => TaskError::unanswerable(format!("{}: {e}", self.points.display())),
        })?;
        let noise = self
            .noise
            .shared_noise(watch, |stage| trueness_measure::fit::noise(&fit, &scan, self.seed, stage))?;
        let document = trueness_measure::fit::document(&fit, &noise, points, vec![record], self.seed);
        let drawn = || Fitted { shape: fit.shape, points: scan.into_points() };
        let scene = self.view.then(|| Box::new(drawn()) as Box<dyn Scene<FitDocument>>);
        Ok(Done { scene, ..Done::new(document) })
    }
}

/// The points with their element.
struct Fitted {
    shape: Shape,
    points: Vec<Point>,
}

impl Scene<FitDocument> for Fitted {
    fn draw(
        &self,
        document: &FitDocument,
        page: &mut dyn FnMut(&[ViewObject], &[Marks]) -> Result<(), TaskError>,
    ) -> Result<(), TaskError> {
        let view = View::new(document, &document.inputs[0].path, &self.shape, &self.points);
        page(&view.objects(), &view.marks)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A shape that is fitted has its word here.
    #[test]
    fn every_shape_has_its_word() {
        let mut names: Vec<&str> = Kind::ALL.iter().map(|kind| kind.name()).collect();
        names.dedup();
        let words: Vec<&str> = Element::ALL.iter().map(|(_, word, _)| *word).collect();
        assert_eq!(words, names);
        for (element, word, about) in Element::ALL {
            for planar in [false, true] {
                let kind = element.kind(planar);
                assert_eq!(kind.name(), *word);
                assert_eq!(Some(kind), Kind::named(word, planar).or(Kind::named(word, !planar)));
            }
            assert_eq!(about.is_empty(), Kind::named(word, false).is_some(), "{word}");
        }
    }

    #[test]
    fn methods_are_called_alike() {
        for (method, word, _) in Method::ALL {
            assert_eq!(fit::Method::from(*method).name(), *word);
        }
        assert_eq!(Method::ALL.len(), fit::Method::ALL.len());
    }
}
