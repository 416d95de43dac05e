//! What is in a file?

use crate::read::{self, Any, Body};
use crate::task::{Done, PointReading, Request, RunFiles, TaskError, Watch};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use trueness_cad::trimmed::Trimmed;
use trueness_document::info::{Content, InfoDocument};
use trueness_document::{InputRecord, Role};
use trueness_files::cad::CadFile;
use trueness_files::{PointSource, Sources};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::sum::Sum;
use trueness_geom::space::{Aabb, cross, minus, norm};

/// What is asked about a file.
///
/// ```
/// use trueness::task::Request;
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::info::InfoRequest};
/// let request = InfoRequest { file: "../../corpus/shapes/mayo__258_cube.off".into(), ..InfoRequest::default() };
/// let document = request.run(&FileSources, &Silent)?.document;
/// assert_eq!(document.facets, Some(12));
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct InfoRequest {
    /// A file of any format that is read.
    pub file: PathBuf,
    /// How it is taken.
    #[serde(flatten)]
    pub reading: PointReading,
}

impl Request for InfoRequest {
    type Document = InfoDocument;
    const COMMAND: &'static str = "info";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        Ok(RunFiles::of([&self.file]))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<InfoDocument>, TaskError> {
        let found = read::any(sources, &self.file, Role::Mesh, &self.reading.options())?;
        let mut document = match found {
            Any::Whole(opened) => match opened.body {
                Body::Mesh(source) => mesh(&source.mesh, InfoDocument::new(opened.record, Content::Mesh)),
                Body::Points(source) => {
                    let document = InfoDocument::new(opened.record, Content::Points);
                    points(source, document, watch)?
                }
            },
            Any::Cad(file, record) => cad(&file, record, watch)?,
            Any::Splines(_, record) => InfoDocument::new(record, Content::Splines),
            Any::Drawing(_, record) => InfoDocument::new(record, Content::Drawing),
        };
        read::hash(sources, &mut document.inputs[0], &self.file)?;
        Ok(Done::new(document))
    }
}

fn mesh(mesh: &Mesh, document: InfoDocument) -> InfoDocument {
    let area = |f: &[u32; 3]| {
        let [a, b, c] = mesh.places(f);
        0.5 * norm(cross(minus(b, a), minus(c, a)))
    };
    InfoDocument {
        points: Some(mesh.positions.len() as u64),
        facets: Some(mesh.faces.len() as u64),
        area: Some(mesh.faces.iter().map(area).sum::<Sum>().value()),
        bounds: sides(mesh.finite_bounds()),
        ..document
    }
}

/// All points are read: a file need not say how many it holds.
fn points(
    mut source: PointSource,
    mut document: InfoDocument,
    watch: &dyn Watch,
) -> Result<InfoDocument, TaskError> {
    let stage = watch.stage("reading", "points", source.expected());
    let (mut count, mut bounds, mut block) = (0, Aabb::EMPTY, vec![]);
    loop {
        source.next_block(&mut block)?;
        if block.is_empty() {
            break;
        }
        count += block.len() as u64;
        bounds = bounds.union(&Aabb::of(&block));
        stage.advance(block.len() as u64);
        if stage.cancelled() {
            return Err(trueness_geom::progress::Cancelled.into());
        }
    }
    document.inputs[0].warnings.extend(source.remarks());
    document.inputs[0].points = count;
    document.inputs[0].bounds = trueness_measure::bounds(&bounds);
    Ok(InfoDocument { points: Some(count), bounds: sides(bounds), ..document })
}

/// Areas and volumes are exact integrals over the faces.
fn cad(file: &CadFile, mut record: InputRecord, watch: &dyn Watch) -> Result<InfoDocument, TaskError> {
    let model = &file.model;
    let faces = model.instances.iter().filter_map(|i| model.parts.get(i.part as usize));
    let faces = faces.map(|part| part.brep.faces.len() as u64).sum();
    let stage = watch.stage("following borders", "faces", Some(faces));
    let (shape, turned) = Trimmed::of(model, &*stage)?.agreed();
    stage.finish();
    let stage = watch.stage("integrating", "faces", Some(faces));
    let integrals = shape.integrals(&*stage)?;
    stage.finish();
    read::cad::tell_turned(&mut record, &turned);
    read::cad::tell_missing(file, &shape, integrals.iter().flatten().count() as u64, &mut record);
    Ok(InfoDocument {
        bounds: sides(shape.bounds()),
        area: Some(trueness_measure::cad::area(&integrals)),
        cad: Some(trueness_measure::cad::record(model, &shape, &integrals)),
        ..InfoDocument::new(record, Content::Cad)
    })
}

fn sides(bounds: Aabb) -> Option<[[f64; 3]; 2]> {
    (!bounds.is_empty()).then_some([bounds.min, bounds.max])
}
