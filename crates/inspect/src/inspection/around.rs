//! The facets about vertices.

use trueness_geom::mesh::Mesh;

/// The facets about each vertex of a mesh.
pub(super) struct Around {
    first: Vec<usize>,
    facets: Vec<u32>,
}

impl Around {
    pub fn new(mesh: &Mesh) -> Around {
        let mut first = vec![0; mesh.positions.len() + 1];
        mesh.faces.iter().flatten().for_each(|v| first[*v as usize + 1] += 1);
        (1..first.len()).for_each(|v| first[v] += first[v - 1]);
        let (mut next, mut facets) = (first.clone(), vec![0; 3 * mesh.faces.len()]);
        for (facet, corners) in (0u32..).zip(&mesh.faces) {
            for v in corners {
                facets[next[*v as usize]] = facet;
                next[*v as usize] += 1;
            }
        }
        Around { first, facets }
    }

    pub fn of(&self, v: u32) -> &[u32] {
        &self.facets[self.first[v as usize]..self.first[v as usize + 1]]
    }
}
