//! Outlines of a CAD model: where planes cut its faces.

use super::super::faced::faced;
use crate::read::cad::{Chord, drawn};
use crate::task::TaskError;
use std::path::Path;
use trueness_cad::section::section;
use trueness_cad::tessellate::Tessellation;
use trueness_cad::trimmed::Trimmed;
use trueness_document::InputRecord;
use trueness_document::section::{NominalWarning, NominalWarningKind};
use trueness_files::cad::CadFile;
use trueness_geom::plane::{Plane, PlaneFrame};
use trueness_geom::progress::Progress;
use trueness_measure::section::cut_outline;
use trueness_section::Outline;

/// Faces, and the facets that say which of them a plane passes.
pub struct Faces {
    shape: Trimmed,
    drawn: Tessellation,
}

/// Faces that a warning names at most.
const MAX_NAMED_FACES: usize = 8;

impl Faces {
    /// Those of a model; facets of shells that look inwards are turned, and the file is told so.
    pub fn open(
        path: &Path,
        file: &CadFile,
        record: &mut InputRecord,
        progress: &dyn Progress,
    ) -> Result<Faces, TaskError> {
        let (shape, mut drawn) = drawn(path, file, Chord::MEASURED, record, progress)?;
        let outward = faced(&drawn.mesh, record, progress)?;
        // Of faces that lie in one place twice both are cut.
        if outward.faces.len() == drawn.mesh.faces.len() {
            drawn.mesh = outward;
        }
        Ok(Faces { shape, drawn })
    }

    /// The outlines in a plane, in the coordinates of its frame, and what makes them doubtful.
    pub fn outlines(&self, plane: &Plane, frame: &PlaneFrame) -> (Vec<Outline>, Option<NominalWarning>) {
        let found = section(&self.shape, &self.drawn, plane);
        let outlines = found.outlines.iter().map(|outline| cut_outline(outline, frame));
        (outlines.filter(|o| !o.segments.is_empty()).collect(), self.in_plane(&found.in_plane, plane))
    }

    fn in_plane(&self, faces: &[u32], plane: &Plane) -> Option<NominalWarning> {
        if faces.is_empty() {
            return None;
        }
        let number = |face: &u32| self.shape.brep.faces.get(*face as usize).map(|f| f.entity.to_string());
        let mut named: Vec<String> = faces.iter().filter_map(number).take(MAX_NAMED_FACES).collect();
        if faces.len() > MAX_NAMED_FACES {
            named.push(format!("{} more", faces.len() - MAX_NAMED_FACES));
        }
        let (of, lie) = if let [_] = faces { ("face", "lies") } else { ("faces", "lie") };
        Some(NominalWarning {
            kind: NominalWarningKind::FaceInPlane,
            value: faces.len() as f64,
            text: format!(
                "{of} {} of the nominal {lie} in the plane at {:.4} mm: its section is that just below; move the plane off the {of}",
                named.join(", "),
                plane.offset
            ),
        })
    }
}
