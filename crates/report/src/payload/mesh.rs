//! A mesh and its deviations as blobs.

use super::super::ReportError;
use super::super::no_value::NoValue;
use super::field::Codes;
use super::grid::Grid;
use super::order;
use super::planes::pack;
use super::predict::{Rule, rules};
use super::simplify::Places;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::space::Point;

/// Triangles of the coarser levels, where the mesh has clearly more.
const LEVEL_TRIANGLES: [usize; 3] = [600_000, 150_000, 40_000];

/// A mesh whose vertices stand in the order in which its triangles first use them.
pub struct Ordered {
    /// Corners.
    pub triangles: Vec<[u32; 3]>,
    /// Places, millimeters.
    pub positions: Vec<Point>,
    /// For each vertex its number in the mesh that came in.
    pub source: Vec<u32>,
    /// Bound of what simplification moved the surface by, millimeters; 0 when nothing was left out.
    pub error: f64,
}

/// What may be left out of a mesh, and what not.
pub struct Wanted<'a> {
    /// Vertices that stay.
    pub keep: &'a [u32],
    /// Triangles at most.
    pub limit: usize,
    /// Vertices at the same place may become one.
    pub join: bool,
}

impl Ordered {
    /// Takes the drawable triangles of a mesh: all corners exist, are finite and differ. Where there are more than the limit,
    /// edges are collapsed onto existing vertices.
    pub fn of(mesh: &Mesh, wanted: &Wanted, progress: &dyn Progress) -> Result<Ordered, Cancelled> {
        let one =
            if wanted.join { joined(&mesh.positions) } else { (0..mesh.positions.len() as u32).collect() };
        let finite =
            |c: &u32| mesh.positions.get(*c as usize).is_some_and(|p| p.iter().all(|x| x.is_finite()));
        let drawable = |f: &&[u32; 3]| f.iter().all(finite);
        let mut corners: Vec<u32> = mesh
            .faces
            .par_iter()
            .filter(drawable)
            .map(|f| f.map(|v| one[v as usize]))
            .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            .flat_map_iter(|t| t)
            .collect();
        let mut error = 0.0;
        if corners.len() / 3 > wanted.limit {
            let mut locks = vec![false; mesh.positions.len()];
            for v in wanted.keep.iter().filter_map(|k| one.get(*k as usize)) {
                locks[*v as usize] = true;
            }
            let places = Places::of(&mesh.positions);
            (corners, error) = places.simplify(&corners, &locks, wanted.limit, progress)?;
        }
        Ok(Ordered::from_corners(&order::for_cache(&corners, progress)?, &mesh.positions, error))
    }

    /// Numbers the vertices as they are first used.
    fn from_corners(corners: &[u32], positions: &[Point], error: f64) -> Ordered {
        let mut number = vec![u32::MAX; positions.len()];
        let mut source = vec![];
        let mut renumbered = Vec::with_capacity(corners.len());
        for &old in corners {
            let number = &mut number[old as usize];
            if *number == u32::MAX {
                *number = source.len() as u32;
                source.push(old);
            }
            renumbered.push(*number);
        }
        Ordered {
            triangles: triples(&renumbered),
            positions: source.iter().map(|o| positions[*o as usize]).collect(),
            source,
            error,
        }
    }
}

/// For each vertex the lowest one at the same place; −0 is 0.
fn joined(positions: &[Point]) -> Vec<u32> {
    let key = |v: &u32| positions[*v as usize].map(|x| (x + 0.0).to_bits());
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.par_sort_unstable_by_key(|v| (key(v), *v));
    let mut one = vec![0; positions.len()];
    for group in order.chunk_by(|a, b| key(a) == key(b)) {
        group.iter().for_each(|v| one[*v as usize] = group[0]);
    }
    one
}

/// A mesh as bytes, before compression.
pub struct MeshBytes {
    /// Triangle code of EXT_meshopt_compression.
    pub triangles: Vec<u8>,
    /// Differences from the prediction, x then y then z.
    pub positions: Vec<u8>,
    rules: Vec<Rule>,
}

