//! Writes binary PLY.

use crate::{
    AtomicFile,
    error::WriteFault,
    format::{
        corners::corner_positions,
        loss::Loss,
        sink::{Block, Layout, PointsSink},
    },
};
use std::io::{Seek, SeekFrom, Write};
use trueness_geom::mesh::Mesh;

/// This many rows become bytes at a time.
const PLY_ROWS_PER_WRITE: usize = 1 << 14;
/// Digits reserved for the number of points.
const COUNT_DIGITS: usize = 20;

/// The header of `count` vertices: always of the same length, so that it can be written again when they are counted.
fn header(layout: Layout, count: u64, faces: Option<usize>) -> String {
    let mut text =
        format!("ply\nformat binary_little_endian 1.0\ncomment millimetres\nelement vertex {count}\n");
    let digits = count.to_string().len();
    text.push_str("property double x\nproperty double y\nproperty double z\n");
    if layout.deviation {
        text.push_str("property double deviation\nproperty uchar excluded\n");
    }
    if layout.color {
        text.push_str("property uchar red\nproperty uchar green\nproperty uchar blue\n");
    }
    if let Some(faces) = faces {
        text.push_str(&format!("element face {faces}\nproperty list uchar uint vertex_indices\n"));
    }
    text.push_str(&format!("comment {}\nend_header\n", "-".repeat(COUNT_DIGITS - digits)));
    text
}

/// Begins the points.
pub(super) fn begin(
    mut file: AtomicFile,
    layout: Layout,
    _: &str,
) -> Result<Box<dyn PointsSink>, WriteFault> {
    file.write_all(header(layout, 0, None).as_bytes())?;
    Ok(Box::new(Rows { file, layout, count: 0 }))
}

struct Rows {
    file: AtomicFile,
    layout: Layout,
    count: u64,
}

impl PointsSink for Rows {
    fn write(&mut self, block: &Block) -> Result<(), WriteFault> {
        let mut bytes = Vec::new();
        for start in (0..block.points.len()).step_by(PLY_ROWS_PER_WRITE) {
            bytes.clear();
            for i in start..block.points.len().min(start + PLY_ROWS_PER_WRITE) {
                push(&mut bytes, &block.points[i]);
                if let Some(d) = block.deviation.get(i) {
                    bytes.extend(d.to_le_bytes());
                    bytes.push(block.reason.get(i).copied().unwrap_or(u8::from(d.is_nan())));
                }
                bytes.extend(block.color.get(i).into_iter().flatten());
            }
            self.file.write_all(&bytes)?;
        }
        self.count += block.points.len() as u64;
        Ok(())
    }
    fn finish(mut self: Box<Self>) -> Result<AtomicFile, WriteFault> {
        self.file.seek(SeekFrom::Start(0))?;
        self.file.write_all(header(self.layout, self.count, None).as_bytes())?;
        Ok(self.file)
    }
}

fn push(bytes: &mut Vec<u8>, numbers: &[f64]) {
    bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
}

/// Writes vertices and triangles.
pub(super) fn mesh(file: &mut AtomicFile, mesh: &Mesh) -> Result<Loss, WriteFault> {
    let header = header(Layout::default(), mesh.positions.len() as u64, Some(mesh.faces.len()));
    file.write_all(header.as_bytes())?;
    let mut bytes = Vec::new();
    for positions in mesh.positions.chunks(PLY_ROWS_PER_WRITE) {
        bytes.clear();
        push(&mut bytes, positions.as_flattened());
        file.write_all(&bytes)?;
    }
    for (i, faces) in mesh.faces.chunks(PLY_ROWS_PER_WRITE).enumerate() {
        bytes.clear();
        for (j, face) in faces.iter().enumerate() {
            corner_positions(mesh, i * PLY_ROWS_PER_WRITE + j, face)?;
            bytes.push(3);
            bytes.extend(face.iter().flat_map(|v| v.to_le_bytes()));
        }
        file.write_all(&bytes)?;
    }
    Ok(Loss::default())
}
