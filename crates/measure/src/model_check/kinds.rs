//! What is looked for in a CAD model.

use trueness_cad::check::FaultKind;
use trueness_geom::check::{DefectKind, Measure, Severity, Shows};

/// A kind that no facet tells.
const fn kind(
    name: &'static str,
    severity: Severity,
    about: &'static str,
    (size, measure): (&'static str, Measure),
    shows: Shows,
) -> DefectKind {
    DefectKind { name, severity, about, size, measure, shows, follows: false, missing: None, find: |_| None }
}

const LENGTH: (&str, Measure) = ("length of the edge, mm", Measure::Length);
const GAP: (&str, Measure) = ("greatest distance, mm", Measure::Distance);

static REFUSED: DefectKind = kind(
    "refused_faces",
    Severity::Error,
    "Faces whose border encloses nothing or contradicts itself.",
    ("0", Measure::Length),
    Shows::Points,
);
/// Faces that the reader does not know.
pub static UNREAD: DefectKind = kind(
    "unread_faces",
    Severity::Error,
    "Faces of the file that were not read.",
    ("none", Measure::Length),
    Shows::Points,
);
static FREE: DefectKind =
    kind("free_edges", Severity::Error, "Edges that end one face only.", LENGTH, Shows::Line);
static SHARED: DefectKind =
    kind("shared_edges", Severity::Error, "Edges in which more than two faces meet.", LENGTH, Shows::Line);
static OPPOSITE: DefectKind = kind(
    "opposite_faces",
    Severity::Error,
    "Edges along which the normals of two faces do not agree.",
    LENGTH,
    Shows::Line,
);
static INSIDE_OUT: DefectKind = kind(
    "inside_out_solids",
    Severity::Error,
    "Solids whose faces look inwards.",
    ("volume, mm³", Measure::Volume),
    Shows::Facets,
);
/// Faces that pass through each other.
pub static CROSSING: DefectKind = DefectKind {
    missing: Some("not asked for"),
    ..kind(
        "crossing_faces",
        Severity::Error,
        "Faces of one body that pass through each other by more than facets are off.",
        ("greatest depth of a facet, mm", Measure::Distance),
        Shows::Facets,
    )
};
static TURNED: DefectKind = kind(
    "turned_loops",
    Severity::Warning,
    "Faces that lie on the right of their loops.",
    ("0", Measure::Length),
    Shows::Facets,
);
static EDGE_GAPS: DefectKind = kind(
    "edge_gaps",
    Severity::Warning,
    "Edges farther from the surface of a face than the file says.",
    GAP,
    Shows::Line,
);
static VERTEX_GAPS: DefectKind = kind(
    "vertex_gaps",
    Severity::Warning,
    "Edges that end farther from their vertex than the file says.",
    GAP,
    Shows::Line,
);
static TINY: DefectKind =
    kind("tiny_edges", Severity::Warning, "Edges no longer than the uncertainty.", LENGTH, Shows::Line);
static SLIVERS: DefectKind = kind(
    "sliver_faces",
    Severity::Warning,
    "Faces no wider than the uncertainty.",
    ("width, mm", Measure::Height),
    Shows::Facets,
);

/// All kinds, in the order in which they are told.
pub static MODEL_KINDS: [&DefectKind; 12] = [
    &UNREAD,
    &REFUSED,
    &FREE,
    &SHARED,
    &OPPOSITE,
    &INSIDE_OUT,
    &CROSSING,
    &TURNED,
    &EDGE_GAPS,
    &VERTEX_GAPS,
    &TINY,
    &SLIVERS,
];

/// Those that leave the borders or the sides of faces open.
pub static DECIDING: [&DefectKind; 6] = [&FREE, &SHARED, &OPPOSITE, &INSIDE_OUT, &REFUSED, &UNREAD];

/// The kind of a fault.
pub fn of(kind: FaultKind) -> &'static DefectKind {
    match kind {
        FaultKind::RefusedFace => &REFUSED,
        FaultKind::FreeEdge => &FREE,
        FaultKind::SharedEdge => &SHARED,
        FaultKind::OppositeFaces => &OPPOSITE,
        FaultKind::InsideOutSolid => &INSIDE_OUT,
        FaultKind::TurnedLoops => &TURNED,
        FaultKind::EdgeGap => &EDGE_GAPS,
        FaultKind::VertexGap => &VERTEX_GAPS,
        FaultKind::TinyEdge => &TINY,
        FaultKind::SliverFace => &SLIVERS,
    }
}