impl MeshBytes {
    /// Encodes triangles and positions on `grid`.
    pub fn of(mesh: &Ordered, grid: &Grid) -> Result<MeshBytes, ReportError> {
        let (code, read) = triangle_code(&flat(&mesh.triangles), mesh.positions.len())?;
        let rules = rules(&read, mesh.positions.len());
        let places: Vec<[u16; 3]> = mesh.positions.par_iter().map(|p| grid.place(p)).collect();
        let coordinate = |k: usize| {
            let at = |v: u32| i32::from(places[v as usize][k]);
            pack(rules.par_iter().enumerate().map(|(v, rule)| at(v as u32) - rule.position(at)), 2)
        };
        let positions = [0, 1, 2].map(coordinate).concat();
        Ok(MeshBytes { triangles: code, positions, rules })
    }

    /// Encodes one deviation a vertex, in this mesh's order.
    pub fn field(&self, codes: &Codes, value: impl Fn(u32) -> (f64, NoValue) + Sync) -> Vec<u8> {
        let all: Vec<i32> = (0..self.rules.len() as u32)
            .into_par_iter()
            .map(|v| {
                let (d, reason) = value(v);
                codes.code(d, reason)
            })
            .collect();
        self.numbers(&all, codes.bytes)
    }

    /// Encodes one whole number a vertex, in this mesh's order, in so many bytes.
    pub fn numbers(&self, all: &[i32], bytes: usize) -> Vec<u8> {
        let at = |v: u32| all[v as usize];
        let differences =
            self.rules.par_iter().enumerate().map(|(v, rule)| at(v as u32).wrapping_sub(rule.value(at)));
        pack(differences, bytes)
    }
}

/// Triangles of the levels that a mesh gets.
pub fn level_sizes(triangles: usize) -> impl Iterator<Item = usize> {
    LEVEL_TRIANGLES.into_iter().filter(move |t| 10 * t < 7 * triangles)
}

/// Coarser index lists over the same vertices, each made from the one before: code, triangles, error in millimeters.
pub fn levels(mesh: &Ordered, progress: &dyn Progress) -> Result<Vec<(Vec<u8>, usize, f64)>, ReportError> {
    let places = Places::of(&mesh.positions);
    let locks = vec![false; mesh.positions.len()];
    let (mut corners, mut error) = (flat(&mesh.triangles), 0.0);
    let mut levels = vec![];
    for target in level_sizes(mesh.triangles.len()) {
        let (left, more) = places.simplify(&corners, &locks, target, progress)?;
        error += more;
        corners = order::for_cache(&left, progress)?;
        let (code, _) = triangle_code(&corners, mesh.positions.len())?;
        levels.push((code, corners.len() / 3, error));
    }
    Ok(levels)
}

/// The code, and the triangles as a reader gets them back (each may start at another corner).
fn triangle_code(corners: &[u32], vertices: usize) -> Result<(Vec<u8>, Vec<[u32; 3]>), ReportError> {
    let failed = |e: meshopt::Error| ReportError::Encoding(e.to_string());
    let code = meshopt::encode_index_buffer(corners, vertices).map_err(failed)?;
    let read = meshopt::decode_index_buffer::<u32>(&code, corners.len()).map_err(failed)?;
    Ok((code, triples(&read)))
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
    use trueness_geom::progress::Silent;
    use trueness_geom::space::Aabb;

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
        let ordered =
            Ordered::of(&mesh, &Wanted { keep: &[], limit: usize::MAX, join: true }, &Silent).unwrap();
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
        let ordered =
            Ordered::of(&mesh, &Wanted { keep: &[1234], limit: 1000, join: true }, &Silent).unwrap();
        assert!(ordered.triangles.len() <= 1100 && ordered.error > 0.0, "{}", ordered.triangles.len());
        assert!(ordered.positions.contains(&mesh.positions[1234]));
    }
}
