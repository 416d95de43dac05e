//! A mesh and its deviations as blobs.

use super::field::{Codes, NoValue};
use super::grid::Grid;
use super::planes::pack;
use super::predict::{Rule, rules};
use meshopt::{SimplifyOptions, VertexDataAdapter};
use trueness_geom::mesh::Mesh;
use trueness_geom::space::{Aabb, Point};

/// Triangles of the coarser levels, where the mesh has clearly more.
const LEVELS: [usize; 3] = [600_000, 150_000, 40_000];

/// A mesh whose vertices stand in the order in which its triangles first use them.
pub struct Ordered {
    /// Corners.
    pub triangles: Vec<[u32; 3]>,
    /// Places, millimetres.
    pub positions: Vec<Point>,
    /// For each vertex its number in the mesh that came in.
    pub source: Vec<u32>,
    /// Bound of what simplification moved the surface by, millimetres; 0 when nothing was left out.
    pub error: f64,
}

impl Ordered {
    /// Takes the drawable triangles of a mesh: all corners exist, are finite and differ. Equal places become one vertex.
    /// Where that leaves more than `limit` triangles, edges are collapsed onto existing vertices; those in `keep` stay.
    pub fn of(mesh: &Mesh, keep: &[u32], limit: usize) -> Ordered {
        // Without a sign on zero, equal places have equal bits.
        let places: Vec<Point> = mesh.positions.iter().map(|p| p.map(|x| x + 0.0)).collect();
        let drawable = |f: &&[u32; 3]| {
            f.iter().all(|c| places.get(*c as usize).is_some_and(|p| p.iter().all(|x| x.is_finite())))
        };
        let corners: Vec<u32> = mesh.faces.iter().filter(drawable).flatten().copied().collect();
        let (count, one) = meshopt::generate_vertex_remap(&places, Some(&corners));
        let mut source = vec![u32::MAX; count];
        for (old, new) in (0u32..).zip(&one) {
            if let Some(slot) = source.get_mut(*new as usize) {
                *slot = old.min(*slot);
            }
        }
        let positions: Vec<Point> = source.iter().map(|s| places[*s as usize]).collect();
        let mut corners: Vec<u32> = corners
            .chunks_exact(3)
            .map(|t| [0, 1, 2].map(|k| one[t[k] as usize]))
            .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            .flatten()
            .collect();
        let mut error = 0.0;
        if corners.len() / 3 > limit {
            let locked: Vec<u32> = keep.iter().filter_map(|k| one.get(*k as usize).copied()).collect();
            (corners, error) = collapse(&corners, &positions, &locked, limit);
        }
        Ordered::from_corners(corners, positions, source, error)
    }

    /// Brings triangles into an order that uses few vertices at a time, and numbers the vertices as they are first used.
    fn from_corners(corners: Vec<u32>, positions: Vec<Point>, source: Vec<u32>, error: f64) -> Ordered {
        let corners = meshopt::optimize_vertex_cache(&corners, positions.len());
        let mut number = vec![u32::MAX; positions.len()];
        let mut old_of = vec![];
        let mut renumbered = Vec::with_capacity(corners.len());
        for &old in &corners {
            let number = &mut number[old as usize];
            if *number == u32::MAX {
                *number = old_of.len() as u32;
                old_of.push(old as usize);
            }
            renumbered.push(*number);
        }
        Ordered {
            triangles: triples(&renumbered),
            positions: old_of.iter().map(|o| positions[*o]).collect(),
            source: old_of.iter().map(|o| source[*o]).collect(),
            error,
        }
    }
}

/// A mesh as bytes, before compression.
pub struct MeshBytes {
    /// Triangle code of EXT_meshopt_compression.
    pub triangles: Vec<u8>,
    /// Differences from the prediction, x then y then z.
    pub positions: Vec<u8>,
    /// Coarser index lists over the same vertices: code, triangles, error in millimetres.
    pub levels: Vec<(Vec<u8>, usize, f64)>,
    rules: Vec<Rule>,
}

impl MeshBytes {
    /// Encodes triangles, positions on `grid`, and the coarser levels.
    pub fn of(mesh: &Ordered, grid: &Grid) -> Result<MeshBytes, meshopt::Error> {
        let (code, read) = triangle_code(&flat(&mesh.triangles), mesh.positions.len())?;
        let rules = rules(&read, mesh.positions.len());
        let places: Vec<[u16; 3]> = mesh.positions.iter().map(|p| grid.place(p)).collect();
        let mut positions = vec![];
        for k in 0..3 {
            let at = |v: u32| i32::from(places[v as usize][k]);
            let differences = rules.iter().zip(0..).map(|(rule, v)| at(v) - rule.position(at));
            positions.extend(pack(differences, places.len(), 2));
        }
        let mut levels = vec![];
        for target in LEVELS.into_iter().filter(|t| 10 * t < 7 * mesh.triangles.len()) {
            let (corners, error) = collapse(&flat(&mesh.triangles), &mesh.positions, &[], target);
            let corners = meshopt::optimize_vertex_cache(&corners, mesh.positions.len());
            levels.push((triangle_code(&corners, mesh.positions.len())?.0, corners.len() / 3, error));
        }
        Ok(MeshBytes { triangles: code, positions, levels, rules })
    }

