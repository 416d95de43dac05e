//! Area, volume and center of mass.
//!
//! The volume is the sum over the facets of the signed tetrahedra to one place (the divergence theorem). That place is the
//! middle of the box, so little cancels, and sums are carried in two numbers. The result is good to about 1e-15 of the volume
//! of the box. Chunks are fixed, so it has the same bits for any number of threads.

use super::Topology;
use crate::mesh::Mesh;
use crate::num::sum::{Sum, Sums};
use crate::parallel::prelude::*;
use crate::space::{Aabb, Point, cross, dot, minus, norm, plus, times};

/// Facets that are summed in one go: sums do not depend on the number of threads.
const FACETS_PER_SUM: usize = 1 << 13;

/// Size and place of a mesh, over the facets that count.
#[derive(Clone, Debug, PartialEq)]
pub struct Properties {
    /// Box of all vertices at finite places.
    pub bounds: Aabb,
    /// Sum of the areas of the facets, mm².
    pub area: f64,
    /// Volume enclosed, mm³: positive where the facets look outwards. Means nothing unless the mesh is closed and
    /// consistently oriented.
    pub signed_volume: f64,
    /// Center of mass of the volume; `None` where the volume is zero to rounding.
    pub center_of_mass: Option<Point>,
    /// Center of mass of the surface; `None` where the area is zero.
    pub center_of_area: Option<Point>,
    /// Area of each shell, mm².
    pub shell_areas: Vec<f64>,
    /// Signed volume of each shell, mm³.
    pub shell_volumes: Vec<f64>,
}

/// Sums over some facets, lengths measured from the middle of the box. They are the area, and the area times three times the
/// center of each facet. Then follow six times the volume, and that times four times the center of each tetrahedron.
type Moments = [Sum; 8];
/// Place of the area among the sums; times the center follows.
const AREA_SUM: usize = 0;
/// Place of the six-fold volume among the sums; times the center follows.
const VOLUME_SUM: usize = 4;

/// Area and six-fold volume of consecutive facets of one shell.
type Run = (u32, Sum, Sum);

fn add(a: Sum, b: Sum) -> Sum {
    a.plus(b.high).plus(b.low)
}

impl Properties {
    /// The properties of `mesh`, which `topology` was made of. Linear time.
    pub fn of(mesh: &Mesh, topology: &Topology) -> Properties {
        let bounds = mesh.finite_bounds();
        let origin: Point = std::array::from_fn(|k| bounds.min[k] + (bounds.max[k] - bounds.min[k]) / 2.0);
        let parts: Vec<(Moments, Vec<Run>)> = (mesh.faces.par_chunks(FACETS_PER_SUM))
            .zip(topology.shell_of.par_chunks(FACETS_PER_SUM))
            .map(|(faces, shells)| chunk(mesh, origin, faces, shells))
            .collect();
        let mut all = Moments::default();
        let mut shells = vec![(Sum::default(), Sum::default()); topology.shells];
        for (part, runs) in &parts {
            all = std::array::from_fn(|i| add(all[i], part[i]));
            for (shell, area, volume) in runs {
                let of = &mut shells[*shell as usize];
                *of = (add(of.0, *area), add(of.1, *volume));
            }
        }
        let (area, volume) = (all[AREA_SUM].value(), all[VOLUME_SUM].value() / 6.0);
        let center = |of: usize, scale: f64| {
            plus(origin, times(scale, std::array::from_fn(|k| all[of + 1 + k].value())))
        };
        let sides = bounds.sides();
        // The rounding of a volume that is really zero.
        let noise = 1e-14 * sides[0] * sides[1] * sides[2];
        Properties {
            bounds,
            area,
            signed_volume: volume,
            center_of_mass: (volume.abs() > noise).then(|| center(VOLUME_SUM, 1.0 / (24.0 * volume))),
            center_of_area: (area > 0.0).then(|| center(AREA_SUM, 1.0 / (3.0 * area))),
            shell_areas: shells.iter().map(|s| s.0.value()).collect(),
            shell_volumes: shells.iter().map(|s| s.1.value() / 6.0).collect(),
        }
    }
}

fn chunk(mesh: &Mesh, origin: Point, faces: &[[u32; 3]], shells: &[u32]) -> (Moments, Vec<Run>) {
    let (mut all, mut runs) = (Moments::default(), Vec::<Run>::new());
    let mut i = 0;
    while i < faces.len() {
        let (shell, mut run) = (shells[i], Sums::<8>::ZERO);
        while i < faces.len() && shells[i] == shell {
            if shell != u32::MAX {
                run.add(terms(faces[i].map(|v| minus(mesh.positions[v as usize], origin))));
            }
            i += 1;
        }
        if shell != u32::MAX {
            let run = run.each();
            all = std::array::from_fn(|i| add(all[i], run[i]));
            runs.push((shell, run[AREA_SUM], run[VOLUME_SUM]));
        }
    }
    (all, runs)
}

/// The contribution of a facet to the [`Moments`].
#[inline(always)]
fn terms([a, b, c]: [Point; 3]) -> [f64; 8] {
    let area = 0.5 * norm(cross(minus(b, a), minus(c, a)));
    let volume = dot(a, cross(b, c));
    let [x, y, z] = plus(a, plus(b, c));
    [area, area * x, area * y, area * z, volume, volume * x, volume * y, volume * z]
}
