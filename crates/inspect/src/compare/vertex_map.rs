//! Deviations of scattered points as a field on the reference's vertices, for a coloured surface.

use trueness_geom::closest::Closest;

/// The mean deviation of the points nearest to each vertex's facets, weighted by how near the vertex they are.
#[derive(Clone, Debug, Default)]
pub struct VertexMap {
    sum: Vec<f64>,
    weight: Vec<f64>,
}

impl VertexMap {
    /// For a mesh of so many vertices.
    pub fn new(vertices: usize) -> VertexMap {
        VertexMap { sum: vec![0.0; vertices], weight: vec![0.0; vertices] }
    }

    /// Adds a deviation at a place on `face`, whose barycentric coordinates are the weights. The order of the calls decides
    /// the last bits.
    pub fn add(&mut self, face: &[u32; 3], barycentric: [f32; 3], deviation: f64) {
        for (&v, w) in face.iter().zip(barycentric) {
            self.sum[v as usize] += f64::from(w) * deviation;
            self.weight[v as usize] += f64::from(w);
        }
    }

    /// The field: one value a vertex, NaN where no point came near.
    pub fn values(&self) -> Vec<f64> {
        let mean = |(s, w): (&f64, &f64)| if *w > 0.0 { s / w } else { f64::NAN };
        self.sum.iter().zip(&self.weight).map(mean).collect()
    }
}

/// The weights of a place.
pub fn weights(place: &Closest) -> [f32; 3] {
    place.barycentric.map(|b| b as f32)
}
