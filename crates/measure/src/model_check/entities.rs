//! Numbers of entities in the file, which a user names faces and edges by.

use std::collections::BTreeMap;
use trueness_cad::trimmed::Trimmed;

/// The numbers of the entities of the first two faces and of one edge.
pub fn numbers(shape: &Trimmed, faces: &[u32], edges: &[u32]) -> BTreeMap<String, f64> {
    let face = |f: &u32| shape.brep.faces.get(*f as usize).map(|f| f.entity as f64);
    let edge = |e: &u32| shape.brep.edges.get(*e as usize).map(|e| e.entity as f64);
    let mut all = BTreeMap::new();
    for (name, number) in ["face", "other_face"].into_iter().zip(faces) {
        all.extend(face(number).map(|x| (name.to_string(), x)));
    }
    if let [only] = edges {
        all.extend(edge(only).map(|x| ("edge".to_string(), x)));
    }
    all
}
