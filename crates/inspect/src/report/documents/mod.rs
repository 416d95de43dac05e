//! What a page needs to know of a result document: one file each.

mod alignment;
mod check;
mod compare;
mod curvature;
mod fit;
mod inspect;
mod repair;
mod section;
mod segment;
mod subject;
mod surface;
mod trend;

pub use section::flat;
pub use subject::{Drawn, Frame, Head, Map, Pick, Subject};
pub use trend::MapPage;

use crate::results::check::CheckDocument;
use crate::results::compare::CompareDocument;
use crate::results::curvature::CurvatureDocument;
use crate::results::fit::FitDocument;
use crate::results::inspect::InspectDocument;
use crate::results::repair::RepairDocument;
use crate::results::section::SectionDocument;
use crate::results::segment::SegmentDocument;
use crate::results::surface::SurfaceDocument;
use crate::results::trend::TrendDocument;

/// The document that a report is of; every number on the page is from it.
#[derive(Clone, Copy, Debug)]
pub enum Answer<'a> {
    /// Is this mesh sound?
    Check(&'a CheckDocument),
    /// How far is the measured from the reference?
    Compare(&'a CompareDocument),
    /// How does this mesh or cloud bend?
    Curvature(&'a CurvatureDocument),
    /// Which element lies through these points?
    Fit(&'a FitDocument),
    /// Does this part keep its tolerances?
    Inspect(&'a InspectDocument),
    /// What was mended in this mesh?
    Repair(&'a RepairDocument),
    /// Which lines, arcs and curves is this section made of?
    Section(&'a SectionDocument),
    /// Which elements are in this mesh or cloud?
    Segment(&'a SegmentDocument),
    /// Which surface lies through these points?
    Surface(&'a SurfaceDocument),
    /// Does this process keep its tolerances, part by part?
    Trend(&'a TrendDocument),
    /// What do the parts have in common, and where do they differ?
    TrendMap(MapPage<'a>),
}

impl Answer<'_> {
    /// What the page is made of.
    pub(super) fn subject(&self) -> &dyn Subject {
        match self {
            Answer::Check(d) => *d,
            Answer::Compare(d) => *d,
            Answer::Curvature(d) => *d,
            Answer::Fit(d) => *d,
            Answer::Inspect(d) => *d,
            Answer::Repair(d) => *d,
            Answer::Section(d) => *d,
            Answer::Segment(d) => *d,
            Answer::Surface(d) => *d,
            Answer::Trend(d) => *d,
            Answer::TrendMap(d) => d,
        }
    }
}
