//! Where vertices were left out, those that stay show the worst of what the others showed.

use trueness_document::tolerance::badness;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Point, dot, minus, norm};

/// For each vertex of the mesh the one that stands for it: itself if it is among `left`, else that of a neighbor along an edge,
/// the nearest of those that offer themselves first. `u32::MAX` where no way leads to one that is left.
pub fn owners(mesh: &Mesh, left: &[u32]) -> Vec<u32> {
    let mut owners = vec![u32::MAX; mesh.positions.len()];
    left.iter().for_each(|v| owners[*v as usize] = *v);
    let at = |v: u32| mesh.positions[v as usize];
    let away = |a: u32, b: u32| -> f64 {
        let d = minus(at(a), at(b));
        dot(d, d)
    };
    let mut offers: Vec<u32> = vec![u32::MAX; owners.len()];
    let whole = |f: &&[u32; 3]| f.iter().all(|v| (*v as usize) < mesh.positions.len());
    let waits = |f: &&[u32; 3]| f.iter().any(|v| owners[*v as usize] == u32::MAX);
    let mut faces: Vec<&[u32; 3]> = mesh.faces.par_iter().filter(whole).filter(waits).collect();
    loop {
        let mut open = vec![];
        for face in &faces {
            for k in 0..3 {
                for (from, to) in [(face[k], face[(k + 1) % 3]), (face[(k + 1) % 3], face[k])] {
                    let owner = owners[from as usize];
                    if owner == u32::MAX || owners[to as usize] != u32::MAX {
                        continue;
                    }
                    let offer = &mut offers[to as usize];
                    if *offer == u32::MAX {
                        open.push(to);
                        *offer = owner;
                    } else if (away(owner, to), owner) < (away(*offer, to), *offer) {
                        *offer = owner;
                    }
                }
            }
        }
        if open.is_empty() {
            return owners;
        }
        open.iter().for_each(|v| owners[*v as usize] = offers[*v as usize]);
        faces.retain(|f| f.iter().any(|v| owners[*v as usize] == u32::MAX));
    }
}

/// Farthest that a vertex lies from the one that stands for it, millimeters.
pub fn farthest(mesh: &Mesh, owners: &[u32]) -> f64 {
    let place = |v: u32| mesh.positions.get(v as usize);
    let away = |(p, owner): (&Point, &u32)| place(*owner).map_or(0.0, |q| norm(minus(*p, *q)));
    mesh.positions.par_iter().zip(owners).map(away).reduce(|| 0.0, f64::max)
}

/// The value of each vertex that is left: the worst of those it stands for, farthest beyond the zone or else greatest in size.
pub fn worst(values: &[f64], owners: &[u32], zone: Option<[f64; 2]>) -> Vec<f64> {
    let mut worst = values.to_vec();
    for (value, owner) in values.iter().zip(owners).filter(|(v, _)| !v.is_nan()) {
        if let Some(shown) = worst.get_mut(*owner as usize)
            && (shown.is_nan() || badness(*value, zone) > badness(*shown, zone))
        {
            *shown = *value;
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_bad_is_lost_with_its_vertex() {
        // A strip; vertices 2 to 5 were left out, and the worst was among them.
        let positions = (0..8u32).map(|i| [f64::from(i / 2), f64::from(i % 2), 0.0]).collect();
        let faces =
            (0..3u32).flat_map(|i| [[2 * i, 2 * i + 1, 2 * i + 2], [2 * i + 2, 2 * i + 1, 2 * i + 3]]);
        let mesh = Mesh { positions, faces: faces.collect() };
        let owners = owners(&mesh, &[0, 1, 6, 7]);
        assert_eq!(owners, [0, 1, 0, 1, 6, 7, 6, 7]);
        assert_eq!(farthest(&mesh, &owners), 1.0);
        let none = f64::NAN;
        let shown = worst(&[0.1, 0.0, -0.3, none, 0.4, none, -0.35, none], &owners, None);
        assert_eq!((shown[0], shown[1], shown[6]), (-0.3, 0.0, 0.4));
        assert!(shown[7].is_nan());
        let zoned = worst(&[0.1, 0.0, -0.3, none, 0.4, none, -0.35, none], &owners, Some([-0.1, 0.5]));
        assert_eq!(zoned[6], -0.35);
    }
}
