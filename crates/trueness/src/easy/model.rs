//! A CAD model that others are measured against.

use crate::read::cad::Chord;
use crate::read::{self, MeshOrCad};
use crate::task::TaskError;
use std::path::Path;
use trueness_document::{InputRecord, Role};
use trueness_files::{ReadOptions, Sources};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_measure::cad_faces::CadFaces;

/// A CAD model with exact faces: read once, asked often, from any number of threads.
pub struct Model {
    faces: CadFaces,
    mesh: Mesh,
    record: InputRecord,
}

impl Model {
    /// Of the CAD file that goes by a name.
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
}

impl std::fmt::Debug for Model {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Model({:?})", self.faces)
    }
}
