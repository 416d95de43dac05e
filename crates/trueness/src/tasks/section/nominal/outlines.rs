//! The file of a nominal, and its outlines in the planes of a section.

use super::super::faced::faced;
use super::super::found::Found;
use super::super::planes::Cut;
use super::faces::Faces;
use super::layers::Layers;
use crate::read::{self, Body, NominalBody, Opened};
use crate::task::TaskError;
use std::path::Path;
use trueness_document::InputRecord;
use trueness_document::section::NominalWarning;
use trueness_files::drawing::{Drawing, Drawn};
use trueness_files::{ReadOptions, Sources};
use trueness_geom::mesh::Mesh;
use trueness_geom::plane::{Plane, PlaneFrame};
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, dot};
use trueness_measure::section::Section;
use trueness_section::{self as section, Options, Outline, SectionError, Segment};

/// A nominal as it stands in its file.
pub struct Nominal {
    /// What the document says of the file.
    pub record: InputRecord,
    /// Its name as messages have it.
    shown: String,
    body: Held,
}

/// What the file of a nominal held.
enum Held {
    Mesh(Mesh),
    Faces(Box<Faces>),
    /// Points in order, and whether they have two coordinates.
    Row(Vec<Point>, bool),
    Drawing(Drawing, Layers),
}

/// Ends of drawn entities that are this share of the drawing apart are one; rational curves are followed within this share of their own size.
const MAX_JOINED_ENDS_SHARE: f64 = 1e-6;

impl Nominal {
    /// Opens the nominal of so many planes.
    pub fn open(
        sources: &dyn Sources,
        path: &Path,
        reading: &ReadOptions,
        planes: usize,
        progress: &dyn Progress,
    ) -> Result<Nominal, TaskError> {
        let shown = path.display().to_string();
        let (body, mut record) = match read::nominal(sources, path, reading)? {
            NominalBody::Drawing(drawing, record) => (Held::Drawing(drawing, Layers::default()), record),
            NominalBody::Whole(opened) => whole(path, opened, progress)?,
            NominalBody::Cad(file, mut record) => {
                let faces = Faces::open(path, &file, &mut record, progress)?;
                (Held::Faces(Box::new(faces)), record)
            }
        };
        read::hash(sources, &mut record, path)?;
        let body = match body {
            Held::Drawing(drawing, _) => {
                let layers = Layers::of(&drawing, planes, &shown)?;
                Held::Drawing(drawing, layers)
            }
            body => body,
        };
        Ok(Nominal { record, shown, body })
    }

