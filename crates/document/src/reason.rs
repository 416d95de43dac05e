//! Why a verdict is what it is: the one rule by which values and doubts become a verdict.

use super::word::named;
use super::{Verdict, Word};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What makes a verdict fail or undecided.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct VerdictReason {
    /// `out_of_tolerance`, `alignment`, `size_ratio`, `hardly_overlapping`, `incomplete_reference`, `not_measured`,
    /// `between_vertices`, `coverage` or `coverage_unknown`.
    pub kind: Word<ReasonKind>,
    /// One sentence for people.
    pub text: String,
}

/// What a reason is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReasonKind {
    /// More points lie beyond the tolerance than are allowed.
    OutOfTolerance,
    /// The pose cannot be relied on.
    Alignment,
    /// The sizes of measured and reference stand in a ratio as two units do.
    SizeRatio,
    /// The boxes of measured and reference hardly overlap.
    HardlyOverlapping,
    /// Not all of the reference was read.
    IncompleteReference,
    /// No point counts.
    NotMeasured,
    /// Between its vertices the measured mesh is out of tolerance.
    BetweenVertices,
    /// The points cover less of the reference than is asked for.
    Coverage,
    /// How much of the reference the points cover is not known.
    CoverageUnknown,
}

impl ReasonKind {
    /// All, in the order in which they are told.
    pub const ALL: [ReasonKind; 9] = [
        ReasonKind::OutOfTolerance,
        ReasonKind::Alignment,
        ReasonKind::SizeRatio,
        ReasonKind::HardlyOverlapping,
        ReasonKind::IncompleteReference,
        ReasonKind::NotMeasured,
        ReasonKind::BetweenVertices,
        ReasonKind::Coverage,
        ReasonKind::CoverageUnknown,
    ];

    /// Its name in documents.
    pub fn name(self) -> &'static str {
        match self {
            ReasonKind::OutOfTolerance => "out_of_tolerance",
            ReasonKind::Alignment => "alignment",
            ReasonKind::SizeRatio => "size_ratio",
            ReasonKind::HardlyOverlapping => "hardly_overlapping",
            ReasonKind::IncompleteReference => "incomplete_reference",
            ReasonKind::NotMeasured => "not_measured",
            ReasonKind::BetweenVertices => "between_vertices",
            ReasonKind::Coverage => "coverage",
            ReasonKind::CoverageUnknown => "coverage_unknown",
        }
    }

    /// What it makes of a verdict.
    fn bearing(self) -> Bearing {
        match self {
            ReasonKind::OutOfTolerance => Bearing::Fails,
            ReasonKind::Alignment
            | ReasonKind::SizeRatio
            | ReasonKind::HardlyOverlapping
            | ReasonKind::IncompleteReference => Bearing::Doubts,
            ReasonKind::NotMeasured
            | ReasonKind::BetweenVertices
            | ReasonKind::Coverage
            | ReasonKind::CoverageUnknown => Bearing::Lacks,
        }
    }
}

/// What a reason makes of a verdict.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Bearing {
    /// Points were measured that do not conform.
    Fails,
    /// The values themselves may be those of another pose or another face: they prove neither pass nor fail.
    Doubts,
    /// Something was not measured: what was measured may fail all the same, but not all passes.
    Lacks,
}

named!(ReasonKind, "kind of reason", Self::ALL, |kind| kind.name());

impl VerdictReason {
    /// A reason of this kind.
    pub fn new(kind: ReasonKind, text: impl Into<String>) -> VerdictReason {
        VerdictReason { kind: Word(kind), text: text.into() }
    }
}

/// The verdict that all reasons together allow, and the reasons that make it: a doubt about the values leaves everything open, a point
/// out of tolerance fails, what was not measured leaves open what did not fail, and what has no reason passes.
pub fn judged(reasons: &[VerdictReason]) -> (Verdict, Vec<VerdictReason>) {
    let of = |bearing: Bearing| reasons.iter().filter(move |r| r.kind.bearing() == bearing);
    let has = |bearing| of(bearing).next().is_some();
    let all = |bearings: &[Bearing]| bearings.iter().flat_map(|b| of(*b)).cloned().collect();
    if has(Bearing::Doubts) {
        (Verdict::Undecided, all(&[Bearing::Doubts, Bearing::Lacks]))
    } else if has(Bearing::Fails) {
        (Verdict::Fail, all(&[Bearing::Fails]))
    } else if has(Bearing::Lacks) {
        (Verdict::Undecided, all(&[Bearing::Lacks]))
    } else {
        (Verdict::Pass, vec![])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubts_leave_all_open_and_gaps_what_did_not_fail() {
        use ReasonKind::{Alignment, Coverage, IncompleteReference, NotMeasured, OutOfTolerance};
        for (given, verdict, told) in [
            (&[][..], Verdict::Pass, &[][..]),
            (&[OutOfTolerance], Verdict::Fail, &[OutOfTolerance]),
            (&[OutOfTolerance, Coverage], Verdict::Fail, &[OutOfTolerance]),
            (&[Coverage], Verdict::Undecided, &[Coverage]),
            (&[NotMeasured, Coverage], Verdict::Undecided, &[NotMeasured, Coverage]),
            (&[OutOfTolerance, Alignment], Verdict::Undecided, &[Alignment]),
            (
                &[OutOfTolerance, Coverage, IncompleteReference],
                Verdict::Undecided,
                &[IncompleteReference, Coverage],
            ),
        ] {
            let reasons: Vec<VerdictReason> = given.iter().map(|k| VerdictReason::new(*k, "x")).collect();
            let (found, why) = judged(&reasons);
            let why: Vec<ReasonKind> = why.iter().map(|r| *r.kind).collect();
            assert_eq!((found, &why[..]), (verdict, told), "{given:?}");
        }
    }
}
