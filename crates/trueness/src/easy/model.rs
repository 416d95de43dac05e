//! A CAD model that others are measured against.

use crate::read::cad::Chord;
use crate::read::{self, MeshOrCad};
use crate::task::TaskError;
use std::convert::Infallible;
use std::path::Path;
use trueness_document::{InputRecord, Role};
use trueness_files::{ReadOptions, Sources};
use trueness_geom::cloud::Whole;
use trueness_geom::deviation::surface::SurfaceOptions;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::space::Point;
use trueness_measure::cad_faces::CadFaces;
use trueness_measure::compare::{self, CompareError, Exact, Options, Reference};
use trueness_measure::file_numbers::LeftOut;

/// A CAD model with exact faces: read once, asked often, from any number of threads.
pub struct Model {
    faces: CadFaces,
    mesh: Mesh,
    record: InputRecord,
}

impl Model {
    /// Of the STEP or IGES file that goes by a name.
    ///
    /// # Errors
    /// Those of reading; a file without a CAD model; cancelled.
    pub fn read(sources: &dyn Sources, name: &Path, progress: &dyn Progress) -> Result<Model, TaskError> {
        let options = ReadOptions::default();
        let (MeshOrCad::Cad(file), mut record) = read::mesh_or_cad(sources, name, Role::Reference, &options)?
        else {
            return Err(TaskError::usage(format!("{}: it holds no CAD model", name.display())));
        };
        let (faces, mesh) = read::cad::faces(name, &file, Chord::DRAWN, &mut record, progress)?;
        Ok(Model { faces, mesh, record })
    }

    /// The faces.
    pub fn faces(&self) -> &CadFaces {
        &self.faces
    }

    /// The mesh that draws them.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// What a document says of its file: unit, faces that could not be read, warnings.
    pub fn record(&self) -> &InputRecord {
        &self.record
    }

    /// The exact deviation of each point from the faces, in the order of the points, as a comparison has it: not finite where the point is
    /// [excluded](crate::Exclusion).
    ///
    /// # Errors
    /// A sign method that is for meshes; a point that is not finite; cancelled.
    pub fn deviations(
        &self,
        points: &[Point],
        surface: &SurfaceOptions,
        progress: &dyn Progress,
    ) -> Result<Vec<f64>, TaskError> {
        if points.is_empty() {
            return Ok(vec![]);
        }
        let exact = Some(Exact::Cad(&self.faces));
        let name = self.record.path.clone();
        let reference = Reference { name, mesh: &self.mesh, exact, left_out: LeftOut::default() };
        let options = Options { surface: *surface, ..Options::default() };
        let mut all = Vec::with_capacity(points.len());
        let mut stream = Whole::<Infallible>::new(points.to_vec());
        compare::run(&mut stream, &[reference], &options, progress, |block| -> Result<(), Infallible> {
            all.extend_from_slice(&block.measured[0]);
            Ok(())
        })
        .map_err(|e| match e {
            CompareError::Query(trueness_geom::closest::QueryError::Cancelled(e)) => e.into(),
            e => TaskError::because(e),
        })?;
        Ok(all)
    }
}

impl std::fmt::Debug for Model {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Model({:?})", self.faces)
    }
}