    /// What its outlines are taken from.
    pub fn kind(&self) -> &'static str {
        match self.body {
            Held::Mesh(_) => "facets",
            Held::Faces(_) => "faces",
            Held::Row(..) => "contour",
            Held::Drawing(..) => "drawing",
        }
    }

    /// What of a drawing lies on layers of no plane.
    pub fn passed_over(&self) -> Option<NominalWarning> {
        match &self.body {
            Held::Drawing(_, layers) => layers.passed_over.clone(),
            _ => None,
        }
    }

    /// Its outlines in the plane of a section, the one of this number, and what makes them doubtful.
    pub fn outlines(
        &self,
        (found, number): (&Found, usize),
        section: &Section,
        own: Option<&Cut>,
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<(Vec<Outline>, Option<NominalWarning>), TaskError> {
        let outlines = match &self.body {
            Held::Mesh(mesh) => return Ok((cut(mesh, section, own, progress)?, None)),
            Held::Faces(faces) => return Ok(faces.outlines(&plane_of(section, own), &frame(section))),
            Held::Drawing(drawing, layers) => self.drawn(drawing, layers.own(number).as_deref())?,
            Held::Row(..) if found.sections.len() > 1 => {
                return Err(TaskError::usage(format!(
                    "--nominal {}: it holds points in order, which are of one plane; give one --plane, or a mesh",
                    self.shown
                )));
            }
            Held::Row(points, planar) => {
                contour(points, *planar, section, options, progress).map_err(|e| match e {
                    SectionError::Cancelled(e) => e.into(),
                    e => self.because(e),
                })?
            }
        };
        self.refuse_crossings(&outlines, progress)?;
        Ok((outlines, None))
    }

    /// Why this nominal cannot be used.
    pub fn because(&self, reason: impl std::fmt::Display) -> TaskError {
        TaskError::unanswerable(format!("{}: {reason}", self.shown))
    }

    /// The outlines of a drawing, of all of it or of the plane's own layer.
    fn drawn(&self, drawing: &Drawing, own: Option<&str>) -> Result<Vec<Outline>, TaskError> {
        let kept = drawing.entities.iter().filter(|e| own.is_none_or(|own| *own == e.layer));
        let mut segments = vec![];
        for entity in kept {
            segments.push(match &entity.drawn {
                Drawn::Line { start, end } => Segment::straight(*start, *end),
                Drawn::Arc { center, radius, start, sweep } => Segment::arc(*center, *radius, *start, *sweep),
                Drawn::Spline(curve) => Segment::curve(curve, MAX_JOINED_ENDS_SHARE * entity.drawn.size())
                    .ok_or_else(|| {
                        self.undrawn("a rational spline of it has no finite place; draw it anew")
                    })?,
            });
        }
        if segments.is_empty() && own.is_none() {
            return Err(self
                .undrawn("it holds neither lines nor arcs nor splines that are read: there is no nominal"));
        }
        Ok(section::with_material_inside(section::joined(segments, MAX_JOINED_ENDS_SHARE * drawing.size())))
    }

    /// Why the drawing has no outlines, with what of it was passed over.
    fn undrawn(&self, reason: &str) -> TaskError {
        let Some(told) = self.record.warnings.iter().find(|w| w.contains("passed over")) else {
            return self.because(reason);
        };
        let explode = if told.contains(" INSERT") { "; explode its blocks (INSERT)" } else { "" };
        self.because(format!("{reason}; {told}{explode}"))
    }

    /// Refuses closed outlines that cross themselves: no side of them is outside.
    fn refuse_crossings(&self, outlines: &[Outline], progress: &dyn Progress) -> Result<(), TaskError> {
        for outline in outlines.iter().filter(|o| o.closed) {
            if let [[x, y], ..] = section::crossings(&outline.segments, true, progress)?[..] {
                return Err(self.because(format!(
                    "its outline crosses itself at ({x:.4}, {y:.4}): no side of it is outside of the material; mend it"
                )));
            }
        }
        Ok(())
    }
}

/// A mesh that looks outwards, or points.
fn whole(path: &Path, opened: Opened, progress: &dyn Progress) -> Result<(Held, InputRecord), TaskError> {
    let Opened { mut record, body, planar, .. } = opened;
    let held = match body {
        Body::Mesh(source) => Held::Mesh(faced(&source.mesh, &mut record, progress)?),
        Body::Points(source) => {
            let points = read::all_points(path, source, &mut record)?;
            read::describe(&mut record, &points);
            Held::Row(points, planar)
        }
    };
    Ok((held, record))
}

/// Where the plane of a section cuts a mesh.
fn cut(
    mesh: &Mesh,
    section: &Section,
    own: Option<&Cut>,
    progress: &dyn Progress,
) -> Result<Vec<Outline>, TaskError> {
    let frame = frame(section);
    let chains = section::cut(mesh, &plane_of(section, own), progress)?;
    let flat = |chain: &section::Chain| chain.points.iter().map(|p| frame.flat(*p)).collect::<Vec<_>>();
    Ok(chains.iter().map(|chain| Outline::polyline(&flat(chain), chain.closed)).collect())
}

/// The contour of a row of points, which is the outer one if it is closed.
fn contour(
    points: &[Point],
    planar: bool,
    section: &Section,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Vec<Outline>, SectionError> {
    // Two columns are coordinates in the plane already.
    let frame = if planar { PlaneFrame::default() } else { frame(section) };
    let flat: Vec<[f64; 2]> = points.iter().map(|p| frame.flat(*p)).collect();
    let own = Options { level: options.level, ..Options::default() };
    let found = section::contour(&flat, &own, progress)?;
    Ok(section::with_material_inside(vec![Outline::of(&found)]))
}

/// The plane of a section: the one that it was cut by, or that of points in order.
pub fn plane_of(section: &Section, own: Option<&Cut>) -> Plane {
    let frame = frame(section);
    let normal = frame.normal();
    own.map_or(Plane { normal, offset: dot(normal, frame.origin) }, |cut| cut.plane())
}

fn frame(section: &Section) -> PlaneFrame {
    PlaneFrame { origin: section.frame.origin, x: section.frame.x, y: section.frame.y }
}
