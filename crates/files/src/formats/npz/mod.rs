//! NPZ: arrays of NumPy in an archive.

mod zip;

use crate::{
    AtomicFile,
    error::WriteFault,
    format::{
        Format, Head,
        columns::Columns,
        sink::{Block, Layout, PointsSink},
        spool::Spool,
        values::Values,
    },
};
use trueness_geom::space::Point;
use zip::Archive;

/// Archive of NumPy arrays.
pub(crate) const NPZ: Format = Format {
    name: "npz",
    known_as: &["NPZ"],
    extensions: &[],
    written_as: &["npz"],
    manual: include_str!("npz.md"),
    holds: &[],
    columns: false,
    sniff: |_: &Head| false,
    read: None,
    model: None,
    points: Some(begin),
    mesh: None,
};

/// The header of an array takes this many bytes: a multiple of 64, as NumPy wants it, with room for any shape.
const ARRAY_HEADER_BYTES: usize = 128;

/// The header of an array of `rows` rows.
fn header(descr: &str, rows: u64, width: Option<u32>) -> Vec<u8> {
    let shape = width.map_or(format!("({rows},)"), |w| format!("({rows}, {w})"));
    let dictionary = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((ARRAY_HEADER_BYTES as u16 - 10).to_le_bytes());
    bytes.extend(dictionary.as_bytes());
    bytes.resize(ARRAY_HEADER_BYTES - 1, b' ');
    bytes.push(b'\n');
    bytes
}

fn begin(file: AtomicFile, layout: Layout, _: &str) -> Result<Box<dyn PointsSink>, WriteFault> {
    let columns = Columns::beside(&file, layout);
    let mut archive = Archive::new(file);
    // The shape is written again when the points are counted.
    archive.begin("points.npy", ARRAY_HEADER_BYTES)?;
    Ok(Box::new(Arrays { archive, columns }))
}

struct Arrays {
    archive: Archive,
    columns: Columns,
}

impl PointsSink for Arrays {
    fn write(&mut self, block: &Block) -> Result<(), WriteFault> {
        self.columns.write(block, |bytes| self.archive.write(bytes))
    }

    fn finish(mut self: Box<Self>) -> Result<AtomicFile, WriteFault> {
        let Columns { layout, count: rows, deviation, excluded, color } = &mut self.columns;
        let rows = *rows;
        self.archive.end(&header("<f8", rows, Some(3)))?;
        let mut add = |name: &str, descr: &str, width: Option<u32>, values: &mut Spool| {
            self.archive.begin(name, ARRAY_HEADER_BYTES)?;
            values.play(|bytes| self.archive.write(bytes))?;
            self.archive.end(&header(descr, rows, width))
        };
        if layout.deviation {
            add("deviation.npy", "<f8", None, deviation)?;
            let kind = if layout.reason { "|u1" } else { "|b1" };
            add("excluded.npy", kind, None, excluded)?;
        }
        if layout.color {
            add("colour.npy", "|u1", Some(3), color)?;
        }
        Ok(self.archive.finish()?)
    }
}

/// Writes points, their facets, and an array of each of their numbers.
pub(crate) fn values<const N: usize>(
    file: AtomicFile,
    points: &[Point],
    faces: &[[u32; 3]],
    values: &Values<N>,
) -> Result<AtomicFile, WriteFault> {
    let mut archive = Archive::new(file);
    let count = points.len();
    let mut add = |name: &str, head: Vec<u8>, rows: usize, row: &dyn Fn(usize, &mut Vec<u8>)| {
        archive.begin(&format!("{name}.npy"), ARRAY_HEADER_BYTES)?;
        for start in (0..rows).step_by(1 << 14) {
            let mut bytes = vec![];
            (start..rows.min(start + (1 << 14))).for_each(|i| row(i, &mut bytes));
            archive.write(&bytes)?;
        }
        archive.end(&head)
    };
    let numbers = |of: &[f64], bytes: &mut Vec<u8>| of.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    add("points", header("<f8", count as u64, Some(3)), count, &|i, bytes| numbers(&points[i], bytes))?;
    for (k, name) in values.names.iter().enumerate() {
        add(name, header("<f8", count as u64, None), count, &|i, bytes| {
            numbers(&(values.of)(i)[k..=k], bytes)
        })?;
    }
    add("reason", header("|u1", count as u64, None), count, &|i, bytes| bytes.push((values.reason)(i)))?;
    add("colour", header("|u1", count as u64, Some(3)), count, &|i, bytes| bytes.extend((values.color)(i)))?;
    if !faces.is_empty() {
        let rows = faces.len();
        add("faces", header("<u4", rows as u64, Some(3)), rows, &|i, bytes| {
            faces[i].iter().for_each(|v| bytes.extend(v.to_le_bytes()));
        })?;
    }
    Ok(archive.finish()?)
}
