//! A file in another format.

use crate::read::cad::Chord;
use crate::read::{self, Any, Body, Opened};
use crate::task::{
    Done, Output, PointReading, Request, Rounding, RunFiles, STEPS, TaskError, Watch, above_zero, ended,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use trueness_document::convert::{ConvertDocument, Written};
use trueness_document::{InputRecord, Role};
use trueness_files::cad::CadFile;
use trueness_files::write::{self, Block, Layout, MeshFile, Writable};
use trueness_files::{PointSource, SourceMesh, Sources};
use trueness_geom::progress::Cancelled;

/// What a conversion is asked.
///
/// ```
/// use trueness::task::Request;
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::convert::ConvertRequest};
/// let out = std::env::temp_dir().join("cube of a conversion.ply");
/// let request = ConvertRequest { input: "../../corpus/shapes/mayo__258_cube.off".into(), out: out.clone(), ..ConvertRequest::default() };
/// let mut done = request.run(&FileSources, &Silent)?;
/// assert_eq!((done.document.points, done.document.facets), (8, Some(12)));
/// done.commit()?;
/// assert!(out.exists());
/// # std::fs::remove_file(out).unwrap();
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ConvertRequest {
    /// A file of any format that is read as a mesh or points.
    pub input: PathBuf,
    /// Where to write it, in the format of its ending, mm.
    pub out: PathBuf,
    /// How the input is taken.
    #[serde(flatten)]
    pub reading: PointReading,
    /// How far facets of a CAD model may lie from its faces, mm; without it a twenty-thousandth of its diagonal.
    pub chord: Option<f64>,
}

impl Request for ConvertRequest {
    type Document = ConvertDocument;
    const COMMAND: &'static str = "convert";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        Ok(RunFiles::of([&self.input]).also("OUT", Some(&self.out)))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<ConvertDocument>, TaskError> {
        self.chord.map(|chord| above_zero("chord", chord)).transpose()?;
        let reading = self.reading.options();
        let found = match read::any(sources, &self.input, Role::Mesh, &reading)? {
            Any::Cad(file, record) => Found::Mesh(self.facets(&file, record, watch)?),
            Any::Whole(Opened { record, body: Body::Mesh(mesh), .. }) => Found::Mesh((mesh, record)),
            Any::Whole(Opened { record, body: Body::Points(points), .. }) => Found::Points(points, record),
            Any::Splines(..) | Any::Drawing(..) => {
                let opened = read::open(sources, &self.input, Role::Mesh, &reading);
                return Err(opened.err().unwrap_or_else(|| TaskError::unanswerable("it holds no mesh")));
            }
        };
        if let (Some(_), true) = (self.chord, !matches!(&found, Found::Mesh((_, r)) if r.cad.is_some())) {
            return Err(TaskError::usage("--chord is for CAD models; leave it out"));
        }
        let mut done = match found {
            Found::Mesh((source, record)) => self.mesh(source, record)?,
            Found::Points(source, record) => self.points(source, record, watch)?,
        };
        read::hash(sources, &mut done.document.inputs[0], &self.input)?;
        Ok(done)
    }
}

/// What is written.
enum Found {
    Mesh((SourceMesh, InputRecord)),
    Points(PointSource, InputRecord),
}

impl ConvertRequest {
    /// The facets of a model.
    fn facets(
        &self,
        file: &CadFile,
        mut record: InputRecord,
        watch: &dyn Watch,
    ) -> Result<(SourceMesh, InputRecord), TaskError> {
        let stage = watch.stage("dividing faces", STEPS, None);
        let chord = self.chord.map_or(Chord::MEASURED, Chord::Within);
        let found = read::cad::tessellated(&self.input, file, chord, &mut record, &*stage);
        let (_, mesh) = ended(stage, found)?;
        Ok((mesh, record))
    }

    fn document(&self, record: InputRecord, written: Written) -> ConvertDocument {
        ConvertDocument::new(record, self.out.display().to_string(), written)
    }

    fn mesh(&self, source: SourceMesh, record: InputRecord) -> Result<Done<ConvertDocument>, TaskError> {
        let mut document = self.document(record, Written::Mesh);
        // A format of points alone takes the vertices.
        if Writable::Mesh.check(&self.out).is_err() && Writable::Points.check(&self.out).is_ok() {
            document.written.0 = Written::Points;
            document.points = source.mesh.positions.len() as u64;
            document.lost.push(format!("{} facets: the format holds points alone", source.mesh.faces.len()));
            let mut file = write::points(&self.out, Layout::default())?;
            file.write(&Block { points: &source.mesh.positions, ..Block::default() })?;
            return Ok(finished(document, Output::later(move || file.finish().map(drop))));
        }
        Writable::Mesh.check(&self.out)?;
        let file = MeshFile::write(&self.out, &source.mesh)?;
        let loss = file.loss;
        document.points = source.mesh.positions.len() as u64;
        document.facets = Some(source.mesh.faces.len() as u64);
        document.farthest_moved = Some(loss.farthest);
        document.lost = lost(&source);
        let mut done = finished(document, Output::later(move || file.finish()));
        done.losses
            .extend((loss.moved > 0).then(|| Rounding { path: self.out.clone(), farthest: loss.farthest }));
        Ok(done)
    }

    /// Points go from file to file in blocks: memory does not grow with their number.
    fn points(
        &self,
        mut source: PointSource,
        record: InputRecord,
        watch: &dyn Watch,
    ) -> Result<Done<ConvertDocument>, TaskError> {
        Writable::Points.check(&self.out)?;
        let mut document = self.document(record, Written::Points);
        let mut file = write::points(&self.out, Layout::default())?;
        let stage = watch.stage("converting", "points", source.expected());
        let mut block = vec![];
        loop {
            source.next_block(&mut block)?;
            if block.is_empty() {
                break;
            }
            file.write(&Block { points: &block, ..Block::default() })?;
            document.points += block.len() as u64;
            stage.advance(block.len() as u64);
            if stage.cancelled() {
                return Err(Cancelled.into());
            }
        }
        stage.finish();
        document.inputs[0].warnings.extend(source.remarks());
        document.inputs[0].points = document.points;
        Ok(finished(document, Output::later(move || file.finish().map(drop))))
    }
}

fn finished(document: ConvertDocument, output: Output) -> Done<ConvertDocument> {
    Done { outputs: vec![output], ..Done::new(document) }
}

/// What no format that is written holds.
fn lost(source: &SourceMesh) -> Vec<String> {
    let mut lost = vec![];
    if source.stored_normals.is_some() {
        lost.push("the normals stored with the facets: those written follow from the corners".into());
    }
    if let Some(regions) = &source.regions {
        lost.push(format!("the names of {} parts of the mesh", regions.names.len()));
    }
    if !source.unread.is_empty() {
        lost.push(format!("what the file tells beside places and corners: {}", source.unread.join(", ")));
    }
    if !source.nonfinite_facets.is_empty() {
        lost.push(format!("{} facets with coordinates that are not finite", source.nonfinite_facets.len()));
    }
    lost
}