    /// Encodes one deviation a vertex, in this mesh's order.
    pub fn field(&self, codes: &Codes, value: impl Fn(u32) -> (f64, NoValue)) -> Vec<u8> {
        let all: Vec<i32> = (0..self.rules.len() as u32)
            .map(|v| {
                let (d, reason) = value(v);
                codes.code(d, reason)
            })
            .collect();
        let at = |v: u32| all[v as usize];
        pack(
            self.rules.iter().zip(0..).map(|(rule, v)| at(v).wrapping_sub(rule.value(at))),
            all.len(),
            codes.bytes,
        )
    }
}

/// The code, and the triangles as a reader gets them back (each may start at another corner).
fn triangle_code(corners: &[u32], vertices: usize) -> Result<(Vec<u8>, Vec<[u32; 3]>), meshopt::Error> {
    let code = meshopt::encode_index_buffer(corners, vertices)?;
    let read = meshopt::decode_index_buffer::<u32>(&code, corners.len())?;
    Ok((code, triples(&read)))
}

/// Collapses edges until at most about `triangles` are left. The error is in millimetres.
fn collapse(corners: &[u32], positions: &[Point], locked: &[u32], triangles: usize) -> (Vec<u32>, f64) {
    let bounds = Aabb::of(positions);
    // Single precision only after the corner of the box is taken off.
    let near: Vec<[f32; 3]> =
        positions.iter().map(|p| std::array::from_fn(|k| (p[k] - bounds.min[k]) as f32)).collect();
    let Ok(vertices) = VertexDataAdapter::new(meshopt::typed_to_bytes(&near), 12, 0) else {
        return (corners.to_vec(), 0.0);
    };
    let mut locks = vec![false; positions.len()];
    locked.iter().for_each(|v| locks[*v as usize] = true);
    let mut error = 0.0f32;
    let options = SimplifyOptions::ErrorAbsolute;
    let left = meshopt::simplify_with_locks(
        corners,
        &vertices,
        &locks,
        3 * triangles,
        f32::MAX,
        options,
        Some(&mut error),
    );
    (left, f64::from(error))
}

fn flat(triangles: &[[u32; 3]]) -> Vec<u32> {
    triangles.iter().flatten().copied().collect()
}

fn triples(corners: &[u32]) -> Vec<[u32; 3]> {
    corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wavy sheet of `n` × `n` squares, some vertices doubled, some faces broken.
    fn sheet(n: u32) -> Mesh {
        let mut mesh = Mesh::default();
        for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (f64::from(i), f64::from(j)))) {
            mesh.positions.push([i, j, (0.3 * i).sin() * (0.2 * j).cos()]);
        }
        let at = |i: u32, j: u32| i * (n + 1) + j;
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.faces.extend([[a, b, c], [a, c, d]]);
        }
        let copy = mesh.positions.len() as u32;
        mesh.positions.extend([mesh.positions[0], [f64::NAN; 3]]);
        mesh.faces[0][0] = copy;
        mesh.faces.extend([[0, 1, copy + 1], [0, 1, 99_999], [0, 1, 1]]);
        mesh
    }

    fn unpack(bytes: &[u8], count: usize, plane: usize) -> Vec<i32> {
        let folded =
            |i: usize| i32::from(bytes[plane * count + i]) | (i32::from(bytes[(plane + 1) * count + i]) << 8);
        (0..count).map(|i| (folded(i) >> 1) ^ -(folded(i) & 1)).collect()
    }

    /// Reads back what was packed, as the page's script does.
    #[test]
    fn positions_and_values_come_back() {
        let mesh = sheet(40);
        let ordered = Ordered::of(&mesh, &[], usize::MAX);
        assert_eq!((ordered.positions.len(), ordered.triangles.len()), (41 * 41, 2 * 40 * 40));
        let grid = Grid::over(&Aabb::of(&ordered.positions), 16);
        let bytes = MeshBytes::of(&ordered, &grid).unwrap();
        let corners =
            meshopt::decode_index_buffer::<u32>(&bytes.triangles, 3 * ordered.triangles.len()).unwrap();
        let (count, rules) = (ordered.positions.len(), rules(&triples(&corners), ordered.positions.len()));
        for k in 0..3 {
            let mut read: Vec<i32> = vec![];
            for (v, d) in unpack(&bytes.positions, count, 2 * k).into_iter().enumerate() {
                let place = rules[v].position(|u| read[u as usize]) + d;
                read.push(place & 0xffff);
                assert_eq!(read[v], i32::from(grid.place(&ordered.positions[v])[k]));
            }
        }
        let value = |v: u32| ordered.positions[v as usize][2];
        let codes = Codes::for_values(&[1.0], 2.0);
        let field = bytes.field(&codes, |v| (value(v), NoValue::Unknown));
        let mut read: Vec<i32> = vec![];
        for (v, d) in unpack(&field, count, 0).into_iter().enumerate() {
            read.push(rules[v].value(|u| read[u as usize]) + d);
            assert!((f64::from(read[v]) * codes.step - value(v as u32)).abs() <= 0.5001 * codes.step);
        }
    }

    #[test]
    fn collapsing_keeps_what_must_stay() {
        let mesh = sheet(60);
        let ordered = Ordered::of(&mesh, &[1234], 1000);
        assert!(ordered.triangles.len() <= 1100 && ordered.error > 0.0, "{}", ordered.triangles.len());
        assert!(ordered.positions.contains(&mesh.positions[1234]));
    }
}
