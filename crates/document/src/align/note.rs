//! What is to be said about an alignment.

use crate::Word;
use crate::word::named;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something to be said about an alignment.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct AlignNote {
    /// `poor`, `ambiguous`, `free`, `normals_turned`, `scale`, `few`, `unconfirmed`, `left_out`, `amplified`, `undetermined`, `mirrored` or
    /// `not_converged`; of an inspection also `size_ratio` and `hardly_overlapping`.
    pub kind: Word<AlignNoteKind>,
    /// One sentence for people.
    pub text: String,
}

/// What a note is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlignNoteKind {
    /// Half of the points, or the places that belong together, are far off.
    Poor,
    /// Other poses fit about as well.
    Ambiguous,
    /// A motion is free.
    Free,
    /// The normals were turned round.
    NormalsTurned,
    /// The measured fits when it is larger or smaller.
    Scale,
    /// Few points were given.
    Few,
    /// One of several searches alone found the pose.
    Unconfirmed,
    /// Much of the measured does not count.
    LeftOut,
    /// Errors of a row move the part many times as far.
    Amplified,
    /// A motion is not held, and the reference is not the same along it.
    Undetermined,
    /// The best fit of a mirror image is much better.
    Mirrored,
    /// The iteration did not settle.
    NotConverged,
    /// The measured and the nominal part have different sizes.
    SizeRatio,
    /// The measured and the nominal part hardly overlap.
    HardlyOverlapping,
}

impl AlignNoteKind {
    /// All, in the order above.
    pub const ALL: [AlignNoteKind; 14] = [
        AlignNoteKind::Poor,
        AlignNoteKind::Ambiguous,
        AlignNoteKind::Free,
        AlignNoteKind::NormalsTurned,
        AlignNoteKind::Scale,
        AlignNoteKind::Few,
        AlignNoteKind::Unconfirmed,
        AlignNoteKind::LeftOut,
        AlignNoteKind::Amplified,
        AlignNoteKind::Undetermined,
        AlignNoteKind::Mirrored,
        AlignNoteKind::NotConverged,
        AlignNoteKind::SizeRatio,
        AlignNoteKind::HardlyOverlapping,
    ];

    /// Its name in documents.
    pub fn name(self) -> &'static str {
        match self {
            AlignNoteKind::Poor => "poor",
            AlignNoteKind::Ambiguous => "ambiguous",
            AlignNoteKind::Free => "free",
            AlignNoteKind::NormalsTurned => "normals_turned",
            AlignNoteKind::Scale => "scale",
            AlignNoteKind::Few => "few",
            AlignNoteKind::Unconfirmed => "unconfirmed",
            AlignNoteKind::LeftOut => "left_out",
            AlignNoteKind::Amplified => "amplified",
            AlignNoteKind::Undetermined => "undetermined",
            AlignNoteKind::Mirrored => "mirrored",
            AlignNoteKind::NotConverged => "not_converged",
            AlignNoteKind::SizeRatio => "size_ratio",
            AlignNoteKind::HardlyOverlapping => "hardly_overlapping",
        }
    }

    /// Whether the alignment may be relied on no longer. What the shape leaves free, normals that were turned round, and
    /// what was left out, are only told.
    pub fn is_doubt(self) -> bool {
        match self {
            AlignNoteKind::Free
            | AlignNoteKind::NormalsTurned
            | AlignNoteKind::LeftOut
            | AlignNoteKind::Amplified => false,
            AlignNoteKind::Poor
            | AlignNoteKind::Ambiguous
            | AlignNoteKind::Scale
            | AlignNoteKind::Few
            | AlignNoteKind::Unconfirmed
            | AlignNoteKind::Undetermined
            | AlignNoteKind::Mirrored
            | AlignNoteKind::NotConverged
            | AlignNoteKind::SizeRatio
            | AlignNoteKind::HardlyOverlapping => true,
        }
    }
}

named!(AlignNoteKind, "kind of note", Self::ALL, |kind| kind.name());
