//! A grid about the reference that tells at once how far a place is from it, about: for trying very many poses.
//!
//! A cell is 8 bytes, and samples are tried eight at a time in single precision. First come the places of all eight, then their
//! cells at once, then their scores. The grid of a part then lies in the second-level cache, and the loads of a block go side
//! by side. All is in units of cells. No operation is fused or put in another order: all levels give the same bits.

use super::sample::Samples;
use crate::closest::{Query, QueryError, Tree};
use crate::mesh::Mesh;
use crate::progress::Progress;
use crate::rigid::Rigid;
use crate::simd::widest::widest;
use crate::space::{Aabb, Point, Vector, cross, dot, minus, times, unit};

/// Cells along the diagonal of the reference's box.
const CELLS_PER_DIAGONAL: f64 = 72.0;
/// The greatest number of a cell.
const MAX_CELL_NUMBER: f64 = 32767.0;
/// Samples that are tried at once.
pub(super) const SAMPLES_PER_BLOCK: usize = 8;
/// Added to a number below 2²², it leaves the nearest whole number in the last bits.
const WHOLE_NUMBER_SHIFT: f32 = 12_582_912.0;

/// The surface near the middle of a cell: its distance along the normal, in steps of [`Field::step`], and the normal of the
/// nearest facet. All four numbers have 16 bits each, from the least. Where the surface is beyond reach: as far as can be told.
type Cell = u64;

/// Distances near a mesh.
pub(super) struct Field {
    low: Point,
    /// Cells a millimeter.
    scale: f64,
    counts: [usize; 3],
    /// The last one is for all places outside of the grid.
    cells: Vec<Cell>,
    /// Cells a step of a cell's distance.
    step: f32,
    /// Distance beyond which a place does not count.
    pub reach: f64,
}

fn cell_of(steps: f64, normal: Vector) -> Cell {
    let part = |x: f64| u64::from(x.round().clamp(-MAX_CELL_NUMBER, MAX_CELL_NUMBER) as i16 as u16);
    part(steps)
        | part(MAX_CELL_NUMBER * normal[0]) << 16
        | part(MAX_CELL_NUMBER * normal[1]) << 32
        | part(MAX_CELL_NUMBER * normal[2]) << 48
}

impl Field {
    /// The field of the mesh of `tree`, as far as `reach`. Cost: some ten thousand closest points.
    pub fn new(tree: &Tree, bounds: &Aabb, reach: f64, progress: &dyn Progress) -> Result<Field, QueryError> {
        let cell = bounds.diagonal() / CELLS_PER_DIAGONAL;
        let low = bounds.min.map(|x| x - reach - cell);
        let counts = bounds.sides().map(|s| ((s + 2.0 * reach) / cell) as usize + 3);
        let middle = |i: usize| {
            let (x, rest) = (i % counts[0], i / counts[0]);
            let at = [x, rest % counts[1], rest / counts[1]];
            std::array::from_fn(|k| low[k] + (at[k] as f64 + 0.5) * cell)
        };
        let middles: Vec<Point> = (0..counts.iter().product()).map(middle).collect();
        // Twice of what is looked for is as far as can be told: beyond reach from everywhere in the cell.
        let step = 2.0 * (reach + cell) / MAX_CELL_NUMBER;
        let far = cell_of(MAX_CELL_NUMBER, [0.0; 3]);
        let query = Query { max_distance: reach + cell, ..Query::default() };
        let mut cells = tree.map_closest(&middles, &query, progress, |i, hit| {
            let Some(hit) = hit else { return far };
            let foot = tree.foot(&middles[i], &hit);
            let Some(normal) = normal_of(&foot.corners) else { return far };
            let away = minus(middles[i], foot.point);
            // Beside a rim the distance is longer than its share along the normal.
            let height = hit.distance().copysign(dot(away, normal));
            cell_of(height / step, normal)
        })?;
        cells.push(far);
        Ok(Field { low, scale: 1.0 / cell, counts, cells, step: (step / cell) as f32, reach })
    }

    /// The same as numbers of cells, for blocks about `middle`.
    pub fn placed(&self, pose: &Rigid, middle: Point) -> Placed {
        let rows = pose.rotation();
        let middle = pose.point(middle);
        Placed {
            turn: rows.map(|r| r.map(|x| x as f32)),
            rows: rows.map(|r| r.map(|x: f64| (x * self.scale) as f32)),
            shift: std::array::from_fn(|k| ((middle[k] - self.low[k]) * self.scale - 0.5) as f32),
        }
    }

    /// How well samples fit the surface, one after the other. Each adds 1 where it lies on the surface, and 0 beyond `reach` of
    /// it or turned away.
    pub fn score(&self, placed: &Placed, blocks: &[SampleBlock], reach: f64) -> f64 {
        let per_reach = (1.0 / (reach * self.scale)) as f32;
        let sums = scores(self, placed, blocks, per_reach);
        sums.iter().map(|s| f64::from(*s)).sum()
    }
}

/// A pose in units of cells.
pub(super) struct Placed {
    /// Rotation, and the same with millimeters made cells.
    turn: [[f32; 3]; 3],
    rows: [[f32; 3]; 3],
    /// Where the middle of the samples comes to lie, from the middle of the first cell.
    shift: [f32; 3],
}

