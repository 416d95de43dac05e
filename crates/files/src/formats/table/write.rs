//! Writes CSV.

use crate::{
    AtomicFile,
    error::WriteFault,
    write::{Block, Layout, PointsSink, push_number},
};
use rayon::prelude::*;
use std::io::Write;

/// Rows made into text by one task.
const CHUNK: usize = 1 << 13;

/// Begins the file with its header line.
pub(super) fn begin(mut file: AtomicFile, layout: Layout) -> Result<Box<dyn PointsSink>, WriteFault> {
    let mut header = String::from("x,y,z");
    if layout.deviation {
        header.push_str(",deviation");
    }
    if layout.colour {
        header.push_str(",red,green,blue");
    }
    header.push('\n');
    file.write_all(header.as_bytes())?;
    Ok(Box::new(Csv { file }))
}

struct Csv {
    file: AtomicFile,
}

impl PointsSink for Csv {
    fn write(&mut self, block: &Block) -> Result<(), WriteFault> {
        let starts: Vec<usize> = (0..block.points.len()).step_by(CHUNK).collect();
        // A few parts at a time, so that the text does not outgrow the numbers.
        for group in starts.chunks(4 * rayon::current_num_threads().max(1)) {
            let texts: Vec<Vec<u8>> = group.par_iter().map(|start| rows(block, *start)).collect();
            for text in texts {
                self.file.write_all(&text)?;
            }
        }
        Ok(())
    }
    fn finish(self: Box<Self>) -> Result<AtomicFile, WriteFault> {
        Ok(self.file)
    }
}

/// Rows from `start` on. The shortest digits that give the same number back; nothing where there is no number.
fn rows(block: &Block, start: usize) -> Vec<u8> {
    let mut text = Vec::with_capacity(CHUNK * 64);
    for i in start..block.points.len().min(start + CHUNK) {
        let [x, y, z] = block.points[i];
        for (k, v) in [x, y, z].iter().chain(block.deviation.get(i)).enumerate() {
            if k > 0 {
                text.push(b',');
            }
            if v.is_finite() {
                push_number(&mut text, *v);
            }
        }
        if let Some(colour) = block.colour.get(i) {
            for c in colour {
                // Writing to a vector cannot fail.
                let _ = write!(text, ",{c}");
            }
        }
        text.push(b'\n');
    }
    text
}
