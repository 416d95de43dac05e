//! Planes, cylinders, cones, spheres and tori in a mesh or cloud.

use crate::read::{self, Body, Opened};
use crate::task::{
    Choice, Done, Independence, Output, PointReading, Request, RunFiles, Scene, TaskError, Watch, choices,
    ended,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use trueness_document::Role;
use trueness_document::segment::{PieceKind, SegmentDocument};
use trueness_files::Sources;
use trueness_files::write::{Pieces, Writable, regions};
use trueness_geom::scan::Scan;
use trueness_geom::segment::{self, Options, SegmentError, Segmentation};
use trueness_geom::shape::Kind;
use trueness_measure::file_numbers::LeftOut;
use trueness_measure::noise_or_reason;
use trueness_report::views::segment::{View, color};
use trueness_report::{Marks, ViewObject};

choices! {
    /// An element that can be found.
    pub enum Element {
        Plane = "plane": "",
        Cylinder = "cylinder": "",
        Cone = "cone": "",
        Sphere = "sphere": "",
        Torus = "torus": "",
    }
}

impl From<Element> for Kind {
    fn from(element: Element) -> Kind {
        match element {
            Element::Plane => Kind::Plane,
            Element::Cylinder => Kind::Cylinder,
            Element::Cone => Kind::Cone,
            Element::Sphere => Kind::Sphere,
            Element::Torus => Kind::Torus,
        }
    }
}

/// What a segmentation is asked.
///
/// ```
/// use trueness::task::Request;
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::segment::SegmentRequest};
/// let request = SegmentRequest { input: "../../corpus/shapes/trimesh__angle_block.STL".into(), ..SegmentRequest::default() };
/// let done = request.run(&FileSources, &Silent)?;
/// assert!(done.document.regions.iter().all(|region| region.max <= done.document.tolerance));
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SegmentRequest {
    /// A mesh, or points.
    pub input: PathBuf,
    /// What is looked for.
    pub shapes: Vec<Element>,
    /// Distance up to which a point belongs to an element, mm; without it eight standard deviations of the noise found.
    pub tolerance: Option<f64>,
    /// Angle between neighboring facets, or normals of points, from which on there is an edge between them, degrees.
    pub crease: f64,
    /// Least share of the area, or of the points of a cloud, that a region must have, percent; without it 0.2, of a drawn mesh 0.01.
    pub min_share: Option<f64>,
    /// Fewest measured points of a region.
    pub min_points: usize,
    /// How the input is taken.
    #[serde(flatten)]
    pub reading: PointReading,
    /// How far neighbors share errors.
    #[serde(flatten)]
    pub noise: Independence,
    /// List the facets or points of every region in the document.
    pub members: bool,
    /// Where to write the facets or points with the number of their region.
    pub out: Option<PathBuf>,
    /// Seed of everything random.
    pub seed: u64,
    /// Keep what a report draws.
    pub view: bool,
}

impl Default for SegmentRequest {
    fn default() -> SegmentRequest {
        SegmentRequest {
            input: PathBuf::new(),
            shapes: Element::ALL.iter().map(|(element, ..)| *element).collect(),
            tolerance: None,
            crease: 32.0,
            min_share: None,
            min_points: 0,
            reading: PointReading::default(),
            noise: Independence::default(),
            members: false,
            out: None,
            seed: 0,
            view: false,
        }
    }
}

impl SegmentRequest {
    fn options(&self) -> Options {
        Options {
            kinds: self.shapes.iter().copied().map(Kind::from).collect(),
            tolerance: self.tolerance,
            crease: self.crease.to_radians(),
            min_share: self.min_share.map(|percent| percent / 100.0),
            min_points: self.min_points,
            seed: self.seed,
        }
    }
}

impl Request for SegmentRequest {
    type Document = SegmentDocument;
    const COMMAND: &'static str = "segment";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        Ok(RunFiles::of([&self.input]).out(self.out.as_ref(), Writable::Regions))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<SegmentDocument>, TaskError> {
        let options = self.options();
        let Opened { mut record, body, .. } =
            read::open(sources, &self.input, Role::Measured, &self.reading.options())?;
        let (scan, left_out) = match body {
            Body::Mesh(source) => (Scan::Mesh(source.mesh), source.nonfinite_facets),
            Body::Points(source) => {
                (Scan::Cloud(read::all_points(&self.input, source, &mut record)?), vec![])
            }
        };
        read::describe(&mut record, scan.points());
        let (kind, word, total) = match &scan {
            Scan::Mesh(mesh) => (PieceKind::Facets, "facets", mesh.faces.len()),
            Scan::Cloud(points) => (PieceKind::Points, "points", points.len()),
        };
        let stage = watch.stage("segmenting", word, Some(total as u64));
        let (hash, found) = rayon::join(
            || read::hash(sources, &mut record, &self.input),
            || match &scan {
                Scan::Mesh(mesh) => segment::mesh(mesh, &options, &*stage),
                Scan::Cloud(points) => segment::cloud(points, &options, &*stage),
            },
        );
        let found = ended(stage, found);
        hash?;
        let found = found.map_err(|e| match e {
            SegmentError::Cancelled(e) => e.into(),
            e @ SegmentError::WrongOption { .. } => TaskError::option(e),
            e @ SegmentError::NoKind => TaskError::usage(e.to_string()),
            e => TaskError::unanswerable(format!("{}: {e}", self.input.display())),
        })?;
        let output = self.out.as_ref().map(|path| write(path, &scan, &found)).transpose()?;
        let members = self.members.then_some(LeftOut(&left_out));
        let noise = self
            .noise
            .shared_noise(watch, |stage| noise_or_reason(found.shared_noise(&scan, self.seed, stage)))?;
        let document =
            trueness_measure::segment::document(&found, &noise, kind, vec![record], &options, members);
        let drawn = || Segmented { scan, labels: found.labels };
        let scene = self.view.then(|| Box::new(drawn()) as Box<dyn Scene<SegmentDocument>>);
        Ok(Done { scene, outputs: output.into_iter().collect(), ..Done::new(document) })
    }
}

/// Writes the pieces with the numbers of their regions.
fn write(path: &Path, scan: &Scan, found: &Segmentation) -> Result<Output, TaskError> {
    let pieces = match scan {
        Scan::Mesh(mesh) => Pieces::Facets(&mesh.faces),
        Scan::Cloud(_) => Pieces::Points,
    };
    let labels: Vec<i32> = found.labels.iter().map(|&label| label as i32).collect();
    let color = |label: i32| color(usize::try_from(label).ok());
    Ok(Output::file(path, regions(path, scan.points(), pieces, &labels, color)?))
}

/// The pieces with their regions.
struct Segmented {
    scan: Scan,
    labels: Vec<u32>,
}

impl Scene<SegmentDocument> for Segmented {
    fn draw(
        &self,
        document: &SegmentDocument,
        page: &mut dyn FnMut(&[ViewObject], &[Marks]) -> Result<(), TaskError>,
    ) -> Result<(), TaskError> {
        let view = View::new(document, &self.scan, &self.labels);
        page(&view.objects(), &view.marks)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::segment::KINDS;

    #[test]
    fn every_shape_that_is_found_has_its_word() {
        let words: Vec<&str> = Element::ALL.iter().map(|(_, word, _)| *word).collect();
        assert_eq!(words, KINDS.map(Kind::name));
        assert_eq!(SegmentRequest::default().options().kinds, KINDS);
    }
}
