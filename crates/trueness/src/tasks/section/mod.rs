//! The lines, arcs and curves of sections, and where they join.

mod faced;
mod found;
mod nominal;
mod planes;
mod request;
mod row;
mod write;

pub use request::{Continuity, Fit, Interval, NoLevel, Search, SectionRequest, level};

use crate::read::{self, Body, Opened};
use crate::task::{Done, Page, Request, RunFiles, STEPS, Scene, TaskError, Watch};
use found::{Found, Methods};
use planes::Cut;
use trueness_document::section::SectionDocument;
use trueness_document::{InputRecord, Role};
use trueness_files::Sources;
use trueness_geom::noise::{self, Noise};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::{Point, minus, norm};
use trueness_measure::{NoiseOrReason, noise_or_reason};
use trueness_report::{ViewObject, flat};
use trueness_section::{Options, SectionError};

impl Request for SectionRequest {
    type Document = SectionDocument;
    const COMMAND: &'static str = "section";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        Ok(RunFiles::of(std::iter::once(&self.input).chain(&self.nominal))
            .ending("--dxf", self.dxf.as_ref(), &["dxf"])
            .ending("--svg", self.svg.as_ref(), &["svg"])
            .ending("--step", self.step.as_ref(), &["stp", "step"])
            .ending("--iges", self.iges.as_ref(), &["igs", "iges"])
            .ending("--out", self.out.as_ref(), &["csv"]))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<SectionDocument>, TaskError> {
        self.check()?;
        let (options, rule) = (self.options(), self.rule()?);
        let mut part = read::open(sources, &self.input, Role::Measured, &self.reading.options())?;
        let planes = self.planes()?;
        let noise = self.noise_of(&mut part, watch)?;
        let stage = watch.stage("finding segments", STEPS, None);
        let (found, mut record) = self.find(part, noise.own, &planes, &options, &*stage)?;
        read::hash(sources, &mut record, &self.input)?;
        let shown = self.input.display();
        let found = found.map_err(|e| match e {
            SectionError::Cancelled(e) => e.into(),
            e @ SectionError::WrongOption { .. } => TaskError::option(e),
            e => TaskError::unanswerable(format!("{shown}: {e}")),
        })?;
        if !planes.is_empty() && found.rows.is_empty() {
            let why = planes::nothing_met(&planes, &found.sections, &record);
            return Err(TaskError::unanswerable(format!("{shown}: {why}")));
        }
        let compared = nominal::compare(self, sources, (&found, &planes), (&rule, &options), &*stage)?;
        let (nominal, file) = compared.unzip();
        let inputs = std::iter::once(record).chain(file).collect();
        let mut document = trueness_measure::section::document(&found.sections, inputs, &options);
        trueness_measure::section::tell_noise(&mut document, noise.told.as_ref());
        document.nominal = nominal;
        let document = self.complete(document, &found, &*stage)?;
        drop(stage);
        let outputs = write::outputs(self, &found.sections, &found.rows, document.nominal.as_ref())?;
        let scene = self.view.then(|| Box::new(Contours(found.rows)) as Box<dyn Scene<SectionDocument>>);
        Ok(Done { scene, outputs, ..Done::new(document) })
    }
}

/// The noise of a mesh's vertices.
#[derive(Default)]
struct MeshNoise {
    /// As it is.
    own: Option<Noise>,
    /// As it is told, or why it is not; of points nothing.
    told: Option<NoiseOrReason>,
}

impl SectionRequest {
    /// Lets the facets of a mesh look outwards, and finds its noise.
    fn noise_of(&self, part: &mut Opened, watch: &dyn Watch) -> Result<MeshNoise, TaskError> {
        let shown = self.input.display().to_string();
        let Body::Mesh(source) = &mut part.body else {
            self.independence.only_for_meshes(&shown)?;
            return Ok(MeshNoise::default());
        };
        self.fit_a_mesh(&shown)?;
        row::no_method(self)?;
        let stage = watch.stage("orienting the facets", STEPS, None);
        source.mesh = faced::faced(&source.mesh, &mut part.record, &*stage)?;
        drop(stage);
        let mut own = None;
        let find = |progress: &dyn Progress| {
            let found = noise::mesh(&source.mesh, self.seed, progress);
            own = found.as_ref().ok().copied();
            noise_or_reason(found.and_then(Noise::even))
        };
        let told = self.independence.shared_noise(watch, find)?;
        Ok(MeshNoise { own: own.or(told.as_ref().ok().copied()), told: Some(told) })
    }

    /// What is found in the file, and what there is to say of it.
    fn find(
        &self,
        part: Opened,
        noise: Option<Noise>,
        planes: &[Cut],
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<(Result<Found, SectionError>, InputRecord), TaskError> {
        let Opened { mut record, body, planar, .. } = part;
        let source = match body {
            Body::Mesh(source) => {
                self.check_noise(&record)?;
                return Ok((planes::mesh(&source.mesh, noise, planes, options, progress), record));
            }
            Body::Points(source) => source,
        };
        let points = read::all_points(&self.input, source, &mut record)?;
        read::describe(&mut record, &points);
        self.check_noise(&record)?;
        if planes.is_empty() {
            self.fit_a_row()?;
            return Ok((row::row(self, (&points, planar), options, progress), record));
        }
        row::no_method(self)?;
        let slab = self.slab(&self.input.display().to_string(), planar)?;
        Ok((planes::cloud(&points, planes, &slab, options, progress), record))
    }

    /// Refuses a noise that no points of this file can have.
    fn check_noise(&self, record: &InputRecord) -> Result<(), TaskError> {
        let size = record.bounds.as_ref().map(|b| norm(minus(b.max, b.min)));
        match self.noise.zip(size) {
            Some((noise, size)) if noise > size => Err(TaskError::usage(format!(
                "--noise {noise:?}: all of {} lies within {size:.4} mm; give the standard deviation of its points, mm",
                record.path
            ))),
            _ => Ok(()),
        }
    }

    /// The document with what was asked for beside contours and nominal.
    fn complete(
        &self,
        mut document: SectionDocument,
        found: &Found,
        progress: &dyn Progress,
    ) -> Result<SectionDocument, Cancelled> {
        let (sections, rows) = (&found.sections, &found.rows);
        document.airfoils = self
            .airfoil
            .then(|| trueness_measure::section::airfoils(sections, rows, progress))
            .transpose()?;
        for found in document.airfoils.iter().flatten() {
            if let Some(contour) = document.contours.get_mut(found.contour as usize) {
                contour.doubts.extend(found.doubt());
            }
        }
        document = trueness_measure::section::with_blades(document, self.stacking, progress)?;
        if self.tidy {
            document = trueness_measure::section::with_offers(document, sections, rows);
        }
        self.tell_raised_gap(&mut document.planes);
        if let Some(Methods { chosen, interval, table }) = &found.methods {
            document = trueness_measure::section::with_methods(document, *chosen, interval, table);
        }
        Ok(document)
    }
}

/// The points of each contour.
struct Contours(Vec<Vec<[f64; 2]>>);

impl Scene<SectionDocument> for Contours {
    fn draw<'a>(&self, _: &SectionDocument, page: &'a mut Page<'a>) -> Result<(), TaskError> {
        let places: Vec<Vec<Point>> = self.0.iter().map(|row| flat(row)).collect();
        let objects: Vec<ViewObject> = places.iter().map(|p| ViewObject::measured(p)).collect();
        page(&objects, &[])
    }
}
