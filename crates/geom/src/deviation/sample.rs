//! Points spread evenly over a mesh, and distances between two meshes from both sides.

use crate::closest::{MeshError, check_mesh};
use crate::mesh::Mesh;
use crate::num::random::Random;
use crate::num::sum::Sum;
use crate::parallel::prelude::*;
use crate::space::{Point, cross, minus, norm};
use crate::stats::statistics::{Number, Statistics};

/// Why a mesh cannot be sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SampleError {
    /// The mesh is not usable.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// All facets are points or lines.
    #[error("the mesh has no area: sample its vertices instead")]
    NoArea,
}

/// A point on a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Where, millimeters.
    pub point: Point,
    /// On which face.
    pub face: u32,
}

/// `count` points of the mesh, evenly spread by area. The surface, face after face, is cut into `count` strips of equal area,
/// and each gives one random point. So each face gets its share to within one or two points.
///
/// Point `i` depends on the mesh, the count, the seed and `i` alone. Faces without area get none.
///
/// # Errors
/// A mesh without faces, with bad indices or coordinates, or without area.
pub fn sample(mesh: &Mesh, count: usize, seed: u64) -> Result<Vec<Sample>, SampleError> {
    check_mesh(mesh)?;
    let corners = |face: usize| mesh.places(&mesh.faces[face]);
    let mut total = Sum::default();
    let ends: Vec<f64> = (0..mesh.faces.len())
        .map(|face| {
            let [a, b, c] = corners(face);
            total = total.plus(norm(cross(minus(b, a), minus(c, a))));
            total.value()
        })
        .collect();
    let total = total.value();
    if total <= 0.0 {
        return Err(SampleError::NoArea);
    }
    // The last face with area: rounding may carry the last strip past the end.
    let last = ends.partition_point(|end| *end < total);
    Ok((0..count)
        .into_par_iter()
        .map(|i| {
            let mut random = Random::stream(seed, i as u64);
            let place = (i as f64 + random.unit()) / count as f64 * total;
            let face = ends.partition_point(|end| *end <= place).min(last);
            let [a, b, c] = corners(face);
            // A root makes the distance from the first corner even over the area (Turk 1990).
            let (along, across) = (random.unit().sqrt(), random.unit());
            let point = std::array::from_fn(|k| a[k] + along * ((b[k] - a[k]) + across * (c[k] - b[k])));
            Sample { point, face: face as u32 }
        })
        .collect())
}

/// Distance between two surfaces, from the deviations of points of each from the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoSided {
    /// Greatest distance from either side: the Hausdorff distance of the points from the other surface.
    pub hausdorff: Number,
    /// Mean of both mean absolute deviations.
    pub mean: Number,
    /// Root of the mean of both mean squares.
    pub rms: Number,
}

impl TwoSided {
    /// Both directions together, each with the same weight, however many points it has.
    pub fn of(there: &Statistics, back: &Statistics) -> TwoSided {
        let both = |f: fn(&Statistics) -> Number, join: fn(f64, f64) -> f64| Ok(join(f(there)?, f(back)?));
        TwoSided {
            hausdorff: both(Statistics::max_abs, f64::max),
            mean: both(|s| s.mean_abs, |a, b| 0.5 * (a + b)),
            rms: both(|s| s.rms, |a, b| (0.5 * (a * a + b * b)).sqrt()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::statistics::{Missing, Summary};

    fn two_facets() -> Mesh {
        // Areas 3 : 1, and a facet without area between them.
        Mesh {
            positions: vec![
                [0.0; 3],
                [3.0, 0.0, 0.0],
                [0.0, 2.0, 0.0],
                [0.0, 0.0, 1.0],
                [1.0, 0.0, 1.0],
                [0.0, 2.0, 1.0],
            ],
            faces: vec![[0, 1, 2], [0, 0, 1], [3, 4, 5]],
        }
    }

    #[test]
    fn faces_get_their_share() {
        let mesh = two_facets();
        let samples = sample(&mesh, 4000, 1).unwrap();
        let on = |face| samples.iter().filter(|s| s.face == face).count();
        assert_eq!((on(0), on(1), on(2)), (3000, 0, 1000));
        for s in &samples {
            let [x, y, z] = s.point;
            let (width, height) = if s.face == 0 { (3.0, 0.0) } else { (1.0, 1.0) };
            assert!(x >= 0.0 && y >= 0.0 && x / width + y / 2.0 <= 1.0 + 1e-15 && z == height);
        }
        // Even inside a facet: the mean is the centroid, half of the points lie in each half by area.
        let mean = |k: usize| samples[..3000].iter().map(|s| s.point[k]).sum::<f64>() / 3000.0;
        assert!((mean(0) - 1.0).abs() < 0.05 && (mean(1) - 2.0 / 3.0).abs() < 0.04);
        let near =
            samples[..3000].iter().filter(|s| s.point[0] / 3.0 + s.point[1] / 2.0 < 0.5f64.sqrt()).count();
        assert!(near.abs_diff(1500) < 140, "{near}");
    }

    #[test]
    fn the_same_for_any_number_of_threads() {
        let run = |threads: usize, seed: u64| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| sample(&two_facets(), 500, seed)).unwrap()
        };
        assert_eq!(run(1, 3), run(4, 3));
        assert_ne!(run(1, 3), run(1, 4));
        assert_eq!(sample(&two_facets(), 0, 1), Ok(vec![]));
        assert_eq!(sample(&Mesh::default(), 5, 1), Err(SampleError::Mesh(MeshError::NoFaces)));
        let line = Mesh { faces: vec![[0, 1, 1]], ..two_facets() };
        assert_eq!(sample(&line, 5, 1), Err(SampleError::NoArea));
    }

    #[test]
    fn both_sides_weigh_the_same() {
        let of = |v: &[f64]| Summary::of(v).all;
        let found = TwoSided::of(&of(&[-3.0, 1.0]), &of(&[0.5]));
        assert_eq!((found.hausdorff, found.mean), (Ok(3.0), Ok(1.25)));
        assert_eq!(found.rms, Ok((0.5 * (5.0 + 0.25f64)).sqrt()));
        assert_eq!(TwoSided::of(&of(&[1.0]), &of(&[])).mean, Err(Missing::NoValues));
    }
}
