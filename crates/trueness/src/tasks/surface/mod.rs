//! A B-spline surface through scattered points.

mod knots;
mod models;
mod request;

pub use request::{Base, Gap, MAX_CORRECTIONS, NoGap, NoPair, NoWeight, Pair, SurfaceRequest, Weight};

use crate::read::{self, Opened};
use crate::task::{Done, Request, RunFiles, STEPS, Scene, TaskError, Watch};
use trueness_document::Role;
use trueness_document::surface::SurfaceDocument;
use trueness_files::{Holds, Sources};
use trueness_geom::scan::Scan;
use trueness_geom::space::Point;
use trueness_report::views::surface::View;
use trueness_report::{Marks, ViewObject};
use trueness_surface::{
    self as surface, BaseKind, Fairness, Layout, Options, Outline, SurfaceError, SurfaceFit,
};

impl SurfaceRequest {
    fn options(&self, sources: &dyn Sources) -> Result<Options, TaskError> {
        let degree = self.degree.as_ref().map(|d| d.value.0);
        let layout = match (&self.knots, self.tolerance) {
            (Some(path), _) => Layout::Knots(knots::read(sources, path, degree)?),
            (None, Some(t)) => Layout::Tolerance(t),
            (None, None) => self.spans.as_ref().map_or(Layout::Auto, |spans| Layout::Spans(spans.value.0)),
        };
        Ok(Options {
            degree: degree.unwrap_or([3, 3]),
            layout,
            base: self.base.into(),
            fairness: self.fairness.as_ref().map_or(Fairness::Auto, |w| w.value.0),
            corrections: self.corrections.into(),
            robust: self.robust,
            ..Options::default()
        })
    }
}

impl Request for SurfaceRequest {
    type Document = SurfaceDocument;
    const COMMAND: &'static str = "surface";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        self.check()?;
        Ok(RunFiles::of(std::iter::once(&self.points).chain(&self.knots))
            .ending("--step", self.step.as_ref(), &["stp", "step"])
            .ending("--iges", self.iges.as_ref(), &["igs", "iges"])
            .ending("--obj", self.obj.as_ref(), &["obj"]))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<SurfaceDocument>, TaskError> {
        self.check()?;
        let options = self.options(sources)?;
        let Opened { mut record, body, planar, .. } =
            read::open(sources, &self.points, Role::Measured, &self.reading.options())?;
        let shown = self.points.display();
        if planar {
            return Err(TaskError::usage(format!("{shown}: it has two columns; a surface needs x, y and z")));
        }
        let scan = read::scan(&self.points, body, &mut record)?;
        if scan.mesh().is_none() && options.base == BaseKind::Mesh {
            return Err(TaskError::usage(format!(
                "{shown}: --base mesh lays facets flat, and the file has none; give a mesh ({}), or take plane, xy, cylinder or sphere",
                Holds::Mesh.formats()
            )));
        }
        let points = scan.points();
        read::describe(&mut record, points);
        read::hash(sources, &mut record, &self.points)?;
        let stage = watch.stage("fitting", STEPS, None);
        let fit = match &scan {
            Scan::Mesh(mesh) => surface::fit_mesh(mesh, &options, &*stage),
            Scan::Cloud(points) => surface::fit(points, &options, &*stage),
        };
        let fit = fit.map_err(|e| match e {
            SurfaceError::Cancelled(e) => e.into(),
            e @ (SurfaceError::Degree { .. }
            | SurfaceError::Spans { .. }
            | SurfaceError::Tolerance(_)
            | SurfaceError::Fairness(_)) => TaskError::option(e),
            e => TaskError::unanswerable(format!("{shown}: {e}")),
        })?;
        let outline = self.trim.as_ref().map(|gap| fit.outline(gap.value.0, &*stage)).transpose()?;
        if outline.as_ref().is_some_and(|o| o.regions.is_empty()) {
            return Err(TaskError::unanswerable(format!(
                "{shown}: the points have no outline on the base to cut along; leave out --trim"
            )));
        }
        let document =
            trueness_measure::surface::document(&fit, points, &options, outline.as_ref(), vec![record]);
        drop(stage);
        let stage = watch.stage("writing the surface", STEPS, None);
        let outputs = models::write(self, &fit.surface, outline.as_ref(), &*stage)?;
        drop(stage);
        let drawn = || Fitted { fit, outline, points: scan.into_points() };
        let scene = self.view.then(|| Box::new(drawn()) as Box<dyn Scene<SurfaceDocument>>);
        Ok(Done { scene, outputs, ..Done::new(document) })
    }
}

/// The points with their surface.
struct Fitted {
    fit: SurfaceFit,
    outline: Option<Outline>,
    points: Vec<Point>,
}

impl Scene<SurfaceDocument> for Fitted {
    fn draw(
        &self,
        document: &SurfaceDocument,
        page: &mut dyn FnMut(&[ViewObject], &[Marks]) -> Result<(), TaskError>,
    ) -> Result<(), TaskError> {
        let name = &document.inputs[0].path;
        let view = View::new(document, &self.fit, self.outline.as_ref(), name, &self.points);
        page(&view.objects(), &view.marks)
    }
}