/// Some samples, side by side.
#[derive(Clone, Debug, Default)]
pub(super) struct SampleBlock {
    /// From a middle, millimeters.
    points: [[f32; SAMPLES_PER_BLOCK]; 3],
    normals: [[f32; SAMPLES_PER_BLOCK]; 3],
    /// The least cosine of the angle between normals; none agrees with what fills up the last block.
    least: [f32; SAMPLES_PER_BLOCK],
    /// 1 where the normal may point either way, else 0.
    either: f32,
}

impl SampleBlock {
    /// All samples, from `middle`.
    pub fn of(samples: &Samples, middle: Point) -> Vec<SampleBlock> {
        let parts = samples.points.chunks(SAMPLES_PER_BLOCK).zip(samples.normals.chunks(SAMPLES_PER_BLOCK));
        let block = |(points, normals): (&[Point], &[Vector])| {
            let mut block = SampleBlock {
                least: [f32::INFINITY; SAMPLES_PER_BLOCK],
                either: if samples.oriented { 0.0 } else { 1.0 },
                ..SampleBlock::default()
            };
            for (l, (p, n)) in points.iter().zip(normals).enumerate() {
                let p = minus(*p, middle);
                for k in 0..3 {
                    block.points[k][l] = p[k] as f32;
                    block.normals[k][l] = n[k] as f32;
                }
                // No normal agrees with all.
                block.least[l] = if *n == [0.0; 3] { -1.0 } else { SAME_PLACE_COSINE };
            }
            block
        };
        parts.map(block).collect()
    }
}

widest! {
    /// The sums of the worths of every eighth sample.
    fn scores[][](field: &Field, placed: &Placed, blocks: &[SampleBlock], per_reach: f32) -> [f32; SAMPLES_PER_BLOCK] = {
        let mut sums = [0.0f32; SAMPLES_PER_BLOCK];
        let outside = field.cells.len() - 1;
        let counts = field.counts.map(|c| c as u32);
        for block in blocks {
            let [x, y, z] = &block.points;
            let (mut index, mut off) = ([[0u32; SAMPLES_PER_BLOCK]; 3], [[0.0f32; SAMPLES_PER_BLOCK]; 3]);
            for k in 0..3 {
                let r = placed.rows[k];
                for l in 0..SAMPLES_PER_BLOCK {
                    // So far off that nothing is there, but no farther than what can be rounded.
                    let at = (r[0] * x[l] + r[1] * y[l] + r[2] * z[l] + placed.shift[k]).clamp(-1e6, 1e6);
                    let whole = at + WHOLE_NUMBER_SHIFT;
                    index[k][l] = whole.to_bits().wrapping_sub(WHOLE_NUMBER_SHIFT.to_bits());
                    off[k][l] = at - (whole - WHOLE_NUMBER_SHIFT);
                }
            }
            let mut number = [0u32; SAMPLES_PER_BLOCK];
            for l in 0..SAMPLES_PER_BLOCK {
                let inside = (index[0][l] < counts[0]) & (index[1][l] < counts[1]) & (index[2][l] < counts[2]);
                let n = index[2][l].wrapping_mul(counts[1]).wrapping_add(index[1][l]);
                let n = n.wrapping_mul(counts[0]).wrapping_add(index[0][l]);
                number[l] = if inside { n } else { u32::MAX };
            }
            let mut cells = [0u64; SAMPLES_PER_BLOCK];
            for l in 0..SAMPLES_PER_BLOCK {
                cells[l] = field.cells[(number[l] as usize).min(outside)];
            }
            let [x, y, z] = &block.normals;
            let (mut height, mut cosine) = ([0.0f32; SAMPLES_PER_BLOCK], [0.0f32; SAMPLES_PER_BLOCK]);
            for l in 0..SAMPLES_PER_BLOCK {
                height[l] = f32::from(cells[l] as i16) * field.step;
            }
            for k in 0..3 {
                let r = placed.turn[k];
                for l in 0..SAMPLES_PER_BLOCK {
                    let n = f32::from((cells[l] >> (16 * (k + 1))) as i16) * (1.0 / MAX_CELL_NUMBER as f32);
                    height[l] += off[k][l] * n;
                    cosine[l] += (r[0] * x[l] + r[1] * y[l] + r[2] * z[l]) * n;
                }
            }
            for l in 0..SAMPLES_PER_BLOCK {
                let share = height[l] * per_reach;
                let score = (1.0 - share * share).max(0.0);
                let agrees = cosine[l].max(-cosine[l] * block.either) >= block.least[l];
                sums[l] += if agrees { score } else { 0.0 };
            }
        }
        sums
    }
}

/// Cosine of the largest angle between the normals of one place.
const SAME_PLACE_COSINE: f32 = 0.35;

/// Unit normal of a face; `None` where it has no area.
pub(super) fn facet_normal(mesh: &Mesh, face: u32) -> Option<Vector> {
    normal_of(&mesh.corners(face))
}

/// Unit normal of a triangle; `None` where it has no area.
#[inline(always)]
pub(super) fn normal_of(&[a, b, c]: &[Point; 3]) -> Option<Vector> {
    let (u, v) = (minus(b, a), minus(c, a));
    // Edges near unit length, so that tiny facets do not underflow.
    let size = u.iter().chain(&v).fold(0.0f64, |m, x| m.max(x.abs()));
    unit(cross(times(1.0 / size, u), times(1.0 / size, v))).map(|n| n.0)
}
