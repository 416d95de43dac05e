//! Why facets bound no solid, in words.

use trueness_geom::check::Report;

/// Why facets enclose nothing.
pub fn why_no_solid(report: &Report) -> String {
    let closed = report.soundness.closed;
    if closed { "neighbors look in different directions" } else { "the mesh is open" }.to_string()
}

/// Why there is no genus, where there is none.
pub fn genus_reason(report: &Report) -> Option<String> {
    let s = &report.soundness;
    report.genus.is_none().then(|| match s.closed && s.consistently_oriented {
        true => "more than two facets meet at an edge, or parts touch at a vertex".into(),
        false => why_no_solid(report),
    })
}
