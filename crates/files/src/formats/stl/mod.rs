//! STL: triangles without connections, in bytes or in words.

mod ascii;
mod binary;
mod write;

use crate::{
    Warning,
    assemble::{self, Corner},
    detect::is_text,
    error::{Fault, Result},
    format::{Format, Head, Parsed},
    open::{ReadOptions, Weld},
    source::Source,
    unicode::without_mark,
};
use binary::{HEADER, RECORD};
use rayon::prelude::*;

/// STL, binary and ASCII.
pub(crate) const STL: Format = Format {
    name: "stl",
    extensions: &["stl", "stla", "stlb"],
    written_as: &["stl"],
    manual: include_str!("stl.md"),
    sniff,
    read: Some(read),
    points: None,
    mesh: Some(write::mesh),
};

fn sniff(head: &Head) -> bool {
    let declared = binary::declared(head.bytes);
    match (declared, head.length) {
        (Some(n), Some(length)) if length == HEADER as u64 + n * RECORD as u64 => true,
        // The length of a stream is not known: is this a count, and a facet after it?
        (Some(n), None) if n > 0 && !is_text(head.bytes) => binary::plausible(head.bytes),
        _ => looks_ascii(head.bytes),
    }
}

fn looks_ascii(bytes: &[u8]) -> bool {
    let text = without_mark(bytes).trim_ascii_start();
    let solid = text.get(..5).is_some_and(|w| w.eq_ignore_ascii_case(b"solid"));
    // Some binary files begin with "solid" too: their records show as control characters.
    solid && is_text(&bytes[..bytes.len().min(1024)])
}

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let bytes = source.feed.all()?;
    let declared = binary::declared(bytes);
    let exact = declared.is_some_and(|n| bytes.len() as u64 == HEADER as u64 + n * RECORD as u64);
    let text = !exact && is_text(&bytes[..bytes.len().min(1024)]);
    if text && looks_ascii(bytes) {
        let ascii::Read { facets, warnings } = ascii::read(bytes)?;
        return mesh("stl-ascii", &facets, options, warnings);
    }
    if text {
        return Err(Fault::unexpected("STL: the word \"solid\" or a binary header", bytes).at_line(1));
    }
    let (records, warnings) = binary::records(bytes)?;
    mesh("stl-binary", records, options, warnings)
}

/// A facet of either kind of file.
trait Facet: Copy + Send + Sync {
    /// Position in the precision of the file.
    type Position: Corner;
    fn corner(&self, k: usize) -> Self::Position;
    /// The stored normal, which may be anything.
    fn normal(&self) -> [f32; 3];
    /// Whether all corners are finite.
    fn finite(&self) -> bool;
}

/// Facets of one task.
const CHUNK: usize = 1 << 13;

/// The mesh of all facets but those that are not finite.
fn mesh<F: Facet>(
    variant: &'static str,
    facets: &[F],
    options: &ReadOptions,
    mut warnings: Vec<Warning>,
) -> Result<Parsed> {
    let bad = not_finite(facets);
    let kept: Vec<F>;
    let mut good = facets;
    if let Some(&first) = bad.first() {
        warnings.push(Warning::NonFiniteFacets { count: bad.len() as u64, first: first as u64 + 1 });
        kept = facets.iter().filter(|f| f.finite()).copied().collect();
        good = &kept;
    }
    let mesh = crate::SourceMesh {
        mesh: assemble::corners(good.len(), |f, k| good[f].corner(k), options.weld != Weld::None)?,
        stored_normals: Some(good.par_iter().map(F::normal).collect()),
        nonfinite_facets: bad.len() as u64,
    };
    Ok(Parsed::mesh(variant, mesh, warnings))
}

/// Numbers of the facets with a coordinate that is not finite, ascending.
fn not_finite<F: Facet>(facets: &[F]) -> Vec<usize> {
    let parts = facets.par_chunks(CHUNK).enumerate();
    let found = parts.flat_map_iter(|(i, part)| {
        let bad = part.iter().enumerate().filter(|(_, f)| !f.finite());
        bad.map(move |(j, _)| i * CHUNK + j)
    });
    found.collect()
}
