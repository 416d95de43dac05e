//! The faces of a model, with all that is asked of them.

use super::face::CadFace;
use crate::drawn_faces::DrawnFaces;
use std::collections::BTreeSet;
use trueness_cad::brep::{Bounds, Brep, Loop};
use trueness_cad::model::Model;
use trueness_cad::search::Search;
use trueness_cad::trim::Trim;
use trueness_cad::trimmed::Trimmed;
use trueness_document::face::FaceRecord;
use trueness_geom::deviation::surface::OnlyCancels;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Cancelled, Progress};

/// Faces of a CAD model, ready to be measured against. The mesh that draws them goes beside it.
pub struct CadFaces {
    /// Where nearest places are looked up.
    pub search: Search<Trim>,
    /// The faces, in the order of the search.
    pub faces: Vec<CadFace>,
    /// What pictures show of them, with the face of each facet of the mesh that draws them.
    pub drawn: DrawnFaces,
    /// How far that mesh is from them at most, mm.
    pub drawn_within: f64,
    /// Up to where places may have been meant as one, mm; 0 if the file says nothing.
    pub uncertainty: f64,
    /// Entities that are faces, or hold faces, and could not be read: their number, and why.
    pub unread: Vec<(u64, String)>,
    /// The names on the way from the root of the assembly to each instance. Where several have the same, the later ones have a number too.
    pub instances: Vec<String>,
    /// Faces that share an edge with each, ascending.
    pub(super) neighbors: Vec<Vec<u32>>,
}

impl CadFaces {
    /// Of a model where its parts stand. `of_facet` is the face of each facet of `mesh`, which draws them within `drawn_within` mm.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn new(
        model: &Model,
        shape: Trimmed,
        (mesh, of_facet): (&Mesh, Vec<u32>),
        drawn_within: f64,
        progress: &dyn Progress,
    ) -> Result<CadFaces, Cancelled> {
        let Trimmed { brep, trims } = shape;
        let faces =
            brep.faces.iter().zip(&trims).map(|(face, trim)| CadFace::new(face, trim.as_ref())).collect();
        let neighbors = neighbors(&brep);
        let drawn = DrawnFaces::new(&brep, mesh, of_facet);
        let trims = trims.into_iter().map(Result::ok).collect();
        let search = Search::watched(&brep, trims, &OnlyCancels(progress))?;
        let unread = model.unread.iter().filter(|u| u.holds_faces);
        Ok(CadFaces {
            search,
            faces,
            drawn,
            drawn_within,
            uncertainty: model.same_within().unwrap_or(0.0),
            unread: unread.map(|u| (u.entity, u.reason.clone())).collect(),
            instances: instance_names(model),
            neighbors,
        })
    }

    /// What documents say of a face. Its instance is told where there are several.
    pub fn record(&self, face: u32) -> FaceRecord {
        let own = &self.faces[face as usize];
        let instance = self.instances.get(own.instance as usize).filter(|_| self.instances.len() > 1);
        let name = Some(own.name.clone()).filter(|name| !name.is_empty());
        FaceRecord { face: own.entity, name, instance: instance.cloned() }
    }

    /// The facets of some faces, ascending.
    pub fn facets(&self, faces: &[u32]) -> Vec<u32> {
        (0u32..)
            .zip(&self.drawn.of_facet)
            .filter(|(_, face)| faces.contains(face))
            .map(|(facet, _)| facet)
            .collect()
    }
}

impl std::fmt::Debug for CadFaces {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "CadFaces({})", self.faces.len())
    }
}

/// A name of its own for each instance: files may give several the same, or none.
fn instance_names(model: &Model) -> Vec<String> {
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let name = |path: &[String]| {
        let path = path.join("/");
        let path = path.trim();
        let numbered = (2u32..).map(|n| format!("{path} ({n})").trim().to_string());
        let first = Some(path.to_string()).filter(|path| !path.is_empty());
        let free = first.into_iter().chain(numbered).find(|name| !taken.contains(name)).unwrap_or_default();
        taken.insert(free.clone());
        free
    };
    model.instances.iter().map(|i| i.path.as_slice()).map(name).collect()
}

/// Faces that share an edge with each, ascending.
fn neighbors(brep: &Brep) -> Vec<Vec<u32>> {
    let mut around: Vec<Vec<u32>> = vec![vec![]; brep.edges.len()];
    for (number, face) in (0u32..).zip(&brep.faces) {
        let Bounds::Loops(loops) = &face.bounds else { continue };
        for edge in loops.iter().filter_map(edges_of).flatten() {
            if let Some(of) = around.get_mut(edge as usize) {
                of.push(number);
            }
        }
    }
    let mut all: Vec<Vec<u32>> = vec![vec![]; brep.faces.len()];
    for faces in &around {
        for face in faces {
            all[*face as usize].extend(faces.iter().filter(|other| *other != face));
        }
    }
    for own in &mut all {
        own.sort_unstable();
        own.dedup();
    }
    all
}

fn edges_of(of: &Loop) -> Option<impl Iterator<Item = u32>> {
    match of {
        Loop::Edges(uses) => Some(uses.iter().map(|u| u.edge)),
        Loop::Vertex(_) => None,
    }
}
