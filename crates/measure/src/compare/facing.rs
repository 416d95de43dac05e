//! Only places that look the same way: normals of the measured against those of the reference.

use std::sync::Arc;
use trueness_geom::mesh::Mesh;
use trueness_geom::space::{Vector, cross, dot, minus, norm, normal, plus, times, unit};

/// The measured normals, and how far they may turn away from those of the reference.
#[derive(Clone, Debug)]
pub struct Facing {
    angle: f64,
    cosine: f64,
    normals: Arc<[Vector]>,
}

impl Facing {
    /// `normals[i]` is that of point `i`, of any length; a point whose normal is zero or not finite agrees with nothing. `angle` in
    /// radians, above 0 and at most π.
    pub fn new(angle: f64, normals: Vec<Vector>) -> Facing {
        let normals: Vec<Vector> = normals.into_iter().map(direction).collect();
        Facing { angle, cosine: libm::cos(angle), normals: normals.into() }
    }

    /// Radians.
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// Number of normals.
    pub fn count(&self) -> usize {
        self.normals.len()
    }

    /// Whether the normal of point `index` is within the angle of `normal`, which has length 1. What has no normal does not agree.
    pub(super) fn agrees(&self, index: u64, normal: Option<Vector>) -> bool {
        let mine = usize::try_from(index).ok().and_then(|i| self.normals.get(i));
        match (mine, normal) {
            (Some(mine), Some(normal)) if *mine != [0.0; 3] => dot(*mine, normal) >= self.cosine,
            _ => false,
        }
    }
}

/// The same with length 1; zero for what has no direction.
fn direction(v: Vector) -> Vector {
    unit(v).map_or([0.0; 3], |(n, _)| n)
}

/// The outward unit normal of a facet; `None` without area.
pub(super) fn facet_normal(mesh: &Mesh, face: u32) -> Option<Vector> {
    normal(mesh.faces[face as usize].map(|v| mesh.positions[v as usize]))
}

/// A normal for each of these facets, zero for one without area.
pub fn facet_normals(mesh: &Mesh, faces: impl IntoIterator<Item = u32>) -> Vec<Vector> {
    faces.into_iter().map(|f| facet_normal(mesh, f).unwrap_or([0.0; 3])).collect()
}

/// A normal for each vertex, by its facets, each with the weight of its angle there (G. Thürmer and C. A. Wüthrich, "Computing
/// vertex normals from polygonal facets", 1998); zero for a vertex that no facet with area uses. One pass over the facets.
///
/// ```
/// use trueness_geom::mesh::Mesh;
/// let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [5.0; 3]];
/// let normals = trueness_measure::compare::vertex_normals(&Mesh { positions, faces: vec![[0, 1, 2]] });
/// assert_eq!(normals, [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0; 3]]);
/// ```
pub fn vertex_normals(mesh: &Mesh) -> Vec<Vector> {
    let mut sums = vec![[0.0; 3]; mesh.positions.len()];
    for (face, corners) in (0u32..).zip(&mesh.faces) {
        let Some(normal) = facet_normal(mesh, face) else { continue };
        for k in 0..3 {
            let [here, next, last] = [0, 1, 2].map(|j| mesh.positions[corners[(k + j) % 3] as usize]);
            let (a, b) = (minus(next, here), minus(last, here));
            let angle = libm::atan2(norm(cross(a, b)), dot(a, b));
            let sum = &mut sums[corners[k] as usize];
            *sum = plus(*sum, times(angle, normal));
        }
    }
    sums.into_iter().map(direction).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corners_of_a_cube_look_along_its_diagonals() {
        // However its squares are cut in two: weights by angle do not see it.
        let third = 1.0 / 3f64.sqrt();
        let positions = (0..8u32).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
        let faces = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        let cube = Mesh { positions, faces };
        for (v, n) in vertex_normals(&cube).iter().enumerate() {
            for k in 0..3 {
                let side = if v >> k & 1 == 1 { third } else { -third };
                assert!((n[k] - side).abs() < 1e-15, "{v}: {n:?}");
            }
        }
    }

    #[test]
    fn the_limit_belongs_to_the_angle_and_nothing_agrees_without_a_normal() {
        let turned = |degrees: f64| {
            let a = degrees.to_radians();
            [3.0 * a.sin(), 0.0, 3.0 * a.cos()]
        };
        let normals = [0.0, 29.99, 30.01, 180.0].map(turned);
        let facing = Facing::new(30f64.to_radians(), [&normals[..], &[[0.0; 3], [f64::NAN; 3]]].concat());
        let up = Some([0.0, 0.0, 1.0]);
        let found: Vec<bool> = (0..7).map(|i| facing.agrees(i, up)).collect();
        assert_eq!(found, [true, true, false, false, false, false, false]);
        assert!(!facing.agrees(0, None));
    }
}
