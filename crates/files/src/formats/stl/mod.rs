//! STL: triangles without connections, in bytes or in words.

mod ascii;
mod binary;
mod facet;
mod write;

use crate::{
    Warning, assemble,
    error::{Fault, Result},
    format::{Format, Head, Parsed, ReadOptions, Weld},
    lines::{is_text, without_mark},
    source::{HEAD, Source},
    unicode::no_zeros,
};
use binary::{HEADER, RECORD};
use facet::Facet;
use trueness_geom::parallel::prelude::*;

/// STL, binary and ASCII.
pub(crate) const STL: Format = Format {
    name: "stl",
    extensions: &["stl", "stla", "stlb"],
    written_as: &["stl"],
    manual: include_str!("stl.md"),
    columns: false,
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
    source.feed.ahead(HEAD)?;
    let length = match source.feed.left() {
        Some(length) => length,
        None => source.feed.all()?.len() as u64,
    };
    let head = source.feed.ahead(HEAD)?;
    let exact = binary::declared(head).is_some_and(|n| length == HEADER as u64 + n * RECORD as u64);
    let text = !exact && is_text(&head[..head.len().min(1024)]);
    if text && looks_ascii(head) {
        let bytes = source.feed.all()?;
        no_zeros(bytes)?;
        let ascii::Read { facets, warnings } = ascii::read(bytes)?;
        return mesh("stl-ascii", &facets, options, warnings);
    }
    if text {
        return Err(Fault::unexpected("STL: the word \"solid\" or a binary header", head).at_line(1));
    }
    // Before the file is read as a whole: it may be far longer than what it declares.
    let (facets, warnings) = binary::facets(head, length)?;
    let bytes = source.feed.ahead(HEADER + facets * RECORD)?;
    let records = bytes.get(HEADER..).unwrap_or_default().as_chunks().0;
    mesh("stl-binary", records.get(..facets).unwrap_or(records), options, warnings)
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
        warnings.push(Warning::NonFiniteFacets { count: bad.len() as u64, first: first as u64 });
        kept = facets.iter().filter(|f| f.finite()).copied().collect();
        good = &kept;
    }
    let mesh = crate::SourceMesh {
        mesh: assemble::corners(good.len(), |f, k| good[f].corner(k), options.weld != Weld::None)?,
        stored_normals: Some(good.par_iter().map(F::normal).collect()),
        nonfinite_facets: bad.into_iter().map(|f| f as u32).collect(),
        unread: vec![],
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
