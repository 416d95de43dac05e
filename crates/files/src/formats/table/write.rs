//! Writes rows of numbers.

use crate::{
    AtomicFile,
    error::WriteFault,
    format::sink::{Block, Layout, PointsSink},
    number::push_number,
};
use std::io::Write;
use trueness_geom::parallel::prelude::*;

/// One task makes this many rows into text.
const TEXT_ROWS_PER_TASK: usize = 1 << 13;

/// How rows are written.
#[derive(Clone, Copy)]
struct Style {
    /// The beginning of the header line.
    header: &'static str,
    separator: u8,
    /// The text of a missing number.
    nothing: &'static str,
}

impl Style {
    fn of(extension: &str) -> Style {
        match extension {
            "csv" => Style { header: "", separator: b',', nothing: "" },
            "tsv" => Style { header: "", separator: b'\t', nothing: "" },
            // Blanks cannot part an empty column from the next.
            _ => Style { header: "# ", separator: b' ', nothing: "nan" },
        }
    }
}

/// Begins the file with its header line.
pub(super) fn begin(
    mut file: AtomicFile,
    layout: Layout,
    extension: &str,
) -> Result<Box<dyn PointsSink>, WriteFault> {
    let style = Style::of(extension);
    let mut names = vec!["x", "y", "z"];
    if layout.deviation {
        names.push("deviation");
    }
    if layout.reason {
        names.push("excluded");
    }
    if layout.face {
        names.push("face");
    }
    if layout.color {
        names.extend(["red", "green", "blue"]);
    }
    let names = names.join(&char::from(style.separator).to_string());
    writeln!(file, "{}{names}", style.header)?;
    Ok(Box::new(Rows { file, style }))
}

struct Rows {
    file: AtomicFile,
    style: Style,
}

impl PointsSink for Rows {
    fn write(&mut self, block: &Block) -> Result<(), WriteFault> {
        let starts: Vec<usize> = (0..block.points.len()).step_by(TEXT_ROWS_PER_TASK).collect();
        let style = self.style;
        // A few parts at a time, so that the text does not outgrow the numbers.
        for group in starts.chunks(4 * rayon::current_num_threads().max(1)) {
            let texts: Vec<Vec<u8>> = group.par_iter().map(|start| rows(block, *start, style)).collect();
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

/// Rows from `start` on. The shortest digits that give the same number back.
fn rows(block: &Block, start: usize, style: Style) -> Vec<u8> {
    let mut text = Vec::with_capacity(TEXT_ROWS_PER_TASK * 64);
    for i in start..block.points.len().min(start + TEXT_ROWS_PER_TASK) {
        let [x, y, z] = block.points[i];
        for (k, v) in [x, y, z].iter().chain(block.deviation.get(i)).enumerate() {
            if k > 0 {
                text.push(style.separator);
            }
            if v.is_finite() { push_number(&mut text, *v) } else { text.extend(style.nothing.bytes()) }
        }
        // Writing to a vector cannot fail.
        if let Some(reason) = block.reason.get(i) {
            text.push(style.separator);
            let _ = write!(text, "{reason}");
        }
        if let Some(face) = block.face.get(i) {
            text.push(style.separator);
            let _ = match face {
                Some(face) => write!(text, "{face}"),
                None => write!(text, "{}", style.nothing),
            };
        }
        for c in block.color.get(i).into_iter().flatten() {
            text.push(style.separator);
            let _ = write!(text, "{c}");
        }
        text.push(b'\n');
    }
    text
}
