//! STL: triangles without connections, in bytes or in words.

mod ascii;
mod binary;
mod facet;
mod write;

use crate::{
    FacetRegions, Warning, assemble,
    error::{Fault, Result},
    format::{Format, Head, Holds, Parsed, ReadOptions, Weld},
    lines::{is_text, line_of, without_filling, without_mark},
    source::{SNIFFED_BYTES, Source},
    unicode::no_zeros,
};
use binary::{STL_HEADER_BYTES, STL_RECORD_BYTES};
use facet::Facet;
use trueness_geom::parallel::prelude::*;

/// STL, binary and ASCII.
pub(crate) const STL: Format = Format {
    name: "stl",
    known_as: &["STL"],
    extensions: &["stl", "stla", "stlb"],
    written_as: &["stl"],
    manual: include_str!("stl.md"),
    holds: &[Holds::Mesh],
    columns: false,
    sniff,
    read: Some(read),
    model: None,
    points: None,
    mesh: Some(write::mesh),
};

fn sniff(head: &Head) -> bool {
    let declared = binary::declared(head.bytes);
    match (declared, head.length) {
        (Some(n), Some(length)) if length == STL_HEADER_BYTES as u64 + n * STL_RECORD_BYTES as u64 => true,
        // The length of a stream is not known: is this a count, and a facet after it?
        (Some(n), None) if n > 0 && !is_text(head.bytes) => binary::plausible(head.bytes),
        _ => looks_ascii(head.bytes),
    }
}

fn looks_ascii(bytes: &[u8]) -> bool {
    let text = without_mark(bytes).trim_ascii_start();
    let solid = text.get(..5).is_some_and(|w| w.eq_ignore_ascii_case(b"solid"));
    // Some binary files begin with "solid" too: their records show as control characters.
    solid && begins_as_text(bytes)
}

fn begins_as_text(bytes: &[u8]) -> bool {
    let text = without_filling(bytes).0;
    is_text(&text[..text.len().min(1024)])
}

fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    source.feed.ahead(SNIFFED_BYTES)?;
    let length = match source.feed.left() {
        Some(length) => length,
        None => source.feed.all()?.len() as u64,
    };
    let head = source.feed.ahead(SNIFFED_BYTES)?;
    let exact = binary::declared(head)
        .is_some_and(|n| length == STL_HEADER_BYTES as u64 + n * STL_RECORD_BYTES as u64);
    let text = !exact && begins_as_text(head);
    if text && looks_ascii(head) {
        let (bytes, zeros) = without_filling(source.feed.all()?);
        no_zeros(bytes)?;
        let ascii::Read { facets, regions, warnings } = ascii::read(bytes)?;
        if zeros && warnings.contains(&Warning::NoEndsolid) {
            // Zeros here were never written over; they do not fill up a finished file.
            return Err(Fault::Zeros.at_line(line_of(bytes, bytes.len())));
        }
        return mesh("stl-ascii", &facets, regions, options, warnings);
    }
    if text {
        return Err(Fault::unexpected("STL: the word \"solid\" or a binary header", head).at_line(1));
    }
    // Before the file is read as a whole: it may be far longer than what it declares.
    let (facets, warnings) = binary::facets(head, length)?;
    if !warnings.is_empty()
        && binary::may_have_attributes(facets, length)
        && let Some(records) = binary::with_attributes(source.feed.all()?)
    {
        return mesh("stl-binary", &records, None, options, vec![]);
    }
    let bytes = source.feed.ahead(STL_HEADER_BYTES + facets * STL_RECORD_BYTES)?;
    let records = bytes.get(STL_HEADER_BYTES..).unwrap_or_default().as_chunks().0;
    mesh("stl-binary", records.get(..facets).unwrap_or(records), None, options, warnings)
}

/// One task looks at this many facets.
const STL_FACETS_PER_TASK: usize = 1 << 13;

/// The mesh of all facets but those that are not finite.
fn mesh<F: Facet>(
    variant: &'static str,
    facets: &[F],
    mut regions: Option<FacetRegions>,
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
        if let Some(regions) = &mut regions {
            let mut finite = facets.iter().map(F::finite);
            regions.of_facet.retain(|_| finite.next().unwrap_or(true));
        }
    }
    let mesh = crate::SourceMesh {
        mesh: assemble::corners(good.len(), |f, k| good[f].corner(k), options.weld != Weld::None)?,
        stored_normals: Some(good.par_iter().map(F::normal).collect()),
        nonfinite_facets: bad.into_iter().map(|f| f as u32).collect(),
        regions,
        unread: vec![],
    };
    Ok(Parsed::mesh(variant, mesh, warnings))
}

/// Numbers of the facets with a coordinate that is not finite, ascending.
fn not_finite<F: Facet>(facets: &[F]) -> Vec<usize> {
    let parts = facets.par_chunks(STL_FACETS_PER_TASK).enumerate();
    let found = parts.flat_map_iter(|(i, part)| {
        let bad = part.iter().enumerate().filter(|(_, f)| !f.finite());
        bad.map(move |(j, _)| i * STL_FACETS_PER_TASK + j)
    });
    found.collect()
}
